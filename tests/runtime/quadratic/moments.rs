//! Mean, standard deviation, skewness and kurtosis; the measure of nonlinearity.

use eigentol::second_order::Quadratic;
use eigentol::{Error, Matrix, Tolerances, Vector};

use super::{close, coupled, factor, independent, spread, value_at};

/// Points and weights of Gauss-Hermite quadrature for the standard normal, exact to degree 9 (Abramowitz and Stegun
/// 25.4.46).
fn gauss_hermite() -> [(f64, f64); 5] {
    let (inner, outer) = (10.0_f64.sqrt(), 5.0);
    let (near, far) = ((outer - inner).sqrt(), (outer + inner).sqrt());
    let (heavy, light) = ((7.0 + 2.0 * inner) / 60.0, (7.0 - 2.0 * inner) / 60.0);
    [(-far, light), (-near, heavy), (0.0, 8.0 / 15.0), (near, heavy), (far, light)]
}

#[test]
fn moments_are_those_of_quadrature() {
    let (model, tolerances) = coupled();
    let lower = factor(&tolerances);
    let rule = gauss_hermite();
    let expectation = |g: &dyn Fn(f64) -> f64| {
        let points = (0..625).map(|e| [e % 5, e / 5 % 5, e / 25 % 5, e / 125]);
        points
            .map(|k| {
                let weight: f64 = k.iter().map(|&k| rule[k].1).product();
                weight * g(value_at(&model, &spread(&lower, &k.map(|k| rule[k].0))))
            })
            .sum::<f64>()
    };
    let mean = expectation(&|f| f);
    let sigma = expectation(&|f| (f - mean).powi(2)).sqrt();
    let moments = model.moments(&tolerances).unwrap();
    close(moments.mean, mean, 1e-14);
    close(moments.mean_shift, mean - 7.0, 1e-12);
    close(moments.sigma, sigma, 1e-13);
    // Degree 8 is within the exactness of the rule.
    let standard = |power: i32| expectation(&|f| ((f - mean) / sigma).powi(power));
    close(moments.skewness, standard(3), 1e-12);
    close(moments.excess_kurtosis, standard(4) - 3.0, 1e-12);
    close(moments.first_order_sigma, tolerances.sigma(&model.slopes), 1e-14);
    let parts = moments.first_order_sigma.hypot(moments.curvature_sigma);
    close(moments.sigma, parts, 1e-14);
}

#[test]
fn chi_square_has_its_known_moments() {
    // z1^2 + z2^2 + z3^2: mean 3, variance 6, skewness sqrt(8/3), excess kurtosis 4.
    let mut curvature = [[0.0; 3]; 3];
    (0..3).for_each(|i| curvature[i][i] = 2.0);
    let model = Quadratic { value: 0.0, slopes: [0.0; 3].into(), curvature: curvature.into() };
    let moments = model.moments(&independent([1.0; 3])).unwrap();
    close(moments.mean, 3.0, 1e-15);
    close(moments.sigma, 6.0_f64.sqrt(), 1e-15);
    close(moments.skewness, (8.0_f64 / 3.0).sqrt(), 1e-15);
    close(moments.excess_kurtosis, 4.0, 1e-15);
}

/// From 80-digit arithmetic: gradient, Hessian, first-order sigma, and second-order mean shift and sigma.
#[test]
fn moments_of_the_pendulums_match_reference() {
    // Single pendulum at 4.5 rad/s by length and speed.
    let single = Quadratic {
        value: 3.091_455_967_663_133_5,
        slopes: [3.458_855_669_253_761, 2.224_259_401_371_256_7].into(),
        curvature: [
            [-14.246_485_475_263_3, -4.025_867_542_836_738],
            [-4.025_867_542_836_738, -1.789_274_463_482_994_5],
        ]
        .into(),
    };
    let tolerances = Tolerances::new([0.03; 2], 3.0, None).unwrap();
    let moments = single.moments(&tolerances).unwrap();
    close(moments.first_order_sigma, 0.041_123_001_380_392_1, 1e-14);
    close(moments.mean_shift, -0.000_801_787_996_937_314_8, 1e-13);
    close(moments.sigma, 0.041_137_502_815_362_624, 1e-14);
    // Second mode of the double pendulum at rest by lengths and masses.
    let double = Quadratic {
        value: 7.188_670_870_287_714,
        slopes: [-1.457_534_942_931_293_6, -2.136_800_492_212_563, -0.406_791_183_257_948_4, 0.406_791_183_257_948_4]
            .into(),
        curvature: [
            [2.899_317_239_751_564_3, -0.713_014_825_354_624, 0.064_284_105_986_698_93, -0.064_284_105_986_698_93],
            [-0.713_014_825_354_624, 3.918_215_563_673_469, 0.139_111_485_642_275_27, -0.139_111_485_642_275_27],
            [0.064_284_105_986_698_93, 0.139_111_485_642_275_27, 0.127_507_866_899_861_38, 0.008_089_194_186_121_427],
            [-0.064_284_105_986_698_93, -0.139_111_485_642_275_27, 0.008_089_194_186_121_427, -0.143_686_255_272_104_2],
        ]
        .into(),
    };
    let tolerances = Tolerances::new([0.03, 0.03, 0.09, 0.09], 3.0, None).unwrap();
    let moments = double.moments(&tolerances).unwrap();
    close(moments.first_order_sigma, 0.031_094_931_508_785_822, 1e-14);
    close(moments.mean_shift, 0.000_333_596_365_403_742_4, 1e-13);
    close(moments.sigma, 0.031_097_232_481_812_825, 1e-14);
}

