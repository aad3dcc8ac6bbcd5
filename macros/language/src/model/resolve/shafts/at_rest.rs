//! What a part of a shaft between two stations does at rest, in closed form: section after section from the force and the
//! moment at its first end.
//!
//! Motions in two planes are one complex number `y + i z`. Where the material lags and turns, its stiffness against bending is
//! complex too: what bends it pushes it sideways.

use proc_macro2::Ident;

use super::super::resolver::Resolver;
use crate::model::expression::Expr;
use crate::model::mechanism::{ForceLaw, Line, Span};
use crate::model::simplify::{add, divide, multiply, negate, power_integer, subtract};

/// A complex expression.
#[derive(Clone, Debug)]
struct Complex(Expr, Expr);

const ZERO: Expr = Expr::Number(0.0);

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
        let Bent { by_moment: [w_b, b_b], by_force: [w_s, b_s], sag: [w_q, b_q], load, turned, length } =
            self.given_way(name, span);
        let weight = &Complex(weight[0].clone(), weight[1].clone());
        // Deflection and slope of the last end beside those of a rigid shaft on the first, less those under its weight, by the
        // force and the moment there.
        let sagged = |x: &Complex| x.times(weight);
        let d = [
            w_last.less(&w_first).less(&b_first.scaled(&length)).less(&sagged(&w_q)),
            b_last.less(&b_first).less(&sagged(&b_q)),
        ];
        let give = [[w_s.plus(&w_b.scaled(&length)), w_b], [b_s.plus(&b_b.scaled(&length)), b_b]];
        let determinant = give[0][0].times(&give[1][1]).less(&give[0][1].times(&give[1][0]));
        let inverse = determinant.inverse();
        let entry = |x: &Complex, sign: f64| x.times(&inverse).scaled(&Expr::Number(sign));
        let stiffness =
            [[entry(&give[1][1], 1.0), entry(&give[0][1], -1.0)], [entry(&give[1][0], -1.0), entry(&give[0][0], 1.0)]];
        let stiffness = stiffness.map(|row| {
            row.map(|Complex(re, im)| Complex(self.shared_of_shaft(name, re), self.shared_of_shaft(name, im)))
        });
        let [force, moment] = [0, 1].map(|k| stiffness[k][0].times(&d[0]).plus(&stiffness[k][1].times(&d[1])));
        let loads = [weight.scaled(&load), weight.scaled(&turned)];
        if stiffness.iter().flatten().all(|x| x.1 == ZERO) {
            let product =
                |a: &Complex, b: &Complex| add(multiply(a.0.clone(), b.0.clone()), multiply(a.1.clone(), b.1.clone()));
            let twice = add(product(&d[0], &force), product(&d[1], &moment));
            let elastic = multiply(Expr::Number(0.5), twice);
            let of_load = subtract(product(&loads[1], &b_last), product(&loads[0], &w_last));
            return vec![ForceLaw::Potential { energy: add(elastic, of_load) }];
        }
        // What the shaft does to its ends, the opposite of what moves them.
        let at_first = [force.clone(), moment.plus(&force.scaled(&length))];
        let at_last = [loads[0].less(&force), real(ZERO).less(&moment).less(&loads[1])];
        let mut laws = Vec::new();
        for (end, [force, moment]) in [at_first, at_last].into_iter().enumerate() {
            let values = [force.0, moment.0, force.1, moment.1];
            for ((id, factor), value) in span.ends[end].iter().zip(values) {
                laws.push(ForceLaw::Generalized { coordinate: *id, value: multiply(Expr::Number(*factor), value) });
            }
        }
        laws
    }

    fn given_way(&mut self, name: &Ident, span: &Span) -> Bent {
        let mut so_far = Bent {
            by_moment: [real(ZERO), real(ZERO)],
            by_force: [real(ZERO), real(ZERO)],
            sag: [real(ZERO), real(ZERO)],
            load: ZERO,
            turned: ZERO,
            length: ZERO,
        };
        for section in &span.sections {
            let [length, bending, shear, mass, _, lag, ..] = section;
            // Of `y + i z` the stiffness is `E I (1 - i lag speed)`.
            let turned = negate(multiply(lag.clone(), span.speed.clone()));
            let stiffness = Complex(bending.clone(), multiply(bending.clone(), turned));
            let gives = stiffness.inverse();
            let shears = match span.line {
                Line::Slender => ZERO,
                _ => divide(Expr::Number(1.0), shear.clone()),
            };
            let power = |n: i32, below: f64| divide(power_integer(length.clone(), n), Expr::Number(below));
            let product = |a: &Expr, b: &Expr| multiply(a.clone(), b.clone());
            let sum = |terms: [Expr; 3]| terms.into_iter().fold(ZERO, add);
            let Bent { by_moment, by_force, sag, load, turned, length: before } = &so_far;
            // Integrals of the moment once and twice, by moment and force at the first end and by the weight before.
            let once = [
                length.clone(),
                negate(add(product(before, length), power(2, 2.0))),
                sum([product(turned, length), product(load, &power(2, 2.0)), product(mass, &power(3, 6.0))]),
            ];
            let twice = [
                power(2, 2.0),
                negate(add(product(before, &power(2, 2.0)), power(3, 6.0))),
                sum([product(turned, &power(2, 2.0)), product(load, &power(3, 6.0)), product(mass, &power(4, 24.0))]),
            ];
            let sheared = [
                ZERO,
                product(length, &shears),
                negate(multiply(add(product(load, length), product(mass, &power(2, 2.0))), shears)),
            ];
            let parts = [by_moment, by_force, sag];
            let mut next = Vec::new();
            for (k, [deflection, slope]) in parts.into_iter().enumerate() {
                let moved = deflection.plus(&slope.scaled(length)).plus(&gives.scaled(&twice[k]));
                let pair = [moved.plus(&real(sheared[k].clone())), slope.plus(&gives.scaled(&once[k]))];
                next.push(pair);
            }
            let more = product(mass, length);
            let turned = sum([turned.clone(), product(load, length), product(mass, &power(2, 2.0))]);
            let (load, length) = (add(load.clone(), more), add(before.clone(), length.clone()));
            let mut shared = |x: Expr| self.shared_of_shaft(name, x);
            let mut pairs = next.into_iter().map(|pair| pair.map(|Complex(re, im)| Complex(shared(re), shared(im))));
            let mut pair = || pairs.next().expect("three pairs");
            let (by_moment, by_force, sag) = (pair(), pair(), pair());
            drop(pairs);
            so_far = Bent {
                by_moment,
                by_force,
                sag,
                load: self.shared_of_shaft(name, load),
                turned: self.shared_of_shaft(name, turned),
                length: self.shared_of_shaft(name, length),
            };
        }
        so_far
    }
}

/// Deflection and slope of the last end, beside those of a rigid shaft, by moment and force at the first end and by a unit of
/// gravity; the mass before the last end, its first moment about it, and the length.
struct Bent {
    by_moment: [Complex; 2],
    by_force: [Complex; 2],
    sag: [Complex; 2],
    load: Expr,
    turned: Expr,
    length: Expr,
}
