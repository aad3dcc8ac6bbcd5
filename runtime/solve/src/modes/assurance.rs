//! Tracking modes: which modes of two sets are the same motion (modal assurance criterion), and which cannot be told
//! apart.
#![allow(clippy::needless_range_loop, reason = "index loops read as the formulas they are")]

use super::kinetic::{kinetic, product};
use super::{Family, Mode};
use crate::algebra::{Matrix, Vector, for_size, greater, times_complex};
use crate::kernels::Linear;
use crate::{Behaviour, Complex, Modes};

/// Largest share of the assurance that a difference of eigenvalues can remove: it decides between modes of equal shape.
pub const EIGENVALUE_SHARE: f64 = 0.05;
/// Above this assurance a mode is recognised without looking at the other modes of its set.
pub const CERTAIN: f64 = 0.6;
/// Below this assurance two modes of shafts are not one.
const ALIKE: f64 = 0.3;

/// Similarity, from 0 to 1, of mode `i` of `from` to mode `j` of `to`: `table[i][j]`.
///
/// For undamped modes this is the modal assurance criterion: the squared cosine between the shapes, weighted with the
/// mass matrix of `linear`. With speeds the weight is that of the kinetic energy, with displacements converted to
/// velocities by the largest `|s|`. General modes are motions of positions and velocities: the phase of the eigenvalue
/// counts as well, and among modes of equal shape the one with the nearer eigenvalue scores up to 5 % more. Both sets
/// and the matrices must belong to one mechanism.
#[must_use]
pub fn assurance(from: &Modes, to: &Modes, linear: &Linear) -> Matrix {
    let kinetic_mass = kinetic(from, to, linear);
    let mass = kinetic_mass.as_ref().unwrap_or(&linear.mass);
    let general = from.family == Family::General || to.family == Family::General;
    let weighted = |mode: &Mode| times_complex(mass, &mode.shape);
    let measured = |mode: &Mode| {
        let weighted = weighted(mode);
        let size = product(&mode.shape, &weighted).norm();
        (weighted, size, mode.s.norm())
    };
    let own_sizes = from.modes.iter().map(measured);
    let own_sizes: Vec<_> = own_sizes.map(|(_, size, rate)| (size, rate)).collect();
    let others: Vec<_> = to.modes.iter().map(measured).collect();
    Matrix::from_fn(from.modes.len(), to.modes.len(), |i, j| {
        let (mode, (own_size, own_rate)) = (&from.modes[i], own_sizes[i]);
        let (weighted, size, rate) = &others[j];
        let scale = own_size * size;
        let cosine = product(&mode.shape, weighted).norm_sqr();
        let shapes = if scale > 0.0 { cosine / scale } else { 0.0 };
        if general { shapes * same_eigenvalue(mode.s, to.modes[j].s, own_rate, *rate) } else { shapes }
    })
}

/// `(1 + cos of the phase difference) / 2`, reduced slightly with the distance; takes both eigenvalues and their sizes.
fn same_eigenvalue(a: Complex, b: Complex, size_a: f64, size_b: f64) -> f64 {
    let sizes = size_a * size_b;
    let phase = if sizes > 0.0 { 0.5 + 0.5 * (a.conj() * b).re / sizes } else { 1.0 };
    let sum = size_a + size_b;
    let distance = if sum > 0.0 { (a - b).norm() / sum } else { 0.0 };
    phase * (1.0 - EIGENVALUE_SHARE * distance)
}

/// Whether these are undamped modes each of which has at least this assurance in its place.
#[must_use]
pub fn stay_in_place(from: &Modes, to: &Modes, linear: &Linear, least: f64) -> bool {
    let undamped = from.family == Family::Undamped && to.family == Family::Undamped;
    let mut stay = undamped && from.modes.len() == to.modes.len();
    if stay {
        each_in_place(from, to, &linear.mass, |assurance| stay &= assurance >= least);
    }
    stay
}

/// Passes on the assurance of each pair of undamped modes in the same place.
#[inline(always)]
fn each_in_place(from: &Modes, to: &Modes, mass: &Matrix, mut each: impl FnMut(f64)) {
    for_size(
        mass.row_count(),
        #[inline(always)]
        |n| {
            for (x, y) in from.modes.iter().zip(&to.modes) {
                each(real_assurance(n, x, y, mass));
            }
        },
    );
}

