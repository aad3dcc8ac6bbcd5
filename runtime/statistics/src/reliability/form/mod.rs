//! The first-order reliability method (Hasofer and Lind 1974): the point of the limit nearest to the origin, and the
//! probability beyond the tangent plane there.

mod bulge;
mod design_point;
mod optimiser;
mod regions;
mod search;
mod settings;

pub use design_point::{DesignPoint, FormSensitivity};
pub use regions::FailureRegions;
pub use settings::FormSettings;

use super::closest::Evaluations;
use super::counted::Counted;
use super::limit_state::LimitState;
use crate::Error;

/// The nearest design point, and the evaluations used to find it.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FormResult {
    /// The design point nearest to the origin.
    pub design_point: DesignPoint,
    /// Number of evaluations of the limit state.
    pub evaluations: Evaluations,
}

/// Finds the design point nearest to the origin, by a search from the origin and restarts in random directions.
///
/// # Errors
///
/// If a setting is invalid, if the limit state has no value at the origin, or if no start leads to a design point:
/// [`Error::NoDesignPoint`] then contains the best point, for example if nothing fails at all.
///
/// # Examples
///
/// ```
/// use core::convert::Infallible;
/// use eigentol_statistics::reliability::{FormSettings, LimitFunction, LimitValue, form};
///
/// let limit = LimitFunction::new(2, |z: &[f64]| {
///     let value = 10.0 - 3.0 * z[0] - 4.0 * z[1];
///     Ok::<_, Infallible>(LimitValue { value, gradient: vec![-3.0, -4.0] })
/// });
/// let found = form(&limit, &FormSettings::default())?.design_point;
/// assert!((found.beta - 2.0).abs() < 1e-12);
/// assert!((found.importance_factors()[0] - 0.36).abs() < 1e-12);
/// # Ok::<(), eigentol_statistics::Error>(())
/// ```
pub fn form<L: LimitState>(limit: &L, settings: &FormSettings) -> Result<FormResult, Error> {
    let FailureRegions { mut design_points, evaluations, .. } = regions::by_restarts(&Counted::new(limit)?, settings)?;
    Ok(FormResult { design_point: design_points.swap_remove(0), evaluations })
}

/// Finds the design points of several failure regions: those found by [`form`], then those found after placing bulges
/// at the known ones (Der Kiureghian and Dakessian 1998), until no more are found.
///
/// # Errors
///
/// Those of [`form`].
pub fn failure_regions<L: LimitState>(limit: &L, settings: &FormSettings) -> Result<FailureRegions, Error> {
    regions::by_bulges(&Counted::new(limit)?, settings)
}
