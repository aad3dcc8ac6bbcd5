//! What is right but seems not to be meant.

use proc_macro2::Ident;

use super::evaluate::Values;
use super::mechanism::{
    Beam, ForceLaw, Frame, Joint, JointStep, Line, Mechanism, Motion, Point, Section, Shaft, StepMotion,
};
use crate::base::ids::PointId;
use crate::model::expression::{Expr, Vector};

/// Ratios this close to one say nothing.
const ALIKE: f64 = 1e-6;
/// The most of a shaft's length between a seat and its journal.
const BESIDE: f64 = 0.01;

/// Something that seems not to be meant, in the nominal design.
#[derive(Clone, Debug)]
pub struct Doubt {
    /// Of what.
    pub name: Ident,
    /// What contradicts what.
    pub message: String,
    /// What to look at.
    pub help: &'static str,
}

const EXCHANGED: &str = "bending about y moves the beam along `up`: its stiffness takes the height to the third power. Exchange the \
                         stiffnesses, or write `#[allow(deprecated)]` above the mechanism if they are meant";
const STANDS: &str = "write `spinning at` and that speed behind the shaft, for the gyroscopic moments of its sections, or \
                      `#[allow(deprecated)]` above the mechanism if it stands still";
const ASTRAY: &str = "place the point on the ground where the station is: the sections before it have that length together. Write \
                      `#[allow(deprecated)]` above the mechanism if the distance is meant";

impl Mechanism {
    /// Beams given by numbers whose two bending stiffnesses seem to be exchanged: the lower one is about the axis from
    /// which the section extends, or has its inertia, farther; shafts that stand still under what turns; bushings with one end away
    /// from the station of a shaft that they hold. Nothing is said where a number depends on an input.
    pub fn doubts(&self) -> Vec<Doubt> {
        let design: Vec<f64> = self.design.iter().map(|value| value.nominal).collect();
        let values = Values::new(&self.constants, &[], &design);
        let mut list: Vec<Doubt> = Vec::new();
        for beam in &self.beams {
            if list.iter().any(|x| x.name == beam.whole) {
                continue;
            }
            let Some(contradiction) = contradiction(&values, beam) else {
                continue;
            };
            let message = format!("`{}` {contradiction}", beam.whole);
            list.push(Doubt { name: beam.whole.clone(), message, help: EXCHANGED });
        }
        for shaft in &self.shafts {
            if let Some(driven) = self.driven_on(shaft).filter(|_| shaft.speed == Expr::Number(0.0)) {
                let message = format!("`{}` does not spin, although `{driven}` turns what stands on it", shaft.name);
                list.push(Doubt { name: shaft.name.clone(), message, help: STANDS });
            }
        }
        for force in &self.forces {
            if let ForceLaw::Bushing { from, to, .. } = &force.law
                && let Some((shaft, away)) = self.away_from_shaft(&values, [*from, *to])
            {
                let message = format!(
                    "one end of `{}` is {away:.3} m away from the station of `{shaft}` that it holds",
                    force.name
                );
                list.push(Doubt { name: force.name.clone(), message, help: ASTRAY });
            }
        }
        list
    }

    /// A joint that drives a rotation from a station of a shaft that bends.
    fn driven_on(&self, shaft: &Shaft) -> Option<&Ident> {
        let turns = |step: &JointStep| {
            let motion = &self.coordinates[step.coordinate.index()].motion;
            step.motion == StepMotion::Turn && matches!(motion, Motion::Driven(_)) && motion.runs()
        };
        let on_shaft = |joint: &Joint| shaft.stations.iter().any(|station| Frame::Body(station.body) == joint.from);
        let bends = shaft.spans.iter().any(|span| span.line != Line::Bar);
        let joint = self.joints.iter().find(|joint| bends && on_shaft(joint) && joint.steps.iter().any(turns));
        joint.map(|joint| &joint.name)
    }

    /// The shaft that one of two points is on, and how far the other, which does not move either, is from it, if that is far.
    fn away_from_shaft(&self, values: &Values<'_>, ends: [PointId; 2]) -> Option<(&Ident, f64)> {
        let [first, second] = ends.map(|end| &self.points[end.index()]);
        let place = |point: &Point| Some(sum(self.standing(values, point.frame)?, of(values, &point.placement.offset)));
        let away = distance(place(first)?, place(second)?);
        let holds = |shaft: &&Shaft| {
            let on = |point: &Point| shaft.stations.iter().any(|station| Frame::Body(station.body) == point.frame);
            let ends = [shaft.stations.first(), shaft.stations.last()];
            let ends = ends.map(|end| self.standing(values, Frame::Body(end?.body)));
            let [Some(root), Some(tip)] = ends else { return false };
            (on(first) || on(second)) && away > BESIDE * distance(root, tip)
        };
        self.shafts.iter().find(holds).map(|shaft| (&shaft.name, away))
    }

    /// Where a station, or the ground, has its origin.
    fn standing(&self, values: &Values<'_>, frame: Frame) -> Option<[f64; 3]> {
        if frame == Frame::Ground {
            return Some([0.0; 3]);
        }
        let stands = |joint: &&Joint| joint.to == frame && joint.word == "station" && joint.from == Frame::Ground;
        self.joints.iter().find(stands).map(|joint| of(values, &joint.from_placement.offset))
    }
}

fn of(values: &Values<'_>, vector: &Vector) -> [f64; 3] {
    vector.each_ref().map(|x| values.of(x))
}

fn sum(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] + b[k])
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    [0, 1, 2].map(|k| (a[k] - b[k]).powi(2)).iter().sum::<f64>().sqrt()
}

fn contradiction(values: &Values<'_>, beam: &Beam) -> Option<String> {
    let mut sections = beam.sections.iter().map(|(_, _, section)| section);
    sections.find_map(|section| {
        let Section {
            stiffness: [_, about_y, about_z], inertia: [inertia_y, inertia_z], size: [width, height], ..
        } = section;
        let ratio = |a, b| {
            let (a, b) = (values.of(a), values.of(b));
            (a > 0.0 && b > 0.0).then(|| (a / b).ln())
        };
        let stiffness = ratio(about_y, about_z)?;
        let evidence = [
            (ratio(height, width), "its height", "its width"),
            (ratio(inertia_y, inertia_z), "`inertia_y`", "`inertia_z`"),
        ];
        evidence.into_iter().find_map(|(ratio, y, z)| {
            let ratio = ratio?;
            let is_clear = stiffness.abs() > ALIKE && ratio.abs() > ALIKE;
            let (stiffer, larger, smaller) = if ratio > 0.0 { ('z', y, z) } else { ('y', z, y) };
            (is_clear && stiffness * ratio < 0.0)
                .then(|| format!("is stiffer about {stiffer}, although {larger} is greater than {smaller}"))
        })
    })
}
