//! Which samples left the nominal branch, where closed forms tell.

use eigentol::tolerance::Outcome;
use eigentol::{Coordinate, DesignVariable, Input, Study, mechanism};

use crate::common::derived::Derived;
use crate::common::models::Spring;

const FORCE: DesignVariable<Derived<Spring>> = DesignVariable::new(2);

/// `-3 q + q^3 = force` has valleys near `q = 1.7` and `q = -1.7`; the upper one ends where the force is below -2.
#[test]
fn a_valley_that_ends_is_left() {
    for (nominal, sigma) in [(-1.2, 0.4), (0.0, 0.8), (-1.9, 0.05), (3.0, 1.0)] {
        let study = Study::new(Derived(Spring))
            .input(Input::new(0), -3.0)
            .design(DesignVariable::new(1), 1.0)
            .design(FORCE, nominal)
            .start(Coordinate::new(0), 1.7)
            .sigma_level(1.0)
            .tolerance(FORCE, sigma)
            .samples(2000)
            .keep_samples(true);
        let run = study.monte_carlo().unwrap();
        let all = run.all.as_ref().unwrap();
        assert!(all.iter().all(|own| own.outcome == Outcome::Stable));
        let fell = all.iter().filter(|x| x.design[2] < -2.0).count();
        assert_eq!(run.left_nominal_branch, fell, "{nominal}");
        let down = |sample: &&eigentol::tolerance::Sample| sample.coordinates.as_ref().unwrap()[0] < 0.0;
        assert_eq!(all.iter().filter(down).count(), fell);
    }
}

mechanism! {
    /// A bar that is held upright by a spring, off its vertical: beyond the limit it leans to one side, and that side
    /// is the same for all.
    mechanism Leaning {
        design k = 20.0 N*m/rad;
        design aside = 0.02 rad;
        design c = 1.0 N*m*s/rad;
        gravity 9.81 m/s^2 along -z;
        body bar: rod(mass: 3 kg, length: 1 m, along: z);
        joint theta: revolute(y) from ground to bar;
        force hold: spring(on: theta, stiffness: k, rest: aside);
        force damp: damper(on: theta, damping: c);
    }
}

/// An imperfect pitchfork has one branch, along which all samples stay.
#[test]
fn an_imperfect_pitchfork_keeps_its_branch() {
    let study = Study::new(Leaning).start(Leaning::theta, 0.1).tolerance(Leaning::k, 9.0).samples(1000);
    let run = study.monte_carlo().unwrap();
    assert_eq!((run.counts.stable, run.left_nominal_branch), (1000, 0), "{run}");
}

/// An unstable state that the start names is kept by its samples: all of them are unstable, and none left it.
#[test]
fn samples_about_an_unstable_state_stay_with_it() {
    let study = Study::new(Derived(Spring))
        .input(Input::new(0), -3.0)
        .design(DesignVariable::new(1), 1.0)
        .design(FORCE, 0.0)
        .start(Coordinate::new(0), 0.0)
        .policy(eigentol::Policy::Nearest)
        .sigma_level(1.0)
        .tolerance(FORCE, 0.1)
        .samples(300);
    let run = study.monte_carlo().unwrap();
    assert_eq!(run.counts.divergent, 300, "{run}");
    assert_eq!(run.left_nominal_branch, 0);
}
