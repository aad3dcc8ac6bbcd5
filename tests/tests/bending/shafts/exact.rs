//! Closed forms and transfer matrices in seventy digits.

use std::fmt::Write;

use eigentol::forced::Measure;
use eigentol::modes::Sense;
use eigentol::{Complex, DesignVariable, Input, Output, Stability, Study};
use eigentol_interpreter::Interpreted;
use serde_json::Value;

use crate::beams::compared::{design, numbers, parameter, study, truth};

fn names(study: &Study<Interpreted>) -> Vec<String> {
    study.description().design.iter().map(|variable| variable.name.to_string()).collect()
}

/// Simple supports of both ends of `rotor`.
const SUPPORTS: &str = "point left: rotor at root; point right: rotor at tip;
    constraint left_y: equation(zero: position(left).y); constraint left_z: equation(zero: position(left).z);
    constraint right_y: equation(zero: position(right).y); constraint right_z: equation(zero: position(right).z);";

#[test]
fn a_spinning_shaft() {
    let file = truth(include_str!("../../../truth/flexible/F7_spinning_shaft.json"));
    let parameters = [("L", "m"), ("EI", "N*m^2"), ("kGA", "N"), ("rhoA", "kg/m"), ("rhoI", "kg*m")];
    let text = format!(
        "mechanism Shaft {{
            input omega: rad/s; {}
            body rotor: shaft(along: x, up: z, length: L, stiffness: EI, shear_stiffness: kGA, mass_per_length: rhoA,
                inertia: rhoI, elements: 40) spinning at omega;
            {SUPPORTS}
        }}",
        design(&file, &parameters)
    );
    for case in file["cases"].as_array().expect("cases") {
        let speed = case["Omega"].as_f64().expect("a speed");
        let study = study(&text, Some(speed));
        let (modes, sensitivities) = (study.modes().expect("modes"), study.sensitivities().expect("derivatives"));
        let all = numbers(&case["omega"]);
        // Negative frequencies are backward whirl; of each number of waves the two of lowest frequency.
        for (k, omega) in all.iter().enumerate().filter(|(k, _)| [1, 2].contains(&(k % 4))) {
            let near = |mode: &usize| (modes.modes[*mode].s.im / omega.abs() - 1.0).abs() < 1e-8;
            let mode = (0..modes.modes.len()).find(near).unwrap_or_else(|| panic!("{speed}: no mode near {omega}"));
            if speed == 0.0 {
                continue;
            }
            let sense = study.whirls().expect("kinds")[mode].expect("a shaft").sense();
            let with = if *omega > 0.0 { Sense::Forward } else { Sense::Backward };
            assert_eq!(sense, Some(with), "{speed} {omega}");
            let slopes = sensitivities.modes[mode].s().expect("derivatives");
            let first = |name: &str| numbers(&case["derivatives"][name]["first"])[k] * omega.signum();
            for (name, slope) in names(&study).iter().zip(&slopes.by_design) {
                let expected = first(name);
                assert!((slope.im / expected - 1.0).abs() < 1e-8, "{speed} {omega} {name}: {slope} {expected}");
            }
            let expected = first("Omega");
            assert!((slopes.by_input[0].im / expected - 1.0).abs() < 1e-8, "{speed} {omega}: {expected}");
            let curvature = study.mode_curvature(mode).expect("second derivatives");
            let curvature = curvature.eigenvalue.as_ref().expect("second derivatives");
            let second = |name: &str| numbers(&case["derivatives"][name]["second"])[k] * omega.signum();
            let named = names(&study);
            let own = named.iter().enumerate().map(|(j, name)| (name.as_str(), curvature.by_design[j][j].im));
            for (name, found) in own.chain([("Omega", curvature.by_input[0][0].im)]) {
                let scale = parameter(&file, name).min(speed.max(1.0)).powi(2);
                let error = (found - second(name)).abs() * scale;
                assert!(error < 1e-7 * omega.abs(), "{speed} {omega} {name}: {found} {}", second(name));
            }
        }
    }
}

