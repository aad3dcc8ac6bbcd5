//! Random expressions for force laws and energies, every term of the right dimension.

use super::tree::Builder;
use super::values::Source;
use crate::model::{Coordinate, Curve, Expr, Unit, Value};

impl Source {
    /// A factor from an interval, with either sign; its unit completes the product of `others` to `whole`.
    fn factor(&mut self, (low, high): (f64, f64), whole: Unit, others: &[Unit]) -> Expr {
        let unit = whole.over(others);
        let size = self.random.between(low, high);
        let number = self.random.signed(size);
        Expr::Value(self.value(number, unit), unit)
    }

    fn positive(&mut self, (low, high): (f64, f64), whole: Unit, others: &[Unit]) -> Expr {
        let unit = whole.over(others);
        Expr::Value(self.between(low, high, unit), unit)
    }

    /// A curve over values of about this size, with two to six points: arbitrary, on a line, or all zero. It extends
    /// beyond the size itself to cover arguments that do not move.
    fn curve(&mut self, (size, unit): (f64, Unit), argument: Expr) -> Expr {
        self.curves += 1;
        let count = 2 + self.random.below(5);
        let kind = if self.special { self.random.below(4) } else { 3 };
        let mut x = -1.5 * size;
        let points = (1..=count).map(|k| {
            x += size * self.random.between(0.2, 1.4);
            if k == count {
                x = x.max(1.3 * size);
            }
            let y = match kind {
                0 => 0.0,
                1 => 0.5 * x / size,
                _ => self.random.between(-1.0, 1.0),
            };
            [x, y]
        });
        let curve =
            Curve { points: points.collect(), name: format!("curve{}", self.curves), units: [unit, Unit::Of([0; 3])] };
        Expr::Curve(curve, Box::new(argument))
    }

    /// `k (length - L) + k3 (length - L)^3 + c rate + c2 rate length`.
    pub(super) fn tension(&mut self) -> Expr {
        let (metre, speed) = (Unit::Metre, Unit::MetrePerSecond);
        let free = Expr::Value(self.between(0.1, 0.8, metre), metre);
        let stretch = Expr::Length.minus(free);
        let cube = Expr::Power(Box::new(stretch.clone()), 3);
        Expr::Sum(vec![
            Expr::Product(vec![self.positive((10.0, 100.0), Unit::Newton, &[metre]), stretch]),
            Expr::Product(vec![self.factor((1.0, 20.0), Unit::Newton, &[metre; 3]), cube]),
            Expr::Product(vec![self.positive((0.1, 2.0), Unit::Newton, &[speed]), Expr::LengthRate]),
            Expr::Product(vec![self.factor((0.1, 1.0), Unit::Newton, &[speed, metre]), Expr::LengthRate, Expr::Length]),
            Expr::Product(vec![self.factor((1.0, 10.0), Unit::Newton, &[]), self.curve((0.7, metre), Expr::Length)]),
        ])
    }
}

impl Builder {
    fn units(&self, coordinate: Coordinate) -> [Unit; 3] {
        let motion = self.joints[coordinate.joint].steps[coordinate.step].motion;
        [motion.unit(), motion.rate_unit(), motion.force_unit()]
    }

    fn term(&mut self, range: (f64, f64), whole: Unit, parts: Vec<(Expr, Unit)>) -> Expr {
        let units: Vec<Unit> = parts.iter().map(|part| part.1).collect();
        let mut factors = vec![self.source.factor(range, whole, &units)];
        factors.extend(parts.into_iter().map(|part| part.0));
        Expr::Product(factors)
    }

    /// `-k q - k3 q^3 - c rate(q)`, plus couplings with another free coordinate, the speed of any coordinate, or an
    /// input.
    pub(super) fn generalized(&mut self, coordinate: Coordinate, free: &[Coordinate], all: &[Coordinate]) -> Expr {
        let [unit, rate_unit, force] = self.units(coordinate);
        let q = Expr::Coordinate(coordinate);
        let stiffness = self.source.positive((5.0, 80.0), force, &[unit]);
        let hardening = self.source.positive((1.0, 10.0), force, &[unit; 3]);
        let damping = self.source.positive((0.1, 2.0), force, &[rate_unit]);
        let cube = Expr::Power(Box::new(q.clone()), 3);
        let mut terms = vec![
            Expr::Product(vec![stiffness, q.clone()]).times(-1.0),
            Expr::Product(vec![hardening, cube]).times(-1.0),
            Expr::Product(vec![damping, Expr::Rate(coordinate)]).times(-1.0),
        ];
        let random = &mut self.source.random;
        let (other, moving) = (free[random.below(free.len())], all[random.below(all.len())]);
        let [other_unit, ..] = self.units(other);
        let [_, moving_unit, _] = self.units(moving);
        let input = (!self.inputs.is_empty()).then(|| self.source.random.below(self.inputs.len()));
        if other != coordinate {
            let other = (Expr::Coordinate(other), other_unit);
            terms.push(self.term((1.0, 8.0), force, vec![other]));
        }
        if self.source.random.chance(0.4) {
            let rate = (Expr::Rate(moving), moving_unit);
            terms.push(self.term((0.1, 1.0), force, vec![rate]));
        }
        if let Some(input) = input.filter(|_| self.source.random.chance(0.5)) {
            let input = (Expr::Input(input), self.inputs[input].unit);
            terms.push(self.term((0.1, 1.0), force, vec![input, (q, unit)]));
        }
        if self.source.random.chance(0.4) {
            let argument = self.argument_of_a_curve((Expr::Coordinate(other), other_unit));
            let curve = self.source.curve((1.0, argument.1), argument.0);
            let factor = (Expr::Coordinate(coordinate), unit);
            terms.push(self.term((0.1, 4.0), force, vec![(curve, Unit::Radian), factor]));
        }
        Expr::Sum(terms)
    }

