//! Branches of equilibria.

use pyo3::prelude::*;

use super::{Equilibrium, attributes, result};
use crate::arrays::{Array1, Array2, rows, vector};

result! {
    /// The branches of equilibria along an input.
    Branches(eigentol::branches::Branches)
}

attributes! {
    Branches(self, py) {
        /// The branches.
        branches: Vec<Branch> = self.0.branches.iter().cloned().map(Branch).collect();
        /// Whether the search ended early, so that there may be more branches.
        truncated: bool = self.0.truncated;
    }
}

result! {
    /// One branch of equilibria. `k` is the number of its points, `n` that of the unknowns.
    Branch(eigentol::branches::Branch)
}

attributes! {
    Branch(self, py) {
        /// Values of the input, SI, shape (k,).
        values: Array1<'py> = vector(py, self.0.points.iter().map(|point| point.value));
        /// Unknowns, SI, shape (k, n).
        coordinates: PyResult<Array2<'py>> = {
            let all = self.0.points.iter();
            let all = all.map(|x| x.equilibrium.coordinates.to_vec());
            rows(py, self.0.description.coordinates.len(), all)
        };
        /// Whether no small disturbance grows exponentially, at each point; nothing resists a neutral motion, which
        /// counts as stable.
        stable: Vec<bool> =
            self.0.points.iter().map(|point| point.equilibrium.stability.holds()).collect();
        /// The equilibrium at each point.
        equilibria: Vec<Equilibrium> =
            self.0.points.iter().map(|point| Equilibrium(point.equilibrium.clone())).collect();
        /// Derivatives of the unknowns by length along the branch, shape (k, n).
        tangents: PyResult<Array2<'py>> = {
            let all = self.0.points.iter().map(|point| point.tangent.to_vec());
            rows(py, self.0.description.coordinates.len(), all)
        };
        /// The same of the input, SI, shape (k,).
        input_tangents: Array1<'py> = vector(py, self.0.points.iter().map(|point| point.input_tangent));
        /// The equilibria at the special points.
        special_equilibria: Vec<Equilibrium> =
            self.0.special.iter().map(|point| Equilibrium(point.equilibrium.clone())).collect();
        /// Critical vectors of the special points, `Khat v = 0`, shape (special points, n).
        critical_vectors: PyResult<Array2<'py>> = {
            let all = self.0.special.iter().map(|x| x.v.to_vec());
            rows(py, self.0.description.coordinates.len(), all)
        };
        /// Left critical vectors, `Khat^T w = 0`, shape (special points, n).
        left_critical_vectors: PyResult<Array2<'py>> = {
            let all = self.0.special.iter().map(|x| x.w.to_vec());
            rows(py, self.0.description.coordinates.len(), all)
        };
        /// Special points: what each is, in words, and the value of the input there, SI.
        special: Vec<(String, f64)> =
            self.0.special.iter().map(|special| (special.kind.to_string(), special.value)).collect();
        /// How it ends at either side, in words.
        ends: Vec<String> = self.0.ends.iter().map(ToString::to_string).collect();
    }
}
