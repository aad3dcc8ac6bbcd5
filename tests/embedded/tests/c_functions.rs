//! Checks that the C functions are the kernels: the same bits in the order of the header, and no output if an argument
//! is null.
#![allow(unsafe_code)]

use std::ffi::CStr;
use std::ptr::{null, null_mut};

use eigentol::Mechanism;
use eigentol_embedded::for_c::{Swing, ball_c, swing_c::*};

const Q: [f64; 2] = [0.3, -0.2];
const U: [f64; 1] = [4.0];
const B: [f64; 3] = [2.1, 3.3, 0.7];
const V: [f64; 2] = [1.5, -0.6];
const A: [f64; 2] = [-2.5, 0.8];

/// Fills the results before a call, and must still be there beyond the end of each result afterwards.
const UNTOUCHED: f64 = 12345.0;

/// Calls a function with the state and pointers to the requested number of results, each with room for `R` numbers.
macro_rules! call {
    ($function:ident($($argument:expr),*) -> [$($result:ident: $length:expr),*]) => {
        $(let mut $result = [UNTOUCHED; $length + 1];)*
        // SAFETY: the lengths are those in the header, plus one number after each result.
        let code = unsafe { $function($($argument,)* $($result.as_mut_ptr()),*) };
        assert_eq!(code, 0);
        $(
            let [$result @ .., behind] = $result;
            assert_eq!(behind, UNTOUCHED);
        )*
    };
}

fn state() -> [*const f64; 3] {
    [Q.as_ptr(), U.as_ptr(), B.as_ptr()]
}

#[test]
fn residuals() {
    let [q, u, b] = state();
    call!(swing_residual(q, u, b) -> [residual: 2]);
    assert_eq!(residual, Swing.residual(&Q, &U, &B));
    call!(swing_residual_parts(q, u, b) -> [inertia: 2, applied: 2]);
    let parts = Swing.residual_parts(&Q, &U, &B);
    assert_eq!((inertia, applied), (parts.inertia, parts.applied));
    call!(swing_motion_residual(A.as_ptr(), V.as_ptr(), q, u, b) -> [moving: 2]);
    assert_eq!(moving, Swing.motion_residual(&A, &V, &Q, &U, &B));
    call!(swing_motion(V.as_ptr(), q, u, b) -> [mass: 4, force: 2]);
    let motion = Swing.motion(&V, &Q, &U, &B);
    assert_eq!((mass.as_slice(), force), (motion.0.as_flattened(), motion.1));
}

#[test]
fn matrices() {
    let [q, u, b] = state();
    call!(swing_residual_and_stiffness(q, u, b) -> [residual: 2, newton: 4]);
    let (expected, square) = Swing.residual_and_stiffness(&Q, &U, &B);
    assert_eq!((residual, newton.as_slice()), (expected, square.as_flattened()));

    call!(swing_linear(q, u, b) -> [mass: 4, damping: 4, stiffness: 4]);
    let linear = Swing.linear(&Q, &U, &B);
    assert_eq!(mass, *linear.mass.as_flattened());
    assert_eq!(damping, *linear.damping.as_flattened());
    assert_eq!(stiffness, *linear.stiffness.as_flattened());

    let moving = Swing.motion_linear(&A, &V, &Q, &U, &B);
    call!(swing_motion_linear(A.as_ptr(), V.as_ptr(), q, u, b) -> [mass: 4, damping: 4, stiffness: 4]);
    assert_eq!(mass, *moving.mass.as_flattened());
    assert_eq!(damping, *moving.damping.as_flattened());
    assert_eq!(stiffness, *moving.stiffness.as_flattened());
    assert_ne!(stiffness[1], stiffness[2], "a transposed matrix is seen");

    let (du, db) = ([0.7], [0.1, -0.2, 0.3]);
    let along = Swing.linear_along(&Q, &U, &B, &V, &du, &db);
    call!(swing_linear_along(q, u, b, V.as_ptr(), du.as_ptr(), db.as_ptr()) -> [mass: 4, damping: 4, stiffness: 4]);
    assert_eq!(mass, *along.mass.as_flattened());
    assert_eq!(damping, *along.damping.as_flattened());
    assert_eq!(stiffness, *along.stiffness.as_flattened());
}

