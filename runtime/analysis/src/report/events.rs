//! Events: critical states, resonances and the onset of flutter, and how tolerances move them.

use core::fmt;

use eigentol_results::numbers::{given, in_unit, per, percent, rough, rough_in, with_unit};
use eigentol_results::relevance::{BELOW, names, relevant};
use eigentol_results::table::{Table, cells};
use eigentol_results::title::title_along;
use eigentol_solve::report::undamped;

use super::branches::critical_vectors;
use crate::sweep::{Change, Condition, CriticalState, Crossing, Event, EventTolerance};

/// The event of mode number `mode` at a value of the input called `name`, where growth changes like this.
pub(super) fn meeting(mode: usize, condition: Condition, change: Change, name: &str) -> String {
    let mode = mode + 1;
    match condition {
        Condition::Line(line) if line.offset == 0.0 => {
            format!("frequency {mode} is {} times {name}", given(line.ratio))
        }
        Condition::Line(line) => format!(
            "frequency {mode} is {} times {name} plus {} rad/s",
            given(line.ratio),
            given(line.offset)
        ),
        Condition::FlutterOnset => match change {
            Change::End => format!("end of flutter of mode {mode}"),
            Change::Touch => format!("mode {mode} keeps its amplitude"),
            Change::ToDivergence => format!("flutter of mode {mode} turns into divergence"),
            Change::ToFlutter => format!("divergence turns into flutter of mode {mode}"),
            _ => format!("onset of flutter of mode {mode}"),
        },
    }
}

impl fmt::Display for CriticalState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.equilibrium.description;
        if let Some(info) = d.inputs.get(self.input.index()) {
            let value = with_unit(in_unit(self.value, &info.unit), &info.unit);
            writeln!(
                f,
                "{}: critical at {} = {value}, {}",
                title_along(d, &self.equilibrium.inputs, self.input),
                info.name,
                self.kind
            )?;
        }
        write!(f, "{}", self.equilibrium)?;
        critical_vectors(f, d, &self.v, &self.w)
    }
}

impl fmt::Display for Crossing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.equilibrium.description;
        if let Some(info) = d.inputs.get(self.input.index()) {
            let value = with_unit(in_unit(self.value, &info.unit), &info.unit);
            let what = meeting(self.mode, self.condition, self.change, &info.name);
            let title = title_along(d, &self.equilibrium.inputs, self.input);
            writeln!(f, "{title}: {what} at {} = {value}", info.name)?;
        }
        write!(f, "{}{}", self.equilibrium, self.modes)
    }
}

/// The event, without the value: `frequency 1 is 2 times speed (backward)`.
pub(super) fn what_happens(event: &Event, change: Change, name: &str) -> String {
    match event {
        Event::Critical => "critical".to_owned(),
        Event::Crossing {
            mode,
            condition,
            whirl,
            ..
        } => {
            let sense = whirl.map_or(String::new(), |whirl| format!(" ({})", whirl.sense()));
            format!("{}{sense}", meeting(*mode, *condition, change, name))
        }
    }
}

impl fmt::Display for EventTolerance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        let Some(info) = d.inputs.get(self.input.index()) else {
            return Ok(());
        };
        let (name, unit) = (&info.name, &info.unit);
        let title = title_along(d, &self.inputs, self.input);
        write!(
            f,
            "{title}: {} at {name}",
            what_happens(&self.event, self.change, name)
        )?;
        let value = in_unit(self.value, unit);
        let spread = match &self.spread {
            Ok(spread) => spread,
            Err(error) => {
                let value = with_unit(value, unit);
                return writeln!(f, " = {value}, without a spread: {error}");
            }
        };
        writeln!(
            f,
            " = {value} +/- {} ({} sigma)",
            with_unit(rough_in(spread.band, unit), unit),
            self.sigma_level
        )?;
        let mut order: Vec<usize> = (0..d.design.len()).collect();
        order.sort_by(|&a, &b| {
            let size = |k: usize| spread.variance_shares[k].abs();
            size(b).total_cmp(&size(a))
        });
        let matters = |k: &usize| relevant(spread.variance_shares[*k], 1.0);
        let (shown, left): (Vec<usize>, Vec<usize>) = order.into_iter().partition(matters);
        let mut table = Table::new(cells(["derivative by", "value", "share of variance"]));
        for k in shown {
            let info = &d.design[k];
            table.row(vec![
                per(&info.name, &info.unit),
                rough(spread.by_design[k] * info.unit.scale / unit.scale),
                percent(spread.variance_shares[k]),
            ]);
        }
        if !table.is_empty() {
            write!(f, "{table}")?;
        }
        if !left.is_empty() {
            let left: Vec<&str> = left.iter().map(|&k| &*d.design[k].name).collect();
            writeln!(
                f,
                "  Left out, {BELOW} of the variance: {}",
                names(&left, "variables")
            )?;
        }
        undamped(f, self.family, d)
    }
}
