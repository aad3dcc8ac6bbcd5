//! Events belong to the machine: random machines whose events are known in closed form, along grids of 2 to 200 points.

use eigentol::error::NotFound;
use eigentol::sweep::Change;
use eigentol::{Error, Input, Stability, Study};
use eigentol_interpreter::Interpreted;
use eigentol_statistics::random::RandomNumbers;

const HIGH: f64 = 40.0;

/// An event: its kind, its value, and how growth changes there.
type Event = (&'static str, f64, Option<Change>);

fn between(random: &mut RandomNumbers, low: f64, high: f64) -> f64 {
    low + random.fraction() * (high - low)
}

fn count(random: &mut RandomNumbers, least: usize, most: usize) -> usize {
    least + (random.fraction() * (most + 1 - least) as f64) as usize
}

fn study(text: &str) -> Study<Interpreted> {
    match Interpreted::from_text(text) {
        Ok(machine) => Study::new(machine),
        Err(error) => panic!("{error}\n{text}"),
    }
}

/// The events that a diagram with so many points lists.
fn listed(study: &Study<Interpreted>, points: usize, orders: &[f64]) -> Vec<Event> {
    let last = points as f64 - 1.0;
    let values: Vec<f64> = (0..points).map(|k| HIGH * k as f64 / last).collect();
    let found = study.campbell(Input::new(0), &values, orders).expect("a diagram");
    let searched = found.searched.as_ref().expect("a search");
    assert_eq!((searched.low, searched.high), (0.0, HIGH));
    assert!(searched.unresolved.is_empty() && searched.gaps.is_empty());
    let critical = found.critical.iter().map(|x| ("critical", x.value, None));
    let onsets = found.flutter_onsets.iter();
    let growth = onsets.map(|onset| ("growth", onset.value, Some(onset.change)));
    let lines = found.crossings.iter().map(|crossing| ("line", crossing.value, None));
    let mut all: Vec<Event> = critical.chain(growth).chain(lines).collect();
    all.sort_by(|a, b| a.1.total_cmp(&b.1));
    all
}

/// Compares the lists along several grids with the known events.
fn check(text: &str, orders: &[f64], mut known: Vec<Event>) {
    known.sort_by(|a, b| a.1.total_cmp(&b.1));
    let study = study(text);
    for points in [2, 3, 5, 11, 51, 200] {
        let events = listed(&study, points, orders);
        let kinds = |all: &[Event]| all.iter().map(|pair| (pair.0, pair.2)).collect::<Vec<_>>();
        assert_eq!(kinds(&events), kinds(&known), "{points} points\n{text}\n{events:?}\n{known:?}");
        for (found, known) in events.iter().zip(&known) {
            let off = (found.1 - known.1).abs();
            assert!(off < 1e-9 * HIGH, "{found:?}, not {known:?}\n{text}");
        }
    }
}

/// Masses on a turning base, each held in one direction: each loses its stiffness at its own frequency. A pair that
/// nothing holds along the axis is free.
#[test]
fn critical_speeds_of_sliders_also_close_together() {
    let mut random = RandomNumbers::new(1, 0);
    for free in [false, true] {
        for _ in 0..6 {
            let sliders = count(&mut random, 2, 6);
            let mut speeds: Vec<f64> = (0..sliders).map(|_| between(&mut random, 2.0, 38.0)).collect();
            // Two that are close together, between two points of most grids.
            speeds.push(speeds[0] * (1.0 + 10f64.powf(between(&mut random, -6.0, -2.0))));
            let mut text = String::from(
                "mechanism Sliders { input speed: rad/s; body base: massless;
                 joint turn: revolute(x) from ground to base, driven at speed;\n",
            );
            for (k, speed) in speeds.iter().enumerate() {
                let mass = between(&mut random, 0.5, 3.0);
                text += &format!(
                    "body b{k}: point(mass: {mass} kg); joint y{k}: prismatic(y) from base to b{k};
                     force f{k}: spring(on: y{k}, stiffness: {} N/m);\n",
                    mass * speed * speed
                );
            }
            if free {
                text += "body p: point(mass: 1 kg); body q: point(mass: 2 kg);
                    joint px: prismatic(x) from base to p; joint qx: prismatic(x) from base to q;
                    force fp: generalized(on: px, value: (300 N/m) * (qx - px));
                    force fq: generalized(on: qx, value: (300 N/m) * (px - qx));\n";
            }
            text += "}";
            let known = speeds.iter().map(|speed| ("critical", *speed, None));
            check(&text, &[], known.collect());
        }
    }
}

/// Oscillators whose damping is a product of factors linear in the input: growth begins and ends at their zeros.
#[test]
fn bands_of_growth() {
    let mut random = RandomNumbers::new(2, 0);
    for _ in 0..6 {
        let mut text = String::from("mechanism Bands { input speed: rad/s;\n");
        let mut known: Vec<Event> = Vec::new();
        for k in 0..count(&mut random, 1, 4) {
            let low = between(&mut random, 1.0, 38.0);
            let width = 10f64.powf(between(&mut random, -4.0, 0.0));
            let high = f64::min(low + width, 39.0);
            let stiffness = between(&mut random, 100.0, 1000.0);
            text += &format!(
                "body b{k}: point(mass: 1 kg); joint x{k}: prismatic(x) from ground to b{k};
                 force f{k}: spring(on: x{k}, stiffness: {stiffness} N/m);
                 force d{k}: generalized(on: x{k},
                    value: -(0.01 kg*s/rad^2) * (speed - {low} rad/s) * (speed - {high} rad/s) * rate(x{k}));\n"
            );
            known.push(("growth", low, Some(Change::Onset)));
            known.push(("growth", high, Some(Change::End)));
        }
        text += "}";
        check(&text, &[], known);
    }
}

/// A round rotor on isotropic bearings in fixed axes: `omega` is a frequency at every speed, and internal damping `ci`
/// beside an external `ce` starts growth at `omega (1 + ce / ci)`.
#[test]
fn rotors_with_internal_damping() {
    let mut random = RandomNumbers::new(3, 0);
    for _ in 0..6 {
        let omega: f64 = between(&mut random, 4.0, 12.0);
        let (outer, inner) = (between(&mut random, 0.1, 0.3), between(&mut random, 0.1, 0.3));
        let mass = between(&mut random, 0.5, 3.0);
        let (k, ce, ci) = (mass * omega * omega, mass * outer, mass * inner);
        let text = format!(
            "mechanism Rotor {{ input speed: rad/s; body s: massless; body disc: point(mass: {mass} kg);
             joint x: prismatic(x) from ground to s; joint y: prismatic(y) from s to disc;
             force kx: spring(on: x, stiffness: {k} N/m); force ky: spring(on: y, stiffness: {k} N/m);
             force cx: damper(on: x, damping: {ce} N*s/m); force cy: damper(on: y, damping: {ce} N*s/m);
             force ix: generalized(on: x, value: -({ci} N*s/m) * (rate(x) + speed * y));
             force iy: generalized(on: y, value: -({ci} N*s/m) * (rate(y) - speed * x)); }}"
        );
        let onset = omega * (1.0 + outer / inner);
        let mut known = Vec::new();
        if onset < HIGH {
            known.push(("growth", onset, Some(Change::Onset)));
        }
        check(&text, &[], known);
        let study = study(&text);
        let beyond = study.input(Input::new(0), onset * 1.01);
        let stability = beyond.equilibrium().expect("a state").stability;
        assert!(matches!(stability, Stability::Flutter { .. }), "{stability}");
    }
}

