//! How often intervals of lines hold the exact probability, and on which side the others lie.

use eigentol_statistics::normal::{cdf, density};
use eigentol_statistics::random::RandomNumbers;
use eigentol_statistics::reliability::LimitState;
use eigentol_statistics::reliability::lines::{Direction, LineSampler, LineSettings};

use crate::common::limit;

/// Intervals below the exact value, that hold it, and above it.
#[derive(Debug, Default)]
struct Tally([u32; 3]);

impl Tally {
    /// Lines through a limit, along directions, as a command draws them.
    fn add<L: LimitState>(&mut self, limit: &L, directions: &[Direction], seed: u64, exact: f64) {
        let dimension = limit.dimension();
        let variables: Vec<usize> = (0..dimension).collect();
        let settings = LineSettings { seed, evaluations: 20_000, ..LineSettings::default() };
        let sampler = LineSampler::new(dimension, &variables, directions, &settings);
        let sampler = sampler.expect("valid settings");
        let found = sampler.run(limit);
        if !found.settled {
            // Plain samples tell more, but too few of these fail: more of them have to be asked for.
            assert!(found.lines == 0 && exact < 0.01, "{found:?} {exact}");
            return;
        }
        assert!((0.0..=1.0).contains(&found.probability.value), "{found:?}");
        let off = found.probability.value - exact;
        let half = 1.96 * found.probability.standard_error;
        let side = 1 + i32::from(off > half) - i32::from(off < -half);
        self.0[side as usize] += 1;
    }

    /// 95 % within what so many trials show, and no more on one side than on the other.
    fn check(&self, what: &str) {
        let [below, inside, above] = self.0.map(f64::from);
        let all = below + inside + above;
        let scatter = 3.0 * (0.05 * all).sqrt();
        assert!(inside > 0.94 * all - scatter, "{what}: {self:?}");
        assert!((below - above).abs() < 0.01 * all + scatter, "{what}: {self:?}");
    }
}

fn normal(random: &mut RandomNumbers) -> f64 {
    eigentol_statistics::normal::quantile(random.probability())
}

fn unit(random: &mut RandomNumbers, dimension: usize) -> Vec<f64> {
    let all: Vec<f64> = (0..dimension).map(|_| normal(random)).collect();
    let length = all.iter().map(|x| x * x).sum::<f64>().sqrt();
    all.iter().map(|x| x / length).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn toward(along: &[f64], distance: f64) -> Direction {
    Direction { along: along.to_vec(), distance }
}

/// Planes on either side of the origin, from 1e-6 to 1 - 1e-6.
#[test]
fn straight_limits() {
    let mut random = RandomNumbers::starting_at(58, 6, 0);
    let mut tally = Tally::default();
    for trial in 0..1000 {
        let dimension = 2 + (random.probability() * 5.0) as usize;
        let along = unit(&mut random, dimension);
        let beta = 9.5 * random.probability() - 4.75;
        let plane = limit(dimension, |z| (beta - dot(&along, z), vec![0.0; dimension]));
        tally.add(&plane, &[toward(&along, beta)], trial, cdf(-beta));
    }
    tally.check("straight");
}

/// A paraboloid in random directions, bent towards the origin or away from it.
#[test]
fn curved_limits() {
    let mut random = RandomNumbers::starting_at(58, 7, 0);
    let mut tally = Tally::default();
    for trial in 0..300 {
        let dimension = 2 + (random.probability() * 5.0) as usize;
        let along = unit(&mut random, dimension);
        let other = unit(&mut random, dimension);
        let part = dot(&along, &other);
        let across: Vec<f64> = (along.iter().zip(&other)).map(|(a, b)| b - part * a).collect();
        let length = dot(&across, &across).sqrt();
        let beta = 4.0 * random.probability();
        let curvature = (0.8 * random.probability() - 0.3) / beta.max(1.0);
        let sign = if random.probability() < 0.5 { 1.0 } else { -1.0 };
        let value = |z: &[f64]| {
            let u = dot(&across, z) / length;
            sign * (beta - dot(&along, z) + 0.5 * curvature * u * u)
        };
        let steps = (-9000..9000).map(|k| (f64::from(k) + 0.5) * 1e-3);
        let beyond: f64 = steps.map(|u| 1e-3 * density(u) * cdf(-beta - 0.5 * curvature * u * u)).sum();
        let exact = if sign > 0.0 { beyond } else { 1.0 - beyond };
        let paraboloid = limit(dimension, |z| (value(z), vec![0.0; dimension]));
        tally.add(&paraboloid, &[toward(&along, sign * beta)], trial, exact);
    }
    tally.check("curved");
}

/// Bands and ends of sums of uniform variables, whose ends are flat, among variables that do not matter.
#[test]
fn bands_of_flat_distributions() {
    let mut random = RandomNumbers::starting_at(58, 8, 0);
    let mut tally = Tally::default();
    for trial in 0..200 {
        let (a, b) = (1.0, 0.3 + random.probability());
        let low = (a + b) * (0.1 + 0.8 * random.probability());
        let high = match trial % 2 {
            0 => low + 10.0_f64.powf(-3.0 * random.probability() - 0.5),
            _ => a + b + 1.0,
        };
        let steps = (0..20_000).map(|k| (f64::from(k) + 0.5) / 20_000.0);
        let share = |u: f64| {
            let [from, to] = [low, high].map(|end| ((end - a * u) / b).clamp(0.0, 1.0));
            to - from
        };
        let exact = steps.map(share).sum::<f64>() / 20_000.0;
        let value = |z: &[f64]| {
            let sum = a * cdf(z[1]) + b * cdf(z[3]);
            (low - sum).max(sum - high)
        };
        let band = limit(5, |z| (value(z), vec![0.0; 5]));
        let directions = [toward(&[0.0, a, 0.0, b, 0.0], (low - 0.5 * (a + b)) / 0.4)];
        tally.add(&band, &directions, trial, exact);
    }
    tally.check("flat");
}
