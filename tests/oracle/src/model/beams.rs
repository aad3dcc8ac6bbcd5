//! Flexible bodies: rods whose sections turn by polynomials of the place along them.

use num_dual::DualNum;

use super::joints::Coordinate;
use super::values::Value;

/// A rod. Its mass is that of slices, bodies of the model, each with a flexure for a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Beam {
    /// Declared name.
    pub name: String,
    /// The joint whose steps are its coordinates: those of twist, of bending about the second and the third axis, of
    /// stretch, and of shear along the second and the third axis.
    pub joint: usize,
    /// The number of coordinates of twist and bending.
    pub counts: [usize; 3],
    /// The number of coordinates of stretch and shear.
    pub strains: [usize; 3],
    /// Whether sections shear as the change of the bending moments requires. Only of a straight beam whose sections
    /// couple no strains.
    pub static_shear: bool,
    /// Length.
    pub length: Value,
    /// Perpendicular unit vectors in the frame of its root, the first along the beam.
    pub axes: [[f64; 3]; 3],
    /// How it is curved before it is loaded.
    pub prebend: Prebend,
    /// The sections at the points of quadrature.
    pub sections: Vec<Section>,
    /// Time by which the rate of strain counts like strain.
    pub lag: Value,
    /// A driven coordinate by which its round material turns about its bent axis, beside its sections, which carry what is
    /// attached. The slices have such a coordinate each; this is one of them.
    pub spin: Option<Coordinate>,
}

/// An arc of a circle: the direction of the beam turns evenly about one direction across it.
#[derive(Clone, Debug, PartialEq)]
pub struct Prebend {
    /// The direction about which it turns, along the second and the third axis of the beam; not zero.
    pub about: [f64; 2],
    /// The angles by which it has turned at the root and at the tip. It has at the root if the beam is a part of another.
    pub angles: [Value; 2],
}

/// The elasticity of a section at a point of quadrature.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Its place as a fraction of the length.
    pub place: f64,
    /// Weight of the quadrature; all add up to 1.
    pub weight: f64,
    /// The angle of its axes about the beam before it bends.
    pub twist: Value,
    /// Stiffness against stretch, shear along its two axes, twist, and bending about its two axes: a symmetric matrix.
    pub stiffness: [[Value; 6]; 6],
}

/// The motion from the root of a beam to one of its sections.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flexure {
    /// Index of the beam.
    pub beam: usize,
    /// The section as a fraction of the length.
    pub place: f64,
}

impl Beam {
    /// The number of coordinates.
    pub fn coordinates(&self) -> usize {
        self.counts.iter().chain(&self.strains).sum()
    }

    /// The axis about which all sections turn, if there is only one.
    pub fn plane(&self) -> Option<usize> {
        let mut used = (0..3).filter(|&k| self.counts[k] > 0);
        match (used.next(), used.next()) {
            (Some(axis), None) => Some(axis),
            _ => None,
        }
    }

    /// The angle of a section in a plane, or the vector by which it turns in space, along the axes of the beam:
    /// `sum q_j I_j(x)`.
    pub fn turn<D: DualNum<Primitive = f64> + Copy>(&self, q: &[D], value: f64) -> [D; 3] {
        combined(self.counts, q, |order| integral(order, value))
    }

    /// Its derivative by the place as a fraction of the length: `sum q_j P_j(x)`.
    pub fn slope<D: DualNum<Primitive = f64> + Copy>(&self, q: &[D], value: f64) -> [D; 3] {
        combined(self.counts, q, |order| legendre(order, value))
    }

    /// Its second derivative: `sum q_j P_j'(x)`.
    pub fn curl<D: DualNum<Primitive = f64> + Copy>(&self, q: &[D], value: f64) -> [D; 3] {
        combined(self.counts, q, |order| derivative(order, value))
    }

    /// Stretch, and shear along the second and the third axis, if they are coordinates: `sum q_j P_j(x)`.
    pub fn strain<D: DualNum<Primitive = f64> + Copy>(&self, q: &[D], value: f64) -> [D; 3] {
        let turns: usize = self.counts.iter().sum();
        combined(self.strains, &q[turns..], |order| legendre(order, value))
    }

    /// What each point of quadrature counts in an integral from the root to a place: the integral of Lagrange's
    /// polynomial of that point.
    pub fn weights_to(&self, value: f64) -> Vec<f64> {
        let lagrange = |k: usize, x: f64| -> f64 {
            let factors = self.others(k).map(|(_, factor)| factor(x));
            factors.product()
        };
        let weight = |k| -> f64 {
            let terms = self.sections.iter();
            let terms = terms.map(|term| value * term.weight * lagrange(k, value * term.place));
            terms.sum()
        };
        (0..self.sections.len()).map(weight).collect()
    }

    /// What each point of quadrature counts in the derivative at a place: the derivative of Lagrange's polynomial of that
    /// point.
    pub fn slopes_at(&self, value: f64) -> Vec<f64> {
        let without = |k: usize, left_out: usize| -> f64 {
            let factors = self.others(k).filter(|(i, _)| *i != left_out);
            factors.map(|(_, factor)| factor(value)).product()
        };
        let slope = |k: usize| -> f64 {
            let at = self.sections[k].place;
            let terms = self.others(k);
            let terms = terms.map(|(i, _)| without(k, i) / (at - self.sections[i].place));
            terms.sum()
        };
        (0..self.sections.len()).map(slope).collect()
    }

    /// The factors `(x - x_i) / (x_k - x_i)` of Lagrange's polynomial of point `k`.
    fn others(&self, k: usize) -> impl Iterator<Item = (usize, impl Fn(f64) -> f64)> {
        let at = self.sections[k].place;
        let others = self.sections.iter().enumerate().filter(move |(i, _)| *i != k);
        others.map(move |(i, other)| (i, move |x: f64| (x - other.place) / (at - other.place)))
    }
}

/// Sums of coordinates of three kinds, one kind after the other, times the shape of their order.
fn combined<D: DualNum<Primitive = f64> + Copy>(counts: [usize; 3], q: &[D], shape: impl Fn(usize) -> f64) -> [D; 3] {
    let mut rest = q;
    counts.map(|count| {
        let (own, others) = rest.split_at(count);
        rest = others;
        let terms = own.iter().enumerate();
        terms.map(|(order, &q)| q * shape(order)).sum()
    })
}

/// Coefficient of `x^k` in the Legendre polynomial of `[0, 1]`: `(-1)^(n + k) (n over k) (n + k over k)`.
fn coefficient(n: usize, k: usize) -> f64 {
    let binomial = |n: usize, k: usize| -> f64 {
        let factors = (0..k).map(|i| (n - i) as f64 / (i + 1) as f64);
        factors.product()
    };
    let sign = if (n + k).is_multiple_of(2) { 1.0 } else { -1.0 };
    sign * (binomial(n, k) * binomial(n + k, k)).round()
}

fn legendre(n: usize, x: f64) -> f64 {
    let terms = (0..=n).map(|k| coefficient(n, k) * x.powi(k as i32));
    terms.sum()
}

fn derivative(n: usize, x: f64) -> f64 {
    let terms = (1..=n).map(|k| coefficient(n, k) * k as f64 * x.powi(k as i32 - 1));
    terms.sum()
}

/// The integral of the polynomial from 0 to `x`.
fn integral(n: usize, x: f64) -> f64 {
    let terms = (0..=n).map(|k| coefficient(n, k) * x.powi(k as i32 + 1) / (k + 1) as f64);
    terms.sum()
}
