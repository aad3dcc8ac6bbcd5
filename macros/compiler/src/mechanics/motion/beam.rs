//! How the sections of a beam move.

use crate::algebra::{Direction, ExprId, Graph, Matrix3, Vector3, derivatives_along};
use crate::base::ids::BeamId;
use crate::mechanics::setup::{CoordinateMotion, OfBeam, Values};
use crate::model::mechanism::Mechanism;

use super::bend::{bend, bend_change, bend_powers, factor, only_axis};
use super::frame::FrameMotion;
use super::strain::Heading;
use super::turned::Turned;
use super::unbent::offset;

/// Motion of the sections of a beam, in the axes of the motion of its root.
#[derive(Clone, Debug)]
pub(crate) struct BeamMotion {
    /// At the places of quadrature.
    pub(crate) sections: Vec<SectionMotion>,
    pub(crate) directions: Vec<DirectionMotion>,
    /// From the axis to the centre of mass, m, of the sections that have it elsewhere.
    pub(crate) offsets: Vec<(usize, DirectionMotion)>,
    pub(crate) stations: Vec<StationMotion>,
}

/// Motion of a section.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SectionMotion {
    /// Its axes: along the beam, and the two across it. Its origin is that of the root.
    pub(crate) frame: FrameMotion,
    /// The axes of the beam at the root.
    pub(crate) axes: Matrix3,
    turn: Turn,
    /// Angular velocity, and the rates of its components, along the axes of the section.
    pub(crate) spin: Vector3,
    pub(crate) growth: Vector3,
    /// Rates of the angle or the Rodrigues vector.
    rate: Vector3,
    second: Vector3,
    /// Angular velocity relative to the root.
    pub(crate) relative: Vector3,
}

/// The direction of a beam at a section.
#[derive(Clone, Debug)]
pub(crate) struct DirectionMotion {
    pub(crate) vector: Vector3,
    pub(crate) rate: Vector3,
    pub(crate) second_rate: Vector3,
    /// Velocity relative to the root.
    leaving: Vector3,
    /// Derivatives by the strains, by row of the sections, along the axes of the section.
    slopes: Vec<(usize, Vector3)>,
    section: SectionMotion,
    /// In closed form, if the section turns by a Rodrigues vector.
    turned: Option<Turned>,
}

/// A station: its section, and where it is.
#[derive(Clone, Debug)]
pub(crate) struct StationMotion {
    pub(crate) section: SectionMotion,
    /// Share of the direction of each section in its place, m.
    pub(crate) reach: Vec<ExprId>,
    /// Velocity of its origin relative to the root.
    pub(crate) velocity: Vector3,
}

/// How a section has turned, along the axes of the beam at the root.
#[derive(Clone, Copy, Debug)]
enum Turn {
    /// By an angle about one of them.
    Angle(usize),
    /// By a Rodrigues vector, with `1 / (1 + |turn|^2 / 4)`, and the rotation.
    Rodrigues(Vector3, ExprId, Matrix3),
}

