//! How a vibration moves the bodies that spin: across their axes, in which direction, about them, or along them.
//!
//! In the vibration `q* + Re((x + i y) e^{i w t})`, `w > 0`, a quantity that moves by `r` along `x` and by `s` along
//! `y` follows the ellipse `r cos(w t) - s sin(w t)`, counterclockwise about `-r x s`. With `omega` the angular
//! velocity of a body in the steady state, `m` its mass, `a` the arm from its axis to its centre of mass (in the steady
//! state this is accelerated by `-|omega|^2 a`), and `r` and `s` the displacements of the point of the body on the axis,
//! `theta` its small rotation, summed over the bodies and over slices of the beams, whose material may spin about its
//! own axis:
//!
//! - `moment = -sum |omega| omega . m (r x s)`,
//! - `lateral = sum m (|omega x r|^2 + |omega x s|^2) / 2`,
//! - `axial = sum m ((omega . r)^2 + (omega . s)^2) / 2`,
//! - `torsional = sum (J + m a^2) (omega . theta)^2 / 2` along `x` and `y`, `J` the moment of inertia about `omega`.
//!
//! Small rotations contribute to the first two in the same way, with the trace of the second moment about the centre of
//! mass in place of `m`. For one body, `moment / lateral` is one on a circle in the sense of the spin, minus one on a
//! circle against it, and zero on a line.
//!
//! With `e` the share of a body in the last three sums, `eccentric = |sum e a|^2 / (sum e sum e (a^2 + J / m))` is near
//! one if what moves is a body that hangs beside its axis, such as a blade, and zero if it is a shaft. `moving` is
//! `sum e / |omega|^2`, and `still` the sum that corresponds to it over the bodies that do not spin.
//!
//! # The sense of whirl is a kernel
//!
//! It depends on displacements and spins of bodies, which only the compiler knows: it emits `whirl` where a massive
//! body is driven to turn (`mechanics/kernels/whirl.rs`).

use crate::algebra::{Array, Direction, ExprId, Function, Graph, Matrix3, Vector3, derivatives_along};
use crate::mechanics::kernel_name::KernelName;
use crate::mechanics::motion::{BeamMotion, FrameMotion, Kinematics};
use crate::mechanics::setup::{Context, MassDistribution, SymbolList, Values, at_rest};
use crate::model::mechanism::{Body, Frame};

use super::parameters::parameter;

/// The function that computes the direction in which a vibration whirls.
pub(crate) fn whirl(g: &mut Graph, context: &Context, kinematics: &Kinematics) -> Option<Function> {
    let symbols = context.symbols;
    let sums = sums(g, context, kinematics)?;
    Some(Function {
        name: KernelName::Whirl.name(),
        parameters: vec![
            parameter("q", &symbols.q),
            parameter("u", &symbols.u),
            parameter("b", &symbols.b),
            parameter("real", &symbols.real),
            parameter("imaginary", &symbols.imaginary),
        ],
        results: vec![Array { name: "sums", shape: vec![SUMS.len()], values: sums.to_vec() }],
    })
}

/// The sums, in order.
const SUMS: [&str; 7] = ["moment", "lateral", "torsional", "axial", "eccentric", "moving", "still"];

/// Added to a divisor that is zero where nothing spins, and then divides zero.
const TINY: f64 = 1e-300;

/// Whether each body moves with coordinates of blades that are not unknowns: these are seen from the ground, and so no
/// motion of the body.
fn on_blades(context: &Context) -> Vec<bool> {
    let mut all = vec![false; context.mechanism.bodies.len()];
    for branch in &context.topology.branches {
        let carried = matches!(branch.parent, Frame::Body(parent) if all[parent.index()]);
        let free = &context.topology.free;
        let steps = context.mechanism.joints[branch.joint.index()].steps.iter();
        let mut unknowns = steps.filter_map(|step| free.iter().position(|id| *id == step.coordinate));
        all[branch.body.index()] = carried || unknowns.any(|k| context.multiblade.name(k).is_some());
    }
    all
}

