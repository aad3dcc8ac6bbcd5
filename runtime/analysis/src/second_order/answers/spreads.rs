use eigentol_results::numbers::{converted, number, or_dash, rough};
use eigentol_results::relevance::{NOTHING_VARIES, unless_rounding};
use eigentol_results::{Answer, Columns, Findings, at_point, displayed};

use crate::second_order::{ModeSecondOrder, ModelMoments, SecondOrder, SecondOrderSpread};
use crate::tolerance::Doubt;
use crate::tolerance::{doubted, joined};
use crate::{Description, Error};

/// `second-order tolerances`: a row for each mode, empty and with the reason if the mode has no second-order result.
impl Answer for SecondOrder {
    const KIND: &'static str = "second-order tolerances";

    at_point!();

    fn findings(&self) -> Findings {
        let mut said = self.titled("spread of the frequencies to second order");
        let rows = self.rows();
        spreads(&mut said, &self.description, &rows);
        if !self.varies {
            said.note(NOTHING_VARIES);
        }
        for row in &rows {
            if let Err(error) = row.mode {
                said.note(format!("Mode {}: {error}.", row.number));
            }
        }
        let known = rows.iter().map(|row| match row.mode {
            Ok(_) => row.doubts,
            Err(_) => &[],
        });
        doubted(&mut said, &known.collect::<Vec<_>>());
        said
    }
}

displayed!(SecondOrder);

/// A mode, counted from 1.
struct Row<'a> {
    number: usize,
    mode: &'a Result<ModeSecondOrder, Error>,
    doubts: &'a [Doubt],
}

impl Row<'_> {
    fn spread(&self, of: Quantity) -> Option<&SecondOrderSpread> {
        Some(of(self.mode.as_ref().ok()?))
    }

    fn moments(&self, of: Quantity) -> Option<ModelMoments> {
        Some(self.spread(of)?.moments)
    }

    /// A number of the text, which has no modes without a result.
    fn cell(&self, of: Quantity, text: fn(&SecondOrderSpread) -> String) -> String {
        self.spread(of).map_or_else(|| "-".to_owned(), text)
    }
}

type Quantity = fn(&ModeSecondOrder) -> &SecondOrderSpread;

const FREQUENCY: Quantity = |mode| &mode.frequency;
const NATURAL_FREQUENCY: Quantity = |mode| &mode.natural_frequency;
const DAMPING_RATIO: Quantity = |mode| &mode.damping_ratio;

impl SecondOrder {
    fn rows(&self) -> Vec<Row<'_>> {
        self.modes
            .iter()
            .zip(&self.doubts)
            .enumerate()
            .map(|(r, (mode, doubts))| Row { number: r + 1, mode, doubts })
            .collect()
    }
}

fn spreads(said: &mut Findings, d: &Description, rows: &[Row<'_>]) {
    let mut table = Columns::new("second-order tolerances", rows);
    table.show_rows((0..rows.len()).filter(|r| rows[*r].mode.is_ok()).collect());
    table.whole("mode", &|row| Some(row.number)).shown();
    moments(&mut table, "frequency", "rad/s", FREQUENCY);
    moments(&mut table, "natural frequency", "rad/s", NATURAL_FREQUENCY);
    moments(&mut table, "damping ratio", "", DAMPING_RATIO);
    table.words("error", &|row| Some(row.mode.as_ref().err()?.to_string()));
    table.words("doubts", &|row| joined(row.doubts));
    let frequency = |row: &Row<'_>| row.spread(FREQUENCY).map(|spread| spread.moments);
    table.frequencies("nominal", d, number, &|row| Some(row.spread(FREQUENCY)?.model.value));
    table.frequencies("mean", d, number, &|row| Some(frequency(row)?.mean));
    let unit = &d.frequency;
    table.cells("sigma, first order", &|row| {
        let own = frequency(row).map(|own| unless_rounding(own.first_order_sigma, own.mean));
        or_dash(own.map(|own| converted(own, unit)), rough)
    });
    table.frequencies("sigma", d, rough, &|row| {
        let own = frequency(row)?;
        Some(unless_rounding(own.sigma, own.mean))
    });
    table.cells("skewness", &|row| row.cell(FREQUENCY, |spread| format!("{:+.3}", spread.moments.skewness)));
    table.cells("damping ratio, mean", &|row| row.cell(DAMPING_RATIO, |spread| rough(spread.moments.mean)));
    table.cells("sigma", &|row| row.cell(DAMPING_RATIO, |spread| sigma(spread.moments.sigma, spread.moments.mean)));
    said.columns(table);
}

/// Columns of data: value, mean, standard deviations and shape of a quantity.
fn moments(table: &mut Columns<'_, Row<'_>>, name: &str, unit: &str, of: Quantity) {
    table.number(name, unit, &|row| Some(row.spread(of)?.model.value));
    type Pick = fn(ModelMoments) -> f64;
    let picks: [(&str, &str, Pick); 5] = [
        ("mean", unit, |x| x.mean),
        ("first-order sigma", unit, |x| x.first_order_sigma),
        ("sigma", unit, |x| x.sigma),
        ("skewness", "", |x| x.skewness),
        ("excess kurtosis", "", |x| x.excess_kurtosis),
    ];
    for (what, unit, pick) in picks {
        table.number(&format!("{what} of {name}"), unit, &|row| Some(pick(row.moments(of)?)));
    }
}

fn sigma(value: f64, mean: f64) -> String {
    rough(unless_rounding(value, mean))
}
