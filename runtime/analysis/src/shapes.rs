//! Total derivatives of mode shapes, left and right, by a bordered solve (Nelson 1976).
//!
//! With `Q phi = 0`, `Q = Khat - lambda Mhat` or `s^2 Mhat + s Chat + Khat`, a change of the matrices gives
//! `Q dphi = -(dQ + Q' ds) phi`. `Q` is singular only in the direction of `phi`. The equation is solved with
//! `alpha (Q' phi) c^H` added to `Q`, which changes only the component of the solution along `phi`; that component
//! follows from the normalisation: `c = Mhat phi`, or the unit vector of the component that is one (`Normalisation`).

mod answer;

use crate::algebra::{Field, Lu, Matrix, Vector, greater, largest, times, times_complex};
use crate::constraints::Structure;
use crate::kernels::{DirectionalKernels, Kernels, Linear};
use crate::modes::{CLUSTER_GAP, Family, Normalisation, clusters, lead, pencil_slope_times, pencil_times, transposed};
use crate::scalar::Real as _;
use crate::sensitivity::{Rate, check_modes, directions, outside_domain};
use crate::shafts::ShaftsAlong;
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
    let shapes = Shapes::new(mechanism, at, modes, mode)?;
    let (mut right, mut left) = (Vec::new(), Vec::new());
    for (variable, direction) in directions(mechanism, at)?.enumerate() {
        let change = direction.linear(mechanism, at);
        let rate = shapes.rate_along(variable, &change);
        let (dright, dleft) = shapes.along(variable, &change, rate);
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
    mode: &'a Mode,
    sides: Sides,
    /// Derivative of the eigenvalue: of `lambda` for undamped modes, of `s` for general ones.
    rate: Rate<'a>,
    /// What shafts add.
    pub(super) shafts: Option<ShaftsAlong<'a>>,
}

/// The deflated pencil of a mode.
enum Sides {
    /// Real, and the same on both sides.
    Undamped(Box<Side<f64>>),
    General {
        right: Box<Side<Complex>>,
        left: Box<Side<Complex>>,
    },
}

impl<'a> Shapes<'a> {
    pub(super) fn new(
        mechanism: &'a dyn Kernels,
        at: &'a Equilibrium,
        modes: &'a Modes,
        position: usize,
    ) -> Result<Self, Error> {
        check_modes(at, modes)?;
        let Some(mode) = modes.modes.get(position) else {
            return Err(Error::NoSuchMode { mode: position, count: modes.modes.len() });
        };
        let clustered = Error::ClusteredMode { mode: position };
        if clusters(modes, CLUSTER_GAP)[position] {
            return Err(clustered);
        }
        if mode.place() != mode.s {
            return Err(Error::NextToPole { mode: position });
        }
        let family = modes.family;
        let linear = &at.linear;
        let shafts = ShaftsAlong::of(mechanism, at, mode.s)?;
        let motions = Structure::of(&at.description).motions();
        let (size, leading) = Normalisation::of(&at.description);
        let scale = scale(linear, motions, mode);
        let first_of = |shape: &[Complex], leading: usize| lead(&shape[..leading.min(shape.len())]);
        let sides = match family {
            Family::Undamped => {
                let shape = mode.real_shape();
                let pencil = |i: usize, j: usize| linear.stiffness[i][j] - mode.lambda * linear.mass[i][j];
                let slope = times(&linear.mass, &shape).iter().map(|time| -time).collect();
                let normalised = (size, first_of(&mode.shape, leading.right));
                Side::new(linear, pencil, (&shape, slope), scale, normalised).map(|side| Sides::Undamped(side.into()))
            }
            Family::General => {
                let s = mode.s;
                let side = |linear: &Linear, shape: &[Complex], leading: usize, is_left: bool| {
                    let pencil = |i: usize, j: usize| {
                        let (m, c) = (linear.mass[i][j], linear.damping[i][j]);
                        let of_shafts = shafts.as_ref().map_or(Complex::ZERO, |own| own.entry([i, j], is_left));
                        s * (s * m + c) + linear.stiffness[i][j] + of_shafts
                    };
                    let mut slope = pencil_slope_times(linear, s, shape);
                    if let Some(own) = &shafts {
                        own.add_slope_times(Complex::ONE, shape, is_left, &mut slope);
                    }
                    let normalised = (size, first_of(shape, leading));
                    Side::new(linear, pencil, (shape, slope), scale, normalised)
                };
                let right = side(linear, &mode.shape, leading.right, false);
                let left = side(&transposed(linear), mode.left(), leading.left, true);
                right.zip(left).map(|(right, left)| Sides::General { right: right.into(), left: left.into() })
            }
        };
        let rate = Rate::of(at, family, mode, shafts.as_ref());
        Ok(Self { mode, sides: sides.ok_or(clustered)?, rate, shafts })
    }

