//! First and second total derivatives of the vibrations of random machines, against those of the whole problem solved
//! again in hyper-dual numbers.

use eigentol::equilibrium::equilibrium;
use eigentol::forced::{ForcedCurvature, Measure, second_derivatives};
use eigentol::{Complex, CoordinateInfo, Description, Output, Policy, Role};
use eigentol_interpreter::Interpreted;
use eigentol_tests::rederived::{self, ComplexDerived, Derived, State, Vibration, flat, ordered};

use crate::forcing::compared::Random;
use crate::forcing::declared::{Coordinate, Machine, Motion};
use crate::forcing::random::machine;

/// Allowed errors relative to the derivative, or to a hundredth of what a change of the variables by their own sizes
/// would do.
const FIRST: f64 = 1e-10;
const SECOND: f64 = 1e-8;

/// By the number of derivatives by time.
const MEASURES: [Measure; 3] = [Measure::Displacement, Measure::Velocity, Measure::Acceleration];

/// Numbers of a declaration that become variables.
const VARIABLES: usize = 6;

/// Units as they end a quantity, longer ones first.
const UNITS: [&str; 16] = [
    "N*m*s/rad",
    "N*m/rad",
    "rad/s^2",
    "kg*m^2",
    "N*s/m",
    "m/s^2",
    "rad/s",
    "kg*m",
    "N/m",
    "N*m",
    "m/s",
    "rad",
    "kg",
    "N",
    "m",
    "s",
];

/// A text with some of its numbers, and factors of some of its vectors, as variables, and the values of the inputs.
fn with_variables(text: &str, random: &mut Random) -> (String, Vec<f64>) {
    let mut places = quantities(text);
    while places.len() > VARIABLES {
        places.remove(random.below(places.len()));
    }
    let (mut declared, mut inputs, mut body, mut done) = (String::new(), Vec::new(), String::new(), 0);
    for (k, (start, end, unit)) in places.into_iter().enumerate() {
        let number = &text[start..end];
        let name = format!("variable{k}");
        body += &text[done..start];
        let vector = number.starts_with('[');
        let size = if vector { "1.0" } else { number };
        if random.chance(25) {
            declared += &format!("    input {name}: {unit};\n");
            inputs.push(size.parse().expect("a number"));
        } else {
            declared += &format!("    design {name} = {size} {unit};\n");
        }
        body += &match vector {
            true => format!("{name} * {number}"),
            false => name,
        };
        done = end + 1 + unit.len();
    }
    body += &text[done..];
    (body.replacen("{\n", &format!("{{\n{declared}"), 1), inputs)
}

/// Start and end of every number or vector with a unit.
fn quantities(text: &str) -> Vec<(usize, usize, &'static str)> {
    let mut found = Vec::new();
    for (space, _) in text.match_indices(' ') {
        let after = &text[space + 1..];
        let of_unit = |unit: &&&str| {
            after
                .strip_prefix(**unit)
                .is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || "*/^".contains(c)))
        };
        let Some(unit) = UNITS.iter().find(of_unit) else {
            continue;
        };
        let before = &text[..space];
        let start = match before.ends_with(']') {
            true => before.rfind('['),
            false => before.rfind([' ', '(']).map(|place| place + 1),
        };
        let start = start.expect("a quantity");
        let number = &text[start..space];
        // at zero, all that depends on it may vanish
        if number.starts_with('[') || number.parse::<f64>().is_ok_and(|value| value != 0.0) {
            found.push((start, space, *unit));
        }
    }
    found
}

/// A machine that stands: everything free is held by springs, and what coasts is turned by motors.
fn standing(seed: u64) -> Machine {
    let mut machine = machine(seed);
    machine.kernels_only = false;
    let joints = machine.joints.iter();
    let all: Vec<Coordinate> = joints.flat_map(|joint| joint.coordinates.clone()).collect();
    let free = |slides: bool| {
        let mut all = all.iter();
        all.any(|item| matches!(item.motion, Motion::Free) && item.slides == slides)
    };
    if free(false) {
        machine.other("every angle: spring_damper(stiffness: 90 N*m/rad, damping: 1.5 N*m*s/rad);");
    }
    if free(true) {
        machine.other("every displacement: spring_damper(stiffness: 120 N/m, damping: 2.5 N*s/m);");
    }
    for own in &all {
        match own.motion {
            Motion::Free => machine.output(&own.name),
            Motion::Coasting => machine.other(&format!(
                "force motor_{0}: generalized(on: {0}, value: 6 N*m - 1.5 N*m*s/rad * rate({0}));",
                own.name
            )),
            _ => &mut machine,
        };
    }
    machine
}

