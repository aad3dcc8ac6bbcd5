//! The operand of a question about tolerances. If inputs have tolerances, it is the mechanism with the deviations of
//! these inputs as further design variables.
//!
//! # Questions are not generic
//!
//! A method of `Study<M>` converts values to SI and passes on a table of kernels, so the library compiles each question
//! once, not once per mechanism.

use std::borrow::Cow;

use super::settings::Settings;
use crate::kernels::{BatchKernels, CurvatureKernels, DeviatingInputs, DirectionalKernels, Kernels, SummaryKernels};
use crate::sensitivity::{Sensitivities, sensitivities};
use crate::{Equilibrium, Error, Modes, Tolerances};

/// A table of kernels with the settings to study it with, and the same with deviating inputs if any are wanted.
pub(super) struct Table<'a, K: ?Sized> {
    pub(super) settings: &'a Settings,
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

impl<K: Kernels + ?Sized> Table<'_, K> {
    /// An equilibrium of the plain mechanism as one of this mechanism.
    pub(super) fn state<'s>(&self, plain: &'s Equilibrium) -> Cow<'s, Equilibrium> {
        match &self.deviating {
            Some(of) => Cow::Owned(plain.with_deviations(of)),
            None => Cow::Borrowed(plain),
        }
    }
}

impl<'a, K: ?Sized> Toleranced<'a, K> {
    /// The equilibrium and its modes.
    pub(super) fn solved(&self) -> (&Equilibrium, &Modes) {
        match &self.deviating {
            Some(deviating) => (&deviating.0, &deviating.1),
            None => self.plain,
        }
    }

    pub(super) fn settings(&self) -> &'a Settings {
        self.table.settings
    }
}

impl Toleranced<'_, dyn Kernels + '_> {
    /// The derivatives of the modes.
    pub(super) fn sensitivities(&self) -> Result<Cow<'_, Sensitivities>, Error> {
        match &self.deviating {
            Some(of) => sensitivities(self.kernels(), &of.0, &of.1).map(Cow::Owned),
            None => self.table.settings.sensitivities(self.table.plain).map(Cow::Borrowed),
        }
    }
}

macro_rules! tables {
    ($($table:ident),*) => {$(
        impl<'a> Table<'a, dyn $table + 'a> {
            /// The mechanism without deviations.
            pub(super) fn plain(settings: &'a Settings, plain: &'a (dyn $table + 'a)) -> Self {
                Self {
                    settings,
                    plain,
                    deviating: None,
                    design: Cow::Borrowed(&settings.design),
                }
            }

            /// The mechanism with deviations of the inputs that have tolerances.
            pub(super) fn deviating(
                settings: &'a Settings,
                plain: &'a (dyn $table + 'a),
            ) -> Result<Self, Error> {
                let mut table = Self::plain(settings, plain);
                let inputs = settings.deviating_inputs();
                if !inputs.is_empty() {
                    let deviating = DeviatingInputs::new(plain, &inputs)?;
                    table.design = Cow::Owned(deviating.design(&settings.design).into());
                    table.deviating = Some(deviating);
                }
                Ok(table)
            }

            pub(super) fn kernels(&self) -> &(dyn $table + '_) {
                match &self.deviating {
                    Some(deviating) => deviating,
                    None => self.plain,
                }
            }
        }

        impl<'a> Toleranced<'a, dyn $table + 'a> {
            /// Solves the operating point, unless that is done.
            pub(super) fn of(
                settings: &'a Settings,
                kernels: &'a (dyn $table + 'a),
            ) -> Result<Self, Error> {
                let plain = settings.solved(kernels)?;
                let table = Table::<dyn $table>::deviating(settings, kernels)?;
                let with = |of| (plain.0.with_deviations(of), plain.1.with_deviations(of));
                Ok(Self {
                    deviating: table.deviating.as_ref().map(|of| Box::new(with(of))),
                    table,
                    plain,
                    tolerances: settings.tolerances()?,
                })
            }

            pub(super) fn kernels(&self) -> &(dyn $table + '_) {
                self.table.kernels()
            }
        }
    )*};
}

tables!(Kernels, DirectionalKernels, CurvatureKernels, BatchKernels, SummaryKernels);
