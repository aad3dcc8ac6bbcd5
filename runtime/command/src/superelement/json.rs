//! The file that describes a superelement: stations, units, and where its matrices are.

use eigentol_compiler::matrix_market::Mistake;
use serde::Deserialize;
use serde_json::value::RawValue;

/// The whole file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File<'a> {
    pub(super) superelement: String,
    #[serde(default, borrow)]
    pub(super) units: Units<'a>,
    #[serde(borrow)]
    pub(super) stations: Vec<Station<'a>>,
    #[serde(borrow)]
    pub(super) unknowns: Option<At<'a>>,
    #[serde(borrow)]
    pub(super) mass: Source<'a>,
    #[serde(borrow)]
    pub(super) stiffness: Source<'a>,
    #[serde(borrow)]
    pub(super) damping: Option<Source<'a>>,
    pub(super) held: Option<Held>,
}

/// Where the part is fixed, if it is.
#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Held {
    Inside,
}

/// Units of the matrices and positions; what is not given is in SI.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Units<'a> {
    #[serde(borrow)]
    pub(super) length: Option<At<'a>>,
    #[serde(borrow)]
    pub(super) mass: Option<At<'a>>,
    #[serde(borrow)]
    pub(super) force: Option<At<'a>>,
    #[serde(borrow)]
    pub(super) time: Option<At<'a>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Station<'a> {
    pub(super) name: Option<String>,
    #[serde(borrow)]
    pub(super) node: Option<At<'a>>,
    pub(super) position: [f64; 3],
}

/// Where a matrix is.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Source<'a> {
    #[serde(borrow)]
    pub(super) matrix_market: Option<At<'a>>,
    #[serde(borrow)]
    pub(super) file: Option<At<'a>>,
    #[serde(borrow)]
    pub(super) format: Option<At<'a>>,
    pub(super) name: Option<String>,
}

/// A value that is read where its place is known.
#[derive(Clone, Copy, Deserialize)]
#[serde(transparent)]
pub(super) struct At<'a>(#[serde(borrow)] &'a RawValue);

impl<'a> At<'a> {
    /// A mistake in this value of a text.
    pub(super) fn mistake(self, text: &str, message: impl Into<String>) -> Mistake {
        let at = (self.0.get().as_ptr() as usize).saturating_sub(text.as_ptr() as usize);
        let (line, column) = crate::mistake::Mistake::at(text, at, String::new()).start;
        Mistake { line, column, message: message.into() }
    }

    pub(super) fn get<T: Deserialize<'a>>(self, text: &str) -> Result<T, Mistake> {
        serde_json::from_str(self.0.get()).map_err(|error| self.mistake(text, plain(&error)))
    }
}

/// Reads the file.
pub(super) fn read(text: &str) -> Result<File<'_>, Mistake> {
    serde_json::from_str(text).map_err(|error| Mistake {
        line: error.line(),
        column: error.column().max(1),
        message: plain(&error),
    })
}

/// A message without the place that is drawn.
fn plain(error: &serde_json::Error) -> String {
    error.to_string().split(" at line ").next().unwrap_or_default().to_owned()
}
