//! How many modes the coordinates of beams resolve.

use super::functions::{Functions, Role, Unknown};
use crate::model::beam::Beam;
use crate::model::mechanism::Mechanism;

/// How many of its first modes the coordinates resolve by the rule for beams, if there are any: those of the beams, and one
/// for each other coordinate that no constraint takes away.
pub fn resolved_modes(mechanism: &Mechanism, functions: &Functions) -> Option<usize> {
    let beams = &mechanism.beams;
    let moves = |unknown: &&Unknown| matches!(unknown.role, Role::Position(_) | Role::Speed(_));
    let moving = functions.unknowns.iter().filter(moves).count();
    let reactions = functions.unknowns.len() - moving;
    let of_beams: usize = beams.iter().map(Beam::size).sum();
    let resolved: usize = beams.iter().map(Beam::resolved_modes).sum();
    let others = moving.saturating_sub(of_beams + reactions);
    (!beams.is_empty()).then_some(others + resolved)
}
