use eigentol_results::numbers::{CLUSTER, converted, heading, number, of_mode, or_dash, rough, short};
use eigentol_results::relevance::{NOTHING_VARIES, unless_rounding};
use eigentol_results::shares::Shares;
use eigentol_results::{Answer, Columns, Findings, at_point, displayed};

use super::doubts::{doubted, joined};
use crate::modes::{Family, undamped};
use crate::sensitivity::Quantity;
use crate::tolerance::{Doubt, FirstOrder, ModeTolerance, Spread};

/// The standard deviation, or zero if it is rounding compared to the mean.
pub fn spread_of(spread: &Spread) -> f64 {
    unless_rounding(spread.sigma, spread.mean)
}

/// A distance in standard deviations; `-` if it is infinite.
pub fn far(distance: f64) -> String {
    or_dash(Some(distance).filter(|distance| distance.is_finite()), short)
}

/// Whether no tolerance moves the mode, alone or relative to others.
pub fn unmoved(mode: &ModeTolerance) -> bool {
    let moved = |spread: Option<Spread>| spread.is_some_and(|spread| spread_of(&spread) != 0.0);
    !mode.clustered
        && mode.distance_to_neighbour == f64::INFINITY
        && mode.lambda.sigma == 0.0
        && !moved(mode.growth())
        && !moved(mode.damping_ratio())
}

/// `first-order tolerances`: a row for each mode; a cluster has no sigma. The shares are for the frequency, or for
/// `lambda` if the mode has no frequency.
impl Answer for FirstOrder {
    const KIND: &'static str = "first-order tolerances";

    at_point!();

    fn findings(&self) -> Findings {
        let mut said = self.titled("first-order spread of the frequencies");
        let doubts: Vec<Vec<Doubt>> = (0..self.modes.len()).map(|mode| self.doubts(mode)).collect();
        let moved = self.varies && !self.modes.iter().all(unmoved);
        self.spreads(&mut said, &doubts, moved);
        if !self.varies {
            said.note(NOTHING_VARIES);
        } else if !moved {
            said.note("No tolerance moves a mode.");
        } else {
            self.rates(&mut said);
        }
        undamped(&mut said, self.family, &self.description);
        doubted(&mut said, &doubts);
        if self.modes.len() > 1 {
            said.note(
                "Each mode is taken alone: `summary` also checks which modes mix and how nonlinear frequencies are.",
            );
        }
        said
    }
}

displayed!(FirstOrder);

/// A mode, counted from 1, and the doubts about it.
struct Row<'a> {
    number: usize,
    mode: &'a ModeTolerance,
    doubts: &'a [Doubt],
}

impl Row<'_> {
    fn alone(&self) -> bool {
        !self.mode.clustered
    }

    /// A spread in the text, where a cluster has none.
    fn sigma(&self, of: Option<Spread>) -> String {
        of_mode(of.as_ref().map(spread_of), self.mode.clustered, rough)
    }

    fn shares(&self) -> Option<&[f64]> {
        self.alone().then(|| self.mode.variance_shares())
    }

    fn distance(&self, distance: f64) -> String {
        if self.alone() { far(distance) } else { CLUSTER.to_owned() }
    }
}

impl FirstOrder {
    /// The spread of every mode and its sources; without its text where nothing is moved.
    fn spreads(&self, said: &mut Findings, doubts: &[Vec<Doubt>], moved: bool) {
        let d = &self.description;
        let rows =
            self.modes.iter().zip(doubts).enumerate().map(|(r, (mode, doubts))| Row { number: r + 1, mode, doubts });
        let rows: Vec<Row<'_>> = rows.collect();
        let mut table = Columns::new("first-order tolerances", &rows);
        if !moved {
            table.show_rows(Vec::new());
        }
        table.whole("mode", &|row| Some(row.number)).shown();
        let general = self.family == Family::General;
        for quantity in Quantity::ALL {
            self.spread_columns(&mut table, quantity, general);
        }
        table.words("motion", &|row| Some(row.mode.behaviour.word().to_owned()));
        table.flag("cluster", &|row| Some(row.mode.clustered));
        table.number("distance to critical", "sigma", &|row| Some(row.mode.distance_to_critical));
        table.number("distance to instability", "sigma", &|row| Some(row.mode.distance_to_instability));
        table.number("distance to neighbour", "sigma", &|row| Some(row.mode.distance_to_neighbour));
        if general {
            table.cells("to instability [sigma]", &|row| row.distance(row.mode.distance_to_instability));
        }
        table.cells("to critical [sigma]", &|row| row.distance(row.mode.distance_to_critical));
        table.words("doubts", &|row| joined(row.doubts));
        table.number("sigma level", "", &|_| Some(self.sigma_level));
        table.shares(d, &Row::shares);
        let shares = Shares::of(d, rows.iter().filter_map(Row::shares));
        shares.columns(&mut table, &Row::shares);
        said.columns(table);
        if moved {
            shares.rest(said);
        }
    }

    /// Mean, sigma and band of one quantity. The text shows frequencies and, of general modes, damping ratios.
    fn spread_columns(&self, table: &mut Columns<'_, Row<'_>>, quantity: Quantity, general: bool) {
        let unit = quantity.unit().symbol;
        let of = |row: &Row<'_>| row.mode.of(quantity).filter(|_| row.alone());
        table.number(&quantity.to_string(), &unit, &|row| Some(of(row)?.mean));
        table.number(&format!("sigma of {quantity}"), &unit, &|row| Some(of(row)?.sigma));
        table.number(&format!("band of {quantity}"), &unit, &|row| Some(of(row)?.band));
        match quantity {
            Quantity::Frequency => {
                let d = &*self.description;
                let unit = &d.frequency;
                let sigma = |row: &Row<'_>| row.mode.frequency().as_ref().map(|own| converted(spread_of(own), unit));
                table.frequencies("mean", d, number, &|row| {
                    let nominal = row.mode.behaviour.frequency();
                    of(row).map(|x| x.mean).or(nominal)
                });
                table.cells(&heading("sigma", unit), &|row| of_mode(sigma(row), row.mode.clustered, rough));
                table.cells(&heading(&format!("{} sigma", self.sigma_level), unit), &|row| {
                    of_mode(sigma(row).map(|sigma| sigma * self.sigma_level), row.mode.clustered, rough)
                });
            }
            Quantity::DampingRatio if general => {
                table.cells("damping ratio", &|row| or_dash(row.mode.damping_ratio().map(|x| x.mean), rough));
                table.cells("sigma", &|row| row.sigma(row.mode.damping_ratio()));
            }
            _ => {}
        }
    }

    /// The rates of modes without a frequency.
    fn rates(&self, said: &mut Findings) {
        for (r, mode) in self.modes.iter().enumerate() {
            let rate = mode
                .growth()
                .filter(|item| mode.behaviour.frequency().is_none() && !mode.clustered && spread_of(item) != 0.0);
            let Some(rate) = rate else { continue };
            let verb = if rate.mean > 0.0 { "grows" } else { "decays" };
            said.note(format!(
                "Mode {} {verb} at {} 1/s, sigma {} 1/s.",
                r + 1,
                number(rate.mean.abs()),
                rough(rate.sigma)
            ));
        }
    }
}
