use eigentol_results::numbers::{converted, heading, number, or_dash, rough};
use eigentol_results::relevance::{NOTHING_VARIES, unless_rounding};
use eigentol_results::shares::mostly;
use eigentol_results::{Answer, Columns, Findings, Listed, at_point, displayed};

use crate::Quantity;
use crate::clusters::ClusterTolerance;
use crate::judge::Doubt;
use crate::modes::{Behaviour, undamped};
use crate::summary::{Advice, Summary, Trust};
use crate::tolerance::{ModeTolerance, Spread, far, spread_of, unmoved};

/// `summary`: a row for each mode, with the sigmas of all methods and the recommended method; `doubts`: a row for each
/// reason not to trust first order; those of the clusters, if any.
impl Answer for Summary {
    const KIND: &'static str = "summary";

    at_point!();

    fn findings(&self) -> Findings {
        let d = &self.description;
        let mut said = self.titled("what tolerances do to the frequencies");
        let moved = self.first.varies && !self.unmoved();
        self.frequencies(&mut said, moved);
        if moved {
            self.damping_ratios(&mut said);
        } else if self.first.varies {
            said.note("No tolerance moves a mode.");
        } else {
            said.note(NOTHING_VARIES);
        }
        self.doubted(&mut said);
        undamped(&mut said, self.first.family, d);
        for sentence in self.sentences() {
            said.note(sentence.text);
        }
        self.mixed(&mut said);
        said
    }
}

displayed!(Summary);

/// A mode and the verdict on it.
struct Row<'a> {
    /// Position of the mode, from 0.
    mode: usize,
    first: &'a ModeTolerance,
    trust: &'a Trust,
    /// Whether it is no member of a cluster, and so has a sigma of its own.
    alone: bool,
}

impl Row<'_> {
    fn spread(&self) -> Option<Spread> {
        self.first.frequency().filter(|_| self.alone)
    }

    /// The first-order standard deviation that the text shows.
    fn sigma(&self) -> Option<f64> {
        self.spread().as_ref().map(spread_of)
    }

    fn sampled(&self, quantity: Quantity) -> Option<f64> {
        Some(self.trust.check(quantity)?.sigma.value)
    }
}

impl Advice {
    /// The method in words, as tables name it.
    fn word(self) -> &'static str {
        match self {
            Self::FirstOrder => "first order",
            Self::SecondOrder => "second order",
            Self::Cluster => "cluster",
            Self::Sampling => "samples",
        }
    }
}

fn verdict(doubts: &[Doubt]) -> &'static str {
    match doubts {
        [] => "yes",
        doubts if doubts.iter().any(Doubt::shared) => "cluster",
        [Doubt::NoFrequency, ..] => "-",
        _ => "no",
    }
}

impl Summary {
    /// Whether no tolerance moves a mode or mixes it with others.
    pub(super) fn unmoved(&self) -> bool {
        self.clusters.is_empty() && self.first.modes.iter().all(unmoved)
    }

