//! Modes: approximations from a Krylov space, each made exact by itself.
//!
//! The pencil is linear in twice as many unknowns, of which Arnoldi's method finds the modes nearest to a shift with one
//! factorisation. Each is then refined with the condensed `T(s)`: two-sided Newton steps converge cubically (K. Schreiber,
//! "Nonlinear Eigenvalue Problems: Newton-type Methods and Nonlinear Rayleigh Functionals", 2008).

use eigentol_numerics::Complex;
use eigentol_numerics::algebra::{Lu, Matrix, Vector, add_to, dot};
use eigentol_numerics::eigenproblem::eigenvalues;

use crate::assembly::{Assembly, At, SpanGradient};
use crate::error::Error;
use crate::motion::{Kept, Motion, Side};
use crate::section::Line;

/// A mode: `P(s) right = 0` and `left^T P(s) = 0`.
#[derive(Clone, Debug)]
pub struct Mode {
    /// 1/s.
    pub s: Complex,
    /// Its shape.
    pub right: Motion,
    /// The weights of its adjoint.
    pub left: Motion,
}

/// Newton steps at most; three are usual from a Krylov space, two from a neighbour.
const STEPS: usize = 12;
/// A relative step after which `s` and both vectors are as exact as rounding lets them be.
const CLOSE: f64 = 1e-9;
/// A relative step behind which the next, unless it is much smaller, is rounding.
const STAYS: f64 = 1e-6;
/// What is slower than this part of a typical frequency is a rigid motion, whose rounding it is.
const RIGID: f64 = 1e-4;
/// Radians by which a determinant may turn in half a step along an edge.
const TURN: f64 = 0.9;
/// Distance of equal eigenvalues as a part of them.
const SAME: f64 = 1e-7;
/// How far beside an eigenvalue another one with the same value is looked for, as a part of it.
const APART: f64 = 1e-9;
/// The inverse of what is left without a mode, above which no other has its eigenvalue.
const ALONE: f64 = 1e3;
/// The shift as a part of a typical frequency: rigid motions have none.
const SHIFT: f64 = 0.1;

impl Assembly {
    /// Up to `count` modes of lowest `|s|` that oscillate and in which stations move, by frequency. The search can miss one:
    /// [`Self::count_within`] tells.
    ///
    /// # Errors
    /// [`Error::NotConverged`].
    pub fn modes(&self, count: usize) -> Result<Vec<Mode>, Error> {
        let mut modes: Vec<Mode> = Vec::new();
        for (s, stations) in self.krylov(count + 2)? {
            let mode = self.turned(&self.beside(s)?, stations)?;
            // Both of two equal ones are found with the first.
            if modes.iter().any(|other| other.is_near(&mode)) {
                continue;
            }
            let second = self.beside_it(&mode)?;
            modes.push(mode);
            modes.extend(second);
        }
        modes.sort_by(|a, b| a.s.im.total_cmp(&b.s.im));
        modes.truncate(count);
        Ok(modes)
    }

    /// The number of eigenvalues within a rectangle from one corner to the opposite one, each as often as it is a zero of the
    /// determinant: the times that this turns about zero along the edges. `None` where an eigenvalue is on an edge.
    ///
    /// A list of modes within the rectangle is complete where it has as many. Steps are a quarter of the shorter edge at
    /// most, so that what is as far from an edge is not stepped over.
    #[must_use]
    pub fn count_within(&self, low: Complex, high: Complex) -> Option<usize> {
        let corners = [low, Complex::new(high.re, low.im), high, Complex::new(low.re, high.im), low];
        let most = 0.25 * f64::min((high.re - low.re).abs(), (high.im - low.im).abs());
        let mut turns = 0.0;
        for edge in corners.windows(2) {
            let at = |share: f64| Some(self.at(edge[0] + (edge[1] - edge[0]) * share)?.phase());
            let longest = most / (edge[1] - edge[0]).norm();
            let (mut place, mut phase, mut step) = (0.0, at(0.0)?, longest);
            while place < 1.0 {
                let next = f64::min(place + step, 1.0);
                let (half, whole) = (at((place + next) / 2.0)?, at(next)?);
                let [first, second] = [(half / phase).arg(), (whole / half).arg()];
                if first.abs() > TURN || second.abs() > TURN {
                    step /= 2.0;
                    if step < 1e-9 {
                        return None;
                    }
                    continue;
                }
                turns += (first + second) / core::f64::consts::TAU;
                (place, phase) = (next, whole);
                if first.abs().max(second.abs()) < TURN / 3.0 {
                    step = f64::min(2.0 * step, longest);
                }
            }
        }
        Some(turns.round().max(0.0) as usize)
    }