/// The sums; `None` if no massive body turns in the state of rest.
fn sums(g: &mut Graph, context: &Context, kinematics: &Kinematics) -> Option<[ExprId; 7]> {
    let zero = g.zero();
    let tiny = g.constant(TINY);
    let symbols = context.symbols;
    let on_blade = on_blades(context);
    let bodies = context.mechanism.bodies.iter().zip(&kinematics.bodies);
    let mut pieces: Vec<Piece> = bodies
        .zip(&on_blade)
        .filter(|((body, _), on_blade)| !body.parts.is_empty() && !**on_blade)
        .map(|((body, motion), _)| Piece::of_body(g, context.values, body, &motion.frame))
        .collect();
    for (k, motion) in kinematics.beams.iter().enumerate() {
        if on_blade[context.mechanism.beams[k].body.index()] {
            continue;
        }
        pieces.extend(slices(g, context, k, motion));
    }
    let vectors: Vec<ExprId> = (pieces.iter()).flat_map(|piece| piece.motion).flat_map(|vector| vector.0).collect();
    let accelerations: Vec<ExprId> = pieces.iter().flat_map(|x| x.acceleration.0).collect();
    let spins = pairs(&at_rest(g, symbols, &vectors));
    let accelerations = at_rest(g, symbols, &accelerations);
    let mut moved = |name, along: &SymbolList| {
        let rates = symbols.velocity.with(&along.values).collect();
        pairs(&derivatives_along(g, &vectors, &Direction::new(name, rates)))
    };
    let moved = [moved("_real", &symbols.real), moved("_imaginary", &symbols.imaginary)];

    let [mut moment, mut lateral, mut torsional, mut axial, mut moving, mut still] = [zero; 6];
    let (mut place, mut gyration, mut spinning) = (Vector3::zero(g), zero, false);
    for (index, piece) in pieces.iter().enumerate() {
        let omega = spins[index][1].add(g, piece.spin);
        let [real, imaginary] = moved.each_ref().map(|all| all[index]);
        let trace = piece.second_moment(g, None);
        if omega.is_zero(g) {
            for [r, theta] in [real, imaginary] {
                let shares = [(piece.mass, r), (trace, theta)].map(|(weight, moved)| {
                    let square = moved.dot(g, moved);
                    g.mul(weight, square)
                });
                still = g.sum([still, shares[0], shares[1]]);
            }
            continue;
        }
        spinning = true;
        let (speed, square) = (omega.norm(g), omega.dot(g, omega));
        let divisor = g.add(square, tiny);
        let one = g.constant(1.0);
        let inverse = g.div(one, divisor);
        let arm = Vector3([0, 1, 2].map(|k| accelerations[3 * index + k])).scale(g, inverse).neg(g);
        let reach = arm.dot(g, arm);
        let about_center = piece.second_moment(g, Some(omega));
        let polar = g.mul(about_center, inverse);
        let offset = g.mul(piece.mass, reach);
        let about_axis = g.add(polar, offset);
        // The point of the body on the axis.
        let on_axis = [real, imaginary].map(|[r, theta]| {
            let swing = theta.cross(g, arm);
            r.sub(g, swing)
        });
        let turns = [real[1], imaginary[1]];
        let mut across = zero;
        for (weight, [r, s]) in [(piece.mass, on_axis), (trace, turns)] {
            let area = s.cross(g, r);
            let along = omega.dot(g, area);
            let weighted = g.mul(weight, speed);
            let share = g.mul(weighted, along);
            moment = g.add(moment, share);
            let squares = [r, s].map(|moved| {
                let across = omega.cross(g, moved);
                across.dot(g, across)
            });
            let sum = g.sum(squares);
            let share = g.mul(weight, sum);
            across = g.add(across, share);
        }
        let [along, about] = [(piece.mass, on_axis), (about_axis, turns)].map(|(weight, moved)| {
            let squares = moved.map(|moved| {
                let along = omega.dot(g, moved);
                g.mul(along, along)
            });
            let sum = g.sum(squares);
            g.mul(weight, sum)
        });
        lateral = g.add(lateral, across);
        axial = g.add(axial, along);
        torsional = g.add(torsional, about);
        let share = g.sum([across, along, about]);
        let energy = g.mul(share, inverse);
        moving = g.add(moving, energy);
        let centroid = arm.scale(g, share);
        place = place.add(g, centroid);
        let mass = g.add(piece.mass, tiny);
        let square = g.div(about_axis, mass);
        let spread = g.mul(share, square);
        gyration = g.add(gyration, spread);
    }
    if !spinning {
        return None;
    }
    let all = g.sum([lateral, axial, torsional]);
    let [square, spread] = [place.dot(g, place), g.mul(all, gyration)];
    let divisor = g.add(spread, tiny);
    let eccentric = g.div(square, divisor);
    let [lateral, torsional, axial, moving, still] =
        [lateral, torsional, axial, moving, still].map(|sum| g.scale(0.5, sum));
    let sums = [moment, lateral, torsional, axial, eccentric, moving, still];
    for (sum, name) in sums.into_iter().zip(SUMS) {
        g.set_name(sum, || name.to_owned());
    }
    Some(sums)
}

/// A body, or the mass of a beam that a place of its quadrature stands for.
struct Piece {
    mass: ExprId,
    /// The second moment about the centre of mass, `isotropic 1 + sum weight (a b^T)`, in the piece's axes.
    isotropic: ExprId,
    moments: Vec<(ExprId, Vector3, Vector3)>,
    /// The piece's axes; the common ones if there are none.
    axes: Option<Matrix3>,
    /// Velocity of its centre of mass and angular velocity.
    motion: [Vector3; 2],
    /// Acceleration of its centre of mass.
    acceleration: Vector3,
    /// Angular velocity of its material in addition.
    spin: Vector3,
}

