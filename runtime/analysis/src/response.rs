//! Responses of a mechanism at designs near the nominal one: quantities of modes, outputs and critical values of an
//! input, with exact total derivatives.

use crate::algebra::Vector;
use crate::along::name_of;
use crate::clusters::common_slopes;
use crate::forced::{self, ForcedResponse, Measure};
use crate::kernels::{BatchKernels, CurvatureKernels, DirectionalKernels, Kernels};
use crate::modes::Family;
use crate::scalar::Instructions;
use crate::second_order::SecondDerivatives;
use crate::sensitivity::{Quantity, Slopes, eigenvalue_slope, output_sensitivities, sensitivities};
use crate::sweep::{
    Change, Condition, CriticalState, Crossing, Following, Range, critical_sensitivity,
    critical_state, crossing_sensitivity, first_crossing, meeting,
};
use crate::tolerance::{Outcome, Solution};
use crate::{
    Any, Complex, Description, Equilibrium, Error, Excitation, Modes, Output, Text, Unit, Watch,
};

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

/// The vibration of an output under all excitations that have one frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Vibration {
    /// The output.
    pub output: Output,
    /// One of the excitations.
    pub excitation: Excitation,
    /// What is measured.
    pub measure: Measure,
}

impl Vibration {
    /// The output as a displacement.
    #[must_use]
    pub fn new<M>(output: Output<M>, excitation: Excitation<M>) -> Self {
        Self {
            output: output.any(),
            excitation: excitation.any(),
            measure: Measure::Displacement,
        }
    }

    /// Every output under every harmonic, as a displacement.
    #[must_use]
    pub fn all(of: &Description) -> Vec<Self> {
        let harmonics = of.excitations.iter().enumerate();
        let firsts = harmonics.filter(|(k, info)| info.with == *k);
        let each = |(k, _)| {
            let outputs = (0..of.outputs.len()).map(Output::<Any>::new);
            outputs.map(move |output| Self::new(output, Excitation::new(k)))
        };
        firsts.flat_map(each).collect()
    }

    /// The output as a velocity or an acceleration.
    #[must_use]
    pub fn measure(self, measure: Measure) -> Self {
        Self { measure, ..self }
    }

    /// The amplitude in a response.
    pub(crate) fn of(&self, response: &ForcedResponse) -> Option<f64> {
        let harmonic = self.place(&response.description)?;
        let amplitude = response
            .harmonics
            .get(harmonic)?
            .amplitude(self.output, self.measure)?;
        Some(amplitude.norm()).filter(|value| value.is_finite())
    }

    /// The amplitude with its total first and second derivatives; `None` where it has none.
    #[expect(clippy::type_complexity, reason = "a value and its derivatives")]
    pub(crate) fn quadratic(
        &self,
        mechanism: &dyn CurvatureKernels,
        at: &Equilibrium,
    ) -> Result<Option<((f64, Slopes<f64>), SecondDerivatives<f64>)>, Error> {
        let all = forced::second_derivatives(mechanism, at)?;
        let found = || {
            let (place, output) = (self.place(&at.description)?, self.output);
            let value = self.of(&all.first.response)?;
            let first = all.first.modulus(place, output, self.measure)?;
            let second = all.modulus(place, output, self.measure)?;
            Some(((value, first), second))
        };
        Ok(found())
    }

    /// Refuses handles of another mechanism.
    pub(crate) fn check(&self, of: &Description) -> Result<(), Error> {
        check_output(self.output, of)?;
        let (index, count) = (self.excitation.index(), of.excitations.len());
        match index < count {
            true => Ok(()),
            false => Err(Error::UnknownHandle {
                kind: "excitation",
                index,
                mechanism: of.name.clone(),
                count,
            }),
        }
    }

    /// The position of its harmonic.
    pub(crate) fn place(&self, of: &Description) -> Option<usize> {
        let with = of.excitations.get(self.excitation.index())?.with;
        let firsts = of.excitations.iter().enumerate().take(with + 1);
        firsts
            .filter(|(k, info)| info.with == *k)
            .count()
            .checked_sub(1)
    }

    fn name(&self, of: &Description) -> String {
        let output = of.outputs.get(self.output.index());
        let output = output.map_or("?", |info| &*info.name);
        let with = of
            .excitations
            .get(self.excitation.index())
            .map(|info| info.with);
        let members = of.excitations.iter().filter(|info| Some(info.with) == with);
        let names: Vec<&str> = members.map(|info| &*info.name).collect();
        let measure = match self.measure {
            Measure::Displacement => "",
            Measure::Velocity => "rate of ",
            Measure::Acceleration => "acceleration of ",
        };
        format!("{measure}{output} under {}", names.join(", "))
    }

