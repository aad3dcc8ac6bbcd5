//! Equilibria and events as text.

use core::fmt;

use crate::equilibrium::{Assembly, AssemblyMode, ConstraintState, Equilibria, Note};
use crate::{Description, Equilibrium, Role, Stability, Text};
use eigentol_results::numbers::{given_in, heading, in_unit, rough_in, with_unit};
use eigentol_results::relevance::of_its_kind;
use eigentol_results::table::{Table, cells};
use eigentol_results::title::title;

impl fmt::Display for Stability {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stable => write!(f, "stable"),
            Self::Neutral { zero: 1 } => write!(f, "neutral (one free direction)"),
            Self::Neutral { zero } => write!(f, "neutral ({zero} free directions)"),
            Self::Divergent { negative } => match negative {
                1 => write!(f, "divergent (unstable in one direction)"),
                _ => write!(f, "divergent (unstable in {negative} directions)"),
            },
            Self::GyroscopicallyStabilised { negative } => write!(
                f,
                "stable by gyroscopic forces alone ({negative} directions without stiffness)"
            ),
            Self::Marginal => write!(
                f,
                "marginal (an oscillation neither grows nor decays within rounding)"
            ),
            Self::Flutter { growing } => match growing {
                1 => write!(f, "flutter (one growing oscillation)"),
                _ => write!(f, "flutter ({growing} growing oscillations)"),
            },
            Self::Undecided => write!(f, "undecided: its eigenvalues were not found"),
        }
    }
}

impl Stability {
    /// The state after "the equilibrium is", in a sentence.
    ///
    /// ```
    /// # use eigentol_solve as eigentol;
    /// use eigentol::Stability;
    ///
    /// let state = Stability::Flutter { growing: 1 }.predicate();
    /// assert_eq!(state, "unstable (flutter: one growing oscillation)");
    /// ```
    #[must_use]
    pub fn predicate(self) -> String {
        match self {
            Self::Flutter { growing: 1 } => {
                "unstable (flutter: one growing oscillation)".to_owned()
            }
            Self::Flutter { growing } => {
                format!("unstable (flutter: {growing} growing oscillations)")
            }
            Self::Divergent { negative: 1 } => "unstable in one direction (divergence)".to_owned(),
            Self::Divergent { negative } => {
                format!("unstable in {negative} directions (divergence)")
            }
            other => other.to_string(),
        }
    }
}

impl fmt::Display for Equilibrium {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        write!(f, "{}: equilibrium, ", title(d, &self.inputs))?;
        if self.constraints.singular {
            write!(f, "stability undecided in a singular configuration")?;
        } else {
            write!(f, "{}", self.stability)?;
        }
        writeln!(f)?;
        unknowns(f, d, &self.coordinates, None)?;
        redundancy(f, &self.constraints, self.dependent_constraints())?;
        for sentence in self.sentences() {
            writeln!(f, "  {sentence}.")?;
        }
        match &self.pose {
            Some(pose) if pose.margin < NEAR_SINGULAR => writeln!(
                f,
                "  {} is near its singular pose (margin {:.1e}): its coordinates are ill-conditioned",
                pose.joint, pose.margin
            ),
            _ => Ok(()),
        }
    }
}

impl fmt::Display for Equilibria {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        let title = title(d, &self.inputs);
        writeln!(
            f,
            "{title}: {}",
            counted_as(self.len(), "equilibrium", "equilibria")
        )?;
        if self.is_empty() {
            return Ok(());
        }
        let motions = || {
            let infos = d.coordinates.iter().enumerate();
            infos.filter(|(_, info)| matches!(info.role, Role::Position | Role::Speed))
        };
        let names = motions().map(|(_, info)| heading(&info.name, &info.unit));
        let mut table = Table::new(
            cells(["equilibrium"])
                .into_iter()
                .chain(names)
                .chain(cells(["state"]))
                .collect(),
        );
        for (k, state) in self.iter().enumerate() {
            let values = motions()
                .map(|(i, info)| in_unit(of_its_kind(d, &state.coordinates, i), &info.unit));
            let stability = match state.constraints.singular {
                true => "undecided in a singular configuration".to_owned(),
                false => state.stability.to_string(),
            };
            let number = [(k + 1).to_string()].into_iter();
            table.row(number.chain(values).chain([stability]).collect());
        }
        write!(f, "{table}")
    }
}

/// `1 thing`, `2 things`.
fn counted_as(number: usize, one: &str, several: &str) -> String {
    match number {
        1 => format!("1 {one}"),
        _ => format!("{number} {several}"),
    }
}

