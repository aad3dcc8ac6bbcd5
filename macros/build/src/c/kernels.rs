//! The kernels available in C, and their documentation there.

use eigentol_compiler::Compilation;

use super::function::{Answer, Argument, Function, Part, Size};
use Argument::{Array, Number};
use Part::{Matrices, Slice};
use Size::{E, Exactly, N, O, P, U};

const STATE: [Argument; 3] = [Array("q", N), Array("u", U), Array("b", P)];

const fn answer(name: &'static str, shape: &'static [Size], part: Part) -> Answer {
    Answer { name, shape, part }
}

const LINEAR: &[Answer] = &[
    answer("mass", &[N, N], Slice("result.mass.as_flattened()")),
    answer("damping", &[N, N], Slice("result.damping.as_flattened()")),
    answer("stiffness", &[N, N], Slice("result.stiffness.as_flattened()")),
];

const GRADIENT: &[Answer] = &[
    answer("by_coordinate", &[N], Slice("&result.coordinates")),
    answer("by_input", &[U], Slice("&result.inputs")),
    answer("by_design", &[P], Slice("&result.design")),
];

const PARTIALS: &[Answer] = &[
    answer("mass_by_coordinate", &[N, N, N], Matrices("by_coordinate", "mass")),
    answer("damping_by_coordinate", &[N, N, N], Matrices("by_coordinate", "damping")),
    answer("stiffness_by_coordinate", &[N, N, N], Matrices("by_coordinate", "stiffness")),
    answer("mass_by_input", &[U, N, N], Matrices("by_input", "mass")),
    answer("damping_by_input", &[U, N, N], Matrices("by_input", "damping")),
    answer("stiffness_by_input", &[U, N, N], Matrices("by_input", "stiffness")),
    answer("mass_by_design", &[P, N, N], Matrices("by_design", "mass")),
    answer("damping_by_design", &[P, N, N], Matrices("by_design", "damping")),
    answer("stiffness_by_design", &[P, N, N], Matrices("by_design", "stiffness")),
];

fn function(
    name: &'static str,
    about: &'static str,
    [before, after]: [&[Argument]; 2],
    answers: &[Answer],
) -> Function {
    Function { name, about, arguments: [before, &STATE, after].concat(), answers: answers.to_vec() }
}

