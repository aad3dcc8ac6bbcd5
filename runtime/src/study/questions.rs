//! What a study can be asked at one operating point: each question runs the chain of functions that answers it.

use super::Study;
use crate::equilibrium::{self, Assembly, Equilibrium, Problem, Search};
use crate::modes::{Family, PerMode, Whirl};
use crate::sensitivity::{
    self, DirectionalDerivatives, EquilibriumShift, Method, ModeCurvature, OutputSensitivities,
    Quantity, Sensitivities, ShapeSensitivity,
};
use crate::tolerance::{
    self, Band, ClusterTolerance, FirstOrder, ModeMargin, MonteCarlo, OutputTolerances, Sampling,
    SecondOrder, Summary,
};
use crate::{Coordinate, Error, Mechanism, Modes, modes};

impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Study<M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    /// The dynamic equilibrium ([`equilibrium::equilibrium`]).
    ///
    /// # Errors
    /// Those of the function, and [`Error::UnknownHandle`] when a builder method was given a foreign handle.
    pub fn equilibrium(&self) -> Result<Equilibrium<N, U, P>, Error> {
        self.ask(Self::settled)
    }

    /// The mechanism put together, coordinates with a [`Study::start`] held ([`equilibrium::assemble`]).
    ///
    /// # Errors
    /// Those of the function.
    pub fn assembly(&self) -> Result<Assembly<N>, Error> {
        self.ask(|study| {
            study.ready()?;
            let held: Vec<_> = (0..N).filter(|&j| study.held[j]).map(Coordinate).collect();
            equilibrium::assemble(
                &study.mechanism,
                &study.inputs,
                &study.design,
                &study.start,
                &held,
            )
        })
    }

    /// Distinct equilibria from many starts ([`equilibrium::find_equilibria`]).
    ///
    /// # Errors
    /// Those of the function.
    pub fn equilibria(&self, search: &Search<N>) -> Result<Vec<Equilibrium<N, U, P>>, Error> {
        self.ask(|study| {
            equilibrium::find_equilibria(
                &study.mechanism,
                &study.inputs,
                &study.design,
                &study.assembled_start()?,
                search,
            )
        })
    }

    /// The natural modes ([`modes::modes`]).
    ///
    /// # Errors
    /// Those of the equilibrium and of the function.
    pub fn modes(&self) -> Result<Modes<N>, Error> {
        self.ask(|study| study.modes_at(&study.settled()?))
    }

    /// As [`Self::equilibrium`], on this stack.
    fn settled(&self) -> Result<Equilibrium<N, U, P>, Error> {
        equilibrium::equilibrium(
            &self.mechanism,
            &self.inputs,
            &self.design,
            &self.assembled_start()?,
            self.policy,
        )
    }

    fn solved(&self) -> Result<(Equilibrium<N, U, P>, Modes<N>), Error> {
        let state = self.settled()?;
        let found = self.modes_at(&state)?;
        Ok((state, found))
    }

    fn modes_at(&self, state: &Equilibrium<N, U, P>) -> Result<Modes<N>, Error> {
        state.regular()?;
        modes::modes_at(state, self.family_of(state))
    }

    fn family_of(&self, state: &Equilibrium<N, U, P>) -> Family {
        self.family.unwrap_or(Family::of(state.description))
    }

    /// How the equilibrium moves ([`sensitivity::equilibrium_shift`]).
    ///
    /// # Errors
    /// Those of the equilibrium and of the function.
    pub fn equilibrium_shift(&self) -> Result<EquilibriumShift<N, U, P>, Error> {
        self.ask(|study| {
            let state = study.settled()?;
            state.regular()?;
            sensitivity::equilibrium_shift(&study.mechanism, &state)
        })
    }

    /// Total derivatives of the modes ([`sensitivity::sensitivities`]).
    ///
    /// # Errors
    /// Those of the equilibrium, the modes and the function.
    pub fn sensitivities(&self) -> Result<Box<Sensitivities<N, U, P>>, Error> {
        self.ask(|study| {
            let state = study.settled()?;
            let found = study.modes_at(&state)?;
            sensitivity::sensitivities(&study.mechanism, &state, &found).map(Box::new)
        })
    }

    /// Values and total derivatives of the outputs ([`sensitivity::output_sensitivities`]).
    ///
    /// # Errors
    /// Those of the equilibrium and of the function.
    pub fn outputs(&self) -> Result<OutputSensitivities<U, P, O>, Error> {
        self.ask(|study| {
            let state = study.settled()?;
            state.regular()?;
            sensitivity::output_sensitivities(&study.mechanism, &state)
        })
    }

    /// First-order spread of the frequencies ([`tolerance::first_order`]).
    ///
    /// # Errors
    /// Those of equilibrium, modes, sensitivities and tolerances.
    pub fn first_order(&self) -> Result<Box<FirstOrder<N, P>>, Error> {
        self.ask(|study| {
            // Borrowed: to move them would take a noticeable part of the time.
            let tolerances = study.tolerances();
            let tolerances = borrowed(&tolerances)?;
            let problem = Problem::new(&study.mechanism, &study.inputs, &study.design)?;
            let start = study.assembled_start()?;
            problem.check_start(&start)?;
            let state = equilibrium::settle(&problem, &start, study.policy);
            let state = state
                .as_ref()
                .map_err(|failure| failure.explain(problem.description()))?;
            state.regular()?;
            let mut found = Modes::empty(&state.linear, study.family_of(state), state.description);
            let solved = found.solve(&state.linear, state.rounding);
            solved.map_err(|failure| failure.explain(state.description))?;
            let mut slopes = Sensitivities::blank(&found, Method::Adjoint);
            sensitivity::sensitivities_into(&study.mechanism, state, &found, &mut slopes)?;
            Ok(Box::new(tolerance::first_order(
                &found, &slopes, tolerances,
            )))
        })
    }

    /// First-order spread of the outputs ([`tolerance::output_tolerances`]).
    ///
    /// # Errors
    /// Those of equilibrium, output sensitivities and tolerances.
    pub fn output_tolerances(&self) -> Result<OutputTolerances<P, O>, Error> {
        self.ask(|study| {
            Ok(tolerance::output_tolerances(
                &study.outputs()?,
                &study.tolerances()?,
            ))
        })
    }

    /// Monte Carlo with re-solved equilibria ([`tolerance::monte_carlo`]).
    ///
    /// # Errors
    /// Those of the nominal equilibrium and modes, of the tolerances, and [`Error::Threads`].
    pub fn monte_carlo(&self) -> Result<MonteCarlo<N, P>, Error> {
        self.sample(None)
    }

    /// As [`Study::monte_carlo`]; `progress` is called with a number of samples whenever that many more are done.
    ///
    /// # Errors
    /// As [`Study::monte_carlo`].
    pub fn monte_carlo_with_progress(
        &self,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<MonteCarlo<N, P>, Error> {
        self.sample(Some(progress))
    }

    fn sample(&self, progress: Option<&(dyn Fn(usize) + Sync)>) -> Result<MonteCarlo<N, P>, Error> {
        self.ask(|study| {
            let tolerances = study.tolerances()?;
            let (state, found) = study.solved()?;
            let sampling = Sampling {
                samples: study.samples,
                seed: study.seed,
                stream: study.stream,
                threads: study.threads,
                keep_samples: study.keep_samples,
                vectors: study.vectors,
                progress,
            };
            tolerance::monte_carlo(&study.mechanism, &state, &found, &tolerances, &sampling)
        })
    }

    /// Derivatives of the eigenvalues of one mode, counted from 0, and of those equal to it, along a change of inputs and
    /// design variables ([`sensitivity::directional_derivatives`]).
    ///
    /// # Errors
    /// Those of equilibrium, modes and the function.
    pub fn directional_derivatives(
        &self,
        mode: usize,
        direction: (&[f64; U], &[f64; P]),
    ) -> Result<DirectionalDerivatives, Error> {
        self.ask(|study| {
            let (state, found) = study.solved()?;
            sensitivity::directional_derivatives(&study.mechanism, &state, &found, mode, direction)
        })
    }

    /// Derivatives of the shapes of one mode, counted from 0 ([`sensitivity::shape_sensitivity`]).
    ///
    /// # Errors
    /// Those of equilibrium, modes and the function.
    pub fn shape_sensitivity(&self, mode: usize) -> Result<ShapeSensitivity<N, U, P>, Error> {
        self.ask(|study| {
            let (state, found) = study.solved()?;
            sensitivity::shape_sensitivity(&study.mechanism, &state, &found, mode)
        })
    }

    /// First and second derivatives of one mode, counted from 0 ([`sensitivity::mode_curvature`]).
    ///
    /// # Errors
    /// Those of equilibrium, modes and the function.
    pub fn mode_curvature(&self, mode: usize) -> Result<Box<ModeCurvature<U, P>>, Error> {
        self.ask(|study| {
            let (state, found) = study.solved()?;
            sensitivity::mode_curvature(&study.mechanism, &state, &found, mode).map(Box::new)
        })
    }

    /// Spread of every mode to second order ([`tolerance::second_order`]).
    ///
    /// # Errors
    /// Those of equilibrium, modes and tolerances; a mode without second derivatives says so itself.
    pub fn second_order(&self) -> Result<SecondOrder<P>, Error> {
        self.ask(|study| {
            let tolerances = study.tolerances()?;
            let (state, found) = study.solved()?;
            Ok(tolerance::second_order(
                &study.mechanism,
                &state,
                &found,
                &tolerances,
            ))
        })
    }

    /// The modes that tolerances bring together, and their spread ([`tolerance::clusters`]).
    ///
    /// # Errors
    /// Those of equilibrium, modes, tolerances and the function.
    pub fn clusters(&self) -> Result<Vec<ClusterTolerance<U, P>>, Error> {
        self.ask(|study| {
            let tolerances = study.tolerances()?;
            let (state, found) = study.solved()?;
            tolerance::clusters(&study.mechanism, &state, &found, &tolerances)
        })
    }

    /// First order, second order, clusters, and for each mode whether its standard deviation is to be believed
    /// ([`tolerance::summary`]).
    ///
    /// # Errors
    /// Those of equilibrium, modes, tolerances and the function.
    pub fn summary(&self) -> Result<Box<Summary<N, U, P>>, Error> {
        self.ask(|study| {
            let tolerances = Box::new(study.tolerances()?);
            let solved = study.solved().map(Box::new)?;
            tolerance::summary(&study.mechanism, &solved.0, &solved.1, &tolerances).map(Box::new)
        })
    }

    /// Probability that the frequency of one mode, counted from 0, lies in a forbidden band
    /// ([`tolerance::mode_margin`]).
    ///
    /// # Errors
    /// Those of equilibrium, modes, tolerances and the function.
    pub fn margin(&self, mode: usize, band: Band) -> Result<ModeMargin<U, P>, Error> {
        self.margin_of(mode, Quantity::Frequency, band)
    }

    /// As [`Study::margin`] for any quantity of the mode: [`Quantity::Growth`] between zero and infinity is the
    /// probability that it is unstable.
    ///
    /// # Errors
    /// As [`Study::margin`].
    pub fn margin_of(
        &self,
        mode: usize,
        quantity: Quantity,
        band: Band,
    ) -> Result<ModeMargin<U, P>, Error> {
        self.ask(|study| {
            let tolerances = study.tolerances()?;
            let (state, found) = study.solved()?;
            tolerance::mode_margin(
                &study.mechanism,
                &state,
                &found,
                (mode, quantity),
                &tolerances,
                band,
            )
        })
    }

    /// How each mode whirls ([`modes::whirls`]).
    ///
    /// # Errors
    /// Those of equilibrium and modes.
    pub fn whirls(&self) -> Result<PerMode<Option<Whirl>, N>, Error> {
        self.ask(|study| {
            let (state, found) = study.solved()?;
            Ok(modes::whirls(&study.mechanism, &state, &found))
        })
    }
}

/// What a question was answered, where it stands.
#[inline]
fn borrowed<T>(answer: &Result<T, Error>) -> Result<&T, Error> {
    answer.as_ref().map_err(Error::clone)
}
