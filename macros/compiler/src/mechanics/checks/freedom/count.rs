//! The number of free directions at an equilibrium.

use crate::algebra::{Disturbed, NullSpace, times};
use crate::mechanics::setup::RandomState;

use super::fields::Field;
use super::state::{Friction, Linearised, System};
use super::symmetry::{Combinations, symmetries, unresisted_wholes};

/// The free directions of one design.
pub(super) struct Count {
    /// How many there are at an equilibrium.
    pub(super) directions: usize,
    /// How many more there may be behind rounding.
    hidden: usize,
    /// Whether an equilibrium was found.
    pub(super) rests: bool,
    pub(super) proof: Proof,
}

impl Count {
    /// What rounding hides.
    pub(super) fn hidden(&self) -> Option<String> {
        (self.hidden > 0).then(|| {
            format!(
                "rounding hides whether anything resists in {} of the directions in which there seems to be little stiffness; they count as held",
                self.hidden
            )
        })
    }
}

/// How free directions were found.
pub(super) enum Proof {
    /// The mechanism rests where all coordinates are zero, and these directions meet no resistance there. Some may meet
    /// some farther away.
    AtZero(Unresisted),
    /// Motions that leave the equations as they are.
    Symmetries(Combinations, Friction),
}

/// Directions that meet no resistance at an equilibrium.
pub(super) struct Unresisted {
    /// Motions of connected parts as wholes.
    pub(super) wholes: Combinations,
    /// The rates of the free coordinates, first in `wholes`, then in others.
    pub(super) rates: Vec<Vec<Disturbed>>,
    /// How many more there may be behind rounding.
    hidden: usize,
}

/// Counts the free directions of a design; `None` if the equations are rarely finite.
pub(super) fn count(system: &System, design: u64) -> Option<Count> {
    if let Some(state) = system.at_zero(design) {
        let unresisted = unresisted(system, &state);
        return Some(Count {
            directions: unresisted.rates.len(),
            hidden: unresisted.hidden,
            rests: true,
            proof: Proof::AtZero(unresisted),
        });
    }
    by_symmetry(system, design)
}

/// All null vectors of the stiffness that move no speed. With wholes held at as many coordinates, only others are left.
fn unresisted(system: &System, state: &Linearised) -> Unresisted {
    let (free, n) = (system.fields.free, state.residual.len());
    let moving = system.context.moving().1;
    let wholes = unresisted_wholes(system, state);
    let mut rates = transposed(&rates(system, state, &wholes));
    let values = |rates: &Vec<Disturbed>| rates.iter().map(Disturbed::value).collect();
    let held = clear_pivots(rates.iter().map(values).collect());
    let columns: Vec<usize> = (moving..n).chain((0..free).filter(|k| !held.contains(k))).collect();
    let row = |i: usize| columns.iter().map(|&j| state.stiffness[j][i]).collect();
    let null = NullSpace::new((0..n).map(row).collect(), n - moving, state.operations);
    rates.extend(null.vectors.iter().map(|vector| {
        let mut rates = vec![Disturbed::exact(0.0); free];
        for (&k, &rate) in columns[n - moving..].iter().zip(vector) {
            rates[k] = rate;
        }
        rates
    }));
    Unresisted { wholes, rates, hidden: null.hidden }
}

fn transposed(rows: &[Vec<Disturbed>]) -> Vec<Vec<Disturbed>> {
    let columns = rows.first().map_or(0, Vec::len);
    (0..columns).map(|k| rows.iter().map(|row| row[k]).collect()).collect()
}

/// Rolling at rest takes no place away: at rest its equations hold everywhere. Besides the motions that leave the
/// equations as they are, the stiffness then has a null vector for each such equation that none of these motions breaks.
///
/// Other directions are no combination of the candidates, such as a turn about a hinge that other bodies carry away. An
/// equilibrium shows them.
fn by_symmetry(system: &System, design: u64) -> Option<Count> {
    let mut choice = (symmetries(system, design, Friction::Any), Friction::Any);
    let state = at_random(system, design, Friction::Any)?;
    let velocities = system.first_of_velocities()..system.size();
    let all: Vec<usize> = velocities.clone().collect();
    if !all.is_empty() {
        // Where nothing but friction acts along these motions, there is none at an equilibrium.
        let without = symmetries(system, design, Friction::None);
        let held = rank(&slips(system, &state, &all, &without), state.operations);
        if held == independent(system, &state, &all) {
            choice = (without, Friction::None);
        }
    }
    let (symmetries, friction) = choice;
    let idle: Vec<usize> = velocities.filter(|&k| is_idle(&state, k)).collect();
    let slips = slips(system, &state, &idle, &symmetries);
    let places = independent(system, &state, &idle) - rank(&slips, state.operations);
    let resting = system.equilibria(design).find(|x| !is_singular(&state, x));
    let proven = dimension(system, &state, &symmetries, resting.as_ref()) + places;
    let shown = resting.map(|resting| unresisted(system, &resting));
    Some(Count {
        directions: proven.max(shown.as_ref().map_or(0, |shown| shown.rates.len())),
        hidden: shown.as_ref().map_or(0, |shown| shown.hidden),
        rests: shown.is_some(),
        proof: Proof::Symmetries(symmetries, friction),
    })
}

pub(super) fn at_random(system: &System, design: u64, friction: Friction) -> Option<Linearised> {
    (101..140).find_map(|motion| system.at(RandomState { design, motion }, friction))
}

