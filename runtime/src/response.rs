//! What is asked of a mechanism at other values of its design: quantities of modes, outputs, critical values of an input, with exact
//! total derivatives.

use crate::algebra::Vector;
use crate::kernels::{BatchKernels, DirectionalKernels, Kernels};
use crate::scalar::Instructions;
use crate::sensitivity::{Quantity, output_sensitivities, sensitivities};
use crate::sweep::{
    Condition, CriticalState, Crossing, Following, Range, critical_sensitivity, critical_state,
    crossing_sensitivity, first_crossing,
};
use crate::tolerance::{Outcome, Solution};
use crate::{Equilibrium, Error, Modes, Output, Watch};

/// A number that a design gives.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Response {
    /// A quantity of a nominal mode, counted from 0: frequencies in rad/s, growth in 1/s.
    Mode {
        /// Position of the nominal mode.
        mode: usize,
        /// What is asked of it.
        quantity: Quantity,
    },
    /// An output, SI.
    Output(Output),
    /// The first value of an input in a range at which the branch that is stable at its low end loses its stiffness, SI
    /// ([`critical_state`]).
    Critical(Range),
    /// The first value of an input in a range at which a mode meets a condition, SI: the speed at which a rotor resonates, or begins to
    /// flutter. Along the range stable equilibria are followed, as by [`crossings`](crate::sweep::crossings).
    Crossing {
        /// Number of the mode at the start of the range, from 0.
        mode: usize,
        /// What it meets.
        condition: Condition,
        /// Where to look.
        range: Range,
    },
}

/// The responses to one design.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Realisation {
    /// What becomes of it at the operating point.
    pub outcome: Outcome,
    /// The responses in the order in which they were asked for; `None` where it has none: of a mode that does not oscillate, of a
    /// design without a stable equilibrium, of a range without a critical value.
    pub values: Vec<Option<f64>>,
    /// Total derivatives by the design variables, when asked for; `None` where there are none.
    pub gradients: Vec<Option<Vector>>,
}

/// Responses of designs near a nominal one. Modes are matched to the nominal modes by shape.
pub struct Responses<'a> {
    mechanism: &'a dyn DirectionalKernels,
    /// The same where designs can be solved side by side.
    batches: Option<&'a dyn BatchKernels>,
    vectors: Option<Instructions>,
    nominal: &'a Equilibrium,
    modes: &'a Modes,
    wanted: Vec<Response>,
    watch: Watch<'a>,
}

/// What the next evaluation uses again.
pub struct Workspace(Solution);

impl<'a> Responses<'a> {
    /// Prepares to ask for responses of designs near the nominal one.
    ///
    /// # Errors
    /// [`Error::NoSuchMode`], [`Error::UnknownHandle`], [`Error::Setting`] for a range that makes no sense.
    pub fn new(
        mechanism: &'a dyn DirectionalKernels,
        nominal: &'a Equilibrium,
        modes: &'a Modes,
        wanted: Vec<Response>,
    ) -> Result<Self, Error> {
        let description = &nominal.description;
        for response in &wanted {
            match response {
                Response::Mode { mode, .. } => check_mode(*mode, modes)?,
                Response::Output(output) => {
                    let (index, count) = (output.index(), description.outputs.len());
                    if index >= count {
                        return Err(Error::UnknownHandle {
                            kind: "output",
                            index,
                            mechanism: description.name.clone(),
                            count,
                        });
                    }
                }
                Response::Critical(range) => range.check(description)?,
                Response::Crossing { mode, range, .. } => {
                    check_mode(*mode, modes)?;
                    range.check(description)?;
                }
            }
        }
        Ok(Self {
            mechanism,
            batches: None,
            vectors: Some(Instructions::best()),
            nominal,
            modes,
            wanted,
            watch: Watch::default(),
        })
    }

    /// Lets `watch` see each design, and end the evaluation with [`Error::Stopped`].
    #[must_use]
    pub fn watched(mut self, watch: Watch<'a>) -> Self {
        self.watch = watch;
        self
    }

    /// Whether the work may go on.
    pub(crate) fn go_on(&self) -> Result<(), Error> {
        match self.watch.stopped() {
            true => Err(Error::Stopped),
            false => Ok(()),
        }
    }

    /// Counts a design that is evaluated, where the work may go on.
    pub(crate) fn counted(&self) -> Result<(), Error> {
        self.go_on()?;
        self.watch.advance(1);
        Ok(())
    }

