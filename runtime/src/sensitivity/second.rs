//! Exact second total derivatives of a mode, by differentiating its adjoint gradient along the motion of the equilibrium,
//! of the shapes and of the eigenvalue with each variable: as many gradient evaluations as there are variables.

use super::adjoint::normaliser;
use super::pencil::{
    Direction, Form, form_gradient, form_gradient_along, residual_gradient, residual_gradient_along,
};
use super::quantity::{eigenvalue_curvature, eigenvalue_slope};
use super::shapes::Shapes;
use super::shift::{directions, outside_domain};
use super::{ModeSensitivity, Quantity, Slopes};
use crate::array::{Lu, dot_complex, times_complex, transpose};
use crate::modes::Family;
use crate::pencil::pencil_slope_times;
use crate::{Complex, Description, Equilibrium, Error, Linear, Mechanism, Mode, Modes};

/// Second derivatives of one number, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SecondDerivatives<T, const U: usize, const P: usize> {
    /// By two inputs.
    pub by_input: [[T; U]; U],
    /// `by_input_and_design[i][j]`: by input `i` and design variable `j`.
    pub by_input_and_design: [[T; P]; U],
    /// By two design variables: the Hessian.
    pub by_design: [[T; P]; P],
}

/// First and second total derivatives of one mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeCurvature<const U: usize, const P: usize> {
    /// Position of the mode.
    pub mode: usize,
    /// Its eigenvalue, 1/s.
    pub s: Complex,
    /// First derivatives, from the same gradients.
    pub first: ModeSensitivity<U, P>,
    /// Of `lambda = -Re s^2`.
    pub lambda: SecondDerivatives<f64, U, P>,
    /// Of `s`; `None` for an undamped neutral mode.
    pub eigenvalue: Option<SecondDerivatives<Complex, U, P>>,
    /// Greatest difference of mirrored second derivatives before they were averaged, relative to the greatest: exact
    /// arithmetic would give zero.
    pub asymmetry: f64,
    /// The mechanism it belongs to.
    pub description: &'static Description,
}

impl<const U: usize, const P: usize> ModeCurvature<U, P> {
    /// Second derivatives of a quantity of the mode; `None` where it has none.
    pub fn of(&self, quantity: Quantity) -> Option<SecondDerivatives<f64, U, P>> {
        self.first.of(quantity)?;
        let (first, second, s) = (self.first.s?, self.eigenvalue?, self.s);
        let curvature = |a, b, ab| quantity.curvature(s, a, b, ab);
        Some(second.combine(&first, curvature))
    }
}

impl<T: Copy, const U: usize, const P: usize> SecondDerivatives<T, U, P> {
    /// Element by element with the two first derivatives it belongs to.
    fn combine<F: Copy, R>(
        &self,
        first: &Slopes<F, U, P>,
        f: impl Fn(F, F, T) -> R,
    ) -> SecondDerivatives<R, U, P> {
        fn block<T: Copy, F: Copy, R, const A: usize, const B: usize>(
            matrix: &[[T; B]; A],
            rows: &[F; A],
            columns: &[F; B],
            f: impl Fn(F, F, T) -> R,
        ) -> [[R; B]; A] {
            core::array::from_fn(|i| core::array::from_fn(|j| f(rows[i], columns[j], matrix[i][j])))
        }
        let (inputs, design) = (&first.by_input, &first.by_design);
        SecondDerivatives {
            by_input: block(&self.by_input, inputs, inputs, &f),
            by_input_and_design: block(&self.by_input_and_design, inputs, design, &f),
            by_design: block(&self.by_design, design, design, &f),
        }
    }
}

