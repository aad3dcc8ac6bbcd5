//! A search for a design point by the Hasofer-Lind-Rackwitz-Fiessler iteration.

use super::bulge::Bulge;
use super::design_point::Iterate;
use super::settings::FormSettings;
use crate::reliability::counted::Counted;
use crate::reliability::vector::{add_scaled, dot, norm};

/// The limit state of a search, with bulges at design points that are already known.
pub(super) struct Search<'a> {
    pub(super) limit: &'a Counted<'a>,
    pub(super) settings: &'a FormSettings,
    /// +1 if the origin is safe, -1 if it fails.
    pub(super) sign: f64,
    pub(super) bulges: Vec<Bulge>,
}

impl Search<'_> {
    pub(super) fn at(&self, z: &[f64]) -> Option<Iterate> {
        let mut limit = self.limit.evaluate(z)?;
        for bulge in &self.bulges {
            bulge.add_to(&mut limit, z);
        }
        Some(Iterate::new(z.to_vec(), limit, self.sign))
    }

    pub(super) fn is_solved(&self, iterate: &Iterate) -> bool {
        iterate.residual() <= self.settings.tolerance && norm(&iterate.point) <= self.settings.radius
    }

    /// The improved Hasofer-Lind-Rackwitz-Fiessler iteration (Zhang and Der Kiureghian 1995, *Two improved algorithms
    /// for reliability analysis*): a step to the nearest point of the linearised limit, halved until the merit function
    /// `|z|^2 / 2 + c |g|` decreases. Returns the best point visited.
    pub(super) fn iterate(&self, start: Iterate) -> Iterate {
        let mut best = start.clone();
        let mut current = start;
        for _ in 0..self.settings.iterations {
            if self.is_solved(&best) {
                break;
            }
            let Some(next) = self.step(&current) else {
                break;
            };
            if next.residual() < best.residual() {
                best = next.clone();
            }
            current = next;
        }
        best
    }

    fn step(&self, from: &Iterate) -> Option<Iterate> {
        let slope = from.slope()?;
        let height = from.limit.value / slope.norm;
        let along_normal = dot(&from.point, &slope.direction) + height;
        let target: Vec<f64> = slope.direction.iter().map(|n| along_normal * n).collect();
        let penalty = 2.0 * norm(&from.point).max(along_normal.abs()) / slope.norm;
        let merit = |at: &Iterate| 0.5 * norm(&at.point).powi(2) + penalty * at.limit.value.abs();
        let step = add_scaled(&target, -1.0, &from.point);
        let mut part = (self.settings.radius / norm(&step).max(f64::MIN_POSITIVE)).min(1.0);
        for _ in 0..12 {
            let next = self.at(&add_scaled(&from.point, part, &step));
            let better = |next: &Iterate| merit(next) < merit(from) || next.residual() < 0.5 * from.residual();
            if let Some(next) = next.filter(better) {
                return Some(next);
            }
            part *= 0.5;
        }
        None
    }
}