/// Undamped oscillators whose frequencies do not depend on the speed meet the engine orders where they equal them.
#[test]
fn resonances() {
    let mut random = RandomNumbers::new(4, 0);
    for _ in 0..6 {
        let mut text = String::from(
            "mechanism Lines { input speed: rad/s; design unused_ = 1 s/rad; output o = speed * unused_;\n",
        );
        let mut known: Vec<Event> = Vec::new();
        for k in 0..count(&mut random, 2, 5) {
            let frequency: f64 = between(&mut random, 3.0, 70.0);
            text += &format!(
                "body b{k}: point(mass: 2 kg); joint x{k}: prismatic(x) from ground to b{k};
                 force f{k}: spring(on: x{k}, stiffness: {} N/m);\n",
                2.0 * frequency * frequency
            );
            for order in [1.0, 2.0] {
                if frequency / order < HIGH {
                    known.push(("line", frequency / order, None));
                }
            }
        }
        text += "}";
        check(&text, &[1.0, 2.0], known);
    }
}

/// `s^2 - 2 a s + (k - u) = 0` grows with oscillation while `k - u > a^2`, without beyond; where `u = k`, one of the two
/// roots ceases to grow.
#[test]
fn flutter_turns_into_divergence_and_back() {
    let mut random = RandomNumbers::new(5, 0);
    for _ in 0..4 {
        let (a, k) = (between(&mut random, 0.5, 2.0), between(&mut random, 10.0, 30.0));
        let study = study(&format!(
            "mechanism Turning {{ input u: N/m; body p: point(mass: 1 kg); joint x: prismatic(x) from ground to p;
             force f: generalized(on: x, value: -({k} N/m - u) * x + ({} N*s/m) * rate(x)); }}",
            2.0 * a
        ))
        .stay();
        for (ends, change, words) in [
            ([0.0, HIGH], Change::ToDivergence, "flutter of mode 1 turns into divergence"),
            ([HIGH, 0.0], Change::ToFlutter, "divergence turns into flutter of mode"),
        ] {
            let found = study.campbell(Input::new(0), &ends, &[] as &[f64]);
            let found = found.expect("a diagram");
            let [turn] = &found.flutter_onsets[..] else {
                panic!("{found}");
            };
            assert_eq!(turn.change, change, "{found}");
            assert!((turn.value - (k - a * a)).abs() < 1e-8 * HIGH, "{found}");
            assert!(found.to_string().contains(words), "{found}");
            let [critical] = &found.critical[..] else {
                panic!("{found}");
            };
            assert!((critical.value - k).abs() < 1e-9 * HIGH, "{found}");
            let expected = match change {
                Change::ToDivergence => Change::End,
                _ => Change::Onset,
            };
            assert_eq!(critical.change, expected, "{found}");
        }
    }
}

