//! Exact second total derivatives of a mode. Its adjoint gradient is differentiated along the change of the
//! equilibrium, the shapes and the eigenvalue with each variable, so the number of gradient evaluations equals the
//! number of variables.

use core::ops::Range;
use core::slice;

use super::adjoint::Adjoint;
use super::derivatives::{SecondDerivatives, symmetric};
use crate::algebra::{Matrix, Vector, dot, dot_complex, times_columns, times_complex};
use crate::kernels::{Curvature, CurvatureKernels, Gradient, Kernels, Linear};
use crate::modes::{Family, pencil_slope_times};
use crate::scalar::Real as _;
use crate::sensitivity::{
    BilinearForm, ComplexGradient, Direction, ModeSensitivity, Quantity, Slopes, directions, eigenvalue_curvature,
    eigenvalue_slope, form_gradient, form_gradients_along, normaliser, outside_domain,
};
use crate::shafts::ShaftsAlong;
use crate::shapes::Shapes;
use crate::{Behaviour, Complex, Description, Equilibrium, Error, Mode, Modes, Shared};

/// First and second total derivatives of one mode.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModeCurvature {
    /// Position of the mode.
    pub mode: usize,
    /// Its eigenvalue, 1/s.
    pub s: Complex,
    /// First derivatives, from the same gradients.
    pub first: ModeSensitivity,
    /// Second derivatives of `lambda = -Re s^2`.
    pub lambda: SecondDerivatives<f64>,
    /// Second derivatives of `s`; `None` for an undamped neutral mode.
    pub eigenvalue: Option<SecondDerivatives<Complex>>,
    /// Largest difference between mirrored second derivatives before averaging, relative to the largest derivative:
    /// zero in exact arithmetic.
    pub asymmetry: f64,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl ModeCurvature {
    /// The derivatives of a free direction: its eigenvalue is zero for every input and design.
    fn of_free(at: &Equilibrium, mode: usize) -> Self {
        let (u, p) = (at.inputs.len(), at.design.len());
        let mut first = ModeSensitivity::blank();
        first.set_free(u, p);
        Self {
            mode,
            s: Complex::ZERO,
            first,
            lambda: SecondDerivatives::zeros(u, p),
            eigenvalue: Some(SecondDerivatives::zeros(u, p)),
            asymmetry: 0.0,
            description: at.description.clone(),
        }
    }

    /// Second derivatives of a quantity of the mode; `None` if it has no such quantity.
    #[must_use]
    pub fn of(&self, quantity: Quantity) -> Option<SecondDerivatives<f64>> {
        self.first.of(quantity)?;
        let (first, second) = (self.first.s()?, self.eigenvalue.as_ref()?);
        let curvature = |a, b, ab| quantity.curvature(self.s, a, b, ab);
        Some(second.combine(&first, curvature))
    }
}

/// First and second total derivatives of mode number `mode` with respect to all inputs and design variables.
///
/// # Errors
/// [`Error::ClusteredMode`] if the mode has (nearly) equal neighbours, [`Error::CriticalState`] if `Khat` is singular,
/// [`Error::OutsideDomain`] if a derivative is not finite, [`Error::NoSuchMode`].
pub fn mode_curvature(
    mechanism: &dyn CurvatureKernels,
    at: &Equilibrium,
    modes: &Modes,
    mode: usize,
) -> Result<ModeCurvature, Error> {
    let mut mode_curvatures = mode_curvatures(mechanism, at, modes, mode..mode + 1);
    mode_curvatures.pop().unwrap_or(Err(Error::NoSuchMode { mode, count: modes.modes.len() }))
}

/// Directions along which the gradients of several modes are differentiated together.
const TOGETHER: usize = 8;

