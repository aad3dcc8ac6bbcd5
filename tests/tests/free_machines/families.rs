//! Families of steady motions: the unknowns that are held select the member, and what derivatives compare (`U2`).

use eigentol::equilibrium::Note;
use eigentol::{Coordinate, Error, Study};
use eigentol_interpreter::Interpreted;

use super::common::{close, frequencies, number, numbers, study, truth};

/// A disc rolls without slip, its lean, its course and its spin free.
fn coin() -> Study<Interpreted> {
    study(
        "mechanism Coin {
            design m_ = 1 kg;
            design r_ = 0.5 m;
            gravity 9.81 m/s^2 along -z;
            body base: massless;
            body mast: massless;
            body fork: massless;
            body wheel: disk(mass: m_, radius: r_, axis: y);
            joint travel: planar(forward: x, side: y, yaw: z) from ground to base, coasting;
            joint height: prismatic(z) from base to mast;
            joint lean: revolute(x) from mast to fork;
            joint spin: revolute(y) from fork to wheel, coasting;
            point hub: wheel;
            point road: ground;
            constraint contact: rolling(wheel: hub, axis: y, radius: r_, on: road);
        }",
    )
}

fn unknown(study: &Study<Interpreted>, name: &str) -> Coordinate<Interpreted> {
    let all = &study.description().coordinates;
    let place = all.iter().position(|info| info.name == *name);
    Coordinate::new(place.expect("an unknown"))
}

#[test]
fn a_coin_in_a_circle() {
    let truth = truth("U2_coin_family");
    let values = numbers(&truth["values"]);
    let parameter = |name: &str| number(&truth["parameters"][name]);
    let [lean, yaw, spin] = ["lean", "yaw", "spin"].map(|name| unknown(&coin(), name));
    let height = unknown(&coin(), "height");
    let start = coin().guess(height, 0.5);
    let by_yaw = (start.clone())
        .hold(lean, parameter("lean"))
        .hold(yaw, parameter("yaw_rate"))
        .guess(spin, 4.0);
    let by_spin = start
        .hold(lean, parameter("lean"))
        .hold(spin, parameter("spin"))
        .guess(yaw, -1.0);
    for (study, name) in [
        (by_yaw, "held_lean_and_yaw_rate"),
        (by_spin, "held_lean_and_spin"),
    ] {
        let solved = study.solve().expect(name);
        let state = &solved.equilibrium;
        assert!(
            state.notes.contains(&Note::Member { dimension: 2 }),
            "{:?}",
            state.notes
        );
        let at = |unknown: Coordinate<_>| state.coordinates[unknown.index()];
        close(at(spin), values[1], 1e-11, "spin");
        close(at(yaw), values[2], 1e-11, "yaw rate");
        let found = frequencies(&solved);
        assert_eq!(found.len(), 1, "{:?}", solved.modes);
        close(found[0], values[0], 1e-10, "frequency");
        let slopes = solved.sensitivities().expect("derivatives");
        let r = solved
            .modes
            .modes
            .iter()
            .position(|mode| mode.frequency().is_some());
        let own = slopes.modes[r.expect("it wobbles")]
            .frequency()
            .expect("derivatives");
        close(
            own.by_design[1],
            number(&truth[name]["first"]["r"][0]),
            1e-9,
            "by radius",
        );
        assert!(own.by_design[0].abs() < 1e-9);
    }
}

#[test]
fn too_many_or_dependent_unknowns_are_refused() {
    let [lean, yaw, spin] = ["lean", "yaw", "spin"].map(|name| unknown(&coin(), name));
    let all = coin().hold(lean, 0.3).hold(yaw, -1.0).hold(spin, 4.0);
    assert!(
        matches!(all.equilibrium(), Err(Error::NotHeld { dimension: 2, .. })),
        "{:?}",
        all.equilibrium()
    );
}
