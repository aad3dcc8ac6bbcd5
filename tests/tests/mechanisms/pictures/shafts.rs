//! Shafts in pictures: the shape of their sections, how they bend between stations, and superelements.

use std::f64::consts::PI;

use eigentol::Study;
use eigentol::picture::{Beam, Scene, Section, Shape, scene};
use eigentol_interpreter::Interpreted;

use crate::pictures::space::{Vector, add, difference, dot, norm, scaled, subtract};

fn machine(text: &str) -> Interpreted {
    Interpreted::from_text(text).unwrap_or_else(|mistakes| panic!("{text}\n{mistakes:?}"))
}

/// The picture where all coordinates are zero.
fn at_rest(text: &str, design: &[f64]) -> Scene {
    let machine = machine(text);
    let count = machine.description().coordinates.len();
    scene(&machine, &vec![0.0; count], &[], design).expect("a picture")
}

fn only(scene: &Scene) -> &Beam {
    let [shaft] = &scene.beams[..] else { panic!("{:?}", scene.beams) };
    shaft
}

/// The direction of an axis of a section.
fn axis(section: &Section, k: usize) -> Vector {
    section.pose.rotation.map(|row| row[k])
}

const STEEL: &str = "material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;";

/// Two rows of one diameter with a station between, a step, a cone, and another one that begins where the first ends.
fn stepped() -> String {
    format!(
        "mechanism Rotor {{ {STEEL} design wide = 60 mm; design long = 80 mm;
            body rotor: shaft(along: y, up: z, material: steel, sections: [
                [120 mm, 40 mm], [30 mm, 40 mm], [long, wide, 20 mm], [60 mm, taper(50 mm, 30 mm), 20 mm],
                [50 mm, 30 mm, 10 mm, steel, 36 mm, 30 mm, steel]
            ]) at [0.1, 0.2, 0.3] m;
            point journal: rotor at station 1;
            point seat: ground at [0.1, 0.32, 0.3] m;
            force film: bushing(from: seat, to: journal, stiffness: [1, 1, 1] MN/m);
        }}"
    )
}

