//! Total derivatives of mode shapes, left and right, by a bordered solve (Nelson 1976).
//!
//! With `Q phi = 0`, `Q = Khat - lambda Mhat` or `s^2 Mhat + s Chat + Khat`, a change of the matrices gives
//! `Q dphi = -(dQ + Q' ds) phi`. `Q` is singular in the direction of `phi` only; it is solved with `alpha (Q' phi) c^H`
//! added, which leaves the solution as it is but for its part along `phi`, and that part follows from the normalisation:
//! `c = Mhat phi`, or the unit vector of the component that is one ([`Normalisation`]).

use super::CLUSTER_GAP;
use super::explicit::rate_of;
use super::shift::{directions, outside_domain};
use crate::array::{Lu, dot_complex, largest_element, times_complex};
use crate::modes::{Family, Normalisation, clusters, lead};
use crate::pencil::{pencil_slope_times, pencil_times, transposed};
use crate::{Complex, Description, Equilibrium, Error, Linear, Mechanism, Mode, Modes};

/// Total derivatives of the shapes of one mode, normalised as the mode is ([`Mode::shape`]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapeSensitivity<const N: usize, const U: usize, const P: usize> {
    /// `right_by_input[j]`: derivative of `phi` by input `j`.
    pub right_by_input: [[Complex; N]; U],
    /// `right_by_design[j]`: derivative of `phi` by design variable `j`.
    pub right_by_design: [[Complex; N]; P],
    /// `left_by_input[j]`: derivative of `psi` by input `j`.
    pub left_by_input: [[Complex; N]; U],
    /// `left_by_design[j]`: derivative of `psi` by design variable `j`.
    pub left_by_design: [[Complex; N]; P],
    /// The mechanism they belong to.
    pub description: &'static Description,
}

/// Total derivatives of the shapes of mode number `mode` by every input and design variable.
///
/// # Errors
/// [`Error::ClusteredMode`] where the mode has (nearly) equal neighbours, [`Error::CriticalState`] when `Khat` is
/// singular, [`Error::OutsideDomain`] when a derivative is not finite, [`Error::NoSuchMode`].
pub fn shape_sensitivity<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
    mode: usize,
) -> Result<ShapeSensitivity<N, U, P>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    let shapes = Shapes::new(at, modes, mode)?;
    let mut all = directions(mechanism, at)?.map(|along| {
        let change = along.linear(mechanism, at);
        shapes.along(&change, (shapes.rate)(&change))
    });
    let zero = ([Complex::default(); N], [Complex::default(); N]);
    let by_input: [_; U] = core::array::from_fn(|_| all.next().unwrap_or(zero));
    let by_design: [_; P] = core::array::from_fn(|_| all.next().unwrap_or(zero));
    let finite = by_input
        .iter()
        .chain(&by_design)
        .flat_map(|(right, left)| right.iter().chain(left))
        .all(|value| value.is_finite());
    if !finite {
        return Err(outside_domain(at));
    }
    Ok(ShapeSensitivity {
        right_by_input: by_input.map(|(right, _)| right),
        right_by_design: by_design.map(|(right, _)| right),
        left_by_input: by_input.map(|(_, left)| left),
        left_by_design: by_design.map(|(_, left)| left),
        description: modes.description,
    })
}

/// How the eigenvalue and the shapes of one mode move with its matrices.
pub(super) struct Shapes<'a, const N: usize, F> {
    linear: &'a Linear<f64, N>,
    family: Family,
    mode: &'a Mode<N>,
    right: Side<N>,
    /// `None` where it is the same as the right one.
    left: Option<Side<N>>,
    /// The rate of the eigenvalue: of `lambda` for undamped modes, of `s` for general ones.
    pub(super) rate: F,
}

impl<'a, const N: usize> Shapes<'a, N, ()> {
    pub(super) fn new<const U: usize, const P: usize>(
        at: &'a Equilibrium<N, U, P>,
        modes: &'a Modes<N>,
        position: usize,
    ) -> Result<Shapes<'a, N, impl Fn(&Linear<f64, N>) -> Complex + use<'a, N, U, P>>, Error> {
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
        let (size, leading) = Normalisation::of(at.description);
        let normalised = (size, leading.right);
        let right =
            Side::new(linear, family, mode, &mode.shape, normalised).ok_or(clustered.clone())?;
        let left = match family {
            Family::Undamped => None,
            Family::General => {
                let normalised = (size, leading.left);
                let transposed = transposed(linear);
                let side = Side::new(&transposed, family, mode, &mode.left, normalised);
                Some(side.ok_or(clustered)?)
            }
        };
        Ok(Shapes {
            linear,
            family,
            mode,
            right,
            left,
            rate: rate_of(at, family, mode),
        })
    }
}

