//! Derivatives of inertia and weight along every coordinate by positions and velocities, for any motion.
//!
//! Suppose that everything a body carries keeps its motion relative to the body. Change the body's angular velocity by
//! `spin`, its angular acceleration by `growth - omega x spin` and the acceleration of its origin by `acceleration`.
//! The acceleration of a particle at `r` then changes by `acceleration + growth x r + 2 spin x dr/dt`. This requires
//!
//! - `force = m acceleration + growth x h + 2 spin x P`,
//! - `moment = h x acceleration + I growth + (tr D 1 - D) spin + spin x L`,
//!
//! with mass `m`, first moment `h` and inertia `I`, and, as rates in a frame that moves with the origin without
//! turning, linear and angular momentum `P` and `L` and the rate `D` of the second moment. For the next body outwards,
//! `spin` and `growth` are the same and `acceleration` increases by `growth x d + 2 spin x dd/dt`, where `d` points
//! from origin to origin. Thus each joint acts as a change of the motion of everything it carries, and each coordinate
//! further out needs only one covector, obtained in one walk towards the ground. Part of the covector is the load of the
//! mass matrix.
//!
//! A coordinate of a beam turns and moves its stations, all at once and not one after the other, and changes the beam's own
//! load on its root (`mechanics/inertia/linearised_beam.rs`). Beams are taken at rest only, where they are rigid bodies for
//! all other coordinates.
//!
//! Every body is written in its own axes here, and every entry is a derivative by an unknown, even if the equations
//! themselves are written in runs: where only some joints form runs, as hip, knee and ankle of a walking robot do, the
//! walks need half the operations of differentiation. Where runs prevail, as in a chain of bars, differentiation by
//! absolute angles is far shorter, and nothing is tried.

use crate::algebra::{ExprId, Graph, Matrix3, Vector3};
use crate::base::ids::{BeamId, BodyId};
use crate::census::taken;
use crate::mechanics::motion::{
    BodyMotion, Kinematics, StepAxis, Tree, Wrench, for_inertia, for_inertia_at_rest, second_rate,
};
use crate::mechanics::setup::{Context, CoordinateMotion, ForceSelection};
use crate::model::mechanism::Frame;
use crate::topology::Branch;

use super::augmented::augmented_bodies;
use super::composite::{Composite, Composites, accelerating, spun};
use super::flexible::BeamInertia;
use super::linearised_beam::{Interface, Mobility, OwnBlocks, OwnColumn, station_steps};
use super::momentum::{Momentum, momenta, rates};
use super::newton_euler::inertial;

/// Columns of the derivatives of inertia minus weight by the unknowns: `mass` by their accelerations.
pub(crate) struct Variation {
    pub(crate) mass: Vec<Vec<ExprId>>,
    pub(crate) by_position: Vec<Vec<ExprId>>,
    pub(crate) by_velocity: Vec<Vec<ExprId>>,
}

/// A change of a body's motion, or the covector with the factors of its parts.
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

    /// The part of the covector that is a wrench, along an elementary motion.
    fn load(&self, g: &mut Graph, axis: &StepAxis) -> ExprId {
        axis.project(g, self.acceleration, self.growth)
    }

    /// Transfers the covector from a body to its parent; `rate` is the velocity of the body's origin relative to the
    /// parent's.
    fn move_to_parent(&mut self, g: &mut Graph, motion: &BodyMotion, rate: Vector3) {
        if let Some(rotation) = motion.to_parent {
            for part in [&mut self.spin, &mut self.growth, &mut self.acceleration] {
                *part = rotation.apply(g, *part);
            }
        }
        let lever = motion.frame.offset.cross(g, self.acceleration);
        self.growth = self.growth.add(g, lever);
        let two = g.constant(2.0);
        let carried = rate.scale(g, two).cross(g, self.acceleration);
        self.spin = self.spin.add(g, carried);
    }
}

