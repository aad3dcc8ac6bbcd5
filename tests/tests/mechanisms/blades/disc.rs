//! Eight blades on a disc at rest, tuned and mistuned, in closed form.

use super::*;
use std::path::Path;

fn truth() -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("truth/flexible/F17_bladed_disc.json");
    serde_json::from_str(&std::fs::read_to_string(path).expect("values")).expect("JSON")
}

fn disc(truth: &Value, deviations: &[f64]) -> Study<Interpreted> {
    let of = |name: &str| number(&truth["parameters"][name]);
    let text = format!(
        "part Blade(J: kg*m^2) {{
            design k = {:?} N*m/rad;
            port root;
            body arm: rigid(mass: 1 kg, inertia: [J / 2, J / 2, J]);
            joint flap: revolute(z) from root to arm;
            force hinge: spring(on: flap, stiffness: k);
        }}
        mechanism Disc {{
            design kc = {:?} N*m/rad;
            design J = {:?} kg*m^2;
            body disk: massless;
            joint seat: fixed from ground to disk;
            cyclic blade[0..8] about z {{ use blade: Blade(J: J) with root: disk at [50 mm, 0, 0]; }}
            for i in 0..8 {{
                force tie[i]: potential(energy: kc * (blade[i].flap - blade[(i + 1) % 8].flap)^2 / 2);
            }}
        }}",
        of("k"),
        of("kc"),
        of("J")
    );
    let mut study = study(&text);
    for (k, deviation) in deviations.iter().enumerate() {
        let place = design(&study, &format!("blade[{k}].k"));
        study = study.design(eigentol::DesignVariable::new(place), of("k") * (1.0 + deviation));
    }
    study
}

#[test]
fn a_tuned_disc_has_nodal_diameters() {
    let truth = truth();
    let study = disc(&truth, &[]);
    let expected = numbers(&truth["tuned"]);
    let whirls = study.whirls().expect("kinds");
    let found = study.modes().expect("modes").frequencies();
    for (frequency, whirl) in found.iter().zip(whirls.iter()) {
        let pattern = whirl.and_then(|whirl| whirl.blades).expect("a pattern");
        let own = expected[pattern.nodal_diameters];
        assert!((frequency.expect("it oscillates") - own).abs() < 1e-12 * own, "{pattern:?}");
        assert!(pattern.share > 1.0 - 1e-12, "{pattern:?}");
    }
    let names: Vec<String> = whirls.iter().map(|whirl| whirl.expect("a kind").to_string()).collect();
    let pairs = ["1 diameter", "2 diameters", "3 diameters"].into_iter().flat_map(|name| [name; 2]);
    let names_expected: Vec<&str> = ["collective"].into_iter().chain(pairs).chain(["differential"]).collect();
    assert_eq!(names, names_expected);
    // Without ties all frequencies are equal, and modes are told apart by their patterns all the same.
    let ties = design(&study, "kc");
    let study = study.design(eigentol::DesignVariable::new(ties), 0.0);
    let names: Vec<String> =
        study.whirls().expect("kinds").iter().map(|whirl| whirl.expect("a kind").to_string()).collect();
    assert_eq!(names, names_expected);
    let modes = study.modes().expect("modes").with_whirls(study.whirls().expect("kinds"));
    assert!(modes.to_string().contains("2, 3"), "{modes}");
}

#[test]
fn a_mistuned_disc_has_derivatives_by_each_blade() {
    let truth = truth();
    let deviations = numbers(&truth["deviations"]);
    let study = disc(&truth, &deviations);
    let expected = numbers(&truth["mistuned"]);
    let k = number(&truth["parameters"]["k"]);
    let found = study.modes().expect("modes").frequencies();
    for (r, expected) in expected.iter().enumerate() {
        let frequency = found[r].expect("it oscillates");
        assert!((frequency - expected).abs() < 1e-12 * expected, "{r}: {frequency}");
    }
    for blade in 0..8 {
        let by = derivatives(&study, &format!("blade[{blade}].k"));
        for (r, by) in by.into_iter().enumerate() {
            let expected = number(&truth["mistuned_derivatives"][blade][r]) / k;
            close(by.expect("simple"), Complex::new(0.0, expected), 1e-10, 1e-3, &format!("{blade} {r}"));
        }
    }
}