#[test]
fn cross_sections_have_the_places_and_diameters_that_are_declared() {
    let (wide, long) = (0.07, 0.1);
    let scene = at_rest(&stepped(), &[wide, long]);
    let shaft = only(&scene);
    assert_eq!((&*shaft.name, shaft.round), ("rotor", true));
    let bare: Vec<_> = (0..scene.bodies.len()).map(|body| scene.is_of_beam(body)).collect();
    assert_eq!((bare, scene.is_shaft(shaft)), (vec![true; 3], true));
    let rows = [(0.15, [0.04; 2]), (long, [wide; 2]), (0.06, [0.05, 0.03]), (0.05, [0.036; 2])];
    let along = |section: &Section| section.pose.position[1] - 0.2;
    let (mut sections, mut start) = (shaft.sections.iter().peekable(), 0.0);
    for (length, [first, last]) in rows {
        let end = start + length;
        let mut places = Vec::new();
        while let Some(section) = sections.next_if(|section| along(section) < end + 1e-12) {
            let share = (along(section) - start) / length;
            let diameter = first + share * (last - first);
            assert!(difference(&section.size, &[diameter; 2]) < 1e-15, "{section:?} {diameter}");
            let [x, _, z] = section.pose.position;
            assert!(difference(&[x, z], &[0.1, 0.3]) < 1e-15, "{section:?}");
            let axes = [0, 1, 2].map(|k| axis(section, k));
            let expected = [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
            assert!(difference(axes.as_flattened(), expected.as_flattened()) < 1e-15, "{axes:?}");
            places.push(along(section));
            if share > 1.0 - 1e-12 {
                break;
            }
        }
        assert!((places[0] - start).abs() < 1e-14 && (places[places.len() - 1] - end).abs() < 1e-14, "{places:?}");
        start = end;
    }
    assert_eq!(sections.next(), None);
    let [low, high] = scene.bounds;
    assert!(difference(&low, &[0.1 - wide / 2.0, 0.2, 0.3 - wide / 2.0]) < 1e-14, "{low:?}");
    assert!(difference(&high, &[0.1 + wide / 2.0, 0.2 + start, 0.3 + wide / 2.0]) < 1e-14, "{high:?}");
}

#[test]
fn the_volume_is_that_of_the_sections() {
    let scene = at_rest(&stepped(), &[0.06, 0.08]);
    let piece = |pair: &[Section]| {
        let [a, b] = [0, 1].map(|k| pair[k].size[0]);
        let length = norm(subtract(pair[1].pose.position, pair[0].pose.position));
        PI / 12.0 * length * (a * a + a * b + b * b)
    };
    let volume: f64 = only(&scene).sections.windows(2).map(piece).sum();
    let squares = 0.15 * 0.04_f64.powi(2) + 0.08 * 0.06_f64.powi(2) + 0.05 * 0.036_f64.powi(2);
    let cone = 0.06 * (0.05_f64.powi(2) + 0.05 * 0.03 + 0.03_f64.powi(2)) / 3.0;
    let expected = PI / 4.0 * (squares + cone);
    assert!((volume / expected - 1.0).abs() < 1e-13, "{volume} {expected}");
}

/// A shaft by numbers is a line; a long row has cross-sections between its ends.
#[test]
fn a_shaft_of_unknown_diameter_is_a_line() {
    let text = "mechanism Rotor { body rotor: shaft(along: x, up: z, length: 2 m, mass_per_length: 1 kg/m,
        stiffness: 10 N*m^2, shear: 0); }";
    let scene = at_rest(text, &[]);
    let sections = &only(&scene).sections;
    assert_eq!(sections.len(), 17);
    for (k, section) in sections.iter().enumerate() {
        assert_eq!(section.size, [0.0; 2]);
        assert!(difference(&section.pose.position, &[k as f64 / 8.0, 0.0, 0.0]) < 1e-15);
    }
}

/// The cubic with the places and directions of both ends: `z = c x^2 (3 l - x)` clamped at the root, and turned there.
#[test]
fn between_stations_the_axis_is_a_cubic() {
    let text = format!(
        "mechanism Rotor {{ {STEEL}
            body rotor: shaft(along: x, up: z, material: steel, lines: [bending, torsion], sections: [[2 m, 40 mm]]);
        }}"
    );
    let machine = machine(&text);
    let at = |name: &str, value: f64, q: &mut [f64]| {
        let description = machine.description();
        let index = description.coordinates.iter().position(|own| &*own.name == name).expect(name);
        q[index] = value;
    };
    let mut q = vec![0.0; machine.description().coordinates.len()];
    let (c, length) = (1e-5, 2.0_f64);
    at("rotor.z[1]", 2.0 * c * length.powi(3), &mut q);
    at("rotor.turn_y[1]", -3.0 * c * length.powi(2), &mut q);
    at("rotor.twist[1]", 0.5, &mut q);
    let scene = scene(&machine, &q, &[], &[]).expect("a picture");
    let sections = &only(&scene).sections;
    for section in sections {
        let [x, y, z] = section.pose.position;
        assert!(y.abs() < 1e-15 && (z - c * x * x * (3.0 * length - x)).abs() < 1e-11, "{section:?}");
        let axes = [0, 1, 2].map(|k| axis(section, k));
        for (i, a) in axes.iter().enumerate() {
            for (j, b) in axes.iter().enumerate() {
                assert!((dot(*a, *b) - f64::from(u8::from(i == j))).abs() < 1e-14, "{axes:?}");
            }
        }
        let slope = 3.0 * c * x * (2.0 * length - x);
        assert!((axes[0][2] - slope).abs() < 1e-9, "{axes:?} {slope}");
    }
    let (first, last) = (&sections[0], &sections[sections.len() - 1]);
    for (section, body) in [(first, 0), (last, 1)] {
        let pose = scene.bodies[body].pose;
        assert!(norm(subtract(section.pose.position, pose.position)) < 1e-15);
        assert!(difference(section.pose.rotation.as_flattened(), pose.rotation.as_flattened()) < 1e-14);
    }
}

