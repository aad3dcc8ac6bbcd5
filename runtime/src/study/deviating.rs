//! Inputs with tolerances: the study of a mechanism that has their deviations as further design variables.

use super::{Solved, Study};
use crate::Error;
use crate::kernels::{DeviatingInputs, Kernels};

impl<M: Kernels> Study<M> {
    /// The same study of the mechanism whose inputs deviate, behind its table of kernels; `None` where no input has a tolerance.
    pub(super) fn deviating<'k, K: Kernels + ?Sized>(
        &self,
        kernels: &'k K,
    ) -> Result<Option<Study<DeviatingInputs<'k, K>>>, Error> {
        let inputs = self.settings.deviating_inputs();
        if inputs.is_empty() {
            return Ok(None);
        }
        let mechanism = DeviatingInputs::new(kernels, &inputs)?;
        let design = mechanism.design(&self.settings.design);
        Ok(Some(Study {
            settings: self.settings.widened(mechanism.description(), design),
            mechanism,
        }))
    }
}

impl<M: Kernels> Solved<'_, M> {
    /// The same state, of the study of the mechanism whose inputs deviate.
    pub(super) fn in_study<'s, 'k, K: Kernels + ?Sized>(
        &self,
        study: &'s Study<DeviatingInputs<'k, K>>,
    ) -> Solved<'s, DeviatingInputs<'k, K>> {
        Solved {
            study,
            equilibrium: self.equilibrium.with_deviations(&study.mechanism),
            modes: self.modes.with_deviations(&study.mechanism),
        }
    }
}

/// The study of the mechanism whose inputs deviate, with this table of kernels; `None` where no input has a tolerance.
macro_rules! deviating {
    ($study:expr, $table:ident) => {{
        let kernels: &dyn $table = &$study.mechanism;
        $study.deviating(kernels)?
    }};
}

pub(super) use deviating;
