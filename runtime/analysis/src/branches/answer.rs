//! Branches of equilibria and their special points as text and tables.

use std::{ptr, slice};

use eigentol_results::numbers::{converted, heading, number, optional};
use eigentol_results::relevance::{EVERYTHING, shown};
use eigentol_results::{Answer, Columns, Findings, Grid, Subject, Table, displayed};

use super::{Branch, BranchEnd, BranchPoint, Branches, SpecialPoint};
use crate::along::{Moving, critical_vectors, happening, heading_of, value_of, varied};
use crate::{Role, Stability};

/// A row for each equilibrium of a branch, with the branch number, counted from 1.
///
/// Branches can be written one after the other: all have the same columns.
#[must_use]
pub fn branch_table(number: usize, branch: &Branch) -> Table {
    let branches = slice::from_ref(branch);
    let rows = points(number, branches);
    let mut table = point_columns(branch, &rows, Vec::new(), &moving(branch, branches)).finish().0;
    table.operating_point(&branch.description, branch.inputs(), Some(branch.input));
    table
}

/// `branches`: a row for each equilibrium; `special points`: a row for each, if any.
impl Answer for Branch {
    const KIND: &'static str = "branch";

    fn subject(&self) -> Option<Subject<'_>> {
        Some(Subject::along(&self.description, self.inputs(), self.input))
    }

    fn findings(&self) -> Findings {
        let count = self.points.len();
        let [first, last] = &self.ends;
        let mut said = self.titled(format_args!("branch of {count} equilibria; begins: {first}; ends: {last}"));
        let branches = slice::from_ref(self);
        let (moving, points) = (moving(self, branches), points(1, branches));
        let rows = self.rows_shown();
        let left_out = rows.len() < count;
        let told = format!("{} of {count} equilibria are shown: {EVERYTHING}.", rows.len());
        said.columns(point_columns(self, &points, rows, &moving));
        moving.rest(&mut said);
        if left_out {
            said.note(told);
        }
        let special = special(branches);
        let rows = (0..special.len()).collect();
        special_columns(&mut said, self, &special, rows, &moving);
        said
    }
}

/// `branches`: a row for each equilibrium of each branch; `special points`: a row for each fold and fork, if any.
impl Answer for Branches {
    const KIND: &'static str = "branches";

    fn subject(&self) -> Option<Subject<'_>> {
        self.branches.first()?.subject()
    }

    /// The text has one row per stretch of constant stability.
    fn findings(&self) -> Findings {
        let Some(one) = self.branches.first() else {
            return Findings::titled("no branches".to_owned());
        };
        let count = self.branches.len();
        let mut said = self.titled(format_args!("{count} {}", branches_word(count)));
        let moving = moving(one, &self.branches);
        said.text(stretches(one, &self.branches, &moving));
        moving.rest(&mut said);
        let points = points(1, &self.branches);
        said.data(point_columns(one, &points, Vec::new(), &moving).finish().0);
        let (special, distinct) = (special(&self.branches), self.special());
        let known = |k: &usize| distinct.iter().any(|x| ptr::eq(*x, special[*k].1));
        let rows = (0..special.len()).filter(known).collect();
        special_columns(&mut said, one, &special, rows, &moving);
        for (ends, branches) in self.ends() {
            let word = branches_word(branches.len());
            said.note(format!("{word} {}: {ends}", branches.join(", ")));
        }
        let stopped = |branch: &Branch| branch.ends.contains(&BranchEnd::Stopped);
        if self.branches.iter().any(stopped) {
            said.note("stopped: there may be more");
        } else if self.truncated {
            said.note("there are more branches: the limit was reached");
        }
        said
    }
}

/// `special points`: one row.
impl Answer for SpecialPoint {
    const KIND: &'static str = "special point";

    fn subject(&self) -> Option<Subject<'_>> {
        let at = &self.equilibrium;
        Some(Subject::along(&at.description, &at.inputs, self.input))
    }

    fn findings(&self) -> Findings {
        let d = &self.equilibrium.description;
        let what = |place| format!("{} at {place}", self.kind);
        let mut said = happening(&self.equilibrium, self.input, self.value, what);
        critical_vectors(&mut said, d, &self.v, &self.w);
        let mut table = Columns::new("special points", slice::from_ref(self));
        table.words("kind", &|row| Some(row.kind.to_string()));
        varied(&mut table, d, self.input, number, &|x| x.value);
        table.unknowns(d, &|row| Some(&row.equilibrium.coordinates[..]));
        said.data(table.finish().0);
        said
    }
}

displayed!(Branch, Branches, SpecialPoint);

impl Branch {
    /// The inputs, SI; all but the varied one keep their values.
    fn inputs(&self) -> &[f64] {
        self.points.first().map_or(&[], |point| &point.equilibrium.inputs)
    }

    /// Some points at equal intervals, and both sides of each change of stability.
    fn rows_shown(&self) -> Vec<usize> {
        let stability = |k: usize| self.points[k].equilibrium.stability;
        let changes = (1..self.points.len()).filter(|&k| stability(k) != stability(k - 1));
        let mut rows = shown(self.points.len());
        rows.extend(changes.flat_map(|k| [k - 1, k]));
        rows.sort_unstable();
        rows.dedup();
        rows
    }
}

