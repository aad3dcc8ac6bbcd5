//! Modes: residuals and normalisation of random pencils, repeated eigenvalues, identity by shape.

use crate::common::chain::DOUBLE;
use crate::common::close;
use crate::common::derived::Derived;
use crate::common::description;
use crate::common::models::{Plate, Spring};
use crate::common::pendulum::Pendulum;
use eigentol::equilibrium::equilibrium;
use eigentol::kernels::{Kernels, Linear};
use eigentol::modes::{clusters, match_modes, modes, undamped_modes};
use eigentol::{Behaviour, DampingKind, Description, Error, Family, Matrix, Mode, Modes, Policy, Shared, Vector};
use proptest::prelude::*;

static ANY: Shared<Description> = Shared::Static(&description!("Any", &[], &[], &[], true, DampingKind::Zero));

fn pencil(stiffness: impl Into<Matrix>, mass: impl Into<Matrix>) -> Linear {
    let (stiffness, mass) = (stiffness.into(), mass.into());
    Linear { damping: Matrix::zeros(mass.row_count(), mass.row_count()), mass, stiffness }
}

fn modes_of(linear: &Linear, description: &Shared<Description>) -> Result<Modes, Error> {
    eigentol::modes::modes_of(linear, Family::Undamped, description)
}

fn real(mode: &Mode) -> Vector {
    assert!(mode.shape.iter().all(|value| value.im == 0.0));
    mode.shape.map(|value| value.re)
}

fn form(x: &[f64], matrix: &Matrix, y: &[f64]) -> f64 {
    let n = x.len();
    (0..n).map(|i| (0..n).map(|j| x[i] * matrix[i][j] * y[j]).sum::<f64>()).sum()
}

fn diagonal(n: usize, value: impl Fn(usize) -> f64) -> Matrix {
    Matrix::from_fn(n, n, |i, j| if i == j { value(i) } else { 0.0 })
}

/// A symmetric matrix from the first numbers of `seeds`; shifted to be positive definite if `shift` is positive.
fn symmetric(n: usize, seeds: &[f64], shift: f64) -> Matrix {
    let mut matrix = Matrix::zeros(n, n);
    for i in 0..n {
        for j in 0..=i {
            let value = seeds[(i * n + j) % seeds.len()];
            matrix[i][j] = value;
            matrix[j][i] = value;
        }
        matrix[i][i] += shift;
    }
    matrix
}

fn check(n: usize, stiffness: &[f64], mass: &[f64], duplicate: bool) {
    let (k, m) = if duplicate {
        // Two blocks of equal uncoupled oscillators: every eigenvalue repeated.
        (diagonal(n, |i| (1 + i / 2) as f64), diagonal(n, |_| 2.0))
    } else {
        let mass = symmetric(n, mass, 1.5 * n as f64);
        (symmetric(n, stiffness, 0.0), mass)
    };
    let modes = modes_of(&pencil(k, m.clone()), &ANY).unwrap();
    for (r, mode) in modes.modes.iter().enumerate() {
        assert!(mode.residual < 1e-11, "residual {:e}", mode.residual);
        let shape = real(mode);
        let lead = shape.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap();
        assert!(lead > 0.0 || shape.iter().any(|x| (x + lead).abs() < 1e-8), "{shape:?}");
        for (s, other) in modes.modes.iter().enumerate() {
            let expected = if r == s { 1.0 } else { 0.0 };
            let product = form(&shape, &m, &real(other));
            assert!((product - expected).abs() < 1e-11, "{r} {s}: {product}");
        }
        if r > 0 {
            assert!(mode.lambda >= modes.modes[r - 1].lambda);
        }
    }
}

/// The same cases on every run.
fn fixed(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        failure_persistence: None,
        rng_seed: proptest::test_runner::RngSeed::Fixed(1),
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(fixed(60))]

    #[test]
    fn random_pencils(
        stiffness in prop::collection::vec(-1.0..1.0_f64, 144),
        mass in prop::collection::vec(-1.0..1.0_f64, 144),
        duplicate in any::<bool>(),
    ) {
        for n in [1, 2, 3, 4, 5, 6, 7, 8, 9, 12] {
            check(n, &stiffness, &mass, duplicate);
        }
    }
}

proptest! {
    #![proptest_config(fixed(300))]

    /// A soft pendulum on stiff bearings: stiffnesses, masses and lengths of very different magnitude.
    #[test]
    fn eigenvalues_of_very_different_size(
        stiffness in prop::collection::vec(-0.2..0.2_f64, 25),
        mass in prop::collection::vec(-0.2..0.2_f64, 25),
        scale in prop::collection::vec(-2.5..2.5_f64, 5),
    ) {
        let graded = |seeds: &[f64], shift: f64, power: f64| {
            let plain = symmetric(5, seeds, shift);
            Matrix::from_fn(5, 5, |i, j| plain[i][j] * 10f64.powf(power * (scale[i] + scale[j])))
        };
        let linear = pencil(graded(&stiffness, 2.0, 1.0), graded(&mass, 2.0, -0.25));
        let found = modes_of(&linear, &ANY).unwrap();
        for (r, mode) in found.modes.iter().enumerate() {
            prop_assert!(mode.residual < 1e-12, "residual {:e}", mode.residual);
            prop_assert!(mode.lambda > 0.0, "lambda {:e}", mode.lambda);
            for other in &found.modes[..r] {
                let product = form(&real(mode), &linear.mass, &real(other));
                prop_assert!(product.abs() < 1e-6, "{product:e}");
            }
        }
    }
}

