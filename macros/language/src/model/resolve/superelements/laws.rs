//! The stations and internal coordinates of superelements, and their matrices as forces between these.

use proc_macro2::Ident;

use super::super::beams::declared::Stations;
use super::super::resolver::Resolver;
use super::super::shafts::stations::Standing;
use super::declared::{Declared, MOTIONS, Share, Square};
use crate::base::ids::{BodyId, CoordinateId};
use crate::base::names::joined;
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::{
    Body, Coordinate, CoordinateQuantity, Force, ForceLaw, Frame, Joint, Motion, ShaftStation, Superelement,
};
use crate::model::simplify::{add, multiply, negate, subtract};

/// The names of the coordinates of a station.
const NAMES: [&str; MOTIONS] = ["x", "y", "z", "turn_x", "turn_y", "turn_z"];

impl Resolver<'_> {
    /// The superelements, whose stations `bodies` holds already, from the given one on.
    pub(in crate::model::resolve) fn superelements(
        &mut self,
        stations: &Stations,
        first: usize,
        bodies: &[Body],
        joints: &mut Vec<Joint>,
        forces: &mut Vec<Force>,
        gravity: &Vector,
    ) -> Vec<Superelement> {
        let mut all = Vec::new();
        for (index, name, declared) in stations.superelements() {
            let Some(root) = bodies.iter().position(|body| body.name == *name) else { continue };
            let spin = match declared.base {
                Some((base, at)) => self.spin(name, base, at, joints, gravity).map(Some),
                None => Some(None),
            };
            let Some(spin) = spin else { continue };
            let spun = match &spin {
                Some(spin) => match self.spun(name, declared, spin) {
                    Some(spun) => spun,
                    None => continue,
                },
                None => declared.clone(),
            };
            let base = declared.base.map_or(Frame::Ground, |(base, _)| base);
            let mut own = Vec::new();
            for (place, offset) in declared.stations.iter().enumerate() {
                let used = || stations.used.iter().position(|at| *at == (index, place as f64));
                let Some(body) = (if place == 0 { Some(root) } else { used().map(|k| first + k) }) else { continue };
                let moves = |k: usize| declared.moves[MOTIONS * place + k];
                let motions = [0, 1, 2, 3, 4, 5].map(|k| moves(k).then(|| (NAMES[k], unit(k % 3), k >= 3)));
                let standing =
                    Standing { name, place, number: place + 1, base, body: BodyId::new(body), offset: offset.clone() };
                own.push(self.station_with(standing, motions, bodies, joints));
            }
            let (internal, coordinates) = self.internal(name, declared, &own);
            let accelerations: Vec<Vector> = declared
                .stations
                .iter()
                .map(|place| {
                    let outwards = spin.as_ref().map(|spin| spin.outwards(place));
                    [0, 1, 2].map(|k| {
                        let own = outwards.as_ref().map_or(Expr::Number(0.0), |own| own[k].clone());
                        add(gravity[k].clone(), own)
                    })
                })
                .collect();
            forces.extend(laws(&spun, &coordinates, &accelerations).into_iter().map(|law| Force {
                name: name.clone(),
                law,
                of_every: true,
            }));
            all.push(Superelement { name: name.clone(), stations: own, internal, mass: mass(declared) });
        }
        all
    }

    /// The internal coordinates, and those of all rows.
    fn internal(
        &mut self,
        name: &Ident,
        declared: &Declared,
        stations: &[ShaftStation],
    ) -> (Vec<CoordinateId>, Vec<Option<CoordinateId>>) {
        let mut all: Vec<Option<CoordinateId>> = stations.iter().flat_map(|station| station.coordinates).collect();
        let mut internal = Vec::new();
        for row in all.len()..declared.order() {
            let moves = declared.moves[row];
            if moves {
                let id = CoordinateId::new(self.declared_coordinates.len());
                let named = joined(&joined(&name.to_string(), "internal"), &(internal.len() + 1).to_string());
                self.declared_coordinates.push(Coordinate {
                    name: Ident::new(&named, name.span()),
                    joint: stations[stations.len() - 1].joint,
                    quantity: CoordinateQuantity::Displacement,
                    motion: Motion::Free,
                });
                internal.push(id);
            }
            all.push(moves.then(|| internal[internal.len() - 1]));
        }
        (internal, all)
    }
}

