//! Random trees and loops with excitations of every kind: each is refused for a reason that a reader understands, or
//! agrees with its explicit twin.

use nalgebra::{Rotation3, Unit};

use crate::forcing::compared::{Random, compare};
use crate::forcing::declared::{Deviation, Frequency, Law, Machine, Motion, V, text, v};

/// Axes as words and vectors.
fn axes() -> Vec<(String, V)> {
    let all = [
        v(1.0, 0.0, 0.0),
        v(0.0, 1.0, 0.0),
        v(0.0, 0.0, 1.0),
        v(-1.0, 0.0, 0.0),
        v(0.0, -1.0, 0.0),
        v(0.0, 0.0, -1.0),
        v(1.0, 2.0, -2.0) / 3.0,
        v(0.6, 0.0, 0.8),
        v(0.0, -0.8, 0.6),
    ];
    all.into_iter().map(|axis| (text(axis), axis)).collect()
}

/// A body as others see it.
struct Seat {
    name: String,
    /// Its axes in those of the ground, with all coordinates at zero.
    axes: Rotation3<f64>,
    /// The axis, in the ground's axes, about which it is turned.
    turned: Option<V>,
}

struct Builder {
    random: Random,
    machine: Machine,
    seats: Vec<Seat>,
    /// Running coordinates.
    running: Vec<String>,
    free: Vec<String>,
}

fn seated(seat: &Seat) -> bool {
    seat.turned.is_none()
}

impl Builder {
    fn new(seed: u64) -> Self {
        let ground = Seat { name: "ground".into(), axes: Rotation3::identity(), turned: None };
        Self {
            random: Random::new(seed),
            machine: Machine { kernels_only: true, ..Machine::default() },
            seats: vec![ground],
            running: Vec::new(),
            free: Vec::new(),
        }
    }

    fn vector(&mut self, size: f64) -> V {
        v(self.random.number(), self.random.number(), self.random.number()) * size
    }

    fn frequency(&mut self) -> Frequency {
        if !self.running.is_empty() && self.random.chance(50) {
            let drive = self.random.one_of(&self.running);
            return Frequency::Order(1.0 + self.random.below(3) as f64 / 2.0, drive);
        }
        Frequency::Own(3.0 + 2.0 * self.random.number())
    }

    /// A placement on the `from` side, and its rotation.
    fn placement(&mut self, on: Option<&str>) -> (String, Rotation3<f64>) {
        let at = self.vector(0.5);
        let (_, axis) = self.random.one_of(&axes());
        let angle = match self.random.chance(30) {
            true => self.random.number(),
            false => 0.0,
        };
        let turn = Rotation3::from_axis_angle(&Unit::new_normalize(axis), angle);
        let on = on.map_or(String::new(), |body| format!(" on {body}"));
        let turned = match angle == 0.0 {
            true => String::new(),
            false => format!(" rotated({}, {angle:?} rad)", text(axis)),
        };
        (format!("at {} m{turned}{on}", text(at)), turn)
    }

    /// Ends of a joint, which may lead from the body to its parent; the body's axes.
    fn ends(&mut self, parent: usize, body: &str) -> (String, bool, Rotation3<f64>, Rotation3<f64>) {
        let reversed = self.random.chance(30);
        let name = self.seats[parent].name.clone();
        let (placement, turn) = self.placement(reversed.then_some(&name));
        let joint = self.seats[parent].axes * turn;
        let ends = match reversed {
            false => format!("from {name} to {body} {placement}"),
            true => format!("from {body} to {name}, {placement}"),
        };
        (ends, reversed, joint, joint)
    }

    fn motion(&mut self) -> Motion {
        if self.random.chance(75) {
            return Motion::Free;
        }
        let quantity = self.random.one_of(&["amplitude", "velocity", "acceleration"]);
        let amplitude = 0.2 + 0.1 * self.random.number();
        Motion::Shaken(quantity, amplitude, self.frequency(), self.random.number())
    }

