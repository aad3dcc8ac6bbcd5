//! Axes.

use serde::Serialize;

/// An axis of numbers, or of categories.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Axis {
    /// The quantity it measures.
    pub name: String,
    /// The unit; empty for pure numbers.
    pub unit: String,
    /// Its ends, in the unit, ascending.
    pub range: [f64; 2],
    /// The categories at 0, 1, 2, ...; empty for an axis of numbers.
    pub categories: Vec<String>,
    /// Whether equal lengths are equal ratios; all values are then positive.
    pub logarithmic: bool,
}

impl Axis {
    /// An axis of numbers whose range is still to be determined.
    #[must_use]
    pub fn new(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { name: name.into(), unit: unit.into(), ..Self::default() }
    }

    /// An axis of categories, with half a category of room at either end.
    #[must_use]
    pub fn of_categories(name: impl Into<String>, categories: Vec<String>) -> Self {
        Self { name: name.into(), range: [-0.5, categories.len() as f64 - 0.5], categories, ..Self::default() }
    }

    /// Name and unit: `speed [rpm]`.
    #[must_use]
    pub fn heading(&self) -> String {
        if self.unit.is_empty() { self.name.clone() } else { format!("{} [{}]", self.name, self.unit) }
    }
}