/// Beck's column flutters at a load in proportion to its stiffness. Which of the two modes that merge grows is a matter of
/// rounding; the onset is the first one's.
#[test]
fn an_onset_is_of_the_first_of_two_modes_that_merge() {
    let load = |coordinates: usize, stiffness: f64| {
        let study = study(&format!(
            "mechanism Beck {{ input p: N;
             body b: beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: {stiffness} N*m^2, bending_y: {coordinates});
             joint c: fixed from ground to b; point e: b at tip; force f: follower(at: e, force: [-p, 0, 0]); }}"
        ));
        let found = study.campbell(Input::new(0), &[0.0, 30.0], &[] as &[f64]);
        let found = found.expect("a diagram");
        let [onset] = &found.flutter_onsets[..] else {
            panic!("{stiffness}: {found}");
        };
        let words = "onset of flutter of mode 1";
        assert!(found.to_string().contains(words), "{stiffness}: {found}");
        onset.value / stiffness
    };
    for coordinates in 3..7 {
        let expected = load(coordinates, 1.0);
        assert!((expected / 20.0509 - 1.0).abs() < 2e-2, "{expected}");
        for share in 190..=210 {
            let found = load(coordinates, 0.005 * f64::from(share));
            assert!((found / expected - 1.0).abs() < 1e-8, "{found} {expected}");
        }
    }
}

