//! Limiting states: nothing to hold the machine, starts far away or exactly on an unstable state, critical speeds.

use eigentol::{Behaviour, Coordinate, DesignVariable, Error, Policy, Stability, Study};
use eigentol_oracle::truth::Truth;
use eigentol_tests::corpus::rotating_double_pendulum::RotatingDoublePendulum;
use eigentol_tests::corpus::rotating_pendulum::RotatingPendulum;

use super::sound::{assert_answers, assert_equilibrium};
use eigentol_tests::statically_unstable::{Falling, FreeBar, SprungMass, StandingBar};

const BOTH: [Policy; 2] = [Policy::Stable, Policy::Nearest];

/// `x* = k rest / (k - m omega^2)`: none at `omega^2 = k / m`; beyond it a divergent one on the other side of the axis.
#[test]
fn a_spring_too_weak_for_the_speed() {
    let study = |omega: f64| Study::new(SprungMass).input(SprungMass::omega, omega);
    for policy in BOTH {
        let held = study(9.0).policy(policy).equilibrium().expect("the spring holds");
        assert!((held.coordinates[0] - 10.0 / 19.0).abs() < 1e-14);
        assert_eq!(held.stability, Stability::Stable);

        let none = study(10.0).policy(policy).equilibrium();
        assert!(matches!(none, Err(Error::NoEquilibrium { .. })), "{none:?}");

        let beyond = study(11.0).policy(policy);
        let state = beyond.equilibrium().expect("an unstable equilibrium");
        assert!((state.coordinates[0] + 10.0 / 21.0).abs() < 1e-14, "{state:?}");
        assert_eq!(state.stability, Stability::Divergent { negative: 1 });
        let modes = beyond.modes().expect("modes");
        let Behaviour::Divergent(rate) = modes.modes[0].behaviour else {
            panic!("{modes:?}");
        };
        assert!((rate - 21f64.sqrt()).abs() < 1e-13);
        assert_eq!(modes.modes[0].frequency(), None);
        let spread = &beyond.first_order().expect("of lambda").modes[0];
        assert!(spread.frequency().is_none() && spread.lambda.sigma > 0.0);
        assert!(spread.distance_to_critical < 0.0);
        let run = beyond.monte_carlo().expect("counts");
        assert_eq!((run.counts.divergent, run.counts.total()), (3000, 3000));
        assert_eq!(*run.modes, [None]);
    }
    // Without a rest length any position is an equilibrium at the critical speed.
    let anywhere = study(10.0).design(SprungMass::rest, 0.0).start(Coordinate::new(0), 0.3);
    let state = anywhere.equilibrium().expect("any place");
    assert_eq!(state.coordinates, [0.3]);
    assert_eq!(state.stability, Stability::Neutral { zero: 1 });
    assert_eq!(anywhere.modes().expect("modes").modes[0].behaviour, Behaviour::Neutral);
    assert!(matches!(anywhere.sensitivities(), Err(Error::CriticalState)));
}

/// `k theta = m g l / 2 sin theta`: upright is unstable where `k < m g l / 2`.
#[test]
fn an_inverted_bar_is_not_called_stable() {
    let study = Study::new(StandingBar);
    let upright = study.clone().policy(Policy::Nearest).equilibrium().expect("upright");
    assert_eq!(upright.coordinates, [0.0]);
    assert_eq!(upright.stability, Stability::Divergent { negative: 1 });
    let fallen = study.equilibrium().expect("it leans on its spring");
    assert_eq!(fallen.stability, Stability::Stable);
    let theta = fallen.coordinates[0];
    assert!((5.0 * theta - 9.81 * theta.sin()).abs() < 1e-13 && theta > 1.0);
    let held = study.design(StandingBar::k, 10.0).equilibrium().expect("upright");
    assert_eq!(held.coordinates, [0.0]);
    assert_eq!(held.stability, Stability::Stable);
}

#[test]
fn what_nothing_holds() {
    let rests =
        Study::new(FreeBar).design(FreeBar::k, 0.0).start(Coordinate::new(0), 1.25).equilibrium().expect("anywhere");
    assert_eq!(rests.coordinates, [1.25]);
    assert_eq!(rests.stability, Stability::Neutral { zero: 1 });
    for policy in BOTH {
        let falls = Study::new(Falling).design(Falling::k, 0.0).policy(policy).equilibrium();
        assert!(matches!(falls, Err(Error::NoEquilibrium { .. })), "{falls:?}");
    }
}

/// A start many turns away still leads to a state of rest, within the resolution of an angle of that size.
#[test]
fn far_starts() {
    for start in [1e3, -1e3, 1e6, -1e6] {
        for omega in [0.0, 2.0, 3.8, 3.9, 5.0, 20.0] {
            let study = Study::new(RotatingPendulum)
                .input(RotatingPendulum::omega, omega)
                .start(RotatingPendulum::theta, start);
            for policy in BOTH {
                let state = study.clone().policy(policy).equilibrium();
                let state = state.unwrap_or_else(|error| panic!("{start}, {omega}: {error}"));
                assert_equilibrium(&RotatingPendulum, &state);
                if policy == Policy::Stable {
                    assert_eq!(state.stability, Stability::Stable, "{start}, {omega}");
                    let cosine = (14.715 / (omega * omega)).min(1.0);
                    // At this angle adjacent numbers are this far apart.
                    let coarse = 1e-9 + 8.0 * f64::EPSILON * start.abs();
                    let found = state.coordinates[0].cos();
                    assert!((found - cosine).abs() <= coarse, "{start}, {omega}: {found}");
                }
            }
        }
        let study = Study::new(RotatingDoublePendulum)
            .input(RotatingDoublePendulum::omega, 4.0)
            .start(RotatingDoublePendulum::theta1, start)
            .start(RotatingDoublePendulum::theta2, -0.7 * start);
        let state = study.equilibrium().expect("a stable state");
        assert_equilibrium(&RotatingDoublePendulum, &state);
        assert_eq!(state.stability, Stability::Stable, "{start}");
    }
}

