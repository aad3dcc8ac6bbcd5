//! The constraint equations: the source of each, and the name of its multiplier.

use proc_macro2::Ident;

use crate::base::ids::{ConstraintId, JointId};
use crate::model::mechanism::{ConstraintLaw, Mechanism};

/// The source of an equation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Source {
    Constraint(ConstraintId),
    /// A joint that closes a loop.
    Joint(JointId),
}

impl Source {
    pub(crate) fn name(self, mechanism: &Mechanism) -> &Ident {
        match self {
            Source::Constraint(id) => &mechanism.constraints[id.index()].name,
            Source::Joint(id) => &mechanism.joints[id.index()].name,
        }
    }

    /// Whether it is a contact without slip.
    pub(crate) fn rolls(self, mechanism: &Mechanism) -> bool {
        let law = |id: ConstraintId| &mechanism.constraints[id.index()].law;
        matches!(self, Source::Constraint(id) if matches!(law(id), ConstraintLaw::Rolling { .. }))
    }
}

/// One equation of a constraint.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) source: Source,
    /// Index of the equation within its source.
    pub(crate) component: usize,
    /// The name of its source, with the component if there are several.
    pub(crate) label: String,
    /// Unit of its multiplier.
    pub(crate) unit: String,
    /// Whether it constrains velocities instead of positions.
    pub(crate) of_velocities: bool,
}
