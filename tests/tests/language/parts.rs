//! Parts, arrays and loops give what is written out by hand: the same items in the same order, and so the same bits.

use std::fmt::Write as _;

use eigentol::{Coordinate, DesignVariable, Matrix, Output, Study, mechanism};
use eigentol_compiler::base::names::flattened;
use eigentol_compiler::mechanics::Limits;
use eigentol_compiler::syntax::parse::parse;
use eigentol_compiler::syntax::print::print;
use eigentol_compiler::{compile_text, tokens};
use eigentol_interpreter::Interpreted;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng as _, SeedableRng as _};

/// A machine with parts and the same written out, both made while walking through a random tree.
struct Twins {
    random: ChaCha8Rng,
    parts: String,
    number: usize,
}

/// A part: its text with names of its own, and a function that writes its items under another name.
struct Part {
    name: String,
    /// Parameters whose values its user gives.
    parameters: Vec<String>,
    /// `(design variables, items)` of an instance with this name, hung on this body at this place.
    written: Box<dyn Fn(&str, &[String], Option<&str>, &str, &str) -> String>,
}

impl Twins {
    fn below(&mut self, bound: u32) -> usize {
        (self.random.next_u32() % bound) as usize
    }

    fn value(&mut self) -> String {
        format!("{}.{}", 1 + self.below(9), self.below(100))
    }

    /// A pendulum on a port, with an array of springs on its joint and parts hung on its tip.
    fn part(&mut self, depth: usize) -> Part {
        let inner: Vec<(Part, Vec<String>, String, bool)> = (0..depth.min(1 + self.below(2)))
            .map(|_| {
                let part = self.part(depth / 2);
                let given = part.parameters.iter().map(|_| format!("{} m", self.value())).collect();
                let place = format!("[0, {}, 0] m rotated(z, {} deg)", self.value(), self.value());
                (part, given, place, self.below(2) == 0)
            })
            .collect();
        let number = self.number;
        self.number += 1;
        let (mass, spring, springs) = (self.value(), self.value(), self.below(4));
        let mut text = format!(
            "part P{number}(length: m) {{
                port root;
                design mass = {mass} kg +/- 2%;
                body arm: rod(mass: mass, length: length, along: x);
                joint swing: revolute(z) from root to arm at [0.1 m, 0, 0];
                design k[0..{springs}] = {spring} N*m/rad;
                for i in 0..{springs} {{ force hold[i]: spring(on: swing, stiffness: (i + 1) * k[i]); }}
                point tip: arm at [length, 0, 0];
                output far = position(tip).y + sum(for i in 0..{springs}: i * swing * 1 m);\n"
        );
        for (k, (part, given, place, gives_mass)) in inner.iter().enumerate() {
            let mut arguments: Vec<String> =
                part.parameters.iter().zip(given).map(|(name, value)| format!("{name}: {value} + length")).collect();
            if *gives_mass {
                arguments.push("mass: mass".to_owned());
            }
            let _ = writeln!(text, "use next[{k}]: {}({}) with root: arm at {place};", part.name, arguments.join(", "));
        }
        text.push_str("}\n");
        self.parts = format!("{text}{}", self.parts);
        let written = move |name: &str, given: &[String], mass_given: Option<&str>, body: &str, at: &str| {
            let n = |own: &str| format!("{name}_{own}");
            let [length, m, arm, swing, tip] = ["length", "mass", "arm", "swing", "tip"].map(n);
            let mut text = format!("let {length} = {};\npoint {}: {body} {at};\n", given[0], n("root"));
            text += &match mass_given {
                None => format!("design {m} = {mass} kg +/- 2%;\n"),
                Some(value) => format!("let {m} = {value};\n"),
            };
            let (root, fixed) = match at {
                "" => (body.to_owned(), String::new()),
                at => {
                    let frame = n("root_frame");
                    let fixed =
                        format!("body {frame}: massless;\njoint {frame}_joint: fixed from {body} to {frame} {at};\n");
                    (frame, fixed)
                }
            };
            let _ = writeln!(text, "body {arm}: rod(mass: {m}, length: {length}, along: x);");
            let _ = writeln!(text, "joint {swing}: revolute(z) from {root} to {arm} at [0.1 m, 0, 0];");
            for i in 0..springs {
                let _ = writeln!(text, "design {}_{i} = {spring} N*m/rad;", n("k"));
            }
            for i in 0..springs {
                let _ = writeln!(
                    text,
                    "force {}_{i}: spring(on: {swing}, stiffness: ({i} + 1) * {}_{i});",
                    n("hold"),
                    n("k")
                );
            }
            let terms: Vec<String> = (0..springs).map(|i| format!("({i} * {swing} * 1 m)")).collect();
            let sum = if springs == 0 { "(0)".to_owned() } else { format!("({})", terms.join(" + ")) };
            let _ = writeln!(text, "point {tip}: {arm} at [{length}, 0, 0];");
            let _ = writeln!(text, "output {} = position({tip}).y + {sum};", n("far"));
            for (k, (part, given, place, gives_mass)) in inner.iter().enumerate() {
                let given: Vec<String> = given.iter().map(|value| format!("{value} + {length}")).collect();
                let of_mass = gives_mass.then_some(m.as_str());
                text += &(part.written)(&format!("{name}_next_{k}"), &given, of_mass, &arm, &format!("at {place}"));
            }
            text + &fixed
        };
        let (name, parameters) = (format!("P{number}"), vec!["length".to_owned()]);
        Part { name, parameters, written: Box::new(written) }
    }
}