/// An elementary motion of a free coordinate, and how it changes the motion of the body that it carries.
struct Step {
    unknown: usize,
    axis: StepAxis,
    /// The axis, and the velocity of the body's origin per unit rate.
    turn: Vector3,
    velocity: Vector3,
    /// The same relative to the point about which moments are taken before the motion: the origin as it was; of a
    /// station, the beam counts the moment about where it is.
    departing: Vector3,
    /// Change of the body's motion, in body axes, per unit of the coordinate.
    further: Change,
    /// Change of the body's motion, in body axes, per unit of the coordinate's rate.
    faster: Change,
}

impl Step {
    /// Derivative by position of a wrench that moves with the body, seen from before the joint.
    fn carry(&self, g: &mut Graph, wrench: &Wrench) -> Wrench {
        let turned = self.turn.cross(g, wrench.moment);
        let moved = self.departing.cross(g, wrench.force);
        Wrench { force: self.turn.cross(g, wrench.force), moment: turned.add(g, moved) }
    }
}

/// The motion of a frame, and how its origin moves away from a point of it.
struct Moving {
    omega: Vector3,
    second_rate: Matrix3,
    acceleration: Vector3,
    leaving: Vector3,
}

impl Step {
    /// Behind an elementary motion with axis `z` and velocity `v` of the body's origin `O`, a frame moves with `omega`
    /// and `W` (its second rate), its point at `O` has the acceleration `a`, and `O` moves away from that point at `u`,
    /// the rate of the motions that follow. If the coordinate increases by one unit, the frame turns and moves relative
    /// to everything before it. Seen from the frame,
    ///
    /// - `spin = omega x z`, `growth = W z`, `acceleration = a x z + W v + 2 spin x u`;
    ///
    /// if the rate increases by one unit, `spin = z`, `growth = 2 omega x z`, `acceleration = 2 omega x v + 2 z x u`.
    fn new(g: &mut Graph, unknown: usize, axis: StepAxis, frame: &Moving) -> Self {
        let zero = Vector3::zero(g);
        let two = g.constant(2.0);
        let turn = axis.turn.unwrap_or(zero);
        let velocity = axis.velocity(g, zero);
        let spin = frame.omega.cross(g, turn);
        let turned = frame.acceleration.cross(g, turn);
        let moved = frame.second_rate.apply(g, velocity);
        let carried = spin.cross(g, frame.leaving).scale(g, two);
        let further = Change {
            spin,
            growth: frame.second_rate.apply(g, turn),
            acceleration: turned.add(g, moved).add(g, carried),
        };
        let moved = frame.omega.cross(g, velocity);
        let carried = turn.cross(g, frame.leaving);
        let faster =
            Change { spin: turn, growth: spin.scale(g, two), acceleration: moved.add(g, carried).scale(g, two) };
        Self { unknown, axis, turn, velocity, departing: velocity, further, faster }
    }
}

/// The free motions of a joint, from the parent to the body.
fn steps(
    g: &mut Graph,
    context: &Context,
    kinematics: &Kinematics,
    mobilities: &[Mobility],
    body: BodyId,
) -> Vec<Step> {
    let motion = kinematics.of(body);
    let frame = &motion.frame;
    let (mut omega, mut alpha) = (frame.angular_velocity, frame.angular_acceleration);
    let mut acceleration = frame.acceleration;
    let zero = Vector3::zero(g);
    if let Some((beam, station)) = motion.flexure {
        let second_rate = second_rate(g, omega, alpha);
        let moving = Moving { omega, second_rate, acceleration, leaving: zero };
        let mobility = &mobilities[beam.index()];
        let steps = station_steps(g, context, kinematics, mobility, (body, beam, station)).into_iter();
        return steps.map(|(unknown, axis)| Step { departing: zero, ..Step::new(g, unknown, axis, &moving) }).collect();
    }
    let two = g.constant(2.0);
    let mut leaving = zero;
    let mut steps = Vec::new();
    for axis in motion.steps.iter().rev() {
        let turn = axis.turn.unwrap_or(zero);
        let velocity = axis.velocity(g, zero);
        let free = &context.topology.free;
        if let Some(unknown) = free.iter().position(|&id| id == axis.coordinate) {
            let second_rate = second_rate(g, omega, alpha);
            let moving = Moving { omega, second_rate, acceleration, leaving };
            steps.push(Step::new(g, unknown, *axis, &moving));
        }
        // the frame before this motion
        let CoordinateMotion { velocity: rate, acceleration: growth, .. } =
            kinematics.coordinates[axis.coordinate.index()];
        let spin = turn.scale(g, rate);
        let speed = velocity.scale(g, rate);
        omega = omega.sub(g, spin);
        let growing = turn.scale(g, growth);
        let gyroscopic = omega.cross(g, spin);
        alpha = alpha.sub(g, growing).sub(g, gyroscopic);
        let growing = velocity.scale(g, growth);
        let coriolis = omega.cross(g, speed).scale(g, two);
        let centripetal = spin.cross(g, speed);
        for term in [growing, coriolis, centripetal] {
            acceleration = acceleration.sub(g, term);
        }
        leaving = leaving.add(g, speed);
    }
    steps.reverse();
    steps
}

