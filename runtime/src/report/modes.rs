//! Modes as text.

use core::f64::consts::TAU;
use core::fmt;

use super::table::{Table, number};
use crate::{Behaviour, Modes};

impl fmt::Display for Behaviour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Oscillating(_) => write!(f, "oscillates"),
            Self::Neutral => write!(f, "free"),
            Self::Divergent(rate) => write!(f, "diverges, rate {} 1/s", number(*rate)),
        }
    }
}

impl<const N: usize> fmt::Display for Modes<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: natural modes", self.description.name)?;
        let mut head: Vec<String> = ["mode", "omega [rad/s]", "f [Hz]", "lambda [1/s^2]"]
            .map(str::to_owned)
            .to_vec();
        head.extend(
            self.description
                .coordinates
                .iter()
                .map(|info| info.name.to_owned()),
        );
        head.push("motion".to_owned());
        let mut table = Table::new(head);
        for (r, mode) in self.modes.iter().enumerate() {
            let omega = mode.frequency();
            let mut row = vec![
                (r + 1).to_string(),
                super::table::optional(omega),
                super::table::optional(omega.map(|omega| omega / TAU)),
                number(mode.lambda),
            ];
            row.extend(mode.shape.iter().map(|&value| number(value)));
            row.push(mode.behaviour.to_string());
            table.row(row);
        }
        write!(f, "{table}")?;
        if self.damping_ignored {
            writeln!(
                f,
                "  Damping and gyroscopic forces (Chat) are not zero here and are ignored: undamped modes."
            )?;
        }
        Ok(())
    }
}
