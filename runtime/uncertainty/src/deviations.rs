//! Designs as functions of independent standard normal numbers, with shifted nominal values and tolerances scaled about
//! their means.

use eigentol_statistics::{Distribution, semidefinite_factor};

use crate::algebra::Vector;
use crate::tolerance::Tolerances;
use crate::{Description, Error};

/// The deviations of designs from a nominal one.
#[derive(Clone, Debug)]
pub(crate) struct Deviations<'a> {
    tolerances: &'a Tolerances,
    nominal: Vector,
    /// Scale of each half-width, relative to the tolerances.
    scales: Vector,
    /// Factor of the correlation matrix, row by row, for the standard normal variables behind design variables whose
    /// half-width is zero; empty without a correlation matrix.
    root: Vec<f64>,
}

impl<'a> Deviations<'a> {
    /// Deviations of `tolerances` about a nominal design.
    ///
    /// # Errors
    /// [`Error::WrongLength`] for tolerances of another mechanism, [`Error::Setting`] for a correlation that cannot be
    /// factorised.
    pub(crate) fn new(tolerances: &'a Tolerances, nominal: &[f64]) -> Result<Self, Error> {
        tolerances.check_count(nominal.len())?;
        let size = nominal.len();
        let root = match (tolerances.correlation(), tolerances.joint()) {
            (Some(matrix), None) => semidefinite_factor(matrix.as_flattened(), size)?,
            _ => Vec::new(),
        };
        Ok(Self { tolerances, nominal: nominal.into(), scales: Vector::filled(size, 1.0), root })
    }

    /// Rejects variables without a density, which are not smooth functions of normal ones.
    pub(crate) fn check_densities(&self, description: &Description) -> Result<(), Error> {
        let all = self.tolerances.joint().map(|(joint, _)| joint.variables());
        let discrete = all.and_then(|all| all.iter().position(|x| !Distribution::is_continuous(x)));
        let Some(k) = discrete else {
            return Ok(());
        };
        let name = description.design.get(k).map_or("", |info| &*info.name);
        Err(Error::setting(
            "distribution",
            format!("`{name}` takes discrete values: a design point needs a density, sampling does not"),
        ))
    }

    /// The deviations about another nominal design, with other half-widths; those that are zero stay zero.
    pub(crate) fn moved(&self, nominal: &[f64], half_widths: &[f64]) -> Self {
        let scales = half_widths
            .iter()
            .zip(self.tolerances.half_widths())
            .map(|(new, old)| if *old > 0.0 { new / old } else { 1.0 });
        Self { nominal: nominal.into(), scales: scales.collect(), ..self.clone() }
    }

    pub(crate) fn dimension(&self) -> usize {
        self.nominal.len()
    }

    pub(crate) fn tolerances(&self) -> &'a Tolerances {
        self.tolerances
    }

    fn mean(&self, k: usize) -> f64 {
        self.nominal[k] + self.tolerances.shifts()[k]
    }

    fn unscaled(&self, z: &[f64]) -> Vector {
        let mut design = Vector::zeros(self.dimension());
        self.tolerances.design_from_normal(&self.nominal, z, &mut design);
        design
    }

    /// The design (SI) for given independent standard normal numbers.
    pub(crate) fn design(&self, z: &[f64]) -> Vector {
        let mut design = self.unscaled(z);
        for (k, (value, scale)) in design.iter_mut().zip(&self.scales).enumerate() {
            if *scale != 1.0 {
                *value = self.mean(k) + scale * (*value - self.mean(k));
            }
        }
        design
    }

    /// Transforms derivatives with respect to the design variables into derivatives with respect to the standard normal
    /// numbers.
    pub(crate) fn gradient(&self, z: &[f64], by_design: &[f64]) -> Vec<f64> {
        let scaled: Vec<f64> = by_design.iter().zip(&self.scales).map(|(a, s)| a * s).collect();
        let mut by_normal = vec![0.0; self.dimension()];
        match self.tolerances.joint() {
            Some((joint, _)) => joint.gradient_by_normal(z, &scaled, &mut by_normal),
            None => {
                for (slope, row) in scaled.iter().zip(self.tolerances.factor().iter()) {
                    for (sum, l) in by_normal.iter_mut().zip(row) {
                        *sum += slope * l;
                    }
                }
            }
        }
        by_normal
    }

    /// Derivative of each design variable with respect to its own half-width, scaling the distribution about its mean.
    pub(crate) fn by_half_width(&self, z: &[f64]) -> Vector {
        let design = self.unscaled(z);
        self.tolerances
            .half_widths()
            .iter()
            .enumerate()
            .map(|(k, half_width)| {
                if *half_width > 0.0 {
                    (design[k] - self.mean(k)) / half_width
                } else {
                    self.own_normal(k, z) / self.tolerances.sigma_level()
                }
            })
            .collect()
    }

    /// The standard normal variable behind a variable that does not vary.
    fn own_normal(&self, k: usize, z: &[f64]) -> f64 {
        let size = self.dimension();
        let element = |j: usize| match self.tolerances.joint() {
            Some((joint, _)) => joint.normal_factor(k, j),
            None if self.root.is_empty() => f64::from(u8::from(j == k)),
            None => self.root[k * size + j],
        };
        (0..size).map(|j| element(j) * z[j]).sum()
    }

    /// Share of each design variable in the variance of a function linearised at `z`: `s_k (Sigma s)_k / (s Sigma s)`,
    /// with the slopes `s` of the function and the covariance `Sigma` of the equivalent normal variables. The shares
    /// sum to 1; for independent variables they are the squares of the direction cosines.
    pub(crate) fn shares(&self, z: &[f64], by_design: &[f64]) -> Vector {
        let by_normal = self.gradient(z, by_design);
        let square: f64 = by_normal.iter().map(|slope| slope * slope).sum();
        let size = self.dimension();
        let share = |k: usize| {
            let mut alone = vec![0.0; size];
            alone[k] = by_design[k];
            self.gradient(z, &alone).iter().zip(&by_normal).map(|(a, b)| a * b).sum::<f64>() / square
        };
        (0..size).map(share).collect()
    }
}
