//! What a study keeps for the next question, and which settings make it forget.

use eigentol::modes::Family;
use eigentol::{Coordinate, DesignVariable, Error, Law, Policy, Study};

use super::{LENGTH, MASS, OMEGA, THETA};
use crate::common::pendulum::Pendulum;

type Setting = fn(Study<Pendulum>) -> Study<Pendulum>;

/// Settings with another answer, or the same for another reason.
const SETTINGS: [Setting; 16] = [
    |study| study.input(OMEGA, 4.5),
    |study| study.design(LENGTH, 1.1),
    |study| study.start(THETA, 0.0),
    |study| study.guess(THETA, -1.0),
    |study| study.hold(THETA, 0.1),
    |study| study.stay(),
    |study| study.start(THETA, 3.0).policy(Policy::Nearest),
    |study| study.family(Family::General),
    |study| study.tolerance(OMEGA, 0.1),
    |study| study.relative_tolerance(MASS, 0.02),
    |study| study.limits(LENGTH, 0.0, 0.02),
    |study| study.law(LENGTH, Law::Uniform),
    |study| study.sigma_level(2.0),
    |study| study.correlation([[1.0, 0.5], [0.5, 1.0]]),
    |study| study.start(Coordinate::new(7), 0.0),
    |study| study.tolerance(DesignVariable::<Pendulum>::new(7), 0.1),
];

fn fresh() -> Study<Pendulum> {
    Study::new(Pendulum).input(OMEGA, 5.0).start(THETA, 1.0).relative_tolerance(LENGTH, 0.03).samples(20).threads(1)
}

fn answers(study: &Study<Pendulum>) -> String {
    let point = (study.equilibrium(), study.modes(), study.tolerances());
    let spread = (study.first_order(), study.outputs(), study.monte_carlo());
    format!("{point:?} {spread:?}")
}

#[test]
fn settings_after_a_question_count_like_those_before() {
    let asked = fresh();
    let before = answers(&asked);
    for (k, setting) in SETTINGS.iter().enumerate() {
        let changed = setting(asked.clone());
        assert_eq!(changed, setting(fresh()), "setting {k}");
        assert_eq!(answers(&changed), answers(&setting(fresh())), "setting {k}");
    }
    assert_eq!(answers(&asked), before);
}

#[test]
fn the_order_of_questions_does_not_matter() {
    for family in [Family::Undamped, Family::General] {
        let one = fresh().family(family);
        let other = one.clone().family(family);
        let first = (one.equilibrium(), one.modes());
        let second = other.modes();
        assert_eq!(first, (other.equilibrium(), second));
    }
}

#[test]
fn a_mistake_after_a_question_is_found() {
    let study = fresh();
    study.modes().unwrap();
    let study = study.tolerance(DesignVariable::<Pendulum>::new(7), 0.1);
    let refused = study.modes();
    assert!(matches!(refused, Err(Error::UnknownHandle { index: 7, .. })));
}

#[test]
fn threads_can_share_a_study() {
    let study = fresh();
    let ask = || study.modes().unwrap();
    let (one, other) = std::thread::scope(|scope| {
        let (one, other) = (scope.spawn(ask), scope.spawn(ask));
        (one.join().unwrap(), other.join().unwrap())
    });
    assert_eq!(one, other);
}
