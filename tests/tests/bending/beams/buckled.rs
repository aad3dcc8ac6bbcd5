//! Beams that buckle sideways.

use crate::beams::compared::study;

/// A narrow cantilever loaded across at its tip turns sideways at `4.0126 sqrt(EI GJ) / L^2` (Michell 1899, Prandtl 1899),
/// where `EI` is its stiffness sideways: its frequency vanishes there.
#[test]
fn a_narrow_cantilever_buckles_sideways_at_the_load_of_prandtl() {
    let lowest = |load: f64| {
        let strip = study(
            "mechanism Strip {
                input load: N;
                body strip: beam(length: 1.3 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 4e5 N*m^2,
                    stiffness_z: 4 N*m^2, torsion_stiffness: 7 N*m^2, inertia_y: 1e-3 kg*m, inertia_z: 1e-3 kg*m, bending: 6,
                    torsion: 6);
                joint clamp: fixed from ground to strip;
                point end: strip at tip;
                force weight: load(at: end, force: [0, 0, -load]);
            }",
            Some(load),
        );
        let modes = strip.modes().expect("modes");
        modes.modes[0].s.im.powi(2)
    };
    let critical = 4.012_599_34 * (4.0_f64 * 7.0).sqrt() / 1.3_f64.powi(2);
    // Next to it, lambda falls in a straight line over the square of the load.
    let squares = [0.99_f64, 0.999].map(|share| (share.powi(2), lowest(share * critical)));
    let [(a, first), (b, second)] = squares;
    assert!(second > 0.0 && second < 0.2 * first, "{squares:?}");
    let zero = (b + (b - a) * second / (first - second)).sqrt();
    assert!((zero - 1.0).abs() < 1e-4, "{zero}");
}
