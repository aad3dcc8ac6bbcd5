//! Placements: where a frame is in another, for joints, points and the shapes of a body.

use super::Resolver;
use super::expected::Expected;
use super::typed::Place;
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::Placement;
use crate::syntax::ast;

/// The zero vector.
pub(super) fn zero() -> Vector {
    [0.0; 3].map(Expr::Number)
}

/// The frame itself.
pub(super) fn unplaced() -> Placement {
    Placement {
        offset: zero(),
        rotations: Vec::new(),
    }
}

impl Resolver<'_> {
    /// A placement; without one the frame itself. `what` names what is placed.
    pub(super) fn placement(
        &mut self,
        placement: Option<&ast::Placement>,
        what: &str,
    ) -> Option<Placement> {
        let Some(placement) = placement else {
            return Some(unplaced());
        };
        let offset = match &placement.offset {
            Some(offset) => self.position(offset, what),
            None => Some(zero()),
        };
        let rotations: Vec<Option<(Vector, Expr)>> = placement
            .rotations
            .iter()
            .map(|(axis, angle)| {
                let direction = self.direction(axis, Place::Parameter);
                let turn = self.scalar_of(angle, Expected::angle(), "this");
                if let Some(turn) = &turn {
                    self.require_finite(std::slice::from_ref(turn), "this angle", angle.extent);
                }
                direction.zip(turn)
            })
            .collect();
        Some(Placement {
            offset: offset?,
            rotations: rotations.into_iter().collect::<Option<_>>()?,
        })
    }
}
