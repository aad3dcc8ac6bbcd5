//! The equations `g(q, u_k) = 0` of a branch, and Newton's method on a plane across it.

use core::cell::RefCell;

use super::bordered::Bordered;
use super::local_scaling::{CurvePosition, Frame, System};
use super::settings::Continuation;
use crate::algebra::{Matrix, Vector, add_to, all_finite};
use crate::constraints::{Structure, redundant_rows};
use crate::equilibrium::{
    ACCEPTED, Failure, OperatingPoint, Policy, SolvedState, Verdict, constraint_state, judge, relative_residual, solve,
};
use crate::error::NotFound;
use crate::free::{FreeDirections, Held};
use crate::kernels::{DirectionalKernels, Linear};
use crate::modes::{Followed, judge_shafts};
use crate::rounding;
use crate::{Description, Equilibrium, Error, Mode, Shared, Watch};

/// A mechanism with one varying input.
pub(crate) struct Curve<'a> {
    pub(crate) mechanism: &'a dyn DirectionalKernels,
    pub(crate) description: Shared<Description>,
    pub(crate) structure: Structure,
    pub(crate) inputs: &'a [f64],
    pub(crate) design: &'a [f64],
    pub(crate) settings: &'a Continuation,
    /// What holds the place along free directions. At a critical state the stiffness alone does not tell them from the
    /// critical one.
    pub(crate) place: FreeDirections,
    /// A large change of every unknown, SI.
    pub(crate) large: Vector,
    pub(crate) watch: Watch<'a>,
    /// Redundant constraints, omitted from Newton's method for regularity; every point must still meet all of them.
    dropped: Vec<bool>,
    /// With shafts, what the way has shown.
    pub(super) followed: RefCell<Followed>,
}

/// The reason why a point was not reached.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ContinuationFailure {
    /// The equations are not finite at this point.
    OutsideDomain(Vector),
    /// The input describes a body that cannot exist.
    Unphysical(Error),
    /// The point is not accepted as an equilibrium.
    Refused(Failure),
    /// The search missed the point.
    Missed(NotFound),
}

impl ContinuationFailure {
    /// Whether the equations end there.
    pub(crate) fn at_edge(&self) -> bool {
        matches!(
            self,
            Self::OutsideDomain(_)
                | Self::Unphysical(_)
                | Self::Refused(Failure::OutsideDomain { .. } | Failure::BentTooFar(_))
        )
    }
}

/// A point of the branch on a given plane.
pub(crate) struct Corrected {
    pub(crate) local: CurvePosition,
    pub(crate) place: CurvePosition,
    pub(crate) system: System,
    pub(crate) iterations: usize,
}

/// Displacement, in units of coordinates and input, that residuals are compared to.
const SMALL: f64 = 1e-3;
/// After a Newton step this small, in local units, only rounding remains.
const LAST_STEP: f64 = 1e-13;
/// Below this size, a step that no longer shrinks has reached rounding.
const ROUNDING: f64 = 1e-8;
/// Newton's method does not converge if a step is larger than this fraction of the previous one.
const CONTRACTION: f64 = 0.5;
/// Shares of the range at which a regular state beside a singular one is sought.
const NUDGES: [f64; 3] = [1e-6, 1e-4, 1e-2];

impl<'a> Curve<'a> {
    pub(crate) fn new(
        mechanism: &'a dyn DirectionalKernels,
        inputs: &'a [f64],
        design: &'a [f64],
        settings: &'a Continuation,
    ) -> Result<Self, Error> {
        let description = mechanism.description();
        settings.check(&description)?;
        Ok(Self {
            mechanism,
            structure: Structure::of(&description),
            large: Vector::from_fn(description.coordinates.len(), |i| settings.size * description.large(i)),
            dropped: Vec::new(),
            followed: RefCell::default(),
            place: FreeDirections::default(),
            description,
            inputs,
            design,
            settings,
            watch: Watch::default(),
        })
    }

