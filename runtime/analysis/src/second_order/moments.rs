//! Moments of a second-order model.

use super::quadratic::{ModelMoments, Quadratic, beyond_range};
use super::sampled::sampled_moments;
use super::standard::Standard;
use crate::Error;
use crate::tolerance::Tolerances;

impl Quadratic {
    /// Mean, standard deviation, skewness and kurtosis of the model.
    ///
    /// With `a = L^T S` and `B = L^T H L`, `Sigma = L L^T`, the cumulants are
    /// `k_r = (r - 1)! tr(B^r) / 2 + r! a^T B^(r-2) a / 2` for `r >= 2` (Mathai and Provost, Quadratic Forms in Random
    /// Variables, 1992, section 3.2).
    ///
    /// # Errors
    /// [`Error::NotFinite`] for a model that is not finite, [`Error::WrongLength`] if the model and the tolerances
    /// differ in the number of design variables, [`Error::Setting`] for a spread beyond the range of a double.
    pub fn moments(&self, tolerances: &Tolerances) -> Result<ModelMoments, Error> {
        self.check(tolerances)?;
        let central = self.about_means(tolerances);
        let mut moments = Standard::new(&central, tolerances)?.moments(central.value);
        if let Some((joint, about)) = tolerances.joint() {
            let mean = moments.mean - self.value;
            let (variance, skewness, kurtosis) = sampled_moments(self, (joint, about), mean)?;
            let linear = moments.first_order_sigma.powi(2);
            moments.curvature_sigma = (variance - linear).abs().sqrt();
            moments.sigma = variance.sqrt();
            moments.skewness = skewness;
            moments.excess_kurtosis = kurtosis;
        }
        if moments.mean.is_finite() && moments.sigma.is_finite() { Ok(moments) } else { Err(beyond_range()) }
    }
}