impl Branches {
    /// How branches end, each pair of ends once, with the numbers of the branches that have it.
    fn ends(&self) -> Vec<(String, Vec<String>)> {
        let mut said: Vec<(String, Vec<String>)> = Vec::new();
        for (k, branch) in self.branches.iter().enumerate() {
            let [first, last] = &branch.ends;
            let (text, number) = (format!("{first} to {last}"), (k + 1).to_string());
            match said.iter_mut().find(|(known, _)| *known == text) {
                Some((_, numbers)) => numbers.push(number),
                None => said.push((text, vec![number])),
            }
        }
        said
    }
}

fn branches_word(count: usize) -> &'static str {
    if count == 1 { "branch" } else { "branches" }
}

/// The coordinates and speeds that move; the text leaves reactions to the tables.
fn moving<'a>(one: &'a Branch, branches: &[Branch]) -> Moving<'a> {
    let states = branches.iter().flat_map(|branch| &branch.points).map(|point| &point.equilibrium);
    Moving::of(&one.description, states, &[Role::Position, Role::Speed])
}

/// Points with the number of their branch, counted from `first`.
fn points(first: usize, branches: &[Branch]) -> Vec<(usize, &BranchPoint)> {
    branches
        .iter()
        .zip(first..)
        .flat_map(|(branch, number)| branch.points.iter().map(move |point| (number, point)))
        .collect()
}

/// Special points with the number of their branch, counted from 1.
fn special(branches: &[Branch]) -> Vec<(usize, &SpecialPoint)> {
    branches
        .iter()
        .zip(1..)
        .flat_map(|(branch, number)| branch.special.iter().map(move |point| (number, point)))
        .collect()
}

/// A row for each point; `one` is any branch of the same mechanism.
fn point_columns<'a>(
    one: &Branch,
    points: &'a [(usize, &'a BranchPoint)],
    shown: Vec<usize>,
    moving: &Moving<'_>,
) -> Columns<'a, (usize, &'a BranchPoint)> {
    let d = &one.description;
    let mut table = Columns::new("branches", points);
    table.show_rows(shown);
    table.whole("branch", &|(branch, _)| Some(*branch));
    varied(&mut table, d, one.input, number, &|(_, x)| x.value);
    table.unknowns(d, &|(_, x)| Some(&x.equilibrium.coordinates[..]));
    moving.columns(&mut table, &|(_, x)| Some(&x.equilibrium));
    for (k, info) in d.outputs.iter().enumerate() {
        table.measured(&info.name, &info.unit, &|(_, x)| x.outputs.get(k).copied()).digits(number);
    }
    table.words("stability", &|(_, item)| Some(item.equilibrium.stability_word())).shown().headed("state");
    table
}

/// A row for each special point, if any.
fn special_columns(
    said: &mut Findings,
    one: &Branch,
    points: &[(usize, &SpecialPoint)],
    shown: Vec<usize>,
    moving: &Moving<'_>,
) {
    if points.is_empty() {
        return;
    }
    let d = &one.description;
    let mut table = Columns::new("special points", points);
    table.show_rows(shown);
    table.whole("branch", &|(branch, _)| Some(*branch));
    table.words("kind", &|(_, x)| Some(x.kind.to_string())).shown().headed("special point");
    varied(&mut table, d, one.input, number, &|(_, x)| x.value);
    table.cells("state", &|(_, x)| x.equilibrium.stability_word());
    table.unknowns(d, &|(_, x)| Some(&x.equilibrium.coordinates[..]));
    moving.columns(&mut table, &|(_, x)| Some(&x.equilibrium));
    said.columns(table);
}

/// A stretch of constant stability: the number of its branch if it is the first of it, and both ends.
struct Stretch<'a> {
    number: Option<usize>,
    stability: Stability,
    ends: [&'a BranchPoint; 2],
}

impl<'a> Stretch<'a> {
    fn all(branches: &'a [Branch]) -> Vec<Self> {
        branches
            .iter()
            .zip(1..)
            .flat_map(|(branch, number)| {
                let runs = branch.stretches().into_iter().enumerate();
                runs.filter_map(move |(i, (stability, run))| {
                    Some(Self { number: (i == 0).then_some(number), stability, ends: [run.first()?, run.last()?] })
                })
            })
            .collect()
    }
}

/// A row for each stretch.
fn stretches(one: &Branch, branches: &[Branch], moving: &Moving<'_>) -> Grid {
    let (d, input) = (&one.description, one.input);
    let rows = Stretch::all(branches);
    let mut table = Columns::new("stretches", &rows);
    table.cells("branch", &|row| row.number.map(|number| number.to_string()).unwrap_or_default());
    for (k, end) in ["from", "to"].into_iter().enumerate() {
        let heading = format!("{end} {}", heading_of(d, input));
        table.cells(&heading, &|row| value_of(d, input, row.ends[k].value));
    }
    table.cells("state", &|row| row.stability.to_string());
    moving.columns_from_to(&mut table, &|x| x.ends.map(|end| &end.equilibrium));
    for (k, info) in d.outputs.iter().enumerate() {
        let at = |end: &BranchPoint| optional(end.outputs.get(k).map(|value| converted(*value, &info.unit)));
        table.cells(&heading(&info.name, &info.unit), &|row| at(row.ends[0]));
        table.cells("to", &|row| at(row.ends[1]));
    }
    table.finish().1
}