/// First and second total derivatives of mode number `mode` by all inputs and design variables.
///
/// # Errors
/// [`Error::ClusteredMode`] where the mode has (nearly) equal neighbours, [`Error::CriticalState`] when `Khat` is
/// singular, [`Error::OutsideDomain`] when a derivative is not finite, [`Error::NoSuchMode`].
pub fn mode_curvature<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
    mode: usize,
) -> Result<ModeCurvature<U, P>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    let position = mode;
    let (first, rows) = match modes.family {
        Family::Undamped => undamped_rows(mechanism, at, modes, position)?,
        Family::General => general_rows(mechanism, at, modes, position)?,
    };
    let mode = &modes.modes[position];
    let (second, asymmetry) = symmetric(&rows);
    let (first, lambda, eigenvalue) = match modes.family {
        Family::Undamped => {
            let real = first.map(|value| value.re);
            let lambda = second.combine(&first, |_, _, value| value.re);
            let moves = mode.s != Complex::new(0.0, 0.0);
            let eigenvalue = moves.then(|| {
                let ds = first.map(|value| eigenvalue_slope(mode.s, value.re));
                lambda.combine(&ds, |a, b, value| eigenvalue_curvature(mode.s, a, b, value))
            });
            let first = ModeSensitivity::from_lambda(mode, real, false);
            (first, lambda, eigenvalue)
        }
        Family::General => {
            let lambda = second.combine(&first, |a, b, ab| -2.0 * (a * b + mode.s * ab).re);
            let first = ModeSensitivity::from_eigenvalue(mode, first, false);
            (first, lambda, Some(second))
        }
    };
    let result = ModeCurvature {
        mode: position,
        s: mode.s,
        first,
        lambda,
        eigenvalue,
        asymmetry,
        description: modes.description,
    };
    let second = result.lambda.by_design.iter().flatten();
    let mixed = result.lambda.by_input_and_design.iter().flatten();
    let inputs = result.lambda.by_input.iter().flatten();
    let mut all = second.chain(mixed).chain(inputs);
    let of_s = result.eigenvalue.as_ref().is_none_or(|of_s| {
        let mixed = of_s.by_input_and_design.iter().flatten();
        let all = of_s.by_design.iter().flatten().chain(mixed);
        let mut all = all.chain(of_s.by_input.iter().flatten());
        all.all(|value| value.is_finite())
    });
    if all.all(|value| value.is_finite()) && of_s && result.first.finite() {
        Ok(result)
    } else {
        Err(outside_domain(at))
    }
}

/// The first derivatives of an eigenvalue, and how they move with each variable. In functions of their own, so that what one
/// family needs does not lie on the stack of the other.
type Rows<const U: usize, const P: usize> = (Slopes<Complex, U, P>, Vec<Slopes<Complex, U, P>>);

#[inline(never)]
fn undamped_rows<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
    position: usize,
) -> Result<Rows<U, P>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    let shapes = Shapes::new(at, modes, position)?;
    let factors = Lu::new(&transpose(&at.linear.stiffness)).ok_or(Error::CriticalState)?;
    let gradient = Undamped::new(mechanism, at, &factors, &modes.modes[position]);
    let along = |direction: Direction<N, U, P>| {
        let change = direction.linear(mechanism, at);
        let rate = (shapes.rate)(&change);
        let (dphi, _) = shapes.along(&change, rate);
        gradient.along(&direction, rate.re, &dphi.map(|value| value.re))
    };
    let rows = directions(mechanism, at)?.map(along).collect();
    Ok((gradient.total(), rows))
}

#[inline(never)]
fn general_rows<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
    position: usize,
) -> Result<Rows<U, P>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    let shapes = Shapes::new(at, modes, position)?;
    let factors = Lu::new(&transpose(&at.linear.stiffness)).ok_or(Error::CriticalState)?;
    let gradient = General::new(mechanism, at, &factors, &modes.modes[position]);
    let along = |direction: Direction<N, U, P>| {
        let change = direction.linear(mechanism, at);
        let rate = (shapes.rate)(&change);
        gradient.along(&direction, &change, rate, shapes.along(&change, rate))
    };
    let rows = directions(mechanism, at)?.map(along).collect();
    Ok((gradient.total(), rows))
}

