//! One equilibrium problem: a mechanism with inputs and design variables that were checked, evaluated with care.

use super::dependent_names;
use crate::array::{Square, all_finite, all_finite_square};
use crate::constraints::{Structure, fix_gauge, redundant_rows};
use crate::modes::symmetric::Trouble;
use crate::{DampingKind, Description, Error, Linear, Mechanism, Real, RestParts, Role};

/// A mechanism at given inputs and design variables.
pub(crate) struct Problem<'a, M, const N: usize, const U: usize, const P: usize, const O: usize> {
    pub(crate) mechanism: &'a M,
    pub(crate) inputs: &'a [f64; U],
    pub(crate) design: &'a [f64; P],
    /// Constraints that are left out, because the others imply them where they are met: rows with a zero residual and minus
    /// one on the diagonal (each constraint gives `Khat` a negative eigenvalue). Away from there dependent rows do not look dependent, and only hinder each other.
    dropped: [bool; N],
}

impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Clone
    for Problem<'_, M, N, U, P, O>
{
    fn clone(&self) -> Self {
        *self
    }
}

impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Copy
    for Problem<'_, M, N, U, P, O>
{
}

impl<'a, M, const N: usize, const U: usize, const P: usize, const O: usize>
    Problem<'a, M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    const DESCRIPTION: &'static Description = &M::DESCRIPTION;
    pub(crate) const STRUCTURE: Structure = Structure::of(&M::DESCRIPTION);
    /// Number of coordinates and speeds: they come first, and reactions after them.
    pub(crate) const MOTIONS: usize = N.saturating_sub(Self::STRUCTURE.constraints());

    /// Checks that the values are finite and describe bodies that can exist.
    pub(crate) fn new(
        mechanism: &'a M,
        inputs: &'a [f64; U],
        design: &'a [f64; P],
    ) -> Result<Self, Error> {
        let names = Self::DESCRIPTION;
        let input = |index: usize| names.inputs.get(index).map(|info| info.name);
        let variable = |index: usize| names.design.get(index).map(|info| info.name);
        finite("input", input, inputs)?;
        finite("design variable", variable, design)?;
        if let Some(violation) = mechanism.violation(inputs, design) {
            return Err(Error::Unphysical {
                quantity: violation.quantity,
                requirement: violation.requirement,
                value: violation.value,
            });
        }
        Ok(Self {
            mechanism,
            inputs,
            design,
            dropped: [false; N],
        })
    }

    /// For values that a caller has checked itself.
    pub(crate) fn unchecked(mechanism: &'a M, inputs: &'a [f64; U], design: &'a [f64; P]) -> Self {
        Self {
            mechanism,
            inputs,
            design,
            dropped: [false; N],
        }
    }

    /// The same without the constraints that are redundant at `x`, which meets them.
    pub(crate) fn without_redundant(&self, x: &[f64; N]) -> Self {
        let plain = if const { Self::STRUCTURE.constraints() > 1 } {
            self.evaluate_plain(x)
        } else {
            None
        };
        plain.map_or(*self, |(_, stiffness)| {
            self.without(&redundant_rows(&stiffness, Self::STRUCTURE))
        })
    }

    /// The same without these constraints.
    pub(crate) fn without(&self, dropped: &[bool; N]) -> Self {
        Self {
            dropped: *dropped,
            ..*self
        }
    }

    pub(crate) fn description(&self) -> &'static Description {
        Self::DESCRIPTION
    }

    pub(crate) fn check_start(&self, start: &[f64; N]) -> Result<(), Error> {
        let unknowns = Self::DESCRIPTION.coordinates;
        let name = |index: usize| unknowns.get(index).map(|info| info.name);
        finite("start value of coordinate", name, start)
    }

    /// Residual and stiffness, its gauge fixed; `None` when either is not finite.
    pub(crate) fn evaluate(&self, q: &[f64; N]) -> Option<([f64; N], Square<N>)> {
        let (mut residual, mut stiffness) = self.evaluate_plain(q)?;
        if const { !Self::STRUCTURE.open() } {
            if self.dropped.contains(&true) {
                self.drop_rows(&mut residual, Some(&mut stiffness));
            } else {
                fix_gauge(&mut stiffness, Self::STRUCTURE);
            }
        }
        Some((residual, stiffness))
    }

    /// The residual alone; it may not be finite.
    pub(crate) fn residual(&self, q: &[f64; N]) -> [f64; N] {
        let mut residual = self.mechanism.residual(q, self.inputs, self.design);
        if const { !Self::STRUCTURE.open() } {
            self.drop_rows(&mut residual, None);
        }
        residual
    }

    /// Inertia and applied forces at rest; they may not be finite.
    pub(crate) fn parts(&self, q: &[f64; N]) -> RestParts<f64, N> {
        self.mechanism.residual_parts(q, self.inputs, self.design)
    }

    fn drop_rows(&self, residual: &mut [f64; N], mut stiffness: Option<&mut Square<N>>) {
        for k in (Self::MOTIONS..N).filter(|&k| self.dropped[k]) {
            residual[k] = 0.0;
            if let Some(stiffness) = &mut stiffness {
                for j in 0..N {
                    stiffness[k][j] = 0.0;
                    stiffness[j][k] = 0.0;
                }
                stiffness[k][k] = -1.0;
            }
        }
    }

    /// As [`Self::evaluate`], with every constraint and the gauge as it is.
    pub(crate) fn evaluate_plain(&self, q: &[f64; N]) -> Option<([f64; N], Square<N>)> {
        let (residual, stiffness) =
            self.mechanism
                .residual_and_stiffness(q, self.inputs, self.design);
        (all_finite(&residual) && all_finite_square(&stiffness)).then_some((residual, stiffness))
    }

    pub(crate) fn evaluate_start(&self, q: &[f64; N]) -> Result<([f64; N], Square<N>), Failure<N>> {
        self.evaluate(q).ok_or(Failure::OutsideDomain {
            what: "the residual",
            coordinates: *q,
        })
    }

    /// The linearised mechanism, its gauge fixed.
    pub(crate) fn linear(&self, q: &[f64; N]) -> Result<Linear<f64, N>, Failure<N>> {
        let mut linear = self.mechanism.linear(q, self.inputs, self.design);
        self.check(q, &linear)?;
        if const { !Self::STRUCTURE.open() } {
            fix_gauge(&mut linear.stiffness, Self::STRUCTURE);
        }
        Ok(linear)
    }

    /// [`Self::parts`] and the linearised mechanism, neither of which may be finite, its gauge as it is. Of a small mechanism
    /// the sines, and what else both need, are computed once.
    #[inline]
    pub(crate) fn parts_and_linear(&self, q: &[f64; N]) -> (RestParts<f64, N>, Linear<f64, N>) {
        let (mechanism, u, b) = (self.mechanism, self.inputs, self.design);
        if const { N <= FEW_COORDINATES } {
            <f64 as Real>::run(
                #[inline(always)]
                || {
                    let parts = mechanism.residual_parts_inlined(q, u, b);
                    (parts, mechanism.linear_inlined(q, u, b))
                },
            )
        } else {
            (self.parts(q), mechanism.linear(q, u, b))
        }
    }

    /// Refuses matrices that are not finite.
    #[inline]
    pub(crate) fn check(&self, q: &[f64; N], linear: &Linear<f64, N>) -> Result<(), Failure<N>> {
        let undamped = const { matches!(M::DESCRIPTION.damping, DampingKind::Zero) };
        let what = if !all_finite_square(&linear.mass) {
            "the mass matrix"
        } else if !undamped && !all_finite_square(&linear.damping) {
            "the damping matrix"
        } else if !all_finite_square(&linear.stiffness) {
            "the stiffness matrix"
        } else {
            return Ok(());
        };
        Err(Failure::OutsideDomain {
            what,
            coordinates: *q,
        })
    }
}