    /// A body on joints that do not run.
    fn link(&mut self, k: usize) {
        let parent = self.random.below(self.seats.len());
        let name = format!("link{k}");
        let center = self.vector(0.3);
        self.machine.body(&name, "box(mass: 2 kg, size: [0.5, 0.7, 0.4] m)", center);
        let (ends, _, axes_of_body, _) = self.ends(parent, &name);
        let (a, _) = self.random.one_of(&axes());
        let tilted = self.random.one_of(&["x", "y", "[3, 0, 4]", "[0, -1, 1]"]);
        let (kind, names): (String, Vec<String>) = match self.random.below(6) {
            0 | 1 => (format!("revolute({a})"), vec![format!("j{k}")]),
            2 => (format!("prismatic({a})"), vec![format!("/j{k}")]),
            3 => (format!("cylindrical(j{k}s: {a}, j{k}t: {a})"), vec![format!("/j{k}s"), format!("j{k}t")]),
            4 => (format!("universal(j{k}a: z, j{k}b: {tilted})"), vec![format!("j{k}a"), format!("j{k}b")]),
            _ => (
                format!("spherical(j{k}a: z, j{k}b: y, j{k}c: x)"),
                vec![format!("j{k}a"), format!("j{k}b"), format!("j{k}c")],
            ),
        };
        let coordinates: Vec<(&str, Motion)> = names.iter().map(|name| (name.as_str(), self.motion())).collect();
        let single = names.len() == 1;
        let joint = if single { names[0].trim_start_matches('/').to_owned() } else { format!("joint{k}") };
        self.machine.joint(&format!("joint {joint}: {kind} {ends}"), &coordinates);
        for (name, motion) in &coordinates {
            if let Motion::Free = motion {
                let name = name.trim_start_matches('/');
                self.free.push(name.to_owned());
            }
        }
        if single
            && a.contains("1.0, 0.0, 0.0")
            && let Motion::Shaken(..) = coordinates[0].1
        {
            let function = if names[0].starts_with('/') { "force" } else { "moment" };
            let sign = if a.contains('-') { "-" } else { "" };
            self.machine.reaction(&format!("{sign}reaction_{function}({joint}).x"), &joint);
        }
        let turned = self.seats[parent].turned;
        self.seats.push(Seat { name, axes: axes_of_body, turned });
    }

    /// A body of revolution that turns about its axis, perhaps with another on it.
    fn rotor(&mut self, k: usize) {
        // on the ground nothing feels it
        let parent = match self.random.chance(90) {
            true => 1 + self.random.below(self.seats.len() - 1),
            false => 0,
        };
        let name = format!("rotor{k}");
        let (word, axis) = self.random.one_of(&axes());
        let (ends, reversed, axes_of_body, _) = self.ends(parent, &name);
        let sense = if reversed { -axis } else { axis };
        let along = axis * 0.3 * self.random.number();
        let shape = match self.random.chance(50) {
            true => format!("disk(mass: 2 kg, radius: 0.4 m, axis: {word})"),
            false => format!("cylinder(mass: 2 kg, radius: 0.3 m, length: 0.6 m, axis: {word})"),
        };
        self.machine.rotor(&name, &shape, along, sense);
        let speed = 4.0 + 2.0 * self.random.number();
        let motion = match self.random.chance(70) {
            true => Motion::Driven(if self.random.chance(50) { speed } else { -speed }),
            false => Motion::Coasting,
        };
        let coasts = matches!(motion, Motion::Coasting);
        let coordinate = format!("spin{k}");
        self.machine.joint(&format!("joint {coordinate}: revolute({word}) {ends}"), &[(&coordinate, motion)]);
        if word.contains("1.0, 0.0, 0.0") && !coasts {
            let sign = if word.contains('-') { "-" } else { "" };
            let moment = format!("{sign}reaction_moment({coordinate}).x");
            self.machine.reaction(&moment, &coordinate);
        }
        let turned = axes_of_body * sense;
        self.seats.push(Seat { name: name.clone(), axes: axes_of_body, turned: Some(turned) });
        self.running.push(coordinate);
        if self.random.chance(25) {
            self.carried(k, &name, &word, sense, turned);
        }
    }

    /// A body on a rotor: it twists about the same axis, or slides along it.
    fn carried(&mut self, k: usize, on: &str, word: &str, axis: V, turned: V) {
        let name = format!("hub{k}");
        let (kind, slides) = self.random.one_of(&[("revolute", ""), ("prismatic", "/")]);
        let along = axis * 0.2;
        self.machine.rotor(&name, &format!("disk(mass: 1 kg, radius: 0.4 m, axis: {word})"), along, axis);
        self.machine.joint(
            &format!("joint twist{k}: {kind}({word}) from {on} to {name}"),
            &[(&format!("{slides}twist{k}"), Motion::Free)],
        );
        self.free.push(format!("twist{k}"));
        let axes = self.seats.last().expect("the rotor").axes;
        self.seats.push(Seat { name, axes, turned: Some(turned) });
    }

