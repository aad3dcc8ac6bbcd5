//! Numbers without a unit.

use crate::syntax::ast::{Value, ValueKind};

/// The text of a number without a unit, or of a vector of such numbers.
pub(super) fn bare_number(value: &Value) -> Option<String> {
    match &value.bare().kind {
        ValueKind::Number(number, None) => Some(format!("{number}")),
        ValueKind::Negate(operand) => bare_number(operand).map(|text| format!("-{text}")),
        ValueKind::Vector(components, None) => {
            let texts: Option<Vec<String>> = components.iter().map(bare_number).collect();
            Some(format!("[{}]", texts?.join(", ")))
        }
        _ => None,
    }
}