/// Waves of a uniform shaft between simple supports under an axial force: `s`, and its derivative by the force, of the equations
/// that a wave leaves.
#[test]
fn a_shaft_under_tension() {
    let (length, bending, shear, mass, rotary) = (1.2_f64, 8350.0, 4.4e6, 5.55, 3.1e-4);
    for (force, speed, lag, slender) in [
        (20e3, 300.0, 0.0, true),
        (20e3, 300.0, 2e-5, true),
        (180e3, 0.0, 0.0, false),
        (-40e3, 200.0, 0.0, false),
        (0.0, 200.0, 0.0, true),
    ] {
        let theory = if slender { "shear: 0".to_owned() } else { format!("shear_stiffness: {shear} N") };
        let text = format!(
            "mechanism Tense {{
                input omega: rad/s;
                design tension = {force} N;
                gravity 9.81 m/s^2 along -z;
                body rotor: shaft(along: x, up: z, length: {length} m, stiffness: {bending} N*m^2, {theory}, tension: tension,
                    mass_per_length: {mass} kg/m, inertia: {rotary} kg*m, lag: {lag} s) spinning at omega;
                {SUPPORTS}
            }}"
        );
        let study = study(&text, Some(speed));
        let (modes, sensitivities) = (study.modes().expect("modes"), study.sensitivities().expect("derivatives"));
        for (number, direction) in [(1.0, 1.0), (1.0, -1.0), (2.0, 1.0), (3.0, -1.0)] {
            let k = number * core::f64::consts::PI / length;
            // Of `y + i z`; `y - i z` is the other direction. The equations for `w sin kx` and a slope of `b cos kx`.
            let determinant = |s: Complex, tension: f64| -> Complex {
                let turned = Complex::new(0.0, -2.0 * direction * speed) * rotary * s + rotary * s * s;
                let bends = bending * k * k * (1.0 + lag * (s - Complex::new(0.0, direction * speed)));
                if slender {
                    return mass * s * s + k * k * (turned + bends + tension);
                }
                let deflection = mass * s * s + (shear + tension) * k * k;
                (deflection * (turned + bends + shear) - (shear * k).powi(2)) / shear
            };
            let by = |of: &dyn Fn(f64) -> Complex, step: f64| (of(step) - of(-step)) / (2.0 * step);
            let mut found = 0;
            for (mode, own) in modes.modes.iter().enumerate() {
                let s = own.s;
                let slope = by(&|step| determinant(s + step, force), 1e-3);
                if (determinant(s, force) / slope).norm() > 1e-8 * s.norm() {
                    continue;
                }
                found += 1;
                let expected = -by(&|step| determinant(s, force + step), 1.0) / slope;
                let derivative = sensitivities.modes[mode].s().expect("derivatives").by_design[0];
                let error = (derivative - expected).norm();
                assert!(error < 1e-7 * expected.norm(), "{force} {s}: {derivative} {expected}");
                if speed == 0.0 {
                    continue;
                }
                let second = study.mode_curvature(mode).expect("second derivatives").eigenvalue;
                let second = second.as_ref().expect("second derivatives").by_design[0][0];
                let at = |tension: f64| {
                    (0..6)
                        .fold(s, |s, _| s - determinant(s, tension) / by(&|step| determinant(s + step, tension), 1e-3))
                };
                let expected = (at(force + 500.0) - 2.0 * at(force) + at(force - 500.0)) / 2.5e5;
                // The rounding of `s`, up to 3e-11 of it, is 2e-3 of its second derivative.
                assert!((second - expected).norm() < 5e-3 * expected.norm(), "{force} {s}: {second} {expected}");
            }
            assert!(found > 0, "{force} {number} {direction}");
        }
    }
}

