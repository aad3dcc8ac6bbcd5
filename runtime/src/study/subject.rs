//! What a question is put to: no type of a mechanism in it, so that questions are compiled once. Where inputs have tolerances, it is
//! the mechanism that has their deviations as further design variables.

use super::settings::Settings;
use super::{Solved, Study};
use crate::kernels::{
    BatchKernels, CurvatureKernels, DeviatingInputs, DirectionalKernels, Kernels, SummaryKernels,
};
use crate::{Equilibrium, Error, Modes};

/// A mechanism behind a table of kernels, and how it is studied.
pub(super) struct Subject<'a, K: ?Sized> {
    pub(super) kernels: &'a K,
    pub(super) settings: &'a Settings,
}

/// The same, solved.
pub(super) struct SolvedSubject<'a, K: ?Sized> {
    pub(super) kernels: &'a K,
    pub(super) settings: &'a Settings,
    pub(super) equilibrium: &'a Equilibrium,
    pub(super) modes: &'a Modes,
}

impl<M> Study<M> {
    /// The mechanism behind one of its tables.
    pub(super) fn subject<'a, K: ?Sized>(&'a self, kernels: &'a K) -> Subject<'a, K> {
        Subject {
            kernels,
            settings: &self.settings,
        }
    }
}

impl<M> Solved<'_, M> {
    /// The mechanism behind one of its tables.
    pub(super) fn subject<'a, K: ?Sized>(&'a self, kernels: &'a K) -> SolvedSubject<'a, K> {
        SolvedSubject {
            kernels,
            settings: &self.study.settings,
            equilibrium: &self.equilibrium,
            modes: &self.modes,
        }
    }
}

impl Settings {
    /// The mechanism whose inputs deviate, and its settings; `None` where no input has a tolerance.
    fn deviating<'a, K: Kernels + ?Sized>(
        &self,
        kernels: &'a K,
    ) -> Result<Option<(DeviatingInputs<'a, K>, Self)>, Error> {
        let inputs = self.deviating_inputs();
        if inputs.is_empty() {
            return Ok(None);
        }
        let mechanism = DeviatingInputs::new(kernels, &inputs)?;
        let settings = self.widened(mechanism.description(), mechanism.design(&self.design));
        Ok(Some((mechanism, settings)))
    }
}

macro_rules! deviating {
    ($subject:ident, $table:ident $(, $state:ident)*) => {
        impl<'k> $subject<'_, dyn $table + 'k> {
            /// Puts a question to the mechanism, or to that whose inputs deviate where inputs have tolerances.
            pub(super) fn deviating<R>(
                &self,
                question: impl FnOnce(&$subject<'_, dyn $table + '_>) -> Result<R, Error>,
            ) -> Result<R, Error> {
                match self.settings.deviating(self.kernels)? {
                    None => question(self),
                    Some((mechanism, settings)) => question(&$subject {
                        kernels: &mechanism,
                        settings: &settings,
                        $($state: &self.$state.with_deviations(&mechanism),)*
                    }),
                }
            }
        }
    };
}

deviating!(Subject, Kernels);
deviating!(Subject, DirectionalKernels);
deviating!(Subject, BatchKernels);
deviating!(SolvedSubject, Kernels, equilibrium, modes);
deviating!(SolvedSubject, DirectionalKernels, equilibrium, modes);
deviating!(SolvedSubject, CurvatureKernels, equilibrium, modes);
deviating!(SolvedSubject, BatchKernels, equilibrium, modes);
deviating!(SolvedSubject, SummaryKernels, equilibrium, modes);
