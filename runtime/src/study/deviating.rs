//! The operand of a question about tolerances. If inputs have tolerances, it is the mechanism with the deviations of
//! these inputs as further design variables.
//!
//! # Questions are not generic
//!
//! A method of `Study<M>` converts values to SI and passes on a table of kernels and the settings, so the library
//! compiles each question once, not once per mechanism.

use std::borrow::Cow;

use super::settings::Settings;
use crate::kernels::{
    BatchKernels, CurvatureKernels, DeviatingInputs, DirectionalKernels, Kernels, SummaryKernels,
};
use crate::{Equilibrium, Error, Modes, Tolerances};

/// A table of kernels, and the same with deviating inputs if any are wanted.
pub(super) struct Table<'a, K: ?Sized> {
    /// The mechanism without deviations.
    pub(super) plain: &'a K,
    deviating: Option<DeviatingInputs<'a, K>>,
    /// Design variables, SI, followed by deviations of zero.
    pub(super) design: Cow<'a, [f64]>,
}

/// A table of kernels at a solved operating point with tolerances.
pub(super) struct Toleranced<'a, K: ?Sized> {
    table: Table<'a, K>,
    plain: (&'a Equilibrium, &'a Modes),
    deviating: Option<Box<(Equilibrium, Modes)>>,
    pub(super) tolerances: &'a Tolerances,
}

impl Settings {
    /// The mechanism without deviations.
    pub(super) fn plain<'a, K: ?Sized>(&'a self, kernels: &'a K) -> Table<'a, K> {
        Table {
            plain: kernels,
            deviating: None,
            design: Cow::Borrowed(&self.design),
        }
    }

    /// The mechanism, with deviations of the inputs that have tolerances.
    pub(super) fn deviating<'a, K: Kernels + ?Sized>(
        &'a self,
        kernels: &'a K,
    ) -> Result<Table<'a, K>, Error> {
        let inputs = self.deviating_inputs();
        if inputs.is_empty() {
            return Ok(self.plain(kernels));
        }
        let deviating = DeviatingInputs::new(kernels, &inputs)?;
        Ok(Table {
            plain: kernels,
            design: Cow::Owned(deviating.design(&self.design).into()),
            deviating: Some(deviating),
        })
    }

    /// Like [`Self::deviating`], with the equilibrium, the modes and the tolerances.
    pub(super) fn toleranced<'a, K: Kernels + ?Sized>(
        &'a self,
        kernels: &'a K,
        solved: (&'a Equilibrium, &'a Modes),
    ) -> Result<Toleranced<'a, K>, Error> {
        let table = self.deviating(kernels)?;
        let of = table.deviating.as_ref();
        let deviating =
            of.map(|of| Box::new((solved.0.with_deviations(of), solved.1.with_deviations(of))));
        Ok(Toleranced {
            table,
            plain: solved,
            deviating,
            tolerances: self.tolerances()?,
        })
    }
}

impl<K: Kernels + ?Sized> Table<'_, K> {
    /// An equilibrium of the plain mechanism as one of this mechanism.
    pub(super) fn state<'s>(&self, plain: &'s Equilibrium) -> Cow<'s, Equilibrium> {
        match &self.deviating {
            Some(of) => Cow::Owned(plain.with_deviations(of)),
            None => Cow::Borrowed(plain),
        }
    }
}

impl<K: ?Sized> Toleranced<'_, K> {
    /// The equilibrium and its modes.
    pub(super) fn solved(&self) -> (&Equilibrium, &Modes) {
        match &self.deviating {
            Some(own) => (&own.0, &own.1),
            None => self.plain,
        }
    }
}

macro_rules! kernels {
    ($($table:ident),*) => {$(
        impl<'k> Table<'_, dyn $table + 'k> {
            pub(super) fn kernels(&self) -> &(dyn $table + '_) {
                match &self.deviating {
                    Some(deviating) => deviating,
                    None => self.plain,
                }
            }
        }

        impl<'k> Toleranced<'_, dyn $table + 'k> {
            pub(super) fn kernels(&self) -> &(dyn $table + '_) {
                self.table.kernels()
            }
        }
    )*};
}

kernels!(
    Kernels,
    DirectionalKernels,
    CurvatureKernels,
    BatchKernels,
    SummaryKernels
);
