//! Frequencies, first and second derivatives of free machines against values computed in 60 digits.

use eigentol::sensitivity::Quantity;
use eigentol::{Behaviour, Coordinate, Study};
use eigentol_interpreter::Interpreted;
use serde_json::Value;

use super::common::{close, designs, frequencies, machine, number, numbers, study, truth};

/// The positions of the modes that oscillate.
fn oscillating(study: &Study<Interpreted>) -> Vec<usize> {
    let modes = study.modes().expect("modes").modes;
    let all = modes.iter().enumerate();
    all.filter(|(_, mode)| mode.frequency().is_some()).map(|(r, _)| r).collect()
}

fn free(study: &Study<Interpreted>) -> usize {
    let modes = study.modes().expect("modes").modes;
    modes.iter().filter(|mode| mode.behaviour == Behaviour::Free).count()
}

/// Compares first derivatives of frequencies, and Hessians where they are stored.
fn check_derivatives(
    study: &Study<Interpreted>,
    first: impl Fn(&str, usize) -> Option<f64>,
    second: impl Fn(&str, &str, usize) -> Option<f64>,
) {
    let (first_tolerance, second_tolerance) = (1e-9, 1e-8);
    let names: Vec<String> =
        (study.description().design.iter()).map(|info| info.name.trim_end_matches('_').to_owned()).collect();
    let slopes = study.sensitivities().expect("derivatives");
    let mut compared = 0;
    for (k, r) in oscillating(study).into_iter().enumerate() {
        let own = slopes.modes[r].frequency().expect("derivatives of a frequency");
        let curvature = study.mode_curvature(r).expect("second derivatives");
        let hessian = curvature.of(Quantity::Frequency).expect("of a frequency").by_design;
        let largest = (0..names.len())
            .flat_map(|i| (0..names.len()).map(move |j| (i, j)))
            .fold(0.0_f64, |most, (i, j)| most.max(hessian[i][j].abs()));
        assert!(curvature.asymmetry < 1e-9, "asymmetry {}", curvature.asymmetry);
        for (i, name) in names.iter().enumerate() {
            if let Some(expected) = first(name, k) {
                close(own.by_design[i], expected, first_tolerance, &format!("d{k}/d{name}"));
                compared += 1;
            }
            for (j, other) in names.iter().enumerate() {
                if let Some(expected) = second(name, other, k) {
                    let error = (hessian[i][j] - expected).abs();
                    assert!(
                        error <= second_tolerance * expected.abs().max(1e-4 * largest),
                        "d2{k}/d{name}d{other}: {} instead of {expected}",
                        hessian[i][j]
                    );
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 0);
}

fn entry<'a>(of: &'a Value, a: &str, b: &str) -> Option<&'a Value> {
    of.get(format!("{a} {b}")).or_else(|| of.get(format!("{b} {a}")))
}

const TRAIN: [(&str, &str); 7] = [
    ("J1", "kg*m^2"),
    ("J2", "kg*m^2"),
    ("J3", "kg*m^2"),
    ("J4", "kg*m^2"),
    ("k1", "N*m/rad"),
    ("k2", "N*m/rad"),
    ("n", ""),
];

/// The geared train in absolute angles, in relative ones, and in a mixture.
fn trains(truth: &Value, extra: &str) -> Vec<(&'static str, String)> {
    let wheel = |name: &str, j: &str| format!("body {name}: rigid(mass: 1 kg, inertia: [1 kg*m^2, 1 kg*m^2, {j}]);\n");
    let bodies = [("w1", "J1_"), ("w2", "J2_"), ("w3", "J3_"), ("w4", "J4_")].map(|(name, j)| wheel(name, j)).concat();
    let designs = designs(truth, &TRAIN);
    let absolute = "
        joint p1: revolute(z) from ground to w1;
        joint p2: revolute(z) from ground to w2;
        joint p4: revolute(z) from ground to w4;
        joint p3: revolute(z) from ground to w3;
        constraint gear: equation(zero: p3 - n_ * p2);
        force s1: potential(energy: k1_ * (p2 - p1)^2 / 2);
        force s2: potential(energy: k2_ * (p4 - p3)^2 / 2);
    ";
    let relative = "
        joint p1: revolute(z) from ground to w1;
        joint d2: revolute(z) from w1 to w2;
        joint p3: revolute(z) from ground to w3;
        joint d4: revolute(z) from w3 to w4;
        constraint gear: equation(zero: p3 - n_ * (p1 + d2));
        force s1: spring(on: d2, stiffness: k1_);
        force s2: spring(on: d4, stiffness: k2_);
        output p4 = p3 + d4;
    ";
    let mixed = "
        joint p1: revolute(z) from ground to w1;
        joint d2: revolute(z) from w1 to w2;
        joint p4: revolute(z) from ground to w4;
        joint d3: revolute(z) from w4 to w3;
        constraint gear: equation(zero: p4 + d3 - n_ * (p1 + d2));
        force s1: spring(on: d2, stiffness: k1_);
        force s2: spring(on: d3, stiffness: k2_);
    ";
    [("absolute", absolute), ("relative", relative), ("mixed", mixed)]
        .map(|(name, joints)| {
            let text = format!("mechanism Train {{\n{designs}{bodies}{joints}{extra}}}");
            (name, text)
        })
        .into()
}

#[test]
fn a_geared_train_in_any_coordinates() {
    let truth = truth("N1_geared_train");
    let mut all = Vec::new();
    for (name, text) in trains(&truth, "") {
        let study = study(&text);
        let found = frequencies(&study);
        for (found, expected) in found.iter().zip(numbers(&truth["frequencies"])) {
            close(*found, expected, 1e-12, name);
        }
        assert_eq!((found.len(), free(&study)), (2, 1), "{name}");
        check_derivatives(
            &study,
            |b, k| Some(number(&truth["first"][b][k])),
            |a, b, k| entry(&truth["hessian"], a, b).map(|values| number(&values[k])),
        );
        all.push(found);
    }
    for found in &all[1..] {
        for (a, b) in found.iter().zip(&all[0]) {
            close(*a, *b, 1e-11, "in other coordinates");
        }
    }
}

#[test]
fn a_free_body_in_the_plane() {
    let truth = truth("N2_free_base");
    let units = [
        ("M", "kg"),
        ("I", "kg*m^2"),
        ("m", "kg"),
        ("l", "m"),
        ("a", "m"),
        ("h", "m"),
        ("kt", "N*m/rad"),
        ("rest", "rad"),
        ("ks", "N/m"),
        ("l0", "m"),
    ];
    let text = format!(
        "mechanism FreeBase {{
            {}
            body base: rigid(mass: M_, inertia: [1 kg*m^2, 1 kg*m^2, I_]);
            body arm: rod(mass: m_, length: l_, along: x);
            joint place: planar(px: x, py: y, th: z) from ground to base;
            joint al: revolute(z) from base to arm at [a_, 0, 0];
            force hinge: spring(on: al, stiffness: kt_, rest: rest_);
            point top: base at [0, h_, 0];
            point tip: arm at [l_, 0, 0];
            force strut: spring_damper(from: top, to: tip, stiffness: ks_, length: l0_);
        }}",
        designs(&truth, &units)
    );
    // Where the base stands makes no difference.
    for place in [[0.0, 0.0, 0.0], [0.3, -2.0, 2.5]] {
        let mut study = study(&text);
        for (j, value) in place.into_iter().chain([1.0]).enumerate() {
            study = study.start(Coordinate::new(j), value);
        }
        let state = study.equilibrium().expect("modes");
        let q = &state.coordinates;
        close(q[3], number(&truth["equilibrium"]), 1e-12, "angle of the arm");
        for (j, value) in place.into_iter().enumerate() {
            assert!((q[j] - value).abs() < 1e-12, "it moved: {q:?}");
        }
        assert_eq!(free(&study), 3);
        let found = frequencies(&study);
        assert_eq!(found.len(), 1);
        close(found[0], number(&truth["frequency"]), 1e-12, "frequency");
        check_derivatives(
            &study,
            |b, _| Some(number(&truth["first"][b]["frequency"])),
            |a, b, _| entry(&truth["hessian"], a, b).map(|values| number(&values["frequency"])),
        );
        let shift = study.equilibrium_shift().expect("its shift");
        for (i, info) in machine(&text).description().design.iter().enumerate() {
            let expected = &truth["first"][info.name.trim_end_matches('_')]["equilibrium"];
            close(shift.by_design[3][i], number(expected), 1e-10, &info.name);
        }
    }
}

