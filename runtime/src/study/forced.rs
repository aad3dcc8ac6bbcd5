//! Questions about forced vibration.

use super::deviating::{Table, Toleranced};
use super::over_input::first_of;
use super::{Study, Value};
use crate::bode::{self, Banded, Bode};
use crate::forced::{self, ForcedCurvature, ForcedResponse, ForcedSensitivities};
use crate::kernels::{CurvatureKernels, Kernels, SummaryKernels};
use crate::peaks::{self, Peaks};
use crate::propagation::{self, Propagation};
use crate::response::{Response, Responses, Vibration};
use crate::sweep::Range;
use crate::{Error, Input};

impl<M: Kernels> Study<M> {
    /// The steady vibration under the declared excitations ([`forced::response`]).
    #[doc = include_str!("shaken.txt")]
    /// let vibration = study.forced_response()?;
    /// let amplitude = vibration.harmonics[0].outputs[Rotor::shake.index()].expect("it vibrates").norm();
    /// assert!((amplitude / 3.3888e-4 - 1.0).abs() < 1e-3);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::equilibrium`] and [`forced::response`].
    pub fn forced_response(&self) -> Result<ForcedResponse, Error> {
        forced::response(&self.mechanism, self.settings.regular(&self.mechanism)?)
    }

    /// The steady vibration and its total derivatives by every input and design variable ([`forced::sensitivities`]).
    #[doc = include_str!("shaken.txt")]
    /// use eigentol::forced::Measure;
    ///
    /// let slopes = study.forced_sensitivities()?;
    /// let amplitude = slopes.modulus(0, Rotor::shake.any(), Measure::Displacement).expect("it vibrates");
    /// assert!(amplitude.by_design[Rotor::e.index()] > 8.0);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::forced_response`] and [`Study::equilibrium_shift`].
    pub fn forced_sensitivities(&self) -> Result<ForcedSensitivities, Error> {
        forced::sensitivities(&self.mechanism, self.settings.regular(&self.mechanism)?)
    }

    /// What each excitation contributes, and its total derivatives: a harmonic for every excitation alone
    /// ([`forced::share_sensitivities`]).
    #[doc = include_str!("shaken.txt")]
    /// let alone = study.share_sensitivities()?;
    /// assert_eq!(alone, study.forced_sensitivities()?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::forced_sensitivities`].
    pub fn share_sensitivities(&self) -> Result<ForcedSensitivities, Error> {
        forced::share_sensitivities(&self.mechanism, self.settings.regular(&self.mechanism)?)
    }
}

impl<M: CurvatureKernels> Study<M> {
    /// The steady vibration with total first and second derivatives ([`forced::second_derivatives`]).
    #[doc = include_str!("shaken.txt")]
    /// let all = study.forced_curvature()?;
    /// assert!(all.asymmetry < 1e-9);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::forced_sensitivities`].
    pub fn forced_curvature(&self) -> Result<ForcedCurvature, Error> {
        forced::second_derivatives(&self.mechanism, self.settings.regular(&self.mechanism)?)
    }
}

impl<M: CurvatureKernels> Study<M> {
    /// The peaks of an amplitude along an input, with exact derivatives and their spread under the tolerances
    /// ([`peaks::peaks`]).
    #[doc = include_str!("shaken.txt")]
    /// use eigentol::response::Vibration;
    ///
    /// let found = study.peaks(Vibration::new(Rotor::shake, Rotor::u), Rotor::omega, 200.0, 600.0)?;
    /// assert!(found.peaks.len() == 1 && found.peaks[0].amplification.is_some());
    /// println!("{}", found.separation([450.0, 600.0]));
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`peaks::peaks`] and [`Study::tolerances`].
    pub fn peaks(
        &self,
        vibration: Vibration,
        input: Input<M>,
        low: impl Into<Value>,
        high: impl Into<Value>,
    ) -> Result<Peaks, Error> {
        Ok(self.peaks_of(&[vibration], input, low, high)?.into_iter().next().expect("one for each vibration"))
    }

    /// The peaks of several amplitudes along an input, from the same states.
    ///
    /// # Errors
    /// As [`Study::peaks`].
    pub fn peaks_of(
        &self,
        vibrations: &[Vibration],
        input: Input<M>,
        low: impl Into<Value>,
        high: impl Into<Value>,
    ) -> Result<Vec<Peaks>, Error> {
        let Range { input, low, high, .. } = self.range(input, low, high)?;
        let table = Table::<dyn CurvatureKernels>::deviating(&self.settings, &self.mechanism)?;
        let point = (&self.settings.inputs[..], &table.design[..]);
        let (start, following) = table.way(table.plain, (input, low))?;
        let tolerances = self.settings.tolerances()?;
        peaks::peaks(
            table.kernels(),
            point,
            &start,
            following,
            (Range::new(input, low, high), vibrations),
            Some(tolerances),
            self.settings.watch(),
        )
    }
}

