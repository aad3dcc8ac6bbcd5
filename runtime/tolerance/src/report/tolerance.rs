//! Tolerances as text.

use core::fmt;

use eigentol_statistics::reliability::sampling::wilson;

use super::doubts::doubted;
use crate::modes::Family;
use crate::tolerance::{Counts, Doubt, ModeTolerance, OutputTolerances, Spread, Statistics};
use crate::{FirstOrder, MonteCarlo};
use eigentol_results::numbers::{
    CLUSTER, given, heading, number, of_mode, optional, or_dash, rough, short,
};
use eigentol_results::relevance::{NOTHING_VARIES, names, unless_rounding};
use eigentol_results::shares::Shares;
use eigentol_results::table::{Table, cells};
use eigentol_results::title::title;
use eigentol_solve::report::undamped;

/// The standard deviation, or zero if it is rounding compared to the mean.
pub fn spread_of(spread: &Spread) -> f64 {
    unless_rounding(spread.sigma, spread.mean)
}

impl fmt::Display for OutputTolerances {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        let title = title(d, &self.inputs);
        writeln!(f, "{title}: first-order spread of the outputs")?;
        let mut head = cells(["output", "mean", "sigma"]);
        head.push(format!("{} sigma", self.sigma_level));
        let spreads = self.spreads.iter().flatten();
        let moved = spreads.filter(|own| spread_of(own) != 0.0);
        let shares = Shares::of(d, moved.map(|own| &own.variance_shares[..]));
        head.extend(shares.head());
        let mut table = Table::new(head);
        let values = self.values.iter().zip(&self.spreads);
        for (info, (value, own)) in d.outputs.iter().zip(values) {
            let scaled = |value: f64| value / info.unit.scale;
            let own = own.as_ref();
            let sigma = own.map(|own| scaled(spread_of(own)));
            let mut row = vec![
                heading(&info.name, &info.unit),
                optional(Some(scaled(own.map_or(*value, |own| own.mean)))),
                or_dash(sigma, rough),
                or_dash(sigma.map(|sigma| sigma * self.sigma_level), rough),
            ];
            let moved = own.filter(|_| sigma != Some(0.0));
            row.extend(shares.cells(moved.map(|own| &own.variance_shares[..])));
            table.row(row);
        }
        write!(f, "{table}")?;
        if !self.varies {
            writeln!(f, "  {NOTHING_VARIES}")?;
        }
        shares.rest(f)
    }
}

/// A distance in standard deviations; `-` if it is infinite.
pub fn far(distance: f64) -> String {
    or_dash(
        Some(distance).filter(|distance| distance.is_finite()),
        short,
    )
}

/// Whether no tolerance moves the mode, alone or relative to others.
pub fn unmoved(mode: &ModeTolerance) -> bool {
    let moved = |spread: Option<Spread>| spread.is_some_and(|own| spread_of(&own) != 0.0);
    !mode.clustered
        && mode.distance_to_neighbour == f64::INFINITY
        && mode.lambda.sigma == 0.0
        && !moved(mode.growth())
        && !moved(mode.damping_ratio())
}

impl fmt::Display for FirstOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        let title = title(d, &self.inputs);
        writeln!(f, "{title}: first-order spread of the frequencies")?;
        if !self.varies {
            writeln!(f, "  {NOTHING_VARIES}")?;
        } else if self.modes.iter().all(unmoved) {
            writeln!(f, "  No tolerance moves a mode.")?;
        } else {
            self.spreads(f)?;
        }
        undamped(f, self.family, d)?;
        let doubts: Vec<Vec<Doubt>> = (0..self.modes.len())
            .map(|mode| self.doubts(mode))
            .collect();
        doubted(f, &doubts)?;
        if self.modes.len() > 1 {
            writeln!(
                f,
                "  Each mode is taken alone: `summary` also checks which modes mix and how nonlinear frequencies are."
            )?;
        }
        Ok(())
    }
}

