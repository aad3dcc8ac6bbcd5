//! Modes: approximations from a Krylov space, each made exact by itself.
//!
//! The pencil is linear in twice as many unknowns, of which Arnoldi's method finds the modes nearest to a shift with one
//! factorisation. Each is then refined with the condensed `T(s)`: two-sided Newton steps converge cubically (K. Schreiber,
//! "Nonlinear Eigenvalue Problems: Newton-type Methods and Nonlinear Rayleigh Functionals", 2008).

use eigentol_numerics::Complex;
use eigentol_numerics::algebra::{Lu, Matrix, Vector, dot_complex};

use crate::assembly::{Assembly, At};
use crate::error::Error;
use crate::gradients::{Form, SpanForm};
use crate::krylov::{KNOWN, Ritz, SLOW};
use crate::motion::Side;
use crate::pencil::{Pencil, times};

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
/// The relative error of an approximation below which it is one of that mode.
const CONVERGED: f64 = 1e-2;
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
/// What is left of a unit vector without known modes, above which it is none of them.
const NEW: f64 = 0.05;
/// How much more than far from a pole spans resist where steps may creep.
const CREEPS: f64 = 10.0;
/// How far beside an eigenvalue another one near it is looked for, as a part of it.
const APART: f64 = 1e-5;
/// What is left of a unit vector without the known modes, below which no other is near.
const ALONE: f64 = 1e-3;
/// Most modes that one is looked for beside.
const EQUAL: usize = 4;
/// The most motions that grow without oscillating which are looked for.
const DIVERGENT: usize = 12;

