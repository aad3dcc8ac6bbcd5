//! Modes as text.

use core::f64::consts::TAU;
use core::fmt;

use super::table::{Table, cells, number, optional};
use super::title::title;
use crate::modes::{Family, Sense, Whirl};
use crate::{Behaviour, Complex, CoordinateInfo, Modes, Role};

impl fmt::Display for Behaviour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Oscillating(_) => write!(f, "oscillates"),
            Self::Damped(_) => write!(f, "decays"),
            Self::Flutter(_) => write!(f, "grows (flutter)"),
            Self::Decaying(rate) => write!(f, "creeps back, rate {} 1/s", number(*rate)),
            Self::Neutral => write!(f, "free"),
            Self::Divergent(rate) => write!(f, "diverges, rate {} 1/s", number(*rate)),
        }
    }
}

impl fmt::Display for Sense {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Forward => "forward",
            Self::Backward => "backward",
            Self::Planar => "planar",
        })
    }
}

impl fmt::Display for Whirl {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({:+.2})", self.sense(), self.ratio)
    }
}

impl fmt::Display for Modes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let general = self.family == Family::General;
        let title = title(&self.description, &self.inputs);
        writeln!(f, "{title}: natural modes")?;
        let mut head = cells(["mode", "omega [rad/s]", "f [Hz]"]);
        head.extend(if general {
            cells(["|s| [rad/s]", "Re s [1/s]", "damping ratio"])
        } else {
            cells(["lambda [1/s^2]"])
        });
        // Reactions come last among the unknowns; a shape is what moves.
        let moves = |info: &&CoordinateInfo| matches!(info.role, Role::Position | Role::Speed);
        let moving = self.description.coordinates.iter().filter(moves);
        head.extend(moving.clone().map(|info| info.name.to_string()));
        head.push("motion".to_owned());
        let mut table = Table::new(head);
        for mode in &self.modes {
            let omega = mode.frequency();
            let mut row = vec![
                (mode.label + 1).to_string(),
                optional(omega),
                optional(omega.map(|omega| omega / TAU)),
            ];
            if general {
                row.push(optional(mode.natural_frequency()));
                row.push(number(mode.s.re));
                row.push(optional(mode.damping_ratio().filter(|_| omega.is_some())));
            } else {
                row.push(number(mode.lambda));
            }
            let shape = mode.shape.iter().zip(moving.clone());
            row.extend(shape.map(|(&value, _)| component(value)));
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

/// A component of a shape: real, or amplitude and phase in degrees.
fn component(value: Complex) -> String {
    if value.im.abs() <= 1e-12 * value.re.abs() {
        number(value.re)
    } else {
        format!(
            "{} @ {:.1} deg",
            number(value.norm()),
            value.arg().to_degrees()
        )
    }
}
