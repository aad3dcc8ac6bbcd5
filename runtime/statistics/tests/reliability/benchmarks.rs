//! Published problems. RP numbers are those of the reliability benchmark of TNO (Rozsas and Slobbe 2019, *Repository
//! and Black-box Reliability Challenge 2019*), with the formulas of OpenTURNS's `otbenchmark`. Published versions give
//! different probabilities for some problems (RP25: 6.14e-6 and 4.1486e-5; RP28: 1.46e-7 and 1.763e-7; RP14: 7.52e-3).
//! Each is therefore computed here a second time, by integration over one or several variables, and compared with the
//! version that this supports.

use core::convert::Infallible;
use core::f64::consts::{PI, SQRT_2};

use eigentol_statistics::reliability::lines::{LineProbability, LineSettings};
use eigentol_statistics::reliability::{DesignPoint, FormSettings, LimitState, failure_regions};

use crate::common::{below, close, density, design_point, estimate, limit, linear, mean};

fn sampled<L: LimitState>(limit: &L, points: &[DesignPoint]) -> LineProbability {
    let settings = LineSettings { evaluations: 100_000, coefficient_of_variation: 0.015, ..LineSettings::default() };
    let found = estimate(limit, points, &settings);
    assert!(found.settled, "{found:?}");
    found
}

/// Several limits of which any, or all, must be passed for failure.
fn together(
    limits: &[&dyn LimitState<Error = Infallible>],
    of: fn(f64, f64) -> f64,
) -> impl LimitState<Error = Infallible> {
    let dimension = limits[0].dimension();
    limit(dimension, move |z| {
        let values = limits.iter().map(|limit| limit.evaluate(z).map_or(f64::NAN, |found| found.value));
        (values.reduce(of).unwrap_or(f64::NAN), vec![0.0; z.len()])
    })
}

fn regions<L: LimitState>(limit: &L) -> Vec<DesignPoint> {
    failure_regions(limit, &FormSettings::default()).expect("valid").design_points
}

fn off(found: &LineProbability, exact: f64) {
    let distance = (found.probability.value - exact).abs();
    assert!(distance < 4.0 * found.probability.standard_error, "{found:?} {exact}");
}

/// A lognormal variable with this mean and standard deviation, and its derivative by the standard normal variable.
fn lognormal(mean: f64, deviation: f64, z: f64) -> (f64, f64) {
    let zeta = (deviation / mean).powi(2).ln_1p().sqrt();
    let x = (mean.ln() - 0.5 * zeta * zeta + zeta * z).exp();
    (x, zeta * x)
}

#[test]
fn rp8() {
    const FACTORS: [f64; 6] = [1.0, 2.0, 2.0, 1.0, -5.0, -5.0];
    const LAWS: [(f64, f64); 6] =
        [(120.0, 12.0), (120.0, 12.0), (120.0, 12.0), (120.0, 12.0), (50.0, 10.0), (40.0, 8.0)];
    let limit = limit(6, |z| {
        let parts: Vec<(f64, f64)> = FACTORS
            .iter()
            .zip(LAWS)
            .zip(z)
            .map(|((a, (mean, deviation)), z)| {
                let (x, slope) = lognormal(mean, deviation, *z);
                (a * x, a * slope)
            })
            .collect();
        let value = parts.iter().map(|part| part.0).sum();
        (value, parts.iter().map(|part| part.1).collect())
    });
    close(sampled(&limit, &[design_point(&limit)]).probability.value, 0.000784, 0.05);
}

/// Uniform, Gumbel and normal variables.
#[test]
fn rp14() {
    let limit = limit(5, |z| {
        let p = below(z[2]).clamp(1e-300, 1.0 - 1e-16);
        let scale = 350.0 * 6.0_f64.sqrt() / PI;
        let x1 = 70.0 + 10.0 * below(z[0]);
        let x2 = 39.0 + 0.1 * z[1];
        let x3 = 1500.0 - 0.577_215_664_901_532_9 * scale - scale * (-p.ln()).ln();
        let x3_slope = scale * density(z[2]) / (-p.ln() * p);
        let x4 = 400.0 + 0.1 * z[3];
        let x5 = 250_000.0 + 35_000.0 * z[4];
        let root = (x3 * x3 * x4 * x4 / 16.0 + x5 * x5).sqrt();
        let factor = 32.0 / (PI * x2.powi(3));
        let gradient = vec![
            10.0 * density(z[0]),
            0.1 * 3.0 * factor / x2 * root,
            -factor * x3 * x4 * x4 / 16.0 / root * x3_slope,
            -factor * x3 * x3 * x4 / 16.0 / root * 0.1,
            -factor * x5 / root * 35_000.0,
        ];
        (x1 - factor * root, gradient)
    });
    // Given the others, x1 is uniform; x4 hardly varies.
    let range = |number: i32, reach: f64| {
        let step = 2.0 * reach / f64::from(number);
        (0..=number).map(move |k| {
            let z = -reach + f64::from(k) * step;
            (z, step * density(z))
        })
    };
    let mut exact = 0.0;
    for (z3, weight3) in range(160, 8.0) {
        let scale = 350.0 * 6.0_f64.sqrt() / PI;
        let x3 = 1500.0 - 0.577_215_664_901_532_9 * scale - scale * (-below(z3).ln()).ln();
        for (z5, weight5) in range(160, 8.0) {
            let x5 = 250_000.0 + 35_000.0 * z5;
            let root = (x3 * x3 * 1e4 + x5 * x5).sqrt();
            for (z2, weight2) in range(12, 5.0) {
                let stress = 32.0 / (PI * (39.0 + 0.1 * z2).powi(3)) * root;
                exact += weight3 * weight5 * weight2 * (0.1 * (stress - 70.0)).clamp(0.0, 1.0);
            }
        }
    }
    off(&sampled(&limit, &[design_point(&limit)]), exact);
}

