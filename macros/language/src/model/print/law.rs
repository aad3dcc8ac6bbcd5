//! Force laws as text.

use super::super::mechanism::ForceLaw;
use super::Names;
use crate::base::ids::{CoordinateId, PointId};

impl Names<'_> {
    pub(super) fn law(&self, law: &ForceLaw) -> String {
        let (s, v) = (|value| self.scalar(value), |vector| self.vector(vector));
        let m = |matrix| self.matrix(matrix);
        let coordinate = |id: &CoordinateId| &self.0.coordinates[id.index()].name;
        let point = |id: &PointId| &self.0.points[id.index()].name;
        match law {
            ForceLaw::CoordinateSpring { coordinate: on, stiffness, rest } => {
                format!("spring on {} stiffness {} rest {}", coordinate(on), s(stiffness), s(rest))
            }
            ForceLaw::CoordinateDamper { coordinate: on, damping } => {
                format!("damper on {} damping {}", coordinate(on), s(damping))
            }
            ForceLaw::CoordinateInerter { coordinates: [on, with], inertance } if on == with => {
                format!("inerter on {} inertance {}", coordinate(on), s(inertance))
            }
            ForceLaw::CoordinateInerter { coordinates: [on, with], inertance } => {
                format!("inerter on {} and {} inertance {}", coordinate(on), coordinate(with), s(inertance))
            }
            ForceLaw::SpringDamper { from, to, stiffness, damping, length } => format!(
                "spring_damper from {} to {} stiffness {} damping {} length {}",
                point(from),
                point(to),
                s(stiffness),
                s(damping),
                s(length)
            ),
            ForceLaw::Tension { from, to, tension } => {
                format!("tension from {} to {} law {}", point(from), point(to), s(tension))
            }
            ForceLaw::Generalized { coordinate: on, value } => {
                format!("generalized on {} value {}", coordinate(on), s(value))
            }
            ForceLaw::Potential { energy } => format!("potential energy {}", s(energy)),
            ForceLaw::Bushing { from, to, stiffness, damping, turning_stiffness, turning_damping } => format!(
                "bushing from {} to {} stiffness {} damping {} turning_stiffness {} turning_damping {}",
                point(from),
                point(to),
                m(stiffness),
                m(damping),
                m(turning_stiffness),
                m(turning_damping)
            ),
            ForceLaw::Load { point: at, force, moment, following } => format!(
                "{} at {} force {} moment {}",
                if *following { "follower" } else { "load" },
                point(at),
                v(force),
                v(moment)
            ),
            ForceLaw::Distributed { on, force, follower, damping } => {
                format!("distributed on {on} force {} follower {} damping {}", v(force), v(follower), s(damping))
            }
            ForceLaw::Drag { point: at, damping, turning_damping } => {
                format!("drag at {} damping {} turning_damping {}", point(at), s(damping), s(turning_damping))
            }
        }
    }
}
