//! Second-order spreads and margins of modes as text.

use core::fmt;

use super::judgement::verdict;
use super::margin::MarginTable;
use crate::judge::Doubt;
use crate::second_order::{ModeMargin, SecondOrder};
use eigentol_results::naming::named;
use eigentol_results::numbers::{heading, number, rough};
use eigentol_results::relevance::{CHANCE, NOTHING_VARIES, unless_rounding};
use eigentol_results::table::{Table, cells};
use eigentol_results::title::title;
use eigentol_tolerance::report::doubted;

impl fmt::Display for SecondOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{}: spread of the frequencies to second order",
            title(&self.description, &self.inputs)
        )?;
        let mut table = Table::new(cells([
            "mode",
            "nominal [rad/s]",
            "mean [rad/s]",
            "sigma, first order",
            "sigma [rad/s]",
            "skewness",
            "damping ratio, mean",
            "sigma",
        ]));
        for (r, mode) in self.modes.iter().enumerate() {
            let Ok(mode) = mode else { continue };
            let (frequency, damping) = (&mode.frequency, &mode.damping_ratio);
            table.row(vec![
                (r + 1).to_string(),
                number(frequency.model.value),
                number(frequency.moments.mean),
                sigma(frequency.moments.first_order_sigma, frequency.moments.mean),
                sigma(frequency.moments.sigma, frequency.moments.mean),
                format!("{:+.3}", frequency.moments.skewness),
                rough(damping.moments.mean),
                sigma(damping.moments.sigma, damping.moments.mean),
            ]);
        }
        write!(f, "{table}")?;
        if !self.varies {
            writeln!(f, "  {NOTHING_VARIES}")?;
        }
        for (r, mode) in self.modes.iter().enumerate() {
            if let Err(error) = mode {
                writeln!(f, "  Mode {}: {error}.", r + 1)?;
            }
        }
        let known = self.modes.iter().zip(&self.doubts);
        let known: Vec<&[Doubt]> = known
            .map(|(mode, doubts)| mode.as_ref().map_or(&[][..], |_| &doubts[..]))
            .collect();
        doubted(f, &known)
    }
}

fn sigma(value: f64, mean: f64) -> String {
    rough(unless_rounding(value, mean))
}

impl fmt::Display for ModeMargin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let table = MarginTable {
            inputs: &self.inputs,
            margin: &self.margin,
            quantity: &format!("{} {}", self.quantity, self.mode + 1),
            unit: self.quantity.unit(),
            description: &self.description,
        };
        write!(f, "{table}")?;
        let of = |claimed| verdict(&self.judgement, claimed);
        writeln!(f, "  Designs solved anew: {}.", self.judgement)?;
        if self.judgement.judged().is_some() {
            writeln!(
                f,
                "  First order: {}; second order: {}.",
                of(self.margin.first_order),
                of(self.margin.corrected.value)
            )?;
        }
        if !self.mixed_with.is_empty() {
            writeln!(
                f,
                "  Tolerances mix this mode with {}: no model of it alone can be relied on.",
                named(&self.mixed_with)
            )?;
        }
        let told = self.by_input.as_ref();
        let Some(by_input) = told.filter(|_| self.margin.first_order >= CHANCE) else {
            return Ok(());
        };
        for (info, slope) in self.description.inputs.iter().zip(by_input) {
            let slope = rough(slope * info.unit.scale);
            let by = heading(&info.name, &info.unit);
            writeln!(f, "  probability by {by}: {slope}")?;
        }
        Ok(())
    }
}
