//! Shafts as beams, and superelements as rods between their stations.

use super::Numbers;
use crate::algebra::{ExprId, Graph, Matrix3, Vector3};
use crate::base::ids::BodyId;
use crate::mechanics::motion::Kinematics;
use crate::mechanics::picture::{PictureBeam, SolidKind};
use crate::model::mechanism::{Mechanism, Shaft, Superelement};

/// Length along the first axis that is added to rods, so that they have a direction where stations coincide, m.
const LEAST: f64 = 1e-9;

impl Numbers<'_> {
    /// The poses of the cross-sections of a shaft. Between two stations the axis is the cubic with their places and
    /// directions.
    pub(super) fn poses_of_shaft(&mut self, g: &mut Graph, kinematics: &Kinematics, shaft: &Shaft) {
        let own_axes = Matrix3([0, 1, 2].map(|k| self.values.vector(g, &shaft.axes[k])));
        let stations = shaft.stations.iter().map(|station| {
            let frame = &kinematics.of(station.body).frame;
            (frame.position, frame.orientation.axes.multiply(g, own_axes))
        });
        let stations: Vec<_> = stations.collect();
        for section in &shaft.outline {
            let fraction = self.values.scalar(g, &section.fraction);
            let (position, axes) = between(g, &stations[section.station..], fraction);
            self.pose(position, axes);
        }
    }

    pub(super) fn shaft(&mut self, g: &mut Graph, shaft: &Shaft) -> PictureBeam {
        for section in &shaft.outline {
            let diameter = self.values.scalar(g, &section.diameter);
            self.all.extend([diameter; 2]);
        }
        PictureBeam { name: shaft.name.to_string(), sections: shaft.outline.len() as u32, round: true }
    }

    /// A rod from a station of a superelement to the middle of all its stations; nothing on other bodies.
    pub(super) fn spoke(&mut self, g: &mut Graph, mechanism: &Mechanism, body: BodyId) -> Option<(SolidKind, bool)> {
        let is_of = |own: &&Superelement| own.stations.iter().any(|station| station.body == body);
        let whole = mechanism.superelements.iter().find(is_of)?;
        let places = whole.stations.iter().map(|station| {
            let joint = &mechanism.joints[station.joint.index()];
            (station.body, self.values.vector(g, &joint.from_placement.offset))
        });
        let places: Vec<_> = places.collect();
        let own = places.iter().find(|(of, _)| *of == body)?.1;
        let least = [LEAST, 0.0, 0.0].map(|x| g.constant(x));
        let share = g.constant(1.0 / places.len() as f64);
        let arm = places.iter().fold(Vector3(least), |arm, (_, place)| {
            let reach = place.sub(g, own).scale(g, share);
            arm.add(g, reach)
        });
        let half = g.constant(0.5);
        let (center, length) = (arm.scale(g, half), arm.norm(g));
        self.vector(center);
        let along = unit(g, arm);
        self.vector(along);
        self.all.push(length);
        Some((SolidKind::Rod, false))
    }
}

/// The place and the axes at a fraction of the way from the first of these stations to the second.
fn between(g: &mut Graph, stations: &[(Vector3, Matrix3)], fraction: ExprId) -> (Vector3, Matrix3) {
    let [(first, from), (last, to)] = [stations[0], stations[1]];
    let chord = last.sub(g, first);
    let length = chord.norm(g);
    let one = g.constant(1.0);
    let (s, r) = (fraction, g.sub(one, fraction));
    let (ss, rr, sr) = (g.mul(s, s), g.mul(r, r), g.mul(s, r));
    let (near_weight, far_weight) = (g.mul(sr, r), g.mul(sr, s));
    let twice = g.scale(2.0, sr);
    let (near_slope, far_slope) = (g.sub(rr, twice), g.sub(ss, twice));
    // The directions at the ends against the chord.
    let [near, far] = [from, to].map(|axes| axes.0[0].scale(g, length).sub(g, chord));
    let back = g.neg(far_weight);
    let position = sum(g, first, [(s, chord), (near_weight, near), (back, far)]);
    let slope = sum(g, chord, [(near_slope, near), (far_slope, far)]);
    let along = unit(g, slope);
    let across = from.0[1].scale(g, r);
    let across = sum(g, across, [(s, to.0[1])]);
    let up = along.cross(g, across);
    let up = unit(g, up);
    (position, Matrix3([along, up.cross(g, along), up]))
}

fn sum<const N: usize>(g: &mut Graph, start: Vector3, terms: [(ExprId, Vector3); N]) -> Vector3 {
    terms.into_iter().fold(start, |sum, (factor, vector)| {
        let term = vector.scale(g, factor);
        sum.add(g, term)
    })
}

fn unit(g: &mut Graph, vector: Vector3) -> Vector3 {
    let length = vector.norm(g);
    Vector3(vector.0.map(|component| g.div(component, length)))
}
