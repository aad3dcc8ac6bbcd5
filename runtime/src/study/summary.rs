//! Verdicts on first-order results of a study.

use super::subject::SolvedSubject;
use super::{Solved, Study};
use crate::Error;
use crate::kernels::SummaryKernels;
use crate::summary::{self, BUDGET, Summary};

impl<M: SummaryKernels> Solved<'_, M> {
    /// First-order spread, second-order spread and clusters, and for each mode whether its standard deviation can be
    /// trusted ([`summary::summary`]). The samples
    /// that judge are always the same, whatever [`Study::samples`] and [`Study::seed`].
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// println!("{}", study.solve()?.summary()?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Solved::sensitivities`] and [`Study::tolerances`].
    pub fn summary(&self) -> Result<Summary, Error> {
        self.summary_within(BUDGET)
    }

    /// Like [`Solved::summary`], with a limit on the number of operations spent on samples
    /// ([`summary::summary_within`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// // No samples: distances and the second-order model.
    /// assert!(study.solve()?.summary_within(0.0)?.sampled().is_none());
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Solved::summary`].
    pub fn summary_within(&self, operations: f64) -> Result<Summary, Error> {
        self.subject::<dyn SummaryKernels>(&self.study.mechanism)
            .summary_within(operations)
    }
}

impl<M: SummaryKernels> Study<M> {
    /// First-order spread, second-order spread and clusters, and for each mode whether its standard deviation can be
    /// trusted ([`summary`](crate::summary::summary)). The samples
    /// that judge are always the same, whatever [`Study::samples`] and [`Study::seed`].
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// assert!(study.summary()?.trusted());
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::sensitivities`] and [`Study::tolerances`].
    pub fn summary(&self) -> Result<Summary, Error> {
        self.solve()?.summary()
    }
}

impl SolvedSubject<'_, dyn SummaryKernels + '_> {
    fn summary_within(&self, operations: f64) -> Result<Summary, Error> {
        self.deviating(|own| {
            summary::summary_watched(
                own.kernels,
                (own.equilibrium, own.modes),
                own.settings.tolerances()?,
                operations,
                own.settings.watch(),
            )
        })
    }
}
