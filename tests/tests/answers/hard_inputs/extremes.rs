//! The limits of the double-precision range.

use eigentol::sensitivity::{sensitivities, sensitivities_explicit, sensitivities_with_frozen_equilibrium};
use eigentol::{Coordinate, DesignVariable, Policy, Stability, Study};
use eigentol_tests::corpus::governor::Governor;
use eigentol_tests::corpus::rotating_double_pendulum::RotatingDoublePendulum;
use eigentol_tests::corpus::rotating_pendulum::RotatingPendulum;
use proptest::prelude::*;

use super::sound::{assert_equilibrium, assert_numbers};
use super::wild::{ask_often, design, sized};

fn pendulum(omega: f64, l: f64, m: f64) -> Study<RotatingPendulum> {
    Study::new(RotatingPendulum)
        .input(RotatingPendulum::omega, omega)
        .design(RotatingPendulum::l, l)
        .design(RotatingPendulum::m, m)
}

/// Numbers near 1e9 are 1.2e-7 apart: `cos theta*` is 1 to within 1e-9, or there is no result.
#[test]
fn starts_a_thousand_million_radians_away() {
    for start in [1e9, -1e9, 3e9, 1e10] {
        for omega in [0.0, 2.0, 3.8, 3.9, 5.0, 20.0] {
            let study = pendulum(omega, 1.0, 3.0).start(RotatingPendulum::theta, start);
            let Ok(state) = study.equilibrium() else {
                continue;
            };
            assert_equilibrium(&RotatingPendulum, &state);
            let cosine = (14.715 / (omega * omega)).min(1.0);
            let found = state.coordinates[0].cos();
            let coarse = 1e-9 + 8.0 * f64::EPSILON * start.abs();
            assert!((found - cosine).abs() <= coarse, "{start}, {omega}: {found}");
        }
    }
}

/// The moment of gravity, about 2700 N m, determines the angle of the upper bar. The remaining residual is thousands of
/// times larger, and far more than coordinate rounding explains. Relative to the lower bar's stiffness it is small.
#[test]
fn a_short_bar_on_a_bar_round_the_world() {
    let study = Study::new(RotatingDoublePendulum)
        .input(RotatingDoublePendulum::omega, 1.0)
        .design(RotatingDoublePendulum::l1, 957.675_109_776_582_5)
        .design(RotatingDoublePendulum::l2, 132_130_681.632_674_43)
        .design(RotatingDoublePendulum::m1, 1.0)
        .design(RotatingDoublePendulum::m2, 1.0)
        .start(RotatingDoublePendulum::theta2, -450.359_239_896_829);
    for start in -40..=40 {
        let start = 0.25 * f64::from(start);
        let study = study.clone().start(RotatingDoublePendulum::theta1, start);
        for policy in [Policy::Stable, Policy::Nearest] {
            if let Ok(state) = study.clone().policy(policy).equilibrium() {
                assert_equilibrium(&RotatingDoublePendulum, &state);
            }
        }
    }
}

/// The time scale of the upper bar is nowhere near that of the lower one, yet it must still come to rest.
#[test]
fn a_tiny_bar_under_a_long_one() {
    let study = |start: f64| {
        Study::new(RotatingDoublePendulum)
            .input(RotatingDoublePendulum::omega, 6.960_622_633_984_01)
            .design(RotatingDoublePendulum::l1, 174.200_789_846_162_2)
            .design(RotatingDoublePendulum::l2, 1.597_802_686_943_615_8e-18)
            .design(RotatingDoublePendulum::m1, 1.0)
            .design(RotatingDoublePendulum::m2, 1.0)
            .start(RotatingDoublePendulum::theta1, start)
    };
    for start in [-6.960_622_633_984_01, 0.5, 1.0, 3.0] {
        for policy in [Policy::Stable, Policy::Nearest] {
            if let Ok(state) = study(start).policy(policy).equilibrium() {
                assert_equilibrium(&RotatingDoublePendulum, &state);
            }
        }
    }
}

/// `Khat (|q| + 0.001)` overflows, and a residual relative to infinity would be zero.
#[test]
fn a_residual_is_not_measured_by_infinity() {
    let design = [7.015e151, 379.9, 4.708e77, 878.2, 333.1];
    let mut study = Study::new(Governor)
        .input(Governor::speed, 8.448)
        .input(Governor::collar, -315_108.3)
        .start(Coordinate::new(0), 2.25);
    for (j, value) in design.into_iter().enumerate() {
        study = study.design(DesignVariable::new(j), value);
    }
    if let Ok(state) = study.equilibrium() {
        assert_equilibrium(&Governor, &state);
        assert_eq!(state.stability, Stability::Stable);
    }
}

/// The variance overflows, but its shares need not.
#[test]
fn shares_of_a_huge_variance() {
    for width in [1e100, 1e154, 1e160, 1e200, f64::MAX] {
        let spread = pendulum(1.0, 1.0, 3.0).tolerance(RotatingPendulum::l, width).first_order().expect("a spread");
        let mode = &spread.modes[0];
        assert_numbers(mode.variance_shares(), "shares");
        assert_numbers(mode.frequency().iter().map(|x| x.sigma), "sigma");
        let outputs = pendulum(5.0, 1.0, 3.0)
            .start(Coordinate::new(0), 1.0)
            .tolerance(RotatingPendulum::l, width)
            .output_tolerances()
            .expect("a spread");
        assert_numbers(outputs.spreads[0].iter().flat_map(|x| &x.variance_shares), "shares of an output");
    }
}

/// Where the adjoint method reports that a derivative is not finite, the explicit method must not return NaN.
#[test]
fn both_ways_of_differentiating_refuse_alike() {
    let study = pendulum(-4.923, 4.256e-161, 0.1198).start(Coordinate::new(0), -1.8e-90);
    let (state, found) = (study.equilibrium().expect("a state"), study.modes().expect("modes"));
    let adjoint = sensitivities(&RotatingPendulum, &state, &found);
    assert!(adjoint.is_err(), "{adjoint:?}");
    if let Ok(all) = sensitivities_explicit(&RotatingPendulum, &state, &found) {
        assert_numbers(&all.modes[0].lambda.by_design, "explicit");
    }
}

#[test]
fn frozen_derivatives_are_numbers() {
    let study = pendulum(-1.416e-96, 4.7392e155, 7.6749e-24);
    let (state, found) = (study.equilibrium().expect("a state"), study.modes().expect("modes"));
    let frozen = sensitivities_with_frozen_equilibrium(&RotatingPendulum, &state, &found);
    if let Ok(frozen) = frozen {
        assert_numbers(&frozen.modes[0].lambda.by_design, "frozen");
    }
}

/// Any number of 64 bits: NaN, infinite, subnormal.
fn any_bits() -> impl Strategy<Value = f64> {
    any::<u64>().prop_map(f64::from_bits)
}

/// The whole range of a double, where products overflow and vanish.
fn values_of_any_bits(cases: u32) {
    ask_often(
        cases,
        prop_oneof![1 => any_bits(), 9 => sized(300.0)],
        prop_oneof![1 => any_bits(), 19 => design(300.0)],
        prop_oneof![1 => any_bits(), 9 => sized(300.0)],
        prop_oneof![1 => any_bits(), 9 => design(300.0)],
    );
}

#[test]
fn any_bits_at_all() {
    values_of_any_bits(60);
}

#[test]
#[ignore = "a quarter of a minute"]
fn any_bits_at_all_many_times() {
    values_of_any_bits(2000);
}