#[test]
fn blades_that_are_not_equal_are_refused() {
    let text = |extra: &str| {
        format!(
            "mechanism Disc {{
                body disk: massless;
                joint seat: fixed from ground to disk;
                body arm[0..3]: rod(mass: 1 kg, length: 1 m, along: x);
                joint flap[0]: revolute(z) from disk to arm[0];
                joint flap[1]: revolute(z) from disk to arm[1] rotated(z, 120 deg);
                joint flap[2]: revolute(z) from disk to arm[2] rotated(z, 240 deg);
                for i in 0..3 {{ force hinge[i]: spring(on: flap[i], stiffness: 1 N*m/rad); }}
                {extra}
                cyclic flap[0..3] about z;
            }}"
        )
    };
    study(&text(""));
    let mistake = Interpreted::from_text(&text("force more: spring(on: flap[1], stiffness: 1 N*m/rad, rest: 0.1);"));
    let mistake = mistake.map(drop).expect_err("refused").to_string();
    assert!(mistake.contains("`flap[1]` feels other forces than `flap[0]`"), "{mistake}");
}

/// Amplitude of the worst blade over a fine grid, from the matrices written by hand.
fn worst(parameters: [f64; 4], stiffness: &[f64], order: usize) -> (f64, usize) {
    let [kc, inertia, damping, _] = parameters;
    let n = stiffness.len();
    let at = |w: f64| {
        let matrix = nalgebra::DMatrix::from_fn(n, n, |i, j| {
            let next = (i + 1) % n == j || (j + 1) % n == i;
            match (i == j, next) {
                (true, _) => Complex::new(stiffness[i] + 2.0 * kc - inertia * w * w, damping * w),
                (_, true) => Complex::new(-kc, 0.0),
                _ => Complex::new(0.0, 0.0),
            }
        });
        let phase = |k: usize| Complex::cis(std::f64::consts::TAU * (order * k) as f64 / n as f64);
        let force = nalgebra::DVector::from_fn(n, |k, _| phase(k));
        let response = matrix.lu().solve(&force).expect("damped");
        let worst = (0..n).max_by(|a, b| response[*a].norm().total_cmp(&response[*b].norm())).expect("a blade");
        (response[worst].norm(), worst)
    };
    let grid = (0..60_000).map(|k| at(245.0 + 12.0 * f64::from(k) / 60_000.0));
    grid.max_by(|a, b| a.0.total_cmp(&b.0)).expect("a frequency")
}

#[test]
fn mistuning_amplifies_the_worst_blade() {
    let parameters = [2.0, 0.004, 0.002, 250.0];
    let [kc, inertia, damping, k] = parameters;
    let text = format!(
        "part Blade() {{
            design k = {k:?} N*m/rad +/- 3%;
            port root;
            body arm: rigid(mass: 1 kg, inertia: [0.002, 0.002, {inertia:?}] kg*m^2);
            joint flap: revolute(z) from root to arm;
            force hinge: spring(on: flap, stiffness: k);
            force damp: damper(on: flap, damping: {damping:?} N*m*s/rad);
        }}
        mechanism Disc {{
            design kc = {kc:?} N*m/rad;
            body disk: massless;
            joint seat: fixed from ground to disk;
            cyclic blade[0..6] about z {{ use blade: Blade() with root: disk; }}
            for i in 0..6 {{
                force tie[i]: potential(energy: kc * (blade[i].flap - blade[(i + 1) % 6].flap)^2 / 2);
            }}
        }}"
    );
    let deviations = [0.011, -0.004, 0.0, 0.007, -0.013, 0.002];
    let built = |deviations: &[f64]| {
        let mut study = study(&text);
        for (blade, deviation) in deviations.iter().enumerate() {
            let place = design(&study, &format!("blade[{blade}].k"));
            study = study.design(eigentol::DesignVariable::new(place), k * (1.0 + deviation));
        }
        study
    };
    let asked = |study: &Study<Interpreted>| {
        let order = eigentol::mistuning::EngineOrder::of(study.description(), Some("blade"), Some("flap"), 2);
        eigentol::mistuning::EngineOrder { samples: 300, ..order.expect("blades") }
    };
    let brute = |deviations: &[f64]| {
        let stiffness: Vec<f64> = deviations.iter().map(|deviation| k * (1.0 + deviation)).collect();
        let mean = stiffness.iter().sum::<f64>() / 6.0;
        let (tuned, _) = worst(parameters, &[mean; 6], 2);
        let (amplitude, blade) = worst(parameters, &stiffness, 2);
        (amplitude / tuned, blade)
    };
    let study = built(&deviations);
    let found = study.mistuning(asked(&study)).expect("damped blades");
    let (factor, blade) = brute(&deviations);
    assert!((found.factor / factor - 1.0).abs() < 1e-5, "{} {factor}", found.factor);
    assert_eq!((found.built.blade, found.built.others), (blade, 0));
    let by_design = found.by_design.as_ref().expect("one worst blade");
    for blade in 0..6 {
        let moved = |step: f64| {
            let mut deviations = deviations;
            deviations[blade] += step;
            let study = built(&deviations);
            study.mistuning(eigentol::mistuning::EngineOrder { samples: 0, ..asked(&study) }).expect("blades").factor
        };
        let difference = (moved(1e-6) - moved(-1e-6)) / (2e-6 * k);
        let exact = by_design[design(&study, &format!("blade[{blade}].k"))];
        assert!((exact - difference).abs() < 1e-5 * difference.abs().max(1e-2), "{blade}: {exact} {difference}");
    }
    // Samples of the model are those of the whole, and none is above Whitehead's factor by more than its tuned mean.
    assert!(found.verified.0 > 0 && found.verified.1 < 1e-6, "{:?}", found.verified);
    assert_eq!(found.worst.iter().sum::<usize>(), 300);
    assert!(found.quantile(1.0) < Some(1.05 * found.whitehead()), "{found}");
    let tuned = built(&[0.0; 6]);
    let tuned = tuned.mistuning(asked(&tuned)).expect("blades");
    assert!((tuned.factor - 1.0).abs() < 1e-9 && tuned.by_design.is_none() && tuned.built.others == 5, "{tuned}");
    assert!(tuned.quantile(0.5) > Some(1.05), "{tuned}");
}

