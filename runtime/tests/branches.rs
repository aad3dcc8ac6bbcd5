//! Branches of equilibria: followed through folds and into each other, located to rounding, each once.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::GRAVITY;
use common::chain::DOUBLE;
use common::derived::Derived;
use common::pendulum::{Pendulum, W};
use eigentol::equilibrium::{Branch, BranchEnd, Branches, Continuation, SpecialKind, branches};
use eigentol::{Input, Stability};

const INPUT: Input = Input(0);
const BAR: [f64; 2] = [3.0, 1.0];
const BARS: [f64; 4] = [1.0, 1.0, 3.0, 3.0];
const SOFT: SpecialKind = SpecialKind::Pitchfork {
    supercritical: Some(true),
};

fn range(low: f64, high: f64) -> Continuation {
    Continuation::new(INPUT, low, high)
}

#[test]
fn the_pendulum_bends_to_both_sides() {
    let found = branches(&Pendulum, &[0.0], &BAR, &[0.3], &range(0.0, 6.0), None).unwrap();
    println!("{found}");
    assert_eq!(found.branches.len(), 3);
    assert_eq!(found.special().len(), 1);
}

#[test]
fn explore() {
    let found = branches(&DOUBLE, &[0.0], &BARS, &[0.3; 2], &range(0.0, 8.0), None).unwrap();
    println!("{found}");
    for machine in 0..1 {
        use common::branching::*;
        println!(
            "{}",
            branches(
                &Derived(Snap),
                &[0.0],
                &[1.0],
                &[1.0],
                &range(-1.0, 1.0),
                None
            )
            .unwrap()
        );
        println!(
            "{}",
            branches(
                &Derived(Exchange),
                &[0.0],
                &[0.0, 0.0, 1.0],
                &[0.0],
                &range(-1.0, 1.0),
                None
            )
            .unwrap()
        );
        println!(
            "{}",
            branches(
                &Derived(Imperfect),
                &[0.0],
                &[1e-2, 0.0],
                &[0.0],
                &range(-1.0, 1.0),
                None
            )
            .unwrap()
        );
        println!(
            "{}",
            branches(
                &Derived(Imperfect),
                &[0.0],
                &[1e-7, 0.0],
                &[0.0],
                &range(-1.0, 1.0),
                None
            )
            .unwrap()
        );
        println!(
            "{}",
            branches(
                &Derived(Imperfect),
                &[0.0],
                &[1e-14, 0.0],
                &[0.0],
                &range(-1.0, 1.0),
                None
            )
            .unwrap()
        );
        println!(
            "{}",
            branches(
                &Derived(Quintic),
                &[0.0],
                &[1.0],
                &[0.0],
                &range(0.0, 2.0),
                None
            )
            .unwrap()
        );
        println!(
            "{}",
            branches(
                &Derived(Rotor),
                &[0.0],
                &[],
                &[0.0; 2],
                &range(0.0, 2.0),
                None
            )
            .unwrap()
        );
        println!(
            "{}",
            branches(
                &Derived(NearlyTwo),
                &[0.0],
                &[1e-4],
                &[0.0; 2],
                &range(0.0, 2.0),
                None
            )
            .unwrap()
        );
        println!(
            "{}",
            branches(
                &Derived(NearlyTwo),
                &[0.0],
                &[0.0],
                &[0.0; 2],
                &range(0.0, 2.0),
                None
            )
            .unwrap()
        );
        println!(
            "{}",
            branches(
                &Derived(Lopsided),
                &[0.0],
                &[1.0],
                &[0.0; 2],
                &range(0.0, 2.0),
                None
            )
            .unwrap()
        );
        println!(
            "{}",
            branches(
                &Derived(Edge),
                &[0.0],
                &[],
                &[0.0; 1],
                &range(0.0, 2.0),
                None
            )
            .unwrap()
        );
        println!(
            "{}",
            branches(
                &Derived(Away),
                &[0.0],
                &[],
                &[0.0; 1],
                &range(0.0, 2.0),
                None
            )
            .unwrap()
        );
        println!(
            "{}",
            branches(&Derived(Nothing), &[0.0], &[], &[], &range(0.0, 2.0), None).unwrap()
        );
    }
}