/// A body with everything it carries, with the joints' relative motion unchanged.
struct Carried {
    mass: Composite,
    momentum: Momentum,
}

impl Carried {
    /// The wrench that a change of the body's motion requires.
    fn wrench(&self, g: &mut Graph, change: &Change) -> Wrench {
        let Composite { mass, first, second } = self.mass;
        let two = g.constant(2.0);
        let pushed = change.acceleration.scale(g, mass);
        let growing = change.growth.cross(g, first);
        let linear = self.momentum.linear.scale(g, two);
        let spinning = change.spin.cross(g, linear);
        let force = pushed.add(g, growing).add(g, spinning);
        let pushed = first.cross(g, change.acceleration);
        let growing = spun(g, second, change.growth);
        let spreading = spun(g, self.momentum.second, change.spin);
        let spinning = change.spin.cross(g, self.momentum.angular);
        let moment = pushed.add(g, growing).add(g, spreading).add(g, spinning);
        Wrench { force, moment }
    }

    /// The covector's `spin` part for the load along an elementary motion.
    fn asks_of_spin(&self, g: &mut Graph, step: &Step) -> Vector3 {
        let two = g.constant(2.0);
        let pushed = self.momentum.linear.scale(g, two).cross(g, step.velocity);
        let spreading = spun(g, self.momentum.second, step.turn);
        let turning = self.momentum.angular.cross(g, step.turn);
        pushed.add(g, spreading).add(g, turning)
    }
}

/// The derivatives of the load on a body by one unknown, by position and by velocity, and the covector that its equation
/// asks of the body's motion.
#[derive(Clone, Copy)]
struct Column {
    unknown: usize,
    asks: Change,
    loads: [Wrench; 2],
}

impl Column {
    /// Of an elementary motion, on the body that it moves.
    fn new(g: &mut Graph, step: &Step, whole: &Carried, (load, wrench): (Wrench, &Wrench)) -> Self {
        let asks = Change { spin: whole.asks_of_spin(g, step), growth: load.moment, acceleration: load.force };
        let further = whole.wrench(g, &step.further);
        let turned = step.carry(g, wrench);
        Self { unknown: step.unknown, asks, loads: [further.add(g, turned), whole.wrench(g, &step.faster)] }
    }

    /// Of a coordinate of a beam on its root, its stations left out.
    fn of_beam(g: &mut Graph, own: OwnColumn, omega: Vector3) -> Self {
        let [by_omega, growth, acceleration] = own.by_motion;
        // the angular acceleration changes by `growth - omega x spin`
        let turned = omega.cross(g, growth);
        let asks = Change { spin: by_omega.add(g, turned), growth, acceleration };
        Self { unknown: own.unknown, asks, loads: own.loads }
    }

    fn add(&mut self, g: &mut Graph, other: &Self) {
        let Change { spin, growth, acceleration } = other.asks;
        self.asks.spin = self.asks.spin.add(g, spin);
        self.asks.growth = self.asks.growth.add(g, growth);
        self.asks.acceleration = self.asks.acceleration.add(g, acceleration);
        for (load, other) in self.loads.iter_mut().zip(other.loads) {
            *load = load.add(g, other);
        }
    }

    fn move_to_parent(&mut self, g: &mut Graph, motion: &BodyMotion, rate: Vector3) {
        self.asks.move_to_parent(g, motion, rate);
        for load in &mut self.loads {
            *load = moved_to_parent(g, motion, load);
        }
    }
}

