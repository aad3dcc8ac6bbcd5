//! Sweeps of an input, and the events located along them.

use crate::common::branching::{Away, Exchange, LopsidedSnap, Quintic, Rotor, Snap};
use crate::common::chain::DOUBLE;
use crate::common::close;
use crate::common::derived::Derived;
use crate::common::models::{Overdamped, Plate, Spring};
use crate::common::pendulum::{Pendulum, W};
use eigentol::branches::SpecialKind;
use eigentol::sweep::{Line, Range, critical_state, crossings, sweep};
use eigentol::{Error, Input, Policy};

const BAR: [f64; 2] = [3.0, 1.0];
const BARS: [f64; 4] = [1.0, 1.0, 3.0, 3.0];

#[test]
fn sweep_goes_on_past_failures_and_along_the_stable_branch() {
    let values = [2.0, 3.0, f64::NAN, 3.8, 3.9, 5.0];
    let points = sweep(&Pendulum, &[0.0], &BAR, &[1.047], Policy::Stable, Input::new(0), &values).unwrap().points;
    assert_eq!(points.len(), values.len());
    assert!(matches!(points[2].equilibrium, Err(Error::NotFinite { .. })));
    let last = points[5].modes.as_ref().unwrap().modes[0].frequency().unwrap();
    close(last, 4.042_122_091_179_335, 1e-13);
    let foreign = sweep(&Pendulum, &[0.0], &BAR, &[0.0], Policy::Stable, Input::new(3), &values);
    assert!(matches!(foreign, Err(Error::UnknownHandle { index: 3, .. })));
}

#[test]
fn critical_speeds_and_crossings_match_closed_forms() {
    let range = Range::new(Input::new(0), 0.1, 5.0).steps(60);
    let single = critical_state(&Pendulum, &[0.0], &BAR, &[1.047], range).unwrap();
    close(single.value, 3.836_013_555_763_326_5, 1e-12);
    let double = critical_state(&DOUBLE, &[0.0], &BARS, &[1.047, 1.047], range).unwrap();
    close(double.value, 2.680_114_012_253_375_3, 1e-12);
    let below = Range::new(Input::new(0), 0.1, 3.0).steps(60);
    let none = critical_state(&Pendulum, &[0.0], &BAR, &[1.0], below);
    assert!(matches!(none, Err(Error::NotInRange { input, .. }) if input == "omega"));

    let met = crossings(&Pendulum, &[0.0], &BAR, &[1.0], Policy::Stable, range, 1.0).unwrap();
    assert_eq!(met.len(), 1);
    close(met[0].value, 2.712_471_198_003_769, 1e-13);
    let met = crossings(&DOUBLE, &[0.0], &BARS, &[1.0, 1.0], Policy::Stable, range, 1.0).unwrap();
    assert_eq!(met[0].mode, 0);
    assert!((met[0].value - 1.8951).abs() < 5e-5);
}

#[test]
fn a_limit_point_is_found_where_the_branch_ends() {
    // k q - q^3 = 1 loses its lower solution where k = 3 q^2 and 2 q^3 = 1.
    let range = Range::new(Input::new(0), 4.0, 1.0).steps(20);
    let design = [1.0, -1.0, 1.0];
    let fold = critical_state(&Derived(Spring), &[0.0], &design, &[0.25], range).unwrap();
    close(fold.value, 3.0 * 0.5f64.powf(2.0 / 3.0), 1e-13);
    assert_eq!(fold.kind, SpecialKind::Fold);
    close(fold.equilibrium.coordinates[0], 0.5f64.cbrt(), 1e-12);
}

fn through(low: f64, high: f64, steps: usize) -> Range {
    Range::new(Input::new(0), low, high).steps(steps)
}

