//! Beams at random places of random machines, with special cases on purpose.

use std::thread;

use eigentol_oracle::random::Random;

use crate::flexible::judged::{Machine, judge};

/// Writes one machine after another; each is a function of its number.
struct Writer {
    random: Random,
    lines: Vec<String>,
    names: usize,
    /// What turns about z at a constant speed has no gravity across z.
    spins: bool,
}

/// A cross-section as arguments of a beam, and what a beam of it can do.
struct Section {
    text: String,
    twists: bool,
    shears: bool,
    round: bool,
    couples: bool,
}

/// A place to which something can be attached: what precedes `to` in a joint, and what follows the name of a point.
#[derive(Clone)]
struct Place {
    from: String,
    point: String,
}

fn vector([x, y, z]: [f64; 3]) -> String {
    format!("[{x:?}, {y:?}, {z:?}]")
}

impl Writer {
    fn new(seed: u64) -> Self {
        let mut random = Random::new(seed);
        let spins = random.chance(0.4);
        Self { random, lines: Vec::new(), names: 0, spins }
    }

    fn name(&mut self, what: &str) -> String {
        self.names += 1;
        format!("{what}{}", self.names)
    }

    fn number(&mut self, low: f64, high: f64) -> f64 {
        self.random.between(low, high)
    }

    /// A positive number with a unit: as such, or a design variable.
    fn quantity(&mut self, low: f64, high: f64, unit: &str) -> String {
        let value = format!("{:?} {unit}", self.number(low, high));
        if self.random.chance(0.7) {
            return value;
        }
        let name = self.name("b");
        self.lines.push(format!("design {name} = {value};"));
        name
    }

    fn placement(&mut self) -> String {
        let mut text = String::new();
        if self.random.chance(0.5) {
            let offset = self.random.vector(0.3);
            text += &format!(" at {} m", vector(offset));
        }
        if self.random.chance(0.5) {
            let axis = self.axis();
            let angle = self.number(-2.0, 2.0);
            text += &format!(" rotated({axis}, {angle:?} rad)");
        }
        text
    }

    fn axis(&mut self) -> String {
        let axes = ["x", "y", "z", "-y", "[1, 2, 2]", "[0, 3, 4]", "[-2, 1, 0.5]"];
        self.random.of(&axes).to_owned()
    }

    /// Something that carries the beam: the ground, or a body on a joint.
    fn carrier(&mut self) -> Place {
        let ground = Place { from: "ground".to_owned(), point: "ground at [0.3, -0.2, 0.5] m".to_owned() };
        if self.spins {
            let hub = self.name("hub");
            self.lines.push(format!("body {hub}: massless;"));
            let joint = self.name("spin");
            self.lines.push(format!("joint {joint}: revolute(z) from ground to {hub}, driven at omega;"));
            return Place { point: format!("{hub} at [0.3, -0.2, 0.5] m"), from: hub };
        }
        if self.random.chance(0.3) {
            return ground;
        }
        let carrier = self.name("carrier");
        let mass = self.quantity(0.5, 2.0, "kg");
        self.lines
            .push(format!("body {carrier}: box(mass: {mass}, size: [0.2, 0.3, 0.4] m, center: [0.1, 0, 0.05] m);"));
        self.joint("ground", &carrier);
        Place { point: format!("{carrier} at [0.3, -0.2, 0.5] m"), from: carrier }
    }

    /// A joint of some kind with springs on its coordinates.
    fn joint(&mut self, from: &str, to: &str) {
        let placement = self.placement();
        let name = self.name("joint");
        let axis = self.axis();
        let [a, b, c, d, e, f] = [(); 6].map(|()| self.name("q"));
        let (kind, angles, slides): (String, Vec<String>, Vec<String>) = match self.random.below(7) {
            0 => ("fixed".to_owned(), vec![], vec![]),
            1 => (format!("revolute({axis})"), vec![name.clone()], vec![]),
            2 => (format!("prismatic({axis})"), vec![], vec![name.clone()]),
            3 => (format!("universal({a}: x, {b}: [0, 1, 0.3])"), vec![a, b], vec![]),
            4 => (format!("spherical({a}: x, {b}: y, {c}: z)"), vec![a, b, c], vec![]),
            5 => (format!("screw({axis}, lead: 0.3 m)"), vec![name.clone()], vec![]),
            _ => (format!("free({a}: x, {b}: y, {c}: z, {d}: x, {e}: y, {f}: z)"), vec![d, e, f], vec![a, b, c]),
        };
        self.lines.push(format!("joint {name}: {kind} from {from} to {to}{placement};"));
        for (coordinates, unit) in [(angles, "N*m/rad"), (slides, "N/m")] {
            for coordinate in coordinates {
                let stiffness = self.quantity(20.0, 80.0, unit);
                let spring = self.name("spring");
                self.lines.push(format!("force {spring}: spring(on: {coordinate}, stiffness: {stiffness});"));
            }
        }
    }