/// Round rotors beside each other, in coordinates that turn: frequencies `|omega +- u|` of different rotors cross, and
/// nothing ever grows.
#[test]
fn frequencies_that_cross_are_no_flutter() {
    let mut random = RandomNumbers::new(6, 0);
    for _ in 0..6 {
        let mut text = String::from(
            "mechanism Rotors { input speed: rad/s; body shaft: massless;
             joint spin: revolute(z) from ground to shaft, driven at speed;\n",
        );
        for k in 0..count(&mut random, 2, 3) {
            let omega = (10.0 * between(&mut random, 1.0, 9.0)).round() / 10.0;
            let stiffness = omega * omega;
            text += &format!(
                "body s{k}: massless; body d{k}: point(mass: 1 kg);
                 joint x{k}: prismatic(x) from shaft to s{k}; joint y{k}: prismatic(y) from s{k} to d{k};
                 force fx{k}: spring(on: x{k}, stiffness: {stiffness} N/m);
                 force fy{k}: spring(on: y{k}, stiffness: {stiffness} N/m);\n"
            );
        }
        text += "}";
        let study = study(&text);
        for _ in 0..16 {
            let ends = [between(&mut random, 0.0, 1.0), between(&mut random, 1.0, 20.0)];
            let ends = ends.map(|end| (10.0 * end).round() / 10.0);
            let found = study.campbell(Input::new(0), &ends, &[] as &[f64]);
            let found = found.expect("a diagram");
            assert!(found.flutter_onsets.is_empty(), "{ends:?} {found}\n{text}");
        }
    }
}

/// `x'' + a x + u y = 0` and `y'' + b y - u x = 0` merge at `u = (b - a) / 2`, several times the same as well as alone.
#[test]
fn equal_pairs_merge_once_each() {
    let mut random = RandomNumbers::new(7, 0);
    for copies in [1, 2, 3] {
        for _ in 0..3 {
            let a = between(&mut random, 5.0, 20.0);
            let onset = between(&mut random, 2.0, 15.0);
            let b = a + 2.0 * onset;
            let mut text = String::from("mechanism Copies { input u: N/m;\n");
            for k in 0..copies {
                text += &format!(
                    "body p{k}: point(mass: 1 kg); body q{k}: point(mass: 1 kg);
                     joint x{k}: prismatic(x) from ground to p{k}; joint y{k}: prismatic(x) from ground to q{k};
                     force f{k}: generalized(on: x{k}, value: -({a} N/m) * x{k} - u * y{k});
                     force g{k}: generalized(on: y{k}, value: -({b} N/m) * y{k} + u * x{k});\n"
                );
            }
            text += "}";
            let study = study(&text);
            for _ in 0..8 {
                let (low, high) = (between(&mut random, 0.0, 1.0), onset * between(&mut random, 1.05, 4.0));
                let found = study.events(Input::new(0), low, high, &[] as &[f64]);
                let found = found.expect("events").crossings;
                let values: Vec<(f64, Change)> = found.iter().map(|x| (x.value, x.change)).collect();
                assert_eq!(values.len(), copies, "{low} to {high}: {values:?}\n{text}");
                for (value, change) in &values {
                    assert_eq!(*change, Change::Onset);
                    assert!((value - onset).abs() < 1e-7 * high, "{values:?}\n{text}");
                }
            }
        }
    }
}

/// Where an equilibrium loses its stability to another one, the way goes on along that, whatever the range: there the
/// second mass never loses its stiffness.
#[test]
fn the_way_past_a_branch_point_is_the_stable_one() {
    let mut random = RandomNumbers::new(8, 0);
    for _ in 0..4 {
        let (first, second) = (between(&mut random, 2.0, 6.0), between(&mut random, 7.0, 12.0));
        let study = study(&format!(
            "mechanism Buckling {{ input u: N/m; body p: point(mass: 1 kg); body q: point(mass: 1 kg);
             joint x: prismatic(x) from ground to p; joint y: prismatic(y) from ground to q;
             force e: potential(energy: ({first} N/m - u) * x^2 / 2 + ({second} N/m - u) * y^2 / 2
                + (3 N/m^3) * x^4 + (12 N/m^3) * x^2 * y^2); }}"
        ));
        for _ in 0..16 {
            let high = second * 10f64.powf(between(&mut random, 0.02, 2.0));
            let found = study.events(Input::new(0), 0.0, high, &[] as &[f64]);
            let found = found.expect("events").critical;
            let values: Vec<f64> = found.iter().map(|x| x.value).collect();
            assert_eq!(values.len(), 1, "0 to {high}: {values:?}, {first}, {second}");
            assert!((values[0] - first).abs() < 1e-9 * high, "{values:?}, {first}");
        }
    }
}

