//! Sequential quadratic programming for strongly curved limits, where the iteration does not converge.

use core::cell::RefCell;

use slsqp::{Func, StopTols, minimize};

use super::design_point::Iterate;
use super::search::Search;
use crate::reliability::vector::norm;

/// The library uses a 32-bit counter.
const EVALUATIONS: usize = i32::MAX as usize;

/// The optimiser stores dense matrices; with more variables only the iteration is tried.
const OPTIMISER_VARIABLES: usize = 1000;

impl Search<'_> {
    /// The best point visited from a start, provided that the limit state has a value at the start or between it and
    /// the origin.
    pub(super) fn from(&self, start: &[f64]) -> Option<Iterate> {
        let mut start = start.to_vec();
        let mut at_start = self.at(&start);
        for _ in 0..8 {
            if at_start.is_some() {
                break;
            }
            start.iter_mut().for_each(|z| *z *= 0.5);
            at_start = self.at(&start);
        }
        let best = self.iterate(at_start?);
        let too_many = self.limit.dimension() > OPTIMISER_VARIABLES;
        if self.is_solved(&best) || too_many || self.settings.optimiser_evaluations == 0 {
            return Some(best);
        }
        Some(self.iterate(minimise(self, best)))
    }
}

/// Minimises `|z|^2 / 2` on the far side of the limit (Kraft 1988, *A software package for sequential quadratic
/// programming*) from a starting point, and returns the best point visited. Points without a value have an infinite
/// objective; the line search then halves its step.
fn minimise(search: &Search, start: Iterate) -> Iterate {
    let Some(slope) = start.slope() else {
        return start;
    };
    // In units of z, with the sign such that feasible points are negative.
    let scale = search.sign / slope.norm;
    let tolerance = search.settings.tolerance;
    let radius = search.settings.radius;
    let first = start.point.clone();
    let progress = RefCell::new(Progress { last: Some(start.clone()), last_point: first.clone(), best: start });
    let objective = |z: &[f64], gradient: Option<&mut [f64]>, (): &mut ()| {
        if let Some(gradient) = gradient {
            gradient.copy_from_slice(z);
        }
        match progress.borrow_mut().at(search, z) {
            Some(_) => 0.5 * norm(z).powi(2),
            None => f64::INFINITY,
        }
    };
    let limit = |z: &[f64], gradient: Option<&mut [f64]>, (): &mut ()| {
        let mut progress = progress.borrow_mut();
        let Some(evaluation) = progress.at(search, z) else {
            return f64::INFINITY;
        };
        if let Some(gradient) = gradient {
            for (entry, slope) in gradient.iter_mut().zip(&evaluation.limit.gradient) {
                *entry = scale * slope;
            }
        }
        // On the limit is sufficient: otherwise rounding of g would decide feasibility.
        let value = scale * evaluation.limit.value;
        if value.abs() < 0.1 * tolerance { 0.0 } else { value }
    };
    let limits: [&dyn Func<()>; 1] = [&limit];
    let stop = StopTols { xtol_rel: 0.1 * tolerance, ..StopTols::default() };
    // However the optimiser ends, only the residuals of the best point count.
    let _ = minimize(
        objective,
        &first,
        &vec![(-radius, radius); first.len()],
        &limits,
        (),
        search.settings.optimiser_evaluations.min(EVALUATIONS),
        Some(stop),
    );
    progress.into_inner().best
}

/// Caches the last evaluation, because objective and limit are queried at the same point one after the other.
struct Progress {
    last_point: Vec<f64>,
    last: Option<Iterate>,
    best: Iterate,
}

impl Progress {
    fn at(&mut self, search: &Search, z: &[f64]) -> Option<&Iterate> {
        if self.last_point != z {
            self.last_point = z.to_vec();
            let finite = z.iter().all(|z| z.is_finite());
            self.last = if finite { search.at(z) } else { None };
            if let Some(last) = &self.last
                && last.residual() < self.best.residual()
            {
                self.best = last.clone();
            }
        }
        self.last.as_ref()
    }
}
