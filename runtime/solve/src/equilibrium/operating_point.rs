//! One equilibrium problem: a mechanism with validated inputs and design variables, evaluated with checks.

use super::Needed;
use super::balance::{Data, remove_rounding};
use crate::algebra::{Matrix, Vector, all_finite, all_finite_matrix, for_size, greater};
use crate::arguments::{check_count, check_finite};
use crate::constraints::{Structure, fix_gauge, redundant_rows};
use crate::eigenproblem::EigenproblemError;
use crate::error::{NotClosed, NotFound};
use crate::free::{FreeDirections, Held, declared, fix_place};
use crate::kernels::{Kernels, Linear, RestParts};
use crate::state::dependent_names;
use crate::{DampingKind, Description, Equilibrium, Error, Mode, Modes, PoseMargin, Role, Shared};

/// A mechanism at given inputs and design variables.
#[derive(Clone)]
#[doc(hidden)]
pub struct OperatingPoint<'a> {
    #[doc(hidden)]
    pub mechanism: &'a dyn Kernels,
    #[doc(hidden)]
    pub description: Shared<Description>,
    pub(crate) structure: Structure,
    pub(crate) inputs: &'a [f64],
    pub(crate) design: &'a [f64],
    /// Constraints that are left out because the others imply them where they are met. Their rows have a zero residual
    /// and minus one on the diagonal (each constraint gives `Khat` a negative eigenvalue). Away from there dependent
    /// rows do not look dependent and only hinder each other. Empty if none is left out.
    dropped: Vec<bool>,
    /// The modes of a nearby state, which speed up the computation of those of this one; may be empty.
    #[doc(hidden)]
    pub nearby: &'a [Mode],
    #[doc(hidden)]
    pub needed: Needed,
    /// Whether each unknown has a start value that was given, not a default; may be empty.
    named: &'a [bool],
    /// What holds the place along free directions; if `None`, it is found from the stiffness itself.
    place: Option<&'a FreeDirections>,
    /// The unknowns by which the member of a family of steady motions is to be held.
    #[doc(hidden)]
    pub held: Vec<Held>,
}

impl<'a> OperatingPoint<'a> {
    /// Checks that the values have the right number, are finite, and describe bodies that can exist.
    #[doc(hidden)]
    pub fn new(mechanism: &'a dyn Kernels, inputs: &'a [f64], design: &'a [f64]) -> Result<Self, Error> {
        let point = Self::unchecked(mechanism, inputs, design);
        point.check_values()?;
        Ok(point)
    }

    /// Checks inputs and design variables like [`Self::new`].
    #[doc(hidden)]
    pub fn check_values(&self) -> Result<(), Error> {
        let (names, inputs, design) = (&self.description, self.inputs, self.design);
        check_count("inputs", inputs, names.inputs.len())?;
        check_count("design variables", design, names.design.len())?;
        check_finite("input", |k| &names.inputs[k].name, inputs)?;
        check_finite("design variable", |k| &names.design[k].name, design)?;
        self.check_possible()
    }

    /// Checks that finite values describe bodies that can exist.
    #[doc(hidden)]
    #[inline]
    pub fn check_possible(&self) -> Result<(), Error> {
        match self.mechanism.violation(self.inputs, self.design) {
            None => Ok(()),
            Some(violation) => Err(Error::Unphysical {
                quantity: violation.quantity,
                requirement: violation.requirement,
                value: violation.value,
            }),
        }
    }

    /// Skips the checks: inputs and design variables must be validated.
    #[doc(hidden)]
    #[inline]
    pub fn unchecked(mechanism: &'a dyn Kernels, inputs: &'a [f64], design: &'a [f64]) -> Self {
        let description = mechanism.description();
        Self {
            mechanism,
            structure: Structure::of(&description),
            description,
            inputs,
            design,
            dropped: Vec::new(),
            nearby: &[],
            needed: Needed::Modes,
            named: &[],
            place: None,
            held: Vec::new(),
        }
    }

