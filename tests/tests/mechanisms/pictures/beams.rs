//! Beams in pictures: where their centre lines run, how their sections stand, and how they move in modes.

use eigentol::Study;
use eigentol::picture::{Scene, Section, scene};
use eigentol_interpreter::Interpreted;

fn machine(text: &str) -> Interpreted {
    Interpreted::from_text(text).unwrap_or_else(|mistakes| panic!("{text}\n{mistakes:?}"))
}

/// The directions of the axes of a section: columns of its rotation.
fn axis(section: &Section, k: usize) -> [f64; 3] {
    section.pose.rotation.map(|row| row[k])
}

fn close(values: [f64; 3], expected: [f64; 3], bar: f64) {
    let apart = (0..3).map(|i| (values[i] - expected[i]).abs());
    assert!(apart.fold(0.0, f64::max) < bar, "{values:?} {expected:?}");
}

fn tapered() -> Scene {
    let text = "mechanism Blade {
        body blade: beam(length: 2 m, along: y, up: z,
            section: rectangle(width: 120 mm, height: 20 mm) to rectangle(width: 60 mm, height: 8 mm), twist: 0.5 rad,
            density: 2700 kg/m^3, modulus: 70 GPa);
        joint clamp: fixed from ground to blade at [0.1 m, 0, 0] rotated(z, 90 deg);
    }";
    let blade = machine(text);
    let q = vec![0.0; 10];
    scene(&blade, &q, &[], &[]).expect("a picture")
}

#[test]
fn a_straight_blade_is_tapered_and_twisted_about_its_axis() {
    let scene = tapered();
    let [blade] = &scene.beams[..] else { panic!("{:?}", scene.beams) };
    assert_eq!((&*blade.name, blade.round), ("blade", false));
    let root = scene.bodies[0].pose;
    let along = root.direction([0.0, 1.0, 0.0]);
    let up = root.direction([0.0, 0.0, 1.0]);
    let across = root.direction([-1.0, 0.0, 0.0]);
    for section in &blade.sections {
        let arm: [f64; 3] = core::array::from_fn(|i| section.pose.position[i] - root.position[i]);
        let reach: f64 = arm.iter().zip(along).map(|(a, b)| a * b).sum();
        close(arm, along.map(|along| reach * along), 1e-12);
        let share = reach / 2.0;
        let sizes = [0.12 - 0.06 * share, 0.02 - 0.012 * share];
        assert!(section.size.iter().zip(sizes).all(|(a, b)| (a - b).abs() < 1e-12));
        let (s, c) = (0.5 * share).sin_cos();
        close(axis(section, 0), along, 1e-12);
        close(axis(section, 1), core::array::from_fn(|i| c * across[i] + s * up[i]), 1e-12);
    }
    let places = &blade.sections;
    close(places[0].pose.position, root.position, 1e-15);
    close(places[places.len() - 1].pose.position, root.place([0.0, 2.0, 0.0]), 1e-12);
}

/// What is known by numbers is drawn as large as it is said to be, about its centre of mass.
#[test]
fn sections_by_numbers_have_the_size_that_is_given() {
    let numbers = "inertia_y: 1 g*m, inertia_z: 2 g*m, EIy: 2 N*m^2, EIz: 5 N*m^2, GJ: 1 N*m^2, mass: 1 kg/m";
    let text = format!(
        "mechanism Blade {{
            body blade: beam(length: 2 m, along: x, up: z, bending: 2, torsion: 1, center_y: 5 mm, section:
                section({numbers}, width: 60 mm, height: 30 mm) to section({numbers}, width: 20 mm, height: 10 mm));
            joint clamp: fixed from ground to blade;
        }}"
    );
    let scene = scene(&machine(&text), &[0.0; 5], &[], &[]).expect("a picture");
    let [blade] = &scene.beams[..] else { panic!("{:?}", scene.beams) };
    for section in &blade.sections {
        let share = section.pose.position[0] / 2.0;
        let expected = [0.06 - 0.04 * share, 0.03 - 0.02 * share];
        let apart = section.size.iter().zip(expected).map(|(a, b)| (a - b).abs());
        assert!(apart.fold(0.0, f64::max) < 1e-15, "{:?}", section.size);
        let [x, y, z] = section.pose.position;
        close([x, y, z], [x, 5e-3, 0.0], 1e-15);
    }
}