#[test]
fn frequencies_match_references() {
    for (omega, expected) in [
        (1.0, 3.703_376_837_428_241),
        (3.8, 0.524_404_424_085_075_8),
        (4.0, 1.570_604_481_561_16),
        (8.0, 7.785_672_713_990_423),
    ] {
        let state = equilibrium(&Pendulum, &[omega], &[3.0, 1.0], &[1.0], Policy::Stable).unwrap();
        close(modes(&state).unwrap().modes[0].frequency().unwrap(), expected, 1e-13);
    }
    // From 50-digit arithmetic (mpmath), two uniform bars in series.
    for (omega, design, expected) in [
        (2.5, [1.0, 1.0, 3.0, 3.0], [0.965_925_006_756_158_8, 6.739_954_664_634_111]),
        (3.5, [1.0, 1.0, 3.0, 3.0], [2.817_961_821_063_948, 9.284_467_432_029_244]),
        (5.0, [0.8, 1.1, 2.5, 3.7], [4.761_994_922_557_966, 14.298_968_212_106_408]),
    ] {
        let state = equilibrium(&DOUBLE, &[omega], &design, &[1.0, 1.0], Policy::Stable).unwrap();
        let found = modes(&state).unwrap();
        assert!(!found.damping_ignored);
        for (actual, expected) in found.frequencies().iter().zip(expected) {
            close(actual.unwrap(), expected, 1e-12);
        }
    }
}

#[test]
fn gyroscopic_terms_are_named_as_ignored() {
    let state = equilibrium(&Derived(Plate), &[4.0], &[0.5, 40.0, 60.0, 0.0], &[0.1, 0.0], Policy::Stable).unwrap();
    let found = undamped_modes(&state).unwrap();
    assert!(found.damping_ignored);
    close(found.modes[0].lambda, 64.0, 1e-14);
    close(found.modes[1].lambda, 104.0, 1e-14);
    assert!(found.to_string().contains("ignored"));
    let still = equilibrium(&Derived(Plate), &[0.0], &[0.5, 40.0, 60.0, 0.0], &[0.1, 0.0], Policy::Stable);
    assert!(!undamped_modes(&still.unwrap()).unwrap().damping_ignored);
}

#[test]
fn divergence_and_freedom_are_classes() {
    let at = |k: f64, force: f64| {
        let state = equilibrium(&Derived(Spring), &[k], &[4.0, 0.0, force], &[0.0], Policy::Nearest);
        modes(&state.unwrap()).unwrap().modes.remove(0)
    };
    assert_eq!(at(-16.0, 1.0).behaviour, Behaviour::Divergent(2.0));
    assert_eq!(at(-16.0, 1.0).frequency(), None);
    assert_eq!(at(0.0, 0.0).behaviour, Behaviour::Neutral);
    assert_eq!(at(16.0, 1.0).behaviour, Behaviour::Oscillating(2.0));
}

#[test]
fn matching_follows_shapes_and_is_a_permutation() {
    let mass = diagonal(3, |_| 1.0);
    let diagonal = |a: f64, b: f64, c: f64| {
        let stiffness = diagonal(3, |i| [a, b, c][i]);
        modes_of(&pencil(stiffness, mass.clone()), &ANY).unwrap()
    };
    let order =
        match_modes(&diagonal(1.0, 2.0, 3.0), &diagonal(5.0, 4.0, 3.0), &pencil(Matrix::zeros(3, 3), mass.clone()));
    assert_eq!(order, [Some(2), Some(1), Some(0)]);
    let near = diagonal(1.0, 1.0 + 1e-9, 3.0);
    assert_eq!(clusters(&near, 1e-6), [true, true, false]);
}

#[test]
fn singular_mass_names_its_coordinate() {
    let singular = pencil([[1.0, 0.0], [0.0, 1.0]], [[1.0, 1.0], [1.0, 1.0]]);
    let result = modes_of(&singular, &Derived(Plate).description());
    let coordinate = "y".into();
    assert_eq!(result, Err(Error::SingularMass { coordinate }));
    let nan = pencil([[f64::NAN, 0.0], [0.0, 1.0]], [[1.0, 0.0], [0.0, 1.0]]);
    assert!(matches!(modes_of(&nan, &ANY), Err(Error::ModesNotFound { .. })));
}

/// The symmetric part of a skew `Chat` is zero except for rounding: its eigenpairs can only be judged relative to
/// rounding.
#[test]
fn a_matrix_of_rounding_errors_has_modes() {
    let noise = 1.3234889800848443e-23;
    let mut stiffness = [[0.0; 5]; 5];
    stiffness[2][4] = -noise;
    stiffness[4][2] = -noise;
    let upper = [
        [1.9187994587294266, 0.7440131129819394, -7.638034203205087e-7, 0.09375712284500543, 3.1215194881275135e-9],
        [0.0, 0.36089343390111894, -1.7297349814103477e-9, 0.049280050306295106, -2.1347471029188987e-8],
        [0.0, 0.0, 0.010052758516844843, -3.9834955515877086e-10, -0.00042152151664017135],
        [0.0, 0.0, 0.0, 0.009666666666667063, 4.0093340298414425e-10],
        [0.0, 0.0, 0.0, 0.0, 0.0006966666666666667],
    ];
    let mass = Matrix::from_fn(5, 5, |i, j| upper[i.min(j)][i.max(j)]);
    let modes = modes_of(&pencil(stiffness, mass.clone()), &ANY).unwrap();
    assert!(modes.modes.iter().all(|mode| mode.lambda.abs() < 1e-20));
    assert!(modes_of(&pencil([[0.0; 5]; 5], mass), &ANY).is_ok());
}
