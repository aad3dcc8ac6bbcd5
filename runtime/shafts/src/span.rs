//! A part of a shaft between two stations.

use eigentol_numerics::{Complex, Matrix};

use crate::element::{Ends, Node, Shape};
use crate::error::Error;
use crate::motion::Side;
use crate::section::{Coefficients, Line, Number, Section};

/// Which unknown of the stations a motion of an end is, and how many times it; `None` where the end is held.
pub type Place = Option<(usize, f64)>;

/// A part of a shaft between two stations, at which all that is attached to it is.
#[derive(Clone, Debug)]
pub struct Span {
    /// What it does.
    pub line: Line,
    /// Speed at which it turns about its axis, rad/s; of no meaning for a bar.
    pub speed: f64,
    /// Its sections in order, and into how many equal elements each is divided.
    pub sections: Vec<(Section, usize)>,
    /// The motions of its two ends: along `y`, slope of the section in the plane of `x` and `y`, along `z`, slope in the
    /// plane of `x` and `z`; of a bar the first alone. Positive slopes turn about `z` and about `-y`.
    pub ends: [[Place; 4]; 2],
}

impl Span {
    /// A planar motion is the sum of `y + i z` and `y - i z`, which do not mix where the shaft is round.
    pub(crate) fn directions(&self) -> &'static [f64] {
        if self.line == Line::Bar { &[0.0] } else { &[1.0, -1.0] }
    }

    pub(crate) fn components(&self) -> usize {
        if self.line == Line::Bar { 1 } else { 2 }
    }

    pub(crate) fn pieces(&self) -> impl Iterator<Item = usize> + '_ {
        self.sections.iter().enumerate().flat_map(|(k, (_, pieces))| std::iter::repeat_n(k, *pieces))
    }

    /// Which of its different elements each section has, and a section of each.
    pub(crate) fn kinds(&self) -> (Vec<usize>, Vec<usize>) {
        let mut different: Vec<usize> = Vec::new();
        let kind = |k: usize| {
            let element = self.element(k);
            let known = different.iter().position(|&other| self.element(other) == element);
            known.unwrap_or_else(|| {
                different.push(k);
                different.len() - 1
            })
        };
        let own = (0..self.sections.len()).map(kind).collect();
        (own, different)
    }

    /// A section as one of its elements.
    pub(crate) fn element(&self, section: usize) -> Section {
        let (mut own, pieces) = self.sections[section];
        own.length /= pieces as f64;
        own
    }

    /// The unknowns of the stations that its ends move with.
    pub(crate) fn unknowns(&self) -> impl Iterator<Item = usize> + '_ {
        self.ends.iter().flatten().filter_map(|place| Some((*place)?.0))
    }

    /// Those by which its ends deflect in the first plane.
    pub(crate) fn deflections(&self) -> impl Iterator<Item = usize> + '_ {
        self.ends.iter().filter_map(|end| Some(end[0]?.0))
    }

    /// Whether another is of the same kind and moves with the same unknowns.
    pub(crate) fn meets(&self, other: &Self) -> bool {
        self.line == other.line && self.unknowns().any(|own| other.unknowns().any(|unknown| unknown == own))
    }

    /// The sum of what its elements do against moving their ends apart.
    pub(crate) fn stiffness(&self) -> f64 {
        let of_section = |k: usize| {
            let own = self.element(k);
            let one = match self.line {
                Line::Timoshenko => own.shear / own.length,
                Line::Slender => 12.0 * own.stiffness / own.length.powi(3),
                Line::Bar => own.stiffness / own.length,
            };
            self.sections[k].1 as f64 * one
        };
        (0..self.sections.len()).map(of_section).sum()
    }

    /// Its mass, or its moment of inertia where it is one that twists.
    pub(crate) fn mass(&self) -> f64 {
        self.sections.iter().map(|(own, _)| own.mass * own.length).sum()
    }

    /// Its length.
    pub(crate) fn length(&self) -> f64 {
        self.sections.iter().map(|(own, _)| own.length).sum()
    }

    /// The order of what it does at such a frequency against a deflection and against a slope of an end, far from a pole.
    pub(crate) fn usual(&self, s: f64) -> [f64; 2] {
        let length = self.length();
        let stiffness = self.sections.iter().map(|(own, _)| own.stiffness).fold(0.0, f64::max);
        let waves = s * (self.mass() * length / stiffness).sqrt();
        if self.line == Line::Bar {
            return [stiffness / length * (1.0 + waves); 2];
        }
        let waves = (waves * length).sqrt();
        [stiffness / length.powi(3) * (12.0 + waves.powi(3)), stiffness / length * (4.0 + waves)]
    }

    /// Whether the unknowns of a node are its deflection and its slope times half the length.
    pub(crate) fn slope_is_length(&self) -> bool {
        self.line == Line::Slender
    }

    pub(crate) fn shape(&self, section: usize) -> Shape {
        let slope = if self.slope_is_length() { self.element(section).length / 2.0 } else { 1.0 };
        Shape { components: self.components(), slope }
    }

    pub(crate) fn coefficients(&self, section: usize, direction: f64) -> Coefficients {
        self.element(section).coefficients(self.line, direction * self.speed)
    }

    /// The motions of the ends in each direction.
    pub(crate) fn ends_of(&self, stations: &[Complex], side: Side) -> Vec<[Node; 2]> {
        let value = |place: Place| place.map_or(Complex::ZERO, |(index, factor)| stations[index] * factor);
        if self.line == Line::Bar {
            return vec![self.ends.map(|end| [value(end[0]), Complex::ZERO])];
        }
        let turn = |direction: f64| match side {
            Side::Right => (Complex::new(0.0, direction), 1.0),
            Side::Left => (Complex::new(0.0, -direction), 0.5),
        };
        let directions = self.directions().iter().map(|&direction| {
            let (turn, scale) = turn(direction);
            self.ends.map(|end| [0, 1].map(|k| (value(end[k]) + turn * value(end[k + 2])) * scale))
        });
        directions.collect()
    }

    /// Adds the blocks between the ends in a direction to a matrix of the stations.
    pub(crate) fn add_blocks(&self, direction: f64, blocks: &Ends, to: &mut Matrix<Complex>) {
        let c = self.components();
        // planes `y y`, `y z`, `z y`, `z z` of each entry
        let (half, turned) = (0.5, Complex::new(0.0, 0.5 * direction));
        for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            for (a, b) in (0..c).flat_map(|a| (0..c).map(move |b| (a, b))) {
                let entry = blocks[p][q][a][b];
                let mut put = |row: usize, column: usize, value: Complex| {
                    if let (Some((i, left)), Some((j, right))) = (self.ends[p][row], self.ends[q][column]) {
                        to[i][j] += value * (left * right);
                    }
                };
                if c == 1 {
                    put(a, b, entry);
                    continue;
                }
                put(a, b, entry * half);
                put(a, b + 2, entry * turned);
                put(a + 2, b, -entry * turned);
                put(a + 2, b + 2, entry * half);
            }
        }
    }

    /// Adds the loads on the ends in each direction to those on the stations.
    pub(crate) fn add_loads(&self, loads: &[[Node; 2]], side: Side, to: &mut [Complex]) {
        let mut put = |place: Place, load: Complex| {
            if let Some((index, factor)) = place {
                to[index] += load * factor;
            }
        };
        for (direction, loads) in self.directions().iter().zip(loads) {
            for (end, load) in self.ends.iter().zip(loads) {
                if self.line == Line::Bar {
                    put(end[0], load[0]);
                    continue;
                }
                let (turn, scale) = match side {
                    Side::Right => (Complex::new(0.0, -direction), 0.5),
                    Side::Left => (Complex::new(0.0, *direction), 1.0),
                };
                for k in 0..2 {
                    put(end[k], load[k] * scale);
                    put(end[k + 2], turn * load[k] * scale);
                }
            }
        }
    }
}

/// Refuses what is no span.
pub(crate) fn check(index: usize, span: &Span, count: usize) -> Result<(), Error> {
    if span.sections.is_empty() || span.sections.iter().any(|(_, pieces)| *pieces == 0) {
        return Err(Error::NoSections { span: index });
    }
    let used = if span.line == Line::Bar { 1 } else { 4 };
    if span.ends.iter().flat_map(|end| &end[..used]).flatten().any(|(place, _)| *place >= count) {
        return Err(Error::Place { span: index, count });
    }
    let positive: &[Number] = match span.line {
        Line::Timoshenko => &[Number::Length, Number::Stiffness, Number::Shear, Number::Mass],
        Line::Slender | Line::Bar => &[Number::Length, Number::Stiffness, Number::Mass],
    };
    for (section, (own, _)) in span.sections.iter().enumerate() {
        for number in Number::ALL {
            let value = own.number(number);
            if !value.is_finite() || (positive.contains(&number) && value <= 0.0) {
                return Err(Error::Number { span: index, section, number, value });
            }
        }
    }
    Ok(())
}
