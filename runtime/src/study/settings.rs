//! The settings of a study, and the steps that do not depend on the mechanism's type.

use std::borrow::Cow;
use std::sync::OnceLock;

use super::cache::Cache;
use super::parameter::Parameter;
use super::value::Value;
use super::variation::Variation;
use super::watcher::Watcher;
use crate::equilibrium;
use crate::equilibrium::{Assembly, OperatingPoint, Policy, Search};
use crate::kernels::Kernels;
use crate::modes::Family;
use crate::scalar::Instructions;
use crate::sensitivity::{self, Sensitivities};
use crate::tolerance::{Distribution, Sampling, Tolerances};
use crate::{Coordinate, CorrelationInfo, Description, Equilibrium, Error, Input, Mode, Modes, Shared, Unit, Watch};
use crate::{Matrix, Vector};
use eigentol_solve::constraints::Structure;
use eigentol_solve::free::{Held, declared};

/// What is solved at an operating point.
#[derive(Clone, Debug, Default)]
struct Solution {
    equilibrium: OnceLock<Result<Box<Equilibrium>, Error>>,
    modes: OnceLock<Result<Modes, Error>>,
    sensitivities: OnceLock<Result<Sensitivities, Error>>,
}

/// The operating point, the tolerances and the solver options.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Settings {
    pub(super) description: Shared<Description>,
    pub(super) inputs: Vector,
    pub(super) design: Vector,
    pub(super) start: Vector,
    /// Which coordinates have a start value of their own: they keep it when a mechanism with constraints is assembled,
    /// and an equilibrium with these values is the answer whatever its stability.
    named: Vec<bool>,
    /// The unknowns by which a member of a family of steady motions is held.
    holds: Vec<Held>,
    pub(super) policy: Policy,
    pub(super) family: Option<Family>,
    design_variations: Vec<Variation>,
    input_variations: Vec<Variation>,
    sigma_level: f64,
    correlation: Option<Matrix>,
    /// The tolerances that result from these settings at the current inputs and design.
    tolerances: Cache<OnceLock<Result<Tolerances, Error>>>,
    solution: Cache<Solution>,
    pub(super) samples: usize,
    pub(super) seed: u64,
    pub(super) stream: u64,
    pub(super) threads: usize,
    pub(super) vectors: Option<Instructions>,
    pub(super) keep_samples: bool,
    pub(super) steps: usize,
    pub(super) watcher: Watcher,
    fault: Option<Error>,
}

impl Settings {
    /// The nominal design with the declared tolerances.
    pub(super) fn new(description: Shared<Description>) -> Self {
        let (design, unknowns) = (&description.design, description.coordinates.len());
        Self {
            tolerances: Cache::default(),
            solution: Cache::default(),
            inputs: Vector::zeros(description.inputs.len()),
            design: design.iter().map(|info| info.nominal).collect(),
            start: Vector::zeros(unknowns),
            named: vec![false; unknowns],
            holds: Vec::new(),
            policy: Policy::Stable,
            family: None,
            design_variations: (design.iter()).map(|info| Variation::About(info.tolerance.clone())).collect(),
            input_variations: (description.inputs.iter())
                .map(|info| Variation::About(info.tolerance.clone()))
                .collect(),
            sigma_level: 3.0,
            correlation: None,
            samples: 3000,
            seed: 0,
            stream: 0,
            threads: 0,
            vectors: Some(Instructions::best()),
            keep_samples: false,
            steps: 200,
            watcher: Watcher::default(),
            fault: None,
            description,
        }
    }

    /// Sets the value of a parameter.
    pub(super) fn set_value(&mut self, parameter: Parameter, value: Value) {
        let value = self.si(parameter, value);
        let (slot, is_fixed) = match parameter {
            Parameter::Design(variable) => {
                (self.design.get_mut(variable.index()), self.design_variations.iter().all(Variation::is_fixed))
            }
            Parameter::Input(input) => {
                (self.inputs.get_mut(input.index()), self.input_variations.iter().all(Variation::is_none))
            }
        };
        set(slot, value, &mut self.fault);
        self.solution.clear();
        if !is_fixed {
            self.tolerances.clear();
        }
    }

    /// Holds an unknown at a value along a family of steady motions.
    pub(super) fn hold(&mut self, unknown: Coordinate, value: Value) {
        self.set_start(unknown, value, true);
        if let Some(&value) = self.start.get(unknown.index()) {
            self.holds.retain(|held| held.unknown != unknown.index());
            self.holds.push(Held::at(unknown.index(), value));
            self.solution.clear();
        }
    }

