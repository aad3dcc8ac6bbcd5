//! The stations of shafts that are used, with their coordinates, and what is between them.

use proc_macro2::Ident;

use super::super::beams::declared::Stations;
use super::super::placements::unplaced;
use super::super::resolver::Resolver;
use super::declared::{Declared, Section};
use crate::base::ids::{BodyId, CoordinateId, JointId};
use crate::base::names::joined;
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::{
    Body, Coordinate, CoordinateQuantity, Force, ForceLaw, Frame, Joint, JointStep, LUMPED, Line, Motion, NUMBERS,
    Placement, Shaft, ShaftStation, Span, StepMotion,
};
use crate::model::simplify::{add, dot, multiply, power_integer};

/// The numbers of a section of a line.
type Numbers = [Expr; NUMBERS];

/// Which coordinates of a station are the motions of an end, and with which factors.
type Motions = &'static [(usize, f64)];

/// The names of the coordinates of a station, their axes, and whether they turn. The order is that of their motions.
const MOTIONS: [(&str, usize, bool); 6] = [
    ("y", 1, false),
    ("z", 2, false),
    ("turn_y", 1, true),
    ("turn_z", 2, true),
    ("stretch", 0, false),
    ("twist", 0, true),
];

/// The most of the length between two stations times the root of tension over stiffness against bending: what one end does to the
/// other falls with its exponential.
const TENSE: f64 = 8.0;

/// The most elements of what bends within a radius of gyration of its sections, of which a solid round shaft has four to its
/// diameter. Shorter ones are so stiff that rounding hides slow modes; a shaft has so many in any case, as far as it is not
/// told to have fewer.
const FINEST: f64 = 2.0;
const FEWEST: f64 = 4.0;

/// Where a station is.
pub(in crate::model::resolve) struct Standing<'a> {
    /// Of the body with stations.
    pub(in crate::model::resolve) name: &'a Ident,
    pub(in crate::model::resolve) place: usize,
    /// How it is counted in names.
    pub(in crate::model::resolve) number: usize,
    pub(in crate::model::resolve) base: Frame,
    pub(in crate::model::resolve) body: BodyId,
    /// In the base.
    pub(in crate::model::resolve) offset: Vector,
}

