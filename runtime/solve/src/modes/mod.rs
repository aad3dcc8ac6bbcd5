//! Natural modes of small vibrations about an equilibrium.
//!
//! Undamped modes solve `Khat phi = lambda Mhat phi`; they describe the motion completely where `Chat` is zero and
//! `Khat` symmetric. Every other case needs general modes, `(s^2 Mhat + s Chat + Khat) phi = 0` with left vectors
//! `psi^T (s^2 Mhat + s Chat + Khat) = 0`. One type describes both: an undamped mode has `s^2 = -lambda`.
//!
//! With constraints and speeds the same equations hold over all unknowns, reactions included; the number of modes is
//! the number of motions that the constraints leave free.

mod answer;
mod assurance;
mod blades;
mod constrained;
mod cyclic;
mod deflation;
#[cfg(test)]
mod deflation_tests;
mod kinetic;
mod mode;
mod normalisation;
mod pencil;
mod principal;
mod shafts;
mod undamped;
mod whirl;

#[doc(hidden)]
pub use assurance::{
    CERTAIN, EIGENVALUE_SHARE, equal_groups, in_order, match_with_assurance, merged, near, near_another, position,
    stay_in_place,
};
pub use assurance::{assurance, clusters, match_modes};
pub use blades::{BladePattern, Travel, ring_speeds};
#[doc(hidden)]
pub use constrained::free_pairs;
pub(crate) use deflation::deflated;
#[doc(hidden)]
pub use kinetic::inertia;
pub use mode::{Behaviour, Mode};
#[doc(hidden)]
pub use normalisation::{Normalisation, lead};
#[doc(hidden)]
pub use pencil::{pencil_slope_times, pencil_times, transposed};
#[doc(hidden)]
pub use shafts::{Followed, completed, holds, joined, judge_shafts};
#[doc(hidden)]
pub use undamped::undamped;
pub use whirl::{Character, Kind, Sense, Whirl, Whirls, whirls};

use crate::algebra::{Matrix, Vector, asymmetry, dot_complex, for_size, greater};
use crate::constraints::{Structure, Tangent};
use crate::eigenproblem::{Eigenproblem, EigenproblemError, Pairs, Root, roots_near};
use crate::kernels::{DeviatingInputs, Kernels, Linear};
use crate::rounding::{Sign, sign};
use crate::shafts::Shafts;
use crate::{Complex, DampingKind, Description, Equilibrium, Error, Shared};

/// Eigenvalues closer than this, relative to the larger, form a cluster whatever the tolerances: rounding mixes their
/// shapes.
pub const CLUSTER_GAP: f64 = 1e-6;

/// The equation that a set of modes solves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Family {
    /// `Khat phi = lambda Mhat phi`, `Khat` symmetric.
    Undamped,
    /// `(s^2 Mhat + s Chat + Khat) phi = 0`.
    General,
}

impl Family {
    /// The family that neglects nothing: undamped if the compiler proved `Chat` zero and `Khat` symmetric.
    #[must_use]
    pub fn of(description: &Description) -> Self {
        if description.damping == DampingKind::Zero && description.symmetric_stiffness {
            Self::Undamped
        } else {
            Self::General
        }
    }
}

/// All modes at one equilibrium.
///
/// Undamped modes are sorted by `lambda`, general ones by frequency `Im s`, those that do not oscillate first and by
/// `|s|`; all ascending, unless they follow the order of another set.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Modes {
    /// The modes.
    pub modes: Vec<Mode>,
    /// The equation they solve.
    pub family: Family,
    /// `Chat` is non-zero here and was neglected: these are the modes of `Mhat` and `Khat` alone.
    pub damping_ignored: bool,
    /// What each does to bodies that spin, in the order of the modes; empty unless asked for
    /// ([`Self::with_whirls`]).
    pub whirls: Vec<Option<Whirl>>,
    /// The inputs they belong to, SI; empty for the modes of given matrices.
    pub inputs: Vector,
    /// The mechanism they belong to.
    pub description: Shared<Description>,
}

impl Modes {
    /// Frequencies of all modes, in order, rad/s.
    pub fn frequencies(&self) -> Vec<Option<f64>> {
        self.modes.iter().map(Mode::frequency).collect()
    }