/// The assurance of two undamped modes of `n` components; see [`for_size`].
#[inline(always)]
fn real_assurance(n: usize, from: &Mode, to: &Mode, mass: &Matrix) -> f64 {
    let (x, y, mass) = (&from.shape[..n], &to.shape[..n], &mass.as_flattened()[..n * n]);
    let scale = real_form(n, x, mass, x) * real_form(n, y, mass, y);
    let product = real_form(n, x, mass, y);
    if scale > 0.0 { product * product / scale } else { 0.0 }
}

/// `x^T mass y` of the real parts.
#[inline(always)]
fn real_form(n: usize, x: &[Complex], mass: &[f64], y: &[Complex]) -> f64 {
    let mut sum = -0.0;
    for i in 0..n {
        let mut weighted = -0.0;
        for j in 0..n {
            weighted += mass[i * n + j] * y[j].re;
        }
        sum += x[i].re * weighted;
    }
    sum
}

/// Matches modes: for each mode of `from`, the position of the mode of `to` that is the same motion; `None` if `to` has
/// fewer modes, and of shafts, whose lowest modes are not always the same, if none of them is like it.
///
/// Pairs are assigned in descending order of assurance, ties in order of position. No position occurs twice, and the
/// result is deterministic.
#[must_use]
pub fn match_modes(from: &Modes, to: &Modes, linear: &Linear) -> Vec<Option<usize>> {
    let matches = match_with_assurance(from, to, linear).into_iter();
    matches.map(position).collect()
}

/// The position in a match found by [`match_with_assurance`].
#[inline]
pub fn position(matched: Option<(usize, f64)>) -> Option<usize> {
    matched.map(|(position, _)| position)
}

/// Like [`match_modes`], with the assurance of each pair.
pub fn match_with_assurance(from: &Modes, to: &Modes, linear: &Linear) -> Vector<Option<(usize, f64)>> {
    let (here, there) = (from.modes.len(), to.modes.len());
    if here == 1 && there == 1 {
        return [Some((0, 1.0))].into();
    }
    // The shapes of one undamped set are orthogonal, so each matches at most one shape of another set with more than
    // one half.
    let undamped = from.family == Family::Undamped && to.family == Family::Undamped;
    if undamped && here <= there {
        let (mut matched, mut places) = (Vector::filled(here, None), 0..);
        each_in_place(from, to, &linear.mass, |assurance| {
            if let Some(place) = places.next() {
                matched[place] = Some((place, assurance));
            }
        });
        if matched.iter().flatten().all(|&(_, same)| same > CERTAIN) {
            return matched;
        }
    }
    let table = assurance(from, to, linear);
    let least = if from.description.spans.is_empty() { 0.0 } else { ALIKE };
    let mut matched = Vector::filled(here, None);
    let mut used = vec![false; there];
    for _ in 0..here.min(there) {
        let mut best = None;
        for i in (0..here).filter(|&i| matched[i].is_none()) {
            for j in (0..there).filter(|&j| !used[j]) {
                if best.is_none_or(|(_, _, most)| table[i][j] > most) {
                    best = Some((i, j, table[i][j]));
                }
            }
        }
        if let Some((i, j, most)) = best.filter(|(.., most)| *most >= least) {
            matched[i] = Some((j, most));
            used[j] = true;
        }
    }
    matched
}

impl Modes {
    /// Gives these modes the labels of the modes of `before` in the same places.
    #[doc(hidden)]
    pub fn continue_in_place(&mut self, before: &Self) {
        for (mode, before) in self.modes.iter_mut().zip(&before.modes) {
            mode.label = before.label;
        }
    }