/// Everything that is computed, without what the names are.
fn program(text: &str) -> String {
    let compiled = compile_text(text, Limits::default()).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"));
    flattened(&format!("{:?}", compiled.program))
}

#[test]
fn parts_give_the_bits_of_what_is_written_out() {
    let head = "gravity 9.81 m/s^2 along x;\ndesign size = 0.3 m +/- 1%;\n";
    for seed in 0..30 {
        let mut twins = Twins { random: ChaCha8Rng::seed_from_u64(seed), parts: String::new(), number: 0 };
        let part = twins.part(seed as usize % 3);
        let count = 1 + twins.below(2);
        let parts = format!(
            "{}mechanism M {{ {head} let n = {count};
             for i in 0..n {{ use m[i]: {}(length: (i + 1) * size) with root: ground; }} }}",
            twins.parts, part.name
        );
        let mut flat = format!("mechanism M {{ {head} let n = {count};\n");
        for i in 0..count {
            flat += &(part.written)(&format!("m_{i}"), &[format!("({i} + 1) * size")], None, "ground", "");
        }
        flat += "}";
        assert_eq!(program(&parts), program(&flat), "{parts}\n{flat}");
        let read = |text: &str| parse(tokens(text).expect("tokens")).expect("a declaration");
        let printed = print(&read(&parts));
        assert_eq!(print(&read(&printed)), printed);
        assert_eq!(program(&printed), program(&flat), "{printed}");
    }
}

mechanism! {
    /// A blade that flaps.
    part Blade(length: m, spring: N*m/rad) {
        /// Of the whole blade.
        design mass = 2 kg +/- 1%;
        port root;
        body arm: rod(mass: mass, length: length, along: x);
        joint flap: revolute(-y) from root to arm at [50 mm, 0, 0];
        force hinge: spring(on: flap, stiffness: spring);
        point tip: arm at [length, 0, 0];
    }
    mechanism Rotor {
        input omega: rpm;
        design l = 600 mm +/- 0.5 mm;
        design k[0..2] = 40 N*m/rad +/- 5%;
        body hub: disk(mass: 8 kg, radius: 10 cm, axis: z);
        joint spin: revolute(z) from ground to hub, driven at omega;
        for i in 0..3 { use blade[i]: Blade(length: l, spring: k[0]) with root: hub rotated(z, i * 120 deg); }
        use odd: Blade(length: l / 2, spring: k[1], mass: 1 kg) with root: hub rotated(z, 60 deg);
        output lift = sum(for i in 0..3: position(blade[i].tip).z) / 3;
    }
}

