//! First order, second order and clusters side by side, and for every mode whether its standard deviation can be
//! trusted: measured against samples where these are cheap.
//!
//! # How a verdict is found
//!
//! Some samples, always the same ones, are solved anew, each on its own stable equilibrium, and first and second order predict
//! each of them. The ratio of the standard deviations over the same samples is known much better than either, and more are
//! drawn until the error of first order is clearly below 3 %, clearly above, or known to 0.4 %. The number of operations
//! is limited ([`BUDGET`]), not the time, so that the answer is the same on every machine. What samples cannot decide within it is
//! judged by distances to the critical state and by the second-order model, which errs: a distance does not tell how large the error
//! is, and near a critical state the Taylor series does not converge.
//!
//! # What a frequency is across critical states
//!
//! Standard deviations of samples are those over all stable samples together, on whatever branch of equilibria each of them has settled.
//! A mode that does not oscillate in a sample has no frequency there, and an unstable sample has none at all. Both are counted
//! ([`Check::count`], [`Sampled`]) and left out of mean and standard deviation.

mod branch;
mod chances;
mod cost;
mod paired;
mod sampled;
mod verdict;

pub use chances::{Chance, Sampled, Sampling};
pub use paired::Measured;
pub use verdict::{Advice, Check, Doubt, TRUSTED_SIGMA_ERROR, Trust};

use self::sampled::{About, FEWEST, Finding, Found, Prediction, ROUNDING, finding};
use crate::algebra::Vector;
use crate::clusters::{ClusterTolerance, clusters};
use crate::kernels::SummaryKernels;
use crate::modes::Family;
use crate::second_order::{ModeSecondOrder, SecondOrder, SecondOrderSpread, second_order};
use crate::sensitivity::{Quantity, sensitivities};
use crate::tolerance::{
    FirstOrder, ModeTolerance, Spread, TRUSTED_DISTANCE, Tolerances, first_order,
};
use crate::{Behaviour, Description, Equilibrium, Error, Mode, Modes, Shared};

/// Additions and multiplications that the samples of a [`summary`] may cost: some ten milliseconds.
pub const BUDGET: f64 = 1.5e8;

/// A critical state within as many standard deviations takes more samples: rare ones may matter.
const DOUBTFUL_DISTANCE: f64 = 6.0;

/// What tolerances do to the modes, with a verdict for each.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Summary {
    /// First-order spread.
    pub first: FirstOrder,
    /// Spread to second order.
    pub second: SecondOrder,
    /// The modes that tolerances bring together.
    pub clusters: Vec<ClusterTolerance>,
    /// For each mode whether its standard deviation can be trusted.
    pub trust: Vec<Trust>,
    /// What became of the samples.
    pub sampling: Sampling,
    /// The inputs it belongs to, SI.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl Summary {
    /// Whether every mode is trusted.
    pub fn trusted(&self) -> bool {
        self.trust.iter().all(Trust::trusted)
    }

    /// The cluster that a mode belongs to.
    #[must_use]
    pub fn cluster_of(&self, mode: usize) -> Option<&ClusterTolerance> {
        self.clusters
            .iter()
            .find(|cluster| cluster.modes.contains(&mode))
    }

    /// What became of the samples; `None` where there are none.
    #[must_use]
    pub fn sampled(&self) -> Option<&Sampled> {
        match &self.sampling {
            Sampling::Done(sampled) => Some(sampled),
            _ => None,
        }
    }
}

/// First order, second order, clusters and a verdict for each mode, by samples within [`BUDGET`].
///
/// # Errors
/// [`Error::CriticalState`] when `Khat` is singular, [`Error::OutsideDomain`] when a derivative is not finite,
/// [`Error::WrongLength`] for tolerances of another mechanism, [`Error::Threads`] when worker threads cannot be started.
pub fn summary(
    mechanism: &dyn SummaryKernels,
    at: &Equilibrium,
    modes: &Modes,
    tolerances: &Tolerances,
) -> Result<Summary, Error> {
    summary_within(mechanism, at, modes, tolerances, BUDGET)
}

