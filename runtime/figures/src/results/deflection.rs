//! Mode shapes of beams as deflection curves.

use core::f64::consts::TAU;

use eigentol::picture::{ModePictures, Pose, Scene};
use eigentol::{Complex, Description, Mode, Modes};

use super::along::{finished, with_notes};
use super::shapes::{MOST, label};
use crate::Error;
use crate::caption::operating_point;
use crate::figure::{Axis, Colour, Curve, Figure, Panel, Point, Stroke};
use crate::style::Style;

/// Displacements below this fraction of a mode's largest are not worth a panel.
const SEEN: f64 = 0.03;
/// Share of a beam's length along the common axis from which it counts as lying along it.
const ALONG: f64 = 0.7;
/// Translations below this fraction of the twist times the length belong to a torsional mode.
const TWISTED: f64 = 1e-3;
/// Variation of a rest shape, as a fraction of the size, that counts as straight.
const STRAIGHT: f64 = 1e-6;
const NAMES: [&str; 3] = ["x", "y", "z"];

/// Deflection curves of the beams: how far their sections move in each mode, a panel for each direction of the common frame
/// in which any does and one for twist, relative to the largest displacement of the mode; above them the bent shape of the
/// equilibrium, if it is bent.
///
/// `pictures` are those of the first modes, at three phases or more ([`eigentol::Study::mode_pictures`]).
///
/// # Errors
/// [`Error::Nothing`] without beams, or if no mode moves one.
pub fn deflections(scene: &Scene, modes: &Modes, pictures: &[ModePictures], style: &Style) -> Result<Figure, Error> {
    let d: &Description = &modes.description;
    let line = Line::of(scene).ok_or_else(|| Error::nothing("the mechanism has no beam"))?;
    let shapes: Vec<(usize, &Mode, Shape)> = (pictures.iter().take(MOST))
        .filter_map(|picture| {
            let mode = modes.modes.get(picture.mode)?;
            Some((picture.mode, mode, line.shape(picture)?))
        })
        .collect();
    let mut panels = line.rest(scene);
    let mut later = false;
    let directions = NAMES.iter().map(|name| format!("displacement along {name}")).chain(["twist".to_owned()]);
    for (k, name) in directions.enumerate() {
        let largest = |shape: &Shape| shape.iter().map(|parts| parts[k].norm()).fold(0.0, f64::max);
        if !shapes.iter().any(|(.., shape)| largest(shape) > SEEN) {
            continue;
        }
        let mut panel = Panel::new(line.axis(), Axis::new(name, ""));
        for (r, mode, shape) in shapes.iter().filter(|(.., shape)| largest(shape) > SEEN) {
            let part = |of: fn(&Complex) -> f64| line.curve(shape.iter().map(|parts| of(&parts[k])));
            panel.curve(Curve::new(label(mode, d, style), Colour::Series(*r), part(|x| x.re)));
            if shape.iter().any(|parts| parts[k].im.abs() > SEEN) {
                later = true;
                panel.curve(Curve::new("", Colour::Series(*r), part(|x| x.im)).stroke(Stroke::Dotted));
            }
        }
        panel.fit();
        panel.level_line(0.0);
        panels.push(panel);
    }
    if panels.is_empty() {
        return Err(Error::nothing("no mode moves a beam"));
    }
    let mut caption =
        vec![operating_point(d, &modes.inputs, None), "Each mode relative to its largest displacement.".to_owned()];
    if later {
        caption.push("Dotted: a quarter of a period later.".to_owned());
    }
    Ok(finished(style, d, "mode shapes", with_notes(caption, style, d), panels))
}

/// Complex displacements of each section along x, y, z, and its twist, the largest one real.
type Shape = Vec<[Complex; 4]>;

/// The sections of all beams, in order.
struct Line {
    rest: Vec<Pose>,
    /// Where each stands on the horizontal axis, m.
    places: Vec<f64>,
    /// Number of sections of each beam.
    counts: Vec<usize>,
    /// Number of poses before the sections.
    before: usize,
    /// The direction of the common frame that the places are measured along; `None` if they are arc lengths.
    along: Option<usize>,
}

impl Line {
    fn of(scene: &Scene) -> Option<Self> {
        let beams = || scene.beams.iter().filter(|beam| beam.sections.len() > 1);
        let rest: Vec<Pose> = beams().flat_map(|beam| beam.sections.iter().map(|section| section.pose)).collect();
        if rest.is_empty() {
            return None;
        }
        let extent = |i: usize| {
            let ends = rest.iter().map(|pose| pose.position[i]);
            ends.clone().fold(f64::NEG_INFINITY, f64::max) - ends.fold(f64::INFINITY, f64::min)
        };
        let axis = (0..3).max_by(|a, b| extent(*a).total_cmp(&extent(*b)))?;
        let (mut arc, mut lies) = (Vec::new(), true);
        let mut gone = 0.0;
        for beam in beams() {
            let start = gone;
            let positions: Vec<[f64; 3]> = beam.sections.iter().map(|section| section.pose.position).collect();
            arc.push(gone);
            for pair in positions.windows(2) {
                gone += distance(pair[0], pair[1]);
                arc.push(gone);
            }
            let (first, last) = (positions.first()?, positions.last()?);
            lies &= (last[axis] - first[axis]).abs() >= ALONG * (gone - start);
        }
        Some(Self {
            places: if lies { rest.iter().map(|pose| pose.position[axis]).collect() } else { arc },
            counts: beams().map(|beam| beam.sections.len()).collect(),
            before: scene.bodies.len(),
            along: lies.then_some(axis),
            rest,
        })
    }

