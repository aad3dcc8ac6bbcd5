//! Modes of mechanisms with shafts, the stability that follows from them, and how they move what spins.

use super::mode::{Behaviour, Mode};
use super::normalisation::{Normalisation, normalise};
use crate::algebra::{Cholesky, Lu, Matrix, dot_complex};
use crate::constraints::{Structure, Tangent};
use crate::kernels::Kernels;
use crate::shafts::{Shafts, form, numbers};
use crate::{Complex, Description, Equilibrium, Stability};
use eigentol_contract::LineKind;
use eigentol_shafts::{Line, Others, Pencil};

/// After how many states in succession is asked whether there are others among the lowest.
const FOLLOWED: usize = 8;
/// Part of the distance to instability, as the last two states have it, for which a state is not judged by itself.
const SURE: f64 = 0.25;
/// The most steps between states that are not judged.
const UNJUDGED: f64 = 16.0;

/// What the states of a mechanism with shafts along an input have shown so far: modes near which the next are sought, and how far
/// it is to an instability. Empty without shafts.
#[derive(Clone, Debug, Default)]
#[doc(hidden)]
pub struct Followed {
    modes: Vec<Mode>,
    states: usize,
    /// The last value, and the last judged one with the greatest growth there, 1/s.
    last: f64,
    judged: Option<(f64, f64)>,
    sure: f64,
}

impl Followed {
    /// The modes of the last state.
    #[doc(hidden)]
    #[must_use]
    pub fn modes(&self) -> &[Mode] {
        &self.modes
    }

    /// Whether it is time to ask if there are others among the lowest.
    #[doc(hidden)]
    #[must_use]
    pub fn is_due(&self) -> bool {
        (self.states + 1).is_multiple_of(FOLLOWED)
    }

    /// Goes on from a state with these modes.
    #[doc(hidden)]
    pub fn join(&mut self, modes: &[Mode]) {
        self.modes = modes.to_vec();
    }

    /// Whether a state at this value of the input is stable as those before it were.
    #[doc(hidden)]
    #[must_use]
    pub fn vouch(&self, value: f64) -> bool {
        self.judged
            .is_some_and(|(place, _)| (value - place).abs() < self.sure.min(UNJUDGED * (value - self.last).abs()))
    }

    /// Takes a state with its modes; none if it was not judged.
    #[doc(hidden)]
    pub fn take(&mut self, value: f64, modes: &[Mode]) {
        self.last = value;
        if modes.is_empty() {
            return;
        }
        let growth = modes.iter().map(|mode| mode.s.re + mode.error).fold(f64::NEG_INFINITY, f64::max);
        self.sure = match self.judged {
            Some((place, before)) if growth.max(before) < 0.0 => {
                SURE * growth.abs() * ((value - place) / (growth - before)).abs()
            }
            _ => 0.0,
        };
        self.judged = Some((value, growth));
        self.states += 1;
        self.modes = modes.to_vec();
    }
}

/// The modes of a state of shafts with those among the lowest that are not known.
#[doc(hidden)]
#[must_use]
pub fn completed(state: &Equilibrium, modes: Vec<Mode>) -> Vec<Mode> {
    let known: Vec<_> = modes.iter().map(start).collect();
    match Shafts::of(state) {
        Ok(Some(shafts)) if !modes.is_empty() && !shafts.whole.has_all(&known) => {
            shafts.modes(state, &modes, Others::Lowest).unwrap_or(modes)
        }
        _ => modes,
    }
}

/// The modes of a state of shafts with those that continue others and are not among them.
#[doc(hidden)]
#[must_use]
pub fn joined(state: &Equilibrium, modes: Vec<Mode>, beside: &[Mode]) -> Vec<Mode> {
    let beside: Vec<_> = beside.iter().map(start).collect();
    let shafts = Shafts::of(state).ok().flatten();
    shafts.and_then(|shafts| shafts.modes(state, &modes, |_| Others::Continuing(&beside))).unwrap_or(modes)
}

