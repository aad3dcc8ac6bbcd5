//! Calls generated code by kernel name, over vectors of any scalar; results are flattened as the interpreter's are.

use eigentol::{Array, Gradient, Linear, Mechanism, Real};

/// Calls a kernel of the runtime's contract: one vector per returned array, indices of differentiation outermost.
/// `None` for a name that is not in the contract.
///
/// # Panics
/// When the number or the lengths of the arguments are wrong.
pub fn evaluate<T: Real, M: Mechanism>(machine: &M, kernel: &str, arguments: &[Vec<T>]) -> Option<Vec<Vec<T>>> {
    let q = |k: usize| <M::Coordinates<T> as Array<T>>::view(&arguments[k]);
    let u = |k: usize| <M::Inputs<T> as Array<T>>::view(&arguments[k]);
    let b = |k: usize| <M::Design<T> as Array<T>>::view(&arguments[k]);
    let scalar = |k: usize| arguments[k][0];
    Some(match kernel {
        "motion_residual" => {
            vec![machine.motion_residual(q(0), q(1), q(2), u(3), b(4)).as_ref().to_vec()]
        }
        "motion" => {
            let (mass, right) = machine.motion(q(0), q(1), u(2), b(3));
            vec![flat(mass.as_ref()), right.as_ref().to_vec()]
        }
        "residual_and_stiffness" => {
            let (residual, stiffness) = machine.residual_and_stiffness(q(0), u(1), b(2));
            vec![residual.as_ref().to_vec(), flat(stiffness.as_ref())]
        }
        "linear_partials" => {
            let partials = machine.linear_partials(q(0), u(1), b(2));
            let mut arrays = matrices(partials.by_coordinate.as_ref());
            arrays.extend(matrices(partials.by_input.as_ref()));
            arrays.extend(matrices(partials.by_design.as_ref()));
            arrays
        }
        "linear_along" => matrices(&[machine.linear_along(q(0), u(1), b(2), q(3), u(4), b(5))]),
        "mode_gradient" => gradient(machine.mode_gradient(q(0), u(1), b(2), q(3), scalar(4))),
        "pencil_gradient" => gradient(machine.pencil_gradient(q(0), u(1), b(2), q(3), q(4), q(5), q(6))),
        "residual_gradient" => gradient(machine.residual_gradient(q(0), u(1), b(2), q(3))),
        "mode_gradient_along" => {
            gradient(machine.mode_gradient_along(q(0), u(1), b(2), q(3), scalar(4), q(5), u(6), b(7), q(8), scalar(9)))
        }
        "pencil_gradient_along" => gradient(machine.pencil_gradient_along(
            q(0),
            u(1),
            b(2),
            q(3),
            q(4),
            q(5),
            q(6),
            q(7),
            u(8),
            b(9),
            q(10),
            q(11),
            q(12),
            q(13),
        )),
        "residual_gradient_along" => {
            gradient(machine.residual_gradient_along(q(0), u(1), b(2), q(3), q(4), u(5), b(6), q(7)))
        }
        "forced_gradient" => {
            let o = |k: usize| <M::Outputs<T> as Array<T>>::view(&arguments[k]);
            let e = |k: usize| <M::Excitations<T> as Array<T>>::view(&arguments[k]);
            gradient(machine.forced_gradient(
                q(0),
                u(1),
                b(2),
                o(3),
                q(4),
                q(5),
                q(6),
                e(7),
                q(8),
                q(9),
                o(10),
                o(11),
                e(12),
            ))
        }
        "motion_linear" => matrices(&[machine.motion_linear(q(0), q(1), q(2), u(3), b(4))]),
        "whirl" => vec![machine.whirl(q(0), u(1), b(2), q(3), q(4)).to_vec()],
        other => return evaluate_at(machine, other, arguments),
    })
}

/// Like [`evaluate`], but only for kernels of `q`, `u`, `b` that differentiate at most once: another scalar can be
/// tested on these without rustc translating everything for it.
///
/// # Panics
/// When the number or the lengths of the arguments are wrong.
pub fn evaluate_at<T: Real, M: Mechanism>(machine: &M, kernel: &str, arguments: &[Vec<T>]) -> Option<Vec<Vec<T>>> {
    let q = |k: usize| <M::Coordinates<T> as Array<T>>::view(&arguments[k]);
    let u = |k: usize| <M::Inputs<T> as Array<T>>::view(&arguments[k]);
    let b = |k: usize| <M::Design<T> as Array<T>>::view(&arguments[k]);
    Some(match kernel {
        "residual" => vec![machine.residual(q(0), u(1), b(2)).as_ref().to_vec()],
        "residual_parts" => {
            let parts = machine.residual_parts(q(0), u(1), b(2));
            vec![parts.inertia.as_ref().to_vec(), parts.applied.as_ref().to_vec()]
        }
        "linear" => matrices(&[machine.linear(q(0), u(1), b(2))]),
        "residual_partials" => {
            let (by_input, by_design) = machine.residual_partials(q(0), u(1), b(2));
            vec![flat(by_input.as_ref()), flat(by_design.as_ref())]
        }
        "picture" => vec![machine.picture(q(0), u(1), b(2)).as_ref().to_vec()],
        "outputs" => vec![machine.outputs(q(0), u(1), b(2)).as_ref().to_vec()],
        "output_partials" => {
            let (by_coordinate, by_input, by_design) = machine.output_partials(q(0), u(1), b(2));
            vec![flat(by_coordinate.as_ref()), flat(by_input.as_ref()), flat(by_design.as_ref())]
        }
        "forcing" => {
            let forcing = machine.forcing(q(0), u(1), b(2));
            vec![
                flat(forcing.cosine.as_ref()),
                forcing.frequency.as_ref().to_vec(),
                flat(forcing.direct_cosine.as_ref()),
                flat(forcing.sine.as_ref()),
                flat(forcing.direct_sine.as_ref()),
            ]
        }
        "output_motion" => {
            let (acceleration, velocity, position) = machine.output_motion(q(0), u(1), b(2));
            vec![flat(acceleration.as_ref()), flat(velocity.as_ref()), flat(position.as_ref())]
        }
        _ => return None,
    })
}

fn flat<T: Copy, R: AsRef<[T]>>(rows: &[R]) -> Vec<T> {
    rows.iter().flat_map(AsRef::as_ref).copied().collect()
}

/// All mass matrices, then all damping matrices, then all stiffness matrices.
fn matrices<T: Copy, R: AsRef<[T]>, A: AsRef<[R]>>(list: &[Linear<A>]) -> Vec<Vec<T>> {
    let part =
        |of: fn(&Linear<A>) -> &A| -> Vec<T> { list.iter().flat_map(|linear| flat(of(linear).as_ref())).collect() };
    vec![part(|linear| &linear.mass), part(|linear| &linear.damping), part(|linear| &linear.stiffness)]
}

fn gradient<T: Copy>(gradient: Gradient<impl AsRef<[T]>, impl AsRef<[T]>, impl AsRef<[T]>>) -> Vec<Vec<T>> {
    vec![gradient.coordinates.as_ref().to_vec(), gradient.inputs.as_ref().to_vec(), gradient.design.as_ref().to_vec()]
}
