//! Mass off the axis of a beam.

use std::f64::consts::PI;

use crate::beams::compared::study;

const MASS: f64 = 1.2;
const BENDING: f64 = 3.0;
const TORSION: f64 = 0.8;
const INERTIA: f64 = 0.004;

/// A beam on forks, which let it bend but not twist at its ends.
fn on_forks(length: f64, center: f64) -> String {
    format!(
        "mechanism Forks {{
            design L = {length} m; design c = {center} m;
            body bar: beam(length: L, along: x, up: z, mass_per_length: {MASS} kg/m, stiffness_y: {BENDING} N*m^2,
                stiffness_z: 9000 N*m^2, torsion_stiffness: {TORSION} N*m^2, inertia_z: {INERTIA} kg*m,
                center_y: c, bending_y: 9, torsion: 9, bending_z: 3);
            body carriage: massless;
            joint left: revolute(y) from ground to bar;
            joint slide: prismatic(x) from ground to carriage at [L, 0, 0];
            joint right: revolute(y) from bar at tip to carriage;
        }}"
    )
}

/// Deflection and twist go like `sin(k x)`, `k = n pi / L`, so that `w^2` is an eigenvalue of `[EI k^4, 0; 0, GJ k^2]`
/// with the mass matrix `[m, m c; m c, j + m c^2]`.
fn closed_form(n: f64, length: f64, center: f64) -> [f64; 2] {
    let k = n * PI / length;
    let (bending, torsion) = (BENDING * k.powi(4), TORSION * k * k);
    let polar = INERTIA + MASS * center * center;
    let a = MASS * polar - (MASS * center).powi(2);
    let b = bending * polar + torsion * MASS;
    let root = (b * b - 4.0 * a * bending * torsion).sqrt();
    [b - root, b + root].map(|twice| (twice / (2.0 * a)).sqrt())
}

#[test]
fn bending_couples_with_torsion() {
    let (length, center) = (1.0, 0.06);
    let study = study(&on_forks(length, center), None);
    let modes = study.modes().expect("modes");
    let values: Vec<f64> = modes.frequencies().into_iter().flatten().collect();
    let sensitivities = study.sensitivities().expect("derivatives");
    for (n, bar) in [(1.0, 1e-9), (2.0, 1e-6)] {
        for (branch, expected) in closed_form(n, length, center).into_iter().enumerate() {
            let error = |value: &f64| (value / expected - 1.0).abs();
            let nearest = (0..values.len()).min_by(|a, b| error(&values[*a]).total_cmp(&error(&values[*b])));
            let mode = nearest.expect("a mode");
            assert!(error(&values[mode]) < bar, "{expected} {values:?}");
            let slopes = sensitivities.modes[mode].frequency().expect("a frequency");
            let h = 1e-5;
            let by = |l: f64, c: f64| {
                let [above, below] = [h, -h].map(|h| closed_form(n, length + l * h, center + c * h)[branch]);
                (above - below) / (2.0 * h)
            };
            for (slope, expected) in slopes.by_design.iter().zip([by(1.0, 0.0), by(0.0, 1.0)]) {
                let size = expected.abs().max(1.0);
                assert!((slope - expected).abs() < 1e3 * bar * size, "{slope} {expected}");
            }
        }
    }
}

/// A cantilever on its side twists by `m g c L^2 / (2 GJ)` under its weight.
#[test]
fn weight_twists() {
    let study = study(
        "mechanism Side {
            gravity 9.81 m/s^2 along -z;
            body bar: beam(length: 0.7 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 1e5 N*m^2,
                stiffness_z: 1e5 N*m^2, torsion_stiffness: 4000 N*m^2, center_y: 50 mm, bending: 3);
            joint clamp: fixed from ground to bar;
            body cross: massless;
            joint weld: fixed from bar at tip to cross;
            point left: cross at [0, 1 m, 0];
            point right: cross at [0, -1 m, 0];
            output turn = (position(left).z - position(right).z) / 2 m;
            output moment = reaction_moment(clamp).x;
        }",
        None,
    );
    let values = study.outputs().expect("outputs").values;
    let [turn, moment] = values[..] else {
        panic!("two outputs");
    };
    let about_axis = 9.81 * 0.05 * 0.7;
    assert!((moment.abs() / about_axis - 1.0).abs() < 1e-6, "{moment}");
    let expected = -about_axis * 0.7 / (2.0 * 4000.0);
    assert!((turn / expected - 1.0).abs() < 1e-6, "{turn} {expected}");
}
