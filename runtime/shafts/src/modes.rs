//! Modes: approximations from a Krylov space, each made exact by itself.
//!
//! The pencil is linear in twice as many unknowns, of which Arnoldi's method finds the modes nearest to a shift with one
//! factorisation. Each is then refined with the condensed `T(s)`: two-sided Newton steps converge cubically (K. Schreiber,
//! "Nonlinear Eigenvalue Problems: Newton-type Methods and Nonlinear Rayleigh Functionals", 2008).

use eigentol_contract::scalar::Real as _;
use eigentol_numerics::Complex;
use eigentol_numerics::algebra::{Lu, Matrix, Vector, add_to, dot, dot_complex};
use eigentol_numerics::eigenproblem::general::hessenberg_eigenvalues;

use crate::assembly::{Assembly, At};
use crate::error::Error;
use crate::gradients::{Form, SpanForm};
use crate::motion::{Kept, Motion, Side};
use crate::pencil::Pencil;
use crate::section::Line;

/// A mode: `T(s) right = 0` and `left^T T(s) = 0`.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// 1/s.
    pub s: Complex,
    /// Its shape at the stations.
    pub right: Vector<Complex>,
    /// The weights of its adjoint there.
    pub left: Vector<Complex>,
}

/// A mode, and `T` with its derivative at its `s`.
pub type Found = (Mode, Pencil);

/// Steps of inverse iteration before them.
const TURNS: usize = 4;
/// Newton steps at most; three are usual from a Krylov space, two from a neighbour.
const STEPS: usize = 12;
/// A relative step after which `s` and both vectors are as exact as rounding lets them be.
const CLOSE: f64 = 1e-9;
/// A relative step behind which the next, unless it is much smaller, is rounding in any motion ([`jitter`]).
const STAYS: f64 = 1e-7;
/// The square of an eigenvalue that is rounding, as a part of the terms that cancel in it.
const RIGID: f64 = 256.0 * f64::EPSILON;
/// What is slower than so many times that may be nothing but rounding.
const SLOW: f64 = 16.0;
/// The relative error of an approximation below which it is one of that mode.
const CONVERGED: f64 = 1e-2;
/// That below which the modes nearest to a shift are all among the approximations.
const KNOWN: f64 = 1e-4;
/// The most Krylov spaces.
const SPACES: usize = 6;
/// How far beside an eigenvalue, as a part of it, equations are solved that are singular there: as little as does.
const BESIDE: [f64; 5] = [0.0, 1e-10, 1e-8, 1e-6, 1e-4];
/// How far from an approximation its mode may be, in units of the error that is expected, and as a part of it in any case.
const FAR: f64 = 100.0;
const NEAR: f64 = 1e-2;
/// Steps that do not move `s` where those before have left a mode.
const AGAIN: usize = 6;
/// The most that resistance by the rate may be, as a part of stiffness, where motions are sought.
const GATHERED: f64 = 0.7;
/// Radians by which a determinant may turn in half a step along an edge.
const TURN: f64 = 0.9;
/// Distance of equal eigenvalues as a part of them.
const SAME: f64 = 1e-7;
/// Distance of eigenvalues, as a part of them, below which steps do not tell their modes from combinations.
const BLENDED: f64 = 1e-5;
/// Rounding of an eigenvalue in units of that of the terms.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// How far beside an eigenvalue another one near it is looked for, as a part of it.
const APART: f64 = 1e-5;
/// What is left of a unit vector without the known modes, below which no other is near.
const ALONE: f64 = 1e-3;
/// Most modes that one is looked for beside.
const EQUAL: usize = 4;
/// The most motions that grow without oscillating which are looked for.
const DIVERGENT: usize = 12;
/// The shift as a part of a typical frequency: rigid motions have none.
const SHIFT: f64 = 0.1;

