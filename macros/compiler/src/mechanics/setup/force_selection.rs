//! The causes of force that an evaluation of the equations includes.

use crate::base::ids::{BodyId, ForceId};

/// Selects causes of force: all of them for the equations themselves, a single one to find the cause of an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ForceSelection {
    pub(crate) inertia: Selection<BodyId>,
    pub(crate) forces: Selection<ForceId>,
    pub(crate) gravity: bool,
    pub(crate) constraints: bool,
}

/// All members of a kind, one, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Selection<Id> {
    All,
    One(Id),
    None,
}

impl<Id: PartialEq> Selection<Id> {
    pub(crate) fn contains(&self, id: Id) -> bool {
        match self {
            Self::All => true,
            Self::One(only) => *only == id,
            Self::None => false,
        }
    }
}

impl ForceSelection {
    /// All causes.
    pub(crate) const ALL: Self =
        Self { inertia: Selection::All, forces: Selection::All, gravity: true, constraints: true };
    /// Inertia alone.
    pub(crate) const INERTIA: Self =
        Self { inertia: Selection::All, forces: Selection::None, gravity: false, constraints: false };
    /// Everything except inertia.
    pub(crate) const APPLIED: Self =
        Self { inertia: Selection::None, forces: Selection::All, gravity: true, constraints: true };
}
