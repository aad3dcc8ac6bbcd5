//! What a part of a shaft between two stations does at rest, in closed form: section after section from the force and the
//! moment at its first end.
//!
//! Motions in two planes are one complex number `y + i z`. Where the material lags and turns, its stiffness against bending is
//! complex too: what bends it pushes it sideways.

use proc_macro2::Ident;

use super::super::resolver::Resolver;
use crate::model::expression::Expr;
use crate::model::mechanism::{ForceLaw, Line, NUMBERS, Span};
use crate::model::simplify::{add, divide, multiply, negate, power_integer, subtract};

/// A complex expression.
#[derive(Clone, Debug)]
struct Complex(Expr, Expr);

const ZERO: Expr = Expr::Number(0.0);
/// Terms of the series in the tension: errors of `1e-9` up to twice the square below.
const TERMS: usize = 10;
/// The most that tension times the square of a step's length may be of the stiffness against bending.
const FAST: f64 = 8.0;
const MOST_STEPS: usize = 64;

fn real(a: Expr) -> Complex {
    Complex(a, ZERO)
}

impl Complex {
    fn plus(&self, other: &Self) -> Self {
        Self(add(self.0.clone(), other.0.clone()), add(self.1.clone(), other.1.clone()))
    }

    fn less(&self, other: &Self) -> Self {
        Self(subtract(self.0.clone(), other.0.clone()), subtract(self.1.clone(), other.1.clone()))
    }

    fn times(&self, other: &Self) -> Self {
        let product = |a: &Expr, b: &Expr| multiply(a.clone(), b.clone());
        Self(
            subtract(product(&self.0, &other.0), product(&self.1, &other.1)),
            add(product(&self.0, &other.1), product(&self.1, &other.0)),
        )
    }

    fn scaled(&self, factor: &Expr) -> Self {
        Self(multiply(factor.clone(), self.0.clone()), multiply(factor.clone(), self.1.clone()))
    }

    fn inverse(&self) -> Self {
        if self.1 == ZERO {
            return real(divide(Expr::Number(1.0), self.0.clone()));
        }
        let square = add(power_integer(self.0.clone(), 2), power_integer(self.1.clone(), 2));
        Self(divide(self.0.clone(), square.clone()), divide(negate(self.1.clone()), square))
    }
}

