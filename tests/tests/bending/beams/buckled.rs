//! Beams that buckle.

use eigentol::branches::{BranchEnd, SpecialKind};
use eigentol::{Error, Input};

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

/// A column in space bends more and more beyond `pi^2 EI / 4 L^2`, and has no limit load: its branch ends where its tip
/// turns by more than 150 degrees, which is refused.
#[test]
fn a_buckled_column_is_followed_until_it_turns_too_far() {
    let column = study(
        "mechanism Column {
            input load: N;
            body column: beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 1 N*m^2,
                stiffness_z: 1.2 N*m^2, bending: 6, torsion: 0);
            joint clamp: fixed from ground to column;
            point end: column at tip;
            force weight: load(at: end, force: [-load, 0, 0]);
        }",
        None,
    );
    let load = Input::new(0);
    let critical = std::f64::consts::PI.powi(2) / 4.0;
    let turned = |error: &Error| matches!(error, Error::BentTooFar { degrees, .. } if (degrees - 150.0).abs() < 0.1);
    for high in [20.0, 30.0] {
        let found = column.events(load, 0.0, high, &[] as &[f64]).expect("events");
        let values: Vec<f64> = found.critical.iter().map(|state| state.value).collect();
        assert_eq!(values.len(), 1, "{values:?}");
        assert!((values[0] / critical - 1.0).abs() < 1e-6, "{values:?}");
        let gaps = &found.searched.gaps;
        assert!(matches!(&gaps[..], [gap] if turned(&gap.reason)), "{gaps:?}");
    }
    let found = column.branches(load, 0.0, 20.0).expect("branches");
    let special = found.branches.iter().flat_map(|branch| &branch.special);
    assert!(special.clone().count() > 0);
    for point in special {
        assert_ne!(point.kind, SpecialKind::Fold, "{found}");
    }
    let ends = found.branches.iter().flat_map(|branch| &branch.ends);
    let ends = ends.filter(|end| matches!(end, BranchEnd::Domain(error) if turned(error)));
    assert!(ends.count() > 0, "{found}");
}
