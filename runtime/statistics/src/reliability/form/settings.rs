//! Settings of the search for design points.

use crate::Error;

/// Settings of the search for design points.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FormSettings {
    /// Maximum residual of a design point, for both limit and direction; see [`Residuals`](crate::reliability::Residuals).
    pub tolerance: f64,
    /// Steps of the Hasofer-Lind-Rackwitz-Fiessler iteration before the general optimiser takes over.
    pub iterations: usize,
    /// Maximum number of evaluations of the general optimiser from one start; zero disables it.
    pub optimiser_evaluations: usize,
    /// Number of starts in random directions and their opposites, in addition to the one at the origin. Each costs
    /// about as much as that.
    pub restarts: usize,
    /// Seed of the random directions.
    pub seed: u64,
    /// Maximum distance of design points from the origin, in standard deviations.
    pub radius: f64,
    /// Design points whose mutual distance is below this fraction of their distance from the origin (or of 1, if that
    /// is larger) belong to one failure region.
    pub separation: f64,
    /// Maximum number of failure regions.
    pub regions: usize,
}

impl Default for FormSettings {
    fn default() -> Self {
        Self {
            tolerance: 1e-9,
            iterations: 30,
            optimiser_evaluations: 300,
            restarts: 4,
            seed: 1,
            radius: 100.0,
            separation: 0.1,
            regions: 16,
        }
    }
}

impl FormSettings {
    pub(super) fn check(&self) -> Result<(), Error> {
        let positive = [("tolerance", self.tolerance), ("radius", self.radius), ("separation", self.separation)];
        for (setting, value) in positive {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Error::setting(setting, format!("{value} is not positive and finite")));
            }
        }
        let reason = "at least one is needed".to_string();
        match (self.iterations, self.regions) {
            (0, _) => Err(Error::setting("iterations", reason)),
            (_, 0) => Err(Error::setting("regions", reason)),
            _ => Ok(()),
        }
    }
}
