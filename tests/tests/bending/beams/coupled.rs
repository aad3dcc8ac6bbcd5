//! Sections whose stiffness is a matrix.

use crate::beams::compared::{assert_alike, frequencies, study};

/// A cantilever with all kinds of coordinates.
fn cantilever(section: &str, turned: &str) -> Vec<f64> {
    let study = study(
        &format!(
            "mechanism Cantilever {{
                body bar: beam(length: 0.8 m, along: x, up: z, {section}, bending: 3, torsion: 2, shear: 2, stretch: 2);
                joint clamp: fixed from ground to bar {turned};
            }}"
        ),
        None,
    );
    frequencies(&study)
}

const DIAGONAL: [f64; 6] = [900.0, 400.0, 300.0, 2.0, 3.0, 5.0];

fn matrix(entries: [[f64; 6]; 6]) -> String {
    format!("{entries:?}")
}

#[test]
fn a_diagonal_is_the_section_by_numbers() {
    let inertia = "inertia_y: 0.01 kg*m, inertia_z: 0.02 kg*m";
    let [axial, shear_y, shear_z, twist, about_y, about_z] = DIAGONAL;
    let mut entries = [[0.0; 6]; 6];
    for (k, own) in DIAGONAL.into_iter().enumerate() {
        entries[k][k] = own;
    }
    let entries = matrix(entries);
    let by_numbers = cantilever(
        &format!(
            "section: section(mass: 1.2 kg/m, EA: {axial} N, GAy: {shear_y} N, GAz: {shear_z} N, GJ: {twist} N*m^2,
                EIy: {about_y} N*m^2, EIz: {about_z} N*m^2, {inertia})"
        ),
        "",
    );
    let within = format!("section: section(mass: 1.2 kg/m, stiffness: {entries}, {inertia})");
    let beside = format!("mass_per_length: 1.2 kg/m, stiffness: {entries}, {inertia}");
    for section in [within, beside] {
        assert_eq!(cantilever(&section, ""), by_numbers);
    }
}

/// A section turned about the beam, by its matrix or by what holds it.
#[test]
fn a_matrix_that_is_turned() {
    let inertia = "inertia_y: 0.01 kg*m, inertia_z: 0.01 kg*m";
    let [axial, shear_y, shear_z, twist, about_y, about_z] = DIAGONAL;
    let (sine, cosine) = 0.4_f64.sin_cos();
    let mut entries = [[0.0; 6]; 6];
    (entries[0][0], entries[3][3]) = (axial, twist);
    for (k, [y, z]) in [(1, [shear_y, shear_z]), (4, [about_y, about_z])] {
        entries[k][k] = cosine * cosine * y + sine * sine * z;
        entries[k + 1][k + 1] = sine * sine * y + cosine * cosine * z;
        let beside = sine * cosine * (y - z);
        (entries[k][k + 1], entries[k + 1][k]) = (beside, beside);
    }
    let turned = cantilever(&format!("mass_per_length: 1.2 kg/m, stiffness: {}, {inertia}", matrix(entries)), "");
    let held = cantilever(
        &format!(
            "mass_per_length: 1.2 kg/m, axial_stiffness: {axial} N, shear_stiffness_y: {shear_y} N,
            shear_stiffness_z: {shear_z} N, torsion_stiffness: {twist} N*m^2, stiffness_y: {about_y} N*m^2,
            stiffness_z: {about_z} N*m^2, {inertia}"
        ),
        "rotated(x, 0.4 rad)",
    );
    assert_alike(&turned, &held, 1e-9);
}

/// A beam described about a line that is `c` below its centre: strain `e + c k` at the centre and mass off the axis.
#[test]
fn about_another_line() {
    let of = |section: &str, at: f64, lever: f64| {
        study(
            &format!(
                "mechanism Line {{
                    gravity 9.81 m/s^2 along -z;
                    design c = 0.05 m; design EA = 500 N; design EI = 1.5 N*m^2;
                    body bar: beam(length: 0.8 m, along: x, up: z, {section}, bending_y: 4, stretch: 4, points: 12, lag: 0.5 ms);
                    body end: point(mass: 0.05 kg, center: [0, 0, {lever} m]);
                    joint clamp: fixed from ground to bar at [0, 0, {at} m];
                    joint weld: fixed from bar at tip to end;
                    point gauge: bar at 0.3 length;
                    point eye: end at [0, 0, {lever} m];
                    output x = position(eye).x; output z = position(eye).z;
                    output moment = moment(gauge).y; output stretch = strain(gauge).x;
                    output bent = curvature(gauge).y;
                }}"
            ),
            None,
        )
    };
    let centre = of("section: section(mass: 0.4 kg/m, EA: EA, EIy: EI)", 0.05, 0.0);
    let none = "0, 0, 0";
    let zeros = "[0, 0, 0, 0, 0, 0]";
    let coupled = format!(
        "section: section(mass: 0.4 kg/m, center_z: c, stiffness: [[EA, {none}, EA * c, 0], {zeros}, {zeros}, {zeros},
            [EA * c, {none}, EI + EA * c * c, 0], {zeros}])"
    );
    let below = of(&coupled, 0.0, 0.05);
    assert_alike(&frequencies(&below), &frequencies(&centre), 1e-9);
    let values = [&below, &centre].map(|x| x.outputs().expect("outputs").values.to_vec());
    assert_alike(&values[0][..2], &values[1][..2], 1e-9);
    let [moment, stretch, bent] = [2, 3, 4].map(|k| values[1][k]);
    // the bending is strong, and the strain seen from below has its part
    assert!(values[1][0] < 0.78, "{values:?}");
    let expected = [moment + 0.05 * 500.0 * stretch, stretch - 0.05 * bent, bent];
    assert_alike(&values[0][2..], &expected, 1e-8);
    // by the stiffness of the material
    let sensitivities = [&below, &centre].map(|x| x.sensitivities().expect("derivatives"));
    for mode in 0..3 {
        let [below, centre] = sensitivities
            .each_ref()
            .map(|sensitivity| sensitivity.modes[mode].frequency().expect("a frequency").by_design.to_vec());
        assert_alike(&below[1..], &centre[1..], 1e-7);
    }
}