    /// The same settings for a mechanism that differs in its unknowns alone: those of the same name start at their
    /// values in an equilibrium of this one, the others at zero.
    #[cfg_attr(not(feature = "analysis"), allow(dead_code, reason = "only convergence asks for it"))]
    pub(super) fn of(&self, description: Shared<Description>, at: &Equilibrium) -> Self {
        let unknowns = &description.coordinates;
        let index_of = |unknown: usize| {
            let name = &self.description.coordinates.get(unknown)?.name;
            unknowns.iter().position(|info| info.name == *name)
        };
        let held = |held: &Held| Some(Held::at(index_of(held.unknown)?, held.value));
        let mut settings = Self {
            start: Vector::zeros(unknowns.len()),
            named: vec![false; unknowns.len()],
            holds: self.holds.iter().filter_map(held).collect(),
            policy: Policy::about(at),
            solution: Cache::default(),
            ..self.clone()
        };
        for (index, value) in at.coordinates.iter().enumerate() {
            if let Some(place) = index_of(index) {
                settings.start[place] = *value;
                settings.named[place] = self.named[index];
            }
        }
        settings.description = description;
        settings
    }

    /// Starts at all of these unknowns.
    pub(super) fn start_at(&mut self, unknowns: &[f64]) {
        self.start = unknowns.into();
        self.named.fill(true);
        self.solution.clear();
    }

    pub(super) fn set_start(&mut self, coordinate: Coordinate, value: Value, named: bool) {
        let all = self.description.coordinates.get(coordinate.index());
        let value = match all {
            Some(info) => Ok(value.si(&info.unit)),
            None => Err(self.unknown("coordinate", coordinate.index(), self.start.len())),
        };
        let slot = self.start.get_mut(coordinate.index());
        set(slot, value, &mut self.fault);
        if let Some(slot) = self.named.get_mut(coordinate.index()) {
            *slot = named;
        }
        self.solution.clear();
    }

    /// Chooses which equilibrium to look for.
    pub(super) fn set_policy(&mut self, policy: Policy) {
        self.policy = policy;
        self.solution.clear();
    }

    /// Chooses the family of modes.
    pub(super) fn set_family(&mut self, family: Family) {
        self.family = Some(family);
        self.solution.clear();
    }

    /// Sets tolerance limits as deviations from the value of a parameter.
    pub(super) fn set_limits(&mut self, parameter: Parameter, lower: Value, upper: Value) {
        let limits = (self.unit(parameter)).map(|unit| (lower.si(unit), upper.si(unit)));
        match limits {
            Ok(limits) => self.vary(parameter, |x| x.set_limits(limits, false)),
            Err(error) => self.refuse(error),
        }
    }

    /// Changes the variation of a parameter.
    pub(super) fn vary(&mut self, parameter: Parameter, change: impl FnOnce(&mut Variation)) {
        let (all, index) = match parameter {
            Parameter::Design(variable) => (&mut self.design_variations, variable.index()),
            Parameter::Input(input) => (&mut self.input_variations, input.index()),
        };
        if let Some(variation) = all.get_mut(index) {
            change(variation);
        } else if let Err(error) = self.unit(parameter).cloned() {
            self.refuse(error);
        }
        self.tolerances.clear();
    }

    fn refuse(&mut self, error: Error) {
        self.fault.get_or_insert(error);
    }

    pub(super) fn set_sigma_level(&mut self, level: f64) {
        self.sigma_level = level;
        self.tolerances.clear();
    }

    pub(super) fn set_correlation(&mut self, matrix: Matrix) {
        self.correlation = Some(matrix);
        self.tolerances.clear();
    }

    fn unit(&self, parameter: Parameter) -> Result<&Unit, Error> {
        let Description { design, inputs, .. } = &*self.description;
        let (unit, kind, index, count) = match parameter {
            Parameter::Design(variable) => {
                let info = design.get(variable.index());
                let unit = info.map(|info| &info.unit);
                (unit, "design variable", variable.index(), design.len())
            }
            Parameter::Input(input) => {
                let info = inputs.get(input.index());
                let unit = info.map(|info| &info.unit);
                (unit, "input", input.index(), inputs.len())
            }
        };
        unit.ok_or_else(|| self.unknown(kind, index, count))
    }

    /// Converts a value of a parameter to SI.
    pub(super) fn si(&self, parameter: Parameter, value: Value) -> Result<f64, Error> {
        self.unit(parameter).map(|unit| value.si(unit))
    }

    fn unknown(&self, kind: &'static str, index: usize, count: usize) -> Error {
        Error::UnknownHandle { kind, index, mechanism: self.description.name.clone(), count }
    }

    fn ready(&self) -> Result<(), Error> {
        match &self.fault {
            None => self.equal_blades(),
            Some(fault) => Err(fault.clone()),
        }
    }

