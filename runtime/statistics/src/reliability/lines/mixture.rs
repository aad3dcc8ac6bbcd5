//! The directions along which lines run, and how a point is weighted that lines of all of them meet.

use core::f64::consts::TAU;

use super::line::{Direction, Line};
use super::scan::{Scanned, Side, Stretch};
use crate::legendre;
use crate::normal;
use crate::reliability::vector::{dot, unit};

/// Lines of a round along each direction in which failure is expected, at least.
const FEWEST_OF_EACH: usize = 4;
/// For so many of them, one runs along a variable, whatever is expected.
const EXPLORED_BY_ONE_OF: usize = 3;
/// The weight of all variables, of which the directions in which failure is expected have nearly one. A point that only
/// lines along variables meet counts for its reciprocal: less, and a few lines that matter are missing from the scatter.
const RARELY: f64 = 0.1;
/// A density less than that of the nearest place of a stretch by this logarithm does not count.
const NEGLIGIBLE: f64 = 40.0;

/// Directions, and the number of lines along each. Every point `z` lies on lines of all directions `n`, met with a density
/// proportional to `exp((n . z)^2 / 2)` times the normal density; they share it in proportion to these densities times
/// weights (the balance heuristic: Veach and Guibas 1995, *Optimally combining sampling techniques for Monte Carlo
/// rendering*), which keeps the sum unbiased and what a line contributes bounded, whatever the directions and weights.
#[derive(Clone, Debug)]
pub(super) struct Mixture {
    /// Of length one: those in which failure is expected, then those of the variables.
    directions: Vec<Vec<f64>>,
    /// The distances at which it is expected.
    distances: Vec<f64>,
    /// Lines of a round along each direction in which failure is expected, then along all variables together.
    round: Vec<usize>,
    /// The weight of each direction where lines of several meet.
    weights: Vec<f64>,
    /// What lines of each group count.
    factors: Vec<f64>,
}

impl Mixture {
    /// Of `variables`, lines run along those `explored`.
    pub(super) fn new(
        dimension: usize,
        (variables, explored): (&[usize], &[usize]),
        directions: &[Direction],
        round: usize,
    ) -> Self {
        let within = |item: &Direction| {
            let mut along = vec![0.0; dimension];
            for &k in variables {
                along[k] = *item.along.get(k)?;
            }
            let distance = item.distance;
            distance.is_finite().then_some((unit(&along)?, distance))
        };
        let mut known: Vec<(Vec<f64>, f64)> = match variables {
            [_] => Vec::new(),
            _ => directions.iter().filter_map(within).collect(),
        };
        known.sort_by(|(_, a), (_, b)| a.total_cmp(b));
        let distances = known.iter().map(|(_, distance)| *distance).collect();
        known.iter_mut().for_each(|(_, distance)| *distance = distance.max(0.0));
        let likely = |distance: f64| (normal::ln_upper(distance) - normal::ln_upper(known[0].1)).exp();
        let sum: f64 = known.iter().map(|(_, distance)| likely(*distance)).sum();
        let lines = round.max(FEWEST_OF_EACH * known.len());
        let spare = (lines - FEWEST_OF_EACH * known.len()) as f64;
        let of_each = |distance: f64| FEWEST_OF_EACH + (spare * likely(distance) / sum) as usize;
        let mut round: Vec<usize> = known.iter().map(|(_, distance)| of_each(*distance)).collect();
        let expected: usize = round.iter().sum();
        let exploring =
            (lines / EXPLORED_BY_ONE_OF).max(FEWEST_OF_EACH - 1).max(if known.is_empty() { lines } else { 0 });
        let all = (expected + exploring) as f64;
        // Of the directions in which failure is expected by their lines; of the variables, to which nothing is left where
        // the others look, little.
        let mut weights: Vec<f64> = round.iter().map(|count| *count as f64 / all).collect();
        let rarely = if known.is_empty() { 1.0 } else { RARELY };
        weights.extend(explored.iter().map(|_| rarely / explored.len() as f64));
        let mut factors: Vec<f64> = round.iter().map(|_| 1.0).collect();
        factors.push(rarely * all / exploring as f64);
        round.push(exploring);
        let mut directions: Vec<Vec<f64>> = known.into_iter().map(|(along, _)| along).collect();
        for &k in explored {
            let mut direction = vec![0.0; dimension];
            direction[k] = 1.0;
            directions.push(direction);
        }
        Self { directions, distances, round, weights, factors }
    }

    /// Number of directions.
    pub(super) fn count(&self) -> usize {
        self.directions.len()
    }

    /// Number of directions in which failure is expected: the first ones.
    pub(super) fn expected(&self) -> usize {
        self.round.len() - 1
    }

    pub(super) fn direction(&self, index: usize) -> &[f64] {
        &self.directions[index]
    }

    /// The group of directions to which each line of a round belongs.
    pub(super) fn groups(&self) -> impl Iterator<Item = usize> {
        self.round.iter().enumerate().flat_map(|(group, count)| core::iter::repeat_n(group, *count))
    }

    /// A direction of a group, by a number in (0, 1).
    pub(super) fn pick(&self, group: usize, choice: f64) -> &[f64] {
        let among = if group < self.expected() { 1 } else { self.count() - self.expected() };
        self.direction(group + (choice * among as f64) as usize)
    }

    /// What a line through a point contributes.
    pub(super) fn weigh(&self, group: usize, scanned: &Scanned, across: &[f64], direction: &[f64]) -> Line {
        let along = self.directions.iter().zip(&self.weights);
        let along: Vec<[f64; 3]> =
            along.map(|(other, weight)| [weight.ln(), dot(other, across), dot(other, direction)]).collect();
        let density = |t: f64| {
            self.factors[group]
                / (TAU.sqrt()
                    * along
                        .iter()
                        .map(|[weight, start, slope]| {
                            let place = start + slope * t;
                            (weight + 0.5 * place * place).exp()
                        })
                        .sum::<f64>())
        };
        let whole = |(from, to): Stretch| {
            let far = 0.0_f64.clamp(from, to).hypot((2.0 * NEGLIGIBLE).sqrt());
            let (from, to) = (from.max(-far), to.min(far));
            let panels = (to - from).ceil().max(1.0) as usize;
            legendre::composite((from, to), panels, density)
        };
        let sum = |wanted: Side| {
            scanned.stretches.iter().filter(|x| x.2 == wanted).map(|(from, to, _)| whole((*from, *to))).sum::<f64>()
        };
        let (fails, without_value) = (sum(Side::Fails), sum(Side::WithoutValue));
        let mut known = vec![fails + without_value + sum(Side::Safe) - 1.0];
        for (distance, [_, start, slope]) in self.distances.iter().zip(&along) {
            let place = (distance - start) / slope;
            let beyond = match *slope {
                slope if slope > 0.0 => whole((place, f64::INFINITY)),
                slope if slope < 0.0 => whole((f64::NEG_INFINITY, place)),
                _ => whole((f64::NEG_INFINITY, f64::INFINITY)) * f64::from(u8::from(start >= distance)),
            };
            known.push(beyond - normal::cdf(-distance));
        }
        Line { fails, without_value, known, group, evaluations: scanned.evaluations }
    }
}
