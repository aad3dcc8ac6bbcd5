//! The values that select one of a family of steady motions.

use crate::algebra::{Array, ExprId, Function, Graph};
use crate::mechanics::kernel_name::KernelName;
use crate::mechanics::setup::Context;

use super::parameters::parameter;

/// The function of the declared values; `None` if there are none.
pub(crate) fn held_values(g: &mut Graph, context: &Context) -> Option<Function> {
    let steady = &context.mechanism.steady;
    let (symbols, values) = (context.symbols, context.values);
    let values: Vec<ExprId> = steady.iter().map(|x| values.scalar(g, &x.value)).collect();
    (!values.is_empty()).then(|| Function {
        name: KernelName::HeldValues.name(),
        parameters: vec![parameter("u", &symbols.u), parameter("b", &symbols.b)],
        results: vec![Array { name: "values", shape: vec![values.len()], values }],
    })
}