impl Resolver<'_> {
    /// Forces on the coordinates of both ends, with the weight of what is between them: an energy where there is one.
    pub(super) fn at_rest(&mut self, name: &Ident, span: &Span, weight: [Expr; 2]) -> Vec<ForceLaw> {
        match span.line {
            Line::Bar => self.bar_at_rest(name, span, &weight[0]),
            Line::Timoshenko | Line::Slender => self.bent_at_rest(name, span, weight),
        }
    }

    /// The energy of a torque `T` along the cubic through both ends, `T/2` times the integral of `y'' z' - z'' y'`: at the ends of
    /// the shaft it turns half with these, and so does no work on a way that closes (semitangential: H. Ziegler, "Principles
    /// of Structural Stability", 1968).
    pub(super) fn under_torque(&mut self, name: &Ident, span: &Span, torque: &Expr) -> ForceLaw {
        let length = span.sections.iter().fold(ZERO, |length, section| add(length, section[0].clone()));
        let length = self.shared_of_shaft(name, length);
        let ends = [0, 1].map(|end| Self::motions(span, end));
        let scaled = |factor: f64, x: Expr| multiply(Expr::Number(factor), x);
        // By how much the slope changes, and the mean of all along it and of its ends.
        let [y, z] = [0, 2].map(|plane| {
            let [moves, slopes] = [plane, plane + 1].map(|k| ends.each_ref().map(|end| end[k].clone()));
            let [[w, next], [first, last]] = [moves, slopes];
            let of_ends = scaled(0.5, add(first.clone(), last.clone()));
            [subtract(last, first), divide(subtract(next, w), length.clone()), of_ends]
        });
        // Within, it is a parabola.
        let turned = |[change, ..]: &[Expr; 3], [_, mean, of_ends]: &[Expr; 3]| {
            multiply(change.clone(), subtract(scaled(2.0, mean.clone()), of_ends.clone()))
        };
        let integral = subtract(turned(&y, &z), turned(&z, &y));
        let energy = multiply(scaled(0.5, torque.clone()), integral);
        ForceLaw::Potential { energy }
    }

    fn motions(span: &Span, end: usize) -> Vec<Expr> {
        let own = span.ends[end].iter();
        own.map(|(id, factor)| multiply(Expr::Number(*factor), Expr::Coordinate(*id))).collect()
    }

    fn bar_at_rest(&mut self, name: &Ident, span: &Span, weight: &Expr) -> Vec<ForceLaw> {
        let [first, last] = [0, 1].map(|end| Self::motions(span, end).swap_remove(0));
        let (mut give, mut sag, mut load) = (ZERO, ZERO, ZERO);
        for section in &span.sections {
            let [length, stiffness, _, mass, ..] = section;
            let own = divide(length.clone(), stiffness.clone());
            let line = multiply(mass.clone(), weight.clone());
            let whole = multiply(line, length.clone());
            // The force at a place is that at the first end less the load before it.
            let mean = add(load.clone(), multiply(Expr::Number(0.5), whole.clone()));
            let [new_give, new_sag, new_load] =
                [add(give, own.clone()), subtract(sag, multiply(own, mean)), add(load, whole)];
            [give, sag, load] = [new_give, new_sag, new_load].map(|x| self.shared_of_shaft(name, x));
        }
        let strain = subtract(subtract(last.clone(), first), sag);
        let elastic = divide(power_integer(strain, 2), multiply(Expr::Number(2.0), give));
        vec![ForceLaw::Potential { energy: subtract(elastic, multiply(load, last)) }]
    }

    fn bent_at_rest(&mut self, name: &Ident, span: &Span, weight: [Expr; 2]) -> Vec<ForceLaw> {
        let [w_first, b_first, w_last, b_last] = {
            let planes = [0, 1].map(|end| {
                let [y, slope_y, z, slope_z] =
                    <[Expr; 4]>::try_from(Self::motions(span, end)).expect("a shaft that bends has these motions");
                [Complex(y, z), Complex(slope_y, slope_z)]
            });
            let [[a, b], [c, d]] = planes;
            [a, b, c, d]
        };
        let Bent { by_slope, by_moment, by_force, sag, load } = self.given_way(name, span);
        let weight = &Complex(weight[0].clone(), weight[1].clone());
        let [w_t, b_t, m_t] = &by_slope;
        let [w_b, b_b, m_b] = &by_moment;
        let [w_s, b_s, m_s] = &by_force;
        let [w_q, b_q, m_q] = sag.each_ref().map(|x| x.times(weight));
        // Deflection and slope of the last end beside those without force and moment there but that of tension, by the force and
        // the moment that are left.
        let d =
            [w_last.less(&w_first).less(&b_first.times(w_t)).less(&w_q), b_last.less(&b_first.times(b_t)).less(&b_q)];
        let by_last = m_b.inverse();
        let arm = m_s.times(&by_last);
        let give =
            [[w_s.less(&w_b.times(&arm)), w_b.times(&by_last)], [b_s.less(&b_b.times(&arm)), b_b.times(&by_last)]];
        let determinant = give[0][0].times(&give[1][1]).less(&give[0][1].times(&give[1][0]));
        let inverse = determinant.inverse();
        let entry = |x: &Complex, sign: f64| x.times(&inverse).scaled(&Expr::Number(sign));
        let stiffness =
            [[entry(&give[1][1], 1.0), entry(&give[0][1], -1.0)], [entry(&give[1][0], -1.0), entry(&give[0][0], 1.0)]];
        let stiffness = stiffness.map(|row| {
            row.map(|Complex(re, im)| Complex(self.shared_of_shaft(name, re), self.shared_of_shaft(name, im)))
        });
        let [force, moment] = [0, 1].map(|k| stiffness[k][0].times(&d[0]).plus(&stiffness[k][1].times(&d[1])));
        let loads = [weight.scaled(&load), m_q];
        if stiffness.iter().flatten().all(|x| x.1 == ZERO) {
            let product =
                |a: &Complex, b: &Complex| add(multiply(a.0.clone(), b.0.clone()), multiply(a.1.clone(), b.1.clone()));
            let twice = add(product(&d[0], &force), product(&d[1], &moment));
            let elastic = multiply(Expr::Number(0.5), twice);
            let tense = product(&b_first.times(m_t), &d[1].plus(&b_first.times(b_t).scaled(&Expr::Number(0.5))));
            let of_load = subtract(product(&loads[1], &b_last), product(&loads[0], &w_last));
            return vec![ForceLaw::Potential { energy: add(add(elastic, tense), of_load) }];
        }
        // What the shaft does to its ends, the opposite of what moves them.
        let at_first = [force.clone(), moment.less(&force.times(m_s)).times(&by_last)];
        let at_last = [loads[0].less(&force), real(ZERO).less(&moment).less(&b_first.times(m_t)).less(&loads[1])];
        let mut laws = Vec::new();
        for (end, [force, moment]) in [at_first, at_last].into_iter().enumerate() {
            let values = [force.0, moment.0, force.1, moment.1];
            for ((id, factor), value) in span.ends[end].iter().zip(values) {
                laws.push(ForceLaw::Generalized { coordinate: *id, value: multiply(Expr::Number(*factor), value) });
            }
        }
        laws
    }

    /// Section after section, each in as many steps as keep the series of its tension short.
    fn given_way(&mut self, name: &Ident, span: &Span) -> Bent {
        let none = || real(ZERO);
        let one = || real(Expr::Number(1.0));
        let mut so_far = Bent {
            by_slope: [none(), one(), none()],
            by_moment: [none(), none(), one()],
            by_force: [none(), none(), none()],
            sag: [none(), none(), none()],
            load: ZERO,
        };
        for section in &span.sections {
            let steps = self.steps_under_tension(section);
            let piece = Piece::new(span, section, steps);
            for _ in 0..steps {
                let Bent { by_slope, by_moment, by_force, sag, load } = &so_far;
                let next = [
                    piece.moved(by_slope, [&ZERO, &ZERO]),
                    piece.moved(by_moment, [&ZERO, &ZERO]),
                    piece.moved(by_force, [&Expr::Number(1.0), &ZERO]),
                    piece.moved(sag, [&negate(load.clone()), &piece.mass]),
                ];
                let load = add(load.clone(), multiply(piece.mass.clone(), piece.length.clone()));
                let mut shared = |x: Expr| self.shared_of_shaft(name, x);
                let [by_slope, by_moment, by_force, sag] =
                    next.map(|column| column.map(|Complex(re, im)| Complex(shared(re), shared(im))));
                so_far = Bent { by_slope, by_moment, by_force, sag, load: self.shared_of_shaft(name, load) };
            }
        }
        so_far
    }

    fn steps_under_tension(&self, [length, bending, _, _, _, _, tension, _]: &[Expr; NUMBERS]) -> usize {
        let [length, bending, tension] = [length, bending, tension].map(|x| self.nominal_of(x));
        let steps = (tension.abs() * length * length / (bending * FAST)).sqrt().ceil();
        if steps.is_finite() { (steps as usize).clamp(1, MOST_STEPS) } else { 1 }
    }
}

