//! Probabilities of meeting requirements, and design points, as text.

use core::fmt;

use super::judgement::verdict;
use super::margin::chance;
use super::numbers::{counted, given_in, heading, in_unit, or_dash, rough, short, with_unit};
use super::relevance::{BELOW, NOTHING_VARIES, names, relevant};
use super::table::{Table, cells};
use super::title::title;
use crate::Description;
use crate::requirement::{
    Chances, DesignPoint, Edge, Limit, LimitReliability, RareFailure, Reliability, Tally,
};

/// Confidence of the intervals.
const CONFIDENCE: f64 = 0.95;

impl fmt::Display for Chances {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let samples = self.all.samples();
        let subject = title(&self.description, &self.inputs);
        writeln!(f, "{subject}: requirements, {}", counted(samples, "sample"))?;
        if samples < self.planned {
            writeln!(
                f,
                "  Not complete: {} samples were asked for.",
                self.planned
            )?;
        }
        let mut table = Table::new(cells([
            "requirement",
            "met",
            "failed",
            "untold",
            "P(failed)",
            "95% interval (Clopper-Pearson)",
        ]));
        for (k, tally) in self.each.iter().enumerate() {
            table.row(row((k + 1).to_string(), tally));
        }
        table.row(row("all".to_owned(), &self.all));
        write!(f, "{table}")?;
        if !self.varies {
            writeln!(f, "  {NOTHING_VARIES}")?;
        }
        if self.each.iter().any(|tally| tally.untold > 0) {
            writeln!(
                f,
                "  Untold: the response does not exist; such a sample counts neither as met nor as failed."
            )?;
        }
        let stable = self.counts.stable;
        if stable < samples {
            let others = counted(samples - stable, "sample");
            writeln!(f, "  Not stable: {others}: {}", self.counts)?;
        }
        Ok(())
    }
}

fn row(name: String, tally: &Tally) -> Vec<String> {
    let interval = tally.clopper_pearson(CONFIDENCE).map_or_else(
        |_| "-".to_owned(),
        |found| format!("{} to {}", short(found.lower), short(found.upper)),
    );
    vec![
        name,
        tally.met.to_string(),
        tally.failed.to_string(),
        tally.untold.to_string(),
        rough(tally.failure()),
        interval,
    ]
}

impl fmt::Display for Reliability {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        writeln!(f, "{}: reliability", title(d, &self.inputs))?;
        for own in &self.limits {
            limit(f, own, d)?;
        }
        for k in &self.left_out {
            writeln!(f, "  Requirement {} has no design point: sample it.", k + 1)?;
        }
        if let Some(system) = &self.system {
            writeln!(
                f,
                "  At least one of these fails with probability {} to first order (bounds {} to {}).",
                chance(system.probability.value, 0.0),
                chance(system.bounds.lower, 0.0),
                chance(system.bounds.upper, 0.0)
            )?;
        }
        if self.limits.len() + self.left_out.len() > 1 {
            writeln!(
                f,
                "  At least one requirement fails, designs solved anew: {}.",
                self.judgement
            )?;
        }
        Ok(())
    }
}

fn limit(f: &mut fmt::Formatter<'_>, own: &LimitReliability, d: &Description) -> fmt::Result {
    write!(
        f,
        "  Requirement {}: {}",
        own.limit.requirement + 1,
        text(&own.limit, d)
    )?;
    match &own.design_points {
        Err(error) => writeln!(f, ": {error}.")?,
        Ok(_) => writeln!(f)?,
    }
    writeln!(
        f,
        "  Designs solved anew: probability of failure {}.",
        own.judgement
    )?;
    let verdict = own
        .probability()
        .map(|claimed| verdict(&own.judgement, claimed));
    let verdict = verdict.unwrap_or_default();
    let points = own.design_points.iter().flatten();
    points
        .into_iter()
        .try_for_each(|at| point(f, (at, &verdict), d))
}

fn point(
    f: &mut fmt::Formatter<'_>,
    (at, verdict): (&DesignPoint, &str),
    d: &Description,
) -> fmt::Result {
    writeln!(
        f,
        "  beta {}, probability of failure {} (first order), {} (second order); design point {}",
        rough(at.beta()),
        chance(at.probability(), 0.0),
        or_dash(at.second_order, |value| chance(value, 0.0)),
        verdict
    )?;
    let mut table = Table::new(cells([
        "variable",
        "design point",
        "importance",
        "beta by nominal value",
        "by half-width",
    ]));
    let mut left = Vec::new();
    for (k, info) in d.design.iter().enumerate() {
        if !relevant(at.importance[k], 1.0) {
            left.push(&*info.name);
            continue;
        }
        let scale = info.unit.scale;
        table.row(vec![
            heading(&info.name, &info.unit),
            in_unit(at.design[k], &info.unit),
            format!("{:.3}", at.importance[k]),
            rough(at.by_nominal[k].beta * scale),
            rough(at.by_half_width[k].beta * scale),
        ]);
    }
    if !table.is_empty() {
        write!(f, "{table}")?;
    }
    match left.is_empty() {
        true => Ok(()),
        false => writeln!(
            f,
            "  Left out, {BELOW} of the importance: {}",
            names(&left, "variables")
        ),
    }
}

/// `frequency 1 at least 4.00000 rad/s`.
fn text(limit: &Limit, d: &Description) -> String {
    let (name, unit) = (limit.response.name(d), limit.response.unit(d));
    let one = |end: f64| with_unit(given_in(end, &unit), &unit);
    match limit.edge {
        Edge::AtLeast(low) => format!("{name} at least {}", one(low)),
        Edge::AtMost(high) => format!("{name} at most {}", one(high)),
        Edge::Outside { low, high } => format!("{name} outside {} to {}", one(low), one(high)),
    }
}

impl fmt::Display for RareFailure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let subject = title(&self.description, &self.inputs);
        let found = &self.failure;
        writeln!(
            f,
            "{subject}: {} importance samples about {}",
            found.samples,
            counted(self.centres, "design point")
        )?;
        writeln!(
            f,
            "  At least one requirement fails with probability {} +- {} ({} failed, {} undecided).",
            rough(found.probability.value),
            short(found.probability.standard_error),
            counted(found.failures, "sample"),
            found.without_value
        )?;
        if self.contradicted() {
            writeln!(
                f,
                "  Not to be relied on: along lines of designs, the probability is {}.",
                self.judgement
            )?;
        } else if !found.reached {
            writeln!(f, "  Not settled: the samples did not reach their target.")?;
        }
        if self.without_design_point.is_empty() {
            return Ok(());
        }
        let numbers: Vec<String> = (self.without_design_point.iter())
            .map(|k| (k + 1).to_string())
            .collect();
        writeln!(
            f,
            "  No design point for requirement {}: failures with a probability of up to {} may have gone unseen (95 %).",
            numbers.join(", "),
            rough(self.unseen)
        )
    }
}