    /// Gives this point the unknowns whose start values are given, and those by which a member of a family is to be held.
    /// Unknowns with declared values follow, unless they are held at another one.
    #[doc(hidden)]
    #[inline]
    pub fn ask(&mut self, named: &'a [bool], held: Vec<Held>) {
        self.named = named;
        self.held = held;
        if !self.description.held.is_empty() {
            let mut declared = declared(self.mechanism, self.inputs, self.design);
            declared.retain(|declared| self.held.iter().all(|other| other.unknown != declared.unknown));
            self.held.append(&mut declared);
        }
    }

    /// This point, held as a steady motion of another design is: declared values are those of this design.
    #[doc(hidden)]
    #[inline]
    pub fn held_like(mut self, other: &FreeDirections) -> Self {
        if other.held.is_empty() {
            self.held.clear()
        } else {
            self.held = self.at_declared_values(&other.held)
        }
        self
    }

    /// This point held by these unknowns and by those with declared values.
    #[doc(hidden)]
    #[inline]
    pub fn held_by(mut self, held: &[Held]) -> Self {
        if held.is_empty() && self.description.held.is_empty() {
            return self;
        }
        let held = self.at_declared_values(held);
        self.ask(&[], held);
        self
    }

    /// Whether it is held as a member of a family of steady motions.
    #[doc(hidden)]
    pub fn of_family(&self) -> bool {
        !self.held.is_empty()
    }

    /// Held unknowns, those with declared values at the values of this design.
    fn at_declared_values(&self, held: &[Held]) -> Vec<Held> {
        let mut held = held.to_vec();
        if held.iter().any(|x| x.declared.is_some()) {
            let declared = declared(self.mechanism, self.inputs, self.design);
            for hold in &mut held {
                if let Some(index) = hold.declared {
                    hold.clone_from(&declared[index]);
                }
            }
        }
        held
    }

    /// The coordinates and speeds whose start values are given.
    pub(super) fn named(&self) -> impl Iterator<Item = usize> {
        (0..self.motions()).filter(|&unknown| self.named.get(unknown) == Some(&true))
    }

    /// This point with the modes of a nearby state.
    #[doc(hidden)]
    #[inline]
    pub fn near(mut self, modes: &'a Modes) -> Self {
        self.nearby = modes.general();
        self
    }

    /// This point, for no more than what is `needed` of its states.
    #[doc(hidden)]
    #[inline]
    pub fn only(mut self, needed: Needed) -> Self {
        self.needed = needed;
        self
    }

    /// This point, for states whose stability decides between them.
    pub(super) fn judged(&self) -> Self {
        self.clone().only(self.needed.max(Needed::Verdict))
    }

