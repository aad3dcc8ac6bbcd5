//! Multiblade coordinates: what equal blades do together, seen from the ground.
//!
//! The hub turns, so blades and a support that is not symmetric about the axis have equations of motion that are periodic
//! in the angle `psi` of the drive. With blade `i` at `psi_i = psi + 2 pi i/N`, each of its coordinates is
//!
//! - `beta_i = a_0 + sum_n (c_n cos n psi_i + s_n sin n psi_i) + d (-1)^i`, `n < N/2`, `d` for even `N`,
//!
//! which are as many unknowns as there are blades. With `T` the coefficients of these, `beta = T a`, `dbeta/dt = T v` and
//! `d2beta/dt2 = T w`, where each pair has
//!
//! - `v_c = c' + n W s`, `v_s = s' - n W c`,
//! - `w_c = c'' + 2 n W s' - n^2 W^2 c`, `w_s = s'' - 2 n W c' - n^2 W^2 s`,
//!
//! `W` is the speed, and the forces along the unknowns are `T^T` times those along the coordinates of the blades. For three
//! blades or more on an axis without a force across it, these equations do not depend on `psi` where the blades do the same
//! (`c = s = d = 0`), and neither do their first derivatives. (R. P. Coleman and A. M. Feingold, NACA report 1351, 1958;
//! G. Bir, "Multi-blade coordinate transformation and its application to wind turbine analysis", 2008.)

use std::f64::consts::TAU;

use crate::algebra::{ExprId, Graph, SymbolId, Unary, substitute};
use crate::base::names::joined;
use crate::model::mechanism::Ring;
use crate::topology::Topology;

use super::symbols::{SymbolList, Symbols};

/// Coordinates of blades in terms of unknowns that all blades share; empty where the unknowns are the coordinates.
#[derive(Clone, Debug, Default)]
pub(crate) struct Multiblade {
    rings: Vec<Turning>,
    /// By unknown: its name and whether the blades differ in it, where it is not the coordinate of a joint.
    unknowns: Vec<Option<(String, bool)>>,
    /// Whether blades differ in steady motion.
    pub(crate) bent: bool,
    /// What replaces the coordinates, their rates and the vectors along them.
    replaced: Vec<(SymbolId, ExprId)>,
    /// The coordinates where all blades do the same.
    alike: Vec<(SymbolId, ExprId)>,
    /// The unknowns in which they differ.
    lateral: Vec<SymbolId>,
}

/// One ring and the drive that turns it.
#[derive(Clone, Debug)]
struct Turning {
    /// By coordinate, then by blade: the place among the unknowns.
    slots: Vec<Vec<usize>>,
    /// By blade, then by pattern.
    pattern: Vec<Vec<ExprId>>,
    speed: ExprId,
}

/// What a blade's place contributes to one of its coordinates.
#[derive(Clone, Copy)]
enum Pattern {
    Collective,
    Cosine(u32),
    Sine(u32),
    Differential,
}

/// The patterns of `n` blades in order.
fn patterns(n: usize) -> Vec<Pattern> {
    let mut patterns = vec![Pattern::Collective];
    for harmonic in 1..=(n as u32 - 1) / 2 {
        patterns.extend([Pattern::Cosine(harmonic), Pattern::Sine(harmonic)]);
    }
    if n.is_multiple_of(2) {
        patterns.push(Pattern::Differential);
    }
    patterns
}

/// The cosine and the sine of a whole part of a turn, exactly zero and one where they are.
fn of_turn(part: usize, n: usize) -> [f64; 2] {
    let quarter = |part: usize| match 4 * (part % n) {
        0 => Some([1.0, 0.0]),
        x if x == n => Some([0.0, 1.0]),
        x if x == 2 * n => Some([-1.0, 0.0]),
        x if x == 3 * n => Some([0.0, -1.0]),
        _ => None,
    };
    quarter(part).unwrap_or_else(|| {
        let angle = TAU * (part % n) as f64 / n as f64;
        [angle.cos(), angle.sin()]
    })
}

impl Pattern {
    /// Of a pattern at place `k`: its number of waves, the place of the pattern that the rotation carries into it, and the
    /// sign of that.
    fn carried(self, k: usize) -> Option<(f64, usize, f64)> {
        match self {
            Self::Cosine(n) => Some((f64::from(n), k + 1, 1.0)),
            Self::Sine(n) => Some((f64::from(n), k - 1, -1.0)),
            Self::Collective | Self::Differential => None,
        }
    }

    /// `ring` in the plural, the coordinate and the pattern, `blades.lag.cosine`.
    fn name(self, ring: &Ring, coordinate: &str) -> String {
        let mut name = format!("{}s", ring.name);
        if !coordinate.is_empty() {
            name = joined(&name, coordinate);
        }
        let several = ring.members > 4;
        let (word, harmonic) = match self {
            Self::Collective => ("collective", None),
            Self::Cosine(n) => ("cosine", Some(n)),
            Self::Sine(n) => ("sine", Some(n)),
            Self::Differential => ("differential", None),
        };
        name = joined(&name, word);
        match harmonic.filter(|_| several) {
            Some(n) => joined(&name, &n.to_string()),
            None => name,
        }
    }

