//! The verdict on a mode, from samples, distances and the second-order model.

use super::chances::Sampling;
use super::sampled::{FEWEST, Finding, Prediction, ROUNDING, SampledChecks, finding};
use super::verdict::{Advice, Check, Trust};
use crate::clusters::ClusterTolerance;
use crate::judge::{Doubt, Measured, TRUSTED_SIGMA_ERROR};
use crate::modes::Family;
use crate::second_order::{ModeSecondOrder, SecondOrder, SecondOrderSpread};
use crate::sensitivity::Quantity;
use crate::tolerance::FirstOrder;
use crate::{Behaviour, Mode};

/// With a critical state or critical damping within this many standard deviations, more samples are drawn: rare ones
/// may matter.
const DOUBTFUL_DISTANCE: f64 = 6.0;

/// The data on which verdicts are based.
pub(super) struct Judge<'a> {
    pub(super) first: &'a FirstOrder,
    pub(super) second: &'a SecondOrder,
    pub(super) clusters: &'a [ClusterTolerance],
}

/// What the samples showed about a mode.
#[derive(Default)]
struct Findings {
    checks: Vec<Check>,
    errors: Vec<(Quantity, Measured, Finding)>,
    /// Whether first order is wrong for some quantity.
    wrong: bool,
    /// Whether first order is right for all quantities.
    right: bool,
    /// For each quantity of which the samples miss what matters.
    unrepresentative: Vec<Doubt>,
    /// Set if too few samples have a value of some quantity.
    missing: Option<Doubt>,
    /// Whether the samples keep the modes in order, although distances put this mode in a cluster.
    separate: bool,
}

