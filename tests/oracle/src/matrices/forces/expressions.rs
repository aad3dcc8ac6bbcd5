//! Expressions of the motion, and forces derived from a potential energy.

use num_dual::Dual;

use super::{Efforts, Moving, value};
use crate::matrices::scalar::still;
use crate::matrices::space::Vector;
use crate::matrices::{Oracle, Scalar};
use crate::model::{Coordinate, Expr};

/// The quantities that appear in an expression.
struct Leaves<'a, D> {
    coordinate: &'a dyn Fn(Coordinate) -> D,
    rate: &'a dyn Fn(Coordinate) -> D,
    /// Position of a point along the axes of the ground.
    position: &'a dyn Fn(usize) -> Vector<D>,
    length: [D; 2],
    inputs: &'a [D],
    design: &'a [D],
}

impl<D: Scalar> Leaves<'_, D> {
    fn of(&self, expr: &Expr) -> D {
        match expr {
            Expr::Value(number, _) => value(*number, self.design),
            Expr::Input(input) => self.inputs[*input],
            Expr::Coordinate(coordinate) => (self.coordinate)(*coordinate),
            Expr::Rate(coordinate) => (self.rate)(*coordinate),
            Expr::Position(point, component) => (self.position)(*point).0[*component],
            Expr::Distance(from, to) => {
                let span = (self.position)(*to) - (self.position)(*from);
                span.dot(span).sqrt()
            }
            Expr::Length => self.length[0],
            Expr::LengthRate => self.length[1],
            Expr::Sum(parts) => parts.iter().map(|part| self.of(part)).sum(),
            Expr::Product(parts) => parts.iter().fold(D::one(), |product, part| product * self.of(part)),
            Expr::Power(base, exponent) => self.of(base).powi(*exponent),
            Expr::Sine(angle) => self.of(angle).sin(),
            Expr::Cosine(angle) => self.of(angle).cos(),
            Expr::Curve(curve, argument) => curve.at(self.of(argument)),
        }
    }
}

impl Oracle<'_> {
    /// An expression of coordinates, rates and points.
    pub(super) fn of_motion<D: Scalar>(&self, moving: &Moving<D>, expr: &Expr) -> D {
        self.of_length(moving, expr, D::zero(), D::zero())
    }

    /// An expression that may also contain the length of a tension and its rate.
    pub(super) fn of_length<D: Scalar>(&self, moving: &Moving<D>, expr: &Expr, length: D, rate: D) -> D {
        let leaves = Leaves {
            coordinate: &|q| self.position(moving, q),
            rate: &|q| self.speed(moving, q),
            position: &|point| self.ground_position(moving, point),
            length: [length, rate],
            inputs: &moving.state.inputs,
            design: &moving.state.design,
        };
        leaves.of(expr)
    }

    fn ground_position<D: Scalar>(&self, moving: &Moving<D>, point: usize) -> Vector<D> {
        let position = self.point(moving, point).origin.now();
        moving.at.ground.inverse().point(position)
    }

    /// `-dV/dp` on each point and `-dV/dq` along each coordinate in the energy.
    pub(super) fn potential<D: Scalar>(&self, efforts: &mut Efforts<D>, moving: &Moving<D>, energy: &Expr) {
        let (mut coordinates, mut points) = (Vec::new(), Vec::new());
        energy.leaves(&mut |leaf| match leaf {
            Expr::Coordinate(coordinate) => coordinates.push(*coordinate),
            Expr::Position(point, _) => points.push(*point),
            Expr::Distance(from, to) => points.extend([*from, *to]),
            _ => {}
        });
        coordinates.sort_unstable();
        coordinates.dedup();
        points.sort_unstable();
        points.dedup();

        let slope = |seed: Seed| self.slope(moving, energy, seed);
        for coordinate in coordinates {
            self.act(efforts, coordinate, -slope(Seed::Coordinate(coordinate)));
        }
        for point in points {
            let component = |axis| -slope(Seed::Position(point, axis));
            let force = self.in_ground(Vector(std::array::from_fn(component)));
            let place = self.point(moving, point).origin.now();
            efforts.push(self.frame_of(point), force, place);
        }
    }

    /// Partial derivative of an energy with respect to one leaf.
    fn slope<D: Scalar>(&self, moving: &Moving<D>, energy: &Expr, seed: Seed) -> D {
        let seeded = |x: D, hit: bool| Dual::new(x, if hit { D::one() } else { D::zero() });
        let zero = seeded(D::zero(), false);
        let leaves = Leaves {
            coordinate: &|q| seeded(self.position(moving, q), seed == Seed::Coordinate(q)),
            rate: &|_| zero,
            position: &|point| {
                let at = self.ground_position(moving, point).0;
                Vector(std::array::from_fn(|axis| seeded(at[axis], seed == Seed::Position(point, axis))))
            },
            length: [zero; 2],
            inputs: &still(&moving.state.inputs),
            design: &still(&moving.state.design),
        };
        leaves.of(energy).eps
    }
}

/// A leaf to differentiate with respect to.
#[derive(Clone, Copy, PartialEq)]
enum Seed {
    Coordinate(Coordinate),
    Position(usize, usize),
}
