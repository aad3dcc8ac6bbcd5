//! Loops whose links carry no load: their reactions, and all forces in some of the equations, are rounding.

use eigentol::scalar::Instructions;
use eigentol::{Stability, Study};
use eigentol_interpreter::Interpreted;

use super::common::assert_close;

/// A slider-crank on a horizontal table, with this behind each of its names.
fn slider_crank(k: usize) -> String {
    format!(
        "body crank{k}: rod(mass: 1 kg, length: 0.1 m, along: x);
        body rod{k}: rod(mass: 1 kg, length: 0.3 m, along: x);
        body piston{k}: point(mass: 1 kg);
        joint a{k}: revolute(z) from ground to crank{k};
        joint b{k}: revolute(z) from crank{k} to rod{k} at [0.1 m, 0, 0];
        joint x{k}: prismatic(x) from ground to piston{k};
        joint wrist{k}: revolute(z) from rod{k} to piston{k} at [0.3 m, 0, 0], cut;"
    )
}

/// A moment turns the first crank against its spring and nothing else.
fn turned(others: &str) -> Study<Interpreted> {
    let text = format!(
        "mechanism Turned {{
            input moment: N*m;
            design stiffness = 5 N*m/rad +/- 3%;
            {}
            point shaft: crank1;
            force spring: spring(on: a1, stiffness: stiffness);
            force load: load(at: shaft, moment: [0, 0, moment]);
            {others}
        }}",
        slider_crank(1)
    );
    let study = Study::new(Interpreted::from_text(&text).expect("a declaration"));
    start(study, "a1", 0.8)
}

fn start(study: Study<Interpreted>, name: &str, value: f64) -> Study<Interpreted> {
    let coordinate = study.find_coordinate(name).expect("it is declared");
    study.start(coordinate, value)
}

fn idle(moment: f64) -> Study<Interpreted> {
    let study = turned("");
    let input = study.find_input("moment").expect("it is declared");
    study.input(input, moment)
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
        for (coordinate, right) in state.coordinates.iter().zip(right) {
            assert_close(*coordinate, right, 1e-12, &format!("{moment}"));
        }
        assert!(state.coordinates[3..].iter().all(|reaction| reaction.abs() < 1e-13));
        assert_eq!(state.stability, Stability::Stable);
    }
}

#[test]
fn every_sample_of_an_unloaded_slider_crank_rests() {
    let study = idle(1.0).samples(500);
    for vectors in [None, Some(Instructions::best())] {
        let sampled = study.clone().vectors(vectors).monte_carlo().expect("samples");
        assert_eq!(sampled.counts.stable, 500, "{vectors:?}");
    }
}

/// The forces of a loop that is a billion times stiffer are no measure for the other one.
#[test]
fn a_light_loop_is_solved_beside_a_heavy_one() {
    let light = "force soft: spring(on: a2, stiffness: 5e-9 N*m/rad, rest: 0.5);
        force push: spring(on: x2, stiffness: 3e-8 N/m, rest: 0.3 m);";
    let study = start(turned(&(slider_crank(2) + light)), "a2", 1.2);
    let moment = study.find_input("moment").expect("it is declared");
    let heavy = study.find_design("stiffness").expect("it is declared");
    let alone = |stiffness: f64| {
        let study = study.clone().input(moment, 0.2 * stiffness);
        let study = study.design(heavy, stiffness);
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