/// Damping that touches zero from either side without passing it.
#[test]
fn growth_that_touches_zero() {
    for sign in ["-", ""] {
        let text = format!(
            "mechanism Touching {{ input u: rad/s; body p: point(mass: 1 kg); joint x: prismatic(x) from ground to p;
             force f: spring(on: x, stiffness: 50 N/m);
             force d: generalized(on: x, value: {sign}(0.01 kg*s/rad^2) * (u - 17 rad/s)^2 * rate(x)); }}"
        );
        for ends in [[0.0, HIGH], [HIGH, 0.0]] {
            let found = study(&text).stay().campbell(Input::new(0), &ends, &[] as &[f64]);
            let found = found.expect("a diagram");
            let [touch] = &found.flutter_onsets[..] else {
                panic!("{sign} {found}");
            };
            assert_eq!(touch.change, Change::Touch);
            assert!((touch.value - 17.0).abs() < 1e-6 * HIGH, "{found}");
            assert!(found.to_string().contains("mode 1 keeps its amplitude"));
        }
    }
}

/// What happens exactly at an end of the range is listed alike at either end, and once.
#[test]
fn events_at_the_ends_of_a_range() {
    let stiffness = "mechanism Softening { input u: N/m; body p: point(mass: 1 kg);
        joint x: prismatic(x) from ground to p; force f: generalized(on: x, value: -(4 N/m - u) * x); }";
    let damping = "mechanism Weakening { input u: N*s/m; body p: point(mass: 1 kg); body q: point(mass: 1 kg);
        joint x: prismatic(x) from ground to p; joint y: prismatic(x) from ground to q;
        force s: spring(on: x, stiffness: 9 N/m); force t: spring(on: y, stiffness: 19 N/m);
        force e: damper(on: y, damping: 0.1 N*s/m);
        force f: generalized(on: x, value: -(4 N*s/m - u) * rate(x)); }";
    let fold = "mechanism Fold { input u: N; body p: point(mass: 1 kg); joint x: prismatic(x) from ground to p;
        force f: generalized(on: x, value: -(4 N/m^2) * (1 m^2 - (x - 1 m)^2) + u); }";
    for (text, kinds) in [(stiffness, [1, 0]), (damping, [0, 1]), (fold, [1, 0])] {
        for (low, high) in [(0.0, 4.0), (4.0, 0.0), (4.0, 6.0), (6.0, 4.0), (0.0, 6.0)] {
            if text == fold && f64::max(low, high) > 4.0 {
                continue;
            }
            let found = study(text).stay().events(Input::new(0), low, high, &[] as &[f64]);
            let found = found.expect("events");
            let of = format!("{low} to {high}: {text}");
            assert_eq!([found.critical.len(), found.crossings.len()], kinds, "{of}");
            let critical = found.critical.iter().map(|x| x.value);
            for value in critical.chain(found.crossings.iter().map(|crossing| crossing.value)) {
                assert!((value - 4.0).abs() < 1e-9, "{value} {of}");
            }
        }
    }
    let reached = study(stiffness).critical_state(Input::new(0), 0.0, 4.0);
    assert_eq!(reached.expect("at the end").value, 4.0);
}