/// A piece of a section: `E I b' = m`, `m' = -r (f - T b)` and `w' = r b + f / (S + T)` with the transverse force `f`, whose share
/// `r = S / (S + T)` is shear.
struct Piece {
    length: Expr,
    mass: Expr,
    /// `1 / (E I)`, of `y + i z`.
    gives: Complex,
    /// `r`, and `1 / (S + T)`.
    shears: [Expr; 2],
    /// `T r`.
    tension: Expr,
    /// Length to the power `n` times the sum of all `(T r / (E I) length^2)^k / (n + 2 k)!`, for each `n`: without tension what
    /// integrals of one are.
    powers: [Complex; 5],
}

impl Piece {
    fn new(span: &Span, [length, bending, shear, mass, _, lag, tension, _]: &[Expr; NUMBERS], steps: usize) -> Self {
        let length = divide(length.clone(), Expr::Number(steps as f64));
        // Of `y + i z` the stiffness is `E I (1 - i lag speed)`.
        let turned = negate(multiply(lag.clone(), span.speed.clone()));
        let gives = Complex(bending.clone(), multiply(bending.clone(), turned)).inverse();
        let shears = match span.line {
            Line::Slender => [Expr::Number(1.0), ZERO],
            _ if *tension == ZERO => [Expr::Number(1.0), divide(Expr::Number(1.0), shear.clone())],
            _ => {
                let whole = add(shear.clone(), tension.clone());
                [divide(shear.clone(), whole.clone()), divide(Expr::Number(1.0), whole)]
            }
        };
        let tension = multiply(tension.clone(), shears[0].clone());
        let square = gives.scaled(&multiply(tension.clone(), power_integer(length.clone(), 2)));
        let factorial = |n: usize| (1..=n).map(|k| k as f64).product::<f64>();
        let constant = |n: usize| real(Expr::Number(1.0 / factorial(n)));
        // The series of the last two, from which those before them follow.
        let last = |n: usize| {
            let terms = if tension == ZERO { 0 } else { TERMS };
            (0..terms).rev().fold(constant(n + 2 * terms), |sum, k| constant(n + 2 * k).plus(&sum.times(&square)))
        };
        let [fourth, third] = [last(4), last(3)];
        let second = constant(2).plus(&square.times(&fourth));
        let first = constant(1).plus(&square.times(&third));
        let zeroth = constant(0).plus(&square.times(&second));
        let mut n = 0;
        let powers = [zeroth, first, second, third, fourth].map(|series| {
            n += 1;
            series.scaled(&power_integer(length.clone(), n - 1))
        });
        Self { length, mass: mass.clone(), gives, shears, tension, powers }
    }

