//! Multiple starts and multiple design points.

use super::bulge::Bulge;
use super::design_point::{DesignPoint, Iterate};
use super::search::Search;
use super::settings::FormSettings;
use crate::Error;
use crate::reliability::closest::Evaluations;
use crate::reliability::counted::Counted;
use crate::reliability::random::NormalSamples;
use crate::reliability::vector::{add_scaled, distance, dot, norm, scaled, unit};

/// Design points of separate failure regions.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FailureRegions {
    /// The design points, nearest to the origin first; at least one.
    pub design_points: Vec<DesignPoint>,
    /// Whether the search ended because it found no further region, rather than at the maximum number.
    pub exhausted: bool,
    /// Number of evaluations of the limit state.
    pub evaluations: Evaluations,
}

/// Distance from a point, as a fraction of its distance from the origin (or of 1, if that is larger), at which a search
/// restarts to see whether it returns. This escapes from points that are nearest along some directions only (Rackwitz:
/// `1 + beta kappa < 0`).
const NUDGE: f64 = 0.05;

/// A coordinate that contributes less than this fraction to the distance of a design point is not reflected, and at most
/// so many are.
const REFLECTED: f64 = 0.3;
const REFLECTIONS: usize = 6;
/// A reflection is a start if its distance from the limit, relative to that from the origin, is smaller.
const SYMMETRIC: f64 = 0.1;

pub(super) fn by_restarts(limit: &Counted, settings: &FormSettings) -> Result<FailureRegions, Error> {
    let mut regions = Regions::start(limit, settings)?;
    regions.restart();
    regions.finish()
}

pub(super) fn by_bulges(limit: &Counted, settings: &FormSettings) -> Result<FailureRegions, Error> {
    let mut regions = Regions::start(limit, settings)?;
    regions.restart();
    regions.search_reflections();
    while !regions.is_full() && regions.search_behind_bulges() {
        regions.search_reflections();
    }
    regions.finish()
}

struct Regions<'a> {
    search: Search<'a>,
    random: NormalSamples,
    found: Vec<DesignPoint>,
    /// Number of design points of which the reflections have been searched.
    reflected: usize,
    /// The best of the points that are not design points.
    best: Iterate,
}

impl<'a> Regions<'a> {
    /// Starts with a search from the origin.
    fn start(limit: &'a Counted<'a>, settings: &'a FormSettings) -> Result<Self, Error> {
        settings.check()?;
        let dimension = limit.dimension();
        let origin = vec![0.0; dimension];
        let at_origin = limit.evaluate(&origin).ok_or_else(|| limit.no_value("at the origin"))?;
        let sign = if at_origin.value > 0.0 { 1.0 } else { -1.0 };
        let mut regions = Self {
            search: Search { limit, settings, sign, bulges: Vec::new() },
            random: NormalSamples::new(settings.seed, 0, 0, dimension),
            found: Vec::new(),
            reflected: 0,
            best: Iterate::new(origin.clone(), at_origin, sign),
        };
        regions.visit(&origin);
        Ok(regions)
    }

    fn is_full(&self) -> bool {
        self.found.len() >= self.search.settings.regions
    }

    /// Searches from random directions and their opposites, at the distance of the first design point.
    fn restart(&mut self) {
        let mut direction = Vec::new();
        for restart in 0..self.search.settings.restarts {
            direction = match restart % 2 {
                0 => self.random_direction(),
                _ => scaled(-1.0, &direction),
            };
            let usual = [3.0, 6.0, 1.0][restart / 2 % 3];
            let distance = self.found.first().map_or(usual, |p| p.beta.abs().max(1.0));
            self.visit(&scaled(distance, &direction));
        }
    }

