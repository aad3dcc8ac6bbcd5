//! Declared units.

use crate::base::dimension::Dimension;

/// A unit as declared: a value in SI is the value in this unit times `scale`.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    /// As declared, without spaces; empty for a plain number.
    pub symbol: String,
    /// SI value of one unit.
    pub scale: f64,
}

impl Unit {
    /// A unit whose SI value is one.
    pub fn one(symbol: &str) -> Self {
        Self { symbol: symbol.to_string(), scale: 1.0 }
    }

    /// The SI unit of a dimension.
    pub fn si(dimension: Dimension) -> Self {
        if dimension.is_none() { Self::one("") } else { Self::one(&dimension.si_symbol()) }
    }
}
