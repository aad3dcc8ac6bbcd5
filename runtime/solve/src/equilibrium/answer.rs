//! What equilibria and assemblies say.

use eigentol_results::columns::Columns;
use eigentol_results::grid::{Grid, cells};
use eigentol_results::numbers::{heading, in_unit, rough_in};
use eigentol_results::relevance::of_its_kind;
use eigentol_results::{Answer, Findings, at_point, displayed};

use super::{Assembly, AssemblyMode, ConstraintState, Equilibria};
use crate::{Description, Equilibrium, Role, Text};

/// Pose margin below which a text warns.
const NEAR_SINGULAR: f64 = 0.1;

/// Maximum number of unknowns that are all listed.
const LISTED: usize = 12;

displayed!(Equilibrium, Equilibria, Assembly);

/// `equilibrium`: one row, a column for each unknown.
impl Answer for Equilibrium {
    const KIND: &'static str = "equilibrium";

    at_point!();

    fn findings(&self) -> Findings {
        let d = &self.description;
        let stability = if self.constraints.singular {
            format!("stability {}", self.stability_word())
        } else {
            self.stability_word()
        };
        let mut said = self.titled(format_args!("equilibrium, {stability}"));
        said.columns(states("equilibrium", d, &[(0, self)]));
        unknowns(&mut said, d, &self.coordinates, None);
        redundancy(&mut said, &self.constraints, self.dependent_constraints());
        for sentence in self.sentences() {
            said.note(format!("{sentence}."));
        }
        if let Some(pose) = self.pose.as_ref().filter(|pose| pose.margin < NEAR_SINGULAR) {
            said.note(format!(
                "{} is near its singular pose (margin {:.1e}): its coordinates are ill-conditioned",
                pose.joint, pose.margin
            ));
        }
        said
    }
}

/// `equilibria`: a row for each.
impl Answer for Equilibria {
    const KIND: &'static str = "equilibria";

    at_point!();

    fn findings(&self) -> Findings {
        let d = &self.description;
        let count = match self.len() {
            1 => "1 equilibrium".to_owned(),
            several => format!("{several} equilibria"),
        };
        let mut said = self.titled(count);
        if self.is_empty() {
            return said;
        }
        let rows: Vec<_> = self.iter().enumerate().collect();
        let mut table = states("equilibria", d, &rows);
        table.cells("equilibrium", &|row| (row.0 + 1).to_string());
        for (i, info) in d.coordinates.iter().enumerate() {
            if matches!(info.role, Role::Position | Role::Speed) {
                table.cells(&heading(&info.name, &info.unit), &|row| {
                    in_unit(of_its_kind(d, &row.1.coordinates, i), &info.unit)
                });
            }
        }
        table.cells("state", &|row| row.1.stability_word());
        said.columns(table);
        if self.more_expected {
            said.note(format!("From {} starts; more equilibria are to be expected from more starts.", self.starts));
        }
        said
    }
}

/// The data of states: unknowns, stability.
fn states<'a, 'b>(
    name: &str,
    description: &Description,
    rows: &'a [(usize, &'b Equilibrium)],
) -> Columns<'a, (usize, &'b Equilibrium)> {
    let mut table = Columns::new(name, rows);
    table.unknowns(description, &|row| Some(&row.1.coordinates[..]));
    table.words("stability", &|row| Some(row.1.stability_word()));
    table.number("relative residual", "", &|row| Some(row.1.relative_residual));
    table
}

/// `assembly`: one row, a column for each unknown.
impl Answer for Assembly {
    const KIND: &'static str = "assembly";

    at_point!();

    fn findings(&self) -> Findings {
        let d = &self.description;
        let mut said = self.titled(self.how());
        let rows = [self];
        let mut table = Columns::new("assembly", &rows);
        table.unknowns(d, &|row| Some(&row.coordinates[..]));
        table.number("margin to dead centre", "", &|row| Some(row.margin));
        table.flag("singular", &|row| Some(row.singular || row.constraints.singular));
        said.columns(table);
        unknowns(&mut said, d, &self.coordinates, Some(&self.changes()));
        redundancy(&mut said, &self.constraints, self.dependent_constraints());
        if self.singular && !self.constraints.singular {
            said.note("dead centre: the coordinates that are not held do not follow those that are");
        }
        said
    }
}

impl Assembly {
    /// How it was assembled.
    fn how(&self) -> String {
        let mode = match self.mode {
            Some(AssemblyMode::Positive) => ", positive assembly mode",
            Some(AssemblyMode::Negative) => ", negative assembly mode",
            None => "",
        };
        let margin =
            if self.margin < 1.0 { format!(", margin to a dead centre {:.1e}", self.margin) } else { String::new() };
        let iterations = self.iterations;
        format!("assembled in {iterations} iterations{mode}{margin}")
    }
}

/// Coordinates, speeds and reactions, each with its own heading, and how far each was moved. A reaction is exerted by
/// `from` on `to`. In a long list, zeros are only counted.
fn unknowns(said: &mut Findings, description: &Description, values: &[f64], moved: Option<&[f64]>) {
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
    let mut table = Grid::default();
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
        let mut row = vec![heading(&info.name, &info.unit), in_unit(value(i), &info.unit)];
        row.extend(moved.map(|moved| rough_in(moved[i], &info.unit)));
        table.row(row);
    }
    said.text(table);
    if counted {
        let all = infos.len();
        said.note(format!("Zero, within rounding: the other {zero} of {all}."));
    }
}

/// Says which constraints are redundant, and whether only here.
fn redundancy(said: &mut Findings, state: &ConstraintState, dependent: impl Iterator<Item = Text>) {
    if state.redundant > 0 {
        let names: Vec<_> = dependent.map(|name| name.to_string()).collect();
        said.note(format!(
            "{} of {} constraints redundant ({}): only combinations of their reactions are determined",
            state.redundant,
            names.len(),
            names.join(", ")
        ));
    }
    if state.singular {
        said.note(
            "singular configuration: a dead centre, or where motions branch: constraints are redundant only here, so the linearised \
             mechanism does not say how it can move",
        );
    }
}