impl Assembly {
    /// Up to `count` modes of lowest `|s|` that oscillate and in which stations move, by frequency. The search can miss one:
    /// [`Self::count_within`] tells.
    ///
    /// # Errors
    /// [`Error::NotConverged`].
    pub fn modes(&self, count: usize) -> Result<Vec<Found>, Error> {
        let rigid = self.rigid();
        // Where one of them has been lost, a larger space knows it better.
        for more in [2, 8] {
            let wanted = |s: Complex| s.im > rigid && !self.gathers(s);
            let (mut modes, lost) = self.of_krylov((count + more, count), wanted)?;
            modes.sort_by(|(a, _), (b, _)| a.s.norm().total_cmp(&b.s.norm()));
            modes.truncate(count);
            let complete = modes.len() == count && modes.iter().all(|(mode, _)| mode.s.norm() < lost);
            modes.sort_by(|(a, _), (b, _)| a.s.im.total_cmp(&b.s.im));
            if complete || lost.is_infinite() {
                return Ok(modes);
            }
        }
        Err(Error::NotConverged)
    }

    /// Whether these eigenvalues are all that the search would find below the greatest of them, as far as a Krylov space tells.
    #[must_use]
    pub fn has_all(&self, known: &[Complex]) -> bool {
        let rigid = self.rigid();
        let wanted = |s: Complex| s.im > rigid && !self.gathers(s);
        let Ok(found) = self.krylov((known.len() + 2, known.len()), &wanted) else { return false };
        let greatest = known.iter().map(|s| s.norm()).fold(0.0, f64::max);
        let is_known = |own: &Ritz| {
            let reach = (FAR * own.rest).max(SAME) * own.s.norm();
            own.rest < KNOWN && known.iter().any(|s| (s - own.s).norm() < reach)
        };
        found.iter().filter(|own| own.s.norm() < greatest * (1.0 - NEAR)).all(is_known)
    }

    /// The number of motions that grow without oscillating, as on springs that push away, at rates up to those of the lowest
    /// frequencies.
    ///
    /// # Errors
    /// [`Error::NotConverged`].
    pub fn divergent(&self) -> Result<usize, Error> {
        let rigid = self.rigid();
        Ok(self.of_krylov((DIVERGENT, DIVERGENT), |s| s.im.abs() <= rigid && s.re > rigid)?.0.len())
    }

