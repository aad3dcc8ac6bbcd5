use eigentol_contract::DesignInfo;
use eigentol_results::naming::named;
use eigentol_results::numbers::{heading, per, rough, short};
use eigentol_results::relevance::{BELOW, CHANCE, largest, names, relevant};
use eigentol_results::title::title;
use eigentol_results::{Answer, Columns, Findings, Subject, displayed};

use super::words::ends;
use crate::judge::{chance, judged, verdict};
use crate::requirement::SecondOrderFailure;

/// `second-order failure`: one row; `probability by design`: a row for each design variable, per `unit` of its nominal
/// value and half-width.
impl Answer for SecondOrderFailure {
    const KIND: &'static str = "second-order failure";

    fn subject(&self) -> Option<Subject<'_>> {
        Some(Subject::at(&self.description, &self.inputs))
    }

    fn findings(&self) -> Findings {
        let d = &self.description;
        let mut said =
            Findings::titled(format!("{}: {}, to second order", title(d, &self.inputs), self.wanted.text(d)));
        self.row(&mut said);
        self.slopes(&mut said);
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
        for (info, slope) in d.inputs.iter().zip(slopes) {
            let slope = rough(slope * info.unit.scale);
            let by = heading(&info.name, &info.unit);
            said.note(format!("probability by {by}: {slope}"));
        }
        said
    }
}

displayed!(SecondOrderFailure);

impl SecondOrderFailure {
    fn row(&self, said: &mut Findings) {
        let Some(response) = self.wanted.response() else {
            return;
        };
        let (unit, margin) = (response.unit(&self.description), &self.margin);
        let bands = self.bands.iter().map(|(low, high)| ends(&[*low, *high], &unit));
        let bands = bands.collect::<Vec<_>>().join(", ");
        let corrected = &margin.corrected;
        let rows = [self];
        let mut table = Columns::new("second-order failure", &rows);
        table.words("requirement", &|_| Some(self.wanted.text(&self.description)));
        table.words("fails from", &|_| Some(bands.clone())).shown();
        table.measured("nominal", &unit, &|_| Some(margin.value)).shown();
        let sigma = table.measured("sigma", &unit, &|_| Some(margin.sigma));
        sigma.digits(rough);
        let distance = table.number("distance to band", "sigma", &|_| Some(margin.distance));
        distance.digits(short).headed("to band [sigma]");
        let first = table.number("probability of failure, first order", "", &|_| Some(margin.first_order));
        first.digits(|value| chance(value, 0.0)).headed("first order");
        table.number("probability of failure", "", &|_| Some(corrected.value));
        table.cells("second order", &|_| chance(corrected.value, corrected.error));
        let error = table.number("error of probability", "", &|_| Some(corrected.error));
        error.digits(|error| format!("{error:.1e}")).headed(match corrected.model_error {
            None => "integration error",
            Some(_) => "error of second order",
        });
        judged(&mut table, &|x| &x.judgement);
        said.columns(table);
    }

    /// The derivatives of the first-order probability: a row for each design variable.
    fn slopes(&self, said: &mut Findings) {
        let margin = &self.margin;
        let Some(slopes) = &margin.derivatives else {
            let why = match margin.sigma {
                0.0 => "nothing varies at first order",
                _ => "they exist for normal variables, and within the range of a double",
            };
            said.note(format!("No derivatives: {why}."));
            return;
        };
        let pairs = slopes.by_design.iter().zip(&slopes.by_half_width);
        let rows = self.description.design.iter().zip(pairs);
        let rows = rows.map(|(info, (nominal, half_width))| Slope { info, nominal: *nominal, half_width: *half_width });
        let rows: Vec<Slope<'_>> = rows.collect();
        let still = rows.iter().all(|row| row.largest() == 0.0);
        if still {
            said.note("No variable changes the probability, within the range of a double.");
        } else if margin.first_order < CHANCE {
            said.note("The tables show what changes so small a probability.");
        }
        let told = !still && margin.first_order >= CHANCE;
        slope_table(said, &rows, told);
    }
}

/// Derivatives of a probability with respect to the nominal value and half-width of a design variable, per SI unit.
struct Slope<'a> {
    info: &'a DesignInfo,
    nominal: f64,
    half_width: f64,
}

impl Slope<'_> {
    fn largest(&self) -> f64 {
        self.nominal.abs().max(self.half_width.abs())
    }

    /// The effect of a change as large as the nominal value.
    fn effect(&self) -> f64 {
        self.largest() * self.info.nominal.abs()
    }
}

/// The text, if anything is told, leaves out what has little effect.
fn slope_table(said: &mut Findings, rows: &[Slope<'_>], told: bool) {
    let most = largest(rows.iter().map(Slope::effect));
    let matters = |row: &Slope<'_>| row.info.nominal == 0.0 || relevant(row.effect(), most);
    let (shown, left): (Vec<usize>, Vec<usize>) = (0..rows.len()).partition(|&k| matters(&rows[k]));
    let mut table = Columns::new("probability by design", rows);
    table.show_rows(if told { shown } else { Vec::new() });
    table.words("by", &|row| Some(row.info.name.to_string()));
    table.words("unit", &|row| Some(row.info.unit.symbol.to_string()));
    table.cells("probability by", &|row| per(&row.info.name, &row.info.unit));
    let nominal = table.number("by nominal value", "per unit", &|row| Some(row.nominal * row.info.unit.scale));
    nominal.digits(rough).headed("nominal value");
    let half_width = table.number("by half-width", "per unit", &|row| Some(row.half_width * row.info.unit.scale));
    half_width.digits(rough).headed("half-width");
    said.columns(table);
    if told && !left.is_empty() {
        let left: Vec<&str> = left.iter().map(|&k| &*rows[k].info.name).collect();
        let names = names(&left, "variables");
        said.note(format!("Left out, {BELOW} of the largest effect: {names}"));
    }
}