/// A beam under a moment at its end, which knows nothing of torque, with springs that make a right-handed rotor of it; and the torque
/// at which a clamped shaft with a free end coils, `pi E I / L` (H. Ziegler).
#[test]
fn a_shaft_under_torque() {
    let rows = ["[1 m / 12, 100 mm]"; 12].join(", ");
    let steel = "material own: density 1273.239544735 kg/m^3, modulus 2.037183271576 GPa, poisson 0.3;";
    let shaft = format!(
        "{steel} body rotor: shaft(along: x, up: z, material: own, shear: 0, sections: [{rows}], torque: torque);"
    );
    let clamped = "point root: rotor at root; body arm: massless; joint weld: fixed from rotor to arm;
        point ahead: arm at [1 m, 0, 0];
        constraint held_y: equation(zero: position(root).y); constraint held_z: equation(zero: position(root).z);
        constraint turn_y: equation(zero: position(ahead).z); constraint turn_z: equation(zero: position(ahead).y);";
    let supports = |first: &str, second: &str| {
        format!(
            "point end: ground at [1 m, 0, 0]; point tip: rotor at tip;
            force holds: bushing(from: end, to: tip, stiffness: [0, 1, 1] GN/m, turning_stiffness: [0, 1, 1] GN*m);
            point a: ground at [1 m / 3, 0, 0] rotated(x, 0.3 rad); point on_a: rotor at {first};
            point b: ground at [2 m / 3, 0, 0] rotated(x, 1.4 rad); point on_b: rotor at {second};
            force spring_a: bushing(from: a, to: on_a, stiffness: [0, 300, 0] kN/m);
            force spring_b: bushing(from: b, to: on_b, stiffness: [0, 300, 0] kN/m);"
        )
    };
    let twisted = format!(
        "mechanism Twisted {{ design torque = 0 N*m; {shaft} {clamped} {} }}",
        supports("station 4", "station 8")
    );
    let beam = format!(
        "mechanism Beam {{ design torque = 0 N*m;
            body rotor: beam(length: 1 m, along: x, up: z, bending: 7, torsion: 2, mass_per_length: 10 kg/m,
                inertia_y: 6.25e-3 kg*m, inertia_z: 6.25e-3 kg*m, stiffness_y: 1e4 N*m^2, stiffness_z: 1e4 N*m^2,
                torsion_stiffness: 1e9 N*m^2);
            joint clamp: fixed from ground to rotor; {}
            force turns: load(at: tip, moment: [torque, 0, 0]); }}",
        supports("1/3 length", "2/3 length")
    );
    let [twisted, beam] = [twisted, beam].map(|text| study(&text, None));
    let lowest = |study: &Study<Interpreted>, torque: f64| {
        let study = study.clone().design(DesignVariable::new(0), torque);
        let modes = study.modes().expect("modes").modes;
        let all = study.sensitivities().expect("derivatives").modes;
        let by_torque = |mode: usize| all[mode].s().expect("derivatives").by_design[0].im;
        (0..2).map(|mode| (modes[mode].s.im, by_torque(mode))).collect::<Vec<_>>()
    };
    let at_rest = lowest(&beam, 0.0);
    for torque in [8e3, -20e3] {
        for ((own, of_beam), plain) in lowest(&twisted, torque).iter().zip(lowest(&beam, torque)).zip(&at_rest) {
            // Of what torque does three thousandths, and what is beside four in the bending of the beam.
            let most = 0.02 * (of_beam.0 - plain.0).abs() + 5e-5 * plain.0;
            assert!((own.0 - of_beam.0).abs() < most, "{torque}: {own:?} {of_beam:?}");
            assert!((own.1 - of_beam.1).abs() < 0.02 * of_beam.1.abs(), "{torque}: {own:?} {of_beam:?}");
        }
    }
    let free = format!("mechanism Free {{ design torque = 0 N*m; {shaft} {clamped} }}");
    let coils = core::f64::consts::PI * 1e4;
    for (torque, gives_way) in [(0.999 * coils, false), (1.001 * coils, true)] {
        let state = study(&free, None).design(DesignVariable::new(0), torque).equilibrium().expect("a state");
        let stability = state.stability;
        assert_eq!(matches!(stability, Stability::Divergent { .. }), gives_way, "{torque}: {stability:?}");
    }
}

