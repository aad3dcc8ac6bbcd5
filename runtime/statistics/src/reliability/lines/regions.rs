//! The regions in which lines run: the space is divided among directions.

use super::line::Direction;
use super::scan::Stretch;
use crate::normal;
use crate::reliability::vector::{dot, unit};

/// A nearer failure is expected everywhere.
const NEAR: f64 = 0.5;
/// Directions with a larger cosine are one.
const SAME: f64 = 1.0 - 1e-9;
/// At most this share of the failures beyond the nearest plane belongs to variables where nothing is expected.
const RARE: f64 = 0.05;

/// A region: the points that lie farther along its direction, in units of its distance, than along any other.
#[derive(Clone, Debug)]
struct Region {
    /// Of length one.
    direction: Vec<f64>,
    distance: f64,
}

/// The regions of directions in which failure is expected, then those of variables, which are explored.
#[derive(Clone, Debug)]
pub(super) struct Regions {
    all: Vec<Region>,
    expected: usize,
}

impl Regions {
    pub(super) fn new(dimension: usize, variables: &[usize], directions: &[Direction]) -> Self {
        let within = |item: &Direction| {
            let mut along = vec![0.0; dimension];
            for &k in variables {
                along[k] = *item.along.get(k)?;
            }
            Some(Region {
                direction: unit(&along)?,
                distance: item.distance.max(NEAR),
            })
        };
        let mut all: Vec<Region> = directions.iter().filter_map(within).collect();
        all.retain(|x| x.distance.is_finite());
        all.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        let nearest = all.first().map_or(NEAR, |x| x.distance);
        let rare = -normal::quantile(0.5 * RARE / variables.len() as f64);
        let known = all.len();
        let mut expected = known;
        all.extend(variables.iter().map(|k| {
            let mut direction = vec![0.0; dimension];
            direction[*k] = 1.0;
            Region {
                direction,
                // No component of a point of the plane exceeds this more often.
                distance: nearest.hypot(rare),
            }
        }));
        let mut apart: Vec<Region> = Vec::new();
        for (k, region) in all.into_iter().enumerate() {
            let same = |other: &Region| dot(&other.direction, &region.direction).abs() > SAME;
            if !apart.iter().any(same) {
                apart.push(region);
            } else if k < known {
                expected -= 1;
            }
        }
        Self {
            all: apart,
            expected,
        }
    }

    pub(super) fn count(&self) -> usize {
        self.all.len()
    }

    /// Number of regions in which failure is expected: the first ones.
    pub(super) fn expected(&self) -> usize {
        self.expected
    }

    /// The direction of a region, of length one.
    pub(super) fn direction(&self, region: usize) -> &[f64] {
        &self.all[region].direction
    }

    /// The parts of a line along the direction of a region, through this point across it, that lie in the region.
    pub(super) fn stretches(&self, region: usize, across: &[f64]) -> [Stretch; 2] {
        let this_region = &self.all[region];
        // Along `t >= 0` in one sense or the other.
        let half = |sign: f64| {
            let mut stretch = (0.0, f64::INFINITY);
            for (k, other) in self.all.iter().enumerate() {
                if k != region {
                    let start = dot(&other.direction, across);
                    let slope = sign * dot(&other.direction, &this_region.direction);
                    let ratio = other.distance / this_region.distance;
                    stretch = below(stretch, start, slope - ratio);
                    stretch = below(stretch, -start, -slope - ratio);
                }
            }
            stretch
        };
        let (back, forward) = (half(-1.0), half(1.0));
        [(-back.1, -back.0), forward]
    }
}

/// The part of a stretch where `start + slope t <= 0`.
fn below((from, to): Stretch, start: f64, slope: f64) -> Stretch {
    if slope > 0.0 {
        (from, to.min(-start / slope))
    } else if slope < 0.0 {
        (from.max(-start / slope), to)
    } else if start <= 0.0 {
        (from, to)
    } else {
        (from, from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reliability::random::NormalSamples;
    use crate::reliability::vector::add_scaled;

    /// Every point lies on one line of one region only.
    #[test]
    fn regions_share_the_space() {
        let toward = |along: [f64; 3], distance: f64| Direction {
            along: along.to_vec(),
            distance,
        };
        for directions in [
            vec![],
            vec![toward([1.0, 0.0, 0.0], 3.0)],
            vec![toward([1.0, 1.0, 0.0], -1.0)],
            vec![toward([1.0, 1.0, 0.2], 2.0), toward([-1.0, 0.3, 0.0], 4.0)],
            vec![toward([0.0, 1.0, 0.0], 2.0), toward([0.0, -5.0, 0.0], 1.0)],
        ] {
            let regions = Regions::new(3, &[0, 1, 2], &directions);
            let mut samples = NormalSamples::new(1, 0, 0, 3);
            for _ in 0..200 {
                let point: Vec<f64> = samples.next_sample().iter().map(|z| 3.0 * z).collect();
                let owners = (0..regions.count()).filter(|region| {
                    let direction = regions.direction(*region);
                    let along = dot(&point, direction);
                    let across = add_scaled(&point, -along, direction);
                    let stretches = regions.stretches(*region, &across);
                    stretches
                        .iter()
                        .any(|(from, to)| *from < along && along < *to)
                });
                assert_eq!(owners.count(), 1, "{directions:?} {point:?}");
            }
        }
    }

    #[test]
    fn directions_that_are_the_same_count_once() {
        let toward = |distance: f64| Direction {
            along: vec![0.0, -2.0],
            distance,
        };
        let regions = Regions::new(2, &[0, 1], &[toward(3.0), toward(2.0)]);
        assert_eq!((regions.count(), regions.expected()), (2, 1));
        assert_eq!(regions.all[0].distance, 2.0);
        let all = [3.0, 2.0, 4.0, 5.0].map(toward);
        let regions = Regions::new(2, &[0, 1], &all);
        assert_eq!((regions.count(), regions.expected()), (2, 1));
    }
}