#[test]
fn modes_from_blocks_are_those_of_the_whole() {
    let text = "part Blade() {
            port root;
            body cuff: massless;
            body arm: rod(mass: 2 kg, length: 0.7 m, along: x);
            joint flap: revolute(-y) from root to cuff at [0.2 m, 0, 0];
            joint lag: revolute(z) from cuff to arm;
            force a: spring(on: flap, stiffness: 2000 N*m/rad);
            force b: spring(on: lag, stiffness: 900 N*m/rad);
            force c: damper(on: flap, damping: 3 N*m*s/rad);
        }
        mechanism Rotor {
            input omega: rad/s;
            body mast: massless;
            body hub: disk(mass: 8 kg, radius: 0.2 m, axis: z);
            joint spin: revolute(z) from ground to mast, driven at omega;
            joint heave: prismatic(z) from mast to hub;
            joint twist: revolute(z) from hub to rim;
            body rim: disk(mass: 3 kg, radius: 0.3 m, axis: z);
            force d: spring(on: heave, stiffness: 9e5 N/m);
            force e: spring(on: twist, stiffness: 9e4 N*m/rad);
            cyclic blade[0..7] about z { use blade: Blade() with root: rim; }
        }";
    let study = at(text, 40.0);
    let modes = study.modes().expect("modes");
    let mut without = study.description().clone();
    without.rings = Vec::new().into();
    let linear = &study.equilibrium().expect("steady motion").linear;
    let whole = eigentol::modes::modes_of(linear, modes.family, &without.into()).expect("modes");
    assert_eq!(modes.modes.len(), whole.modes.len());
    for (one, other) in modes.modes.iter().zip(&whole.modes) {
        assert!((one.s - other.s).norm() < 1e-9 * other.s.norm(), "{} {}", one.s, other.s);
        assert!(one.residual < 1e-10, "{:.1e}", one.residual);
    }
    let pure = study.whirls().expect("kinds");
    let patterns = pure.iter().flatten().filter_map(|whirl| whirl.blades);
    assert!(patterns.into_iter().all(|pattern| pattern.share > 1.0 - 1e-9));
}

/// Loops inside the blades are held by forces of their own, which say nothing about whether blades are equal.
#[test]
fn blades_may_hold_loops() {
    let study = study(
        "part Blade() {
            port root;
            body arm: rod(mass: 1 kg, length: 1 m, along: x);
            body link: massless;
            joint flap: revolute(z) from root to arm;
            joint pin: revolute(z) from root to link at [0, 0.2, 0] m;
            point a: arm at [0.3, 0, 0] m;
            point b: link at [0.3, 0, 0] m;
            body weight: point(mass: 0.5 kg);
            joint seat: fixed from link to weight at [0.3, 0, 0] m;
            constraint rod: distance(from: a, to: b, length: 0.2 m);
            force spring: spring(on: flap, stiffness: 10 N*m/rad);
        }
        mechanism Disc {
            body disk: massless;
            joint seat: fixed from ground to disk;
            cyclic blade[0..4] about z { use blade: Blade() with root: disk; }
        }",
    );
    // A parallelogram: both turn by one angle.
    let expected = (10.0_f64 / (1.0 / 3.0 + 0.5 * 0.09)).sqrt();
    let modes = study.modes().expect("modes").with_whirls(study.whirls().expect("kinds"));
    assert_eq!(modes.modes.len(), 4);
    for frequency in modes.frequencies() {
        assert!((frequency.expect("it oscillates") - expected).abs() < 1e-12 * expected);
    }
    // Alone, a blade is in all patterns, and no pair is one row.
    assert!(!modes.to_string().contains("1, 2"), "{modes}");
}