#[test]
fn partial_derivatives() {
    let [q, u, b] = state();
    call!(swing_residual_partials(q, u, b) -> [by_input: 2, by_design: 6]);
    let partials = Swing.residual_partials(&Q, &U, &B);
    assert_eq!(by_input, *partials.0.as_flattened());
    assert_eq!(by_design, *partials.1.as_flattened());

    call!(swing_linear_partials(q, u, b) -> [
        mass_q: 8, damping_q: 8, stiffness_q: 8,
        mass_u: 4, damping_u: 4, stiffness_u: 4,
        mass_b: 12, damping_b: 12, stiffness_b: 12
    ]);
    let partials = Swing.linear_partials(&Q, &U, &B);
    let of_coordinates = partials.by_coordinate;
    let of_design = partials.by_design;
    assert_eq!(mass_q, *of_coordinates.map(|l| l.mass).as_flattened().as_flattened());
    assert_eq!(damping_q, *of_coordinates.map(|l| l.damping).as_flattened().as_flattened());
    assert_eq!(stiffness_q, *of_coordinates.map(|l| l.stiffness).as_flattened().as_flattened());
    assert_eq!(mass_u, *partials.by_input[0].mass.as_flattened());
    assert_eq!(damping_u, *partials.by_input[0].damping.as_flattened());
    assert_eq!(stiffness_u, *partials.by_input[0].stiffness.as_flattened());
    assert_eq!(mass_b, *of_design.map(|l| l.mass).as_flattened().as_flattened());
    assert_eq!(damping_b, *of_design.map(|l| l.damping).as_flattened().as_flattened());
    assert_eq!(stiffness_b, *of_design.map(|l| l.stiffness).as_flattened().as_flattened());
}

#[test]
fn gradients() {
    let [q, u, b] = state();
    let phi = [1.0, -0.4];
    call!(swing_mode_gradient(q, u, b, phi.as_ptr(), 3.0) -> [by_q: 2, by_u: 1, by_b: 3]);
    let gradient = Swing.mode_gradient(&Q, &U, &B, &phi, 3.0);
    assert_eq!((by_q, by_u, by_b), (gradient.coordinates, gradient.inputs, gradient.design));

    call!(swing_pencil_gradient(q, u, b, phi.as_ptr(), A.as_ptr(), V.as_ptr(), Q.as_ptr()) -> [by_q: 2, by_u: 1, by_b: 3]);
    let gradient = Swing.pencil_gradient(&Q, &U, &B, &phi, &A, &V, &Q);
    assert_eq!((by_q, by_u, by_b), (gradient.coordinates, gradient.inputs, gradient.design));

    call!(swing_residual_gradient(q, u, b, phi.as_ptr()) -> [by_q: 2, by_u: 1, by_b: 3]);
    let gradient = Swing.residual_gradient(&Q, &U, &B, &phi);
    assert_eq!((by_q, by_u, by_b), (gradient.coordinates, gradient.inputs, gradient.design));
}

#[test]
fn outputs_and_whirl() {
    let [q, u, b] = state();
    call!(swing_outputs(q, u, b) -> [outputs: 4]);
    assert_eq!(outputs, Swing.outputs(&Q, &U, &B));
    call!(swing_output_partials(q, u, b) -> [by_q: 8, by_u: 4, by_b: 12]);
    let partials = Swing.output_partials(&Q, &U, &B);
    assert_eq!(by_q, *partials.0.as_flattened());
    assert_eq!(by_u, *partials.1.as_flattened());
    assert_eq!(by_b, *partials.2.as_flattened());
    call!(swing_whirl(q, u, b, A.as_ptr(), V.as_ptr()) -> [sums: 7]);
    assert_eq!(sums, Swing.whirl(&Q, &U, &B, &A, &V));
    assert_ne!(sums[0], 0.0);
}

