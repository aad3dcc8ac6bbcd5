//! Mass distributions of the shapes, in the form that makes the equations of motion cheapest.
//!
//! A body's inertia force and moment need only the integrals of `rho` and `rho rho^T` over its mass, where `rho` is the
//! position from the body's origin. They are written in terms of a few body-fixed vectors, the arms `d_k`:
//!
//! - `integral rho dm = sum_k first_k d_k`,
//! - `integral rho rho^T dm = isotropic 1 + sum_kj second_kj d_k d_j^T`.
//!
//! A bar needs one arm, a disk one arm and the isotropic part, an inertia tensor at most three arms besides its centre
//! of mass; an offset, or a tensor about another point, takes one arm more.

use crate::algebra::{ExprId, Graph, Vector3};
use crate::base::ids::BodyId;
use crate::census::taken;
use crate::mechanics::setup::{Context, MassDistribution, Values};
use crate::model::expression::Vector;
use crate::model::mechanism::{Body, Placement, Shape};
use crate::model::shape::{MeanSquare, Reduced, Spread};

impl MassDistribution {
    /// The pieces of a body and, while excitations are derived, its deviations.
    pub(crate) fn of(g: &mut Graph, context: &Context, id: BodyId) -> Vec<Self> {
        let body = &context.mechanism.bodies[id.index()];
        let mut pieces = Self::of_body(g, context.values, body);
        let deviations = context.excited.deviations.iter();
        pieces.extend(deviations.filter(|(body, _)| *body == id).map(|(_, deviation)| deviation.clone()));
        pieces
    }

    /// The pieces of a body, each about the body's origin; holes count negative.
    pub(crate) fn of_body(g: &mut Graph, values: &Values, body: &Body) -> Vec<Self> {
        let several = body.parts.len() > 1;
        body.parts
            .iter()
            .enumerate()
            .map(|(index, part)| {
                let mut piece = Self::of_shape(g, values, &part.shape);
                if part.hole {
                    piece = piece.negated(g);
                }
                piece = piece.placed(g, values, &part.placement);
                let name = body.name.to_string();
                piece.set_names(g, &if several { format!("{name}_part{index}") } else { name });
                piece
            })
            .collect()
    }

    /// The mass distribution of a shape about the origin of its frame.
    fn of_shape(g: &mut Graph, values: &Values, shape: &Shape) -> Self {
        let Reduced { mass, center, spread, .. } = shape.reduced();
        let mass = values.scalar(g, mass);
        match spread {
            Spread::Point => Self::point(g, values, mass, center),
            Spread::Line { length, along } => {
                let length = values.scalar(g, length);
                let along = values.vector(g, along);
                Self::line(g, values, mass, length, along, center)
            }
            Spread::Round { axis, across, along } => {
                let across = second_moment(g, values, mass, &across);
                let along = second_moment(g, values, mass, &along);
                let excess = g.sub(along, across);
                let axis = values.vector(g, axis);
                Self::point(g, values, mass, center).with(g, across, &[(axis, excess)])
            }
            Spread::Box { size } => {
                let second = values.vector(g, size).0.map(|edge| quadratic(g, 1.0 / 12.0, mass, edge));
                let zero = g.zero();
                Self::point(g, values, mass, center).with_tensor(g, second, [zero; 3])
            }
            Spread::Ball(along) => {
                let isotropic = second_moment(g, values, mass, &along);
                Self::point(g, values, mass, center).with(g, isotropic, &[])
            }
            Spread::Tensor { inertia, about } => {
                let [xx, yy, zz, xy, yz, xz] = std::array::from_fn(|i| values.scalar(g, &inertia[i]));
                let sum = g.sum([xx, yy, zz]);
                let half_trace = g.scale(0.5, sum);
                let diagonal = [xx, yy, zz].map(|j| g.sub(half_trace, j));
                let products = [xy, yz, xz].map(|j| g.neg(j));
                let mut body = Self::point(g, values, mass, center);
                if let Some(about) = about {
                    // The given tensor includes the mass at its distance from the point; subtract that part.
                    let (center, about) = (values.vector(g, center), values.vector(g, about));
                    let distance = center.sub(g, about);
                    let (zero, minus) = (g.zero(), g.neg(mass));
                    body = body.with(g, zero, &[(distance, minus)]);
                }
                body.with_tensor(g, diagonal, products)
            }
        }
    }

    /// The negative of a mass distribution, for a hole.
    fn negated(mut self, g: &mut Graph) -> Self {
        self.mass = g.neg(self.mass);
        self.isotropic = g.neg(self.isotropic);
        for arm in &mut self.arms {
            arm.first = g.neg(arm.first);
            for second in &mut arm.second {
                *second = g.neg(*second);
            }
        }
        self
    }

