//! Parts, arrays and loops give what is written out by hand: the same items in the same order, and so the same bits.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use eigentol::{Coordinate, DesignVariable, Input, Matrix, Output, Study, mechanism};
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

type Written = dyn Fn(&str, &[String], Option<&str>, &str, &str) -> String;

/// A part: its text with names of its own, and a function that writes its items under another name.
struct Part {
    name: String,
    /// Parameters whose values its user gives.
    parameters: Vec<String>,
    /// The items of an instance with this name, these parameters and perhaps this mass, hung on this body at this place.
    written: Box<Written>,
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
                output far = position(tip).y + sum(for i in 0..{springs}: i * swing * 1 m);
                output high = position(root).x;\n"
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
            let _ = writeln!(text, "output {} = position({}).x;", n("high"), n("root"));
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

/// One argument takes the place of a whole array of design variables, but not of another whose name it starts.
#[test]
fn an_argument_stands_for_an_array() {
    let text = "part A { design k[0..2] = 1 N*m/rad; design kk = 5 N*m/rad; port on;
                    body b: rod(mass: 3 kg, length: 1 m, along: -z); joint j: revolute(y) from on to b;
                    for i in 0..2 { force f[i]: spring(on: j, stiffness: k[i] + kk); } }
                mechanism M { design k = 8 N*m/rad; use a: A(k: k) with on: ground; }";
    let study = Study::new(Interpreted::from_text(text).expect("a declaration"));
    let names: Vec<&str> = study.description().design.iter().map(|x| &*x.name).collect();
    assert_eq!(names, ["k", "a.kk"]);
    let found = study.modes().expect("modes").frequencies()[0].expect("oscillates");
    assert!((found - 26.0_f64.sqrt()).abs() < 1e-12, "{found}");
}

/// A chain of parts, each in the next: as deep as may be, and far deeper than any stack.
#[test]
fn parts_stand_in_parts_to_a_depth() {
    let text = |depth: usize| {
        let mut text = "part P0 { port on; body b: rod(mass: 1 kg, length: 1 m, along: -z); \
                        joint j: revolute(y) from on to b; }\n"
            .to_owned();
        for k in 1..depth {
            let _ = writeln!(text, "part P{k} {{ port on; use inner: P{} with on: on; }}", k - 1);
        }
        format!("{text} mechanism M {{ gravity 9.81 m/s^2 along -z; use outer: P{} with on: ground; }}", depth - 1)
    };
    let deep = Study::new(Interpreted::from_text(&text(32)).expect("a declaration"));
    assert_eq!(deep.description().coordinates[0].name.matches("inner").count(), 31);
    let error = Interpreted::from_text(&text(20_000)).expect_err("too deep").to_string();
    assert!(error.contains("more than 32 deep"), "{error}");
}

/// A declaration of the examples.
fn example(name: &str) -> Study<Interpreted> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples").join(name);
    Study::new(Interpreted::from_file(path).unwrap_or_else(|error| panic!("{error}")))
}

#[test]
fn the_examples_have_the_frequencies_of_closed_forms() {
    let lowest = |study: &Study<Interpreted>| study.modes().expect("modes").frequencies();
    // A hanging chain: zeros of J0(2 w sqrt(L / g)), a little lower in links of which each is a rod.
    let chain = lowest(&example("chain.mechanism"));
    for (mode, zero) in [2.404_825_557_7, 5.520_078_110_3].into_iter().enumerate() {
        let expected = 0.5 * zero * (9.81_f64 / 0.96).sqrt();
        assert!((chain[mode].expect("oscillates") / expected - 1.0).abs() < 2e-3, "{mode}");
    }
    // The five motions in which the blades do not lift the hub have the frequency of a blade alone.
    let rotor = example("bladed_rotor.mechanism");
    let rotor = rotor.clone().input(Input::new(0), 600.0 * std::f64::consts::TAU / 60.0);
    let alone = (3_947.841_760_4 * (1.0 + 1.5 * 0.05 / 0.6) + 3.0 * 400.0 / (2.0 * 0.36_f64)).sqrt();
    // The damping of the air moves them by half of its square.
    let equal = lowest(&rotor).into_iter().flatten().filter(|w| (w / alone - 1.0).abs() < 1e-6);
    assert_eq!(equal.count(), 5);
    // Three inertias, a spring and two meshes: the determinant changes its sign at each frequency.
    let gears = example("gearbox.mechanism");
    let damping = gears.find_design("motor.torsion_damping").expect("a design variable");
    let found = lowest(&gears.design(damping, 0.0));
    let base = 0.5 * 20.0_f64.to_radians().cos();
    let (fast, slow) = ([20.0, 60.0].map(|z| z * 2e-3 * base), [18.0, 90.0].map(|z| z * 3e-3 * base));
    let mesh = 20e9 * 0.02;
    let determinant = |w: f64| {
        let square = w * w;
        let a = 20e3 + mesh * fast[0] * fast[0] - 2e-3 * square;
        let b = mesh * (fast[1] * fast[1] + slow[0] * slow[0]) - 16e-3 * square;
        let c = mesh * slow[1] * slow[1] - 0.8 * square;
        let (ab, bc) = (mesh * fast[0] * fast[1], mesh * slow[0] * slow[1]);
        a * (b * c - bc * bc) - ab * ab * c
    };
    assert_eq!(found.len(), 3);
    for frequency in found.into_iter().flatten() {
        assert!(determinant(frequency * (1.0 - 1e-9)) * determinant(frequency * (1.0 + 1e-9)) < 0.0, "{frequency}");
    }
}

