//! Parts of a report.

use serde::Serialize;

/// Which sections of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// What a moved value changes at once: those of the operating point, tolerances to first order, and of forced vibration
    /// only the sentences.
    AtPoint,
    /// What takes longer: the judgement of tolerances, forced vibration, and those along an input.
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
