//! Names of bodies, points, joints and coordinates; for a wrong name, the nearest name of the right kind is suggested.

use proc_macro2::Ident;

use super::coordinates;
use super::joints::kinds::Kind;
use super::resolver::Resolver;
use super::scope::Meaning;
use crate::base::ids::{CoordinateId, JointId, PointId};
use crate::base::names::LINK;
use crate::model::mechanism::{CoordinateQuantity, Frame};

impl Resolver<'_> {
    /// A body, or the ground.
    pub(super) fn frame(&mut self, name: &Ident) -> Option<Frame> {
        let text = name.to_string();
        if text == "ground" {
            return Some(Frame::Ground);
        }
        // The port of a part is the point at the origin of a frame.
        if text.contains(LINK)
            && let Some(port) = self.declared_point(name).filter(|point| point.placement.is_none())
        {
            return self.frame(&port.frame);
        }
        match self.scope.find_or_unclear(&text) {
            Some(Meaning::Body(id)) => Some(Frame::Body(id)),
            other => {
                let is_body = |meaning| matches!(meaning, Meaning::Body(_));
                self.wrong_reference(name, "body", other, is_body);
                None
            }
        }
    }

    /// A declared point.
    pub(super) fn point_named(&mut self, name: &Ident) -> Option<PointId> {
        match self.scope.find_or_unclear(&name.to_string()) {
            Some(Meaning::Point(id)) => Some(id),
            other => {
                let is_point = |meaning| matches!(meaning, Meaning::Point(_));
                self.wrong_reference(name, "point", other, is_point);
                None
            }
        }
    }

    /// A joint; `kind` is the expected kind, for messages.
    pub(super) fn joint_named(&mut self, name: &Ident, kind: &str) -> Option<JointId> {
        match self.scope.find_or_unclear(&name.to_string()) {
            Some(Meaning::Joint(id)) => Some(id),
            Some(Meaning::OnlyCoordinate(id)) => Some(self.coordinates.get(id.index())?.joint),
            other => {
                let is_right = |meaning| {
                    matches!(meaning, Meaning::Joint(_) | Meaning::OnlyCoordinate(_) | Meaning::Constraint(_))
                };
                self.wrong_reference(name, kind, other, is_right);
                None
            }
        }
    }

    /// A coordinate, by its own name or by that of a joint with a single coordinate.
    pub(super) fn coordinate(&mut self, name: &Ident) -> Option<(CoordinateId, CoordinateQuantity)> {
        match self.scope.find_or_unclear(&name.to_string()) {
            Some(Meaning::OnlyCoordinate(id) | Meaning::Coordinate(id)) => {
                let declared = self.coordinates.get(id.index())?;
                let quantity = declared.quantity?;
                if declared.cut {
                    let joint = declared.joint;
                    self.coordinate_of_cut_joint(name, joint);
                    return None;
                }
                Some((id, quantity))
            }
            Some(Meaning::Joint(id)) => {
                self.no_coordinate_of_its_name(name, id);
                None
            }
            meaning => {
                self.wrong_reference(name, "coordinate", meaning, Meaning::is_coordinate);
                None
            }
        }
    }

    /// Reports a coordinate of a cut joint: its motions are equations, so there is nothing to refer to.
    fn coordinate_of_cut_joint(&mut self, name: &Ident, id: JointId) {
        let Some(joint) = coordinates::joints(self.ast).nth(id.index()) else {
            return;
        };
        let message = if joint.name == *name {
            format!("`{name}` is cut, so it has no coordinate")
        } else {
            format!("`{name}` belongs to the cut joint `{}`, which has no coordinates", joint.name)
        };
        let help = "cut another joint of the loop, or leave out `cut`: then one that nothing refers to is chosen";
        self.diagnostics.error_with_help(name, message, help);
    }

    /// Reports a joint that is fixed or has several coordinates; for an unknown kind of joint nothing more can be said.
    fn no_coordinate_of_its_name(&mut self, name: &Ident, id: JointId) {
        let joint = coordinates::joints(self.ast).nth(id.index());
        let Some(kind) = joint.and_then(|joint| Kind::find(&joint.kind.to_string())) else {
            return;
        };
        if kind.motions.is_empty() {
            let message = format!("`{name}` is a {} joint and has no coordinate", kind.word);
            self.diagnostics.error(name, message);
            return;
        }
        let coordinates = self.coordinates.iter().filter(|other| other.joint == id);
        let names: Vec<String> = coordinates.map(|other| format!("`{}`", other.name)).collect();
        if !names.is_empty() {
            let message = format!("`{name}` is a {} joint with several coordinates", kind.word);
            let help = format!("name one of them: {}", names.join(", "));
            self.diagnostics.error_with_help(name, message, help);
        }
    }

    pub(super) fn wrong_reference(
        &mut self,
        name: &Ident,
        kind: &str,
        found: Option<Meaning>,
        right: impl Fn(Meaning) -> bool,
    ) {
        if found == Some(Meaning::Unclear) {
            return;
        }
        if let Some(meaning) = found {
            let is = meaning.describe();
            let message = format!("`{name}` is {is}; a {kind} is expected here");
            let help = match meaning {
                Meaning::Body(_) if kind == "point" => {
                    Some(format!("declare a point of the body: `point p: {name} at [0, 0, 0];`"))
                }
                Meaning::Coordinate(id) if kind.starts_with("joint") => self
                    .coordinates
                    .get(id.index())
                    .and_then(|coordinate| coordinates::joints(self.ast).nth(coordinate.joint.index()))
                    .map(|joint| format!("its joint is `{}`", joint.name)),
                _ => None,
            };
            self.report(name, message, help);
            return;
        }
        let text = name.to_string();
        if text == "ground" {
            let help = (kind == "point").then(|| "declare a point of it: `point p: ground;`".into());
            self.report(name, format!("`ground` is a frame; a {kind} is expected here"), help);
            return;
        }
        let near = self.scope.nearest(&text, right).map(str::to_string);
        let near = near.or_else(|| {
            (kind == "body").then(|| crate::base::nearest::nearest(&text, ["ground"]))?.map(str::to_string)
        });
        let help = near.map(|near| format!("did you mean `{near}`?"));
        self.report(name, format!("unknown {kind} `{text}`"), help);
    }
}