/// The sag of a tense shaft in closed form, beside a station as well as at it, whatever the number of sections; compressed beyond
/// Euler's load it gives way.
#[test]
fn a_tense_shaft_sags_less() {
    let (length, bending, mass) = (2.0_f64, 8350.0, 5.55);
    let text = |force: f64, rows: &[f64]| {
        let rows: String = rows.iter().map(|row| format!("[{} m, 30 mm],", row * length)).collect();
        format!(
            "mechanism Tense {{
                design tension = {force} N;
                gravity 9.81 m/s^2 along -z;
                material own: density {} kg/m^3, modulus {} Pa, poisson 0.3;
                body rotor: shaft(along: x, up: z, sections: [{rows}], material: own, shear: 0, tension: tension);
                point middle: rotor at station 1;
                {SUPPORTS}
                output sag = position(middle).z;
            }}",
            mass / (core::f64::consts::PI * 0.015_f64.powi(2)),
            bending / (core::f64::consts::PI / 4.0 * 0.015_f64.powi(4)),
        )
    };
    let load = 9.81 * mass;
    for (force, rows) in
        [(60e3, [0.5, 0.5].as_slice()), (60e3, &[0.5, 0.2, 0.3]), (120e3, &[0.5, 0.5]), (-15e3, &[0.5, 0.1, 0.4])]
    {
        let exact = |force: f64| {
            let half = Complex::from(force / bending).sqrt() * (length / 2.0);
            -load / force * (length * length / 8.0 - bending / force * (1.0 - half.cosh().inv().re))
        };
        let study = study(&text(force, rows), None);
        let found = study.outputs().expect("outputs");
        let sag = found.values[0];
        assert!((sag / exact(force) - 1.0).abs() < 1e-8, "{force}: {sag} {}", exact(force));
        let slope = (exact(force * 1.0001) - exact(force * 0.9999)) / (2e-4 * force);
        let derivative = found.by_design[0].as_ref().expect("a derivative")[0];
        assert!((derivative / slope - 1.0).abs() < 1e-6, "{force}: {derivative} {slope}");
    }
    let euler = bending * (core::f64::consts::PI / length).powi(2);
    let stable = |share: f64| {
        let study = study(&text(-share * euler, &[0.5, 0.5]), None);
        study.equilibrium().expect("an equilibrium").stability == eigentol::Stability::Stable
    };
    assert!(stable(0.9999) && !stable(1.0001));
}

/// Material that lags and air that resists: eigenvalues, the speed of the onset, and derivatives of both.
#[test]
fn internal_damping() {
    let file = truth(include_str!("../../../truth/flexible/F8_internal_damping.json"));
    let parameters = [("L", "m"), ("EI", "N*m^2"), ("rhoA", "kg/m"), ("rhoI", "kg*m"), ("c", "N*s/m^2"), ("eta", "s")];
    let text = format!(
        "mechanism Shaft {{
            input omega: rad/s; {}
            body rotor: shaft(along: x, up: z, length: L, stiffness: EI, shear: 0, mass_per_length: rhoA, inertia: rhoI,
                lag: eta, drag: c) spinning at omega;
            {SUPPORTS}
        }}",
        design(&file, &parameters)
    );
    let study = study(&text, Some(parameter(&file, "Omega")));
    let (modes, sensitivities) = (study.modes().expect("modes"), study.sensitivities().expect("derivatives"));
    let listed = numbers(&file["eigenvalues_re_im_twice"]);
    for (k, pair) in listed.chunks_exact(2).enumerate() {
        let expected = Complex::new(pair[0], pair[1].abs());
        let mode = modes.modes.iter().position(|mode| (mode.s - expected).norm() < 1e-9 * expected.norm());
        let mode = mode.unwrap_or_else(|| panic!("no mode near {expected}"));
        let slopes = sensitivities.modes[mode].s().expect("derivatives");
        for (name, slope) in names(&study).iter().zip(&slopes.by_design) {
            let first = numbers(&file["derivatives"][name.as_str()]["first"]);
            let expected = Complex::new(first[2 * k], first[2 * k + 1] * pair[1].signum());
            assert!((slope - expected).norm() < 1e-8 * expected.norm(), "{name}: {slope} {expected}");
        }
        let curvature = study.mode_curvature(mode).expect("second derivatives");
        let curvature = curvature.eigenvalue.as_ref().expect("second derivatives");
        for (j, name) in names(&study).iter().enumerate() {
            let second = numbers(&file["derivatives"][name.as_str()]["second"]);
            let (found, listed) =
                (curvature.by_design[j][j], Complex::new(second[2 * k], second[2 * k + 1] * pair[1].signum()));
            let error = (found - listed).norm() * parameter(&file, name).powi(2);
            assert!(error < 1e-7 * expected.norm(), "{name}: {found} {listed}");
        }
    }
    let tolerances = study.clone().flutter_onset_tolerances(Input::new(0), 0.0, 1000.0).expect("onsets");
    let [onset] = &tolerances[..] else { panic!("{tolerances:?}") };
    let speed = numbers(&file["onset_speed_and_whirl"])[0];
    assert!((onset.value / speed - 1.0).abs() < 1e-9, "{onset:?}");
    let spread = onset.spread.as_ref().expect("a derivative");
    for (name, own) in names(&study).iter().zip(&spread.by_design) {
        let expected = numbers(&file["onset_derivatives"][name.as_str()]["first"])[0];
        assert!((own / expected - 1.0).abs() < 1e-8, "{name}: {own} {expected}");
    }
}