    /// The positions of so many modes at most: where there are more, of those that grow, then of those that oscillate, then of
    /// the others.
    #[must_use]
    pub fn foremost(&self, count: usize) -> Vec<usize> {
        let rank = |mode: &Mode| if mode.behaviour.grows() { 0 } else { 1 + usize::from(mode.frequency().is_none()) };
        let mut all: Vec<usize> = (0..self.modes.len()).collect();
        if all.len() > count {
            all.sort_by_key(|&mode| rank(&self.modes[mode]));
            all.truncate(count);
        }
        all
    }

    /// The modal matrix: column `r` is the shape of mode `r`, row `i` belongs to unknown `i`.
    #[must_use]
    pub fn shapes(&self) -> Matrix<Complex> {
        self.columns(|mode| &mode.shape)
    }

    /// The matrix of left vectors: column `r` is [`Mode::left`] of mode `r`.
    #[must_use]
    pub fn left_shapes(&self) -> Matrix<Complex> {
        self.columns(Mode::left)
    }

    fn columns(&self, of: fn(&Mode) -> &[Complex]) -> Matrix<Complex> {
        let rows = self.modes.first().map_or(0, |mode| of(mode).len());
        Matrix::from_fn(rows, self.modes.len(), |i, r| of(&self.modes[r])[i])
    }

    /// The modes with their kinds ([`whirls`]), if anything that spins moves in one.
    #[must_use]
    pub fn with_whirls(&self, whirls: Whirls) -> Self {
        let mut modes = self.clone();
        if whirls.iter().any(Option::is_some) {
            modes.whirls = whirls.0;
        }
        modes
    }

    /// Reassigns these modes to the mechanism with deviating inputs, all deviations zero.
    #[must_use]
    pub fn with_deviations<K: Kernels + ?Sized>(&self, of: &DeviatingInputs<'_, K>) -> Self {
        Self { description: of.description(), ..self.clone() }
    }

    /// The modes if they are general, otherwise an empty slice.
    pub(crate) fn general(&self) -> &[Mode] {
        match self.family {
            Family::General => &self.modes,
            Family::Undamped => &[],
        }
    }

    /// Real parts of the shapes, one shape per row.
    #[doc(hidden)]
    pub fn real_shapes(&self) -> Matrix {
        let columns = self.modes.first().map_or(0, |mode| mode.shape.len());
        Matrix::from_fn(self.modes.len(), columns, |r, i| self.modes[r].shape[i].re)
    }

    /// Positions, ascending, of the modes whose eigenvalues rounding cannot distinguish from that of mode `mode`,
    /// itself included.
    ///
    /// They form a chain in which each eigenvalue is within 1e-6 of the next, relative to the larger. Tolerances can
    /// merge more modes (`clusters::clusters`). Empty if there is no such mode.
    #[must_use]
    pub fn cluster_of(&self, mode: usize) -> Vec<usize> {
        let mut members: Vec<usize> = (mode < self.modes.len()).then_some(mode).into_iter().collect();
        let mut next = 0;
        while let Some(&of) = members.get(next) {
            let near = (0..self.modes.len()).filter(|&r| near(self, of, r, CLUSTER_GAP));
            let new: Vec<usize> = near.filter(|r| !members.contains(r)).collect();
            members.extend(new);
            next += 1;
        }
        members.sort_unstable();
        members
    }

    /// Whether no small disturbance grows exponentially. Neutral modes count as stable: nothing resists a motion along
    /// them, which a disturbance may continue for ever.
    #[must_use]
    pub fn stable(&self) -> bool {
        !self.modes.iter().any(|mode| mode.behaviour.grows())
    }
}

/// The modes about an equilibrium, in the family that neglects nothing ([`Family::of`]).
///
/// # Errors
/// [`Error::SingularMass`] if a coordinate moves no mass, [`Error::ModesNotFound`] if a pair fails its residual check,
/// [`Error::SingularConfiguration`] where constraints become dependent.
pub fn modes(equilibrium: &Equilibrium) -> Result<Modes, Error> {
    equilibrium.regular()?;
    let family = Family::of(&equilibrium.description);
    modes_at(equilibrium, family, Vec::new())
}

/// Undamped modes about an equilibrium: `Chat` is neglected, and the result says so where it is non-zero.
///
/// # Errors
/// Those of [`modes`], [`Error::NonsymmetricStiffness`] if `Khat` is not symmetric, and [`Error::NoUndampedModes`] with
/// speeds or constraints on velocities.
pub fn undamped_modes(equilibrium: &Equilibrium) -> Result<Modes, Error> {
    equilibrium.regular()?;
    modes_at(equilibrium, Family::Undamped, Vec::new())
}

