//! The quadratic pencil `s^2 Mhat + s Chat + Khat` between complex vectors, evaluated with the real kernels.
//!
//! # Complex modes, real kernels
//!
//! `psi^T (s^2 Mhat + s Chat + Khat) phi` is bilinear, so four calls of a real kernel (`pencil_gradient`) give its
//! complex gradient. Generated code needs no complex numbers.

use core::mem::take;

use crate::algebra::{Values, Vector};
use crate::kernels::{Curvature, CurvatureKernels, DirectionalKernels, Gradient, Kernels, Linear};
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

fn products(real: bool) -> &'static [(Part, Part)] {
    if real { &PRODUCTS[..1] } else { &PRODUCTS }
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

/// Gradient of a form with respect to coordinates, inputs and design variables, its vectors held fixed. `room` is scratch
/// space.
pub fn form_gradient(
    mechanism: &dyn Kernels,
    at: &Equilibrium,
    form: &BilinearForm,
    [first, second]: &mut ComplexGradient,
    [re, im]: &mut ComplexGradient,
) {
    let real = form.is_real();
    let vectors: Vec<_> = products(real).iter().map(|&(left, others)| form.parts(left, others)).collect();
    let into = &mut [&mut *re, first, &mut *im, second][..vectors.len()];
    mechanism.pencil_gradients_into(&at.coordinates, &at.inputs, &at.design, &vectors, into);
    if real {
        each(im, re, |im, _| *im = 0.0);
    } else {
        combine(re, first, im, second);
    }
}

fn combine(re: &mut Gradient, first: &Gradient, im: &mut Gradient, second: &Gradient) {
    subtract(re, first);
    each(im, second, |im, product| *im += product);
}

/// Derivatives of [`form_gradient`] along several directions, along each of which the vectors of the form change in their
/// own way: of the real parts, and of the imaginary parts.
pub fn form_gradients_along(
    mechanism: &dyn CurvatureKernels,
    at: &Equilibrium,
    form: &BilinearForm,
    along: &[(&Direction, BilinearForm)],
) -> [Vec<Gradient>; 2] {
    let products = products(form.is_real() && along.iter().all(|(_, change)| change.is_real()));
    let points = along.iter().flat_map(|(direction, change)| {
        products.iter().map(|&(left, others)| {
            let lists = |[q, u, b]: [_; 3], [l, a, v, x]: [_; 4]| -> [&[f64]; 7] { [q, u, b, l, a, v, x] };
            let here: [&[f64]; 3] = [&at.coordinates, &at.inputs, &at.design];
            [lists(here, form.parts(left, others)), lists(direction.parts(), change.parts(left, others))]
        })
    });
    let points: Vec<[[&[f64]; 7]; 2]> = points.collect();
    let points: Vec<[&[&[f64]]; 2]> = points.iter().map(|lists| lists.each_ref().map(|lists| &lists[..])).collect();
    let mut gradients = vec![Gradient::zeros(mechanism.sizes()); points.len()];
    mechanism.evaluate_curvature_each(Curvature::PencilGradient, &points, &mut gradients);
    let both = gradients.chunks_exact_mut(products.len()).map(|own| match own {
        [re, first, im, second] => {
            combine(re, first, im, second);
            (take(re), take(im))
        }
        own => (take(&mut own[0]), Gradient::zeros(mechanism.sizes())),
    });
    both.unzip().into()
}
