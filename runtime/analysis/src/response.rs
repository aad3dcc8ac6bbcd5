//! Responses of a mechanism at designs near the nominal one: quantities of modes, outputs and critical values of an
//! input, with exact total derivatives.

mod missing;

use crate::algebra::Vector;
use crate::along::name_of;
use crate::clusters::common_slopes;
use crate::equilibrium::Needed;
pub use crate::forced::Vibration;
use crate::forced::{self, ForcedResponse, ForcedSensitivities, check_output};
use crate::kernels::{BatchKernels, CurvatureKernels, Kernels, SummaryKernels};
use crate::modes::Family;
use crate::peaks::{self, PeakQuantity};
use crate::scalar::Instructions;
use crate::sensitivity::{Quantity, eigenvalue_slope, output_sensitivities, sensitivities};
use crate::sweep::{
    Change, Condition, CriticalState, Crossing, Following, Range, critical_sensitivity, critical_state,
    crossing_sensitivity, first_crossing, meeting,
};
use crate::tolerance::side_by_side::SolvedDesign;
use crate::tolerance::{Outcome, Solution};
use crate::{Complex, Description, Equilibrium, Error, Modes, Output, Unit, Watch};

/// A scalar that depends on the design.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Response {
    /// A quantity of a nominal mode, counted from 0: frequencies in rad/s, growth in 1/s. Modes with equal nominal
    /// eigenvalues have no identity but their order: the first of them is the lowest in every design.
    Mode {
        /// Position of the nominal mode, from 0.
        mode: usize,
        /// The quantity of that mode.
        quantity: Quantity,
    },
    /// An output, SI.
    Output(Output),
    /// The amplitude, 0 to peak, with which an output vibrates under excitations, SI.
    Vibration(Vibration),
    /// The greatest amplitude of a vibration in a range of an input, or where its highest peak is. The search follows
    /// stable equilibria ([`peaks`](fn@crate::peaks::peaks)).
    Peak {
        /// The vibration.
        vibration: Vibration,
        /// The range to search.
        range: Range,
        /// What is asked about it.
        quantity: PeakQuantity,
    },
    /// The first value (SI) of an input in a range at which the branch that is stable at the low end loses its
    /// stiffness ([`critical_state`]).
    Critical(Range),
    /// The first value (SI) of an input in a range at which a mode meets a condition, such as the speed at which a
    /// rotor resonates or starts to flutter. The search follows stable equilibria, like
    /// [`crossings`](crate::sweep::crossings).
    Crossing {
        /// Position of the mode at the start of the range, from 0.
        mode: usize,
        /// The condition to be met.
        condition: Condition,
        /// The range to search.
        range: Range,
    },
}

impl Response {
    /// Whether it describes the state at the operating point: a mode or an output, which only a stable equilibrium has.
    #[doc(hidden)]
    pub fn of_state(self) -> bool {
        matches!(self, Self::Mode { .. } | Self::Output(_) | Self::Vibration(_))
    }

    /// The range of an input along which it is sought.
    #[must_use]
    pub fn range(&self) -> Option<Range> {
        match self {
            Self::Critical(range) | Self::Crossing { range, .. } | Self::Peak { range, .. } => Some(*range),
            Self::Mode { .. } | Self::Output(_) | Self::Vibration(_) => None,
        }
    }

    /// Whether it is a size, which is never below zero: a frequency or an amplitude.
    #[must_use]
    pub fn never_negative(&self) -> bool {
        match self {
            Self::Mode { quantity, .. } => {
                matches!(quantity, Quantity::Frequency | Quantity::NaturalFrequency)
            }
            Self::Vibration(_) => true,
            Self::Peak { quantity, .. } => *quantity == PeakQuantity::Height,
            Self::Output(_) | Self::Critical(_) | Self::Crossing { .. } => false,
        }
    }

