//! Declared units.

/// A unit as declared: a value in SI is the value in this unit times `scale`.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    /// As declared, without spaces.
    pub symbol: String,
    /// SI value of one unit.
    pub scale: f64,
}
