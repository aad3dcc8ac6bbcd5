//! Which joint of a loop is cut.

use crate::base::diagnostics::Diagnostics;
use crate::base::ids::JointId;
use crate::model::expression::Expr;
use crate::model::mechanism::{ConstraintLaw, ExcitationLaw, ForceLaw, Mechanism, Motion};

/// The joints, by id, that must not be cut: their coordinates are used elsewhere in the declaration, are driven or
/// coast, or they cannot be written as equations.
pub(super) fn needed(mechanism: &Mechanism) -> Vec<bool> {
    let mut needed = vec![false; mechanism.joints.len()];
    let mut of_coordinate = |id: crate::base::ids::CoordinateId| {
        needed[mechanism.coordinates[id.index()].joint.index()] = true;
    };
    for steady in &mechanism.steady {
        of_coordinate(steady.coordinate);
    }
    let mut values: Vec<&Expr> = mechanism.outputs.iter().map(|output| &output.value).collect();
    for force in mechanism.forces.iter().filter(|force| !force.of_every) {
        match &force.law {
            ForceLaw::CoordinateSpring { coordinate, .. } | ForceLaw::CoordinateDamper { coordinate, .. } => {
                of_coordinate(*coordinate)
            }
            ForceLaw::CoordinateInerter { coordinates, .. } => coordinates.iter().for_each(|id| of_coordinate(*id)),
            ForceLaw::Generalized { coordinate, value } => {
                of_coordinate(*coordinate);
                values.push(value);
            }
            ForceLaw::Potential { energy } => values.push(energy),
            ForceLaw::SpringDamper { .. }
            | ForceLaw::Tension { .. }
            | ForceLaw::Bushing { .. }
            | ForceLaw::Load { .. }
            | ForceLaw::Distributed { .. }
            | ForceLaw::Drag { .. } => {}
        }
    }
    for excitation in &mechanism.excitations {
        if let ExcitationLaw::Generalized { coordinate, .. } = &excitation.law {
            of_coordinate(*coordinate);
        }
    }
    for constraint in &mechanism.constraints {
        if let ConstraintLaw::Equation { zero, .. } = &constraint.law {
            values.push(zero);
        }
    }
    for value in values {
        for leaf in value.leaves() {
            if let Expr::Coordinate(id) | Expr::Rate(id) = leaf {
                of_coordinate(*id);
            }
        }
    }
    for (index, joint) in mechanism.joints.iter().enumerate() {
        let moves_itself = mechanism
            .coordinates
            .iter()
            .any(|coordinate| coordinate.joint.index() == index && coordinate.motion != Motion::Free);
        needed[index] |= moves_itself || joint.closing.is_none();
    }
    needed
}

/// Of the joints of a loop that may be cut, the one that leaves the most freedom and thus the fewest equations; in a
/// tie, the last declared.
pub(super) fn choose(
    mechanism: &Mechanism,
    joints: &[JointId],
    needed: &[bool],
    diagnostics: &mut Diagnostics,
) -> Option<JointId> {
    let mut joints = joints.to_vec();
    joints.sort();
    let freedom = |id: &JointId| mechanism.joints[id.index()].steps.len();
    let chosen = joints.iter().filter(|id| !needed[id.index()]).max_by_key(|id| freedom(id)).copied();
    if chosen.is_none() && joints.is_empty() {
        let message = "a beam hangs on itself: something it carries holds its root";
        diagnostics.error_with_help(&mechanism.name, message, "let the ground, or a body before it, hold the root");
    } else if chosen.is_none() {
        let names: Vec<String> = joints.iter().map(|id| format!("`{}`", mechanism.joints[id.index()].name)).collect();
        let last = joints.last()?;
        diagnostics.error_with_help(
            &mechanism.joints[last.index()].name,
            format!(
                "the joints {} close a loop, and none of them can be cut: each is driven, coasting, a screw, or its coordinate is used",
                names.join(", ")
            ),
            "a cut joint has no coordinates: let forces and outputs use points, or the coordinates of other joints",
        );
    }
    chosen
}