impl<M: SummaryKernels> Study<M> {
    /// How tolerances spread amplitudes of vibration, right at a resonance too ([`propagation::vibrations`]).
    #[doc = include_str!("shaken.txt")]
    /// use eigentol::response::Vibration;
    ///
    /// println!("{}", study.vibration_spread(&[Vibration::new(Rotor::shake, Rotor::u)])?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::propagate`] and [`Study::forced_response`].
    pub fn vibration_spread(&self, wanted: &[Vibration]) -> Result<Propagation, Error> {
        let toleranced = Toleranced::<dyn SummaryKernels>::of(&self.settings, &self.mechanism)?;
        let (state, modes) = toleranced.solved();
        let wanted = wanted.iter().copied().map(Response::Vibration);
        let responses = Responses::new(toleranced.kernels(), state, modes, wanted.collect())?;
        let sampling = self.settings.sampling();
        Ok(propagation::vibrations(toleranced.kernels(), &responses, toleranced.tolerances, &sampling, 0)?.0)
    }

    /// Forced vibration at each value of one input: amplitude and phase of every output with their derivatives
    /// ([`bode::bode`]).
    #[doc = include_str!("shaken.txt")]
    /// println!("{}", study.bode(Rotor::omega, &[350.0, 380.0, 410.0])?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::sweep`]; [`Error::NoExcitation`]. A point that fails carries its own error.
    pub fn bode(&self, input: Input<M>, values: &[impl Into<Value> + Copy]) -> Result<Bode, Error> {
        let values = self.settings.values_si(input.any(), values)?;
        Table::<dyn SummaryKernels>::plain(&self.settings, &self.mechanism).bode((input.any(), &values), None)
    }

    /// [`Study::bode`] with bands of these amplitudes under tolerances; `checked` designs are solved anew at each value
    /// to say how good the bands are.
    #[doc = include_str!("shaken.txt")]
    /// use eigentol::response::Vibration;
    ///
    /// let wanted = [Vibration::new(Rotor::shake, Rotor::u)];
    /// println!("{}", study.bode_bands(Rotor::omega, &[380.0, 398.0], &wanted, 64)?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::bode`] and [`Study::vibration_spread`].
    pub fn bode_bands(
        &self,
        input: Input<M>,
        values: &[impl Into<Value> + Copy],
        wanted: &[Vibration],
        checked: usize,
    ) -> Result<Bode, Error> {
        let values = self.settings.values_si(input.any(), values)?;
        let table = Table::<dyn SummaryKernels>::deviating(&self.settings, &self.mechanism)?;
        let banded = Banded {
            wanted: wanted.to_vec(),
            tolerances: self.settings.tolerances()?,
            // Progress counts values.
            sampling: self.settings.sampling().progress(None),
            checked,
        };
        table.bode((input.any(), &values), Some(&banded))
    }
}

impl Table<'_, dyn SummaryKernels + '_> {
    fn bode(&self, along: (Input, &[f64]), banded: Option<&Banded<'_>>) -> Result<Bode, Error> {
        let point = (&self.settings.inputs[..], &self.design[..]);
        let from = (along.0, first_of(along.1));
        let (start, following) = self.way(self.plain, from)?;
        let watch = self.settings.watch();
        bode::bode(self.kernels(), point, &start, following, along, (banded, self.settings.sampling().threads, watch))
    }
}
