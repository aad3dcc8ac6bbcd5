use eigentol_results::numbers::{converted, given, number, or_dash, rough, short};
use eigentol_results::relevance::{NOTHING_VARIES, names, unless_rounding};
use eigentol_results::{Answer, Columns, Findings, Grid, Table, at_point, displayed};
use eigentol_statistics::reliability::sampling::wilson;

use super::samples::{origin, samples_columns};
use super::statistics::{outcome_rows, statistics};
use crate::modes::{Family, undamped};
use crate::tolerance::{MonteCarlo, Sample, Statistics};

/// `Monte Carlo`: a row for each mode; `outcomes`: a row for each outcome; `samples`: a row for each sample, if they
/// were kept. All include the seed and stream of the random numbers, if below 2^63.
impl Answer for MonteCarlo {
    const KIND: &'static str = "Monte Carlo";

    at_point!();

    fn findings(&self) -> Findings {
        let mut said =
            self.titled(format_args!("Monte Carlo with re-solved equilibria, {}: {}", self.drawn(), self.counts));
        self.modes_table(&mut said);
        self.outcomes_table(&mut said);
        if !self.varies {
            said.note(NOTHING_VARIES);
        }
        self.skewed(&mut said);
        undamped(&mut said, self.family, &self.description);
        self.remarks(&mut said);
        said
    }

    fn details(&self) -> Vec<Table> {
        self.all.iter().map(|all| self.samples_table(all)).collect()
    }
}

displayed!(MonteCarlo);

/// A mode and its statistics; the text has only modes that oscillate in some sample.
struct Row<'a> {
    mode: usize,
    frequency: Option<&'a Statistics>,
    damping: Option<&'a Statistics>,
}

/// Skewness above which mean and sigma do not describe a distribution: the 3-sigma tails differ by half.
const SKEWED: f64 = 0.1;
/// Normal probabilities below minus three and minus one sigma, the median, and plus one and plus three sigma.
const QUANTILES: [f64; 5] = [0.00135, 0.15866, 0.5, 0.84134, 0.99865];

/// The standard deviation, or zero if it is rounding compared to the mean.
fn sigma(of: &Statistics) -> Option<f64> {
    of.sigma.map(|sigma| unless_rounding(sigma, of.mean))
}

impl MonteCarlo {
    fn modes_table(&self, said: &mut Findings) {
        let modes = self.modes.iter().zip(&self.damping_ratios).enumerate();
        let rows = modes.map(|(r, (frequency, damping))| Row {
            mode: r + 1,
            frequency: frequency.as_ref(),
            damping: damping.as_ref(),
        });
        let rows: Vec<Row<'_>> = rows.collect();
        let (told, without): (Vec<usize>, Vec<usize>) = (0..rows.len()).partition(|&r| rows[r].frequency.is_some());
        let mut table = Columns::new("Monte Carlo", &rows);
        table.show_rows(told);
        table.whole("mode", &|row| Some(row.mode)).shown();
        statistics(&mut table, "frequency", "rad/s", &|row| row.frequency);
        statistics(&mut table, "damping ratio", "", &|row| row.damping);
        origin(&mut table, self);
        let unit = &self.description.frequency;
        let in_unit = |omega: f64| converted(omega, unit);
        let d = &*self.description;
        table.frequencies("mean", d, number, &|row| Some(row.frequency?.mean));
        let cell = |value: Option<f64>, form| or_dash(value.map(in_unit), form);
        table.cells("std. error", &|row| cell(row.frequency.and_then(|own| own.standard_error), short));
        table.frequencies("sigma", d, rough, &|row| sigma(row.frequency?));
        table.cells("min", &|row| cell(row.frequency.map(|own| own.min), number));
        table.cells("max", &|row| cell(row.frequency.map(|own| own.max), number));
        let complete = |statistics: &Statistics| statistics.count == self.counts.stable as u64;
        if !self.modes.iter().flatten().all(complete) {
            table.cells("samples", &|row| row.frequency.map_or(0, |frequency| frequency.count).to_string());
        }
        if self.family == Family::General {
            table.cells("damping ratio", &|row| or_dash(row.damping.map(|damping| damping.mean), rough));
            table.cells("sigma", &|row| or_dash(row.damping.and_then(|damping| damping.sigma), rough));
        }
        said.columns(table);
        if !without.is_empty() {
            let numbers: Vec<String> = without.iter().map(|r| (r + 1).to_string()).collect();
            let numbers: Vec<&str> = numbers.iter().map(String::as_str).collect();
            let word = if without.len() == 1 { "Mode" } else { "Modes" };
            let numbers = names(&numbers, "of them");
            said.note(format!("{word} {numbers}: no oscillation in any stable sample, so no frequency."));
        }
    }

