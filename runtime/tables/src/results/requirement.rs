use eigentol::judge::Judgement;
use eigentol::requirement::{
    Chances, DesignPoint, FailureProbability, Found, LimitReliability, Probabilities, RareFailure,
    Reliability, Tally,
};

use super::Tables;
use super::names::{by, in_unit, operating_point, per_unit};
use super::tolerance::outcomes;
use crate::Table;

/// Confidence level of the intervals.
const CONFIDENCE: f64 = 0.95;

fn tallies<'a>(table: &mut Table, all: impl Iterator<Item = &'a Tally> + Clone) {
    table.whole("met", all.clone().map(|own| own.met));
    table.whole("failed", all.clone().map(|own| own.failed));
    table.whole("untold", all.clone().map(|own| own.untold));
    table.numbers(
        "probability of failure",
        "",
        all.clone().map(Tally::failure),
    );
    let interval = all.map(|own| own.clopper_pearson(CONFIDENCE).ok());
    table.numbers(
        "95 % from",
        "",
        interval.clone().map(|own| Some(own?.lower)),
    );
    table.numbers("95 % to", "", interval.map(|own| Some(own?.upper)));
}

/// `chances`: a row for each requirement; `chance of all`: one row; `outcomes`.
impl Tables for Chances {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let mut each = Table::new("chances");
        each.whole("requirement", 1..=self.each.len());
        tallies(&mut each, self.each.iter());
        operating_point(&mut each, d, &self.inputs, None);
        let mut all = Table::new("chance of all");
        tallies(&mut all, [&self.all].into_iter());
        operating_point(&mut all, d, &self.inputs, None);
        let mut outcomes = outcomes(&self.counts);
        operating_point(&mut outcomes, d, &self.inputs, None);
        vec![each, all, outcomes]
    }
}

/// The probability by designs solved anew, for rows that each have a judgement; empty where there is none.
pub(super) fn judged<'a>(table: &mut Table, all: impl Iterator<Item = &'a Judgement> + Clone) {
    let each = || all.clone().map(Judgement::judged);
    table.numbers(
        "probability, solved anew",
        "",
        each().map(|own| Some(own?.probability.value)),
    );
    let intervals = || each().map(|own| own.map(|own| own.interval()));
    table.numbers("95 % from", "", intervals().map(|own| Some(own?.lower)));
    table.numbers("95 % to", "", intervals().map(|own| Some(own?.upper)));
    table.numbers(
        "probability without response",
        "",
        each().map(|own| Some(own?.untold.value)),
    );
    table.flags("settled", each().map(|own| Some(own?.settled)));
    let designs = each().map(|own| usize::try_from(own?.designs).ok());
    table.whole("designs", designs);
}

/// `probabilities of failure`: a row for each requirement and one for any of them; the tables of design points and
/// samples, if there are any.
impl Tables for Probabilities {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let mut table = Table::new("probabilities of failure");
        let names = self.wanted.iter().map(|own| own.text(d));
        let names = names.chain(["any".to_owned()]);
        table.texts("requirement", names.map(Some));
        let all = || self.each.iter().chain([&self.any]);
        let numbers = |of: fn(&FailureProbability) -> f64| all().map(of);
        table.numbers("probability of failure", "", numbers(|own| own.value));
        table.numbers("95 % from", "", numbers(|own| own.interval.lower));
        table.numbers("95 % to", "", numbers(|own| own.interval.upper));
        table.numbers(
            "probability without response",
            "",
            numbers(|own| own.untold),
        );
        let by = all().map(|own| {
            Some(match own.by {
                Found::DesignPoint => "design point".to_owned(),
                Found::Lines => "lines".to_owned(),
                _ => "samples".to_owned(),
            })
        });
        table.texts("found by", by);
        table.whole(
            "designs",
            all().map(|own| usize::try_from(own.designs).ok()),
        );
        operating_point(&mut table, d, &self.inputs, None);
        let mut tables = vec![table];
        tables.extend(self.reliability.iter().flat_map(Tables::tables));
        tables.extend(self.chances.iter().flat_map(Tables::tables));
        tables
    }
}