#[test]
fn constants_name_places() {
    call!(swing_nominal() -> [b: 3]);
    assert_eq!(b[SWING_DESIGN_m], 2.0);
    assert_eq!(b[SWING_DESIGN_M], 3.5);
    assert_eq!(b[SWING_DESIGN_l], 0.8);
    assert_eq!([SWING_COORDINATES, SWING_INPUTS, SWING_DESIGN, SWING_OUTPUTS], [2, 1, 3, 4]);
    assert_eq!([SWING_COORDINATE_alpha, SWING_COORDINATE_beta], [0, 1]);
    assert_eq!([SWING_INPUT_omega, SWING_OUTPUT_sum], [0, 3]);
    assert_eq!(ball_c::BALL_COORDINATE_roll, 2);
}

fn violation(b: [f64; 3]) -> Option<&'static str> {
    let mut text = null();
    // SAFETY: the lengths are those in the header.
    let code = unsafe { swing_violation(U.as_ptr(), b.as_ptr(), &raw mut text) };
    assert_eq!(code, 0);
    // SAFETY: the text has static lifetime.
    (!text.is_null()).then(|| unsafe { CStr::from_ptr(text) }.to_str().unwrap_or_default())
}

#[test]
fn requirements_are_told_in_words() {
    assert_eq!(violation(B), None);
    assert_eq!(violation([2.0, -1.0, 0.8]), Some("mass of lower has to be positive"));
    assert_eq!(violation([f64::NAN, 1.0, 0.8]), Some("mass of upper has to be positive"));
    assert_eq!(violation([2.0, 1.0, 0.0]), Some("length of upper has to be positive"));
}

#[test]
fn null_is_answered_by_the_position_of_the_argument() {
    let [q, u, b] = state();
    let mut numbers = [[UNTOUCHED; 2]; 3];
    let [x, y, z] = &mut numbers;
    let (x, y, z) = (x.as_mut_ptr(), y.as_mut_ptr(), z.as_mut_ptr());
    let mut text = c"untouched".as_ptr();
    // SAFETY: nothing is read or written if an argument is null.
    let codes = unsafe {
        [
            swing_residual(null(), u, b, x),
            swing_residual(q, null(), b, x),
            swing_residual(q, u, null(), x),
            swing_residual(q, u, b, null_mut()),
            // numbers count as arguments
            swing_mode_gradient(q, u, b, null(), 1.0, x, y, z),
            swing_mode_gradient(q, u, b, q, 1.0, null_mut(), y, z),
            swing_mode_gradient(q, u, b, q, 1.0, x, y, null_mut()),
            swing_nominal(null_mut()),
            swing_violation(null(), b, &raw mut text),
            swing_violation(u, b, null_mut()),
        ]
    };
    assert_eq!(codes, [1, 2, 3, 4, 4, 6, 8, 1, 1, 3]);
    assert_eq!(numbers, [[UNTOUCHED; 2]; 3]);
    assert_eq!(text, c"untouched".as_ptr());
}

#[test]
fn null_stands_for_lists_without_entries() {
    let q = [0.1, 0.2, 0.3];
    let (mut residual, mut margin) = ([UNTOUCHED; 3], [UNTOUCHED]);
    let (none, nowhere) = (null(), null_mut());
    // SAFETY: the lengths are those in the header.
    let codes = unsafe {
        [
            ball_c::ball_residual(q.as_ptr(), none, none, residual.as_mut_ptr()),
            ball_c::ball_outputs(q.as_ptr(), none, none, nowhere),
            ball_c::ball_nominal(nowhere),
            ball_c::ball_pose_margin(q.as_ptr(), none, none, margin.as_mut_ptr()),
            ball_c::ball_pose_margin(none, none, none, margin.as_mut_ptr()),
        ]
    };
    assert_eq!(codes, [0, 0, 0, 0, 1]);
    assert!(residual.iter().all(|entry| entry.is_finite()));
    // axes z, y, x: the volume is the cosine of the middle rotation
    assert!((margin[0] - 0.2_f64.cos()).abs() < 1e-15);
}

/// A result may overwrite an argument.
#[test]
fn results_may_overlap_arguments() {
    let mut numbers = Q;
    let [_, u, b] = state();
    // SAFETY: both are two numbers long.
    let code = unsafe { swing_residual(numbers.as_ptr(), u, b, numbers.as_mut_ptr()) };
    assert_eq!((code, numbers), (0, Swing.residual(&Q, &U, &B)));
}
