//! Families of steady motions: the unknowns that are held select the member, and what derivatives compare (`U2`).

use eigentol::equilibrium::Note;
use eigentol::kernels::{BatchKernels, CurvatureKernels};
use eigentol::{Coordinate, Error, Input, Quantity, Study, mechanism};
use eigentol_interpreter::Interpreted;
use serde_json::Value;

use super::common::{close, frequencies, number, numbers, study, truth};

/// A disc rolls without slip, its lean, its course and its spin free.
fn coin() -> Study<Interpreted> {
    coin_with("")
}

fn coin_with(more: &str) -> Study<Interpreted> {
    study(&coin_text(more))
}

fn coin_text(more: &str) -> String {
    format!(
        "mechanism Coin {{
            design m_ = 1 kg;
            design r_ = 0.5 m;
            {more}
            gravity 9.81 m/s^2 along -z;
            body base: massless;
            body mast: massless;
            body fork: massless;
            body wheel: disk(mass: m_, radius: r_, axis: y);
            joint travel: planar(forward: x, side: y, yaw: z) from ground to base, coasting;
            joint height: prismatic(z) from base to mast;
            joint lean: revolute(x) from mast to fork;
            joint spin: revolute(y) from fork to wheel, coasting;
            point hub: wheel;
            point road: ground;
            constraint contact: rolling(wheel: hub, axis: y, radius: r_, on: road);
        }}"
    )
}

fn unknown(study: &Study<Interpreted>, name: &str) -> Coordinate<Interpreted> {
    let all = &study.description().coordinates;
    let place = all.iter().position(|info| info.name == *name);
    Coordinate::new(place.expect("an unknown"))
}

#[test]
fn a_coin_in_a_circle() {
    let truth = truth("U2_coin_family");
    let values = numbers(&truth["values"]);
    let parameter = |name: &str| number(&truth["parameters"][name]);
    let [lean, yaw, spin] = ["lean", "yaw", "spin"].map(|name| unknown(&coin(), name));
    let height = unknown(&coin(), "height");
    let start = coin().guess(height, 0.5);
    let by_yaw = (start.clone()).hold(lean, parameter("lean")).hold(yaw, parameter("yaw_rate")).guess(spin, 4.0);
    let by_spin = start.hold(lean, parameter("lean")).hold(spin, parameter("spin")).guess(yaw, -1.0);
    for (study, name) in [(by_yaw, "held_lean_and_yaw_rate"), (by_spin, "held_lean_and_spin")] {
        let state = &study.equilibrium().expect(name);
        let modes = study.modes().expect(name);
        assert!(state.notes.contains(&Note::Member { dimension: 2 }), "{:?}", state.notes);
        let at = |unknown: Coordinate<_>| state.coordinates[unknown.index()];
        close(at(spin), values[1], 1e-11, "spin");
        close(at(yaw), values[2], 1e-11, "yaw rate");
        let found = frequencies(&study);
        assert_eq!(found.len(), 1, "{modes:?}");
        close(found[0], values[0], 1e-10, "frequency");
        let slopes = study.sensitivities().expect("derivatives");
        let r = modes.modes.iter().position(|mode| mode.frequency().is_some());
        let own = slopes.modes[r.expect("it wobbles")].frequency().expect("derivatives");
        close(own.by_design[1], number(&truth[name]["first"]["r"][0]), 1e-9, "by radius");
        assert!(own.by_design[0].abs() < 1e-9);
    }
}

#[test]
fn too_many_or_dependent_unknowns_are_refused() {
    let [lean, yaw, spin] = ["lean", "yaw", "spin"].map(|name| unknown(&coin(), name));
    let all = coin().hold(lean, 0.3).hold(yaw, -1.0).hold(spin, 4.0);
    assert!(matches!(all.equilibrium(), Err(Error::NotHeld { dimension: 2, .. })), "{:?}", all.equilibrium());
}

/// The frequency of the coin, by `(r, lean, x)` with `x` the other unknown held: value, gradient, second derivatives.
struct Wobble {
    value: f64,
    first: [f64; 3],
    second: [[f64; 3]; 3],
}