    /// Its name in texts and tables, for example `frequency 1` or `critical speed`.
    ///
    /// An output has its declared name, a crossing one such as `speed where frequency 2 crosses 1x speed`. `of`
    /// describes the mechanism.
    #[must_use]
    pub fn name(&self, of: &Description) -> String {
        match self {
            Self::Mode { mode, quantity } => format!("{quantity} {}", mode + 1),
            Self::Output(output) => {
                let info = of.outputs.get(output.index());
                info.map_or("?", |info| &*info.name).to_owned()
            }
            Self::Vibration(vibration) => vibration.name(of),
            Self::Peak { vibration, range, quantity } => {
                let (name, input) = (vibration.name(of), name_of(of, range.input));
                match quantity {
                    PeakQuantity::Height => format!("greatest {name} along {input}"),
                    PeakQuantity::Place => format!("{input} at the peak of {name}"),
                }
            }
            Self::Critical(range) => format!("critical {}", name_of(of, range.input)),
            Self::Crossing { mode, condition, range } => {
                let name = name_of(of, range.input);
                let link = match condition {
                    Condition::Line(_) => "where",
                    Condition::FlutterOnset => "at the",
                };
                format!("{name} {link} {}", meeting(*mode, *condition, Change::Onset, name))
            }
        }
    }

    /// The unit of its values in texts and tables: as declared, or that of the quantity of a mode.
    #[must_use]
    pub fn unit(&self, of: &Description) -> Unit {
        let declared = match self {
            Self::Mode { quantity, .. } => return quantity.unit(),
            Self::Output(output) => of.outputs.get(output.index()).map(|info| &info.unit),
            Self::Vibration(vibration) | Self::Peak { vibration, quantity: PeakQuantity::Height, .. } => {
                let unit = vibration.unit(of);
                return unit.unwrap_or_else(|| Quantity::DampingRatio.unit());
            }
            _ => self.range().and_then(|range| of.inputs.get(range.input.index())).map(|info| &info.unit),
        };
        declared.cloned().unwrap_or_else(|| Quantity::DampingRatio.unit())
    }
}

/// The responses at one design.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Realisation {
    /// The outcome at the operating point.
    pub outcome: Outcome,
    /// The responses in the order requested. `None` where a response does not exist: the mode does not oscillate, the
    /// design has no stable equilibrium, or the range has no critical value. Growth and damping ratio, which say how
    /// stable an equilibrium is, exist at an unstable one too.
    pub values: Vec<Option<f64>>,
    /// Total derivatives with respect to the design variables, if requested; `None` where they do not exist, as for one
    /// of several equal eigenvalues that a variable splits.
    pub gradients: Vec<Option<Vector>>,
}

/// Evaluates responses at designs near a nominal one. Modes are matched to the nominal modes by shape.
pub struct Responses<'a> {
    mechanism: &'a dyn CurvatureKernels,
    /// The same mechanism, if several designs can be solved at once.
    batches: Option<&'a dyn BatchKernels>,
    vectors: Option<Instructions>,
    nominal: &'a Equilibrium,
    modes: &'a Modes,
    wanted: Vec<Response>,
    watch: Watch<'a>,
    /// For flutter, the modes that flutter in the nominal design. Two modes merge there, and either may be the one that
    /// grows: one that does not flutter in the nominal design stands for the one that does.
    flutter: Vec<(Response, Vec<usize>)>,
}

/// Buffers reused between evaluations.
pub struct Workspace {
    solution: Solution,
    unjudged: bool,
}

impl Workspace {
    /// For the state of each design whatever its stability, which is not found out.
    #[doc(hidden)]
    #[must_use]
    pub fn unjudged(self) -> Self {
        Self { unjudged: true, ..self }
    }
}

impl<'a> Responses<'a> {
    /// Prepares evaluations of responses near the nominal design.
    ///
    /// # Errors
    /// [`Error::NoSuchMode`], [`Error::UnknownHandle`], or [`Error::Setting`] for an invalid range.
    pub fn new(
        mechanism: &'a dyn CurvatureKernels,
        nominal: &'a Equilibrium,
        modes: &'a Modes,
        wanted: Vec<Response>,
    ) -> Result<Self, Error> {
        let description = &nominal.description;
        for response in &wanted {
            match response {
                Response::Mode { mode, .. } => check_mode(*mode, modes)?,
                Response::Output(output) => check_output(*output, description)?,
                Response::Vibration(vibration) => vibration.check(description)?,
                Response::Peak { vibration, range, .. } => {
                    vibration.check(description)?;
                    range.check(description)?;
                }
                Response::Critical(range) => range.check(description)?,
                Response::Crossing { mode, range, .. } => {
                    check_mode(*mode, modes)?;
                    range.check(description)?;
                }
            }
        }
        let mut responses = Self {
            mechanism,
            batches: None,
            vectors: Some(Instructions::best()),
            nominal,
            modes,
            wanted,
            watch: Watch::default(),
            flutter: Vec::new(),
        };
        let flutter = responses.wanted.iter().filter_map(|response| {
            Some((*response, responses.nominal_flutter(*response)?.into_iter().map(|(mode, _)| mode).collect()))
        });
        responses.flutter = flutter.collect();
        Ok(responses)
    }

