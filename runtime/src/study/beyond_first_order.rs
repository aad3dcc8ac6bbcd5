//! Methods of a study at one operating point, beyond modes and their first-order spread.

use super::Study;
use super::deviating::Toleranced;
use crate::clusters::{self, ClusterTolerance, DirectionalDerivatives};
use crate::convergence::{self, Convergence, Solved};
use crate::forced;
use crate::kernels::{CurvatureKernels, DirectionalKernels, Kernels, PictureKernels, SummaryKernels};
use crate::mistuning::{self, EngineOrder, Mistuning};
use crate::peaks::Peaks;
use crate::picture::{self, ModePictures, Scene, VibrationPictures};
use crate::response::{Response, Vibration};
use crate::second_order::{self, ModeCurvature, OutputCurvature, SecondOrder};
use crate::shapes::{self, ShapeSensitivity};
use crate::summary::{self, BUDGET, Summary};
use crate::sweep::{Line, Range};
use crate::{Equilibrium, Error, Excitation, Input, Output};

impl<M: Kernels> Study<M> {
    /// How far outputs, frequencies and damping ratios change with more coordinates of beams
    /// ([`convergence::convergence`]).
    ///
    /// `refined` is the same mechanism with one and with two more coordinates of each component of its beams, as
    /// `eigentol_interpreter::Interpreted::refined` reads it. It is solved next to the equilibrium of this study.
    ///
    /// # Errors
    /// As [`Study::modes`].
    pub fn convergence<N: Kernels>(&self, refined: [N; 2]) -> Result<Convergence, Error> {
        let [one, two] = &self.refined(refined)?;
        Ok(convergence::convergence(self.solution()?, [one.solution()?, two.solution()?]))
    }

    /// Like [`Study::convergence`], with what is found along an input between `low` and `high`: critical values, where
    /// frequencies meet `lines`, onsets of flutter, and the highest peaks of vibration ([`convergence::first_events`], [`convergence::highest_peaks`]).
    ///
    /// # Errors
    /// As [`Study::modes`] and [`Study::campbell`]; that of [`Study::peaks`] is part of the result.
    pub fn convergence_along<N: CurvatureKernels>(
        &self,
        refined: [N; 2],
        range: Range<M>,
        lines: &[Line],
    ) -> Result<Convergence, Error>
    where
        M: CurvatureKernels,
    {
        let refined = self.refined(refined)?;
        let [one, two] = &refined;
        let convergence = convergence::convergence(self.solution()?, [one.solution()?, two.solution()?]);
        let range = range.any();
        let mut answers =
            [self.events_along(range, lines)?, one.events_along(range, lines)?, two.events_along(range, lines)?];
        let peaks = || -> Result<[Vec<Peaks>; 3], Error> {
            let [one, two] = [one.all_peaks(range)?, two.all_peaks(range)?];
            Ok([self.all_peaks(range)?, one, two])
        };
        let peaks = peaks();
        for (answers, peaks) in answers.iter_mut().zip(peaks.iter().flatten()) {
            answers.extend(convergence::highest_peaks(peaks, range));
        }
        let [declared, one, two] = &answers;
        let mut convergence = convergence.with(declared, [one, two]);
        convergence.without_peaks = peaks.err();
        Ok(convergence)
    }

    fn events_along(&self, range: Range, lines: &[Line]) -> Result<Vec<(Response, f64)>, Error>
    where
        M: CurvatureKernels,
    {
        let input = Input::new(range.input.index());
        let found = self.campbell(input, &[range.low, range.high], lines)?;
        Ok(convergence::first_events(&found, range))
    }

    fn all_peaks(&self, range: Range) -> Result<Vec<Peaks>, Error>
    where
        M: CurvatureKernels,
    {
        let vibrations = Vibration::all(self.description());
        if vibrations.is_empty() {
            Ok(Vec::new())
        } else {
            let input = Input::new(range.input.index());
            self.peaks_of(&vibrations, input, range.low, range.high)
        }
    }

    /// Studies of mechanisms with more coordinates, next to the equilibrium of this one.
    fn refined<N: Kernels>(&self, refined: [N; 2]) -> Result<[Study<N>; 2], Error> {
        let state = self.settings.equilibrium(&self.mechanism)?;
        Ok(refined.map(|mechanism| Study { settings: self.settings.of(mechanism.description(), state), mechanism }))
    }

    fn solution(&self) -> Result<Solved<'_>, Error> {
        let (state, modes) = self.solved()?;
        Ok(Solved { mechanism: &self.mechanism, state, modes })
    }
}

