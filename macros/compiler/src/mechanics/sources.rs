//! Which causes of force an evaluation of the equations takes into account.

use crate::base::ids::{BodyId, ForceId};

/// Selects causes of force: all for the equations themselves, single ones to find a culprit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Sources {
    pub(super) inertia: Selection<BodyId>,
    pub(super) forces: Selection<ForceId>,
    pub(super) gravity: bool,
    pub(super) constraints: bool,
}

/// All of a kind, one, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Selection<Id> {
    All,
    One(Id),
    None,
}

impl<Id: PartialEq> Selection<Id> {
    pub(super) fn contains(&self, id: Id) -> bool {
        match self {
            Self::All => true,
            Self::One(only) => *only == id,
            Self::None => false,
        }
    }
}

impl Sources {
    /// Everything.
    pub(super) const ALL: Self = Self {
        inertia: Selection::All,
        forces: Selection::All,
        gravity: true,
        constraints: true,
    };
    /// Inertia alone.
    pub(super) const INERTIA: Self = Self {
        inertia: Selection::All,
        forces: Selection::None,
        gravity: false,
        constraints: false,
    };
    /// Everything that is not inertia.
    pub(super) const APPLIED: Self = Self {
        inertia: Selection::None,
        forces: Selection::All,
        gravity: true,
        constraints: true,
    };
}
