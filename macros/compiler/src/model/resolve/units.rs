//! Units as written to dimension and scale, and the names that a unit has swallowed.

use super::resolver::Resolver;
use super::scope::Meaning;
use super::typed::Typed;
use crate::base::dimension::Dimension;
use crate::base::units;
use crate::syntax::ast::{Unit, UnitFactor, Value, ValueKind};
use crate::syntax::print;

impl Resolver<'_> {
    /// Dimension and SI value of a unit.
    pub(super) fn unit(&mut self, unit: &Unit) -> Option<(Dimension, f64)> {
        let mut known = true;
        let mut product = Some((Dimension::NONE, 1.0));
        for factor in &unit.factors {
            let Some(named) = units::find(&factor.name) else {
                let name = &factor.name;
                let help = if self.scope.find(name).is_some() {
                    Some(format!(
                        "a word after a number is a unit; to multiply by the declared `{name}` write `*`"
                    ))
                } else {
                    units::suggestion(name).map(|near| format!("did you mean `{near}`?"))
                };
                self.report(factor.extent, format!("unknown unit `{name}`"), help);
                known = false;
                continue;
            };
            product = product.and_then(|(dimension, scale)| {
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
        let usable = product.filter(|(_, scale)| scale.is_normal());
        if known && usable.is_none() {
            let message = "this unit is outside the range of a 64-bit number";
            self.diagnostics.error(unit.extent, message);
        }
        usable.filter(|_| known)
    }

    /// In `3 kg * m` the `m` is the metre even when a design variable is called `m`. Help, when reading the name as
    /// declared would turn the dimension found into the one expected.
    pub(super) fn swallowed(
        &self,
        value: &Value,
        found: Dimension,
        expected: Dimension,
    ) -> Option<String> {
        let search = |value: &Value| self.swallowed(value, found, expected);
        match &value.kind {
            ValueKind::Number(number, Some(unit)) => {
                let (first, others) = unit.factors.split_first()?;
                let meant = |factor: &&UnitFactor| {
                    let declared = self.declared_dimension(&factor.name)?;
                    let read = units::find(&factor.name)?.dimension;
                    let change = declared.over(read)?.power(factor.exponent, 1)?;
                    (found.times(change)? == expected).then_some(())
                };
                let name = &others.iter().find(|factor| meant(factor).is_some())?.name;
                let first = print::unit(&Unit {
                    factors: vec![first.clone()],
                    extent: unit.extent,
                });
                Some(format!(
                    "`{name}` after a number is read as a unit; for the declared `{name}` write `({number} {first}) * {name}`"
                ))
            }
            ValueKind::Number(_, None) | ValueKind::Name(_) => None,
            ValueKind::Vector(values, _) | ValueKind::Call(_, values) => {
                values.iter().find_map(search)
            }
            ValueKind::Negate(of) | ValueKind::Component(of, _) => search(of),
            ValueKind::Parenthesised(of) => search(of),
            ValueKind::Binary(binary) => search(&binary.left).or_else(|| search(&binary.right)),
        }
    }

    /// The dimension of a declared number.
    fn declared_dimension(&self, name: &str) -> Option<Dimension> {
        match self.scope.find(name)? {
            Meaning::Input(id) => *self.inputs.get(id.index())?,
            Meaning::Design(id) => Some(self.design.get(id.index())?.as_ref()?.dimension),
            Meaning::Let(index) => match self.lets.get(index)?.as_ref()? {
                Typed::Scalar(_, quantity) => Some(quantity.dimension()),
                Typed::Vector(..) | Typed::Matrix(..) => None,
            },
            _ => None,
        }
    }
}