    /// Deflection, slope and moment at its end from those at its beginning, with the transverse force there and the load on it.
    fn moved(&self, [w, b, m]: &[Complex; 3], [force, load]: [&Expr; 2]) -> [Complex; 3] {
        let Self { length, gives, shears: [share, shears], tension, powers: [p0, p1, p2, p3, p4], .. } = self;
        // Integrals of the transverse force that is shear.
        let pushed = |by: &Complex, more: &Complex| by.scaled(force).less(&more.scaled(load)).scaled(share);
        let bent = |b0: &Complex, m0: &Complex, by: &Complex, more: &Complex| {
            b.times(b0).plus(&gives.times(&m.times(m0).less(&pushed(by, more))))
        };
        let sheared = multiply(
            subtract(
                multiply(force.clone(), length.clone()),
                multiply(load.clone(), divide(power_integer(length.clone(), 2), Expr::Number(2.0))),
            ),
            shears.clone(),
        );
        [
            w.plus(&bent(p1, p2, p3, p4).scaled(share)).plus(&real(sheared)),
            bent(p0, p1, p2, p3),
            b.times(p1).scaled(tension).plus(&m.times(p0)).less(&pushed(p1, p2)),
        ]
    }
}

/// Deflection, slope and moment at the last end, by a slope, a moment and a force at the first and by a unit of gravity; the mass
/// before it.
struct Bent {
    by_slope: [Complex; 3],
    by_moment: [Complex; 3],
    by_force: [Complex; 3],
    sag: [Complex; 3],
    load: Expr,
}
