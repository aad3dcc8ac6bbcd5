//! Judges by the oracle whether the compiler refuses a mechanism rightly.

use eigentol_oracle::agreement::Case;
use eigentol_oracle::kernels::{At, Kernels};
use eigentol_oracle::model::Model;
use eigentol_oracle::{Oracle, Place};
use nalgebra::{DMatrix, DVector, Vector3, Vector6};

/// Allowed error of a power relative to itself. Messages give shares to five digits.
const TOLERANCE: f64 = 1e-4;

/// Whether `message` names motions along which loads act and nothing holds the mechanism, and the oracle's residual does
/// work along each that is the same everywhere and not zero. Then no place is an equilibrium.
pub(crate) fn is_unbalanced(model: &Model, message: &str) -> bool {
    let motions = message
        .strip_suffix(", which nothing holds")
        .and_then(|rest| rest.split_once(" along "))
        .and_then(|(_, motions)| read(model, motions));
    motions.is_some_and(|motions| motions.iter().all(|motion| motion.is_unbalanced(model)))
}

/// What a message says of a motion.
#[derive(Default)]
struct Motion {
    /// The coordinates that move, and their shares.
    coordinates: Vec<(usize, f64)>,
    /// The bodies that also move with space.
    bodies: Vec<usize>,
    /// Which components of their twist may differ from zero.
    twist: [bool; 6],
}

/// Reads a list of motions; `None` if its words are unknown.
fn read(model: &Model, list: &str) -> Option<Vec<Motion>> {
    let body = |text: &str| {
        let name = text.strip_prefix('`')?.split('`').next()?;
        model.bodies.iter().position(|body| body.name == name)
    };
    let mut motions: Vec<Motion> = Vec::new();
    for text in list.replace(" and ", ", ").split(", ") {
        let (coordinates, space) = match text.split_once(" with ") {
            Some((coordinates, space)) => (Some(coordinates), Some(space)),
            None if text.starts_with('`') => (Some(text), None),
            None => (None, Some(text)),
        };
        if let (Some(next), Some(last)) = (body(text), motions.last_mut()) {
            last.bodies.push(next);
            last.twist = narrowed(last.twist, text);
            continue;
        }
        let mut motion = Motion::default();
        if let Some(coordinates) = coordinates {
            motion.coordinates = shares(model, coordinates.trim_matches('`'))?;
        }
        if let Some(space) = space {
            let (turns, name) = match space.strip_prefix("rotation of ") {
                Some(name) => (true, name),
                None => (false, space.strip_prefix("translation of ")?),
            };
            motion.bodies.push(body(name)?);
            motion.twist = narrowed([turns, turns, turns, true, true, true], name);
        }
        motions.push(motion);
    }
    Some(motions)
}

/// The components of a twist about or along the axis with which `text` may end.
fn narrowed(mut twist: [bool; 6], text: &str) -> [bool; 6] {
    let ends = |word: &str, axis: &str| text.ends_with(&format!(" {word} {axis}"));
    for (word, first) in [("about", 0), ("along", 3)] {
        if let Some(only) = ["x", "y", "z"].iter().position(|axis| ends(word, axis)) {
            for k in (0..3).filter(|k| *k != only) {
                twist[first + k] = false;
            }
        }
    }
    twist
}

/// Free coordinates and their shares, as in `a : b = 1 : 2`.
fn shares(model: &Model, text: &str) -> Option<Vec<(usize, f64)>> {
    let free = model.free();
    let place = |name: &str| free.iter().position(|x| model.step(*x).name == name);
    let (names, shares) = text.split_once(" = ").unwrap_or((text, "1"));
    let places: Vec<usize> = names.split(" : ").map(place).collect::<Option<_>>()?;
    let shares = shares.split(" : ").map(|share| share.parse().ok());
    let shares: Vec<f64> = shares.collect::<Option<_>>()?;
    (places.len() == shares.len()).then(|| places.into_iter().zip(shares).collect())
}

impl Motion {
    /// Whether constants exist with which the power is one at every place: more places than constants.
    fn is_unbalanced(&self, model: &Model) -> bool {
        let oracle = Oracle::new(model);
        let Case { at: [_, u, b], .. } = Case::random(model, 1);
        let places = 8 + 3 * (self.coordinates.len() + 12 * self.bodies.len());
        let mut rows = Vec::new();
        let mut wanted = Vec::new();
        for seed in (1..).take(places) {
            let Case { at: [q, ..], .. } = Case::random(model, seed);
            let powers = self.powers(&oracle, [&q, &u, &b]);
            wanted.push(1.0);
            wanted.resize(wanted.len() + powers.nrows() - 1, 0.0);
            rows.extend(powers.row_iter().map(|row| row.into_owned()));
        }
        let (rows, wanted) = (DMatrix::from_rows(&rows), DVector::from(wanted));
        let constants = rows.clone().svd(true, true).solve(&wanted, 1e-9);
        constants.is_ok_and(|constants| (rows * constants - wanted).amax() < TOLERANCE)
    }

    /// By constant, the power of the residual at a place, then what the joints do not allow of the bodies' twists.
    /// Without bodies, the only constant is the speed of the motion. With bodies, it is the rate of each coordinate and
    /// each component of the twists, in the ground and in the body.
    fn powers(&self, oracle: &Oracle, at @ [q, _, b]: At) -> DMatrix<f64> {
        let residual = DVector::from(Kernels::residual(oracle, at));
        let powers = self.coordinates.iter().map(|(k, share)| share * residual[*k]);
        if self.bodies.is_empty() {
            return DMatrix::from_element(1, 1, powers.sum());
        }
        let mut columns: Vec<Vec<f64>> = powers.map(|power| vec![power]).collect();
        let poses = oracle.poses(q, b);
        for (k, &body) in self.bodies.iter().enumerate() {
            let rates = oracle.twists(q, b, body);
            let rates = DMatrix::from_fn(6, rates.len(), |i, j| rates[j][i]);
            let inverse = rates.clone().pseudo_inverse(1e-9).expect("a positive limit");
            for twist in self.twists(poses[body]) {
                let own = &inverse * twist;
                let mut column = vec![residual.dot(&own)];
                column.resize(1 + 6 * k, 0.0);
                column.extend((twist - &rates * own).iter());
                columns.push(column);
            }
        }
        let rows = 1 + 6 * self.bodies.len();
        let entry = |i: usize, j: usize| columns[j].get(i).copied().unwrap_or(0.0);
        DMatrix::from_fn(rows, columns.len(), entry)
    }

    /// The twists about the ground's origin of a body with the given pose: those constant in the ground, then those
    /// constant in the body.
    fn twists(&self, (origin, rotation): Place) -> Vec<Vector6<f64>> {
        let in_ground = (0..6).filter(|&k| self.twist[k]).map(|k| Vector6::ith(k, 1.0));
        let turns = self.twist[..3].contains(&true);
        let in_body = (0..3).flat_map(|k| {
            let axis = Vector3::from(rotation.map(|row| row[k]));
            let shift = Vector3::from(origin).cross(&axis);
            let turn = Vector6::new(axis.x, axis.y, axis.z, shift.x, shift.y, shift.z);
            let slide = Vector6::new(0.0, 0.0, 0.0, axis.x, axis.y, axis.z);
            turns.then_some(turn).into_iter().chain([slide])
        });
        in_ground.chain(in_body).collect()
    }
}
