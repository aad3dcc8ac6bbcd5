//! Equilibria of a mechanism.

use std::collections::BTreeMap;

use eigentol::Matrix;
use pyo3::prelude::*;

use super::{Described, attributes, result};
use crate::arrays::{Array1, Array2, matrix, vector};
use crate::names;

result! {
    /// An equilibrium and the linearised mechanism there, SI. `n` is the number of unknowns.
    Equilibrium(eigentol::Equilibrium), crate::results::typed
}

attributes! {
    Equilibrium(self, py) {
        /// The inputs it belongs to, SI, shape (inputs,).
        inputs: Array1<'py> = vector(py, self.0.inputs.clone());
        /// The design variables it belongs to, SI, shape (design,).
        design: Array1<'py> = vector(py, self.0.design.clone());
        /// Mass matrix Mhat, shape (n, n).
        mass: PyResult<Array2<'py>> = matrix(py, &self.0.linear.mass);
        /// Damping and gyroscopic matrix Chat, shape (n, n).
        damping: PyResult<Array2<'py>> = matrix(py, &self.0.linear.damping);
        /// Stiffness matrix Khat, shape (n, n).
        stiffness: PyResult<Array2<'py>> = matrix(py, &self.0.linear.stiffness);
        /// Remaining residual, N or N m, shape (n,).
        residual: Array1<'py> = vector(py, self.0.residual.clone());
        /// Greatest remaining residual, relative to the forces in its own equation.
        relative_residual: f64 = self.0.relative_residual;
        /// What the mechanism would do there, in words.
        stability: String = self.0.stability.to_string();
        /// Whether no small disturbance grows exponentially; nothing resists a neutral motion, which counts as stable.
        stable: bool = self.0.stability.holds();
        /// The unknowns that hold it in a family of steady motions, with their values, SI.
        held: BTreeMap<String, f64> = {
            let held = self.0.free.held.iter();
            let name = |unknown: usize| self.0.description.coordinates[unknown].name.to_string();
            held.map(|held| (name(held.unknown), held.value)).collect()
        };
        /// Motions that nothing resists, wherever the mechanism stands, shape (r, n).
        free: PyResult<Array2<'py>> = {
            let motions = &self.0.free.motions;
            let columns = self.0.coordinates.len();
            matrix(
                py,
                &Matrix::from_fn(motions.len(), columns, |r, i| motions[r][i]),
            )
        };
        /// Estimated effect of rounding on the residual, relative to the forces in its equation.
        rounding: f64 = self.0.rounding;
        /// Whether it is a singular configuration of the constraints.
        singular: bool = self.0.constraints.singular;
        /// The joint of three turns or the beam that is closest to its singular pose, and how far: 1 at best, 0 there.
        /// None without such joints and beams.
        pose: Option<(String, f64)> = {
            let pose = self.0.pose.as_ref()?;
            Some((pose.joint.to_string(), pose.margin))
        };
        /// Whether the search passed an unstable region: the start was not in the valley of the answer.
        left_unstable_region: bool = self.0.left_unstable_region;
        /// Whether it was asked for whatever its stability.
        kept: bool = self.0.kept;
        /// Names of the unknowns.
        names: Vec<&str> = names::coordinates(&self.0.description);
        /// The unknowns: coordinates (rad or m), after them speeds and reactions of constraints (SI), shape (n,).
        coordinates: Array1<'py> = vector(py, self.0.coordinates.clone());
        /// Iterations spent.
        iterations: usize = self.0.iterations;
        /// Number of coordinates that the constraints leave free.
        freedom: usize = self.0.constraints.freedom;
        /// Number of constraints that follow from others.
        redundant: usize = self.0.constraints.redundant;
        /// Names of the constraints that depend on each other.
        dependent_constraints: Vec<String> =
            self.0.dependent_constraints().map(|dependent_constraint| dependent_constraint.to_string()).collect();
    }
}