/// What a family of comparisons has seen.
#[derive(Default)]
struct Seen {
    machines: usize,
    loops: usize,
    coasting: usize,
    bent: usize,
    kinds: [usize; 3],
    moduli: usize,
    /// The largest errors relative to the allowed ones, and where they occur.
    worst: [(f64, String); 2],
}

impl Seen {
    fn note(&mut self, order: usize, error: f64, what: impl Fn() -> String) {
        let error = if error.is_nan() { f64::INFINITY } else { error };
        if error > self.worst[order].0 {
            self.worst[order] = (error, what());
        }
    }

    /// Compares derivatives of a number of this size.
    fn compare(
        &mut self,
        what: &str,
        (first, second): (&[f64], &[Vec<f64>]),
        expected: &Derived,
        (size, variables): (f64, &[f64]),
    ) {
        assert_eq!([first.len(), second.len()], [variables.len(); 2]);
        let sizes = || variables.iter().enumerate();
        for (i, one) in sizes() {
            let (found, exact) = (first[i], expected.gradient[i]);
            let scale = exact.abs() + 1e-2 * size / one;
            self.note(0, (found - exact).abs() / (FIRST * scale), || format!("{what} by {i}: {found} {exact}"));
            for (j, other) in sizes() {
                let (found, exact) = (second[i][j], expected.hessian[i][j]);
                let scale = exact.abs() + 1e-2 * size / (one * other);
                self.note(1, (found - exact).abs() / (SECOND * scale), || {
                    format!("{what} by {i}, {j}: {found} {exact}")
                });
            }
        }
    }

    fn complex(
        &mut self,
        what: &str,
        (first, second): (&[Complex], &[Vec<Complex>]),
        expected: &ComplexDerived,
        at: (f64, &[f64]),
    ) {
        for (part, of) in [(0, &expected.re), (1, &expected.im)] {
            let number = |y: &Complex| [y.re, y.im][part];
            let first: Vec<f64> = first.iter().map(number).collect();
            let second = second.iter().map(|row| row.iter().map(number).collect());
            let second: Vec<Vec<f64>> = second.collect();
            self.compare(&format!("{what} part {part}"), (&first, &second), of, at);
        }
    }

    /// Every output of a machine in every harmonic.
    fn machine(&mut self, what: &str, all: &ForcedCurvature, state: &State, variables: &[f64]) {
        for (h, harmonic) in all.first.response.harmonics.iter().enumerate() {
            let members: Vec<usize> = harmonic.shares.iter().map(|share| share.excitation).collect();
            for (rate, measure) in MEASURES.into_iter().enumerate() {
                let expected = state.vibration(&members, rate);
                let what = format!("{what} harmonic {h} {measure:?}");
                let w = &expected.frequency;
                assert!((harmonic.frequency - w.value).abs() <= 1e-13 * w.value, "{what}");
                let first = flat(&all.first.harmonics[h].frequency);
                let second = ordered(&all.harmonics[h].frequency);
                self.compare(&what, (&first, &second), w, (w.value, variables));
                for o in 0..expected.outputs.len() {
                    let what = format!("{what} output {o}");
                    self.output(&what, (all, h, Output::new(o), rate), &expected, variables);
                }
            }
        }
    }

