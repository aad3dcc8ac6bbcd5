//! Beams with more coordinates than declared.

use eigentol::Study;
use eigentol::convergence::Convergence;
use eigentol::response::Response;
use eigentol::sensitivity::Quantity;
use eigentol_interpreter::{Interpreted, RefineError};

use crate::beams::compared::machine;

/// A cantilever that its weight bends, with this many coordinates.
fn cantilever(bending: usize, more: &str) -> String {
    format!(
        "mechanism Cantilever {{
            gravity 1 m/s^2 along -z;
            body arm: beam(length: 1 m, along: x, up: z, bending_y: {bending}, stiffness_y: 10 N*m^2,
                mass_per_length: 1 kg/m{more});
            joint clamp: fixed from ground to arm;
            point end: arm at tip;
            output height = position(end).z;
        }}"
    )
}

fn convergence(study: &Study<Interpreted>, text: &str) -> Convergence {
    let refined = [1, 2].map(|more| Interpreted::refined(text, more).expect("a beam"));
    study.convergence(refined).expect("a comparison")
}

fn frequencies(mechanism: Interpreted) -> Vec<f64> {
    let modes = Study::new(mechanism).modes().expect("modes");
    modes.frequencies().into_iter().flatten().collect()
}

/// The changes of one answer.
fn changes(of: &Convergence, answer: Response) -> [f64; 2] {
    let change = of.changes.iter().find(|change| change.answer == answer);
    change.expect("the answer").relative.map(|relative| relative.expect("a change"))
}

fn frequency(mode: usize) -> Response {
    let quantity = Quantity::Frequency;
    Response::Mode { mode, quantity }
}

#[test]
fn a_refined_beam_is_one_declared_with_more() {
    let text = |bending: usize, torsion: usize, shear: usize| {
        format!(
            "mechanism Mast {{
                body mast: beam(length: 1 m, along: z, up: x, section: tube(outer: 40 mm, inner: 30 mm),
                    density: 2700 kg/m^3, modulus: 70 GPa, shear_modulus: 26 GPa, bending: {bending},
                    torsion: {torsion}, shear: {shear});
                joint foot: fixed from ground to mast;
            }}"
        )
    };
    let refined = Interpreted::refined(&text(4, 2, 2), 1).expect("a beam");
    let declared = machine(&text(5, 3, 3));
    assert_eq!(refined.description().coordinates, declared.description().coordinates);
    assert_eq!(frequencies(refined), frequencies(declared));
}

#[test]
fn changes_are_those_of_beams_declared_with_more() {
    let text = cantilever(4, "");
    let study = Study::new(machine(&text));
    let convergence = convergence(&study, &text);
    let declared = frequencies(machine(&text));
    for (k, bending) in [5, 6].into_iter().enumerate() {
        let more = frequencies(machine(&cantilever(bending, "")));
        for (mode, own) in declared.iter().enumerate() {
            // More coordinates lower frequencies.
            let expected = more[mode] / own - 1.0;
            let change = changes(&convergence, frequency(mode))[k];
            assert!((change - expected).abs() < 1e-11, "{mode}: {change}");
        }
    }
    let first = changes(&convergence, frequency(0));
    assert!(first.iter().all(|own| (-1e-5..-1e-7).contains(own)));
    let fourth = changes(&convergence, frequency(3));
    assert!(fourth.iter().all(|own| *own < -0.1), "{fourth:?}");
}

#[test]
fn with_five_coordinates_the_first_mode_stays() {
    let text = cantilever(5, "");
    let convergence = convergence(&Study::new(machine(&text)), &text);
    assert!(changes(&convergence, frequency(0)).iter().all(|own| own.abs() < 1e-6));
    let said = convergence.to_string();
    assert!(said.contains("Modes 1 and 2 change by less than 1e-"), "{said}");
    assert!(said.contains("`height` changes only by rounding"), "{said}");
    assert_eq!(convergence.of_first(2).changes.len(), 3);
}

/// So much damping that the last modes do not oscillate: these come first, and are not compared.
#[test]
fn damping_ratios_are_compared_too() {
    let text = cantilever(6, ", lag: 1 ms");
    let found = convergence(&Study::new(machine(&text)), &text).of_first(1);
    let mode = found.changes[0].mode().expect("a mode");
    assert!(mode > 0);
    let quantity = Quantity::DampingRatio;
    for answer in [frequency(mode), Response::Mode { mode, quantity }] {
        let [one, two] = changes(&found, answer);
        assert!(one.abs() < 1e-6 && two.abs() < 1e-6, "{one} {two}");
    }
    assert_eq!(found.changes.len(), 3);
}

/// The compared equilibrium is that of the study, here the unstable one of a column that has buckled.
#[test]
fn a_refined_study_stays_at_the_equilibrium() {
    let text = "mechanism Column {
        gravity 10 m/s^2 along -z;
        body column: beam(length: 1 m, along: z, up: x, bending_y: 5, stiffness_y: 1 N*m^2, mass_per_length: 1 kg/m);
        joint clamp: fixed from ground to column;
        point end: column at tip;
        output height = position(end).z;
    }";
    let study = Study::new(machine(text));
    let upright = study.clone().stay();
    let height = |study: &Study<Interpreted>| study.outputs().expect("outputs").values[0];
    assert!((height(&upright) - 1.0).abs() < 1e-12 && height(&study) < 0.9);
    for study in [study, upright] {
        let convergence = convergence(&study, text);
        let moved = changes(&convergence, Response::Output(eigentol::Output::new(0)));
        assert!(moved.iter().all(|own| own.abs() < 1e-3), "{moved:?}");
    }
}

#[test]
fn the_rule_counts_planes_of_bending_and_other_coordinates() {
    assert_eq!(machine(&cantilever(4, "")).description().resolved_modes, Some(1));
    assert_eq!(machine(&cantilever(5, "")).description().resolved_modes, Some(2));
    assert_eq!(machine(&cantilever(8, "")).description().resolved_modes, Some(4));
    let swinging = cantilever(5, "").replace("joint clamp: fixed from", "joint clamp: revolute(y) from");
    assert_eq!(machine(&swinging).description().resolved_modes, Some(3));
}

#[test]
fn a_mechanism_without_beams_cannot_be_refined() {
    let text = "mechanism Rigid { gravity 9.81 m/s^2 along -z;
        body bar: rod(mass: 1 kg, length: 1 m, along: -z); joint t: revolute(y) from ground to bar; }";
    assert_eq!(machine(text).description().resolved_modes, None);
    let refused = Interpreted::refined(text, 1).expect_err("no beam");
    assert!(matches!(refused, RefineError::NoBeam { .. }));
    assert_eq!(refused.to_string(), "`Rigid` has no beam, so there are no coordinates to add");
    let refused = Interpreted::refined("mechanism Wrong { body }", 1);
    assert!(matches!(refused, Err(RefineError::Mistakes(_))));
}
