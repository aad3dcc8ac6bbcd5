//! Places along beams to which something is attached.

use proc_macro2::Ident;

use super::super::coordinates;
use super::super::placements::unplaced;
use super::super::resolver::Resolver;
use super::super::shafts::declared::Declared as Shaft;
use super::declared::{Declared, Flexible};
use crate::base::ids::{BeamId, BodyId, CoordinateId, JointId};
use crate::base::names::joined;
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::{
    self, Beam, Body, Coordinate, CoordinateQuantity, Force, Frame, Joint, Motion, Point, Station, Superelement,
};
use crate::model::simplify;
use crate::syntax::ast::{ItemKind, Value, ValueKind};

/// The first number of what beams add.
struct First {
    body: usize,
    joint: usize,
    coordinate: usize,
}

/// A part of a beam that nothing interrupts.
struct Piece {
    name: String,
    /// Where it starts, and the body there.
    root: (f64, BodyId),
    end: f64,
    /// Its stations, from the root outwards; the last is its end.
    stations: Vec<(f64, BodyId)>,
}

impl Resolver<'_> {
    /// The station that a place means on a frame: `tip`, `root` or a fraction of the length of a beam; `None` if it is
    /// an ordinary place, with an inner `None` if it is wrong.
    pub(in crate::model::resolve) fn station(&mut self, frame: &Ident, value: &Value) -> Option<Option<Frame>> {
        let beam = self.stations.bodies.iter().position(|(name, _)| name == frame);
        match beam.map(|beam| (beam, &self.stations.bodies[beam].1)) {
            Some((beam, Flexible::Shaft(shaft))) => {
                let last = shaft.as_deref().map(Shaft::last);
                return self.station_of_shaft(frame, beam, last, value);
            }
            Some((beam, Flexible::Superelement(own))) => {
                let count = own.as_ref().map(|own| own.stations.len());
                return self.station_of_superelement(frame, beam, count, value);
            }
            _ => {}
        }
        let fraction = match &value.kind {
            ValueKind::Fraction(fraction) => *fraction,
            ValueKind::Station(_) => {
                let message = format!("`{frame}` is no shaft and no superelement: it has no stations");
                let help = "`at station 4` is the end of the fourth section of a `shaft`";
                self.diagnostics.error_with_help(value.extent, message, help);
                return Some(None);
            }
            ValueKind::Name(word) if beam.is_some() && word == "tip" => 1.0,
            ValueKind::Name(word) if beam.is_some() && word == "root" => 0.0,
            _ => return None,
        };
        let Some(beam) = beam else {
            let message = format!("`{frame}` is not a beam: it has no places along it");
            let help = format!("place it by a vector: `{frame} at [0.1 m, 0, 0]`");
            self.diagnostics.error_with_help(value.extent, message, help);
            return Some(None);
        };
        if !(0.0..=1.0).contains(&fraction) {
            let message = format!("{fraction} is outside the beam, which goes from 0 to 1 length");
            let help = format!("write a fraction: `{frame} at 0.4 length`, or `{frame} at tip`");
            self.diagnostics.error_with_help(value.extent, message, help);
            return Some(None);
        }
        Some(self.place_along(frame, beam, fraction))
    }

    /// The station that a place means on a shaft; its number of sections is `None` if it is wrong.
    fn station_of_shaft(
        &mut self,
        frame: &Ident,
        shaft: usize,
        last: Option<usize>,
        value: &Value,
    ) -> Option<Option<Frame>> {
        let station = match &value.kind {
            ValueKind::Station(station) => *station as usize,
            ValueKind::Name(word) if word == "tip" => last.unwrap_or(1),
            ValueKind::Name(word) if word == "root" => 0,
            ValueKind::Fraction(_) => {
                let message = "things stand on a shaft between two sections";
                let help =
                    format!("write `{frame} at station 4` for the end of its fourth section; divide a section in two");
                self.diagnostics.error_with_help(value.extent, message, help);
                return Some(None);
            }
            _ => return None,
        };
        let Some(last) = last else { return Some(None) };
        if station > last {
            let message = format!("station {station} is off the shaft `{frame}`, whose last is {last}");
            let help = "station 4 is the end of the fourth section, station 0 the root";
            self.diagnostics.error_with_help(value.extent, message, help);
            return Some(None);
        }
        Some(self.place_along(frame, shaft, station as f64))
    }

    /// The station that a place means on a superelement; their number is `None` if it is wrong.
    fn station_of_superelement(
        &mut self,
        frame: &Ident,
        superelement: usize,
        count: Option<usize>,
        value: &Value,
    ) -> Option<Option<Frame>> {
        let station = match &value.kind {
            ValueKind::Station(station) => *station as usize,
            ValueKind::Fraction(_) => 0,
            ValueKind::Name(word) if word == "tip" || word == "root" => 0,
            _ => return None,
        };
        let Some(count) = count else { return Some(None) };
        if !(1..=count).contains(&station) {
            let message = match value.kind {
                ValueKind::Station(_) => format!("`{frame}` has no station {station}: they count from 1 to {count}"),
                _ => format!("`{frame}` is a superelement: things stand on its stations only"),
            };
            let help = format!("write `{frame} at station 1`; stations are those of its `stations: [..]` in order");
            self.diagnostics.error_with_help(value.extent, message, help);
            return Some(None);
        }
        Some(self.place_along(frame, superelement, (station - 1) as f64))
    }

    /// The frame of a place that is used: of the root, that of the body.
    fn place_along(&mut self, frame: &Ident, body: usize, place: f64) -> Option<Frame> {
        let root = self.frame(frame);
        if place == 0.0 {
            return root;
        }
        let index = self.stations.used.iter().position(|x| *x == (body, place)).unwrap_or_else(|| {
            self.stations.used.push((body, place));
            self.stations.used.len() - 1
        });
        let bodies = self.items_that(|kind| matches!(kind, ItemKind::Body(_)));
        root.map(|_| Frame::Body(BodyId::new(bodies + index)))
    }

    /// Whether a body has places along it.
    pub(in crate::model::resolve) fn has_places(&self, name: &Ident) -> bool {
        self.stations.bodies.iter().any(|(x, _)| x == name)
    }

    pub(in crate::model::resolve) fn is_beam(&self, name: &Ident) -> bool {
        self.stations.beams().any(|(_, x, _)| x == name)
    }

    /// Whether a beam stretches or shears by coordinates of its own; `None` if it is wrong.
    pub(in crate::model::resolve) fn strains(&self, name: &Ident) -> Option<bool> {
        let (.., beam) = self.stations.beams().find(|(_, x, _)| *x == name)?;
        Some(beam?.strains != [0; 3])
    }

    fn items_that(&self, is: fn(&ItemKind) -> bool) -> usize {
        self.ast.items.iter().filter(|item| is(&item.kind)).count()
    }

    /// Beams, shafts and superelements with their stations, which are added to the bodies and joints, their coordinates, and
    /// what they do at rest. A beam is split where a load stands on it: its moment has a kink there, which no polynomial has.
    pub(in crate::model::resolve) fn flexible_bodies(
        &mut self,
        bodies: &mut Vec<Body>,
        joints: &mut Vec<Joint>,
        points: &[Point],
        forces: &mut Vec<Force>,
        gravity: &Vector,
    ) -> (Vec<Beam>, Vec<mechanism::Shaft>, Vec<Superelement>) {
        let stations = std::mem::take(&mut self.stations);
        let first = First {
            body: self.items_that(|kind| matches!(kind, ItemKind::Body(_))),
            joint: coordinates::joints(self.ast).count(),
            coordinate: self.coordinates.len(),
        };
        let mut beams = Vec::new();
        let is_whole = bodies.len() == first.body
            && joints.len() == first.joint
            && self.declared_coordinates.len() == first.coordinate
            && stations.are_right();
        if !is_whole {
            return (beams, Vec::new(), Vec::new());
        }
        let loaded = self.loaded(joints, points);
        for (index, (beam, fraction)) in stations.used.iter().enumerate() {
            let (name, of) = &stations.bodies[*beam];
            let word = match of {
                Flexible::Beam(_) if *fraction == 1.0 => "tip".to_owned(),
                Flexible::Beam(_) => format!("station_{index}"),
                Flexible::Shaft(_) => format!("station_{fraction}"),
                Flexible::Superelement(_) => format!("station_{}", fraction + 1.0),
            };
            bodies.push(Body { name: self.unused(&format!("{name}_{word}"), name), parts: Vec::new() });
        }
        for (index, name, declared) in stations.beams() {
            let root = bodies.iter().position(|body| body.name == *name);
            let (Some(declared), Some(root)) = (declared, root) else {
                continue;
            };
            let mut beam_stations: Vec<(f64, BodyId)> = stations
                .used
                .iter()
                .enumerate()
                .filter(|(_, (beam, _))| *beam == index)
                .map(|(k, (_, fraction))| (*fraction, BodyId::new(first.body + k)))
                .collect();
            beam_stations.sort_by(|a, b| a.0.total_cmp(&b.0));
            let ends: Vec<(f64, BodyId)> = beam_stations
                .iter()
                .filter(|(fraction, body)| *fraction == 1.0 || loaded.contains(&Frame::Body(*body)))
                .copied()
                .collect();
            if let Some((_, tip)) = ends.last().filter(|_| declared.table.is_sharp()) {
                self.require_unloaded(name, *tip, &loaded);
            }
            let mut start = (0.0, BodyId::new(root));
            for (number, end) in ends.iter().enumerate() {
                let name = match ends.len() {
                    1 => name.to_string(),
                    _ => self.unused(&format!("{name}_{}", number + 1), name).to_string(),
                };
                let within = beam_stations.iter().filter(|(fraction, _)| start.0 < *fraction && *fraction <= end.0);
                let piece = Piece { name, root: start, end: end.0, stations: within.copied().collect() };
                beams.push(self.piece(&stations.bodies[index].0, declared, piece, beams.len(), bodies, joints));
                start = *end;
            }
        }
        let shafts = self.shafts(&stations, first.body, bodies, joints, forces, gravity);
        let superelements = self.superelements(&stations, first.body, bodies, joints, forces, gravity);
        (beams, shafts, superelements)
    }

    /// A tip without a section takes neither a force nor a moment.
    fn require_unloaded(&mut self, name: &Ident, tip: BodyId, loaded: &[Frame]) {
        if loaded.contains(&Frame::Body(tip)) {
            let message = format!("something stands on the tip of `{name}`, which is sharp: it carries no load");
            let help =
                format!("give the tip a small section, or load the beam before its end: `{name} at 0.99 length`");
            self.diagnostics.error_with_help(name, message, help);
        }
    }

    /// A part of a beam between loads, or all of it.
    fn piece(
        &mut self,
        whole: &Ident,
        declared: &Declared,
        piece: Piece,
        number: usize,
        bodies: &[Body],
        joints: &mut Vec<Joint>,
    ) -> Beam {
        let (start, root) = piece.root;
        let share = piece.end - start;
        let mut stations = Vec::new();
        for (fraction, body) in &piece.stations {
            let joint = JointId::new(joints.len());
            joints.push(Joint {
                name: bodies[body.index()].name.clone(),
                word: "flexure",
                closing: None,
                steps: Vec::new(),
                from: Frame::Body(root),
                to: Frame::Body(*body),
                from_placement: unplaced(),
                to_placement: unplaced(),
                cut: false,
                flexure: Some((BeamId::new(number), stations.len())),
            });
            stations.push(Station {
                place: (fraction - start) / share,
                section: declared.section(*fraction),
                body: *body,
                joint,
            });
        }
        let joint = JointId::new(joints.len() - 1);
        let mut component = |word: &str, count: usize| -> Vec<CoordinateId> {
            let mut ids = Vec::new();
            for k in 0..count {
                ids.push(CoordinateId::new(self.declared_coordinates.len()));
                let name = joined(&joined(&piece.name.to_string(), word), &k.to_string());
                let name = Ident::new(&name, whole.span());
                self.declared_coordinates.push(Coordinate {
                    name,
                    joint,
                    quantity: CoordinateQuantity::Angle,
                    motion: Motion::Free,
                });
            }
            ids
        };
        let [torsion, y, z] = declared.counts;
        let [stretch, shear_y, shear_z] = declared.strains;
        Beam {
            name: piece.name.clone(),
            whole: whole.clone(),
            body: root,
            length: simplify::multiply(Expr::Number(share), declared.length.clone()),
            axes: declared.axes.clone(),
            coordinates: [component("torsion", torsion), component("bend_y", y), component("bend_z", z)],
            strains: [component("stretch", stretch), component("shear_y", shear_y), component("shear_z", shear_z)],
            static_shear: declared.static_shear,
            root: declared.section(start),
            round: declared.table.is_round(),
            sections: declared.sections(start, piece.end),
            stations,
            spin: declared.spin.clone(),
            lag: declared.lag.clone(),
            positive: declared.positive.clone(),
        }
    }

    /// The bodies on which loads stand: those with a joint, with a point that a force, a constraint or an excitation
    /// names, or with one at which the force inside is asked for.
    fn loaded(&self, joints: &[Joint], points: &[Point]) -> Vec<Frame> {
        let mut names = self.cut_open.clone();
        for item in &self.ast.items {
            let call = match &item.kind {
                ItemKind::Force(force) => &force.law,
                ItemKind::Constraint(constraint) => &constraint.law,
                _ => continue,
            };
            let arguments = call.arguments.iter().flatten();
            names.extend(arguments.flat_map(|argument| argument.value.names()).map(Ident::to_string));
        }
        let of_joints = joints.iter().flat_map(|joint| [joint.from, joint.to]);
        let of_points = points.iter().filter(|point| names.contains(&point.name.to_string()));
        of_joints.chain(of_points.map(|point| point.frame)).collect()
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