impl Assembly {
    /// Up to `count` modes of lowest `|s|`, by frequency, where nothing is apart from the rest.
    pub(crate) fn lowest(&self, count: usize) -> Result<Vec<Found>, Error> {
        // Where one of them has been lost, a larger space knows it better.
        for more in [2, 8] {
            let (mut modes, lost) = self.of_krylov((count + more, count), |s| self.oscillates(s))?;
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

    /// The different oscillations that continue these.
    pub(crate) fn following(&self, from: &[Mode]) -> Vec<Found> {
        let mut found: Vec<Found> = Vec::new();
        for own in self.refined(from).into_iter().flatten() {
            if self.oscillates(own.0.s) && self.is_new(&own.0, found.iter().map(|(other, _)| other)) {
                found.push(own);
            }
        }
        found
    }

    /// Whether two eigenvalues are equal, as far as the rounding of the terms lets one see, which is more for slow ones.
    fn are_equal(&self, a: &Mode, b: &Mode) -> bool {
        let apart = (a.s - b.s).norm() / a.s.norm();
        apart < SAME || apart < NEAR && apart < jitter(a.s, self.terms())
    }

    /// Whether a mode is none of these, nor a combination of such as have its eigenvalue: of equal ones any combinations are modes.
    pub(crate) fn is_new<'a>(&self, mode: &Mode, among: impl IntoIterator<Item = &'a Mode>) -> bool {
        let mut known: Vec<Vector<Complex>> = Vec::new();
        let rest = |x: &Vector<Complex>, known: &[Vector<Complex>]| {
            let mut rest = x.clone();
            normalised(&mut rest);
            for direction in known {
                let share: Complex = direction.iter().zip(&rest).map(|(a, b)| a.conj() * b).sum();
                rest.iter_mut().zip(direction).for_each(|(x, along)| *x -= share * along);
            }
            let size = normalised(&mut rest).recip();
            (size > NEW).then_some(rest)
        };
        for other in among.into_iter().filter(|other| self.are_equal(mode, other)) {
            known.extend(rest(&other.right, &known));
        }
        rest(&mode.right, &known).is_some()
    }

    fn oscillates(&self, s: Complex) -> bool {
        s.im > self.rigid() && !self.gathers(s)
    }

    /// Whether these are all below this size, as far as a Krylov space tells that knows so many.
    pub(crate) fn has(&self, known: &[Mode], sure: usize, greatest: f64) -> bool {
        let Ok(found) = self.krylov((sure + 2, sure), &|s| self.oscillates(s)) else { return false };
        let is_known = |own: &Ritz| {
            let reach = (FAR * own.rest).max(SAME) * own.s.norm();
            own.rest < KNOWN && known.iter().any(|mode| (mode.s - own.s).norm() < reach)
        };
        found.iter().filter(|own| own.s.norm() < greatest * (1.0 - NEAR)).all(is_known)
    }

    /// The number of motions that grow without oscillating in what is not apart.
    pub(crate) fn diverging(&self) -> Result<usize, Error> {
        let rigid = self.rigid();
        Ok(self.of_krylov((DIVERGENT, DIVERGENT), |s| s.im.abs() <= rigid && s.re > rigid)?.0.len())
    }

    /// The wanted modes of a Krylov space, made exact, and the least size of an approximation that led to none.
    fn of_krylov(&self, count: (usize, usize), wanted: impl Fn(Complex) -> bool) -> Result<(Vec<Found>, f64), Error> {
        let found = self.krylov(count, &wanted)?;
        let near: Vec<Complex> = found.iter().map(|own| own.s).collect();
        let starts = found.iter().zip(self.regular(&near)).map(|(own, pencil)| {
            let stations = own.stations.clone()?;
            let next_to_pole = pencil.s != own.s;
            let (factors, pencil) = self.factored_beside(pencil)?;
            let start = turned(&pencil, &factors, (own.s, next_to_pole), stations);
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
            let is_known = modes.iter().any(|(other, _)| other.is_near(&mode))
                || !self.is_new(&mode, modes.iter().map(|(other, _)| other));
            if wanted(mode.s) && !is_known {
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
        let is_first = |k: &usize| !modes[..*k].iter().any(|(other, _)| near(other, &modes[*k].0));
        let apart: Vec<&Mode> = (0..modes.len()).filter(is_first).map(|k| &modes[k].0).collect();
        let beside: Vec<Complex> = apart.iter().map(|mode| mode.s * (1.0 + APART)).collect();
        let mut starts = Vec::new();
        for (mode, Pencil { s, matrix, .. }) in apart.into_iter().zip(self.pencils(&beside)) {
            let Some(factors) = Lu::of(matrix.clone()) else { continue };
            let ones = Vector::from_fn(self.stations(), |k| Complex::new(1.0, 0.3 * (k % 3) as f64));
            let mut right = factors.solve(&ones);
            let mut left = factors.solve_transposed(&ones);
            normalised(&mut right);
            normalised(&mut left);
            for (known, _) in modes.iter().filter(|(other, _)| near(mode, other)) {
                let moved = times(&matrix, &known.right);
                let below = dot_complex(&known.left, &moved);
                let share = dot_complex(&known.left, &times(&matrix, &right)) / below;
                right.iter_mut().zip(&known.right).for_each(|(x, known)| *x -= share * known);
                let share = dot_complex(&left, &moved) / below;
                left.iter_mut().zip(&known.left).for_each(|(y, known)| *y -= share * known);
            }
            // What is left where no other is near is smaller by the distance from the known one as a part of that to the next.
            if normalised(&mut right) < 1.0 / ALONE && normalised(&mut left) < 1.0 / ALONE {
                starts.push(Mode { s, right, left });
            }
        }
        let once = self.refined(&starts).into_iter().zip(&starts).filter_map(|(found, start)| {
            let stays = |(mode, _): &Found| near(start, mode);
            let found = found.filter(stays).or_else(|| self.with_all_unknowns(start, 2).filter(stays));
            found.map(|(mode, _)| mode)
        });
        // Once more: beside an eigenvalue already the first step is small.
        let once: Vec<Mode> = once.collect();
        let mut all = modes.to_vec();
        for found in self.refined(&once).into_iter().flatten() {
            // Near a pole steps may creep to where nothing is.
            let is_sure = self.poles(&found.1) < CREEPS;
            let found = if is_sure { Some(found) } else { self.with_all_unknowns(&found.0, 2) };
            let Some(found) = found else { continue };
            if self.is_new(&found.0, all.iter().map(|(other, _)| other)) {
                all.push(found);
            }
        }
        all.split_off(modes.len())
    }

    /// Derivatives of the eigenvalue of a mode by the numbers of each section of each span and by the speed of each span.
    #[must_use]
    pub fn slopes(&self, mode: &Mode) -> Vec<SpanForm> {
        let Mode { right, left, .. } = mode;
        let s = self.regular(&[mode.s])[0].s;
        let mut all = self.gradients(&[Form { left, s, right }]).swap_remove(0);
        let by_s = all.iter().map(|own| own.rate).sum::<Complex>() + self.slope_of_stations(left, s, right);
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
            for ((place, mode, last), pencil) in running.into_iter().zip(self.regular(&s)) {
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
        let Some(Pencil { s, matrix, slope }) = self.regular(&[mean]).pop() else { return };
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
            Mode { s: s + change, right: sum(right, |mode| &mode.right), left: sum(left, |mode| &mode.left) }
        };
        let both = [combined(half + root), combined(half - root)];
        let exact = both.map(|mode| {
            let pencil = self.regular(&[mode.s]).pop()?;
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
            let before = s;
            s = at.s - rest * size / left.product(&self.slope_loads(&right, at.s, Side::Right));
            let step = (s - before).norm() / s.norm();
            let stays = step > 0.1 * last && step.max(last) < jitter(s, terms);
            last = step;
            if !step.is_finite() {
                return None;
            }
            if step < CLOSE || stays {
                let (mut right, mut left) = (right.stations, left.stations);
                normalised(&mut right);
                normalised(&mut left);
                return Some((Mode { s, right, left }, self.regular(&[s]).pop()?));
            }
        }
        None
    }

    /// Factors at `s`, or so far beside it that rounding leaves something to solve with, and no pole is next to it.
    fn beside(&self, s: Complex) -> Option<At<'_>> {
        let s = self.regular(&[s]).pop()?.s;
        BESIDE.iter().find_map(|part| self.at(s * (1.0 + part)))
    }

    /// The same of the stations alone, and the pencil that the factors are of.
    fn factored_beside(&self, pencil: Pencil) -> Option<(Lu<Complex>, Pencil)> {
        if let Some(factors) = factored(&pencil) {
            return Some((factors, pencil));
        }
        BESIDE[1..].iter().find_map(|part| {
            let beside = self.pencils(&[pencil.s * (1.0 + part)]).pop()?;
            Some((factored(&beside)?, beside))
        })
    }

    /// A two-sided Newton step from a pencil at `s` or beside it, its size relative to `s`, and the pencil behind it, as far as
    /// the step is small; one beside stays there.
    fn step(&self, mode: Mode, pencil: Pencil) -> Option<(Mode, f64, Pencil)> {
        let Mode { s: before, right, left } = mode;
        let next_to_pole = pencil.s != before;
        let (factors, mut pencil) = self.factored_beside(pencil)?;
        let [on, against] = pencil.loads(next_to_pole, &right, &left);
        let mut right = factors.solve(&on);
        let size = normalised(&mut right);
        let mut left = factors.solve_transposed(&against);
        normalised(&mut left);
        let rest = dot_complex(&left, &on) * size;
        let change = rest / dot_complex(&left, &times(&pencil.slope, &right));
        let s = pencil.s - change;
        let step = (s - before).norm() / s.norm();
        if !next_to_pole {
            add_scaled(&mut pencil.matrix, -change, &pencil.slope);
            pencil.s = s;
        }
        step.is_finite().then_some((Mode { s, right, left }, step, pencil))
    }

    /// The mode nearest to a value of `s`, as far as the stations move in it.
    ///
    /// # Errors
    /// [`Error::NotConverged`].
    pub fn mode_at(&self, s: Complex) -> Result<Mode, Error> {
        let pencil = self.regular(&[s]).pop().ok_or(Error::NotConverged)?;
        let factors = factored(&pencil).ok_or(Error::NotConverged)?;
        let ones = Vector::from_fn(self.stations(), |k| Complex::new(1.0 + 0.1 * k as f64, 0.0));
        let start = turned(&pencil, &factors, (s, pencil.s != s), factors.solve(&ones));
        self.refined(&[start]).pop().flatten().map(|(mode, _)| mode).ok_or(Error::NotConverged)
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
    pub(crate) fn rigid(&self) -> f64 {
        (RIGID * self.terms()).sqrt()
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
fn turned(
    pencil: &Pencil,
    factors: &Lu<Complex>,
    (s, next_to_pole): (Complex, bool),
    stations: Vector<Complex>,
) -> Mode {
    let mut right = stations;
    let mut left =
        factors.solve_transposed(&Vector::from_fn(right.len(), |k| Complex::new(1.0 + 0.3 * (k % 5) as f64, 0.0)));
    for _ in 0..TURNS {
        let [on, against] = pencil.loads(next_to_pole, &right, &left);
        right = factors.solve(&on);
        left = factors.solve_transposed(&against);
        normalised(&mut right);
        normalised(&mut left);
    }
    Mode { s, right, left }
}

fn add_scaled(to: &mut Matrix<Complex>, factor: Complex, from: &Matrix<Complex>) {
    let entries = to.as_flattened_mut().iter_mut().zip(from.as_flattened());
    entries.for_each(|(to, from)| *to += factor * from);
}

/// Scales to one; returns the factor.
fn normalised(x: &mut [Complex]) -> f64 {
    let factor = x.iter().map(Complex::norm_sqr).sum::<f64>().sqrt().recip();
    x.iter_mut().for_each(|x| *x *= factor);
    factor
}

impl Mode {
    fn is_near(&self, other: &Self) -> bool {
        (self.s - other.s).norm() < SAME * self.s.norm()
    }
}
