//! Drives: which coordinates of a joint are free, and at what speed the others move.

use super::super::typed::Place;
use super::super::{Resolver, coordinates};
use super::kinds::Kind;
use crate::base::ids::{CoordinateId, JointId};
use crate::base::nearest::nearest;
use crate::model::mechanism::Motion;
use crate::syntax::ast::{Drive, Joint, JointClause};

impl Resolver<'_> {
    /// Every coordinate of the joint free, or driven at its one declared speed.
    pub(super) fn drives(
        &mut self,
        joint: &Joint,
        id: JointId,
        kind: Option<&'static Kind>,
    ) -> Option<Vec<Motion>> {
        let coordinates = self.coordinates_of(id);
        let mut motions = vec![Motion::Free; coordinates.len()];
        let mut driven = vec![false; coordinates.len()];
        let mut right = Some(());
        for clause in &joint.clauses {
            let JointClause::Drive(drive) = clause else {
                continue;
            };
            let place = kind.and_then(|kind| self.driven_place(joint, kind, drive, &coordinates));
            let Some(place) = place else {
                // Its value may be wrong as well.
                self.scalar(&drive.speed, Place::Parameter);
                right = None;
                continue;
            };
            if std::mem::replace(&mut driven[place], true) {
                let message = match &drive.coordinate {
                    Some(name) => format!("`{name}` is driven twice"),
                    None => "this joint is driven twice".to_string(),
                };
                self.diagnostics.error(drive.keyword, message);
                right = None;
                continue;
            }
            match self.motion(drive, coordinates[place]) {
                Some(motion) => motions[place] = motion,
                None => right = None,
            }
        }
        right.map(|()| motions)
    }

    /// The place in the joint of the coordinate that a clause drives.
    fn driven_place(
        &mut self,
        joint: &Joint,
        kind: &Kind,
        drive: &Drive,
        coordinates: &[CoordinateId],
    ) -> Option<usize> {
        if kind.motions.is_empty() {
            let message = "a fixed joint cannot be driven";
            self.diagnostics.error(drive.keyword, message);
            return None;
        }
        let names: Vec<String> = coordinates
            .iter()
            .filter_map(|id| self.coordinates.get(id.index()))
            .map(|coordinate| coordinate.name.to_string())
            .collect();
        let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
        let Some(name) = &drive.coordinate else {
            if names.len() == 1 {
                return Some(0);
            }
            // Without coordinates the axes are wrong, and that has been reported.
            if let Some(first) = names.first() {
                self.diagnostics.error_with_help(
                    drive.keyword,
                    format!("`{}` has the coordinates {}", joint.name, quoted.join(", ")),
                    format!("say which one is driven: `{first} driven at ...`"),
                );
            }
            return None;
        };
        let text = name.to_string();
        let place = names.iter().position(|other| *other == text);
        if place.is_none() && !names.is_empty() {
            let message = format!("`{text}` is no coordinate of this joint");
            let help = match nearest(&text, names.iter().map(String::as_str)) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("it has {}", quoted.join(", ")),
            };
            self.diagnostics.error_with_help(name, message, help);
        }
        place
    }

    fn motion(&mut self, drive: &Drive, coordinate: CoordinateId) -> Option<Motion> {
        let quantity = self.coordinates.get(coordinate.index())?.quantity?;
        let dimension = coordinates::rate_dimension(quantity);
        let what = "the speed of this drive";
        let speed = self.scalar_of(&drive.speed, dimension, what)?;
        self.require_finite(std::slice::from_ref(&speed), what, drive.speed.extent);
        Some(Motion::Driven(speed))
    }
}