#[test]
fn a_disc_on_an_incline() {
    let truth = truth("N3_disc_on_incline");
    let units = [("m", "kg"), ("r", "m"), ("k", "N/m"), ("l0", "m"), ("h", "m"), ("slope", "rad")];
    let text = format!(
        "mechanism DiscOnIncline {{
            {}
            gravity [9.81 m/s^2 * sin(slope_), 0, -9.81 m/s^2 * cos(slope_)];
            body base: massless;
            body wheel: disk(mass: m_, radius: r_, axis: y);
            joint x: prismatic(x) from ground to base at [0, 0, r_];
            joint spin: revolute(y) from base to wheel;
            point post: ground at [0, 0, h_];
            point hub: wheel;
            point road: ground;
            force k: spring_damper(from: post, to: hub, stiffness: k_, length: l0_);
            constraint contact: rolling(wheel: hub, axis: y, radius: r_, on: road);
        }}",
        designs(&truth, &units)
    );
    let study = study(&text).start(Coordinate::new(0), 0.1);
    let state = study.equilibrium().expect("modes");
    close(state.coordinates[0], number(&truth["x"]), 1e-12, "place");
    let found = frequencies(&study);
    assert_eq!((found.len(), free(&study)), (1, 1));
    close(found[0], number(&truth["frequency"]), 1e-11, "frequency");
    check_derivatives(
        &study,
        |b, _| Some(number(&truth["first"][b]["frequency"])),
        |a, b, _| entry(&truth["hessian"], a, b).map(|values| number(&values["frequency"])),
    );
}

