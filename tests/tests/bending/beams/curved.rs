//! Beams that are curved before they are loaded.

use std::f64::consts::{FRAC_PI_2, PI};

use eigentol::{DesignVariable, Kernels as _};

use crate::beams::compared::{assert_alike, frequencies, study};

const LENGTH: f64 = 0.9;
const ABOUT_Y: f64 = 3.0;
const ABOUT_Z: f64 = 5.0;
const AGAINST_TWIST: f64 = 2.0;

/// The numbers of a section.
fn section() -> String {
    format!(
        "mass_per_length: 1.2 kg/m, stiffness_y: {ABOUT_Y} N*m^2, stiffness_z: {ABOUT_Z} N*m^2,
        torsion_stiffness: {AGAINST_TWIST} N*m^2, inertia_y: 0.01 kg*m, inertia_z: 0.02 kg*m"
    )
}

/// Where the tip of a quarter of a circle is under a force on it.
fn tip(force: [f64; 3]) -> Vec<f64> {
    let study = study(
        &format!(
            "mechanism Arc {{
                body arc: beam(length: {LENGTH} m, along: x, up: z, {}, bending: 7, torsion: 7, prebend_y: -90 deg);
                joint clamp: fixed from ground to arc;
                point tip: arc at tip;
                force pull: load(at: tip, force: {force:?} N);
                output x = position(tip).x; output y = position(tip).y; output z = position(tip).z;
            }}",
            section()
        ),
        None,
    );
    study.outputs().expect("outputs").values.to_vec()
}

/// Castigliano's theorem: in the plane `F R^3 / EI` times `3 pi / 4 - 2` along the force and `1 / 2` across it; out of the
/// plane `F R^3 (pi / 4 EI + (3 pi / 4 - 2) / GJ)`.
#[test]
fn a_quarter_of_a_circle() {
    let radius = LENGTH / FRAC_PI_2;
    let free = tip([0.0; 3]);
    assert_alike(&[free[0], free[2]], &[radius, radius], 1e-12);
    assert!(free[1].abs() < 1e-15);
    let force = 1e-4;
    let size = force * radius.powi(3);
    let moved = |force| -> Vec<f64> {
        let loaded = tip(force);
        loaded.iter().zip(&free).map(|(a, b)| a - b).collect()
    };
    let [x, _, z] = moved([0.0, 0.0, force])[..] else {
        panic!("three outputs");
    };
    let shape = 0.75 * PI - 2.0;
    assert_alike(&[z, x], &[size * shape / ABOUT_Y, -0.5 * size / ABOUT_Y], 3e-5);
    let y = moved([0.0, force, 0.0])[1];
    let expected = size * (0.25 * PI / ABOUT_Z + shape / AGAINST_TWIST);
    assert_alike(&[y], &[expected], 3e-5);
}

/// A beam that is curved sideways and bends up, as straight ones in series, which miss its frequencies by the square of
/// their angle.
#[test]
fn an_arc_of_straight_beams() {
    let whole = study(
        &format!(
            "mechanism Arc {{
                body arc: beam(length: {LENGTH} m, along: x, up: z, {}, bending_y: 6, torsion: 5, prebend_z: 80 deg);
                joint clamp: fixed from ground to arc;
            }}",
            section()
        ),
        None,
    );
    let of = |pieces: usize| {
        let angle = 80.0 / pieces as f64;
        let mut text = String::new();
        for k in 0..pieces {
            let from = match k {
                0 => "ground".to_owned(),
                _ => format!("piece{} at tip", k - 1),
            };
            let turn = if k == 0 { 0.5 * angle } else { angle };
            text += &format!(
                "body piece{k}: beam(length: {} m, along: x, up: z, {}, bending_y: 2, torsion: 1);
                joint weld{k}: fixed from {from} to piece{k} rotated(z, {turn} deg);\n",
                LENGTH / pieces as f64,
                section()
            );
        }
        frequencies(&study(&format!("mechanism Series {{ {text} }}"), None))
    };
    let expected = frequencies(&whole);
    let [coarse, fine] = [4, 8].map(of);
    for (mode, expected) in expected.iter().take(2).enumerate() {
        let [coarse, fine] = [&coarse, &fine].map(|x| x[mode] / expected - 1.0);
        assert!(fine.abs() < 3e-3, "mode {mode}: {fine}");
        // what two steps say about none
        let limit = fine + (fine - coarse) / 3.0;
        assert!(limit.abs() < 1e-4, "mode {mode}: {limit}");
    }
}

const STRAINED: &str = "center_y: 10 mm, center_z: -5 mm, shear: 3, stretch: 2, axial_stiffness: 900 N,
    shear_stiffness_y: 400 N, shear_stiffness_z: 300 N, lag: 1 ms";

