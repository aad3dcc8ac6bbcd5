//! Lists of numbers with their unit: the points of a curve, or the possible values of a design variable.

use super::resolver::Resolver;
use super::typed::{Quantity, ValueContext};
use crate::model::expression::Expr;
use crate::model::mechanism::Unit;
use crate::syntax::ast::{Value, ValueKind};
use crate::syntax::print;

/// The numbers of a list.
pub(super) struct Listed {
    /// In SI units.
    pub(super) numbers: Vec<f64>,
    pub(super) quantity: Quantity,
    /// The declared unit.
    pub(super) unit: Unit,
}

/// The content of a list and its spelling, for messages.
fn words(value_context: ValueContext) -> (&'static str, &'static str) {
    match value_context {
        ValueContext::Points => {
            ("points of a curve", "write `curve stiffness: [1000, 2000, 3000] rpm -> [5, 6, 6.5] MN/m;`")
        }
        _ => (
            "values",
            "write `one of [1.9, 2.0, 2.1] mm`, with `weighted [1, 6, 1]` behind it where not all are as frequent",
        ),
    }
}

impl Resolver<'_> {
    /// Numbers in brackets, without names.
    pub(super) fn listed(&mut self, list: &Value, value_context: ValueContext) -> Option<Listed> {
        let (what, help) = words(value_context);
        let ValueKind::Vector(elements, unit) = &list.bare().kind else {
            let message = format!("the {what} are listed in brackets");
            return self.refuse_with_help(list.extent, message, help);
        };
        let scale = self.optional_unit(unit.as_ref());
        let numbers: Vec<_> = elements.iter().map(|element| self.listed_number(element, value_context)).collect();
        let numbers: Vec<(f64, Quantity)> = numbers.into_iter().collect::<Option<_>>()?;
        let (numbers, quantities): (Vec<f64>, Vec<Quantity>) = numbers.into_iter().unzip();
        let common = self.common_quantity(&quantities, elements, what)?;
        let (quantity, scale) = match scale? {
            None => (common, 1.0),
            Some((dimension, scale)) => {
                let product = common.dimension().times(dimension);
                (self.in_range(product, list.extent)?, scale)
            }
        };
        let unit = match unit {
            Some(unit) if common.dimension().is_none() => Unit { symbol: print::unit(unit), scale },
            None if !elements.is_empty() => self.display_unit(&elements[0], quantity.dimension()),
            _ => Unit::si(quantity.dimension()),
        };
        Some(Listed { numbers: numbers.into_iter().map(|x| x * scale).collect(), quantity, unit })
    }

    fn listed_number(&mut self, element: &Value, value_context: ValueContext) -> Option<(f64, Quantity)> {
        match self.scalar(element, value_context)? {
            (Expr::Number(number), quantity) => Some((number, quantity)),
            // Names are refused, and numbers are combined immediately.
            _ => None,
        }
    }
}