/// As [`summary`], with samples that may cost so many operations: more decide closer cases, none leave the distances.
///
/// # Errors
/// As [`summary`].
pub fn summary_within(
    mechanism: &dyn SummaryKernels,
    at: &Equilibrium,
    modes: &Modes,
    tolerances: &Tolerances,
    budget: f64,
) -> Result<Summary, Error> {
    let slopes = sensitivities(mechanism, at, modes)?;
    let mut summary = Summary {
        first: first_order(modes, &slopes, tolerances)?,
        second: second_order(mechanism, at, modes, tolerances),
        clusters: clusters(mechanism, at, modes, tolerances)?,
        trust: Vec::new(),
        sampling: Sampling::NotNeeded,
        inputs: at.inputs.clone(),
        description: modes.description.clone(),
    };
    let predictions: Vec<Prediction<'_>> = (modes.modes.iter().enumerate())
        .flat_map(|(mode, own)| summary.predictions(mode, own))
        .collect();
    let about = About {
        mechanism,
        at,
        modes,
        tolerances,
    };
    let found = about.sample(&predictions, budget)?;
    let trust = (modes.modes.iter().enumerate())
        .map(|(mode, own)| summary.judge(mode, own, &predictions, &found))
        .collect();
    (summary.trust, summary.sampling) = (trust, found.sampling);
    Ok(summary)
}

impl Summary {
    /// What samples are to check of a mode: of one that has a frequency of its own, or would have one beside a critical state.
    fn predictions(&self, mode: usize, own: &Mode) -> Vec<Prediction<'_>> {
        let oscillates = own.frequency().is_some();
        let critical = own.behaviour == Behaviour::Neutral;
        if self.cluster_of(mode).is_some() || !(oscillates || critical) {
            return Vec::new();
        }
        let first = &self.first.modes[mode];
        let second = self.second.modes[mode].as_ref().ok();
        let quantities = quantities(own).into_iter();
        let prediction = |(quantity, size)| {
            let spread = spread_of(first, quantity);
            Prediction {
                mode,
                quantity,
                nominal: quantity.of(own).unwrap_or(0.0),
                size,
                slopes: spread.map(|spread| &spread.by_design[..]),
                second: second.map(|second| &second_spread_of(second, quantity).model),
                doubtful: self.first.distance_to_critical < DOUBTFUL_DISTANCE
                    || self
                        .distance_to_critical_damping(mode)
                        .is_some_and(|distance| distance < DOUBTFUL_DISTANCE),
            }
        };
        quantities.map(prediction).collect()
    }

    fn judge(
        &self,
        mode: usize,
        own: &Mode,
        predictions: &[Prediction<'_>],
        found: &Found,
    ) -> Trust {
        let all = predictions.iter().zip(&found.checks).zip(&found.counts);
        let own_ones: Vec<_> = all.filter(|((one, _), _)| one.mode == mode).collect();
        let checks: Vec<Check> = own_ones
            .iter()
            .filter_map(|((_, check), _)| **check)
            .collect();
        let findings: Vec<(Quantity, Measured, Finding)> = checks
            .iter()
            .filter_map(|check| {
                let error = check.first_order_error?;
                Some((check.quantity, error, finding(error)))
            })
            .collect();
        let wrong = findings
            .iter()
            .any(|(_, _, found)| *found == Finding::Wrong);
        // Nothing moves it, and samples agree.
        let stays_still = own_ones.iter().any(|((one, check), count)| {
            let spread = spread_of(&self.first.modes[mode], one.quantity);
            one.quantity == Quantity::Frequency
                && check.is_none()
                && **count >= FEWEST
                && spread.is_some_and(|spread| spread.sigma <= ROUNDING * one.size)
        });
        let frequency = findings.iter().find(|one| one.0 == Quantity::Frequency);
        let right = findings
            .iter()
            .all(|(_, _, found)| *found == Finding::Right)
            && (frequency.is_some() || stays_still);
        let mut doubts = self.doubts(mode, own, wrong, right);
        for (quantity, error, finding) in findings {
            if finding == Finding::Wrong {
                doubts.push(Doubt::Inaccurate { quantity, error });
            }
        }
        if let Sampling::Done(Sampled { samples, .. }) = &found.sampling {
            for ((prediction, _), count) in own_ones {
                if own.frequency().is_some() && 2 * count < *samples {
                    doubts.push(Doubt::Missing {
                        quantity: prediction.quantity,
                        count: *count,
                        samples: *samples,
                    });
                }
            }
        }
        Trust {
            mode,
            advice: self.advice(mode, &doubts, &checks),
            doubts,
            checks,
        }
    }

    /// What distances and the second-order model say against a mode that samples found wrong, right, or did not decide.
    fn doubts(&self, mode: usize, own: &Mode, wrong: bool, right: bool) -> Vec<Doubt> {
        let mut doubts = Vec::new();
        let near = |distance: f64| distance < TRUSTED_DISTANCE;
        if own.frequency().is_none() {
            doubts.push(Doubt::NoFrequency);
        }
        let cluster = self.cluster_of(mode);
        if let Some(cluster) = cluster {
            doubts.push(Doubt::Clustered {
                modes: cluster.modes.clone(),
                distance: cluster.distance,
                defective: cluster.defective(),
            });
        }
        let first = &self.first.modes[mode];
        let distance = self.first.distance_to_critical;
        // Samples about an unstable state have left it.
        if near(distance) && !(right && distance > 0.0) {
            doubts.push(Doubt::NearCritical { distance });
        }
        let distance = first.distance_to_instability;
        if near(distance) {
            doubts.push(Doubt::NearInstability { distance });
        }
        if let Some(distance) = self.distance_to_critical_damping(mode)
            && near(distance)
            && !right
            && !near(first.distance_to_critical)
        {
            doubts.push(Doubt::NearCriticalDamping { distance });
        }
        let decided = wrong || right || cluster.is_some() || own.frequency().is_none();
        if !decided && !expanded_near_a_root(&doubts) {
            self.check_by_second_order(mode, own, &mut doubts);
        }
        doubts
    }

    fn advice(&self, mode: usize, doubts: &[Doubt], checks: &[Check]) -> Advice {
        let confirmed = |check: &Check| {
            let error = check.second_order_error;
            error.is_some_and(|error| finding(error) == Finding::Right)
        };
        let inaccurate = |doubt: &Doubt| matches!(doubt, Doubt::Inaccurate { .. });
        let stays = self.first.distance_to_critical > 0.0;
        if doubts.is_empty() {
            Advice::FirstOrder
        } else if self.cluster_of(mode).is_some() {
            Advice::Cluster
        } else if stays && doubts.iter().any(inaccurate) && checks.iter().all(confirmed) {
            Advice::SecondOrder
        } else {
            Advice::Sampling
        }
    }

    /// The standard deviation of a frequency to second order, rad/s; `None` where there is none, or where it means nothing
    /// because the series does not converge.
    pub(crate) fn second_order_sigma(&self, mode: usize) -> Option<f64> {
        let second = self.second.modes[mode].as_ref().ok()?;
        let trust = &self.trust[mode];
        let converges = !expanded_near_a_root(&trust.doubts) || trust.advice == Advice::SecondOrder;
        converges.then_some(second.frequency.moments.sigma)
    }

    /// `(Im s)^2` over its standard deviation; `None` for undamped modes and those that do not oscillate.
    fn distance_to_critical_damping(&self, mode: usize) -> Option<f64> {
        let own = self.first.modes[mode].frequency.as_ref()?;
        (self.first.family == Family::General && own.sigma > 0.0)
            .then(|| 0.5 * own.mean / own.sigma)
    }

    fn check_by_second_order(&self, mode: usize, own: &Mode, doubts: &mut Vec<Doubt>) {
        let second = match &self.second.modes[mode] {
            Ok(second) => second,
            Err(reason) => {
                let reason = reason.clone();
                doubts.push(Doubt::Unchecked { reason });
                return;
            }
        };
        for (quantity, size) in quantities(own) {
            let spread = second_spread_of(second, quantity);
            let sigma_error = spread.nonlinearity.sigma_error();
            if spread.moments.sigma > ROUNDING * size && sigma_error > TRUSTED_SIGMA_ERROR {
                doubts.push(Doubt::Nonlinear {
                    quantity,
                    sigma_error,
                });
            }
        }
    }
}