    fn section(&mut self) -> Section {
        let section =
            |text: &str| Section { text: text.to_owned(), twists: true, shears: true, round: false, couples: false };
        match self.random.below(9) {
            0 => {
                let values = [
                    self.quantity(0.3, 1.0, "kg/m"),
                    self.quantity(5.0, 20.0, "N*m^2"),
                    self.quantity(5.0, 20.0, "N*m^2"),
                    self.quantity(5.0, 20.0, "N*m^2"),
                    self.quantity(20.0, 60.0, "N"),
                    self.quantity(20.0, 60.0, "N"),
                    self.quantity(20.0, 60.0, "N"),
                ];
                let [mass, y, z, torsion, axial, shear_y, shear_z] = values;
                section(&format!(
                    "mass_per_length: {mass}, stiffness_y: {y}, stiffness_z: {z}, \
                     torsion_stiffness: {torsion}, inertia_y: 0.01 kg*m, inertia_z: 0.03 kg*m, \
                     axial_stiffness: {axial}, shear_stiffness_y: {shear_y}, shear_stiffness_z: {shear_z}"
                ))
            }
            // equal stiffnesses, inertia only about one axis
            1 => section(
                "mass_per_length: 0.7 kg/m, stiffness_y: 12 N*m^2, stiffness_z: 12 N*m^2, \
                 torsion_stiffness: 12 N*m^2, inertia_y: 0.02 kg*m, axial_stiffness: 40 N, \
                 shear_stiffness_y: 40 N, shear_stiffness_z: 40 N",
            ),
            2 => {
                let (w, h) = (self.quantity(30.0, 60.0, "mm"), self.quantity(8.0, 20.0, "mm"));
                let taper = match self.random.chance(0.5) {
                    true => " to rectangle(width: 20 mm, height: 30 mm)",
                    false => "",
                };
                section(&format!(
                    "section: rectangle(width: {w}, height: {h}){taper}, density: 2700 kg/m^3, \
                     modulus: 70 MPa, shear_modulus: 26 MPa"
                ))
            }
            3 => Section {
                round: true,
                ..section(
                    "section: tube(outer: 20 mm, inner: 17 mm) to tube(outer: 12 mm, inner: 8 mm), \
                     density: 7850 kg/m^3, modulus: 210 MPa, poisson: 0.3",
                )
            },
            4 => section(
                "section: section(mass: 0.5 kg/m, EIy: 4 N*m^2, EIz: 30 N*m^2, GJ: 15 N*m^2, \
                 inertia_z: 0.02 kg*m, EA: 70 N, GAy: 60 N, GAz: 30 N) to section(mass: 0.2 kg/m, EIy: 2 N*m^2, \
                 EIz: 9 N*m^2, GJ: 5 N*m^2, EA: 40 N, GAy: 50 N, GAz: 40 N)",
            ),
            5 => Section {
                twists: false,
                shears: false,
                round: true,
                ..section("section: circle(radius: 10 mm), density: 7850 kg/m^3, modulus: 210 MPa")
            },
            6 => {
                let mass = self.quantity(0.3, 1.0, "kg/m");
                let stiffness = self.stiffness();
                Section {
                    couples: true,
                    ..section(&format!(
                        "mass_per_length: {mass}, stiffness: {stiffness}, inertia_y: 0.01 kg*m, inertia_z: 0.03 kg*m"
                    ))
                }
            }
            7 => {
                let inertia = "inertia_y: 0.01 kg*m, inertia_z: 0.02 kg*m";
                let root = self.stiffness();
                let tip = match self.random.chance(0.3) {
                    true => "EA: 30 N, GAy: 40 N, GAz: 25 N, GJ: 7 N*m^2, EIy: 6 N*m^2, EIz: 9 N*m^2".to_owned(),
                    false => format!("stiffness: {}", self.stiffness()),
                };
                Section {
                    couples: true,
                    ..section(&format!(
                        "section: section(mass: 0.5 kg/m, stiffness: {root}, {inertia}) \
                         to section(mass: 0.3 kg/m, {tip}, {inertia})"
                    ))
                }
            }
            // a stubby shaft
            _ => {
                let values = [
                    self.quantity(0.3, 1.0, "kg/m"),
                    self.quantity(5.0, 20.0, "N*m^2"),
                    self.quantity(0.02, 0.1, "kg*m"),
                    self.quantity(20.0, 60.0, "N"),
                ];
                let [mass, stiffness, inertia, shear] = values;
                Section {
                    round: true,
                    ..section(&format!(
                        "mass_per_length: {mass}, stiffness_y: {stiffness}, stiffness_z: {stiffness}, \
                         torsion_stiffness: 8 N*m^2, inertia_y: {inertia}, inertia_z: {inertia}, \
                         axial_stiffness: 50 N, shear_stiffness_y: {shear}, shear_stiffness_z: {shear}"
                    ))
                }
            }
        }
    }

