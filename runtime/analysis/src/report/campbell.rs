//! Campbell diagrams as text: events, one line per mode, and some of the points.

use core::fmt;

use super::events::what_happens;
use crate::campbell::{Campbell, CampbellMode};
use crate::modes::{Family, Sense};
use crate::tolerance::Spread;
use crate::{Behaviour, InputInfo};
use eigentol_results::numbers::{
    given_in, heading, in_unit, number, optional, or_dash, rough, rough_in,
};
use eigentol_results::relevance::{EVERYTHING, shown};
use eigentol_results::shares::mostly;
use eigentol_results::table::{Table, cells, not_reached};
use eigentol_results::title::title_along;
use eigentol_solve::report::undamped;
use eigentol_tolerance::report::spread_of;

impl fmt::Display for Campbell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        let title = title_along(d, &self.inputs, self.input);
        writeln!(f, "{title}: Campbell diagram")?;
        not_reached(f, self.unreached)?;
        let Some(info) = d.inputs.get(self.input.index()) else {
            return Ok(());
        };
        self.events(f, info)?;
        self.by_mode(f, info)?;
        self.by_point(f, info)?;
        undamped(f, self.family, d)
    }
}

impl Campbell {
    /// Critical values, onsets of flutter and crossings.
    fn events(&self, f: &mut fmt::Formatter<'_>, info: &InputInfo) -> fmt::Result {
        let mut table = Table::new(vec![
            "what happens".to_owned(),
            heading(&format!("at {}", info.name), &info.unit),
            format!("{} sigma", self.sigma_level),
            "mostly from".to_owned(),
        ]);
        let events = self.critical.iter().chain(&self.flutter_onsets);
        for event in events.chain(&self.crossings) {
            let mut row = vec![
                what_happens(&event.event, event.change, &info.name),
                in_unit(event.value, &info.unit),
            ];
            row.extend(match &event.spread {
                Ok(own) => vec![
                    rough_in(own.band, &info.unit),
                    mostly(&self.description, &own.variance_shares),
                ],
                Err(error) => vec!["-".to_owned(), error.to_string()],
            });
            table.row(row);
        }
        match table.is_empty() {
            true => Ok(()),
            false => write!(f, "{table}"),
        }
    }

    /// Each mode over the whole range: its largest spread and its smallest damping.
    fn by_mode(&self, f: &mut fmt::Formatter<'_>, info: &InputInfo) -> fmt::Result {
        let general = self.family == Family::General;
        let spread = |own: &CampbellMode| own.frequency.as_ref().map_or(0.0, spread_of);
        let damped = |own: &CampbellMode| own.damping_ratio.as_ref().map(|own| own.mean);
        let mut head = cells(["mode", "omega [rad/s]", "to", "most sigma"]);
        head.push(format!("at {}", info.name));
        if general {
            head.extend(cells(["least damping ratio", "sigma"]));
            head.push(format!("at {}", info.name));
        }
        head.extend(cells(["whirl", "motion"]));
        let mut table = Table::new(head);
        for label in self.labels() {
            let all: Vec<(f64, &CampbellMode)> = self.branch(label).collect();
            let (Some((_, first)), Some((_, last))) = (all.first(), all.last()) else {
                continue;
            };
            let mut row = vec![
                (label + 1).to_string(),
                optional(first.behaviour.frequency()),
                optional(last.behaviour.frequency()),
            ];
            let widest = (all
                .iter()
                .filter(|(_, own)| !own.clustered && spread(own) > 0.0))
            .max_by(|(_, a), (_, b)| spread(a).total_cmp(&spread(b)));
            row.push(or_dash(widest.map(|(_, own)| spread(own)), rough));
            row.push(widest.map_or("-".to_owned(), |(value, _)| given_in(*value, &info.unit)));
            if general {
                let has = all.iter().filter(|(_, own)| damped(own).is_some());
                let least = has.min_by(|(_, a), (_, b)| {
                    let ratio = |own| damped(own).unwrap_or(f64::INFINITY);
                    ratio(a).total_cmp(&ratio(b))
                });
                let sigma = |own: &Spread| spread_of(own);
                row.push(or_dash(least.and_then(|(_, own)| damped(own)), rough));
                let own = least.filter(|(_, own)| !own.clustered);
                let own = own.and_then(|(_, own)| own.damping_ratio.as_ref());
                row.push(or_dash(own.map(sigma), rough));
                row.push(least.map_or("-".to_owned(), |(value, _)| given_in(*value, &info.unit)));
            }
            row.push(senses(&all));
            row.push(motions(&all));
            table.row(row);
        }
        match table.is_empty() {
            true => Ok(()),
            false => write!(f, "{table}"),
        }
    }

