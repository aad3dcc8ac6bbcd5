//! How inertia and weight along every coordinate change with positions and velocities, along any motion.
//!
//! Let all that a body carries keep its motion relative to the body. A change of the body's motion, of its angular velocity by
//! `spin`, of its angular acceleration by `growth - omega x spin`, of the acceleration of its origin by `acceleration`,
//! changes the acceleration of a particle at `r` by `acceleration + growth x r + 2 spin x dr/dt`. It takes
//!
//! - `force = m acceleration + growth x h + 2 spin x P`,
//! - `moment = h x acceleration + I growth + (tr D 1 - D) spin + spin x L`,
//!
//! with mass `m`, first moment `h`, inertia `I`, and as rates of a frame that moves with the origin without turning: linear and
//! angular momentum `P` and `L`, rate `D` of the second moment. Seen from the next body outwards, `spin` and `growth` are the
//! same and `acceleration` is more by `growth x d + 2 spin x dd/dt`, `d` from origin to origin. Every joint is thus a change
//! of the motion of what it carries, and every coordinate behind it asks with one covector: one walk towards the ground for each.

use crate::algebra::{Graph, Vector3};
use crate::base::ids::ExprId;
use crate::model::mechanism::Frame;

use super::augmented::{AugmentedBody, augmented_bodies};
use super::composite::{Composite, Composites, accelerating, add_products, add_symmetric, spun};
use super::forces::Wrench;
use super::inertial::Inertial;
use super::kinematics::{BodyMotion, Kinematics};
use super::path::Tree;
use super::problem::Problem;
use super::sources::Sources;
use super::step_axis::StepAxis;

/// Derivatives of inertia less weight along the unknowns, by columns.
pub(super) struct Variation {
    pub(super) by_position: Vec<Vec<ExprId>>,
    pub(super) by_velocity: Vec<Vec<ExprId>>,
}

/// A change of the motion of a body, or what multiplies each of its parts.
#[derive(Clone, Copy)]
struct Change {
    spin: Vector3,
    growth: Vector3,
    acceleration: Vector3,
}

impl Change {
    fn dot(&self, g: &mut Graph, other: &Self) -> ExprId {
        let spin = self.spin.dot(g, other.spin);
        let growth = self.growth.dot(g, other.growth);
        let acceleration = self.acceleration.dot(g, other.acceleration);
        g.sum([spin, growth, acceleration])
    }
}

/// The axis and the velocity of the body's origin, per unit rate.
struct Twist {
    axis: Vector3,
    velocity: Vector3,
}

impl Twist {
    fn of(g: &mut Graph, step: &StepAxis) -> Self {
        let zero = Vector3::zero(g);
        Self {
            axis: step.turn.unwrap_or(zero),
            velocity: step.velocity(g, zero),
        }
    }

    /// How the body moves otherwise, seen in its axes, where the joint stands further on.
    fn by_position(&self, g: &mut Graph, motion: &BodyMotion) -> Change {
        let frame = &motion.frame;
        let turned = frame.acceleration.cross(g, self.axis);
        let moved = frame.second_rate.apply(g, self.velocity);
        Change {
            spin: frame.angular_velocity.cross(g, self.axis),
            growth: frame.second_rate.apply(g, self.axis),
            acceleration: turned.add(g, moved),
        }
    }

    /// The same where the joint moves faster.
    fn by_velocity(&self, g: &mut Graph, motion: &BodyMotion) -> Change {
        let omega = motion.frame.angular_velocity;
        let two = g.constant(2.0);
        Change {
            spin: self.axis,
            growth: omega.cross(g, self.axis).scale(g, two),
            acceleration: omega.cross(g, self.velocity).scale(g, two),
        }
    }

    /// A wrench that moves with the body, by position, seen from before the joint.
    fn carry(&self, g: &mut Graph, wrench: &Wrench) -> Wrench {
        let turned = self.axis.cross(g, wrench.moment);
        let moved = self.velocity.cross(g, wrench.force);
        Wrench {
            force: self.axis.cross(g, wrench.force),
            moment: turned.add(g, moved),
        }
    }
}

/// Rates of the mass distribution about a body's origin, as the body's motion is written.
#[derive(Clone, Copy)]
struct Momentum {
    linear: Vector3,
    angular: Vector3,
    second: [[ExprId; 3]; 3],
}

impl Momentum {
    fn of_body(g: &mut Graph, body: &AugmentedBody, motion: &BodyMotion) -> Self {
        let omega = motion.frame.angular_velocity;
        let columns = body.second.map(|column| omega.cross(g, Vector3(column)));
        let mut second = [[g.zero(); 3]; 3];
        add_symmetric(g, &mut second, |g, i, j| {
            g.add(columns[j].0[i], columns[i].0[j])
        });
        let twice = g.scale(2.0, body.isotropic);
        let isotropic = omega.scale(g, twice);
        Self {
            linear: omega.cross(g, body.first),
            angular: spun(g, body.second, omega).add(g, isotropic),
            second,
        }
    }