    /// The curve, with its work reported to `watch`, which can stop it.
    pub(crate) fn watched(self, watch: Watch<'a>) -> Self {
        Self { watch, ..self }
    }

    /// Number of unknowns.
    pub(crate) fn size(&self) -> usize {
        self.description.coordinates.len()
    }

    /// The operating point at these inputs, with all constraints.
    pub(crate) fn operating_point<'b>(&'b self, inputs: &'b [f64]) -> OperatingPoint<'b> {
        OperatingPoint::unchecked(self.mechanism, inputs, self.design).held_like(&self.place).placed(&self.place)
    }

    /// The curve prepared for branches near a state. In a singular configuration more constraints look redundant than
    /// around it: the redundancies of the nearest regular state are used, or none.
    pub(crate) fn about(mut self, state: &Equilibrium) -> Self {
        if !state.free.held.is_empty() {
            self.place = state.free.clone();
        } else if self.description.free_directions > 0 {
            // The state itself may be critical.
            let mut beside = NUDGES.iter();
            let beside = beside.find_map(|&share| self.beside(state, share).ok());
            self.place = beside.map_or_else(|| state.free.clone(), |beside| beside.state.free);
        }
        if self.structure.constraints() > 1 {
            let redundant = |state: &Equilibrium| redundant_rows(&state.linear.stiffness, self.structure);
            self.dropped = if state.constraints.singular {
                let beside = NUDGES.iter().filter_map(|&share| self.beside(state, share).ok());
                let mut regular = beside.filter(|beside| !beside.state.constraints.singular);
                regular.next().map_or_else(Vec::new, |beside| redundant(&beside.state))
            } else {
                redundant(state)
            };
        }
        self
    }

    /// The equilibrium beside a state at one end of the range, at a share of the way to the other end.
    pub(crate) fn beside(&self, state: &Equilibrium, share: f64) -> Result<SolvedState, Failure> {
        let (low, high) = (self.settings.low, self.settings.high);
        let value = state.inputs[self.settings.input.index()];
        let target = if value == low { high } else { low };
        let inputs = self.inputs_at(value + share * (target - value));
        let point = self.operating_point(&inputs);
        solve(&point, &state.coordinates, Policy::Nearest)
    }

    pub(crate) fn inputs_at(&self, p: f64) -> Vector {
        let mut inputs = Vector::from(self.inputs);
        if let Some(value) = inputs.get_mut(self.settings.input.index()) {
            *value = p;
        }
        inputs
    }

    /// The mechanism linearised at a point.
    pub(crate) fn linear(&self, at: &CurvePosition) -> Result<Linear, ContinuationFailure> {
        self.operating_point(&self.inputs_at(at.p)).linear(&at.q).map_err(ContinuationFailure::Refused)
    }

    pub(crate) fn system(&self, at: &CurvePosition) -> Result<System, ContinuationFailure> {
        let inputs = self.inputs_at(at.p);
        let point = self.operating_point(&inputs).without(&self.dropped);
        let (residual, stiffness) =
            point.evaluate(&at.q).ok_or_else(|| ContinuationFailure::OutsideDomain(at.q.clone()))?;
        let (by_inputs, _) = point.mechanism.residual_partials(&at.q, &inputs, self.design);
        let mut by_input = by_inputs.column(self.settings.input.index());
        for (held, column) in point.held.iter().zip(&self.place.columns) {
            if let Some(by_input_of_value) = held.by_input.get(self.settings.input.index()) {
                add_to(&mut by_input, -by_input_of_value, column);
            }
        }
        for (value, dropped) in by_input.iter_mut().zip(&self.dropped) {
            if *dropped {
                *value = 0.0;
            }
        }
        if all_finite(&by_input) {
            Ok(System { residual, stiffness, by_input })
        } else {
            Err(ContinuationFailure::OutsideDomain(at.q.clone()))
        }
    }

