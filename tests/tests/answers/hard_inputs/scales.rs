//! The same machine a million times smaller or larger: the shape of the answer does not change.

use eigentol::tolerance::ModeTolerance;
use eigentol::{DesignVariable, Family, Mechanism, Stability, Study};
use eigentol_tests::corpus::rotating_double_pendulum::RotatingDoublePendulum;
use eigentol_tests::corpus::sliders_on_plate::SlidersOnPlate;

use super::sound::assert_equilibrium;

/// Scales lengths by `a`, masses by `c`, speeds by `1/sqrt(a)`: angles stay the same, and frequencies scale with the
/// speed.
#[test]
fn pendulums_of_every_size() {
    let at = |length: f64, mass: f64, speed: f64| {
        let design = RotatingDoublePendulum::DESCRIPTION.design;
        let mut study = Study::new(RotatingDoublePendulum)
            .input(RotatingDoublePendulum::omega, speed / length.sqrt())
            .start(RotatingDoublePendulum::theta1, 0.3);
        for (j, info) in design.iter().enumerate() {
            let factor = if info.unit.symbol.contains("kg") { mass } else { length };
            study = study
                .design(DesignVariable::new(j), factor * info.nominal)
                .tolerance(DesignVariable::new(j), factor * info.tolerance.upper);
        }
        study
    };
    for speed in [0.0, 1.0, 2.6, 2.7, 3.5, 12.0] {
        let usual = at(1.0, 1.0, speed);
        let reference = usual.equilibrium().expect("a state");
        let modes = usual.modes().expect("modes").modes;
        let sigmas = usual.first_order().expect("a spread").modes;
        for length in [1e-6, 1e-3, 1e3, 1e6] {
            for mass in [1e-9, 1.0, 1e9] {
                let what = format!("{speed} rad/s, lengths by {length:e}, masses by {mass:e}");
                let study = at(length, mass, speed);
                let state = study.equilibrium().expect("a state");
                assert_equilibrium(&RotatingDoublePendulum, &state);
                assert_eq!(state.stability, Stability::Stable, "{what}");
                let scaled = study.modes().expect("modes").modes;
                let spread = study.first_order().expect("a spread").modes;
                for i in 0..2 {
                    let off = (state.coordinates[i].abs() - reference.coordinates[i].abs()).abs();
                    assert!(off < 1e-10, "{what}: {state:?}");
                    let expected = modes[i].lambda / length;
                    let off = (scaled[i].lambda - expected).abs();
                    assert!(off <= 1e-8 * expected, "{what}: {}", scaled[i].lambda);
                    let sigma = |modes: &[ModeTolerance]| {
                        let frequency = modes[i].frequency();
                        frequency.expect("a frequency").sigma
                    };
                    let expected = sigma(&sigmas) / length.sqrt();
                    let found = sigma(&spread);
                    assert!((found - expected).abs() <= 1e-7 * expected, "{what}: {found}");
                }
            }
        }
    }
}

/// `x* = kx x0 / (kx - m omega^2)`, whatever the size of each quantity.
#[test]
fn sliders_of_every_size() {
    for length in [1e-9, 1e-3, 1e6, 1e12] {
        for force in [1e-12, 1e-3, 1e9] {
            for mass in [1e-9, 1.0, 1e6] {
                let (kx, m, x0) = (40.0 * force, 0.5 * mass, 0.1 * length);
                let omega = 4.0 * f64::sqrt(force / mass);
                let study = Study::new(SlidersOnPlate)
                    .input(SlidersOnPlate::omega, omega)
                    .design(SlidersOnPlate::m, m)
                    .design(SlidersOnPlate::kx, kx)
                    .design(SlidersOnPlate::ky, 60.0 * force)
                    .design(SlidersOnPlate::x0, x0)
                    .design(SlidersOnPlate::y0, 0.02 * length);
                let state = study.equilibrium().expect("a state");
                assert_equilibrium(&SlidersOnPlate, &state);
                let (x, y) = (state.coordinates[0], state.coordinates[1]);
                let near = |value: f64, expected: f64| (value - expected).abs() <= 1e-12 * expected;
                assert!(near(x, 0.125 * length), "{length:e} {force:e} {mass:e}: {x:e}");
                assert!(near(y, 0.3 / 13.0 * length), "{length:e} {force:e} {mass:e}: {y:e}");
                let undamped = study.clone().family(Family::Undamped);
                let lambda = undamped.modes().expect("modes").modes[0].lambda;
                assert!(near(lambda, 64.0 * force / mass), "{lambda:e}");
                let general = study.modes().expect("modes");
                for (mode, expected) in general.modes.iter().zip([5.791_190_506_937_825, 14.087_658_162_815_892]) {
                    let omega = mode.frequency().expect("it oscillates");
                    assert!(near(omega, expected * f64::sqrt(force / mass)), "{omega:e}");
                }
            }
        }
    }
}
