//! A figure of the answer.

use std::path::PathBuf;

use clap::Args;
use eigentol_figures::{Figure, Form, Style};

use crate::failure::{Failure, plural};
use crate::output::Output;
use crate::place::Target;
use crate::point::Question;
use crate::study_file::FrequencyUnit;

/// Where a figure goes.
#[derive(Args, Debug)]
pub(crate) struct Picture {
    /// Draw the answer into a file, `.svg` or `.png`; an existing file is replaced
    #[arg(long, value_name = "FILE")]
    figure: Option<PathBuf>,
    #[command(flatten)]
    wording: Wording,
}

/// How a figure calls things.
#[derive(Args, Debug)]
pub(crate) struct Wording {
    /// Names of the modes in figures, in order: `bounce,pitch` [default: their numbers]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    mode_names: Vec<String>,
    /// Unit of frequencies in figures [default: Hz along an input in rpm or Hz, otherwise rad/s]
    #[arg(long, value_name = "UNIT", value_enum)]
    frequency_unit: Option<FrequencyUnit>,
}

impl Wording {
    fn is_given(&self) -> bool {
        !self.mode_names.is_empty() || self.frequency_unit.is_some()
    }

    /// Mode names and units from the study file, overridden by the command line.
    pub(crate) fn style(&self, question: &Question) -> Style {
        let names = match self.mode_names.is_empty() {
            true => &question.file.mode_names,
            false => &self.mode_names,
        };
        let style = Style::default().name_modes(names.iter().map(|name| name.trim()));
        match self.frequency_unit.or(question.file.frequency_unit) {
            None => style,
            Some(FrequencyUnit::Hertz) => style.hertz(),
            Some(FrequencyUnit::RadiansPerSecond) => style.radians_per_second(),
        }
    }
}

impl Picture {
    /// Whether a figure is requested.
    pub(crate) fn is_wanted(&self) -> bool {
        self.figure.is_some()
    }

    /// Rejects, before any long computation, wording options without a figure, unknown file formats and unwritable
    /// files.
    pub(crate) fn check(&self, output: &Output) -> Result<(), Failure> {
        if self.figure.is_none() && self.wording.is_given() {
            let message = "names of modes and a unit of frequencies only apply to a figure";
            return Err(Failure::usage(message, "ask for one: `--figure modes.svg`"));
        }
        if let Some(path) = &self.figure {
            Form::of(path)?;
            let writable = Target::of(path).check();
            writable.map_err(|source| Failure::write(path, source))?;
        }
        Ok(())
    }

    /// The style of the figure.
    pub(crate) fn style(&self, question: &Question) -> Style {
        self.wording.style(question).design_of(&question.study)
    }

    /// Draws the figure, if one is requested.
    pub(crate) fn draw(
        &self,
        figure: impl FnOnce() -> Result<Figure, eigentol_figures::Error>,
    ) -> Result<(), Failure> {
        if let Some(path) = &self.figure {
            let file = figure()?.file(Form::of(path)?)?;
            let written = Target::of(path).write(&file);
            if output.is_written_to(path) {
                let message = format!("`{}` cannot hold the answer and its figure", path.display());
                let help = "give `--output` and `--figure` files of their own";
                return Err(Failure::usage(message, help));
            }
            written.map_err(|source| Failure::write(path, source))?;
        }
        Ok(())
    }
}