/// Like [`mode_curvature`], for several modes, which share the motion of the state.
pub(super) fn mode_curvatures(
    mechanism: &dyn CurvatureKernels,
    at: &Equilibrium,
    modes: &Modes,
    positions: Range<usize>,
) -> Vec<Result<ModeCurvature, Error>> {
    let mut pending: Vec<Result<PendingMode<'_>, Error>> = positions
        .clone()
        .map(|mode| {
            if is_free(modes, mode) {
                Err(Error::NotOscillating { mode, lambda: 0.0 })
            } else {
                PendingMode::new(mechanism, at, modes, mode)
            }
        })
        .collect();
    if pending.iter().any(Result::is_ok) {
        match directions(mechanism, at) {
            Ok(directions) => {
                let all: Vec<Direction> = directions.collect();
                let n = at.coordinates.len();
                let shift = Matrix::from_fn(all.len(), n, |k, i| all[k].coordinates[i]);
                let mut ready: Vec<&mut PendingMode<'_>> = pending.iter_mut().flatten().collect();
                for directions in all.chunks(TOGETHER) {
                    let changes = directions.iter().map(|direction| direction.linear(mechanism, at));
                    let changes: Vec<Linear> = changes.collect();
                    match modes.family {
                        Family::Undamped => {
                            undamped_along(&mut ready, (directions, &shift), &changes);
                        }
                        Family::General => {
                            for pending in &mut ready {
                                let first = pending.rows.len();
                                let rows =
                                    pending.gradient.along((directions, &shift), (first, &changes), &pending.shapes);
                                pending.rows.extend(rows);
                            }
                        }
                    }
                }
            }
            Err(error) => pending.iter_mut().filter(|x| x.is_ok()).for_each(|x| *x = Err(error.clone())),
        }
    }
    pending
        .into_iter()
        .zip(positions)
        .map(|(item, position)| {
            if is_free(modes, position) { Ok(ModeCurvature::of_free(at, position)) } else { item?.curvature(at, modes) }
        })
        .collect()
}

fn is_free(modes: &Modes, position: usize) -> bool {
    let mode = modes.modes.get(position);
    mode.is_some_and(|mode| mode.behaviour == Behaviour::Free)
}

/// A mode whose curvature is being computed.
struct PendingMode<'a> {
    position: usize,
    mode: &'a Mode,
    gradient: AdjointGradient<'a>,
    shapes: Shapes<'a>,
    /// The derivatives of its gradient along each direction so far.
    rows: Vec<Slopes<Complex>>,
}

impl<'a> PendingMode<'a> {
    fn new(
        mechanism: &'a dyn CurvatureKernels,
        at: &'a Equilibrium,
        modes: &'a Modes,
        position: usize,
    ) -> Result<Self, Error> {
        let shapes = Shapes::new(mechanism, at, modes, position)?;
        let mode = &modes.modes[position];
        Ok(Self {
            position,
            mode,
            gradient: AdjointGradient::new(mechanism, at, modes.family, (mode, shapes.shafts.as_ref()))?,
            shapes,
            rows: Vec::new(),
        })
    }

    fn curvature(self, at: &Equilibrium, modes: &Modes) -> Result<ModeCurvature, Error> {
        let (mode, slopes) = (self.mode, self.gradient.slopes());
        let (second, asymmetry) = symmetric(&self.rows, at.inputs.len(), Complex::norm);
        let mut first = ModeSensitivity::blank();
        first.set(mode, modes.family, &slopes);
        let (lambda, eigenvalue) = match modes.family {
            Family::Undamped => {
                let lambda = second.combine(&slopes, |_, _, value| value.re);
                let moves = mode.s != Complex::new(0.0, 0.0);
                let eigenvalue = moves.then(|| {
                    let ds = slopes.map(|value| eigenvalue_slope(mode.s, value.re));
                    lambda.combine(&ds, |a, b, value| eigenvalue_curvature(mode.s, a, b, value))
                });
                (lambda, eigenvalue)
            }
            Family::General => {
                let lambda = second.combine(&slopes, |a, b, ab| -2.0 * (a * b + mode.s * ab).re);
                (lambda, Some(second))
            }
        };
        let of_s = eigenvalue.as_ref();
        let finite = lambda.iter().all(|value| value.is_finite())
            && of_s.is_none_or(|of_s| of_s.iter().all(|value| value.is_finite()))
            && first.finite();
        if !finite {
            return Err(outside_domain(at));
        }
        Ok(ModeCurvature {
            mode: self.position,
            s: mode.s,
            first,
            lambda,
            eigenvalue,
            asymmetry,
            description: modes.description.clone(),
        })
    }
}

