//! Second derivatives of critical values against closed forms, and against differences of first derivatives at critical
//! states found again.

use crate::common::branching::{Exchange, Flat, Lopsided, LopsidedSnap, MovingPitchfork, Quintic, Skewed, Snap};
use crate::common::chain::DOUBLE;
use crate::common::derived::Derived;
use crate::common::models::Spring;
use crate::common::pendulum::{Pendulum, W};
use eigentol::branches::SpecialKind;
use eigentol::error::NoDerivative;
use eigentol::kernels::CurvatureKernels;
use eigentol::second_order::{EventCurvature, critical_curvature};
use eigentol::sweep::{CriticalState, Range, critical_sensitivity, critical_state};
use eigentol::{Error, Input};

/// A machine, its design, and a range that contains its critical state.
pub(crate) struct Case<'a> {
    pub(crate) machine: &'a dyn CurvatureKernels,
    pub(crate) b: &'a [f64],
    pub(crate) start: &'a [f64],
    pub(crate) between: (f64, f64),
}

impl Case<'_> {
    fn state(&self, b: &[f64]) -> CriticalState {
        let (low, high) = self.between;
        let range = Range::new(Input::new(0), low, high).steps(40);
        critical_state(self.machine, &[0.0], b, self.start, range).unwrap()
    }

    /// Second derivatives, checked against extrapolated differences of the first ones.
    pub(crate) fn curvature(&self) -> EventCurvature {
        let b = self.b;
        let event_curvature = critical_curvature(self.machine, &self.state(b)).unwrap();
        let first = |b: &[f64]| critical_sensitivity(self.machine, &self.state(b)).unwrap();
        for (own, again) in event_curvature.first.iter().zip(&first(b)) {
            assert!((own - again).abs() <= 1e-12 * (1.0 + own.abs()));
        }
        assert!(event_curvature.asymmetry < 1e-8, "{:e}", event_curvature.asymmetry);
        for k in 0..b.len() {
            let slope = |h: f64, j: usize| {
                let [mut up, mut down] = [b.to_vec(), b.to_vec()];
                up[k] += h;
                down[k] -= h;
                (first(&up)[j] - first(&down)[j]) / (2.0 * h)
            };
            for j in 0..b.len() {
                let h = 4e-3 * b[k].abs().max(0.1);
                let expected = (4.0 * slope(0.5 * h, j) - slope(h, j)) / 3.0;
                let own = event_curvature.second[j][k];
                assert!((own - expected).abs() < 1e-7 * (1.0 + own.abs()), "{j}, {k}: {own} {expected}");
            }
        }
        event_curvature
    }

    /// Second derivatives, checked against a closed form as well.
    fn is(&self, expected: &[&[f64]]) {
        let found = self.curvature();
        for (own, expected) in found.second.iter().zip(expected) {
            for (own, expected) in own.iter().zip(*expected) {
                assert!((own - expected).abs() < 1e-9 * (1.0 + expected.abs()), "{own} {expected}");
            }
        }
    }
}

/// `u_c = (3 g / 2 l)^(1/2)`.
#[test]
fn of_the_pendulum() {
    Case { machine: &Pendulum, b: &[3.0, 1.0], start: &[1.0], between: (0.1, 5.0) }
        .is(&[&[0.0, 0.0], &[0.0, 0.75 * W.sqrt()]]);
}

#[test]
fn of_the_double_pendulum() {
    let found =
        Case { machine: &DOUBLE, b: &[0.8, 1.1, 2.5, 3.7], start: &[1.0, 1.0], between: (0.1, 5.0) }.curvature();
    // Scaling of masses and lengths: `b . du_c/db = 0` over masses, `-u_c / 2` over lengths; likewise for each
    // derivative.
    let (b, first) = ([0.8, 1.1, 2.5, 3.7], &found.first);
    for j in 0..4 {
        let over = |pair: [usize; 2]| pair.map(|k| b[k] * found.second[j][k]).iter().sum::<f64>();
        let (masses, lengths) = (over([2, 3]), over([0, 1]));
        let of_masses = if j >= 2 { -first[j] } else { 0.0 };
        let of_lengths = -0.5 * first[j] - if j < 2 { first[j] } else { 0.0 };
        assert!((masses - of_masses).abs() < 1e-9, "{j}: {masses} {of_masses}");
        assert!((lengths - of_lengths).abs() < 1e-9, "{j}: {lengths} {of_lengths}");
    }
}