    pub(crate) fn watch(&self) -> Watch<'a> {
        self.watch
    }

    /// The same of a mechanism that can be evaluated at several designs side by side: samples of quantities of modes are then
    /// solved in the vectors of the processor where [`monte_carlo`](crate::tolerance::monte_carlo) does so.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn side_by_side(
        mechanism: &'a dyn BatchKernels,
        nominal: &'a Equilibrium,
        modes: &'a Modes,
        wanted: Vec<Response>,
    ) -> Result<Self, Error> {
        Ok(Self {
            batches: Some(mechanism),
            ..Self::new(mechanism, nominal, modes, wanted)?
        })
    }

    /// Chooses the vector instructions of [`Self::side_by_side`], in place of the best of the processor; `None` solves designs one by
    /// one.
    #[must_use]
    pub fn vectors(mut self, vectors: Option<Instructions>) -> Self {
        self.vectors = vectors;
        self
    }

    /// What solves designs side by side, and with which instructions.
    pub(crate) fn batches(&self) -> Option<(&'a dyn BatchKernels, Instructions)> {
        self.batches.zip(self.vectors)
    }

    /// The responses in order.
    #[must_use]
    pub fn wanted(&self) -> &[Response] {
        &self.wanted
    }

    /// The design about which responses are asked for, and its equilibrium.
    pub(crate) fn nominal(&self) -> &'a Equilibrium {
        self.nominal
    }

    pub(crate) fn mechanism(&self) -> &'a dyn DirectionalKernels {
        self.mechanism
    }

    /// The nominal modes.
    pub(crate) fn modes(&self) -> &'a Modes {
        self.modes
    }

    /// Room for evaluations by one thread.
    #[must_use]
    pub fn workspace(&self) -> Workspace {
        Workspace(Solution::about(self.nominal, self.modes))
    }

    /// The responses to a design, SI.
    ///
    /// # Errors
    /// [`Error::WrongLength`] for a design of another mechanism, [`Error::Stopped`]. What fails is an outcome and has no values.
    pub fn at(&self, room: &mut Workspace, design: &[f64]) -> Result<Realisation, Error> {
        self.evaluate(room, design, false)
    }

    /// Like [`Self::at`], with derivatives.
    ///
    /// # Errors
    /// As [`Self::at`].
    pub fn with_gradients(
        &self,
        room: &mut Workspace,
        design: &[f64],
    ) -> Result<Realisation, Error> {
        self.evaluate(room, design, true)
    }

    fn evaluate(
        &self,
        Workspace(solved): &mut Workspace,
        design: &[f64],
        slopes: bool,
    ) -> Result<Realisation, Error> {
        crate::arguments::check_count("design variables", design, self.nominal.design.len())?;
        self.counted()?;
        solved.solve(self.mechanism, self.nominal, self.modes, design);
        let stable = solved.outcome == Outcome::Stable;
        let mut found = Realisation {
            outcome: solved.outcome,
            values: Vec::with_capacity(self.wanted.len()),
            gradients: Vec::new(),
        };
        let mut own = Own::default();
        for response in &self.wanted {
            let (value, gradient) = match response {
                Response::Critical(range) => {
                    let state = self.critical_state(design, *range);
                    let asked = state.as_ref().filter(|_| slopes);
                    let gradient =
                        asked.and_then(|state| critical_sensitivity(self.mechanism, state).ok());
                    (state.map(|state| state.value), gradient)
                }
                Response::Crossing { .. } => {
                    let state = self.first_crossing(design, response);
                    let asked = state.as_ref().filter(|_| slopes);
                    let gradient =
                        asked.and_then(|state| crossing_sensitivity(self.mechanism, state).ok());
                    (state.map(|state| state.value), gradient)
                }
                _ if !stable => (None, None),
                Response::Mode { mode, quantity } => {
                    let value = solved.mode(*mode).and_then(|mode| quantity.of(mode));
                    let slopes = value.filter(|_| slopes);
                    let place = solved.place(*mode);
                    let gradient = slopes.and(place).and_then(|place| {
                        let all = own.of_modes(self.mechanism, solved)?;
                        Some(all.modes.get(place)?.of(*quantity)?.by_design)
                    });
                    (value, gradient)
                }
                Response::Output(output) => {
                    let k = output.index();
                    let state = &solved.state;
                    let kernels: &dyn Kernels = self.mechanism;
                    let values = kernels.outputs(&state.coordinates, &state.inputs, design);
                    let value = values.get(k).copied().filter(|value| value.is_finite());
                    let slopes = value.filter(|_| slopes);
                    let gradient = slopes.and_then(|_| {
                        let all = own.of_outputs(self.mechanism, solved)?;
                        all.by_design.get(k)?.clone()
                    });
                    (value, gradient)
                }
            };
            found.values.push(value);
            if slopes {
                found.gradients.push(gradient);
            }
        }
        Ok(found)
    }

    pub(crate) fn critical_state(&self, design: &[f64], range: Range) -> Option<CriticalState> {
        let (inputs, start) = (&self.nominal.inputs, &self.nominal.coordinates);
        if self.mechanism.violation(inputs, design).is_some() {
            return None;
        }
        critical_state(self.mechanism, inputs, design, start, range).ok()
    }

    /// The state of a [`Response::Crossing`].
    pub(crate) fn first_crossing(&self, design: &[f64], response: &Response) -> Option<Crossing> {
        let Response::Crossing {
            mode,
            condition,
            range,
        } = *response
        else {
            return None;
        };
        let (inputs, start) = (&self.nominal.inputs, &self.nominal.coordinates);
        let (values, what) = ((&**inputs, design), (mode, condition));
        first_crossing(
            self.mechanism,
            values,
            start,
            Following::default(),
            range,
            what,
        )
        .ok()
        .flatten()
    }
}

fn check_mode(mode: usize, modes: &Modes) -> Result<(), Error> {
    let count = modes.modes.len();
    match mode < count {
        true => Ok(()),
        false => Err(Error::NoSuchMode { mode, count }),
    }
}

/// Derivatives at one design, found when first asked for.
#[derive(Default)]
struct Own {
    modes: Option<Option<crate::Sensitivities>>,
    outputs: Option<Option<crate::sensitivity::OutputSensitivities>>,
}

impl Own {
    fn of_modes(
        &mut self,
        mechanism: &dyn Kernels,
        solved: &Solution,
    ) -> Option<&crate::Sensitivities> {
        let found = || sensitivities(mechanism, &solved.state, solved.modes()).ok();
        self.modes.get_or_insert_with(found).as_ref()
    }

    fn of_outputs(
        &mut self,
        mechanism: &dyn Kernels,
        solved: &Solution,
    ) -> Option<&crate::sensitivity::OutputSensitivities> {
        let found = || output_sensitivities(mechanism, &solved.state).ok();
        self.outputs.get_or_insert_with(found).as_ref()
    }
}