    fn axis(&self) -> Axis {
        let name = self.along.map_or("length along the beams", |axis| NAMES[axis]);
        Axis::new(name, "m")
    }

    /// Values at the sections as a curve that is broken between beams which do not touch.
    fn curve(&self, values: impl Iterator<Item = f64>) -> Vec<Option<Point>> {
        let points: Vec<Point> = self.places.iter().zip(values).map(|(&place, value)| [place, value]).collect();
        let mut all = Vec::new();
        let mut first = 0;
        for &count in &self.counts {
            if first > 0 && distance(self.rest[first - 1].position, self.rest[first].position) > STRAIGHT {
                all.push(None);
            }
            all.extend(points[first..first + count].iter().copied().map(Some));
            first += count;
        }
        all
    }

    /// The complex shape of a mode; `None` if it moves no beam.
    fn shape(&self, picture: &ModePictures) -> Option<Shape> {
        let phases = picture.frames.len();
        let parts = |k: usize| -> [Complex; 4] {
            let mut parts = [Complex::ZERO; 4];
            for (phase, frame) in picture.frames.iter().enumerate() {
                let turn = Complex::from_polar(2.0 / phases as f64, -TAU * phase as f64 / phases as f64);
                let moved = frame.get(self.before + k).map_or([0.0; 4], |pose| self.moved(k, pose));
                for (part, moved) in parts.iter_mut().zip(moved) {
                    *part += moved * turn;
                }
            }
            parts
        };
        let mut shape: Shape = (0..self.rest.len()).map(parts).collect();
        let largest = |shape: &Shape, components: core::ops::Range<usize>| {
            shape
                .iter()
                .flat_map(|parts| parts[components.clone()].to_vec())
                .max_by(|a, b| a.norm().total_cmp(&b.norm()))
                .unwrap_or(Complex::ZERO)
        };
        let (travel, twist) = (largest(&shape, 0..3), largest(&shape, 3..4));
        let length = self.places.last()? - self.places.first()?;
        let torsional = travel.norm() <= TWISTED * twist.norm() * length.abs();
        let unit = if torsional { twist } else { travel };
        if unit.norm() == 0.0 {
            return None;
        }
        for parts in &mut shape {
            for part in parts.iter_mut() {
                *part /= unit;
            }
            // Twist and travel have no common unit: a mode is seen by one of them.
            if torsional { parts[..3].fill(Complex::ZERO) } else { parts[3] = Complex::ZERO }
        }
        Some(shape)
    }

    /// How far a section has moved from its rest: along x, y, z, and turned about its own axis.
    fn moved(&self, k: usize, pose: &Pose) -> [f64; 4] {
        let rest = &self.rest[k];
        let [x, y, z] = core::array::from_fn(|i| pose.position[i] - rest.position[i]);
        // Columns of a rotation are the axes of the section: the second one tilts towards the third as it twists.
        let column = |of: &Pose, j: usize| [of.rotation[0][j], of.rotation[1][j], of.rotation[2][j]];
        let (second, third) = (column(pose, 1), column(rest, 2));
        [x, y, z, second.iter().zip(third).map(|(a, b)| a * b).sum()]
    }

    /// The bent shapes of the equilibrium across the axis, mm.
    fn rest(&self, scene: &Scene) -> Vec<Panel> {
        let Some(along) = self.along else {
            return Vec::new();
        };
        let across = (0..3).filter(|i| *i != along);
        let bent = across.filter_map(|i| {
            let values: Vec<f64> = self.rest.iter().map(|pose| pose.position[i]).collect();
            let [first, last] = [(self.places[0], values[0]), (*self.places.last()?, *values.last()?)];
            let slope = (last.1 - first.1) / (last.0 - first.0);
            let straight = |place: f64| first.1 + slope * (place - first.0);
            let off = values.iter().zip(&self.places).map(|(value, place)| (value - straight(*place)).abs());
            if off.fold(0.0, f64::max) <= STRAIGHT * scene.size() {
                return None;
            }
            let mut panel = Panel::new(self.axis(), Axis::new(format!("equilibrium, {}", NAMES[i]), "mm"));
            let values = values.iter().map(|value| 1e3 * value);
            panel.curve(Curve::new("", Colour::Black, self.curve(values)));
            panel.fit();
            Some(panel)
        });
        bent.collect()
    }
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}