/// The kernels of a mechanism, in the order of the runtime's contract.
pub(super) fn kernels(compilation: &Compilation) -> Vec<Function> {
    let velocity = Array("velocity", N);
    let moving = [Array("acceleration", N), velocity];
    let has = |name: &str| compilation.program.kernel(name).is_some();
    let mut functions = vec![
        function(
            "residual",
            "Residual at rest, N or N m by coordinate: zero at an equilibrium.",
            [&[], &[]],
            &[answer("residual", &[N], Slice("&result"))],
        ),
        function(
            "residual_parts",
            "Residual at rest in two parts: `residual = inertia - applied`.",
            [&[], &[]],
            &[answer("inertia", &[N], Slice("&result.inertia")), answer("applied", &[N], Slice("&result.applied"))],
        ),
        function(
            "motion_residual",
            "Residual of the nonlinear equations of motion: zero along a motion.",
            [&moving, &[]],
            &[answer("residual", &[N], Slice("&result"))],
        ),
        function(
            "motion",
            "Mass matrix and force of the nonlinear equations of motion, `mass * acceleration = force`.",
            [&[velocity], &[]],
            &[answer("mass", &[N, N], Slice("result.0.as_flattened()")), answer("force", &[N], Slice("&result.1"))],
        ),
        function(
            "motion_linear",
            "Derivatives of `motion_residual` by accelerations, velocities and coordinates.",
            [&moving, &[]],
            LINEAR,
        ),
        function(
            "residual_and_stiffness",
            "Residual at rest and its derivative by the coordinates: what a step of Newton's method needs.",
            [&[], &[]],
            &[
                answer("residual", &[N], Slice("&result.0")),
                answer("stiffness", &[N, N], Slice("result.1.as_flattened()")),
            ],
        ),
        function("linear", "Mass, damping and stiffness of small motions about an equilibrium.", [&[], &[]], LINEAR),
        function(
            "residual_partials",
            "Derivatives of the residual at rest by every input and every design variable.",
            [&[], &[]],
            &[
                answer("by_input", &[N, U], Slice("result.0.as_flattened()")),
                answer("by_design", &[N, P], Slice("result.1.as_flattened()")),
            ],
        ),
    ];
    if has("linear_partials") {
        functions.push(function(
            "linear_partials",
            "Derivatives of the three matrices by every coordinate, input and design variable: `..[k]` by the one of index `k`.",
            [&[], &[]],
            PARTIALS,
        ));
    }
    functions.extend([
        function(
            "linear_along",
            "Derivative of the three matrices along the direction `dq`, `du`, `db`.",
            [&[], &[Array("dq", N), Array("du", U), Array("db", P)]],
            LINEAR,
        ),
        function(
            "mode_gradient",
            "Derivatives of `phi^T (stiffness - lambda mass) phi`, with `phi` and `lambda` held fixed.",
            [&[], &[Array("phi", N), Number("lambda")]],
            GRADIENT,
        ),
        function(
            "pencil_gradient",
            "Derivatives of `left^T (mass acceleration + damping velocity + stiffness position)`, the four vectors held fixed.",
            [
                &[],
                &[
                    Array("left", N),
                    Array("acceleration", N),
                    velocity,
                    Array("position", N),
                ],
            ],
            GRADIENT,
        ),
        function(
            "residual_gradient",
            "Derivatives of `w^T residual`, with `w` held fixed.",
            [&[], &[Array("w", N)]],
            GRADIENT,
        ),
    ]);
    if has("whirl") {
        functions.push(function(
            "whirl",
            "How the vibration `Re((real + i imaginary) e^(i w t))`, `w > 0`, moves the bodies that spin: `moment`, `lateral`,\n\
             `torsional`, `axial`, `eccentric`, `moving`, `still`. `moment` is positive where the vibration runs with the\n\
             spin, negative where it runs against it, at most as large as `lateral`.",
            [&[], &[Array("real", N), Array("imaginary", N)]],
            &[answer("sums", &[Exactly(7)], Slice("&result"))],
        ));
    }
    functions.extend([
        function("outputs", "The declared outputs, SI.", [&[], &[]], &[answer("outputs", &[O], Slice("&result"))]),
        function(
            "output_partials",
            "Derivatives of the outputs by every coordinate, input and design variable.",
            [&[], &[]],
            &[
                answer("by_coordinate", &[O, N], Slice("result.0.as_flattened()")),
                answer("by_input", &[O, U], Slice("result.1.as_flattened()")),
                answer("by_design", &[O, P], Slice("result.2.as_flattened()")),
            ],
        ),
    ]);
    if has("forcing") {
        functions.extend([
            function(
                "forcing",
                "Harmonic excitations: forces `cosine cos(w t) + sine sin(w t)` on the equations of motion and directly on the outputs,\n\
                 and `w`, rad/s.",
                [&[], &[]],
                &[
                    answer("cosine", &[E, N], Slice("result.cosine.as_flattened()")),
                    answer("frequency", &[E], Slice("&result.frequency")),
                    answer(
                        "direct_cosine",
                        &[E, O],
                        Slice("result.direct_cosine.as_flattened()"),
                    ),
                    answer("sine", &[E, N], Slice("result.sine.as_flattened()")),
                    answer(
                        "direct_sine",
                        &[E, O],
                        Slice("result.direct_sine.as_flattened()"),
                    ),
                ],
            ),
            function(
                "output_motion",
                "Derivatives of the outputs along any motion by accelerations, velocities and coordinates, at rest.",
                [&[], &[]],
                &[
                    answer(
                        "by_acceleration",
                        &[O, N],
                        Slice("result.0.as_flattened()"),
                    ),
                    answer("by_velocity", &[O, N], Slice("result.1.as_flattened()")),
                    answer("by_position", &[O, N], Slice("result.2.as_flattened()")),
                ],
            ),
        ]);
    }
    functions
}
