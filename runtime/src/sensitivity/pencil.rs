//! The quadratic pencil `s^2 Mhat + s Chat + Khat` between complex vectors, by the real kernels.

use crate::{Complex, Equilibrium, Gradient, Linear, Mechanism, Mode};

/// The bilinear form `left^T (Mhat acceleration + Chat velocity + Khat position)`.
#[derive(Clone, Copy)]
pub(super) struct Form<const N: usize> {
    pub(super) left: [Complex; N],
    pub(super) acceleration: [Complex; N],
    pub(super) velocity: [Complex; N],
    pub(super) position: [Complex; N],
}

impl<const N: usize> Form<N> {
    /// `psi^T (s^2 Mhat + s Chat + Khat) phi`.
    pub(super) fn of(left: &[Complex; N], s: Complex, right: &[Complex; N]) -> Self {
        Self {
            left: *left,
            acceleration: right.map(|value| s * s * value),
            velocity: right.map(|value| s * value),
            position: *right,
        }
    }

    /// How the form of a mode changes with its vectors and its eigenvalue.
    pub(super) fn along(
        mode: &Mode<N>,
        dleft: &[Complex; N],
        ds: Complex,
        dright: &[Complex; N],
    ) -> Self {
        let (s, right) = (mode.s, &mode.shape);
        Self {
            left: *dleft,
            acceleration: core::array::from_fn(|i| s * (2.0 * ds * right[i] + s * dright[i])),
            velocity: core::array::from_fn(|i| ds * right[i] + s * dright[i]),
            position: *dright,
        }
    }

    fn is_real(&self) -> bool {
        let Self {
            left,
            acceleration,
            velocity,
            position,
        } = self;
        let all = [left, acceleration, velocity, position];
        all.into_iter().flatten().all(|value| value.im == 0.0)
    }

    /// Real or imaginary parts: left, acceleration, velocity, position.
    fn part(&self, pick: fn(&Complex) -> f64) -> [[f64; N]; 4] {
        [self.left, self.acceleration, self.velocity, self.position]
            .map(|vector| vector.map(|value| pick(&value)))
    }
}

const RE: fn(&Complex) -> f64 = |value| value.re;
const IM: fn(&Complex) -> f64 = |value| value.im;

/// A direction in coordinates, inputs and design variables.
#[derive(Clone, Copy)]
pub(super) struct Direction<const N: usize, const U: usize, const P: usize> {
    pub(super) coordinates: [f64; N],
    pub(super) inputs: [f64; U],
    pub(super) design: [f64; P],
}

impl<const N: usize, const U: usize, const P: usize> Direction<N, U, P> {
    /// Total derivatives of the linearised matrices along it.
    pub(super) fn linear<M, const O: usize>(
        &self,
        mechanism: &M,
        at: &Equilibrium<N, U, P>,
    ) -> Linear<f64, N>
    where
        M: Mechanism<N, U, P, O>,
    {
        mechanism.linear_along(
            &at.coordinates,
            &at.inputs,
            &at.design,
            &self.coordinates,
            &self.inputs,
            &self.design,
        )
    }
}

type ComplexGradient<const N: usize, const U: usize, const P: usize> = Gradient<Complex, N, U, P>;

/// A complex gradient from real kernel calls; `call(w, z)` is real-linear in the parts it is given.
fn complex<const N: usize, const U: usize, const P: usize>(
    real: bool,
    call: impl Fn(fn(&Complex) -> f64, fn(&Complex) -> f64) -> Gradient<f64, N, U, P>,
) -> ComplexGradient<N, U, P> {
    let zero = || Gradient {
        coordinates: [0.0; N],
        inputs: [0.0; U],
        design: [0.0; P],
    };
    let (rr, ii, ri, ir) = if real {
        (call(RE, RE), zero(), zero(), zero())
    } else {
        (call(RE, RE), call(IM, IM), call(RE, IM), call(IM, RE))
    };
    fn join<const K: usize>(parts: [&[f64; K]; 4]) -> [Complex; K] {
        let [rr, ii, ri, ir] = parts;
        core::array::from_fn(|k| Complex::new(rr[k] - ii[k], ri[k] + ir[k]))
    }
    Gradient {
        coordinates: join([
            &rr.coordinates,
            &ii.coordinates,
            &ri.coordinates,
            &ir.coordinates,
        ]),
        inputs: join([&rr.inputs, &ii.inputs, &ri.inputs, &ir.inputs]),
        design: join([&rr.design, &ii.design, &ri.design, &ir.design]),
    }
}

