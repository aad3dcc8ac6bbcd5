//! Equilibria: closed forms, unstable starts, distant starts, invalid input, events along an input.

use crate::common::chain::DOUBLE;
use crate::common::close;
use crate::common::derived::Derived;
use crate::common::models::{Follower, Plate, Slipping, Spring, Supercritical};
use crate::common::pendulum::{Pendulum, W};
use eigentol::equilibrium::{Search, equilibrium, find_equilibria};
use eigentol::modes::modes;
use eigentol::{Behaviour, Error, Policy, Stability, Watch};

const BAR: [f64; 2] = [3.0, 1.0];
const BARS: [f64; 4] = [1.0, 1.0, 3.0, 3.0];

fn angle(omega: f64) -> f64 {
    (W / (omega * omega)).acos()
}

#[test]
fn pendulum_follows_its_closed_form() {
    for omega in [0.0, 0.1, 1.0, 3.0, 3.8, 3.83, 3.84, 3.9, 4.0, 6.5, 20.0] {
        let state = equilibrium(&Pendulum, &[omega], &BAR, &[1.047], Policy::Stable).unwrap();
        assert_eq!(state.stability, Stability::Stable);
        let expected = if omega * omega > W { angle(omega) } else { 0.0 };
        assert!((state.coordinates[0] - expected).abs() < 1e-12, "{omega}: {state}");
        assert!(state.relative_residual < 1e-12);
        assert!(state.iterations < 20, "{omega}: {state}");
    }
}

#[test]
fn unstable_start_is_left_by_default_and_kept_on_request() {
    let stable = equilibrium(&Pendulum, &[5.0], &BAR, &[0.0], Policy::Stable).unwrap();
    assert!((stable.coordinates[0] - angle(5.0)).abs() < 1e-13);
    assert!(stable.left_unstable_region);
    let negative = equilibrium(&Pendulum, &[5.0], &BAR, &[-1e-7], Policy::Stable).unwrap();
    assert!((negative.coordinates[0] + angle(5.0)).abs() < 1e-13);
    let kept = equilibrium(&Pendulum, &[5.0], &BAR, &[0.0], Policy::Nearest).unwrap();
    assert_eq!(kept.coordinates, [0.0]);
    assert_eq!(kept.stability, Stability::Divergent { negative: 1 });
    // Upside down, standing still.
    let up = [std::f64::consts::PI];
    let upright = equilibrium(&Pendulum, &[0.0], &BAR, &up, Policy::Nearest).unwrap();
    assert_eq!(upright.stability, Stability::Divergent { negative: 1 });
    let fallen = equilibrium(&Pendulum, &[0.0], &BAR, &up, Policy::Stable).unwrap();
    assert_eq!(fallen.stability, Stability::Stable);
}

#[test]
fn stable_states_everywhere_near_the_critical_speed() {
    for k in -12..=12_i32 {
        let offset = f64::from(k.signum()) * 10f64.powi(-k.abs());
        let omega = W.sqrt() * (1.0 + offset);
        let state = equilibrium(&Pendulum, &[omega], &BAR, &[0.3], Policy::Stable).unwrap();
        assert!(state.stability.holds(), "{offset}: {state}");
        let expected = if omega * omega > W { angle(omega) } else { 0.0 };
        assert!((state.coordinates[0] - expected).abs() < 2e-5, "{offset}: {state} {expected}");
    }
}

#[test]
fn far_starts_end_in_stable_states() {
    for start in [1e6, -1e6, 12345.678, 3.2, 1e9] {
        for omega in [1.0, 5.0] {
            let state = equilibrium(&Pendulum, &[omega], &BAR, &[start], Policy::Stable).unwrap();
            assert_eq!(state.stability, Stability::Stable, "{start} {omega}");
        }
    }
    for start in [[1e6, -1e6], [3.0, 3.0], [std::f64::consts::PI, 0.0], [-2.0, 2.0]] {
        let state = equilibrium(&DOUBLE, &[3.0], &BARS, &start, Policy::Stable).unwrap();
        assert_eq!(state.stability, Stability::Stable, "{start:?}");
    }
    // A cubic spring from far away: Newton's method contracts only by a factor 2/3.
    let far = equilibrium(&Derived(Spring), &[1.0], &[1.0, 1.0, 2.0], &[1e8], Policy::Stable).unwrap();
    close(far.coordinates[0], 1.0, 1e-14);
}

