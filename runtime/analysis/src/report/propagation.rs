//! Spreads and worst cases of responses as text.

use core::fmt;

use eigentol_statistics::sensitivity::Estimate;

use crate::propagation::{
    Controlled, Estimated, Influence, Method, Points, Propagation, QUANTILES, VariableInfluence,
    WorstCase,
};
use crate::response::Response;
use crate::{Description, Unit};
use eigentol_results::numbers::{heading, in_unit, or_dash, percent, short};
use eigentol_results::relevance::{BELOW, names, relevant, unless_rounding};
use eigentol_results::table::{Table, cells};
use eigentol_results::title::title;
use eigentol_tolerance::report::standing;

fn labelled(response: &Response, d: &Description) -> (String, Unit) {
    let unit = response.unit(d);
    (heading(&response.name(d), &unit), unit)
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::FirstOrder => f.write_str("first order"),
            Self::SecondOrder => f.write_str("second order"),
            Self::Sampled(Points::Random) => f.write_str("random samples"),
            Self::Sampled(Points::LatinHypercube) => f.write_str("Latin hypercube samples"),
            Self::Sampled(Points::Sobol) => f.write_str("samples at scrambled Sobol' points"),
            Self::Tensor { nodes } => write!(f, "quadrature with {nodes} nodes for each variable"),
            Self::Sparse { level } => write!(f, "quadrature on a sparse grid of level {level}"),
        }
    }
}

impl fmt::Display for Propagation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        let title = title(d, &self.inputs);
        writeln!(f, "{title}: spread of responses by {}", self.method)?;
        if !self.reason.is_empty() {
            writeln!(f, "  Why: {}.", self.reason)?;
        }
        writeln!(f, "  {} designs: {}.", self.evaluations, self.counts)?;
        let head = [
            "response", "nominal", "mean", "error", "sigma", "error", "skewness", "error", "share",
        ];
        let mut table = Table::new(cells(head));
        let mut quantiles = vec!["quantile".to_owned()];
        quantiles.extend(QUANTILES.map(|p| format!("{:.3} %", 100.0 * p)));
        let mut quantiles = Table::new(quantiles);
        let mut any = false;
        for (response, own) in self.wanted.iter().zip(&self.spreads) {
            let (label, unit) = labelled(response, d);
            let Some(own) = own else {
                table.row(vec![label, "no value".to_owned()]);
                continue;
            };
            let both = |own: Option<Estimated>| match own {
                None => cells(["-", "-"]),
                Some(own) => vec![
                    in_unit(own.value, &unit),
                    or_dash(own.error.map(|error| unit.from_si(error)), short),
                ],
            };
            let nominal = own
                .nominal
                .map_or_else(|| "-".to_owned(), |value| in_unit(value, &unit));
            let mut row = vec![label.clone(), nominal];
            row.extend(both(Some(own.mean)));
            row.extend(both(own.sigma.map(|sigma| Estimated {
                value: unless_rounding(sigma.value, own.mean.value),
                ..sigma
            })));
            row.push(or_dash(own.skewness.map(|own| own.value), short));
            row.push(or_dash(own.skewness.and_then(|own| own.error), short));
            row.push(percent(own.share));
            table.row(row);
            if !own.quantiles.is_empty() {
                any = true;
                let mut row = vec![label];
                row.extend(own.quantiles.iter().map(|own| in_unit(own.value, &unit)));
                quantiles.row(row);
            }
        }
        write!(f, "{table}")?;
        if any {
            write!(f, "{quantiles}")?;
        }
        if self.wanted.len() > 1 {
            write!(f, "{}", self.correlations())?;
        }
        for (response, own) in self.wanted.iter().zip(&self.doubts) {
            for doubt in own {
                writeln!(f, "  {} for {}: {doubt}", standing(doubt), response.name(d))?;
            }
        }
        if self.doubts.iter().any(|own| !own.is_empty()) {
            writeln!(
                f,
                "  Nothing is known about their errors: samples need no model."
            )?;
        }
        Ok(())
    }
}

impl Propagation {
    fn correlations(&self) -> Table {
        let names: Vec<String> = (self.wanted.iter())
            .map(|response| response.name(&self.description))
            .collect();
        let mut head = vec!["correlation".to_owned()];
        head.extend(names.iter().cloned());
        let mut table = Table::new(head);
        for (i, name) in names.into_iter().enumerate() {
            let mut row = vec![name];
            let own = (0..self.wanted.len()).map(|j| self.correlation(i, j));
            row.extend(own.map(|own| own.map_or("-".to_owned(), |own| format!("{own:.3}"))));
            table.row(row);
        }
        table
    }
}

