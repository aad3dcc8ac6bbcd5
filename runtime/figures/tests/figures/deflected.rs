//! Deflection curves of beams.

use eigentol::Study;
use eigentol_figures::figure::Panel;
use eigentol_figures::{Error, Figure, Style, deflections};
use eigentol_interpreter::Interpreted;

use crate::machines::save;

fn drawn(text: &str, modes: usize) -> Result<Figure, Error> {
    let study = Study::new(Interpreted::from_text(text).expect("a mechanism"));
    let (scene, found) = (study.picture().expect("a picture"), study.modes().expect("modes"));
    let moving: Vec<_> = (0..modes).map(|mode| study.mode_pictures(mode, 4, 1e-4).expect("a mode")).collect();
    deflections(&scene, &found, &moving, &Style::default())
}

fn panel<'a>(figure: &'a Figure, name: &str) -> &'a Panel {
    let found = figure.panels.iter().find(|panel| panel.y.name == name);
    found.unwrap_or_else(|| panic!("{name}: {:?}", figure.panels.iter().map(|panel| &panel.y.name).collect::<Vec<_>>()))
}

const CANTILEVER: &str = "mechanism Cantilever {
    body arm: beam(length: 1 m, along: x, up: z, bending: 7, stiffness_y: 1 N*m^2, stiffness_z: 4 N*m^2,
        mass_per_length: 1 kg/m);
    joint clamp: fixed from ground to arm;
}";

/// Euler's beam, clamped at one end: `cosh bx - cos bx - s (sinh bx - sin bx)`.
#[test]
fn a_cantilever_bends_as_euler_says() {
    let figure = drawn(CANTILEVER, 2).unwrap();
    let (b, s) = (1.875_104_068_711_961_f64, 0.734_095_513_757_4);
    let shape = |x: f64| (b * x).cosh() - (b * x).cos() - s * ((b * x).sinh() - (b * x).sin());
    for (name, mode) in [("displacement along z", 0), ("displacement along y", 1)] {
        let curves = &panel(&figure, name).curves;
        let own = curves.iter().find(|curve| curve.label.starts_with(&format!("mode {}", mode + 1))).expect(name);
        for at in own.pieces.concat() {
            let expected = shape(at[0]) / shape(1.0);
            assert!((at[1].abs() - expected).abs() < 2e-4, "{name}: {at:?} {expected}");
        }
    }
    assert_eq!(figure.panels.len(), 2, "nothing twists, and the equilibrium is straight");
    save(&figure, "deflections");
}

/// A shaft that only twists, `sin(pi x / 2 l)`, and one that hangs from both ends.
#[test]
fn what_twists_has_a_panel_and_so_has_what_sags() {
    let shaft = "mechanism Shaft { material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;
        body shaft: beam(length: 2 m, along: x, up: z, section: circle(radius: 20 mm), material: steel, bending: 0, torsion: 5);
        joint clamp: fixed from ground to shaft;
    }";
    let figure = drawn(shaft, 1).unwrap();
    let twist = panel(&figure, "twist");
    let own = twist.curves.iter().find(|curve| curve.label.starts_with("mode 1")).unwrap();
    for at in own.pieces.concat() {
        let expected = (std::f64::consts::FRAC_PI_4 * at[0]).sin();
        assert!((at[1].abs() - expected).abs() < 1e-3, "{at:?} {expected}");
    }
    let heavy = CANTILEVER.replace("body arm", "gravity 0.1 m/s^2 along -z; body arm");
    let sag = drawn(&heavy, 1).unwrap();
    let tip = *panel(&sag, "equilibrium, z").curves[0].pieces[0].last().unwrap();
    // `q l^4 / 8 EI`, to the accuracy of small bending, mm.
    assert!((tip[1] + 1e3 * 0.1 / 8.0).abs() < 0.01, "{tip:?}");
}

#[test]
fn a_machine_without_beams_has_no_deflection_curves() {
    let text = "mechanism Spring { body a: point(mass: 1 kg); joint x: prismatic(x) from ground to a;
        force s: spring(on: x, stiffness: 9 N/m); }";
    assert!(matches!(drawn(text, 1), Err(Error::Nothing(_))));
}