    /// Gives these modes the order and the labels of the modes of `before` that they continue, at the positions `order`.
    ///
    /// Modes without a predecessor come last, labelled from `next` on.
    #[doc(hidden)]
    pub fn arrange(&mut self, before: &Self, order: &[Option<usize>], mut next: usize) {
        let in_place = |(i, index): (usize, &Option<usize>)| *index == Some(i);
        if order.len() == self.modes.len() && order.iter().enumerate().all(in_place) {
            self.continue_in_place(before);
            return;
        }
        let continued =
            order.iter().zip(&before.modes).filter_map(|(index, mode)| index.map(|index| (index, Some(mode.label))));
        let new = (0..self.modes.len()).filter(|index| !order.contains(&Some(*index))).map(|index| (index, None));
        let modes = continued.chain(new).map(|(index, label)| {
            let label = label.unwrap_or_else(|| {
                next += 1;
                next - 1
            });
            Mode { label, ..self.modes[index].clone() }
        });
        self.modes = modes.collect();
    }
}

/// Whether mode `r` has merged, to within its accuracy, with another mode or with its own conjugate into a defective
/// eigenvalue.
///
/// A merged mode has no derivative, and shares its shapes with the other.
#[inline]
pub fn merged(modes: &Modes, r: usize) -> bool {
    /// Semisimple eigenvalues that meet are conditioned far better; defective ones that can still be told apart, far
    /// worse.
    const ILL_CONDITIONED: f64 = 1e5;
    let mode = &modes.modes[r];
    let free = matches!(mode.behaviour, Behaviour::Free);
    if modes.family == Family::Undamped || free || mode.condition <= ILL_CONDITIONED {
        return false;
    }
    let gaps = modes.modes.iter().enumerate().filter(|(j, _)| *j != r).map(|(_, other)| (mode.s - other.s).norm());
    let conjugate = (mode.s.im > 0.0).then_some(2.0 * mode.s.im);
    !mode.condition.is_finite() || gaps.chain(conjugate).any(|gap| gap <= mode.error)
}

/// The groups of equal eigenvalues, each with the positions of its modes, ascending. The shapes in a group are an
/// arbitrary basis, so its modes have no identity but their order.
pub fn equal_groups(modes: &Modes) -> Vec<Vec<usize>> {
    let all = 0..modes.modes.len();
    let groups = all.filter_map(|r| {
        let group = modes.cluster_of(r);
        (group.len() > 1 && group.first() == Some(&r)).then_some(group)
    });
    groups.collect()
}

/// Puts what continues a group of equal modes in ascending order of `size`, by exchanging it with `swap`.
#[inline]
pub fn in_order<T>(group: &[usize], all: &mut T, size: impl Fn(&T, usize) -> f64, swap: impl Fn(&mut T, usize, usize)) {
    for (k, &r) in group.iter().enumerate() {
        for &before in &group[..k] {
            if size(all, r) < size(all, before) {
                swap(all, r, before);
            }
        }
    }
}

/// Marks the modes whose eigenvalue (`lambda` for undamped modes, `s` for general ones) lies within `gap` of another
/// one, relative to the larger of the two.
///
/// Marked modes share a cluster and have no derivative of their own.
#[must_use]
pub fn clusters(modes: &Modes, gap: f64) -> Vec<bool> {
    (0..modes.modes.len()).map(|i| merged(modes, i) || near_another(modes, i, gap)).collect()
}

/// Whether the eigenvalue of mode `i` lies within `gap` of another one, relative to the larger of the two.
#[inline(always)]
pub fn near_another(modes: &Modes, i: usize, gap: f64) -> bool {
    let mode = &modes.modes[i];
    let mut others = modes.modes.iter().enumerate().filter(|(j, _)| *j != i);
    others.any(|(_, other)| near_each_other(modes.family, mode, other, gap))
}

/// Whether two eigenvalues are within `gap`, relative to the larger of the two.
#[inline(always)]
pub fn near(modes: &Modes, i: usize, j: usize, gap: f64) -> bool {
    near_each_other(modes.family, &modes.modes[i], &modes.modes[j], gap)
}

/// Modes of free directions are near no other: their eigenvalues are exactly zero, and nothing mixes them with others.
#[inline(always)]
fn near_each_other(family: Family, a: &Mode, b: &Mode, gap: f64) -> bool {
    if matches!((a.behaviour, b.behaviour), (Behaviour::Free, _) | (_, Behaviour::Free)) {
        return false;
    }
    match family {
        Family::Undamped => (a.lambda - b.lambda).abs() <= gap * greater(a.lambda.abs(), b.lambda.abs()),
        Family::General => (a.s - b.s).norm() <= gap * a.s.norm().max(b.s.norm()),
    }
}
