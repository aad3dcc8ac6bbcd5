//! A beam on three parallel cranks, one more than it needs: it moves as long as all cranks are equally long and their
//! pivots as far apart as their pins.

use eigentol::{Error, Study, mechanism};

use super::common::assert_close;

mechanism! {
    /// Each crank and one pivot by itself.
    mechanism Apart {
        design first = 0.2 m;
        design second = 0.2 m;
        design third = 0.2 m;
        design pivot = 2 m;
        design rest = 0.3;
        gravity 9.81 m/s^2 along -z;
        body beam: rod(mass: 6 kg, length: 2 m, along: x);
        body c1: rod(mass: 1 kg, length: first, along: z);
        body c2: rod(mass: 1 kg, length: second, along: z);
        body c3: rod(mass: 1 kg, length: third, along: z);
        joint t1: revolute(y) from ground to c1;
        joint t2: revolute(y) from ground to c2 at [1 m, 0, 0];
        joint t3: revolute(y) from ground to c3 at [pivot, 0, 0];
        joint p1: revolute(y) from c1 to beam at [0, 0, first];
        joint p2: revolute(y) from c2 to beam at [0, 0, second], at [1 m, 0, 0] on beam, cut;
        joint p3: revolute(y) from c3 to beam at [0, 0, third], at [2 m, 0, 0] on beam, cut;
        force spring: spring(on: t1, stiffness: 30 N*m/rad, rest: rest);
    }
}

mechanism! {
    /// All cranks together.
    mechanism Together {
        design length = 0.2 m;
        design rest = 0.3;
        gravity 9.81 m/s^2 along -z;
        body beam: rod(mass: 6 kg, length: 2 m, along: x);
        body c1: rod(mass: 1 kg, length: length, along: z);
        body c2: rod(mass: 1 kg, length: length, along: z);
        body c3: rod(mass: 1 kg, length: length, along: z);
        joint t1: revolute(y) from ground to c1;
        joint t2: revolute(y) from ground to c2 at [1 m, 0, 0];
        joint t3: revolute(y) from ground to c3 at [2 m, 0, 0];
        joint p1: revolute(y) from c1 to beam at [0, 0, length];
        joint p2: revolute(y) from c2 to beam at [0, 0, length], at [1 m, 0, 0] on beam, cut;
        joint p3: revolute(y) from c3 to beam at [0, 0, length], at [2 m, 0, 0] on beam, cut;
        force spring: spring(on: t1, stiffness: 30 N*m/rad, rest: rest);
    }
}

const RESTS: [f64; 7] = [-0.9, -0.3, 0.05, 0.2, 0.3, 0.6, 1.1];

#[test]
fn a_crank_that_cannot_change_alone_has_no_derivative() {
    for rest in RESTS {
        let study = Study::new(Apart)
            .design(Apart::rest, rest)
            .start(Apart::t1, rest);
        let errors = [
            study.sensitivities().expect_err("no derivatives"),
            study.equilibrium_shift().expect_err("no derivatives"),
            study.first_order().expect_err("no derivatives"),
        ];
        for error in errors {
            let Error::ClosesHereOnly { variable, .. } = error else {
                panic!("{rest}: {error}")
            };
            assert_eq!(variable, "first");
        }
    }
}

/// `k (t - rest) = 7.5 kg g l sin t`, the weight of the beam and of half the cranks.
#[test]
fn cranks_that_change_together_have_derivatives() {
    for rest in RESTS {
        let study = Study::new(Together)
            .design(Together::rest, rest)
            .start(Together::t1, rest);
        let t = study.equilibrium().expect("an equilibrium").coordinates[0];
        let weight = 7.5 * 9.81;
        let stiffness = 30.0 - weight * 0.2 * t.cos();
        let shift = study.equilibrium_shift().expect("derivatives");
        for crank in 0..3 {
            let by_length = shift.by_design[crank][0];
            assert_close(
                by_length,
                weight * t.sin() / stiffness,
                1e-9,
                &format!("{rest}"),
            );
        }
        study.sensitivities().expect("derivatives");
    }
}