impl FirstOrder {
    /// The spread of every mode and its sources.
    fn spreads(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        let general = self.family == Family::General;
        let mut head = cells(["mode", "mean [rad/s]", "sigma [rad/s]"]);
        head.push(format!("{} sigma [rad/s]", self.sigma_level));
        if general {
            head.extend(cells(["damping ratio", "sigma", "to instability [sigma]"]));
        }
        head.push("to critical [sigma]".to_owned());
        let alone = self.modes.iter().filter(|mode| !mode.clustered);
        let shares = Shares::of(d, alone.map(ModeTolerance::variance_shares));
        head.extend(shares.head());
        let mut table = Table::new(head);
        for (r, mode) in self.modes.iter().enumerate() {
            let own = |value: Option<f64>| of_mode(value, mode.clustered, rough);
            let away = |distance: f64| match mode.clustered {
                true => CLUSTER.to_owned(),
                false => far(distance),
            };
            let (frequency, damping) = (mode.frequency(), mode.damping_ratio());
            let sigma = frequency.as_ref().map(spread_of);
            let alone = frequency.as_ref().filter(|_| !mode.clustered);
            let mean = alone.map(|spread| spread.mean);
            let mut row = vec![
                (r + 1).to_string(),
                optional(mean.or(mode.behaviour.frequency())),
                own(sigma),
                own(sigma.map(|sigma| sigma * self.sigma_level)),
            ];
            if general {
                row.push(or_dash(damping.as_ref().map(|spread| spread.mean), rough));
                row.push(own(damping.as_ref().map(spread_of)));
                row.push(away(mode.distance_to_instability));
            }
            row.push(away(mode.distance_to_critical));
            row.extend(shares.cells((!mode.clustered).then(|| mode.variance_shares())));
            table.row(row);
        }
        write!(f, "{table}")?;
        shares.rest(f)?;
        for (r, mode) in self.modes.iter().enumerate() {
            let grows = mode.growth().filter(|own| {
                mode.behaviour.frequency().is_none() && !mode.clustered && spread_of(own) != 0.0
            });
            if let Some(own) = grows {
                let verb = if own.mean > 0.0 { "grows" } else { "decays" };
                let (rate, sigma) = (number(own.mean.abs()), rough(own.sigma));
                writeln!(
                    f,
                    "  Mode {} {verb} at {rate} 1/s, sigma {sigma} 1/s.",
                    r + 1
                )?;
            }
        }
        Ok(())
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} stable", self.stable)?;
        for (number, name) in [
            (self.divergent, "divergent"),
            (self.flutter, "in flutter"),
            (self.undecided, "of undecided stability"),
            (self.no_equilibrium, "without equilibrium"),
            (self.not_assembled, "not assembled"),
            (self.unphysical, "unphysical"),
            (self.no_modes, "without modes"),
        ] {
            if number > 0 {
                write!(f, ", {number} {name}")?;
            }
        }
        Ok(())
    }
}

