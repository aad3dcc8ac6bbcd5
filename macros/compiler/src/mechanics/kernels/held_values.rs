//! The values that select one of a family of steady motions, and the speeds of rings.

use crate::algebra::{Array, ExprId, Function, Graph};
use crate::mechanics::kernel_name::KernelName;
use crate::mechanics::setup::Context;

use super::parameters::parameter;

/// The function of the declared values, followed by the speeds at which rings turn; `None` if there are none.
pub(crate) fn held_values(g: &mut Graph, context: &Context, speeds: &[ExprId]) -> Option<Function> {
    let steady = &context.mechanism.steady;
    let (symbols, values) = (context.symbols, context.values);
    let held = steady.iter().map(|x| values.scalar(g, &x.value));
    let values: Vec<ExprId> = held.chain(speeds.iter().copied()).collect();
    (!values.is_empty()).then(|| Function {
        name: KernelName::HeldValues.name(),
        parameters: vec![parameter("u", &symbols.u), parameter("b", &symbols.b)],
        results: vec![Array { name: "values", shape: vec![values.len()], values }],
    })
}
