//! Total derivatives of mode shapes, left and right, by a bordered solve (Nelson 1976).
//!
//! With `Q phi = 0`, `Q = Khat - lambda Mhat` or `s^2 Mhat + s Chat + Khat`, a change of the matrices gives
//! `Q dphi = -(dQ + Q' ds) phi`. `Q` is singular only in the direction of `phi`. The equation is solved with
//! `alpha (Q' phi) c^H` added to `Q`, which changes only the component of the solution along `phi`; that component
//! follows from the normalisation: `c = Mhat phi`, or the unit vector of the component that is one (`Normalisation`).

use crate::algebra::{Lu, Matrix, Values, Vector, dot_complex, greater, largest, times_complex};
use crate::constraints::Structure;
use crate::kernels::{DirectionalKernels, Linear};
use crate::modes::{
    CLUSTER_GAP, Family, Normalisation, clusters, lead, pencil_slope_times, pencil_times,
    transposed,
};
use crate::sensitivity::{Rate, check_modes, directions, outside_domain};
use crate::{Complex, Description, Equilibrium, Error, Mode, Modes, Shared};

/// Total derivatives of the shapes of one mode, with the normalisation of the mode ([`Mode::shape`]).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ShapeSensitivity {
    /// `right_by_input[j]`: derivative of `phi` with respect to input `j`.
    pub right_by_input: Matrix<Complex>,
    /// `right_by_design[j]`: derivative of `phi` with respect to design variable `j`.
    pub right_by_design: Matrix<Complex>,
    /// `left_by_input[j]`: derivative of `psi` with respect to input `j`.
    pub left_by_input: Matrix<Complex>,
    /// `left_by_design[j]`: derivative of `psi` with respect to design variable `j`.
    pub left_by_design: Matrix<Complex>,
    /// The mechanism they belong to.
    pub description: Shared<Description>,
}

/// Total derivatives of the shapes of mode number `mode` with respect to every input and design variable.
///
/// # Errors
/// [`Error::ClusteredMode`] if the mode has (nearly) equal neighbours, [`Error::CriticalState`] if `Khat` is singular,
/// [`Error::OutsideDomain`] if a derivative is not finite, [`Error::NoSuchMode`].
pub fn shape_sensitivity(
    mechanism: &dyn DirectionalKernels,
    at: &Equilibrium,
    modes: &Modes,
    mode: usize,
) -> Result<ShapeSensitivity, Error> {
    let shapes = Shapes::new(at, modes, mode)?;
    let (mut right, mut left) = (Vec::new(), Vec::new());
    for direction in directions(mechanism, at)? {
        let change = direction.linear(mechanism, at);
        let (dright, dleft) = shapes.along(&change, shapes.rate.along(&change));
        right.push(dright);
        left.push(dleft);
    }
    let mut values = right.iter().chain(&left).flatten();
    if !values.all(|value| value.is_finite()) {
        return Err(outside_domain(at));
    }
    let (n, inputs) = (at.coordinates.len(), at.inputs.len());
    let rows = |rows: &[Vector<Complex>]| Matrix::from_fn(rows.len(), n, |k, i| rows[k][i]);
    Ok(ShapeSensitivity {
        right_by_input: rows(&right[..inputs]),
        right_by_design: rows(&right[inputs..]),
        left_by_input: rows(&left[..inputs]),
        left_by_design: rows(&left[inputs..]),
        description: modes.description.clone(),
    })
}

/// Derivatives of the eigenvalue and the shapes of one mode with respect to its matrices.
pub(super) struct Shapes<'a> {
    linear: &'a Linear,
    family: Family,
    mode: &'a Mode,
    right: Side,
    /// `None` if it equals the right one.
    left: Option<Side>,
    /// Derivative of the eigenvalue: of `lambda` for undamped modes, of `s` for general ones.
    pub(super) rate: Rate<'a>,
}

impl<'a> Shapes<'a> {
    pub(super) fn new(
        at: &'a Equilibrium,
        modes: &'a Modes,
        position: usize,
    ) -> Result<Self, Error> {
        check_modes(at, modes)?;
        let Some(mode) = modes.modes.get(position) else {
            return Err(Error::NoSuchMode {
                mode: position,
                count: modes.modes.len(),
            });
        };
        let clustered = Error::ClusteredMode { mode: position };
        if clusters(modes, CLUSTER_GAP)[position] {
            return Err(clustered);
        }
        let family = modes.family;
        let linear = &at.linear;
        let motions = Structure::of(&at.description).motions();
        let (size, leading) = Normalisation::of(&at.description);
        let normalised = (size, leading.right);
        let right = Side::new((linear, motions), family, mode, &mode.shape, normalised)
            .ok_or(clustered.clone())?;
        let left = match family {
            Family::Undamped => None,
            Family::General => {
                let normalised = (size, leading.left);
                let transposed = transposed(linear);
                let side = Side::new(
                    (&transposed, motions),
                    family,
                    mode,
                    mode.left(),
                    normalised,
                );
                Some(side.ok_or(clustered)?)
            }
        };
        Ok(Self {
            linear,
            family,
            mode,
            right,
            left,
            rate: Rate::of(at, family, mode),
        })
    }

