//! Compares one mechanism in two sets of unknowns.

use eigentol::kernels::CurvatureKernels;
use eigentol::modes::modes;
use eigentol::second_order::mode_curvature;
use eigentol::sensitivity::{Quantity, sensitivities, sensitivities_by_finite_difference, sensitivities_explicit};
use eigentol::{Array, Equilibrium, Modes, Policy, Sensitivities, equilibrium::equilibrium};

use crate::common::derived::{Derived, Model};

/// An equilibrium with its modes.
pub(crate) struct State {
    pub(crate) mechanism: Box<dyn CurvatureKernels>,
    pub(crate) at: Equilibrium,
    pub(crate) modes: Modes,
}

pub(crate) fn nominal<X: Model>() -> X::Design<f64> {
    Array::from_fn(|j| X::DESCRIPTION.design[j].nominal)
}

impl State {
    pub(crate) fn new<X: Model + 'static>(model: X, u: &[f64], start: &[f64]) -> Self {
        Self::with(model, u, nominal::<X>().as_ref(), start)
    }

    pub(crate) fn with<X: Model + 'static>(model: X, u: &[f64], b: &[f64], start: &[f64]) -> Self {
        let mechanism = Box::new(Derived(model));
        let at = equilibrium(&*mechanism, u, b, start, Policy::Stable).unwrap();
        let modes = modes(&at).unwrap();
        Self { mechanism, at, modes }
    }
}

#[track_caller]
pub(crate) fn near(a: f64, b: f64, tolerance: f64, scale: f64) {
    assert!((a - b).abs() <= tolerance * scale, "{a:e} is not {b:e}: off by {:e} of {scale:e}", (a - b).abs());
}

#[track_caller]
pub(crate) fn all_near(a: &[f64], b: &[f64], tolerance: f64) {
    assert_eq!(a.len(), b.len());
    let scale = b.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    for (a, b) in a.iter().zip(b) {
        near(*a, *b, tolerance, scale.max(1e-4));
    }
}

/// Requires equal modes: eigenvalues, behaviour, small residuals and valid error estimates.
#[track_caller]
pub(crate) fn same_modes(a: &Modes, b: &Modes, tolerance: f64) {
    assert_eq!(a.modes.len(), b.modes.len());
    let size = b.modes.iter().fold(0.0_f64, |most, mode| most.max(mode.s.norm()));
    for (mode, other) in a.modes.iter().zip(&b.modes) {
        assert!((mode.s - other.s).norm() <= tolerance * size, "{} {}", mode.s, other.s);
        assert_eq!(
            std::mem::discriminant(&mode.behaviour),
            std::mem::discriminant(&other.behaviour),
            "{:?} {:?}",
            mode.behaviour,
            other.behaviour
        );
        assert!(mode.residual < 1e-11, "residual {}", mode.residual);
        assert!(mode.error < 1e-9 * size, "error {}", mode.error);
    }
}

#[track_caller]
pub(crate) fn same_sensitivities(a: &Sensitivities, b: &Sensitivities, tolerance: f64) {
    assert_eq!(a.modes.len(), b.modes.len());
    for (mode, other) in a.modes.iter().zip(&b.modes) {
        all_near(&mode.lambda.by_design, &other.lambda.by_design, tolerance);
        all_near(&mode.lambda.by_input, &other.lambda.by_input, tolerance);
        for quantity in Quantity::ALL {
            let pair = (mode.of(quantity), other.of(quantity));
            let (Some(own), Some(other)) = pair else {
                assert!(pair.0.is_none() && pair.1.is_none());
                continue;
            };
            let scale = other.by_design.iter().fold(1e-4_f64, |most, x| most.max(x.abs()));
            for (a, b) in own.by_design.iter().zip(&other.by_design) {
                near(*a, *b, tolerance, scale);
            }
        }
    }
}

/// Modes, derivatives by three methods, and Hessians of a mechanism with constraints against the one without.
#[track_caller]
pub(crate) fn same_mechanism(a: &State, b: &State) {
    same_modes(&a.modes, &b.modes, 1e-11);
    let reference = sensitivities(&*b.mechanism, &b.at, &b.modes).unwrap();
    let adjoint = sensitivities(&*a.mechanism, &a.at, &a.modes).unwrap();
    same_sensitivities(&adjoint, &reference, 1e-9);
    let explicit = sensitivities_explicit(&*a.mechanism, &a.at, &a.modes).unwrap();
    same_sensitivities(&explicit, &reference, 1e-9);
    let differences = sensitivities_by_finite_difference(&*a.mechanism, &a.at, &a.modes, 5e-6).unwrap();
    same_sensitivities(&differences, &reference, 2e-6);
    for r in 0..a.modes.modes.len() {
        let own = mode_curvature(&*a.mechanism, &a.at, &a.modes, r).unwrap();
        let other = mode_curvature(&*b.mechanism, &b.at, &b.modes, r).unwrap();
        assert!(own.asymmetry < 1e-9, "asymmetry {}", own.asymmetry);
        all_near(own.lambda.by_design.as_flattened(), other.lambda.by_design.as_flattened(), 1e-9);
        all_near(own.lambda.by_input_and_design.as_flattened(), other.lambda.by_input_and_design.as_flattened(), 1e-9);
    }
}
