//! How shafts change with the variables at one `s`: what second derivatives are made of.

use eigentol_shafts::{Changes, Varied};

use super::{Shafts, numbers_along};
use crate::algebra::{Matrix, Vector, dot_complex};
use crate::kernels::{Kernels, Linear, Second};
use crate::scalar::Dual;
use crate::{Complex, Equilibrium, Error};

/// What the shafts of a mechanism add to `T(s)` at one `s`, with derivatives by `s` and by each input and then each design variable,
/// at fixed compiled matrices.
#[doc(hidden)]
pub struct ShaftsAlong<'a> {
    mechanism: &'a dyn Kernels,
    at: &'a Equilibrium,
    shafts: Shafts,
    s: Complex,
    #[doc(hidden)]
    pub value: Matrix<Complex>,
    #[doc(hidden)]
    pub slope: Matrix<Complex>,
    #[doc(hidden)]
    pub curvature: Matrix<Complex>,
    /// By each variable, and the mixed derivatives by it and `s`.
    #[doc(hidden)]
    pub by: Vec<[Matrix<Complex>; 2]>,
}

impl<'a> ShaftsAlong<'a> {
    /// At one `s`; `None` without shafts.
    #[doc(hidden)]
    pub fn of(mechanism: &'a dyn Kernels, at: &'a Equilibrium, s: Complex) -> Result<Option<Self>, Error> {
        let Some(shafts) = Shafts::of(at)? else { return Ok(None) };
        let varied = |along: Option<usize>| {
            let numbers = numbers_along(mechanism, &at.description, [&at.inputs, &at.design], [along, None]);
            let first = f64::from(u8::from(along.is_none()));
            Varied { numbers, s: moving(s, [first, 1.0]) }
        };
        let variables = at.inputs.len() + at.design.len();
        let all: Vec<Varied> = core::iter::once(None).chain((0..variables).map(Some)).map(varied).collect();
        let mut found = shafts.spans.varied(&all).into_iter();
        let Some([value, slope, _, curvature]) = found.next() else { return Ok(None) };
        let by = found.map(|[_, by, _, mixed]: Changes| [by, mixed]).collect();
        Ok(Some(Self { mechanism, at, shafts, s, value, slope, curvature, by }))
    }

    /// `T(s)`, with these compiled matrices.
    #[doc(hidden)]
    #[must_use]
    pub fn whole(&self, linear: &Linear) -> Matrix<Complex> {
        let s = self.s;
        let n = self.value.row_count();
        let compiled = |i: usize, j: usize| s * (s * linear.mass[i][j] + linear.damping[i][j]) + linear.stiffness[i][j];
        Matrix::from_fn(n, n, |i, j| compiled(i, j) + self.value[i][j])
    }

    /// An entry of what is added to `T(s)`, or to its transpose.
    #[doc(hidden)]
    pub fn entry(&self, [i, j]: [usize; 2], transposed: bool) -> Complex {
        if transposed { self.value[j][i] } else { self.value[i][j] }
    }

    /// Adds a factor times the derivative by `s`, or of its transpose, times a motion.
    #[doc(hidden)]
    pub fn add_slope_times(&self, factor: Complex, x: &[Complex], transposed: bool, to: &mut [Complex]) {
        add_times(factor, &self.slope, x, transposed, to);
    }

    /// Adds the derivative by a variable, or of its transpose, times a motion.
    #[doc(hidden)]
    pub fn add_times(&self, variable: usize, x: &[Complex], transposed: bool, to: &mut [Complex]) {
        add_times(Complex::ONE, &self.by[variable][0], x, transposed, to);
    }

    /// `left^T A right` of one of these matrices.
    #[doc(hidden)]
    pub fn form(&self, matrix: &Matrix<Complex>, left: &[Complex], right: &[Complex]) -> Complex {
        dot_complex(left, &times(matrix, right))
    }

    /// Derivatives of `left^T T(s) right` by each two variables.
    #[doc(hidden)]
    pub fn second(&self, left: &[Complex], right: &[Complex]) -> Matrix<Complex> {
        let count = self.by.len();
        let fixed = moving(self.s, [0.0; 2]);
        let pairs: Vec<[usize; 2]> = (0..count).flat_map(|i| (0..=i).map(move |j| [i, j])).collect();
        let mut forms = Matrix::zeros(count, count);
        // In pieces: each has a matrix of the stations for each pair.
        for pairs in pairs.chunks(64) {
            let of_pair = |pair: &[usize; 2]| {
                let point = [&self.at.inputs[..], &self.at.design];
                Varied { numbers: numbers_along(self.mechanism, &self.at.description, point, pair.map(Some)), s: fixed }
            };
            let all: Vec<Varied> = pairs.iter().map(of_pair).collect();
            for ([i, j], [.., mixed]) in pairs.iter().zip(self.shafts.spans.varied(&all)) {
                forms[*i][*j] = dot_complex(left, &times(&mixed, right));
                forms[*j][*i] = forms[*i][*j];
            }
        }
        forms
    }
}

/// `s` that moves along two directions.
fn moving(s: Complex, [first, next]: [f64; 2]) -> [Second; 2] {
    let number = |value: f64, [first, next]: [f64; 2]| {
        let fixed = |value: f64| Dual { value, slope: 0.0 };
        Dual { value: Dual { value, slope: first }, slope: fixed(next) }
    };
    [number(s.re, [first, next]), number(s.im, [0.0; 2])]
}

fn times(matrix: &Matrix<Complex>, x: &[Complex]) -> Vector<Complex> {
    matrix.iter().map(|row| dot_complex(row, x)).collect()
}

fn add_times(factor: Complex, matrix: &Matrix<Complex>, x: &[Complex], transposed: bool, to: &mut [Complex]) {
    for (i, row) in matrix.iter().enumerate() {
        for (j, entry) in row.iter().enumerate() {
            let (at, from) = if transposed { (j, i) } else { (i, j) };
            to[at] += factor * entry * x[from];
        }
    }
}