impl<'a> Judge<'a> {
    /// The predictions that samples are to check: for modes that have a frequency of their own, or would have one
    /// beside a critical state.
    pub(super) fn predictions(&self, mode: usize, eigenmode: &Mode) -> Vec<Prediction<'a>> {
        let oscillates = eigenmode.frequency().is_some();
        let critical = eigenmode.behaviour == Behaviour::Neutral;
        if !self.may_be_separate(mode) || !(oscillates || critical) {
            return Vec::new();
        }
        let first = &self.first.modes[mode];
        let second = self.second.modes[mode].as_ref().ok();
        let damping = first.distance_to_critical_damping(self.first.family);
        let distance =
            damping.map_or(self.first.distance_to_critical, |distance| distance.min(self.first.distance_to_critical));
        let prediction = |(quantity, size)| Prediction {
            mode,
            quantity,
            nominal: quantity.of(eigenmode).unwrap_or(0.0),
            size,
            sigma: first.of(quantity).map_or(0.0, |spread| spread.sigma),
            slopes: first.of(quantity).map(|spread| spread.by_design),
            second: second.map(|second| &*second_spread_of(second, quantity).model),
            doubtful: distance < DOUBTFUL_DISTANCE || self.cluster(mode).is_some(),
        };
        quantities(eigenmode).into_iter().map(prediction).collect()
    }

    /// The verdict on a mode.
    pub(super) fn verdict(
        &self,
        mode: usize,
        eigenmode: &Mode,
        predictions: &[Prediction<'_>],
        samples: &SampledChecks,
    ) -> Trust {
        let said = self.findings(mode, eigenmode, predictions, samples);
        let mut doubts = self.doubts(mode, eigenmode, &said);
        for (quantity, error, finding) in said.errors {
            if finding == Finding::Wrong {
                doubts.push(Doubt::Inaccurate { quantity, error });
            }
        }
        doubts.extend(said.unrepresentative);
        let unstable = |doubt: &Doubt| matches!(doubt, Doubt::NearInstability { .. });
        if !doubts.iter().any(unstable) {
            doubts.extend(said.missing);
        }
        Trust { mode, advice: self.advice(&doubts, &said.checks), doubts, checks: said.checks }
    }

    fn findings(
        &self,
        mode: usize,
        eigenmode: &Mode,
        predictions: &[Prediction<'_>],
        found: &SampledChecks,
    ) -> Findings {
        let Sampling::Done(sampled) = &found.sampling else {
            return Findings::default();
        };
        let cluster = self.clusters.iter().position(|cluster| cluster.modes.contains(&mode));
        let separate = cluster.is_some_and(|cluster| found.exchanged[cluster] == 0);
        if cluster.is_some() && !(separate && self.may_be_separate(mode)) {
            return Findings::default();
        }
        let mut said = Findings { separate, ..Findings::default() };
        let all = predictions.iter().zip(&found.checks).zip(&found.counts);
        for ((prediction, check), &count) in all.filter(|((one, _), _)| one.mode == mode) {
            let quantity = prediction.quantity;
            said.checks.extend(check);
            if check.is_some_and(|check| !check.representative) {
                said.unrepresentative.push(Doubt::Unrepresentative { quantity });
            }
            if let Some(error) = check.and_then(|check| check.first_order_error) {
                said.errors.push((quantity, error, finding(error)));
            }
            let spread = self.first.modes[mode].of(quantity);
            if quantity == Quantity::Frequency {
                // Checked, or else nothing moves the frequency and the samples agree.
                let still = spread.is_some_and(|spread| spread.sigma <= ROUNDING * prediction.size);
                said.right = check.is_some_and(|check| check.first_order_error.is_some())
                    || (check.is_none() && still && count >= FEWEST);
            }
            if eigenmode.frequency().is_some() && 2 * count < sampled.samples {
                said.missing = Some(Doubt::Missing { quantity, count, samples: sampled.samples });
            }
        }
        let are = |finding| move |error: &(_, _, Finding)| error.2 == finding;
        said.wrong = said.errors.iter().any(are(Finding::Wrong));
        said.right &= said.errors.iter().all(are(Finding::Right));
        if cluster.is_some() && !said.right {
            return Findings::default();
        }
        said
    }

    /// Doubts from distances and the second-order model, given that samples found the mode wrong, right, or undecided.
    fn doubts(&self, mode: usize, eigenmode: &Mode, said: &Findings) -> Vec<Doubt> {
        let cluster = (self.cluster(mode)).filter(|_| !(said.separate && said.right));
        let mut doubts = self.first.doubts(mode);
        doubts.retain(|doubt| match doubt {
            Doubt::NearCritical { distance } | Doubt::BranchNear { distance, .. } => !(said.right && *distance != 0.0),
            Doubt::NearCriticalDamping { .. } => !said.right,
            // Clusters decide.
            Doubt::EqualNeighbours | Doubt::NearNeighbour { .. } => false,
            _ => true,
        });
        if let Some(cluster) = cluster {
            let modes = cluster.modes.clone();
            let clustered = if cluster.equal {
                Doubt::EqualInEveryDesign { modes }
            } else {
                Doubt::Clustered { modes, distance: cluster.distance, defective: cluster.defective() }
            };
            doubts.insert(doubts.iter().take_while(|doubt| **doubt == Doubt::NoFrequency).count(), clustered);
        }
        let decided = said.wrong || said.right;
        let open = !decided && cluster.is_none() && eigenmode.frequency().is_some();
        if open && !expanded_near_a_root(&doubts) {
            self.check_by_second_order(mode, eigenmode, &mut doubts);
        }
        doubts
    }

    fn advice(&self, doubts: &[Doubt], checks: &[Check]) -> Advice {
        let confirmed = |check: &Check| {
            let error = check.second_order_error;
            error.is_some_and(|error| finding(error) == Finding::Right)
        };
        let any = |kind: fn(&Doubt) -> bool| doubts.iter().any(kind);
        if doubts.is_empty() {
            Advice::FirstOrder
        } else if any(|doubt| {
            matches!(doubt, Doubt::Clustered { defective: false, .. } | Doubt::EqualInEveryDesign { .. })
        }) {
            Advice::Cluster
        } else if any(|doubt| matches!(doubt, Doubt::Inaccurate { .. })) && checks.iter().all(confirmed) {
            Advice::SecondOrder
        } else {
            Advice::Sampling
        }
    }

    /// The cluster of a mode, according to distances.
    fn cluster(&self, mode: usize) -> Option<&'a ClusterTolerance> {
        let mut all = self.clusters.iter();
        all.find(|cluster| cluster.modes.contains(&mode))
    }

    /// Whether samples can show that tolerances do not mix the mode with others: undamped modes then keep their order.
    fn may_be_separate(&self, mode: usize) -> bool {
        self.cluster(mode).is_none_or(|cluster| {
            self.first.family == Family::Undamped
                && !cluster.defective()
                && !cluster.modes.iter().any(|r| self.first.modes[*r].clustered)
        })
    }

    fn check_by_second_order(&self, mode: usize, eigenmode: &Mode, doubts: &mut Vec<Doubt>) {
        let second = match &self.second.modes[mode] {
            Ok(second) => second,
            Err(reason) => {
                let reason = reason.clone();
                doubts.push(Doubt::Unchecked { reason });
                return;
            }
        };
        for (quantity, size) in quantities(eigenmode) {
            let spread = second_spread_of(second, quantity);
            let sigma_error = spread.nonlinearity.sigma_error();
            if spread.moments.sigma > ROUNDING * size && sigma_error > TRUSTED_SIGMA_ERROR {
                doubts.push(Doubt::Nonlinear { quantity, sigma_error });
            }
        }
    }
}

/// The quantities of a mode to judge, each with the magnitude that it is compared to.
fn quantities(mode: &Mode) -> Vec<(Quantity, f64)> {
    let damped = matches!(mode.behaviour, Behaviour::Damped(_) | Behaviour::Flutter(_));
    let mut all = vec![(Quantity::Frequency, mode.s.norm())];
    if damped {
        all.push((Quantity::DampingRatio, 1.0));
    }
    all
}

fn second_spread_of(mode: &ModeSecondOrder, quantity: Quantity) -> &SecondOrderSpread {
    match quantity {
        Quantity::DampingRatio => &mode.damping_ratio,
        _ => &mode.frequency,
    }
}

/// Whether a frequency is the root of something that vanishes nearby. Its Taylor series then does not converge within
/// the tolerances, and second order is no check of first order.
pub(super) fn expanded_near_a_root(doubts: &[Doubt]) -> bool {
    doubts.iter().any(|doubt| {
        matches!(doubt, Doubt::NearCritical { .. } | Doubt::BranchNear { .. } | Doubt::NearCriticalDamping { .. })
    })
}
