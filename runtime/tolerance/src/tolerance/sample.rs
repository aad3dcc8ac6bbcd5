//! One sample, solved on its own.

use super::Outcome;
use crate::algebra::Vector;
use crate::equilibrium::{Needed, OperatingPoint, solve_into};
use crate::kernels::Kernels;
use crate::modes::{CERTAIN, Family, equal_groups, in_order, match_with_assurance, position, stay_in_place};
use crate::{Complex, Equilibrium, Mode, Modes, Policy};

/// One sample.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sample {
    /// Its design variables, SI.
    pub design: Vector,
    /// Its outcome.
    pub outcome: Outcome,
    /// Its equilibrium, if it has one.
    pub coordinates: Option<Vector>,
    /// Eigenvalues `s` in the order of the nominal modes, 1/s; `None` if they were not found or the sample has no such
    /// mode.
    pub eigenvalues: Vec<Option<Complex>>,
    /// Frequencies in the order of the nominal modes, rad/s; `None` for a mode that does not oscillate.
    pub frequencies: Vec<Option<f64>>,
    /// Damping ratios in the order of the nominal modes; `None` if there is none.
    pub damping_ratios: Vec<Option<f64>>,
}

/// The solution of a sample, in a workspace reused by the next one.
#[doc(hidden)]
pub struct Solution {
    #[doc(hidden)]
    pub outcome: Outcome,
    /// Meaningful only if the outcome is that of an equilibrium.
    #[doc(hidden)]
    pub state: Equilibrium,
    /// Whether it has an equilibrium.
    #[doc(hidden)]
    pub solved: bool,
    modes: Modes,
    /// Groups of nominal modes with equal eigenvalues.
    groups: Vec<Vec<usize>>,
    /// Positions of the nominal modes among them; empty if they were not found.
    places: Vector<Option<usize>>,
}

impl Solution {
    /// A workspace for samples about a nominal state.
    #[doc(hidden)]
    pub fn about(nominal: &Equilibrium, modes: &Modes) -> Self {
        Self {
            outcome: Outcome::Stable,
            state: nominal.clone(),
            solved: true,
            modes: modes.clone(),
            groups: equal_groups(modes),
            places: Vector::default(),
        }
    }

    /// Solves the sample with this design, starting from the nominal state.
    #[doc(hidden)]
    pub fn solve(
        &mut self,
        mechanism: &dyn Kernels,
        nominal: &Equilibrium,
        (modes, needed): (&Modes, Needed),
        design: &[f64],
    ) {
        self.places = Vector::default();
        let judged = self.solve_state(mechanism, nominal, (modes, needed), design);
        self.solved = judged.is_ok();
        let judged = match judged {
            Err(outcome) => {
                self.outcome = outcome;
                return;
            }
            Ok(judged) => judged,
        };
        self.outcome = Outcome::from(self.state.stability);
        if needed < Needed::Modes || self.state.regular().is_err() {
            return;
        }
        let (solved, state) = (&mut self.modes, &self.state);
        match solved.solve_judged(state, judged, &modes.modes) {
            Ok(()) => {
                let mut places = if stay_in_place(modes, solved, &state.linear, CERTAIN) {
                    Vector::from_fn(modes.modes.len(), Some)
                } else {
                    match_with_assurance(modes, solved, &state.linear).map(position)
                };
                let size = |places: &Vector<Option<usize>>, r: usize| match places[r] {
                    None => f64::INFINITY,
                    Some(index) if solved.family == Family::Undamped => solved.modes[index].lambda,
                    Some(index) => solved.modes[index].s.norm(),
                };
                for group in &self.groups {
                    in_order(group, &mut places, size, |places, i, j| places.swap(i, j));
                }
                self.places = places;
            }
            Err(_) => self.outcome = Outcome::NoModes,
        }
    }

    fn solve_state(
        &mut self,
        mechanism: &dyn Kernels,
        nominal: &Equilibrium,
        (modes, needed): (&Modes, Needed),
        design: &[f64],
    ) -> Result<Vec<Mode>, Outcome> {
        let inputs = &nominal.inputs;
        if mechanism.violation(inputs, design).is_some() {
            return Err(Outcome::Unphysical);
        }
        let mut point = OperatingPoint::unchecked(mechanism, inputs, design).near(modes);
        point.needed = needed;
        if !nominal.free.held.is_empty() {
            point = point.held_like(&nominal.free);
        }
        self.state.design.copy_from_slice(design);
        let start = &nominal.coordinates;
        solve_into(&point, start, Policy::about(nominal), &mut self.state).map_err(|failure| Outcome::from(&failure))
    }

    /// Whether the sample is as stable, or as unstable, as the nominal state.
    #[doc(hidden)]
    pub fn continues(&self, nominal: &Equilibrium) -> bool {
        if nominal.stability.holds() {
            self.outcome == Outcome::Stable
        } else {
            self.solved && self.state.stability == nominal.stability
        }
    }

    /// The mode that continues nominal mode `r`.
    #[doc(hidden)]
    pub fn mode(&self, r: usize) -> Option<&Mode> {
        self.modes.modes.get(self.place(r)?)
    }

    /// Its position among [`Self::modes`].
    #[doc(hidden)]
    pub fn place(&self, r: usize) -> Option<usize> {
        *self.places.get(r)?
    }

    /// The modes found, in their own order.
    #[doc(hidden)]
    pub fn modes(&self) -> &Modes {
        &self.modes
    }

    /// Converts the solution to a sample with the given number of nominal modes.
    pub(crate) fn sample(&self, design: &[f64], modes: usize) -> Sample {
        let each_mode = || (0..modes).map(|r| self.mode(r));
        Sample {
            design: design.into(),
            outcome: self.outcome,
            eigenvalues: each_mode().map(|mode| Some(mode?.s)).collect(),
            frequencies: each_mode().map(|mode| mode?.frequency()).collect(),
            damping_ratios: each_mode().map(|mode| mode?.damping_ratio()).collect(),
            coordinates: self.solved.then(|| self.state.coordinates.clone()),
        }
    }
}