impl<M: PictureKernels> Study<M> {
    /// The visible scene at the equilibrium: poses and shapes of the bodies ([`picture::scene`]).
    #[doc = include_str!("example.txt")]
    /// let scene = study.picture()?;
    /// println!("{}: {:?}", scene.bodies[1].name, scene.bodies[1].pose);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::equilibrium`].
    pub fn picture(&self) -> Result<Scene, Error> {
        let Equilibrium { coordinates, inputs, design, .. } = self.settings.equilibrium(&self.mechanism)?;
        picture::scene(&self.mechanism, coordinates, inputs, design)
    }

    /// Poses of all bodies over one period of a mode (counted from 0), at `phases` evenly spaced phases.
    ///
    /// The largest displacement to either side is the fraction `amplitude` of the size of the mechanism
    /// ([`picture::mode_pictures`]).
    #[doc = include_str!("example.txt")]
    /// let swing = study.mode_pictures(0, 24, 0.1)?;
    /// println!("{:?}", swing.frames[6][1].position);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::modes`]; [`Error::NoSuchMode`], [`Error::Setting`].
    pub fn mode_pictures(&self, mode: usize, phases: usize, amplitude: f64) -> Result<ModePictures, Error> {
        let (state, modes) = self.solved()?;
        picture::mode_pictures(&self.mechanism, state, modes, mode, phases, amplitude)
    }

    /// Poses of all bodies over one period of the vibration with the frequency of an excitation, at `phases` evenly
    /// spaced phases: the operating deflection shape, enlarged as modes are ([`picture::vibration_pictures`]).
    #[doc = include_str!("shaken.txt")]
    /// let moved = study.vibration_pictures(Rotor::u, 24, 0.1)?;
    /// println!("{} times as far", moved.enlargement);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`forced::response`] and [`Study::equilibrium`]; [`Error::UnknownHandle`], [`Error::Setting`].
    pub fn vibration_pictures(
        &self,
        excitation: Excitation<M>,
        phases: usize,
        amplitude: f64,
    ) -> Result<VibrationPictures, Error> {
        let state = self.settings.regular(&self.mechanism)?;
        let response = forced::response(&self.mechanism, state)?;
        let harmonic = response.harmonic(excitation);
        let harmonic = harmonic.ok_or_else(|| Error::UnknownHandle {
            kind: "excitation",
            index: excitation.index(),
            mechanism: response.description.name.clone(),
            count: response.description.excitations.len(),
        })?;
        picture::vibration_pictures(&self.mechanism, state, harmonic, phases, amplitude)
    }
}

impl<M: DirectionalKernels> Study<M> {
    /// Derivatives of the eigenvalue of one mode (counted from 0), and of all eigenvalues equal to it, along a
    /// direction in the space of inputs and design variables
    /// ([`directional_derivatives`](crate::clusters::directional_derivatives)).
    #[doc = include_str!("example.txt")]
    /// let (inputs, design) = ([1.0], [0.0, 0.0]);
    /// let slopes = study.directional_derivatives(0, (&inputs, &design))?;
    /// println!("{:?} rad/s per rad/s", slopes.frequencies);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::sensitivities`]; [`Error::WrongLength`], [`Error::NoSuchMode`], [`Error::Defective`].
    pub fn directional_derivatives(
        &self,
        mode: usize,
        direction: (&[f64], &[f64]),
    ) -> Result<DirectionalDerivatives, Error> {
        let (state, modes) = self.solved()?;
        clusters::directional_derivatives(&self.mechanism, state, modes, mode, direction)
    }

    /// Derivatives of the mode shapes of one mode, counted from 0
    /// ([`shape_sensitivity`](crate::shapes::shape_sensitivity)).
    #[doc = include_str!("example.txt")]
    /// let slopes = study.shape_sensitivity(0)?;
    /// println!("{}", slopes.right_by_design[Pendulum::l.index()][Pendulum::theta.index()]);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::sensitivities`]; [`Error::NoSuchMode`], [`Error::ClusteredMode`].
    pub fn shape_sensitivity(&self, mode: usize) -> Result<ShapeSensitivity, Error> {
        let (state, modes) = self.solved()?;
        shapes::shape_sensitivity(&self.mechanism, state, modes, mode)
    }