/// The derivatives of the gradients of undamped modes along several directions, with the products of all matrices and
/// shapes, and the solutions for all directions, formed together.
fn undamped_along(
    modes: &mut [&mut PendingMode<'_>],
    (directions, shift): (&[Direction], &Matrix),
    changes: &[Linear],
) {
    let shapes: Vec<Vector> = modes.iter().map(|pending| pending.mode.real_shape()).collect();
    let n = shapes.first().map_or(0, |shape| shape.len());
    let columns = Matrix::from_fn(n, shapes.len(), |i, r| shapes[r][i]);
    let products = changes.iter().map(|change| {
        let moved = |matrix: &Matrix| {
            f64::run(
                #[inline(always)]
                || times_columns(matrix, &columns),
            )
        };
        [&change.stiffness, &change.mass].map(moved)
    });
    let products: Vec<[Matrix; 2]> = products.collect();
    for (r, (pending, phi)) in modes.iter_mut().zip(&shapes).enumerate() {
        let each = products.iter();
        let each = each.map(|[k, m]| (k.column(r), m.column(r)));
        let each: Vec<(Vector, Vector)> = each.collect();
        let rates = each.iter().map(|(k, m)| dot(phi, k) - pending.mode.lambda * dot(phi, m));
        let rates: Vec<f64> = rates.collect();
        let Some(moved) = pending.shapes.undamped_along(&each, &rates) else {
            continue;
        };
        let rows = pending.gradient.undamped_along((directions, shift), &moved, &rates);
        pending.rows.extend(rows);
    }
}

/// The adjoint gradient of a mode, prepared for differentiation. For an undamped mode `dlambda = n`, where `n` is the
/// total derivative of `a = phi^T (Khat - lambda Mhat) phi` at fixed vectors. For a general mode `ds = -n / d`, where
/// `n` is that of `a = psi^T (s^2 Mhat + s Chat + Khat) phi` and `d = psi^T (2 s Mhat + Chat) phi`.
struct AdjointGradient<'a> {
    mechanism: &'a dyn CurvatureKernels,
    at: &'a Equilibrium,
    family: Family,
    mode: &'a Mode,
    adjoint: Adjoint<'a>,
    /// `Khat^T w = da/dq`: the real part and, for a general mode, the imaginary one.
    w: Vec<Vector>,
    /// `n`.
    numerator: Slopes<Complex>,
    /// `d`.
    denominator: Complex,
    /// Second derivatives of `a` by the numbers of shafts.
    of_shafts: Option<Matrix<Complex>>,
}

impl<'a> AdjointGradient<'a> {
    fn new(
        mechanism: &'a dyn CurvatureKernels,
        at: &'a Equilibrium,
        family: Family,
        (mode, shafts): (&'a Mode, Option<&ShaftsAlong<'_>>),
    ) -> Result<Self, Error> {
        let adjoint = Adjoint::new(mechanism, at)?;
        let kernels: &dyn Kernels = mechanism;
        let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
        let [mut total, mut room] = gradients(kernels);
        match family {
            Family::Undamped => {
                let phi = mode.real_shape();
                kernels.mode_gradient_into(q, u, b, &phi, mode.lambda, &mut total[0]);
            }
            Family::General => {
                form_gradient(kernels, at, &form(mode), &mut room, &mut total);
            }
        }
        let w = total[..parts(family)].iter_mut().map(|part| adjoint.total(part, &mut room[0])).collect();
        let (mut numerator, mut denominator) = (joined(&total), normaliser(at, None, mode));
        if let Some(own) = shafts {
            let form = |matrix: &Matrix<Complex>| own.form(matrix, mode.left(), &mode.shape);
            denominator += form(&own.slope);
            numerator.iter_mut().zip(&own.by).for_each(|(n, [by, _])| *n += form(by));
        }
        Ok(Self {
            mechanism,
            at,
            family,
            mode,
            adjoint,
            w,
            numerator,
            denominator,
            of_shafts: shafts.map(|own| own.second(mode.left(), &mode.shape)),
        })
    }

    /// First derivatives: of `lambda` for an undamped mode, of `s` for a general one.
    fn slopes(&self) -> Slopes<Complex> {
        match self.family {
            Family::Undamped => self.numerator.clone(),
            Family::General => self.numerator.map(|value| -value / self.denominator),
        }
    }

    /// The derivatives of [`Self::slopes`] of an undamped mode along directions, along which its shape and its `lambda`
    /// move as given.
    fn undamped_along(
        &self,
        (directions, shift): (&[Direction], &Matrix),
        moved: &[Vector],
        rates: &[f64],
    ) -> Vec<Slopes<Complex>> {
        let (mechanism, at, mode) = (self.mechanism, self.at, self.mode);
        let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
        let phi = mode.real_shape();
        let along = directions.iter().zip(moved).zip(rates).map(|((direction, dphi), rate)| {
            let [dq, du, db] = direction.parts();
            [dq, du, db, dphi, slice::from_ref(rate)]
        });
        let along: Vec<[&[f64]; 5]> = along.collect();
        let zeros = || vec![Gradient::zeros(mechanism.sizes()); along.len()];
        let (mut changes, mut room) = (zeros(), zeros());
        let here: [&[f64]; 5] = [q, u, b, &phi, &[mode.lambda]];
        let points: Vec<[&[&[f64]]; 2]> = along.iter().map(|along| [&here[..], along]).collect();
        mechanism.evaluate_curvature_each(Curvature::ModeGradient, &points, &mut changes);
        for w in &self.w {
            self.adjoint.total_along_each(&mut changes, w, directions, (shift, &mut room));
        }
        let slopes = |change: Gradient| Slopes {
            by_input: change.inputs.iter().map(|input| (*input).into()).collect(),
            by_design: change.design.iter().map(|value| (*value).into()).collect(),
        };
        changes.into_iter().map(slopes).collect()
    }

