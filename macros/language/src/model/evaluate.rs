//! Numerical values of expressions at given inputs and design variables.

use rustc_hash::{FxHashMap, FxHashSet};

use super::expression::{Expr, Vector};
use super::mechanism::{Constant, Mechanism};

/// Values of inputs, design variables and named constants.
#[derive(Clone, Debug)]
pub struct Values<'a> {
    inputs: &'a [f64],
    design: &'a [f64],
    constants: Vec<f64>,
    /// Constants that are computed where an expression needs them.
    pending: &'a [Constant],
}

impl<'a> Values<'a> {
    /// Computes the named constants from inputs and design variables, all SI.
    pub fn new(constants: &[Constant], inputs: &'a [f64], design: &'a [f64]) -> Self {
        let mut values = Self { inputs, design, constants: Vec::with_capacity(constants.len()), pending: &[] };
        for constant in constants {
            let value = values.of(&constant.value);
            values.constants.push(value);
        }
        values
    }

    /// The same for a single expression: the constants that it needs are computed with it.
    pub fn needed(constants: &'a [Constant], inputs: &'a [f64], design: &'a [f64]) -> Self {
        Self { inputs, design, constants: Vec::new(), pending: constants }
    }

    /// The value of an expression; NaN if it depends on the motion or leaves the domain of a function.
    pub fn of(&self, expr: &Expr) -> f64 {
        self.shared(expr, &mut FxHashMap::default())
    }

    /// Computes repeated parts only once: `done` holds them by address.
    fn shared(&self, expr: &Expr, done: &mut FxHashMap<*const Expr, f64>) -> f64 {
        let address = std::ptr::from_ref(expr);
        if let Some(&value) = done.get(&address) {
            return value;
        }
        let known = |table: &[f64], index: usize| table.get(index).copied().unwrap_or(f64::NAN);
        let mut part = |part: &Expr| self.shared(part, done);
        let value = match expr {
            Expr::Number(value) => *value,
            Expr::Design(id) => known(self.design, id.index()),
            Expr::Input(id) => known(self.inputs, id.index()),
            Expr::Constant(id) => match self.pending.get(id.index()) {
                Some(constant) => part(&constant.value),
                None => known(&self.constants, id.index()),
            },
            Expr::Coordinate(_)
            | Expr::Rate(_)
            | Expr::Position(..)
            | Expr::Length
            | Expr::LengthRate
            | Expr::Reaction(..)
            | Expr::ConstraintReaction(..)
            | Expr::Exerted(..)
            | Expr::Bent(..)
            | Expr::KineticEnergy
            | Expr::PotentialEnergy => f64::NAN,
            Expr::Negate(a) => -part(a),
            Expr::Add(a, b) => part(a) + part(b),
            Expr::Subtract(a, b) => part(a) - part(b),
            Expr::Multiply(a, b) => part(a) * part(b),
            Expr::Divide(a, b) => part(a) / part(b),
            Expr::PowerInteger(a, n) => part(a).powi(*n),
            Expr::Power(a, b) => part(a).powf(part(b)),
            Expr::Call(function, a) => function.apply(part(a)),
            Expr::Atan2(y, x) => part(y).atan2(part(x)),
        };
        done.insert(address, value);
        value
    }
}

impl Values<'_> {
    /// The components of a vector.
    pub fn vector(&self, vector: &Vector) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.of(&vector[axis]))
    }
}

/// The value of one expression of a mechanism at inputs `u` and design variables `b`, SI.
pub fn evaluate(mechanism: &Mechanism, expr: &Expr, u: &[f64], b: &[f64]) -> f64 {
    Values::needed(&mechanism.constants, u, b).of(expr)
}

/// A set of inputs or constants, used to find the expressions that depend on them.
#[derive(Clone, Debug)]
pub struct Dependence {
    on_inputs: bool,
    constants: Vec<bool>,
}

impl Dependence {
    /// Dependence on an input, directly or through a constant.
    pub fn on_inputs(constants: &[Constant]) -> Self {
        let mut dependence = Self { on_inputs: true, constants: Vec::new() };
        for constant in constants {
            let depends = dependence.of(&constant.value);
            dependence.constants.push(depends);
        }
        dependence
    }

    /// Dependence on a constant whose value is not finite.
    pub fn on_constants_without_value(values: &Values) -> Self {
        Self { on_inputs: false, constants: values.constants.iter().map(|c| !c.is_finite()).collect() }
    }

    /// Whether the expression depends on one of them.
    pub fn of(&self, expr: &Expr) -> bool {
        self.shared(expr, &mut FxHashSet::default())
    }

    /// `visited` holds the parts already found independent, by address.
    fn shared(&self, expr: &Expr, visited: &mut FxHashSet<*const Expr>) -> bool {
        if !visited.insert(std::ptr::from_ref(expr)) {
            return false;
        }
        match expr {
            Expr::Input(_) => self.on_inputs,
            Expr::Constant(id) => self.constants.get(id.index()).copied().unwrap_or(false),
            Expr::Negate(a) | Expr::PowerInteger(a, _) | Expr::Call(_, a) => self.shared(a, visited),
            Expr::Add(a, b)
            | Expr::Subtract(a, b)
            | Expr::Multiply(a, b)
            | Expr::Divide(a, b)
            | Expr::Power(a, b)
            | Expr::Atan2(a, b) => self.shared(a, visited) || self.shared(b, visited),
            _ => false,
        }
    }
}