    /// Searches with the known design points pushed off the limit, from the origin and from the point opposite to the
    /// last one. Returns whether another one was found.
    fn search_behind_bulges(&mut self) -> bool {
        self.search.bulges = self.found.iter().filter_map(Bulge::over).collect();
        let opposite = self.found.last().map(|last| scaled(-1.0, &last.point));
        let origin = vec![0.0; self.search.limit.dimension()];
        let starts = [Some(origin), opposite];
        let ends: Vec<Iterate> = starts.into_iter().flatten().filter_map(|start| self.search.from(&start)).collect();
        self.search.bulges.clear();
        let before = self.found.len();
        for end in ends {
            if norm(&end.point) <= self.search.settings.radius {
                self.visit(&end.point);
            }
        }
        self.found.len() > before
    }

    /// Searches from the known design points with the signs of one or two coordinates changed, where the limit is near:
    /// responses are often even in a variable, such as an eccentricity, or in two together, such as a product.
    fn search_reflections(&mut self) {
        while !self.is_full() && self.reflected < self.found.len() {
            let point = self.found[self.reflected].point.clone();
            self.reflected += 1;
            let mut large: Vec<usize> =
                (0..point.len()).filter(|&k| point[k].abs() > REFLECTED * norm(&point)).collect();
            large.sort_by(|&a, &b| point[b].abs().total_cmp(&point[a].abs()));
            large.truncate(REFLECTIONS);
            for (i, j) in (0..large.len()).flat_map(|i| (0..=i).map(move |j| (i, j))) {
                let mut start = point.clone();
                start[large[i]] = -point[large[i]];
                start[large[j]] = -point[large[j]];
                let at_start = self.search.at(&start);
                let slope = at_start.as_ref().and_then(Iterate::slope);
                if slope.is_some_and(|slope| slope.residuals.limit < SYMMETRIC) {
                    self.visit(&start);
                }
            }
        }
    }

    /// Searches from a starting point, checks the result, and keeps it if it is new.
    fn visit(&mut self, start: &[f64]) {
        if self.is_full() {
            return;
        }
        let Some(end) = self.search.from(start) else {
            return;
        };
        if !self.search.is_solved(&end) {
            if end.residual() < self.best.residual() {
                self.best = end;
            }
            return;
        }
        let Some(point) = end.design_point() else {
            return;
        };
        if self.is_new(&point) {
            let point = self.nudged(point);
            if self.is_new(&point) {
                self.found.push(point);
            }
        }
    }

    fn is_new(&self, point: &DesignPoint) -> bool {
        let apart = self.search.settings.separation * point.beta.abs().max(1.0);
        self.found.iter().all(|known: &DesignPoint| distance(&known.point, &point.point) > apart)
    }

    /// The point itself, or the result of a search from next to it if that is nearer to the origin.
    fn nudged(&mut self, point: DesignPoint) -> DesignPoint {
        let random = self.random_direction();
        let along = dot(&random, &point.direction);
        let Some(tangent) = unit(&add_scaled(&random, -along, &point.direction)) else {
            return point;
        };
        let beside = add_scaled(&point.point, NUDGE * point.beta.abs().max(1.0), &tangent);
        let end = self.search.from(&beside);
        let solved = end.filter(|end| self.search.is_solved(end));
        let nearer = (1.0 - 1e-6) * point.beta.abs() - self.search.settings.tolerance;
        match solved.and_then(Iterate::design_point) {
            Some(other) if other.beta.abs() < nearer => other,
            _ => point,
        }
    }

    fn random_direction(&mut self) -> Vec<f64> {
        let sample = self.random.next_sample().to_vec();
        unit(&sample).unwrap_or(sample)
    }

    fn finish(mut self) -> Result<FailureRegions, Error> {
        let evaluations = self.search.limit.evaluations();
        let exhausted = !self.is_full();
        if self.found.is_empty() {
            return Err(Error::NoDesignPoint {
                radius: self.search.settings.radius,
                closest: Box::new(self.best.closest(evaluations)),
            });
        }
        self.found.sort_by(|a, b| a.beta.abs().total_cmp(&b.beta.abs()));
        Ok(FailureRegions { design_points: self.found, exhausted, evaluations })
    }
}