    /// The wanted modes of a Krylov space, made exact, and the least size of an approximation that led to none.
    fn of_krylov(&self, count: (usize, usize), wanted: impl Fn(Complex) -> bool) -> Result<(Vec<Found>, f64), Error> {
        let found = self.krylov(count, &wanted)?;
        let near: Vec<Complex> = found.iter().map(|own| own.s).collect();
        let starts = found.iter().zip(self.pencils(&near)).map(|(own, pencil)| {
            let stations = own.stations.clone()?;
            let (factors, pencil, _) = self.factored_beside(own.s, pencil)?;
            let start = turned(&pencil, &factors, own.s, stations);
            let next = self.step(start.clone(), pencil).filter(|(_, step, _)| *step < CONVERGED);
            Some(next.map_or(start, |(mode, ..)| mode))
        });
        let starts: Vec<Mode> = starts.collect::<Option<_>>().ok_or(Error::NotConverged)?;
        let (mut modes, mut lost): (Vec<Found>, _) = (Vec::new(), f64::INFINITY);
        for ((found, start), own) in self.refined(&starts).into_iter().zip(starts).zip(&found) {
            // What a space knows well is not another mode: steps from there may have gone to one.
            let reach = (FAR * own.rest).max(NEAR) * own.s.norm();
            let stays = |(mode, _): &Found| (mode.s - own.s).norm() < reach || own.rest > CONVERGED;
            let found = found.filter(stays).or_else(|| {
                let again = Mode { s: own.s, ..start };
                self.with_all_unknowns(&again, AGAIN).filter(stays)
            });
            let Some((mode, pencil)) = found else {
                if own.s.norm() > SLOW * self.rigid() {
                    lost = lost.min(own.s.norm());
                }
                continue;
            };
            // Both of two equal ones are found with the first.
            if wanted(mode.s) && !modes.iter().any(|(other, _)| other.is_near(&mode)) {
                modes.push((mode, pencil));
            }
        }
        for _ in 0..EQUAL {
            let others = self.others(&modes);
            if others.is_empty() {
                break;
            }
            modes.extend(others);
            self.separate_each(&mut modes.iter_mut().collect::<Vec<_>>());
        }
        modes.retain(|(mode, _)| wanted(mode.s));
        Ok((modes, lost))
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

    /// Another mode with an eigenvalue near each of these, where there is one: of a round rotor at rest each has an equal one, at
    /// low speeds a near one, and a Krylov space may know one of them only. It is what inverse iteration leaves of a motion
    /// without the known modes, where that is anything.
    fn others(&self, modes: &[Found]) -> Vec<Found> {
        let near = |a: &Mode, b: &Mode| (a.s - b.s).norm() < APART / ALONE * a.s.norm();
        let mut starts = Vec::new();
        for (k, (mode, pencil)) in modes.iter().enumerate() {
            if modes[..k].iter().any(|(other, _)| near(other, mode)) {
                continue;
            }
            let aside = mode.s * APART;
            let mut matrix = pencil.matrix.clone();
            add_scaled(&mut matrix, aside, &pencil.slope);
            let Some(factors) = Lu::of(matrix) else { continue };
            let ones = Vector::from_fn(self.stations(), |k| Complex::new(1.0, 0.3 * (k % 3) as f64));
            let mut right = factors.solve(&ones);
            let mut left = factors.solve_transposed(&ones);
            normalised(&mut right);
            normalised(&mut left);
            for (known, _) in modes.iter().filter(|(other, _)| near(mode, other)) {
                let moved = times(&pencil.slope, &known.right);
                let below = dot_complex(&known.left, &moved);
                let share = dot_complex(&known.left, &times(&pencil.slope, &right)) / below;
                right.iter_mut().zip(&known.right).for_each(|(x, known)| *x -= share * known);
                let share = dot_complex(&left, &moved) / below;
                left.iter_mut().zip(&known.left).for_each(|(y, known)| *y -= share * known);
            }
            // What is left where no other is near is smaller by the distance from the known one as a part of that to the next.
            if normalised(&mut right) < 1.0 / ALONE && normalised(&mut left) < 1.0 / ALONE {
                starts.push(Mode { s: mode.s + aside, right, left });
            }
        }
        // Once more: beside an eigenvalue already the first step is small.
        let once: Vec<Mode> = self.refined(&starts).into_iter().flatten().map(|(mode, _)| mode).collect();
        let mut others: Vec<Found> = Vec::new();
        for found in self.refined(&once).into_iter().flatten() {
            if !modes.iter().chain(&others).any(|(known, _)| known.is_same(&found.0)) {
                others.push(found);
            }
        }
        others
    }

    /// Derivatives of the eigenvalue of a mode by the numbers of each section of each span and by the speed of each span.
    #[must_use]
    pub fn slopes(&self, mode: &Mode) -> Vec<SpanForm> {
        let Mode { s, right, left } = mode;
        let mut all = self.gradients(&[Form { left, s: *s, right }]).swap_remove(0);
        let by_s = all.iter().map(|own| own.rate).sum::<Complex>() + self.slope_of_stations(left, *s, right);
        for own in &mut all {
            own.rate /= -by_s;
            own.speed /= -by_s;
            own.sections.iter_mut().flatten().for_each(|x| *x /= -by_s);
        }
        all
    }

    /// Modes from approximations, for example those at a neighbouring speed or design, by Newton's method side by side in the
    /// vectors of the processor, each with the pencil at its `s`; `None` for one that does not converge. The bits of each do not
    /// depend on the others, but of those that are nearly equal.
    #[must_use]
    pub fn refined(&self, starts: &[Mode]) -> Vec<Option<Found>> {
        let mut running: Vec<(usize, Mode, f64)> =
            starts.iter().enumerate().map(|(k, mode)| (k, mode.clone(), f64::INFINITY)).collect();
        let mut found = vec![None; starts.len()];
        let terms = self.terms();
        for _ in 0..STEPS {
            if running.is_empty() {
                break;
            }
            let s: Vec<Complex> = running.iter().map(|(_, mode, _)| mode.s).collect();
            let mut next = Vec::with_capacity(running.len());
            for ((place, mode, last), pencil) in running.into_iter().zip(self.pencils(&s)) {
                let Some((mode, step, pencil)) = self.step(mode, pencil) else { continue };
                // What remains is the cube of the last step, or rounding where steps no longer shrink.
                let stays = step > 0.1 * last && step.max(last) < jitter(mode.s, terms);
                if step < CLOSE || stays {
                    found[place] = Some((mode, pencil));
                } else {
                    next.push((place, mode, step));
                }
            }
            running = next;
        }
        for (place, found) in found.iter_mut().enumerate().filter(|(_, found)| found.is_none()) {
            *found = self.with_all_unknowns(&starts[place], 2);
        }
        self.separate_each(&mut found.iter_mut().flatten().collect::<Vec<_>>());
        found
    }

    fn separate_each(&self, modes: &mut [&mut Found]) {
        for k in 0..modes.len() {
            let (before, own) = modes.split_at_mut(k);
            before.iter_mut().for_each(|other| self.separate(other, own[0]));
        }
    }

    /// Makes two modes with nearly the same eigenvalue exact: where that is far from all others, steps are small for any
    /// combination of the two. Those that are modes follow from the two alone (Rayleigh and Ritz).
    fn separate(&self, first: &mut Found, second: &mut Found) {
        let (a, b) = (&first.0, &second.0);
        if (a.s - b.s).norm() > BLENDED * a.s.norm() {
            return;
        }
        let mean = 0.5 * (a.s + b.s);
        let Some(Pencil { matrix, slope }) = self.pencils(&[mean]).pop() else { return };
        let form =
            |matrix: &Matrix<Complex>, left: &Mode, right: &Mode| dot_complex(&left.left, &times(matrix, &right.right));
        let all = |m: &Matrix<Complex>| [[form(m, a, a), form(m, a, b)], [form(m, b, a), form(m, b, b)]];
        let ([[p, q], [r, t]], [[e, f], [g, h]]) = (all(&matrix), all(&slope));
        let below = e * h - f * g;
        if below.norm() < ALONE * ALONE * (e * h).norm() {
            return;
        }
        // The determinant of the first and a number times the second.
        let half = -0.5 * (p * h + e * t - q * g - f * r) / below;
        let root = (half * half - (p * t - q * r) / below).sqrt();
        let rounding = ROUNDING * (mean.norm() + self.terms() / mean.norm());
        if root.norm() <= rounding {
            return;
        }
        let combined = |change: Complex| {
            let [[p, q], [r, t]] = [[p + change * e, q + change * f], [r + change * g, t + change * h]];
            // From the larger row, and the larger column.
            let right = if p.norm() + q.norm() > r.norm() + t.norm() { [q, -p] } else { [t, -r] };
            let left = if p.norm() + r.norm() > q.norm() + t.norm() { [r, -p] } else { [t, -q] };
            let sum = |[x, y]: [Complex; 2], of: fn(&Mode) -> &Vector<Complex>| {
                let mut sum = Vector::from_fn(of(a).len(), |k| x * of(a)[k] + y * of(b)[k]);
                normalised(&mut sum);
                sum
            };
            Mode { s: mean + change, right: sum(right, |mode| &mode.right), left: sum(left, |mode| &mode.left) }
        };
        let both = [combined(half + root), combined(half - root)];
        let exact = both.map(|mode| {
            let pencil = self.pencils(&[mode.s]).pop()?;
            let (mode, step, pencil) = self.step(mode, pencil)?;
            (step < CLOSE).then_some((mode, pencil))
        });
        if let [Some(one), Some(other)] = exact {
            (*first, *second) = (one, other);
        }
    }

    /// The same with all unknowns in place of those of the stations: `T` has poles where spans vibrate between stations that
    /// stand still, and next to one Newton's method leaves it. So many steps do not move `s`.
    fn with_all_unknowns(&self, start: &Mode, turns: usize) -> Option<Found> {
        let (mut s, terms) = (start.s, self.terms());
        let at = self.beside(s)?;
        let (mut right, mut left) = (at.condensed.motion(&start.right), at.condensed.weights(&start.left));
        for _ in 0..turns {
            right = at.solve(self.slope_loads(&right, s, Side::Right), Side::Right);
            left = at.solve(self.slope_loads(&left, s, Side::Left), Side::Left);
            right.normalise();
            left.normalise();
        }
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let at = self.beside(s)?;
            // P(s) right = on, so that on is what is left of the equations.
            let on = self.slope_loads(&right, s, Side::Right);
            left = at.solve(self.slope_loads(&left, s, Side::Left), Side::Left);
            left.normalise();
            let rest = left.product(&on);
            right = at.solve(on, Side::Right);
            let size = right.normalise();
            let change = rest * size / left.product(&self.slope_loads(&right, at.s, Side::Right));
            s = at.s - change;
            let step = change.norm() / s.norm();
            let stays = step > 0.1 * last && step.max(last) < jitter(s, terms);
            last = step;
            if !step.is_finite() {
                return None;
            }
            if step < CLOSE || stays {
                let (mut right, mut left) = (right.stations, left.stations);
                normalised(&mut right);
                normalised(&mut left);
                return Some((Mode { s, right, left }, self.pencils(&[s]).pop()?));
            }
        }
        None
    }