/// Coordinates up to which two kernels in one function pay: code for more is long.
pub(super) const FEW_COORDINATES: usize = 4;

/// Refuses the first value that is not finite, under its name.
#[inline]
fn finite<const K: usize>(
    kind: &'static str,
    name: impl Fn(usize) -> Option<&'static str>,
    values: &[f64; K],
) -> Result<(), Error> {
    if all_finite(values) {
        return Ok(());
    }
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(index) => Err(Error::NotFinite {
            kind,
            name: name(index).unwrap_or("?"),
            value: values[index],
        }),
    }
}

/// Why a solve failed; owns nothing, so that a failing sample costs no allocation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Failure<const N: usize> {
    OutsideDomain {
        what: &'static str,
        coordinates: [f64; N],
    },
    NotFound {
        reason: &'static str,
        coordinates: [f64; N],
        iterations: usize,
        relative: f64,
    },
    /// The constraints stay open by `gaps`, in the places of their rows; zero where they are met.
    NotAssembled {
        reason: &'static str,
        coordinates: [f64; N],
        gaps: [f64; N],
        /// The row that stays open most, relative to what motions can close.
        worst: usize,
        iterations: usize,
    },
    /// Beside a singular configuration, in which the forces do not balance.
    Unbalanced {
        coordinates: [f64; N],
        /// The direction that constraints do not hold there, down the applied forces; its greatest component is one.
        downhill: [f64; N],
        /// The constraints that lose their independence.
        dependent: [bool; N],
    },
    SingularMass(usize),
    Mode {
        mode: usize,
        residual: f64,
    },
}