    /// What the equations are evaluated with.
    pub(crate) fn data(&self) -> Data<'_> {
        Data {
            mechanism: self.mechanism,
            description: &self.description,
            motions: self.motions(),
            inputs: self.inputs,
            design: self.design,
        }
    }

    /// Number of unknowns.
    pub(crate) fn size(&self) -> usize {
        self.description.coordinates.len()
    }

    /// Number of free directions; none if it is known that there are none.
    pub(crate) fn free(&self) -> usize {
        if self.place.is_some_and(FreeDirections::is_empty) { 0 } else { self.description.free_directions }
    }

    /// This point without its free directions if there are none at `q`: by the stiffness there, something resists.
    pub(super) fn resisted(&self, q: &[f64]) -> Option<Self> {
        const NONE: &FreeDirections = &FreeDirections::none();
        let claimed = self.place.is_none() && self.free() > 0;
        let stiffness = claimed.then(|| self.linear(q).ok())??.stiffness;
        FreeDirections::of(&stiffness, self.free()).is_empty().then(|| Self { place: Some(NONE), ..self.clone() })
    }

    /// Number of coordinates and speeds, which come first, before the reactions.
    pub(crate) fn motions(&self) -> usize {
        self.structure.motions()
    }

    /// This point without the constraints that are redundant at `x`, a state that meets them.
    pub(crate) fn without_redundant(&self, x: &[f64]) -> Self {
        let plain = if self.structure.constraints() > 1 { self.evaluate_plain(x) } else { None };
        plain.map_or_else(|| self.clone(), |(_, stiffness)| self.without(&redundant_rows(&stiffness, self.structure)))
    }

    /// This point with the place held as at another state.
    #[doc(hidden)]
    pub fn placed(self, free_directions: &'a FreeDirections) -> Self {
        let directions = (!free_directions.is_empty()).then_some(free_directions);
        Self { place: directions, ..self }
    }

    /// This point without the constraints marked in `dropped`.
    #[doc(hidden)]
    pub fn without(&self, dropped: &[bool]) -> Self {
        Self { dropped: dropped.to_vec(), ..self.clone() }
    }

    /// An empty state, to be overwritten.
    #[inline]
    pub(crate) fn blank_state(&self) -> Equilibrium {
        Equilibrium::blank(&self.description, self.inputs, self.design)
    }

    #[doc(hidden)]
    pub fn check_start(&self, start: &[f64]) -> Result<(), Error> {
        let unknowns = &self.description.coordinates;
        check_count("start values", start, unknowns.len())?;
        check_finite("start value of coordinate", |k| &unknowns[k].name, start)
    }

    /// Residual and stiffness with the gauge fixed and the place held along free directions; `None` if either is not
    /// finite.
    #[doc(hidden)]
    pub fn evaluate(&self, q: &[f64]) -> Option<(Vector, Matrix)> {
        let n = self.size();
        let (mut residual, mut stiffness) = (Vector::zeros(n), Matrix::zeros(n, n));
        self.evaluate_into(q, &mut residual, &mut stiffness).then_some((residual, stiffness))
    }

    /// Like [`Self::evaluate`], overwriting a residual and a stiffness of this size; false if either is not finite.
    pub(crate) fn evaluate_into(&self, q: &[f64], residual: &mut Vector, stiffness: &mut Matrix) -> bool {
        let entries = stiffness.as_flattened_mut();
        self.mechanism.residual_and_stiffness_into(q, self.inputs, self.design, residual, entries);
        let finite = for_size(
            q.len(),
            #[inline(always)]
            |n| all_finite(&residual[..n]) && all_finite(&stiffness.as_flattened()[..n * n]),
        );
        if finite && !self.structure.open() {
            if self.dropped.contains(&true) {
                self.drop_rows(residual, Some(stiffness));
            } else {
                fix_gauge(stiffness, self.structure);
            }
        }
        if finite && self.free() > 0 {
            remove_rounding(&self.data(), q, stiffness);
        }
        match self.place {
            Some(directions) if finite => {
                directions.hold(stiffness);
                directions.lead(residual, q, &self.held);
            }
            None if finite && self.free() > 0 => fix_place(stiffness, self.free()),
            _ => {}
        }
        finite
    }

    /// The residual alone, which may not be finite.
    #[doc(hidden)]
    pub fn residual(&self, q: &[f64]) -> Vector {
        let mut residual = self.mechanism.residual(q, self.inputs, self.design);
        if !self.structure.open() {
            self.drop_rows(&mut residual, None);
        }
        residual
    }

    /// The largest component of a step, relative to [large changes](Description::large).
    pub(super) fn size_of(&self, step: &[f64]) -> f64 {
        step.iter().enumerate().map(|(i, step)| (step / self.description.large(i)).abs()).fold(0.0, greater)
    }

    /// Inertia and applied forces at rest, which may not be finite.
    pub(crate) fn parts(&self, q: &[f64]) -> RestParts {
        self.mechanism.residual_parts(q, self.inputs, self.design)
    }

    /// Like [`Self::parts`], overwriting parts of this size.
    pub(crate) fn parts_into(&self, q: &[f64], parts: &mut RestParts) {
        self.mechanism.residual_parts_into(q, self.inputs, self.design, parts);
    }

    fn drop_rows(&self, residual: &mut [f64], mut stiffness: Option<&mut Matrix>) {
        for k in (self.motions()..self.size()).filter(|&k| self.dropped.get(k) == Some(&true)) {
            residual[k] = 0.0;
            if let Some(stiffness) = &mut stiffness {
                for j in 0..self.size() {
                    stiffness[k][j] = 0.0;
                    stiffness[j][k] = 0.0;
                }
                stiffness[k][k] = -1.0;
            }
        }
    }

    /// Like [`Self::evaluate`], but with every constraint, and without fixing the gauge.
    pub(crate) fn evaluate_plain(&self, q: &[f64]) -> Option<(Vector, Matrix)> {
        let evaluated = self.mechanism.residual_and_stiffness(q, self.inputs, self.design);
        (all_finite(&evaluated.0) && all_finite_matrix(&evaluated.1)).then_some(evaluated)
    }

    pub(crate) fn evaluate_start(&self, q: &[f64]) -> Result<(Vector, Matrix), Failure> {
        self.evaluate(q).ok_or_else(|| Failure::OutsideDomain { what: "the residual", coordinates: q.into() })
    }

    /// The linearised mechanism with the gauge fixed.
    #[doc(hidden)]
    pub fn linear(&self, q: &[f64]) -> Result<Linear, Failure> {
        let mut linear = Linear::zeros(self.size());
        self.linear_into(q, &mut linear)?;
        Ok(linear)
    }

    /// Like [`Self::linear`], overwriting matrices of this size.
    pub(crate) fn linear_into(&self, q: &[f64], linear: &mut Linear) -> Result<(), Failure> {
        self.mechanism.linear_into(q, self.inputs, self.design, linear);
        self.check(q, linear)?;
        if self.free() > 0 {
            remove_rounding(&self.data(), q, &mut linear.stiffness);
        }
        if !self.structure.open() {
            fix_gauge(&mut linear.stiffness, self.structure);
        }
        Ok(())
    }

    /// [`Self::parts`] and the linearised mechanism, either of which may not be finite, without fixing the gauge. For a
    /// small mechanism the sines and other common terms are computed once.
    #[inline]
    pub(crate) fn parts_and_linear(&self, q: &[f64]) -> (RestParts, Linear) {
        let (parts, mut linear) = self.mechanism.parts_and_linear(q, self.inputs, self.design);
        if self.free() > 0 {
            remove_rounding(&self.data(), q, &mut linear.stiffness);
        }
        (parts, linear)
    }

    /// Why the mass matrix is not positive definite at a state, by this row: beams that are bent too far, if there are any.
    #[cold]
    pub(super) fn singular_mass(&self, q: &[f64], row: usize) -> Failure {
        let pose = self.mechanism.pose_margin(q, self.inputs, self.design);
        match pose.filter(|pose| pose.margin < pose.least) {
            Some(pose) => Failure::BentTooFar(pose),
            None => Failure::SingularMass(row),
        }
    }

    /// Refuses matrices that are not finite.
    #[inline]
    pub(crate) fn check(&self, q: &[f64], linear: &Linear) -> Result<(), Failure> {
        let infinite = self.infinite(q.len(), linear);
        infinite.map_or(Ok(()), |what| Err(Failure::OutsideDomain { what, coordinates: q.into() }))
    }

    /// The matrix of size `n` that is not finite, if there is one; see [`for_size`].
    #[inline(always)]
    pub(super) fn infinite(&self, n: usize, linear: &Linear) -> Option<&'static str> {
        let Linear { mass, damping, stiffness } = linear;
        let undamped = matches!(self.description.damping, DampingKind::Zero);
        if !all_finite(&mass.as_flattened()[..n * n]) {
            Some("the mass matrix")
        } else if !undamped && !all_finite(&damping.as_flattened()[..n * n]) {
            Some("the damping matrix")
        } else if !all_finite(&stiffness.as_flattened()[..n * n]) {
            Some("the stiffness matrix")
        } else {
            None
        }
    }
}

