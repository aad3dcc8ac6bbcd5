//! Whether a vibration whirls in the direction in which the bodies spin.
//!
//! In the vibration `q* + Re((x + i y) e^{i w t})`, `w > 0`, a quantity that moves by `r` along `x` and by `s` along
//! `y` follows the ellipse `r cos(w t) - s sin(w t)`, counterclockwise about `-r x s`. With `omega` the angular
//! velocity of a body in the steady state, `r` and `s` the displacements of its centre of mass and `m` its mass, summed
//! over the bodies and over slices of the beams, whose material may spin about its own axis:
//!
//! - `moment = -sum |omega| omega . m (r x s)`,
//! - `size = sum m (|omega x r|^2 + |omega x s|^2) / 2`.
//!
//! Small rotations contribute in the same way, with the trace of the second moment about the centre of mass in place of
//! `m`. For one body, `moment / size` is one on a circle in the sense of the spin, minus one on a circle against it,
//! and zero on a line.
//!
//! # The sense of whirl is a kernel
//!
//! It depends on displacements and spins of bodies, which only the compiler knows: it emits `whirl` where a massive
//! body is driven to turn (`mechanics/kernels/whirl.rs`).

use crate::algebra::{Array, Direction, ExprId, Function, Graph, Vector3, derivatives_along};
use crate::mechanics::kernel_name::KernelName;
use crate::mechanics::motion::{BeamMotion, in_common_frame_at_zero};
use crate::mechanics::setup::{Context, MassDistribution, SymbolList, Values, at_rest};
use crate::model::mechanism::Body;

use super::parameters::parameter;

/// The function that computes the direction in which a vibration whirls.
pub(crate) fn whirl(g: &mut Graph, context: &Context) -> Option<Function> {
    let symbols = context.symbols;
    let moment_and_size = moment_and_size(g, context)?;
    Some(Function {
        name: KernelName::Whirl.name(),
        parameters: vec![
            parameter("q", &symbols.q),
            parameter("u", &symbols.u),
            parameter("b", &symbols.b),
            parameter("real", &symbols.real),
            parameter("imaginary", &symbols.imaginary),
        ],
        results: vec![Array {
            name: "moment_and_size",
            shape: vec![2],
            values: moment_and_size.to_vec(),
        }],
    })
}

/// `moment` and `size`; `None` if no massive body turns in the state of rest.
fn moment_and_size(g: &mut Graph, context: &Context) -> Option<[ExprId; 2]> {
    let zero = g.zero();
    let kinematics = in_common_frame_at_zero(g, context);
    let symbols = context.symbols;
    let bodies = kinematics.bodies.iter();
    let bodies = bodies.map(|body| [body.frame.velocity, body.frame.angular_velocity]);
    let mut vectors: Vec<[Vector3; 2]> = bodies.collect();
    let slices: Vec<Slice> = (0..context.mechanism.beams.len())
        .flat_map(|k| slices(g, context, k, &kinematics.beams[k]))
        .collect();
    vectors.extend(slices.iter().map(|slice| slice.motion));
    let vectors: Vec<ExprId> = vectors.iter().flatten().flat_map(|pair| pair.0).collect();
    let spins = by_body(&at_rest(g, symbols, &vectors));
    let mut moved = |name, along: &SymbolList| {
        let rates = symbols.velocity.with(&along.values).collect();
        by_body(&derivatives_along(
            g,
            &vectors,
            &Direction::new(name, rates),
        ))
    };
    let real = moved("_real", &symbols.real);
    let imaginary = moved("_imaginary", &symbols.imaginary);

    let (mut moment, mut size) = (zero, zero);
    let mut add = |g: &mut Graph, omega: Vector3, shares: [(ExprId, [Vector3; 2]); 2]| {
        let speed = omega.norm(g);
        for (weight, [r, s]) in shares {
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
            size = g.add(size, share);
        }
    };
    for (index, body) in context.mechanism.bodies.iter().enumerate() {
        let [_, omega] = spins[index];
        if body.parts.is_empty() || omega.is_zero(g) {
            continue;
        }
        let central = Central::of_body(g, context.values, body);
        let frame = &kinematics.bodies[index].frame;
        let center = frame.orientation.express(g, central.center);
        let mut of_center = |[velocity, turning]: [Vector3; 2]| {
            let about_origin = turning.cross(g, center);
            velocity.add(g, about_origin)
        };
        let centers = [of_center(real[index]), of_center(imaginary[index])];
        let turns = [real[index][1], imaginary[index][1]];
        let shares = [(central.mass, centers), (central.second_moment, turns)];
        add(g, omega, shares);
    }
    let first = context.mechanism.bodies.len();
    for (index, slice) in (first..).zip(&slices) {
        let spin = slice.axis.scale(g, slice.spin);
        let omega = spins[index][1].add(g, spin);
        if omega.is_zero(g) {
            continue;
        }
        let [places, turns] = [0, 1].map(|k| [real[index][k], imaginary[index][k]]);
        add(
            g,
            omega,
            [(slice.mass, places), (slice.second_moment, turns)],
        );
    }
    let size = g.scale(0.5, size);
    (!g.is(size, 0.0)).then(|| {
        g.set_name(moment, || "moment".to_owned());
        g.set_name(size, || "size".to_owned());
        [moment, size]
    })
}