impl<const N: usize> From<Trouble> for Failure<N> {
    fn from(trouble: Trouble) -> Self {
        match trouble {
            Trouble::SingularMass(row) => Self::SingularMass(row),
            Trouble::Inaccurate { mode, residual } => Self::Mode { mode, residual },
        }
    }
}

impl<const N: usize> Failure<N> {
    #[cold]
    pub(crate) fn explain(self, description: &'static Description) -> Error {
        match self {
            Self::OutsideDomain { what, coordinates } => Error::OutsideDomain {
                mechanism: description.name,
                what,
                coordinates: coordinates.to_vec(),
            },
            Self::NotFound {
                reason,
                coordinates,
                iterations,
                relative,
            } => Error::NoEquilibrium {
                reason,
                iterations,
                coordinates: coordinates.to_vec(),
                relative_residual: relative,
            },
            Self::NotAssembled {
                reason,
                coordinates,
                gaps,
                worst,
                iterations,
            } => Error::NotAssembled {
                reason,
                constraint: name(description, worst),
                gap: gaps[worst],
                unit: gap_unit(description, worst),
                others: (0..N)
                    .filter(|&row| row != worst && gaps[row] != 0.0)
                    .map(|row| (name(description, row), gaps[row]))
                    .collect(),
                coordinates: coordinates.to_vec(),
                iterations,
            },
            Self::Unbalanced {
                coordinates,
                dependent,
                ..
            } => Error::UnboundedReactions {
                constraints: dependent_names(description, dependent).collect(),
                coordinates: coordinates.to_vec(),
            },
            Self::SingularMass(row) => Error::SingularMass {
                coordinate: name(description, row),
            },
            Self::Mode { mode, residual } => Error::ModesNotFound { mode, residual },
        }
    }
}

/// Name of an unknown.
pub(crate) fn name(description: &Description, index: usize) -> &'static str {
    let found = description.coordinates.get(index);
    found.map_or("?", |info| info.name)
}

/// Unit of the gap of a constraint: what its reaction does work on.
pub(crate) fn gap_unit(description: &Description, row: usize) -> &'static str {
    let Some(info) = description.coordinates.get(row) else {
        return "";
    };
    match (info.unit.symbol, info.role) {
        ("N", Role::VelocityReaction) => "m/s",
        ("N*m", Role::VelocityReaction) => "rad/s",
        ("N", _) => "m",
        ("N*m", _) => "rad",
        _ => "",
    }
}
