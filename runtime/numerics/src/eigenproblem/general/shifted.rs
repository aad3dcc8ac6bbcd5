//! Triangular factors of `H - s` for a real Hessenberg matrix `H`: `n^2` operations each.

use num_complex::Complex64;

use super::pencil::bound;
use crate::scalar::Real;

/// A complex vector by its parts.
#[derive(Clone, Debug, Default)]
pub(super) struct Parts {
    pub(super) re: Vec<f64>,
    pub(super) im: Vec<f64>,
}

impl Parts {
    pub(super) fn zeros(n: usize) -> Self {
        Self { re: vec![0.0; n], im: vec![0.0; n] }
    }

    pub(super) fn both(&mut self) -> [&mut [f64]; 2] {
        [&mut self.re, &mut self.im]
    }

    pub(super) fn fill(&mut self, value: f64) {
        self.re.fill(value);
        self.im.fill(0.0);
    }

    fn get(&self, i: usize) -> Complex64 {
        Complex64::new(self.re[i], self.im[i])
    }

    fn set(&mut self, i: usize, value: Complex64) {
        (self.re[i], self.im[i]) = (value.re, value.im);
    }

    fn swap(&mut self, i: usize, j: usize) {
        self.re.swap(i, j);
        self.im.swap(i, j);
    }

    /// Euclidean length.
    pub(super) fn length(&self) -> f64 {
        self.re.iter().zip(&self.im).map(|(re, im)| re * re + im * im).sum::<f64>().sqrt()
    }

    /// The sum of the products, without conjugation.
    pub(super) fn dot(&self, other: &Self) -> Complex64 {
        dot((&self.re, &self.im), (&other.re, &other.im))
    }

    pub(super) fn scale(&mut self, factor: f64) {
        self.re.iter_mut().for_each(|x| *x *= factor);
        self.im.iter_mut().for_each(|x| *x *= factor);
    }
}

/// `H - s = L U` with exchanges of neighbouring rows.
pub(super) struct Shifted {
    n: usize,
    /// `U`, row by row.
    re: Vec<f64>,
    im: Vec<f64>,
    /// The only element of each column of `L` below the diagonal, and whether rows were exchanged before.
    below: Vec<Complex64>,
    exchanged: Vec<bool>,
}

impl Shifted {
    /// Room for matrices of size `n`.
    pub(super) fn new(n: usize) -> Self {
        Self {
            n,
            re: vec![0.0; n * n],
            im: vec![0.0; n * n],
            below: vec![Complex64::ZERO; n],
            exchanged: vec![false; n],
        }
    }

    /// Factors `H - s`; pivots below `least` are replaced by it.
    pub(super) fn factor(&mut self, h: &[f64], s: Complex64, least: f64) {
        f64::run(
            #[inline(always)]
            || self.eliminate(h, s, least),
        );
    }

    #[inline(always)]
    fn eliminate(&mut self, h: &[f64], s: Complex64, least: f64) {
        let n = self.n;
        let load = |k: usize, re: &mut [f64], im: &mut [f64]| {
            let from = k.saturating_sub(1);
            re[from..n].copy_from_slice(&h[k * n + from..(k + 1) * n]);
            im[from..n].fill(0.0);
            re[k] -= s.re;
            im[k] -= s.im;
        };
        load(0, &mut self.re[..n], &mut self.im[..n]);
        for k in 0..n {
            let (re, re_next) = self.re[k * n..].split_at_mut(n);
            let (im, im_next) = self.im[k * n..].split_at_mut(n);
            if k + 1 < n {
                let (re_next, im_next) = (&mut re_next[..n], &mut im_next[..n]);
                load(k + 1, re_next, im_next);
                self.exchanged[k] = re_next[k].abs() > re[k].abs() + im[k].abs();
                if self.exchanged[k] {
                    re[k..].swap_with_slice(&mut re_next[k..]);
                    im[k..].swap_with_slice(&mut im_next[k..]);
                }
                raise(&mut re[k], &mut im[k], least);
                let factor = Complex64::new(re_next[k], im_next[k]) / Complex64::new(re[k], im[k]);
                self.below[k] = factor;
                let above = re[k + 1..].iter().zip(&im[k + 1..]);
                let below = re_next[k + 1..].iter_mut().zip(&mut im_next[k + 1..]);
                for ((x, y), (a, b)) in below.zip(above) {
                    *x -= factor.re * a - factor.im * b;
                    *y -= factor.re * b + factor.im * a;
                }
            } else {
                raise(&mut re[k], &mut im[k], least);
            }
        }
    }