/// The modes of the given family about an equilibrium; for `judged` see [`Modes::solve_at`].
pub(crate) fn modes_at(at: &Equilibrium, family: Family, judged: Vec<Mode>) -> Result<Modes, Error> {
    let mut modes = Modes::empty(family, &at.description);
    modes.solve_at(at, judged)?;
    Ok(modes)
}

/// Modes of given matrices that belong to the mechanism described by `description`.
///
/// The elements are assumed to be accurate to rounding: only an [`Equilibrium`] knows where an element is a small
/// difference of large terms, as at a critical speed.
///
/// # Errors
/// Those of [`undamped_modes`], and [`Error::WrongLength`] if the matrices do not have the size that `description`
/// gives.
pub fn modes_of(linear: &Linear, family: Family, description: &Shared<Description>) -> Result<Modes, Error> {
    check_sizes(linear, description)?;
    solve_modes(linear, family, description, 0.0).map_err(|failure| failure.explain(description))
}

/// Refuses matrices that are not square or differ in size. Mechanisms with constraints or speeds also fix the size;
/// open ones accept any.
fn check_sizes(linear: &Linear, description: &Description) -> Result<(), Error> {
    let expected =
        if Structure::of(description).open() { linear.mass.row_count() } else { description.coordinates.len() };
    let sizes = |matrix: &Matrix| [matrix.row_count(), matrix.column_count()];
    let matrices = [&linear.mass, &linear.damping, &linear.stiffness];
    match matrices.into_iter().flat_map(sizes).find(|&size| size != expected) {
        None => Ok(()),
        Some(found) => Err(Error::WrongLength { kind: "rows or columns of a matrix", found, expected }),
    }
}

/// Why there are no modes; the error allocates nothing.
#[doc(hidden)]
pub enum ModesFailure {
    Asymmetric(f64),
    /// Undamped modes were requested, but speeds or constraints on velocities rule them out.
    NotHolonomic,
    Pencil(EigenproblemError),
    /// Those of shafts were not found.
    Shafts,
    /// Harmonics that are left out move an eigenvalue by about this part of it.
    Periodic {
        error: f64,
    },
    /// The square of this eigenvalue exceeds the range of a double.
    Range {
        mode: usize,
        size: f64,
    },
}

impl ModesFailure {
    #[cold]
    pub(crate) fn explain(self, description: &Description) -> Error {
        match self {
            Self::Shafts => Error::Shaft { reason: "its modes did not converge".into() },
            Self::Asymmetric(asymmetry) => Error::NonsymmetricStiffness { asymmetry },
            Self::NotHolonomic => Error::NoUndampedModes,
            Self::Range { mode, size } => Error::EigenvalueRange { mode, size },
            Self::Periodic { error } => Error::PeriodicCoefficients { error },
            Self::Pencil(EigenproblemError::SingularMass(row)) => {
                Error::SingularMass { coordinate: description.unknown_name(row) }
            }
            Self::Pencil(EigenproblemError::Inaccurate { mode, residual }) => Error::ModesNotFound { mode, residual },
        }
    }
}

/// Relative asymmetry up to which `Khat` counts as symmetric.
pub(crate) const SYMMETRIC: f64 = 1e-11;

/// The modes of given matrices; a `lambda` not beyond `floor` counts as zero.
pub fn solve_modes(
    linear: &Linear,
    family: Family,
    description: &Shared<Description>,
    floor: f64,
) -> Result<Modes, ModesFailure> {
    let mut modes = Modes::empty(family, description);
    modes.solve_near(linear, (description.free_directions, floor), &[])?;
    Ok(modes)
}

impl Modes {
    /// An empty set of modes.
    #[inline]
    #[doc(hidden)]
    pub fn empty(family: Family, description: &Shared<Description>) -> Self {
        Self {
            modes: Vec::new(),
            family,
            damping_ignored: false,
            whirls: Vec::new(),
            inputs: Vector::default(),
            description: description.clone(),
        }
    }

    /// Overwrites this set with the modes about an equilibrium. `judged` holds its general modes if they were needed to
    /// judge its stability, and is empty otherwise.
    #[doc(hidden)]
    pub fn solve_at(&mut self, at: &Equilibrium, judged: Vec<Mode>) -> Result<(), Error> {
        self.solve_judged(at, judged, &[]).map_err(|failure| failure.explain(&at.description))?;
        self.inputs.set(&at.inputs, |value| *value);
        Ok(())
    }

