//! Members of families of steady motions against closed forms: spreads, ways along an input, critical states, samples.

use eigentol::branches::SpecialKind;
use eigentol::error::NoDerivative;
use eigentol::sweep::{Change, Condition};
use eigentol::{Coordinate, DesignVariable, Error, Input, Parameter, Stability, Study};
use eigentol_interpreter::Interpreted;

use super::common::{close, study};

const G: f64 = 9.81;
const LENGTH: f64 = 0.8;
const RATIO: f64 = 2.0;
const SHAFT: f64 = 0.1;
/// The moment of inertia of the shaft, as a multiple of that of the rod.
const K: f64 = SHAFT / (LENGTH * LENGTH / 3.0);
const TILT: Coordinate<Interpreted> = Coordinate::new(0);

/// A rod that goes round on a shaft without torque, at `n` times the input. At the speed `s`,
/// `cos tilt = 3 g / (2 l s^2)`. The shaft has `k` times the moment of inertia of the rod about its end and is free to
/// change its speed: `omega^2 = s^2 sin^2 tilt (1 + 4 cos^2 tilt / (k + sin^2 tilt))`.
fn conical(more: &str) -> Study<Interpreted> {
    study(&format!(
        "mechanism Conical {{
            input w: rad/s; design l = {LENGTH} m; design n = {RATIO}; {more}
            gravity {G} m/s^2 along -z;
            body shaft: rigid(mass: 1 kg, inertia: [{SHAFT}, {SHAFT}, {SHAFT}] kg*m^2);
            body bar: rod(mass: 1 kg, length: l, along: -z);
            joint spin: revolute(z) from ground to shaft, coasting;
            joint tilt: revolute(y) from shaft to bar;
            steady spin = n * w; }}"
    ))
}

fn cosine(w: f64) -> f64 {
    1.5 * G / (LENGTH * (RATIO * w).powi(2))
}

fn frequency(w: f64) -> f64 {
    let x = cosine(w).powi(2);
    RATIO * w * ((1.0 - x) * (1.0 + 4.0 * x / (K + 1.0 - x))).sqrt()
}

/// With `x = cos^2 tilt ~ w^-4`.
fn by_speed(w: f64) -> f64 {
    let x = cosine(w).powi(2);
    let rest = K + 1.0 - x;
    let by_x = -1.0 / (1.0 - x) + 4.0 * (K + 1.0) / (rest * (rest + 4.0 * x));
    frequency(w) / w * (1.0 - 2.0 * x * by_x)
}

/// The speed, as the input sets it, above which the rod leaves the axis.
fn critical() -> f64 {
    (1.5 * G / LENGTH).sqrt() / RATIO
}

fn at(study: &Study<Interpreted>, w: f64) -> Study<Interpreted> {
    study.clone().input(Input::new(0), w).start(TILT, 0.9)
}

#[test]
fn tolerances_of_inputs_act_through_steady_values() {
    let w = 4.0;
    let study = at(&conical(""), w).relative_tolerance(Parameter::Input(Input::new(0)), 0.05).samples(4000);
    let modes = &study.modes().expect("it goes round").modes;
    let mode = modes.iter().position(|mode| mode.frequency().is_some());
    let mode = mode.expect("it nods");
    let sigma = by_speed(w).abs() * w * 0.05 / 3.0;
    let spread = study.first_order().expect("a spread");
    let found = spread.modes[mode].frequency().expect("a frequency").sigma;
    close(found, sigma, 1e-9, "spread");
    let sampled = study.monte_carlo().expect("samples");
    let statistics = sampled.modes[mode].as_ref().expect("statistics");
    assert_eq!(statistics.count, 4000);
    let found = statistics.sigma.expect("a sigma");
    assert!((found / sigma - 1.0).abs() < 0.04, "{found}, not {sigma}");
}