    /// A matrix of stiffness that couples all strains a little, or some strongly. What couples two is well below the
    /// geometric mean of their own, also where design variables change.
    fn stiffness(&mut self) -> String {
        let own = [60.0, 40.0, 20.0, 9.0, 5.0, 15.0].map(|x| x * self.number(0.8, 1.2));
        let all = [(0, 3), (0, 4), (0, 5), (1, 2), (1, 3), (1, 5), (2, 4), (3, 4), (3, 5), (4, 5)];
        let some = [(); 2].map(|()| self.random.of(&all));
        let is_full = self.random.chance(0.5);
        let mut rows = [(); 6].map(|()| [(); 6].map(|()| String::new()));
        for i in 0..6 {
            for j in 0..=i {
                let share = match i == j {
                    true => 1.0,
                    false if is_full => self.number(-0.15, 0.15),
                    false if some.contains(&(j, i)) => self.random.signed(0.38),
                    false => 0.0,
                };
                let unit = ["N", "N*m", "N*m^2"][i / 3 + j / 3];
                let entry = self.entry(share * (own[i] * own[j]).sqrt(), unit);
                (rows[i][j], rows[j][i]) = (entry.clone(), entry);
            }
        }
        let rows = rows.map(|row| format!("[{}]", row.join(", ")));
        format!("[{}]", rows.join(", "))
    }

    /// A number without its unit, or a design variable with its sign.
    fn entry(&mut self, number: f64, unit: &str) -> String {
        if number == 0.0 || self.random.chance(0.9) {
            return format!("{number:?}");
        }
        let name = self.name("b");
        let (size, sign) = (number.abs(), if number < 0.0 { "-" } else { "" });
        self.lines.push(format!("design {name} = {size:?} {unit};"));
        format!("{sign}{name}")
    }

    /// Angles by which the axis is turned at the tip, as further arguments.
    fn prebend(&mut self) -> String {
        let which = self.random.below(3);
        let mut text = String::new();
        for (k, name) in [(0, "prebend_y"), (1, "prebend_z")] {
            if which == k || which == 2 {
                let sign = self.random.of(&["", "-"]);
                let angle = self.quantity(0.2, 1.1, "rad");
                text += &format!(", {name}: {sign}{angle}");
            }
        }
        text
    }

    /// Coordinates of strain, as further arguments.
    fn strains(&mut self, may_be_static: bool) -> String {
        let mut text = match self.random.below(4) {
            0 if may_be_static => ", shear: static".to_owned(),
            1 => format!(", shear: {}", 1 + self.random.below(2)),
            _ => String::new(),
        };
        if self.random.chance(0.3) {
            text += &format!(", stretch: {}", 1 + self.random.below(2));
        }
        text
    }

