//! Combinations of the candidates with a property at every place. The property is linear in the coefficients, which are
//! the same everywhere.

use crate::algebra::{Disturbed, NullSpace, times};
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
    let moving = system.context.moving().1;
    common(system, design, friction, system.fields.len(), |state| {
        let n = state.residual.len();
        let reactions = |i: usize| (moving..n).map(move |j| state.stiffness[j][i]);
        let change = |i: usize| {
            state
                .fields
                .iter()
                .map(move |field| change(field, state, i))
        };
        let mut rows: Rows = (0..n)
            .map(|i| reactions(i).chain(change(i)).collect())
            .collect();
        rows.extend(missed(system, state, n - moving, 0));
        rows
    })
}

/// The directions along which the loads do the same work everywhere, apart from gaps of constraints:
/// `d/dq (w . g + eta . Phi) = 0`, and likewise by speeds and reactions, with any `eta` at every place. The candidates
/// are followed by the equations of coasting coordinates.
pub(super) fn conserved(system: &System, design: u64, friction: Friction) -> Combinations {
    let (free, moving) = system.context.moving();
    let candidates = system.fields.len() + moving - free;
    common(system, design, friction, candidates, |state| {
        let n = state.residual.len();
        let gaps = |j: usize| (moving..n).map(move |i| state.stiffness[j][i]);
        let slope = |j: usize| state.fields.iter().map(move |field| slope(field, state, j));
        let coasting = |j: usize| (free..moving).map(move |i| state.stiffness[j][i]);
        let mut rows: Rows = (0..n)
            .map(|j| gaps(j).chain(slope(j)).chain(coasting(j)).collect())
            .collect();
        rows.extend(missed(system, state, n - moving, moving - free));
        rows
    })
}

/// `w . g` for each combination.
pub(super) fn powers(
    state: &Linearised,
    along: &Combinations,
    loads: &[Disturbed],
    free: usize,
) -> Vec<Disturbed> {
    let coasting = loads[free..].iter().copied();
    let power = |field: &Field| {
        let pairs = field.coordinates.iter().zip(&field.rates);
        sum(pairs.map(|(&k, &rate)| rate * loads[k]))
    };
    let row: Vec<Disturbed> = state.fields.iter().map(power).chain(coasting).collect();
    let row: Vec<Disturbed> = row
        .into_iter()
        .take(along.first().map_or(0, Vec::len))
        .collect();
    times(&[row], along).concat()
}

/// All combinations that solve the equations `rows` at every state; columns in front of those of the candidates belong
/// to unknowns of their own at every state.
fn common(
    system: &System,
    design: u64,
    friction: Friction,
    candidates: usize,
    rows: impl Fn(&Linearised) -> Rows,
) -> Combinations {
    let mut combinations: Option<Combinations> = None;
    let mut confirmed = 0;
    for motion in 1..=ATTEMPTS {
        let Some(state) = system.at(RandomState { design, motion }, friction) else {
            continue;
        };
        let mut rows = rows(&state);
        let lead = rows.first().map_or(0, Vec::len).saturating_sub(candidates);
        if let Some(found) = &combinations {
            for row in &mut rows {
                let tail = row.split_off(lead);
                row.extend(times(&[tail], found).concat());
            }
        }
        let next = NullSpace::new(rows, lead, state.operations).vectors;
        let next = match &combinations {
            None => next,
            Some(found) => combined(found, &next),
        };
        let before = combinations.as_ref().map_or(candidates, Vec::len);
        confirmed = if next.len() == before {
            confirmed + 1
        } else {
            0
        };
        let done = next.is_empty() || confirmed == CONFIRMED;
        combinations = Some(next);
        if done {
            break;
        }
    }
    combinations.unwrap_or_default()
}

/// What remains of the motions of space that the joints do not allow, after `before` zeros and followed by `after`.
fn missed(system: &System, state: &Linearised, before: usize, after: usize) -> Rows {
    let zeros = |count: usize| std::iter::repeat_n(Disturbed::exact(0.0), count);
    let mut rows = Rows::new();
    let mut first = system.fields.free;
    for carrier in &system.fields.carriers {
        let next = first + carrier.len();
        for component in 0..RIGID {
            let entries = state.fields[first..next]
                .iter()
                .map(|field| field.missed[component]);
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
    let pairs = field.coordinates.iter().zip(&field.rates);
    let product = sum(pairs.map(|(&k, &rate)| state.stiffness[k][i] * rate));
    product + turned(field, state, i)
}

/// Derivative of the power of the equations along a field by unknown `j`.
fn slope(field: &Field, state: &Linearised, j: usize) -> Disturbed {
    if let ([k], []) = (&field.coordinates[..], &field.slopes[..]) {
        return state.stiffness[j][*k];
    }
    let pairs = field.coordinates.iter().zip(&field.rates);
    let product = sum(pairs.map(|(&k, &rate)| state.stiffness[j][k] * rate));
    product + turned(field, state, j)
}

/// `(d zeta/dq_i) . g`.
fn turned(field: &Field, state: &Linearised, i: usize) -> Disturbed {
    match field.coordinates.iter().position(|&k| k == i) {
        None => Disturbed::exact(0.0),
        Some(index) => {
            let pairs = field.coordinates.iter().zip(&field.slopes[index]);
            sum(pairs.map(|(&k, &slope)| state.residual[k] * slope))
        }
    }
}

fn sum(terms: impl Iterator<Item = Disturbed>) -> Disturbed {
    terms.fold(Disturbed::exact(0.0), |sum, term| sum + term)
}

/// `sum_k weights_k vectors_k` for each list of weights.
pub(super) fn combined(vectors: &Combinations, weights: &Combinations) -> Combinations {
    let length = vectors.first().map_or(0, Vec::len);
    let entry = |j: usize, weights: &[Disturbed]| {
        let terms = vectors.iter().zip(weights);
        sum(terms.map(|(vector, &weight)| weight * vector[j]))
    };
    let one = |weights: &Vec<Disturbed>| (0..length).map(|j| entry(j, weights)).collect();
    weights.iter().map(one).collect()
}