    /// Derivative of the eigenvalue by a variable, along which the compiled matrices change by `change`.
    pub(super) fn rate_along(&self, variable: usize, change: &Linear) -> Complex {
        self.rate.along(change) + self.shafts.as_ref().map_or(Complex::ZERO, |own| self.rate.of_shafts(own, variable))
    }

    /// Derivatives of the right and the left shape by a variable, along which the compiled matrices change by `change` and
    /// the eigenvalue by `rate`.
    pub(super) fn along(&self, variable: usize, change: &Linear, rate: Complex) -> (Vector<Complex>, Vector<Complex>) {
        let mode = self.mode;
        match &self.sides {
            Sides::Undamped(side) => {
                let shape = &mode.real_shape();
                let [k, m] = [&change.stiffness, &change.mass].map(|matrix| times(matrix, shape));
                let right = side.nelson_derivative(&self.moved((&k, &m), rate.re), &m);
                let right: Vector<Complex> = right.iter().map(|value| (*value).into()).collect();
                (right.clone(), right)
            }
            Sides::General { right, left } => {
                let moved = |side: &Side<Complex>, change: &Linear, is_left: bool| {
                    let mut direct = pencil_times(change, mode.s, &side.shape);
                    if let Some(own) = &self.shafts {
                        own.add_times(variable, &side.shape, is_left, &mut direct);
                    }
                    Vector::from_fn(direct.len(), |i| -direct[i] - rate * side.slope[i])
                };
                let moved = [moved(right, change, false), moved(left, &transposed(change), true)];
                let right = right.nelson_derivative(&moved[0], &times_complex(&change.mass, &mode.shape));
                let left = left.nelson_derivative(&moved[1], &times_complex(&change.mass, mode.left()));
                (right, left)
            }
        }
    }

    /// Derivatives of an undamped shape along several directions, given for each the products of the changes of
    /// stiffness and mass with the shape, and the change of `lambda`; `None` for a general mode.
    pub(super) fn undamped_along(&self, products: &[(Vector, Vector)], rates: &[f64]) -> Option<Vec<Vector>> {
        let Sides::Undamped(side) = &self.sides else {
            return None;
        };
        let right = products.iter().zip(rates);
        let right = right.map(|((k, m), rate)| self.moved((k, m), *rate));
        let right: Vec<Vector> = right.collect();
        let right = Matrix::from_fn(side.shape.len(), right.len(), |i, j| right[j][i]);
        let across = f64::run(
            #[inline(always)]
            || side.factors.solve_columns(&right),
        );
        Some(products.iter().enumerate().map(|(j, (_, m))| side.complete(&across.column(j), m)).collect())
    }

    /// `-(dQ + Q' dlambda) phi` of an undamped mode.
    fn moved(&self, (k, m): (&[f64], &[f64]), rate: f64) -> Vector {
        let lambda = self.mode.lambda;
        let slope = match &self.sides {
            Sides::Undamped(side) => &side.slope[..],
            Sides::General { .. } => &[],
        };
        Vector::from_fn(k.len(), |i| -(k[i] - lambda * m[i]) - rate * slope[i])
    }
}