    /// The derivatives of [`Self::slopes`] of a general mode along directions, from the first given one on, along which the
    /// matrices change as given.
    fn along(
        &self,
        (directions, shift): (&[Direction], &Matrix),
        (first, changes): (usize, &[Linear]),
        shapes: &Shapes<'_>,
    ) -> Vec<Slopes<Complex>> {
        let (mechanism, mode) = (self.mechanism, self.mode);
        let mut of_shafts = Vec::new();
        let (ratios, moved): (Vec<Complex>, Vec<(&Direction, BilinearForm)>) = directions
            .iter()
            .zip(changes)
            .enumerate()
            .map(|(k, (direction, change))| {
                let variable = first + k;
                let rate = shapes.rate_along(variable, change);
                let (dphi, dpsi) = shapes.along(variable, change, rate);
                let mut denominator = self.denominator_along(change, rate, &dphi, &dpsi);
                if let Some(own) = &shapes.shafts {
                    let (phi, psi) = (&mode.shape[..], mode.left());
                    let moves = |matrix: &Matrix<Complex>| own.form(matrix, &dpsi, phi) + own.form(matrix, psi, &dphi);
                    denominator += moves(&own.slope)
                        + rate * own.form(&own.curvature, psi, phi)
                        + own.form(&own.by[variable][1], psi, phi);
                    let each = own.by.iter().map(|[by, mixed]| moves(by) + rate * own.form(mixed, psi, phi));
                    of_shafts.push(each.collect::<Vec<Complex>>());
                }
                let ratio = denominator / self.denominator;
                (ratio, (direction, BilinearForm::along(mode, &dpsi, rate, &dphi)))
            })
            .unzip();
        let mut totals = form_gradients_along(mechanism, self.at, &form(mode), &moved);
        let mut room = vec![Gradient::zeros(mechanism.sizes()); directions.len()];
        for (changes, w) in totals.iter_mut().zip(&self.w) {
            self.adjoint.total_along_each(changes, w, directions, (shift, &mut room));
        }
        let [re, im] = totals;
        let each = re.into_iter().zip(im).zip(ratios).enumerate();
        each.map(|(k, ((re, im), ratio))| {
            let mut slopes = joined(&[re, im]);
            if let (Some(second), Some(own)) = (&self.of_shafts, of_shafts.get(k)) {
                let all = slopes.iter_mut().zip(&second[first + k]).zip(own);
                all.for_each(|((dn, second), own)| *dn += second + own);
            }
            for (dn, n) in slopes.iter_mut().zip(self.numerator.iter()) {
                *dn = (ratio * n - *dn) / self.denominator;
            }
            slopes
        })
        .collect()
    }

    /// Derivative of `d` when the matrices change by `change`, the eigenvalue by `ds` and the shapes by `dphi` and
    /// `dpsi`.
    fn denominator_along(&self, change: &Linear, ds: Complex, dphi: &[Complex], dpsi: &[Complex]) -> Complex {
        let linear = &self.at.linear;
        let (s, phi, psi) = (self.mode.s, &self.mode.shape, self.mode.left());
        dot_complex(dpsi, &pencil_slope_times(linear, s, phi))
            + dot_complex(psi, &pencil_slope_times(linear, s, dphi))
            + 2.0 * ds * dot_complex(psi, &times_complex(&linear.mass, phi))
            + dot_complex(psi, &pencil_slope_times(change, s, phi))
    }
}

fn form(mode: &Mode) -> BilinearForm {
    BilinearForm::of(mode.left(), mode.s, &mode.shape)
}

/// Buffers for the gradients of two complex numbers.
fn gradients(kernels: &(impl Kernels + ?Sized)) -> [ComplexGradient; 2] {
    [(); 2].map(|()| [(); 2].map(|()| Gradient::zeros(kernels.sizes())))
}

/// Combines real and imaginary parts into derivatives with respect to inputs and design variables.
pub(crate) fn joined([re, im]: &ComplexGradient) -> Slopes<Complex> {
    let join = |re: &Vector, im: &Vector| re.iter().zip(im).map(|(&re, &im)| Complex { re, im }).collect();
    Slopes { by_input: join(&re.inputs, &im.inputs), by_design: join(&re.design, &im.design) }
}

/// Number of real components of an eigenvalue.
fn parts(family: Family) -> usize {
    match family {
        Family::Undamped => 1,
        Family::General => 2,
    }
}