    fn unit(&self, of: &Description) -> Option<Unit> {
        let unit = &of.outputs.get(self.output.index())?.unit;
        let per = match self.measure {
            Measure::Displacement => return Some(unit.clone()),
            Measure::Velocity => "/s",
            Measure::Acceleration => "/s^2",
        };
        let symbol = match &*unit.symbol {
            "" => format!("1{per}"),
            symbol => format!("{symbol}{per}"),
        };
        Some(Unit {
            symbol: Text::from(symbol),
            scale: unit.scale,
        })
    }
}

impl Response {
    /// Whether it describes the state at the operating point: a mode or an output, which only a stable equilibrium has.
    pub(crate) fn of_state(self) -> bool {
        matches!(
            self,
            Self::Mode { .. } | Self::Output(_) | Self::Vibration(_)
        )
    }

    /// Its name in texts and tables, for example `frequency 1` or `critical speed`.
    ///
    /// An output has its declared name, a crossing one such as `speed where frequency 2 is 1 times speed`. `of`
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
            Self::Critical(range) => format!("critical {}", name_of(of, range.input)),
            Self::Crossing {
                mode,
                condition,
                range,
            } => {
                let name = name_of(of, range.input);
                let link = match condition {
                    Condition::Line(_) => "where",
                    Condition::FlutterOnset => "at the",
                };
                format!(
                    "{name} {link} {}",
                    meeting(*mode, *condition, Change::Onset, name)
                )
            }
        }
    }

    /// The unit of its values in texts and tables: as declared, or that of the quantity of a mode.
    #[must_use]
    pub fn unit(&self, of: &Description) -> Unit {
        let declared = match self {
            Self::Mode { quantity, .. } => return quantity.unit(),
            Self::Output(output) => of.outputs.get(output.index()).map(|info| &info.unit),
            Self::Vibration(vibration) => {
                let unit = vibration.unit(of);
                return unit.unwrap_or_else(|| Quantity::DampingRatio.unit());
            }
            Self::Critical(range) | Self::Crossing { range, .. } => {
                of.inputs.get(range.input.index()).map(|info| &info.unit)
            }
        };
        declared
            .cloned()
            .unwrap_or_else(|| Quantity::DampingRatio.unit())
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
    mechanism: &'a dyn DirectionalKernels,
    /// The same mechanism, if several designs can be solved at once.
    batches: Option<&'a dyn BatchKernels>,
    vectors: Option<Instructions>,
    nominal: &'a Equilibrium,
    modes: &'a Modes,
    wanted: Vec<Response>,
    watch: Watch<'a>,
}

/// Buffers reused between evaluations.
pub struct Workspace(Solution);

impl<'a> Responses<'a> {
    /// Prepares evaluations of responses near the nominal design.
    ///
    /// # Errors
    /// [`Error::NoSuchMode`], [`Error::UnknownHandle`], or [`Error::Setting`] for an invalid range.
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
                Response::Output(output) => check_output(*output, description)?,
                Response::Vibration(vibration) => vibration.check(description)?,
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

    /// Reports every design to `watch`, which can end the evaluation with [`Error::Stopped`].
    #[must_use]
    pub fn watched(mut self, watch: Watch<'a>) -> Self {
        self.watch = watch;
        self
    }

    /// Fails if the work has been stopped.
    pub(crate) fn go_on(&self) -> Result<(), Error> {
        match self.watch.stopped() {
            true => Err(Error::Stopped),
            false => Ok(()),
        }
    }

    /// Counts one evaluated design; fails if the work has been stopped.
    pub(crate) fn counted(&self) -> Result<(), Error> {
        self.go_on()?;
        self.watch.advance(1);
        Ok(())
    }

