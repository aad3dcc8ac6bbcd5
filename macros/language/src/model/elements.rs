//! Forces and constraints of a mechanism, in words.

/// Gravity, a drive, a force, a constraint or a curve.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Element {
    /// Declared name.
    pub name: String,
    /// The keyword it is declared with; `drive` for a driven coordinate.
    pub kind: String,
    /// The points or coordinates it acts on, and its law with numbers in SI.
    pub law: String,
}
