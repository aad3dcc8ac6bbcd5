//! Branches of equilibria as text.

use core::fmt;

use super::table::{Table, cells, heading, in_unit, number};
use super::title::title_along;
use crate::branches::{Branch, BranchEnd, Branches, SpecialKind, SpecialPoint};
use crate::{Description, Input};

impl fmt::Display for SpecialKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Fold => "fold",
            Self::Pitchfork {
                supercritical: Some(true),
            } => "supercritical pitchfork",
            Self::Pitchfork {
                supercritical: Some(false),
            } => "subcritical pitchfork",
            Self::Pitchfork {
                supercritical: None,
            } => "pitchfork",
            Self::Transcritical => "transcritical",
            Self::Degenerate => "degenerate",
        })
    }
}

impl fmt::Display for BranchEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Low => write!(f, "low end of the range"),
            Self::High => write!(f, "high end of the range"),
            Self::BranchPoint => write!(f, "branch point"),
            Self::Closed => write!(f, "closed"),
            Self::Escape => write!(f, "infinity"),
            Self::Domain(error) => write!(f, "edge of the domain: {error}"),
            Self::PointLimit => write!(f, "limit of the number of points"),
            Self::Lost(error) => write!(f, "lost: {error}"),
        }
    }
}

/// The mechanism and the inputs that keep their value.
fn branch_title(branch: &Branch) -> String {
    let inputs = branch.points.first().map(|one| &one.equilibrium.inputs[..]);
    title_along(
        &branch.description,
        inputs.unwrap_or_default(),
        branch.input,
    )
}

fn input_heading(d: &Description, input: Input) -> String {
    d.inputs
        .get(input.index())
        .map_or_else(String::new, |info| heading(&info.name, &info.unit))
}

fn input_value(d: &Description, input: Input, value: f64) -> String {
    d.inputs
        .get(input.index())
        .map_or_else(|| number(value), |info| in_unit(value, &info.unit))
}

fn coordinate_headings(d: &Description) -> impl Iterator<Item = String> + use<'_> {
    d.coordinates
        .iter()
        .map(|info| heading(&info.name, &info.unit))
}

fn coordinate_values(d: &Description, q: &[f64]) -> impl Iterator<Item = String> {
    d.coordinates
        .iter()
        .zip(q)
        .map(|(info, &value)| in_unit(value, &info.unit))
}

/// Critical vectors by coordinate; the left one where it is another.
pub(super) fn critical_vectors(
    f: &mut fmt::Formatter<'_>,
    d: &Description,
    v: &[f64],
    w: &[f64],
) -> fmt::Result {
    let mut table = Table::new(cells(["coordinate", "critical mode v", "left vector w"]));
    for ((info, &v), &w) in d.coordinates.iter().zip(v).zip(w) {
        table.row(vec![info.name.to_string(), number(v), number(w)]);
    }
    write!(f, "{table}")
}

impl fmt::Display for SpecialPoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.equilibrium.description;
        let value = input_value(d, self.input, self.value);
        let info = d.inputs.get(self.input.index());
        let (name, unit) = info.map_or(("?", ""), |info| (&*info.name, &*info.unit.symbol));
        let title = title_along(d, &self.equilibrium.inputs, self.input);
        writeln!(f, "{title}: {} at {name} = {value} {unit}", self.kind)?;
        write!(f, "{}", self.equilibrium)?;
        critical_vectors(f, d, &self.v, &self.w)
    }
}

fn special_table<'a>(
    d: &Description,
    points: impl Iterator<Item = &'a SpecialPoint>,
) -> Option<Table> {
    let mut points = points.peekable();
    let input = points.peek()?.input;
    let mut head = vec!["special point".to_owned(), input_heading(d, input)];
    head.extend(coordinate_headings(d));
    head.push("state".to_owned());
    let mut table = Table::new(head);
    for point in points {
        let state = &point.equilibrium;
        let mut row = vec![
            point.kind.to_string(),
            input_value(d, point.input, point.value),
        ];
        row.extend(coordinate_values(d, &state.coordinates));
        row.push(state.stability.to_string());
        table.row(row);
    }
    Some(table)
}

impl fmt::Display for Branch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        let [first, last] = &self.ends;
        writeln!(
            f,
            "{}: branch of {} equilibria; begins: {first}; ends: {last}",
            branch_title(self),
            self.points.len()
        )?;
        let mut head = vec![input_heading(d, self.input)];
        head.extend(coordinate_headings(d));
        head.push("state".to_owned());
        let mut table = Table::new(head);
        for point in &self.points {
            let state = &point.equilibrium;
            let mut row = vec![input_value(d, self.input, point.value)];
            row.extend(coordinate_values(d, &state.coordinates));
            row.push(state.stability.to_string());
            table.row(row);
        }
        write!(f, "{table}")?;
        special_table(d, self.special.iter()).map_or(Ok(()), |table| write!(f, "{table}"))
    }
}

impl fmt::Display for Branches {
    /// One row for each stretch of one stability, then the special points.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(one) = self.branches.first() else {
            return writeln!(f, "no branches");
        };
        let d = &one.description;
        writeln!(f, "{}: {} branches", branch_title(one), self.branches.len())?;
        let mut head = vec!["branch".to_owned()];
        for end in ["from", "to"] {
            head.push(format!("{end} {}", input_heading(d, one.input)));
            head.extend(coordinate_headings(d));
        }
        head.push("state".to_owned());
        let mut table = Table::new(head);
        for (k, branch) in self.branches.iter().enumerate() {
            for (i, (stability, run)) in branch.stretches().into_iter().enumerate() {
                let mut row = vec![if i == 0 {
                    format!("{}", k + 1)
                } else {
                    String::new()
                }];
                for point in run.first().into_iter().chain(run.last()) {
                    row.push(input_value(d, branch.input, point.value));
                    row.extend(coordinate_values(d, &point.equilibrium.coordinates));
                }
                row.push(stability.to_string());
                table.row(row);
            }
        }
        write!(f, "{table}")?;
        if let Some(table) = special_table(d, self.special().into_iter()) {
            write!(f, "{table}")?;
        }
        for (k, branch) in self.branches.iter().enumerate() {
            let [first, last] = &branch.ends;
            writeln!(f, "  branch {}: {first} to {last}", k + 1)?;
        }
        if self.truncated {
            writeln!(f, "  there are more branches: the limit was reached")?;
        }
        Ok(())
    }
}