/// Where to look for a mode at a neighbouring state.
fn start(mode: &Mode) -> eigentol_shafts::Mode {
    eigentol_shafts::Mode { s: mode.s, right: mode.shape.clone(), left: mode.left().into() }
}

/// The number of modes that are sought, those of lowest frequency, for each shaft.
const MODES: usize = 12;
/// The most of all.
const MOST_MODES: usize = 24;
/// Damping that is none, as a part of the greatest: many motions have none at all.
const UNDAMPED: f64 = 1e-12;
/// Rounding of an eigenvalue in units of that of the largest terms.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// How many modes are sought: so many for each shaft, which has one span fewer than stations.
fn count(of: &Description) -> usize {
    let bends = of.spans.iter().filter(|span| span.line != LineKind::Bar);
    let ends = bends.clone().flat_map(|span| span.ends.iter().filter_map(|end| Some(end.first()?.0)));
    let mut stations: Vec<usize> = ends.collect();
    stations.sort_unstable();
    stations.dedup();
    let shafts = stations.len().saturating_sub(bends.count()).max(1);
    (MODES * shafts).min(MOST_MODES)
}

impl Shafts {
    /// The modes at a state of these shafts: those that continue others, and more, of as many as are usual.
    pub(crate) fn modes<'a>(
        &self,
        at: &Equilibrium,
        nearby: &[Mode],
        others: impl FnOnce(usize) -> Others<'a>,
    ) -> Option<Vec<Mode>> {
        let starts: Vec<_> = nearby.iter().map(start).collect();
        let count = count(&at.description);
        let others = if starts.is_empty() { Others::Lowest(count) } else { others(count) };
        let found = self.whole.continued(&starts, others).ok()?;
        let mut modes = Vec::new();
        let (size, leading) = Normalisation::of(&at.description);
        for ((own, Pencil { s: place, matrix, slope }), within) in found {
            let eigentol_shafts::Mode { s, mut right, mut left } = own;
            let mass = &at.linear.mass;
            let weighs =
                normalise(&mut right, mass, size, leading.right) && normalise(&mut left, mass, size, leading.left);
            if !weighs {
                return None;
            }
            let moved: Vec<f64> = right.iter().map(|x| x.norm_sqr().sqrt()).collect();
            let size = |row: &[Complex]| row.iter().zip(&moved).map(|(a, x)| a.norm_sqr().sqrt() * x).sum::<f64>();
            let sizes: Vec<f64> = matrix.iter().map(size).collect();
            let terms: f64 = left.iter().zip(&sizes).map(|(l, size)| l.norm() * size).sum();
            let slope: Complex = left.iter().zip(slope.iter()).map(|(l, row)| l * dot_complex(row, &right)).sum();
            let error = ROUNDING * (terms / slope.norm() + s.norm() + 0.5 * within / s.norm());
            let rest = |(row, size): (&[Complex], &f64)| dot_complex(row, &right).norm() / size.max(f64::MIN_POSITIVE);
            let rest = matrix.iter().zip(&sizes).map(rest).fold(0.0, f64::max);
            let behaviour = Behaviour::of_general(s, error, false);
            modes.push(Mode::general([s, place], (right, left), behaviour, rest, error));
        }
        Some(modes)
    }

    /// Adds what spins of the shafts to the sums of the kernel `whirl` of each mode.
    pub(crate) fn add_to_whirls(&self, of: &Description, modes: &[Mode], sums: &mut [[f64; 7]]) {
        let all = self.spans.inertia(&modes.iter().map(|mode| form(mode, mode)).collect::<Vec<_>>());
        sums.iter_mut().zip(all).for_each(|(sums, own)| self.add_to_whirl(of, &own, sums));
    }

    fn add_to_whirl(&self, of: &Description, spans: &[[f64; 2]], sums: &mut [f64; 7]) {
        let [moment, lateral, torsional, axial, eccentric, moving, still] = sums;
        let before = *moving;
        for (span, &[with, against]) in self.spans.spans().iter().zip(spans) {
            let (speed, square) = (span.speed, span.speed * span.speed);
            let all = if span.line == Line::Bar {
                let place = span.ends.iter().find_map(|end| end[0]).map_or(0, |(index, _)| index);
                let along = of.coordinates.get(place).is_some_and(|info| *info.unit.symbol == *"m");
                *(if along { &mut *axial } else { &mut *torsional }) += 0.5 * square * with;
                0.5 * with
            } else {
                *moment += 0.25 * speed * speed.abs() * (with - against);
                *lateral += 0.25 * square * (with + against);
                0.25 * (with + against)
            };
            *(if speed == 0.0 { &mut *still } else { &mut *moving }) += all;
        }
        // Shafts stand on their axes.
        if *moving > 0.0 {
            *eccentric *= (before / *moving).powi(2);
        }
    }
}