#[test]
fn handles_are_written_as_the_names() {
    let flap: Coordinate<Rotor> = Rotor::blade[1].flap;
    let mass: DesignVariable<Rotor> = Rotor::blade[2].mass;
    let lift: Output<Rotor> = Rotor::lift;
    assert_eq!((flap.index(), mass.index(), lift.index()), (1, 5, 0));
    assert_eq!(Rotor::odd.flap.index(), 3);
    let study = Study::new(Rotor).input(Rotor::omega, 30.0).design(Rotor::k[1], 90.0);
    let names: Vec<&str> = study.description().design.iter().map(|x| &*x.name).collect();
    assert_eq!(names, ["l", "k[0]", "k[1]", "blade[0].mass", "blade[1].mass", "blade[2].mass"]);
    let coordinates: Vec<&str> = study.description().coordinates.iter().map(|x| &*x.name).collect();
    assert_eq!(coordinates, ["blade[0].flap", "blade[1].flap", "blade[2].flap", "odd.flap"]);
    // THEORY of a flapping blade: `w^2 = W^2 (1 + 3 e / (2 l)) + k / I`.
    let of = |l: f64, m: f64, k: f64| (900.0 * (1.0 + 1.5 * 0.05 / l) + 3.0 * k / (m * l * l)).sqrt();
    let modes = study.modes().expect("modes").frequencies();
    let expected = [of(0.6, 2.0, 40.0), of(0.6, 2.0, 40.0), of(0.6, 2.0, 40.0), of(0.3, 1.0, 90.0)];
    for (found, expected) in modes.iter().flatten().zip(expected) {
        assert!((found - expected).abs() < 1e-10 * expected, "{found} {expected}");
    }
}

#[test]
fn the_macro_and_the_interpreter_agree() {
    let text = "part A { design m = 1 kg; port on; body b: rod(mass: m, length: 1 m, along: -z); \
                joint j: revolute(y) from on to b; }
                mechanism M { gravity 9.81 m/s^2 along -z; use a[0..2]: A with on: ground; }";
    let machine = Interpreted::from_text(text).expect("a declaration");
    let study = Study::new(machine);
    assert_eq!(study.find_design("a[1].m").expect("a design variable").index(), 1);
    let error = study.find_design("a[2].m").expect_err("no such instance").to_string();
    assert!(error.contains("a[2].m") && error.contains("a[1].m"), "{error}");
}

#[test]
fn batches_are_correlated() {
    let text = |items: &str| {
        format!(
            "part A {{ design m = 1 kg +/- 3%; port on; body b: rod(mass: m, length: 1 m, along: -z); \
             joint j: revolute(y) from on to b; }}
             mechanism M {{ design k = 2 N*m/rad +/- 1%; gravity 9.81 m/s^2 along -z; use a[0..3]: A with on: ground; \
             force f: spring(on: a[0].j, stiffness: k); output sum = a[0].m + a[1].m + a[2].m; {items} }}"
        )
    };
    let study = |items: &str| Study::new(Interpreted::from_text(&text(items)).expect("a declaration"));
    let correlation = |items: &str| {
        let matrix = study(items).correlation_matrix();
        matrix.map(|matrix| [matrix[1][2], matrix[1][3], matrix[2][3], matrix[0][1]])
    };
    assert_eq!(correlation(""), None);
    assert_eq!(correlation("correlated 0.8: a[..].m;"), Some([0.8, 0.8, 0.8, 0.0]));
    assert_eq!(correlation("correlated -0.25: a[1..].m; correlated 0.5: k, a[0].m;"), Some([0.0, 0.0, -0.25, 0.5]));
    // The variance of a sum of three with sigma s and correlation r: `3 s^2 (1 + 2 r)`.
    let sigma = study("correlated 0.8: a[..].m;").output_tolerances().expect("a spread").spreads[0]
        .as_ref()
        .expect("smooth")
        .sigma;
    assert!((sigma - 0.01 * (3.0_f64 * 2.6).sqrt()).abs() < 1e-14, "{sigma}");
    // A matrix that is set takes its place.
    let set = study("correlated 0.8: a[..].m;").correlation(Matrix::from_fn(1, 1, |_, _| 1.0));
    assert!(set.tolerances().is_err());
}
