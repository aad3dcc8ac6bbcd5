//! What a user should know about how an equilibrium was found.

use eigentol_results::numbers::{given_in, with_unit};

use super::Equilibrium;

/// What a user should know about how an equilibrium was found.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Note {
    /// The start values are those of an unstable equilibrium, which therefore is the answer.
    Stays,
    /// The nearest equilibrium is this far from a start value, rad or m (rad/s or m/s for a speed).
    Far {
        /// The unknown that differs most.
        unknown: usize,
        /// How far it is from its start value.
        distance: f64,
    },
    /// It is one of a family of steady motions with this number of parameters;
    /// [`FreeDirections::held`](field@crate::free::FreeDirections::held) says what holds it, in derivatives too.
    Member {
        /// Number of parameters of the family.
        dimension: usize,
    },
    /// An unknown has another value than the start value that was given.
    OtherValue {
        /// The unknown.
        unknown: usize,
        /// Its start value, SI.
        asked: f64,
        /// Its value, SI.
        found: f64,
    },
}

impl Note {
    /// It as a sentence about the state, without a full stop.
    pub(super) fn sentence(&self, state: &Equilibrium) -> String {
        let infos = &state.description.coordinates;
        let value = |unknown: usize, value: f64| {
            let unit = &infos[unknown].unit;
            with_unit(given_in(value, unit), unit)
        };
        match self {
            Self::Stays => "Stays at the start values: they are those of an unstable equilibrium".to_owned(),
            Self::Far { unknown, distance } => format!(
                "The nearest equilibrium is {} from the start of {}",
                value(*unknown, *distance),
                infos[*unknown].name
            ),
            Self::Member { dimension } => {
                let held = state.free.held.iter();
                let held = held.map(|held| {
                    let text = value(held.unknown, state.coordinates[held.unknown]);
                    format!("{} = {text}", infos[held.unknown].name)
                });
                let parameters = match dimension {
                    1 => "one parameter".to_owned(),
                    _ => format!("{dimension} parameters"),
                };
                format!(
                    "One of a family of steady motions with {parameters}: holds {}, in derivatives too",
                    held.collect::<Vec<_>>().join(" and ")
                )
            }
            Self::OtherValue { unknown, asked, found } => format!(
                "{} is {} here, although {} was given",
                infos[*unknown].name,
                value(*unknown, *found),
                value(*unknown, *asked)
            ),
        }
    }
}
