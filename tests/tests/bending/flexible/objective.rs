//! What turning the whole machine, or describing it in other axes, must not change; and what roundness means.

use eigentol::{Input, Study};
use eigentol_interpreter::Interpreted;

use crate::flexible::judged::{Machine, assert_close};

/// Frequencies of the modes, rad/s, rising.
fn frequencies(text: &str, speed: Option<f64>) -> Vec<f64> {
    let machine = Interpreted::from_text(text);
    let study = Study::new(machine.unwrap_or_else(|mistakes| panic!("{text}\n{mistakes:?}")));
    let study = match speed {
        Some(speed) => study.input(Input::new(0), speed),
        None => study,
    };
    let modes = study.modes().unwrap_or_else(|error| panic!("{error}\n{text}"));
    let mut values: Vec<f64> = modes.frequencies().into_iter().flatten().collect();
    values.sort_by(f64::total_cmp);
    values
}

const SECTION: &str = "mass_per_length: 0.6 kg/m, stiffness_y: 9 N*m^2, stiffness_z: 16 N*m^2, \
    torsion_stiffness: 5 N*m^2, inertia_y: 1 g*m, inertia_z: 2 g*m, bending: 3, torsion: 2, twist: 0.5 rad";

/// `gravity` and `mast` are vectors in the ground; `turned` is the rotation of everything.
fn boom(gravity: [f64; 3], mast: [f64; 3], turned: &str, axes: &str, back: &str) -> String {
    format!(
        "mechanism Boom {{
            gravity {gravity:?} m/s^2;
            body boom: beam(length: 1.2 m, {axes}, {SECTION});
            body pod: box(mass: 0.3 kg, size: [0.2, 0.1, 0.3] m, center: [0.1, 0.05, 0] m);
            joint clamp: fixed from ground to boom {turned} rotated(y, 0.3 rad) {back};
            joint end: revolute(z) from boom at tip to pod {};
            force hinge: spring(on: end, stiffness: 6 N*m/rad);
            point eye: boom at 0.6 length;
            point mast: ground at {mast:?} m;
            force stay: spring_damper(from: mast, to: eye, stiffness: 20 N/m, length: 0.4 m);
        }}",
        match back {
            "" => "",
            _ => "rotated(z, -90 deg)",
        }
    )
}

#[test]
fn turning_everything_changes_no_frequency() {
    let along_x = "along: x, up: z";
    let upright = boom([0.0, 2.0, -9.0], [0.3, 0.4, 0.9], "", along_x, "");
    let expected = frequencies(&upright, None);
    // the axes x, y, z become y, z, x, by a third of a turn about [1, 1, 1]
    let turned = boom([-9.0, 0.0, 2.0], [0.9, 0.3, 0.4], "rotated([1, 1, 1], 120 deg)", along_x, "");
    let size = expected[0];
    assert_close("turned", &frequencies(&turned, None), &expected, 1e-9, size);
    // the same beam described along -y of a frame that is turned back
    let described = boom([0.0, 2.0, -9.0], [0.3, 0.4, 0.9], "", "along: -y, up: z", "rotated(z, 90 deg)");
    let values = frequencies(&described, None);
    assert_close("described along -y", &values, &expected, 1e-9, size);
}

const ROUND: &str = "section: tube(outer: 20 mm, inner: 16 mm) to tube(outer: 12 mm, inner: 9 mm), \
    density: 2700 kg/m^3, modulus: 70 GPa";

fn round(along: &str, up: &str, gravity: &str, section: &str) -> String {
    format!(
        "mechanism Round {{
            input omega: rad/s;
            {gravity}
            body hub: massless;
            body rod: beam(length: 0.8 m, along: {along}, up: {up}, {section});
            joint spin: revolute(z) from ground to hub, driven at omega;
            joint clamp: fixed from hub to rod;
        }}"
    )
}

#[test]
fn round_beams_have_double_frequencies() {
    for (along, up) in [("x", "z"), ("z", "[1, 3, 0]"), ("[1, 2, 2]", "[2, 1, -2]")] {
        let section = format!("{ROUND}, bending: 4");
        let values = frequencies(&round(along, up, "", &section), Some(0.0));
        assert_eq!(values.len(), 8);
        for pair in values.chunks(2) {
            assert_close("double", &pair[..1], &pair[1..], 1e-10, pair[0]);
        }
    }
    // whatever the twist of the section
    let section = format!("{ROUND}, bending: 4, twist: 40 deg");
    let values = frequencies(&round("x", "z", "", &section), Some(0.0));
    for pair in values.chunks(2) {
        assert_close("double", &pair[..1], &pair[1..], 1e-10, pair[0]);
    }
}

