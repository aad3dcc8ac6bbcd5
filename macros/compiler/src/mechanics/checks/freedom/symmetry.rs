//! Combinations of the candidates with a property at every place. The property is linear in the coefficients, which are
//! the same everywhere.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use crate::algebra::{Disturbed, NullSpace, scale, times};
use crate::mechanics::setup::RandomState;

use super::fields::{Field, RIGID};
use super::state::{Friction, Linearised, System};

/// States at which a property must be confirmed once no more combinations fall away, and attempts to find states.
const CONFIRMED: usize = 3;
const ATTEMPTS: u64 = 24;

/// Vectors of coefficients of the candidates.
pub(super) type Combinations = Vec<Vec<Disturbed>>;

type Rows = Vec<Vec<Disturbed>>;

/// The motions that leave the equations as they are, up to reactions of constraints:
/// `K zeta + (d zeta/dq)^T g + Phi_q^T nu = 0` and `Phi_q zeta = 0`, with any `nu` at every place.
pub(super) fn symmetries(system: &System, design: u64, friction: Friction) -> Combinations {
    found(system, design, friction, 0, changes)
}

/// The motions of [`wholes`] that meet no resistance at an equilibrium.
pub(super) fn unresisted_wholes(system: &System, state: &Linearised) -> Combinations {
    let wholes = wholes(system, state, 0);
    let mut rows = changes(system, state);
    let lead = system.size() - system.context.moving().1;
    combine(&mut rows, lead, &wholes);
    let null_space = NullSpace::of_scaled(rows, lead, state.operations);
    combined(&wholes, &null_space.vectors)
}

fn changes(system: &System, state: &Linearised) -> Rows {
    let moving = system.context.moving().1;
    let n = state.residual.len();
    let reactions = |i: usize| (moving..n).map(move |j| state.stiffness[j][i]);
    let change = |i: usize| state.fields.iter().map(move |field| change(field, state, i));
    let mut rows: Rows = (0..n).map(|i| reactions(i).chain(change(i)).collect()).collect();
    scale(&mut rows, state.operations);
    rows.extend(missed(system, state, n - moving, 0));
    rows
}

/// The directions along which the loads do the same work everywhere, apart from gaps of constraints:
/// `d/dq (w . g + eta . Phi) = 0`, and likewise by speeds and reactions, with any `eta` at every place. The candidates
/// are followed by the equations of coasting coordinates.
pub(super) fn conserved(system: &System, design: u64, friction: Friction) -> Combinations {
    let (free, moving) = system.context.moving();
    found(system, design, friction, moving - free, |system, state| {
        let n = state.residual.len();
        let gaps = |j: usize| (moving..n).map(move |i| state.stiffness[j][i]);
        let slope = |j: usize| state.fields.iter().map(move |field| slope(field, state, j));
        let coasting = |j: usize| (free..moving).map(move |i| state.stiffness[j][i]);
        let mut rows: Rows = (0..n).map(|j| gaps(j).chain(slope(j)).chain(coasting(j)).collect()).collect();
        scale(&mut rows, state.operations);
        rows.extend(missed(system, state, n - moving, moving - free));
        rows
    })
}

/// The motions of space of each connected part as a whole: bodies in it are tied to each other, not to the ground, so
/// that whatever stands between them leaves these motions exactly as they are, however stiff it is. By candidate,
/// followed by `more`.
fn wholes(system: &System, state: &Linearised, more: usize) -> Combinations {
    let carriers = &system.fields.carriers;
    let mut parts: Vec<usize> = (0..system.size()).collect();
    let mut join = |i: usize, j: usize| {
        let (from, to) = (parts[i].max(parts[j]), parts[i].min(parts[j]));
        if from != to {
            parts.iter_mut().filter(|part| **part == from).for_each(|part| *part = to);
        }
    };
    for (j, column) in state.stiffness.iter().enumerate() {
        (0..column.len()).filter(|&i| !column[i].is_zero()).for_each(|i| join(i, j));
    }
    for carrier in carriers {
        let first = carrier.coordinates[0];
        carrier.coordinates.iter().for_each(|&k| join(first, k));
    }
    // Of the bodies that a joint carries, those that can move in most ways.
    let mut first = system.fields.free;
    let mut order = Vec::new();
    for carrier in carriers {
        order.push((first, &carrier.coordinates));
        first += carrier.len();
    }
    order.sort_by_key(|(_, coordinates)| Reverse(coordinates.len()));
    let mut moved = vec![false; system.fields.free];
    let none = vec![Disturbed::exact(0.0); system.fields.len() + more];
    let mut wholes: BTreeMap<(usize, usize), Vec<Disturbed>> = BTreeMap::new();
    for (first, coordinates) in order {
        let singular = state.fields[first].coordinates.is_empty();
        if singular || coordinates.iter().any(|&k| moved[k]) {
            continue;
        }
        coordinates.iter().for_each(|&k| moved[k] = true);
        for component in 0..RIGID {
            let whole = (parts[coordinates[0]], component);
            let whole = wholes.entry(whole).or_insert_with(|| none.clone());
            whole[first + component] = Disturbed::exact(1.0);
        }
    }
    wholes.into_values().collect()
}