/// Nelson and McVaugh's rotor with bearings of these numbers, and more declarations.
fn rotor(rotor: &Value, theory: &str, more: &str, [stiffness, damping]: [[&str; 4]; 2]) -> String {
    let sections = rotor["sections"].as_array().expect("sections");
    let mut rows = String::new();
    for (k, own) in sections.iter().enumerate() {
        let [length, outer, inner] = ["L", "od", "id"].map(|key| own[key].as_f64().expect("a number"));
        let outer = if k == 9 { "od_10".to_owned() } else { format!("{outer} m") };
        write!(rows, "[{length} m, {outer}, {inner} m],").expect("text");
    }
    let steel = |key: &str| sections[0][key].as_f64().expect("a number");
    let disc = |key: &str| rotor["discs"][0][key].as_f64().expect("a number");
    let bearing = |[a, b, c, d]: [&str; 4]| format!("[[0, 0, 0], [0, {a}, {b}], [0, {c}, {d}]]");
    let at =
        |station: usize| -> f64 { sections[..station].iter().map(|own| own["L"].as_f64().expect("a number")).sum() };
    let mut bearings = String::new();
    for station in [10, 14] {
        write!(
            bearings,
            "point seat_{station}: ground at [{} m, 0, 0]; point journal_{station}: rotor at station {station};
            force film_{station}: bushing(from: seat_{station}, to: journal_{station}, stiffness: {}, damping: {});",
            at(station),
            bearing(stiffness),
            bearing(damping)
        )
        .expect("text");
    }
    format!(
        "mechanism Rotor {{
            input omega: rad/s;
            design disc_mass = {} kg; design disc_Ip = {} kg*m^2; design od_10 = {} m;
            design modulus = {} Pa;
            design kxx = 43.78 MN/m; design cyy = 1752 N*s/m;
            material steel: density {} kg/m^3, modulus modulus, shear_modulus {} Pa;
            body rotor: shaft(along: x, up: z, material: steel, shear_coefficient: {}, sections: [{rows}]{theory})
                spinning at omega;
            body disc: rigid(mass: disc_mass, inertia: [disc_Ip, {Id} kg*m^2, {Id} kg*m^2]);
            joint turns: revolute(x) from rotor at station 4 to disc, driven at omega;
            {bearings} {more}
        }}",
        disc("m"),
        disc("Ip"),
        sections[9]["od"].as_f64().expect("a number"),
        steel("E"),
        steel("rho"),
        steel("G"),
        steel("kappa"),
        Id = disc("Id"),
    )
}

const NONE: [&str; 4] = ["0", "0", "0", "0"];