/// A constant curvature bends the centre line into an arc of a circle.
#[test]
fn a_bent_centre_line_is_an_arc() {
    let text = "mechanism Arm {
        body arm: beam(length: 1.5 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 2 N*m^2, bending_y: 8);
        joint clamp: fixed from ground to arm;
    }";
    let angle = 2.0;
    let mut q = vec![0.0; 8];
    q[0] = angle;
    let scene = scene(&machine(text), &q, &[], &[]).expect("a picture");
    let [arm] = &scene.beams[..] else { panic!("{:?}", scene.beams) };
    assert_eq!(arm.sections.len(), 12);
    let radius = 1.5 / angle;
    for section in &arm.sections {
        let [x, _, z] = axis(section, 0);
        let (sine, cosine) = (-z, x);
        let arc = [radius * sine, 0.0, radius * (cosine - 1.0)];
        // The polynomial through ten directions is not quite the arc.
        close(section.pose.position, arc, 1e-9);
        close(axis(section, 1), [0.0, 1.0, 0.0], 1e-12);
        assert_eq!(section.size, [0.0; 2]);
    }
    let tip = arm.sections[11].pose;
    let station = scene.bodies.iter().find(|body| &*body.name == "arm_tip").expect("a tip");
    assert_eq!(tip, station.pose);
    let [low, high] = scene.bounds;
    assert!((low[2] - tip.position[2]).abs() < 1e-12 && (high[0] - radius).abs() < 0.02 * radius);
}

/// A load splits a beam; the parts meet there, and in every frame of a mode.
#[test]
fn parts_of_a_beam_stay_together_in_modes() {
    let text = "mechanism Shaft {
        gravity 9.81 m/s^2 along -z;
        body shaft: beam(length: 1 m, along: x, up: z, section: tube(outer: 20 mm, inner: 17 mm),
            density: 2700 kg/m^3, modulus: 0.5 GPa, bending: 4);
        joint clamp: fixed from ground to shaft;
        body disk: disk(mass: 1 kg, radius: 0.1 m, axis: x);
        joint seat: fixed from shaft at 0.6 length to disk;
    }";
    let study = Study::new(machine(text));
    let rest = study.picture().expect("a picture");
    let [shaft] = &rest.beams[..] else { panic!("{:?}", rest.beams) };
    assert!(&*shaft.name == "shaft" && shaft.round);
    assert!(shaft.sections.iter().all(|section| section.size == [0.04; 2]));
    let of_beams: Vec<&str> =
        (0..rest.bodies.len()).filter(|body| rest.is_of_beam(*body)).map(|body| &*rest.bodies[body].name).collect();
    assert!(!of_beams.contains(&"disk") && of_beams.len() == rest.bodies.len() - 1);
    let (share, bodies) = (1e-4, rest.bodies.len());
    let first = shaft.sections.len() / 2;
    for mode in 0..3 {
        let swing = study.mode_pictures(mode, 4, share).expect("a swing");
        for frame in &swing.frames {
            assert_eq!(frame.len(), rest.poses());
            let [end, start] = [frame[bodies + first - 1], frame[bodies + first]];
            close(end.position, start.position, 1e-14);
        }
        let sections = shaft.sections.iter();
        let moved = sections.zip(&swing.frames[0][bodies..]).map(|(section, pose)| {
            let squares = (0..3).map(|i| (pose.position[i] - section.pose.position[i]).powi(2));
            squares.sum::<f64>().sqrt()
        });
        let farthest = moved.fold(0.0, f64::max) / rest.size();
        assert!(farthest <= 1.001 * share && farthest > 0.5 * share, "{mode}: {farthest}");
    }
}
