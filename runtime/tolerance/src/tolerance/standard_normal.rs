//! Designs as functions of independent standard normal numbers, whatever distribution the variables have.

use super::Tolerances;

impl Tolerances {
    /// Writes the design, SI, that corresponds to independent standard normal numbers, one for each design variable.
    #[doc(hidden)]
    pub fn design_from_normal(&self, nominal: &[f64], z: &[f64], into: &mut [f64]) {
        match self.joint() {
            None if self.correlation().is_none() => {
                let means = nominal.iter().zip(self.shifts());
                let normal = self.sigmas().iter().zip(z);
                for (value, ((nominal, shift), (sigma, z))) in into.iter_mut().zip(means.zip(normal)) {
                    *value = nominal + shift + sigma * z;
                }
            }
            None => {
                let means = nominal.iter().zip(self.shifts());
                let rows = self.factor().iter().zip(means);
                for (i, (value, (row, (nominal, shift)))) in into.iter_mut().zip(rows).enumerate() {
                    *value = row[..=i].iter().zip(z).fold(nominal + shift, |sum, (l, z)| sum + l * z);
                }
            }
            Some((joint, about)) => {
                joint.from_normal(z, into);
                for (value, (nominal, about)) in into.iter_mut().zip(nominal.iter().zip(about)) {
                    *value += nominal - about;
                }
            }
        }
    }

    /// The dimensions of the standard normal space that any variable depends on.
    #[doc(hidden)]
    pub fn normal_dimensions(&self) -> Vec<usize> {
        let variables = 0..self.sigmas().len();
        let matters = |j: usize| match self.joint() {
            None => self.factor().iter().any(|row| row[j] != 0.0),
            Some((joint, _)) => (variables.clone()).any(|i| self.sigmas()[i] > 0.0 && joint.normal_factor(i, j) != 0.0),
        };
        variables.clone().filter(|&j| matters(j)).collect()
    }
}