    /// Derivatives of the right and the left shape when the matrices change by `change` and the eigenvalue by `rate`.
    pub(super) fn along(
        &self,
        change: &Linear,
        rate: Complex,
    ) -> (Vector<Complex>, Vector<Complex>) {
        let mode = self.mode;
        let moved = |linear: &Linear, change: &Linear, shape: &[Complex]| {
            let direct = match self.family {
                Family::Undamped => {
                    let k = times_complex(&change.stiffness, shape);
                    let m = times_complex(&change.mass, shape);
                    Vector::from_fn(shape.len(), |i| k[i] - mode.lambda * m[i])
                }
                Family::General => pencil_times(change, mode.s, shape),
            };
            let slope = eigenvalue_slope_times(linear, self.family, mode, shape);
            Vector::from_fn(shape.len(), |i| -direct[i] - rate * slope[i])
        };
        let right = self.right.solve(
            &moved(self.linear, change, &mode.shape),
            &times_complex(&change.mass, &mode.shape),
        );
        let left = match &self.left {
            None => right.clone(),
            Some(side) => side.solve(
                &moved(&transposed(self.linear), &transposed(change), mode.left()),
                &times_complex(&change.mass, mode.left()),
            ),
        };
        (right, left)
    }
}

/// `Q' phi`: derivative of the pencil with respect to its eigenvalue (`lambda` or `s`), times a shape.
fn eigenvalue_slope_times(
    linear: &Linear,
    family: Family,
    mode: &Mode,
    shape: &[Complex],
) -> Vector<Complex> {
    match family {
        Family::Undamped => times_complex(&linear.mass, shape).map(|value| -value),
        Family::General => pencil_slope_times(linear, mode.s, shape),
    }
}

/// The deflated pencil on one side of a mode.
struct Side {
    shape: Vector<Complex>,
    size: Normalisation,
    /// The vector `c`.
    weighted: Vector<Complex>,
    lead: usize,
    factors: Lu<Complex>,
}

impl Side {
    fn new(
        (linear, motions): (&Linear, usize),
        family: Family,
        mode: &Mode,
        shape: &[Complex],
        (normalisation, leading): (Normalisation, usize),
    ) -> Option<Self> {
        let n = shape.len();
        let lead = lead(&shape[..leading.min(n)]);
        let weighted = match normalisation {
            Normalisation::Mass => times_complex(&linear.mass, shape),
            Normalisation::Largest => {
                Vector::from_fn(n, |i| if i == lead { 1.0 } else { 0.0 }.into())
            }
        };
        let slope = eigenvalue_slope_times(linear, family, mode, shape);
        let (s, lambda) = (mode.s, mode.lambda);
        let pencil: Matrix<Complex> = Matrix::from_fn(n, n, |i, j| {
            let (m, c, k) = (
                linear.mass[i][j],
                linear.damping[i][j],
                linear.stiffness[i][j],
            );
            match family {
                Family::Undamped => (k - lambda * m).into(),
                Family::General => s * (s * m + c) + k,
            }
        });
        let size = |vector: &[Complex]| {
            vector
                .iter()
                .fold(0.0, |most: f64, value| most.max(value.norm()))
        };
        // The constraints are no stiffness.
        let largest = |matrix: &Matrix| {
            let moving = matrix
                .iter()
                .take(motions)
                .map(|row| largest(&row[..motions]));
            moving.fold(0.0, greater)
        };
        let scale = largest(&linear.stiffness)
            + s.norm() * (largest(&linear.damping) + s.norm() * largest(&linear.mass));
        let added = if scale > 0.0 { scale } else { 1.0 } / (size(&slope) * size(&weighted));
        let deflated = Matrix::from_fn(n, n, |i, j| {
            pencil[i][j] + added * slope[i] * weighted[j].conj()
        });
        Some(Self {
            shape: shape.into(),
            size: normalisation,
            weighted,
            lead,
            factors: Lu::new(&deflated)?,
        })
    }

    /// The derivative of the shape, from the right-hand side and `dMhat phi`.
    fn solve(&self, right: &[Complex], mass_change: &[Complex]) -> Vector<Complex> {
        let n = right.len();
        let conj = |vector: &[Complex]| vector.map(|value| value.conj());
        let across = self.factors.solve(right);
        if self.size == Normalisation::Largest {
            let part = -across[self.lead] / self.shape[self.lead];
            return Vector::from_fn(n, |i| across[i] + part * self.shape[i]);
        }
        let size_change = dot_complex(&conj(&self.shape), mass_change).re;
        let along = -0.5 * size_change - dot_complex(&conj(&self.weighted), &across).re;
        let turn = -across[self.lead].im / self.shape[self.lead].re;
        let part = Complex::new(along, turn);
        Vector::from_fn(n, |i| across[i] + part * self.shape[i])
    }
}
