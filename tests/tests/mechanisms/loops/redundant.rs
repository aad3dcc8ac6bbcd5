//! A beam on three parallel cranks, one more than it needs: it moves as long as all cranks are equally long and their
//! pivots as far apart as their pins.

use eigentol::{Error, Study};
use eigentol_interpreter::Interpreted;

use super::common::assert_close;

/// Cranks of these lengths, the third on a pivot at this distance from the first. The spring rests at this angle.
fn cranks([first, second, third]: [&str; 3], pivot: &str, rest: f64) -> Study<Interpreted> {
    let text = format!(
        "mechanism Cranks {{
            design l = 0.2 m +/- 1 mm;
            gravity 9.81 m/s^2 along -z;
            body beam: rod(mass: 6 kg, length: 2 m, along: x);
            body c1: rod(mass: 1 kg, length: {first}, along: z);
            body c2: rod(mass: 1 kg, length: {second}, along: z);
            body c3: rod(mass: 1 kg, length: {third}, along: z);
            joint t1: revolute(y) from ground to c1;
            joint t2: revolute(y) from ground to c2 at [1 m, 0, 0];
            joint t3: revolute(y) from ground to c3 at [{pivot}, 0, 0];
            joint p1: revolute(y) from c1 to beam at [0, 0, {first}];
            joint p2: revolute(y) from c2 to beam at [0, 0, {second}], at [1 m, 0, 0] on beam, cut;
            joint p3: revolute(y) from c3 to beam at [0, 0, {third}], at [2 m, 0, 0] on beam, cut;
            force spring: spring(on: t1, stiffness: 30 N*m/rad, rest: {rest:?});
        }}"
    );
    let study = Study::new(Interpreted::from_text(&text).expect("a declaration"));
    let t1 = study.find_coordinate("t1").expect("it is declared");
    study.start(t1, rest)
}

const RESTS: [f64; 7] = [-0.9, -0.3, 0.05, 0.2, 0.3, 0.6, 1.1];

#[test]
fn what_cannot_change_alone_has_no_derivative() {
    let fixed = "0.2 m";
    let cases = [
        (["l", fixed, fixed], "2 m"),
        ([fixed, "l", fixed], "2 m"),
        ([fixed, fixed, "l"], "2 m"),
        (["l", "l", fixed], "2 m"),
        ([fixed; 3], "10 * l"),
        (["l"; 3], "10 * l"),
    ];
    for ((lengths, pivot), rest) in cases.into_iter().flat_map(|case| RESTS.map(|rest| (case, rest))) {
        let study = cranks(lengths, pivot, rest);
        let errors = [
            study.sensitivities().expect_err("no derivatives"),
            study.equilibrium_shift().expect_err("no derivatives"),
            study.first_order().expect_err("no derivatives"),
        ];
        for error in errors {
            let Error::ClosesHereOnly { variable, .. } = error else { panic!("{lengths:?} {pivot} {rest}: {error}") };
            assert_eq!(variable, "l");
        }
    }
}

/// `k (t - rest) = 7.5 kg g l sin t`, the weight of the beam and of half the cranks.
#[test]
fn cranks_that_change_together_have_derivatives() {
    for rest in RESTS {
        let study = cranks(["l"; 3], "2 m", rest);
        let t = study.equilibrium().expect("an equilibrium").coordinates[0];
        let weight = 7.5 * 9.81;
        let right = weight * t.sin() / (30.0 - weight * 0.2 * t.cos());
        let shift = study.equilibrium_shift().expect("derivatives");
        for crank in 0..3 {
            assert_close(shift.by_design[crank][0], right, 1e-9, &format!("{rest}"));
        }
        study.sensitivities().expect("derivatives");
    }
}
