//! First-order systems and multinormal probabilities against closed forms.

use core::f64::consts::PI;

use eigentol_statistics::reliability::sampling::Interval;
use eigentol_statistics::reliability::system::{
    FirstOrderSystem, QuadratureSettings, box_probability, probability_above,
};

use crate::common::{below, close, design_point, linear, mean};

fn equicorrelated(number: usize, correlation: f64) -> Vec<Vec<f64>> {
    let entry = |i, j| if i == j { 1.0 } else { correlation };
    (0..number).map(|i| (0..number).map(|j| entry(i, j)).collect()).collect()
}

/// Equal correlations `r > 0`: given the common part the variables are independent (Dunnett and Sobel 1955).
#[test]
fn equal_correlations() {
    let r = 0.4_f64;
    for (beta, number) in [(1.0, 3), (2.5, 6), (5.0, 12)] {
        let system = FirstOrderSystem::new(vec![beta; number], equicorrelated(number, r)).unwrap();
        let given = |x: f64| (r.sqrt() * x - beta) / (1.0 - r).sqrt();
        let none = |x: f64| {
            let fails = below(given(x));
            -(number as f64 * (-fails).ln_1p()).exp_m1()
        };
        let settings = QuadratureSettings::default();
        let series = system.series_probability(&settings).unwrap();
        close(series.value, mean(none), 1e-3);
        assert!((series.value - mean(none)).abs() < 6.0 * series.standard_error + 1e-12);
        let finer = QuadratureSettings { points: 10_000, ..settings.clone() };
        let parallel = system.parallel_probability(&finer).unwrap();
        let exact = mean(|x| below(given(x)).powi(number as i32));
        assert!((parallel.value - exact).abs() < 5.0 * parallel.standard_error + 1e-9 * exact);
        assert!(parallel.standard_error < 0.05 * exact, "{parallel:?} {exact}");
        let met = system.all_met(&settings).unwrap();
        close(met.value, 1.0 - mean(none), 1e-3);
        let bounds = system.series_bounds();
        assert!(bounds.lower <= series.value * 1.001 && series.value <= bounds.upper * 1.001);
    }
}

/// Positive orthants of three variables: `1/8 + sum asin(r) / (4 pi)`.
#[test]
fn orthants() {
    let (a, b, c) = (0.6, -0.3, 0.2_f64);
    let correlation = vec![vec![1.0, a, b], vec![a, 1.0, c], vec![b, c, 1.0]];
    let positive = [Interval { lower: 0.0, upper: f64::INFINITY }; 3];
    let exact = 0.125 + (a.asin() + b.asin() + c.asin()) / (4.0 * PI);
    let found = box_probability(&positive, &correlation, &QuadratureSettings::default()).unwrap();
    close(found.value, exact, 1e-3);
    assert!((found.value - exact).abs() < 6.0 * found.standard_error + 1e-9);
}

/// More requirements than variables: the matrix is singular, and opposite limits exclude each other.
#[test]
fn singular_matrices() {
    let design_points = [
        design_point(&linear(2.0, vec![-1.0, 0.0])),
        design_point(&linear(2.5, vec![1.0, 0.0])),
        design_point(&linear(3.0, vec![0.0, -1.0])),
        design_point(&linear(2.0, vec![-1.0, 0.0])),
    ];
    let system = FirstOrderSystem::of(&design_points).unwrap();
    let exact = 1.0 - (below(2.0) - below(-2.5)) * below(3.0);
    let settings = QuadratureSettings::default();
    close(system.series_probability(&settings).unwrap().value, exact, 1e-3);
    assert_eq!(system.parallel_probability(&settings).unwrap().value, 0.0);
    close(system.all_met(&settings).unwrap().value, 1.0 - exact, 1e-3);
}

/// For two requirements Ditlevsen's bounds coincide at the exact probability.
#[test]
fn bounds_of_a_pair_are_exact() {
    for r in [-0.5, 0.0, 0.9] {
        let system = FirstOrderSystem::new(vec![3.2, 3.0], equicorrelated(2, r)).unwrap();
        let exact = below(-3.0) + below(-3.2) - probability_above(3.0, 3.2, r).unwrap();
        let bounds = system.series_bounds();
        close(bounds.lower, exact, 1e-12);
        close(bounds.upper, exact, 1e-12);
        let series = system.series_probability(&QuadratureSettings::default()).unwrap();
        close(series.value, exact, 1e-4);
    }
}

/// Independent requirements of very different, very small probabilities.
#[test]
fn small_probabilities_keep_their_digits() {
    let system = FirstOrderSystem::new(vec![9.0, 8.0, 8.2], equicorrelated(3, 0.0)).unwrap();
    let exact = below(-9.0) + below(-8.0) + below(-8.2);
    let series = system.series_probability(&QuadratureSettings::default()).unwrap();
    close(series.value, exact, 1e-10);
}

#[test]
fn nonsense_is_refused() {
    let settings = QuadratureSettings::default();
    assert!(FirstOrderSystem::new(vec![], vec![]).is_err());
    assert!(FirstOrderSystem::new(vec![f64::NAN], vec![vec![1.0]]).is_err());
    assert!(FirstOrderSystem::new(vec![1.0, 2.0], vec![vec![1.0]]).is_err());
    assert!(FirstOrderSystem::new(vec![1.0; 2], equicorrelated(2, 1.5)).is_err());
    // Not positive semidefinite.
    assert!(FirstOrderSystem::new(vec![1.0; 3], equicorrelated(3, -0.9)).is_err());
    let reversed = [Interval { lower: 1.0, upper: 0.0 }];
    assert!(box_probability(&reversed, &[vec![1.0]], &settings).is_err());
    assert!(probability_above(0.0, 0.0, 1.1).is_err());
    assert!(probability_above(f64::NAN, 0.0, 0.1).is_err());
}
