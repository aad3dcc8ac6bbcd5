//! Figures in files.

use std::fs;
use std::path::Path;

use crate::{Error, Figure};

/// The endings that [`Figure::save`] knows.
const KNOWN: &str = if cfg!(feature = "png") {
    "`.svg` or `.png`"
} else {
    "`.svg`"
};

impl Figure {
    /// Writes the figure into a file, in the form that the ending of its name says: `.svg`, or `.png` with the feature `png`.
    ///
    /// # Errors
    /// [`Error::Ending`] for another one, [`Error::Write`], [`Error::Drawing`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        let path = path.as_ref();
        let ending = path.extension().and_then(|own| own.to_str());
        let file = match ending.map(str::to_ascii_lowercase).as_deref() {
            Some("svg") => self.svg()?.into_bytes(),
            #[cfg(feature = "png")]
            Some("png") => self.png()?,
            _ => {
                return Err(Error::Ending {
                    path: path.to_owned(),
                    known: KNOWN,
                });
            }
        };
        fs::write(path, file).map_err(|source| Error::Write {
            path: path.to_owned(),
            source,
        })
    }
}