    fn add(&mut self, g: &mut Graph, other: &Self) {
        self.linear = self.linear.add(g, other.linear);
        self.angular = self.angular.add(g, other.angular);
        add_symmetric(g, &mut self.second, |_, i, j| other.second[i][j]);
    }

    /// As the parent's motion is written, about the parent's origin, which the body's leaves at `rate`; with the first moment
    /// and the mass that move along.
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

/// A body with all it carries, its joints held to their motion.
struct Carried {
    mass: Composite,
    momentum: Momentum,
}

impl Carried {
    /// The wrench that a change of the body's motion takes.
    fn wrench(&self, g: &mut Graph, change: &Change) -> Wrench {
        let Composite {
            mass,
            first,
            second,
        } = self.mass;
        let two = g.constant(2.0);
        let pushed = change.acceleration.scale(g, mass);
        let growing = change.growth.cross(g, first);
        let spinning = change.spin.cross(g, self.momentum.linear).scale(g, two);
        let force = pushed.add(g, growing).add(g, spinning);
        let pushed = first.cross(g, change.acceleration);
        let growing = spun(g, second, change.growth);
        let spreading = spun(g, self.momentum.second, change.spin);
        let spinning = change.spin.cross(g, self.momentum.angular);
        let moment = pushed.add(g, growing).add(g, spreading).add(g, spinning);
        Wrench { force, moment }
    }