impl Equilibrium {
    /// [`Self::notes`] in words, without full stops.
    #[must_use]
    pub fn sentences(&self) -> Vec<String> {
        self.notes.iter().map(|note| said(self, note)).collect()
    }
}

/// A note as a sentence.
fn said(state: &Equilibrium, note: &Note) -> String {
    let infos = &state.description.coordinates;
    let value = |unknown: usize, value: f64| {
        let unit = &infos[unknown].unit;
        with_unit(given_in(value, unit), unit)
    };
    match note {
        Note::Stays => {
            "Stays at the start values: they are those of an unstable equilibrium".to_owned()
        }
        Note::Far { unknown, distance } => format!(
            "The nearest equilibrium is {} from the start of {}",
            value(*unknown, *distance),
            infos[*unknown].name
        ),
        Note::Member { dimension } => {
            let held = state.free.held.iter();
            let held = held.map(|held| {
                let found = value(held.unknown, state.coordinates[held.unknown]);
                format!("{} = {found}", infos[held.unknown].name)
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
        Note::OtherValue {
            unknown,
            asked,
            found,
        } => format!(
            "{} is {} here, although {} was given",
            infos[*unknown].name,
            value(*unknown, *found),
            value(*unknown, *asked)
        ),
    }
}

/// Coordinates, speeds and reactions, each with its own heading, and how far each was moved. A reaction is exerted by
/// `from` on `to`. In a long list, zeros are only counted.
fn unknowns(
    f: &mut fmt::Formatter<'_>,
    description: &Description,
    values: &[f64],
    moved: Option<&[f64]>,
) -> fmt::Result {
    let infos = &description.coordinates;
    let value = |i: usize| of_its_kind(description, values, i);
    let still = |i: &usize| value(*i) == 0.0 && moved.is_none_or(|moved| moved[*i] == 0.0);
    let zero = (0..infos.len()).filter(still).count();
    let counted = infos.len() > LISTED && zero > 0;
    let heads = |name: &str| {
        let both = [name, "value", "moved"];
        let columns = if moved.is_some() { 3 } else { 2 };
        cells(both)[..columns].to_vec()
    };
    let mut table = Table::default();
    let mut last = None;
    for (i, info) in infos.iter().enumerate() {
        if counted && still(&i) {
            continue;
        }
        let kind = match info.role {
            Role::Position => "coordinate",
            Role::Speed => "speed",
            Role::PositionReaction | Role::VelocityReaction => "reaction",
        };
        if last.replace(kind) != Some(kind) {
            table.row(heads(kind));
        }
        let mut row = vec![
            heading(&info.name, &info.unit),
            in_unit(value(i), &info.unit),
        ];
        row.extend(moved.map(|moved| rough_in(moved[i], &info.unit)));
        table.row(row);
    }
    if !table.is_empty() {
        write!(f, "{table}")?;
    }
    match counted {
        true => writeln!(
            f,
            "  Zero, within rounding: the other {zero} of {}.",
            infos.len()
        ),
        false => Ok(()),
    }
}

/// Maximum number of unknowns that are all listed.
const LISTED: usize = 12;

fn redundancy(
    f: &mut fmt::Formatter<'_>,
    state: &ConstraintState,
    dependent: impl Iterator<Item = Text>,
) -> fmt::Result {
    if state.redundant > 0 {
        let names: Vec<_> = dependent.map(|name| name.to_string()).collect();
        writeln!(
            f,
            "  {} of {} constraints redundant ({}): only combinations of their reactions are determined",
            state.redundant,
            names.len(),
            names.join(", ")
        )?;
    }
    if state.singular {
        writeln!(
            f,
            "  singular configuration: a dead centre, or where motions branch: constraints are redundant only here, so the linearised \
             mechanism does not say how it can move"
        )?;
    }
    Ok(())
}

impl fmt::Display for Assembly {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        let title = title(d, &self.inputs);
        write!(f, "{title}: assembled in {} iterations", self.iterations)?;
        match self.mode {
            Some(AssemblyMode::Positive) => write!(f, ", positive assembly mode")?,
            Some(AssemblyMode::Negative) => write!(f, ", negative assembly mode")?,
            None => {}
        }
        if self.margin < 1.0 {
            write!(f, ", margin to a dead centre {:.1e}", self.margin)?;
        }
        writeln!(f)?;
        unknowns(f, d, &self.coordinates, Some(&self.changes()))?;
        redundancy(f, &self.constraints, self.dependent_constraints())?;
        if self.singular && !self.constraints.singular {
            writeln!(
                f,
                "  dead centre: the coordinates that are not held do not follow those that are"
            )?;
        }
        Ok(())
    }
}

/// Pose margin below which a report warns.
const NEAR_SINGULAR: f64 = 0.1;
