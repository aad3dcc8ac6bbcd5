use eigentol_results::naming::named;
use eigentol_results::numbers::{heading, rough};
use eigentol_results::relevance::CHANCE;
use eigentol_results::{Answer, Columns, Findings, Subject, Table, displayed};

use super::MarginTable;
use crate::judge::{judged, verdict};
use crate::second_order::ModeMargin;

/// `margin`: one row; `probability by design`: a row for each design variable, per `unit` of its nominal value and
/// half-width.
impl Answer for ModeMargin {
    const KIND: &'static str = "margin";

    fn subject(&self) -> Option<Subject<'_>> {
        Some(Subject::at(&self.description, &self.inputs))
    }

    fn findings(&self) -> Findings {
        let table = MarginTable {
            inputs: &self.inputs,
            margin: &self.margin,
            quantity: &format!("{} {}", self.quantity, self.mode + 1),
            unit: self.quantity.unit(),
            description: &self.description,
        };
        let mut said = table.probabilities();
        said.data(self.row());
        table.slopes(&mut said);
        said.note(format!("Designs solved anew: {}.", self.judgement));
        if self.judgement.judged().is_some() {
            let of = |claimed| verdict(&self.judgement, claimed);
            let [first, second] = [self.margin.first_order, self.margin.corrected.value].map(of);
            said.note(format!("First order: {first}; second order: {second}."));
        }
        if !self.mixed_with.is_empty() {
            said.note(format!(
                "Tolerances mix this mode with {}: no model of it alone can be relied on.",
                named(&self.mixed_with)
            ));
        }
        let told = self.margin.first_order >= CHANCE;
        let slopes = self.by_input.iter().filter(|_| told).flatten();
        for (info, slope) in self.description.inputs.iter().zip(slopes) {
            let slope = rough(slope * info.unit.scale);
            let by = heading(&info.name, &info.unit);
            said.note(format!("probability by {by}: {slope}"));
        }
        said
    }
}

displayed!(ModeMargin);

impl ModeMargin {
    fn row(&self) -> Table {
        let (low, high) = self.margin.band;
        let unit = self.quantity.unit().symbol;
        let rows = [self];
        let mut table = Columns::new("margin", &rows);
        table.whole("mode", &|own| Some(own.mode + 1));
        table.words("quantity", &|own| Some(own.quantity.to_string()));
        table.number("band from", &unit, &|_| Some(low));
        table.number("band to", &unit, &|_| Some(high));
        table.number("nominal", &unit, &|own| Some(own.margin.value));
        table.number("sigma", &unit, &|own| Some(own.margin.sigma));
        table.number("distance to band", "sigma", &|own| {
            Some(own.margin.distance)
        });
        table.number("probability, first order", "", &|own| {
            Some(own.margin.first_order)
        });
        table.number("probability", "", &|own| Some(own.margin.corrected.value));
        table.number("error of probability", "", &|own| {
            Some(own.margin.corrected.error)
        });
        judged(&mut table, &|own| &own.judgement);
        table.finish().0
    }
}
