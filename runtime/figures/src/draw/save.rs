//! Writing figures to files.

use std::fs;
use std::path::Path;

use crate::{Error, Figure};

/// The file format of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Form {
    /// A vector drawing.
    Svg,
    /// A raster image.
    #[cfg(feature = "png")]
    Png,
}

impl Form {
    /// The form given by a file extension: `.svg`, or `.png` with the feature `png`.
    ///
    /// # Errors
    /// [`Error::Ending`] for any other extension.
    pub fn of(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let ending = path.extension().and_then(|x| x.to_str());
        match ending.map(str::to_ascii_lowercase).as_deref() {
            Some("svg") => Ok(Self::Svg),
            #[cfg(feature = "png")]
            Some("png") => Ok(Self::Png),
            _ => Err(Error::Ending {
                path: path.to_owned(),
                known: if cfg!(feature = "png") {
                    "`.svg` or `.png`"
                } else {
                    "`.svg`, and as `.png` by a program built with the feature `png`"
                },
            }),
        }
    }
}

impl Figure {
    /// The content of a file in this form.
    ///
    /// # Errors
    /// [`Error::Drawing`].
    pub fn file(&self, form: Form) -> Result<Vec<u8>, Error> {
        match form {
            Form::Svg => Ok(self.svg()?.into_bytes()),
            #[cfg(feature = "png")]
            Form::Png => self.png(),
        }
    }

    /// Writes the figure to a file, in the form given by its extension ([`Form::of`]).
    ///
    /// # Errors
    /// [`Error::Ending`], [`Error::Write`], [`Error::Drawing`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        let path = path.as_ref();
        let file = self.file(Form::of(path)?)?;
        fs::write(path, file).map_err(|source| Error::Write { path: path.to_owned(), source })
    }
}
