//! Probabilities of intervals: closed forms, reference numbers, sampling, hard scales.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use eigentol::second_order::{Probability, Quadratic};
use eigentol::{Error, Matrix, Vector};

use super::{Normal, close, coupled, factor, independent, spread, value_at, within};

const ALL: f64 = f64::INFINITY;

/// Sum of `c z + nu z^2 / 2` over independent standard normal variables.
fn diagonal(terms: &[(f64, f64)]) -> Quadratic {
    let element = |i: usize, j: usize| if i == j { terms[i].1 } else { 0.0 };
    Quadratic {
        value: 0.0,
        slopes: terms.iter().map(|(c, _)| *c).collect(),
        curvature: Matrix::from_fn(terms.len(), terms.len(), element),
    }
}

fn chance(model: &Quadratic, band: (f64, f64)) -> Probability {
    let tolerances = independent(Vector::filled(model.slopes.len(), 1.0));
    let probability = model.probability(&tolerances, band).unwrap();
    assert!((0.0..=1.0).contains(&probability.value) && probability.error >= 0.0);
    probability
}

/// The value is correct within `1e-11` and within its stated error.
fn agrees(model: &Quadratic, band: (f64, f64), expected: f64) {
    let found = chance(model, band);
    within(found.value, expected, found.error.max(1e-14));
    within(found.value, expected, 1e-11);
    assert!(found.error < 1e-11, "error {:e} at {band:?}", found.error);
}

#[test]
fn without_curvature_the_tails_keep_their_digits() {
    let model = diagonal(&[(3.0, 0.0), (-4.0, 0.0)]);
    // Tails of the normal distribution from 50-digit arithmetic.
    close(chance(&model, (25.0, ALL)).value, 2.866_515_718_791_939e-7, 1e-13);
    close(chance(&model, (-ALL, -50.0)).value, 7.619_853_024_160_526e-24, 1e-13);
    close(chance(&model, (-5.0, 5.0)).value, 0.682_689_492_137_085_9, 1e-14);
    assert_eq!(chance(&model, (-ALL, ALL)).value, 1.0);
    for band in [(25.0, ALL), (-ALL, -50.0), (-5.0, 5.0), (1.0, 2.0)] {
        let first = model.probability_first_order(&independent([1.0; 2]), band);
        close(chance(&model, band).value, first.unwrap(), 1e-14);
    }
}

#[test]
fn chi_square_of_one_to_seven_degrees() {
    // For even and odd numbers of squares: the upper tail by the recurrence Q(k + 2) = Q(k) + density terms.
    fn upper(degrees: usize, x: f64) -> f64 {
        let half = 0.5 * x;
        let mut tail = if degrees.is_multiple_of(2) { (-half).exp() } else { erfc(half.sqrt()) };
        let mut a = if degrees.is_multiple_of(2) { 1.0 } else { 0.5 };
        // half^a e^-half / Gamma(a + 1).
        let mut term =
            if degrees.is_multiple_of(2) { half * (-half).exp() } else { 2.0 * (half / PI).sqrt() * (-half).exp() };
        while 2.0 * a + 0.5 < degrees as f64 {
            tail += term;
            a += 1.0;
            term *= half / a;
        }
        tail
    }
    for degrees in 1..8 {
        let model = diagonal(&vec![(0.0, 2.0); degrees]);
        for x in [1e-3, 0.1, 1.0, 5.0, 12.0, 40.0] {
            agrees(&model, (x, ALL), upper(degrees, x));
            agrees(&model, (-ALL, x), 1.0 - upper(degrees, x));
            agrees(&model, (0.5 * x, x), upper(degrees, 0.5 * x) - upper(degrees, x));
        }
        assert!(chance(&model, (-ALL, -1.0)).value < 1e-12);
        assert!(chance(&model, (-ALL, 0.0)).value < 1e-11);
    }
    // And with many.
    let model = diagonal(&[(0.0, 2.0); 40]);
    for x in [10.0, 30.0, 40.0, 80.0] {
        agrees(&model, (x, ALL), upper(40, x));
    }
}