    /// The distribution seen from a frame in which its own frame is placed: the arms turn, and the offset `o` adds one
    /// arm, because `rho = o + R rho'`.
    pub(crate) fn placed(mut self, g: &mut Graph, values: &Values, placement: &Placement) -> Self {
        let (offset, rotation) = values.placement(g, placement);
        if let Some(rotation) = rotation {
            for arm in &mut self.arms {
                arm.direction = rotation.apply(g, arm.direction);
            }
        }
        if !offset.is_zero(g) {
            let firsts: Vec<ExprId> = self.arms.iter().map(|arm| arm.first).collect();
            self.add_arm(g, offset, self.mass, self.mass);
            let last = self.arms.len() - 1;
            for (k, first) in firsts.into_iter().enumerate() {
                self.arms[k].second[last] = first;
                self.arms[last].second[k] = first;
            }
        }
        self
    }

    /// Names the moments, for readable code.
    fn set_names(&self, g: &mut Graph, body: &str) {
        g.set_name(self.mass, || format!("{body}_mass"));
        g.set_name(self.isotropic, || format!("{body}_isotropic_moment"));
        for arm in &self.arms {
            g.set_name(arm.first, || format!("{body}_first_moment"));
            for &second in &arm.second {
                g.set_name(second, || format!("{body}_second_moment"));
            }
        }
    }

    fn point(g: &mut Graph, values: &Values, mass: ExprId, center: &Vector) -> Self {
        let center = values.vector(g, center);
        let isotropic = g.zero();
        let mut body = Self { mass, isotropic, arms: Vec::new() };
        body.add_arm(g, center, mass, mass);
        body
    }

    /// A bar. If it starts at the origin, it needs one arm for all moments.
    fn line(g: &mut Graph, values: &Values, mass: ExprId, length: ExprId, along: Vector3, center: &Vector) -> Self {
        let half_length = g.scale(0.5, length);
        let natural_center = along.scale(g, half_length);
        if values.vector(g, center) != natural_center {
            let second = quadratic(g, 1.0 / 12.0, mass, length);
            let zero = g.zero();
            return Self::point(g, values, mass, center).with(g, zero, &[(along, second)]);
        }
        taken(|| "inertia: bar from its origin".into());
        let first = g.mul(mass, half_length);
        let moment = g.mul(first, length);
        let second = g.scale(2.0 / 3.0, moment);
        let isotropic = g.zero();
        let mut body = Self { mass, isotropic, arms: Vec::new() };
        body.add_arm(g, along, first, second);
        body
    }

    /// Adds an isotropic second moment and second moments along single directions.
    fn with(mut self, g: &mut Graph, isotropic: ExprId, along: &[(Vector3, ExprId)]) -> Self {
        self.isotropic = g.add(self.isotropic, isotropic);
        let zero = g.zero();
        for &(direction, second) in along {
            self.add_arm(g, direction, zero, second);
        }
        self
    }

    /// Adds a second-moment tensor in body axes; `products` are xy, yz, xz. Without products, one diagonal entry moves
    /// into the isotropic part, chosen to leave the fewest arms.
    fn with_tensor(self, g: &mut Graph, diagonal: [ExprId; 3], products: [ExprId; 3]) -> Self {
        let zero = g.zero();
        let unit: [Vector3; 3] = crate::algebra::Matrix3::identity(g).0;
        if products.iter().all(|&p| p == zero) {
            let equal = |k: usize| diagonal.iter().filter(|&&d| d == diagonal[k]).count();
            let pivot = (0..3).rev().max_by_key(|&k| equal(k)).unwrap_or(0);
            let isotropic = diagonal[pivot];
            taken(|| format!("inertia: {} equal second moments", equal(pivot)));
            let rest: Vec<(Vector3, ExprId)> = (0..3)
                .filter(|&k| diagonal[k] != isotropic)
                .map(|k| (unit[k], g.sub(diagonal[k], isotropic)))
                .collect();
            return self.with(g, isotropic, &rest);
        }
        let [xy, yz, xz] = products;
        let tensor = [[diagonal[0], xy, xz], [xy, diagonal[1], yz], [xz, yz, diagonal[2]]];
        let mut body = self;
        let start = body.arms.len();
        for direction in unit {
            body.add_arm(g, direction, zero, zero);
        }
        for (i, row) in tensor.into_iter().enumerate() {
            for (j, entry) in row.into_iter().enumerate() {
                body.arms[start + i].second[start + j] = entry;
            }
        }
        body
    }
}

/// The sum of `factor mass length^2`.
fn second_moment(g: &mut Graph, values: &Values, mass: ExprId, terms: &MeanSquare) -> ExprId {
    let mut sum = g.zero();
    for &(factor, length) in terms {
        let length = values.scalar(g, length);
        let term = quadratic(g, factor, mass, length);
        sum = g.add(sum, term);
    }
    sum
}

/// `factor mass length^2`.
fn quadratic(g: &mut Graph, factor: f64, mass: ExprId, length: ExprId) -> ExprId {
    let square = g.mul(length, length);
    let moment = g.mul(mass, square);
    g.scale(factor, moment)
}
