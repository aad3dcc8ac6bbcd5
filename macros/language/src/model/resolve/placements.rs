//! Placements of one frame in another, for joints, points and the shapes of a body.

use proc_macro2::Ident;

use super::directions::axis;
use super::expected::Expected;
use super::resolver::Resolver;
use super::typed::ValueContext;
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::{Frame, Placement};
use crate::syntax::ast::{self, ValueKind};
use crate::syntax::print;

/// The zero vector.
pub(super) fn zero() -> Vector {
    [0.0; 3].map(Expr::Number)
}

/// The identity placement.
pub(super) fn unplaced() -> Placement {
    Placement { offset: zero(), rotations: Vec::new() }
}

impl Resolver<'_> {
    /// A frame and a place on it, which may be a station of a beam.
    pub(super) fn placed_frame(
        &mut self,
        frame: &Ident,
        placement: Option<&ast::Placement>,
    ) -> (Option<Frame>, Option<Placement>) {
        let what = "a point's place";
        let offset = placement.and_then(|placement| Some((placement, placement.offset.as_ref()?)));
        if let Some((placement, offset)) = offset
            && let Some(station) = self.station(frame, offset)
        {
            let turned = ast::Placement { offset: None, ..placement.clone() };
            return (station, self.placement(Some(&turned), what));
        }
        (self.frame(frame), self.placement(placement, what))
    }

    /// A placement; the identity if none is given. `what` names the thing being placed.
    pub(super) fn placement(&mut self, placement: Option<&ast::Placement>, what: &str) -> Option<Placement> {
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
                if is_direction(angle) && !is_direction(axis) {
                    let (axis, angle) = (print::value(angle), print::value(axis));
                    return self.refuse_with_help(
                        placement.keyword,
                        "`rotated` takes the direction first, then the angle",
                        format!("write `rotated({axis}, {angle})`"),
                    );
                }
                let direction = self.direction(axis, ValueContext::Parameter);
                let turn = self.scalar_of(angle, Expected::angle(), "this");
                if let Some(turn) = &turn {
                    self.require_finite(std::slice::from_ref(turn), "this angle", angle.extent);
                }
                direction.zip(turn)
            })
            .collect();
        Some(Placement { offset: offset?, rotations: rotations.into_iter().collect::<Option<_>>()? })
    }
}

/// Whether the value is written as an axis or as a vector.
fn is_direction(value: &ast::Value) -> bool {
    axis(value).is_some() || matches!(value.bare().kind, ValueKind::Vector(..))
}
