//! From written units to dimension and scale; also handles names that a unit has absorbed.

use proc_macro2::Ident;

use super::coordinates;
use super::resolver::Resolver;
use super::scope::Meaning;
use super::typed::{Typed, ValueContext};
use crate::base::dimension::Dimension;
use crate::base::units;
use crate::syntax::ast::{ItemKind, Unit, UnitFactor, Value};
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
                    Some(format!("a word after a number is a unit; to multiply by the declared `{name}` write `*`"))
                } else {
                    let respelt = units::respelt(name).map(|text| format!("write `{text}`"));
                    units::per_cent(name)
                        .or(respelt)
                        .or_else(|| units::suggestion(name).map(|near| format!("did you mean `{near}`?")))
                };
                self.report(factor.extent, format!("unknown unit `{name}`"), help);
                known = false;
                continue;
            };
            product = product.and_then(|(dimension, scale)| {
                let dimension = dimension.times(named.dimension.power(factor.exponent, 1)?)?;
                let power = named.scale.powi(factor.exponent.abs());
                let scale = if factor.exponent < 0 { scale / power } else { scale * power };
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

    /// In `3 kg * m` the `m` is the metre even if a design variable is called `m`. Returns help if reading the name as
    /// declared would turn the found dimension into the expected one, also inside a `let` that is used here.
    pub(super) fn swallowed(&self, value: &Value, dimension: Dimension, expected: Dimension) -> Option<String> {
        let meant = |unit: &Unit, index: usize| {
            let factor = &unit.factors[index];
            let declared = self.declared_dimension(&factor.name)?;
            let read = units::find(&factor.name)?.dimension;
            let change = declared.over(read)?.power(factor.exponent, 1)?;
            (dimension.times(change)? == expected).then_some(())
        };
        let help = |value: &Value| {
            value.units().into_iter().find_map(|(number, unit)| {
                let mut others = 1..unit.factors.len();
                let index = others.find(|&index| meant(unit, index).is_some())?;
                let name = &unit.factors[index].name;
                let apart = apart(number, unit, index);
                Some(format!("`{name}` after a number is read as a unit; for the declared `{name}` write `{apart}`"))
            })
        };
        let in_let = |name: &Ident| {
            let mut items = self.ast.items.iter();
            let value = items.find_map(|item| match &item.kind {
                ItemKind::Let(named) if named.name == *name => Some(&named.value),
                _ => None,
            })?;
            Some(format!("in `{name}` {}", help(value)?))
        };
        help(value).or_else(|| value.names().into_iter().find_map(in_let))
    }

    /// Records a unit in which declared names could have been meant.
    pub(super) fn may_be_unclear(&mut self, number: Option<f64>, unit: &Unit, value_context: ValueContext) {
        if value_context.knows_names() && unit.factors.len() > 1 {
            self.units.push((number, unit.clone(), value_context));
        }
    }

    /// Rejects a name after a number that is both a unit and a declared number if the dimension cannot distinguish
    /// them.
    pub(super) fn refuse_unclear_units(&mut self) {
        for (number, unit, context) in std::mem::take(&mut self.units) {
            for index in 1..unit.factors.len() {
                let UnitFactor { name, extent, .. } = &unit.factors[index];
                let is_coordinate = self.scope.find(name).is_some_and(Meaning::is_coordinate);
                if is_coordinate && !context.knows_places() {
                    continue;
                }
                let declared = self.declared_dimension(name);
                let (Some(read), Some(declared)) = (units::find(name), declared) else {
                    continue;
                };
                let reason = if declared == read.dimension {
                    "has the dimension of the declared one"
                } else if context == ValueContext::Output {
                    "would make an output of another dimension"
                } else {
                    continue;
                };
                let message = format!("`{name}` is declared, and the unit `{name}` {reason}");
                let help = format!(
                    "for the declared one write `{}`; if the unit is meant, give the declared one another name",
                    apart(number, &unit, index)
                );
                self.diagnostics.error_with_help(*extent, message, help);
            }
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
            Meaning::OnlyCoordinate(id) | Meaning::Coordinate(id) => {
                let quantity = self.coordinates.get(id.index())?.quantity?;
                Some(coordinates::dimension(quantity))
            }
            _ => None,
        }
    }
}

/// The value written so that its unit ends before one of its factors, which is the name of something declared.
fn apart(number: Option<f64>, unit: &Unit, index: usize) -> String {
    let part = |factors: &[UnitFactor]| print::unit(&Unit { factors: factors.to_vec(), extent: unit.extent });
    let number = number.map_or_else(|| "[...]".to_string(), |number| number.to_string());
    let mut text = format!("({number} {})", part(&unit.factors[..index]));
    for (k, factor) in unit.factors.iter().enumerate().skip(index) {
        let sign = if factor.exponent < 0 { '/' } else { '*' };
        let above = UnitFactor { exponent: factor.exponent.abs(), ..factor.clone() };
        let symbol = part(&[above]);
        text += &if k == index { format!(" {sign} {symbol}") } else { format!(" {sign} (1 {symbol})") };
    }
    text
}
