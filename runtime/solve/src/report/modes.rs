//! Modes as text.

use core::f64::consts::{LN_2, TAU};
use core::fmt;

use crate::modes::{Family, Mode, Sense, Whirl};
use crate::{Behaviour, Complex, CoordinateInfo, Modes, Role};
use eigentol_results::numbers::{optional, or_dash, rough};
use eigentol_results::relevance::{COLUMNS, EVERYTHING, largest, names, relevant, unless_rounding};
use eigentol_results::table::{Table, cells};
use eigentol_results::title::title;

/// Relative difference of numbers that look alike in a table.
const SAME_NUMBER: f64 = 1e-6;

impl fmt::Display for Behaviour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Oscillating(_) => write!(f, "oscillates"),
            Self::Damped(_) => write!(f, "decays"),
            Self::Flutter(_) => write!(f, "grows (flutter)"),
            Self::Decaying(rate) => write!(f, "creeps back, rate {} 1/s", rough(*rate)),
            Self::Free => write!(f, "free"),
            Self::Neutral => write!(f, "neutral"),
            Self::Divergent(rate) => write!(
                f,
                "diverges, rate {} 1/s: doubles in {} s",
                rough(*rate),
                rough(LN_2 / rate)
            ),
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
        if general {
            head.extend(cells(["Re s [1/s]", "damping ratio"]));
        }
        head.push("motion".to_owned());
        let shapes = Shapes::of(self);
        head.extend(shapes.head());
        let mut table = Table::new(head);
        for mode in &self.modes {
            let omega = mode.frequency();
            let mut row = vec![
                (mode.label + 1).to_string(),
                optional(omega),
                optional(omega.map(|omega| omega / TAU)),
            ];
            if general {
                let growth = if mode.s.re.abs() <= mode.error {
                    0.0
                } else {
                    unless_rounding(mode.s.re, mode.s.norm())
                };
                let ratio = mode.damping_ratio().filter(|_| omega.is_some());
                row.push(rough(growth));
                row.push(or_dash(
                    ratio.map(|ratio| if growth == 0.0 { 0.0 } else { ratio }),
                    rough,
                ));
            }
            row.push(mode.behaviour.to_string());
            row.extend(shapes.cells(mode));
            table.row(row);
        }
        write!(f, "{table}")?;
        shapes.rest(f)?;
        let falls = |values: Vec<f64>| {
            values
                .windows(2)
                .any(|pair| pair[1] < pair[0] * (1.0 - SAME_NUMBER))
        };
        let frequencies = self.frequencies().into_iter().flatten().collect();
        let natural = self.modes.iter().map(|mode| mode.s.norm()).collect();
        if falls(frequencies) && !falls(natural) {
            writeln!(f, "  In the order of |s|, the natural frequency.")?;
        }
        if self.damping_ignored {
            writeln!(
                f,
                "  Damping and gyroscopic forces (Chat) are not zero here and are ignored: undamped modes."
            )?;
        }
        Ok(())
    }
}

/// Shapes as columns: one column for each coordinate or speed that moves in any mode, or a single one with the largest
/// components.
struct Shapes<'a> {
    /// Index and description of the unknown, and its largest motion in any mode.
    moving: Vec<(usize, &'a CoordinateInfo, f64)>,
    still: Vec<&'a str>,
}

/// Number of components named in a single column.
const NAMED: usize = 4;

impl<'a> Shapes<'a> {
    fn of(modes: &'a Modes) -> Self {
        // Reactions come last among the unknowns; a shape consists of motions.
        let moves = |info: &CoordinateInfo| matches!(info.role, Role::Position | Role::Speed);
        let most = |i: usize| largest(modes.modes.iter().map(|mode| mode.shape[i].norm()));
        let all = modes.description.coordinates.iter().enumerate();
        let all: Vec<_> = (all.filter(|(_, info)| moves(info)))
            .map(|(i, info)| (i, info, most(i)))
            .collect();
        let greatest = largest(all.iter().map(|(_, _, most)| *most));
        let (moving, still): (Vec<_>, Vec<_>) =
            (all.into_iter()).partition(|(_, _, most)| unless_rounding(*most, greatest) != 0.0);
        Self {
            moving,
            still: still.into_iter().map(|(_, info, _)| &*info.name).collect(),
        }
    }

    fn side_by_side(&self) -> bool {
        self.moving.len() <= COLUMNS
    }

    fn head(&self) -> Vec<String> {
        if !self.side_by_side() {
            return vec!["shape, largest components".to_owned()];
        }
        let names = self.moving.iter().map(|(_, info, _)| info.name.to_string());
        names.collect()
    }

    fn cells(&self, mode: &Mode) -> Vec<String> {
        // Rounding compared to the motion of the coordinate in other modes.
        let shown = |(i, _, most): &(usize, &CoordinateInfo, f64)| {
            let value = mode.shape[*i];
            match unless_rounding(value.norm(), *most) {
                0.0 => Complex::new(0.0, 0.0),
                _ => value,
            }
        };
        if self.side_by_side() {
            return (self.moving.iter().map(|own| component(shown(own)))).collect();
        }
        let own = self.moving.iter().map(|own| (own.1, shown(own), own.2));
        let mut own: Vec<_> = own.collect();
        own.retain(|(_, value, most)| relevant(value.norm(), *most));
        own.sort_by(|(_, a, _), (_, b, _)| b.norm().total_cmp(&a.norm()));
        let named = own.iter().take(NAMED);
        let named = named.map(|(info, value, _)| format!("{} {}", info.name, component(*value)));
        let mut text: Vec<String> = named.collect();
        if own.len() > NAMED {
            text.push(format!("{} more", own.len() - NAMED));
        }
        vec![text.join(", ")]
    }

    fn rest(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.still.is_empty() {
            let (still, verb) = (names(&self.still, "coordinates"), self.still.len());
            let verb = if verb == 1 { "does" } else { "do" };
            writeln!(f, "  In no mode {verb} {still} move.")?;
        }
        if !self.side_by_side() {
            writeln!(
                f,
                "  Only the {NAMED} largest components are shown: {EVERYTHING}."
            )?;
        }
        Ok(())
    }
}

/// A component of a shape: real, or amplitude and phase in degrees.
fn component(value: Complex) -> String {
    let phase = value.arg().to_degrees();
    // A phase of less than half a degree counts as zero.
    if value.im == 0.0 || phase.abs() < 0.5 {
        rough(value.re)
    } else if phase.abs() >= 179.5 {
        rough(-value.norm())
    } else {
        format!("{} @ {phase:.0} deg", rough(value.norm()))
    }
}