impl Wobble {
    fn new(truth: &Value, case: &str, other: &str) -> Self {
        let names = ["r", "lean", other];
        let case = &truth[case];
        let second = |i: usize, j: usize| {
            let (a, b) = (names[i], names[j]);
            let pair = [format!("{a} {b}"), format!("{b} {a}")];
            let found = pair.iter().find_map(|pair| case["hessian"].get(pair));
            number(&found.expect("a second derivative")[0])
        };
        Self {
            value: number(&truth["values"][0]),
            first: names.map(|name| number(&case["first"][name][0])),
            second: std::array::from_fn(|i| std::array::from_fn(|j| second(i, j))),
        }
    }

    /// Checks the frequency of a machine whose radius, lean and other unknown are functions of its design variables, with
    /// these first derivatives by variable, and these second ones by two.
    #[track_caller]
    fn check<M: BatchKernels + CurvatureKernels>(
        &self,
        study: &Study<M>,
        by: &[[f64; 3]],
        by_two: impl Fn(usize, usize) -> [f64; 3],
    ) {
        let state = study.equilibrium().expect("a steady motion");
        let modes = &study.modes().expect("a steady motion").modes;
        assert!(state.notes.contains(&Note::Member { dimension: 2 }), "{:?}", state.notes);
        let mode = modes.iter().position(|mode| mode.frequency().is_some());
        let mode = mode.expect("it wobbles");
        close(modes[mode].frequency().expect("a frequency"), self.value, 1e-10, "frequency");
        let slopes = study.sensitivities().expect("derivatives");
        let first = slopes.modes[mode].frequency().expect("derivatives").by_design;
        let second = study.mode_curvature(mode).expect("second derivatives");
        let second = second.of(Quantity::Frequency).expect("of a frequency").by_design;
        for (a, own) in by.iter().enumerate() {
            let expected: f64 = own.iter().zip(self.first).map(|(x, slope)| x * slope).sum();
            close(first[a], expected, 1e-9, &format!("by {a}"));
            for (b, other) in by.iter().enumerate() {
                let mut expected: f64 = (by_two(a, b).iter().zip(self.first)).map(|(x, slope)| x * slope).sum();
                for (x, row) in own.iter().zip(&self.second) {
                    let along: f64 = row.iter().zip(other).map(|(d, y)| d * y).sum();
                    expected += x * along;
                }
                close(second[a][b], expected, 1e-8, &format!("by {a} and {b}"));
            }
        }
    }
}

const NOTHING: [f64; 3] = [0.0; 3];
const UNIT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The declaration holds what `hold` would, at values with derivatives.
#[test]
fn declared_values() {
    let truth = truth("U2_coin_family");
    let parameter = |name: &str| number(&truth["parameters"][name]);
    let (lean, spin, yaw) = (parameter("lean"), parameter("spin"), parameter("yaw_rate"));
    let of = |name: &str| unknown(&coin(), name);
    let with = |text: String| coin_with(&text).guess(of("height"), 0.5);

    let by_yaw = Wobble::new(&truth, "held_lean_and_yaw_rate", "yaw_rate");
    let study =
        with(format!("design a = {lean} +/- 1%; design w = {yaw} rad/s +/- 2%; steady lean = a; steady yaw = w;"));
    let by = [NOTHING, UNIT[0], UNIT[1], UNIT[2]];
    by_yaw.check(&study.guess(of("spin"), 4.0), &by, |_, _| NOTHING);

    let by_spin = Wobble::new(&truth, "held_lean_and_spin", "spin");
    let study = with(format!("design a = {lean} rad; design w = {spin} rad/s; steady spin = w; steady lean = a;"));
    by_spin.check(&study.guess(of("yaw"), -1.0), &by, |_, _| NOTHING);

    // lean = c a^2, spin = v / r
    let (a, v) = (0.5, spin * 0.5);
    let c = lean / (a * a);
    let text = format!("design a = {a}; design v = {v} m/s; let c = {c}; steady lean = c * a^2; steady spin = v / r_;");
    let r = 0.5;
    let by = [NOTHING, [1.0, 0.0, -v / (r * r)], [0.0, 2.0 * c * a, 0.0], [0.0, 0.0, 1.0 / r]];
    let by_two = |i: usize, j: usize| match (i.min(j), i.max(j)) {
        (1, 1) => [0.0, 0.0, 2.0 * v / (r * r * r)],
        (1, 3) => [0.0, 0.0, -1.0 / (r * r)],
        (2, 2) => [0.0, 2.0 * c, 0.0],
        _ => NOTHING,
    };
    let study = with(text).guess(of("yaw"), -1.0);
    by_spin.check(&study, &by, by_two);

    // the same as generated code
    let generated = Study::<RollingCoin>::new(RollingCoin)
        .design(RollingCoin::a, a)
        .design(RollingCoin::v, v)
        .guess(RollingCoin::height, 0.5)
        .guess(RollingCoin::yaw, -1.0);
    let generated = generated.design(RollingCoin::c, c);
    let with_c = [by.as_slice(), &[[0.0, a * a, 0.0]]].concat();
    by_spin.check(&generated, &with_c, |i, j| match (i.min(j), i.max(j)) {
        (2, 4) => [0.0, 2.0 * a, 0.0],
        (i, j) => by_two(i, j),
    });
}

