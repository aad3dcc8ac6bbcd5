//! The free choices of an allocation, and the allowed failure probabilities.

use super::cost::Cost;
use crate::requirement::Requirements;
use crate::{Error, Vector};

/// A half-width to be chosen.
#[derive(Debug)]
pub struct HalfWidth<'a> {
    /// Position among the design variables, followed by the inputs that have a tolerance.
    pub variable: usize,
    /// Smallest and largest half-width, SI.
    pub limits: (f64, f64),
    /// Its cost.
    pub cost: Cost<'a>,
}

/// A nominal value to be chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Nominal {
    /// Position among the design variables.
    pub variable: usize,
    /// Smallest and largest value, SI.
    pub limits: (f64, f64),
}

/// The free choices.
///
/// Half-widths that are not listed stay as they are; each listed one scales the distribution of its variable about the
/// mean.
#[derive(Debug)]
pub struct Choices<'a> {
    /// Half-widths.
    pub half_widths: Vec<HalfWidth<'a>>,
    /// Nominal values.
    pub nominals: Vec<Nominal>,
    /// Maximum failure probability of each requirement.
    pub failure: Vec<f64>,
}

impl Choices<'_> {
    pub(super) fn check(&self, requirements: &Requirements<'_>) -> Result<(), Error> {
        let present = requirements.deviations().tolerances().half_widths();
        if self.half_widths.is_empty() {
            return refuse("allocation", "no half-width may be chosen".to_owned());
        }
        let (found, expected) = (self.failure.len(), requirements.wanted().len());
        if found != expected {
            return Err(Error::WrongLength { kind: "allowed probabilities of failure", found, expected });
        }
        if let Some(wrong) = self.failure.iter().find(|p| !(**p > 0.0 && **p < 1.0)) {
            return refuse("failure", format!("{wrong} is not a probability inside (0, 1)"));
        }
        if let Some(wrong) = self.half_widths.iter().find_map(|half_width| half_width.cost.mistake()) {
            return refuse("cost", wrong);
        }
        let half_widths = self.half_widths.iter().map(|half_width| (half_width.variable, half_width.limits));
        distinct(requirements, half_widths.clone())?;
        let design = &requirements.responses().nominal().description.design;
        for (variable, (low, high)) in half_widths {
            let name = &design[variable].name;
            if low.is_nan() || low <= 0.0 {
                let reason = format!("the lower limit of `{name}` must be positive, not {low} (SI)");
                return refuse("half-width", reason);
            }
            if present[variable] == 0.0 {
                let reason = format!("`{name}` does not vary: give it any tolerance, which says how it is distributed");
                return refuse("half-width", reason);
            }
            in_order("half-width", name, (low, high))?;
        }
        let mut nominals = self.nominals.iter().map(|nominal| (nominal.variable, nominal.limits));
        distinct(requirements, nominals.clone())?;
        nominals.try_for_each(|(variable, limits)| in_order("nominal value", &design[variable].name, limits))
    }

    /// Start of the search: the current design and half-widths, clamped to the limits.
    pub(super) fn start(&self, nominal: &[f64], half_widths: &[f64]) -> (Vector, Vector) {
        let (mut nominal, mut wide) = (Vector::from(nominal), Vector::from(half_widths));
        for choice in &self.nominals {
            nominal[choice.variable] = nominal[choice.variable].clamp(choice.limits.0, choice.limits.1);
        }
        for half_width in &self.half_widths {
            wide[half_width.variable] = wide[half_width.variable].clamp(half_width.limits.0, half_width.limits.1);
        }
        (nominal, wide)
    }
}

fn in_order(setting: &'static str, name: &str, (low, high): (f64, f64)) -> Result<(), Error> {
    if low < high && (high - low).is_finite() {
        return Ok(());
    }
    let reason = format!("the limits of `{name}` must be finite and in order, not {low} and {high} (SI)");
    refuse(setting, reason)
}

fn distinct(requirements: &Requirements<'_>, all: impl Iterator<Item = (usize, (f64, f64))>) -> Result<(), Error> {
    let state = requirements.responses().nominal();
    let mut seen = vec![false; state.design.len()];
    for (variable, _) in all {
        match seen.get_mut(variable) {
            None => {
                return Err(Error::UnknownHandle {
                    kind: "design variable",
                    index: variable,
                    mechanism: state.description.name.clone(),
                    count: state.design.len(),
                });
            }
            Some(true) => {
                let name = &state.description.design[variable].name;
                return refuse("allocation", format!("`{name}` is chosen twice"));
            }
            Some(flag) => *flag = true,
        }
    }
    Ok(())
}

fn refuse<T>(setting: &'static str, reason: String) -> Result<T, Error> {
    Err(Error::setting(setting, reason))
}
