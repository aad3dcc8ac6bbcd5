//! The quadratic pencil `s^2 Mhat + s Chat + Khat` between complex vectors, evaluated with the real kernels.
//!
//! # Complex modes, real kernels
//!
//! `psi^T (s^2 Mhat + s Chat + Khat) phi` is bilinear, so four calls of a real kernel (`pencil_gradient`) give its
//! complex gradient. Generated code needs no complex numbers.

use crate::algebra::{Values, Vector};
use crate::kernels::{CurvatureKernels, DirectionalKernels, Gradient, Kernels, Linear};
use crate::{Complex, Equilibrium, Mode};

/// The bilinear form `left^T (Mhat acceleration + Chat velocity + Khat position)`: real and imaginary parts of its four
/// vectors, in this order.
#[doc(hidden)]
pub struct BilinearForm {
    re: [Vector; 4],
    im: [Vector; 4],
}

/// Selects the real or the imaginary part of a form.
type Part = fn(&BilinearForm) -> &[Vector; 4];
const RE: Part = |form| &form.re;
const IM: Part = |form| &form.im;

impl BilinearForm {
    /// `psi^T (s^2 Mhat + s Chat + Khat) phi`.
    #[doc(hidden)]
    pub fn of(left: &[Complex], s: Complex, right: &[Complex]) -> Self {
        let acceleration = right.map(|value| s * s * value);
        let velocity = right.map(|value| s * value);
        Self::new([left, &acceleration, &velocity, right])
    }

    /// How the form of a mode changes with its vectors and its eigenvalue.
    #[doc(hidden)]
    pub fn along(mode: &Mode, dleft: &[Complex], ds: Complex, dright: &[Complex]) -> Self {
        let (s, right) = (mode.s, &mode.shape);
        let n = right.len();
        let acceleration = Vector::from_fn(n, |i| s * (2.0 * ds * right[i] + s * dright[i]));
        let velocity = Vector::from_fn(n, |i| ds * right[i] + s * dright[i]);
        Self::new([dleft, &acceleration, &velocity, dright])
    }

    /// Of the left vector, acceleration, velocity and position.
    #[doc(hidden)]
    pub fn new(vectors: [&[Complex]; 4]) -> Self {
        Self {
            re: vectors.map(|vector| vector.map(|value| value.re)),
            im: vectors.map(|vector| vector.map(|value| value.im)),
        }
    }

    fn is_real(&self) -> bool {
        self.im.iter().flatten().all(|value| *value == 0.0)
    }

    /// The left vector from one part and the other vectors from another, as kernels take them.
    fn parts(&self, left: Part, others: Part) -> [&[f64]; 4] {
        let ([left, ..], [_, acceleration, velocity, position]) = (left(self), others(self));
        [left, acceleration, velocity, position]
    }
}

/// A direction in coordinates, inputs and design variables.
#[doc(hidden)]
pub struct Direction {
    #[doc(hidden)]
    pub coordinates: Vector,
    #[doc(hidden)]
    pub inputs: Vector,
    #[doc(hidden)]
    pub design: Vector,
}

impl Direction {
    #[doc(hidden)]
    pub fn parts(&self) -> [&[f64]; 3] {
        [&self.coordinates, &self.inputs, &self.design]
    }

    /// Total derivatives of the linearised matrices along this direction.
    #[doc(hidden)]
    pub fn linear(&self, mechanism: &dyn DirectionalKernels, at: &Equilibrium) -> Linear {
        mechanism.linear_along(&at.coordinates, &at.inputs, &at.design, self.parts())
    }
}

/// The gradients of the real and the imaginary part of a complex number.
pub type ComplexGradient = [Gradient; 2];

/// Which parts of the left vector and of the others the products are of that make up a complex form: the first less the
/// second is its real part, the third and the fourth together its imaginary part.
const PRODUCTS: [(Part, Part); 4] = [(RE, RE), (IM, IM), (RE, IM), (IM, RE)];

/// A complex gradient from real ones: `products(which, into)` computes those of [`PRODUCTS`]. `room` is scratch space.
fn complex(
    [re, im]: &mut ComplexGradient,
    [first, second]: &mut ComplexGradient,
    real: bool,
    products: impl FnOnce(&[(Part, Part)], &mut [&mut Gradient]),
) {
    if real {
        products(&PRODUCTS[..1], &mut [re]);
        each(im, re, |im, _| *im = 0.0);
        return;
    }
    products(&PRODUCTS, &mut [re, first, im, second]);
    subtract(re, first);
    each(im, second, |im, product| *im += product);
}

/// Subtracts every component.
pub fn subtract(from: &mut Gradient, gradient: &Gradient) {
    each(from, gradient, |from, value| *from -= value);
}

fn each(to: &mut Gradient, from: &Gradient, f: impl Fn(&mut f64, f64)) {
    for (to, from) in
        [(&mut to.coordinates, &from.coordinates), (&mut to.inputs, &from.inputs), (&mut to.design, &from.design)]
    {
        for (to, from) in to.iter_mut().zip(from) {
            f(to, *from);
        }
    }
}

/// Gradient of a form with respect to coordinates, inputs and design variables, its vectors held fixed.
pub fn form_gradient(
    mechanism: &dyn Kernels,
    at: &Equilibrium,
    form: &BilinearForm,
    room: &mut ComplexGradient,
    gradient: &mut ComplexGradient,
) {
    let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
    complex(gradient, room, form.is_real(), |products, into| {
        let vectors: Vec<_> = products.iter().map(|&(left, others)| form.parts(left, others)).collect();
        mechanism.pencil_gradients_into(q, u, b, &vectors, into);
    });
}

/// Derivative of [`form_gradient`] along a direction in which the vectors of the form move by `change`.
pub fn form_gradient_along(
    mechanism: &dyn CurvatureKernels,
    at: &Equilibrium,
    (form, change): (&BilinearForm, &BilinearForm),
    along: &Direction,
    room: &mut ComplexGradient,
    gradient: &mut ComplexGradient,
) {
    let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
    let real = form.is_real() && change.is_real();
    complex(gradient, room, real, |products, into| {
        for (&(left, others), gradient) in products.iter().zip(into) {
            let (vectors, changes) = (form.parts(left, others), change.parts(left, others));
            mechanism.pencil_gradient_along_into(q, u, b, vectors, along.parts(), changes, gradient);
        }
    });
}