    /// What the load along a twist asks of the spin.
    fn asks_of_spin(&self, g: &mut Graph, twist: &Twist) -> Vector3 {
        let two = g.constant(2.0);
        let pushed = self.momentum.linear.cross(g, twist.velocity);
        let pushed = pushed.scale(g, two);
        let spreading = spun(g, self.momentum.second, twist.axis);
        let turning = self.momentum.angular.cross(g, twist.axis);
        pushed.add(g, spreading).add(g, turning)
    }
}

/// Whether every body is written along its own axes and hangs on a joint of one motion, as far as it moves freely.
fn applies(problem: &Problem, kinematics: &Kinematics) -> bool {
    let topology = problem.topology;
    topology.coasting.is_empty()
        && topology.branches.iter().all(|branch| {
            let steps = &kinematics.of(branch.body).steps;
            let free = steps
                .iter()
                .any(|step| topology.free.contains(&step.coordinate));
            let layout = problem.runs.layout.of(branch.body);
            layout.own_axes && (steps.len() == 1 || !free)
        })
}

/// Derivatives of inertia less weight along the unknowns; nothing for mechanisms that are written otherwise than along the axes of
/// each body. `kinematics` is that of the layout of runs with the ground accelerated against gravity, `inertial` what it gives.
pub(super) fn variation(
    g: &mut Graph,
    problem: &Problem,
    kinematics: &Kinematics,
    inertial: &Inertial,
) -> Option<Variation> {
    if !applies(problem, kinematics) {
        return None;
    }
    let topology = problem.topology;
    let bodies = augmented_bodies(g, problem, kinematics, Sources::ALL);
    let composites = Composites::new(g, problem, kinematics, &bodies);
    let rates = rates(g, problem, kinematics);
    let momenta = momenta(g, problem, kinematics, &bodies, &composites, &rates);
    let unknown = |step: &StepAxis| topology.free.iter().position(|&id| id == step.coordinate);

    let n = problem.symbols.q.ids.len();
    let mut this = Variation {
        by_position: vec![vec![g.zero(); n]; n],
        by_velocity: vec![vec![g.zero(); n]; n],
    };
    let tree = Tree::new(problem.mechanism, topology);
    for branch in &topology.branches {
        let index = branch.body.index();
        let motion = kinematics.of(branch.body);
        let [step] = &motion.steps[..] else { continue };
        let Some(k) = unknown(step) else { continue };
        let carried = Carried {
            mass: composites.whole[index],
            momentum: momenta[index],
        };
        let twist = Twist::of(g, step);
        let load = accelerating(
            g,
            step,
            &bodies[index],
            &motion.frame,
            &composites.carried[index],
        );
        let mut asks = Change {
            spin: carried.asks_of_spin(g, &twist),
            growth: load.moment,
            acceleration: load.force,
        };
        let [further, faster] = [twist.by_position(g, motion), twist.by_velocity(g, motion)];
        this.by_position[k][k] = asks.dot(g, &further);
        this.by_velocity[k][k] = asks.dot(g, &faster);
        let further = carried.wrench(g, &further);
        let turned = twist.carry(g, &inertial.wrenches[index]);
        let mut loads = [further.add(g, turned), carried.wrench(g, &faster)];

        let mut at = *branch;
        while let Frame::Body(parent) = at.parent {
            let motion = kinematics.of(at.body);
            let (offset, rate) = (motion.frame.offset, rates[at.body.index()]);
            if let Some(rotation) = motion.to_parent {
                let parts = [&mut asks.spin, &mut asks.growth, &mut asks.acceleration];
                for part in parts {
                    *part = rotation.apply(g, *part);
                }
                for load in &mut loads {
                    load.force = rotation.apply(g, load.force);
                    load.moment = rotation.apply(g, load.moment);
                }
            }
            let lever = offset.cross(g, asks.acceleration);
            asks.growth = asks.growth.add(g, lever);
            let two = g.constant(2.0);
            let carried_on = rate.cross(g, asks.acceleration).scale(g, two);
            asks.spin = asks.spin.add(g, carried_on);
            for load in &mut loads {
                let shift = offset.cross(g, load.force);
                load.moment = load.moment.add(g, shift);
            }
            let motion = kinematics.of(parent);
            if let [step] = &motion.steps[..]
                && let Some(i) = unknown(step)
            {
                let twist = Twist::of(g, step);
                let [further, faster] =
                    [twist.by_position(g, motion), twist.by_velocity(g, motion)];
                this.by_position[i][k] = asks.dot(g, &further);
                this.by_velocity[i][k] = asks.dot(g, &faster);
                let [by_position, by_velocity] =
                    loads.map(|load| step.project(g, load.force, load.moment));
                this.by_position[k][i] = by_position;
                this.by_velocity[k][i] = by_velocity;
            }
            let Some(next) = tree.branch(parent) else {
                break;
            };
            at = next;
        }
    }
    Some(this)
}

/// By body id: how fast its origin leaves its parent's, as the parent's motion is written.
fn rates(g: &mut Graph, problem: &Problem, kinematics: &Kinematics) -> Vec<Vector3> {
    let mut rates = vec![Vector3::zero(g); problem.mechanism.bodies.len()];
    for branch in &problem.topology.branches {
        let motion = kinematics.of(branch.body);
        let omega = kinematics.frame(branch.parent).angular_velocity;
        let mut rate = omega.cross(g, motion.frame.offset);
        for step in &motion.steps {
            let speed = kinematics.coordinates[step.coordinate.index()].velocity;
            let twist = Twist::of(g, step).velocity.scale(g, speed);
            let twist = match motion.to_parent {
                Some(rotation) => rotation.apply(g, twist),
                None => twist,
            };
            rate = rate.add(g, twist);
        }
        rates[branch.body.index()] = rate;
    }
    rates
}

/// By body id: of the body with all it carries.
fn momenta(
    g: &mut Graph,
    problem: &Problem,
    kinematics: &Kinematics,
    bodies: &[AugmentedBody],
    composites: &Composites,
    rates: &[Vector3],
) -> Vec<Momentum> {
    let zero = Vector3::zero(g);
    let still = Momentum {
        linear: zero,
        angular: zero,
        second: [zero.0; 3],
    };
    let mut momenta = vec![still; bodies.len()];
    for branch in problem.topology.branches.iter().rev() {
        let index = branch.body.index();
        let motion = kinematics.of(branch.body);
        let own = Momentum::of_body(g, &bodies[index], motion);
        momenta[index].add(g, &own);
        if let Frame::Body(parent) = branch.parent {
            let along = (composites.whole[index].first, composites.apart[index]);
            let moved = momenta[index].moved_to_parent(g, motion, rates[index], along);
            momenta[parent.index()].add(g, &moved);
        }
    }
    momenta
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::inertial::inertial;
    use crate::mechanics::layout::Runs;
    use crate::mechanics::linearise::columns;
    use crate::mechanics::properties::{probe, vanish};
    use crate::mechanics::symbols::Symbols;
    use crate::mechanics::values::Values;
    use crate::model::resolve::resolve;
    use crate::syntax::parse::parse;
    use crate::topology::build::build;

    /// Entries of both matrices that are not zero; each equals the derivative of the equation it belongs to. Nothing where
    /// the walks do not apply.
    fn compared(declaration: &str) -> Option<usize> {
        let ast = parse(declaration.parse().expect("tokens")).expect("it parses");
        let mechanism = resolve(&ast).expect("it resolves");
        let topology = build(&mechanism).expect("it hangs together");
        let g = &mut Graph::new();
        let symbols = Symbols::new(g, &mechanism, &topology);
        let values = Values::new(g, &mechanism, &symbols);
        let runs = Runs::new(g, &mechanism, &topology, &values, &symbols);
        let problem = Problem {
            mechanism: &mechanism,
            topology: &topology,
            symbols: &symbols,
            values: &values,
            runs: &runs,
            rows: &[],
        };
        let running = vec![g.zero(); symbols.running.ids.len()];
        let kinematics = problem.inertial_kinematics(g, &running, Sources::ALL);
        let loads = inertial(g, &problem, &kinematics, Sources::ALL);
        let found = variation(g, &problem, &kinematics, &loads)?;
        let free = topology.free.iter();
        let along: Vec<ExprId> = free.map(|id| loads.along[id.index()]).collect();
        let mut differences = Vec::new();
        let mut entries = Vec::new();
        for (list, found) in [
            (&symbols.q, found.by_position),
            (&symbols.velocity, found.by_velocity),
        ] {
            for (column, found) in columns(g, &along, list).iter().zip(&found) {
                for (&one, &other) in column.iter().zip(found) {
                    differences.push(g.sub(one, other));
                    entries.push(one);
                }
            }
        }
        assert!(!probe(g, &problem, &differences).is_empty());
        for (k, equal) in vanish(g, &problem, &differences).into_iter().enumerate() {
            assert!(equal, "entry {k} of {}: {declaration}", differences.len());
        }
        let zeros = vanish(g, &problem, &entries);
        Some(zeros.into_iter().filter(|zero| !zero).count())
    }

    const BODIES: &str = "input omega: rad/s; design l = 0.7 m; design m = 2 kg;
        gravity [0.3, -0.7, -9.81] m/s^2;
        body hub: rigid(mass: m, center: [0.1, -0.2, 0.3] m, inertia: [1, 2, 2.5, 0.1, -0.2, 0.3] kg*m^2);
        body arm: rigid(mass: 3 kg, center: [0.2 m, l, -0.1 m], inertia: [0.4, 0.3, 0.5, 0.02, 0.03, -0.01] kg*m^2);
        body hand: rigid(mass: 1.5 kg, center: [-0.3, 0.1, 0.2] m, inertia: [0.2, 0.3, 0.25, 0, 0.01, 0.02] kg*m^2);";

    fn of_joints(joints: &str) -> Option<usize> {
        compared(&format!("mechanism Machine {{ {BODIES} {joints} }}"))
    }

    #[test]
    fn turns_about_skew_axes() {
        let entries = of_joints(
            "joint a: revolute([0.2, 0.3, 1]) from ground to hub;
             joint b: revolute(y) from hub to arm at [l, 0, 0.2 m] rotated(x, 20 deg);
             joint c: revolute([1, 0.4, 0]) from arm to hand at [0.1, 0.2, 0.3] m rotated(z, 10 deg) rotated(y, 5 deg);",
        );
        // all but one: the moment of the last body about its axis does not depend on how fast it turns about it
        assert_eq!(entries, Some(17));
    }

    #[test]
    fn slides_and_screws_off_the_origin() {
        let entries = of_joints(
            "joint a: screw([0.1, 0.2, 1], lead: 300 mm) from ground to hub at [0.1, 0.2, 0] m, at [0.3, -0.1, 0.2] m on hub;
             joint b: prismatic([1, 0.5, 0.2]) from hub to arm at [l, 0, 0.2 m], at [0.1, 0.2, 0.3] m rotated(x, 30 deg) on arm;
             joint c: revolute(y) from arm to hand at [0.1, 0.2, 0.3] m, at [0, 0.4, 0.1] m rotated(z, 15 deg) on hand;",
        );
        // nothing depends on the speed of a slide along its own direction
        assert!(entries.is_some_and(|count| count >= 16), "{entries:?}");
    }

    #[test]
    fn branches_drives_and_joints_declared_inwards() {
        let entries = of_joints(
            "body mast: rigid(mass: 1 kg, inertia: [0.1, 0.1, 0.1, 0, 0, 0] kg*m^2);
             joint spin: universal(turn: z, tilt: x) from ground to mast, turn driven at omega, tilt driven at 0.3 rad/s;
             joint a: revolute(x) from hub to mast at [l, 0.1 m, 0.2 m], at [0.3, 0.2, 0] m on mast;
             joint b: revolute(y) from hub to arm at [0.2, 0, 0.3] m;
             joint c: screw(z, lead: 100 mm) from hand to hub at [0.1, 0, 0] m;",
        );
        assert!(entries.is_some_and(|count| count >= 10), "{entries:?}");
    }

    #[test]
    fn runs_are_differentiated() {
        let entries = of_joints(
            "joint a: revolute(y) from ground to hub;
             joint b: revolute(y) from hub to arm at [l, 0, 0.2 m];
             joint c: revolute(z) from arm to hand;",
        );
        assert_eq!(entries, None);
    }
}
