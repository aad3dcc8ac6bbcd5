//! What results based on undamped modes neglect.

use eigentol_results::Findings;

use super::Family;
use crate::{DampingKind, Description};

/// States what results based on undamped modes neglect.
pub fn undamped(said: &mut Findings, family: Family, description: &Description) {
    let what = match (family, description.damping) {
        (Family::General, _) | (_, DampingKind::Zero) => return,
        (Family::Undamped, DampingKind::Gyroscopic) => "Gyroscopic forces (Chat)",
        (Family::Undamped, DampingKind::General) => "Damping and gyroscopic forces (Chat)",
    };
    said.note(format!("{what} of this mechanism are ignored: undamped modes."));
}
