use eigentol::equilibrium::assemble;
use eigentol::error::NotClosed;
use eigentol::{Coordinate, DesignVariable, Error, Policy, Stability, Study};

use super::bordered::bordered;
use super::models::{Parallelogram, Twice};
use crate::common::{GRAVITY, close};

#[test]
fn a_rod_stated_twice() {
    let study = Study::new(bordered(Twice)).guess(Coordinate::new(0), 0.3);
    let state = study.equilibrium().expect("an equilibrium");
    assert!(state.coordinates[0].abs() < 1e-12);
    close(state.coordinates[1], -0.7, 1e-14);
    // Together they carry the weight, sharing it equally in terms of the resulting forces.
    let [.., rod, again] = state.coordinates[..] else { panic!("two reactions") };
    close(rod, 0.5 * 2.0 * GRAVITY, 1e-12);
    close(again, 0.5e-3 * 2.0 * GRAVITY, 1e-12);
    assert_eq!((state.constraints.freedom, state.constraints.redundant), (1, 1));
    assert_eq!(state.dependent_constraints().collect::<Vec<_>>(), ["rod", "again"]);
    assert!(!state.constraints.singular);
    assert_eq!(state.stability, Stability::Stable);
    let text = state.to_string();
    assert!(text.contains("1 of 2 constraints redundant (rod, again)"), "{text}");
}

#[test]
fn rods_that_contradict_each_other() {
    let study = Study::new(bordered(Twice)).guess(Coordinate::new(1), -0.7).design(DesignVariable::new(2), 0.701);
    let Err(Error::NotAssembled { reason, gap, .. }) = study.equilibrium() else {
        panic!("0.7 m is not 0.701 m");
    };
    assert_eq!(reason, NotClosed::Contradiction);
    // Rows are weighted by their size: both are violated by half a millimetre, the second one in units of millimetres.
    assert!((gap.abs() - 0.5e-3).abs() < 1e-6 || (gap.abs() - 0.5).abs() < 1e-3, "{gap}");
}

#[test]
fn a_platform_on_three_bars() {
    let (m, l) = (3.0, 0.8);
    for turn in [0.0, 0.4, -1.0_f64] {
        let study = Study::new(bordered(Parallelogram))
            .input(eigentol::Input::new(0), turn)
            .guess(Coordinate::new(0), 0.1)
            .guess(Coordinate::new(1), -0.7)
            .guess(Coordinate::new(2), 0.1);
        let mut nearest = study.clone().policy(Policy::Nearest);
        if turn == 0.0 {
            // Newton's method on the whole system leaves the constraint surface on its way.
            nearest = nearest.guess(Coordinate::new(0), 0.3);
        }
        let nearest = nearest.equilibrium().expect("an equilibrium");
        let state = study.equilibrium().expect("an equilibrium");
        for (a, b) in state.coordinates.iter().zip(&nearest.coordinates) {
            assert!((a - b).abs() < 1e-11 * (1.0 + b.abs()), "{a} {b}");
        }
        close(state.coordinates[0] + 1.0, l * turn.sin() + 1.0, 1e-13);
        close(state.coordinates[1], -l * turn.cos(), 1e-13);
        assert!(state.coordinates[2].abs() < 1e-13);
        assert_eq!((state.constraints.freedom, state.constraints.redundant), (1, 1));
        assert!(!state.constraints.singular);
        assert_eq!(state.stability, Stability::Stable);
        let forces = &state.coordinates[3..];
        close(forces.iter().sum(), m * GRAVITY, 1e-12);
        // The distribution among them is undetermined; the least solution has no moment.
        close(forces[0], forces[2], 1e-12);
        assert!(forces.iter().all(|&force| force > 1.0));
    }
}

#[test]
fn a_bar_that_does_not_fit() {
    let b = [3.0, 0.8, 0.5, 1e-3];
    let start = [0.0, -0.8, 0.0, 0.0, 0.0, 0.0];
    let error = assemble(&bordered(Parallelogram), &[0.0], &b, &start, &[]).expect_err("too long");
    let text = error.to_string();
    assert!(text.contains("contradict") && text.contains("`middle`"), "{text}");
    let Error::NotAssembled { gap, others, .. } = error else {
        panic!("{text}");
    };
    // The outer bars yield too: they differ from the middle one by a millimetre.
    assert_eq!(others.len(), 2);
    let gaps = others.iter().map(|(_, gap)| *gap).chain([gap]);
    let (least, most) = gaps.fold((0.0_f64, 0.0_f64), |(a, b), gap| (a.min(gap), b.max(gap)));
    close(most - least, 1e-3, 1e-6);
}

#[test]
fn a_branch_of_a_redundant_mechanism() {
    let study = Study::new(bordered(Parallelogram)).guess(Coordinate::new(0), 0.1).guess(Coordinate::new(1), -0.7);
    let branches = study.branches(eigentol::Input::new(0), 0.0, 1.0).expect("a branch");
    assert_eq!(branches.branches.len(), 1);
    let points = &branches.branches[0].points;
    assert!(points.len() > 5);
    for point in points {
        let state = &point.equilibrium;
        close(state.coordinates[1], -0.8 * point.value.cos(), 1e-10);
        close(state.coordinates[3..].iter().sum(), 3.0 * GRAVITY, 1e-10);
        assert_eq!(state.constraints.redundant, 1);
        assert_eq!(state.stability, Stability::Stable);
    }
}