impl Resolver<'_> {
    /// The shafts, whose stations `bodies` holds already, from the given one on; joints, coordinates and what the shafts do
    /// at rest are added.
    pub(in crate::model::resolve) fn shafts(
        &mut self,
        stations: &Stations,
        first: usize,
        bodies: &[Body],
        joints: &mut Vec<Joint>,
        forces: &mut Vec<Force>,
        gravity: &Vector,
    ) -> Vec<Shaft> {
        let mut shafts = Vec::new();
        for (index, name, declared) in stations.shafts() {
            let Some(root) = bodies.iter().position(|body| body.name == *name) else { continue };
            let mut places: Vec<(usize, BodyId)> = stations
                .used
                .iter()
                .enumerate()
                .filter(|(_, (of, _))| *of == index)
                .map(|(k, (_, place))| (*place as usize, BodyId::new(first + k)))
                .collect();
            places.push((0, BodyId::new(root)));
            places.sort_by_key(|(place, _)| *place);
            let stations: Vec<ShaftStation> =
                places.iter().map(|&at| self.shaft_station(name, declared, at, bodies, joints)).collect();
            let mut spans = Vec::new();
            for ends in stations.windows(2) {
                spans.extend(self.spans(name, declared, [&ends[0], &ends[1]], gravity, forces));
            }
            let weight =
                |section: &Section| [section.length.clone(), multiply(section.mass.clone(), section.length.clone())];
            shafts.push(Shaft {
                name: name.clone(),
                axes: declared.axes.clone(),
                speed: declared.speed.clone(),
                weights: declared.between(0, declared.last()).map(weight).collect(),
                outline: declared.outline(&stations, |length| self.nominal_of(length)),
                stations,
                spans,
                positive: declared.positive.clone(),
            });
        }
        shafts
    }

    fn shaft_station(
        &mut self,
        name: &Ident,
        declared: &Declared,
        (place, body): (usize, BodyId),
        bodies: &[Body],
        joints: &mut Vec<Joint>,
    ) -> ShaftStation {
        let [bends, twists, stretches] = [declared.bending.is_some(), declared.twists, declared.stretches];
        let has = [bends, bends, bends, bends, stretches, twists];
        let motions = std::array::from_fn(|k| {
            let (word, axis, turns) = MOTIONS[k];
            has[k].then(|| (word, declared.axes[axis].clone(), turns))
        });
        let arm = declared.between(0, place).fold(Expr::Number(0.0), |arm, section| add(arm, section.length.clone()));
        let along = &declared.axes[0];
        let offset = std::array::from_fn(|k| add(declared.origin[k].clone(), multiply(arm.clone(), along[k].clone())));
        let standing = Standing { name, place, number: place, base: Frame::Ground, body, offset };
        self.station_with(standing, motions, bodies, joints)
    }

    /// A station with these motions: their names, directions, and whether they turn.
    pub(in crate::model::resolve) fn station_with(
        &mut self,
        standing: Standing<'_>,
        motions: [Option<(&str, Vector, bool)>; 6],
        bodies: &[Body],
        joints: &mut Vec<Joint>,
    ) -> ShaftStation {
        let Standing { name, place, number, base, body, offset } = standing;
        let joint = JointId::new(joints.len());
        let mut coordinates = [None; 6];
        let mut steps = Vec::new();
        for (slot, (word, axis, turns)) in
            coordinates.iter_mut().zip(motions).filter_map(|(slot, own)| Some((slot, own?)))
        {
            let id = CoordinateId::new(self.declared_coordinates.len());
            let named = joined(&joined(&name.to_string(), word), &number.to_string());
            let (motion, quantity) = match turns {
                true => (StepMotion::Turn, CoordinateQuantity::Angle),
                false => (StepMotion::Slide, CoordinateQuantity::Displacement),
            };
            self.declared_coordinates.push(Coordinate {
                name: Ident::new(&named, name.span()),
                joint,
                quantity,
                motion: Motion::Free,
            });
            *slot = Some(id);
            steps.push(JointStep { motion, axis, coordinate: id });
        }
        joints.push(Joint {
            name: bodies[body.index()].name.clone(),
            word: "station",
            closing: None,
            steps,
            from: base,
            to: Frame::Body(body),
            from_placement: Placement { offset, rotations: Vec::new() },
            to_placement: unplaced(),
            cut: false,
            flexure: None,
        });
        ShaftStation { place, body, joint, coordinates }
    }

    /// What is between two stations, with what it does at rest.
    fn spans(
        &mut self,
        name: &Ident,
        declared: &Declared,
        ends: [&ShaftStation; 2],
        gravity: &Vector,
        forces: &mut Vec<Force>,
    ) -> Vec<Span> {
        let between = || declared.between(ends[0].place, ends[1].place);
        let zero = || Expr::Number(0.0);
        let lag = &declared.lag;
        let mut lines: Vec<(Line, Motions, Vec<Numbers>)> = Vec::new();
        let numbers = |of: &dyn Fn(&Section) -> [Expr; 6]| -> Vec<Numbers> {
            let row = |own: &Section| {
                let [stiffness, shear, mass, rotary, tension, drag] = of(own);
                [own.length.clone(), stiffness, shear, mass, rotary, lag.clone(), tension, drag]
            };
            between().map(row).collect()
        };
        if let Some(line) = declared.bending {
            let of = |own: &Section| {
                let [bending, shear, mass, rotary] =
                    [&own.bending, &own.shear, &own.mass, &own.rotary].map(Clone::clone);
                [bending, shear, mass, rotary, declared.tension.clone(), declared.drag.clone()]
            };
            lines.push((line, &[(0, 1.0), (3, 1.0), (1, 1.0), (2, -1.0)], numbers(&of)));
        }
        if declared.stretches {
            let of = |own: &Section| [own.stretch.clone(), zero(), own.mass.clone(), zero(), zero(), zero()];
            lines.push((Line::Bar, &[(4, 1.0)], numbers(&of)));
        }
        if declared.twists {
            let of = |own: &Section| [own.twist.clone(), zero(), own.polar.clone(), zero(), zero(), zero()];
            lines.push((Line::Bar, &[(5, 1.0)], numbers(&of)));
        }
        let nominal = |own: &Section| self.nominal_of(&own.length);
        let total: f64 = declared.between(0, declared.last()).map(nominal).sum();
        let all = declared.elements as f64;
        let count = |most: f64, own: &Section| ((most * nominal(own) / total - 1e-9).ceil() as usize).max(1);
        let within_gyration = |own: &Section| {
            let gyration = (self.nominal_of(&own.rotary) / self.nominal_of(&own.mass)).sqrt();
            count(all.min(f64::max(FEWEST, FINEST * total / gyration)), own)
        };
        let of_bars: Vec<usize> = between().map(|own| prime_from(count(all, own))).collect();
        let of_bending: Vec<usize> = between().map(within_gyration).collect();
        let [first, last] = ends.map(|end| end.place);
        let stiffened = |own: &Section| {
            let [tension, bending] = [&declared.tension, &own.bending].map(|x| self.nominal_of(x));
            nominal(own) * (tension / bending).max(0.0).sqrt()
        };
        if declared.bending.is_some() && between().map(stiffened).sum::<f64>() > TENSE {
            let message =
                format!("`{name}` bends too little under its tension between its stations {first} and {last}");
            let help = "divide the sections between them into more rows, with a point at a station between: `point p: rotor at station 1`";
            self.diagnostics.error_with_help(name, message, help);
        }
        let mut spans = Vec::new();
        for (line, motions, sections) in lines {
            let elements = if line == Line::Bar { of_bars.clone() } else { of_bending.clone() };
            // Each number is computed once for everything that uses it.
            let sections: Vec<Numbers> =
                sections.into_iter().map(|row| row.map(|number| self.shared_of_shaft(name, number))).collect();
            let of_end = |end: &ShaftStation| {
                motions.iter().filter_map(|(k, factor)| Some((end.coordinates[*k]?, *factor))).collect()
            };
            let span = Span { line, speed: declared.speed.clone(), sections, elements, ends: ends.map(of_end) };
            let along = if motions[0].0 == 5 { None } else { Some(motions[0].0) };
            let weight = match (line, along) {
                (Line::Bar, None) => [zero(), zero()],
                (Line::Bar, _) => [dot(gravity, &declared.axes[0]), zero()],
                _ => [1, 2].map(|axis| dot(gravity, &declared.axes[axis])),
            };
            let mut laws = self.at_rest(name, &span, weight);
            laws.extend(self.lumped(name, &span));
            if line != Line::Bar && declared.torque != zero() {
                laws.push(self.under_torque(name, &span, &declared.torque));
            }
            forces.extend(laws.into_iter().map(|law| Force { name: name.clone(), law, of_every: true }));
            spans.push(span);
        }
        spans
    }

    /// Half the inertia of a span at each end, so that all its coordinates move some in the equations that are compiled. The
    /// run time takes the same away again ([`LUMPED`]).
    fn lumped(&mut self, name: &Ident, span: &Span) -> Vec<ForceLaw> {
        let [mut length, mut mass, mut rotary] = [(); 3].map(|()| Expr::Number(0.0));
        for section in &span.sections {
            let part = |k: usize| multiply(section[k].clone(), section[0].clone());
            [length, mass, rotary] = [add(length, section[0].clone()), add(mass, part(3)), add(rotary, part(4))];
        }
        let turned = multiply(mass.clone(), multiply(Expr::Number(LUMPED), power_integer(length, 2)));
        let half = |x: Expr| multiply(Expr::Number(0.5), x);
        let both = [half(mass), half(add(rotary, turned))].map(|x| self.shared_of_shaft(name, x));
        let ends = span.ends.iter().flat_map(|end| end.iter().enumerate());
        ends.map(|(k, (coordinate, _))| ForceLaw::CoordinateInerter {
            coordinates: [*coordinate; 2],
            inertance: both[k % 2].clone(),
        })
        .collect()
    }

    pub(super) fn shared_of_shaft(&mut self, name: &Ident, value: Expr) -> Expr {
        match value {
            Expr::Number(_) | Expr::Design(_) | Expr::Input(_) | Expr::Constant(_) => value,
            value => {
                let name = Ident::new(&joined(&name.to_string(), "section"), name.span());
                self.shared(name, value)
            }
        }
    }
}

/// The first prime number from this one on, or one: at a frequency of a uniform bar that has so many elements no part of it vibrates
/// between two of its nodes that stand still, which could not be eliminated.
fn prime_from(least: usize) -> usize {
    let is_prime = |n: &usize| (2..*n).all(|k| !n.is_multiple_of(k));
    (least..).find(is_prime).unwrap_or(least)
}
