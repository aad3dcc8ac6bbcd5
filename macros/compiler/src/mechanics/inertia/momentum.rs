//! Momenta of bodies with everything they carry, along any motion.

use crate::algebra::{ExprId, Graph, Vector3};
use crate::mechanics::motion::{BodyMotion, Kinematics};
use crate::mechanics::setup::Context;
use crate::model::mechanism::Frame;

use super::augmented::AugmentedBody;
use super::composite::{Composites, add_products, add_symmetric, spun};

/// Rates of the mass distribution about a body's origin, in the axes of the body's motion.
#[derive(Clone, Copy)]
pub(crate) struct Momentum {
    pub(crate) linear: Vector3,
    pub(crate) angular: Vector3,
    pub(crate) second: [[ExprId; 3]; 3],
}

impl Momentum {
    fn of_body(g: &mut Graph, body: &AugmentedBody, motion: &BodyMotion) -> Self {
        let omega = motion.frame.angular_velocity;
        let columns = body.second.map(|column| omega.cross(g, Vector3(column)));
        let mut second = [[g.zero(); 3]; 3];
        add_symmetric(g, &mut second, |g, i, j| g.add(columns[j].0[i], columns[i].0[j]));
        let twice = g.scale(2.0, body.isotropic);
        let isotropic = omega.scale(g, twice);
        Self { linear: omega.cross(g, body.first), angular: spun(g, body.second, omega).add(g, isotropic), second }
    }

    fn add(&mut self, g: &mut Graph, other: &Self) {
        self.linear = self.linear.add(g, other.linear);
        self.angular = self.angular.add(g, other.angular);
        add_symmetric(g, &mut self.second, |_, i, j| other.second[i][j]);
    }

    /// Names the entries, for readable code.
    fn set_names(&self, g: &mut Graph, body: &str) {
        self.linear.set_name(g, &format!("{body}_momentum"));
        self.angular.set_name(g, &format!("{body}_angular_momentum"));
        for (row, i) in self.second.into_iter().zip(["x", "y", "z"]) {
            for (entry, j) in row.into_iter().zip(["x", "y", "z"]) {
                g.set_name(entry, || format!("{body}_second_moment_rate_{i}{j}"));
            }
        }
    }

    /// The momentum about the parent's origin, in the axes of the parent's motion. The body's origin moves away from
    /// the parent's at `rate`, and the first moment and the mass move along with it.
    fn moved_to_parent(
        &self,
        g: &mut Graph,
        motion: &BodyMotion,
        rate: Vector3,
        (first, mass): (Vector3, ExprId),
    ) -> Self {
        let (mut moved, mut first) = (*self, first);
        if let Some(rotation) = motion.to_parent {
            moved.linear = rotation.apply(g, self.linear);
            moved.angular = rotation.apply(g, self.angular);
            moved.second = rotation.turn_symmetric(g, self.second);
            first = rotation.apply(g, first);
        }
        let offset = motion.frame.offset;
        let share = offset.scale(g, mass);
        let first = first.add(g, share);
        add_products(g, &mut moved.second, offset, moved.linear);
        add_products(g, &mut moved.second, rate, first);
        let orbital = offset.cross(g, moved.linear);
        let growing = first.cross(g, rate);
        moved.angular = moved.angular.add(g, orbital).add(g, growing);
        let push = rate.scale(g, mass);
        moved.linear = moved.linear.add(g, push);
        moved
    }
}

/// Velocity of each body's origin relative to its parent's, in the axes of the parent's motion, by body id.
pub(crate) fn rates(g: &mut Graph, context: &Context, kinematics: &Kinematics) -> Vec<Vector3> {
    let zero = Vector3::zero(g);
    let mut rates = vec![zero; context.mechanism.bodies.len()];
    for branch in &context.topology.branches {
        let motion = kinematics.of(branch.body);
        let mut rate = kinematics.frame(branch.parent).angular_velocity.cross(g, motion.frame.offset);
        for step in &motion.steps {
            let speed = kinematics.coordinates[step.coordinate.index()].velocity;
            let leaving = step.velocity(g, zero).scale(g, speed);
            let leaving = match motion.to_parent {
                Some(rotation) => rotation.apply(g, leaving),
                None => leaving,
            };
            rate = rate.add(g, leaving);
        }
        rates[branch.body.index()] = rate;
    }
    rates
}

/// Momentum of each body with everything it carries, by body id. `spinning` is the angular momentum of material that
/// spins beside a body.
pub(crate) fn momenta(
    g: &mut Graph,
    context: &Context,
    kinematics: &Kinematics,
    bodies: &[AugmentedBody],
    composites: &Composites,
    (rates, spinning): (&[Vector3], &[Vector3]),
) -> Vec<Momentum> {
    let zero = Vector3::zero(g);
    let spinning = spinning.iter();
    let mut momenta: Vec<_> =
        spinning.map(|&angular| Momentum { linear: zero, angular, second: [zero.0; 3] }).collect();
    for branch in context.topology.branches.iter().rev() {
        let index = branch.body.index();
        let motion = kinematics.of(branch.body);
        let momentum = Momentum::of_body(g, &bodies[index], motion);
        momenta[index].add(g, &momentum);
        momenta[index].set_names(g, &context.mechanism.bodies[index].name.to_string());
        if let Frame::Body(parent) = branch.parent {
            let along = (composites.whole[index].first, composites.apart[index]);
            let moved = momenta[index].moved_to_parent(g, motion, rates[index], along);
            momenta[parent.index()].add(g, &moved);
        }
    }
    momenta
}
