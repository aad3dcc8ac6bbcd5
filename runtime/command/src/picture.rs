//! A figure of the answer.

use std::path::PathBuf;

use clap::Args;
use eigentol_figures::{Figure, Form};

use crate::failure::Failure;
use crate::place::Target;

/// Where a figure goes.
#[derive(Args, Debug)]
pub(crate) struct Picture {
    /// Draw a figure of the answer into a file, `.svg` or `.png`; a file that exists is replaced
    #[arg(long, value_name = "FILE")]
    figure: Option<PathBuf>,
}

impl Picture {
    /// Whether a figure is asked for.
    pub(crate) fn is_wanted(&self) -> bool {
        self.figure.is_some()
    }

    /// Refuses, before long work, a file of another form or one that cannot be written.
    pub(crate) fn check(&self) -> Result<(), Failure> {
        if let Some(path) = &self.figure {
            Form::of(path)?;
            let writable = Target::of(path).check();
            writable.map_err(|source| Failure::write(path, source))?;
        }
        Ok(())
    }

    /// Draws the figure that is asked for, if it is.
    pub(crate) fn draw(
        &self,
        figure: impl FnOnce() -> Result<Figure, eigentol_figures::Error>,
    ) -> Result<(), Failure> {
        if let Some(path) = &self.figure {
            let file = figure()?.file(Form::of(path)?)?;
            let written = Target::of(path).write(&file);
            written.map_err(|source| Failure::write(path, source))?;
        }
        Ok(())
    }
}
