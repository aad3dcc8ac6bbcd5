//! Free directions in words.

use crate::algebra::{Disturbed, NullSpace};
use crate::base::names::written;
use crate::base::span::Extent;
use crate::mechanics::setup::Context;

use super::count::{Count, Proof, rank, rates};
use super::fields::Fields;
use super::state::{Linearised, System};
use super::symmetry::{Combinations, combined};

/// A direction with a name.
pub(super) struct Direction {
    pub(super) text: String,
    pub(super) span: Extent,
}

/// What the free directions of the nominal design are, if they are as many as in every other.
pub(super) fn note(system: &System, count: &Count, state: &Linearised) -> String {
    let directions: Vec<String> = match &count.proof {
        Proof::AtZero(unresisted) => {
            let wholes = unresisted.wholes.iter();
            let wholes = wholes.map(|x| x.iter().map(Disturbed::value).collect::<Vec<_>>());
            let others = reduced(&unresisted.rates[unresisted.wholes.len()..]);
            let all = reduced(&unresisted.rates);
            let moved = |rates: &Vec<f64>| rates.iter().filter(|x| x.abs() > NOTHING).count();
            if all.iter().all(|rates| moved(rates) <= FEW) {
                all.iter().map(|x| together(system.context, system.fields, x)).collect()
            } else {
                wholes
                    .map(|whole| described(system.context, system.fields, &whole).text)
                    .chain(others.iter().map(|x| together(system.context, system.fields, x)))
                    .collect()
            }
        }
        Proof::Symmetries(combinations, _) => {
            let readable = readable(system, combinations, state.operations);
            independent(system, state, readable)
                .iter()
                .map(|combination| described(system.context, system.fields, combination).text)
                .collect()
        }
    };
    let mut list = directions;
    list.truncate(count.directions);
    let rest = count.directions - list.len();
    if rest > 0 {
        let cause = if system.first_of_velocities() < system.size() {
            "rolling leaves open"
        } else {
            "nothing resists at the equilibrium"
        };
        list.push(format!("{rest} more that {cause}"));
    }
    let (they, their) = match count.directions {
        1 if !list[0].contains(':') => ("it stands", "its"),
        _ => ("they stand", "their"),
    };
    let list = written(&list.join(", ")).into_owned();
    format!("free: {list}; nothing depends on where {they}, so {their} place is that of the start")
}

/// Combinations with short descriptions: those of coordinates alone, those of motions of space alone, then all. Some may
/// mean the same motion.
pub(super) fn readable(system: &System, combinations: &Combinations, operations: usize) -> Vec<Vec<f64>> {
    let of_space = system.fields.free..system.fields.len();
    let mut all = Vec::new();
    if !of_space.is_empty() {
        let length = combinations.first().map_or(0, Vec::len);
        let of_coordinates = (0..length).filter(|k| !of_space.contains(k));
        all.extend(without(combinations, of_space.clone(), operations));
        all.extend(without(combinations, of_coordinates, operations));
    }
    all.extend(reduced(combinations));
    let coordinates = |x: &Vec<f64>| x.iter().take(system.fields.free).filter(|x| x.abs() > NOTHING).count();
    all.sort_by_key(|x| coordinates(x) > FEW);
    all
}

/// Those combinations in which some candidates have no share.
fn without(combinations: &Combinations, candidates: impl Iterator<Item = usize>, operations: usize) -> Vec<Vec<f64>> {
    let weights = NullSpace::new(
        candidates.map(|k| combinations.iter().map(|combination| combination[k]).collect()).collect(),
        0,
        operations,
    )
    .vectors;
    reduced(&combined(combinations, &weights))
}

/// Of some combinations, the first that are independent motions.
pub(super) fn independent(system: &System, state: &Linearised, combinations: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let mut chosen: Vec<Vec<f64>> = Vec::new();
    for candidate in combinations {
        chosen.push(candidate);
        let all: Combinations = chosen.iter().map(|x| exact(x)).collect();
        let mut motions = rates(system, state, &all);
        let coasting = system.fields.len()..all[0].len();
        motions.extend(coasting.map(|k| all.iter().map(|x| x[k]).collect()));
        if rank(&motions, state.operations) < chosen.len() {
            chosen.pop();
        }
    }
    chosen
}

/// The numbers of a reduced echelon form, with the rounding that it takes.
pub(super) fn exact(values: &[f64]) -> Vec<Disturbed> {
    (0..).zip(values).map(|(seed, &x): (u64, &f64)| Disturbed::rounded(x, 1e-13 * x.abs(), seed)).collect()
}

/// Names that a list may have.
pub(super) const FEW: usize = 6;

/// Size below which a coefficient is none.
const NOTHING: f64 = 1e-9;

