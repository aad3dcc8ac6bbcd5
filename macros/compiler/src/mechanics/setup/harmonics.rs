//! Unknowns that vibrate in steady motion: where blades make the equations periodic in the angle of their drive, and the
//! periodic part is small.
//!
//! Gravity across the axis of equal blades leaves a part of the equations in multiblade coordinates `a` that depends on the
//! angle `theta` of the drive; turned by one blade, they are the same. So the steady motion, and what is slow beside the
//! drive, is
//!
//! - `a = a_0 + sum_h (c_h cos h theta + s_h sin h theta)`, `h` in `orders`,
//!
//! and `a_0`, `c_h`, `s_h` are the unknowns. Forces along them are the means of those along `a`, times 1, `cos h theta` and
//! `sin h theta` (Galerkin), over angles of one period. Everything that is derived from these equations, modes and their
//! derivatives, is that of Hill's method with these orders: natural frequencies are correct to the fourth power of the
//! periodic part, where those of coefficients averaged over the angle are to the second.

use crate::algebra::{ExprId, Graph, SymbolId, substitute};

use super::symbols::Symbols;

/// An angle of the drive: what replaces the coordinates and their rates there, and the factors of the unknowns.
type Angle = (Vec<(SymbolId, ExprId)>, Vec<f64>);

/// The unknowns, and the equations at angles of one period.
#[derive(Clone, Debug, Default)]
pub(crate) struct Harmonics {
    /// Multiples of the drive's speed; empty where nothing is periodic.
    pub(crate) orders: Vec<usize>,
    /// Number of coordinates.
    coordinates: usize,
    /// Equally spaced over one period.
    angles: Vec<Angle>,
}

impl Harmonics {
    /// With the angles of all drives as symbols, marked that of the ring, and its speed. `symbols` are those of the coordinates, `unknowns` those
    /// extended by the harmonics.
    pub(crate) fn new(
        g: &mut Graph,
        orders: Vec<usize>,
        (symbols, unknowns): (&Symbols, &Symbols),
        (angles, speed): (&[(SymbolId, bool)], ExprId),
    ) -> Self {
        let n = symbols.q.ids.len();
        let count = 4 * orders.len() + 2;
        let period = std::f64::consts::TAU / orders[0] as f64;
        let sampled = (0..count).map(|k| {
            let theta = period * k as f64 / count as f64;
            let factors: Vec<[f64; 2]> =
                orders.iter().map(|&h| [(h as f64 * theta).cos(), (h as f64 * theta).sin()]).collect();
            let value = g.constant(theta);
            let zero = g.zero();
            let mut replaced: Vec<_> =
                angles.iter().map(|&(symbol, own)| (symbol, if own { value } else { zero })).collect();
            for j in 0..n {
                let [q, v, a] = [&unknowns.q, &unknowns.velocity, &unknowns.acceleration];
                let (mut position, mut rate, mut growth) = (vec![q.values[j]], vec![v.values[j]], vec![a.values[j]]);
                for (k, (&order, [cosine, sine])) in orders.iter().zip(&factors).enumerate() {
                    let (c, s) = ((2 * k + 1) * n + j, (2 * k + 2) * n + j);
                    let turn = g.scale(order as f64, speed);
                    let square = g.mul(turn, turn);
                    for (own, other, sign, factor) in [(c, s, 1.0, *cosine), (s, c, -1.0, *sine)] {
                        let twice = g.scale(2.0 * sign, turn);
                        let turn = g.scale(sign, turn);
                        let carried = g.mul(turn, q.values[other]);
                        let velocity = g.add(v.values[own], carried);
                        let coriolis = g.mul(twice, v.values[other]);
                        let centripetal = g.mul(square, q.values[own]);
                        let faster = g.add(a.values[own], coriolis);
                        let acceleration = g.sub(faster, centripetal);
                        position.push(g.scale(factor, q.values[own]));
                        rate.push(g.scale(factor, velocity));
                        growth.push(g.scale(factor, acceleration));
                    }
                }
                let sums = [position, rate, growth].map(|terms| g.sum(terms));
                let ids = [symbols.q.ids[j], symbols.velocity.ids[j], symbols.acceleration.ids[j]];
                replaced.extend(ids.into_iter().zip(sums));
            }
            let weights = [1.0].into_iter().chain(factors.into_iter().flatten());
            (replaced, weights.map(|weight| weight / count as f64).collect())
        });
        Self { angles: sampled.collect(), coordinates: n, orders }
    }

    /// Whether the unknowns are constant in steady motion.
    pub(crate) fn is_empty(&self) -> bool {
        self.orders.is_empty()
    }

    /// Number of unknowns of each coordinate.
    fn each(&self) -> usize {
        1 + 2 * self.orders.len()
    }

    /// Forces along the unknowns from forces along the coordinates, at the symbolic angle.
    pub(crate) fn forces(&self, g: &mut Graph, along: &[ExprId]) -> Vec<ExprId> {
        if self.is_empty() {
            return along.to_vec();
        }
        let mut sums = vec![Vec::new(); self.each() * along.len()];
        for (replaced, weights) in &self.angles {
            let values = substitute(g, along, replaced);
            let products = weights.iter().flat_map(|weight| values.iter().map(move |value| (*weight, *value)));
            for (sum, (weight, value)) in sums.iter_mut().zip(products) {
                sum.push(g.scale(weight, value));
            }
        }
        sums.into_iter().map(|terms| g.sum(terms)).collect()
    }

    /// The mean of values over the angle.
    pub(crate) fn mean(&self, g: &mut Graph, values: &[ExprId]) -> Vec<ExprId> {
        let mut mean = self.forces(g, values);
        mean.truncate(values.len());
        mean
    }

    /// Forces that do not depend on the angle act along the means alone.
    pub(crate) fn constant(&self, g: &mut Graph, along: &[ExprId]) -> Vec<ExprId> {
        let zeros = vec![g.zero(); if self.is_empty() { 0 } else { (self.each() - 1) * self.coordinates }];
        [along, &zeros].concat()
    }

    /// The coordinate of an unknown, the order and whether it is the sine; `None` of the means.
    pub(crate) fn of_unknown(orders: &[usize], coordinates: usize, unknown: usize) -> Option<(usize, usize, bool)> {
        let block = unknown / coordinates.max(1);
        let order = orders.get(block.checked_sub(1)? / 2)?;
        Some((unknown % coordinates, *order, block.is_multiple_of(2)))
    }
}

impl Symbols {
    /// Adds the amplitudes of so many harmonics of every unknown.
    pub(crate) fn with_harmonics(mut self, g: &mut Graph, orders: &[usize]) -> Self {
        let pencil = &mut self.pencil;
        let lists = [
            &mut self.q,
            &mut self.velocity,
            &mut self.acceleration,
            &mut self.phi,
            &mut self.w,
            &mut self.real,
            &mut self.imaginary,
            &mut pencil.left,
            &mut pencil.acceleration,
            &mut pencil.velocity,
            &mut pencil.position,
        ];
        for list in lists {
            let given: Vec<SymbolId> = list.ids.clone();
            for order in orders {
                for part in ["cosine", "sine"] {
                    for &id in &given {
                        let symbol = g.symbol_info(id).clone();
                        let (id, value) = g.symbol(format!("{}_{part}_{order}", symbol.name), symbol.stage);
                        list.ids.push(id);
                        list.values.push(value);
                    }
                }
            }
        }
        self
    }
}