    /// Gradient with respect to `(q, u_k)` of the derivative of `w^T g` along `direction`.
    pub(crate) fn curvature(
        &self,
        at: &CurvePosition,
        w: &[f64],
        direction: &CurvePosition,
    ) -> Result<CurvePosition, ContinuationFailure> {
        let input = self.settings.input.index();
        let mut along = Vector::zeros(self.inputs.len());
        along[input] = direction.p;
        let gradient = self.mechanism.residual_gradient_along(
            &at.q,
            &self.inputs_at(at.p),
            self.design,
            w,
            [&direction.q, &along, &Vector::zeros(self.design.len()), &Vector::zeros(self.size())],
        );
        let curve_position = CurvePosition { q: gradient.coordinates, p: gradient.inputs[input] };
        if curve_position.finite() { Ok(curve_position) } else { Err(ContinuationFailure::OutsideDomain(at.q.clone())) }
    }

    /// The equilibrium at a point of the branch. If the usual relative residual is not small, the residual is compared
    /// to the forces due to a thousandth of the input range and of the coordinates' units: where `Khat` is singular,
    /// the input restores what the coordinates cannot. Where neither does, `also` is an alternative measure of the
    /// residual.
    pub(crate) fn equilibrium(
        &self,
        at: &CurvePosition,
        system: &System,
        iterations: usize,
        also: Option<f64>,
    ) -> Result<SolvedState, ContinuationFailure> {
        let inputs = self.inputs_at(at.p);
        if let Some(violation) = self.mechanism.violation(&inputs, self.design) {
            return Err(ContinuationFailure::Unphysical(Error::Unphysical {
                quantity: violation.quantity,
                requirement: violation.requirement,
                value: violation.value,
            }));
        }
        let mut pose = self.mechanism.pose_margin(&at.q, &inputs, self.design);
        if let Some(pose) = pose.take_if(|pose| pose.margin < pose.least) {
            return Err(ContinuationFailure::Refused(Failure::BentTooFar(pose)));
        }
        let point = self.operating_point(&inputs);
        let linear = point.linear(&at.q).map_err(ContinuationFailure::Refused)?;
        let residual = if self.dropped.contains(&true) { point.residual(&at.q) } else { system.residual.clone() };
        let mut relative = relative_residual(&point, &at.q, &residual, &linear.stiffness);
        if relative.is_nan() || relative > ACCEPTED {
            relative = self.with_input(&at.q, system).min(also.unwrap_or(f64::INFINITY));
        }
        if relative > ACCEPTED {
            return Err(ContinuationFailure::Refused(Failure::NotFound {
                reason: NotFound::Inaccurate,
                coordinates: at.q.to_vec(),
                iterations,
                relative,
            }));
        }
        let constraints = constraint_state(&point, &at.q, &residual, &linear).map_err(ContinuationFailure::Refused)?;
        let verdict = if constraints.singular || !self.description.spans.is_empty() {
            Verdict::undecided()
        } else {
            let checked_state = rounding::CheckedState {
                coordinates: &at.q,
                inputs: &inputs,
                design: self.design,
                residual: &residual,
            };
            judge(self.mechanism, &checked_state, &linear, Some(&[])).map_err(ContinuationFailure::Refused)?
        };
        let mut state = Equilibrium::blank(&self.description, &inputs, self.design);
        state.pose = pose;
        state.coordinates = at.q.clone();
        state.stability = verdict.stability;
        state.rounding = verdict.rounding;
        state.constraints = constraints;
        state.free = self.free_at(at, &linear.stiffness);
        state.linear = linear;
        state.residual = residual;
        state.relative_residual = relative;
        state.iterations = iterations;
        let modes = self.judged(&mut state).unwrap_or(verdict.modes);
        Ok(SolvedState { state, modes })
    }

    /// Judges a state of shafts by the modes that it has; `None` without shafts.
    pub(crate) fn judged(&self, state: &mut Equilibrium) -> Option<Vec<Mode>> {
        let near = self.followed.borrow().modes().to_vec();
        let (stability, modes) = judge_shafts(self.mechanism, state, &near, true)?;
        self.followed.borrow_mut().take(state.inputs[self.settings.input.index()], &modes);
        state.stability = stability;
        Some(modes)
    }