    /// Reports every design to `watch`, which can end the evaluation with [`Error::Stopped`].
    #[must_use]
    pub fn watched(mut self, watch: Watch<'a>) -> Self {
        self.watch = watch;
        self
    }

    /// Fails if the work has been stopped.
    #[doc(hidden)]
    pub fn go_on(&self) -> Result<(), Error> {
        if self.watch.stopped() { Err(Error::Stopped) } else { Ok(()) }
    }

    /// Counts one evaluated design; fails if the work has been stopped.
    #[doc(hidden)]
    pub fn counted(&self) -> Result<(), Error> {
        self.go_on()?;
        self.watch.advance(1);
        Ok(())
    }

    #[doc(hidden)]
    pub fn watch(&self) -> Watch<'a> {
        self.watch
    }

    /// Like [`Self::new`], for a mechanism that can be evaluated at several designs at once: samples of mode quantities
    /// then use the processor's vector instructions under the same conditions as in
    /// [`monte_carlo`](crate::tolerance::monte_carlo).
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn side_by_side(
        mechanism: &'a dyn SummaryKernels,
        nominal: &'a Equilibrium,
        modes: &'a Modes,
        wanted: Vec<Response>,
    ) -> Result<Self, Error> {
        Ok(Self { batches: Some(mechanism), ..Self::new(mechanism, nominal, modes, wanted)? })
    }

    /// Chooses the vector instructions for [`Self::side_by_side`] (default: the best the processor supports); `None`
    /// solves designs one by one.
    #[must_use]
    pub fn vectors(mut self, vectors: Option<Instructions>) -> Self {
        self.vectors = vectors;
        self
    }

    /// The kernels that solve several designs at once, and their vector instructions.
    #[doc(hidden)]
    pub fn batches(&self) -> Option<(&'a dyn BatchKernels, Instructions)> {
        self.batches.zip(self.vectors)
    }

    /// The requested responses in order.
    #[must_use]
    pub fn wanted(&self) -> &[Response] {
        &self.wanted
    }

    /// Equilibrium solutions needed for one design.
    #[doc(hidden)]
    pub fn price(&self) -> u64 {
        let ranges = self.wanted.iter().filter_map(Response::range);
        ranges.map(|range| range.steps as u64).fold(1, u64::saturating_add)
    }

    /// The nominal equilibrium, about which responses are evaluated.
    #[doc(hidden)]
    pub fn nominal(&self) -> &'a Equilibrium {
        self.nominal
    }

    #[doc(hidden)]
    pub fn mechanism(&self) -> &'a dyn CurvatureKernels {
        self.mechanism
    }

    /// The nominal modes.
    #[doc(hidden)]
    pub fn modes(&self) -> &'a Modes {
        self.modes
    }

    /// Creates a workspace for evaluations on one thread.
    #[must_use]
    pub fn workspace(&self) -> Workspace {
        Workspace { solution: Solution::about(self.nominal, self.modes), unjudged: false }
    }

    /// Evaluates the responses at a design, SI.
    ///
    /// # Errors
    /// [`Error::WrongLength`] for a design of another mechanism, [`Error::Stopped`]. A design that fails to solve is
    /// reported as an outcome without values.
    pub fn at(&self, room: &mut Workspace, design: &[f64]) -> Result<Realisation, Error> {
        self.evaluate(room, design, false)
    }

    /// Like [`Self::at`], with total derivatives.
    ///
    /// # Errors
    /// As [`Self::at`].
    pub fn with_gradients(&self, room: &mut Workspace, design: &[f64]) -> Result<Realisation, Error> {
        self.evaluate(room, design, true)
    }

    fn evaluate(&self, room: &mut Workspace, design: &[f64], slopes: bool) -> Result<Realisation, Error> {
        crate::arguments::check_count("design variables", design, self.nominal.design.len())?;
        self.counted()?;
        let of_mode = |response: &Response| matches!(response, Response::Mode { .. });
        let needed = match self.wanted.iter().any(of_mode) {
            true => Needed::Modes,
            false if room.unjudged => Needed::State,
            false => Needed::Verdict,
        };
        let solved = &mut room.solution;
        solved.solve(self.mechanism, self.nominal, (self.modes, needed), design);
        let stable = match needed {
            Needed::State => solved.solved,
            _ => solved.continues(self.nominal),
        };
        let unstable = matches!(solved.outcome, Outcome::Divergent | Outcome::Flutter);
        let mut realisation = Realisation {
            outcome: solved.outcome,
            values: Vec::with_capacity(self.wanted.len()),
            gradients: Vec::new(),
        };
        let mut derivatives = LazyDerivatives::default();
        for response in &self.wanted {
            let (value, gradient) = match response {
                Response::Critical(range) => {
                    let state = self.critical_state(design, *range);
                    let asked = state.as_ref().filter(|_| slopes);
                    let gradient = asked.and_then(|state| critical_sensitivity(self.mechanism, state).ok());
                    (state.map(|state| state.value), gradient)
                }
                Response::Crossing { .. } => {
                    let state = self.first_crossing(design, response);
                    let asked = state.as_ref().filter(|_| slopes);
                    let gradient = asked.and_then(|state| crossing_sensitivity(self.mechanism, state).ok());
                    (state.map(|state| state.value), gradient)
                }
                Response::Peak { vibration, range, quantity } => {
                    match self.peak(design, (*vibration, *range, *quantity)) {
                        Some((value, slopes)) => (Some(value), slopes),
                        None => (None, None),
                    }
                }
                _ if !(stable || unstable && tells_stability(response)) => (None, None),
                Response::Mode { mode, quantity } => {
                    let value = solved.mode(*mode).and_then(|mode| quantity.of(mode));
                    let slopes = value.filter(|_| slopes);
                    let index = solved.place(*mode);
                    let gradient = slopes.and(index).and_then(|position| {
                        let mode = derivatives.of_modes(self.mechanism, solved)?.modes.get(position)?;
                        if mode.clustered {
                            self.common_gradient(solved, position, *quantity)
                        } else {
                            Some(mode.of(*quantity)?.by_design)
                        }
                    });
                    (value, gradient)
                }
                Response::Vibration(vibration) => {
                    let forced_response = derivatives.of_vibrations(self.mechanism, solved);
                    let value = forced_response.and_then(|found| vibration.of(found));
                    let gradient = value.filter(|_| slopes).and_then(|_| {
                        let all = derivatives.along_vibrations(self.mechanism, solved)?;
                        Some(vibration.slopes(all)?.by_design)
                    });
                    (value, gradient)
                }
                Response::Output(output) => {
                    let k = output.index();
                    let state = &solved.state;
                    let kernels: &dyn Kernels = self.mechanism;
                    let value = kernels
                        .outputs(&state.coordinates, &state.inputs, design)
                        .get(k)
                        .copied()
                        .filter(|value| value.is_finite());
                    let slopes = value.filter(|_| slopes);
                    let gradient =
                        slopes.and_then(|_| derivatives.of_outputs(self.mechanism, solved)?.by_design.get(k)?.clone());
                    (value, gradient)
                }
            };
            realisation.values.push(value);
            if slopes {
                realisation.gradients.push(gradient);
            }
        }
        Ok(realisation)
    }

    /// The responses of a design that was solved beside others, those of its equilibrium alone; `state` is a copy of the
    /// nominal one.
    #[doc(hidden)]
    pub fn of_solved(
        &self,
        design: &[f64],
        solved: &SolvedDesign<'_>,
        state: &mut Equilibrium,
        values: &mut [Option<f64>],
    ) {
        let mut forced = None;
        for (value, response) in values.iter_mut().zip(&self.wanted) {
            *value = match response {
                Response::Mode { mode, quantity } => {
                    let s = solved.eigenvalues.get(*mode);
                    s.and_then(|s| quantity.of_stable(*s))
                }
                Response::Vibration(vibration) => {
                    let forced_response = forced.get_or_insert_with(|| {
                        state.coordinates.copy_from_slice(solved.coordinates);
                        state.design.copy_from_slice(design);
                        let (q, u) = (&state.coordinates, &state.inputs);
                        self.mechanism.linear_into(q, u, design, &mut state.linear);
                        forced::response(self.mechanism, state).ok()
                    });
                    forced_response.as_ref().and_then(|forced_response| vibration.of(forced_response))
                }
                _ => None,
            };
        }
    }

    /// Derivatives of a quantity of one of several equal modes, if no variable splits them.
    fn common_gradient(&self, solved: &Solution, index: usize, quantity: Quantity) -> Option<Vector> {
        let modes = solved.modes();
        let slopes = common_slopes(self.mechanism, &solved.state, modes, index)?;
        let s = modes.modes.get(index)?.s;
        let slope = |complex: &Complex| match modes.family {
            Family::Undamped => eigenvalue_slope(s, complex.re),
            Family::General => *complex,
        };
        let each = slopes.iter().map(|x| quantity.slope(s, slope(x)));
        (s != Complex::ZERO).then(|| each.collect())
    }

    #[doc(hidden)]
    pub fn critical_state(&self, design: &[f64], range: Range) -> Option<CriticalState> {
        let (inputs, start) = (&self.nominal.inputs, &self.nominal.coordinates);
        if self.mechanism.violation(inputs, design).is_some() {
            return None;
        }
        critical_state(self.mechanism, inputs, design, start, range).ok()
    }

    /// What a [`Response::Peak`] asks for.
    fn peak(&self, design: &[f64], what: (Vibration, Range, PeakQuantity)) -> Option<(f64, Option<Vector>)> {
        let (inputs, start) = (&self.nominal.inputs, &self.nominal.coordinates);
        if self.mechanism.violation(inputs, design).is_some() {
            return None;
        }
        let values = (&**inputs, design);
        peaks::highest(self.mechanism, values, start, what).ok()
    }

    /// The first crossing that a [`Response::Crossing`] asks for.
    #[doc(hidden)]
    pub fn first_crossing(&self, design: &[f64], response: &Response) -> Option<Crossing> {
        let Response::Crossing { mode, condition, range } = *response else {
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
            self.flutter
                .iter()
                .find(|(own, _)| own == response)
                .filter(|(_, all)| all.contains(&mode))
                .map(|(_, all)| &all[..]),
        )
        .ok()
        .flatten()
    }
}