impl fmt::Display for MonteCarlo {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{}: Monte Carlo with re-solved equilibria, {}: {}",
            title(&self.description, &self.inputs),
            self.drawn(),
            self.counts
        )?;
        let general = self.family == Family::General;
        let complete = |own: &Statistics| own.count == self.counts.stable as u64;
        let all = self.modes.iter().flatten().all(complete);
        let mut head = cells([
            "mode",
            "mean [rad/s]",
            "std. error",
            "sigma [rad/s]",
            "min",
            "max",
        ]);
        if !all {
            head.push("samples".to_owned());
        }
        if general {
            head.extend(cells(["damping ratio", "sigma"]));
        }
        let mut table = Table::new(head);
        let mut without = Vec::new();
        for (r, mode) in self.modes.iter().enumerate() {
            let Some(own) = mode else {
                without.push((r + 1).to_string());
                continue;
            };
            let mut row = vec![
                (r + 1).to_string(),
                number(own.mean),
                or_dash(own.standard_error, short),
                or_dash(
                    own.sigma.map(|sigma| unless_rounding(sigma, own.mean)),
                    rough,
                ),
                number(own.min),
                number(own.max),
            ];
            if !all {
                row.push(own.count.to_string());
            }
            if general {
                let damping = self.damping_ratios[r].as_ref();
                row.push(or_dash(damping.map(|own| own.mean), rough));
                row.push(or_dash(damping.and_then(|own| own.sigma), rough));
            }
            table.row(row);
        }
        if !table.is_empty() {
            write!(f, "{table}")?;
        }
        if !without.is_empty() {
            let names: Vec<&str> = without.iter().map(String::as_str).collect();
            let names = names_of_modes(&names);
            writeln!(
                f,
                "  {names}: no oscillation in any stable sample, so no frequency."
            )?;
        }
        if !self.varies {
            writeln!(f, "  {NOTHING_VARIES}")?;
        }
        self.skewed(f)?;
        undamped(f, self.family, &self.description)?;
        if self.samples < self.planned {
            writeln!(
                f,
                "  Not complete: {} samples were asked for.",
                self.planned
            )?;
        }
        if self.side_by_side {
            writeln!(
                f,
                "  Samples were solved side by side in vectors: solved one by one, the last bits would differ."
            )?;
        }
        if self.clustered {
            writeln!(
                f,
                "  Modes with equal nominal eigenvalues count in ascending order in each sample."
            )?;
        }
        if self.left_nominal_branch > 0 {
            writeln!(
                f,
                "  {} stable samples settled on another branch than the nominal one{}.",
                self.left_nominal_branch,
                share(self.left_nominal_branch, self.samples)
            )?;
        }
        Ok(())
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

fn names_of_modes(numbers: &[&str]) -> String {
    let word = if numbers.len() == 1 { "Mode" } else { "Modes" };
    format!("{word} {}", names(numbers, "of them"))
}

/// Skewness above which mean and sigma do not describe a distribution: the 3-sigma tails differ by half.
const SKEWED: f64 = 0.1;
/// Normal probabilities below minus three and minus one sigma, the median, and plus one and plus three sigma.
const QUANTILES: [f64; 5] = [0.00135, 0.15866, 0.5, 0.84134, 0.99865];

impl MonteCarlo {
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
            let ranges = ranges.map(|own| match own.end.saturating_sub(1) {
                last if last == own.start => last.to_string(),
                last => format!("{} to {last}", own.start),
            });
            let ranges: Vec<String> = ranges.collect();
            if !ranges.is_empty() {
                text += &format!(", numbers {}", ranges.join(" and "));
            }
        }
        text
    }

    /// Quantiles of quantities that are not normally distributed.
    fn skewed(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut head = cells(["not symmetric", "skewness"]);
        head.extend(QUANTILES.map(|p| format!("{} %", given(100.0 * p))));
        let mut table = Table::new(head);
        let frequencies = self.modes.iter().map(|own| ("frequency", own));
        let dampings = self.damping_ratios.iter().map(|own| ("damping ratio", own));
        let both = frequencies.enumerate().chain(dampings.enumerate());
        for (r, (name, own)) in both {
            let Some((own, skewness)) = own.as_ref().and_then(|own| Some((own, own.skewness?)))
            else {
                continue;
            };
            let moves = own
                .sigma
                .is_some_and(|sigma| unless_rounding(sigma, own.mean) != 0.0);
            let told = own
                .skewness_error
                .is_some_and(|error| skewness.abs() > 4.0 * error);
            if skewness.abs() < SKEWED || !told || !moves {
                continue;
            }
            let quantile = |p: f64| or_dash(own.quantile(p).ok().map(|own| own.value), rough);
            let mut row = vec![format!("{name} {}", r + 1), format!("{skewness:+.2}")];
            row.extend(QUANTILES.map(quantile));
            table.row(row);
        }
        if table.is_empty() {
            return Ok(());
        }
        write!(f, "{table}")
    }
}
