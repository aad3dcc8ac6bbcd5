//! Ziegler's column: flutter under a follower load, with and without damping.

use eigentol::{Behaviour, Error, Stability, Study, error::NoDerivative};
use eigentol_tests::machines::ZieglerColumn;

use super::common::{close, design, event};

type Column = Study<ZieglerColumn>;

fn column(damping: f64) -> Column {
    Study::new(ZieglerColumn).design(ZieglerColumn::damping, damping)
}

#[test]
fn stability_under_a_follower_load() {
    let study = column(0.0);
    let [_, l, k, _] = design(&study);
    let at = |p: f64| {
        let study = study.clone().input(ZieglerColumn::load, p * k / l);
        study.equilibrium().expect("straight").stability
    };
    let boundary = 3.5 - 2f64.sqrt();
    assert_eq!(at(0.5), Stability::Marginal);
    assert_eq!(at(boundary - 1e-6), Stability::Marginal);
    assert_eq!(at(boundary + 1e-6), Stability::Flutter { growing: 1 });
    assert_eq!(at(5.5), Stability::Divergent { negative: 2 });
    let damped = column(1e-3).input(ZieglerColumn::load, k / l);
    let stability = damped.equilibrium().expect("straight").stability;
    assert_eq!(stability, Stability::Stable);
}

/// Without damping two frequencies merge: the onset is found, but it has no derivative.
#[test]
fn frequencies_that_merge_have_an_onset_without_derivative() {
    let study = column(0.0);
    let [_, l, k, _] = design(&study);
    let boundary = (3.5 - 2f64.sqrt()) * k / l;
    // However the values of the range lie beside the onset, and from either side.
    for (low, high) in [(0.0, 1.3), (0.0, 1.44), (0.9, 1.01), (1.3, 0.2), (0.999, 1.2), (1.7, 0.0)] {
        let found =
            study.flutter_onset_tolerances(ZieglerColumn::load, low * boundary, high * boundary).expect("a search");
        let [only] = &found[..] else { panic!("{low} to {high}: {found:?}") };
        assert!((only.value - boundary).abs() < 1e-9 * boundary);
        let merge = Error::NoSensitivity { reason: NoDerivative::Merge };
        assert_eq!(only.spread, Err(merge));
    }
}

/// Small damping lowers the flutter load to `p = 41/28 + c^2 / (2 m l^2 k)` (Ziegler 1952).
#[test]
fn damping_destabilises() {
    let study = column(0.05);
    let [m, l, k, c] = design(&study);
    let p = 41.0 / 28.0 + c * c / (2.0 * m * l * l * k);
    let load = p * k / l;
    // P = 41 k / (28 l) + c^2 / (2 m l^3).
    let part = c * c / (2.0 * m * l.powi(3));
    let slopes = [-part / m, -(41.0 * k / (28.0 * l) + 3.0 * part) / l, 41.0 / (28.0 * l), 2.0 * part / c];
    let found = study.flutter_onset_tolerances(ZieglerColumn::load, 0.0, 1.3 * load).expect("a search");
    let [only] = &found[..] else { panic!("{found:?}") };
    let tolerances = study.tolerances().expect("declared");
    event(only, load, &slopes, study.design_values(), tolerances.half_widths());
    let there = study.input(ZieglerColumn::load, load + 0.5);
    let found = there.modes().expect("modes");
    let growing = found.modes.iter().find(|mode| mode.behaviour.grows());
    let growing = growing.expect("flutter");
    assert!(matches!(growing.behaviour, Behaviour::Flutter(_)));
    close(growing.damping_ratio().expect("one"), -growing.s.re / growing.s.norm());
    assert!(growing.damping_ratio().expect("one") < 0.0);
}
