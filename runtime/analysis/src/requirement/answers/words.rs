//! Requirements in words.

use core::f64::consts::TAU;

use crate::judge::chance;
use crate::requirement::{Edge, Found, Limit, Requirement};
use crate::{Description, Text, Unit};
use eigentol_results::numbers::{given_in, with_unit};

impl Requirement {
    /// In words, with the units of a mechanism: `frequency 1 at least 4 rad/s`.
    #[must_use]
    pub fn text(&self, of: &Description) -> String {
        let Some(response) = self.response() else {
            return "stable".to_owned();
        };
        let unit = response.unit(of);
        let limits = self.edges();
        let limits: Vec<String> = limits.iter().map(|edge| edge.text(&unit)).collect();
        format!("{} {}", response.name(of), limits.join(", "))
    }
}

impl Limit {
    /// In words: `frequency 1 at least 4 rad/s`.
    pub(super) fn text(&self, d: &Description) -> String {
        let edge = self.edge.text(&self.response.unit(d));
        format!("{} {edge}", self.response.name(d))
    }
}

impl Found {
    /// The way in words, as tables name it.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::DesignPoint => "design point",
            Self::Lines => "lines",
            Self::Samples => "samples",
        }
    }
}

impl Edge {
    fn text(&self, unit: &Unit) -> String {
        let ends: &[f64] = match self {
            Self::AtLeast(low) => &[*low],
            Self::AtMost(high) => &[*high],
            Self::Outside { low, high } => &[*low, *high],
        };
        let hertz = Unit {
            symbol: Text::Static("Hz"),
            scale: TAU,
        };
        // A limit given in Hz is a short number in Hz only.
        let digits = |unit: &Unit| {
            ends.iter()
                .map(|end| given_in(*end, unit).len())
                .sum::<usize>()
        };
        let unit = match &*unit.symbol == "rad/s" && digits(&hertz) < digits(unit) {
            true => &hertz,
            false => unit,
        };
        let one = |end: f64| with_unit(given_in(end, unit), unit);
        match *self {
            Self::AtLeast(low) => format!("at least {}", one(low)),
            Self::AtMost(high) => format!("at most {}", one(high)),
            Self::Outside { low, high } => format!("outside {} to {}", one(low), one(high)),
        }
    }
}

/// A probability without an error.
pub(super) fn probability(value: f64) -> String {
    chance(value, 0.0)
}
