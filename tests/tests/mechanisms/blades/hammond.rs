//! Ground resonance of four blades (C. E. Hammond, 1974), with values in eighty digits.

use super::*;
use crate::free_machines::common::truth;
use eigentol::modes::{Kind, Travel};

const UNITS: [(&str, &str); 11] = [
    ("mx", "kg"),
    ("my", "kg"),
    ("kx", "N/m"),
    ("ky", "N/m"),
    ("cx", "N*s/m"),
    ("cy", "N*s/m"),
    ("m", "kg"),
    ("S", "kg*m"),
    ("I", "kg*m^2"),
    ("e", "m"),
    ("cl", "N*m*s/rad"),
];

/// Blades with a stiffness of their own at the hinge, zero.
pub(super) const BLADE: &str = "
    part Blade(m: kg, S: kg*m, I: kg*m^2, e: m, cl: N*m*s/rad) {
        design kl = 0 N*m/rad +/- 10 N*m/rad;
        let J: kg*m^2 = I - S^2 / m;
        port root;
        body arm: rigid(mass: m, inertia: [0 kg*m^2, J, J], center: [S / m, 0 m, 0 m]);
        joint lag: revolute(z) from root to arm at [e, 0 m, 0 m];
        force hinge: spring(on: lag, stiffness: kl);
        force damp: damper(on: lag, damping: cl);
    }";

/// The rotor; `frame` moves along x alone.
fn rotor(truth: &Value, frame: &str) -> String {
    format!(
        "{BLADE}
        mechanism Hammond {{
            input omega: rad/s;
            {}
            body frame: {frame};
            body mast: point(mass: my);
            body hub: massless;
            joint x: prismatic(x) from ground to frame;
            joint y: prismatic(y) from frame to mast;
            joint spin: revolute(z) from mast to hub, driven at omega;
            force sx: spring(on: x, stiffness: kx);
            force sy: spring(on: y, stiffness: ky);
            force dx: damper(on: x, damping: cx);
            force dy: damper(on: y, damping: cy);
            cyclic blade[0..4] about z {{
                use blade: Blade(m: m, S: S, I: I, e: e, cl: cl) with root: hub;
            }}
        }}",
        declared(&truth["parameters"], &UNITS)
    )
}

fn check(name: &str, frame: &str, shared: &[(&str, &[&str])]) {
    let truth = truth(name);
    let text = rotor(&truth, frame);
    for case in truth["cases"].as_array().expect("cases") {
        let study = at(&text, number(&case["omega"]));
        let expected = list(&case["eigenvalues"]);
        let places = same_exponents(&study, &expected, 1e-10);
        // Collective and differential lag coincide.
        let alone = |r: usize| expected.iter().filter(|s| (*s - expected[r]).norm() < 1e-6).count() == 1;
        let own = UNITS
            .iter()
            .map(|(name, _)| (*name, vec![*name]))
            .filter(|(name, _)| !shared.iter().any(|(_, of)| of.contains(name)));
        let together = shared.iter().map(|(name, of)| (*name, of.to_vec()));
        for (variable, of) in own.chain(together).chain([("omega", vec!["omega"])]) {
            let sum = |order: &str, r: usize| -> Complex { of.iter().map(|one| complex(&case[order][*one][r])).sum() };
            let found = derivatives(&study, variable);
            for r in (0..expected.len()).filter(|r| alone(*r)) {
                let first = found[places[r]].expect("a derivative");
                let scale = 1e-6 * (0..expected.len()).map(|r| sum("first", r).norm()).fold(0.0, f64::max);
                close(first, sum("first", r), 1e-9, scale, &format!("{name} {variable} {r}"));
                if of.len() > 1 || variable == "omega" {
                    continue;
                }
                let curvature = study.mode_curvature(places[r]).expect("second derivatives");
                let k = design(&study, variable);
                let second = curvature.eigenvalue.expect("of s").by_design[k][k];
                let scale = 1e-3 * (0..expected.len()).map(|r| sum("second", r).norm()).fold(0.0, f64::max);
                close(second, sum("second", r), 1e-7, scale, &format!("{name} {variable} {r}, second"));
            }
        }
        // One blade has a quarter of the effect of all.
        for blade in 0..4 {
            let found = derivatives(&study, &format!("blade[{blade}].kl"));
            for r in (0..expected.len()).filter(|r| alone(*r)) {
                let all = complex(&case["first"]["kl"][r]);
                close(
                    found[places[r]].expect("a derivative") * 4.0,
                    all,
                    1e-9,
                    1e-12,
                    &format!("{name} one blade {r}"),
                );
            }
        }
    }
}

