//! Tolerances as text.

use core::fmt;

use super::equilibrium::meeting;
use super::shares;
use super::table::{Table, cells, heading, in_unit, number, of_mode, optional, per, undamped};
use super::title::{title, title_along};
use crate::modes::Family;
use crate::summary::Doubt;
use crate::sweep::{Event, EventTolerance};
use crate::tolerance::{Counts, OutputTolerances, Statistics, TRUSTED_DISTANCE};
use crate::{FirstOrder, MonteCarlo};

impl fmt::Display for OutputTolerances {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        let title = title(d, &self.inputs);
        writeln!(f, "{title}: first-order spread of the outputs")?;
        let mut head = cells(["output", "mean", "sigma"]);
        head.push(format!("{} sigma", self.sigma_level));
        head.extend(shares::head(d));
        let mut table = Table::new(head);
        let values = self.values.iter().zip(&self.spreads);
        for (info, (value, own)) in d.outputs.iter().zip(values) {
            let scaled = |value: f64| value / info.unit.scale;
            let own = own.as_ref();
            let mut row = vec![
                heading(&info.name, &info.unit),
                number(scaled(*value)),
                optional(own.map(|own| scaled(own.sigma))),
                optional(own.map(|own| scaled(own.band))),
            ];
            row.extend(shares::cells(d, own.map(|own| &own.variance_shares[..])));
            table.row(row);
        }
        write!(f, "{table}")
    }
}

impl fmt::Display for FirstOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        let title = title(d, &self.inputs);
        writeln!(f, "{title}: first-order spread of the frequencies")?;
        let general = self.family == Family::General;
        let mut head = cells(["mode", "mean [rad/s]", "sigma [rad/s]"]);
        head.push(format!("{} sigma [rad/s]", self.sigma_level));
        if general {
            head.extend(cells(["damping ratio", "sigma", "to instability [sigma]"]));
        }
        head.push("to critical [sigma]".to_owned());
        head.extend(shares::head(d));
        let mut table = Table::new(head);
        for (r, mode) in self.modes.iter().enumerate() {
            let own = |value: Option<f64>| of_mode(value, mode.clustered);
            let (frequency, damping) = (mode.frequency.as_ref(), mode.damping_ratio.as_ref());
            let mut row = vec![
                (r + 1).to_string(),
                optional(mode.behaviour.frequency()),
                own(frequency.map(|spread| spread.sigma)),
                own(frequency.map(|spread| spread.band)),
            ];
            if general {
                row.push(optional(damping.map(|spread| spread.mean)));
                row.push(own(damping.map(|spread| spread.sigma)));
                row.push(own(Some(mode.distance_to_instability)));
            }
            row.push(own(Some(mode.distance_to_critical)));
            let shares = (!mode.clustered).then(|| mode.variance_shares());
            row.extend(shares::cells(d, shares));
            table.row(row);
        }
        write!(f, "{table}")?;
        undamped(f, self.family, d)?;
        if self.distance_to_critical == 0.0 {
            return writeln!(
                f,
                "  The stiffness is zero within rounding: this is a critical state. Use Monte Carlo here."
            );
        }
        if self.distance_to_critical < 0.0 {
            return writeln!(
                f,
                "  The equilibrium is not stable: a mode that does not oscillate has no frequency to spread."
            );
        }
        if self.distance_to_critical < TRUSTED_DISTANCE {
            writeln!(
                f,
                "  Not to be trusted: the critical state is {} standard deviations away. First order errs by several \
                 percent at {TRUSTED_DISTANCE} of them, and without bound nearer. Use Monte Carlo here.",
                number(self.distance_to_critical)
            )?;
        }
        for (r, mode) in self
            .modes
            .iter()
            .enumerate()
            .filter(|(_, mode)| !mode.alone())
        {
            write!(f, "  Not to be trusted for mode {}: ", r + 1)?;
            match mode.clustered {
                true => writeln!(
                    f,
                    "it has nearly equal neighbours and no derivative of its own."
                )?,
                false => writeln!(
                    f,
                    "samples mix it with another mode, {} standard deviations away.",
                    number(mode.distance_to_neighbour)
                )?,
            }
        }
        for (r, mode) in self.modes.iter().enumerate() {
            let distance = mode.distance_to_instability;
            if distance < TRUSTED_DISTANCE && !mode.clustered {
                writeln!(
                    f,
                    "  Mode {}: {}",
                    r + 1,
                    Doubt::NearInstability { distance }
                )?;
            }
        }
        if self.modes.len() > 1 {
            writeln!(
                f,
                "  Each mode is taken alone: `summary` also checks which modes mix and how nonlinear frequencies are."
            )?;
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
            "{}: Monte Carlo with re-solved equilibria, {} samples: {}",
            title(&self.description, &self.inputs),
            self.samples,
            self.counts
        )?;
        let mut head = cells([
            "mode",
            "mean [rad/s]",
            "std. error",
            "sigma [rad/s]",
            "min",
            "max",
            "samples",
        ]);
        let general = self.family == Family::General;
        if general {
            head.extend(cells(["damping ratio", "sigma"]));
        }
        let mut table = Table::new(head);
        for (r, mode) in self.modes.iter().enumerate() {
            let value =
                |pick: fn(&Statistics) -> Option<f64>| optional(mode.as_ref().and_then(pick));
            let mut row = vec![
                (r + 1).to_string(),
                value(|s| Some(s.mean)),
                value(|s| s.standard_error),
                value(|s| s.sigma),
                value(|s| Some(s.min)),
                value(|s| Some(s.max)),
                mode.as_ref().map_or(0, |s| s.count).to_string(),
            ];
            if general {
                let damping = self.damping_ratios[r].as_ref();
                row.push(optional(damping.map(|s| s.mean)));
                row.push(optional(damping.and_then(|s| s.sigma)));
            }
            table.row(row);
        }
        write!(f, "{table}")?;
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
                "  Some modes have equal nominal eigenvalues: which of them a sample counts for is arbitrary."
            )?;
        }
        if self.left_nominal_branch > 0 {
            writeln!(
                f,
                "  {} stable samples settled on another branch than the nominal one.",
                self.left_nominal_branch
            )?;
        }
        Ok(())
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
        match self.event {
            Event::Critical => write!(f, "{title}: critical at {name}")?,
            Event::Crossing {
                mode,
                condition,
                whirl,
                ..
            } => {
                let what = meeting(mode, condition, name);
                let sense = whirl.map_or(String::new(), |whirl| format!(" ({})", whirl.sense()));
                write!(f, "{title}: {what}{sense} at {name}")?;
            }
        }
        let (value, symbol) = (in_unit(self.value, unit), &unit.symbol);
        let spread = match &self.spread {
            Ok(spread) => spread,
            Err(error) => return writeln!(f, " = {value} {symbol}, without a spread: {error}"),
        };
        writeln!(
            f,
            " = {value} +/- {} {symbol} ({} sigma)",
            in_unit(spread.band, unit),
            self.sigma_level
        )?;
        let mut table = Table::new(cells(["derivative by", "value", "share of variance"]));
        for ((info, &slope), &share) in d
            .design
            .iter()
            .zip(&spread.by_design)
            .zip(&spread.variance_shares)
        {
            table.row(vec![
                per(&info.name, &info.unit),
                number(slope * info.unit.scale / unit.scale),
                format!("{:.1} %", 100.0 * share),
            ]);
        }
        write!(f, "{table}")?;
        undamped(f, self.family, d)
    }
}