impl BeamMotion {
    pub(crate) fn new(
        g: &mut Graph,
        mechanism: &Mechanism,
        values: &Values,
        id: BeamId,
        root: &FrameMotion,
        (turns, headings): &(OfBeam<CoordinateMotion>, Vec<Heading>),
    ) -> Self {
        let beam = &mechanism.beams[id.index()];
        let name = beam.name.clone();
        let own_axes = Matrix3([0, 1, 2].map(|k| values.vector(g, &beam.axes[k])));
        let axes = Matrix3(own_axes.0.map(|axis| root.orientation.express(g, axis)));
        let start = root.departing(g);
        let mut bent =
            |turn: &[CoordinateMotion; 3], label: String| SectionMotion::new(g, &start, own_axes, axes, *turn, &label);
        let sections: Vec<SectionMotion> =
            turns.rotations.iter().enumerate().map(|(k, turn)| bent(turn, format!("{name}_section_{k}"))).collect();
        let ends: Vec<SectionMotion> =
            turns.stations.iter().enumerate().map(|(k, turn)| bent(turn, format!("{name}_station_{k}"))).collect();
        let directions = sections.iter().zip(headings);
        let directions: Vec<DirectionMotion> =
            directions.map(|(section, heading)| DirectionMotion::new(g, root, section, heading)).collect();
        let mut offsets = Vec::new();
        for (k, (_, _, section)) in beam.sections.iter().enumerate() {
            let offset = offset(g, values, section);
            if !offset.is_zero(g) {
                let offset = Heading::fixed(g, offset);
                offsets.push((k, DirectionMotion::new(g, root, &sections[k], &offset)));
            }
        }
        let length = values.scalar(g, &beam.length);
        let rule = beam.quadrature();
        let stations = beam.stations.iter().zip(ends).map(|(station, section)| {
            let reach: Vec<ExprId> =
                rule.integrals_to(station.place).into_iter().map(|share| g.scale(share, length)).collect();
            StationMotion::new(g, &directions, section, own_axes, reach)
        });
        Self { stations: stations.collect(), sections, directions, offsets }
    }

    /// The directions, then the offsets, with the numbers of their sections.
    pub(crate) fn arms(&self) -> impl Iterator<Item = (usize, &DirectionMotion)> {
        let offsets = self.offsets.iter().map(|(k, arm)| (*k, arm));
        self.directions.iter().enumerate().chain(offsets)
    }
}

impl DirectionMotion {
    fn new(g: &mut Graph, root: &FrameMotion, section: &SectionMotion, heading: &Heading) -> Self {
        let frame = &section.frame;
        let axes = frame.orientation.axes;
        let twice = |g: &mut Graph, v: Vector3| Vector3(v.0.map(|x| g.scale(2.0, x)));
        let vector = axes.apply(g, heading.value);
        let mut this = Self {
            vector,
            rate: frame.angular_velocity.cross(g, vector),
            second_rate: frame.axes_second_rate.apply(g, heading.value),
            leaving: section.relative.cross(g, vector),
            slopes: heading.slopes.clone(),
            section: *section,
            turned: None,
        };
        if let Turn::Rodrigues(turn, factor, rotation) = section.turn {
            let turned = Turned::new(g, (turn, factor, rotation), heading.value);
            let leaving = turned.rate(g, section.rate);
            let second = turned.rate(g, section.second);
            let second = turned.quadratic(g, section.rate).add(g, second);
            this.vector = section.axes.apply(g, turned.vector);
            this.turned = Some(turned);
            this.leaving = section.axes.apply(g, leaving);
            this.rate = root.angular_velocity.cross(g, this.vector);
            this.rate = this.rate.add(g, this.leaving);
            let gyroscopic = root.angular_velocity.cross(g, this.leaving);
            let gyroscopic = twice(g, gyroscopic);
            let carried = root.second_rate.apply(g, this.vector).add(g, gyroscopic);
            this.second_rate = section.axes.apply(g, second).add(g, carried);
        }
        let growing = axes.apply(g, heading.rate);
        let growth = axes.apply(g, heading.second);
        let coriolis = frame.angular_velocity.cross(g, growing);
        let coriolis = twice(g, coriolis);
        Self {
            rate: this.rate.add(g, growing),
            second_rate: this.second_rate.add(g, coriolis).add(g, growth),
            leaving: this.leaving.add(g, growing),
            ..this
        }
    }

    /// Power of a force on the direction while the sections move in a direction.
    pub(crate) fn power(&self, g: &mut Graph, force: Vector3, along: &Direction) -> ExprId {
        let (vector, force) = match &self.turned {
            Some(turned) => (turned.vector, self.section.axes.transpose().apply(g, force)),
            None => (self.vector, force),
        };
        let rates = derivatives_along(g, &vector.0, along);
        force.dot(g, Vector3([rates[0], rates[1], rates[2]]))
    }

