//! Modes whose eigenvalues are equal, or so close that tolerances mix them.

use eigentol::clusters::{ClusterSpread, ClusterTolerance, SortedSpread};
use eigentol::{Complex, tolerance::Statistics};
use pyo3::prelude::*;

use crate::arrays::{Array1, optional, vector};
use crate::hints;
use crate::results::{Answer, Described, attributes, family, result};
use crate::study::Study;
use crate::values::{List, mode_number, word};

#[pymethods]
impl Study {
    /// The modes that tolerances bring together, and their spread.
    fn clusters(&self, py: Python<'_>) -> PyResult<Clusters> {
        self.ask(py, |study| study.clusters()).map(Clusters)
    }

    /// Derivatives of the eigenvalues in the cluster of a mode, counted from 0, along a change of inputs and design
    /// variables: lists, SI, or dictionaries by name; what is not named stays as it is. Equal eigenvalues split
    /// differently in each direction.
    #[pyo3(signature = (mode, inputs=None, design=None))]
    fn directional_derivatives(
        &self,
        py: Python<'_>,
        mode: i64,
        inputs: Option<&hints::Numbers<'_>>,
        design: Option<&hints::Numbers<'_>>,
    ) -> PyResult<Answer> {
        let mode = mode_number(py, mode)?;
        let of = self.inner.description();
        let inputs = List::Inputs.changes(py, of, inputs)?;
        let design = List::Design.changes(py, of, design)?;
        self.ask(py, |study| study.directional_derivatives(mode, (&inputs, &design))).map(Answer::new)
    }
}

result! {
    /// The modes that tolerances bring together. `k` is the number of clusters.
    Clusters(Vec<ClusterTolerance>), crate::results::typed
}

impl Clusters {
    fn counts<'py>(&self, py: Python<'py>, of: fn(&ClusterSpread) -> usize) -> Array1<'py, i64> {
        let count = |cluster_tolerance: &ClusterTolerance| {
            cluster_tolerance.spread.as_ref().map_or(0, |spread| of(spread) as i64)
        };
        vector(py, self.0.iter().map(count))
    }

    /// A number of each member in ascending order, and of the distance of the lowest from the highest, for each cluster.
    fn members<'py>(
        &self,
        py: Python<'py>,
        quantity: &str,
        of: impl Fn(&Statistics) -> Option<f64>,
    ) -> PyResult<Vec<Array1<'py>>> {
        type Part = fn(&ClusterSpread) -> Option<&SortedSpread>;
        let words: [(&str, Part); 4] = [
            ("frequency", |x| Some(&x.frequency)),
            ("lambda", |x| x.lambda.as_ref()),
            ("growth", |x| x.growth.as_ref()),
            ("damping_ratio", |x| x.damping_ratio.as_ref()),
        ];
        let part = word(py, "quantity", quantity, &words)?;
        let each = self.0.iter().map(|item| {
            let spread = item.spread.as_ref().ok().and_then(part);
            let members = (0..item.modes.len()).map(|k| spread?.members.get(k)?.value.as_ref());
            optional(py, members.chain([spread.and_then(|spread| spread.splitting.as_ref())]).map(|x| x.and_then(&of)))
        });
        Ok(each.collect())
    }
}

attributes! {
    Clusters(self, py) {
        /// Positions of the modes of each cluster, from 0.
        modes: Vec<Vec<usize>> = self.0.iter().map(|x| x.modes.clone()).collect();
        /// Least distance of two members, in standard deviations of their difference, shape (k,).
        distances: Array1<'py> = vector(py, self.0.iter().map(|x| x.distance));
        /// Nominal eigenvalues of each cluster: lambda (1/s^2) of undamped modes, s (1/s) of general ones, complex.
        eigenvalues: Vec<Array1<'py, Complex>> =
            self.0.iter().map(|cluster| vector(py, cluster.eigenvalues.iter().copied())).collect();
        /// Whether the members of each are equal in every design, shape (k,).
        equal: Array1<'py, bool> = vector(py, self.0.iter().map(|x| x.equal));
        /// Means of the eigenvalues of each, complex, shape (k,); NaN where they have merged.
        mean_eigenvalues: Array1<'py, Complex> = {
            let none = Complex::new(f64::NAN, f64::NAN);
            vector(py, self.0.iter().map(|item| item.mean.as_ref().map_or(none, |x| x.value)))
        };
        /// Standard deviations of the mean frequencies to first order, rad/s, shape (k,).
        mean_frequency_sigmas: Array1<'py> = {
            optional(py, self.0.iter().map(|x| x.mean.as_ref()?.frequency.as_ref()).map(|x| Some(x?.sigma)))
        };
        /// Numbers of samples behind the members of each, shape (k,).
        samples: Array1<'py, i64> = self.counts(py, |spread| spread.samples);
        /// Why the members of a cluster have no spread: a text for each cluster, or None.
        failures: Vec<Option<String>> =
            self.0.iter().map(|cluster| Some(cluster.spread.as_ref().err()?.to_string())).collect();
        /// "undamped" or "general"; None without clusters.
        family: Option<&'static hints::Family> = Some(family(self.0.first()?.family));
        /// Whether the members of each have merged into one eigenvalue that no derivative describes.
        defective: Vec<bool> = self.0.iter().map(ClusterTolerance::defective).collect();
        /// Numbers of samples that are unstable, shape (k,).
        unstable: Array1<'py, i64> = self.counts(py, |spread| spread.unstable);
        /// Numbers of samples that could not be solved, shape (k,).
        unsolved: Array1<'py, i64> = self.counts(py, |spread| spread.unsolved);
        /// Standard deviations that a tolerance and a band stand for; None without clusters.
        sigma_level: Option<f64> = Some(self.0.first()?.sigma_level);
    }
}

attributes! {
    Clusters(self, py, quantity: hints::QuantityOrLambda = "frequency") {
        /// Means of the members of each cluster from the lowest up, and at last of the distance of the highest from the
        /// lowest: arrays of shape (members + 1,). The quantity is "frequency" (rad/s), "lambda" (1/s^2), "growth" (1/s) or
        /// "damping_ratio".
        mean: Vec<Array1<'py>> = self.members(py, quantity, |statistics| Some(statistics.mean));
        /// Standard deviations likewise.
        sigma: Vec<Array1<'py>> = self.members(py, quantity, |statistics| statistics.sigma);
    }
}

#[pymethods]
impl Clusters {
    fn __len__(&self) -> usize {
        self.0.len()
    }
}