/// Complementary error function by its continued fraction or series, implemented here.
fn erfc(x: f64) -> f64 {
    if x < 2.5 {
        let (mut term, mut sum) = (x, x);
        for k in 1..200 {
            term *= x * x / (f64::from(k) + 0.5);
            sum += term;
        }
        1.0 - 2.0 / PI.sqrt() * (-x * x).exp() * sum
    } else {
        let rest = (1..=200).rev().fold(x, |rest, k| x + 0.5 * f64::from(k) / rest);
        (-x * x).exp() / PI.sqrt() / rest
    }
}

#[test]
fn differences_of_squares_are_laplace() {
    // (z1^2 + z2^2 - z3^2 - z4^2) / 2 is a difference of two exponential variables: a Laplace distribution.
    let model = diagonal(&[(0.0, 1.0), (0.0, 1.0), (0.0, -1.0), (0.0, -1.0)]);
    for y in [1e-6, 0.1, 1.0, 7.0, 20.0] {
        agrees(&model, (y, ALL), 0.5 * (-y).exp());
        agrees(&model, (-ALL, -y), 0.5 * (-y).exp());
        agrees(&model, (-y, y), 1.0 - (-y).exp());
    }
    agrees(&model, (-ALL, 0.0), 0.5);
    // Different rates a and b: P(X > y) = a exp(-y / a) / (a + b).
    let model = diagonal(&[(0.0, 2.0), (0.0, 2.0), (0.0, -0.01), (0.0, -0.01)]);
    for y in [1e-3, 1.0, 20.0] {
        agrees(&model, (y, ALL), 2.0 / 2.01 * (-y / 2.0).exp());
        agrees(&model, (-ALL, -y), 0.01 / 2.01 * (-y / 0.01).exp());
    }
}

/// From quadrature in 30-digit arithmetic over one of two variables, with a closed form for the other:
/// `(c1, nu1, c2, nu2, y)` and `P(X < y)`.
const TWO: [(f64, f64, f64, f64, f64, f64); 26] = [
    (0.3, 1.0, 0.5, 0.6, -0.2, 0.045_638_055_314_149_96),
    (0.3, 1.0, 0.5, 0.6, 0.0, 0.201_612_850_132_624_12),
    (0.3, 1.0, 0.5, 0.6, 1.0, 0.690_561_434_164_346_3),
    (0.3, 1.0, 0.5, 0.6, 5.0, 0.994_782_674_712_377_2),
    (0.0, 1.0, 0.0, -0.5, -1.0, 0.024_960_356_929_822_243),
    (0.0, 1.0, 0.0, -0.5, -0.01, 0.367_951_413_066_087_25),
    (0.0, 1.0, 0.0, -0.5, 0.0, 0.391_826_552_030_607_3),
    (0.0, 1.0, 0.0, -0.5, 0.01, 0.415_810_084_637_450_45),
    (0.0, 1.0, 0.0, -0.5, 1.0, 0.877_149_501_904_910_8),
    (0.0, 1.0, 0.0, -0.5, 3.0, 0.988_556_653_080_691_6),
    (0.0, 1.0, 1e-05, 1e-08, -1e-05, 0.000_371_070_952_989_067),
    (0.0, 1.0, 1e-05, 1e-08, 1e-05, 0.003_213_012_871_309_897),
    (0.0, 1.0, 1e-05, 1e-08, 0.002, 0.050_428_807_880_791_67),
    (0.0, 1.0, 1e-05, 1e-08, 0.5, 0.682_689_489_668_984_5),
    (0.0, 1.0, 1e-05, -1e-08, -1e-05, 0.000_372_219_243_813_452_3),
    (0.0, 1.0, 1e-05, -1e-08, 0.002, 0.050_428_933_788_907_52),
    (0.0, 1.0, 1e-05, -1e-08, 0.5, 0.682_689_494_508_399),
    (0.2, 1.0, 0.001, 0.0, -0.02, 0.014_373_422_569_540_214),
    (0.2, 1.0, 0.001, 0.0, -0.019, 0.031_483_705_924_923_36),
    (0.2, 1.0, 0.001, 0.0, 0.5, 0.682_565_988_952_007_7),
    (3.0, 0.4, 0.1, -2.0, -4.0, 0.158_373_253_000_138_5),
    (3.0, 0.4, 0.1, -2.0, 0.0, 0.608_561_736_725_977),
    (3.0, 0.4, 0.1, -2.0, 6.0, 0.975_255_170_494_126_1),
    (0.0, 1.0, 0.0, 0.0001, 1e-05, 0.000_975_609_744_561_949_3),
    (0.0, 1.0, 0.0, 0.0001, 0.3, 0.561_383_811_756_133_3),
    (0.0, 1.0, 0.0, 0.0001, 9.0, 0.999_977_908_342_467_5),
];