#[test]
fn nonlinearity_compares_the_orders() {
    let model = Quadratic { value: 1.0, slopes: [2.0].into(), curvature: [[3.0]].into() };
    let small = model.nonlinearity(&independent([0.1])).unwrap();
    // Shift 3 * 0.01 / 2 and standard deviation 3 * 0.01 / sqrt(2), both over 0.2.
    close(small.mean_shift, 0.075, 1e-14);
    close(small.spread, 0.03 / 2.0_f64.sqrt() / 0.2, 1e-14);
    close(small.largest(), small.spread, 1e-15);
    let sigma = model.moments(&independent([0.1])).unwrap();
    close(small.sigma_error(), 1.0 - sigma.first_order_sigma / sigma.sigma, 1e-12);
    let flat = Quadratic { slopes: [0.0].into(), ..model.clone() };
    let flat = flat.nonlinearity(&independent([0.1])).unwrap();
    assert!(flat.mean_shift.is_infinite() && flat.spread.is_infinite());
    assert_eq!(flat.sigma_error(), 1.0);
    let nothing = model.nonlinearity(&independent([0.0])).unwrap();
    assert_eq!((nothing.mean_shift, nothing.spread), (0.0, 0.0));
    assert_eq!(nothing.sigma_error(), 0.0);
}

#[test]
fn extreme_scales_keep_their_digits() {
    let ordinary = Quadratic { value: 0.0, slopes: [1.0, -2.0].into(), curvature: [[0.5, 0.2], [0.2, -0.7]].into() };
    let expected = ordinary.moments(&independent([0.3, 0.4])).unwrap();
    for power in [1e200, 1e-200, 1e300] {
        let scaled = Quadratic {
            value: 0.0,
            slopes: ordinary.slopes.map(|s| s * power),
            curvature: ordinary.curvature.map(|h| h * power),
        };
        let moments = scaled.moments(&independent([0.3, 0.4])).unwrap();
        close(moments.sigma, expected.sigma * power, 1e-14);
        close(moments.mean, expected.mean * power, 1e-14);
        close(moments.skewness, expected.skewness, 1e-13);
        close(moments.excess_kurtosis, expected.excess_kurtosis, 1e-13);
    }
    // Design variables of scale 1e-160 and 1e160 together.
    let mixed =
        Quadratic { value: 0.0, slopes: [1e160, -2e-160].into(), curvature: [[0.0, 0.2], [0.2, -0.7e-320]].into() };
    let moments = mixed.moments(&independent([0.3e-160, 0.4e160])).unwrap();
    let plain = Quadratic { value: 0.0, slopes: [1.0, -2.0].into(), curvature: [[0.0, 0.2], [0.2, -0.7]].into() };
    let expected = plain.moments(&independent([0.3, 0.4])).unwrap();
    // -0.7e-320 is subnormal, with three digits.
    close(moments.sigma, expected.sigma, 1e-3);
    close(moments.skewness, expected.skewness, 1e-2);
}

#[test]
fn what_is_not_finite_is_refused() {
    let model = Quadratic { value: 1.0, slopes: [1.0].into(), curvature: [[1.0]].into() };
    let tolerances = independent([1.0]);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for broken in [
            Quadratic { value: bad, ..model.clone() },
            Quadratic { slopes: [bad].into(), ..model.clone() },
            Quadratic { curvature: [[bad]].into(), ..model.clone() },
        ] {
            assert!(matches!(broken.moments(&tolerances), Err(Error::NotFinite { .. })));
        }
    }
    let huge = Quadratic { slopes: [1e200].into(), ..model.clone() };
    let wide = independent([1e200]);
    assert!(matches!(huge.moments(&wide), Err(Error::Setting { .. })));
}

#[test]
fn nothing_varies() {
    let none = Quadratic { value: 5.0, slopes: Vector::zeros(0), curvature: Matrix::zeros(0, 0) };
    let moments = none.moments(&independent(Vector::zeros(0))).unwrap();
    assert_eq!((moments.mean, moments.sigma, moments.skewness), (5.0, 0.0, 0.0));
    let (model, _) = coupled();
    let moments = model.moments(&independent([0.0; 4])).unwrap();
    assert_eq!((moments.mean, moments.sigma, moments.excess_kurtosis), (7.0, 0.0, 0.0));
}

#[test]
fn fully_correlated_variables_act_as_one() {
    let model = Quadratic { value: 0.0, slopes: [1.0, 2.0].into(), curvature: [[0.5, 0.1], [0.1, -0.3]].into() };
    let one = Tolerances::new([0.2, 0.4], 1.0, Some([[1.0; 2]; 2].into())).unwrap();
    let together = model.moments(&one).unwrap();
    // x = (0.2, 0.4) z: slope 1, curvature 0.5 * 0.04 + 2 * 0.1 * 0.08 - 0.3 * 0.16.
    let single = Quadratic { value: 0.0, slopes: [1.0].into(), curvature: [[0.02 + 0.016 - 0.048]].into() };
    let expected = single.moments(&independent([1.0])).unwrap();
    close(together.sigma, expected.sigma, 1e-14);
    close(together.mean, expected.mean, 1e-13);
    close(together.skewness, expected.skewness, 1e-12);
}
