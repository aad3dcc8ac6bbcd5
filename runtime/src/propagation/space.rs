//! Where tolerances are sampled: independent standard normal numbers, as many as anything depends on.

use crate::algebra::Vector;
use crate::tolerance::Tolerances;
use crate::{Equilibrium, Error};

/// The standard normal space behind the tolerances about a nominal design.
pub(super) struct Space<'a> {
    pub(super) nominal: &'a [f64],
    pub(super) tolerances: &'a Tolerances,
    dimensions: Vec<usize>,
}

/// A point of the space and its design.
pub(super) struct Point {
    z: Vector,
    design: Vector,
}

impl<'a> Space<'a> {
    pub(super) fn new(nominal: &'a Equilibrium, tolerances: &'a Tolerances) -> Result<Self, Error> {
        tolerances.check_count(nominal.design.len())?;
        Ok(Self {
            nominal: &nominal.design,
            tolerances,
            dimensions: tolerances.normal_dimensions(),
        })
    }

    /// Number of dimensions; zero where nothing varies.
    pub(super) fn dimensions(&self) -> usize {
        self.dimensions.len()
    }

    /// The design variables that vary.
    pub(super) fn variables(&self) -> Vec<usize> {
        let sigmas = self.tolerances.sigmas();
        (0..sigmas.len()).filter(|&i| sigmas[i] > 0.0).collect()
    }

    pub(super) fn point(&self) -> Point {
        Point {
            z: Vector::zeros(self.nominal.len()),
            design: self.nominal.into(),
        }
    }

    /// One standard normal number for each design variable, from those that matter.
    pub(super) fn standard(&self, z: impl Iterator<Item = f64>) -> Vector {
        let mut all = Vector::zeros(self.nominal.len());
        for (&j, z) in self.dimensions.iter().zip(z) {
            all[j] = z;
        }
        all
    }

    /// The design, SI, that belongs to one standard normal number for each dimension.
    pub(super) fn design<'p>(
        &self,
        point: &'p mut Point,
        z: impl Iterator<Item = f64>,
    ) -> &'p [f64] {
        for (&j, z) in self.dimensions.iter().zip(z) {
            point.z[j] = z;
        }
        let Point { z, design } = point;
        self.tolerances.design_from_normal(self.nominal, z, design);
        design
    }
}
