//! Excitations as text.

use super::super::mechanism::{Deviation, Excitation, ExcitationLaw, Frequency, ShakenBy};
use super::Names;
use crate::base::ids::CoordinateId;

impl Names<'_> {
    pub(super) fn excitation(&self, excitation: &Excitation) -> String {
        let (s, v) = (|value| self.scalar(value), |vector| self.vector(vector));
        let coordinate = |id: &CoordinateId| &self.0.coordinates[id.index()].name;
        let law = match &excitation.law {
            ExcitationLaw::Unbalance { body, at, deviation } => {
                let (word, value) = match deviation {
                    Deviation::Amount(value) => ("amount", value),
                    Deviation::Eccentricity(value) => ("eccentricity", value),
                    Deviation::Tilt(value) => ("tilt", value),
                };
                let body = &self.0.bodies[body.index()].name;
                format!("unbalance on {body} at {} {word} {}", v(at), s(value))
            }
            ExcitationLaw::Load { point, force, moment } => {
                format!("harmonic at {} force {} moment {}", self.0.points[point.index()].name, v(force), v(moment))
            }
            ExcitationLaw::Generalized { coordinate: on, value } => {
                format!("harmonic on {} value {}", coordinate(on), s(value))
            }
            ExcitationLaw::Shaken { coordinate: on, measure, amplitude } => {
                let word = match measure {
                    ShakenBy::Displacement => "amplitude",
                    ShakenBy::Velocity => "velocity",
                    ShakenBy::Acceleration => "acceleration",
                };
                format!("shaken {} {word} {}", coordinate(on), s(amplitude))
            }
        };
        let frequency = match &excitation.frequency {
            Frequency::Own(value) => format!(" frequency {}", s(value)),
            Frequency::Order(order, of) => format!(" order {} of {}", s(order), coordinate(of)),
            Frequency::OfTurning => String::new(),
        };
        format!("{law}{frequency} phase {}", s(&excitation.phase))
    }
}
