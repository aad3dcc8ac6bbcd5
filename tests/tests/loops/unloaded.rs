//! Loops whose links carry no load: their reactions, and all forces in some of the equations, are rounding.

use eigentol::scalar::Instructions;
use eigentol::{Stability, Study, mechanism};

use super::common::assert_close;

mechanism! {
    /// A slider-crank on a horizontal table. The moment turns the crank against its spring and nothing else.
    mechanism Idle {
        input moment: N*m;
        design stiffness = 5 N*m/rad +/- 3%;
        body crank: rod(mass: 1 kg, length: 0.1 m, along: x);
        body rod: rod(mass: 1 kg, length: 0.3 m, along: x);
        body piston: point(mass: 1 kg);
        joint a: revolute(z) from ground to crank;
        joint b: revolute(z) from crank to rod at [0.1 m, 0, 0];
        joint x: prismatic(x) from ground to piston;
        joint wrist: revolute(z) from rod to piston at [0.3 m, 0, 0], cut;
        point shaft: crank;
        force spring: spring(on: a, stiffness: stiffness);
        force load: load(at: shaft, moment: [0, 0, moment]);
    }
}

mechanism! {
    /// Two slider-cranks that have nothing to do with each other.
    mechanism Two {
        input moment: N*m;
        design stiffness = 5 N*m/rad;
        design light = 5e-9 N*m/rad;
        body crank: rod(mass: 1 kg, length: 0.1 m, along: x);
        body rod: rod(mass: 1 kg, length: 0.3 m, along: x);
        body piston: point(mass: 1 kg);
        body small_crank: rod(mass: 1 kg, length: 0.1 m, along: x);
        body small_rod: rod(mass: 1 kg, length: 0.3 m, along: x);
        body small_piston: point(mass: 1 kg);
        joint a: revolute(z) from ground to crank;
        joint b: revolute(z) from crank to rod at [0.1 m, 0, 0];
        joint x: prismatic(x) from ground to piston;
        joint wrist: revolute(z) from rod to piston at [0.3 m, 0, 0], cut;
        joint c: revolute(z) from ground to small_crank;
        joint d: revolute(z) from small_crank to small_rod at [0.1 m, 0, 0];
        joint y: prismatic(x) from ground to small_piston;
        joint pin: revolute(z) from small_rod to small_piston at [0.3 m, 0, 0], cut;
        point shaft: crank;
        force spring: spring(on: a, stiffness: stiffness);
        force load: load(at: shaft, moment: [0, 0, moment]);
        force soft: spring(on: c, stiffness: light, rest: 0.5);
        force push: spring(on: y, stiffness: 3e-8 N/m, rest: 0.3 m);
    }
}

fn idle(moment: f64) -> Study<Idle> {
    Study::new(Idle)
        .input(Idle::moment, moment)
        .start(Idle::a, 0.8)
}

/// `a = M / k`, the rest by the geometry of a triangle.
#[test]
fn an_unloaded_slider_crank_rests_where_its_spring_does() {
    for step in 0..=50 {
        let moment = 1.0 + 0.1 * f64::from(step);
        let state = idle(moment).equilibrium();
        let state = state.unwrap_or_else(|error| panic!("{moment}: {error}"));
        let a = moment / 5.0;
        let lean = (0.1 * a.sin() / 0.3).asin();
        let place = 0.1 * a.cos() + 0.3 * lean.cos();
        let right = [a, -a - lean, place];
        for (found, right) in state.coordinates.iter().zip(right) {
            assert_close(*found, right, 1e-12, &format!("{moment}"));
        }
        assert!(
            state.coordinates[3..]
                .iter()
                .all(|reaction| reaction.abs() < 1e-13)
        );
        assert_eq!(state.stability, Stability::Stable);
    }
}

#[test]
fn every_sample_of_an_unloaded_slider_crank_rests() {
    let study = idle(1.0).samples(500);
    for vectors in [None, Some(Instructions::best())] {
        let sampled = study
            .clone()
            .vectors(vectors)
            .monte_carlo()
            .expect("samples");
        assert_eq!(sampled.counts.stable, 500, "{vectors:?}");
    }
}

/// The forces of a loop that is a billion times stiffer are no measure for the other one.
#[test]
fn a_light_loop_is_solved_beside_a_heavy_one() {
    let alone = |stiffness: f64| {
        let study = Study::new(Two)
            .input(Two::moment, 0.2 * stiffness)
            .design(Two::stiffness, stiffness)
            .start(Two::a, 0.8)
            .start(Two::c, 1.2);
        study.equilibrium().expect("an equilibrium").coordinates
    };
    let like = alone(5e-9);
    let beside = alone(5.0);
    let far = alone(5e3);
    for (j, right) in like.iter().enumerate().take(6) {
        assert_close(beside[j], *right, 1e-9, &format!("coordinate {j}"));
        assert_close(far[j], *right, 1e-9, &format!("coordinate {j}"));
    }
}