mechanism! {
    mechanism RollingCoin {
        design m_ = 1 kg;
        design r_ = 0.5 m;
        design a = 0.5;
        design v = 2 m/s;
        design c = 1;
        gravity 9.81 m/s^2 along -z;
        body base: massless;
        body mast: massless;
        body fork: massless;
        body wheel: disk(mass: m_, radius: r_, axis: y);
        joint travel: planar(forward: x, side: y, yaw: z) from ground to base, coasting;
        joint height: prismatic(z) from base to mast;
        joint lean: revolute(x) from mast to fork;
        joint spin: revolute(y) from fork to wheel, coasting;
        point hub: wheel;
        point road: ground;
        constraint contact: rolling(wheel: hub, axis: y, radius: r_, on: road);
        steady lean = c * a^2;
        steady spin = v / r_;
    }
}

/// Values that inputs set move with them; those of samples are their own.
#[test]
fn declared_values_follow_inputs_and_samples() {
    let truth = truth("U2_coin_family");
    let parameter = |name: &str| number(&truth["parameters"][name]);
    let (lean, spin) = (parameter("lean"), parameter("spin"));
    let of = |name: &str| unknown(&coin(), name);
    let study = coin_with(&format!("input v: m/s; design a = {lean} +/- 1%; steady lean = a; steady spin = v / r_;"));
    let study = study.guess(of("height"), 0.5).guess(of("yaw"), -1.0).input(Input::new(0), spin * 0.5);
    let modes = study.modes().expect("a steady motion");
    let mode = modes.modes.iter().position(|mode| mode.frequency().is_some());
    let mode = mode.expect("it wobbles");
    let slopes = study.sensitivities().expect("derivatives");
    let own = slopes.modes[mode].frequency().expect("derivatives");
    let wobble = Wobble::new(&truth, "held_lean_and_spin", "spin");
    close(own.by_input[0], wobble.first[2] / 0.5, 1e-9, "by the input");
    close(own.by_design[2], wobble.first[1], 1e-9, "by the lean");
    let faster = study.clone().input(Input::new(0), 3.0).equilibrium().expect("faster");
    close(faster.coordinates[of("spin").index()], 6.0, 1e-12, "spin");
    close(faster.coordinates[of("lean").index()], lean, 1e-12, "lean");

    let spread = study.first_order().expect("a spread");
    let spread = &spread.modes[mode];
    let sigma = spread.frequency().expect("a frequency").sigma;
    close(sigma, (wobble.first[1] * lean * 0.01 / 3.0).abs(), 1e-8, "spread");
    let study = study.samples(500);
    let sampled = study;
    let found = sampled.monte_carlo().expect("samples");
    let statistics = found.modes[mode].as_ref().expect("statistics");
    assert_eq!(statistics.count, 500);
    let sampled = statistics.sigma.expect("a sigma");
    assert!((sampled / sigma - 1.0).abs() < 0.1, "{sampled} {sigma}");
}