/// A paraboloid.
#[test]
fn rp22() {
    let parabola = limit(2, |z| {
        let (sum, difference) = (z[0] + z[1], z[0] - z[1]);
        let value = 2.5 - sum / SQRT_2 + 0.1 * difference * difference;
        let (a, b) = (-1.0 / SQRT_2, 0.2 * difference);
        (value, vec![a + b, a - b])
    });
    let at = design_point(&parabola);
    close(at.beta, 2.5, 1e-12);
    let exact = mean(|v| below(-2.5 - 0.2 * v * v));
    close(exact, 0.004_207_305_511_299_618, 1e-12);
    off(&sampled(&parabola, &[at]), exact);
}

/// A parallel system.
#[test]
fn rp25() {
    let limits: [Box<dyn LimitState<Error = Infallible>>; 2] = [
        Box::new(limit(2, |z| (z[0] * z[0] - 8.0 * z[1] + 16.0, vec![2.0 * z[0], -8.0]))),
        Box::new(limit(2, |z| (-16.0 * z[0] + z[1] + 32.0, vec![-16.0, 1.0]))),
    ];
    let limits = limits.each_ref().map(|limit| limit.as_ref());
    // Given x2, failure occurs for x1 between 2 + x2 / 16 and sqrt(8 x2 - 16).
    let between = |x2: f64| {
        let upper = (8.0 * x2 - 16.0).max(0.0).sqrt();
        (below(upper) - below(2.0 + x2 / 16.0)).max(0.0)
    };
    let exact = mean(between);
    close(exact, 4.148_566_293_759_747e-5, 1e-6);
    off(&sampled(&together(&limits, f64::max), &[]), exact);
}

/// Symmetric in its standard normal variables: two regions share a bend of the limit, and the nearest point of one of
/// them gives half of the answer.
#[test]
fn rp28() {
    let limit = limit(2, |z| {
        let (x1, x2) = (78_064.0 + 11_710.0 * z[0], 0.0104 + 0.00156 * z[1]);
        (x1 * x2 - 146.14, vec![11_710.0 * x2, 0.00156 * x1])
    });
    let exact = mean(|z| {
        let x2 = 0.0104 + 0.00156 * z;
        let below_limit = below((146.14 / x2 - 78_064.0) / 11_710.0);
        if x2 > 0.0 { below_limit } else { 1.0 - below_limit }
    });
    close(exact, 1.46e-7, 5e-3);
    let design_points = regions(&limit);
    assert_eq!(design_points.len(), 2, "{design_points:?}");
    off(&sampled(&limit, &design_points), exact);
}

/// Flat to third order at the design point.
#[test]
fn rp31() {
    let limit = limit(2, |z| (2.0 - z[1] + 256.0 * z[0].powi(4), vec![1024.0 * z[0].powi(3), -1.0]));
    let at = design_point(&limit);
    close(at.beta, 2.0, 1e-9);
    let exact = mean(|x| below(-2.0 - 256.0 * x.powi(4)));
    close(exact, 0.003_226_681_209_587_691, 1e-8);
    off(&sampled(&limit, &[at]), exact);
}

/// A series system of two planes.
#[test]
fn rp33() {
    let limits: [Box<dyn LimitState<Error = Infallible>>; 2] =
        [Box::new(linear(3.0 * 3.0_f64.sqrt(), vec![-1.0; 3])), Box::new(linear(3.0, vec![0.0, 0.0, -1.0]))];
    let limits = limits.each_ref().map(|limit| limit.as_ref());
    let design_points = limits.map(|limit| design_point(&limit));
    let r = 1.0 / 3.0_f64.sqrt();
    let both = |x: f64| match x > 3.0 {
        true => below((r * x - 3.0) / (1.0 - r * r).sqrt()),
        false => 0.0,
    };
    let exact = 2.0 * below(-3.0) - mean(both);
    close(exact, 0.00257, 3e-3);
    off(&sampled(&together(&limits, f64::min), &design_points), exact);
}

