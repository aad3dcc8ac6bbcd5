//! Joints: their frames, and the relative motion of their sides.

mod axes;
mod cut;
mod drives;
pub(super) mod kinds;

use proc_macro2::Ident;

use self::kinds::{Kind, SYNONYMS};
use super::coordinates;
use super::placements::unplaced;
use super::resolver::Resolver;
use crate::base::ids::{CoordinateId, JointId};
use crate::base::nearest::suggestion;
use crate::model::mechanism::{Coordinate, Frame, Joint, Placement};
use crate::syntax::ast::{self, JointClause, Value, ValueKind};

/// Placements on the `from` and the `to` side.
type Sides = [Option<Placement>; 2];

impl Resolver<'_> {
    pub(super) fn joints(&mut self) -> Vec<Joint> {
        let mut joints = Vec::new();
        for (index, joint) in coordinates::joints(self.ast).enumerate() {
            joints.extend(self.joint(joint, JointId::new(index)));
        }
        joints
    }

    fn joint(&mut self, joint: &ast::Joint, id: JointId) -> Option<Joint> {
        let kind = self.kind(joint);
        let steps = kind.and_then(|kind| self.steps(joint, id, kind));
        let mut from = match &joint.from_station {
            Some(from_station) => self.station_before_to(joint, from_station),
            None => self.frame(&joint.from),
        };
        let mut to = self.frame(&joint.to);
        let sides = self.placements(joint, [&mut from, &mut to]);
        let apart = self.distinct(joint, from, to);
        let motions = self.drives(joint, id, kind);
        let cut = self.cut(joint, kind);
        let (kind, [from_placement, to_placement]) = (kind?, sides?);
        let (from, to, steps) = (from?, to?, steps?);
        apart?;
        let cut = cut?;
        for (step, motion) in steps.iter().zip(motions?) {
            let declared = self.coordinates.get(step.coordinate.index())?;
            self.declared_coordinates.push(Coordinate {
                name: declared.name.clone(),
                joint: id,
                quantity: declared.quantity?,
                motion,
            });
        }
        Some(Joint {
            name: joint.name.clone(),
            word: kind.word,
            closing: kind.closing,
            steps,
            from,
            to,
            from_placement: from_placement.unwrap_or_else(unplaced),
            to_placement: to_placement.unwrap_or_else(unplaced),
            cut,
            flexure: None,
        })
    }

    fn kind(&mut self, joint: &ast::Joint) -> Option<&'static Kind> {
        let word = joint.kind.to_string();
        let kind = Kind::find(&word);
        if kind.is_none() {
            let help = match suggestion(&word, Kind::words(), &SYNONYMS) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("known are {}", Kind::words().collect::<Vec<_>>().join(", ")),
            };
            let message = format!("unknown joint `{word}`");
            self.diagnostics.error_with_help(&joint.kind, message, help);
        }
        kind
    }

    /// The coordinates of a joint, in order.
    pub(super) fn coordinates_of(&self, joint: JointId) -> Vec<CoordinateId> {
        let ids = self.coordinates.iter().enumerate();
        ids.filter(|(_, coordinate)| coordinate.joint == joint).map(|(index, _)| CoordinateId::new(index)).collect()
    }

    /// Rejects a joint between a body and itself, which constrains nothing.
    fn distinct(&mut self, joint: &ast::Joint, from: Option<Frame>, to: Option<Frame>) -> Option<()> {
        if from.is_some() && from == to {
            let message = format!("this joint connects `{}` with itself", joint.to);
            return self.refuse(&joint.to, message);
        }
        Some(())
    }

    fn station_before_to(&mut self, joint: &ast::Joint, value: &Value) -> Option<Frame> {
        let station = self.station(&joint.from, value);
        if station.is_none() {
            let message =
                "before `to` stands a place along a beam or a shaft: `at tip`, `at 0.4 length` or `at station 4`";
            let help = format!("place the joint after its sides: `from {0} to {1} at ...`", joint.from, joint.to);
            self.diagnostics.error_with_help(value.extent, message, help);
        }
        station.flatten()
    }

    /// The station of a beam that a placement means, and the side it is on.
    fn station_of(
        &mut self,
        joint: &ast::Joint,
        placement: &ast::Placement,
        on: Option<&Ident>,
    ) -> Option<(usize, Option<Frame>)> {
        let offset = placement.offset.as_ref()?;
        let sides = [(0, &joint.from), (1, &joint.to)];
        let meant = sides.into_iter().filter(|(_, name)| on.is_none_or(|on| on == *name));
        let meant: Vec<_> = meant.filter(|(_, name)| self.has_places(name)).collect();
        let (side, name) = match (&meant[..], &offset.kind) {
            ([only], _) => *only,
            ([_, to, ..], _) => *to,
            ([], ValueKind::Fraction(_) | ValueKind::Station(_)) => (0, &joint.from),
            ([], _) => return None,
        };
        Some((side, self.station(name, offset)?))
    }

    /// The placements on both sides; at most one each. A place along a beam replaces the side's frame.
    fn placements(&mut self, joint: &ast::Joint, frames: [&mut Option<Frame>; 2]) -> Option<Sides> {
        let mut stations: [Option<Option<Frame>>; 2] = [None, None];
        let mut sides: Sides = [None, None];
        let mut seen = [false; 2];
        let mut all_right = true;
        for clause in &joint.clauses {
            let JointClause::Placement { placement, on } = clause else {
                continue;
            };
            let station = self.station_of(joint, placement, on.as_ref());
            let turned = ast::Placement { offset: None, ..placement.clone() };
            let rest = match station {
                Some(_) => &turned,
                None => placement,
            };
            let resolved = self.placement(Some(rest), "a joint's place");
            all_right &= resolved.is_some();
            let side = match station {
                Some((side, frame)) => {
                    stations[side] = Some(frame);
                    Some(side)
                }
                None => self.side(joint, on.as_ref()),
            };
            let Some(side) = side else {
                all_right = false;
                continue;
            };
            if seen[side] {
                let frame = if side == 0 { &joint.from } else { &joint.to };
                self.diagnostics.error_with_help(
                    placement.keyword,
                    format!("the joint frame is placed on `{frame}` twice"),
                    format!("say which body each placement is on: `on {}`", joint.to),
                );
                all_right = false;
            }
            seen[side] = true;
            sides[side] = resolved;
        }
        for (frame, station) in frames.into_iter().zip(stations) {
            if let Some(station) = station {
                *frame = station;
            }
        }
        all_right.then_some(sides)
    }

    /// 0 for the `from` side, 1 for the `to` side.
    fn side(&mut self, joint: &ast::Joint, on: Option<&Ident>) -> Option<usize> {
        let Some(on) = on else {
            return Some(0);
        };
        if *on == joint.from {
            return Some(0);
        }
        if *on == joint.to {
            return Some(1);
        }
        let message = format!("`{on}` is not a side of this joint; it connects `{}` and `{}`", joint.from, joint.to);
        self.refuse(on, message)
    }
}