    fn output(
        &mut self,
        what: &str,
        (all, h, output, rate): (&ForcedCurvature, usize, Output, usize),
        expected: &Vibration,
        variables: &[f64],
    ) {
        let measure = MEASURES[rate];
        let y = all.first.response.harmonics[h].amplitude(output, measure);
        let (y, o) = (y.expect("an output"), output.index());
        let (own, modulus) = (&expected.outputs[o], &expected.moduli[o]);
        // vibrations of such machines are of the order of one
        let unit = expected.frequency.value.powi(rate as i32);
        let size = modulus.value.max(1e-3 * unit);
        let error = (y.re - own.re.value).hypot(y.im - own.im.value);
        assert!(error <= 1e-11 * size, "{what}: {y} {own:?}");
        let first = all.first.complex(h, output, measure).expect("slopes");
        let second = all.complex(h, output, measure).expect("curvature");
        self.complex(what, (&flat(&first), &ordered(&second)), own, (size, variables));
        // a modulus bends without bound where it is zero
        if modulus.value < size {
            return;
        }
        self.moduli += 1;
        let first = all.first.modulus(h, output, measure).expect("slopes");
        let second = all.modulus(h, output, measure).expect("curvature");
        let what = format!("{what} modulus");
        self.compare(&what, (&flat(&first), &ordered(&second)), modulus, (size, variables));
    }
}

/// Compares the machine of a seed; `None` if it is refused, cannot be assembled or has redundant constraints.
fn check(seen: &mut Seen, seed: u64) -> Option<()> {
    let declared = standing(seed).excited();
    let (text, u) = with_variables(&declared, &mut Random::new(seed + 77));
    let machine = Interpreted::from_text(&text).ok()?;
    let Description { design, coordinates, excitations, .. } = machine.description();
    let b: Vec<f64> = design.iter().map(|value| value.nominal).collect();
    let starts = coordinates.iter().map(|coordinate| match coordinate.role {
        Role::Speed => 3.0,
        _ => 0.1,
    });
    let starts: Vec<f64> = starts.collect();
    let at = match equilibrium(&machine, &u, &b, &starts, Policy::Nearest) {
        Ok(at) => at,
        Err(error) => {
            let error = error.to_string();
            assert!(error.contains("cannot be assembled"), "{seed}: {error}");
            return None;
        }
    };
    if at.constraints.redundant > 0 {
        return None;
    }
    let all = second_derivatives(&machine, &at).unwrap_or_else(|error| panic!("{seed}: {error}"));
    let state = rederived::Machine::new(&text).at(&u, &b, &at.coordinates);
    let variables: Vec<f64> = b.iter().chain(&u).map(|value| value.abs()).collect();
    seen.machine(&format!("{seed}"), &all, &state, &variables);
    seen.machines += 1;
    let has = |role: Role| usize::from(coordinates.iter().any(|coordinate| coordinate.role == role));
    seen.coasting += has(Role::Speed);
    seen.loops += has(Role::PositionReaction);
    let bent = |(coordinate, q): (&CoordinateInfo, &f64)| coordinate.role == Role::Position && q.abs() > 1e-3;
    seen.bent += usize::from(coordinates.iter().zip(&at.coordinates).any(bent));
    for (count, kind) in seen.kinds.iter_mut().zip(["unbalance", "harmonic", "shaken"]) {
        *count += usize::from(excitations.iter().any(|excitation| excitation.kind == *kind));
    }
    Some(())
}

#[test]
fn derivatives_of_random_machines() {
    derivatives_agree(1);
}

#[test]
#[ignore = "half a minute"]
fn derivatives_of_many_random_machines() {
    derivatives_agree(3);
}

/// On so many hundred machines, with enough of each kind among them.
fn derivatives_agree(hundreds: usize) {
    let mut seen = Seen::default();
    for seed in 0..107 * hundreds as u64 {
        check(&mut seen, seed);
    }
    let Seen { machines, bent, loops, coasting, kinds, moduli, .. } = seen;
    assert!(
        machines >= 33 * hundreds
            && bent >= 30 * hundreds
            && loops >= 16 * hundreds
            && coasting >= 6 * hundreds
            && moduli >= 166 * hundreds,
        "{machines} {bent} {loops} {coasting} {moduli}"
    );
    assert!(kinds.iter().all(|&count| count >= 16 * hundreds), "{kinds:?}");
    for (ratio, what) in seen.worst {
        assert!(ratio <= 1.0, "{what}: {ratio:.1e} of the allowed error");
    }
}