impl<const N: usize, F> Shapes<'_, N, F> {
    /// Derivatives of the right and the left shape while the matrices move by `change` and the eigenvalue by `rate`.
    pub(super) fn along(
        &self,
        change: &Linear<f64, N>,
        rate: Complex,
    ) -> ([Complex; N], [Complex; N]) {
        let mode = self.mode;
        let moved = |linear: &Linear<f64, N>, change: &Linear<f64, N>, shape: &[Complex; N]| {
            let direct = match self.family {
                Family::Undamped => {
                    let k = times_complex(&change.stiffness, shape);
                    let m = times_complex(&change.mass, shape);
                    core::array::from_fn(|i| k[i] - mode.lambda * m[i])
                }
                Family::General => pencil_times(change, mode.s, shape),
            };
            let slope = eigenvalue_slope_times(linear, self.family, mode, shape);
            core::array::from_fn(|i| -direct[i] - rate * slope[i])
        };
        let right = self.right.solve(
            &moved(self.linear, change, &mode.shape),
            &times_complex(&change.mass, &mode.shape),
        );
        let left = match &self.left {
            None => right,
            Some(side) => side.solve(
                &moved(&transposed(self.linear), &transposed(change), &mode.left),
                &times_complex(&change.mass, &mode.left),
            ),
        };
        (right, left)
    }
}

/// `Q' phi`: derivative of the pencil by its eigenvalue (`lambda` or `s`) times a shape.
fn eigenvalue_slope_times<const N: usize>(
    linear: &Linear<f64, N>,
    family: Family,
    mode: &Mode<N>,
    shape: &[Complex; N],
) -> [Complex; N] {
    match family {
        Family::Undamped => times_complex(&linear.mass, shape).map(|value| -value),
        Family::General => pencil_slope_times(linear, mode.s, shape),
    }
}

/// The deflated pencil on one side of a mode.
struct Side<const N: usize> {
    shape: [Complex; N],
    size: Normalisation,
    /// `c`.
    weighted: [Complex; N],
    lead: usize,
    factors: Lu<Complex, N>,
}

impl<const N: usize> Side<N> {
    fn new(
        linear: &Linear<f64, N>,
        family: Family,
        mode: &Mode<N>,
        shape: &[Complex; N],
        (normalisation, leading): (Normalisation, usize),
    ) -> Option<Self> {
        let lead = lead(&shape[..leading.min(N)]);
        let weighted = match normalisation {
            Normalisation::Mass => times_complex(&linear.mass, shape),
            Normalisation::Largest => {
                core::array::from_fn(|i| if i == lead { 1.0 } else { 0.0 }.into())
            }
        };
        let slope = eigenvalue_slope_times(linear, family, mode, shape);
        let (s, lambda) = (mode.s, mode.lambda);
        let pencil: [[Complex; N]; N] = core::array::from_fn(|i| {
            core::array::from_fn(|j| {
                let (m, c, k) = (
                    linear.mass[i][j],
                    linear.damping[i][j],
                    linear.stiffness[i][j],
                );
                match family {
                    Family::Undamped => (k - lambda * m).into(),
                    Family::General => s * (s * m + c) + k,
                }
            })
        });
        let size = |vector: &[Complex; N]| {
            vector
                .iter()
                .fold(0.0, |most: f64, value| most.max(value.norm()))
        };
        let scale = largest_element(&linear.stiffness)
            + s.norm()
                * (largest_element(&linear.damping) + s.norm() * largest_element(&linear.mass));
        let added = if scale > 0.0 { scale } else { 1.0 } / (size(&slope) * size(&weighted));
        let deflated = core::array::from_fn(|i| {
            core::array::from_fn(|j| pencil[i][j] + added * slope[i] * weighted[j].conj())
        });
        Some(Self {
            shape: *shape,
            size: normalisation,
            weighted,
            lead,
            factors: Lu::new(&deflated)?,
        })
    }

    /// The derivative of the shape from the right-hand side and from `dMhat phi`.
    fn solve(&self, right: &[Complex; N], mass_change: &[Complex; N]) -> [Complex; N] {
        let conj = |vector: &[Complex; N]| vector.map(|value| value.conj());
        let across = self.factors.solve(right);
        if self.size == Normalisation::Largest {
            let part = -across[self.lead] / self.shape[self.lead];
            return core::array::from_fn(|i| across[i] + part * self.shape[i]);
        }
        let size_change = dot_complex(&conj(&self.shape), mass_change).re;
        let along = -0.5 * size_change - dot_complex(&conj(&self.weighted), &across).re;
        let turn = -across[self.lead].im / self.shape[self.lead].re;
        let part = Complex::new(along, turn);
        core::array::from_fn(|i| across[i] + part * self.shape[i])
    }
}
