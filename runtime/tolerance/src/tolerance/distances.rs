//! The doubts that distances raise about first order.

use super::{Doubt, FirstOrder, ModeTolerance, TRUSTED_DISTANCE};
use crate::Behaviour;
use crate::modes::Family;
use crate::sensitivity::Quantity;

fn near(distance: f64) -> bool {
    distance < TRUSTED_DISTANCE
}

impl ModeTolerance {
    /// Whether every other mode is far enough away that tolerances do not bring the two together.
    #[must_use]
    pub fn alone(&self) -> bool {
        !self.clustered && !near(self.distance_to_neighbour)
    }

    /// Distance, in standard deviations, to the state where the oscillation ceases: `(Im s)^2` divided by its own
    /// standard deviation, `Im s / (2 sigma)`. `None` for undamped modes and those that do not oscillate.
    #[doc(hidden)]
    pub fn distance_to_critical_damping(&self, family: Family) -> Option<f64> {
        let frequency = self.of(Quantity::Frequency)?;
        (family == Family::General && frequency.sigma > 0.0).then(|| 0.5 * frequency.mean / frequency.sigma)
    }
}

impl FirstOrder {
    /// The doubts that distances raise about the standard deviations of a mode, each on the mode it belongs to. They do
    /// not tell how large an error is: a distance may be small and first order right by chance, as
    /// `summary` finds out by samples.
    #[must_use]
    pub fn doubts(&self, mode: usize) -> Vec<Doubt> {
        let mut doubts = Vec::new();
        let Some(this_mode) = self.modes.get(mode) else {
            return doubts;
        };
        if this_mode.behaviour == Behaviour::Free {
            return doubts;
        }
        let oscillates = this_mode.behaviour.frequency().is_some();
        if !oscillates {
            doubts.push(Doubt::NoFrequency);
        }
        if this_mode.clustered {
            doubts.push(Doubt::EqualNeighbours);
        }
        let distance = this_mode.distance_to_critical;
        let near_critical = near(distance.abs());
        if near_critical {
            doubts.push(Doubt::NearCritical { distance });
        } else if let Some((mode, distance)) = self.nearest_critical() {
            doubts.push(Doubt::BranchNear { mode, distance });
        }
        let distance = this_mode.distance_to_instability;
        if oscillates && near(distance) {
            doubts.push(Doubt::NearInstability { distance });
        }
        if let Some(distance) = this_mode.distance_to_critical_damping(self.family)
            && near(distance)
            && !near_critical
        {
            doubts.push(Doubt::NearCriticalDamping { distance });
        }
        if !this_mode.clustered && near(this_mode.distance_to_neighbour) {
            let distance = this_mode.distance_to_neighbour;
            doubts.push(Doubt::NearNeighbour { distance });
        }
        doubts
    }

    /// Whether distances leave no doubt about any mode ([`Self::doubts`]).
    ///
    /// It considers each mode alone; `summary` also detects which modes mix and how
    /// nonlinear frequencies are, and lets samples decide where distances are small.
    #[must_use]
    pub fn trusted(&self) -> bool {
        (0..self.modes.len()).all(|mode| self.doubts(mode).is_empty())
    }

    /// The mode nearest to its critical state, and the distance, if that is near.
    #[doc(hidden)]
    pub fn nearest_critical(&self) -> Option<(usize, f64)> {
        let distances = self.modes.iter().map(|mode| mode.distance_to_critical);
        let nearest = distances.enumerate().min_by(|(_, a), (_, b)| a.abs().total_cmp(&b.abs()));
        nearest.filter(|(_, distance)| near(distance.abs()))
    }
}
