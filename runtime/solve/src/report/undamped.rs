//! What results based on undamped modes neglect.

use core::fmt;

use crate::modes::Family;
use crate::{DampingKind, Description};

/// States what results based on undamped modes neglect.
pub fn undamped(
    f: &mut fmt::Formatter<'_>,
    family: Family,
    description: &Description,
) -> fmt::Result {
    let what = match (family, description.damping) {
        (Family::General, _) | (_, DampingKind::Zero) => return Ok(()),
        (Family::Undamped, DampingKind::Gyroscopic) => "Gyroscopic forces (Chat)",
        (Family::Undamped, DampingKind::General) => "Damping and gyroscopic forces (Chat)",
    };
    writeln!(f, "  {what} of this mechanism are ignored: undamped modes.")
}