#[test]
fn critical_states_from_every_side() {
    // From the bent branch down to the pitchfork, with any number of steps, both inside the range and at its very end.
    for steps in [1, 7, 200] {
        for low in [6.0, 4.0, W.sqrt() * (1.0 + 1e-7)] {
            let bent = critical_state(&Pendulum, &[0.0], &BAR, &[1.0], through(low, 0.0, steps));
            let bent = bent.unwrap();
            close(bent.value, W.sqrt(), 1e-13);
            let soft = SpecialKind::Pitchfork { supercritical: Some(true) };
            assert_eq!(bent.kind, soft);
        }
    }
    let twice = critical_state(&DOUBLE, &[0.0], &BARS, &[1.0, 1.0], through(5.0, 0.0, 30));
    close(twice.unwrap().value, 2.680_114_012_253_375_3, 1e-12);

    let snap = critical_state(&Derived(Snap), &[0.0], &[1.0], &[2.0], through(-1.0, 1.0, 10));
    let snap = snap.unwrap();
    close(snap.value, 2.0 / 27f64.sqrt(), 1e-14);
    assert_eq!(snap.kind, SpecialKind::Fold);
    let snap = critical_state(&Derived(LopsidedSnap), &[0.0], &[0.2], &[2.0, 1.0], through(-1.0, 1.0, 10));
    close(snap.unwrap().value, 2.0 * 0.3f64.powf(1.5), 1e-13);

    let exchange = critical_state(&Derived(Exchange), &[0.0], &[0.1, -0.2, 0.7], &[0.1], through(-1.0, 1.0, 10));
    let exchange = exchange.unwrap();
    close(exchange.value, 0.1 + 0.3 / 0.7, 1e-13);
    assert_eq!(exchange.kind, SpecialKind::Transcritical);

    let hard = critical_state(&Derived(Quintic), &[0.0], &[1.0], &[0.0], through(0.0, 2.0, 9));
    close(hard.unwrap().value, 1.0, 1e-13);

    let both = critical_state(&Derived(Rotor), &[0.0], &[], &[0.0; 2], through(0.0, 1.7, 9));
    let both = both.unwrap();
    close(both.value, 1.0, 1e-12);
    assert_eq!(both.kind, SpecialKind::Degenerate);
}

#[test]
fn a_branch_that_runs_to_infinity_is_not_critical() {
    for (low, high) in [(0.0, 2.0), (-3.0, 1.1)] {
        let away = critical_state(&Derived(Away), &[0.0], &[], &[0.0], through(low, high, 20));
        assert!(matches!(away, Err(Error::NotInRange { .. })), "{away:?}");
    }
    let design = [0.5, 40.0, 60.0, 0.0];
    let thrown = critical_state(&Derived(Plate), &[0.0], &design, &[0.1, 0.0], through(0.0, 20.0, 50));
    assert!(matches!(thrown, Err(Error::NotInRange { .. })), "{thrown:?}");
}

/// Along the upper branch `omega^2 = 3 q^2 - 1` decreases from 2 to 0 at the fold; on the branch that follows it
/// exceeds 3.
#[test]
fn a_frequency_that_jumps_across_a_line_does_not_meet_it() {
    let range = Range::new(Input::new(0), 0.0, 0.6).steps(7);
    let line = Line { ratio: 0.0, offset: 0.9 };
    let snap = Derived(Snap);
    let met = crossings(&snap, &[0.0], &[1.0], &[1.0], Policy::Stable, range, line).unwrap();
    assert_eq!(met.len(), 1);
    let q = (1.81_f64 / 3.0).sqrt();
    close(met[0].value, q - q.powi(3), 1e-12);
}

#[test]
fn a_mode_that_has_ended_does_not_lend_its_label_to_another() {
    let values: Vec<f64> = (0..=40).map(|i| 0.1 * f64::from(i)).collect();
    let points =
        sweep(&Derived(Overdamped), &[0.0], &[], &[0.0; 2], Policy::Stable, Input::new(0), &values).unwrap().points;
    let mut seen = [false; 2];
    let mut owners = [None; 8];
    for mode in points.iter().flat_map(|point| point.modes.as_ref().unwrap().modes.iter()) {
        let moves_y = usize::from(mode.shape[1].norm() > mode.shape[0].norm());
        seen[moves_y] |= mode.frequency().is_none();
        assert_eq!(*owners[mode.label].get_or_insert(moves_y), moves_y);
    }
    assert!(seen[0] && seen[1], "both are overdamped somewhere");
}