/// Why a solve failed.
#[derive(Clone, Debug, PartialEq)]
#[doc(hidden)]
pub enum Failure {
    OutsideDomain {
        what: &'static str,
        coordinates: Vec<f64>,
    },
    NotFound {
        reason: NotFound,
        coordinates: Vec<f64>,
        iterations: usize,
        relative: f64,
    },
    /// The constraints stay open by `gaps`, at the positions of their rows; zero where a constraint is met.
    NotAssembled {
        reason: NotClosed,
        coordinates: Vec<f64>,
        gaps: Vec<f64>,
        /// The row with the largest gap relative to what motions can close.
        worst: usize,
        iterations: usize,
    },
    /// The state is next to a singular configuration in which the forces do not balance.
    Unbalanced {
        coordinates: Vec<f64>,
        /// The direction, down the applied forces, in which the constraints give no support there; its largest
        /// component is one.
        downhill: Vec<f64>,
        /// The constraints that become dependent there.
        dependent: Vector<bool>,
    },
    /// A family of steady motions of this dimension cannot be held by these unknowns.
    Held {
        unknowns: Vec<usize>,
        dimension: usize,
    },
    SingularMass(usize),
    BentTooFar(PoseMargin<f64>),
    Mode {
        mode: usize,
        residual: f64,
    },
}