/// Several failure regions: not all of them need be found.
#[test]
fn rp53() {
    let limit = limit(2, |z| {
        let (x1, x2) = (1.5 + z[0], 2.5 + z[1]);
        let value = (2.5 * x1).sin() + 2.0 - (x1 * x1 + 4.0) * (x2 - 1.0) / 20.0;
        let by_x1 = 2.5 * (2.5 * x1).cos() - x1 * (x2 - 1.0) / 10.0;
        (value, vec![by_x1, -(x1 * x1 + 4.0) / 20.0])
    });
    let exact = mean(|z| {
        let x1 = 1.5 + z;
        below(1.5 - 20.0 * ((2.5 * x1).sin() + 2.0) / (x1 * x1 + 4.0))
    });
    close(exact, 0.0313, 2e-3);
    let design_points = regions(&limit);
    assert!(design_points.len() >= 2, "{design_points:?}");
    off(&sampled(&limit, &design_points), exact);
}

/// The minimum of a maximum and a ball.
#[test]
fn rp57() {
    let value = |z: &[f64]| {
        let g1 = -z[0] * z[0] + z[1].powi(3) + 3.0;
        let g2 = 2.0 - z[0] - 8.0 * z[1];
        let g3 = (z[0] + 3.0).powi(2) + (z[1] + 3.0).powi(2) - 4.0;
        g1.max(g2).min(g3)
    };
    let found = sampled(&limit(2, move |z| (value(z), vec![0.0; 2])), &[]);
    close(found.probability.value, 0.0284, 0.06);
}

/// Two regions.
#[test]
fn rp75() {
    let limit = limit(2, |z| (3.0 - z[0] * z[1], vec![-z[1], -z[0]]));
    let design_points = regions(&limit);
    assert_eq!(design_points.len(), 2, "{design_points:?}");
    design_points.iter().for_each(|point| close(point.beta, 6.0_f64.sqrt(), 1e-9));
    let exact = mean(|x| if x == 0.0 { 0.0 } else { below(-3.0 / x.abs()) });
    close(exact, 0.009_819_298_721_546_89, 1e-8);
    off(&sampled(&limit, &design_points), exact);
}

#[test]
fn rp107() {
    let at = design_point(&linear(5.0 * 10.0_f64.sqrt(), vec![-1.0; 10]));
    close(at.beta, 5.0, 1e-14);
    close(at.probability(), below(-5.0), 1e-12);
}

/// Steps in the limit states mislead every search that relies on the slope at the origin.
#[test]
fn rp110() {
    let first = limit(2, |z| match z[0] <= 3.5 {
        true => (0.85 - 0.1 * z[0], vec![-0.1, 0.0]),
        false => (4.0 - z[0], vec![-1.0, 0.0]),
    });
    let second = limit(2, |z| match z[1] <= 2.0 {
        true => (2.3 - z[1], vec![0.0, -1.0]),
        false => (0.5 - 0.1 * z[1], vec![0.0, -0.1]),
    });
    let design_points = [design_point(&first), design_point(&second)];
    close(design_points[0].beta, 4.0, 1e-12);
    close(design_points[1].beta, 5.0, 1e-12);
}

/// Four regions.
#[test]
fn rp111() {
    let limit = limit(2, |z| {
        let product = z[0] * z[1];
        let sign = if product < 0.0 { -1.0 } else { 1.0 };
        (12.5 - product.abs(), vec![-sign * z[1], -sign * z[0]])
    });
    let settings = FormSettings { restarts: 12, ..FormSettings::default() };
    let design_points = failure_regions(&limit, &settings).unwrap().design_points;
    assert_eq!(design_points.len(), 4, "{design_points:?}");
    off(&sampled(&limit, &design_points), 8.082_737_356_734_152e-7);
}

/// The series system of Waarts (2000), with four limit states of which two are curved: exact after a rotation by 45
/// degrees.
#[test]
fn four_branches() {
    let curved = |sign: f64| {
        limit(2, move |z| {
            let difference = z[0] - z[1];
            let value = 3.0 + 0.1 * difference * difference - sign * (z[0] + z[1]) / SQRT_2;
            let (a, b) = (-sign / SQRT_2, 0.2 * difference);
            (value, vec![a + b, a - b])
        })
    };
    let straight = |sign: f64| linear(7.0 / SQRT_2, vec![sign, -sign]);
    let limits: [Box<dyn LimitState<Error = Infallible>>; 4] =
        [Box::new(curved(1.0)), Box::new(curved(-1.0)), Box::new(straight(1.0)), Box::new(straight(-1.0))];
    let limits = limits.each_ref().map(|limit| limit.as_ref());
    let exact = mean(|v| match v.abs() < 3.5 {
        true => 2.0 * below(-3.0 - 0.2 * v * v),
        false => 1.0,
    });
    close(exact, 2.22e-3, 0.01);
    let design_points: Vec<DesignPoint> = limits.iter().map(design_point).collect();
    off(&sampled(&together(&limits, f64::min), &design_points), exact);
}