    /// Like [`Self::solve_at`], but leaves the inputs alone and starts from all modes of a nearby equilibrium, if
    /// given.
    #[doc(hidden)]
    #[inline]
    pub fn solve_judged(&mut self, at: &Equilibrium, judged: Vec<Mode>, nearby: &[Mode]) -> Result<(), ModesFailure> {
        if !at.description.spans.is_empty() {
            let sought = || Shafts::of(at).ok().flatten()?.modes(at, nearby, eigentol_shafts::Others::WhereOneEnds);
            self.modes = if judged.is_empty() { sought().ok_or(ModesFailure::Shafts)? } else { judged };
            self.family = Family::General;
            sort_by_frequency(&mut self.modes);
            return Ok(());
        }
        let alone = at.free.held.is_empty();
        if self.family == Family::General && !judged.is_empty() && alone {
            self.modes = judged;
            return Ok(());
        }
        let free = at.description.free_directions + at.free.held.len();
        self.solve_near(&at.linear, (free, at.rounding), nearby)
    }

    /// Overwrites this set with the modes of these matrices, reusing its vectors. There are `free` directions that lead
    /// to neighbouring steady motions, and a `lambda` not beyond `floor` counts as zero. For damped modes of an open
    /// mechanism, passing all modes of a nearby one saves time.
    #[inline]
    pub(crate) fn solve_near(
        &mut self,
        linear: &Linear,
        (free, floor): (usize, f64),
        nearby: &[Mode],
    ) -> Result<(), ModesFailure> {
        let damping = linear.damping.as_flattened();
        self.damping_ignored = self.family == Family::Undamped
            && self.description.damping != DampingKind::Zero
            && damping.iter().any(|&value| value != 0.0);
        match self.family {
            Family::Undamped => solve_undamped(linear, &self.description, floor, &mut self.modes),
            Family::General => {
                let limits = (free, floor);
                solve_general(linear, &self.description, limits, nearby, &mut self.modes)
            }
        }
    }
}

fn solve_undamped(
    linear: &Linear,
    description: &Description,
    floor: f64,
    modes: &mut Vec<Mode>,
) -> Result<(), ModesFailure> {
    let (structure, free) = (Structure::of(description), description.free_directions);
    if !structure.holonomic() {
        return Err(ModesFailure::NotHolonomic);
    }
    if !description.symmetric_stiffness {
        let asymmetry = asymmetry(&linear.stiffness);
        if asymmetry.is_nan() || asymmetry > SYMMETRIC {
            return Err(ModesFailure::Asymmetric(asymmetry));
        }
    }
    let in_rings = structure.open() && free == 0 && !description.rings.is_empty();
    let mut pairs = Pairs::default();
    let cyclic = if in_rings { cyclic::pairs_into(linear, description, &mut pairs) } else { None };
    let solved = cyclic.unwrap_or_else(|| constrained::free_pairs_into(linear, (structure, free), &mut pairs));
    solved.map_err(ModesFailure::Pencil)?;
    let Pairs { lambda, shapes, residuals, errors } = &pairs;
    let (lambda, residuals, errors) = (&lambda[..], &residuals[..], &errors[..]);
    let count = lambda.len();
    if modes.len() != count {
        modes.reserve_exact(count.saturating_sub(modes.len()));
        modes.resize_with(count, Mode::blank);
    }
    for_size(
        shapes.column_count(),
        #[inline(always)]
        |n| {
            let shapes = shapes.as_flattened().chunks_exact(n.max(1));
            for (r, (mode, from)) in modes.iter_mut().zip(shapes).enumerate() {
                let shape = mode.make_undamped(r, (lambda[r], greater(floor, errors[r])), residuals[r], n);
                for (to, from) in shape[..n].iter_mut().zip(&from[..n]) {
                    *to = Complex::from(*from);
                }
            }
        },
    );
    for mode in modes.iter_mut().take(free) {
        if mode.behaviour == Behaviour::Neutral {
            mode.behaviour = Behaviour::Free;
        }
    }
    Ok(())
}

/// Whether a load accelerates motions along `free` directions, which drift faster and faster.
pub fn accelerates(linear: &Linear, structure: Structure, free: usize) -> bool {
    free > 0
        && structure.holonomic()
        && if structure.open() {
            deflation::accelerates(linear, free)
        } else {
            let reduced = Tangent::new(linear, structure).reduce_linear(linear);
            deflation::accelerates(&reduced, free)
        }
}

