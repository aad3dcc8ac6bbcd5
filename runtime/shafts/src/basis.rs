//! The functions of an element on `[-1, 1]` and the integrals of their products, which are constants.
//!
//! # Parity
//!
//! An element has the same numbers all along, so what is even and what is odd about its middle does not mix: the sum of
//! two small problems in place of one large. The nodal unknowns of one class are half the sums or half the differences of
//! those of the two ends.

use std::sync::OnceLock;

use eigentol_numerics::Matrix;

use crate::number::Number;
use crate::section::{Line, TERMS};

/// The largest degree.
pub(crate) const MOST: usize = 12;

/// Half the sum (`+ +`) or half the difference (`- +`) of the ends, by class and component.
pub(crate) const SIGNS: [[[f64; 2]; 2]; 2] = [[[1.0, 1.0], [-1.0, 1.0]], [[-1.0, 1.0], [1.0, 1.0]]];

/// The constant matrices of one class, one for each coefficient of the line. The unknowns of the nodes come first.
#[derive(Clone, Debug)]
pub(crate) struct Class {
    pub(crate) size: usize,
    /// What is not zero on the diagonal and below, by row.
    pub(crate) entries: Vec<Entry>,
}

/// An entry of a matrix: the sum of coefficients times values.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub(crate) row: usize,
    pub(crate) column: usize,
    /// Of each the coefficient, and the value.
    pub(crate) terms: Vec<(usize, f64)>,
}

impl Class {
    fn new(terms: &[Matrix]) -> Self {
        let size = terms.first().map_or(0, Matrix::row_count);
        let places = (0..size).flat_map(|row| (0..=row).map(move |column| (row, column)));
        let entry = |(row, column): (usize, usize)| {
            let values = terms.iter().map(|matrix| matrix[row][column]).enumerate();
            Entry { row, column, terms: values.filter(|(_, value)| value.abs() > 1e-14).collect() }
        };
        Self { size, entries: places.map(entry).filter(|entry| !entry.terms.is_empty()).collect() }
    }
}

impl Entry {
    /// The entry with these coefficients.
    #[inline(always)]
    pub(crate) fn value<T: Number>(&self, k: &[T; TERMS]) -> T {
        let mut sum = T::zero();
        for &(term, value) in &self.terms {
            sum += k[term].times(value);
        }
        sum
    }
}

/// A function of the place by its values, first and second derivatives at the points of quadrature.
type Function = Vec<[f64; 3]>;

/// Both classes of a line at a degree up to [`MOST`], computed once: the even deflection first.
pub(crate) fn classes(line: Line, degree: usize) -> &'static [Class; 2] {
    static KNOWN: [[OnceLock<[Class; 2]>; MOST + 1]; 3] = [const { [const { OnceLock::new() }; MOST + 1] }; 3];
    KNOWN[line as usize][degree].get_or_init(|| computed(line, degree))
}

fn computed(line: Line, degree: usize) -> [Class; 2] {
    let (points, weights) = gauss(degree + 4);
    [0, 1].map(|class| {
        let odd = class == 1;
        match line {
            Line::Bar => {
                let functions = lagrange_and_bubbles(odd, degree, &points);
                let q = |a: usize, b: usize| integral(&weights, &functions, &functions, [a, b]);
                Class::new(&[q(0, 0), q(1, 1)])
            }
            Line::Slender => {
                let functions = hermite_and_bubbles(odd, degree, &points);
                let q = |k: usize| integral(&weights, &functions, &functions, [k, k]);
                Class::new(&[q(0), q(1), q(2)])
            }
            Line::Timoshenko => {
                let (w, b) = (lagrange_and_bubbles(odd, degree, &points), lagrange_and_bubbles(!odd, degree, &points));
                let size = w.len() + b.len();
                // both nodal unknowns first
                let place_w = |k: usize| if k == 0 { 0 } else { k + 1 };
                let place_b = |k: usize| if k == 0 { 1 } else { w.len() + k };
                let mut terms = vec![Matrix::zeros(size, size); TERMS];
                let mut put =
                    |term: usize, own: &Matrix, rows: &dyn Fn(usize) -> usize, columns: &dyn Fn(usize) -> usize| {
                        for i in 0..own.row_count() {
                            for j in 0..own.column_count() {
                                terms[term][rows(i)][columns(j)] += own[i][j];
                            }
                        }
                    };
                put(0, &integral(&weights, &w, &w, [0, 0]), &place_w, &place_w);
                put(1, &integral(&weights, &b, &b, [0, 0]), &place_b, &place_b);
                put(2, &integral(&weights, &b, &b, [1, 1]), &place_b, &place_b);
                put(3, &integral(&weights, &w, &w, [1, 1]), &place_w, &place_w);
                let mixed = integral(&weights, &w, &b, [1, 0]);
                put(4, &mixed, &place_w, &place_b);
                put(4, &mixed.transpose(), &place_b, &place_w);
                Class::new(&terms)
            }
        }
    })
}

