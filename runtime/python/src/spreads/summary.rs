//! Whether spreads can be trusted.

use std::collections::BTreeMap;

use eigentol::summary::{Advice, Check, Trust};
use pyo3::prelude::*;

use super::first_order::FirstOrder;
use super::second_order::SecondOrder;
use super::shared::texts;
use crate::arrays::{Array1, optional, vector};
use crate::clusters::Clusters;
use crate::hints;
use crate::results::{attributes, quantity, result};

/// What to use. In Python `Literal["first order", "second order", "cluster", "samples"]`.
type Advised = str;

result! {
    /// First order, second order, and for each mode whether its standard deviation can be trusted.
    Summary(eigentol::summary::Summary)
}

attributes! {
    Summary(self, py) {
        /// The first-order spread.
        first: FirstOrder = FirstOrder(self.0.first.clone());
        /// The spread to second order.
        second: SecondOrder = SecondOrder(self.0.second.clone());
        /// Whether every mode is trusted.
        trusted: bool = self.0.trusted();
        /// For each mode why its standard deviation is in doubt: texts, none where it can be trusted.
        doubts: Vec<Vec<String>> = self.0.trust.iter().map(|x| texts(&x.doubts)).collect();
        /// Whether each mode is trusted, shape (m,).
        trusted_modes: Array1<'py, bool> = vector(py, self.0.trust.iter().map(Trust::trusted));
        /// What to use for each mode: "first order", "second order", "cluster" or "samples".
        use_instead: Vec<&'static Advised> = {
            let word = |trust: &Trust| match trust.advice {
                Advice::FirstOrder => "first order",
                Advice::SecondOrder => "second order",
                Advice::Cluster => "cluster",
                _ => "samples",
            };
            self.0.trust.iter().map(word).collect()
        };
        /// The modes that tolerances bring together.
        clusters: Clusters = Clusters(self.0.clusters.clone());
        /// Number of samples that judged; None where none were needed or they are too dear.
        samples: Option<usize> = self.0.sampled().map(|x| x.samples);
        /// How probable each outcome is by the samples, by name: 95 % interval.
        outcomes: BTreeMap<String, (f64, f64)> = {
            let all = self.0.sampled().into_iter().flat_map(|x| &x.outcomes);
            all.map(|(outcome, chance)| (format!("{outcome:?}"), (chance.lower, chance.upper))).collect()
        };
        /// How probable it is that a design settles on another branch: 95 % interval; None where it was not looked for.
        on_another_branch: Option<(f64, f64)> = {
            let chance = self.0.sampled()?.other_branch?;
            Some((chance.lower, chance.upper))
        };
    }
}

impl Summary {
    fn checks<'py>(&self, py: Python<'py>, name: &str, of: impl Fn(&Check) -> Option<f64>) -> PyResult<Array1<'py>> {
        let wanted = quantity(py, name)?;
        let all = self.0.trust.iter();
        Ok(optional(py, all.map(|x| x.check(wanted).and_then(&of))))
    }
}

attributes! {
    Summary(self, py, quantity: hints::Quantity = "frequency") {
        /// Means of a quantity over the samples that judged, shape (m,); NaN where there are none.
        sampled_mean: Array1<'py> = self.checks(py, quantity, |check| Some(check.mean));
        /// Standard deviations likewise, shape (m,).
        sampled_sigma: Array1<'py> = self.checks(py, quantity, |check| Some(check.sigma.value));
        /// Standard errors of these, shape (m,).
        sampled_sigma_error: Array1<'py> =
            self.checks(py, quantity, |check| Some(check.sigma.standard_error));
        /// Relative errors of the standard deviations to first order by the same samples, shape (m,).
        first_order_error: Array1<'py> =
            self.checks(py, quantity, |check| check.first_order_error.map(|error| error.value));
        /// Relative errors of those to second order, shape (m,).
        second_order_error: Array1<'py> =
            self.checks(py, quantity, |check| check.second_order_error.map(|error| error.value));
    }
}
