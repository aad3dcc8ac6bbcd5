//! Units as written to dimension and scale, and the names that a unit has swallowed.

use super::Resolver;
use crate::base::dimension::Dimension;
use crate::base::nearest::nearest;
use crate::base::units;
use crate::syntax::ast::{Unit, Value, ValueKind};
use crate::syntax::print;

impl Resolver<'_> {
    /// Dimension and SI value of a unit.
    pub(super) fn unit(&mut self, unit: &Unit) -> Option<(Dimension, f64)> {
        let mut result = Some((Dimension::NONE, 1.0));
        for factor in &unit.factors {
            let Some(named) = units::find(&factor.name) else {
                let name = &factor.name;
                let help = if self.scope.find(name).is_some() {
                    Some(format!(
                        "a word after a number is a unit; for the declared `{name}` write `*` between them"
                    ))
                } else {
                    nearest(name, units::names()).map(|near| format!("did you mean `{near}`?"))
                };
                self.report(factor.extent, format!("unknown unit `{name}`"), help);
                result = None;
                continue;
            };
            result = result.and_then(|(dimension, scale)| {
                let dimension = dimension.times(named.dimension.power(factor.exponent, 1)?)?;
                let power = named.scale.powi(factor.exponent.abs());
                let scale = if factor.exponent < 0 {
                    scale / power
                } else {
                    scale * power
                };
                Some((dimension, scale))
            });
        }
        let (dimension, scale) = result?;
        if !scale.is_finite() || scale == 0.0 {
            let message = "this unit is outside the range of a 64-bit number";
            self.diagnostics.error(unit.extent, message);
            return None;
        }
        Some((dimension, scale))
    }

    /// In `3 kg * m` the `m` is the metre even when a design variable is called `m`; a wrong dimension may come
    /// from that.
    pub(super) fn swallowed(&self, values: &[&Value]) -> Option<String> {
        values.iter().find_map(|value| self.swallowed_in(value))
    }

    fn swallowed_in(&self, value: &Value) -> Option<String> {
        match &value.kind {
            ValueKind::Number(number, Some(unit)) => {
                let (first, others) = unit.factors.split_first()?;
                let name = others
                    .iter()
                    .map(|factor| &factor.name)
                    .find(|name| self.scope.find(name).is_some())?;
                let first = print::unit(&Unit {
                    factors: vec![first.clone()],
                    extent: unit.extent,
                });
                Some(format!(
                    "`{name}` after a number is read as a unit; for the declared `{name}` write `{name} * {number} {first}` or `({number} {first}) * {name}`"
                ))
            }
            ValueKind::Number(_, None) | ValueKind::Name(_) => None,
            ValueKind::Vector(values, _) | ValueKind::Call(_, values) => {
                values.iter().find_map(|value| self.swallowed_in(value))
            }
            ValueKind::Negate(of) | ValueKind::Component(of, _) => self.swallowed_in(of),
            ValueKind::Parenthesised(of) => self.swallowed_in(of),
            ValueKind::Binary(binary) => self
                .swallowed_in(&binary.left)
                .or_else(|| self.swallowed_in(&binary.right)),
        }
    }
}