#[test]
fn on_a_support_that_is_not_symmetric() {
    check("B1_hammond_anisotropic", "point(mass: mx - my)", &[]);
}

#[test]
fn on_a_symmetric_support_seen_from_the_ground() {
    check("B2_hammond_isotropic", "massless", &[("my", &["mx", "my"])]);
}

#[test]
fn one_blade_by_hill() {
    let truth = truth("B1_hammond_anisotropic");
    let study = at(&rotor(&truth, "point(mass: mx - my)"), number(&truth["cases"][0]["omega"]));
    let one = &truth["cases"][0]["one_blade_kl"];
    let places = numbers(&one["modes"]);
    let found = derivatives(&study, "blade[1].kl");
    for (place, expected) in places.iter().zip(list(&one["derivatives"])) {
        let found = found[*place as usize - 1].expect("a derivative");
        close(found, expected, 1e-9, 1e-14, "one blade");
    }
}

#[test]
fn modes_have_the_names_of_rotor_dynamics() {
    let truth = truth("B1_hammond_anisotropic");
    let speed = number(&truth["cases"][0]["omega"]);
    let study = at(&rotor(&truth, "point(mass: mx - my)"), speed);
    let whirls = study.whirls().expect("kinds");
    let modes = study.modes().expect("modes");
    let names: Vec<String> = whirls.iter().map(|whirl| whirl.expect("a kind").to_string()).collect();
    assert_eq!(names[4..], ["regressive", "progressive"]);
    let mut together = [names[0].as_str(), &names[1]];
    together.sort_unstable();
    assert_eq!(together, ["collective", "differential"]);
    for (whirl, mode) in whirls.iter().zip(&modes.modes).skip(4) {
        let whirl = whirl.expect("a kind");
        assert_eq!(whirl.kind, Kind::Blades);
        let pattern = whirl.blades.expect("blades");
        let frequency = mode.frequency().expect("it oscillates");
        // Soft blades regress where they follow the rotation slower than it.
        let of_blade = match pattern.travel.expect("a direction") {
            Travel::Progressive => frequency - speed,
            Travel::Regressive => speed - frequency,
        };
        assert!((pattern.of_blade - of_blade).abs() < 1e-9 * speed);
        assert!(pattern.share > 0.9 && pattern.nodal_diameters == 1, "{pattern:?}");
    }
}

/// A force along x and an unbalance of the hub, against the multiblade equations written by hand.
#[test]
fn forced_vibrations_are_those_of_the_equations_by_hand() {
    let truth = truth("B1_hammond_anisotropic");
    let of = |name: &str| number(&truth["parameters"][name]);
    let (speed, w) = (31.4, 17.0);
    let text = rotor(&truth, "point(mass: mx - my)");
    let end = text.rfind('}').expect("the end");
    let text = format!(
        "{} point axis: hub at [0, 0, 0] m;
        force shaker: harmonic(on: x, force: 100 N, frequency: {w:?} rad/s);
        unbalance residual: on hub, amount: 0.3 kg*m;
        output ox = x; output oy = y; output lag = (blade[0].lag + blade[1].lag + blade[2].lag + blade[3].lag) / 4; }}",
        &text[..end]
    );
    let study = at(&text, speed);
    let response = study.forced_response().expect("a response");
    let [m, s, inertia, e, cl] = ["m", "S", "I", "e", "cl"].map(of);
    // x, y, cosine, sine
    let matrix = |w: f64| {
        let i = Complex::new(0.0, 1.0);
        let (z, n) = (i * w, 4.0);
        let blade = (z * z - speed * speed) * inertia + z * cl + speed * speed * e * s;
        let carried = z * (2.0 * speed * inertia) + cl * speed;
        let half = n / 2.0;
        nalgebra::DMatrix::from_row_slice(
            4,
            4,
            &[
                z * z * (of("mx") + n * m) + z * of("cx") + of("kx"),
                Complex::new(0.0, 0.0),
                Complex::new(0.0, 0.0),
                -z * z * half * s,
                Complex::new(0.0, 0.0),
                z * z * (of("my") + n * m) + z * of("cy") + of("ky"),
                z * z * half * s,
                Complex::new(0.0, 0.0),
                Complex::new(0.0, 0.0),
                z * z * half * s,
                blade * half,
                carried * half,
                -z * z * half * s,
                Complex::new(0.0, 0.0),
                -carried * half,
                blade * half,
            ],
        )
    };
    let turning = 0.3 * speed * speed;
    let forces = [
        (w, [Complex::new(100.0, 0.0), Complex::new(0.0, 0.0)]),
        (speed, [Complex::new(turning, 0.0), Complex::new(0.0, -turning)]),
    ];
    for (frequency, [fx, fy]) in forces {
        let zero = Complex::new(0.0, 0.0);
        let right = nalgebra::DVector::from_vec(vec![fx, fy, zero, zero]);
        let expected = matrix(frequency).lu().solve(&right).expect("damped");
        let mut harmonics = response.harmonics.iter();
        let harmonic = harmonics.find(|harmonic| (harmonic.frequency - frequency).abs() < 1e-9).expect("the frequency");
        for (k, found) in [harmonic.outputs[0], harmonic.outputs[1]].into_iter().enumerate() {
            let found = found.expect("an amplitude");
            close(found, expected[k], 1e-10, 1e-8, &format!("{frequency} {k}"));
        }
        assert!(harmonic.outputs[2].expect("an amplitude").norm() < 1e-12);
    }
}