    /// Another mode with the same eigenvalue, as each of a round rotor at rest has: a Krylov space knows one of them. It is
    /// what inverse iteration leaves of a motion without the known mode; `None` where that is nothing.
    fn beside_it(&self, mode: &Mode) -> Result<Option<Mode>, Error> {
        let s = mode.s * (1.0 + APART);
        let Some(at) = self.at(s) else { return Ok(None) };
        let slope = self.slope_loads(&mode.right, s, Side::Right);
        let slope_left = self.slope_loads(&mode.left, s, Side::Left);
        let rest = |side: Side, known: &Motion, weights: &Motion| {
            let ones = Vector::from_fn(self.stations(), |k| Complex::new(1.0, 0.3 * (k % 3) as f64));
            let mut loads = self.still(Kept::All);
            loads.stations = ones;
            let mut motion = at.solve(loads, side);
            motion.normalise();
            motion.add(-motion.product(weights) / known.product(weights), known);
            motion
        };
        let (mut right, mut left) = (rest(Side::Right, &mode.right, &slope_left), rest(Side::Left, &mode.left, &slope));
        // What is left where the eigenvalue is single is smaller by the distance from it as a part of that to the next.
        if right.normalise() > ALONE || left.normalise() > ALONE {
            return Ok(None);
        }
        // Once more: beside an eigenvalue already the first step is small.
        let second = self.near(&self.near(&Mode { s, right, left })?)?;
        Ok(Some(second).filter(|second| second.is_near(mode) && !second.is_same(mode)))
    }

    /// Derivatives of the eigenvalue of a mode by the numbers of each section of each span and by the speed of each span. By
    /// an entry of the matrices of the stations it is `-left_i right_j` times 1, `s` or `s^2`, over [`Self::normaliser`].
    #[must_use]
    pub fn slopes(&self, mode: &Mode) -> Vec<SpanGradient> {
        let mut all = self.gradient(&mode.left, &mode.right, mode.s);
        let factor = -self.normaliser(&mode.left, &mode.right, mode.s).inv();
        for own in &mut all {
            own.speed *= factor;
            own.sections.iter_mut().flatten().for_each(|x| *x *= factor);
        }
        all
    }