    /// A beam and some of its places.
    fn beam(&mut self, carrier: &Place) -> Vec<Place> {
        let name = self.name("beam");
        let section = self.section();
        let spins = section.round && self.random.chance(0.6);
        let axes = [("x", "z"), ("x", "y"), ("-z", "x"), ("[1, 2, 2]", "[2, 1, -2]"), ("[3, 4, 0]", "z")];
        let (along, up) = self.random.of(&axes);
        let length = self.quantity(0.7, 1.4, "m");
        let kind = match spins {
            true => self.random.of(&[2, 5, 5]),
            false => self.random.below(6),
        };
        let counts = match (kind, section.twists) {
            (0, _) => "bending_y: 3".to_owned(),
            (1, _) => "bending_z: 2".to_owned(),
            (2, true) => "torsion: 2, bending: 0".to_owned(),
            (3, true) => "torsion: 1, bending_y: 2".to_owned(),
            (4, true) => "torsion: 1, bending_y: 2, bending_z: 1".to_owned(),
            (_, true) => "torsion: 2, bending: 2".to_owned(),
            (_, false) => "bending: 2".to_owned(),
        };
        let mut extra = String::new();
        if !spins && self.random.chance(0.4) {
            extra += ", twist: -0.6 rad";
        }
        let is_curved = !spins && section.twists && self.random.chance(0.4);
        if is_curved {
            extra += &self.prebend();
        }
        if !spins && self.random.chance(0.3) {
            extra += ", center_y: 0.03 m, center_z: -0.02 m";
        }
        if section.shears {
            extra += &self.strains(!is_curved && !section.couples);
        }
        if self.random.chance(0.4) {
            extra += &format!(", lag: {:?} s", self.number(0.01, 0.1));
        }
        if self.random.chance(0.3) {
            extra += ", points: 3";
        }
        let spinning = match spins {
            true => format!(" spinning at {}", self.quantity(3.0, 12.0, "rad/s")),
            false => String::new(),
        };
        let section = section.text;
        self.lines.push(format!(
            "body {name}: beam(length: {length}, along: {along}, up: {up}, {section}, {counts}{extra}){spinning};"
        ));
        if self.random.chance(0.4) {
            self.along(&name);
        }
        let clamp = self.name("clamp");
        let placement = self.placement();
        match self.random.below(10) {
            0..=5 => self.lines.push(format!("joint {clamp}: fixed from {} to {name}{placement};", carrier.from)),
            6 | 7 => self.joint(&carrier.from, &name),
            // the other way round
            _ => {
                let placement = match carrier.from.contains(" at ") {
                    true => "",
                    false => &placement,
                };
                self.lines.push(format!("joint {clamp}: fixed from {name} to {}{placement};", carrier.from));
            }
        }
        let place = |at: &str| Place { from: format!("{name} at {at}"), point: format!("{name} at {at}") };
        vec![place("tip"), place("0.4 length"), place("root")]
    }

    /// Forces per length.
    fn along(&mut self, beam: &str) {
        let force = match self.spins {
            true => "[0, 0, -2]",
            false => "[1, -3, 2]",
        };
        let all =
            [format!("force: {force} N/m"), "follower: [0.5, -1, 2] N/m".to_owned(), "damping: 0.8 N*s/m^2".to_owned()];
        let mut given: Vec<&str> = Vec::new();
        for argument in &all {
            if self.random.chance(0.6) {
                given.push(argument);
            }
        }
        if given.is_empty() {
            given.push(&all[0]);
        }
        let name = self.name("load");
        let given = given.join(", ");
        self.lines.push(format!("force {name}: distributed(on: {beam}, {given});"));
    }

    fn attach(&mut self, place: &Place) {
        match self.random.below(4) {
            0 => {
                let pod = self.name("pod");
                let mass = self.quantity(0.1, 0.5, "kg");
                self.lines
                    .push(format!("body {pod}: box(mass: {mass}, size: [0.2, 0.1, 0.3] m, center: [0.05, 0.1, 0] m);"));
                self.joint(&place.from, &pod);
            }
            1 => {
                let pod = self.name("pod");
                self.lines.push(format!("body {pod}: point(mass: 0.3 kg, center: [0.1, 0.02, 0.05] m);"));
                let joint = self.name("weld");
                self.lines.push(format!("joint {joint}: fixed from {} to {pod};", place.from));
            }
            _ => {}
        }
    }

    /// A point of the place; none coincides with one of another body.
    fn point(&mut self, place: &Place) -> String {
        let point = self.name("point");
        let turned = match self.random.chance(0.5) {
            true => " rotated([1, 2, 2], 0.7 rad)",
            false => "",
        };
        self.lines.push(format!("point {point}: {}{turned};", place.point));
        point
    }