    /// Refuses different values of blades whose unknowns are those of all.
    fn equal_blades(&self) -> Result<(), Error> {
        for ring in self.description.rings.iter().filter(|ring| ring.patterns) {
            for of in ring.design.chunks_exact(ring.members) {
                if let Some(other) = of.iter().find(|k| self.design[**k] != self.design[of[0]]) {
                    let variables = [of[0], *other].map(|k| self.description.design[k].name.clone());
                    return Err(Error::UnequalBlades { variables });
                }
            }
        }
        Ok(())
    }

    /// The tolerances of the design variables, followed by those of the inputs that have one.
    pub(super) fn tolerances(&self) -> Result<&Tolerances, Error> {
        self.ready()?;
        self.tolerances.get_or_init(|| self.tolerances_here()).as_ref().map_err(Error::clone)
    }

    fn tolerances_here(&self) -> Result<Tolerances, Error> {
        let inputs = self.input_variations.iter().zip(&self.inputs);
        let inputs = inputs.filter(|(x, _)| !x.is_none());
        let all = self.design_variations.iter().zip(&self.design).chain(inputs);
        let (level, correlation) = (self.sigma_level, self.correlation());
        let normal = (all.clone()).map(|(x, value)| x.normal_half_width(*value));
        if let Some(half_widths) = normal.collect::<Option<Vector>>() {
            return Tolerances::new(half_widths, level, correlation);
        }
        let values = (all.clone()).map(|(x, value)| x.distribution(*value, level));
        let values: Vec<Distribution> = values.collect::<Result<_, _>>()?;
        let nominal: Vector = all.map(|(_, value)| *value).collect();
        Tolerances::distributed(&nominal, values, level, correlation)
    }

    /// The correlation matrix as set, or else as declared.
    pub(super) fn correlation(&self) -> Option<Matrix> {
        let declared = &self.description.correlations;
        let of_declared = || {
            let count = self.design.len() + self.deviating_inputs().len();
            let mut matrix = Matrix::from_fn(count, count, |i, j| if i == j { 1.0 } else { 0.0 });
            for CorrelationInfo { variables: [i, j], correlation } in declared.iter() {
                matrix[*i][*j] = *correlation;
                matrix[*j][*i] = *correlation;
            }
            matrix
        };
        self.correlation.clone().or_else(|| (!declared.is_empty()).then(of_declared))
    }

    /// The inputs that have a tolerance.
    pub(super) fn deviating_inputs(&self) -> Vec<Input> {
        self.input_variations.iter().enumerate().filter(|(_, x)| !x.is_none()).map(|(i, _)| Input::new(i)).collect()
    }

    /// Bounds of the unknowns that are held or have declared steady values: these values.
    pub(super) fn held_bounds(&self, mechanism: &dyn Kernels) -> impl Iterator<Item = (Coordinate, f64, f64)> {
        let bounds = |held: Held| (Coordinate::new(held.unknown), held.value, held.value);
        let declared = declared(mechanism, &self.inputs, &self.design);
        self.holds.iter().cloned().chain(declared).map(bounds)
    }

    /// A search for equilibria held as the study is; if there is none, `None` or only the equilibrium from `start`.
    pub(super) fn held_in(&self, search: Option<&Search>, start: &[f64]) -> Option<Search> {
        let search = search.cloned();
        let search = search.or_else(|| (!self.holds.is_empty()).then(|| Search::new(start, start).starts(0)))?;
        Some(if search.held.is_empty() { search.held(self.holds.clone()) } else { search })
    }

    /// The equilibrium at this value of an input that is to be kept along it: a start value that is given keeps an
    /// unstable equilibrium, and picks the member of a family of steady motions.
    pub(super) fn kept(&self, plain: &dyn Kernels, (input, first): (Input, f64)) -> Option<Equilibrium> {
        let (_, named) = self.beginning(plain);
        let asked = named.contains(&true) || !self.holds.is_empty();
        if !asked && self.description.held.is_empty() {
            return None;
        }
        let mut there = self.clone();
        if let Some(input) = there.inputs.get_mut(input.index()) {
            *input = first;
        }
        let (state, _) = there.solve(plain).ok()?;
        (!state.stability.holds() || !state.free.held.is_empty()).then_some(*state)
    }

