//! The operand of a question: kernels and settings without the mechanism's type, so that each question is compiled only
//! once. If inputs have tolerances, the kernels are those of the mechanism with the input deviations as additional
//! design variables.
//!
//! # Questions are not generic
//!
//! A method of `Study<M>` converts values to SI and passes on a `Subject`, a table of kernels and the settings
//! (`study/subject.rs`), so the library compiles each question once, not once per mechanism. If an input has a
//! tolerance, the subject holds the table with deviating inputs.

use super::settings::Settings;
use super::{Solved, Study};
use crate::kernels::{
    BatchKernels, CurvatureKernels, DeviatingInputs, DirectionalKernels, Kernels, SummaryKernels,
};
use crate::{Equilibrium, Error, Input, Modes};

/// A table of kernels and the settings to study it with.
pub(super) struct Subject<'a, K: ?Sized> {
    pub(super) kernels: &'a K,
    pub(super) settings: &'a Settings,
}

/// A [`Subject`] whose equilibrium and modes are solved.
pub(super) struct SolvedSubject<'a, K: ?Sized> {
    pub(super) kernels: &'a K,
    pub(super) settings: &'a Settings,
    pub(super) equilibrium: &'a Equilibrium,
    pub(super) modes: &'a Modes,
}

impl<M> Study<M> {
    /// The mechanism behind one of its kernel tables.
    pub(super) fn subject<'a, K: ?Sized>(&'a self, kernels: &'a K) -> Subject<'a, K> {
        Subject {
            kernels,
            settings: &self.settings,
        }
    }
}

impl<M> Solved<'_, M> {
    /// The mechanism behind one of its kernel tables.
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
    /// The mechanism with these inputs deviating, and its settings.
    fn deviating<'a, K: Kernels + ?Sized>(
        &self,
        kernels: &'a K,
        inputs: &[Input],
    ) -> Result<(DeviatingInputs<'a, K>, Self), Error> {
        let mechanism = DeviatingInputs::new(kernels, inputs)?;
        let settings = self.widened(mechanism.description(), mechanism.design(&self.design));
        Ok((mechanism, settings))
    }
}

macro_rules! deviating {
    ($subject:ident, $table:ident $(, $state:ident)*) => {
        impl<'k> $subject<'_, dyn $table + 'k> {
            /// Asks the question of the mechanism, or of the one with deviating inputs if any input has a tolerance.
            pub(super) fn deviating<R>(
                &self,
                question: impl FnOnce(&$subject<'_, dyn $table + '_>) -> Result<R, Error>,
            ) -> Result<R, Error> {
                let inputs = self.settings.deviating_inputs();
                if inputs.is_empty() {
                    return question(self);
                }
                let (mechanism, settings) = self.settings.deviating(self.kernels, &inputs)?;
                question(&$subject {
                    kernels: &mechanism,
                    settings: &settings,
                    $($state: &self.$state.with_deviations(&mechanism),)*
                })
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