/// Gives a solved state the numbers of its shafts, and judges it by their lowest modes; `None` if it has none. Without
/// modes near which to look, all are sought; where none are `wanted`, nothing is judged.
#[doc(hidden)]
pub fn judge_shafts(
    mechanism: &dyn Kernels,
    state: &mut Equilibrium,
    nearby: &[Mode],
    wanted: bool,
) -> Option<(Stability, Vec<Mode>)> {
    state.spans = numbers(mechanism, &state.description, &state.inputs, &state.design);
    if state.spans.is_empty() {
        return None;
    }
    if !wanted || state.constraints.singular {
        return Some((Stability::Undecided, Vec::new()));
    }
    let Some(shafts) = Shafts::of(state).ok().flatten() else { return Some((Stability::Undecided, Vec::new())) };
    let modes = shafts.modes(state, nearby, Others::WhereOneEnds).unwrap_or_default();
    let stability = if modes.is_empty() { Stability::Undecided } else { stability(state, &shafts, &modes) };
    Some((stability, modes))
}

/// The stability of a state with these modes, which all oscillate.
fn stability(at: &Equilibrium, shafts: &Shafts, modes: &[Mode]) -> Stability {
    let growing = modes.iter().filter(|mode| mode.behaviour.grows()).count();
    let held = holds(at);
    if !held {
        let odd = Lu::new(&free(at, &at.linear.stiffness)).is_some_and(|factors| factors.negative_determinant());
        match shafts.whole.divergent() {
            Ok(0) if !odd => {}
            Ok(negative) => return Stability::Divergent { negative: negative.max(1) },
            Err(_) => return Stability::Undecided,
        }
    }
    if growing > 0 {
        Stability::Flutter { growing }
    } else if held || modes.iter().all(|mode| matches!(mode.behaviour, Behaviour::Damped(_))) {
        Stability::Stable
    } else {
        Stability::Marginal
    }
}

/// Whether nothing can grow without oscillating: for a real `s > 0` and any motion, `x^T T(s) x` is positive where stiffness
/// is positive and damping not negative, as those of spans are.
#[doc(hidden)]
#[must_use]
pub fn holds(at: &Equilibrium) -> bool {
    let mut damping = symmetric_part(&free(at, &at.linear.damping));
    let most = (0..damping.row_count()).map(|i| damping[i][i].abs()).fold(f64::MIN_POSITIVE, f64::max);
    (0..damping.row_count()).for_each(|i| damping[i][i] += UNDAMPED * most);
    Cholesky::new(&symmetric_part(&free(at, &at.linear.stiffness))).is_ok() && Cholesky::new(&damping).is_ok()
}

/// A matrix in the directions that constraints leave free.
fn free(at: &Equilibrium, matrix: &Matrix) -> Matrix {
    let structure = Structure::of(&at.description);
    if structure.open() { matrix.clone() } else { Tangent::new(&at.linear, structure).reduce(matrix) }
}

fn symmetric_part(a: &Matrix) -> Matrix {
    Matrix::from_fn(a.row_count(), a.row_count(), |i, j| 0.5 * (a[i][j] + a[j][i]))
}
