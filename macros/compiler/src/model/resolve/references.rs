//! Names that stand for bodies, points and joints, each with the nearest name of the right kind when wrong.

use proc_macro2::Ident;

use super::scope::Meaning;
use super::{JointCoordinate, Resolver};
use crate::base::ids::{CoordinateId, JointId, PointId};
use crate::model::mechanism::{CoordinateQuantity, Frame};

impl Resolver<'_> {
    /// A body or the ground.
    pub(super) fn frame(&mut self, name: &Ident) -> Option<Frame> {
        let text = name.to_string();
        if text == "ground" {
            return Some(Frame::Ground);
        }
        match self.scope.find(&text) {
            Some(Meaning::Body(id)) => Some(Frame::Body(id)),
            found => {
                let is_body = |meaning| matches!(meaning, Meaning::Body(_));
                self.wrong_reference(name, "body", found, is_body);
                None
            }
        }
    }

    /// A declared point.
    pub(super) fn point_named(&mut self, name: &Ident) -> Option<PointId> {
        match self.scope.find(&name.to_string()) {
            Some(Meaning::Point(id)) => Some(id),
            found => {
                let is_point = |meaning| matches!(meaning, Meaning::Point(_));
                self.wrong_reference(name, "point", found, is_point);
                None
            }
        }
    }

    /// The coordinate of a joint.
    pub(super) fn coordinate(
        &mut self,
        name: &Ident,
    ) -> Option<(CoordinateId, CoordinateQuantity)> {
        match self.scope.find(&name.to_string()) {
            Some(Meaning::Joint(id)) => self.coordinate_of(id, name),
            found => {
                let is_joint = |meaning| matches!(meaning, Meaning::Joint(_));
                self.wrong_reference(name, "coordinate", found, is_joint);
                None
            }
        }
    }

    fn coordinate_of(
        &mut self,
        joint: JointId,
        name: &Ident,
    ) -> Option<(CoordinateId, CoordinateQuantity)> {
        match self.joint_coordinates.get(joint.index())? {
            JointCoordinate::One(id, quantity) => Some((*id, *quantity)),
            JointCoordinate::Unknown => None,
            JointCoordinate::None => {
                let message = format!("`{name}` is a fixed joint and has no coordinate");
                self.diagnostics.error(name, message);
                None
            }
        }
    }

    fn wrong_reference(
        &mut self,
        name: &Ident,
        kind: &str,
        found: Option<Meaning>,
        right: impl Fn(Meaning) -> bool,
    ) {
        if let Some(meaning) = found {
            let is = meaning.describe();
            let message = format!("`{name}` is {is}; a {kind} is expected here");
            let help = match meaning {
                Meaning::Body(_) if kind == "point" => Some(format!(
                    "declare a point of the body: `point p: {name} at [0, 0, 0];`"
                )),
                _ => None,
            };
            self.report(name, message, help);
            return;
        }
        let text = name.to_string();
        let near = self.scope.nearest(&text, right).map(str::to_string);
        let near = near.or_else(|| {
            (kind == "body")
                .then(|| crate::base::nearest::nearest(&text, ["ground"]))?
                .map(str::to_string)
        });
        let help = near.map(|near| format!("did you mean `{near}`?"));
        self.report(name, format!("unknown {kind} `{text}`"), help);
    }
}