    /// The frequencies at some of the input values.
    fn by_point(&self, f: &mut fmt::Formatter<'_>, info: &InputInfo) -> fmt::Result {
        let oscillates = |label: &usize| {
            let mut branch = self.branch(*label);
            branch.any(|(_, mode)| mode.behaviour.frequency().is_some())
        };
        let mut labels = self.labels();
        labels.retain(oscillates);
        let mut head = vec![heading(&info.name, &info.unit)];
        head.extend(
            labels
                .iter()
                .map(|label| format!("omega{} [rad/s]", label + 1)),
        );
        let mut table = Table::new(head);
        let rows = shown(self.points.len());
        for &k in &rows {
            let point = &self.points[k];
            let mut row = vec![given_in(point.value, &info.unit)];
            match &point.modes {
                Ok(modes) => row.extend(labels.iter().map(|label| {
                    let own = modes.iter().find(|mode| mode.label == *label);
                    let omega = own.and_then(|mode| mode.behaviour.frequency());
                    omega.map_or("-".to_owned(), number)
                })),
                Err(error) => row.push(error.to_string()),
            }
            table.row(row);
        }
        if !table.is_empty() {
            write!(f, "{table}")?;
        }
        let failed = self
            .points
            .iter()
            .filter(|point| point.modes.is_err())
            .count();
        if failed > 0 {
            writeln!(
                f,
                "  {failed} of {} points have no modes.",
                self.points.len()
            )?;
        }
        if rows.len() < self.points.len() {
            let (shown, all) = (rows.len(), self.points.len());
            writeln!(
                f,
                "  {shown} of {all} points are shown: {EVERYTHING}, with sigma, damping and whirl."
            )?;
        }
        Ok(())
    }
}

/// The senses in which a mode whirls along the branch, in order; planar only if it never circles, as at rest all do.
fn senses(branch: &[(f64, &CampbellMode)]) -> String {
    let all = branch.iter().filter_map(|(_, mode)| mode.whirl);
    let mut said: Vec<Sense> = Vec::new();
    for sense in all.map(|whirl| whirl.sense()) {
        match said.last() {
            Some(last) if *last == sense || sense == Sense::Planar => {}
            Some(Sense::Planar) => said = vec![sense],
            _ => said.push(sense),
        }
    }
    let words: Vec<String> = said.iter().map(Sense::to_string).collect();
    match words.is_empty() {
        true => "-".to_owned(),
        false => words.join(", then "),
    }
}

/// The behaviours of a mode along the branch, each once, in order.
fn motions(branch: &[(f64, &CampbellMode)]) -> String {
    let mut said: Vec<&str> = Vec::new();
    for (_, mode) in branch {
        let word = match mode.behaviour {
            Behaviour::Oscillating(_) => "oscillates",
            Behaviour::Damped(_) => "decays",
            Behaviour::Flutter(_) => "grows (flutter)",
            Behaviour::Decaying(_) => "creeps back",
            Behaviour::Free => "free",
            Behaviour::Neutral => "neutral",
            Behaviour::Divergent(_) => "diverges",
        };
        if said.last() != Some(&word) {
            said.push(word);
        }
    }
    said.join(", then ")
}