    /// A coordinate, an input or a design variable.
    fn argument_of_a_curve(&mut self, coordinate: (Expr, Unit)) -> (Expr, Unit) {
        let source = &mut self.source;
        match source.random.below(3) {
            0 if !self.inputs.is_empty() => {
                let input = source.random.below(self.inputs.len());
                (Expr::Input(input), self.inputs[input].unit)
            }
            1 if !source.design.is_empty() => {
                let variable = source.random.below(source.design.len());
                let unit = source.design[variable].unit;
                let factor = 1.0 / source.design[variable].nominal;
                (Expr::Value(Value::Design { variable, factor }, unit), unit)
            }
            _ => coordinate,
        }
    }

    /// `1/2 k (q1 - q2)^2` for coordinates of the same unit, `1/2 k q^2 + g q1 q2` for different ones, `-m cos q` for
    /// angles.
    pub(super) fn energy_of_coordinates(&mut self, coordinate: Coordinate, free: &[Coordinate]) -> Expr {
        let energy = Unit::NewtonMetre;
        let other = free[self.source.random.below(free.len())];
        let ([unit, ..], [other_unit, ..]) = (self.units(coordinate), self.units(other));
        let (q, p) = (Expr::Coordinate(coordinate), Expr::Coordinate(other));
        let stiffness = self.source.positive((5.0, 80.0), energy, &[unit; 2]);
        let half =
            |stretch: Expr, k: Expr| Expr::Product(vec![Expr::number(0.5), k, Expr::Power(Box::new(stretch), 2)]);
        if unit == other_unit && other != coordinate && self.source.random.chance(0.6) {
            return half(q.minus(p), stiffness);
        }
        let mut terms = vec![half(q.clone(), stiffness)];
        if other != coordinate {
            terms.push(self.term((0.5, 5.0), energy, vec![(q.clone(), unit), (p, other_unit)]));
        }
        if unit == Unit::Radian {
            let wave = Expr::Cosine(Box::new(q.times(2.0)));
            terms.push(self.term((0.5, 5.0), energy, vec![(wave, Unit::Radian)]));
        }
        if self.source.random.chance(0.3) {
            let curve = self.source.curve((1.0, unit), Expr::Coordinate(coordinate));
            terms.push(self.term((0.5, 5.0), energy, vec![(curve, Unit::Radian)]));
        }
        Expr::Sum(terms)
    }

    /// `k distance(P, Q)`, or `1/2 k (distance(P, Q) - L)^2`.
    pub(super) fn energy_of_distance(&mut self, from: usize, to: usize) -> Expr {
        let distance = Expr::Distance(from, to);
        let (metre, energy) = (Unit::Metre, Unit::NewtonMetre);
        if self.source.random.chance(0.5) {
            return self.term((5.0, 30.0), energy, vec![(distance, metre)]);
        }
        let length = Expr::Value(self.source.between(0.1, 0.8, metre), metre);
        let stretch = Expr::Power(Box::new(distance.minus(length)), 2);
        let stiffness = self.source.positive((10.0, 100.0), energy, &[metre; 2]);
        Expr::Product(vec![Expr::number(0.5), stiffness, stretch])
    }

    /// `m g position(P).axis`, or `1/2 k position(P).axis^2` where a tie to the ground is allowed as well.
    pub(super) fn energy_of_position(&mut self, point: usize, axis: usize, bound: bool) -> Expr {
        let height = Expr::Position(point, axis);
        let (metre, energy) = (Unit::Metre, Unit::NewtonMetre);
        let weight = self.term((1.0, 10.0), energy, vec![(height.clone(), metre)]);
        if !bound {
            return weight;
        }
        let stiffness = self.source.positive((5.0, 50.0), energy, &[metre; 2]);
        let square = Expr::Power(Box::new(height), 2);
        let spring = Expr::Product(vec![Expr::number(0.5), stiffness, square]);
        Expr::Sum(vec![weight, spring])
    }
}
