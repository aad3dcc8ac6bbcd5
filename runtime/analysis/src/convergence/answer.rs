//! What a comparison with more coordinates says.

use eigentol_results::naming::{capital, named};
use eigentol_results::numbers::{converted, heading, number, short};
use eigentol_results::relevance::{RELEVANT, largest, names};
use eigentol_results::{Answer, Columns, Findings, at_point, displayed};

use super::{Change, Convergence};

displayed!(Convergence);

/// `convergence`: a row for each answer, its value in its unit, relative changes.
impl Answer for Convergence {
    const KIND: &'static str = "convergence";

    at_point!();

    fn findings(&self) -> Findings {
        let d = &self.description;
        let mut said = self.titled("changes with more coordinates of each component of a beam");
        let mut table = Columns::new("convergence", &self.changes);
        table.words("answer", &|row| Some(row.answer.name(d)));
        table.words("unit", &|row| Some(row.answer.unit(d).symbol.to_string()));
        let shown = |row: &Change| match row.answer.unit(d) {
            unit if &*unit.symbol == "rad/s" => d.frequency.clone(),
            unit => unit,
        };
        table.cells("answer", &|row| heading(&row.answer.name(d), &shown(row)));
        table.number("as declared", "", &|row| Some(converted(row.value, &row.answer.unit(d))));
        table.cells("as declared", &|row| number(converted(row.value, &shown(row))));
        for (k, name) in ["change with 1 more", "change with 2 more"].into_iter().enumerate() {
            table.number(name, "", &|row| row.relative[k]).digits(short);
        }
        said.columns(table);
        for verdict in [self.of_modes(), self.of_others()].into_iter().flatten() {
            said.note(verdict);
        }
        if let Some(error) = &self.without_peaks {
            said.note(format!("Peaks are not compared: {error}"));
        }
        said
    }
}

/// Number of answers whose large changes are told one by one.
const TOLD: usize = 3;

impl Convergence {
    /// Which modes are known well, and how far the others change.
    fn of_modes(&self) -> Option<String> {
        let mut modes: Vec<(usize, f64)> = Vec::new();
        for change in &self.changes {
            let (Some(mode), most) = (change.mode(), change.most()) else {
                continue;
            };
            match modes.last_mut() {
                Some((last, greatest)) if *last == mode => *greatest = greatest.max(most),
                _ => modes.push((mode, most)),
            }
        }
        verdict(&modes, named)
    }

    /// Which outputs, events and peaks are known well, and how far the others change.
    fn of_others(&self) -> Option<String> {
        let outputs = self.changes.iter().filter(|change| change.mode().is_none());
        let outputs: Vec<(String, f64)> =
            outputs.map(|output| (format!("`{}`", output.answer.name(&self.description)), output.most())).collect();
        verdict(&outputs, |outputs| {
            let texts: Vec<&str> = outputs.iter().map(String::as_str).collect();
            names(&texts, "answers")
        })
    }
}

/// `Modes 1 to 3 change by less than 1e-6; mode 4 by 2 %.`
fn verdict<T: Clone>(all: &[(T, f64)], name: impl Fn(&[T]) -> String) -> Option<String> {
    let (known, others): (Vec<_>, Vec<_>) = all.iter().partition(|(_, most)| *most < RELEVANT);
    let worst = |of: &[&(T, f64)]| largest(of.iter().map(|(_, most)| *most));
    let called = |of: &[&(T, f64)]| {
        let all: Vec<T> = of.iter().map(|(x, _)| x.clone()).collect();
        name(&all)
    };
    let verb = |of: &[&(T, f64)]| if of.len() == 1 { "changes" } else { "change" };
    let mut parts = Vec::new();
    if !known.is_empty() {
        let by = less_than(worst(&known));
        parts.push(format!("{} {} {by}", called(&known), verb(&known)));
    }
    let (told, rest) = others.split_at(others.len().min(TOLD));
    for entry in told {
        let verb = if parts.is_empty() { " changes" } else { "" };
        parts.push(format!("{}{verb} by {}", called(&[entry]), share(entry.1)));
    }
    if !rest.is_empty() {
        parts.push(format!("{} by up to {}", called(rest), share(worst(rest))));
    }
    (!parts.is_empty()).then(|| format!("{}.", capital(parts.join(", "))))
}

/// The next power of ten.
fn less_than(change: f64) -> String {
    match change {
        0.0 => "only by rounding".to_owned(),
        _ => format!("by less than 1e{}", change.log10().floor() + 1.0),
    }
}

/// A large change.
fn share(change: f64) -> String {
    if change.is_finite() {
        format!("{} %", short(100.0 * change))
    } else {
        "so much that it no longer exists".to_owned()
    }
}
