//! Places along beams to which something is attached.

use proc_macro2::Ident;

use super::super::coordinates;
use super::super::placements::unplaced;
use super::super::resolver::Resolver;
use super::Declared;
use crate::base::ids::{BeamId, BodyId, CoordinateId, JointId};
use crate::model::mechanism::{
    Beam, Body, Coordinate, CoordinateQuantity, Frame, Joint, Motion, Station,
};
use crate::syntax::ast::{ItemKind, Value, ValueKind};

/// The beams of a declaration and the stations used so far. Every beam has a station at its tip.
#[derive(Debug, Default)]
pub(in crate::model::resolve) struct Stations {
    beams: Vec<(Ident, Option<Declared>)>,
    /// The beam and the fraction of its length.
    used: Vec<(usize, f64)>,
}

impl Stations {
    pub(super) fn declare(&mut self, name: &Ident, beam: Option<Declared>) {
        self.used.push((self.beams.len(), 1.0));
        self.beams.push((name.clone(), beam));
    }
}

impl Resolver<'_> {
    /// The station that a place means on a frame: `tip`, `root` or a fraction of the length of a beam; `None` if it is
    /// an ordinary place, with an inner `None` if it is wrong.
    pub(in crate::model::resolve) fn station(
        &mut self,
        frame: &Ident,
        place: &Value,
    ) -> Option<Option<Frame>> {
        let beam = self
            .stations
            .beams
            .iter()
            .position(|(name, _)| name == frame);
        let fraction = match &place.kind {
            ValueKind::Fraction(fraction) => *fraction,
            ValueKind::Name(word) if beam.is_some() && word == "tip" => 1.0,
            ValueKind::Name(word) if beam.is_some() && word == "root" => 0.0,
            _ => return None,
        };
        let Some(beam) = beam else {
            let message = format!("`{frame}` is not a beam: it has no places along it");
            let help = format!("place it by a vector: `{frame} at [0.1 m, 0, 0]`");
            self.diagnostics
                .error_with_help(place.extent, message, help);
            return Some(None);
        };
        if !(0.0..=1.0).contains(&fraction) {
            let message = format!("{fraction} is outside the beam, which goes from 0 to 1 length");
            self.diagnostics.error(place.extent, message);
            return Some(None);
        }
        let root = self.frame(frame);
        if fraction == 0.0 {
            return Some(root);
        }
        let known = self
            .stations
            .used
            .iter()
            .position(|own| *own == (beam, fraction));
        let index = known.unwrap_or_else(|| {
            self.stations.used.push((beam, fraction));
            self.stations.used.len() - 1
        });
        let bodies = self.items_that(|kind| matches!(kind, ItemKind::Body(_)));
        root.map(|_| Some(Frame::Body(BodyId::new(bodies + index))))
    }

    pub(in crate::model::resolve) fn is_beam(&self, name: &Ident) -> bool {
        self.stations.beams.iter().any(|(own, _)| own == name)
    }

    fn items_that(&self, is: fn(&ItemKind) -> bool) -> usize {
        self.ast.items.iter().filter(|item| is(&item.kind)).count()
    }

    /// The beams with their stations, which are added to the bodies and joints, and their coordinates.
    pub(in crate::model::resolve) fn beams(
        &mut self,
        bodies: &mut Vec<Body>,
        joints: &mut Vec<Joint>,
    ) -> Vec<Beam> {
        let stations = std::mem::take(&mut self.stations);
        let first_body = self.items_that(|kind| matches!(kind, ItemKind::Body(_)));
        let first_joint = coordinates::joints(self.ast).count();
        let first_coordinate = self.coordinates.len();
        let mut beams = Vec::new();
        let mut coordinates = Vec::new();
        let is_whole = bodies.len() == first_body
            && joints.len() == first_joint
            && self.declared_coordinates.len() == first_coordinate
            && stations.beams.iter().all(|(_, beam)| beam.is_some());
        if !is_whole {
            return beams;
        }
        for (index, (beam, place)) in stations.used.iter().enumerate() {
            let name = &stations.beams[*beam].0;
            let word = match *place == 1.0 {
                true => "tip".to_owned(),
                false => format!("station_{index}"),
            };
            let name = self.unused(&format!("{name}_{word}"), name);
            bodies.push(Body {
                name: name.clone(),
                parts: Vec::new(),
            });
            let of_beam = stations.used[..index].iter().filter(|own| own.0 == *beam);
            let root = bodies
                .iter()
                .position(|body| body.name == stations.beams[*beam].0);
            joints.push(Joint {
                name,
                word: "flexure",
                closing: None,
                steps: Vec::new(),
                from: Frame::Body(BodyId::new(root.unwrap_or_default())),
                to: Frame::Body(BodyId::new(first_body + index)),
                from_placement: unplaced(),
                to_placement: unplaced(),
                cut: false,
                flexure: Some((BeamId::new(*beam), of_beam.count())),
            });
        }
        for (index, (name, declared)) in stations.beams.iter().enumerate() {
            let own = stations.used.iter().enumerate();
            let own: Vec<Station> = own
                .filter(|(_, (beam, _))| *beam == index)
                .map(|(k, (_, place))| Station {
                    place: *place,
                    body: BodyId::new(first_body + k),
                    joint: JointId::new(first_joint + k),
                })
                .collect();
            let root = bodies.iter().position(|body| body.name == *name);
            let (Some(declared), Some(root), Some(tip)) = (declared, root, own.first()) else {
                continue;
            };
            let joint = tip.joint;
            let mut next = |word: &str, count: usize| -> Vec<CoordinateId> {
                let mut ids = Vec::new();
                for k in 0..count {
                    ids.push(CoordinateId::new(first_coordinate + coordinates.len()));
                    coordinates.push(Coordinate {
                        name: self.unused(&format!("{name}_{word}_{k}"), name),
                        joint,
                        quantity: CoordinateQuantity::Angle,
                        motion: Motion::Free,
                    });
                }
                ids
            };
            let [torsion, y, z] = declared.counts;
            beams.push(Beam {
                body: BodyId::new(root),
                length: declared.length.clone(),
                axes: declared.axes.clone(),
                coordinates: [
                    next("torsion", torsion),
                    next("bend_y", y),
                    next("bend_z", z),
                ],
                sections: declared.sections.clone(),
                stations: own,
                lag: declared.lag.clone(),
            });
        }
        self.declared_coordinates.extend(coordinates);
        beams
    }

    /// A name that nothing else has.
    fn unused(&self, wanted: &str, at: &Ident) -> Ident {
        let mut name = wanted.to_owned();
        while self.scope.find(&name).is_some() {
            name.push('_');
        }
        Ident::new(&name, at.span())
    }
}