#[test]
fn a_free_spacecraft() {
    let truth = truth("N4_free_spacecraft");
    let parameters = truth["parameters"].as_object().expect("parameters");
    let unit = |name: &str| match name {
        "M" | "m1" | "m2" => "kg",
        "k1" | "k2" => "N*m/rad",
        "rest1" | "rest2" => "rad",
        "ks" => "N/m",
        name if name.starts_with(['I', 'J']) => "kg*m^2",
        _ => "m",
    };
    let designs: String = (parameters.iter())
        .map(|(name, value)| format!("design {name}_ = {} {};\n", number(value), unit(name)))
        .collect();
    let text = format!(
        "mechanism Spacecraft {{
            {designs}
            body hull: rigid(mass: M_, inertia: [Ix_, Iy_, Iz_]);
            body p1: rigid(mass: m1_, inertia: [J1x_, J1y_, J1z_], center: [c1x_, c1y_, c1z_]);
            body p2: rigid(mass: m2_, inertia: [J2x_, J2y_, J2z_], center: [c2x_, c2y_, c2z_]);
            joint fly: free(px: x, py: y, pz: z, psi: z, beta: y, phi: x) from ground to hull;
            joint a1: revolute(x) from hull to p1 at [h1x_, h1y_, h1z_];
            joint a2: revolute(z) from hull to p2 at [h2x_, h2y_, h2z_];
            force s1: spring(on: a1, stiffness: k1_, rest: rest1_);
            force s2: spring(on: a2, stiffness: k2_, rest: rest2_);
            point e1: p1 at [2 * c1x_, 2 * c1y_, 2 * c1z_];
            point e2: p2 at [2 * c2x_, 2 * c2y_, 2 * c2z_];
            force strut: spring_damper(from: e1, to: e2, stiffness: ks_, length: l0_);
        }}"
    );
    for turned in [[0.0; 3], [0.7, -0.4, 2.0]] {
        let mut study = study(&text);
        for (j, value) in turned.into_iter().enumerate() {
            study = study.start(Coordinate::new(3 + j), value);
        }
        let state = study.equilibrium().expect("modes");
        let q = &state.coordinates;
        for (j, expected) in numbers(&truth["equilibrium"]).into_iter().enumerate() {
            close(q[6 + j], expected, 1e-12, "angle");
        }
        let found = frequencies(&study);
        assert_eq!((found.len(), free(&study)), (2, 6));
        for (found, expected) in found.iter().zip(numbers(&truth["frequencies"])) {
            close(*found, expected, 1e-10, "frequency");
        }
        check_derivatives(&study, |b, k| truth["first"].get(b).map(|values| number(&values[k])), |_, _, _| None);
    }
}

/// With a damper against the ground one zero remains, and the speed of coasting dies out.
#[test]
fn a_geared_train_with_drag() {
    let truth = truth("N1_geared_train");
    let drag = format!(
        "design d_ = {} N*m*s/rad;\npoint far: w4;\nforce air: drag(at: far, turning_damping: d_);\n",
        number(&truth["with_drag"]["d"])
    );
    let truth_of = &truth["with_drag"];
    for (name, text) in trains(&truth, &drag) {
        let study = study(&text);
        let modes = study.modes().expect(name).modes;
        assert_eq!(free(&study), 1, "{name}");
        let moving: Vec<usize> = (0..modes.len()).filter(|&r| modes[r].behaviour != Behaviour::Free).collect();
        let expected = truth_of["eigenvalues"].as_array().expect("a list");
        assert_eq!(moving.len(), expected.len(), "{name} {modes:?}");
        let slopes = study.sensitivities().expect("derivatives");
        for (k, &r) in moving.iter().enumerate() {
            let own = numbers(&expected[k]);
            let error = (modes[r].s.re - own[0]).hypot(modes[r].s.im - own[1]);
            assert!(error <= 1e-12 * own[0].hypot(own[1]), "{name}: {} {own:?}", modes[r].s);
            let s = slopes.modes[r].s().expect("derivatives").by_design;
            for (i, info) in study.description().design.iter().enumerate() {
                let name = info.name.trim_end_matches('_');
                let own = numbers(&truth_of["first"][name][k]);
                let error = (s[i].re - own[0]).hypot(s[i].im - own[1]);
                assert!(error <= 1e-9 * own[0].hypot(own[1]), "{name}: {} {own:?}", s[i]);
            }
        }
    }
}