#[test]
fn two_variables_match_reference() {
    for (c1, nu1, c2, nu2, y, expected) in TWO {
        let model = diagonal(&[(c1, nu1), (c2, nu2)]);
        agrees(&model, (-ALL, y), expected);
        agrees(&model, (y, ALL), 1.0 - expected);
    }
}

#[test]
fn a_square_beside_a_normal_term_matches_quadrature() {
    // X = c1 z1 + nu z1^2 / 2 + c2 z2: the trapezoidal rule over z1 of the normal probability in z2.
    for (c1, nu, c2) in [(1.0, 0.2, 0.5), (0.3, -1.5, 0.4), (0.0, 1.0, 1.0), (1.0, 1e-3, 0.2)] {
        let model = diagonal(&[(c1, nu), (c2, 0.0)]);
        for y in [-3.0, -0.7, 0.0, 0.4, 2.0] {
            let step = 1.0 / 256.0;
            let expected: f64 = (-2560..=2560)
                .map(|k| {
                    let z = f64::from(k) * step;
                    let rest = (y - c1 * z - 0.5 * nu * z * z) / c2 * FRAC_1_SQRT_2;
                    let below = if rest > 0.0 { 1.0 - 0.5 * erfc(rest) } else { 0.5 * erfc(-rest) };
                    below * (-0.5 * z * z).exp() * step / (2.0 * PI).sqrt()
                })
                .sum();
            agrees(&model, (-ALL, y), expected);
        }
    }
}

#[test]
fn coupled_variables_match_sampling() {
    const SAMPLES: usize = 400_000;
    let (model, tolerances) = coupled();
    let lower = factor(&tolerances);
    let mut normal = Normal(42);
    let bands = [(-ALL, 6.0), (6.5, 7.5), (8.0, ALL), (7.0, 9.0), (10.0, ALL)];
    let mut counts = [0_usize; 5];
    for _ in 0..SAMPLES {
        let z: [f64; 4] = core::array::from_fn(|_| normal.next());
        let f = value_at(&model, &spread(&lower, &z));
        for (count, (low, high)) in counts.iter_mut().zip(bands) {
            *count += usize::from(low < f && f < high);
        }
    }
    let mut beyond_first_order = false;
    for (count, band) in counts.into_iter().zip(bands) {
        let share = count as f64 / SAMPLES as f64;
        let error = (share * (1.0 - share) / SAMPLES as f64).sqrt();
        let found = model.probability(&tolerances, band).unwrap();
        within(found.value, share, 4.0 * error);
        let first = model.probability_first_order(&tolerances, band).unwrap();
        beyond_first_order |= (first - share).abs() > 20.0 * error;
    }
    assert!(beyond_first_order, "the test would not see the curvature");
}

#[test]
fn parts_sum_to_the_whole() {
    let (model, tolerances) = coupled();
    let ends = [-ALL, 5.0, 6.9, 7.0, 7.3, 11.0, ALL];
    let parts = ends.windows(2).map(|pair| {
        let found = model.probability(&tolerances, (pair[0], pair[1]));
        found.unwrap().value
    });
    within(parts.sum(), 1.0, 1e-12);
}