/// `w . g` for each combination.
pub(super) fn powers(state: &Linearised, along: &Combinations, loads: &[Disturbed], free: usize) -> Vec<Disturbed> {
    let coasting = loads[free..].iter().copied();
    let power = |field: &Field| sum(field.coordinates.iter().zip(&field.rates).map(|(&k, &rate)| rate * loads[k]));
    let row: Vec<Disturbed> = state.fields.iter().map(power).chain(coasting).collect();
    let row: Vec<Disturbed> = row.into_iter().take(along.first().map_or(0, Vec::len)).collect();
    times(&[row], along).concat()
}

/// All combinations that solve the equations `rows` at every state: those of [`wholes`], of which there are few, then any
/// that rounding lets see. Columns in front of those of the candidates, `more` than the fields, belong to unknowns of
/// their own at every state.
fn found(
    system: &System,
    design: u64,
    friction: Friction,
    more: usize,
    rows: impl Fn(&System, &Linearised) -> Rows,
) -> Combinations {
    let random = |motion| system.at(RandomState { design, motion }, friction);
    let Some(state) = (1..=ATTEMPTS).find_map(random) else {
        return Combinations::new();
    };
    let candidates = system.fields.len() + more;
    let common = |start: Option<Combinations>| {
        let mut combinations = start;
        let mut confirmed = 0;
        for state in (1..=ATTEMPTS).filter_map(random) {
            let before = combinations.as_ref().map_or(candidates, Vec::len);
            let mut rows = rows(system, &state);
            let lead = rows.first().map_or(0, Vec::len).saturating_sub(candidates);
            if let Some(found) = &combinations {
                combine(&mut rows, lead, found);
            }
            let mut next = NullSpace::of_scaled(rows, lead, state.operations).vectors;
            if let Some(found) = &combinations {
                next = combined(found, &next);
            }
            confirmed = if next.len() == before { confirmed + 1 } else { 0 };
            let done = next.is_empty() || confirmed == CONFIRMED;
            combinations = Some(next);
            if done {
                break;
            }
        }
        combinations.unwrap_or_default()
    };
    let mut all = common(Some(wholes(system, &state, more)));
    all.extend(common(None));
    all
}

/// Equations for the shares of the candidates, after `lead` others, as equations for those of some combinations.
fn combine(rows: &mut Rows, lead: usize, combinations: &Combinations) {
    for row in rows {
        let tail = row.split_off(lead);
        row.extend(times(&[tail], combinations).concat());
    }
}

/// What remains of the motions of space that the joints do not allow, after `before` zeros and followed by `after`.
fn missed(system: &System, state: &Linearised, before: usize, after: usize) -> Rows {
    let zeros = |count: usize| std::iter::repeat_n(Disturbed::exact(0.0), count);
    let mut rows = Rows::new();
    let mut first = system.fields.free;
    for carrier in &system.fields.carriers {
        let next = first + carrier.len();
        for component in 0..RIGID {
            let entries = state.fields[first..next].iter().map(|field| field.missed[component]);
            let others = zeros(state.fields.len() - next + after);
            rows.push(zeros(before + first).chain(entries).chain(others).collect());
        }
        first = next;
    }
    rows
}

/// Change of equation `i` along a field, and of the directions in which the equation holds.
fn change(field: &Field, state: &Linearised, i: usize) -> Disturbed {
    if let ([k], []) = (&field.coordinates[..], &field.slopes[..]) {
        return state.stiffness[*k][i];
    }
    let product = sum(field.coordinates.iter().zip(&field.rates).map(|(&k, &rate)| state.stiffness[k][i] * rate));
    product + turned(field, state, i)
}

/// Derivative of the power of the equations along a field by unknown `j`.
fn slope(field: &Field, state: &Linearised, j: usize) -> Disturbed {
    if let ([k], []) = (&field.coordinates[..], &field.slopes[..]) {
        return state.stiffness[j][*k];
    }
    let product = sum(field.coordinates.iter().zip(&field.rates).map(|(&k, &rate)| state.stiffness[j][k] * rate));
    product + turned(field, state, j)
}

/// `(d zeta/dq_i) . g`.
fn turned(field: &Field, state: &Linearised, i: usize) -> Disturbed {
    match field.coordinates.iter().position(|&k| k == i) {
        None => Disturbed::exact(0.0),
        Some(index) => {
            sum(field.coordinates.iter().zip(&field.slopes[index]).map(|(&k, &slope)| state.residual[k] * slope))
        }
    }
}

fn sum(terms: impl Iterator<Item = Disturbed>) -> Disturbed {
    terms.fold(Disturbed::exact(0.0), |sum, term| sum + term)
}

/// `sum_k weights_k vectors_k` for each list of weights.
pub(super) fn combined(vectors: &Combinations, weights: &Combinations) -> Combinations {
    let length = vectors.first().map_or(0, Vec::len);
    let entry =
        |j: usize, weights: &[Disturbed]| sum(vectors.iter().zip(weights).map(|(vector, &weight)| weight * vector[j]));
    weights.iter().map(|weights| (0..length).map(|j| entry(j, weights)).collect()).collect()
}