/// Seen from the axes that turn with it, a whirl of a thin round rod about its own axis, which the spin does not
/// stiffen, is faster and slower by the spin.
#[test]
fn a_round_rod_about_its_own_axis_splits_by_the_spin() {
    let section = "mass_per_length: 0.6 kg/m, stiffness_y: 9 N*m^2, stiffness_z: 9 N*m^2, bending: 4";
    let text = round("z", "x", "", section);
    let rest = frequencies(&text, Some(0.0));
    let spin = 3.0;
    let mut expected: Vec<f64> = rest.chunks(2).flat_map(|pair| [pair[0] - spin, pair[0] + spin]).collect();
    expected.sort_by(f64::total_cmp);
    assert!(rest[0] > spin);
    let values = frequencies(&text, Some(spin));
    assert_close("split", &values, &expected, 1e-9, rest[0]);
}

/// A shaft that only twists, spun about its own axis on a base that tilts: it is a rotor, and must be round.
#[test]
fn a_twisting_rotor_must_be_round() {
    let text = |inertia_z: &str| {
        format!(
            "mechanism Rotor {{
                input omega: rad/s;
                gravity 9.81 m/s^2 along -z;
                body base: box(mass: 2 kg, size: [0.2, 0.2, 0.1] m);
                body shaft: beam(length: 0.7 m, along: z, up: x, mass_per_length: 3 kg/m, torsion_stiffness: 40 N*m^2,
                    inertia_y: 0.02 kg*m, inertia_z: {inertia_z}, torsion: 2, bending: 0);
                joint tilt: universal(a: x, b: y) from ground to base;
                joint spin: revolute(z) from base to shaft, driven at omega;
                force fa: spring(on: a, stiffness: 900 N*m/rad);
                force fb: spring(on: b, stiffness: 900 N*m/rad);
            }}"
        )
    };
    let machine = Machine::right(&text("0.02 kg*m"));
    let mut random = eigentol_oracle::random::Random::new(6);
    crate::flexible::judged::judge("rotor", &machine, &machine.state(&mut random));
    let values = frequencies(&text("0.02 kg*m"), Some(200.0));
    assert_eq!(values.len(), 4);
    let refusal = Machine::new(&text("0.03 kg*m")).err().expect("refused");
    assert!(refusal.contains("depend on the driven"), "{refusal}");
}

/// A beam that bends as it turns about its own axis on a base that tilts is never the same from instant to instant.
#[test]
fn a_bending_rotor_on_a_tilting_base_is_refused() {
    let text = "mechanism Rotor {
        input omega: rad/s;
        body base: box(mass: 2 kg, size: [0.2, 0.2, 0.1] m);
        body shaft: beam(length: 0.7 m, along: z, up: x, mass_per_length: 3 kg/m, stiffness_y: 40 N*m^2,
            stiffness_z: 40 N*m^2, bending: 2);
        joint tilt: universal(a: x, b: y) from ground to base;
        joint spin: revolute(z) from base to shaft, driven at omega;
        force fa: spring(on: a, stiffness: 900 N*m/rad);
        force fb: spring(on: b, stiffness: 900 N*m/rad);
    }";
    let refusal = Machine::new(text).err().expect("refused");
    assert!(refusal.contains("depend on the driven"), "{refusal}");
}

/// A beam clamped at its root whose tip slides in a clamp: `cos bl cosh bl = 1`, `w = bl^2 sqrt(EI / m) / l^2`.
#[test]
fn a_beam_clamped_at_both_ends() {
    let text = "mechanism Clamped {
        body beam: beam(length: 2 m, along: x, up: z, mass_per_length: 0.5 kg/m, stiffness_y: 8 N*m^2, bending_y: 9);
        joint clamp: fixed from ground to beam;
        joint slide: prismatic(x) from ground to beam at [2, 0, 0] m on ground, at tip on beam, cut;
    }";
    let values = frequencies(text, None);
    for (found, bl) in values.iter().zip([4.730_040_744_862_704_f64, 7.853_204_624_095_838]) {
        let expected = bl * bl * (8.0_f64 / 0.5).sqrt() / 4.0;
        assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
    }
}