#[test]
fn blades_of_their_own_are_told() {
    let truth = truth("B1_hammond_anisotropic");
    let study = at(&rotor(&truth, "point(mass: mx - my)"), 31.4);
    let summary = study.summary().expect("a summary");
    let mixed = |mode: usize| {
        let doubts = summary.trust[mode].doubts.iter();
        doubts.into_iter().any(|doubt| matches!(doubt, eigentol::tolerance::Doubt::Blades { .. }))
    };
    // Collective and differential lag do not reach the hub: a blade is alone in both.
    assert_eq!([0, 1, 2, 3, 4, 5].map(mixed), [true, true, false, false, false, false], "{summary}");
    let place = design(&study, "blade[1].kl");
    let error = study.design(eigentol::DesignVariable::new(place), 5.0).modes().map(drop).expect_err("unequal");
    assert!(error.to_string().contains("`blade[0].kl` and `blade[1].kl` differ"), "{error}");
}

#[test]
fn a_hub_that_turns_the_other_way_is_the_mirror_image() {
    let truth = truth("B1_hammond_anisotropic");
    let text = rotor(&truth, "point(mass: mx - my)");
    let speed = number(&truth["cases"][0]["omega"]);
    let expected = list(&truth["cases"][0]["eigenvalues"]);
    same_exponents(&at(&text, -speed), &expected, 1e-10);
    let other = text.replace("revolute(z) from mast to hub", "revolute(-z) from mast to hub");
    same_exponents(&at(&other, speed), &expected, 1e-10);
    let from_hub = text.replace("revolute(z) from mast to hub", "revolute(z) from hub to mast");
    same_exponents(&at(&from_hub, speed), &expected, 1e-10);
    let ring = text.replace("about z", "about -z");
    same_exponents(&at(&ring, speed), &expected, 1e-10);
}

/// A ring that no drive turns keeps the coordinates and the variables of each of its instances.
#[test]
fn a_ring_beside_the_rotor_is_its_own() {
    let truth = truth("B1_hammond_anisotropic");
    let text = rotor(&truth, "point(mass: mx - my)");
    let end = text.rfind('}').expect("the end");
    let text = format!(
        "part Reed {{ design k = 2 N*m/rad; port root; body arm: rod(mass: 1 kg, length: 1 m, along: y);
            joint swing: revolute(z) from root to arm; force spring: spring(on: swing, stiffness: k); }}
        {} cyclic reed[0..3] about z {{ use reed: Reed() with root: ground; }} }}",
        &text[..end]
    );
    let study = at(&text, 31.4);
    let place = design(&study, "reed[1].k");
    let study = study.design(eigentol::DesignVariable::new(place), 8.0);
    let mut expected = list(&truth["cases"][0]["eigenvalues"]);
    let reed = |k: f64| Complex::new(0.0, (3.0 * k).sqrt());
    expected.extend([reed(2.0), reed(2.0), reed(8.0)]);
    let places = same_exponents(&study, &expected, 1e-10);
    let slopes = derivatives(&study, "reed[1].k");
    let slope = slopes[places[8]].expect("a derivative");
    close(slope, Complex::new(0.0, 3.0 / (2.0 * 24.0_f64.sqrt())), 1e-10, 0.0, "its own");
}