/// The adjoint gradient of an undamped mode, ready to be differentiated.
struct Undamped<'a, M, const N: usize, const U: usize, const P: usize> {
    mechanism: &'a M,
    at: &'a Equilibrium<N, U, P>,
    factors: &'a Lu<f64, N>,
    phi: [f64; N],
    lambda: f64,
    /// `Khat^T w = da/dq`.
    w: [f64; N],
    total: Slopes<Complex, U, P>,
}

impl<'a, M, const N: usize, const U: usize, const P: usize> Undamped<'a, M, N, U, P> {
    fn new<const O: usize>(
        mechanism: &'a M,
        at: &'a Equilibrium<N, U, P>,
        factors: &'a Lu<f64, N>,
        mode: &Mode<N>,
    ) -> Self
    where
        M: Mechanism<N, U, P, O>,
    {
        let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
        let (phi, lambda) = (mode.real_shape(), mode.lambda);
        let direct = mechanism.mode_gradient(q, u, b, &phi, lambda);
        let w = factors.solve(&direct.coordinates);
        let shift = mechanism.residual_gradient(q, u, b, &w);
        let total = Slopes {
            by_input: core::array::from_fn(|j| (direct.inputs[j] - shift.inputs[j]).into()),
            by_design: core::array::from_fn(|j| (direct.design[j] - shift.design[j]).into()),
        };
        Self {
            mechanism,
            at,
            factors,
            phi,
            lambda,
            w,
            total,
        }
    }

    fn total(&self) -> Slopes<Complex, U, P> {
        self.total
    }

    /// Its derivative along a direction in which the eigenvalue moves by `dlambda` and the shape by `dphi`.
    fn along<const O: usize>(
        &self,
        direction: &Direction<N, U, P>,
        dlambda: f64,
        dphi: &[f64; N],
    ) -> Slopes<Complex, U, P>
    where
        M: Mechanism<N, U, P, O>,
    {
        let (q, u, b) = (&self.at.coordinates, &self.at.inputs, &self.at.design);
        let Direction {
            coordinates: dq,
            inputs: du,
            design: db,
        } = direction;
        let direct = self.mechanism.mode_gradient_along(
            q,
            u,
            b,
            &self.phi,
            self.lambda,
            dq,
            du,
            db,
            dphi,
            dlambda,
        );
        let still = self
            .mechanism
            .residual_gradient_along(q, u, b, &self.w, dq, du, db, &[0.0; N]);
        let dw = self.factors.solve(&core::array::from_fn(|i| {
            direct.coordinates[i] - still.coordinates[i]
        }));
        let moved = self.mechanism.residual_gradient(q, u, b, &dw);
        Slopes {
            by_input: core::array::from_fn(|j| {
                (direct.inputs[j] - still.inputs[j] - moved.inputs[j]).into()
            }),
            by_design: core::array::from_fn(|j| {
                (direct.design[j] - still.design[j] - moved.design[j]).into()
            }),
        }
    }
}

/// The adjoint gradient of a general mode: `ds = -n / d` with `n` the total derivative of the form at fixed vectors and
/// `d = psi^T (2 s Mhat + Chat) phi`.
struct General<'a, M, const N: usize, const U: usize, const P: usize> {
    mechanism: &'a M,
    at: &'a Equilibrium<N, U, P>,
    factors: &'a Lu<f64, N>,
    mode: &'a Mode<N>,
    form: Form<N>,
    w: [Complex; N],
    numerator: Slopes<Complex, U, P>,
    denominator: Complex,
}

