//! Bodies as text.

use super::super::mechanism::{Part, Shape};
use super::Names;

impl Names<'_> {
    /// What a body is made of.
    pub(super) fn parts(&self, parts: &[Part]) -> String {
        if parts.is_empty() {
            return "massless".to_owned();
        }
        let mut text = String::new();
        for (index, part) in parts.iter().enumerate() {
            match (part.hole, index) {
                (false, 0) => {}
                (false, _) => text.push_str(" + "),
                (true, _) => text.push_str(" - "),
            }
            text.push_str(&self.shape(&part.shape));
            text.push_str(&self.placement(&part.placement));
        }
        text
    }

    fn shape(&self, shape: &Shape) -> String {
        let (s, v) = (|value| self.scalar(value), |vector| self.vector(vector));
        match shape {
            Shape::Point { mass, center } => format!("point mass {} at {}", s(mass), v(center)),
            Shape::Rod {
                mass,
                length,
                along,
                center,
            } => format!(
                "rod mass {} length {} along {} center {}",
                s(mass),
                s(length),
                v(along),
                v(center)
            ),
            Shape::Disk {
                mass,
                radius,
                axis,
                center,
            } => format!(
                "disk mass {} radius {} axis {} center {}",
                s(mass),
                s(radius),
                v(axis),
                v(center)
            ),
            Shape::Cylinder {
                mass,
                radius,
                length,
                axis,
                center,
            } => format!(
                "cylinder mass {} radius {} length {} axis {} center {}",
                s(mass),
                s(radius),
                s(length),
                v(axis),
                v(center)
            ),
            Shape::Tube {
                mass,
                inner,
                outer,
                length,
                axis,
                center,
            } => format!(
                "tube mass {} inner {} outer {} length {} axis {} center {}",
                s(mass),
                s(inner),
                s(outer),
                s(length),
                v(axis),
                v(center)
            ),
            Shape::Cuboid { mass, size, center } => {
                format!("box mass {} size {} center {}", s(mass), v(size), v(center))
            }
            Shape::Sphere {
                mass,
                radius,
                center,
            } => format!(
                "sphere mass {} radius {} center {}",
                s(mass),
                s(radius),
                v(center)
            ),
            Shape::Rigid {
                mass,
                center,
                inertia,
                about,
            } => {
                let inertia: Vec<String> = inertia.iter().map(s).collect();
                let about = match about {
                    Some(about) => format!(" about {}", v(about)),
                    None => String::new(),
                };
                format!(
                    "rigid mass {} center {} inertia [{}]{about}",
                    s(mass),
                    v(center),
                    inertia.join(", ")
                )
            }
        }
    }
}
