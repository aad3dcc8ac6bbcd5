use eigentol::equilibrium::{AssemblyMode, assemble};
use eigentol::{Coordinate, Error, Study, Text};

use super::bordered::bordered;
use super::models::{FOUR_BAR, FourBar, Parallelogram, SLIDER, SliderCrank, Truss};
use crate::common::close;

/// Intersection of two circles about `a` and `b`, to the left or right of the direction from `a` to `b`.
fn meeting(a: [f64; 2], b: [f64; 2], radii: [f64; 2], left: bool) -> [f64; 2] {
    let d = [b[0] - a[0], b[1] - a[1]];
    let square = d[0] * d[0] + d[1] * d[1];
    let along = 0.5 + (radii[0] * radii[0] - radii[1] * radii[1]) / (2.0 * square);
    let across = (radii[0] * radii[0] / square - along * along).sqrt();
    let across = if left { across } else { -across };
    [a[0] + along * d[0] - across * d[1], a[1] + along * d[1] + across * d[0]]
}

#[test]
fn a_four_bar_closes_on_either_side() {
    let [_, _, l1, l2, l3, d, ..] = FOUR_BAR;
    let ax = 0.25;
    let ay = (l1 * l1 - ax * ax).sqrt();
    let mut modes = Vec::new();
    for left in [true, false] {
        let guess = if left { [0.6, 0.5] } else { [0.4, -0.4] };
        let study = Study::new(bordered(FourBar))
            .start(Coordinate::new(0), ax)
            .guess(Coordinate::new(1), 0.2)
            .guess(Coordinate::new(2), guess[0])
            .guess(Coordinate::new(3), guess[1]);
        let found = study.assembly().expect("it closes");
        let expected = meeting([ax, ay], [d, 0.0], [l2, l3], left);
        for (j, value) in [ax, ay, expected[0], expected[1]].into_iter().enumerate() {
            close(found.coordinates[j], value, 1e-13);
        }
        assert_eq!(found.coordinates[0], ax);
        assert_eq!(found.moved[0], 0.0);
        close(found.moved[3], expected[1] - guess[1], 1e-12);
        assert!(found.gaps.iter().all(|gap| gap.abs() < 1e-15));
        assert!(!found.singular && found.margin > 1e-2);
        assert_eq!((found.constraints.freedom, found.constraints.redundant), (1, 0));
        modes.push(found.mode.expect("as many held as free"));
        let text = found.to_string();
        assert!(text.contains("assembly mode") && text.contains("coupler"), "{text}");
    }
    assert_ne!(modes[0], modes[1]);
    assert!(modes.contains(&AssemblyMode::Positive));
}

#[test]
fn without_held_coordinates_there_is_no_assembly_mode() {
    let start = [0.3, 0.3, 0.7, 0.5, 1e9, f64::from(3), -7.0];
    let found = assemble(&bordered(FourBar), &[0.0], &FOUR_BAR, &start, &[]).expect("it closes");
    assert_eq!(found.mode, None);
    assert!(!found.singular);
    // Reactions are those that balance best, not their start values.
    assert!(found.coordinates[4].abs() < 1e3);
}

#[test]
fn a_slider_crank_far_from_closed() {
    let [_, _, _, l1, l2, ..] = SLIDER;
    for (crank, rod) in [(1.0_f64, -0.3), (2.5, -0.2), (-1.2, 0.4), (1.0, 3.3)] {
        let study = Study::new(bordered(SliderCrank)).start(Coordinate::new(2), crank).guess(Coordinate::new(5), rod);
        let found = study.assembly().expect("it closes");
        let mut angle = (-l1 * crank.sin() / l2).asin();
        if rod > 2.0 {
            angle = std::f64::consts::PI - angle;
        }
        close(found.coordinates[5], angle, 1e-12);
        close(found.coordinates[6], l1 * crank.cos() + l2 * angle.cos(), 1e-12);
        assert!(found.mode.is_some());
    }
}