/// The same directions in reduced echelon form.
fn reduced(vectors: &[Vec<Disturbed>]) -> Vec<Vec<f64>> {
    let mut rows: Vec<Vec<f64>> = vectors.iter().map(|vector| vector.iter().map(Disturbed::value).collect()).collect();
    let columns = rows.first().map_or(0, Vec::len);
    let mut done = 0;
    for column in 0..columns {
        let size = |k: &usize| rows[*k][column].abs();
        let Some(pivot) = (done..rows.len()).max_by(|a, b| size(a).total_cmp(&size(b))) else {
            break;
        };
        if size(&pivot) < NOTHING {
            continue;
        }
        rows.swap(done, pivot);
        let factor = rows[done][column];
        rows[done].iter_mut().for_each(|x| *x /= factor);
        let pivot_row = rows[done].clone();
        for (k, row) in rows.iter_mut().enumerate() {
            let factor = row[column];
            if k != done {
                row.iter_mut().zip(&pivot_row).for_each(|(x, item)| *x -= factor * item);
            }
        }
        done += 1;
    }
    rows.truncate(done);
    rows
}

/// A combination of candidates in words; coasting coordinates may follow them.
pub(super) fn described(context: &Context, fields: &Fields, combination: &[f64]) -> Direction {
    let (coordinates, others) = combination.split_at(fields.free);
    let (mut space, coasting) = others.split_at(fields.len() - fields.free);
    let coordinates = [coordinates, coasting].concat();
    let moved = |values: &&[f64]| values.iter().any(|x| x.abs() > NOTHING);
    let carried = fields.carriers.iter().map(|carrier| {
        let (components, rest) = space.split_at(carrier.len());
        space = rest;
        (carrier, components)
    });
    let carried: Vec<_> = carried.filter(|(_, x)| moved(x)).collect();
    let Some((carrier, twist)) = carried.first() else {
        return Direction { text: together(context, fields, &coordinates), span: span_of(context, &coordinates) };
    };
    let names: Vec<String> = carried
        .iter()
        .map(|(carrier, _)| format!("`{}`", context.mechanism.bodies[carrier.body.index()].name))
        .collect();
    let moves = |k: &usize| carried.iter().any(|(carrier, _)| carrier.coordinates.contains(k));
    let names = match &names[..] {
        few if few.len() <= FEW => names.join(", "),
        _ if fields.carriers.iter().all(|other| other.coordinates.iter().any(&moves)) => "the whole".to_owned(),
        [first, others @ ..] => format!("{first} and {} other bodies", others.len()),
        [] => String::new(),
    };
    let (turn, shift) = twist.split_at(3);
    let (shift, spin) = shift.split_at(3);
    let spin = spin.iter().copied().chain([0.0; 3]);
    let turn: Vec<f64> = turn.iter().zip(spin).map(|(turn, spin)| turn + spin).collect();
    let axis = |vector: &[f64]| -> Option<&str> {
        let present: Vec<usize> = (0..3).filter(|&k| vector[k].abs() > NOTHING).collect();
        match present[..] {
            [only] => Some(["x", "y", "z"][only]),
            _ => None,
        }
    };
    let turns = turn.iter().any(|x| x.abs() > NOTHING);
    let motion = match (turns, axis(&turn), axis(shift)) {
        (true, Some(axis), _) => format!("rotation of {names} about {axis}"),
        (true, None, _) => format!("rotation of {names}"),
        (false, _, Some(axis)) => format!("translation of {names} along {axis}"),
        (false, ..) => format!("translation of {names}"),
    };
    let text = match together(context, fields, &coordinates) {
        none if none.is_empty() => motion,
        coordinates => format!("{coordinates} with {motion}"),
    };
    Direction { text, span: context.mechanism.bodies[carrier.body.index()].name.span().into() }
}

/// Coordinates that change in fixed ratios.
fn together(context: &Context, fields: &Fields, rates: &[f64]) -> String {
    let present: Vec<usize> = (0..rates.len()).filter(|&k| rates[k].abs() > NOTHING).collect();
    let names: Vec<String> = present.iter().map(|&k| name(context, k).to_string()).collect();
    match &present[..] {
        [] => String::new(),
        [_] => format!("`{}`", names[0]),
        [_, others @ ..] if others.len() >= FEW => {
            format!("`{}` and {} other coordinates", names[0], others.len())
        }
        [first, ..] => {
            let rate = |k: usize| rates[k] * fields.units.unknowns[k];
            let shares = present.iter().map(|&k| short(rate(k) / rate(*first)));
            let shares: Vec<String> = shares.collect();
            format!("`{} = {}`", names.join(" : "), shares.join(" : "))
        }
    }
}

fn name<'a>(context: &'a Context, unknown: usize) -> &'a proc_macro2::Ident {
    let topology = context.topology;
    let mut ids = topology.free.iter().chain(&topology.coasting);
    &context.mechanism.coordinates[ids.nth(unknown).expect("a coordinate").index()].name
}

fn span_of(context: &Context, rates: &[f64]) -> Extent {
    name(context, rates.iter().position(|x| x.abs() > NOTHING).unwrap_or(0)).span().into()
}

/// A number to five digits.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.4e}").parse().unwrap_or(value);
    rounded.to_string()
}