    pub(crate) fn watch(&self) -> Watch<'a> {
        self.watch
    }

    /// Like [`Self::new`], for a mechanism that can be evaluated at several designs at once: samples of mode quantities
    /// then use the processor's vector instructions under the same conditions as in
    /// [`monte_carlo`](crate::tolerance::monte_carlo).
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

    /// Chooses the vector instructions for [`Self::side_by_side`] (default: the best the processor supports); `None`
    /// solves designs one by one.
    #[must_use]
    pub fn vectors(mut self, vectors: Option<Instructions>) -> Self {
        self.vectors = vectors;
        self
    }

    /// The kernels that solve several designs at once, and their vector instructions.
    pub(crate) fn batches(&self) -> Option<(&'a dyn BatchKernels, Instructions)> {
        self.batches.zip(self.vectors)
    }

    /// The requested responses in order.
    #[must_use]
    pub fn wanted(&self) -> &[Response] {
        &self.wanted
    }

    /// Equilibrium solutions needed for one design.
    pub(crate) fn price(&self) -> u64 {
        let steps = self.wanted.iter().map(|response| match response {
            Response::Critical(range) | Response::Crossing { range, .. } => range.steps as u64,
            Response::Mode { .. } | Response::Output(_) | Response::Vibration(_) => 0,
        });
        steps.fold(1, u64::saturating_add)
    }

    /// The nominal equilibrium, about which responses are evaluated.
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

    /// Creates a workspace for evaluations on one thread.
    #[must_use]
    pub fn workspace(&self) -> Workspace {
        Workspace(Solution::about(self.nominal, self.modes))
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
        let stable = solved.continues(self.nominal);
        let unstable = matches!(solved.outcome, Outcome::Divergent | Outcome::Flutter);
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
                _ if !(stable || unstable && tells_stability(response)) => (None, None),
                Response::Mode { mode, quantity } => {
                    let value = solved.mode(*mode).and_then(|mode| quantity.of(mode));
                    let slopes = value.filter(|_| slopes);
                    let place = solved.place(*mode);
                    let gradient = slopes.and(place).and_then(|place| {
                        let all = own.of_modes(self.mechanism, solved)?;
                        let own = all.modes.get(place)?;
                        match own.clustered {
                            false => Some(own.of(*quantity)?.by_design),
                            true => self.common_gradient(solved, place, *quantity),
                        }
                    });
                    (value, gradient)
                }
                Response::Vibration(vibration) => {
                    let state = &solved.state;
                    let found = own.of_vibrations(self.mechanism, solved);
                    let value = found.and_then(|found| vibration.of(found));
                    let gradient = value.filter(|_| slopes).and_then(|_| {
                        let all = forced::sensitivities(self.mechanism, state).ok()?;
                        let place = vibration.place(&state.description)?;
                        let slopes = all.modulus(place, vibration.output, vibration.measure)?;
                        Some(slopes.by_design)
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

    /// Derivatives of a quantity of one of several equal modes, if no variable splits them.
    fn common_gradient(
        &self,
        solved: &Solution,
        place: usize,
        quantity: Quantity,
    ) -> Option<Vector> {
        let modes = solved.modes();
        let slopes = common_slopes(self.mechanism, &solved.state, modes, place)?;
        let s = modes.modes.get(place)?.s;
        let slope = |own: &Complex| match modes.family {
            Family::Undamped => eigenvalue_slope(s, own.re),
            Family::General => *own,
        };
        let each = slopes.iter().map(|own| quantity.slope(s, slope(own)));
        (s != Complex::ZERO).then(|| each.collect())
    }

    pub(crate) fn critical_state(&self, design: &[f64], range: Range) -> Option<CriticalState> {
        let (inputs, start) = (&self.nominal.inputs, &self.nominal.coordinates);
        if self.mechanism.violation(inputs, design).is_some() {
            return None;
        }
        critical_state(self.mechanism, inputs, design, start, range).ok()
    }

    /// The first crossing that a [`Response::Crossing`] asks for.
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

/// Whether a response says how stable an equilibrium is: it exists at an unstable one too.
fn tells_stability(response: &Response) -> bool {
    let Response::Mode { quantity, .. } = response else {
        return false;
    };
    matches!(quantity, Quantity::DampingRatio | Quantity::Growth)
}

fn check_output(output: Output, description: &Description) -> Result<(), Error> {
    let (index, count) = (output.index(), description.outputs.len());
    if index < count {
        return Ok(());
    }
    Err(Error::UnknownHandle {
        kind: "output",
        index,
        mechanism: description.name.clone(),
        count,
    })
}

fn check_mode(mode: usize, modes: &Modes) -> Result<(), Error> {
    let count = modes.modes.len();
    match mode < count {
        true => Ok(()),
        false => Err(Error::NoSuchMode { mode, count }),
    }
}

/// Derivatives at one design, computed when first needed.
#[derive(Default)]
struct Own {
    modes: Option<Option<crate::Sensitivities>>,
    outputs: Option<Option<crate::sensitivity::OutputSensitivities>>,
    vibrations: Option<Option<ForcedResponse>>,
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

    fn of_vibrations(
        &mut self,
        mechanism: &dyn Kernels,
        solved: &Solution,
    ) -> Option<&ForcedResponse> {
        let found = || forced::response(mechanism, &solved.state).ok();
        self.vibrations.get_or_insert_with(found).as_ref()
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
