//! Exact second total derivatives of a mode. Its adjoint gradient is differentiated along the change of the
//! equilibrium, the shapes and the eigenvalue with each variable, so the number of gradient evaluations equals the
//! number of variables.

use super::adjoint::Adjoint;
use super::derivatives::{SecondDerivatives, symmetric};
use crate::algebra::{Vector, dot_complex, times_complex};
use crate::kernels::{CurvatureKernels, Gradient, Kernels, Linear};
use crate::modes::{Family, pencil_slope_times};
use crate::sensitivity::{
    ComplexGradient, Direction, Form, ModeSensitivity, Quantity, Slopes, directions,
    eigenvalue_curvature, eigenvalue_slope, form_gradient, form_gradient_along, normaliser,
    outside_domain,
};
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
    let position = mode;
    if (modes.modes.get(position)).is_some_and(|mode| mode.behaviour == Behaviour::Free) {
        return Ok(ModeCurvature::of_free(at, position));
    }
    let shapes = Shapes::new(at, modes, position)?;
    let mode = &modes.modes[position];
    let gradient = AdjointGradient::new(mechanism, at, modes.family, mode)?;
    let rows: Vec<_> = directions(mechanism, at)?
        .map(|direction| gradient.along(&direction, &shapes))
        .collect();
    let slopes = gradient.slopes();
    let (second, asymmetry) = symmetric(&rows, at.inputs.len(), Complex::norm);
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
        mode: position,
        s: mode.s,
        first,
        lambda,
        eigenvalue,
        asymmetry,
        description: modes.description.clone(),
    })
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
}

impl<'a> AdjointGradient<'a> {
    fn new(
        mechanism: &'a dyn CurvatureKernels,
        at: &'a Equilibrium,
        family: Family,
        mode: &'a Mode,
    ) -> Result<Self, Error> {
        let adjoint = Adjoint::new(mechanism, at)?;
        let kernels: &dyn Kernels = mechanism;
        let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
        let (mut total, mut room) = gradients(kernels);
        match family {
            Family::Undamped => {
                let phi = mode.real_shape();
                kernels.mode_gradient_into(q, u, b, &phi, mode.lambda, &mut total[0]);
            }
            Family::General => {
                form_gradient(kernels, at, &form(mode), &mut room, &mut total);
            }
        }
        let parts = total[..parts(family)].iter_mut();
        let w = parts.map(|part| adjoint.total(part, &mut room)).collect();
        Ok(Self {
            mechanism,
            at,
            family,
            mode,
            adjoint,
            w,
            numerator: joined(&total),
            denominator: normaliser(at, mode),
        })
    }

    /// First derivatives: of `lambda` for an undamped mode, of `s` for a general one.
    fn slopes(&self) -> Slopes<Complex> {
        match self.family {
            Family::Undamped => self.numerator.clone(),
            Family::General => self.numerator.map(|value| -value / self.denominator),
        }
    }

    /// The derivatives of [`Self::slopes`] along a direction.
    fn along(&self, direction: &Direction, shapes: &Shapes<'_>) -> Slopes<Complex> {
        let (mechanism, at, mode) = (self.mechanism, self.at, self.mode);
        let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
        let [dq, du, db] = direction.parts();
        let change = direction.linear(mechanism, at);
        let rate = shapes.rate.along(&change);
        let (dphi, dpsi) = shapes.along(&change, rate);
        let (mut total, mut room) = gradients(mechanism);
        match self.family {
            Family::Undamped => mechanism.mode_gradient_along_into(
                q,
                u,
                b,
                &mode.real_shape(),
                mode.lambda,
                [dq, du, db, &dphi.map(|value| value.re)],
                rate.re,
                &mut total[0],
            ),
            Family::General => {
                let moved = Form::along(mode, &dpsi, rate, &dphi);
                let forms = (&form(mode), &moved);
                form_gradient_along(mechanism, at, forms, direction, &mut room, &mut total);
            }
        }
        for (part, w) in total.iter_mut().zip(&self.w) {
            self.adjoint.total_along(part, w, direction, &mut room);
        }
        let mut slopes = joined(&total);
        if self.family == Family::General {
            let ratio = self.denominator_along(&change, rate, &dphi, &dpsi) / self.denominator;
            let n = &self.numerator;
            let inputs = slopes.by_input.iter_mut().zip(&n.by_input);
            for (dn, n) in inputs.chain(slopes.by_design.iter_mut().zip(&n.by_design)) {
                *dn = (ratio * n - *dn) / self.denominator;
            }
        }
        slopes
    }

    /// Derivative of `d` when the matrices change by `change`, the eigenvalue by `ds` and the shapes by `dphi` and
    /// `dpsi`.
    fn denominator_along(
        &self,
        change: &Linear,
        ds: Complex,
        dphi: &[Complex],
        dpsi: &[Complex],
    ) -> Complex {
        let linear = &self.at.linear;
        let (s, phi, psi) = (self.mode.s, &self.mode.shape, self.mode.left());
        dot_complex(dpsi, &pencil_slope_times(linear, s, phi))
            + dot_complex(psi, &pencil_slope_times(linear, s, dphi))
            + 2.0 * ds * dot_complex(psi, &times_complex(&linear.mass, phi))
            + dot_complex(psi, &pencil_slope_times(change, s, phi))
    }
}

fn form(mode: &Mode) -> Form {
    Form::of(mode.left(), mode.s, &mode.shape)
}

/// Buffers for the gradient of a complex number and one real gradient.
fn gradients(kernels: &(impl Kernels + ?Sized)) -> (ComplexGradient, Gradient) {
    let zeros = || Gradient::zeros(kernels.sizes());
    ([zeros(), zeros()], zeros())
}

/// Combines real and imaginary parts into derivatives with respect to inputs and design variables.
fn joined([re, im]: &ComplexGradient) -> Slopes<Complex> {
    let join = |re: &Vector, im: &Vector| {
        let parts = re.iter().zip(im);
        parts.map(|(&re, &im)| Complex { re, im }).collect()
    };
    Slopes {
        by_input: join(&re.inputs, &im.inputs),
        by_design: join(&re.design, &im.design),
    }
}

/// Number of real components of an eigenvalue.
fn parts(family: Family) -> usize {
    match family {
        Family::Undamped => 1,
        Family::General => 2,
    }
}