#[test]
fn double_pendulum_matches_reference() {
    // From 50-digit arithmetic (mpmath), absolute angles, stable branch with positive angles.
    for (omega, expected) in [
        (0.1, [0.0, 0.0]),
        (2.5, [0.0, 0.0]),
        (3.0, [0.577_232_063_771_418_8, 0.739_976_266_906_358_4]),
        (4.0, [1.055_011_451_297_718_3, 1.179_519_008_782_915_3]),
        (5.0, [1.246_207_417_187_873_3, 1.329_589_816_547_526_7]),
    ] {
        for start in [[1.047, 1.047], [0.0, 0.0]] {
            let state = equilibrium(&DOUBLE, &[omega], &BARS, &start, Policy::Stable).unwrap();
            assert_eq!(state.stability, Stability::Stable);
            for (actual, expected) in state.coordinates.iter().zip(expected) {
                assert!((actual - expected).abs() < 1e-12, "{omega} {start:?}: {state}");
            }
        }
    }
}

#[test]
fn every_branch_is_found() {
    let search = Search::new([-3.2], [3.2]).starts(40).seed(1);
    let found = find_equilibria(&Pendulum, &[5.0], &BAR, &[0.3], &search, Watch::default()).unwrap();
    let mut angles: Vec<_> = found.iter().map(|state| state.coordinates[0]).collect();
    angles.sort_by(f64::total_cmp);
    assert_eq!(found.iter().filter(|state| state.stability == Stability::Stable).count(), 2);
    assert_eq!(found.len(), 4, "{angles:?}");
    let again = find_equilibria(&Pendulum, &[5.0], &BAR, &[0.3], &search, Watch::default()).unwrap();
    assert_eq!(found, again);
}

#[test]
fn linear_divergence_is_a_result() {
    // Far above both critical speeds the plate's stiffness is negative in both directions; gyroscopic forces may hold
    // it.
    let design = [0.5, 40.0, 60.0, 0.0];
    let state = equilibrium(&Derived(Plate), &[20.0], &design, &[0.1, 0.0], Policy::Stable).unwrap();
    close(state.coordinates[0], 4.0 / (40.0 - 200.0), 1e-14);
    // In the stationary frame it is a mass on rotating springs: stable again above both critical speeds.
    let held = Stability::GyroscopicallyStabilised { negative: 2 };
    assert_eq!(state.stability, held);
    let one = equilibrium(&Derived(Plate), &[10.0], &design, &[0.1, 0.0], Policy::Stable).unwrap();
    assert_eq!(one.stability, Stability::Divergent { negative: 1 });
    let damped = [0.5, 40.0, 60.0, 0.3];
    let low = equilibrium(&Derived(Plate), &[4.0], &damped, &[0.0, 0.0], Policy::Stable).unwrap();
    close(low.coordinates[0], 0.125, 1e-14);
    assert_eq!(low.stability, Stability::Stable);
    let fed = equilibrium(&Derived(Plate), &[4.0], &[0.5, 40.0, 60.0, -0.3], &[0.0; 2], Policy::Stable);
    assert_eq!(fed.unwrap().stability, Stability::Flutter { growing: 2 });
}

#[test]
fn no_stiffness_and_no_equilibrium() {
    let spring = Derived(Spring);
    let pushed = equilibrium(&spring, &[0.0], &[1.0, 0.0, 1.0], &[0.0], Policy::Stable);
    assert!(matches!(pushed, Err(Error::NoEquilibrium { .. })), "{pushed:?}");
    let free = equilibrium(&spring, &[0.0], &[1.0, 0.0, 0.0], &[7.0], Policy::Stable).unwrap();
    assert_eq!(free.stability, Stability::Neutral { zero: 1 });
    assert_eq!(free.coordinates, [7.0]);
    let divergent = equilibrium(&spring, &[-2.0], &[1.0, 0.0, 1.0], &[0.0], Policy::Stable).unwrap();
    close(divergent.coordinates[0], -0.5, 1e-14);
    assert_eq!(divergent.stability, Stability::Divergent { negative: 1 });
}