    /// Factors at `s`, or so far beside it that rounding leaves something to solve with.
    fn beside(&self, s: Complex) -> Option<At<'_>> {
        BESIDE.iter().find_map(|part| self.at(s * (1.0 + part)))
    }

    /// The same of the stations alone, from the pencil at `s`: factors, the pencil that they are of, and how far it is beside `s`.
    fn factored_beside(&self, s: Complex, pencil: Pencil) -> Option<(Lu<Complex>, Pencil, Complex)> {
        if let Some(factors) = factored(&pencil) {
            return Some((factors, pencil, Complex::ZERO));
        }
        BESIDE[1..].iter().find_map(|part| {
            let beside = self.pencils(&[s * (1.0 + part)]).pop()?;
            Some((factored(&beside)?, beside, s * *part))
        })
    }

    /// A two-sided Newton step, its size relative to `s`, and the pencil behind it, as far as the step is small.
    fn step(&self, mode: Mode, pencil: Pencil) -> Option<(Mode, f64, Pencil)> {
        let Mode { mut s, right, left } = mode;
        let (factors, mut pencil, aside) = self.factored_beside(s, pencil)?;
        // T(s) right = on, so that on is what is left of the equations.
        let on = times(&pencil.slope, &right);
        let mut right = factors.solve(&on);
        let size = normalised(&mut right);
        let mut left = factors.solve_transposed(&times_transposed(&pencil.slope, &left));
        normalised(&mut left);
        let rest = dot_complex(&left, &on) * size;
        let change = rest / dot_complex(&left, &times(&pencil.slope, &right));
        // Where rounding is all that is left of the determinant, `s` is as exact as it can be.
        let change = if aside == Complex::ZERO { change } else { Complex::ZERO };
        s -= change;
        let step = change.norm() / s.norm();
        add_scaled(&mut pencil.matrix, -change - aside, &pencil.slope);
        step.is_finite().then_some((Mode { s, right, left }, step, pencil))
    }

    /// The mode nearest to a value of `s`, as far as the stations move in it.
    ///
    /// # Errors
    /// [`Error::NotConverged`].
    pub fn mode_at(&self, s: Complex) -> Result<Mode, Error> {
        let pencil = self.pencils(&[s]).pop().ok_or(Error::NotConverged)?;
        let factors = factored(&pencil).ok_or(Error::NotConverged)?;
        let ones = Vector::from_fn(self.stations(), |k| Complex::new(1.0 + 0.1 * k as f64, 0.0));
        let start = turned(&pencil, &factors, s, factors.solve(&ones));
        self.refined(&[start]).pop().flatten().map(|(mode, _)| mode).ok_or(Error::NotConverged)
    }

    /// Wanted eigenvalues near a shift and the motions of the stations, the nearest first. A shift far from all of them does not
    /// tell them from each other: as long as one of the nearest, up to `sure` wanted ones, has not converged, the next shift is
    /// what the slowest of them is, or the space has more directions.
    fn krylov(&self, (count, sure): (usize, usize), wanted: &impl Fn(Complex) -> bool) -> Result<Vec<Ritz>, Error> {
        let (mut shift, mut steps) = (SHIFT * self.typical_frequency(), 2 * count + 14);
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

    /// Whether what lags resists by its rate nearly as much as by its stiffness, or more: where both are opposite, at
    /// `-1 / lag + i speed`, infinitely many motions gather, which die away at once.
    fn gathers(&self, s: Complex) -> bool {
        let of_span = |span: &crate::Span| {
            let rate = span.directions().iter().map(|d| (s - Complex::new(0.0, d * span.speed)).norm());
            let rate = rate.fold(f64::INFINITY, f64::min);
            span.sections.iter().any(|(own, _)| own.lag * rate > GATHERED)
        };
        self.spans().iter().any(of_span)
    }

    /// What is slower is a rigid motion, as far as rounding lets one see.
    fn rigid(&self) -> f64 {
        (RIGID * self.terms()).sqrt()
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
        let mut space = Space { shift, basis: Vec::new(), columns: Vec::new() };
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
            v.set_reals(&space.basis[k][half..], space.typical());
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

/// A relative step behind which the next, unless it is much smaller, is rounding: that of the terms, which cancel in a slow motion.
fn jitter(s: Complex, terms: f64) -> f64 {
    STAYS.max(ROUNDING * terms / s.norm_sqr())
}

fn factored(pencil: &Pencil) -> Option<Lu<Complex>> {
    Lu::of(pencil.matrix.clone())
}

/// Both vectors by steps that do not move `s`, which cost little, from an approximation of the motion of the stations.
fn turned(pencil: &Pencil, factors: &Lu<Complex>, s: Complex, stations: Vector<Complex>) -> Mode {
    let mut right = stations;
    let mut left =
        factors.solve_transposed(&Vector::from_fn(right.len(), |k| Complex::new(1.0 + 0.3 * (k % 5) as f64, 0.0)));
    for _ in 0..TURNS {
        right = factors.solve(&times(&pencil.slope, &right));
        left = factors.solve_transposed(&times_transposed(&pencil.slope, &left));
        normalised(&mut right);
        normalised(&mut left);
    }
    Mode { s, right, left }
}

fn times(matrix: &Matrix<Complex>, x: &[Complex]) -> Vector<Complex> {
    matrix.iter().map(|row: &[Complex]| dot_complex(row, x)).collect()
}

fn add_scaled(to: &mut Matrix<Complex>, factor: Complex, from: &Matrix<Complex>) {
    let entries = to.as_flattened_mut().iter_mut().zip(from.as_flattened());
    entries.for_each(|(to, from)| *to += factor * from);
}

fn times_transposed(matrix: &Matrix<Complex>, x: &[Complex]) -> Vector<Complex> {
    let mut sum = Vector::zeros(matrix.column_count());
    for (row, x) in matrix.iter().zip(x) {
        sum.iter_mut().zip(row).for_each(|(sum, value)| *sum += x * value);
    }
    sum
}

/// Scales to one; returns the factor.
fn normalised(x: &mut [Complex]) -> f64 {
    let factor = x.iter().map(Complex::norm_sqr).sum::<f64>().sqrt().recip();
    x.iter_mut().for_each(|x| *x *= factor);
    factor
}

/// An orthonormal basis with what the shifted and inverted pencil is in it, and what it leaves of the last direction.
struct Space {
    shift: f64,
    /// One more than there are columns.
    basis: Vec<Vec<f64>>,
    /// Of the Hessenberg matrix, down to what is left of the next direction.
    columns: Vec<Vec<f64>>,
}

/// An approximation from a Krylov space: with the motion of the stations if it is wanted, and its error as far as what is left of its equation says.
struct Ritz {
    s: Complex,
    stations: Option<Vector<Complex>>,
    rest: f64,
}

impl Space {
    fn typical(&self) -> f64 {
        self.shift / SHIFT
    }

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
        v.reals_into(1.0 / self.typical(), &mut all);
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

impl Mode {
    /// Whether two modes are one.
    #[must_use]
    pub fn is_same(&self, other: &Self) -> bool {
        let product: Complex = self.right.iter().zip(&other.right).map(|(a, b)| a.conj() * b).sum();
        let sizes = [self, other].map(|mode| mode.right.iter().map(Complex::norm_sqr).sum::<f64>().sqrt());
        self.is_near(other) && product.norm() > 0.999 * sizes[0] * sizes[1]
    }

    fn is_near(&self, other: &Self) -> bool {
        (self.s - other.s).norm() < SAME * self.s.norm()
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