#[test]
fn a_rotor_of_eighteen_sections() {
    let file = truth(include_str!("../../../truth/flexible/F9_nelson_mcvaugh.json"));
    for case in file["modes"].as_array().expect("cases") {
        let theory = if case["theory"] == "rayleigh" { ", shear: 0" } else { "" };
        let stiffness = if case["bearings"] == "isotropic" {
            ["kxx", "0", "0", "kxx"]
        } else {
            ["35.03 MN/m", "-8.756 MN/m", "-8.756 MN/m", "35.03 MN/m"]
        };
        let text = rotor(&file["rotor"], theory, "", [stiffness, NONE]);
        let modes = study(&text, case["Omega"].as_f64()).modes().expect("modes");
        let exact = case["eigenvalues"].as_array().expect("eigenvalues");
        for (mode, exact) in modes.modes.iter().zip(exact) {
            let exact = numbers(exact);
            let s = Complex::new(exact[0], exact[1]);
            assert!((mode.s - s).norm() < 1e-8 * s.norm(), "{} {s}", mode.s);
        }
    }
}

/// Synchronous critical speeds: frequencies that the speed crosses.
#[test]
fn critical_speeds_of_a_rotor() {
    let file = truth(include_str!("../../../truth/flexible/F9_nelson_mcvaugh.json"));
    for case in file["critical"].as_array().expect("cases") {
        let theory = if case["theory"] == "rayleigh" { ", shear: 0" } else { "" };
        let text = rotor(&file["rotor"], theory, "", [["kxx", "0", "0", "kxx"], NONE]);
        let study = study(&text, Some(1000.0));
        let found = study.campbell(Input::new(0), &[1000.0, 2500.0, 4000.0, 5500.0], &[1.0]).expect("a diagram");
        let all = found.crossings.iter().chain(&found.not_excited);
        let mut speeds: Vec<f64> = all.map(|own| own.value).collect();
        speeds.sort_by(f64::total_cmp);
        for expected in numbers(&case["synchronous_speeds_rad_s"]).into_iter().filter(|speed| *speed < 5500.0) {
            let near = speeds.iter().any(|speed| (speed / expected - 1.0).abs() < 1e-8);
            assert!(near, "{expected} is not among {speeds:?}");
        }
    }
}

#[test]
fn an_unbalance_response() {
    let file = truth(include_str!("../../../truth/flexible/F10_nelson_unbalance.json"));
    let more = "unbalance heavy: on disc, amount: 6.35 g*mm, angle: 0 deg;
        body collar: massless; joint carries: revolute(x) from rotor at station 15 to collar, driven at omega;
        unbalance light: on collar, amount: 2 g*mm, angle: 1.2 rad;
        point p0: rotor at root; point p4: rotor at station 4; point p10: rotor at station 10; point p14: rotor at station 14;
        output x0 = position(p0).y; output y0 = position(p0).z; output x4 = position(p4).y; output y4 = position(p4).z;
        output x10 = position(p10).y; output y10 = position(p10).z; output x14 = position(p14).y; output y14 = position(p14).z;";
    for case in file["cases"].as_array().expect("cases") {
        let [stiffness, damping] = if case["bearings"] == "isotropic" {
            [["kxx", "0", "0", "43.78 MN/m"], ["1752 N*s/m", "0", "0", "cyy"]]
        } else {
            [["kxx", "-8.756 MN/m", "-8.756 MN/m", "35.03 MN/m"], ["1752 N*s/m", "0", "0", "cyy"]]
        };
        let text = rotor(&file["rotor"], "", more, [stiffness, damping]);
        let mut study = study(&text, case["Omega"].as_f64());
        if case["bearings"] != "isotropic" {
            let kxx = names(&study).iter().position(|name| name == "kxx").expect("declared");
            study = study.design(eigentol::DesignVariable::new(kxx), 3.503e7);
        }
        let all = study.forced_sensitivities().expect("a response");
        let exact = |values: &Value| -> Vec<Complex> {
            let pairs = values.as_array().expect("a list").iter().map(numbers);
            pairs.map(|pair| Complex::new(pair[0], pair[1])).collect()
        };
        let most = |all: &[Complex]| all.iter().map(|x| x.norm()).fold(0.0, f64::max);
        let amplitudes = exact(&case["XY"]);
        for (k, expected) in amplitudes.iter().enumerate() {
            let found = all.response.harmonics[0].outputs[k].expect("an amplitude");
            assert!((found - expected).norm() < 1e-8 * most(&amplitudes), "{k}: {found} {expected}");
            let slopes = all.complex(0, Output::new(k), Measure::Displacement).expect("derivatives");
            for (name, found) in names(&study).iter().zip(&slopes.by_design) {
                let key = match name.as_str() {
                    "kxx" => "bearing_kxx",
                    "cyy" => "bearing_cyy",
                    other => other,
                };
                let first = exact(&case["derivatives"][key]["first"]);
                let error = (found - first[k]).norm();
                assert!(error < 1e-8 * most(&first), "{} {k} {name}: {found} {}", case["Omega"], first[k]);
            }
        }
    }
}