/// Ziegler's column: `2 lambda^2 + (2 p - 7) lambda + 1 = 0`, so it flutters from `p = (7 - sqrt 8) / 2` and diverges
/// beyond `(7 + sqrt 8) / 2`.
#[test]
fn a_follower_load_leads_to_flutter_then_to_divergence() {
    let at = |load: f64| {
        let start = [0.02, 0.03];
        equilibrium(&Derived(Follower), &[load], &[1.0], &start, Policy::Stable).unwrap()
    };
    let stability = |load: f64| at(load).stability;
    assert_eq!(stability(1.0), Stability::Marginal);
    assert_eq!(stability(2.08), Stability::Marginal);
    assert_eq!(stability(2.09), Stability::Flutter { growing: 1 });
    assert_eq!(stability(6.0), Stability::Divergent { negative: 2 });
    assert!(at(1.0).coordinates.iter().all(|q| q.abs() < 1e-12));
    let root = |load: f64, sign: f64| {
        let p: f64 = 7.0 - 2.0 * load;
        (0.25 * (p + sign * (p * p - 8.0).sqrt())).sqrt()
    };
    let found = eigentol::modes::modes(&at(1.0)).unwrap();
    for (mode, sign) in found.modes.iter().zip([-1.0, 1.0]) {
        close(mode.frequency().unwrap(), root(1.0, sign), 1e-14);
        assert!(matches!(mode.behaviour, Behaviour::Oscillating(_)));
    }
    assert!(matches!(eigentol::modes::undamped_modes(&at(1.0)), Err(Error::NonsymmetricStiffness { .. })));
}

#[test]
fn wrong_values_are_named() {
    let solve = |u: f64, b: [f64; 2], q: f64| equilibrium(&Pendulum, &[u], &b, &[q], Policy::Stable);
    for bad in [f64::NAN, f64::INFINITY] {
        for (result, place) in [
            (solve(bad, BAR, 0.0), "omega"),
            (solve(1.0, [bad, 1.0], 0.0), "m"),
            (solve(1.0, [3.0, bad], 0.0), "l"),
            (solve(1.0, BAR, bad), "theta"),
        ] {
            let Err(Error::NotFinite { name, .. }) = result else { panic!("{result:?}") };
            assert_eq!(name, place);
        }
    }
    for (design, what) in [([-3.0, 1.0], "mass of bar"), ([3.0, 0.0], "length of bar")] {
        let result = solve(1.0, design, 0.0);
        let Err(Error::Unphysical { quantity, .. }) = result else { panic!("{result:?}") };
        assert_eq!(quantity, what);
    }
    let massless = equilibrium(&Derived(Spring), &[1.0], &[0.0, 0.0, 1.0], &[0.0], Policy::Stable);
    let coordinate = "x".into();
    assert_eq!(massless, Err(Error::SingularMass { coordinate }));
    let overflow = equilibrium(&Pendulum, &[1e200], &BAR, &[1.0], Policy::Stable);
    assert!(matches!(overflow, Err(Error::OutsideDomain { .. })), "{overflow:?}");
}

/// One negative direction beside a free one: no theorem makes that unstable, and it is not.
#[test]
fn a_free_direction_can_hold_one_without_stiffness() {
    let b = [1.0, 10.0, 0.2];
    for start in [2.0 / 15.0, 0.14] {
        let found = equilibrium(&Derived(Slipping), &[5.0], &b, &[start, 0.3], Policy::Stable);
        let state = found.unwrap();
        assert!((state.coordinates[0] - 2.0 / 15.0).abs() < 1e-13);
        assert_eq!(state.stability, Stability::Neutral { zero: 1 });
        let found = modes(&state).unwrap();
        close(found.modes[1].frequency().unwrap(), 85_f64.sqrt(), 1e-13);
    }
}

#[test]
fn what_gyroscopic_forces_hold_was_not_left() {
    let found = equilibrium(&Derived(Supercritical), &[3.0], &[0.0], &[0.0; 2], Policy::Stable);
    let state = found.unwrap();
    assert_eq!(state.stability, Stability::GyroscopicallyStabilised { negative: 2 });
    assert!(!state.left_unstable_region);
}
