//! Values of an input at which something happens.

use eigentol::sweep::{Change, Condition, EventTolerance, Line};
use eigentol::tolerance::Spread;
use eigentol::{Complex, Vector};
use pyo3::prelude::*;

use crate::arrays::{Array1, vector};
use crate::names;
use crate::results::{attributes, result};

/// In Python `Literal["critical", "crossing", "flutter"]`.
type EventKind = str;

/// In Python `Literal["onset", "end", "pass", "touch", "to divergence", "to flutter"]`.
type EventChange = str;

result! {
    /// A value of an input at which something happens, and how tolerances move it, SI.
    Event(EventTolerance)
}

pub(crate) fn events(all: &[EventTolerance]) -> Vec<Event> {
    all.iter().cloned().map(Event).collect()
}

impl Event {
    fn each(&self, of: impl Fn(&Spread) -> &Vector) -> Vec<f64> {
        let missing = || vec![f64::NAN; self.0.description.design.len()];
        self.0.spread.as_ref().map_or_else(|_| missing(), |spread| of(spread).to_vec())
    }

    fn line(&self) -> Option<Line> {
        match self.0.event {
            eigentol::sweep::Event::Crossing { condition: Condition::Line(line), .. } => Some(line),
            _ => None,
        }
    }
}

attributes! {
    Event(self, py) {
        /// What happens: "critical", "crossing" or "flutter".
        kind: &'static EventKind = match self.0.event {
            eigentol::sweep::Event::Critical => "critical",
            _ if self.line().is_some() => "crossing",
            _ => "flutter",
        };
        /// Which way: "onset", "end", "pass", "touch", "to divergence" or "to flutter".
        change: &'static EventChange = match self.0.change {
            Change::Onset => "onset",
            Change::End => "end",
            Change::Touch => "touch",
            Change::ToDivergence => "to divergence",
            Change::ToFlutter => "to flutter",
            _ => "pass",
        };
        /// Position of the mode, from 0; None for a critical value.
        mode: Option<usize> = match self.0.event {
            eigentol::sweep::Event::Crossing { mode, .. } => Some(mode),
            _ => None,
        };
        /// Its eigenvalue there, 1/s; None for a critical value.
        eigenvalue: Option<Complex> = match self.0.event {
            eigentol::sweep::Event::Crossing { s, .. } => Some(s),
            _ => None,
        };
        /// Whirl of the mode there: minor over major axis of the orbit, positive along the rotation; None where it does not
        /// apply.
        whirl: Option<f64> = match self.0.event {
            eigentol::sweep::Event::Crossing { whirl, .. } => whirl.and_then(|x| x.ratio),
            _ => None,
        };
        /// What the mode does there to bodies that spin: "lateral", "torsional", "axial" or "mixed"; None where
        /// no shaft spins.
        mode_kind: Option<String> = match self.0.event {
            eigentol::sweep::Event::Crossing { whirl, .. } => whirl.map(|x| x.kind.to_string()),
            _ => None,
        };
        /// Multiple of the input that a frequency meets in a crossing.
        order: Option<f64> = self.line().map(|x| x.ratio);
        /// What is added to that, rad/s.
        offset: Option<f64> = self.line().map(|x| x.offset);
        /// The nominal value of the input, SI.
        value: f64 = self.0.value;
        /// Its standard deviation to first order, SI; None where it has no derivative.
        sigma: Option<f64> = self.0.sigma();
        /// Half-width of the band that holds as many standard deviations as the tolerances do, SI.
        band: Option<f64> = Some(self.0.spread.as_ref().ok()?.band);
        /// Derivatives per SI unit of each variable, shape (variables,); NaN where there are none: `failure` says why.
        gradient: Array1<'py> = vector(py, self.each(|x| &x.by_design));
        /// Shares of the variables in the variance, shape (variables,).
        shares: Array1<'py> = vector(py, self.each(|x| &x.variance_shares));
        /// Why it has no derivatives: a text, or None.
        failure: Option<String> = Some(self.0.spread.as_ref().err()?.to_string());
        /// Names of the variables.
        names: Vec<&str> = names::design(&self.0.description);
    }
}