    /// The progress callback and stop flag.
    pub(super) fn watch(&self) -> Watch<'_> {
        self.watcher.watch()
    }

    pub(super) fn sampling(&self) -> Sampling<'_> {
        let watch = self.watch();
        let mut sampling = Sampling::default()
            .samples(self.samples)
            .seed(self.seed)
            .stream(self.stream)
            .threads(self.threads)
            .keep_samples(self.keep_samples)
            .vectors(self.vectors);
        sampling.progress = watch.progress;
        sampling.stop = watch.stop;
        sampling
    }

    pub(super) fn assembly(&self, mechanism: &dyn Kernels) -> Result<Assembly, Error> {
        self.ready()?;
        let (start, named) = self.beginning(mechanism);
        let held = (0..named.len()).filter(|&j| named[j]);
        let held: Vec<Coordinate> = held.map(Coordinate::new).collect();
        equilibrium::assemble(mechanism, &self.inputs, &self.design, &start, &held)
    }

    /// The start values, and which of them are given; those of unknowns with declared steady values are these.
    fn beginning(&self, mechanism: &dyn Kernels) -> (Cow<'_, [f64]>, Cow<'_, [bool]>) {
        let (mut start, mut named) = (Cow::from(&self.start[..]), Cow::from(&self.named));
        for hold in declared(mechanism, &self.inputs, &self.design) {
            if self.holds.iter().all(|held| held.unknown != hold.unknown) {
                start.to_mut()[hold.unknown] = hold.value;
                named.to_mut()[hold.unknown] = true;
            }
        }
        (start, named)
    }

    /// The start of the solvers: the start values, assembled if any coordinate is held.
    pub(super) fn assembled_start(&self, mechanism: &dyn Kernels) -> Result<Cow<'_, [f64]>, Error> {
        let (start, named) = self.beginning(mechanism);
        self.assembled(mechanism, start, &named)
    }

    fn assembled<'a>(
        &self,
        mechanism: &dyn Kernels,
        start: Cow<'a, [f64]>,
        named: &[bool],
    ) -> Result<Cow<'a, [f64]>, Error> {
        self.ready()?;
        if Structure::of(&self.description).open() || !named.contains(&true) {
            return Ok(start);
        }
        Ok(Cow::Owned(self.assembly(mechanism)?.coordinates.into()))
    }

    /// Solves the equilibrium, and returns its general modes if they were needed to judge its stability. The result is
    /// large to move.
    fn solve(&self, mechanism: &dyn Kernels) -> Result<(Box<Equilibrium>, Vec<Mode>), Error> {
        let (start, named) = self.beginning(mechanism);
        let start = self.assembled(mechanism, start, &named)?;
        let (u, b) = (&self.inputs, &self.design);
        let mut point = OperatingPoint::unchecked(mechanism, u, b);
        point.ask(&named, self.holds.clone());
        let mut state = Box::new(Equilibrium::blank(&self.description, u, b));
        let judged = equilibrium::equilibrium_into(&point, &start, self.policy, &mut state)?;
        state.kept = self.policy == Policy::Nearest;
        Ok((state, judged))
    }

    /// The equilibrium, solved once.
    pub(super) fn equilibrium(&self, mechanism: &dyn Kernels) -> Result<&Equilibrium, Error> {
        self.ready()?;
        let state = self.solution.equilibrium.get_or_init(|| {
            let (state, judged) = self.solve(mechanism)?;
            if !judged.is_empty() {
                let _ = self.solution.modes.set(self.modes_about(&state, judged));
            }
            Ok(state)
        });
        state.as_deref().map_err(Error::clone)
    }

    /// An equilibrium that is regular, so that it has derivatives.
    pub(super) fn regular(&self, mechanism: &dyn Kernels) -> Result<&Equilibrium, Error> {
        let state = self.equilibrium(mechanism)?;
        state.regular()?;
        Ok(state)
    }

    /// The equilibrium and its modes, solved once.
    pub(super) fn solved(&self, mechanism: &dyn Kernels) -> Result<(&Equilibrium, &Modes), Error> {
        let state = self.regular(mechanism)?;
        let modes = &self.solution.modes;
        Ok((state, modes.get_or_init(|| self.modes_about(state, Vec::new())).as_ref().map_err(Error::clone)?))
    }

    /// The derivatives of the modes, computed once.
    pub(super) fn sensitivities(&self, mechanism: &dyn Kernels) -> Result<&Sensitivities, Error> {
        let (state, modes) = self.solved(mechanism)?;
        let slopes = self.solution.sensitivities.get_or_init(|| sensitivity::sensitivities(mechanism, state, modes));
        slopes.as_ref().map_err(Error::clone)
    }

    fn modes_about(&self, state: &Equilibrium, judged: Vec<Mode>) -> Result<Modes, Error> {
        state.regular()?;
        let family = self.family.unwrap_or(Family::of(&self.description));
        let mut modes = Modes::empty(family, &self.description);
        modes.solve_at(state, judged)?;
        Ok(modes)
    }
}

/// Stores a value, or records the first error.
fn set<T>(slot: Option<&mut T>, value: Result<T, Error>, fault: &mut Option<Error>) {
    match (slot, value) {
        (Some(slot), Ok(value)) => *slot = value,
        (_, Err(error)) => {
            fault.get_or_insert(error);
        }
        (None, Ok(_)) => {}
    }
}
