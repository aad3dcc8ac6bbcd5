//! The analyses of a rotor over its speed: Campbell diagram ([`eigentol::Campbell`]), critical speeds and onsets of
//! instability ([`events`]), risks at the running speed ([`risk`]); printed by [`tables`], written by [`record`].
//!
//! As usual for rotating machinery, speeds are shown in rpm and frequencies in Hz. Files are in SI units.

pub mod events;
pub mod margin;
pub mod record;
pub mod risk;
pub mod tables;

pub use events::{Happening, RotorEvent};
pub use risk::Risk;

use std::f64::consts::{PI, TAU};

use eigentol::modes::{Sense, Whirl};
use eigentol::{Campbell, Error, Input, Mechanism, Study};

/// One turn per minute, rad/s.
pub const RPM: f64 = PI / 30.0;
/// One cycle per second, rad/s.
pub const HZ: f64 = TAU;

/// The question asked of a rotor.
#[derive(Clone, Debug, PartialEq)]
pub struct RotorQuestion {
    /// The speed input.
    pub speed: Input,
    /// Lowest and highest speed, rad/s.
    pub range: (f64, f64),
    /// Running speed of the machine, rad/s.
    pub running: f64,
    /// Excitation orders: multiples of the speed.
    pub orders: Vec<f64>,
    /// Fraction of the running speed within which frequencies are forbidden.
    pub margin: f64,
}

impl RotorQuestion {
    /// The Campbell diagram at `count` evenly spaced speeds from `low` to `high`, rad/s.
    ///
    /// # Errors
    /// The errors of [`Study::campbell`].
    pub fn campbell<M: Mechanism>(
        &self,
        study: &Study<M>,
        (low, high): (f64, f64),
        count: usize,
    ) -> Result<Campbell, Error> {
        let step = (high - low) / (count.max(2) - 1) as f64;
        let speeds: Vec<f64> = (0..count)
            .map(|k| (low + step * k as f64).min(high))
            .collect();
        study.campbell(self.input(), &speeds, &self.orders)
    }

    /// The speed as an input of the mechanism.
    pub fn input<M>(&self) -> Input<M> {
        Input::new(self.speed.index())
    }

    /// Ends of the forbidden frequency band at the running speed, rad/s.
    pub fn band(&self) -> (f64, f64) {
        (
            self.running * (1.0 - self.margin),
            self.running * (1.0 + self.margin),
        )
    }
}

/// The sense of a whirl as one letter, `-` if there is no whirl.
pub fn letter(whirl: Option<Whirl>) -> &'static str {
    match whirl.map(Whirl::sense) {
        Some(Sense::Forward) => "F",
        Some(Sense::Backward) => "B",
        Some(Sense::Planar) => "P",
        None => "-",
    }
}
