//! What acts on a mechanism or binds it, in words.

/// Gravity, a drive, a force, a constraint or a curve.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Element {
    /// Declared name.
    pub name: String,
    /// The word it is declared with; `drive` of a driven coordinate.
    pub kind: String,
    /// What it acts on and its law, with numbers in SI.
    pub law: String,
}