    fn pivot(&self, i: usize) -> Complex64 {
        let offset = i * (self.n + 1);
        Complex64::new(self.re[offset], self.im[offset])
    }

    /// `U x = b` in place.
    pub(super) fn solve_upper(&self, x: &mut Parts) {
        let n = self.n;
        f64::run(
            #[inline(always)]
            || {
                for i in (0..n).rev() {
                    let row = i * n + i + 1..(i + 1) * n;
                    let u = (&self.re[row.clone()], &self.im[row]);
                    let sum = dot(u, (&x.re[i + 1..], &x.im[i + 1..]));
                    x.set(i, (x.get(i) - sum) / self.pivot(i));
                }
            },
        );
    }

    /// `(H - s) x = b` in place.
    pub(crate) fn solve(&self, x: &mut Parts) {
        for k in 0..self.n.saturating_sub(1) {
            if self.exchanged[k] {
                x.swap(k, k + 1);
            }
            let part = self.below[k] * x.get(k);
            x.set(k + 1, x.get(k + 1) - part);
        }
        self.solve_upper(x);
    }

    /// `(H - s)^T x = b` in place.
    pub(super) fn solve_transposed(&self, x: &mut Parts) {
        let n = self.n;
        f64::run(
            #[inline(always)]
            || {
                for i in 0..n {
                    let y = x.get(i) / self.pivot(i);
                    x.set(i, y);
                    let row = i * n + i + 1..(i + 1) * n;
                    let u = self.re[row.clone()].iter().zip(&self.im[row]);
                    let rest = x.re[i + 1..].iter_mut().zip(&mut x.im[i + 1..]);
                    for ((re, im), (a, b)) in rest.zip(u) {
                        *re -= a * y.re - b * y.im;
                        *im -= a * y.im + b * y.re;
                    }
                }
            },
        );
        for k in (0..n.saturating_sub(1)).rev() {
            let part = self.below[k] * x.get(k + 1);
            x.set(k, x.get(k) - part);
            if self.exchanged[k] {
                x.swap(k, k + 1);
            }
        }
    }
}

#[inline(always)]
fn raise(re: &mut f64, im: &mut f64, least: f64) {
    if bound(Complex64::new(*re, *im)) < least {
        (*re, *im) = (least, 0.0);
    }
}

/// Numbers summed side by side.
const PARTS: usize = 4;

/// The sum of the products, without conjugation.
#[inline(always)]
fn dot((a_re, a_im): (&[f64], &[f64]), (b_re, b_im): (&[f64], &[f64])) -> Complex64 {
    let (mut re, mut im) = ([0.0; PARTS], [0.0; PARTS]);
    let (a, a_rest) = a_re.as_chunks::<PARTS>();
    let (b, b_rest) = a_im.as_chunks::<PARTS>();
    let (c, c_rest) = b_re.as_chunks::<PARTS>();
    let (d, d_rest) = b_im.as_chunks::<PARTS>();
    for (((a, b), c), d) in a.iter().zip(b).zip(c).zip(d) {
        for k in 0..PARTS {
            re[k] += a[k] * c[k] - b[k] * d[k];
            im[k] += a[k] * d[k] + b[k] * c[k];
        }
    }
    let mut sum = Complex64::new((re[0] + re[2]) + (re[1] + re[3]), (im[0] + im[2]) + (im[1] + im[3]));
    for (((a, b), c), d) in a_rest.iter().zip(b_rest).zip(c_rest).zip(d_rest) {
        sum += Complex64::new(a * c - b * d, a * d + b * c);
    }
    sum
}
