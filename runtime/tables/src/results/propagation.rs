use eigentol::Description;
use eigentol::propagation::{Controlled, Estimated, Influence, Propagation, WorstCase};
use eigentol::response::Response;

use super::Tables;
use super::names::{by, in_unit, operating_point};
use super::tolerance::outcomes;
use crate::Table;

/// The columns `response` and `unit`.
fn responses<'a>(
    table: &mut Table,
    d: &Description,
    all: impl Iterator<Item = &'a Response> + Clone,
) {
    table.texts("response", all.clone().map(|own| Some(own.name(d))));
    table.texts("unit", all.map(|own| by(&own.unit(d))));
}

/// The columns of an estimate, in the unit of each response or unitless.
fn estimates<'a>(
    table: &mut Table,
    name: &str,
    d: &Description,
    all: impl Iterator<Item = (Option<&'a Response>, Option<Estimated>)> + Clone,
) {
    let scaled = |of: Option<&Response>, value: f64| match of {
        Some(own) => in_unit(value, &own.unit(d)),
        None => value,
    };
    let value = all.clone().map(|(of, own)| Some(scaled(of, own?.value)));
    table.numbers(name, "", value);
    let error = all.map(|(of, own)| Some(scaled(of, own?.error?)));
    table.numbers(format!("error of {name}"), "", error);
}

/// `spreads`: a row for each response, numbers in its `unit`; `quantiles`: a row for each response and probability;
/// `correlations`: a row for each pair of responses; `outcomes`.
impl Tables for Propagation {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let each = || {
            self.wanted
                .iter()
                .zip(self.spreads.iter().map(Option::as_ref))
        };
        let mut table = Table::new("spreads");
        responses(&mut table, d, self.wanted.iter());
        let nominal = each().map(|(of, own)| Some(in_unit(own?.nominal?, &of.unit(d))));
        table.numbers("nominal", "", nominal);
        estimates(
            &mut table,
            "mean",
            d,
            each().map(|(of, own)| (Some(of), own.map(|own| own.mean))),
        );
        estimates(
            &mut table,
            "sigma",
            d,
            each().map(|(of, own)| (Some(of), own.and_then(|own| own.sigma))),
        );
        estimates(
            &mut table,
            "skewness",
            d,
            each().map(|(_, own)| (None, own.and_then(|own| own.skewness))),
        );
        table.numbers("share", "", each().map(|(_, own)| Some(own?.share)));
        table.texts("method", each().map(|_| Some(self.method.to_string())));
        let doubts = self.doubts.iter().map(|own| {
            let own: Vec<String> = own.iter().map(ToString::to_string).collect();
            (!own.is_empty()).then(|| own.join(" "))
        });
        table.texts("doubts", doubts);
        operating_point(&mut table, d, &self.inputs, None);
        let mut tables = vec![table];
        let quantiles = || {
            let own = each().filter_map(|(of, own)| Some((of, own?)));
            own.flat_map(|(of, own)| own.quantiles.iter().map(move |own| (of, own)))
        };
        if quantiles().next().is_some() {
            let mut table = Table::new("quantiles");
            responses(&mut table, d, quantiles().map(|(of, _)| of));
            table.numbers(
                "probability",
                "",
                quantiles().map(|(_, own)| own.probability),
            );
            let value = quantiles().map(|(of, own)| in_unit(own.value, &of.unit(d)));
            table.numbers("value", "", value);
            let error = quantiles().map(|(of, own)| Some(in_unit(own.error?, &of.unit(d))));
            table.numbers("error", "", error);
            operating_point(&mut table, d, &self.inputs, None);
            tables.push(table);
        }
        let count = self.wanted.len();
        if count > 1 {
            let pairs = || (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j)));
            let name = |k: usize| Some(self.wanted.get(k)?.name(d));
            let mut table = Table::new("correlations");
            table.texts("response", pairs().map(|(i, _)| name(i)));
            table.texts("with", pairs().map(|(_, j)| name(j)));
            table.numbers(
                "correlation",
                "",
                pairs().map(|(i, j)| self.correlation(i, j)),
            );
            operating_point(&mut table, d, &self.inputs, None);
            tables.push(table);
        }
        let mut table = outcomes(&self.counts);
        operating_point(&mut table, d, &self.inputs, None);
        tables.push(table);
        tables
    }
}