#[test]
fn declared_values_and_others() {
    let of = |name: &str| unknown(&coin(), name);
    let declared = coin_with("steady lean = 20 deg; steady spin = 4 rad/s;");
    let declared = declared.guess(of("yaw"), -1.0);
    let held = |study: Study<Interpreted>| {
        let state = study.guess(of("height"), 0.5).equilibrium();
        let free = state.expect("a steady motion").free;
        let held = free.held.iter().map(|x| (x.unknown, x.value));
        let mut held: Vec<_> = held.collect();
        held.sort_by_key(|held| held.0);
        held
    };
    let (lean, spin, yaw) = (of("lean"), of("spin"), of("yaw"));
    let twenty = 20.0_f64.to_radians();
    let places = |study| held(study).into_iter().map(|pair| pair.0).collect::<Vec<_>>();
    let sorted = |mut places: [usize; 2]| {
        places.sort_unstable();
        places
    };
    let found = held(declared.clone());
    assert!(found.contains(&(spin.index(), 4.0)), "{found:?}");
    let own = found.iter().find(|pair| pair.0 == lean.index()).expect("lean");
    close(own.1, twenty, 1e-12, "lean");
    // what the user holds replaces what is declared
    let found = held(declared.clone().hold(lean, 0.3));
    assert!(found.contains(&(spin.index(), 4.0)), "{found:?}");
    let own = found.iter().find(|pair| pair.0 == lean.index()).expect("lean");
    close(own.1, 0.3, 1e-12, "lean");
    let two = declared.clone().hold(yaw, -1.2).hold(spin, 4.0);
    assert_eq!(places(two), sorted([yaw.index(), spin.index()]));
    // a start completes what is declared
    let one = coin_with("steady lean = 20 deg;").start(yaw, -1.2);
    assert_eq!(places(one), sorted([lean.index(), yaw.index()]));
    // too many, or none to select
    let three = coin_with("steady lean = 0.3; steady spin = 4 rad/s; steady yaw = -1 rad/s;");
    let refused = three.guess(of("height"), 0.5).equilibrium();
    assert!(matches!(refused, Err(Error::NotHeld { dimension: 2, .. })), "{refused:?}");
    let pendulum = study_of_pendulum().equilibrium();
    assert!(
        matches!(&pendulum, Err(Error::NotHeld { dimension: 0, unknowns }) if unknowns == &["theta"]),
        "{pendulum:?}"
    );
}

fn study_of_pendulum() -> Study<Interpreted> {
    study(
        "mechanism Pendulum {
            gravity 9.81 m/s^2 along -z;
            body bar: rod(mass: 3 kg, length: 1 m, along: -z);
            joint theta: revolute(y) from ground to bar;
            steady theta = 10 deg;
        }",
    )
}

/// A rod that goes round on a shaft without torque at the declared speed `n w`: `cos tilt = 3 g / (2 l (n w)^2)`, and with
/// the shaft free to change its speed, `s^2 = -w^2 (1 + 3 cos^2 tilt)`.
#[test]
fn a_conical_pendulum() {
    let declared = study(
        "mechanism Conical {
            input w: rad/s;
            design l = 0.8 m;
            design n = 2;
            gravity 9.81 m/s^2 along -z;
            body shaft: massless;
            body bar: rod(mass: 1 kg, length: l, along: -z);
            joint spin: revolute(z) from ground to shaft, coasting;
            joint tilt: revolute(y) from shaft to bar;
            steady spin = n * w;
        }",
    );
    for w in [3.0, 5.0] {
        let study = declared.clone().input(Input::new(0), w).start(Coordinate::new(0), 0.9);
        let modes = study.modes().expect("it goes round");
        let at = |w: f64, l: f64, n: f64| {
            let cosine = 3.0 * 9.81 / (2.0 * l * (n * w).powi(2));
            n * w * (1.0 + 3.0 * cosine * cosine).sqrt()
        };
        let mode = modes.modes.iter().position(|mode| mode.frequency().is_some());
        let mode = mode.expect("it nods");
        let found = modes.modes[mode].frequency().expect("a frequency");
        close(found, at(w, 0.8, 2.0), 1e-11, "frequency");
        // cos^2 ~ l^-2 (n w)^-4
        let share = 3.0 * (3.0 * 9.81 / (2.0 * 0.8 * 4.0 * w * w)).powi(2);
        let slopes = study.sensitivities().expect("derivatives");
        let own = slopes.modes[mode].frequency().expect("derivatives");
        let by_speed = found * (1.0 - 2.0 * share / (1.0 + share));
        close(own.by_input[0], by_speed / w, 1e-10, "by the speed");
        close(own.by_design[1], by_speed / 2.0, 1e-10, "by the ratio");
        close(own.by_design[0], -found * share / (1.0 + share) / 0.8, 1e-10, "by the length");
    }
}
