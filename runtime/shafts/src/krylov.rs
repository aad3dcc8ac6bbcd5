//! Krylov spaces of the whole pencil: approximations of the modes nearest to a shift, with one factorisation.

use eigentol_contract::scalar::Real as _;
use eigentol_numerics::Complex;
use eigentol_numerics::algebra::{Matrix, Vector, add_to, dot};
use eigentol_numerics::eigenproblem::general::hessenberg_eigenvalues;

use crate::assembly::{Assembly, At};
use crate::error::Error;
use crate::motion::{Kept, Motion};
use crate::section::Line;

/// What is slower than so many times that may be nothing but rounding.
pub(crate) const SLOW: f64 = 16.0;
/// That below which the modes nearest to a shift are all among the approximations.
pub(crate) const KNOWN: f64 = 1e-4;
/// The most Krylov spaces.
const SPACES: usize = 6;
/// The most modes for which two directions each, and some, are enough: among many, one that the first direction hardly moves comes late.
const FEW: usize = 14;
/// The shift as a part of a typical frequency: rigid motions have none.
const SHIFT: f64 = 0.1;

/// An orthonormal basis with what the shifted and inverted pencil is in it, and what it leaves of the last direction.
struct Space {
    shift: f64,
    /// By which rates are divided, 1/s: both halves of a vector weigh alike.
    typical: f64,
    /// One more than there are columns.
    basis: Vec<Vec<f64>>,
    /// Of the Hessenberg matrix, down to what is left of the next direction.
    columns: Vec<Vec<f64>>,
}

/// An approximation from a Krylov space: with the motion of the stations if it is wanted, and its error as far as what is left of its equation says.
pub(crate) struct Ritz {
    pub(crate) s: Complex,
    pub(crate) stations: Option<Vector<Complex>>,
    pub(crate) rest: f64,
}

impl Space {
    /// Whether nothing leads out of it.
    fn is_whole(&self) -> bool {
        let of_column = |column: &Vec<f64>| column.last().is_some_and(|rest| *rest == 0.0);
        self.columns.last().is_some_and(of_column) || self.columns.len() >= self.basis[0].len()
    }

    /// A motion and its rate as one vector. The second half is the first times `s`: divided by what is typical, both weigh alike.
    fn flat(&self, x: &Motion, v: &Motion) -> Vec<f64> {
        let mut all = Vec::new();
        x.reals_into(1.0, &mut all);
        all.reserve(all.len());
        v.reals_into(1.0 / self.typical, &mut all);
        all
    }

    /// The approximations nearest to the shift, so many and then the wanted ones only.
    fn ritz(&self, stations: usize, count: usize, wanted: &impl Fn(Complex) -> bool) -> Result<Vec<Ritz>, Error> {
        let size = self.columns.len();
        let hessenberg = Matrix::from_fn(size, size, |i, j| self.columns[j].get(i).copied().unwrap_or(0.0));
        let last = self.columns.last().and_then(|column| column.last()).copied().unwrap_or(0.0);
        let mut small = hessenberg.clone();
        let mut values = vec![Complex::ZERO; size];
        hessenberg_eigenvalues(size, small.as_flattened_mut(), &mut values).ok_or(Error::NotConverged)?;
        values.sort_by(|a, b| b.norm().total_cmp(&a.norm()));
        let places = values.into_iter().filter(|value| value.norm() > 0.0).enumerate();
        let of_value = |(place, value): (usize, Complex)| {
            let s = self.shift + value.inv();
            let is_wanted = wanted(s);
            if !is_wanted && place >= count {
                return None;
            }
            let y = inverse_iteration(&hessenberg, size, value * (1.0 + 1e-12));
            let length = y.iter().map(Complex::norm_sqr).sum::<f64>().sqrt();
            // As a change of `s`, relative to it.
            let rest = last * y[size - 1].norm() / (length * value.norm_sqr() * s.norm());
            let motion = || Vector::from_fn(stations, |i| (0..size).map(|j| y[j] * self.basis[j][i]).sum());
            Some(Ritz { s, stations: is_wanted.then(motion), rest })
        };
        Ok(places.filter_map(of_value).collect())
    }
}

impl Assembly {
    /// Wanted eigenvalues near a shift and the motions of the stations, the nearest first. A shift far from all of them does not
    /// tell them from each other: as long as one of the nearest, up to `sure` wanted ones, has not converged, the next shift is
    /// what the slowest of them is, or the space has more directions.
    pub(crate) fn krylov(
        &self,
        (count, sure): (usize, usize),
        wanted: &impl Fn(Complex) -> bool,
    ) -> Result<Vec<Ritz>, Error> {
        let mut shift = SHIFT * self.typical_frequency();
        let mut steps = 2 * count + 14 + 2 * count.saturating_sub(FEW);
        let mut at = self.at(shift.into()).ok_or(Error::NotConverged)?;
        let mut space = self.space(&at, shift);
        let mut found = Vec::new();
        for _ in 0..SPACES {
            self.extend(&mut space, &at, steps);
            let ritz = space.ritz(self.stations(), 2 * count, wanted)?;
            let mut left = sure;
            let is_known = ritz.iter().take(2 * count).all(|own| {
                let needed = left > 0;
                left -= usize::from(needed && own.stations.is_some());
                !needed || own.rest < KNOWN
            });
            let rigid = SLOW * self.rigid();
            let slowest =
                ritz.iter().map(|own| own.s.norm()).filter(|size| *size > rigid).fold(f64::INFINITY, f64::min);
            found = ritz.into_iter().filter(|own| own.stations.is_some()).take(count).collect();
            if is_known || space.is_whole() {
                break;
            }
            if slowest < 0.5 * shift {
                shift = slowest;
                at = self.at(shift.into()).ok_or(Error::NotConverged)?;
                space = self.space(&at, shift);
            } else {
                steps += steps / 2;
            }
        }
        Ok(found)
    }