    /// A mode from an approximation, for example the mode at a neighbouring speed or design.
    ///
    /// # Errors
    /// [`Error::NotConverged`].
    pub fn near(&self, mode: &Mode) -> Result<Mode, Error> {
        let Mode { mut s, .. } = *mode;
        let mut on = self.slope_loads(&mode.right, s, Side::Right);
        let mut on_left = self.slope_loads(&mode.left, s, Side::Left);
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let at = self.beside(s)?;
            // T(s) right = on, so that on is what is left of the equations.
            let mut left = at.solve(on_left, Side::Left);
            left.normalise();
            let rest = left.product(&on);
            let mut right = at.solve(on, Side::Right);
            let size = right.normalise();
            on = self.slope_loads(&right, at.s, Side::Right);
            let change = rest * size / left.product(&on);
            s = at.s - change;
            let step = change.norm() / s.norm();
            if !step.is_finite() {
                break;
            }
            // What remains is the cube of the last step, or rounding where steps no longer shrink.
            let stays = step > 0.1 * last && last < STAYS;
            last = step;
            if step < CLOSE || stays {
                return Ok(Mode { s, right, left });
            }
            on_left = self.slope_loads(&left, s, Side::Left);
        }
        Err(Error::NotConverged)
    }

    /// The mode nearest to a value of `s`, as far as the stations move in it.
    ///
    /// # Errors
    /// [`Error::NotConverged`].
    pub fn mode_at(&self, s: Complex) -> Result<Mode, Error> {
        let at = self.beside(s)?;
        let ones = Vector::from_fn(self.stations(), |k| Complex::new(1.0 + 0.1 * k as f64, 0.0));
        self.turned(&at, at.response(&ones).stations)
    }

    /// Factors at `s`, or beside it where there is nothing to solve with.
    fn beside(&self, s: Complex) -> Result<At<'_>, Error> {
        self.at(s).or_else(|| self.at(s * (1.0 + 1e-10))).ok_or(Error::NotConverged)
    }

    /// Both vectors by steps that do not move `s`, from an approximation of the motion of the stations.
    fn turned(&self, at: &At<'_>, stations: Vector<Complex>) -> Result<Mode, Error> {
        let mut right = at.between(stations);
        let ones = Vector::from_fn(self.stations(), |k| Complex::new(1.0 - 0.1 * k as f64, 0.0));
        let mut left = at.adjoint(&ones);
        for _ in 0..2 {
            right = at.solve(self.slope_loads(&right, at.s, Side::Right), Side::Right);
            left = at.solve(self.slope_loads(&left, at.s, Side::Left), Side::Left);
            right.normalise();
            left.normalise();
        }
        self.near(&Mode { s: at.s, right, left })
    }

    /// Eigenvalues near a shift and the motions of the stations, the nearest first. The shift is real, and so are all
    /// vectors: planar motions are real where that of `y - i z` is the conjugate of that of `y + i z`, which alone is kept.
    fn krylov(&self, count: usize) -> Result<Vec<(Complex, Vector<Complex>)>, Error> {
        let typical = self.typical_frequency();
        let shift = Complex::new(SHIFT * typical, 0.0);
        let at = self.at(shift).ok_or(Error::NotConverged)?;
        let mut seed = 1_u64;
        let mut first = self.still(Kept::First);
        first.stations = Vector::from_fn(self.stations(), |_| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            Complex::new((seed >> 40) as f64 / (1 << 24) as f64 - 0.5, 0.0)
        });
        let first = at.solve_real(first);
        // The second half of a vector is the first times `s`: divided by what is typical, both weigh alike.
        let flat = |x: &Motion, v: &Motion| {
            let mut all = x.reals(1.0);
            all.extend(v.reals(1.0 / typical));
            all
        };
        let mut start = flat(&first, &first);
        let half = start.len() / 2;
        let most = (2 * count + 14).min(2 * half);
        normalise(&mut start);
        let mut basis = vec![start];
        let mut hessenberg = Matrix::<f64>::zeros(most, most);
        let (mut x, mut v) = (first.clone(), first);
        let mut size = most;
        for k in 0..most {
            x.set_reals(&basis[k][..half], 1.0);
            v.set_reals(&basis[k][half..], typical);
            let mut loads = self.momentum(&x, &v, shift);
            loads.scale(Complex::new(-1.0, 0.0));
            let w = at.solve_real(loads);
            x.add(shift, &w);
            let mut next = flat(&w, &x);
            let before = dot(&next, &next).sqrt();
            for _ in 0..2 {
                let shares: Vec<f64> = basis.iter().map(|own| dot(own, &next)).collect();
                for (j, (own, share)) in basis.iter().zip(&shares).enumerate() {
                    hessenberg[j][k] += share;
                    add_to(&mut next, -share, own);
                }
            }
            let rest = normalise(&mut next);
            if rest <= 1e-13 * before {
                size = k + 1;
                break;
            }
            if k + 1 < most {
                hessenberg[k + 1][k] = rest;
                basis.push(next);
            }
        }
        let small = Matrix::from_fn(size, size, |i, j| Complex::new(hessenberg[i][j], 0.0));
        let mut values = vec![Complex::ZERO; size];
        if !eigenvalues(small.clone().as_flattened_mut(), &mut values) {
            return Err(Error::NotConverged);
        }
        values.sort_by(|a, b| b.norm().total_cmp(&a.norm()));
        let rigid = RIGID * typical;
        let oscillates = |value: &Complex| value.norm() > 0.0 && (shift + value.inv()).im > rigid;
        let pairs = values.into_iter().filter(oscillates).take(count).filter_map(|value| {
            let near = value * (1.0 + 1e-12);
            let shifted = Matrix::from_fn(size, size, |i, j| if i == j { small[i][j] - near } else { small[i][j] });
            let y = Lu::of(shifted)?.solve(&vec![Complex::new(1.0, 0.0); size]);
            let stations = Vector::from_fn(self.stations(), |i| (0..size).map(|j| y[j] * basis[j][i]).sum());
            Some((shift + value.inv(), stations))
        });
        Ok(pairs.collect())
    }

    /// That of the longest span between hinges, 1/s.
    fn typical_frequency(&self) -> f64 {
        let of_span = |span: &crate::Span| {
            let length: f64 = span.sections.iter().map(|(own, _)| own.length).sum();
            let wave = core::f64::consts::PI / length;
            let power = if span.line == Line::Bar { 2 } else { 4 };
            let own = span.sections.iter().map(|(own, _)| own.stiffness / own.mass).sum::<f64>();
            (own / span.sections.len() as f64 * wave.powi(power)).sqrt()
        };
        let lowest = self.spans().iter().map(of_span).fold(f64::INFINITY, f64::min);
        if lowest.is_finite() { lowest } else { 1.0 }
    }
}

impl Mode {
    /// Whether two modes are one.
    #[must_use]
    pub fn is_same(&self, other: &Self) -> bool {
        let product: Complex = self.right.flat().zip(other.right.flat()).map(|(a, b)| a.conj() * b).sum();
        self.is_near(other) && product.norm() > 0.999
    }

    fn is_near(&self, other: &Self) -> bool {
        (self.s - other.s).norm() < SAME * self.s.norm()
    }
}

fn normalise(x: &mut [f64]) -> f64 {
    let norm = dot(x, x).sqrt();
    x.iter_mut().for_each(|x| *x /= norm);
    norm
}