fn solve_general(
    linear: &Linear,
    description: &Description,
    (free, floor): (usize, f64),
    nearby: &[Mode],
    modes: &mut Vec<Mode>,
) -> Result<(), ModesFailure> {
    let structure = Structure::of(description);
    let accelerates = accelerates(linear, structure, free);
    let open = structure.open() && !accelerates;
    let cyclic = if open && free == 0 { cyclic::roots(linear, description, structure) } else { None };
    let roots = if let Some(roots) = cyclic {
        roots
    } else if open && free > 0 {
        deflation::roots(linear, free, |rest| roots_near(Eigenproblem::Quadratic(rest), &[]))
            .map(|roots| constrained::measured(linear, structure, &roots))
    } else if open {
        let nearby: Vec<_> = nearby.iter().map(Mode::near).collect();
        roots_near(Eigenproblem::Quadratic(linear), &nearby)
    } else {
        constrained::general_roots(linear, structure, (free, accelerates))
    };
    let roots = roots.map_err(ModesFailure::Pencil)?;
    // Without dissipation, a motion that stays bounded has imaginary eigenvalues.
    let conservative = description.symmetric_stiffness && description.damping != DampingKind::General;
    modes.clear();
    let mut free_left = free;
    // Without dissipation two real zeros are one motion, as a pair of small imaginary ones is: which of the two they are
    // is rounding.
    let in_pairs = conservative && structure.holonomic();
    let mut second_zero = false;
    for (r, root) in roots.into_iter().enumerate() {
        let mut s = root.s;
        let error = if floor > 0.0 { root.error.max(moved_by(linear, &root, floor)) } else { root.error };
        let zero = sign(s.norm(), error) == Sign::Zero;
        let keeps_amplitude = sign(s.re, error) == Sign::Zero;
        if zero && s.im == 0.0 && in_pairs && free_left == 0 {
            second_zero = !second_zero;
            if !second_zero {
                continue;
            }
        }
        if zero {
            s = Complex::ZERO;
        } else if s.im > 0.0 && keeps_amplitude && conservative {
            s.re = 0.0;
        }
        let mut behaviour = Behaviour::of_general(s, error, zero);
        if zero && free_left > 0 {
            free_left -= 1;
            behaviour = Behaviour::Free;
        }
        let lambda = -(s * s).re;
        if !lambda.is_finite() {
            let size = s.norm();
            return Err(ModesFailure::Range { mode: r, size });
        }
        modes.push(Mode {
            s,
            lambda,
            shape: root.right,
            left: root.left,
            behaviour,
            residual: root.residual,
            error,
            condition: root.condition,
            beside: 0.0,
            label: modes.len(),
        });
    }
    principal::keep_principal(linear, description, modes)?;
    sort_by_frequency(modes);
    Ok(())
}

/// Puts modes that ascend in `|s|` in ascending order of their frequencies; those without one come first, as undamped
/// modes without stiffness do. Frequencies that differ by rounding keep their order.
fn sort_by_frequency(modes: &mut [Mode]) {
    /// Relative difference of equal frequencies.
    const EQUAL: f64 = 1e-12;
    let frequency = |mode: &Mode| mode.frequency().unwrap_or(0.0);
    modes.sort_by(|a, b| frequency(a).total_cmp(&frequency(b)));
    let equal = |a: &Mode, b: &Mode| frequency(b) <= frequency(a) * (1.0 + EQUAL);
    for run in modes.chunk_by_mut(equal) {
        run.sort_by_key(|mode| mode.label);
    }
    for (r, mode) in modes.iter_mut().enumerate() {
        mode.label = r;
    }
}

/// How far a change `floor phi^H Mhat phi` of the pencil moves a root: `d` with
/// `d (|psi^T (2 s M + C) phi| + d) = floor`.
#[cold]
fn moved_by(linear: &Linear, root: &Root, floor: f64) -> f64 {
    let slope = slope(linear, root.s, (&root.left, &root.right));
    2.0 * floor / (slope + (slope * slope + 4.0 * floor).sqrt())
}

/// The change of the pencil, in the sense of [`moved_by`], that moves a mode to zero.
pub(crate) fn change_to_zero(linear: &Linear, mode: &Mode) -> f64 {
    let distance = mode.s.norm();
    distance * (slope(linear, mode.s, (&mode.left, &mode.shape)) + distance)
}

/// `|psi^T (2 s M + C) phi|`.
fn slope(linear: &Linear, s: Complex, (left, right): (&[Complex], &[Complex])) -> f64 {
    dot_complex(left, &pencil_slope_times(linear, s, right)).norm()
}
