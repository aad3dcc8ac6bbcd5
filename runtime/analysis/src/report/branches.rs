//! Branches of equilibria as text.

use core::fmt;

use crate::branches::{Branch, BranchEnd, BranchPoint, Branches, SpecialKind, SpecialPoint};
use crate::{Description, Equilibrium, Input, Role};
use eigentol_results::numbers::{heading, in_unit, number, rough, with_unit};
use eigentol_results::relevance::{
    EVERYTHING, largest, names, of_its_kind, shown, unless_rounding,
};
use eigentol_results::table::{Table, cells};
use eigentol_results::title::title_along;

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
            Self::PointLimit => write!(f, "limit on the number of points"),
            Self::Stopped => write!(f, "stopped"),
            Self::Lost(error) => write!(f, "lost: {error}"),
        }
    }
}

/// The mechanism and the inputs that keep their values.
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

/// The coordinates and speeds that are nonzero somewhere. Reactions are in the tables.
struct Moving<'a> {
    description: &'a Description,
    columns: Vec<usize>,
    still: Vec<&'a str>,
}

impl<'a> Moving<'a> {
    fn of<'b>(d: &'a Description, states: impl Iterator<Item = &'b Equilibrium> + Clone) -> Self {
        let infos = d.coordinates.iter().enumerate();
        let moves = |role: Role| matches!(role, Role::Position | Role::Speed);
        let all = infos.filter(|(_, info)| moves(info.role)).map(|(i, _)| i);
        let (columns, still): (Vec<usize>, Vec<usize>) = all.partition(|&i| {
            let mut states = states.clone();
            states.any(|state| of_its_kind(d, &state.coordinates, i) != 0.0)
        });
        let still = still.into_iter().map(|i| &*d.coordinates[i].name);
        Self {
            description: d,
            columns,
            still: still.collect(),
        }
    }

    fn headings(&self) -> impl Iterator<Item = String> {
        let infos = self
            .columns
            .iter()
            .map(|&i| &self.description.coordinates[i]);
        infos.map(|info| heading(&info.name, &info.unit))
    }

    fn values(&self, q: &[f64]) -> impl Iterator<Item = String> {
        self.columns.iter().map(|&i| {
            let unit = &self.description.coordinates[i].unit;
            in_unit(of_its_kind(self.description, q, i), unit)
        })
    }

    fn rest(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.still.is_empty() {
            return Ok(());
        }
        writeln!(
            f,
            "  zero everywhere: {}",
            names(&self.still, "coordinates")
        )
    }
}

/// Critical vectors by coordinate; the left one only if it differs.
pub(super) fn critical_vectors(
    f: &mut fmt::Formatter<'_>,
    d: &Description,
    v: &[f64],
    w: &[f64],
) -> fmt::Result {
    let most = [v, w].map(|vector| largest(vector.iter().copied()));
    let both = [v, w].map(|vector| vector.to_vec());
    let mut table = Table::new(cells(["coordinate", "critical mode v", "left vector w"]));
    let mut zero = 0;
    for (i, info) in d.coordinates.iter().enumerate() {
        let [Some(v), Some(w)] = [0, 1].map(|k: usize| {
            let own = both[k].get(i)?;
            Some(unless_rounding(*own, most[k]))
        }) else {
            continue;
        };
        if v == 0.0 && w == 0.0 {
            zero += 1;
            continue;
        }
        table.row(vec![info.name.to_string(), rough(v), rough(w)]);
    }
    write!(f, "{table}")?;
    match zero {
        0 => Ok(()),
        _ => writeln!(f, "  Zero: the other {zero} of {}.", d.coordinates.len()),
    }
}

impl fmt::Display for SpecialPoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.equilibrium.description;
        let value = input_value(d, self.input, self.value);
        let info = d.inputs.get(self.input.index());
        let (name, value) = match info {
            Some(info) => (&*info.name, with_unit(value, &info.unit)),
            None => ("?", value),
        };
        let title = title_along(d, &self.equilibrium.inputs, self.input);
        writeln!(f, "{title}: {} at {name} = {value}", self.kind)?;
        write!(f, "{}", self.equilibrium)?;
        critical_vectors(f, d, &self.v, &self.w)
    }
}

