//! Parts of a report.

use serde::Serialize;

/// Which sections of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// Those of the operating point: of forced vibration only the sentences.
    AtPoint,
    /// Those along an input, and forced vibration.
    Along,
    /// All, with samples and branches.
    All,
}

/// A section of a report, written.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Section {
    /// Its anchor.
    pub id: &'static str,
    /// Its heading.
    pub heading: &'static str,
    /// Its content.
    pub html: String,
}