/// A slender shaft on stiff bearings with a station in its middle bends in a half-wave; a step stays together.
#[test]
fn a_shaft_moves_with_its_mode() {
    let text = format!(
        "mechanism Rotor {{ {STEEL}
            body rotor: shaft(along: x, up: z, material: steel, shear: 0, sections: [[1 m, 10 mm], [1 m, 10.001 mm]]);
            body probe: point(mass: 1 mg);
            joint held: fixed from rotor at station 1 to probe;
            point left: rotor at root; point right: rotor at tip;
            point here: ground; point there: ground at [2 m, 0, 0];
            force bearing1: bushing(from: here, to: left, stiffness: [0, 1, 2] GN/m);
            force bearing2: bushing(from: there, to: right, stiffness: [0, 1, 2] GN/m);
        }}"
    );
    let study = Study::new(machine(&text));
    let rest = study.picture().expect("a picture");
    let (sections, bodies) = (&only(&rest).sections, rest.bodies.len());
    let share = 1e-4;
    let swing = study.mode_pictures(0, 4, share).expect("a swing");
    let frame = &swing.frames[0];
    assert_eq!(frame.len(), rest.poses());
    let moved: Vec<f64> = sections
        .iter()
        .zip(&frame[bodies..])
        .map(|(section, pose)| norm(subtract(pose.position, section.pose.position)))
        .collect();
    let most = moved.iter().copied().fold(0.0, f64::max);
    assert!((most / (share * rest.size()) - 1.0).abs() < 1e-3, "{most}");
    for (section, moved) in sections.iter().zip(&moved) {
        let expected = (PI * section.pose.position[0] / 2.0).sin();
        assert!((moved / most - expected).abs() < 0.02, "{moved} {expected}");
    }
    let step = sections.windows(2).position(|pair| pair[0].pose.position == pair[1].pose.position).expect("a step");
    assert!(norm(subtract(frame[bodies + step].position, frame[bodies + step + 1].position)) < 1e-15);
}

/// A superelement is seen as rods from its stations to their middle.
#[test]
fn superelements_are_rods() {
    let header = "%%MatrixMarket matrix coordinate real symmetric\n18 18";
    let ones: String = (1..=18).map(|k| format!("{k} {k} 1.0\n")).collect();
    let mass = format!("{header} 18\n{ones}");
    // A spring against twist between the first two stations, about x.
    let stiffness = format!("{header} 3\n4 4 1.0\n10 4 -1.0\n10 10 1.0\n");
    let text = format!(
        "mechanism Casing {{
            design high = 0.3 m;
            body casing: superelement(mass: \"mass.mtx\", stiffness: \"stiffness.mtx\",
                stations: [[0, 0, high], [0.6, 0.2, 0.3] m, [0, -0.5, 0] m]);
        }}
        file \"mass.mtx\" {mass:?}; file \"stiffness.mtx\" {stiffness:?};"
    );
    let scene = at_rest(&text, &[0.4]);
    let middle = [0.2, -0.1, 0.7 / 3.0];
    assert_eq!(scene.bodies.len(), 3);
    for (number, body) in scene.bodies.iter().enumerate() {
        assert!(!scene.is_of_beam(number));
        let [solid] = &body.solids[..] else { panic!("{body:?}") };
        let Shape::Rod { along, length } = solid.shape else { panic!("{solid:?}") };
        let half = scaled(length / 2.0, along);
        let ends = [subtract(solid.center, half), add(solid.center, half)].map(|end| body.pose.place(end));
        assert!(difference(&ends[0], &body.pose.position) < 1e-8, "{ends:?}");
        assert!(difference(&ends[1], &middle) < 1e-8, "{ends:?}");
        assert!((norm(along) - 1.0).abs() < 1e-15);
    }
}