impl Piece {
    /// `integral |rho|^2 dm`, or `integral |omega x rho|^2 dm`.
    fn second_moment(&self, g: &mut Graph, omega: Option<Vector3>) -> ExprId {
        let omega = omega.map(|omega| match self.axes {
            Some(axes) => Vector3(axes.0.map(|axis| axis.dot(g, omega))),
            None => omega,
        });
        let mut sum = match omega {
            None => g.scale(3.0, self.isotropic),
            Some(omega) => {
                let square = omega.dot(g, omega);
                let both = g.scale(2.0, self.isotropic);
                g.mul(both, square)
            }
        };
        for &(weight, a, b) in &self.moments {
            let [a, b] = [a, b].map(|arm| omega.map_or(arm, |omega| omega.cross(g, arm)));
            let product = a.dot(g, b);
            let term = g.mul(weight, product);
            sum = g.add(sum, term);
        }
        sum
    }

    /// The combined distributions of a body, about their common centre of mass.
    fn of_body(g: &mut Graph, values: &Values, body: &Body, frame: &FrameMotion) -> Self {
        let distributions = MassDistribution::of_body(g, values, body);
        let mass = g.sum(distributions.iter().map(|x| x.mass));
        let isotropic = g.sum(distributions.iter().map(|x| x.isotropic));
        let (mut center, mut centers) = (Vector3::zero(g), Vec::new());
        let mut moments = Vec::new();
        // `c = sum f_k d_k / m`; about it the second moment has `second_kj - f_k f_j / m`.
        for MassDistribution { mass: own, arms, .. } in &distributions {
            let mut own_center = Vector3::zero(g);
            for arm in arms {
                let share = ratio(g, arm.first, *own);
                let part = arm.direction.scale(g, share);
                own_center = own_center.add(g, part);
                for (&second, other) in arm.second.iter().zip(arms) {
                    let about_center = g.mul(share, other.first);
                    let rest = g.sub(second, about_center);
                    moments.push((rest, arm.direction, other.direction));
                }
            }
            let share = ratio(g, *own, mass);
            let part = own_center.scale(g, share);
            center = center.add(g, part);
            centers.push((*own, own_center));
        }
        for (own, own_center) in centers {
            let away = own_center.sub(g, center);
            if !away.is_zero(g) {
                moments.push((own, away, away));
            }
        }
        let (arm, curving) = frame.carry(g, center);
        let about_origin = frame.angular_velocity.cross(g, arm);
        Self {
            mass,
            isotropic,
            moments,
            axes: Some(frame.orientation.axes),
            motion: [frame.velocity.add(g, about_origin), frame.angular_velocity],
            acceleration: frame.acceleration.add(g, curving),
            spin: Vector3::zero(g),
        }
    }
}

fn slices(g: &mut Graph, context: &Context, beam: usize, motion: &BeamMotion) -> Vec<Piece> {
    let beam = &context.mechanism.beams[beam];
    let values = context.values;
    let length = values.scalar(g, &beam.length);
    let spin = values.scalar(g, &beam.spin);
    let rule = beam.quadrature();
    let sections = beam.sections.iter().zip(&motion.sections);
    sections
        .enumerate()
        .map(|(k, ((fraction, weight, section), moving))| {
            let share = g.scale(*weight, length);
            let mass = values.scalar(g, &section.mass);
            let frame = &moving.frame;
            let (mut velocity, mut acceleration) = (frame.velocity, frame.acceleration);
            for (direction, reach) in motion.directions.iter().zip(rule.integrals_to(*fraction)) {
                let reach = g.scale(reach, length);
                let increment = direction.rate.scale(g, reach);
                velocity = velocity.add(g, increment);
                let increment = direction.second_rate.scale(g, reach);
                acceleration = acceleration.add(g, increment);
            }
            for (_, offset) in motion.offsets.iter().filter(|(x, _)| *x == k) {
                velocity = velocity.add(g, offset.rate);
                acceleration = acceleration.add(g, offset.second_rate);
            }
            let [axis, second, third] = frame.orientation.axes.0;
            // The distance from the second axis lies along the third.
            let across = section.inertia.iter().zip([third, second]);
            let moments = across.map(|(inertia, along)| {
                let inertia = values.scalar(g, inertia);
                (g.mul(inertia, share), along, along)
            });
            Piece {
                moments: moments.collect(),
                mass: g.mul(mass, share),
                isotropic: g.zero(),
                axes: None,
                motion: [velocity, frame.angular_velocity],
                acceleration,
                spin: axis.scale(g, spin),
            }
        })
        .collect()
}

/// Velocity and angular velocity of each piece, or the corresponding displacements.
fn pairs(components: &[ExprId]) -> Vec<[Vector3; 2]> {
    components.chunks_exact(6).map(|c| [Vector3([c[0], c[1], c[2]]), Vector3([c[3], c[4], c[5]])]).collect()
}

/// `a / b`, or exactly one if both are the same node: usually one piece is the whole body, and its arm leads to its
/// centre.
fn ratio(g: &mut Graph, a: ExprId, b: ExprId) -> ExprId {
    if a == b { g.constant(1.0) } else { g.div(a, b) }
}