/// A twisted arc that a load splits in the middle, and two in series: the frame between them has the axes of the root.
#[test]
fn arcs_in_series() {
    let arc = |name: &str, length: f64, twist: f64, [y, z]: [f64; 2]| {
        format!(
            "body {name}: beam(length: {length} m, along: x, up: z, {}, {STRAINED}, bending: 3, torsion: 3,
                twist: {twist} deg, prebend_y: {y:?} deg, prebend_z: {z:?} deg);",
            section()
        )
    };
    let whole = |arcs: String, middle: &str, end: &str| {
        study(
            &format!(
                "mechanism Arcs {{
                    gravity 9.81 m/s^2 along -z;
                    {arcs}
                    body weight: point(mass: 0.1 kg);
                    joint seat: fixed from {middle} to weight;
                    point eye: {end} at tip;
                    output x = position(eye).x; output y = position(eye).y; output z = position(eye).z;
                    output energy = potential_energy();
                }}"
            ),
            None,
        )
    };
    let clamp = |name: &str| format!("joint clamp: fixed from ground to {name};");
    let one = arc("arc", LENGTH, 30.0, [40.0, -60.0]) + &clamp("arc");
    let one = whole(one, "arc at 0.5 length", "arc");
    // half of the arc turns by half of the angle about the same direction, which the second half sees turned by its twist
    let (sine, cosine) = (PI / 12.0).sin_cos();
    let seen = [20.0 * cosine - 30.0 * sine, -20.0 * sine - 30.0 * cosine];
    let two = arc("inner", 0.5 * LENGTH, 15.0, [20.0, -30.0])
        + &arc("outer", 0.5 * LENGTH, 15.0, seen)
        + &clamp("inner")
        + &format!(
            "joint weld: fixed from inner at tip to outer rotated([0, 2, -3], {:?} deg) rotated(x, 15 deg);",
            20.0_f64.hypot(30.0)
        );
    let two = whole(two, "inner at tip", "outer");
    let values = [&one, &two].map(|x| x.outputs().expect("outputs").values);
    assert_alike(&values[0], &values[1], 1e-9);
    assert_alike(&frequencies(&one), &frequencies(&two), 1e-8);
}

/// Derivatives by the prebend are those of the whole, those of a beam that is straight in the nominal design too.
#[test]
fn prebend_as_a_design() {
    let of = |[y, z]: [f64; 2]| {
        study(
            &format!(
                "mechanism Design {{
                    gravity 9.81 m/s^2 along -z;
                    design y = {y:?} rad; design z = {z:?} rad;
                    body arc: beam(length: {LENGTH} m, along: x, up: z, {}, {STRAINED}, bending: 3, torsion: 2,
                        twist: 20 deg, prebend_y: y, prebend_z: z);
                    joint clamp: fixed from ground to arc;
                }}",
                section()
            ),
            None,
        )
    };
    for turns in [[0.5, -0.8], [0.0, 0.6], [0.0, 0.0], [-2.5, 1.5]] {
        let declared = of(turns);
        let sensitivities = declared.sensitivities().expect("derivatives");
        for (j, turn) in turns.into_iter().enumerate() {
            let at = |turn: f64| frequencies(&declared.clone().design(DesignVariable::new(j), turn));
            let (above, below) = (at(turn + 1e-4), at(turn - 1e-4));
            for mode in 0..4 {
                let frequency = sensitivities.modes[mode].frequency().expect("a frequency");
                let expected = (above[mode] - below[mode]) / 2e-4;
                let size = above[mode];
                let error = (frequency.by_design[j] - expected).abs();
                assert!(error < 1e-6 * size, "{turns:?} {j} mode {mode}: {error}");
            }
        }
    }
}

/// A straight axis whose straightness has a tolerance in both planes is the straight beam, and a full turn is too much.
#[test]
fn straightness_as_a_tolerance() {
    let text = |prebend: &str| {
        format!(
            "mechanism Straight {{
                gravity 9.81 m/s^2 along -z;
                design y = 0 rad +/- 1 deg; design z = 0 rad +/- 1 deg;
                body arc: beam(length: {LENGTH} m, along: x, up: z, {}, {STRAINED}, bending: 3, torsion: 2, twist: 20 deg{prebend});
                joint clamp: fixed from ground to arc;
            }}",
            section()
        )
    };
    let curved = study(&text(", prebend_y: y, prebend_z: z"), None);
    let straight = study(&text(""), None);
    assert_alike(&frequencies(&curved), &frequencies(&straight), 1e-12);
    let spread = curved.first_order().expect("spread");
    assert!(spread.modes.iter().any(|mode| mode.lambda.sigma > 1e-6));
    let turned = |design: &[f64]| {
        let found = curved.mechanism().violation(&[], design);
        found.map(|x| x.quantity.to_string())
    };
    assert_eq!(turned(&[5.0, 3.6]), None);
    let rest = "rest of a full turn beside the prebend of arc, squared";
    assert_eq!(turned(&[5.0, -4.0]).as_deref(), Some(rest));
}
