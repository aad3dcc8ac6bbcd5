//! A study file: repeated settings, in TOML. Values and tolerances are text with the units of the language.

use std::collections::BTreeMap;
use std::fmt::{self, Display};
use std::fs;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use serde::Deserialize;

use crate::failure::Failure;

/// The settings of a study file.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct StudyFile {
    /// File with the declaration, relative to the study file.
    pub(crate) mechanism: Option<PathBuf>,
    /// Values of inputs and design variables.
    #[serde(default)]
    pub(crate) set: BTreeMap<String, Written>,
    /// Start values of coordinates.
    #[serde(default)]
    pub(crate) start: BTreeMap<String, Written>,
    /// Start values of dependent coordinates.
    #[serde(default)]
    pub(crate) guess: BTreeMap<String, Written>,
    /// Whether to take the equilibrium nearest to the start, whatever its stability.
    #[serde(default)]
    pub(crate) stay: bool,
    /// Values of unknowns where steady motions come in a family.
    #[serde(default)]
    pub(crate) hold: BTreeMap<String, Written>,
    /// Bounds of the starts of a search for equilibria, as for `--between`.
    #[serde(default)]
    pub(crate) between: BTreeMap<String, String>,
    /// The number of the equilibrium to take.
    pub(crate) equilibrium: Option<usize>,
    /// Tolerances of design variables and inputs, with their laws.
    #[serde(default)]
    pub(crate) tolerance: BTreeMap<String, String>,
    /// Correlations of pairs of names.
    pub(crate) correlation: Option<Correlation>,
    pub(crate) sigma_level: Option<f64>,
    /// A range, as for `--sweep`.
    pub(crate) sweep: Option<String>,
    pub(crate) points: Option<usize>,
    pub(crate) orders: Option<Vec<f64>>,
    /// Names, as for `--mode-names`.
    #[serde(default)]
    pub(crate) mode_names: Vec<String>,
    pub(crate) frequency_unit: Option<FrequencyUnit>,
    pub(crate) samples: Option<usize>,
    pub(crate) seed: Option<u64>,
    pub(crate) stream: Option<u64>,
    /// The requirements on the design.
    #[serde(default)]
    pub(crate) require: Vec<Require>,
    /// The tolerances and nominal values that `allocate` may choose.
    #[serde(default)]
    pub(crate) choose: Vec<Choose>,
}

/// Names of pairs, each with its correlation.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged, expecting = "a list of pairs, each with its correlation: `correlation = [[\"l\", \"k\", 0.5]]`")]
pub(crate) enum Correlation {
    Pairs(Vec<(String, String, f64)>),
}

/// A value as written: text with its unit, or a number without one.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged, expecting = "a number, or a text with a unit such as \"3000 rpm\"")]
pub(crate) enum Written {
    Text(String),
    Number(f64),
}

impl Display for Written {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text(text) => f.write_str(text),
            Self::Number(number) => number.fmt(f),
        }
    }
}

/// The unit of frequencies in figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, ValueEnum)]
pub(crate) enum FrequencyUnit {
    #[value(name = "Hz", alias = "hz")]
    #[serde(rename = "Hz")]
    Hertz,
    #[value(name = "rad/s")]
    #[serde(rename = "rad/s")]
    RadiansPerSecond,
}

/// A requirement: a mode quantity, an output, or the input value of an event must lie within limits or outside a band.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table `[[require]]`")]
pub(crate) struct Require {
    /// Counted from 1.
    pub(crate) mode: Option<usize>,
    /// Quantity of a mode at the operating point; its frequency by default.
    pub(crate) quantity: Option<Quantity>,
    pub(crate) output: Option<String>,
    /// An output that vibrates under excitations.
    pub(crate) vibration: Option<String>,
    /// One of the excitations; not needed if all have one frequency.
    pub(crate) under: Option<String>,
    /// What is measured of the vibration; the displacement by default.
    pub(crate) measure: Option<Measure>,
    /// A range, as for `--sweep`: the greatest amplitude in it.
    pub(crate) along: Option<String>,
    /// A range: where in it the highest peak of the vibration is.
    pub(crate) peak: Option<String>,
    /// Where the equilibrium loses its stiffness; a range, as for `--sweep`.
    pub(crate) critical: Option<String>,
    /// Where the frequency of the mode is `order` times the input.
    pub(crate) resonance: Option<String>,
    /// Order of a resonance; 1 by default.
    pub(crate) order: Option<f64>,
    /// Where the mode begins to grow.
    pub(crate) flutter: Option<String>,
    /// The equilibrium must be stable.
    #[serde(default)]
    pub(crate) stable: bool,
    pub(crate) at_least: Option<Written>,
    pub(crate) at_most: Option<Written>,
    pub(crate) outside: Option<[Written; 2]>,
    /// A multiple of an input, and how far away from it: `2 speed by 10%`.
    pub(crate) away_from: Option<String>,
    /// Maximum probability of violating the requirement.
    pub(crate) failure: Option<f64>,
}

/// The measure of a vibration.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Measure {
    Displacement,
    Velocity,
    Acceleration,
}

/// The required quantity of a mode.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Quantity {
    Frequency,
    NaturalFrequency,
    DampingRatio,
    Growth,
}

impl Quantity {
    /// The quantity of this name.
    pub(crate) fn named(name: &str) -> Option<Self> {
        Some(match name {
            "frequency" => Self::Frequency,
            "natural_frequency" => Self::NaturalFrequency,
            "damping_ratio" => Self::DampingRatio,
            "growth" => Self::Growth,
            _ => return None,
        })
    }
}

/// A half-width or a nominal value that may be chosen between limits.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table `[[choose]]`")]
pub(crate) struct Choose {
    /// The variable whose tolerance may be chosen.
    pub(crate) tolerance: Option<String>,
    /// The variable whose nominal value may be chosen.
    pub(crate) nominal: Option<String>,
    pub(crate) least: Written,
    pub(crate) most: Written,
    pub(crate) cost: Option<Cost>,
}

/// Cost `fixed + factor / T^power` of a half-width `T` in the declared unit.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table such as `{ factor = 2.0, power = 1.0, fixed = 0.5 }`")]
pub(crate) struct Cost {
    #[serde(default)]
    pub(crate) fixed: f64,
    pub(crate) factor: f64,
    #[serde(default = "one")]
    pub(crate) power: f64,
}

fn one() -> f64 {
    1.0
}

impl StudyFile {
    pub(crate) fn read(path: &Path) -> Result<Self, Failure> {
        let text = fs::read_to_string(path).map_err(|source| Failure::read(path, source))?;
        let mut file: Self = toml::from_str(&text).map_err(|error| Failure::StudyFile {
            path: path.to_owned(),
            message: error.to_string().trim_end().to_owned(),
        })?;
        if let (Some(mechanism), Some(folder)) = (&file.mechanism, path.parent()) {
            file.mechanism = Some(folder.join(mechanism));
        }
        Ok(file)
    }
}