impl From<EigenproblemError> for Failure {
    fn from(trouble: EigenproblemError) -> Self {
        match trouble {
            EigenproblemError::SingularMass(row) => Self::SingularMass(row),
            EigenproblemError::Inaccurate { mode, residual } => Self::Mode { mode, residual },
        }
    }
}

impl Failure {
    #[cold]
    #[doc(hidden)]
    pub fn explain(self, description: &Description) -> Error {
        match self {
            Self::OutsideDomain { what, coordinates } => {
                Error::OutsideDomain { mechanism: description.name.clone(), what, coordinates }
            }
            Self::NotFound { reason, coordinates, iterations, relative } => {
                Error::NoEquilibrium { reason, iterations, coordinates, relative_residual: relative }
            }
            Self::NotAssembled { reason, coordinates, gaps, worst, iterations } => Error::NotAssembled {
                reason,
                constraint: description.unknown_name(worst),
                gap: gaps[worst],
                unit: gap_unit(description, worst),
                others: (0..gaps.len())
                    .filter(|&row| row != worst && gaps[row] != 0.0)
                    .map(|row| (description.unknown_name(row), gaps[row]))
                    .collect(),
                coordinates,
                iterations,
            },
            Self::Unbalanced { coordinates, dependent, .. } => Error::UnboundedReactions {
                constraints: dependent_names(description, &dependent).collect(),
                coordinates,
            },
            Self::Held { unknowns, dimension } => Error::NotHeld {
                unknowns: (unknowns.into_iter()).map(|unknown| description.unknown_name(unknown)).collect(),
                dimension,
            },
            Self::SingularMass(row) => Error::SingularMass { coordinate: description.unknown_name(row) },
            Self::BentTooFar(pose) => {
                Error::BentTooFar { degrees: 2.0 * pose.margin.max(0.0).sqrt().acos().to_degrees(), beam: pose.joint }
            }
            Self::Mode { mode, residual } => Error::ModesNotFound { mode, residual },
        }
    }
}

/// Unit of the gap of a constraint, on which its reaction does work.
pub(crate) fn gap_unit(description: &Description, row: usize) -> &'static str {
    let Some(info) = description.coordinates.get(row) else {
        return "";
    };
    match (&*info.unit.symbol, info.role) {
        ("N", Role::VelocityReaction) => "m/s",
        ("N*m", Role::VelocityReaction) => "rad/s",
        ("N", _) => "m",
        ("N*m", _) => "rad",
        _ => "",
    }
}
