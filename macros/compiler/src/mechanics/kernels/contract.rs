//! The kernels of the runtime's contract: the expressions that each returns, and their order.

use crate::algebra::{Array, ExprId, Function, Graph, Parameter, cost, substitute};
use crate::mechanics::equations::Equations;
use crate::mechanics::functions::Limits;
use crate::mechanics::kernel_name::KernelName;
use crate::mechanics::linear::{Linear, linear_arrays};
use crate::mechanics::setup::{Symbols, at_rest, columns};

use super::adjoint::{mode_functional, pencil_functional, state_gradient};
use super::parameters::{parameter, scalar, vectors};

/// All kernels, in the order of the runtime's contract.
pub(crate) fn kernels(g: &mut Graph, s: &Symbols, e: &Equations, linear: &Linear, limits: Limits) -> Vec<Function> {
    let n = e.rest.len();
    let vector = |name, values: &[ExprId]| Array { name, shape: vec![values.len()], values: values.to_vec() };
    let state = [parameter("q", &s.q), parameter("u", &s.u), parameter("b", &s.b)];
    let function = |kernel: KernelName, before: Vec<Parameter>, after: Vec<Parameter>, results| Function {
        name: kernel.name(),
        parameters: before.into_iter().chain(state.clone()).chain(after).collect(),
        results,
    };

    let zeros = vec![g.zero(); n];
    let still: Vec<_> = s.acceleration.with(&zeros).collect();
    let force: Vec<ExprId> = substitute(g, &e.motion, &still).iter().map(|&h| g.neg(h)).collect();

    let by_input = columns(g, &e.rest, &s.u);
    let by_design = columns(g, &e.rest, &s.b);
    let arguments = [&s.q, &s.u, &s.b];
    let entries = 3 * n * n * arguments.iter().map(|list| list.ids.len()).sum::<usize>();
    let partials: Option<Vec<Array>> = (entries <= limits.explicit_partials)
        .then(|| arguments.iter().flat_map(|list| linear.partials(g, n, list)).collect());
    let partials = partials.filter(|arrays| {
        let all: Vec<ExprId> = arrays.iter().flat_map(|array| array.values.clone()).collect();
        cost(g, &all).operations <= limits.partial_operations
    });
    let mode_functional = mode_functional(g, s, e);
    let mode_gradient = state_gradient(g, s, mode_functional);
    let pencil_functional = pencil_functional(g, s, e);
    let pencil_gradient = state_gradient(g, s, pencil_functional);
    let weighted = at_rest(g, s, &e.powers[2..]);
    let residual_gradient = state_gradient(g, s, weighted[0]);
    let outputs_by: Vec<Vec<Vec<ExprId>>> = [&s.q, &s.u, &s.b].map(|list| columns(g, &e.outputs, list)).into();
    let mode = || vec![parameter("phi", &s.phi), scalar("lambda", &s.lambda)];

    let mut functions = vec![
        function(KernelName::Residual, vec![], vec![], vec![vector("residual", &e.rest)]),
        function(
            KernelName::ResidualParts,
            vec![],
            vec![],
            vec![vector("inertia", &e.rest_inertia), vector("applied", &e.rest_applied)],
        ),
        function(
            KernelName::MotionResidual,
            vec![parameter("acceleration", &s.acceleration), parameter("velocity", &s.velocity)],
            vec![],
            vec![vector("residual", &e.motion)],
        ),
        function(
            KernelName::Motion,
            vec![parameter("velocity", &s.velocity)],
            vec![],
            vec![linear.arrays(n).swap_remove(0), vector("force", &force)],
        ),
        function(
            KernelName::ResidualAndStiffness,
            vec![],
            vec![],
            vec![vector("residual", &e.rest), linear.arrays(n).swap_remove(2)],
        ),
        function(KernelName::Linear, vec![], vec![], linear.arrays(n)),
        function(
            KernelName::ResidualPartials,
            vec![],
            vec![],
            vec![rows("by_input", n, &by_input), rows("by_design", n, &by_design)],
        ),
        function(KernelName::ModeGradient, vec![], mode(), mode_gradient),
        function(KernelName::PencilGradient, vec![], vectors(&s.pencil), pencil_gradient),
        function(KernelName::ResidualGradient, vec![], vec![parameter("w", &s.w)], residual_gradient),
        function(KernelName::Outputs, vec![], vec![], vec![vector("outputs", &e.outputs)]),
        function(
            KernelName::OutputPartials,
            vec![],
            vec![],
            ["by_coordinate", "by_input", "by_design"]
                .into_iter()
                .zip(&outputs_by)
                .map(|(name, columns)| rows(name, e.outputs.len(), columns))
                .collect(),
        ),
    ];
    if let Some(motion) = linear.along_motion(g, s, e, limits.motion_linear) {
        let before = vec![parameter("acceleration", &s.acceleration), parameter("velocity", &s.velocity)];
        functions.push(function(KernelName::MotionLinear, before, vec![], linear_arrays(&motion, n)));
    }
    functions.extend(partials.map(|arrays| function(KernelName::LinearPartials, vec![], vec![], arrays)));
    functions
}

/// Columns as an array with one row per function.
fn rows(name: &'static str, count: usize, columns: &[Vec<ExprId>]) -> Array {
    let values = (0..count).flat_map(|i| columns.iter().map(move |column| column[i])).collect();
    Array { name, shape: vec![count, columns.len()], values }
}