    /// Power of a force on the vector per unit rate of the angle of its section, or of each component of the Rodrigues
    /// vector, and of each row of the sections by which it strains.
    pub(crate) fn project(&self, g: &mut Graph, force: Vector3) -> ([ExprId; 3], Vec<(usize, ExprId)>) {
        let (powers, along) = match &self.turned {
            Some(turned) => {
                let force = self.section.axes.transpose().apply(g, force);
                turned.powers(g, force)
            }
            None => {
                let moment = self.vector.cross(g, force);
                let along = self.section.frame.orientation.axes.transpose().apply(g, force);
                (self.section.project(g, moment), along)
            }
        };
        (powers, self.slopes.iter().map(|(row, slope)| (*row, slope.dot(g, along))).collect())
    }
}

impl SectionMotion {
    /// A section that has turned by an angle if the beam turns about one axis only, otherwise by a Rodrigues vector:
    /// `R = 1 + f (S + S^2 / 2)` with `S = [turn]x` and `f = 1 / (1 + |turn|^2 / 4)`; its angular velocity is
    /// `f (turn' + turn x turn' / 2)`.
    fn new(
        g: &mut Graph,
        root: &FrameMotion,
        own_axes: Matrix3,
        axes: Matrix3,
        turns: [CoordinateMotion; 3],
        name: &str,
    ) -> Self {
        let turn = Vector3(turns.map(|turn| turn.position));
        let rate = Vector3(turns.map(|turn| turn.velocity));
        let second = Vector3(turns.map(|turn| turn.acceleration));
        if let Some(axis) = only_axis(g, turn) {
            let unit = Matrix3::identity(g).0[axis];
            let rotation = Matrix3::rotation(g, unit, turn.0[axis]);
            let [relative, growth] = [rate, second].map(|vector| axes.apply(g, vector));
            let turned = own_axes.multiply(g, rotation);
            let back = |g: &mut Graph, v: Vector3| rotation.transpose().apply(g, v);
            let (own_spin, own_growth) = own_motion(g, (root, axes), back, (rate, second));
            return Self {
                spin: own_spin,
                growth: own_growth,
                frame: root.bent(g, (turned, relative, growth), name),
                axes,
                turn: Turn::Angle(axis),
                rate,
                second,
                relative,
            };
        }
        let factor = factor(g, turn);
        g.set_name(factor, || format!("{name}_factor"));
        let half = g.scale(0.5, factor);
        let identity = Matrix3::identity(g);
        let columns = identity.0.map(|axis| {
            let once = turn.cross(g, axis);
            let twice = turn.cross(g, once).scale(g, half);
            let once = once.scale(g, factor);
            axis.add(g, once).add(g, twice)
        });
        let rotation = Matrix3(columns);
        let twist = |g: &mut Graph, rate: Vector3| {
            let half_of_it = Vector3(turn.cross(g, rate).0.map(|x| g.scale(0.5, x)));
            rate.add(g, half_of_it).scale(g, factor)
        };
        let spin = twist(g, rate);
        let growth = twist(g, second);
        let along = turn.dot(g, rate);
        let shrinking = g.mul(half, along);
        let lost = spin.scale(g, shrinking);
        let growth = growth.sub(g, lost);
        let [relative, growth] = [spin, growth].map(|vector| axes.apply(g, vector));
        let own_axes_turned = own_axes.multiply(g, rotation);
        let back = (turn.neg(g), factor, rotation.transpose());
        let back = |g: &mut Graph, v: Vector3| Turned::new(g, back, v).vector;
        let bending = bend(g, turn, rate);
        let changing = bend_change(g, turn, rate, second);
        let (own_spin, own_growth) = own_motion(g, (root, axes), back, (bending, changing));
        Self {
            spin: own_spin,
            growth: own_growth,
            frame: root.bent(g, (own_axes_turned, relative, growth), name),
            axes,
            turn: Turn::Rodrigues(turn, factor, rotation),
            rate,
            second,
            relative,
        }
    }

