//! The most probable design that just fails, expressed in the design variables.

use eigentol_statistics::reliability::{self, FormSensitivity, LimitState};

use super::limit_at::LimitAt;
use crate::Error;
use crate::algebra::Vector;
use crate::deviations::Deviations;

/// Distance on either side of a design point at which the limit is checked, in standard deviations.
const STEP: f64 = 1e-3;

/// A design point: the most probable of all designs on a limit, at least locally.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DesignPoint {
    /// The design variables at the point, SI.
    pub design: Vector,
    /// The point in standard normal space.
    pub normal: reliability::DesignPoint,
    /// Share of each design variable in the variance of the limit linearised at the point. The shares sum to 1; for
    /// correlated variables some may be negative.
    pub importance: Vector,
    /// Derivatives of the reliability index and the first-order probability with respect to the nominal value of each
    /// design variable, per SI unit, with the tolerances moving along.
    pub by_nominal: Vec<FormSensitivity>,
    /// Derivatives with respect to each half-width, per SI unit, scaling the distribution about its mean at fixed
    /// correlation.
    pub by_half_width: Vec<FormSensitivity>,
    /// Whether the re-solved mechanism fails a thousandth of a standard deviation beyond this point and does not fail
    /// the same distance before it, and designs solved anew agree that the design points of the limit describe its
    /// failure ([`LimitReliability::judgement`](super::LimitReliability::judgement)).
    pub verified: bool,
}

impl DesignPoint {
    /// The reliability index: distance from the origin of standard normal space, negative if the origin fails.
    #[must_use]
    pub fn beta(&self) -> f64 {
        self.normal.beta
    }

    /// First-order failure probability.
    #[must_use]
    pub fn probability(&self) -> f64 {
        self.normal.probability()
    }

    /// The design point with its derivatives.
    ///
    /// # Errors
    /// [`Error::NoReliability`] if the point has no derivatives.
    pub(super) fn new(
        limit: &LimitAt<'_>,
        deviations: &Deviations<'_>,
        normal: reliability::DesignPoint,
    ) -> Result<Self, Error> {
        let z = &normal.point;
        let slopes = slopes_at(limit, deviations, &normal)?;
        Ok(Self {
            design: deviations.design(z),
            importance: deviations.shares(z, &slopes.by_design),
            by_nominal: slopes.by_nominal,
            by_half_width: slopes.by_half_width,
            verified: crosses(limit, &normal),
            normal,
        })
    }
}

/// Derivatives at a design point with respect to each design variable.
pub(crate) struct Slopes {
    /// Derivatives of the distance from failure.
    by_design: Vec<f64>,
    /// Derivatives of the reliability index and the probability with respect to nominal values.
    pub(crate) by_nominal: Vec<FormSensitivity>,
    /// Derivatives of the reliability index and the probability with respect to half-widths.
    pub(crate) by_half_width: Vec<FormSensitivity>,
}

/// Derivatives at a design point.
///
/// # Errors
/// [`Error::NoReliability`] if the point has no derivatives.
pub(crate) fn slopes_at(
    limit: &LimitAt<'_>,
    deviations: &Deviations<'_>,
    at: &reliability::DesignPoint,
) -> Result<Slopes, Error> {
    let (_, by_design) = limit.by_design(&at.point).map_err(|reason| {
        Error::from(eigentol_statistics::Error::NoLimitValue { place: "at the design point", reason })
    })?;
    let rates = deviations.by_half_width(&at.point);
    let along = by_design.iter().zip(&rates);
    Ok(Slopes {
        by_nominal: by_design.iter().map(|slope| at.sensitivity(*slope)).collect(),
        by_half_width: along.map(|(slope, rate)| at.sensitivity(slope * rate)).collect(),
        by_design,
    })
}

/// Whether the limit is crossed at this point.
fn crosses(limit: &LimitAt<'_>, at: &reliability::DesignPoint) -> bool {
    let beside = |step: f64| {
        let z: Vec<f64> = at.point.iter().zip(&at.direction).map(|(z, n)| z + step * n).collect();
        limit.value(&z).ok()
    };
    let (before, beyond) = (beside(-STEP), beside(STEP));
    before.is_some_and(|value| value > 0.0) && beyond.is_some_and(|value| value <= 0.0)
}
