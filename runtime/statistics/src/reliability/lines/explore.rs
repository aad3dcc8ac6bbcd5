//! Where failures are, before any line counts: how far along the directions in which they are expected, and in which
//! others.

use super::scan::{self, Scanned, Stretch};
use super::{Direction, LineSampler};
use crate::normal;
use crate::reliability::limit_state::LimitState;
use crate::reliability::random::NormalSamples;
use crate::reliability::vector::{add_scaled, dot, norm, scaled, unit};

/// Lines along each direction.
const LINES: u64 = 8;
/// Lines lie this much farther out than the nearest failure known.
const BEYOND: f64 = 1.0;
/// Where none is known, they lie beyond a distance that a variable exceeds this rarely.
const RARE: f64 = 1e-4;
/// A failure is in line with one on a central line if it is this near to it along that line.
const IN_LINE: f64 = 0.5;
/// Directions with a larger cosine are as good as one.
const ALIKE: f64 = 0.98;
/// Failures matter whose density is no less than that of the nearest by this logarithm.
const LESS: f64 = 7.0;
/// Most directions that are added.
const MOST: usize = 4;
/// How far the lines are shifted that show how a limit slopes, and how far they reach from it.
const SHIFT: f64 = 0.3;
const AROUND: f64 = 2.0;
/// Most variables for which slopes are worth their lines.
const MOST_VARIABLES: usize = 10;

/// A direction, of length one, and where designs fail on the line along it through the origin.
struct Central {
    direction: Vec<f64>,
    failing: Vec<Stretch>,
}

impl Central {
    fn distance(&self) -> f64 {
        self.failing.iter().map(|x| nearest(x).abs()).fold(f64::INFINITY, f64::min)
    }

    /// The direction towards failure, and where this begins: nearest to the origin of all places where anything changes.
    fn direction(&self) -> Option<Direction> {
        let changes = self.failing.iter().flat_map(|(from, to)| [(1.0, *from), (-1.0, -to)]);
        let changes = changes.filter(|(_, distance)| distance.is_finite());
        let (sign, distance) = changes.min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
        Some(Direction { along: scaled(sign, &self.direction), distance })
    }

    /// The failure nearest to the origin.
    fn nearest(&self) -> Option<Vec<f64>> {
        let s = self.failing.iter().map(nearest).min_by(|a, b| a.abs().total_cmp(&b.abs()))?;
        Some(scaled(s, &self.direction))
    }

    /// Whether one of two directions is enough.
    fn is_like(&self, other: &Self) -> bool {
        dot(&self.direction, &other.direction).abs() > ALIKE
    }

    /// Whether a point is in line with a failure on the central line.
    fn explains(&self, point: &[f64]) -> bool {
        let s = dot(point, &self.direction);
        self.failing.iter().any(|(from, to): &Stretch| (from - IN_LINE..=to + IN_LINE).contains(&s))
    }
}

/// Explores a limit state along whole lines.
struct Explorer<'a, L> {
    limit: &'a L,
    sampler: &'a LineSampler,
    evaluations: u64,
    /// The variables along which anything changes.
    moving: Vec<usize>,
}

impl LineSampler {
    /// Directions in which failures were found, those expected first; the variables along which anything changes; and the
    /// number of evaluations.
    pub(super) fn explore<L: LimitState>(&self, limit: &L) -> (Vec<Direction>, Vec<usize>, u64) {
        let mut explorer = Explorer { limit, sampler: self, evaluations: 0, moving: Vec::new() };
        let directions = explorer.directions();
        if explorer.moving.is_empty() {
            explorer.moving.clone_from(&self.variables);
        }
        (directions, explorer.moving, explorer.evaluations)
    }

    /// About how many evaluations that takes.
    pub(super) fn cost_of_exploring(&self) -> u64 {
        let lines = self.mixture.count() as u64 * (LINES + 1);
        let slopes = match self.variables.len() {
            few if few <= MOST_VARIABLES => (self.mixture.expected() + MOST) * 2 * few,
            _ => 0,
        };
        let along = |reach: f64| 2.0 * reach / self.spacing();
        (lines as f64 * along(self.settings.reach) + slopes as f64 * along(AROUND)) as u64
    }
}