/// What of a mode is judged, and what it is measured by.
fn quantities(own: &Mode) -> Vec<(Quantity, f64)> {
    let damped = matches!(own.behaviour, Behaviour::Damped(_) | Behaviour::Flutter(_));
    let mut all = vec![(Quantity::Frequency, own.s.norm())];
    if damped {
        all.push((Quantity::DampingRatio, 1.0));
    }
    all
}

fn spread_of(mode: &ModeTolerance, quantity: Quantity) -> Option<&Spread> {
    match quantity {
        Quantity::DampingRatio => mode.damping_ratio.as_ref(),
        _ => mode.frequency.as_ref(),
    }
}

fn second_spread_of(mode: &ModeSecondOrder, quantity: Quantity) -> &SecondOrderSpread {
    match quantity {
        Quantity::DampingRatio => &mode.damping_ratio,
        _ => &mode.frequency,
    }
}

/// Whether a frequency is the root of something that vanishes nearby: its Taylor series does not converge within the
/// tolerances, and one term more is no check of the first.
fn expanded_near_a_root(doubts: &[Doubt]) -> bool {
    doubts.iter().any(|doubt| {
        matches!(
            doubt,
            Doubt::NearCritical { .. } | Doubt::NearCriticalDamping { .. }
        )
    })
}
