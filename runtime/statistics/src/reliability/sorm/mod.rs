//! The second-order reliability method: the limit approximated by a paraboloid at its design point.

mod curvature;
mod paraboloid;

use super::counted::{Counted, Evaluations};
use super::form::DesignPoint;
use super::limit_state::LimitState;
use crate::Error;
use crate::normal;

/// The osculating paraboloid of the limit at a design point.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sorm {
    beta: f64,
    curvatures: Vec<f64>,
    evaluations: Evaluations,
}

/// Fits a paraboloid at a design point, from exact second derivatives if the limit state provides them, otherwise from
/// central differences of its gradient in the tangent plane. The latter take two evaluations for each variable but one.
///
/// # Errors
///
/// If the limit state has no value near the design point, or if its matrix of second derivatives has the wrong size.
///
/// # Examples
///
/// ```
/// use core::convert::Infallible;
/// use eigentol_statistics::reliability::{FormSettings, LimitFunction, LimitValue, form, sorm};
///
/// // A paraboloid at distance 3, with curvature 0.2.
/// let limit = LimitFunction::new(2, |z: &[f64]| {
///     let value = 3.0 - z[0] + 0.1 * z[1] * z[1];
///     Ok::<_, Infallible>(LimitValue { value, gradient: vec![-1.0, 0.2 * z[1]] })
/// });
/// let at = form(&limit, &FormSettings::default())?.design_point;
/// let second_order = sorm(&limit, &at)?;
/// assert!((second_order.curvatures()[0] - 0.2).abs() < 1e-9);
/// let breitung = at.probability() / (1.0_f64 + 3.0 * 0.2).sqrt();
/// assert!((second_order.breitung()? / breitung - 1.0).abs() < 1e-8);
/// # Ok::<(), eigentol_statistics::Error>(())
/// ```
pub fn sorm<L: LimitState>(limit: &L, at: &DesignPoint) -> Result<Sorm, Error> {
    let counted = Counted::new(limit)?;
    if at.point.len() != counted.dimension() {
        return Err(Error::WrongLength {
            kind: "coordinates of the design point",
            found: at.point.len(),
            expected: counted.dimension(),
        });
    }
    let curvatures = curvature::principal_curvatures(&counted, at)?;
    Ok(Sorm { beta: at.beta, curvatures, evaluations: counted.evaluations() })
}

impl Sorm {
    /// Principal curvatures of the limit (dimensionless), ascending, one fewer than there are variables.
    ///
    /// Positive ones make the failure region smaller.
    pub fn curvatures(&self) -> &[f64] {
        &self.curvatures
    }

    /// Number of evaluations of the limit state.
    pub fn evaluations(&self) -> Evaluations {
        self.evaluations
    }

    /// `Phi(-beta) prod (1 + beta kappa_i)^(-1/2)`, asymptotically exact for large `beta` (Breitung 1984, *Asymptotic
    /// approximations for multinormal integrals*, J. Eng. Mech. 110).
    ///
    /// # Errors
    ///
    /// [`Error::Curvature`] if `beta kappa <= -1`.
    pub fn breitung(&self) -> Result<f64, Error> {
        self.product("Breitung", |side| side.beta)
    }

    /// `Phi(-beta) prod (1 + psi kappa_i)^(-1/2)` with `psi = phi(beta) / Phi(-beta)` (Hohenbichler and Rackwitz 1988,
    /// *Improvement of second-order reliability estimates by importance sampling*, J. Eng. Mech. 114).
    ///
    /// # Errors
    ///
    /// [`Error::Curvature`] if `psi kappa <= -1`.
    pub fn hohenbichler_rackwitz(&self) -> Result<f64, Error> {
        self.product("Hohenbichler and Rackwitz", |side| normal::hazard(side.beta))
    }

    /// The exact probability of the paraboloid, by numerical integration (Tvedt 1990, *Distribution of quadratic forms
    /// in normal space*, J. Eng. Mech. 116).
    ///
    /// # Errors
    ///
    /// [`Error::Curvature`] if `beta kappa <= -1`: the design point is then not the nearest point of the paraboloid.
    pub fn tvedt(&self) -> Result<f64, Error> {
        const FORMULA: &str = "Tvedt";
        let side = self.far_side();
        side.require(FORMULA, side.beta)?;
        let beyond = paraboloid::probability_beyond(side.beta, &side.curvatures);
        let least = side.curvatures.first().copied().unwrap_or(0.0);
        let beyond = beyond.ok_or(self.refusal(FORMULA, least))?;
        Ok(self.of_failure(beyond))
    }

    fn product(&self, formula: &'static str, factor: fn(&Self) -> f64) -> Result<f64, Error> {
        let side = self.far_side();
        let factor = factor(&side);
        side.require(formula, factor)?;
        let roots = side.curvatures.iter().map(|kappa| (1.0 + factor * kappa).sqrt());
        Ok(self.of_failure(normal::cdf(-side.beta) / roots.product::<f64>()))
    }

    fn require(&self, formula: &'static str, factor: f64) -> Result<(), Error> {
        match self.curvatures.first() {
            Some(&least) if 1.0 + factor * least <= 0.0 => Err(self.refusal(formula, least)),
            _ => Ok(()),
        }
    }

    fn refusal(&self, formula: &'static str, curvature: f64) -> Error {
        Error::Curvature { formula, curvature, beta: self.beta }
    }

    /// The same limit with the roles of safe and failing sides exchanged if the origin fails.
    fn far_side(&self) -> Self {
        if self.beta >= 0.0 {
            return self.clone();
        }
        Self {
            beta: -self.beta,
            curvatures: self.curvatures.iter().rev().map(|kappa| -kappa).collect(),
            evaluations: self.evaluations,
        }
    }

    fn of_failure(&self, beyond: f64) -> f64 {
        if self.beta >= 0.0 { beyond } else { 1.0 - beyond }
    }
}
