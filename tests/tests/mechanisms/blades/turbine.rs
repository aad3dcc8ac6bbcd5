//! Three blades with gravity across the axis: the coefficients stay periodic, three times a turn.

use super::*;
use crate::free_machines::common::truth;

const UNITS: [(&str, &str); 11] = [
    ("mx", "kg"),
    ("kx", "N/m"),
    ("ky", "N/m"),
    ("cx", "N*s/m"),
    ("cy", "N*s/m"),
    ("m", "kg"),
    ("S", "kg*m"),
    ("I", "kg*m^2"),
    ("e", "m"),
    ("cl", "N*m*s/rad"),
    ("kl", "N*m/rad"),
];

fn turbine(truth: &Value) -> String {
    format!(
        "part Blade(m: kg, S: kg*m, I: kg*m^2, e: m, kl: N*m/rad, cl: N*m*s/rad) {{
            let J: kg*m^2 = I - S^2 / m;
            port root;
            body arm: rigid(mass: m, inertia: [0 kg*m^2, J, J], center: [S / m, 0 m, 0 m]);
            joint lag: revolute(z) from root to arm at [e, 0 m, 0 m];
            force hinge: spring(on: lag, stiffness: kl);
            force damp: damper(on: lag, damping: cl);
        }}
        mechanism Turbine {{
            input omega: rad/s;
            gravity {:?} m/s^2 along -y;
            {}
            body frame: massless;
            body nacelle: point(mass: mx);
            body hub: massless;
            joint x: prismatic(x) from ground to frame;
            joint y: prismatic(y) from frame to nacelle;
            joint spin: revolute(z) from nacelle to hub, driven at omega;
            force sx: spring(on: x, stiffness: kx);
            force sy: spring(on: y, stiffness: ky);
            force dx: damper(on: x, damping: cx);
            force dy: damper(on: y, damping: cy);
            cyclic blade[0..3] about z {{
                use blade: Blade(m: m, S: S, I: I, e: e, kl: kl, cl: cl) with root: hub;
            }}
        }}",
        number(&truth["parameters"]["g"]),
        declared(&truth["parameters"], &UNITS)
    )
}

#[test]
fn a_turbine_with_gravity_across_its_axis() {
    let truth = truth("B3_turbine_gravity");
    let study = at(&turbine(&truth), number(&truth["omega"]));
    let expected = list(&truth["exponents"]);
    let places = same_exponents(&study, &expected, 1e-8);
    let modes = study.modes().expect("modes");
    for (place, s) in places.iter().zip(&expected) {
        let mode = &modes.modes[*place];
        assert!((mode.s - s).norm() <= mode.error && mode.error < 1e-5 * s.norm(), "{} {:.1e}", mode.s, mode.error);
    }
    for (variable, of) in UNITS.iter().map(|(name, _)| (*name, vec![*name])) {
        // The nacelle moves along both axes.
        let of = if variable == "mx" { vec!["mx", "my"] } else { of };
        let sum = |r: usize| -> Complex { of.iter().map(|one| complex(&truth["first"][*one][r])).sum() };
        let scale = 1e-2 * (0..expected.len()).map(|r| sum(r).norm()).fold(0.0, f64::max);
        let found = derivatives(&study, variable);
        for (r, place) in places.iter().enumerate() {
            close(found[*place].expect("a derivative"), sum(r), 1e-5, scale, &format!("{variable} {r}"));
        }
    }
    // The steady motion: the means, and what vibrates three times a turn.
    let at = study.equilibrium().expect("steady motion");
    let mean = numbers(&truth["steady_mean"]);
    for (k, mean) in mean.iter().enumerate() {
        assert!((at.coordinates[k] - mean).abs() < 1e-8, "{k}");
        let amplitude = complex(&truth["steady_first_harmonic"][k]) * 2.0;
        let found = Complex::new(at.coordinates[5 + k], -at.coordinates[10 + k]);
        assert!((found - amplitude).norm() < 1e-5 * 4e-3, "{k}: {found} {amplitude}");
    }
}

#[test]
fn more_than_a_small_periodic_part_is_refused() {
    let mut truth = truth("B3_turbine_gravity");
    truth["parameters"]["g"] = 300.0.into();
    let error = at(&turbine(&truth), number(&truth["omega"])).modes().map(drop).expect_err("Floquet");
    assert!(error.to_string().contains("Floquet"), "{error}");
}