/// Whether the walks apply: not where runs prevail or a coordinate coasts.
fn walks_apply(context: &Context) -> bool {
    context.topology.coasting.is_empty() && !context.runs.prevail()
}

/// Derivatives of inertia minus weight by the unknowns with the running coordinates at `running`; `None` if runs prevail,
/// a coordinate coasts, or a body bends.
pub(crate) fn variation(g: &mut Graph, context: &Context, running: &[ExprId]) -> Option<Variation> {
    if !context.mechanism.beams.is_empty() || !walks_apply(context) {
        return None;
    }
    taken(|| "variation: walks over bodies".into());
    if context.runs.exist() {
        taken(|| "variation: beside runs".into());
    }
    let context = &Context { runs: &context.runs.apart(context.symbols), ..*context };
    let kinematics = for_inertia(g, context, running, ForceSelection::ALL);
    Some(Variation::new(g, context, &kinematics, &[]))
}

/// Derivatives of inertia minus weight, and of the forces of strain, of a mechanism with beams at rest, in which only what
/// is driven runs on; `None` if it has no beams, runs prevail or a coordinate coasts. `strained` are the forces along the
/// rows of the sections.
pub(crate) fn variation_at_rest(g: &mut Graph, context: &Context, strained: &[ExprId]) -> Option<Variation> {
    if context.mechanism.beams.is_empty() || !walks_apply(context) {
        return None;
    }
    taken(|| "variation: walks over bodies and beams".into());
    let context = &Context { runs: &context.runs.apart(context.symbols), ..*context };
    let kinematics = for_inertia_at_rest(g, context);
    Some(Variation::new(g, context, &kinematics, strained))
}

impl Variation {
    fn new(g: &mut Graph, context: &Context, kinematics: &Kinematics, strained: &[ExprId]) -> Self {
        let (topology, mechanism) = (context.topology, context.mechanism);
        let inertial = inertial(g, context, kinematics, ForceSelection::ALL);
        let mut bodies = augmented_bodies(g, context, kinematics, ForceSelection::ALL);
        let mut spinning = vec![Vector3::zero(g); bodies.len()];
        for (beam, motion) in kinematics.beams.iter().enumerate() {
            let root = mechanism.beams[beam].body.index();
            let inertia = BeamInertia::new(g, context, BeamId::new(beam));
            spinning[root] = bodies[root].add_bent(g, &inertia, motion);
        }
        let composites = Composites::new(g, context, kinematics, &bodies);
        let rates = rates(g, context, kinematics);
        let momenta = momenta(g, context, kinematics, &bodies, &composites, (&rates, &spinning));
        let beams = (0..mechanism.beams.len()).map(BeamId::new);
        let mobilities: Vec<Mobility> = beams.map(|beam| Mobility::new(g, context, kinematics, beam)).collect();
        let steps: Vec<Vec<Step>> =
            (0..bodies.len()).map(|index| steps(g, context, kinematics, &mobilities, BodyId::new(index))).collect();

        let n = context.symbols.q.ids.len();
        let zeros = vec![vec![g.zero(); n]; n];
        let mut this = Self { mass: zeros.clone(), by_position: zeros.clone(), by_velocity: zeros };
        let mut of_beams = this.of_beams(g, context, kinematics, &mobilities, (&inertial.wrenches, strained));
        let tree = Tree::new(mechanism, topology);
        let walk = |g: &mut Graph, this: &mut Self, mut column: Column, mut at: Branch| {
            while let Frame::Body(parent) = at.parent {
                column.move_to_parent(g, kinematics.of(at.body), rates[at.body.index()]);
                this.meet(g, &column, &steps[parent.index()]);
                let Some(next) = tree.branch(parent) else {
                    break;
                };
                at = next;
            }
        };
        for branch in &topology.branches {
            let index = branch.body.index();
            let motion = kinematics.of(branch.body);
            let whole = Carried { mass: composites.whole[index], momentum: momenta[index] };
            for (position, step) in steps[index].iter().enumerate() {
                let carried = &composites.carried[index];
                let load = accelerating(g, &step.axis, &bodies[index], &motion.frame, carried);
                let mut column = Column::new(g, step, &whole, (load, &inertial.wrenches[index]));
                let Some((beam, _)) = motion.flexure else {
                    this.mass[step.unknown][step.unknown] = column.asks.load(g, &step.axis);
                    this.by_position[step.unknown][step.unknown] = column.asks.dot(g, &step.further);
                    this.by_velocity[step.unknown][step.unknown] = column.asks.dot(g, &step.faster);
                    this.meet(g, &column, &steps[index][..position]);
                    walk(g, &mut this, column, *branch);
                    continue;
                };
                this.meet_together(g, &column, &steps[index]);
                column.move_to_parent(g, motion, rates[index]);
                let mut columns = of_beams[beam.index()].iter_mut();
                if let Some(sum) = columns.find(|sum| sum.unknown == column.unknown) {
                    sum.add(g, &column);
                }
            }
        }
        for (beam, columns) in mechanism.beams.iter().zip(of_beams) {
            for column in columns {
                this.meet(g, &column, &steps[beam.body.index()]);
                if let Some(branch) = tree.branch(beam.body) {
                    walk(g, &mut this, column, branch);
                }
            }
        }
        this
    }