#[test]
fn dead_centres_are_reported() {
    let [_, _, _, l1, l2, ..] = SLIDER;
    // The slider is held where crank and rod are in line: this does not determine the crank.
    let study = Study::new(bordered(SliderCrank))
        .start(Coordinate::new(6), l1 + l2)
        .guess(Coordinate::new(2), 0.2)
        .guess(Coordinate::new(5), -0.1)
        .guess(Coordinate::new(0), 0.12)
        .guess(Coordinate::new(3), 0.5);
    let found = study.assembly().expect("it closes");
    assert!(found.singular && found.margin < 1e-6, "{}", found.margin);
    assert_eq!(found.mode, None);
    assert!(found.coordinates[2].abs() < 1e-5);
    // The mechanism itself is not in a singular configuration: it has one freedom there as elsewhere.
    assert!(!found.constraints.singular);
    assert_eq!(found.constraints.freedom, 1);
    assert!(found.to_string().contains("dead centre"));
    // With the crank held, the same state is not singular.
    let other = Study::new(bordered(SliderCrank))
        .start(Coordinate::new(2), 0.0)
        .guess(Coordinate::new(3), 0.5)
        .assembly()
        .expect("it closes");
    assert!(!other.singular && other.margin > 0.1);
    close(other.coordinates[6], l1 + l2, 1e-12);
}

#[test]
fn a_flat_parallelogram_is_singular() {
    let flat = [0.8, 0.0, 0.0, 0.0, 0.0, 0.0];
    let b = [3.0, 0.8, 0.5, 0.0];
    let found = assemble(&bordered(Parallelogram), &[0.0], &b, &flat, &[]).expect("it closes");
    assert!(found.constraints.singular && found.singular);
    assert!(found.to_string().contains("singular configuration"));
    let upright = [0.0, -0.8, 0.0, 0.0, 0.0, 0.0];
    let found = assemble(&bordered(Parallelogram), &[0.0], &b, &upright, &[]).expect("it closes");
    assert!(!found.singular);
    assert_eq!((found.constraints.freedom, found.constraints.redundant), (1, 1));
    // Hanging in line with the platform it is in equilibrium, but no linear model describes its swinging.
    let study = Study::new(bordered(Parallelogram))
        .input(eigentol::Input::new(0), std::f64::consts::FRAC_PI_2)
        .guess(Coordinate::new(0), 0.8);
    let state = study.equilibrium().expect("an equilibrium");
    assert!(state.constraints.singular);
    assert!(matches!(
        study.modes(),
        Err(Error::SingularConfiguration { constraints })
            if constraints == ["left", "middle", "right"].map(Text::from)
    ));
}

#[test]
fn lengths_that_do_not_reach() {
    let mut b = FOUR_BAR;
    b[5] = 2.0;
    for start in [[0.0; 7], [0.3, 0.1, 0.8, 0.2, 0.0, 0.0, 0.0]] {
        let Err(error) = assemble(&bordered(FourBar), &[0.0], &b, &start, &[]) else {
            panic!("1.7 m do not reach over 2 m");
        };
        let text = error.to_string();
        let Error::NotAssembled { gap, others, unit, .. } = error else {
            panic!("{text}");
        };
        assert_eq!((others.len(), unit), (2, "m"));
        let missing = gap.abs() + others.iter().map(|(_, gap)| gap.abs()).sum::<f64>();
        close(missing, 2.0 - 1.7, 1e-4);
        assert!(text.contains("lengths that do not reach"), "{text}");
    }
}

#[test]
fn too_many_held_coordinates() {
    let held = [Coordinate::new(0), Coordinate::new(1)];
    let start = [0.3, 0.3, 0.7, 0.5, 0.0, 0.0, 0.0];
    let Err(error) = assemble(&bordered(FourBar), &[0.0], &FOUR_BAR, &start, &held) else {
        panic!("0.424 m is no crank of 0.4 m");
    };
    let text = error.to_string();
    assert!(text.contains("hold fewer") && text.contains("`crank`"), "{text}");
    // Held at compatible values, they cause no conflict.
    let start = [0.0, 0.4, 0.7, 0.5, 0.0, 0.0, 0.0];
    assemble(&bordered(FourBar), &[0.0], &FOUR_BAR, &start, &held).expect("it closes");
}

#[test]
fn an_unfortunate_start_is_left() {
    // With all coordinates zero the bars have no length and no direction.
    let zero = assemble(&bordered(Truss), &[0.0], &[2.0, 1.3, 0.5], &[0.0; 4], &[]);
    close(zero.expect("it closes").coordinates[1].abs(), 1.2, 1e-12);
    let nan = assemble(&bordered(Truss), &[0.0], &[2.0, 1.3, 0.5], &[f64::NAN; 4], &[]);
    assert!(matches!(nan, Err(Error::NotFinite { .. })));
    // A bar without length has no direction.
    let folded = [-0.5, 0.0, 0.0, 0.0];
    let found = assemble(&bordered(Truss), &[0.0], &[2.0, 1.3, 0.5], &folded, &[]);
    close(found.expect("it closes").coordinates[1].abs(), 1.2, 1e-12);
}
