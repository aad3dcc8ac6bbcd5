//! Probabilities of meeting requirements, and design points, as text.

use core::f64::consts::TAU;
use core::fmt;

use super::judgement::verdict;
use super::margin::chance;
use crate::requirement::{
    Chances, DesignPoint, Edge, FailureProbability, Found, Limit, LimitReliability, Probabilities,
    RareFailure, Reliability, Requirement, Tally,
};
use crate::{Description, Text, Unit};
use eigentol_results::numbers::{
    counted, given_in, heading, in_unit, or_dash, rough, short, with_unit,
};
use eigentol_results::relevance::{BELOW, CHANCE, NOTHING_VARIES, names, relevant};
use eigentol_results::table::{Table, cells};
use eigentol_results::title::title;

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

impl fmt::Display for Probabilities {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        writeln!(f, "{}: probability of failure", title(d, &self.inputs))?;
        let mut table = Table::new(cells([
            "requirement",
            "P(failed)",
            "95 % interval",
            "found by",
            "designs",
        ]));
        for (k, (wanted, own)) in self.wanted.iter().zip(&self.each).enumerate() {
            table.row(found(format!("{}: {}", k + 1, wanted.text(d)), own));
        }
        if self.each.len() > 1 {
            table.row(found("any".to_owned(), &self.any));
        }
        write!(f, "{table}")?;
        let all = self.each.iter().chain([&self.any]);
        let untold = all.fold(0.0, |most: f64, own| most.max(own.untold));
        if untold > CHANCE {
            writeln!(
                f,
                "  Designs with a probability of up to {} lack the response needed to tell; they do not count as failures.",
                rough(untold)
            )?;
        }
        let Some(reliability) = &self.reliability else {
            return Ok(());
        };
        for own in &reliability.limits {
            let described = own
                .design_points
                .iter()
                .flatten()
                .filter(|point| point.verified);
            if let Some(nearest) = described.into_iter().next() {
                writeln!(
                    f,
                    "  Requirement {}: {}, most probably fails {} standard deviations from the mean, at",
                    own.limit.requirement + 1,
                    text(&own.limit, d),
                    rough(nearest.beta().abs())
                )?;
                variables(f, nearest, d)?;
            }
        }
        Ok(())
    }
}

fn found(name: String, own: &FailureProbability) -> Vec<String> {
    let by = match own.by {
        Found::DesignPoint => "design point",
        Found::Lines => "lines",
        Found::Samples => "samples",
    };
    vec![
        name,
        chance(own.value, 0.0),
        format!(
            "{} to {}",
            chance(own.interval.lower, 0.0),
            chance(own.interval.upper, 0.0)
        ),
        by.to_owned(),
        own.designs.to_string(),
    ]
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
    let doubtful = |claimed| own.judgement.confirms(claimed) && !own.verified();
    let verdict = own.probability().map(|claimed| match doubtful(claimed) {
        true => "not verified".to_owned(),
        false => verdict(&own.judgement, claimed),
    });
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
    variables(f, at, d)
}

fn variables(f: &mut fmt::Formatter<'_>, at: &DesignPoint, d: &Description) -> fmt::Result {
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

impl Requirement {
    /// In words, with the units of a mechanism: `frequency 1 at least 4 rad/s`.
    #[must_use]
    pub fn text(&self, of: &Description) -> String {
        let Some(response) = self.response() else {
            return "stable".to_owned();
        };
        let unit = response.unit(of);
        let limits = self.edges();
        let limits: Vec<String> = limits.iter().map(|edge| edge_text(edge, &unit)).collect();
        format!("{} {}", response.name(of), limits.join(", "))
    }
}

/// `frequency 1 at least 4 rad/s`.
fn text(limit: &Limit, d: &Description) -> String {
    let edge = edge_text(&limit.edge, &limit.response.unit(d));
    format!("{} {edge}", limit.response.name(d))
}

fn edge_text(edge: &Edge, unit: &Unit) -> String {
    let ends: &[f64] = match edge {
        Edge::AtLeast(low) => &[*low],
        Edge::AtMost(high) => &[*high],
        Edge::Outside { low, high } => &[*low, *high],
    };
    let hertz = Unit {
        symbol: Text::Static("Hz"),
        scale: TAU,
    };
    // A limit given in Hz is a short number in Hz only.
    let digits = |unit: &Unit| {
        ends.iter()
            .map(|end| given_in(*end, unit).len())
            .sum::<usize>()
    };
    let unit = match &*unit.symbol == "rad/s" && digits(&hertz) < digits(unit) {
        true => &hertz,
        false => unit,
    };
    let one = |end: f64| with_unit(given_in(end, unit), unit);
    match *edge {
        Edge::AtLeast(low) => format!("at least {}", one(low)),
        Edge::AtMost(high) => format!("at most {}", one(high)),
        Edge::Outside { low, high } => format!("outside {} to {}", one(low), one(high)),
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
