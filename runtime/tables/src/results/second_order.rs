use eigentol::second_order::{Margin, ModeMargin, SecondOrder};

use super::Tables;
use super::names::{by, operating_point, per_unit};
use super::requirement::judged;
use crate::Table;

/// `second-order tolerances`: a row for each mode, empty and with the reason if the mode has no second-order result.
impl Tables for SecondOrder {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let mut table = Table::new("second-order tolerances");
        table.whole("mode", 1..=self.modes.len());
        for (name, unit) in [
            ("frequency", "rad/s"),
            ("natural frequency", "rad/s"),
            ("damping ratio", ""),
        ] {
            let spreads = self.modes.iter().map(|mode| {
                let mode = mode.as_ref().ok()?;
                Some(match name {
                    "frequency" => &mode.frequency,
                    "natural frequency" => &mode.natural_frequency,
                    _ => &mode.damping_ratio,
                })
            });
            let value = spreads.clone().map(|own| own.map(|own| own.model.value));
            table.numbers(name, unit, value);
            let moments = spreads.map(|own| own.map(|own| own.moments));
            let mean = moments.clone().map(|own| own.map(|own| own.mean));
            table.numbers(format!("mean of {name}"), unit, mean);
            let first = moments
                .clone()
                .map(|own| own.map(|own| own.first_order_sigma));
            table.numbers(format!("first-order sigma of {name}"), unit, first);
            let sigma = moments.clone().map(|own| own.map(|own| own.sigma));
            table.numbers(format!("sigma of {name}"), unit, sigma);
            let skewness = moments.clone().map(|own| own.map(|own| own.skewness));
            table.numbers(format!("skewness of {name}"), "", skewness);
            let kurtosis = moments.map(|own| own.map(|own| own.excess_kurtosis));
            table.numbers(format!("excess kurtosis of {name}"), "", kurtosis);
        }
        let reasons = self
            .modes
            .iter()
            .map(|mode| Some(mode.as_ref().err()?.to_string()));
        table.texts("error", reasons);
        let doubts = self.doubts.iter().map(|own| {
            let own: Vec<String> = own.iter().map(ToString::to_string).collect();
            (!own.is_empty()).then(|| own.join(" "))
        });
        table.texts("doubts", doubts);
        operating_point(&mut table, d, &self.inputs, None);
        vec![table]
    }
}

fn margin(table: &mut Table, margin: &Margin, unit: &str) {
    let (low, high) = margin.band;
    table.numbers("band from", unit, [low]);
    table.numbers("band to", unit, [high]);
    table.numbers("nominal", unit, [margin.value]);
    table.numbers("sigma", unit, [margin.sigma]);
    table.numbers("distance to band", "sigma", [margin.distance]);
    table.numbers("probability, first order", "", [margin.first_order]);
    table.numbers("probability", "", [margin.corrected.value]);
    table.numbers("error of probability", "", [margin.corrected.error]);
}

/// `margin`: one row; `probability by design`: a row for each design variable, per `unit` of its nominal value and
/// half-width.
impl Tables for ModeMargin {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let mut table = Table::new("margin");
        table.whole("mode", [self.mode + 1]);
        table.texts("quantity", [Some(self.quantity.to_string())]);
        margin(&mut table, &self.margin, &self.quantity.unit().symbol);
        judged(&mut table, [&self.judgement].into_iter());
        operating_point(&mut table, d, &self.inputs, None);
        let mut tables = vec![table];
        if let Some(slopes) = &self.margin.derivatives {
            let mut table = Table::new("probability by design");
            table.texts(
                "by",
                d.design.iter().map(|info| Some(info.name.to_string())),
            );
            table.texts("unit", d.design.iter().map(|info| by(&info.unit)));
            for (name, own) in [
                ("nominal value", &slopes.by_design),
                ("half-width", &slopes.by_half_width),
            ] {
                let own = d.design.iter().zip(own);
                let own = own.map(|(info, &slope)| per_unit(slope, &info.unit));
                table.numbers(format!("by {name}"), "per unit", own);
            }
            operating_point(&mut table, d, &self.inputs, None);
            tables.push(table);
        }
        tables
    }
}
