//! First-order spread of the values of an input at which something happens: critical speeds and resonances.

use super::Tolerances;
use crate::equilibrium::{Condition, CriticalState, Crossing};
use crate::modes::{Family, Whirl, whirls};
use crate::sensitivity::{critical_sensitivity, crossing_sensitivity};
use crate::{Complex, Description, Error, Input, Mechanism};

/// What happens at a value of an input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// The lowest mode loses its stiffness.
    Critical,
    /// A mode meets a condition.
    Crossing {
        /// Position of the mode, from 0.
        mode: usize,
        /// What it meets.
        condition: Condition,
        /// Its eigenvalue there, 1/s.
        s: Complex,
        /// How it whirls there; `None` where that does not apply.
        whirl: Option<Whirl>,
    },
}

/// A value of an input at which something happens, and how tolerances move it.
#[derive(Clone, Debug, PartialEq)]
pub struct EventTolerance<const P: usize> {
    /// What happens.
    pub event: Event,
    /// The input.
    pub input: Input,
    /// Its nominal value there, SI.
    pub value: f64,
    /// How the value moves, or why it has no derivative.
    pub spread: Result<EventSpread<P>, Error>,
    /// How many standard deviations a tolerance and a band hold.
    pub sigma_level: f64,
    /// Which modes it was found with.
    pub family: Family,
    /// The mechanism it belongs to.
    pub description: &'static Description,
}

impl<const P: usize> EventTolerance<P> {
    /// The same with another number for the mode of a crossing.
    pub(crate) fn with_mode(mut self, number: usize) -> Self {
        if let Event::Crossing { mode, .. } = &mut self.event {
            *mode = number;
        }
        self
    }

    /// Standard deviation of the value, SI; `None` where it has no derivative.
    pub fn sigma(&self) -> Option<f64> {
        self.spread.as_ref().ok().map(|spread| spread.sigma)
    }
}

/// First-order spread of the value at which something happens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EventSpread<const P: usize> {
    /// `du/db`, SI unit of the input by that of the design variable.
    pub by_design: [f64; P],
    /// Standard deviation, SI.
    pub sigma: f64,
    /// Half-width that holds as many standard deviations as the tolerances do, SI.
    pub band: f64,
    /// Share of each design variable in the variance.
    pub variance_shares: [f64; P],
}

/// Spread of a critical value ([`critical_sensitivity`]).
pub fn critical_tolerance<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    critical: &CriticalState<N, U, P>,
    tolerances: &Tolerances<P>,
) -> EventTolerance<P>
where
    M: Mechanism<N, U, P, O>,
{
    EventTolerance {
        event: Event::Critical,
        input: critical.input,
        value: critical.value,
        spread: critical_sensitivity(mechanism, critical).map(|slopes| spread(slopes, tolerances)),
        sigma_level: tolerances.sigma_level(),
        family: Family::General,
        description: critical.equilibrium.description,
    }
}

/// Spread of a crossing ([`crossing_sensitivity`]).
pub fn crossing_tolerance<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    crossing: &Crossing<N, U, P>,
    tolerances: &Tolerances<P>,
) -> EventTolerance<P>
where
    M: Mechanism<N, U, P, O>,
{
    EventTolerance {
        event: Event::Crossing {
            mode: crossing.mode,
            condition: crossing.condition,
            s: crossing
                .modes
                .modes
                .get(crossing.mode)
                .map_or_else(Complex::default, |mode| mode.s),
            whirl: whirls(mechanism, &crossing.equilibrium, &crossing.modes)
                .get(crossing.mode)
                .copied()
                .flatten(),
        },
        input: crossing.input,
        value: crossing.value,
        spread: crossing_sensitivity(mechanism, crossing).map(|slopes| spread(slopes, tolerances)),
        sigma_level: tolerances.sigma_level(),
        family: crossing.modes.family,
        description: crossing.equilibrium.description,
    }
}

fn spread<const P: usize>(by_design: [f64; P], tolerances: &Tolerances<P>) -> EventSpread<P> {
    let (sigma, variance_shares) = tolerances.spread(&by_design);
    EventSpread {
        by_design,
        sigma,
        band: tolerances.sigma_level() * sigma,
        variance_shares,
    }
}