/// Whether an equation says nothing at rest.
fn is_idle(state: &Linearised, equation: usize) -> bool {
    let mut entries = state.stiffness.iter().map(|column| column[equation]);
    entries.all(|entry| entry.is_rounding(state.operations))
}

/// The rates of the free coordinates in each combination, by coordinate.
pub(super) fn rates(system: &System, state: &Linearised, combinations: &Combinations) -> Vec<Vec<Disturbed>> {
    let mut rows = vec![vec![Disturbed::exact(0.0); state.fields.len()]; system.fields.free];
    for (k, field) in state.fields.iter().enumerate() {
        for (&coordinate, &rate) in field.coordinates.iter().zip(&field.rates) {
            rows[coordinate][k] = rate;
        }
    }
    times(&rows, combinations)
}

/// By constraint on velocities and combination: how fast it slips.
fn slips(
    system: &System,
    state: &Linearised,
    constraints: &[usize],
    combinations: &Combinations,
) -> Vec<Vec<Disturbed>> {
    let rates = rates(system, state, combinations);
    let row = |&k: &usize| state.stiffness[k][..system.fields.free].to_vec();
    times(&constraints.iter().map(row).collect::<Vec<_>>(), &transposed(&rates))
}

/// How many of the constraints on velocities demand what no other constraint does.
fn independent(system: &System, state: &Linearised, constraints: &[usize]) -> usize {
    let moving = system.context.moving().1;
    let of_positions = moving..system.first_of_velocities();
    let lead = of_positions.len();
    let columns: Vec<usize> = of_positions.chain(constraints.iter().copied()).collect();
    let row = |i: usize| columns.iter().map(|&j| state.stiffness[j][i]).collect();
    constraints.len() - NullSpace::new((0..moving).map(row).collect(), lead, state.operations).vectors.len()
}

/// The rank that is certain.
pub(super) fn rank(rows: &[Vec<Disturbed>], operations: usize) -> usize {
    let columns = rows.first().map_or(0, Vec::len);
    let null = NullSpace::new(rows.to_vec(), 0, operations);
    columns - null.vectors.len() - null.hidden
}

/// The number of independent directions of the combinations at an equilibrium, or at a random place if none is found:
/// on its axis, a turn is no motion.
fn dimension(system: &System, state: &Linearised, combinations: &Combinations, resting: Option<&Linearised>) -> usize {
    if combinations.is_empty() {
        return 0;
    }
    let generic = rates(system, state, combinations);
    let dimension = rank(&generic, state.operations);
    let Some(resting) = resting else {
        return dimension;
    };
    let size = |row: &[Disturbed]| {
        row.iter().filter(|x| !x.is_rounding(state.operations)).fold(0.0_f64, |most, x| most.max(x.value().abs()))
    };
    let sizes: Vec<f64> = generic.iter().map(|row| size(row)).collect();
    let rows = rates(system, resting, combinations);
    let scaled = |(coordinate, size): (usize, &f64)| {
        let rates = rows[coordinate].iter().zip(combinations);
        let scaled = rates.map(|(rate, combination)| {
            // The centre of a turn may be far from the axis that it is given by.
            let terms = greatest_term(resting, coordinate, combination);
            let clear = rate.value().abs() > NOTHING * terms;
            if clear { rate.value() / size } else { 0.0 }
        });
        scaled.collect()
    };
    let scaled: Vec<Vec<f64>> = sizes.iter().enumerate().filter(|(_, size)| **size > 0.0).map(scaled).collect();
    dimension.min(clear_pivots(scaled).len())
}

/// The largest share of one candidate in the rate of a coordinate.
fn greatest_term(state: &Linearised, coordinate: usize, combination: &[Disturbed]) -> f64 {
    let term = |(field, share): (&Field, &Disturbed)| {
        let mut rates = field.coordinates.iter().zip(&field.rates);
        let rate = rates.find(|(k, _)| **k == coordinate);
        rate.map_or(0.0, |(_, rate)| (rate.value() * share.value()).abs())
    };
    state.fields.iter().zip(combination).map(term).fold(0.0, f64::max)
}

/// Whether coordinates fail to describe some motion of space that they describe elsewhere.
fn is_singular(elsewhere: &Linearised, here: &Linearised) -> bool {
    let mut pairs = elsewhere.fields.iter().zip(&here.fields);
    pairs.any(|(elsewhere, here)| elsewhere.coordinates.len() != here.coordinates.len())
}

/// Relative size below which a direction at an equilibrium, found by iteration, counts as none.
const NOTHING: f64 = 1e-8;

/// The columns of the pivots in elimination with complete pivoting.
fn clear_pivots(mut rows: Vec<Vec<f64>>) -> Vec<usize> {
    let columns = rows.first().map_or(0, Vec::len);
    let mut pivots = Vec::new();
    while pivots.len() < columns.min(rows.len()) {
        let rank = pivots.len();
        let places = (rank..rows.len()).flat_map(|i| (0..columns).map(move |j| (i, j)));
        let size = |(i, j): (usize, usize)| rows[i][j].abs();
        let Some((row, column)) = places.max_by(|a, b| size(*a).total_cmp(&size(*b))) else {
            break;
        };
        if size((row, column)) < NOTHING {
            break;
        }
        rows.swap(rank, row);
        let (above, below) = rows.split_at_mut(rank + 1);
        let pivot = &above[rank];
        for other in below {
            let factor = other[column] / pivot[column];
            for (x, p) in other.iter_mut().zip(pivot) {
                *x -= factor * p;
            }
            other[column] = 0.0;
        }
        pivots.push(column);
    }
    pivots
}