    /// The free directions at a point of the branch, and what holds it.
    fn free_at(&self, at: &CurvePosition, stiffness: &Matrix) -> FreeDirections {
        let count = self.description.free_directions;
        if self.place.held.is_empty() {
            FreeDirections::of(stiffness, count)
        } else {
            FreeDirections::of_member(stiffness, count, self.held_at(at))
        }
    }

    /// The gauge at a critical point: that of the other points of the branch.
    pub(crate) fn place_at(&self, at: &CurvePosition) -> FreeDirections {
        let mut free = self.place.clone();
        free.held = self.held_at(at);
        free
    }

    fn held_at(&self, at: &CurvePosition) -> Vec<Held> {
        let inputs = self.inputs_at(at.p);
        let mut held = self.operating_point(&inputs).held;
        for coordinate in &mut held {
            coordinate.value = at.q[coordinate.unknown];
        }
        held
    }

    /// Largest residual, each relative to the forces due to a thousandth of the input range and of the coordinates'
    /// units.
    fn with_input(&self, q: &[f64], system: &System) -> f64 {
        (0..q.len()).fold(0.0, |most: f64, i| {
            let input = system.by_input[i].abs() * self.settings.range();
            let scale =
                (0..q.len()).fold(input, |sum, j| sum + system.stiffness[i][j].abs() * (self.large[j] + q[j].abs()));
            let residual = system.residual[i].abs();
            most.max(if residual > 0.0 { residual / (SMALL * scale) } else { 0.0 })
        })
    }

    pub(crate) fn frame(&self, at: &CurvePosition, system: &System) -> Frame {
        Frame::new(at.clone(), &self.large, self.settings.range(), system, self.structure.motions())
    }

    /// Solves `g = 0` on the plane through `from` with normal `normal` (both local), no farther than `reach` from it.
    pub(crate) fn correct(
        &self,
        frame: &Frame,
        from: &CurvePosition,
        normal: &CurvePosition,
        reach: f64,
    ) -> Result<Corrected, ContinuationFailure> {
        let mut local = from.clone();
        let mut last = f64::INFINITY;
        let mut stalled = false;
        let most = self.settings.max_corrections;
        for iterations in 0..=most {
            let position = frame.place(&local);
            let system = self.system(&position)?;
            if last <= LAST_STEP || stalled {
                return Ok(Corrected { local, place: position, system, iterations });
            }
            if iterations == most {
                break;
            }
            let scaled = frame.scaled(&system);
            let off = normal.dot(&local.plus(-1.0, from));
            let step = plane(&scaled, normal)
                .map(|lu| lu.solve(&scaled.residual.map(|value| -value), [-off]))
                .map(|(q, [p])| CurvePosition { q, p })
                .filter(CurvePosition::finite)
                .ok_or(ContinuationFailure::Missed(NotFound::NotIsolated))?;
            let size = step.norm();
            if size > CONTRACTION * last {
                if last > ROUNDING {
                    return Err(ContinuationFailure::Missed(NotFound::Diverges));
                }
                stalled = true;
                continue;
            }
            local = local.plus(1.0, &step);
            last = size;
            if local.plus(-1.0, from).norm() > reach {
                return Err(ContinuationFailure::Missed(NotFound::BendsAway));
            }
        }
        if last <= ROUNDING {
            let position = frame.place(&local);
            let system = self.system(&position)?;
            return Ok(Corrected { local, place: position, system, iterations: most });
        }
        Err(ContinuationFailure::Missed(NotFound::Diverges))
    }
}

/// `[Khat dg/du; normal^T]`.
pub(crate) fn plane(scaled: &System, normal: &CurvePosition) -> Option<Bordered> {
    Bordered::new(&scaled.stiffness, [&scaled.by_input], [&normal.q], [[normal.p]])
}
