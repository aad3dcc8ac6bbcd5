//! The space in which tolerances are sampled: independent standard normal numbers, only as many as matter.

use crate::algebra::Vector;
use crate::tolerance::Tolerances;
use crate::{Equilibrium, Error};

/// The standard normal space behind the tolerances about a nominal design.
pub(super) struct Space<'a> {
    pub(super) nominal: &'a [f64],
    pub(super) tolerances: &'a Tolerances,
    dimensions: Vec<usize>,
}

impl<'a> Space<'a> {
    pub(super) fn new(nominal: &'a Equilibrium, tolerances: &'a Tolerances) -> Result<Self, Error> {
        tolerances.check_count(nominal.design.len())?;
        Ok(Self { nominal: &nominal.design, tolerances, dimensions: tolerances.normal_dimensions() })
    }

    /// Number of dimensions; zero if nothing varies.
    pub(super) fn dimensions(&self) -> usize {
        self.dimensions.len()
    }

    /// The varying design variables.
    pub(super) fn variables(&self) -> Vec<usize> {
        let sigmas = self.tolerances.sigmas();
        (0..sigmas.len()).filter(|&i| sigmas[i] > 0.0).collect()
    }

    /// Expands the numbers that matter to one standard normal number per design variable.
    pub(super) fn standard(&self, z: impl Iterator<Item = f64>) -> Vector {
        let mut all = Vector::zeros(self.nominal.len());
        for (&j, z) in self.dimensions.iter().zip(z) {
            all[j] = z;
        }
        all
    }

    /// Writes the design (SI) for one standard normal number per design variable.
    pub(super) fn design(&self, z: &[f64], design: &mut [f64]) {
        self.tolerances.design_from_normal(self.nominal, z, design);
    }
}
