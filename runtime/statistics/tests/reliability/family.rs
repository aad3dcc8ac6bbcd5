//! A family of machines: responses of two variables of any distribution, dependent or not, among others that do not
//! matter; limits, bands to stay in and bands to stay out of, with probabilities from 1e-6 to 1 - 1e-6. How often the
//! interval holds the exact value, by integration over both variables.

use core::convert::Infallible;
use core::f64::consts::TAU;

use eigentol_statistics::normal::{cdf, density};
use eigentol_statistics::random::RandomNumbers;
use eigentol_statistics::reliability::lines::LineSettings;
use eigentol_statistics::reliability::{FormSettings, LimitFunction, LimitState, LimitValue, failure_regions};
use eigentol_statistics::{Distribution, Joint};

use crate::common::estimate;

/// Nodes and weights of Gauss-Legendre quadrature on (-1, 1), symmetric.
const NODES: [(f64, f64); 2] =
    [(0.339_981_043_584_856, 0.652_145_154_862_546), (0.861_136_311_594_053, 0.347_854_845_137_454)];

/// A machine and what is required of it.
struct Machine {
    joint: Joint,
    /// Variables without effect.
    extra: usize,
    kind: usize,
    c: f64,
    low: f64,
    high: f64,
    outside: bool,
}

impl Machine {
    /// The response and its derivatives.
    fn response(&self, x: &[f64]) -> (f64, [f64; 2]) {
        let (a, b, c) = (x[0], x[1], self.c);
        match self.kind {
            0 => (a + c * b, [1.0, c]),
            1 => (a * a + c * b, [2.0 * a, c]),
            2 => ((a - 1.0).powi(2) + c * (b - 1.0).powi(2), [2.0 * (a - 1.0), 2.0 * c * (b - 1.0)]),
            // A frequency of stiffness and mass.
            3 => {
                let (a, b) = (a.max(1e-9), b.max(1e-9));
                let root = (a / b).sqrt();
                (root, [0.5 * root / a, -0.5 * root / b])
            }
            4 => ((a - 1.0) * (b - 1.0), [b - 1.0, a - 1.0]),
            // The lower of two coupled frequencies.
            5 => {
                let (mean, half) = (0.5 * (a + b), 0.5 * (a - b));
                let root = (half * half + 0.01 * c).sqrt();
                (mean - root, [0.5 - 0.5 * half / root, 0.5 + 0.5 * half / root])
            }
            // An amplitude near a resonance.
            _ => {
                let off = a - 1.15;
                let square = off * off + (0.05 * b).powi(2);
                let amplitude = square.sqrt().recip();
                (amplitude, [-amplitude / square * off, -amplitude / square * 0.0025 * b])
            }
        }
    }

    /// Distance from failure, and its derivative by the response.
    fn distance(&self, response: f64) -> (f64, f64) {
        let (above, below) = (response - self.low, self.high - response);
        let slope = if above < below { 1.0 } else { -1.0 };
        match self.outside {
            true => (-above.min(below), -slope),
            false => (above.min(below), slope),
        }
    }

    fn design(&self, z: &[f64]) -> [f64; 2] {
        let mut design = [0.0; 2];
        self.joint.from_normal(&z[..2], &mut design);
        design
    }

    fn value(&self, z: &[f64]) -> f64 {
        self.distance(self.response(&self.design(z)).0).0
    }

    fn limit(&self) -> impl LimitState<Error = Infallible> + '_ {
        LimitFunction::new(2 + self.extra, move |z: &[f64]| {
            let (response, by) = self.response(&self.design(z));
            let (value, slope) = self.distance(response);
            let mut gradient = vec![0.0; z.len()];
            self.joint.gradient_by_normal(&z[..2], &by.map(|by| by * slope), &mut gradient[..2]);
            Ok(LimitValue { value, gradient })
        })
    }

    /// The probabilities of failure and of its opposite: quadrature over one variable, halved where it is not smooth, of
    /// all changes along the other.
    fn exact(&self) -> [f64; 2] {
        let panel = |from: f64, to: f64| {
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            let mut sums = [0.0; 2];
            for (node, weight) in NODES {
                for z in [middle - half * node, middle + half * node] {
                    let parts = self.along(z);
                    let weight = half * weight * density(z);
                    sums = [sums[0] + weight * parts[0], sums[1] + weight * parts[1]];
                }
            }
            sums
        };
        let add = |a: [f64; 2], b: [f64; 2]| [a[0] + b[0], a[1] + b[1]];
        let quarters = (-32..32).map(|k| [f64::from(k) * 0.25, f64::from(k + 1) * 0.25]);
        let mut open: Vec<([f64; 2], [f64; 2], u32)> =
            quarters.map(|ends| (ends, panel(ends[0], ends[1]), 0)).collect();
        let rough = open.iter().fold([0.0; 2], |sum, part| add(sum, part.1));
        let mut sums = [0.0; 2];
        while let Some(([from, to], whole, depth)) = open.pop() {
            let middle = 0.5 * (from + to);
            let (one, two) = (panel(from, middle), panel(middle, to));
            let both = add(one, two);
            let off = |k: usize| (both[k] - whole[k]).abs() / rough[k].max(1e-9);
            if depth < 8 && off(0).max(off(1)) > 3e-4 {
                open.push(([from, middle], one, depth + 1));
                open.push(([middle, to], two, depth + 1));
            } else {
                sums = add(sums, both);
            }
        }
        sums
    }

    /// Both bounds are looked for by themselves: between them there may be next to nothing.
    fn along(&self, first: f64) -> [f64; 2] {
        let response = |s: f64| self.response(&self.design(&[first, s])).0;
        let place = |k: u32| -8.0 + f64::from(k) * 0.1;
        let responses: Vec<f64> = (0..=160).map(|k| response(place(k))).collect();
        let mut ends = vec![f64::NEG_INFINITY, f64::INFINITY];
        for bound in [self.low, self.high] {
            for k in (1..=160).filter(|k| (responses[*k - 1] > bound) != (responses[*k] > bound)) {
                let (mut near, mut far) = (place(k as u32 - 1), place(k as u32));
                for _ in 0..40 {
                    let middle = 0.5 * (near + far);
                    *(if (response(middle) > bound) == (responses[k - 1] > bound) { &mut near } else { &mut far }) =
                        middle;
                }
                ends.push(near);
            }
        }
        ends.sort_by(f64::total_cmp);
        let mut parts = [0.0; 2];
        for part in ends.windows(2) {
            let (from, to) = (part[0], part[1]);
            let probability = if from > 0.0 { cdf(-from) - cdf(-to) } else { cdf(to) - cdf(from) };
            let middle = 0.5 * (from.clamp(-8.5, 8.5) + to.clamp(-8.5, 8.5));
            parts[usize::from(self.value(&[first, middle]) > 0.0)] += probability;
        }
        parts
    }
}