    /// A Krylov space about a shift, of one direction. The shift is real, and so are all vectors: planar motions are real where that of
    /// `y - i z` is the conjugate of that of `y + i z`, which alone is kept.
    fn space(&self, at: &At<'_>, shift: f64) -> Space {
        let mut seed = 1_u64;
        let mut first = self.still(Kept::First);
        first.stations = Vector::from_fn(self.stations(), |_| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            Complex::new((seed >> 40) as f64 / (1 << 24) as f64 - 0.5, 0.0)
        });
        let first = at.solve_real(first);
        let mut space = Space { shift, typical: self.typical_frequency(), basis: Vec::new(), columns: Vec::new() };
        let mut start = space.flat(&first, &first);
        normalise(&mut start);
        space.basis.push(start);
        space
    }

    /// Adds directions to a space, up to so many, as long as there are others.
    fn extend(&self, space: &mut Space, at: &At<'_>, steps: usize) {
        let shift = Complex::new(space.shift, 0.0);
        let (mut x, mut v) = (self.still(Kept::First), self.still(Kept::First));
        let half = space.basis[0].len() / 2;
        for k in space.columns.len()..steps.min(2 * half) {
            if space.is_whole() {
                return;
            }
            x.set_reals(&space.basis[k][..half], 1.0);
            v.set_reals(&space.basis[k][half..], space.typical);
            let mut loads = self.momentum(&x, &v, shift);
            loads.scale(Complex::new(-1.0, 0.0));
            let w = at.solve_real(loads);
            x.add(shift, &w);
            let mut next = space.flat(&w, &x);
            let column = f64::run(
                #[inline(always)]
                || orthogonalised(&space.basis, &mut next),
            );
            space.columns.push(column);
            space.basis.push(next);
        }
    }

    /// That of the longest span between hinges, 1/s; without spans that of the slowest station.
    fn typical_frequency(&self) -> f64 {
        let of_span = |span: &crate::Span| {
            let wave = core::f64::consts::PI / span.length();
            let power = if span.line == Line::Bar { 2 } else { 4 };
            let own = span.sections.iter().map(|(own, _)| own.stiffness / own.mass).sum::<f64>();
            (own / span.sections.len() as f64 * wave.powi(power)).sqrt()
        };
        let mut lowest = self.spans().iter().map(of_span).fold(f64::INFINITY, f64::min);
        if self.spans().is_empty() {
            lowest = self.rates().filter(|rate| *rate > 0.0).fold(lowest, f64::min).sqrt();
        }
        if lowest.is_finite() { lowest } else { 1.0 }
    }
}

/// `(H - value)^-1` times a vector of ones, for the leading part of a Hessenberg matrix.
fn inverse_iteration(hessenberg: &Matrix, size: usize, value: Complex) -> Vector<Complex> {
    let entry = |i: usize, j: usize| Complex::from(hessenberg[i][j]) - if i == j { value } else { Complex::ZERO };
    let mut rows: Vec<Vec<Complex>> = (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect();
    let mut y = Vector::from_fn(size, |_| Complex::ONE);
    for k in 0..size.saturating_sub(1) {
        if rows[k + 1][k].norm_sqr() > rows[k][k].norm_sqr() {
            rows.swap(k, k + 1);
            y.swap(k, k + 1);
        }
        let (above, below) = rows.split_at_mut(k + 1);
        let (row, next) = (&above[k], &mut below[0]);
        let factor = next[k] / row[k];
        next[k..].iter_mut().zip(&row[k..]).for_each(|(to, from)| *to -= factor * from);
        let moved = factor * y[k];
        y[k + 1] -= moved;
    }
    for k in (0..size).rev() {
        let known: Complex = rows[k][k + 1..].iter().zip(&y[k + 1..]).map(|(a, y)| a * y).sum();
        let least = f64::EPSILON * value.norm();
        let pivot = if rows[k][k].norm() > least { rows[k][k] } else { least.into() };
        y[k] = (y[k] - known) / pivot;
    }
    y
}

/// Takes out of a vector what is along those of a basis, and scales it to one. Returns its shares along them, and then what was left.
#[inline(always)]
fn orthogonalised(basis: &[Vec<f64>], next: &mut [f64]) -> Vec<f64> {
    let before = product(next, next).sqrt();
    let mut column = vec![0.0; basis.len() + 1];
    for _ in 0..2 {
        for (own, to) in basis.iter().zip(&mut column) {
            let share = product(own, next);
            *to += share;
            add_to(next, -share, own);
        }
        // What is not much shorter than before has lost nothing to rounding.
        if product(next, next).sqrt() > 0.1 * before {
            break;
        }
    }
    let rest = normalise(next);
    column[basis.len()] = if rest <= 1e-13 * before { 0.0 } else { rest };
    column
}

/// The scalar product, from eight sums side by side.
#[inline(always)]
fn product(a: &[f64], b: &[f64]) -> f64 {
    let (ahead, bhead) = (a.chunks_exact(8), b.chunks_exact(8));
    let mut sums = [0.0; 8];
    let rest = dot(ahead.remainder(), bhead.remainder());
    for (a, b) in ahead.zip(bhead) {
        for lane in 0..8 {
            sums[lane] += a[lane] * b[lane];
        }
    }
    sums.iter().sum::<f64>() + rest
}

#[inline(always)]
fn normalise(x: &mut [f64]) -> f64 {
    let norm = product(x, x).sqrt();
    x.iter_mut().for_each(|x| *x /= norm);
    norm
}