/// The words that start items are highlighted in editors.
#[test]
fn editors_know_the_words_of_items() {
    let grammar = include_str!("../../../macros/language/editor/mechanism.tmLanguage.json");
    let grammar: serde_json::Value = serde_json::from_str(grammar).expect("JSON");
    let all = grammar["repository"].to_string();
    let known = |word: &str| {
        ["(", "|"].iter().any(|before| [")", "|"].iter().any(|after| all.contains(&format!("{before}{word}{after}"))))
    };
    let mistakes = compile_text("mechanism M { qqqqqq a: b; }", Limits::default()).expect_err("an unknown item");
    let help = mistakes.iter().find_map(|mistake| mistake.help.clone()).expect("a list of words");
    let words: Vec<&str> = help.trim_start_matches("an item starts with one of ").split(", ").collect();
    assert!(words.len() > 15, "{help}");
    words.iter().for_each(|word| assert!(known(word), "{word}"));
}

mechanism! {
    include "tests/language/pendulum.part";
    mechanism Included { gravity 9.81 m/s^2 along -z; use a[0..2]: Pendulum(length: 0.5 m) with root: ground; }
}

#[test]
fn a_macro_includes_files_of_its_crate() {
    let study = Study::new(Included).design(Included::a[1].mass, 3.0);
    let found = study.modes().expect("modes").frequencies();
    found.into_iter().flatten().for_each(|found| assert!((found - (1.5_f64 * 9.81 / 0.5).sqrt()).abs() < 1e-10));
}

/// What a text says of its files: the chain of a circle, what is outside, what does not exist, and mistakes in them.
#[test]
fn files_are_told_by_their_names() {
    let folder = std::env::temp_dir().join(format!("eigentol_parts_{}", std::process::id()));
    fs::create_dir_all(folder.join("inner")).expect("a folder");
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).expect("a file");
    let main = folder.join("main.mechanism");
    let says = |text: &str| {
        fs::write(&main, text).expect("a file");
        Interpreted::from_file(&main).expect_err("a mistake").to_string()
    };
    let machine = "mechanism M { use a: A; use b: A; }";
    write("inner/a.part", "\ninclude \"b.part\";\npart A { body x: massless; joint j: revolute(z) from grund to x; }");
    write("inner/b.part", "part B { }");
    let text = says(&format!("include \"inner/a.part\";\n{machine}"));
    assert!(text.contains("a.part:3:") && text.contains("unknown body `grund`"), "{text}");
    assert!(text.contains("this is in `a`, used at 2:19") && text.matches("unknown body").count() == 1, "{text}");
    write("inner/b.part", "include \"a.part\"; part B { }");
    let text = says(&format!("include \"inner/a.part\"; {machine}"));
    assert!(text.contains("a.part` includes `") && text.contains("b.part:1:9"), "{text}");
    let text = says(&format!("include \"../outside.part\"; {machine}"));
    assert!(text.contains("main.mechanism:1:9: `../outside.part` cannot be read"), "{text}");
    let text = says("include \"/etc/passwd\"; mechanism M { }");
    assert!(text.contains("outside the folder") || text.contains("cannot be read"), "{text}");
    let text = says("include 3; mechanism M { }");
    assert!(text.contains("1:9: expected the name of a file"), "{text}");
    fs::remove_dir_all(&folder).expect("removed");
}

/// The parts of a beam that a load splits have coordinates under names that nothing else has, so that handles differ.
#[test]
fn parts_of_a_beam_leave_names_to_others() {
    let text = "mechanism S { design arm_1 = 2 kg;
        body arm: beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 40 N*m^2, bending_y: 2);
        joint clamp: fixed from ground to arm; body w: sphere(mass: arm_1, radius: 1 cm);
        joint weld: fixed from arm at 0.5 length to w; }";
    let study = Study::new(Interpreted::from_text(text).expect("a declaration"));
    let names: Vec<&str> = study.description().coordinates.iter().map(|x| &*x.name).collect();
    assert_eq!(names, ["arm_1_.bend_y[0]", "arm_1_.bend_y[1]", "arm_2.bend_y[0]", "arm_2.bend_y[1]"]);
}