/// Whether a response says how stable an equilibrium is: it exists at an unstable one too.
fn tells_stability(response: &Response) -> bool {
    let Response::Mode { quantity, .. } = response else {
        return false;
    };
    matches!(quantity, Quantity::DampingRatio | Quantity::Growth | Quantity::LogDecrement)
}

fn check_mode(mode: usize, modes: &Modes) -> Result<(), Error> {
    let count = modes.modes.len();
    if mode < count { Ok(()) } else { Err(Error::NoSuchMode { mode, count }) }
}

/// Derivatives at one design, computed when first needed.
#[derive(Default)]
struct LazyDerivatives {
    modes: Option<Option<crate::Sensitivities>>,
    outputs: Option<Option<crate::sensitivity::OutputSensitivities>>,
    vibrations: Option<Option<ForcedResponse>>,
    along_vibrations: Option<Option<ForcedSensitivities>>,
}

impl LazyDerivatives {
    fn of_modes(&mut self, mechanism: &dyn Kernels, solved: &Solution) -> Option<&crate::Sensitivities> {
        let computed = || sensitivities(mechanism, &solved.state, solved.modes()).ok();
        self.modes.get_or_insert_with(computed).as_ref()
    }

    fn of_vibrations(&mut self, mechanism: &dyn Kernels, solved: &Solution) -> Option<&ForcedResponse> {
        let computed = || forced::response(mechanism, &solved.state).ok();
        self.vibrations.get_or_insert_with(computed).as_ref()
    }

    fn along_vibrations(&mut self, mechanism: &dyn Kernels, solved: &Solution) -> Option<&ForcedSensitivities> {
        let computed = || forced::sensitivities(mechanism, &solved.state).ok();
        self.along_vibrations.get_or_insert_with(computed).as_ref()
    }

    fn of_outputs(
        &mut self,
        mechanism: &dyn Kernels,
        solved: &Solution,
    ) -> Option<&crate::sensitivity::OutputSensitivities> {
        let computed = || output_sensitivities(mechanism, &solved.state).ok();
        self.outputs.get_or_insert_with(computed).as_ref()
    }
}
