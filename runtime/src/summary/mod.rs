//! First order, second order and clusters side by side, and for every mode whether its standard deviation can be
//! trusted.

use crate::algebra::Vector;
use crate::clusters::{ClusterTolerance, clusters};
use crate::kernels::CurvatureKernels;
use crate::modes::Family;
use crate::second_order::{SecondOrder, second_order};
use crate::sensitivity::{Quantity, sensitivities};
use crate::tolerance::{FirstOrder, TRUSTED_DISTANCE, Tolerances, first_order};
use crate::{Behaviour, Description, Equilibrium, Error, Mode, Modes, Shared};

/// A first-order standard deviation that misses that of the second-order model by more than this is not to be trusted.
///
/// Nor is the second-order one then: it shows that a quantity is nonlinear, not by how much. For the rotating bar at 5 rad/s with a
/// tolerance of 45 %, against quadrature of the exact distribution, first order misses the standard deviation by -29 % and second
/// order, 6 % above it, by -24 %. Only sampling gives the answer.
pub const TRUSTED_SIGMA_ERROR: f64 = 0.05;

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
}

/// The verdict on the first-order standard deviation of one mode.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Trust {
    /// Position of the mode, from 0.
    pub mode: usize,
    /// What speaks against it; empty when nothing does.
    pub doubts: Vec<Doubt>,
}

impl Trust {
    /// Whether nothing speaks against it.
    #[must_use]
    pub fn trusted(&self) -> bool {
        self.doubts.is_empty()
    }
}

/// Why a first-order standard deviation is not to be trusted.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Doubt {
    /// The mode does not oscillate: it has no frequency.
    NoFrequency,
    /// Tolerances mix it with other modes.
    Clustered {
        /// Positions of all modes of the cluster, its own included.
        modes: Vec<usize>,
        /// Least distance of two of them, in standard deviations.
        distance: f64,
        /// They have merged into one defective eigenvalue.
        defective: bool,
    },
    /// The critical state, beyond which the equilibrium changes branch, is this many standard deviations away; zero within
    /// rounding of it, negative beyond it.
    NearCritical {
        /// Standard deviations.
        distance: f64,
    },
    /// The mode begins to grow this many standard deviations away; zero when it neither grows nor decays within rounding,
    /// negative when it grows.
    NearInstability {
        /// Standard deviations.
        distance: f64,
    },
    /// The mode ceases to oscillate this many standard deviations away: it meets its conjugate and becomes two real ones.
    NearCriticalDamping {
        /// Standard deviations, `Im s / (2 sigma)`: the distance of `(Im s)^2` from zero.
        distance: f64,
    },
    /// First order misses the standard deviation of the second-order model. Checked only where the series may converge: not
    /// near a critical state or critical damping.
    Nonlinear {
        /// Of what.
        quantity: Quantity,
        /// By how much, as a fraction of the second-order one.
        sigma_error: f64,
    },
    /// The second-order model that should check it does not exist.
    Unchecked {
        /// Why.
        reason: Error,
    },
}

/// First order, second order, clusters and a verdict for each mode.
///
/// # Errors
/// [`Error::CriticalState`] when `Khat` is singular, [`Error::OutsideDomain`] when a derivative is not finite,
/// [`Error::WrongLength`] for tolerances of another mechanism.
pub fn summary(
    mechanism: &dyn CurvatureKernels,
    at: &Equilibrium,
    modes: &Modes,
    tolerances: &Tolerances,
) -> Result<Summary, Error> {
    let slopes = sensitivities(mechanism, at, modes)?;
    let mut summary = Summary {
        first: first_order(modes, &slopes, tolerances)?,
        second: second_order(mechanism, at, modes, tolerances),
        clusters: clusters(mechanism, at, modes, tolerances)?,
        trust: Vec::new(),
        inputs: at.inputs.clone(),
        description: modes.description.clone(),
    };
    let verdict = |(mode, own)| Trust {
        mode,
        doubts: summary.doubts(mode, own),
    };
    summary.trust = modes.modes.iter().enumerate().map(verdict).collect();
    Ok(summary)
}

impl Summary {
    fn doubts(&self, mode: usize, own: &Mode) -> Vec<Doubt> {
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
        if near(distance) {
            doubts.push(Doubt::NearCritical { distance });
        }
        let distance = first.distance_to_instability;
        if near(distance) {
            doubts.push(Doubt::NearInstability { distance });
        }
        if let Some(distance) = self.distance_to_critical_damping(mode)
            && near(distance)
            && !near(first.distance_to_critical)
        {
            doubts.push(Doubt::NearCriticalDamping { distance });
        }
        if cluster.is_none() && own.frequency().is_some() && !expanded_near_a_root(&doubts) {
            self.check_by_second_order(mode, own, &mut doubts);
        }
        doubts
    }

    /// The standard deviation of a frequency to second order, rad/s; `None` where there is none, or where it means nothing
    /// because the series does not converge.
    pub(crate) fn second_order_sigma(&self, mode: usize) -> Option<f64> {
        let second = self.second.modes[mode].as_ref().ok()?;
        let converges = !expanded_near_a_root(&self.trust[mode].doubts);
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
        let damped = matches!(own.behaviour, Behaviour::Damped(_) | Behaviour::Flutter(_));
        for (quantity, spread, size) in [
            (Quantity::Frequency, &second.frequency, own.s.norm()),
            (Quantity::DampingRatio, &second.damping_ratio, 1.0),
        ] {
            let sigma_error = spread.nonlinearity.sigma_error();
            let seen = quantity == Quantity::Frequency || damped;
            if seen && spread.moments.sigma > ROUNDING * size && sigma_error > TRUSTED_SIGMA_ERROR {
                doubts.push(Doubt::Nonlinear {
                    quantity,
                    sigma_error,
                });
            }
        }
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

/// Standard deviations below this, relative to the quantity, are rounding.
const ROUNDING: f64 = 1e-10;
