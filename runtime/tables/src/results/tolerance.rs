use eigentol::tolerance::{Counts, OutputTolerances, Spread, Statistics};
use eigentol::{Description, FirstOrder, MonteCarlo, Quantity};

use super::Tables;
use super::names::{behaviour, by, in_unit, operating_point, word};
use super::samples::{origin, samples_table};
use crate::Table;

/// Columns of one spread: mean, sigma, band.
fn spreads(
    table: &mut Table,
    quantity: Quantity,
    all: impl Iterator<Item = Option<Spread>> + Clone,
) {
    let unit = quantity.unit().symbol;
    let of = |pick: fn(&Spread) -> f64| all.clone().map(move |own| own.as_ref().map(pick));
    table.numbers(format!("{quantity}"), &unit, of(|own| own.mean));
    let sigma = of(|own| own.sigma);
    table.numbers(format!("sigma of {quantity}"), &unit, sigma);
    let band = of(|own| own.band);
    table.numbers(format!("band of {quantity}"), &unit, band);
}

/// One column for the variance share of each design variable.
fn shares<'a>(
    table: &mut Table,
    d: &Description,
    all: impl Iterator<Item = Option<&'a [f64]>> + Clone,
) {
    for (k, info) in d.design.iter().enumerate() {
        let share = move |own: Option<&[f64]>| own?.get(k).copied();
        let name = format!("variance share of {}", info.name);
        table.numbers(name, "", all.clone().map(share));
    }
}

/// `first-order tolerances`: a row for each mode; a cluster has no sigma. The shares are for the frequency, or for
/// `lambda` if the mode has no frequency.
impl Tables for FirstOrder {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let modes = self.modes.iter();
        let rows = self.modes.len();
        let mut table = Table::new("first-order tolerances");
        table.whole("mode", 1..=rows);
        for quantity in [
            Quantity::Frequency,
            Quantity::NaturalFrequency,
            Quantity::DampingRatio,
            Quantity::Growth,
        ] {
            let spread = modes
                .clone()
                .map(|mode| mode.of(quantity).filter(|_| !mode.clustered));
            spreads(&mut table, quantity, spread);
        }
        table.texts(
            "motion",
            modes.clone().map(|mode| behaviour(mode.behaviour)),
        );
        table.flags("cluster", modes.clone().map(|mode| mode.clustered));
        let distance = |pick: fn(&_) -> f64| modes.clone().map(pick);
        let critical =
            distance(|mode: &eigentol::tolerance::ModeTolerance| mode.distance_to_critical);
        table.numbers("distance to critical", "sigma", critical);
        let instability = distance(|mode| mode.distance_to_instability);
        table.numbers("distance to instability", "sigma", instability);
        let neighbour = distance(|mode| mode.distance_to_neighbour);
        table.numbers("distance to neighbour", "sigma", neighbour);
        let doubts = (0..rows).map(|mode| {
            let own = self.doubts(mode);
            let own: Vec<String> = own.iter().map(ToString::to_string).collect();
            (!own.is_empty()).then(|| own.join(" "))
        });
        table.texts("doubts", doubts);
        table.numbers("sigma level", "", vec![self.sigma_level; rows]);
        let share = modes.map(|mode| (!mode.clustered).then(|| mode.variance_shares()));
        shares(&mut table, d, share);
        operating_point(&mut table, d, &self.inputs, None);
        vec![table]
    }
}

/// `output tolerances`: a row for each output, numbers in its `unit`.
impl Tables for OutputTolerances {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let outputs = || d.outputs.iter().zip(&self.spreads);
        let mut table = Table::new("output tolerances");
        let names = outputs().map(|(info, _)| Some(info.name.to_string()));
        table.texts("output", names);
        table.texts("unit", outputs().map(|(info, _)| by(&info.unit)));
        let means = outputs().zip(&self.values).map(|((info, own), &nominal)| {
            in_unit(own.as_ref().map_or(nominal, |own| own.mean), &info.unit)
        });
        table.numbers("mean", "", means);
        for (name, pick) in [
            ("sigma", (|own| own.sigma) as fn(&Spread) -> f64),
            ("band", |own| own.band),
        ] {
            let value =
                outputs().map(|(info, own)| own.as_ref().map(|own| in_unit(pick(own), &info.unit)));
            table.numbers(name, "", value);
        }
        table.numbers("sigma level", "", vec![self.sigma_level; table.rows()]);
        let share = self.spreads.iter();
        let share = share.map(|own| own.as_ref().map(|own| &own.variance_shares[..]));
        shares(&mut table, d, share);
        operating_point(&mut table, d, &self.inputs, None);
        vec![table]
    }
}

/// Columns of statistics over samples.
pub(super) fn statistics<'a>(
    table: &mut Table,
    name: &str,
    unit: &str,
    all: impl Iterator<Item = Option<&'a Statistics>> + Clone,
) {
    let count = all
        .clone()
        .map(|own| own.map_or(0, |own| own.count as usize));
    table.whole(format!("samples of {name}"), count);
    for (what, unit, pick) in [
        (
            "mean",
            unit,
            (|own| Some(own.mean)) as fn(&Statistics) -> Option<f64>,
        ),
        ("standard error", unit, |own| own.standard_error),
        ("sigma", unit, |own| own.sigma),
        ("skewness", "", |own| own.skewness),
        ("least", unit, |own| Some(own.min)),
        ("greatest", unit, |own| Some(own.max)),
    ] {
        let values = all.clone().map(|own| own.and_then(pick));
        table.numbers(format!("{what} of {name}"), unit, values);
    }
}

/// Counts of sample outcomes: a row for each.
pub(super) fn outcomes(counts: &Counts) -> Table {
    let all = [
        ("stable", counts.stable),
        ("divergent", counts.divergent),
        ("flutter", counts.flutter),
        ("undecided", counts.undecided),
        ("no equilibrium", counts.no_equilibrium),
        ("not assembled", counts.not_assembled),
        ("unphysical", counts.unphysical),
        ("no modes", counts.no_modes),
    ];
    let mut table = Table::new("outcomes");
    table.texts("outcome", all.map(|(name, _)| word(name)));
    table.whole("samples", all.map(|(_, count)| count));
    table
}

/// `Monte Carlo`: a row for each mode; `outcomes`: a row for each outcome; `samples`: a row for each sample, if they
/// were kept. All include the seed and stream of the random numbers, if below 2^63.
impl Tables for MonteCarlo {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let mut table = Table::new("Monte Carlo");
        table.whole("mode", 1..=self.modes.len());
        let modes = self.modes.iter().map(Option::as_ref);
        statistics(&mut table, "frequency", "rad/s", modes);
        let damping = self.damping_ratios.iter().map(Option::as_ref);
        statistics(&mut table, "damping ratio", "", damping);
        origin(&mut table, self);
        let mut outcomes = outcomes(&self.counts);
        // Of the stable samples, which come first.
        let elsewhere =
            (0..outcomes.rows()).map(|row| (row == 0).then_some(self.left_nominal_branch));
        outcomes.whole("on another branch", elsewhere);
        origin(&mut outcomes, self);
        let mut tables = vec![table, outcomes];
        if let Some(all) = &self.all {
            let mut samples = samples_table(d, 0, all);
            origin(&mut samples, self);
            tables.push(samples);
        }
        tables
    }
}