    /// How much higher the vibration of the worst blade is than that of equal ones, with its distribution within the
    /// tolerances ([`mistuning`](crate::mistuning::mistuning)).
    ///
    /// # Errors
    /// As [`Study::sensitivities`] and [`Study::tolerances`]; [`Error::Setting`] if there are no such blades.
    pub fn mistuning(&self, asked: EngineOrder) -> Result<Mistuning, Error> {
        let toleranced = Toleranced::<dyn DirectionalKernels>::of(&self.settings, &self.mechanism)?;
        let (state, _) = toleranced.solved();
        mistuning::mistuning(toleranced.kernels(), state, toleranced.tolerances, asked, self.settings.watch())
    }

    /// Finds the clusters of modes that mix within the tolerances, and their spread
    /// ([`clusters`](crate::clusters::clusters)).
    #[doc = include_str!("example.txt")]
    /// // One mode has no other to mix with.
    /// assert!(study.clusters()?.is_empty());
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::sensitivities`] and [`Study::tolerances`].
    pub fn clusters(&self) -> Result<Vec<ClusterTolerance>, Error> {
        let toleranced = Toleranced::<dyn DirectionalKernels>::of(&self.settings, &self.mechanism)?;
        let (state, modes) = toleranced.solved();
        clusters::clusters(toleranced.kernels(), state, modes, toleranced.tolerances)
    }
}

impl<M: CurvatureKernels> Study<M> {
    /// First and second derivatives of one mode, counted from 0
    /// ([`mode_curvature`](crate::second_order::mode_curvature)).
    #[doc = include_str!("example.txt")]
    /// let second = study.mode_curvature(0)?.lambda.by_design;
    /// let l = Pendulum::l.index();
    /// println!("{} 1/s^2 per square metre", second[l][l]);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::sensitivities`]; [`Error::NoSuchMode`], [`Error::ClusteredMode`].
    pub fn mode_curvature(&self, mode: usize) -> Result<ModeCurvature, Error> {
        let (state, modes) = self.solved()?;
        second_order::mode_curvature(&self.mechanism, state, modes, mode)
    }

    /// First and second derivatives of one output ([`output_curvature`](crate::second_order::output_curvature)).
    #[doc = include_str!("example.txt")]
    /// let angle = study.output_curvature(Pendulum::angle)?;
    /// // cos(angle) = 3 g / (2 omega^2 l) whatever the mass.
    /// let m = Pendulum::m.index();
    /// assert!(angle.second.by_design[m][m].abs() < 1e-12);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::outputs`]; [`Error::NoSensitivity`](crate::Error::NoSensitivity) where the output is not smooth.
    pub fn output_curvature(&self, output: Output<M>) -> Result<OutputCurvature, Error> {
        let state = self.settings.regular(&self.mechanism)?;
        second_order::output_curvature(&self.mechanism, state, output.any())
    }

    /// Second-order spread of every mode ([`second_order`](crate::second_order::second_order)).
    #[doc = include_str!("example.txt")]
    /// println!("{}", study.second_order()?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::modes`] and [`Study::tolerances`]; a mode without second derivatives carries its own error.
    pub fn second_order(&self) -> Result<SecondOrder, Error> {
        let toleranced = Toleranced::<dyn CurvatureKernels>::of(&self.settings, &self.mechanism)?;
        let (state, modes) = toleranced.solved();
        let (kernels, tolerances) = (toleranced.kernels(), toleranced.tolerances);
        Ok(second_order::second_order(kernels, state, modes, tolerances))
    }
}

impl<M: SummaryKernels> Study<M> {
    /// First-order spread, second-order spread and clusters, and for each mode whether its standard deviation can be
    /// trusted ([`summary`](crate::summary::summary)). The samples that judge are always the same, whatever
    /// [`Study::samples`] and [`Study::seed`].
    #[doc = include_str!("example.txt")]
    /// assert!(study.summary()?.trusted());
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::sensitivities`] and [`Study::tolerances`].
    pub fn summary(&self) -> Result<Summary, Error> {
        self.summary_within(BUDGET)
    }

    /// Like [`Study::summary`], with a limit on the number of operations spent on samples
    /// ([`summary_within`](crate::summary::summary_within)).
    #[doc = include_str!("example.txt")]
    /// // No samples: distances and the second-order model.
    /// assert!(study.summary_within(0.0)?.sampled().is_none());
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::summary`].
    pub fn summary_within(&self, operations: f64) -> Result<Summary, Error> {
        let toleranced = Toleranced::<dyn SummaryKernels>::of(&self.settings, &self.mechanism)?;
        let (kernels, watch) = (toleranced.kernels(), self.settings.watch());
        summary::summary_watched(kernels, toleranced.solved(), toleranced.tolerances, operations, watch)
    }
}
