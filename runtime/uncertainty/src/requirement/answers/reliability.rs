use eigentol_contract::DesignInfo;
use eigentol_results::numbers::{converted, heading, number, rough};
use eigentol_results::relevance::{BELOW, names, relevant};
use eigentol_results::{Answer, Columns, Findings, at_point, displayed};

use super::words::probability;
use crate::Description;
use crate::judge::{judged, verdict};
use crate::requirement::{DesignPoint, LimitReliability, Reliability};

/// `design points`: a row for each, or one with the error if there are none; `design point variables`: a row for each
/// design variable of each.
impl Answer for Reliability {
    const KIND: &'static str = "reliability";

    at_point!();

    fn findings(&self) -> Findings {
        let d = &self.description;
        let mut said = self.titled("reliability");
        self.data(&mut said);
        for limit_state in &self.limits {
            limit(&mut said, limit_state, d);
        }
        for k in &self.left_out {
            let number = k + 1;
            said.note(format!("Requirement {number} has no design point: sample it."));
        }
        if self.limits.len() + self.left_out.len() > 1 {
            said.note(format!("At least one requirement fails, designs solved anew: {}.", self.judgement));
        }
        said
    }
}

displayed!(Reliability);

/// A limit and one of its design points, if it has any.
type Row<'a> = (&'a LimitReliability, Option<&'a DesignPoint>);

impl Reliability {
    fn data(&self, said: &mut Findings) {
        let rows: Vec<Row<'_>> = self.limits.iter().flat_map(points).collect();
        let d = &self.description;
        design_points(said, &rows, d);
        let entries = rows
            .iter()
            .filter_map(|(limit, x)| Some((*limit, (*x)?)))
            .flat_map(|(limit, x)| entries(limit.requirement, x, d));
        let entries: Vec<Entry<'_>> = entries.collect();
        said.data(entry_columns(&entries, Vec::new()).finish().0);
    }
}

fn points(limit: &LimitReliability) -> Vec<Row<'_>> {
    match &limit.design_points {
        Ok(points) => points.iter().map(|point| (limit, Some(point))).collect(),
        Err(_) => vec![(limit, None)],
    }
}

fn design_points(said: &mut Findings, rows: &[Row<'_>], d: &Description) {
    let mut table = Columns::new("design points", rows);
    table.whole("requirement", &|(x, _)| Some(x.requirement + 1));
    table.words("response", &|(x, _)| Some(x.limit.response()?.name(d)));
    table.number("beta", "", &|(_, x)| Some(x.as_ref()?.beta()));
    table.number("probability of failure, first order", "", &|(_, item)| Some(item.as_ref()?.probability()));
    table.flag("verified", &|(_, x)| Some(x.as_ref()?.verified));
    judged(&mut table, &|(x, _)| &x.judgement);
    table.words("error", &|(item, _)| Some(item.design_points.as_ref().err()?.to_string()));
    said.columns(table);
}

/// What the text says of a limit.
fn limit(said: &mut Findings, limit_reliability: &LimitReliability, d: &Description) {
    let number = limit_reliability.requirement + 1;
    let text = limit_reliability.limit.text(d);
    said.note(match &limit_reliability.design_points {
        Ok(_) => format!("Requirement {number}: {text}"),
        Err(error) => format!("Requirement {number}: {text}: {error}."),
    });
    said.note(format!("Designs solved anew: probability of failure {}.", limit_reliability.judgement));
    let doubtful = |claimed| limit_reliability.judgement.confirms(claimed) && !limit_reliability.verified();
    let verdict = limit_reliability.probability().map(|claimed| {
        if doubtful(claimed) { "not verified".to_owned() } else { verdict(&limit_reliability.judgement, claimed) }
    });
    let verdict = verdict.unwrap_or_default();
    for at in limit_reliability.design_points.iter().flatten() {
        said.note(format!(
            "beta {}, probability of failure {} (first order); design point {verdict}",
            rough(at.beta()),
            probability(at.probability()),
        ));
        variables(said, at, d);
    }
}

/// A design variable at a design point.
struct Entry<'a> {
    /// The requirement, from 0.
    requirement: usize,
    info: &'a DesignInfo,
    /// SI.
    design: f64,
    importance: f64,
    /// Derivatives of the reliability index, per SI unit.
    by_nominal: f64,
    by_half_width: f64,
}

fn entries<'a>(requirement: usize, at: &DesignPoint, d: &'a Description) -> Vec<Entry<'a>> {
    let values = at.design.iter().zip(&at.importance);
    let slopes = at.by_nominal.iter().zip(&at.by_half_width);
    d.design
        .iter()
        .zip(values.zip(slopes))
        .map(|(info, ((design, importance), (nominal, half_width)))| Entry {
            requirement,
            info,
            design: *design,
            importance: *importance,
            by_nominal: nominal.beta,
            by_half_width: half_width.beta,
        })
        .collect()
}

fn entry_columns<'a, 'e>(rows: &'a [Entry<'e>], shown: Vec<usize>) -> Columns<'a, Entry<'e>> {
    let mut table = Columns::new("design point variables", rows);
    table.show_rows(shown);
    table.whole("requirement", &|row| Some(row.requirement + 1));
    table.words("variable", &|row| Some(row.info.name.to_string()));
    table.words("unit", &|row| Some(row.info.unit.symbol.to_string()));
    table.cells("variable", &|row| heading(&row.info.name, &row.info.unit));
    table.number("design point", "", &|row| Some(converted(row.design, &row.info.unit))).digits(number);
    table.number("importance", "", &|row| Some(row.importance)).digits(|share| format!("{share:.3}"));
    let slope = table.number("beta by nominal value", "per unit", &|row| Some(row.by_nominal * row.info.unit.scale));
    slope.digits(rough).headed("beta by nominal value");
    let slope = table.number("beta by half-width", "per unit", &|row| Some(row.by_half_width * row.info.unit.scale));
    slope.digits(rough).headed("by half-width");
    table
}

/// The variables that matter at a design point, in the text.
pub(super) fn variables(said: &mut Findings, at: &DesignPoint, d: &Description) {
    let all = entries(0, at, d);
    let (shown, left): (Vec<usize>, Vec<usize>) = (0..all.len()).partition(|&k| relevant(all[k].importance, 1.0));
    said.text(entry_columns(&all, shown).finish().1);
    if !left.is_empty() {
        let left: Vec<&str> = left.iter().map(|&k| &*all[k].info.name).collect();
        let names = names(&left, "variables");
        said.note(format!("Left out, {BELOW} of the importance: {names}"));
    }
}
