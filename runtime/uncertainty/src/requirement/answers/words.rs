//! Requirements in words.

use core::f64::consts::TAU;

use crate::along::name_of;
use crate::judge::chance;
use crate::requirement::{EstimatedBy, Requirement};
use crate::{Description, Text, Unit};
use eigentol_results::numbers::{given, given_in, percent, with_unit};

impl Requirement {
    /// In words, with the units of a mechanism: `frequency 1 at least 4 rad/s`.
    #[must_use]
    pub fn text(&self, of: &Description) -> String {
        let Some(response) = self.response() else {
            return "stable".to_owned();
        };
        let unit = response.unit(of);
        let limits = self.limits();
        let limits: Vec<String> = limits.iter().map(|limit| limit.words(&unit, of)).collect();
        format!("{} {}", response.name(of), limits.join(", "))
    }

    /// One of [`limits`](Self::limits) without its response.
    fn words(&self, unit: &Unit, of: &Description) -> String {
        match *self {
            Self::Within { low, .. } if low.is_finite() => {
                format!("at least {}", ends(&[low], unit, of))
            }
            Self::Within { high, .. } => format!("at most {}", ends(&[high], unit, of)),
            Self::Outside { low, high, .. } => format!("outside {}", ends(&[low, high], unit, of)),
            Self::Away { input, order, fraction, .. } => {
                let name = name_of(of, input);
                let multiple = match order {
                    1.0 => name.to_owned(),
                    order => format!("{}x {name}", given(order)),
                };
                format!("away from {multiple} by {}", percent(fraction))
            }
            Self::Stable => String::new(),
        }
    }
}

impl EstimatedBy {
    /// The way in words, as tables name it.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::DesignPoint => "design point",
            Self::Lines => "lines",
            Self::Samples => "samples",
        }
    }
}

/// The ends of a limit; those of a frequency in the unit of answers, or in Hz if that is shorter: a limit given in Hz is a
/// short number in Hz only.
fn ends(all: &[f64], unit: &Unit, of: &Description) -> String {
    let hertz = Unit { symbol: Text::Static("Hz"), scale: TAU };
    let digits = |unit: &Unit| -> usize { all.iter().map(|end| given_in(*end, unit).len()).sum() };
    let unit = match &*unit.symbol == "rad/s" {
        true if *of.frequency.symbol != *unit.symbol => &of.frequency,
        true if digits(&hertz) < digits(unit) => &hertz,
        _ => unit,
    };
    all.iter().map(|end| with_unit(given_in(*end, unit), unit)).collect::<Vec<_>>().join(" to ")
}

/// A probability without an error.
pub(super) fn probability(value: f64) -> String {
    chance(value, 0.0)
}