    fn excite(&mut self) {
        for k in 1..self.seats.len() {
            let seat = &self.seats[k];
            let (name, turned) = (seat.name.clone(), seat.turned);
            let Some(turned) = turned else { continue };
            let axis = seat.axes.inverse() * turned;
            // components that vanish but for rounding
            let axis = axis.map(|x| if x.abs() < 1e-15 { 0.0 } else { x });
            let body = self.machine.bodies.iter_mut().find(|body| body.name == name);
            let body = body.expect("declared");
            if body.axis.is_none() {
                body.axis = Some(axis);
            }
            for _ in 0..1 + self.random.below(2) {
                let at = self.vector(0.5);
                let deviation = self.random.one_of(&[Deviation::Amount(at), Deviation::Eccentricity, Deviation::Tilt]);
                let size = 0.2 + 0.1 * self.random.number();
                let angle = 3.0 * self.random.number();
                self.machine.unbalance(&name, deviation, size, angle);
            }
        }
        let none = self.machine.excitations.is_empty();
        if (none || self.random.chance(50)) && !self.free.is_empty() {
            let on = self.random.one_of(&self.free);
            let (frequency, phase) = (self.frequency(), self.random.number());
            self.machine.excite(Law::On(on, 2.0), frequency, phase);
        }
        let still: Vec<String> = self.still();
        if self.random.chance(50) && still.len() > 1 {
            let body = self.random.one_of(&still[1..]);
            let (at, force, moment) = (self.vector(0.5), self.vector(3.0), self.vector(3.0));
            self.machine.other(&format!("point pushed: {body} at {} m;", text(at)));
            let (frequency, phase) = (self.frequency(), self.random.number());
            self.machine.excite(Law::Load("pushed".into(), force, moment), frequency, phase);
            self.machine.output("position(pushed).x");
        }
    }

    /// Names of bodies that nothing turns.
    fn still(&self) -> Vec<String> {
        let seats = self.seats.iter().filter(|seat| seated(seat));
        seats.map(|seat| seat.name.clone()).collect()
    }

    /// Springs, dampers, and what closes loops.
    fn forces(&mut self) {
        if self.random.chance(60) {
            self.machine.other("gravity [1, 2, -9] m/s^2;");
        }
        for (k, free) in self.free.clone().iter().enumerate() {
            let slides = self.machine.coordinate(free).is_some_and(|x| x.slides);
            let unit = if slides { "N*s/m" } else { "N*m*s/rad" };
            if self.random.chance(30) {
                self.machine.other(&format!("force c{k}: damper(on: {free}, damping: 2 {unit});"));
            }
        }
        let still = self.still();
        for k in 0..2 {
            let (one, other) = (self.random.one_of(&still), self.random.one_of(&still));
            if one == other {
                continue;
            }
            let (at, to) = (self.vector(0.5), self.vector(2.0));
            self.machine
                .other(&format!("point from{k}: {one} at {} m;", text(at)))
                .other(&format!("point to{k}: {other} at {} m;", text(to)));
            let item = match self.random.below(4) {
                0 => format!("constraint tie{k}: distance(from: from{k}, to: to{k}, length: 2 m);"),
                1 => format!("constraint tie{k}: coincident(from: from{k}, to: to{k}, along: x);"),
                2 => format!(
                    "joint tie{k}: spherical(t{k}a: z, t{k}b: y, t{k}c: x) from {one} to {other} at {} m, cut;",
                    text(at)
                ),
                _ => format!(
                    "force tie{k}: spring_damper(from: from{k}, to: to{k}, stiffness: 30 N/m, damping: 2 N*s/m, length: 1 m);"
                ),
            };
            self.machine.other(&item);
            self.machine.output(&format!("position(from{k}).y"));
        }
    }
}

pub(crate) fn machine(seed: u64) -> Machine {
    let mut builder = Builder::new(seed);
    let links = 1 + builder.random.below(3);
    let rotors = builder.random.below(3);
    for k in 0..links {
        builder.link(k);
    }
    for k in 0..rotors {
        builder.rotor(k);
    }
    if builder.random.chance(20) {
        builder.link(links);
    }
    builder.forces();
    builder.excite();
    builder.machine
}

/// Parts of the messages for what such machines may do wrong.
const REASONS: [&str; 9] = [
    "so there is no steady state",
    "shakes nothing",
    "so they have more than one frequency",
    "are not harmonic in the angle",
    "it is a constant load, not an excitation",
    "so its vibration is not harmonic",
    "and is not constant in steady motion",
    "no coordinate changes what",
    "is free to move",
];

#[test]
fn random_machines() {
    machines_agree(160);
}

#[test]
#[ignore = "half a minute"]
fn many_random_machines() {
    machines_agree(480);
}

fn machines_agree(machines: u64) {
    let (mut agreed, mut excited, mut refused) = (0, 0_u64, 0);
    for seed in 0..machines {
        let machine = machine(seed);
        match compare(&machine, seed) {
            Ok(outcome) => {
                agreed += 1;
                excited += u64::from(outcome.excited > 0);
            }
            Err(mistakes) => {
                refused += 1;
                let known = REASONS.iter().any(|reason| mistakes.contains(reason));
                assert!(known, "{seed}: {mistakes}\n{}", machine.excited());
            }
        }
    }
    assert!(12 * excited >= 5 * machines, "{agreed} {excited} {refused}");
}