fn law(random: &mut RandomNumbers, kind: usize) -> Distribution {
    let s = 0.05 + 0.15 * random.probability();
    match kind {
        0 | 1 => Distribution::normal(1.0, s),
        2 => Distribution::uniform(1.0 - 1.7 * s, 1.0 + 1.7 * s),
        3 => Distribution::triangular(1.0 - 2.0 * s, 1.0 + s, 1.0 + 2.0 * s),
        4 => Distribution::truncated_normal(1.0, s, (1.0 - 2.0 * s, 1.0 + 3.0 * s)),
        5 => Distribution::lognormal(1.0, s),
        6 => Distribution::weibull_by_moments(1.0, s),
        _ => Distribution::beta((2.0, 3.0), (1.0 - 2.0 * s, 1.0 + 2.0 * s)),
    }
    .expect("a distribution")
}

/// The machine of a trial, and the probabilities of its failure and of its opposite.
fn machine(random: &mut RandomNumbers, trial: usize) -> Machine {
    let [first, second] = [0, 1].map(|_| (random.probability() * 8.0) as usize);
    let laws = vec![law(random, first), law(random, second)];
    let rho = if random.probability() < 0.3 { 1.6 * random.probability() - 0.8 } else { 0.0 };
    let mut machine = Machine {
        joint: Joint::correlated(laws, &[1.0, rho, rho, 1.0]).expect("a correlation"),
        extra: (random.probability() * 4.0) as usize,
        kind: trial % 7,
        c: 0.3 + random.probability(),
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
        outside: random.probability() < 0.5,
    };
    let [one, two] = [0, 1].map(|_| {
        let (radius, angle) = (4.9 * random.probability(), TAU * random.probability());
        machine.response(&machine.design(&[radius * angle.cos(), radius * angle.sin()])).0
    });
    match random.probability() {
        share if share < 0.35 => machine.low = one,
        share if share < 0.7 => machine.high = one,
        _ => (machine.low, machine.high) = (one.min(two), one.max(two)),
    }
    machine
}

/// Intervals that hold the exact value, below and above it, and those off by more than four standard errors and a tenth.
fn family(trials: usize, evaluations: u64) -> [usize; 5] {
    let mut random = RandomNumbers::starting_at(59, 3, 0);
    let mut tally = [0; 5];
    for trial in 0..trials {
        let machine = machine(&mut random, trial);
        let [exact, opposite] = machine.exact();
        assert!((exact + opposite - 1.0).abs() < 1e-6, "{exact} {opposite}");
        let rarer = exact.min(opposite);
        if rarer < 8e-7 {
            continue;
        }
        let limit = machine.limit();
        let found = failure_regions(&limit, &FormSettings::default());
        let points = found.map(|found| found.design_points).unwrap_or_default();
        let settings = LineSettings { seed: trial as u64, evaluations, ..LineSettings::default() };
        let found = estimate(&limit, &points, &settings);
        if !found.settled {
            tally[4] += 1;
            continue;
        }
        let off = found.probability.value - exact;
        let error = found.probability.standard_error;
        // The exact value is itself known to a few parts in ten thousand.
        let half = 1.96 * error + 5e-4 * rarer;
        tally[1 + usize::from(off > half) - usize::from(off < -half)] += 1;
        tally[3] += usize::from(off.abs() > 4.0 * error + 0.1 * rarer);
    }
    tally
}

#[test]
fn intervals_hold_the_exact_value() {
    let [below, inside, above, wrong, open] = family(28, 20_000);
    let claimed = below + inside + above;
    assert!(wrong == 0 && open <= 2 && claimed > 20, "{below} {inside} {above} {wrong} {open}");
    assert!(below + above <= 4, "{below} {inside} {above}");
}

/// As many as a comparison of methods needs.
#[test]
#[ignore = "minutes without optimisation"]
fn intervals_of_400_machines_hold_the_exact_value() {
    for evaluations in [3_000, 20_000] {
        let [below, inside, above, wrong, open] = family(400, evaluations);
        println!("{evaluations}: {below} {inside} {above}, wrong {wrong}, open {open}");
        let claimed = (below + inside + above) as f64;
        assert!(wrong == 0 && (below + above) as f64 <= 0.07 * claimed, "{below} {inside} {above} {wrong} {open}");
    }
}