    /// Its coefficient for blade `i` of `n` when the first stands at `psi`.
    fn of_blade(self, g: &mut Graph, psi: ExprId, (i, n): (usize, usize)) -> ExprId {
        let (harmonic, is_sine) = match self {
            Self::Collective => return g.constant(1.0),
            Self::Differential => return g.constant(if i.is_multiple_of(2) { 1.0 } else { -1.0 }),
            Self::Cosine(harmonic) => (harmonic, false),
            Self::Sine(harmonic) => (harmonic, true),
        };
        let [cosine, sine] = of_turn(harmonic as usize * i, n);
        let angle = g.scale(f64::from(harmonic), psi);
        let [c, s] = [Unary::Cos, Unary::Sin].map(|function| g.unary(function, angle));
        let [first, second] = if is_sine { [(cosine, s), (sine, c)] } else { [(cosine, c), (-sine, s)] };
        let [first, second] = [first, second].map(|(factor, of)| g.scale(factor, of));
        g.add(first, second)
    }
}

impl Multiblade {
    /// Adds a ring whose first blade stands at `psi`, which grows at `speed`.
    pub(crate) fn add(
        &mut self,
        g: &mut Graph,
        (topology, symbols): (&Topology, &Symbols),
        ring: &Ring,
        [psi, speed]: [ExprId; 2],
    ) {
        self.unknowns.resize(symbols.q.ids.len(), None);
        let n = ring.members;
        let patterns = patterns(n);
        let pattern = (0..n).map(|i| patterns.iter().map(|pattern| pattern.of_blade(g, psi, (i, n))).collect());
        let mut turning = Turning { slots: Vec::new(), pattern: pattern.collect(), speed };
        for (name, ids) in &ring.coordinates {
            let slots: Option<Vec<usize>> =
                ids.iter().map(|id| topology.free.iter().position(|free| free == id)).collect();
            let Some(slots) = slots else { continue };
            for (&slot, pattern) in slots.iter().zip(&patterns) {
                let lateral = !matches!(pattern, Pattern::Collective);
                self.unknowns[slot] = Some((pattern.name(ring, name), lateral));
            }
            let values = |list: &SymbolList| -> Vec<ExprId> { slots.iter().map(|&k| list.values[k]).collect() };
            let motion = [&symbols.q, &symbols.velocity, &symbols.acceleration].map(values);
            for (list, rates) in [&symbols.q, &symbols.velocity, &symbols.acceleration]
                .into_iter()
                .zip(rates(g, &patterns, motion, speed))
            {
                self.replace(g, &turning, list, &slots, &rates);
            }
            for list in [&symbols.real, &symbols.imaginary] {
                let values = values(list);
                self.replace(g, &turning, list, &slots, &values);
            }
            let collective = symbols.q.values[slots[0]];
            self.alike.extend(slots.iter().map(|&k| (symbols.q.ids[k], collective)));
            self.lateral.extend(slots[1..].iter().map(|&k| symbols.q.ids[k]));
            turning.slots.push(slots);
        }
        self.rings.push(turning);
    }

    fn replace(&mut self, g: &mut Graph, turning: &Turning, list: &SymbolList, slots: &[usize], values: &[ExprId]) {
        for (row, &slot) in turning.pattern.iter().zip(slots) {
            let terms: Vec<ExprId> = row.iter().zip(values).map(|(&factor, &value)| g.mul(factor, value)).collect();
            let sum = g.sum(terms);
            self.replaced.push((list.ids[slot], sum));
        }
    }

    /// What makes blades do the same; nothing where they do not.
    pub(crate) fn alike(&self, g: &mut Graph) -> Vec<(SymbolId, ExprId)> {
        let zero = g.zero();
        if self.bent { Vec::new() } else { self.lateral.iter().map(|&symbol| (symbol, zero)).collect() }
    }

    /// Whether the unknowns are the coordinates.
    pub(crate) fn is_empty(&self) -> bool {
        self.rings.is_empty()
    }

    /// The name of an unknown that is not the coordinate of a joint.
    pub(crate) fn name(&self, unknown: usize) -> Option<&str> {
        self.unknowns.get(unknown)?.as_ref().map(|(name, _)| name.as_str())
    }

    /// Whether blades differ in an unknown.
    pub(crate) fn is_lateral(&self, unknown: usize) -> bool {
        !self.bent && matches!(self.unknowns.get(unknown), Some(Some((_, true))))
    }

