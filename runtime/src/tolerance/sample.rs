//! One sample, solved by itself.

use super::Outcome;
use crate::algebra::Vector;
use crate::equilibrium::{Problem, settle};
use crate::kernels::Kernels;
use crate::modes::{match_modes, solve_modes};
use crate::{Complex, Equilibrium, Mode, Modes, Policy};

/// One sample.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Sample {
    /// Its design variables, SI.
    pub design: Vector,
    /// What became of it.
    pub outcome: Outcome,
    /// Its equilibrium, when it has one.
    pub coordinates: Option<Vector>,
    /// Eigenvalues `s` in the order of the nominal modes, 1/s; `None` where they were not found, or where the sample has no
    /// such mode.
    pub eigenvalues: Vec<Option<Complex>>,
    /// Frequencies in the order of the nominal modes, rad/s; `None` for a mode that does not oscillate.
    pub frequencies: Vec<Option<f64>>,
    /// Damping ratios in the order of the nominal modes; `None` where there is none.
    pub damping_ratios: Vec<Option<f64>>,
}

/// What was found of a sample.
pub(super) struct Solution {
    pub(super) outcome: Outcome,
    pub(super) state: Option<Equilibrium>,
    modes: Vec<Mode>,
    /// Where the nominal modes are among them.
    places: Vec<Option<usize>>,
}

impl Solution {
    /// Solves the sample of this design from the nominal state.
    pub(super) fn new(
        mechanism: &dyn Kernels,
        nominal: &Equilibrium,
        modes: &Modes,
        design: &[f64],
    ) -> Self {
        let inputs = &nominal.inputs;
        if mechanism.violation(inputs, design).is_some() {
            return Self::without(Outcome::Unphysical, None);
        }
        let problem = Problem::unchecked(mechanism, inputs, design);
        let state = match settle(&problem, &nominal.coordinates, Policy::Stable) {
            Ok(state) => state,
            Err(failure) => return Self::without(Outcome::from(&failure), None),
        };
        let outcome = Outcome::from(state.stability);
        if state.regular().is_err() {
            return Self::without(outcome, Some(state));
        }
        let found = solve_modes(
            &state.linear,
            modes.family,
            &state.description,
            state.rounding,
        );
        let Ok(found) = found else {
            return Self::without(Outcome::NoModes, Some(state));
        };
        Self {
            outcome,
            places: match_modes(modes, &found, &state.linear),
            modes: found.modes,
            state: Some(state),
        }
    }

    fn without(outcome: Outcome, state: Option<Equilibrium>) -> Self {
        Self {
            outcome,
            state,
            modes: Vec::new(),
            places: Vec::new(),
        }
    }

    /// The mode that nominal mode `r` has become.
    pub(super) fn mode(&self, r: usize) -> Option<&Mode> {
        self.modes.get((*self.places.get(r)?)?)
    }

    /// As a sample of so many nominal modes.
    pub(super) fn sample(self, design: &[f64], modes: usize) -> Sample {
        let own = || (0..modes).map(|r| self.mode(r));
        Sample {
            design: design.into(),
            outcome: self.outcome,
            eigenvalues: own().map(|mode| Some(mode?.s)).collect(),
            frequencies: own().map(|mode| mode?.frequency()).collect(),
            damping_ratios: own().map(|mode| mode?.damping_ratio()).collect(),
            coordinates: self.state.map(|state| state.coordinates),
        }
    }
}
