//! The user's choices for a figure.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use eigentol::modes::Character;
use eigentol::{Description, Kernels, Study};

use crate::caption::{design, number};

/// The user's choices for a figure; [`Style::default`] makes none.
///
/// ```
/// use eigentol_figures::Style;
///
/// let style = Style::default().name_mode(0, "swing").hertz();
/// # let _ = style;
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Style {
    title: Option<String>,
    names: BTreeMap<usize, String>,
    frequency: Option<Frequency>,
    lowest: Option<f64>,
    highest: Option<f64>,
    widened: bool,
    ratio: Option<f64>,
    marks: Vec<(f64, String)>,
    notes: Vec<String>,
}

/// The unit of frequencies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Frequency {
    Hertz,
    RadiansPerSecond,
}

impl Style {
    /// A style whose captions list the design variables of a study with their tolerances.
    #[must_use]
    pub fn of<M: Kernels>(study: &Study<M>) -> Self {
        Self::default().design_of(study)
    }

    /// Lists the design variables of a study with their tolerances in captions, like [`Style::of`].
    #[must_use]
    pub fn design_of<M: Kernels>(self, study: &Study<M>) -> Self {
        let description = study.description();
        let tolerances = study.tolerances();
        let half_widths = tolerances.as_ref().map(|tolerance| tolerance.half_widths());
        let half_widths = half_widths.unwrap_or_default();
        self.note(design(description, study.design_values(), half_widths))
    }

    /// Sets the title.
    #[must_use]
    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.title = Some(title.into());
        self
    }

    /// Names a mode, replacing its number. `label` counts from 0; along an input it is the number of the motion.
    #[must_use]
    pub fn name_mode(mut self, label: usize, name: impl Into<String>) -> Self {
        self.names.insert(label, name.into());
        self
    }

    /// Names the modes 0, 1, 2, ...
    #[must_use]
    pub fn name_modes<S: Into<String>>(mut self, names: impl IntoIterator<Item = S>) -> Self {
        let names = names.into_iter().map(Into::into);
        self.names.extend(names.enumerate());
        self
    }

    /// Shows frequencies in Hz. By default they are in the unit of the mechanism's answers (`Description::frequency`).
    #[must_use]
    pub fn hertz(mut self) -> Self {
        self.frequency = Some(Frequency::Hertz);
        self
    }

    /// Shows frequencies in rad/s.
    #[must_use]
    pub fn radians_per_second(mut self) -> Self {
        self.frequency = Some(Frequency::RadiansPerSecond);
        self
    }

    /// Sets the upper end of the first vertical axis, in its unit; for eigenvalues the lower end is its negative.
    #[must_use]
    pub fn highest(mut self, value: f64) -> Self {
        self.highest = Some(value).filter(|value| value.is_finite() && *value > 0.0);
        self
    }

    /// Sets the lower end of the first vertical axis of a Campbell diagram, in its unit, to show part of it.
    #[must_use]
    pub fn lowest(mut self, value: f64) -> Self {
        self.lowest = Some(value).filter(|value| value.is_finite());
        self
    }

    /// Draws bands that are too narrow to see a round number of times as wide, and says so.
    #[must_use]
    pub fn widened(mut self) -> Self {
        self.widened = true;
        self
    }

    /// Draws amplitudes on a logarithmic axis where they differ by more than this factor, 100 unless it is set: 1 for always,
    /// infinity for never.
    #[must_use]
    pub fn logarithmic_beyond(mut self, factor: f64) -> Self {
        self.ratio = Some(factor).filter(|factor| *factor >= 1.0);
        self
    }

    /// Adds a vertical line at a value of the horizontal axis, in its unit, such as the running speed of a machine.
    #[must_use]
    pub fn mark(mut self, at: f64, label: impl Into<String>) -> Self {
        self.marks.push((at, label.into()));
        self
    }

    /// Adds a line to the caption.
    #[must_use]
    pub fn note(mut self, line: impl Into<String>) -> Self {
        self.notes.push(line.into());
        self.notes.retain(|line| !line.is_empty());
        self
    }

    /// The title that was set, or else another one.
    #[must_use]
    pub fn titled(&self, otherwise: String) -> String {
        self.title.clone().unwrap_or(otherwise)
    }

    /// The name of a mode, or `mode 1` if it has none.
    #[must_use]
    pub fn mode(&self, label: usize) -> String {
        self.names.get(&label).cloned().unwrap_or_else(|| format!("mode {}", label + 1))
    }

    /// The name of a mode with its kind or whirl sense.
    pub(crate) fn whirling(&self, label: usize, character: Option<Character>) -> String {
        let name = self.mode(label);
        match character {
            Some(character) => format!("{name}, {character}"),
            None => name,
        }
    }

    /// The value of one rad/s in the unit of frequencies, and the symbol of that unit.
    #[must_use]
    pub fn frequency(&self, of: &Description) -> (f64, String) {
        match self.frequency {
            Some(Frequency::Hertz) => (1.0 / TAU, "Hz".to_owned()),
            Some(Frequency::RadiansPerSecond) => (1.0, "rad/s".to_owned()),
            None => (1.0 / of.frequency.scale, of.frequency.symbol.to_string()),
        }
    }

    pub(crate) fn bottom(&self) -> f64 {
        self.lowest.unwrap_or(0.0)
    }

    pub(crate) fn is_widened(&self) -> bool {
        self.widened
    }

    pub(crate) fn ratio(&self) -> Option<f64> {
        self.ratio
    }

    pub(crate) fn top(&self) -> Option<f64> {
        self.highest
    }

    pub(crate) fn marks(&self) -> impl Iterator<Item = crate::figure::Mark> {
        let finite = self.marks.iter().filter(|(at, _)| at.is_finite());
        finite.map(|(at, label)| crate::figure::Mark {
            label: if label.is_empty() { number(*at) } else { label.clone() },
            at: *at,
        })
    }

    pub(crate) fn notes(&self) -> impl Iterator<Item = String> {
        self.notes.iter().cloned()
    }
}
