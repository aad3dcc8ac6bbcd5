//! A study file: repeated settings, in TOML. Values and tolerances are text with the units of the language.

use std::collections::BTreeMap;
use std::fmt::{self, Display};
use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Deserializer};

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
    pub(crate) tolerance: BTreeMap<String, Written>,
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
    /// The unit of frequencies in texts and figures.
    pub(crate) frequency_unit: Option<String>,
    /// Units in which answers state inputs, design variables, coordinates and outputs.
    #[serde(default)]
    pub(crate) unit: BTreeMap<String, String>,
    pub(crate) samples: Option<usize>,
    pub(crate) seed: Option<u64>,
    pub(crate) stream: Option<u64>,
    /// The requirements on the design, as for `--require`.
    #[serde(default, deserialize_with = "texts")]
    pub(crate) require: Vec<String>,
    /// The greatest probability of violating them, one or one for each.
    #[serde(default, deserialize_with = "one_or_each")]
    pub(crate) failure: Option<Vec<f64>>,
    /// The tolerances and nominal values that `allocate` may choose.
    #[serde(default)]
    pub(crate) choose: Vec<Choose>,
    /// All of them as they are written.
    #[serde(skip)]
    pub(crate) all: toml::Table,
}

/// Names of pairs, each with its correlation.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged, expecting = "a list of pairs, each with its correlation: `correlation = [[\"l\", \"k\", 0.5]]`")]
pub(crate) enum Correlation {
    Pairs(Vec<(String, String, f64)>),
}

/// A requirement is a text.
fn texts<'de, D: Deserializer<'de>>(given: D) -> Result<Vec<String>, D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged, expecting = "a requirement is a text: `require = [\"frequency 1 >= 20 Hz\"]`, `failure = 0.001`")]
    enum Texts {
        All(Vec<String>),
    }
    Texts::deserialize(given).map(|Texts::All(all)| all)
}

fn one_or_each<'de, D: Deserializer<'de>>(given: D) -> Result<Option<Vec<f64>>, D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged, expecting = "a number, or a list with one for each requirement")]
    enum Numbers {
        One(f64),
        Each(Vec<f64>),
    }
    Ok(Some(match Numbers::deserialize(given)? {
        Numbers::One(number) => vec![number],
        Numbers::Each(all) => all,
    }))
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
        // What is a study file is a table.
        file.all = text.parse().unwrap_or_default();
        if let (Some(mechanism), Some(folder)) = (&file.mechanism, path.parent()) {
            file.mechanism = Some(folder.join(mechanism));
        }
        Ok(file)
    }
}