    fn rows(&self) -> Vec<Row<'_>> {
        let modes = self.first.modes.iter().zip(&self.trust).enumerate();
        let rows =
            modes.map(|(mode, (first, trust))| Row { mode, first, trust, alone: self.cluster_of(mode).is_none() });
        rows.collect()
    }

    /// The spread of each frequency by every method, its sources, and whether first order is right; without its text
    /// where nothing is moved.
    fn frequencies(&self, said: &mut Findings, moved: bool) {
        let rows = self.rows();
        let mut table = Columns::new("summary", &rows);
        let behaviours: Vec<_> = rows.iter().map(|row| row.first.behaviour).collect();
        let (resolved, left_out) = Behaviour::resolved(&behaviours, &self.description);
        table.show_rows(if moved { resolved } else { Vec::new() });
        table.whole("mode", &|row| Some(row.mode + 1)).shown();
        let unit = &self.description.frequency;
        let in_unit = |omega: f64| converted(omega, unit);
        let nominal = table.number("frequency", "rad/s", &|row| row.first.behaviour.frequency());
        nominal.digits_in(unit, number).headed(&heading("nominal", unit));
        table.number("sigma, first order", "rad/s", &|row| Some(row.spread()?.sigma));
        table.cells("sigma: first order", &|row| or_dash(row.sigma().map(in_unit), rough));
        table.number("sigma, second order", "rad/s", &|row| {
            Some(self.second.modes.get(row.mode).filter(|_| row.alone)?.as_ref().ok()?.frequency.moments.sigma)
        });
        table.cells("second order", &|row| {
            let nominal = row.first.behaviour.frequency().unwrap_or(0.0);
            let sigma = self.second_order_sigma(row.mode).filter(|_| row.alone);
            or_dash(sigma.map(|sigma| in_unit(unless_rounding(sigma, nominal))), rough)
        });
        let sampled = table.number("sigma, sampled", "rad/s", &|row| row.sampled(Quantity::Frequency));
        if self.sampled().is_some() {
            sampled.digits_in(unit, rough).headed("sampled");
        }
        table.number("standard error of sampled sigma", "rad/s", &|row| {
            Some(row.trust.check(Quantity::Frequency)?.sigma.standard_error)
        });
        table.whole("samples", &|row| Some(row.trust.check(Quantity::Frequency)?.count));
        table.number("band", "rad/s", &|row| Some(row.spread()?.band));
        let level = self.first.sigma_level;
        table.cells(&format!("{level} sigma"), &|row| or_dash(row.sigma().map(|sigma| in_unit(sigma * level)), rough));
        table.cells("mostly from", &|row| {
            if row.sigma().is_some_and(|sigma| sigma != 0.0) {
                mostly(&self.description, row.first.variance_shares())
            } else {
                "-".to_owned()
            }
        });
        table.flag("trusted", &|row| Some(row.trust.trusted()));
        table.cells("trusted", &|row| verdict(&row.trust.doubts).to_owned());
        table.words("use", &|row| Some(row.trust.advice.word().to_owned()));
        said.columns(table);
        said.note_if_any(left_out.filter(|_| moved));
    }

    /// The spread of each damping ratio, if any varies, in the same form.
    fn damping_ratios(&self, said: &mut Findings) {
        let rows = self.rows();
        let moved = rows.iter().filter_map(|row| {
            let ratio = row.first.damping_ratio().filter(|_| row.alone)?;
            (spread_of(&ratio) != 0.0).then_some((row, ratio))
        });
        let moved: Vec<_> = moved.collect();
        let mut table = Columns::new("damping ratios", &moved);
        table.cells("mode", &|(row, _)| (row.mode + 1).to_string());
        table.cells("damping ratio", &|(_, x)| rough(x.mean));
        table.cells("sigma: first order", &|(_, x)| rough(spread_of(x)));
        if self.sampled().is_some() {
            table.cells("sampled", &|(row, _)| or_dash(row.sampled(Quantity::DampingRatio), rough));
        }
        table.cells("to instability [sigma]", &|(row, _)| far(row.first.distance_to_instability));
        table.cells("mostly from", &|(_, item)| mostly(&self.description, &item.variance_shares));
        said.text(table.finish().1);
    }

    fn doubted(&self, said: &mut Findings) {
        let rows = self.trust.iter().flat_map(|mode| mode.doubts.iter().map(move |doubt| (mode.mode, doubt)));
        let rows: Vec<_> = rows.collect();
        let mut table = Columns::new("doubts", &rows);
        table.whole("mode", &|(mode, _)| Some(mode + 1));
        table.words("doubt", &|(_, doubt)| Some(doubt.to_string()));
        said.columns(table);
    }

    /// The clusters; the text has only those that samples have not found separate.
    fn mixed(&self, said: &mut Findings) {
        for cluster in &self.clusters {
            let mut modes = cluster.modes.iter();
            if modes.any(|mode| self.cluster_of(*mode).is_some()) {
                said.quote(cluster.said());
            }
        }
        for table in ClusterTolerance::findings(&self.clusters).into_tables() {
            said.data(table);
        }
    }
}
