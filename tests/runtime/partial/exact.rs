//! Sample statistics against the exact distribution of the rotating bar.

use eigentol::Study;
use eigentol_statistics::normal;

use super::Bar;

/// A speed, rad/s, and the standard deviation of the length about 1 m.
struct Exact {
    omega: f64,
    sigma: f64,
}

/// `3 g / 2` of a bar, m/s^2.
const WEIGHT: f64 = 1.5 * 9.81;

impl Exact {
    /// Where the bar hangs down, `f^2 = 3 g / (2 l) - omega^2`; where it is swung out,
    /// `f^2 = omega^2 - (3 g / (2 l omega))^2`. Lengths between the two with frequency `f` have lower frequencies.
    fn cdf(&self, f: f64) -> f64 {
        let square = self.omega * self.omega;
        let shorter = WEIGHT / (square + f * f);
        let longer = if f < self.omega { WEIGHT / (self.omega * (square - f * f).sqrt()) } else { f64::INFINITY };
        let below = |length: f64| normal::cdf((length - 1.0) / self.sigma);
        below(longer) - below(shorter)
    }

    /// By bisection.
    fn quantile(&self, probability: f64) -> f64 {
        let (mut low, mut high) = (0.0, 50.0);
        while high - low > 1e-13 * high {
            let middle = 0.5 * (low + high);
            if self.cdf(middle) < probability {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }

    /// Mean, standard deviation and skewness, by the midpoint rule over the length.
    fn moments(&self) -> [f64; 3] {
        let steps = 100_000;
        let values: Vec<(f64, f64)> = (0..steps)
            .map(|k| {
                let z = -9.0 + 18.0 * (f64::from(k) + 0.5) / f64::from(steps);
                let length = 1.0 + self.sigma * z;
                let square = self.omega * self.omega;
                let hanging = WEIGHT / length - square;
                let out = square - (WEIGHT / (length * self.omega)).powi(2);
                (hanging.max(out).sqrt(), normal::density(z))
            })
            .collect();
        let weight: f64 = values.iter().map(|(_, weight)| weight).sum();
        let mean_of = |power: i32, about: f64| {
            let terms = values.iter().map(|(value, w)| w * (value - about).powi(power));
            terms.sum::<f64>() / weight
        };
        let mean = mean_of(1, 0.0);
        let sigma = mean_of(2, mean).sqrt();
        [mean, sigma, mean_of(3, mean) / sigma.powi(3)]
    }
}

/// Every reported quantity of `samples` is within a few of its own standard errors of the exact distribution.
fn compare(samples: usize) {
    for (omega, tolerance) in [(2.0, 0.03), (3.82, 0.06), (6.0, 0.12)] {
        let exact = Exact { omega, sigma: tolerance / 3.0 };
        let run = Study::new(Bar)
            .input(Bar::omega, omega)
            .start(Bar::theta, 1.0)
            .tolerance(Bar::l, tolerance)
            .samples(samples)
            .seed(3)
            .monte_carlo()
            .unwrap();
        assert_eq!(run.counts.stable, samples);
        assert!(run.side_by_side || omega == 3.82);
        let mode = run.modes[0].as_ref().unwrap();
        let [mean, sigma, skewness] = exact.moments();
        let within = |what: &str, value: f64, exact: f64, error: f64| {
            println!("{omega} {tolerance} {what}: {value} exact {exact} error {error:e}");
            assert!((value - exact).abs() <= 4.0 * error, "{what}: {value} {exact} {error}");
        };
        within("mean", mode.mean, mean, mode.standard_error.unwrap());
        within("sigma", mode.sigma.unwrap(), sigma, mode.sigma_error.unwrap());
        // The error for a normal distribution, times a factor for the tails of these.
        within("skewness", mode.skewness.unwrap(), skewness, 2.0 * mode.skewness_error.unwrap());
        let n = samples as f64;
        for p in [0.001, 0.01, 0.1, 0.5, 0.9, 0.99, 0.999] {
            let (value, truth) = (mode.quantile(p).unwrap(), exact.quantile(p));
            // In terms of the exact distribution: the probability below the reported value.
            let share = exact.cdf(value.value);
            let bucket = exact.cdf(value.value + value.error) - exact.cdf(value.value - value.error);
            within(&format!("share below {truth}"), share, p, (p * (1.0 - p) / n).sqrt() + bucket);
            let below = mode.sketch().unwrap().cdf(truth).unwrap();
            within(&format!("cdf at {truth}"), below.value, p, (p * (1.0 - p) / n).sqrt() + below.error);
        }
    }
}

#[test]
fn statistics_are_those_of_the_exact_distribution() {
    compare(30_000);
}

/// `cargo test --release --test runtime -- --ignored ten_million`.
#[test]
#[ignore = "ten million samples"]
fn ten_million_samples_have_the_exact_distribution() {
    compare(10_000_000);
}