    fn force(&mut self, from: &Place, to: &Place) {
        let law = match self.random.below(7) {
            0 => {
                let (a, b) = (self.point(from), self.point(to));
                let stiffness = self.quantity(10.0, 60.0, "N/m");
                format!("spring_damper(from: {a}, to: {b}, stiffness: {stiffness}, damping: 3 N*s/m, length: 0.4 m)")
            }
            1 => {
                let (a, b) = (self.point(from), self.point(to));
                format!(
                    "bushing(from: {a}, to: {b}, stiffness: [30, 50, 20] N/m, damping: [1, 2, 3] N*s/m, \
                     turning_stiffness: [3, 2, 4] N*m/rad, turning_damping: [0.1, 0.2, 0.3] N*m*s/rad)"
                )
            }
            2 => {
                let at = self.point(to);
                let force = match self.spins {
                    true => "[0, 0, -3]",
                    false => "[1, 2, -3]",
                };
                format!("load(at: {at}, force: {force} N)")
            }
            3 => {
                let at = self.point(to);
                format!("follower(at: {at}, force: [0.5, -1, 2] N, moment: [0.3, 0.2, -0.4] N*m)")
            }
            4 => {
                let at = self.point(to);
                format!("drag(at: {at}, damping: 0.7 N*s/m, turning_damping: 0.05 N*m*s/rad)")
            }
            5 => {
                let at = self.point(to);
                let square = format!("(position({at}).x^2 + position({at}).y^2)");
                format!("potential(energy: 3 N/m * {square} + 2 N * position({at}).z)")
            }
            _ => return,
        };
        let force = self.name("force");
        self.lines.push(format!("force {force}: {law};"));
    }

    fn machine(mut self) -> String {
        let gravity = match self.spins {
            true => {
                self.lines.push("input omega: rad/s;".to_owned());
                "gravity 9.81 m/s^2 along -z;".to_owned()
            }
            false => format!("gravity {} m/s^2;", vector(self.random.vector(6.0))),
        };
        self.lines.push(gravity);
        let carrier = self.carrier();
        let mut places = self.beam(&carrier);
        if self.random.chance(0.3) {
            // another beam: at the tip of the first, at its root, or inside
            let at = places[self.random.below(3)].clone();
            let second = self.beam(&at);
            places.extend(second);
        }
        for place in places.clone() {
            self.attach(&place);
        }
        for _ in 0..2 {
            let (a, b) = (self.random.below(places.len()), self.random.below(places.len()));
            let (a, b) = (places[a].clone(), places[b].clone());
            let from = match self.spins || self.random.chance(0.5) {
                true => carrier.clone(),
                false => a,
            };
            if from.point != b.point {
                self.force(&from, &b);
            }
        }
        format!("mechanism Random {{\n    {}\n}}", self.lines.join("\n    "))
    }
}

/// What a random machine may be refused for: an element between two places of one rigid piece.
const REASON: &str = "both ends of this element are fixed in";

/// What occurs in many of the machines, together if it is more than one.
const OFTEN: [&[&str]; 21] = [
    &["shear: static"],
    &["shear: 1"],
    &["stretch: "],
    &["lag: "],
    &["twist: "],
    &["center_y: "],
    &["spinning at"],
    &["distributed("],
    &["prebend_y: "],
    &["prebend_z: "],
    &["prebend_y: ", "prebend_z: "],
    &["prebend", "twist: "],
    &["prebend", "center_y: "],
    &["prebend", "shear: "],
    &["prebend", "stretch: "],
    &["prebend", "lag: "],
    &["prebend", "distributed("],
    &["stiffness: [["],
    &["stiffness: [[", "to section("],
    &["stiffness: [[", "prebend"],
    &["stiffness: [[", "stretch: "],
];

/// Judges the machine of a number, and gives its text if it is accepted.
fn judged(seed: u64) -> Option<String> {
    let text = Writer::new(seed).machine();
    let machine = match Machine::new(&text) {
        Ok(machine) => machine,
        Err(mistakes) => {
            assert!(mistakes.contains(REASON), "seed {seed}: {mistakes}\n{text}");
            return None;
        }
    };
    let mut random = Random::new(seed);
    for round in 0..2 {
        let state = machine.state(&mut random);
        judge(&format!("seed {seed}, {round}"), &machine, &state);
    }
    Some(text)
}

#[test]
fn random_beams_obey_lagrange() {
    obey(24, 1);
}

#[test]
#[ignore = "takes a minute or two"]
fn random_beams_obey_lagrange_many_times() {
    obey(120, 10);
}

/// Judges so many machines, and requires every feature and combination in at least a number of them.
fn obey(machines: u64, least: usize) {
    let accepted: Vec<String> = thread::scope(|scope| {
        let half =
            |parity| scope.spawn(move || (0..machines / 2).filter_map(|k| judged(2 * k + parity)).collect::<Vec<_>>());
        let halves = [0, 1].map(half);
        let joined = halves.into_iter().map(|half| half.join().expect("no machine is wrong"));
        joined.flatten().collect()
    });
    assert!(6 * accepted.len() as u64 > 5 * machines, "{}", accepted.len());
    for what in OFTEN {
        let has = |text: &&String| what.iter().all(|x| text.contains(x));
        let count = accepted.iter().filter(has).count();
        assert!(count >= least, "{what:?}: {count}");
    }
}
