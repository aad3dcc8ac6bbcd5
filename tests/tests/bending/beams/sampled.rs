//! Tolerances of beams: in vectors as one by one, and as the first order says.

use eigentol::tolerance::Statistics;

use crate::beams::compared::study;

const SAMPLES: usize = 2000;

/// Bends under its own weight and spins, so that the equilibrium moves with every dimension.
const BLADE: &str = "mechanism Blade {
    gravity 9.81 m/s^2 along -z;
    design L = 0.8 m +/- 0.1 %; design w = 30 mm +/- 0.3 %; design h = 3 mm +/- 0.3 %; design E = 70 GPa +/- 0.5 %;
    body hub: massless;
    body blade: beam(length: L, along: x, up: z, section: rectangle(width: w, height: h), density: 2700 kg/m^3, modulus: E,
        bending_y: 5);
    joint spin: revolute(z) from ground to hub, driven at 30 rad/s;
    joint clamp: fixed from hub to blade at [0.1 m, 0, 0];
}";

#[test]
fn designs_with_beams_are_solved_in_vectors() {
    let study = study(BLADE, None).samples(SAMPLES);
    let together = study.monte_carlo().expect("samples");
    let alone = study.clone().vectors(None).monte_carlo().expect("samples");
    assert!(together.side_by_side && !alone.side_by_side);
    let second = study.second_order().expect("second order");
    for k in 0..3 {
        let of = |all: &[Option<Statistics>]| all[k].clone().expect("samples");
        let (a, b) = (of(&together.modes), of(&alone.modes));
        let scale = b.mean.abs();
        assert!((a.mean - b.mean).abs() < 1e-9 * scale, "{k}");
        let (a, b) = (a.sigma.expect("many"), b.sigma.expect("many"));
        assert!((a - b).abs() < 1e-9 * scale, "{k}: {a} {b}");
        let sigma = second.modes[k].as_ref().expect("derivatives").frequency.moments.sigma;
        // Four standard errors of a deviation.
        let error = 4.0 / (2.0 * SAMPLES as f64).sqrt();
        assert!((b / sigma - 1.0).abs() < error, "{k}: {b} {sigma}");
    }
}