/// A plate on a spring, drawn across a gap of micrometres: it snaps at a third of the gap, at
/// `V^2 = 8 k g^3 / (27 eps A)`.
#[test]
fn pull_in_across_micrometres() {
    let mut random = RandomNumbers::new(6, 0);
    for _ in 0..6 {
        let stiffness = 10_f64.powf(between(&mut random, -1.0, 2.0));
        let gap = 10_f64.powf(between(&mut random, -7.0, -5.0));
        let area = 10_f64.powf(between(&mut random, -9.0, -7.0));
        let permittivity = 8.854_187_812_8e-12;
        let study = study(&format!(
            "mechanism PullIn {{ input v: 1; design k = {stiffness} N/m; design g = {gap} m;
             body plate: point(mass: 1e-9 kg); joint x: prismatic(x) from ground to plate;
             force leaf: spring(on: x, stiffness: k);
             force field: generalized(on: x, value: ({permittivity} N) * ({area} m^2) * v^2 / (2 * (g - x)^2)); }}"
        ));
        let snap = (8.0 * stiffness * gap.powi(3) / (27.0 * permittivity * area)).sqrt();
        let found = study.branches(Input::new(0), 0.0, 3.0 * snap);
        let found = found.expect("branches");
        let special = found.special();
        assert_eq!(special.len(), 1, "{found}");
        assert!((special[0].value / snap - 1.0).abs() < 1e-10, "{found}");
        let x = special[0].equilibrium.coordinates[0];
        assert!((3.0 * x / gap - 1.0).abs() < 1e-6, "{x} {found}");
        let state = study.critical_tolerance(Input::new(0), 0.0, 3.0 * snap);
        let spread = state.expect("a critical state").spread.expect("derivatives");
        for (found, expected) in spread.by_design.iter().zip([0.5 / stiffness, 1.5 / gap]) {
            assert!((found / (expected * snap) - 1.0).abs() < 1e-8, "{found}");
        }
        let beyond = study.input(Input::new(0), 2.0 * snap).equilibrium();
        assert!(matches!(beyond, Err(Error::NoEquilibrium { .. })), "{beyond:?}");
    }
}

/// Two plates on springs that draw each other: beyond their pull-in no state beside the pole passes for an equilibrium.
#[test]
fn two_plates_beyond_their_pull_in() {
    let law = "(8.8541878128e-12 N) * (1e-8 m^2) * v^2 / (2 * (2 um + y - x)^2)";
    let study = study(&format!(
        "mechanism Plates {{ input v: 1; body a: point(mass: 1e-9 kg); body b: point(mass: 1e-9 kg);
         joint x: prismatic(x) from ground to a; joint y: prismatic(x) from ground to b;
         force s: spring(on: x, stiffness: 1 N/m); force t: spring(on: y, stiffness: 3 N/m);
         force p: generalized(on: x, value: {law}); force q: generalized(on: y, value: -{law}); }}"
    ));
    // Both springs in series.
    let snap = (8.0 * 0.75 * 8e-18 / (27.0 * 8.854_187_812_8e-20_f64)).sqrt();
    for share in [1.01, 1.3, 2.0, 3.0, 10.0, 30.0] {
        let found = study.clone().input(Input::new(0), share * snap).equilibrium();
        match found {
            Ok(state) => {
                let [x, y] = [0, 1].map(|i| state.coordinates[i]);
                let force = 8.854_187_812_8e-20 * (share * snap).powi(2) / (2.0 * (2e-6 + y - x).powi(2));
                assert!((x / force - 1.0).abs() < 1e-9, "{share}: {x} {y}");
                assert!((3.0 * y / force + 1.0).abs() < 1e-9, "{share}: {x} {y}");
            }
            Err(Error::NoEquilibrium { reason, .. }) => {
                assert_eq!(reason, NotFound::Unbounded, "{share}");
            }
            Err(other) => panic!("{share}: {other}"),
        }
    }
}