    fn outcomes_table(&self, said: &mut Findings) {
        let rows = outcome_rows(&self.counts);
        let mut table = Columns::new("outcomes", &rows);
        table.words("outcome", &|row| Some(row.0.to_owned()));
        table.whole("samples", &|row| Some(row.1));
        // Of the stable samples.
        table.whole("on another branch", &|row| (row.0 == "stable").then_some(self.left_nominal_branch));
        origin(&mut table, self);
        said.columns(table);
    }

    fn samples_table(&self, all: &[Sample]) -> Table {
        let rows: Vec<_> = all.iter().enumerate().collect();
        let mut table = samples_columns(&self.description, self.modes.len(), &rows);
        origin(&mut table, self);
        table.finish().0
    }

    /// What one has to know to read the numbers.
    fn remarks(&self, said: &mut Findings) {
        if self.samples < self.planned {
            said.note(format!("Not complete: {} samples were asked for.", self.planned));
        }
        if self.side_by_side {
            said.note("Samples were solved side by side in vectors: solved one by one, the last bits would differ.");
        }
        if self.clustered {
            said.note("Modes with equal nominal eigenvalues count in ascending order in each sample.");
        }
        if self.left_nominal_branch > 0 {
            said.note(format!(
                "{} stable samples settled on another branch than the nominal one{}.",
                self.left_nominal_branch,
                share(self.left_nominal_branch, self.samples)
            ));
        }
    }

    /// The settings that reproduce the samples, in words: `4000 samples, seed 7`, with stream and ranges unless these
    /// are the first and all.
    #[must_use]
    pub fn drawn(&self) -> String {
        let mut text = format!("{} samples, seed {}", self.samples, self.seed);
        if self.stream > 0 {
            text += &format!(", stream {}", self.stream);
        }
        if self.samples < self.planned {
            let ranges = self.ranges.iter();
            let ranges = ranges.map(|range| match range.end.saturating_sub(1) {
                last if last == range.start => last.to_string(),
                last => format!("{} to {last}", range.start),
            });
            let ranges: Vec<String> = ranges.collect();
            if !ranges.is_empty() {
                text += &format!(", numbers {}", ranges.join(" and "));
            }
        }
        text
    }

    /// Quantiles of quantities that are not normally distributed.
    fn skewed(&self, said: &mut Findings) {
        let mut head = vec!["not symmetric".to_owned(), "skewness".to_owned()];
        head.extend(QUANTILES.map(|p| format!("{} %", given(100.0 * p))));
        let mut table = Grid::new(head);
        let frequencies = self.modes.iter().map(|mode| ("frequency", mode));
        let dampings = self.damping_ratios.iter().map(|damping_ratio| ("damping ratio", damping_ratio));
        for (r, (name, statistics)) in frequencies.enumerate().chain(dampings.enumerate()) {
            let Some((statistics, skewness)) = statistics.as_ref().and_then(|x| Some((x, x.skewness?))) else {
                continue;
            };
            let moves = statistics.sigma.is_some_and(|sigma| unless_rounding(sigma, statistics.mean) != 0.0);
            let told = statistics.skewness_error.is_some_and(|error| skewness.abs() > 4.0 * error);
            if skewness.abs() < SKEWED || !told || !moves {
                continue;
            }
            let quantile = |p: f64| or_dash(statistics.quantile(p).ok().map(|x| x.value), rough);
            let mut row = vec![format!("{name} {}", r + 1), format!("{skewness:+.2}")];
            row.extend(QUANTILES.map(quantile));
            table.row(row);
        }
        said.text(table);
    }
}

/// `: 7.3 % (95 %: 6.9 to 7.7 %)`.
fn share(count: usize, samples: usize) -> String {
    let percent = |value: f64| format!("{:.3}", 100.0 * value);
    match wilson(count as u64, samples as u64, 0.95) {
        Err(_) => String::new(),
        Ok(interval) => format!(
            ": {} % (95 %: {} to {} %)",
            percent(count as f64 / samples as f64),
            percent(interval.lower),
            percent(interval.upper)
        ),
    }
}
