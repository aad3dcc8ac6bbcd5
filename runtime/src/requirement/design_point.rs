//! The most probable design that just fails, in the terms of the design variables.

use eigentol_statistics::reliability::{self, FormSensitivity, LimitState, sorm};

use super::deviations::Deviations;
use super::limit::LimitAt;
use crate::Error;
use crate::algebra::Vector;

/// How far beside a design point it is tried whether the limit lies there, in standard deviations.
const STEP: f64 = 1e-3;

/// A design point: of all designs on a limit, the most probable one, at least in its neighbourhood.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DesignPoint {
    /// The design variables there, SI.
    pub design: Vector,
    /// The same in standard normal space.
    pub normal: reliability::DesignPoint,
    /// The part of each design variable in the variance of the limit linearised here. Their sum is 1; of correlated variables
    /// some may be negative.
    pub importance: Vector,
    /// Derivatives of the reliability index and of the first-order probability by the nominal value of each design variable, per
    /// SI unit, tolerances moved along with it.
    pub by_nominal: Vec<FormSensitivity>,
    /// Derivatives by each half-width, per SI unit, the distribution scaled about its mean, correlation unchanged.
    pub by_half_width: Vec<FormSensitivity>,
    /// Principal curvatures of the limit in standard normal space; `None` where it has no value beside the point.
    pub curvatures: Option<Vec<f64>>,
    /// Probability of failure by the paraboloid with these curvatures, exactly (Tvedt); `None` without curvatures or where these
    /// bend around the origin more than a sphere.
    pub second_order: Option<f64>,
    /// Whether the mechanism, solved anew, fails a thousandth of a standard deviation beyond this point and does not as far before
    /// it.
    pub verified: bool,
}

impl DesignPoint {
    /// The reliability index: distance from the origin of standard normal space, negative where the origin fails.
    #[must_use]
    pub fn beta(&self) -> f64 {
        self.normal.beta
    }

    /// Probability of failure to first order.
    #[must_use]
    pub fn probability(&self) -> f64 {
        self.normal.probability()
    }

    /// # Errors
    /// [`Error::NoReliability`] where the point has no derivatives.
    pub(super) fn new(
        limit: &LimitAt<'_>,
        deviations: &Deviations<'_>,
        normal: reliability::DesignPoint,
    ) -> Result<Self, Error> {
        let z = &normal.point;
        let slopes = slopes_at(limit, deviations, &normal)?;
        let second = sorm(limit, &normal).ok();
        Ok(Self {
            design: deviations.design(z),
            importance: deviations.shares(z, &slopes.by_design),
            by_nominal: slopes.by_nominal,
            by_half_width: slopes.by_half_width,
            curvatures: second.as_ref().map(|found| found.curvatures().to_vec()),
            second_order: second.and_then(|found| found.tvedt().ok()),
            verified: crosses(limit, &normal),
            normal,
        })
    }
}

/// Derivatives at a design point, by each design variable.
pub(crate) struct Slopes {
    /// Of the distance from failure.
    by_design: Vec<f64>,
    /// Of the reliability index and the probability, by nominal values.
    pub(crate) by_nominal: Vec<FormSensitivity>,
    /// The same by half-widths.
    pub(crate) by_half_width: Vec<FormSensitivity>,
}

/// # Errors
/// [`Error::NoReliability`] where the point has no derivatives.
pub(crate) fn slopes_at(
    limit: &LimitAt<'_>,
    deviations: &Deviations<'_>,
    at: &reliability::DesignPoint,
) -> Result<Slopes, Error> {
    let (_, by_design) = limit.by_design(&at.point).map_err(|reason| {
        Error::from(eigentol_statistics::Error::NoLimitValue {
            place: "at the design point",
            reason,
        })
    })?;
    let rates = deviations.by_half_width(&at.point);
    let along = by_design.iter().zip(&rates);
    Ok(Slopes {
        by_nominal: by_design
            .iter()
            .map(|slope| at.sensitivity(*slope))
            .collect(),
        by_half_width: along
            .map(|(slope, rate)| at.sensitivity(slope * rate))
            .collect(),
        by_design,
    })
}

/// Whether the limit lies at this point.
fn crosses(limit: &LimitAt<'_>, at: &reliability::DesignPoint) -> bool {
    let beside = |step: f64| {
        let moved = at.point.iter().zip(&at.direction);
        let z: Vec<f64> = moved.map(|(z, n)| z + step * n).collect();
        limit.value(&z).ok()
    };
    let (before, beyond) = (beside(-STEP), beside(STEP));
    before.is_some_and(|value| value > 0.0) && beyond.is_some_and(|value| value <= 0.0)
}