/// `controlled spreads`: a row for each response, numbers in its `unit`; `outcomes`.
impl Tables for Controlled {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let each = || {
            self.wanted
                .iter()
                .zip(self.spreads.iter().map(Option::as_ref))
        };
        let mut table = Table::new("controlled spreads");
        responses(&mut table, d, self.wanted.iter());
        estimates(
            &mut table,
            "mean",
            d,
            each().map(|(of, own)| (Some(of), own.map(|own| own.mean))),
        );
        table.numbers("worth of mean", "", each().map(|(_, own)| Some(own?.worth)));
        estimates(
            &mut table,
            "sigma",
            d,
            each().map(|(of, own)| (Some(of), own.map(|own| own.sigma))),
        );
        table.numbers(
            "worth of sigma",
            "",
            each().map(|(_, own)| Some(own?.worth_of_sigma)),
        );
        table.texts("model", each().map(|(_, own)| Some(own?.model.to_string())));
        operating_point(&mut table, d, &self.inputs, None);
        let mut outcomes = outcomes(&self.counts);
        operating_point(&mut outcomes, d, &self.inputs, None);
        vec![table, outcomes]
    }
}

/// `worst case`: a row for each response, numbers in its `unit`; `worst designs`: a row for each extreme of each
/// response, with the design that attains it.
impl Tables for WorstCase {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let each = || self.wanted.iter().zip(&self.responses);
        let mut table = Table::new("worst case");
        responses(&mut table, d, self.wanted.iter());
        let own = each().map(|(of, own)| Some(in_unit(own.nominal?, &of.unit(d))));
        table.numbers("nominal", "", own);
        let own = each().map(|(of, own)| Some(in_unit(own.least.as_ref()?.value, &of.unit(d))));
        table.numbers("least", "", own);
        let own = each().map(|(of, own)| Some(in_unit(own.greatest.as_ref()?.value, &of.unit(d))));
        table.numbers("greatest", "", own);
        table.flags("monotonic", each().map(|(_, own)| own.is_monotonic()));
        let turning = each().map(|(_, own)| {
            let names = own.turning.iter().filter_map(|&j| d.design.get(j));
            let names: Vec<String> = names.map(|info| info.name.to_string()).collect();
            Some(names.join(" ")).filter(|own| !own.is_empty())
        });
        table.texts("turning", turning);
        table.whole(
            "corners without a value",
            each().map(|(_, own)| own.missing.len()),
        );
        operating_point(&mut table, d, &self.inputs, None);
        let ends = || {
            each().flat_map(|(of, own)| {
                let ends = [
                    ("least", own.least.as_ref()),
                    ("greatest", own.greatest.as_ref()),
                ];
                ends.into_iter()
                    .filter_map(move |(end, own)| Some((of, end, own?)))
            })
        };
        let mut designs = Table::new("worst designs");
        responses(&mut designs, d, ends().map(|(of, ..)| of));
        designs.texts("end", ends().map(|(_, end, _)| Some(end.to_owned())));
        designs.numbers(
            "value",
            "",
            ends().map(|(of, _, own)| in_unit(own.value, &of.unit(d))),
        );
        designs.flags("confirmed", ends().map(|(.., own)| own.confirmed));
        let points: Vec<_> = ends().map(|(.., own)| &own.design[..]).collect();
        super::names::design(&mut designs, d, points.into_iter());
        operating_point(&mut designs, d, &self.inputs, None);
        vec![table, designs]
    }
}

/// `influence`: a row for each response and variable; `at low` and `at high` are in the `unit` of the response.
impl Tables for Influence {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let rows = || {
            let each = self.wanted.iter().zip(&self.responses);
            each.flat_map(|(of, own)| own.variables.iter().map(move |own| (of, own)))
        };
        let mut table = Table::new("influence");
        responses(&mut table, d, rows().map(|(of, _)| of));
        table.texts(
            "of",
            rows().map(|(_, own)| Some(d.design.get(own.variable)?.name.to_string())),
        );
        table.numbers("first", "", rows().map(|(_, own)| Some(own.first?.value)));
        table.numbers(
            "first from",
            "",
            rows().map(|(_, own)| Some(own.first?.lower)),
        );
        table.numbers(
            "first to",
            "",
            rows().map(|(_, own)| Some(own.first?.upper)),
        );
        table.numbers("total", "", rows().map(|(_, own)| Some(own.total?.value)));
        table.numbers(
            "total from",
            "",
            rows().map(|(_, own)| Some(own.total?.lower)),
        );
        table.numbers(
            "total to",
            "",
            rows().map(|(_, own)| Some(own.total?.upper)),
        );
        table.numbers("correlation", "", rows().map(|(_, own)| own.correlation));
        table.numbers(
            "rank correlation",
            "",
            rows().map(|(_, own)| own.rank_correlation),
        );
        table.numbers("regression", "", rows().map(|(_, own)| own.regression));
        let low = rows().map(|(of, own)| Some(in_unit(own.at_low?, &of.unit(d))));
        table.numbers("at low", "", low);
        let high = rows().map(|(of, own)| Some(in_unit(own.at_high?, &of.unit(d))));
        table.numbers("at high", "", high);
        operating_point(&mut table, d, &self.inputs, None);
        vec![table]
    }
}