impl<L: LimitState> Explorer<'_, L> {
    /// The directions in which failure is expected, turned towards it; then, again and again, that of the nearest failure
    /// that is not in line with those known.
    fn directions(&mut self) -> Vec<Direction> {
        let mixture = &self.sampler.mixture;
        let mut known: Vec<Central> = Vec::new();
        for k in 0..mixture.expected() {
            let central = self.central(mixture.direction(k).to_vec());
            let turned = central.nearest().and_then(|point| self.towards(&point));
            let central = turned.map_or(central, |direction| self.central(direction));
            if !known.iter().any(|x| x.is_like(&central)) {
                known.push(central);
            }
        }
        let mut points = self.failures(self.farthest(&known));
        for _ in 0..MOST {
            let central = known.iter().map(Central::distance);
            let least = central.chain(points.iter().map(|point| norm(point))).fold(f64::INFINITY, f64::min);
            points.retain(|point| {
                norm(point).powi(2) <= least * least + 2.0 * LESS && !known.iter().any(|x| x.explains(point))
            });
            let nearest = points.iter().enumerate();
            let nearest = nearest.min_by(|(_, a), (_, b)| norm(a).total_cmp(&norm(b)));
            let Some((index, _)) = nearest else { break };
            let point = points.swap_remove(index);
            let Some(direction) = self.towards(&point) else {
                break;
            };
            let central = self.central(direction);
            if !known.iter().any(|x| x.is_like(&central)) {
                known.push(central);
            }
        }
        known.iter().filter_map(Central::direction).collect()
    }

    /// How far from the origin failures matter: beyond the nearest known one, or where samples hardly lie.
    fn farthest(&self, known: &[Central]) -> f64 {
        let reach = self.sampler.settings.reach;
        let least = (known.iter().map(Central::distance)).fold(f64::INFINITY, f64::min);
        let rare = -normal::quantile(RARE);
        (if least.is_finite() { least } else { rare } + BEYOND).min(reach)
    }

    /// The failures nearest to the origin along lines in all directions, up to a distance away from it.
    fn failures(&mut self, farthest: f64) -> Vec<Vec<f64>> {
        let sampler = self.sampler;
        let LineSampler { settings, variables, .. } = sampler;
        // Numbers that no line of the estimate takes.
        let first = 1 << 60;
        let mut samples = NormalSamples::new(settings.seed, settings.stream, first, variables.len());
        let mut all = Vec::new();
        for k in 0..sampler.mixture.count() {
            let direction = sampler.mixture.direction(k);
            let mut moves = false;
            for _ in 0..LINES {
                let (share, sample) = samples.next_with_choice();
                let across = unit(&sampler.across(sample, direction)).unwrap_or_default();
                let across = scaled(share * farthest, &across);
                let everywhere = (f64::NEG_INFINITY, f64::INFINITY);
                let scanned = self.scan(&across, direction, everywhere);
                moves |= scanned.moves;
                for interval in scanned.failing() {
                    all.push(add_scaled(&across, nearest(&interval), direction));
                }
            }
            if let Some(variable) = k.checked_sub(sampler.mixture.expected()).filter(|_| moves) {
                self.moving.push(variables[variable]);
            }
        }
        all
    }

    /// The direction in which a limit lies that passes near a point.
    fn towards(&mut self, point: &[f64]) -> Option<Vec<f64>> {
        let distance = norm(point);
        let direction = unit(point)?;
        let variables = &self.sampler.variables;
        if variables.len() > MOST_VARIABLES {
            return Some(direction);
        }
        // Along lines in the direction of the point, shifted along each variable to either side.
        let mut normal = direction.clone();
        for &k in variables {
            let [back, ahead] = [-SHIFT, SHIFT].map(|shift| {
                let across = scaled(-shift * direction[k], &direction);
                let across: Vec<f64> =
                    (across.iter().enumerate()).map(|(j, x)| if j == k { x + shift } else { *x }).collect();
                let around = (distance - AROUND, distance + AROUND);
                let places = self.line(&across, &direction, around);
                places.iter().map(|x| nearest(x) - distance).min_by(|a, b| a.abs().total_cmp(&b.abs()))
            });
            normal[k] -= (ahead.unwrap_or(0.0) - back.unwrap_or(0.0)) / (2.0 * SHIFT);
        }
        unit(&normal)
    }

    fn central(&mut self, direction: Vec<f64>) -> Central {
        let origin = vec![0.0; direction.len()];
        let everywhere = (f64::NEG_INFINITY, f64::INFINITY);
        let failing = self.line(&origin, &direction, everywhere);
        Central { direction, failing }
    }

    /// Where designs fail on a line.
    fn line(&mut self, across: &[f64], direction: &[f64], stretch: Stretch) -> Vec<Stretch> {
        self.scan(across, direction, stretch).failing().collect()
    }

    fn scan(&mut self, across: &[f64], direction: &[f64], stretch: Stretch) -> Scanned {
        let value = LineSampler::along(self.limit, across, direction);
        let scanned = scan::scan(value, stretch, self.sampler.settings.reach, self.sampler.spacing());
        self.evaluations += scanned.evaluations;
        scanned
    }
}

/// The place of a stretch that is nearest to the origin.
fn nearest((from, to): &Stretch) -> f64 {
    0.0_f64.clamp(*from, *to)
}