/// Gradient of a form by coordinates, inputs and design variables, its vectors held fixed.
pub(super) fn form_gradient<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    form: &Form<N>,
) -> ComplexGradient<N, U, P>
where
    M: Mechanism<N, U, P, O>,
{
    let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
    complex(form.is_real(), |w, z| {
        let ([left, ..], [_, acceleration, velocity, position]) = (form.part(w), form.part(z));
        mechanism.pencil_gradient(q, u, b, &left, &acceleration, &velocity, &position)
    })
}

/// Derivative of [`form_gradient`] along a direction in which the vectors of the form move by `change`.
pub(super) fn form_gradient_along<
    M,
    const N: usize,
    const U: usize,
    const P: usize,
    const O: usize,
>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    form: &Form<N>,
    along: &Direction<N, U, P>,
    change: &Form<N>,
) -> ComplexGradient<N, U, P>
where
    M: Mechanism<N, U, P, O>,
{
    let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
    complex(form.is_real() && change.is_real(), |w, z| {
        let ([left, ..], [_, acceleration, velocity, position]) = (form.part(w), form.part(z));
        let ([dleft, ..], [_, dacceleration, dvelocity, dposition]) =
            (change.part(w), change.part(z));
        mechanism.pencil_gradient_along(
            q,
            u,
            b,
            &left,
            &acceleration,
            &velocity,
            &position,
            &along.coordinates,
            &along.inputs,
            &along.design,
            &dleft,
            &dacceleration,
            &dvelocity,
            &dposition,
        )
    })
}

/// Joins the gradients of the real and of the imaginary part.
fn parts<const N: usize, const U: usize, const P: usize>(
    re: &Gradient<f64, N, U, P>,
    im: &Gradient<f64, N, U, P>,
) -> ComplexGradient<N, U, P> {
    fn join<const K: usize>(re: &[f64; K], im: &[f64; K]) -> [Complex; K] {
        core::array::from_fn(|k| Complex::new(re[k], im[k]))
    }
    Gradient {
        coordinates: join(&re.coordinates, &im.coordinates),
        inputs: join(&re.inputs, &im.inputs),
        design: join(&re.design, &im.design),
    }
}

/// Gradient of `w^T g` at rest.
pub(super) fn residual_gradient<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    w: &[Complex; N],
) -> ComplexGradient<N, U, P>
where
    M: Mechanism<N, U, P, O>,
{
    let [re, im] = [RE, IM].map(|pick| {
        let w = w.map(|value| pick(&value));
        mechanism.residual_gradient(&at.coordinates, &at.inputs, &at.design, &w)
    });
    parts(&re, &im)
}

/// Derivative of [`residual_gradient`] along a direction in which `w` moves by `dw`.
pub(super) fn residual_gradient_along<
    M,
    const N: usize,
    const U: usize,
    const P: usize,
    const O: usize,
>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    w: &[Complex; N],
    along: &Direction<N, U, P>,
    dw: &[Complex; N],
) -> ComplexGradient<N, U, P>
where
    M: Mechanism<N, U, P, O>,
{
    let [re, im] = [RE, IM].map(|pick| {
        let (w, dw) = (w.map(|value| pick(&value)), dw.map(|value| pick(&value)));
        mechanism.residual_gradient_along(
            &at.coordinates,
            &at.inputs,
            &at.design,
            &w,
            &along.coordinates,
            &along.inputs,
            &along.design,
            &dw,
        )
    });
    parts(&re, &im)
}
