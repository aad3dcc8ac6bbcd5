//! The numbers of shafts: for each span its speed and the numbers of its sections.

use crate::algebra::{Array, ExprId, Function, Graph};
use crate::mechanics::kernel_name::KernelName;
use crate::mechanics::setup::Context;

use super::parameters::parameter;

/// The function of these numbers; `None` without shafts.
pub(crate) fn spans(g: &mut Graph, context: &Context) -> Option<Function> {
    let (symbols, values) = (context.symbols, context.values);
    let spans = context.mechanism.spans();
    let numbers = spans.flat_map(|span| std::iter::once(&span.speed).chain(span.sections.iter().flatten()));
    let values: Vec<ExprId> = numbers.map(|number| values.scalar(g, number)).collect();
    (!values.is_empty()).then(|| Function {
        name: KernelName::Spans.name(),
        parameters: vec![parameter("u", &symbols.u), parameter("b", &symbols.b)],
        results: vec![Array { name: "numbers", shape: vec![values.len()], values }],
    })
}