/// The direction of an axis.
fn unit(axis: usize) -> Vector {
    std::array::from_fn(|k| Expr::Number(f64::from(u8::from(k == axis))))
}

/// The matrices as forces: inertia of each two coordinates, and for each row an energy with its weight, and damping.
fn laws(declared: &Declared, coordinates: &[Option<CoordinateId>], accelerations: &[Vector]) -> Vec<ForceLaw> {
    let mut laws = Vec::new();
    let rows = || coordinates.iter().enumerate().filter_map(|(row, id)| Some((row, (*id)?)));
    for (row, id) in rows() {
        for (column, other) in rows().take_while(|(column, _)| *column <= row) {
            let inertance = sum_of(&declared.mass, |share| share.matrix.mean(row, column));
            if inertance != Expr::Number(0.0) {
                laws.push(ForceLaw::CoordinateInerter { coordinates: [id, other], inertance });
            }
        }
        let elastic = sum_over(&declared.stiffness, |matrix| {
            let before = rows().take_while(|(column, _)| *column <= row).map(|(column, other)| {
                let half = if column == row { 0.5 } else { 1.0 };
                (half * matrix.mean(row, column), Expr::Coordinate(other))
            });
            before.collect()
        });
        let energy = subtract(elastic, weight(declared, row, accelerations));
        if energy != Expr::Number(0.0) {
            laws.push(ForceLaw::Potential { energy: multiply(Expr::Coordinate(id), energy) });
        }
        let resists = |shares: &[Share]| {
            sum_over(shares, |matrix| {
                rows().map(|(column, other)| (matrix.mean(row, column), Expr::Rate(other))).collect()
            })
        };
        let resistance = declared.damping.iter().map(|shares| resists(shares)).fold(Expr::Number(0.0), add);
        if resistance != Expr::Number(0.0) {
            laws.push(ForceLaw::Generalized { coordinate: id, value: negate(resistance) });
        }
    }
    laws
}

/// The weight in a row: what stands in it of the mass when each station moves along the acceleration there.
fn weight(declared: &Declared, row: usize, accelerations: &[Vector]) -> Expr {
    let of_share = |share: &Share| {
        let terms = accelerations.iter().enumerate().flat_map(|(station, own)| {
            own.iter().enumerate().map(move |(axis, own)| {
                multiply(Expr::Number(share.matrix.mean(row, MOTIONS * station + axis)), own.clone())
            })
        });
        multiply(share.factor.clone(), terms.fold(Expr::Number(0.0), add))
    };
    declared.mass.iter().map(of_share).fold(Expr::Number(0.0), add)
}

/// The mass, in the first direction in which all stations move.
fn mass(declared: &Declared) -> Expr {
    let stations = declared.stations.len();
    let moves = |direction: &usize| (0..stations).all(|k| declared.moves[MOTIONS * k + direction]);
    let direction = (0..3).find(moves).unwrap_or(0);
    let places = || (0..stations).map(move |k| MOTIONS * k + direction);
    sum_of(&declared.mass, |share| places().flat_map(|i| places().map(move |j| share.matrix.mean(i, j))).sum())
}

/// The sum of a number of each matrix times its factor.
fn sum_of(shares: &[Share], number: impl Fn(&Share) -> f64) -> Expr {
    let each = shares.iter().map(|share| multiply(Expr::Number(number(share)), share.factor.clone()));
    each.fold(Expr::Number(0.0), add)
}

/// The sum over matrices of the factor times the sum of terms.
fn sum_over(shares: &[Share], terms: impl Fn(&Square) -> Vec<(f64, Expr)>) -> Expr {
    let each = shares.iter().map(|share| {
        let terms = terms(&share.matrix).into_iter().filter(|(number, _)| *number != 0.0);
        let sum = terms.map(|(number, of)| multiply(Expr::Number(number), of)).fold(Expr::Number(0.0), add);
        multiply(share.factor.clone(), sum)
    });
    each.fold(Expr::Number(0.0), add)
}