/// Size of the elements of the pencil; constraints are no stiffness.
fn scale(linear: &Linear, motions: usize, mode: &Mode) -> f64 {
    let largest = |matrix: &Matrix| matrix.iter().take(motions).map(|row| largest(&row[..motions])).fold(0.0, greater);
    let s = mode.s.norm();
    let scale = largest(&linear.stiffness) + s * (largest(&linear.damping) + s * largest(&linear.mass));
    if scale > 0.0 { scale } else { 1.0 }
}

/// Real or complex components of a shape.
trait Component: Field + core::iter::Sum {
    fn conj(self) -> Self;
    fn modulus(self) -> f64;
    fn parts(self) -> (f64, f64);
    fn from_parts(re: f64, im: f64) -> Self;
    fn scaled(self, factor: f64) -> Self;
}

impl Component for f64 {
    fn conj(self) -> Self {
        self
    }
    fn modulus(self) -> f64 {
        self.abs()
    }
    fn parts(self) -> (f64, f64) {
        (self, 0.0)
    }
    fn from_parts(re: f64, _: f64) -> Self {
        re
    }
    fn scaled(self, factor: f64) -> Self {
        self * factor
    }
}

impl Component for Complex {
    fn conj(self) -> Self {
        Complex::conj(&self)
    }
    fn modulus(self) -> f64 {
        self.norm()
    }
    fn parts(self) -> (f64, f64) {
        (self.re, self.im)
    }
    fn from_parts(re: f64, im: f64) -> Self {
        Complex::new(re, im)
    }
    fn scaled(self, factor: f64) -> Self {
        self * factor
    }
}

/// The deflated pencil on one side of a mode.
struct Side<T> {
    shape: Vector<T>,
    /// `Q' phi`.
    slope: Vector<T>,
    size: Normalisation,
    /// The vector `c`.
    weighted: Vector<T>,
    lead: usize,
    factors: Lu<T>,
}

impl<T: Component> Side<T> {
    fn new(
        linear: &Linear,
        pencil: impl Fn(usize, usize) -> T,
        (shape, slope): (&[T], Vector<T>),
        scale: f64,
        (normalisation, lead): (Normalisation, usize),
    ) -> Option<Self> {
        let n = shape.len();
        let weighted = match normalisation {
            Normalisation::Mass => {
                let row = |row: &[f64]| row.iter().zip(shape).map(|(m, x)| x.scaled(*m)).sum();
                linear.mass.iter().map(row).collect()
            }
            Normalisation::Largest => Vector::from_fn(n, |i| T::from_parts(if i == lead { 1.0 } else { 0.0 }, 0.0)),
        };
        let size = |vector: &[T]| vector.iter().map(|value| value.modulus()).fold(0.0, f64::max);
        let added = T::from_parts(scale / (size(&slope) * size(&weighted)), 0.0);
        let deflated = Matrix::from_fn(n, n, |i, j| pencil(i, j) + added * slope[i] * weighted[j].conj());
        Some(Self { shape: shape.into(), slope, size: normalisation, weighted, lead, factors: Lu::new(&deflated)? })
    }

    /// The derivative of the shape, from the right-hand side and `dMhat phi`.
    fn nelson_derivative(&self, right: &[T], mass_change: &[T]) -> Vector<T> {
        self.complete(&self.factors.solve(right), mass_change)
    }

    /// Adds the component along the shape that keeps its normalisation.
    fn complete(&self, across: &[T], mass_change: &[T]) -> Vector<T> {
        let product = |x: &[T], y: &[T]| x.iter().zip(y).map(|(x, y)| x.conj() * *y).sum::<T>();
        let part = match self.size {
            Normalisation::Largest => T::default() - across[self.lead] / self.shape[self.lead],
            Normalisation::Mass => {
                let (size_change, _) = product(&self.shape, mass_change).parts();
                let (along, _) = product(&self.weighted, across).parts();
                let ((_, turned), (lead, _)) = (across[self.lead].parts(), self.shape[self.lead].parts());
                T::from_parts(-0.5 * size_change - along, -turned / lead)
            }
        };
        Vector::from_fn(across.len(), |i| across[i] + part * self.shape[i])
    }
}