impl<'a, M, const N: usize, const U: usize, const P: usize> General<'a, M, N, U, P> {
    fn new<const O: usize>(
        mechanism: &'a M,
        at: &'a Equilibrium<N, U, P>,
        factors: &'a Lu<f64, N>,
        mode: &'a Mode<N>,
    ) -> Self
    where
        M: Mechanism<N, U, P, O>,
    {
        let form = Form::of(&mode.left, mode.s, &mode.shape);
        let direct = form_gradient(mechanism, at, &form);
        let w = factors.solve_complex(&direct.coordinates);
        let shift = residual_gradient(mechanism, at, &w);
        let numerator = Slopes {
            by_input: core::array::from_fn(|j| direct.inputs[j] - shift.inputs[j]),
            by_design: core::array::from_fn(|j| direct.design[j] - shift.design[j]),
        };
        Self {
            mechanism,
            at,
            factors,
            mode,
            form,
            w,
            numerator,
            denominator: normaliser(at, mode),
        }
    }

    fn total(&self) -> Slopes<Complex, U, P> {
        self.numerator.map(|value| -value / self.denominator)
    }

    /// Its derivative along a direction in which the matrices move by `change`, the eigenvalue by `ds` and the shapes by
    /// `(dphi, dpsi)`.
    fn along<const O: usize>(
        &self,
        direction: &Direction<N, U, P>,
        change: &Linear<f64, N>,
        ds: Complex,
        (dphi, dpsi): ([Complex; N], [Complex; N]),
    ) -> Slopes<Complex, U, P>
    where
        M: Mechanism<N, U, P, O>,
    {
        let Self {
            mechanism,
            at,
            mode,
            form,
            w,
            ..
        } = self;
        let moved_form = Form::along(mode, &dpsi, ds, &dphi);
        let direct = form_gradient_along(*mechanism, at, form, direction, &moved_form);
        let fixed = [Complex::default(); N];
        let still = residual_gradient_along(*mechanism, at, w, direction, &fixed);
        let dw = self.factors.solve_complex(&core::array::from_fn(|i| {
            direct.coordinates[i] - still.coordinates[i]
        }));
        let moved = residual_gradient(*mechanism, at, &dw);
        let (s, phi, psi) = (mode.s, &mode.shape, &mode.left);
        let slope = |shape| pencil_slope_times(&at.linear, s, shape);
        let ddenominator = dot_complex(&dpsi, &slope(phi))
            + dot_complex(psi, &slope(&dphi))
            + 2.0 * ds * dot_complex(psi, &times_complex(&at.linear.mass, phi))
            + dot_complex(psi, &pencil_slope_times(change, s, phi));
        let ratio = ddenominator / self.denominator;
        let quotient = |dn: Complex, n: Complex| (ratio * n - dn) / self.denominator;
        Slopes {
            by_input: core::array::from_fn(|j| {
                quotient(
                    direct.inputs[j] - still.inputs[j] - moved.inputs[j],
                    self.numerator.by_input[j],
                )
            }),
            by_design: core::array::from_fn(|j| {
                quotient(
                    direct.design[j] - still.design[j] - moved.design[j],
                    self.numerator.by_design[j],
                )
            }),
        }
    }
}

/// The mean of mirrored elements, and how far they differ relative to the greatest.
fn symmetric<const U: usize, const P: usize>(
    rows: &[Slopes<Complex, U, P>],
) -> (SecondDerivatives<Complex, U, P>, f64) {
    let element = |i: usize, j: usize| {
        if j < U {
            rows[i].by_input[j]
        } else {
            rows[i].by_design[j - U]
        }
    };
    let mean = |i: usize, j: usize| 0.5 * (element(i, j) + element(j, i));
    let (mut most, mut difference) = (0.0_f64, 0.0_f64);
    for i in 0..U + P {
        for j in 0..=i {
            most = most.max(element(i, j).norm());
            difference = difference.max((element(i, j) - element(j, i)).norm());
        }
    }
    let second = SecondDerivatives {
        by_input: core::array::from_fn(|i| core::array::from_fn(|j| mean(i, j))),
        by_input_and_design: core::array::from_fn(|i| core::array::from_fn(|j| mean(i, U + j))),
        by_design: core::array::from_fn(|i| core::array::from_fn(|j| mean(U + i, U + j))),
    };
    (second, if most > 0.0 { difference / most } else { 0.0 })
}