impl fmt::Display for WorstCase {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        let title = title(d, &self.inputs);
        writeln!(
            f,
            "{title}: worst case over the box of limits, {} designs",
            self.evaluations
        )?;
        let mut table = Table::new(cells([
            "response",
            "nominal",
            "least",
            "greatest",
            "monotonic",
        ]));
        for (response, own) in self.wanted.iter().zip(&self.responses) {
            let (label, unit) = labelled(response, d);
            let value = |value: Option<f64>| {
                value.map_or_else(|| "-".to_owned(), |value| in_unit(value, &unit))
            };
            let ends =
                [&own.least, &own.greatest].map(|end| value(end.as_ref().map(|end| end.value)));
            let monotonic = if own.is_monotonic() { "yes" } else { "no" };
            let [least, greatest] = ends;
            table.row(vec![
                label,
                value(own.nominal),
                least,
                greatest,
                monotonic.to_owned(),
            ]);
        }
        write!(f, "{table}")?;
        for (response, own) in self.wanted.iter().zip(&self.responses) {
            let name = response.name(d);
            if !own.turning.is_empty() {
                let variables = own.turning.iter().map(|&j| &*d.design[j].name);
                let variables: Vec<&str> = variables.collect();
                writeln!(
                    f,
                    "  {name} rises and falls with {}: it may be worse inside the box.",
                    variables.join(", ")
                )?;
            }
            if !own.missing.is_empty() {
                writeln!(
                    f,
                    "  {name} has no value at {} of the corners.",
                    own.missing.len()
                )?;
            }
        }
        Ok(())
    }
}

impl fmt::Display for Controlled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        let title = title(d, &self.inputs);
        writeln!(
            f,
            "{title}: spread of responses by random samples with the Taylor model as control"
        )?;
        writeln!(f, "  {} designs: {}.", self.counts.total(), self.counts)?;
        let head = [
            "response", "mean", "error", "worth", "sigma", "error", "worth", "model",
        ];
        let mut table = Table::new(cells(head));
        for (response, own) in self.wanted.iter().zip(&self.spreads) {
            let (label, unit) = labelled(response, d);
            let Some(own) = own else {
                table.row(vec![label, "not controlled".to_owned()]);
                continue;
            };
            let mut row = vec![label];
            for (own, worth) in [(own.mean, own.worth), (own.sigma, own.worth_of_sigma)] {
                row.push(in_unit(own.value, &unit));
                row.push(or_dash(own.error.map(|error| unit.from_si(error)), short));
                row.push(short(worth));
            }
            row.push(own.model.to_string());
            table.row(row);
        }
        write!(f, "{table}")?;
        writeln!(
            f,
            "  Worth: how many plain samples give the same error as one of these."
        )
    }
}

impl fmt::Display for Influence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        let title = title(d, &self.inputs);
        writeln!(f, "{title}: where the scatter of responses comes from")?;
        writeln!(f, "  {} designs: {}.", self.counts.total(), self.counts)?;
        for (response, own) in self.wanted.iter().zip(&self.responses) {
            let (label, unit) = labelled(response, d);
            let head = [
                "first",
                "95 %",
                "total",
                "95 %",
                "correlation",
                "of ranks",
                "regression",
                "at low",
                "at high",
            ];
            let mut table = Table::new([vec![label], cells(head)].concat());
            let mut left = Vec::new();
            for own in &own.variables {
                let none =
                    |index: Option<Estimate>| index.is_some_and(|own| !relevant(own.upper, 1.0));
                if none(own.first) && none(own.total) {
                    left.push(&*d.design[own.variable].name);
                    continue;
                }
                let index = |own: Option<Estimate>| match own {
                    None => cells(["-", "-"]),
                    Some(own) => vec![
                        short(own.value),
                        format!("{} to {}", short(own.lower), short(own.upper)),
                    ],
                };
                let value = |own: Option<f64>| {
                    own.map_or_else(|| "-".to_owned(), |own| in_unit(own, &unit))
                };
                let mut row = vec![d.design[own.variable].name.to_string()];
                row.extend(index(own.first));
                row.extend(index(own.total));
                row.extend(
                    [own.correlation, own.rank_correlation, own.regression]
                        .map(|own| or_dash(own, short)),
                );
                row.extend([own.at_low, own.at_high].map(value));
                table.row(row);
            }
            if !table.is_empty() {
                write!(f, "{table}")?;
            }
            if !left.is_empty() {
                let names = names(&left, "variables");
                writeln!(f, "  Left out, certainly {BELOW} of the variance: {names}")?;
            }
            let dependent =
                |own: &VariableInfluence| own.first.is_none() && own.correlation.is_some();
            if own.variables.iter().any(dependent) {
                let why = "no share of the variance belongs to one of them alone";
                writeln!(
                    f,
                    "  No Sobol' indices: the variables depend on each other, so {why}."
                )?;
            }
            if own.missing > 0 {
                writeln!(
                    f,
                    "  {} designs have no value and are left out.",
                    own.missing
                )?;
            }
        }
        Ok(())
    }
}
