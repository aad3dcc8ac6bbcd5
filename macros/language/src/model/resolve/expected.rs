//! The quantity expected at a place in a declaration, in the words of that place: a stiffness about an axis is a moment
//! by dimension, but nobody calls it one.

use super::bare::bare_number;
use super::typed::Quantity;
use crate::base::dimension::Dimension;
use crate::syntax::ast::Value;

/// A dimension with the words for it.
#[derive(Clone, Debug)]
pub(super) struct Expected {
    pub(super) dimension: Dimension,
    /// The name, with an article.
    pub(super) name: String,
    pub(super) unit: String,
}

impl Expected {
    pub(super) fn angle() -> Self {
        Self::named(Dimension::NONE, "an angle", "rad")
    }

    /// Whether it is an angle in radians.
    pub(super) fn is_angle(&self) -> bool {
        self.dimension.is_none() && self.unit == "rad"
    }

    pub(super) fn rotary_stiffness() -> Self {
        Self::named(Dimension::MOMENT, "a rotary stiffness", "N*m/rad")
    }

    pub(super) fn rotary_damping() -> Self {
        Self::named(Dimension::ROTARY_DAMPING, "a rotary damping", "N*m*s/rad")
    }

    pub(super) fn moment() -> Self {
        Self::named(Dimension::MOMENT, "a moment", "N*m")
    }

    pub(super) fn energy() -> Self {
        Self::named(Dimension::MOMENT, "an energy", "J")
    }

    pub(super) fn force_per_length() -> Self {
        Self::named(Dimension::STIFFNESS, "a force per length", "N/m")
    }

    pub(super) fn ratio() -> Self {
        Self::named(Dimension::NONE, "a plain number", "1")
    }

    pub(super) fn travel_per_angle() -> Self {
        Self::named(Dimension::LENGTH, "a travel per angle", "m/rad")
    }

    pub(super) fn angle_per_travel() -> Self {
        let per_length = Dimension::new(-1, 0, 0);
        Self::named(per_length, "an angle per travel", "rad/m")
    }

    /// A quantity in its declared unit.
    pub(super) fn in_unit(dimension: Dimension, unit: &str) -> Self {
        match unit {
            "" | "1" => Self::ratio(),
            _ if dimension.is_none() => Self::named(dimension, "an angle", unit),
            _ => Self::named(dimension, &dimension.name(), unit),
        }
    }

    /// Whether a quantity fits. A number without a unit does not fit where degrees are declared: it would count as
    /// radians.
    pub(super) fn admits(&self, quantity: Quantity, value: &Value) -> bool {
        let is_number = matches!(self.unit.as_str(), "" | "1" | "rad");
        quantity.fits(self.dimension) && (is_number || quantity == Quantity::Zero || bare_number(value).is_none())
    }

    fn named(dimension: Dimension, name: &str, unit: &str) -> Self {
        Self { dimension, name: name.to_string(), unit: unit.to_string() }
    }

    /// The message for a number without a unit where this is expected.
    pub(super) fn needs_unit(&self, written: &str) -> String {
        let Self { name, unit, .. } = self;
        format!("`{written}` has no unit; {name} is expected, for example `{written} {unit}`")
    }

    /// The name and the unit: `a length (m)`.
    pub(super) fn describe(&self) -> String {
        match self.unit.as_str() {
            "" | "1" => self.name.clone(),
            unit => format!("{} ({unit})", self.name),
        }
    }
}

impl From<Dimension> for Expected {
    fn from(dimension: Dimension) -> Self {
        Self::named(dimension, &dimension.name(), &dimension.si_symbol())
    }
}

impl From<Dimension> for Option<Expected> {
    fn from(dimension: Dimension) -> Self {
        Some(dimension.into())
    }
}