/// `design points`: a row for each, or one with the error if there are none; `design point variables`: a row for each
/// design variable of each; `system`: one row.
impl Tables for Reliability {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let mut rows: Vec<(&LimitReliability, Option<&DesignPoint>)> = Vec::new();
        for limit in &self.limits {
            match &limit.design_points {
                Ok(points) => rows.extend(points.iter().map(|own| (limit, Some(own)))),
                Err(_) => rows.push((limit, None)),
            }
        }
        let each = rows.iter();
        let mut table = Table::new("design points");
        table.whole(
            "requirement",
            each.clone().map(|(own, _)| own.limit.requirement + 1),
        );
        table.texts(
            "response",
            each.clone()
                .map(|(own, _)| Some(own.limit.response.name(d))),
        );
        table.numbers(
            "beta",
            "",
            each.clone().map(|(_, own)| Some(own.as_ref()?.beta())),
        );
        let first = each
            .clone()
            .map(|(_, own)| Some(own.as_ref()?.probability()));
        table.numbers("probability of failure, first order", "", first);
        let second = each.clone().map(|(_, own)| own.as_ref()?.second_order);
        table.numbers("probability of failure, second order", "", second);
        table.flags(
            "verified",
            each.clone().map(|(_, own)| Some(own.as_ref()?.verified)),
        );
        judged(&mut table, each.clone().map(|(own, _)| &own.judgement));
        let errors = each.map(|(own, _)| Some(own.design_points.as_ref().err()?.to_string()));
        table.texts("error", errors);
        operating_point(&mut table, d, &self.inputs, None);

        let points = rows
            .iter()
            .filter_map(|(limit, own)| Some((limit, (*own)?)));
        let entries = || {
            points.clone().flat_map(|(limit, own)| {
                let each = d.design.iter().enumerate();
                each.map(move |(k, info)| (limit.limit.requirement, own, k, info))
            })
        };
        let mut variables = Table::new("design point variables");
        variables.whole("requirement", entries().map(|(r, ..)| r + 1));
        variables.texts(
            "variable",
            entries().map(|(.., info)| Some(info.name.to_string())),
        );
        variables.texts("unit", entries().map(|(.., info)| by(&info.unit)));
        let at = entries().map(|(_, own, k, info)| Some(in_unit(*own.design.get(k)?, &info.unit)));
        variables.numbers("design point", "", at);
        let importance = entries().map(|(_, own, k, _)| own.importance.get(k).copied());
        variables.numbers("importance", "", importance);
        let slope = entries()
            .map(|(_, own, k, info)| Some(per_unit(own.by_nominal.get(k)?.beta, &info.unit)));
        variables.numbers("beta by nominal value", "per unit", slope);
        let slope = entries()
            .map(|(_, own, k, info)| Some(per_unit(own.by_half_width.get(k)?.beta, &info.unit)));
        variables.numbers("beta by half-width", "per unit", slope);
        operating_point(&mut variables, d, &self.inputs, None);
        let mut tables = vec![table, variables];
        if let Some(system) = &self.system {
            let mut table = Table::new("system");
            table.numbers("probability of failure", "", [system.probability.value]);
            table.numbers("from", "", [system.bounds.lower]);
            table.numbers("to", "", [system.bounds.upper]);
            operating_point(&mut table, d, &self.inputs, None);
            tables.push(table);
        }
        tables
    }
}

/// `rare failure`: one row.
impl Tables for RareFailure {
    fn tables(&self) -> Vec<Table> {
        let found = &self.failure;
        let whole = |count: u64| usize::try_from(count).ok();
        let mut table = Table::new("rare failure");
        table.numbers("probability of failure", "", [found.probability.value]);
        table.numbers("standard error", "", [found.probability.standard_error]);
        table.whole("samples", [whole(found.samples)]);
        table.whole("failures", [whole(found.failures)]);
        table.whole("without value", [whole(found.without_value)]);
        table.whole("design points", [self.centres]);
        table.numbers("unseen", "", [self.unseen]);
        table.flags("trusted", [Some(self.trusted())]);
        operating_point(&mut table, &self.description, &self.inputs, None);
        vec![table]
    }
}