/// Random masses coupled by springs, dampers, gyroscopic and circulatory forces that change with the speed: the list
/// tells how many oscillations grow anywhere, as eigenvalues of another library at many speeds count them, whatever the
/// range and the number of points.
#[test]
fn lists_equal_counting() {
    use nalgebra::{DMatrix, Schur};
    let mut random = RandomNumbers::new(9, 0);
    let mut events = 0;
    for case in 0..15 {
        let n = count(&mut random, 2, 3);
        let mut matrix = |symmetric: f64, skew: f64, diagonal: f64| {
            let any = DMatrix::from_fn(n, n, |_, _| between(&mut random, -1.0, 1.0));
            let (sum, difference) = (&any + any.transpose(), &any - any.transpose());
            let rest = DMatrix::from_fn(n, n, |i, j| if i == j { diagonal } else { 0.0 });
            sum * (0.5 * symmetric) + difference * (0.5 * skew) + rest
        };
        let damping = [0.0, 0.001, 0.05][case % 3];
        // Stiffness and damping, at speed 0 and per unit of speed.
        let parts = match case % 5 {
            0 => [(2.0, 0.0, 9.0), (0.5, 0.0, 0.0), (0.1, 0.0, 0.2), (0.1, 0.0, 0.0)],
            1 => [(2.0, 1.0, 9.0), (0.4, 2.0, 0.0), (0.0, 0.0, damping), (0.0, 0.0, 0.0)],
            2 => [(2.0, 0.0, -9.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 6.0, 0.0)],
            3 => [(0.02, 0.0, 8.0), (0.1, 0.1, 0.0), (0.0, 0.0, damping), (0.0, 0.0, 0.0)],
            _ => [(3.0, 1.0, 9.0), (2.0, 0.0, 0.0), (0.0, 0.0, damping), (0.0, 0.0, 0.0)],
        };
        let [k0, k1, c0, c1] = parts.map(|(symmetric, skew, diagonal)| matrix(symmetric, skew, diagonal));
        let mut text = String::from("mechanism Pencil { input speed: rad/s;\n");
        for i in 0..n {
            text += &format!("body b{i}: point(mass: 1 kg); joint x{i}: prismatic(x) from ground to b{i};\n");
        }
        for i in 0..n {
            let terms = (0..n).map(|j| {
                format!(
                    "({} N/m) * x{j} + ({} N*s/m/rad) * speed * x{j} + ({} N*s/m) * rate(x{j}) + ({} N*s^2/m/rad) * speed * rate(x{j})",
                    -k0[(i, j)], -k1[(i, j)], -c0[(i, j)], -c1[(i, j)]
                )
            });
            let terms: Vec<String> = terms.collect();
            text += &format!("force f{i}: generalized(on: x{i}, value: {});\n", terms.join(" + "));
        }
        text += "}";
        let flutter = |speed: f64| {
            let mut system = DMatrix::zeros(2 * n, 2 * n);
            for i in 0..n {
                system[(i, n + i)] = 1.0;
                for j in 0..n {
                    system[(n + i, j)] = -k0[(i, j)] - speed * k1[(i, j)];
                    system[(n + i, n + j)] = -c0[(i, j)] - speed * c1[(i, j)];
                }
            }
            let values = Schur::new(system).complex_eigenvalues();
            let grows = values.iter().filter(|s| s.im > 1e-7 && s.re > 1e-9);
            grows.count().cast_signed()
        };
        let study = study(&text).stay();
        for (ends, points) in [([0.0, 4.0], 2), ([4.0, 0.0], 11), ([0.7, 3.3], 4)] {
            let last = f64::from(points - 1);
            let grid = (0..points).map(|k| ends[0] + (ends[1] - ends[0]) * f64::from(k) / last);
            let found = study.campbell(Input::new(0), &grid.collect::<Vec<_>>(), &[] as &[f64]);
            let found = found.expect("a diagram");
            let searched = found.searched.as_ref().expect("a search");
            assert!(searched.unresolved.is_empty(), "{found}\n{text}");
            let at = |event: &eigentol::sweep::EventTolerance| event.value;
            let onsets = &found.flutter_onsets;
            events += onsets.len();
            let change = |event: &eigentol::sweep::EventTolerance| match event.change {
                Change::Onset | Change::ToFlutter => 1,
                Change::End | Change::ToDivergence => -1,
                _ => 0,
            };
            let start = ends[0] - 1e-6 * (ends[1] - ends[0]);
            let (mut last, mut expected) = (start, flutter(ends[0]));
            for k in 1..=200 {
                let speed = ends[0] + (ends[1] - ends[0]) * f64::from(k) / 200.0;
                let near = |x: f64| onsets.iter().any(|event| (at(event) - x).abs() < 1e-4);
                if near(speed) {
                    continue;
                }
                let between = |x: f64| (x - last) * (speed - x) > 0.0;
                let new = onsets.iter().filter(|event| between(at(event)));
                expected += new.map(change).sum::<isize>();
                assert_eq!(flutter(speed), expected, "{speed}: {found}\n{text}");
                last = speed;
            }
        }
    }
    assert!(events > 20, "{events}");
}