/// The mass of a beam that a place of its quadrature stands for.
struct Slice {
    mass: ExprId,
    /// `integral |rho|^2 dm` about the axis of the beam.
    second_moment: ExprId,
    /// Velocity and angular velocity of the section.
    motion: [Vector3; 2],
    /// The axis of the beam there, about which its material spins.
    axis: Vector3,
    spin: ExprId,
}

fn slices(g: &mut Graph, context: &Context, beam: usize, motion: &BeamMotion) -> Vec<Slice> {
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
            let inertia = section
                .inertia
                .each_ref()
                .map(|inertia| values.scalar(g, inertia));
            let polar = g.sum(inertia);
            let mut velocity = moving.frame.velocity;
            for (direction, reach) in motion.directions.iter().zip(rule.integrals_to(*fraction)) {
                let reach = g.scale(reach, length);
                let increment = direction.rate.scale(g, reach);
                velocity = velocity.add(g, increment);
            }
            for (_, offset) in motion.offsets.iter().filter(|(x, _)| *x == k) {
                velocity = velocity.add(g, offset.rate);
            }
            Slice {
                mass: g.mul(mass, share),
                second_moment: g.mul(polar, share),
                motion: [velocity, moving.frame.angular_velocity],
                axis: moving.frame.orientation.axes.0[0],
                spin,
            }
        })
        .collect()
}

/// Velocity and angular velocity of each body, or the corresponding displacements.
fn by_body(components: &[ExprId]) -> Vec<[Vector3; 2]> {
    components
        .chunks_exact(6)
        .map(|c| [Vector3([c[0], c[1], c[2]]), Vector3([c[3], c[4], c[5]])])
        .collect()
}

/// Mass properties about the centre of mass.
struct Central {
    mass: ExprId,
    /// From the body's origin, in the body frame.
    center: Vector3,
    /// `integral |rho - center|^2 dm`.
    second_moment: ExprId,
}

impl Central {
    /// The combined pieces of a body: `k = sum (k_i + m_i |c_i - c|^2)`.
    fn of_body(g: &mut Graph, values: &Values, body: &Body) -> Self {
        let pieces: Vec<Self> = MassDistribution::of_body(g, values, body)
            .iter()
            .map(|piece| Self::of_piece(g, piece))
            .collect();
        let mass = g.sum(pieces.iter().map(|piece| piece.mass));
        let mut center = Vector3::zero(g);
        for piece in &pieces {
            let share = ratio(g, piece.mass, mass);
            let part = piece.center.scale(g, share);
            center = center.add(g, part);
        }
        let mut second_moment = g.zero();
        for piece in &pieces {
            let away = piece.center.sub(g, center);
            let square = away.dot(g, away);
            let moved = g.mul(piece.mass, square);
            let sum = g.add(piece.second_moment, moved);
            second_moment = g.add(second_moment, sum);
        }
        Self {
            mass,
            center,
            second_moment,
        }
    }

    /// `c = sum f_k d_k / m`, `k = 3 isotropic + sum (second_kj - f_k f_j / m) d_k . d_j`.
    fn of_piece(g: &mut Graph, piece: &MassDistribution) -> Self {
        let MassDistribution {
            mass,
            isotropic,
            arms,
        } = piece;
        let mut center = Vector3::zero(g);
        let mut second_moment = g.scale(3.0, *isotropic);
        for arm in arms {
            let share = ratio(g, arm.first, *mass);
            let part = arm.direction.scale(g, share);
            center = center.add(g, part);
            for (&second, other) in arm.second.iter().zip(arms) {
                let about_center = g.mul(share, other.first);
                let rest = g.sub(second, about_center);
                let product = arm.direction.dot(g, other.direction);
                let term = g.mul(rest, product);
                second_moment = g.add(second_moment, term);
            }
        }
        Self {
            mass: *mass,
            center,
            second_moment,
        }
    }
}

/// `a / b`, or exactly one if both are the same node: usually one piece is the whole body, and its arm leads to its
/// centre.
fn ratio(g: &mut Graph, a: ExprId, b: ExprId) -> ExprId {
    if a == b { g.constant(1.0) } else { g.div(a, b) }
}