    /// Unknowns that change their sign when blades are counted from the next.
    pub(crate) fn alternating(&self) -> impl Iterator<Item = usize> + '_ {
        let rings = self.rings.iter().filter(|ring| ring.pattern.len().is_multiple_of(2));
        rings.flat_map(|ring| ring.slots.iter().filter_map(|slots| slots.last().copied()))
    }

    /// Expressions of the coordinates in terms of the unknowns.
    pub(crate) fn in_unknowns(&self, g: &mut Graph, roots: &[ExprId]) -> Vec<ExprId> {
        if self.is_empty() { roots.to_vec() } else { substitute(g, roots, &self.replaced) }
    }

    /// Rates of the coordinates from rates of the unknowns.
    pub(crate) fn rates(&self, g: &mut Graph, along: &[ExprId]) -> Vec<ExprId> {
        self.turned(g, along, |pattern, i, h| pattern[i][h])
    }

    /// Forces along the unknowns from forces along the coordinates.
    pub(crate) fn forces(&self, g: &mut Graph, along: &[ExprId]) -> Vec<ExprId> {
        self.turned(g, along, |pattern, i, h| pattern[h][i])
    }

    /// Mass, damping and stiffness by columns along the unknowns from those along the coordinates, where all blades do the
    /// same: with `P = T^T M T`, `Q = T^T C T`, `R = T^T K T`, each pair adds `2 n W P` to the damping, `n W Q - n^2 W^2 P`
    /// to the stiffness.
    pub(crate) fn matrices(&self, g: &mut Graph, matrices: [Vec<Vec<ExprId>>; 3]) -> [Vec<Vec<ExprId>>; 3] {
        if self.is_empty() {
            return matrices;
        }
        let [mass, damping, stiffness] = matrices.map(|columns| {
            let columns: Vec<Vec<ExprId>> = columns
                .iter()
                .map(|column| {
                    let column = substitute(g, column, &self.alike);
                    self.forces(g, &column)
                })
                .collect();
            let rows: Vec<Vec<ExprId>> = transposed(&columns).into_iter().map(|row| self.forces(g, &row)).collect();
            transposed(&rows)
        });
        let (mut all_damping, mut all_stiffness) = (damping.clone(), stiffness);
        for ring in &self.rings {
            for slots in &ring.slots {
                for (k, pattern) in patterns(slots.len()).into_iter().enumerate() {
                    let Some((harmonic, other, sign)) = pattern.carried(k) else { continue };
                    let (own, other) = (slots[k], slots[other]);
                    let turn = g.scale(-sign * harmonic, ring.speed);
                    let twice = g.scale(2.0, turn);
                    let square = g.mul(turn, turn);
                    for i in 0..mass.len() {
                        let coriolis = g.mul(twice, mass[other][i]);
                        all_damping[own][i] = g.add(all_damping[own][i], coriolis);
                        let carried = g.mul(turn, damping[other][i]);
                        let centripetal = g.mul(square, mass[own][i]);
                        let sum = g.add(all_stiffness[own][i], carried);
                        all_stiffness[own][i] = g.sub(sum, centripetal);
                    }
                }
            }
        }
        [mass, all_damping, all_stiffness]
    }

    fn turned(
        &self,
        g: &mut Graph,
        values: &[ExprId],
        factor: impl Fn(&[Vec<ExprId>], usize, usize) -> ExprId,
    ) -> Vec<ExprId> {
        let mut turned = values.to_vec();
        for ring in &self.rings {
            for slots in &ring.slots {
                for (i, &slot) in slots.iter().enumerate() {
                    let terms = slots.iter().enumerate();
                    let terms: Vec<ExprId> =
                        terms.map(|(h, &other)| g.mul(factor(&ring.pattern, i, h), values[other])).collect();
                    turned[slot] = g.sum(terms);
                }
            }
        }
        turned
    }
}

fn transposed(columns: &[Vec<ExprId>]) -> Vec<Vec<ExprId>> {
    (0..columns.len()).map(|i| columns.iter().map(|column| column[i]).collect()).collect()
}

/// `a`, `v` and `w` from the unknowns and their rates.
fn rates(
    g: &mut Graph,
    patterns: &[Pattern],
    [a, mut velocity, mut acceleration]: [Vec<ExprId>; 3],
    speed: ExprId,
) -> [Vec<ExprId>; 3] {
    let given = velocity.clone();
    for (k, pattern) in patterns.iter().enumerate() {
        let Some((harmonic, other, sign)) = pattern.carried(k) else { continue };
        let turn = g.scale(sign * harmonic, speed);
        let carried = g.mul(turn, a[other]);
        velocity[k] = g.add(velocity[k], carried);
        let twice = g.scale(2.0, turn);
        let coriolis = g.mul(twice, given[other]);
        let square = g.mul(turn, turn);
        let centripetal = g.mul(square, a[k]);
        acceleration[k] = g.add(acceleration[k], coriolis);
        acceleration[k] = g.sub(acceleration[k], centripetal);
    }
    [a, velocity, acceleration]
}