    /// The columns of the beams' coordinates on their roots, without those of the stations; sets the entries between
    /// coordinates of the same beam.
    fn of_beams(
        &mut self,
        g: &mut Graph,
        context: &Context,
        kinematics: &Kinematics,
        mobilities: &[Mobility],
        given: (&[Wrench], &[ExprId]),
    ) -> Vec<Vec<Column>> {
        let beams = &context.mechanism.beams;
        if beams.is_empty() {
            return Vec::new();
        }
        let interface = Interface::new(g, context);
        let mut blocks = OwnBlocks::new(g, context);
        let columns = mobilities.iter().enumerate().map(|(beam, mobility)| {
            let own = blocks.linearise(g, context, (BeamId::new(beam), &interface, mobility), kinematics, given);
            let omega = kinematics.of(beams[beam].body).frame.angular_velocity;
            own.into_iter().map(|own| Column::of_beam(g, own, omega)).collect()
        });
        let columns = columns.collect();
        [self.mass, self.by_velocity, self.by_position] = blocks.by_unknowns(g, context);
        columns
    }

    /// Sets the entries that couple a motion with the motions nearer to the ground, at the body that carries them.
    fn meet(&mut self, g: &mut Graph, column: &Column, before: &[Step]) {
        let Column { unknown: k, asks, loads } = column;
        for other in before {
            let i = other.unknown;
            let mass = asks.load(g, &other.axis);
            (self.mass[i][*k], self.mass[*k][i]) = (mass, mass);
            self.by_position[i][*k] = asks.dot(g, &other.further);
            self.by_velocity[i][*k] = asks.dot(g, &other.faster);
            let [by_position, by_velocity] = loads.map(|load| other.axis.project(g, load.force, load.moment));
            self.by_position[*k][i] = by_position;
            self.by_velocity[*k][i] = by_velocity;
        }
    }

    /// Adds to the entries between motions that move a station together.
    fn meet_together(&mut self, g: &mut Graph, column: &Column, all: &[Step]) {
        let Column { unknown: k, asks, loads } = column;
        for other in all {
            let mass = asks.load(g, &other.axis);
            let [by_position, by_velocity] = loads.map(|load| other.axis.project(g, load.force, load.moment));
            let entries =
                [(&mut self.mass, mass), (&mut self.by_position, by_position), (&mut self.by_velocity, by_velocity)];
            for (matrix, share) in entries {
                matrix[*k][other.unknown] = g.add(matrix[*k][other.unknown], share);
            }
        }
    }
}

fn moved_to_parent(g: &mut Graph, motion: &BodyMotion, load: &Wrench) -> Wrench {
    let mut load = *load;
    if let Some(rotation) = motion.to_parent {
        load.force = rotation.apply(g, load.force);
        load.moment = rotation.apply(g, load.moment);
    }
    let shift = motion.frame.offset.cross(g, load.force);
    load.moment = load.moment.add(g, shift);
    load
}