/// `1` or `eta`, then `(P_k - P_{k-2}) / (2 (2k - 1))` of the same parity, which vanish at the ends.
fn lagrange_and_bubbles(odd: bool, degree: usize, points: &[f64]) -> Vec<Function> {
    let node = if odd { at(points, |x| [x, 1.0, 0.0]) } else { at(points, |_| [1.0, 0.0, 0.0]) };
    let bubble = |k: usize| {
        at(points, |x| {
            let (high, low) = (legendre(k, x), legendre(k - 2, x));
            let scale = 0.5 / (2.0 * k as f64 - 1.0);
            [0, 1, 2].map(|d| scale * (high[d] - low[d]))
        })
    };
    let first = if odd { 3 } else { 2 };
    [node].into_iter().chain((first..=degree).step_by(2).map(bubble)).collect()
}

/// The deflection with slope zero at the ends, the slope with deflection zero there, and `(1 - eta^2)^2 P_k`.
fn hermite_and_bubbles(odd: bool, degree: usize, points: &[f64]) -> Vec<Function> {
    let nodes: [Function; 2] = if odd {
        [
            at(points, |x| [(3.0 * x - x * x * x) / 2.0, (3.0 - 3.0 * x * x) / 2.0, -3.0 * x]),
            at(points, |x| [(x * x * x - x) / 2.0, (3.0 * x * x - 1.0) / 2.0, 3.0 * x]),
        ]
    } else {
        [at(points, |_| [1.0, 0.0, 0.0]), at(points, |x| [(x * x - 1.0) / 2.0, x, 1.0])]
    };
    let bubble = |k: usize| {
        at(points, |x| {
            let rest = 1.0 - x * x;
            let (q, dq, ddq) = (rest * rest, -4.0 * x * rest, 12.0 * x * x - 4.0);
            let [p, dp, ddp] = legendre(k, x);
            [q * p, dq * p + q * dp, ddq * p + 2.0 * dq * dp + q * ddp]
        })
    };
    let first = usize::from(odd);
    nodes.into_iter().chain((first..=degree.saturating_sub(4) + first).step_by(2).map(bubble)).collect()
}

fn at(points: &[f64], f: impl Fn(f64) -> [f64; 3]) -> Function {
    points.iter().map(|&x| f(x)).collect()
}

fn integral(weights: &[f64], a: &[Function], b: &[Function], [da, db]: [usize; 2]) -> Matrix {
    Matrix::from_fn(a.len(), b.len(), |i, j| {
        let products = a[i].iter().zip(&b[j]).zip(weights);
        products.map(|((a, b), weight)| a[da] * b[db] * weight).sum()
    })
}

/// A Legendre polynomial with its first and second derivative, by recursion.
fn legendre(n: usize, x: f64) -> [f64; 3] {
    let (mut before, mut now) = ([1.0, 0.0, 0.0], [x, 1.0, 0.0]);
    if n == 0 {
        return before;
    }
    for k in 1..n {
        let (k, a) = (k as f64, 2.0 * k as f64 + 1.0);
        let next = [
            (a * x * now[0] - k * before[0]) / (k + 1.0),
            (a * (now[0] + x * now[1]) - k * before[1]) / (k + 1.0),
            (a * (2.0 * now[1] + x * now[2]) - k * before[2]) / (k + 1.0),
        ];
        (before, now) = (now, next);
    }
    now
}

/// Points and weights of Gauss and Legendre.
fn gauss(n: usize) -> (Vec<f64>, Vec<f64>) {
    (0..n)
        .map(|k| {
            let mut x = (std::f64::consts::PI * (k as f64 + 0.75) / (n as f64 + 0.5)).cos();
            for _ in 0..20 {
                let [p, dp, _] = legendre(n, x);
                x -= p / dp;
            }
            let [_, dp, _] = legendre(n, x);
            (x, 2.0 / ((1.0 - x * x) * dp * dp))
        })
        .unzip()
}
