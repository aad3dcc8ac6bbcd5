//! Beams whose tip is sharp, and strips much wider than high.

use std::f64::consts::PI;

use crate::beams::compared::study;

const LENGTH: f64 = 2.0;
const MODULUS: f64 = 206e9;
const DENSITY: f64 = 7850.0;

/// `J_n(z)` with `sign` -1, `I_n(z)` with `sign` 1, by their power series.
fn bessel(sign: f64, order: u32, z: f64) -> f64 {
    let half = z / 2.0;
    let mut term = (1..=order).map(|k| half / f64::from(k)).product::<f64>();
    let mut sum = 0.0;
    for k in 1..60 {
        sum += term;
        term *= sign * half * half / (f64::from(k) * f64::from(k + order));
    }
    sum
}

/// The lowest roots of a function above 1.
fn roots(of: impl Fn(f64) -> f64, count: usize) -> Vec<f64> {
    let steps = (0..).map(|k| 1.0 + 0.01 * f64::from(k));
    let halved = |mut low: f64| {
        let mut high = low + 0.01;
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            match of(low) * of(middle) > 0.0 {
                true => low = middle,
                false => high = middle,
            }
        }
        low
    };
    steps.filter(|z| of(*z) * of(z + 0.01) < 0.0).map(halved).take(count).collect()
}

/// Kirchhoff (1879): the deflection of a clamped wedge is `s^(-1/2) (a J_1 + b I_1)`, of a cone `s^(-1) (a J_2 + b I_2)`,
/// of `z sqrt(s)` at the fraction `s` of the length before the tip, with `omega = (z / 2)^2 sqrt(E I / m) / L^2` of the
/// root.
#[test]
fn wedges_and_cones() {
    let size = 1e-3;
    let cases = [
        (1, "rectangle(width: 10 mm, height: 1 mm) to rectangle(width: 10 mm, height: 0 mm)", size / 12.0_f64.sqrt()),
        (2, "circle(radius: 1 mm) to circle(radius: 0 mm)", size / 2.0),
    ];
    for (order, section, gyration) in cases {
        let study = study(
            &format!(
                "mechanism Sharp {{
                    body rod: beam(length: {LENGTH} m, along: x, up: z, density: {DENSITY} kg/m^3, modulus: {MODULUS} Pa,
                        bending_y: 10, section: {section});
                    joint clamp: fixed from ground to rod;
                }}"
            ),
            None,
        );
        let exact = roots(
            |z| bessel(-1.0, order, z) * bessel(1.0, order + 1, z) + bessel(1.0, order, z) * bessel(-1.0, order + 1, z),
            4,
        );
        let found = study.modes().expect("modes").frequencies();
        for (found, z) in found.iter().flatten().zip(exact) {
            let omega = (z / 2.0).powi(2) * gyration * (MODULUS / DENSITY).sqrt() / LENGTH.powi(2);
            // what is left is the inertia of the sections against turning
            assert!((found / omega - 1.0).abs() < 1e-5, "{section}: {found} {omega}");
        }
    }
}

/// Dimensions that end in nothing have derivatives by those at the root: all frequencies of bending grow with the height.
#[test]
fn a_sharp_tip_has_derivatives() {
    let text = "mechanism Wedge {
        design height = 1 mm +/- 0.01 mm;
        body rod: beam(length: 2 m, along: x, up: z, density: 7850 kg/m^3, modulus: 206 GPa, shear_modulus: 80 GPa,
            bending_y: 6, torsion: 3, section: rectangle(width: 60 mm, height: height) to rectangle(width: 30 mm, height: 0 mm));
        joint clamp: fixed from ground to rod;
    }";
    let study = study(text, None);
    let slopes = study.sensitivities().expect("derivatives");
    let lowest = slopes.modes[0].frequency().expect("it oscillates");
    let omega = study.modes().expect("modes").frequencies()[0].expect("it oscillates");
    assert!((lowest.by_design[0] * 1e-3 / omega - 1.0).abs() < 1e-5);
}

/// The constant of torsion of a rectangle, with a thousand terms of Saint-Venant's series.
fn constant_of_torsion(width: f64, height: f64) -> f64 {
    let (long, thick) = (width.max(height), width.min(height));
    let terms = (0..1000).map(|k| f64::from(2 * k + 1)).map(|n| (n * PI * long / (2.0 * thick)).tanh() / n.powi(5));
    long * thick.powi(3) * (1.0 / 3.0 - 64.0 / PI.powi(5) * thick / long * terms.sum::<f64>())
}

/// A clamped strip twists at `pi / 2 L sqrt(G J / rho I_p)`; derivatives do not end where an exponential overflows, at 45
/// times as wide as high.
#[test]
fn strips_far_wider_than_high() {
    let width = 0.06;
    for height in [3.0, 0.3, 0.06, 2e-2, 1.4e-3, 1.3e-3, 1e-4] {
        let text = format!(
            "mechanism Strip {{
                design height = {height} m +/- 1%;
                body rod: beam(length: {LENGTH} m, along: x, up: z, density: {DENSITY} kg/m^3, modulus: {MODULUS} Pa,
                    shear_modulus: 80 GPa, torsion: 8, section: rectangle(width: {width} m, height: height));
                joint clamp: fixed from ground to rod;
            }}"
        );
        let study = study(&text, None);
        let of = |height: f64| {
            let polar = (width * height.powi(3) + height * width.powi(3)) / 12.0;
            PI / (2.0 * LENGTH) * (80e9 * constant_of_torsion(width, height) / (DENSITY * polar)).sqrt()
        };
        let frequencies = study.modes().expect("modes").frequencies();
        let distance = |mode: &usize| (frequencies[*mode].expect("it oscillates") - of(height)).abs();
        let twists = (0..frequencies.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("modes");
        let omega = frequencies[twists].expect("it oscillates");
        assert!((omega / of(height) - 1.0).abs() < 1e-9, "{height}: {omega} {}", of(height));
        let step = 1e-4 * height;
        let slope = (of(height + step) - of(height - step)) / (2.0 * step);
        let found =
            study.sensitivities().expect("derivatives").modes[twists].frequency().expect("it oscillates").by_design[0];
        assert!((found - slope).abs() < 1e-6 * omega / height, "{height}: {found} {slope}");
    }
}