    /// Power of a moment per unit rate of the angle, or of each component of the Rodrigues vector:
    /// `f (m - turn x m / 2)`.
    pub(crate) fn project(&self, g: &mut Graph, moment: Vector3) -> [ExprId; 3] {
        let local_moment = self.axes.transpose().apply(g, moment);
        match self.turn {
            Turn::Angle(axis) => {
                let mut powers = [g.zero(); 3];
                powers[axis] = local_moment.0[axis];
                powers
            }
            Turn::Rodrigues(turn, factor, _) => {
                let half = Vector3(turn.cross(g, local_moment).0.map(|value| g.scale(0.5, value)));
                local_moment.sub(g, half).scale(g, factor).0
            }
        }
    }

    /// The squared cosine of half the angle by which the section has turned: zero at half a turn, where its Rodrigues
    /// vector is infinite. `None` if it turns by an angle.
    pub(crate) fn pose_margin(&self) -> Option<ExprId> {
        match self.turn {
            Turn::Angle(_) => None,
            Turn::Rodrigues(_, factor, _) => Some(factor),
        }
    }

    /// The angular velocity along the axes of the section for a rate of the angle or the Rodrigues vector.
    pub(crate) fn turning(&self, g: &mut Graph, rate: Vector3) -> Vector3 {
        match self.turn {
            Turn::Angle(_) => rate,
            Turn::Rodrigues(turn, ..) => bend(g, turn, rate),
        }
    }

    /// [`project`](Self::project) for a moment along the axes of the section.
    pub(crate) fn project_own(&self, g: &mut Graph, moment: Vector3) -> [ExprId; 3] {
        match self.turn {
            Turn::Angle(_) => moment.0,
            Turn::Rodrigues(turn, ..) => {
                let [.., x, y, z] = bend_powers(g, turn, self.rate, moment);
                [x, y, z]
            }
        }
    }
}

/// Angular velocity and acceleration of a section along its axes, from those of the root, which `back` writes along
/// them, and its own relative to the root.
fn own_motion(
    g: &mut Graph,
    (root, axes): (&FrameMotion, Matrix3),
    back: impl Fn(&mut Graph, Vector3) -> Vector3,
    (relative, growth): (Vector3, Vector3),
) -> (Vector3, Vector3) {
    let [spin, growing] = [root.angular_velocity, root.angular_acceleration].map(|vector| {
        let local = axes.transpose().apply(g, vector);
        back(g, local)
    });
    let gyroscopic = spin.cross(g, relative);
    let growth = growing.add(g, growth).add(g, gyroscopic);
    (spin.add(g, relative), growth)
}

impl StationMotion {
    fn new(
        g: &mut Graph,
        directions: &[DirectionMotion],
        section: SectionMotion,
        own_axes: Matrix3,
        reach: Vec<ExprId>,
    ) -> Self {
        let zero = Vector3::zero(g);
        let (mut offset, mut rate, mut carried, mut second) = (zero, zero, zero, zero);
        for (direction, &share) in directions.iter().zip(&reach) {
            let sums = [
                (&mut offset, direction.vector),
                (&mut rate, direction.leaving),
                (&mut carried, direction.rate),
                (&mut second, direction.second_rate),
            ];
            for (sum, term) in sums {
                let term = term.scale(g, share);
                *sum = sum.add(g, term);
            }
        }
        let frame = FrameMotion {
            offset,
            velocity: section.frame.velocity.add(g, carried),
            acceleration: section.frame.acceleration.add(g, second),
            ..section.frame
        };
        let frame = frame.rotated(g, Some(own_axes.transpose()));
        Self { section: SectionMotion { frame, ..section }, reach, velocity: rate }
    }
}
