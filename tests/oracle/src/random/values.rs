//! Random values, some of them multiples of shared design variables.

use super::Random;
use crate::model::{DesignVariable, Placement, Unit, Value, Values};

/// At most this many design variables.
const MOST: usize = 8;

pub(super) struct Source {
    pub(super) random: Random,
    pub(super) design: Vec<DesignVariable>,
}

impl Source {
    /// A value equal to `number`: a number, a multiple of a design variable that exists already, or a new one.
    pub(super) fn value(&mut self, number: f64, unit: Unit) -> Value {
        if number == 0.0 {
            return Value::Number(0.0);
        }
        let first = self.design.is_empty();
        if !first && self.random.chance(0.45) {
            return Value::Number(number);
        }
        let fitting: Vec<usize> = (0..self.design.len())
            .filter(|&k| self.design[k].unit == unit)
            .collect();
        let full = self.design.len() == MOST;
        if !fitting.is_empty() && (full || self.random.chance(0.8)) {
            let variable = fitting[self.random.below(fitting.len())];
            return Value::Design {
                variable,
                factor: number / self.design[variable].nominal,
            };
        }
        // A small one would need large factors elsewhere.
        if full || number.abs() < 0.1 || !(first || self.random.chance(0.3)) {
            return Value::Number(number);
        }
        // Positive, so that it can be a mass or a length elsewhere.
        let name = format!("b{}", self.design.len());
        self.design.push(DesignVariable {
            name,
            unit,
            nominal: number.abs(),
        });
        Value::Design {
            variable: self.design.len() - 1,
            factor: number.signum(),
        }
    }

    /// A value in an interval.
    pub(super) fn between(&mut self, low: f64, high: f64, unit: Unit) -> Value {
        let number = self.random.between(low, high);
        self.value(number, unit)
    }

    /// A position; now and then with a component of zero.
    pub(super) fn position(&mut self, limit: f64) -> Values {
        std::array::from_fn(|_| {
            let zero = self.random.chance(0.3);
            let number = self.random.between(-limit, limit);
            self.value(if zero { 0.0 } else { number }, Unit::Metre)
        })
    }

    /// An axis: one of the frame's, or any vector but not a unit one.
    pub(super) fn axis(&mut self) -> [f64; 3] {
        let mut axis = [0.0; 3];
        if self.random.chance(0.4) {
            axis[self.random.below(3)] = if self.random.chance(0.5) { 1.0 } else { -1.0 };
            return axis;
        }
        while axis
            .iter()
            .map(|component| component * component)
            .sum::<f64>()
            < 0.1
        {
            axis = self.random.vector(2.0);
        }
        axis
    }

    /// A placement; now and then none.
    pub(super) fn placement(&mut self) -> Placement {
        if self.random.chance(0.25) {
            return Placement::NONE;
        }
        let offset = self.position(0.6);
        let rotations = self.random.below(3);
        let rotations =
            (0..rotations).map(|_| (self.axis(), self.between(-2.0, 2.0, Unit::Radian)));
        Placement {
            offset,
            rotations: rotations.collect(),
        }
    }
}