#[test]
fn members_along_an_input_in_either_direction() {
    let study = conical("");
    for values in [[2.5, 3.0, 4.0, 6.0], [6.0, 4.0, 3.0, 2.5]] {
        let study = at(&study, values[0]).start(TILT, cosine(values[0]).acos() - 0.1);
        let found = study.sweep(Input::new(0), &values).expect("a sweep");
        assert!(found.critical.is_empty() && found.flutter_onsets.is_empty());
        let diagram = study.campbell(Input::new(0), &values, &[] as &[f64]);
        let diagram = diagram.expect("a diagram");
        for (k, &w) in values.iter().enumerate() {
            let state = found.points[k].equilibrium.as_ref().expect("a state");
            close(state.coordinates[0], cosine(w).acos(), 1e-10, "tilt");
            close(state.coordinates[1], RATIO * w, 1e-12, "speed");
            let modes = found.points[k].modes.as_ref().expect("modes");
            let own = modes.modes.iter().find_map(|mode| mode.frequency());
            close(own.expect("it nods"), frequency(w), 1e-10, "frequency");
            let modes = diagram.points[k].modes.as_ref().expect("modes");
            let own = modes.iter().find_map(|mode| mode.behaviour.frequency());
            close(own.expect("it nods"), frequency(w), 1e-10, "in a diagram");
        }
        let all = study.branches(Input::new(0), values[0], values[3]);
        let branches = all.expect("branches").branches;
        for point in &branches[0].points {
            let [tilt, speed] = [0, 1].map(|i| point.equilibrium.coordinates[i]);
            close(tilt.cos(), cosine(point.value), 1e-9, "on a branch");
            close(speed, RATIO * point.value, 1e-12, "speed on a branch");
        }
    }
}

/// Where the rod leaves the axis, a pitchfork, `w = sqrt(3 g / 2 l) / n`.
#[test]
fn critical_states_of_families_have_derivatives() {
    let study = conical("");
    let value = critical();
    let found = study.critical_state(Input::new(0), 0.5, 4.0);
    let found = found.expect("a critical state");
    close(found.value, value, 1e-11, "critical speed");
    assert!(matches!(found.kind, SpecialKind::Pitchfork { .. }));
    let [length, ratio] = [0, 1].map(DesignVariable::new);
    let study =
        study.relative_tolerance(Parameter::Design(length), 0.01).relative_tolerance(Parameter::Design(ratio), 0.02);
    let event = study.critical_tolerance(Input::new(0), 0.5, 4.0);
    let spread = event.expect("a critical state").spread.expect("derivatives");
    close(spread.by_design[0], -value / (2.0 * LENGTH), 1e-9, "by l");
    close(spread.by_design[1], -value / RATIO, 1e-9, "by n");
    let second = study.critical_curvature(Input::new(0), 0.5, 4.0);
    let reason = NoDerivative::Family;
    assert_eq!(second, Err(Error::NoSensitivity { reason }));
    let branches = study.branches(Input::new(0), 0.5, 4.0).expect("branches");
    let special = branches.special();
    assert_eq!(special.len(), 1);
    close(special[0].value, value, 1e-10, "on branches");
}

/// Samples that are slower than the critical speed settle on the axis, on another branch than the nominal one.
#[test]
fn samples_of_members_stay_on_their_branch() {
    let w = 1.01 * critical();
    let ratio: DesignVariable<Interpreted> = DesignVariable::new(1);
    let study = conical("")
        .input(Input::new(0), w)
        .start(TILT, 0.2)
        .relative_tolerance(Parameter::Design(ratio), 0.03)
        .samples(4000);
    let modes = &study.modes().expect("it goes round").modes;
    let mode = modes.iter().position(|mode| mode.frequency().is_some());
    let found = study.monte_carlo().expect("samples");
    assert_eq!(found.counts.stable, 4000, "{:?}", found.counts);
    // P(z < -(1 - 1/1.01) / 0.01)
    let slower = 0.161_063_f64;
    let expected = 4000.0 * (1.0 - slower);
    let scatter = 4.0 * (4000.0 * slower * (1.0 - slower)).sqrt();
    let mode = found.modes[mode.expect("it nods")].as_ref();
    let count = mode.expect("statistics").count as f64;
    assert!((count - expected).abs() < scatter, "{count}, not {expected}");
}