/// `2 (a/3)^(3/2)`; with a non-symmetric coupling `a = 1 - k/2`; `3 (f/2)^(2/3) c^(1/3)` for `k q - c q^3 = f`.
#[test]
fn of_limit_points() {
    Case { machine: &Derived(Snap), b: &[1.3], start: &[2.0], between: (-1.0, 2.0) }
        .is(&[&[1.0 / (6.0 * (1.3 / 3.0_f64).sqrt())]]);
    Case { machine: &Derived(LopsidedSnap), b: &[0.2], start: &[2.0, 1.0], between: (-1.0, 2.0) }
        .is(&[&[1.0 / (24.0 * 0.3_f64.sqrt())]]);
    let (c, half): (f64, f64) = (1.2, 0.45);
    let by_both = -1.0 / (3.0 * half.cbrt() * c.powf(2.0 / 3.0));
    Case { machine: &Derived(Spring), b: &[1.0, -c, 2.0 * half], start: &[0.2], between: (5.0, 0.8) }.is(&[
        &[0.0; 3],
        &[0.0, -2.0 / 3.0 * (half / c.powf(2.5)).powf(2.0 / 3.0), by_both],
        &[0.0, by_both, -c.cbrt() / (6.0 * half.powf(4.0 / 3.0))],
    ]);
}

/// `u = r + (r^2 + 1/r)^(1/2)`, `r = b/a`, on a branch that moves in every direction with input and design.
#[test]
fn of_a_pitchfork_on_a_moving_branch() {
    let (a, b): (f64, f64) = (1.3, 0.9);
    let r = b / a;
    let root = (r * r + 1.0 / r).sqrt();
    let inner = r - 0.5 / (r * r);
    let slope = 1.0 + inner / root;
    let bend = (1.0 + 1.0 / r.powi(3)) / root - inner * inner / root.powi(3);
    let [by_a, by_b] = [-r / a, 1.0 / a];
    let mixed = bend * by_a * by_b - slope / (a * a);
    Case { machine: &Derived(MovingPitchfork), b: &[a, b], start: &[0.0, 0.0], between: (0.01, 4.0) }
        .is(&[&[bend * by_a * by_a + slope * 2.0 * r / (a * a), mixed], &[mixed, bend * by_b * by_b]]);
}

#[test]
fn where_stiffness_is_not_symmetric() {
    Case { machine: &Derived(Lopsided), b: &[1.1], start: &[0.0; 2], between: (0.01, 1.0) }.is(&[&[0.0]]);
    Case { machine: &Derived(Quintic), b: &[1.2], start: &[0.0], between: (0.0, 2.0) }.is(&[&[0.0]]);
    Case { machine: &Derived(Skewed), b: &[0.7, 1.3], start: &[0.0; 2], between: (0.05, 3.0) }.curvature();
}

#[test]
fn where_there_are_none() {
    let (d, e, s) = (0.1, -0.2, 0.7);
    let exchange = Case { machine: &Derived(Exchange), b: &[d, e, s], start: &[d], between: (-1.0, 1.0) };
    let state = exchange.state(exchange.b);
    assert_eq!(state.kind, SpecialKind::Transcritical);
    let refused = critical_curvature(exchange.machine, &state);
    let reason = NoDerivative::Transcritical;
    assert_eq!(refused, Err(Error::NoSensitivity { reason }));

    let flat = Case { machine: &Derived(Flat), b: &[0.3], start: &[1.3], between: (1.0, -1.0) };
    let state = flat.state(flat.b);
    assert_eq!(state.kind, SpecialKind::Fold);
    let refused = critical_curvature(flat.machine, &state);
    let reason = NoDerivative::Cusp;
    assert_eq!(refused, Err(Error::NoSensitivity { reason }));
}