/// Three shafts that twist, five inertias and a gear, free at both ends.
#[test]
fn a_torsional_train() {
    let file = truth(include_str!("../../../truth/flexible/F15_torsional_train.json"));
    let mut parameters = Vec::new();
    let mut shafts = String::new();
    for k in 1..4 {
        parameters.extend([(format!("L{k}"), "m"), (format!("GJ{k}"), "N*m^2"), (format!("rhoJ{k}"), "kg*m")]);
        write!(
            shafts,
            "body shaft{k}: shaft(along: x, up: z, lines: torsion, length: L{k}, torsion_stiffness: GJ{k}, inertia: rhoJ{k} / 2);"
        )
        .expect("text");
    }
    parameters.extend((1..6).map(|k| (format!("J{k}"), "kg*m^2")));
    let parameters: Vec<(&str, &str)> = parameters.iter().map(|(name, unit)| (name.as_str(), *unit)).collect();
    let wheels = [
        ("shaft1 at root", 1),
        ("shaft1 at tip", 2),
        ("shaft2 at tip", 3),
        ("shaft3 at root", 4),
        ("shaft3 at tip", 5),
    ];
    let mut wheel = String::new();
    for (place, k) in wheels {
        write!(
            wheel,
            "body wheel{k}: rigid(mass: 1 kg, inertia: [J{k}, 10 kg*m^2, 10 kg*m^2]);
            joint weld{k}: fixed from {place} to wheel{k};"
        )
        .expect("text");
    }
    // Points of equal wheels move together, those of a gear along the line of contact.
    let text = format!(
        "mechanism Train {{
            {} design ratio = {};
            {shafts} {wheel}
            point rim1: wheel2 at [0, 0.1 m, 0]; point rim2: collar at [0, 0.1 m, 0];
            body collar: massless; joint holds: fixed from shaft2 to collar;
            constraint joined: equation(zero: position(rim1).z - position(rim2).z);
            point rim3: wheel3 at [0, 0.1 m * ratio, 0]; point rim4: wheel4 at [0, 0.1 m, 0];
            constraint gear: equation(zero: position(rim3).z - position(rim4).z);
        }}",
        design(&file, &parameters),
        parameter(&file, "ratio")
    );
    let study = study(&text, None);
    let (modes, sensitivities) = (study.modes().expect("modes"), study.sensitivities().expect("derivatives"));
    for (k, expected) in numbers(&file["frequencies"]).into_iter().enumerate() {
        let near = |mode: &eigentol::Mode| (mode.s.im / expected - 1.0).abs() < 1e-8;
        let mode = modes.modes.iter().position(near).unwrap_or_else(|| panic!("no mode near {expected}"));
        let slopes = sensitivities.modes[mode].s().expect("derivatives");
        for (name, slope) in names(&study).iter().zip(&slopes.by_design) {
            let Some(first) = file["derivatives"][name.as_str()].get("first") else { continue };
            let expected = numbers(first)[k];
            assert!((slope.im / expected - 1.0).abs() < 1e-8, "{k} {name}: {slope} {expected}");
        }
    }
}