/// Unknowns that are held have one value in a search, at whatever bounds the others start.
#[test]
fn searches_for_equilibria_hold_members() {
    let w = 4.0;
    let declared = at(&conical(""), w);
    let speed = 12.0;
    let free = study(&format!(
        "mechanism Conical {{
            gravity {G} m/s^2 along -z;
            body shaft: rigid(mass: 1 kg, inertia: [{SHAFT}, {SHAFT}, {SHAFT}] kg*m^2);
            body bar: rod(mass: 1 kg, length: {LENGTH} m, along: -z);
            joint spin: revolute(z) from ground to shaft, coasting;
            joint tilt: revolute(y) from shaft to bar; }}"
    ));
    let held = free.hold(Coordinate::new(1), speed);
    for (study, speed) in [(declared, RATIO * w), (held, speed)] {
        let search = study.search(&[]).expect("bounds");
        let found = study.equilibria(&search).expect("equilibria");
        let mut tilts: Vec<f64> = Vec::new();
        for state in &*found {
            close(state.coordinates[1], speed, 1e-12, "speed");
            tilts.push(state.coordinates[0].cos());
        }
        tilts.sort_by(f64::total_cmp);
        let round = 1.5 * G / (LENGTH * speed * speed);
        assert_eq!(tilts.len(), 4, "{tilts:?}");
        for (tilt, expected) in tilts.iter().zip([-1.0, round, round, 1.0]) {
            close(*tilt, expected, 1e-9, "tilt");
        }
    }
}

/// A disc rolls in circles, the faster the more it leans: `height = r cos lean`, and with the yaw rate `W`
/// `(C + m r^2) (s - W sin lean) = m g r tan lean / W - A W sin lean`.
#[test]
fn heights_of_a_coin_along_an_input() {
    let (radius, rate) = (0.5, 1.5);
    let text = format!(
        "mechanism Coin {{
            input a: rad; gravity {G} m/s^2 along -z;
            body base: massless; body mast: massless; body fork: massless;
            body wheel: disk(mass: 1 kg, radius: {radius} m, axis: y);
            joint travel: planar(forward: x, side: y, yaw: z) from ground to base, coasting;
            joint height: prismatic(z) from base to mast; joint lean: revolute(x) from mast to fork;
            joint spin: revolute(y) from fork to wheel, coasting;
            point hub: wheel; point road: ground;
            constraint contact: rolling(wheel: hub, axis: y, radius: {radius} m, on: road);
            steady lean = a; steady yaw = -{rate} rad/s; }}"
    );
    let study = study(&text);
    let all = &study.description().coordinates;
    let place = |name: &str| all.iter().position(|x| x.name == *name).expect("a name");
    let [height, lean, spin] = ["height", "lean", "spin"].map(place);
    let study = study.guess(Coordinate::new(height), radius);
    let leans = [0.1, 0.3, 0.6, 0.9];
    let found = study.sweep(Input::new(0), &leans).expect("a sweep");
    for (point, lean_asked) in found.points.iter().zip(leans) {
        let state = point.equilibrium.as_ref().expect("a state");
        let value = |index: usize| state.coordinates[index];
        close(value(lean), lean_asked, 1e-12, "lean");
        close(value(height), radius * lean_asked.cos(), 1e-10, "height");
        let (polar, diameter) = (radius * radius / 2.0, radius * radius / 4.0);
        let (sine, tangent) = (lean_asked.sin(), lean_asked.tan());
        let about_axis = (G * radius * tangent / rate - diameter * rate * sine) / (polar + radius * radius);
        close(value(spin), about_axis + rate * sine, 1e-9, "spin");
    }
}

/// A sleeping top with moments of inertia `A` about its tip: with `C^2 w^2 < 4 A m g l` two of its motions grow.
const TOP: [f64; 4] = [0.3, 0.05, 2e-3, 6e-4];

fn top(spin: &str) -> Study<Interpreted> {
    let [m, l, a, c] = TOP;
    study(&format!(
        "mechanism Top {{
            input w: rad/s;
            design m = {m} kg; design l = {l} m; design A = {a} kg*m^2; design C = {c} kg*m^2;
            gravity {G} m/s^2 along -z;
            body shaft: massless; body top: rigid(mass: m, inertia: [A, A, C], center: [0, 0, l]);
            joint tilt: universal(a: x, b: y) from ground to shaft;
            joint spin: revolute(z) from shaft to top, {spin} }}"
    ))
}

fn sleeping() -> f64 {
    let [m, l, a, c] = TOP;
    (4.0 * (a + m * l * l) * m * G * l).sqrt() / c
}