#[test]
fn starts_on_the_unstable_state_above_the_critical_speed() {
    let truth = Truth::load("P2");
    let critical = truth.get("Omega_critical").number();
    for factor in [1.0 + 1e-9, 1.0 + 1e-6, 1.001, 1.5, 10.0] {
        let study = Study::new(RotatingDoublePendulum).input(RotatingDoublePendulum::omega, factor * critical);
        let state = study.equilibrium().expect("a state");
        assert_equilibrium(&RotatingDoublePendulum, &state);
        assert_eq!(state.stability, Stability::Stable, "{factor}");
        assert!(state.coordinates[0].abs() > 1e-6 && state.left_unstable_region, "{factor}");
        let kept = study.policy(Policy::Nearest).equilibrium().expect("a state");
        assert_eq!(kept.coordinates, [0.0; 2]);
        // The second mode becomes unstable at 7.19 rad/s.
        let negative = if factor > 3.0 { 2 } else { 1 };
        assert_eq!(kept.stability, Stability::Divergent { negative });
    }
}

/// Exactly at the critical speed, and one rounding away from it, the reported class is correct and no answer is NaN.
#[test]
fn exactly_at_the_critical_speed() {
    let critical = Truth::load("P1").get("Omega_critical").number();
    for omega in [critical.next_down(), critical, critical.next_up()] {
        for start in [0.0, 1e-12, 1e-4, 0.5, -1.0] {
            for policy in BOTH {
                let study = Study::new(RotatingPendulum)
                    .input(RotatingPendulum::omega, omega)
                    .start(RotatingPendulum::theta, start)
                    .policy(policy)
                    .samples(300);
                let state = study.equilibrium().expect("a state");
                // The fourth-order potential is flat to 1e-16 up to about a ten-thousandth of a radian.
                assert!(state.coordinates[0].abs() < 1e-3, "{start}: {state:?}");
                let lambda = state.linear.stiffness[0][0] / state.linear.mass[0][0];
                assert!(lambda.abs() < 1e-5, "{start}: {state:?}");
                let tolerances = study.tolerances().expect("declared");
                assert_equilibrium(&RotatingPendulum, &state);
                assert_answers(&RotatingPendulum, &state, &tolerances);
                if let Ok(spread) = study.first_order() {
                    assert!(!spread.trusted(), "{spread:?}");
                }
                let run = study.monte_carlo().expect("samples");
                assert_eq!(run.counts.total(), 300);
                if policy == Policy::Nearest {
                    // They stay with the upright state, which half of them make unstable.
                    assert!((120..=180).contains(&run.counts.stable), "{run}");
                    continue;
                }
                assert_eq!(run.counts.stable, 300);
                let mode = run.modes[0].as_ref().expect("values");
                // The true deviation stays finite.
                let sigma = mode.sigma.expect("many values");
                assert!(sigma > 0.1 && sigma < 0.3);
            }
        }
    }
}

#[test]
fn a_sweep_through_the_critical_speed_stays_on_stable_states() {
    let critical = Truth::load("P2").get("Omega_critical").number();
    let mut speeds: Vec<f64> = (0..=200).map(|k| 2.0 + 0.01 * f64::from(k)).collect();
    speeds.push(critical);
    for offset in [1e-3, 1e-6, 1e-9, 1e-12] {
        speeds.extend([critical - offset, critical + offset]);
    }
    speeds.sort_by(f64::total_cmp);
    let down: Vec<f64> = speeds.iter().rev().copied().collect();
    for speeds in [speeds, down] {
        let study = Study::new(RotatingDoublePendulum);
        let points = study.sweep(RotatingDoublePendulum::omega, &speeds).expect("a sweep").points;
        assert_eq!(points.len(), speeds.len());
        let tolerances = study.tolerances().expect("declared");
        for point in points {
            let state = point.equilibrium.expect("a state");
            assert!(state.stability.holds(), "{} rad/s: {state:?}", point.value);
            assert_equilibrium(&RotatingDoublePendulum, &state);
            assert_answers(&RotatingDoublePendulum, &state, &tolerances);
            let bent = state.coordinates[0].abs() > 1e-3;
            if (point.value - critical).abs() > 1e-3 {
                assert_eq!(bent, point.value > critical, "{}: {state:?}", point.value);
            }
            let modes = point.modes.expect("modes");
            // The second mode never approaches zero.
            assert!(modes.frequencies()[1].is_some_and(|omega| omega > 6.0), "{}", point.value);
        }
    }
}

/// A vanishing length in a joint's placement is legal: the hinge of the lower bar then lies on the axis itself.
#[test]
fn tiny_lengths_are_solved_or_refused() {
    for length in [1e-300, 1e-150, 1e-20, 1e-9] {
        for variable in 0..2 {
            let study = Study::new(RotatingDoublePendulum)
                .input(RotatingDoublePendulum::omega, 3.0)
                .start(RotatingDoublePendulum::theta1, 0.4)
                .design(DesignVariable::new(variable), length);
            if let Ok(state) = study.equilibrium() {
                assert_answers(&RotatingDoublePendulum, &state, &study.tolerances().expect("declared"));
            }
        }
    }
}