fn special_table<'a>(
    moving: &Moving<'_>,
    points: impl Iterator<Item = &'a SpecialPoint>,
) -> Option<Table> {
    let d = moving.description;
    let mut points = points.peekable();
    let input = points.peek()?.input;
    let mut head = vec![
        "special point".to_owned(),
        input_heading(d, input),
        "state".to_owned(),
    ];
    head.extend(moving.headings());
    let mut table = Table::new(head);
    for point in points {
        let state = &point.equilibrium;
        let mut row = vec![
            point.kind.to_string(),
            input_value(d, point.input, point.value),
            state.stability.to_string(),
        ];
        row.extend(moving.values(&state.coordinates));
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
        let moving = Moving::of(d, self.points.iter().map(|point| &point.equilibrium));
        let mut head = vec![input_heading(d, self.input)];
        head.extend(moving.headings());
        head.push("state".to_owned());
        let mut table = Table::new(head);
        let mut rows = shown(self.points.len());
        let stability = |k: usize| self.points[k].equilibrium.stability;
        for k in 1..self.points.len() {
            if stability(k) != stability(k - 1) {
                rows.extend([k - 1, k]);
            }
        }
        rows.sort_unstable();
        rows.dedup();
        for point in rows.iter().map(|&row| &self.points[row]) {
            let state = &point.equilibrium;
            let mut row = vec![input_value(d, self.input, point.value)];
            row.extend(moving.values(&state.coordinates));
            row.push(state.stability.to_string());
            table.row(row);
        }
        write!(f, "{table}")?;
        moving.rest(f)?;
        if rows.len() < self.points.len() {
            let (rows, all) = (rows.len(), self.points.len());
            writeln!(f, "  {rows} of {all} equilibria are shown: {EVERYTHING}.")?;
        }
        special_table(&moving, self.special.iter()).map_or(Ok(()), |table| write!(f, "{table}"))
    }
}

impl fmt::Display for Branches {
    /// One row per stretch of constant stability, then the special points.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(one) = self.branches.first() else {
            return writeln!(f, "no branches");
        };
        let d = &one.description;
        let count = self.branches.len();
        let word = if count == 1 { "branch" } else { "branches" };
        writeln!(f, "{}: {count} {word}", branch_title(one))?;
        let every = self.branches.iter().flat_map(|branch| &branch.points);
        let moving = Moving::of(d, every.map(|point| &point.equilibrium));
        let mut head = vec!["branch".to_owned()];
        head.extend(["from", "to"].map(|end| format!("{end} {}", input_heading(d, one.input))));
        head.push("state".to_owned());
        head.extend(
            moving
                .headings()
                .flat_map(|heading| [heading, "to".to_owned()]),
        );
        let mut table = Table::new(head);
        for (k, branch) in self.branches.iter().enumerate() {
            for (i, (stability, run)) in branch.stretches().into_iter().enumerate() {
                let (Some(first), Some(last)) = (run.first(), run.last()) else {
                    continue;
                };
                let number = if i == 0 {
                    (k + 1).to_string()
                } else {
                    String::new()
                };
                let value = |point: &BranchPoint| input_value(d, branch.input, point.value);
                let mut row = vec![number, value(first), value(last), stability.to_string()];
                let from = moving.values(&first.equilibrium.coordinates);
                let to = moving.values(&last.equilibrium.coordinates);
                row.extend(from.zip(to).flat_map(|(from, to)| [from, to]));
                table.row(row);
            }
        }
        write!(f, "{table}")?;
        moving.rest(f)?;
        if let Some(table) = special_table(&moving, self.special().into_iter()) {
            write!(f, "{table}")?;
        }
        let mut said: Vec<(String, Vec<String>)> = Vec::new();
        for (k, branch) in self.branches.iter().enumerate() {
            let [first, last] = &branch.ends;
            let text = format!("{first} to {last}");
            match said.iter_mut().find(|(known, _)| *known == text) {
                Some((_, own)) => own.push((k + 1).to_string()),
                None => said.push((text, vec![(k + 1).to_string()])),
            }
        }
        for (text, own) in said {
            let word = if own.len() == 1 { "branch" } else { "branches" };
            writeln!(f, "  {word} {}: {text}", own.join(", "))?;
        }
        let stopped = |branch: &Branch| branch.ends.contains(&BranchEnd::Stopped);
        if self.branches.iter().any(stopped) {
            writeln!(f, "  stopped: there may be more")?;
        } else if self.truncated {
            writeln!(f, "  there are more branches: the limit was reached")?;
        }
        Ok(())
    }
}