#[test]
fn scale_does_not_matter() {
    let model = diagonal(&[(0.3, 1.0), (0.5, 0.6), (0.2, -0.4)]);
    let expected = chance(&model, (-0.5, 1.5)).value;
    for power in [1e200, 1e-200, 1e-300] {
        let scaled = Quadratic {
            value: 0.0,
            slopes: model.slopes.map(|s| s * power),
            curvature: model.curvature.map(|h| h * power),
        };
        let found = chance(&scaled, (-0.5 * power, 1.5 * power));
        within(found.value, expected, 1e-12);
    }
}

#[test]
fn intervals_at_the_edge_of_sense() {
    let (model, tolerances) = coupled();
    let of = |band| model.probability(&tolerances, band).unwrap().value;
    within(of((-ALL, ALL)), 1.0, 1e-13);
    assert_eq!(of((7.0, 7.0)), 0.0);
    assert_eq!(of((ALL, ALL)), 0.0);
    assert!(of((1e300, ALL)) < 1e-13 && of((-ALL, -1e300)) < 1e-13);
    within(of((-1e308, 1e308)), 1.0, 1e-13);
    for band in [(f64::NAN, 1.0), (0.0, f64::NAN), (2.0, 1.0)] {
        let found = model.probability(&tolerances, band);
        assert!(matches!(found, Err(Error::Setting { .. })));
        let found = model.probability_first_order(&tolerances, band);
        assert!(matches!(found, Err(Error::Setting { .. })));
    }
    // Nothing varies: the nominal value is either inside or outside.
    let still = independent([0.0; 4]);
    let of = |band| model.probability(&still, band).unwrap().value;
    assert_eq!((of((6.0, 8.0)), of((8.0, 9.0)), of((7.0, 8.0))), (1.0, 0.0, 1.0));
    let none = diagonal(&[]);
    assert_eq!(chance(&none, (-1.0, 1.0)).value, 1.0);
}

#[test]
fn hundred_variables_of_low_rank() {
    // One curved direction among a hundred variables: a single square and a normal term.
    let direction: [f64; 100] = core::array::from_fn(|i| 0.1 * if i % 3 == 0 { -1.0 } else { 1.0 });
    let model = Quadratic {
        value: 0.0,
        slopes: Vector::from_fn(100, |i| if i == 7 { 0.5 } else { 0.0 }),
        curvature: Matrix::from_fn(100, 100, |i, j| direction[i] * direction[j]),
    };
    // c = 0.5 * direction[7] = 0.05 along it, the rest of the slope perpendicular to it.
    let rest = (0.25_f64 - 0.0025).sqrt();
    let same = diagonal(&[(0.05, 1.0), (rest, 0.0)]);
    for band in [(-ALL, 0.0), (0.3, 1.0), (2.0, ALL)] {
        within(chance(&model, band).value, chance(&same, band).value, 1e-12);
    }
}

/// Many models with random signs and scales: never outside [0, 1], never NaN, monotonic in the limit, and the parts sum
/// to 1 within the stated errors.
#[test]
fn random_models_stay_sane() {
    let mut normal = Normal(7);
    let mut worst: f64 = 0.0;
    for _ in 0..300 {
        let mut scale = || 10.0_f64.powf(3.0 * normal.next()) * normal.next().signum();
        let terms: [(f64, f64); 3] = core::array::from_fn(|_| (scale(), scale()));
        let model = diagonal(&terms);
        let tolerances = independent([1.0; 3]);
        let sigma = model.moments(&tolerances).unwrap().sigma;
        let mut before = 0.0;
        for k in -6..=6 {
            let y = 0.5 * f64::from(k) * sigma;
            let below = model.probability(&tolerances, (-ALL, y)).unwrap();
            let above = model.probability(&tolerances, (y, ALL)).unwrap();
            for found in [below, above] {
                assert!((0.0..=1.0).contains(&found.value), "{terms:?} {y:e}");
                assert!(found.error >= 0.0, "{terms:?} {y:e}");
            }
            let allowed = below.error + above.error + 1e-15;
            within(below.value + above.value, 1.0, allowed);
            assert!(below.value >= before - 2.0 * allowed, "{terms:?} {y:e}");
            before = below.value;
            worst = worst.max(below.error);
        }
    }
    assert!(worst < 1e-9, "worst stated error {worst:e}");
}