/// Two frequencies of the top merge where it falls asleep: the same place in either direction, without a derivative.
#[test]
fn a_top_falls_asleep_in_either_direction() {
    for (family, spin) in ["driven at w;", "coasting; steady spin = w;"].iter().enumerate() {
        for (low, high, change) in [(0.0, 300.0, Change::End), (300.0, 0.0, Change::Onset)] {
            let study = top(spin).start(Coordinate::new(0), 0.0).start(Coordinate::new(1), 0.0).stay();
            let diagram = study.campbell(Input::new(0), &[low, high], &[] as &[f64]);
            let diagram = diagram.expect("a diagram");
            let of = format!("family {family}, {low} to {high}: {diagram}");
            let found = study.events(Input::new(0), low, high, &[] as &[f64]);
            let found = found.expect("events");
            // At rest it falls in two directions alike; the least spin makes a flutter of them, at the end of the range.
            let spins = |value: f64| value > 1e-6;
            let crossings = found.crossings.iter().filter(|crossing| spins(crossing.value));
            let merged: Vec<_> = crossings.clone().filter(|x| x.merging).collect();
            let changes: Vec<_> = crossings.map(|crossing| crossing.change).collect();
            assert_eq!((merged.len(), &changes[..]), (1, &[change][..]), "{of}");
            assert_eq!(merged[0].condition, Condition::FlutterOnset);
            // A resolution of 1e-10 of the range.
            close(merged[0].value, sleeping(), 2e-9, &of);
            let mut onsets = diagram.flutter_onsets.iter().filter(|x| spins(x.value));
            let (Some(event), None) = (onsets.next(), onsets.next()) else {
                panic!("{of}");
            };
            close(event.value, sleeping(), 2e-9, &of);
            let reason = NoDerivative::Merge;
            assert_eq!(event.spread, Err(Error::NoSensitivity { reason }), "{of}");
        }
    }
}

/// A sleeping top that was asked to stay, with a tolerance of its moment `C`: it falls where `C < 2 sqrt(A m g l) / w`.
#[test]
fn samples_of_a_top_that_was_asked_to_stay() {
    let w = 1.02 * sleeping();
    let moment: DesignVariable<Interpreted> = DesignVariable::new(3);
    for spin in ["driven at w;", "coasting; steady spin = w;"] {
        let study =
            top(spin).input(Input::new(0), w).stay().relative_tolerance(Parameter::Design(moment), 0.06).samples(2000);
        let state = study.equilibrium().expect("it sleeps");
        assert!(state.stability.holds());
        assert!(!matches!(state.stability, Stability::Flutter { .. }));
        let found = study.monte_carlo().expect("samples");
        // P(z < -(1 - 1/1.02) / 0.02)
        let falls = 0.163_446_f64;
        let scatter = 4.0 * (2000.0 * falls * (1.0 - falls)).sqrt();
        let count = found.counts.flutter as f64;
        assert!((count - 2000.0 * falls).abs() < scatter, "{spin} {:?}", found.counts);
        assert_eq!(found.counts.stable + found.counts.flutter, 2000);
    }
}

/// The speed of a top is a steady value on which no force depends: with `D = C^2 w^2 - 4 A m g l`,
/// `omega = (C w +- sqrt(D)) / 2 A`.
#[test]
fn frequencies_of_a_sleeping_top() {
    let [m, l, a, c] = TOP;
    let (about_tip, w) = (a + m * l * l, 100.0);
    let root = ((c * w).powi(2) - 4.0 * about_tip * m * G * l).sqrt();
    for spin in ["driven at w;", "coasting; steady spin = w;"] {
        let study = top(spin).input(Input::new(0), w).stay();
        let solution = study.modes().expect("it sleeps");
        let slopes = study.sensitivities().expect("derivatives");
        let modes = solution.modes.iter().zip(&slopes.modes);
        let found = modes.filter_map(|(mode, x)| Some((mode.frequency()?, x.frequency()?)));
        let derived: Vec<_> = found.collect();
        assert_eq!(derived.len(), 2, "{spin}");
        for ((frequency, own), sign) in derived.iter().zip([-1.0, 1.0]) {
            let expected = (c * w + sign * root) / (2.0 * about_tip);
            close(*frequency, expected, 1e-11, spin);
            let by_speed = c / (2.0 * about_tip) * (1.0 + sign * c * w / root);
            close(own.by_input[0], by_speed, 1e-9, "by the speed");
            close(own.by_design[3], by_speed * w / c, 1e-9, "by C");
        }
    }
}
