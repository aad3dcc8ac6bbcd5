//! Tolerances as text.

use core::fmt;

use super::table::{Table, cells, number, optional};
use crate::tolerance::{Counts, TRUSTED_DISTANCE};
use crate::{FirstOrder, MonteCarlo};

impl<const N: usize, const P: usize> fmt::Display for FirstOrder<N, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = self.description;
        writeln!(f, "{}: first-order spread of the frequencies", d.name)?;
        let mut head = cells(["mode", "mean [rad/s]", "sigma [rad/s]"]);
        head.push(format!("{} sigma [rad/s]", self.sigma_level));
        head.push("to critical [sigma]".to_owned());
        head.extend(
            d.design
                .iter()
                .map(|info| format!("share of {}", info.name)),
        );
        let mut table = Table::new(head);
        for (r, mode) in self.modes.iter().enumerate() {
            let mut row = vec![
                (r + 1).to_string(),
                optional(mode.mean),
                optional(mode.sigma),
                optional(mode.band),
                number(mode.distance_to_critical),
            ];
            row.extend(
                mode.variance_shares
                    .iter()
                    .map(|share| format!("{:.1} %", 100.0 * share)),
            );
            table.row(row);
        }
        write!(f, "{table}")?;
        if self.distance_to_critical < TRUSTED_DISTANCE {
            writeln!(
                f,
                "  Not to be trusted: the critical state is {} standard deviations away, and first order \
                 needs about {TRUSTED_DISTANCE}. Use Monte Carlo here.",
                number(self.distance_to_critical)
            )?;
        }
        for (r, mode) in self
            .modes
            .iter()
            .enumerate()
            .filter(|(_, mode)| !mode.alone())
        {
            writeln!(
                f,
                "  Not to be trusted for mode {}: samples mix it with another mode, {} standard \
                 deviations away.",
                r + 1,
                number(mode.distance_to_neighbour)
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
            (self.undecided, "of undecided stability"),
            (self.no_equilibrium, "without equilibrium"),
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

impl<const N: usize, const P: usize> fmt::Display for MonteCarlo<N, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{}: Monte Carlo with re-solved equilibria, {} samples: {}",
            self.description.name, self.samples, self.counts
        )?;
        let mut table = Table::new(cells([
            "mode",
            "mean [rad/s]",
            "std. error",
            "sigma [rad/s]",
            "min",
            "max",
            "samples",
        ]));
        for (r, mode) in self.modes.iter().enumerate() {
            let value =
                |pick: fn(&crate::tolerance::Statistics) -> f64| optional(mode.as_ref().map(pick));
            table.row(vec![
                (r + 1).to_string(),
                value(|s| s.mean),
                value(|s| s.standard_error),
                value(|s| s.standard_deviation),
                value(|s| s.min),
                value(|s| s.max),
                mode.as_ref().map_or(0, |s| s.count).to_string(),
            ]);
        }
        write!(f, "{table}")?;
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
