//! A figure of the answer.

use std::path::PathBuf;

use clap::Args;
use eigentol_figures::{Figure, Form, Style};

use crate::destination::Target;
use crate::failure::Failure;
use crate::output::Output;
use crate::point::Question;

/// Where a figure goes.
#[derive(Args, Debug)]
pub(crate) struct Picture {
    /// Draw the answer into a file, `.svg`, or `.png` if built with that feature; an existing file is replaced
    #[arg(long, value_name = "FILE")]
    figure: Option<PathBuf>,
    #[command(flatten)]
    wording: Wording,
}

/// How a figure calls things.
#[derive(Args, Debug)]
pub(crate) struct Wording {
    /// Names of the modes in figures, in order: `bounce,pitch`; modes without one keep their number
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    mode_names: Vec<String>,
}

impl Wording {
    fn is_given(&self) -> bool {
        !self.mode_names.is_empty()
    }

    fn names<'a>(&'a self, question: &'a Question) -> &'a [String] {
        if self.mode_names.is_empty() { &question.file.mode_names } else { &self.mode_names }
    }

    /// Refuses more names than there are modes. Fewer are enough: modes without a name keep their number.
    pub(crate) fn check(&self, question: &Question, modes: usize) -> Result<(), Failure> {
        let names = self.names(question);
        if names.len() <= modes {
            return Ok(());
        }
        let there = match modes {
            1 => "is 1 mode".to_owned(),
            _ => format!("are {modes} modes"),
        };
        let message = format!("{} names of modes are given, and there {there}", names.len());
        let unknown = names[modes..].join("`, `");
        Err(Failure::usage(message, format!("leave out `{unknown}`")))
    }

    /// Mode names from the study file, overridden by the command line.
    pub(crate) fn style(&self, question: &Question) -> Style {
        Style::default().name_modes(self.names(question).iter().map(|name| name.trim()))
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
            let message = "names of modes only apply to a figure";
            return Err(Failure::usage(message, "ask for one: `--figure modes.svg`"));
        }
        if let Some(path) = &self.figure {
            Form::of(path)?;
            if output.is_written_to(path) {
                let message = format!("`{}` cannot hold the answer and its figure", path.display());
                let help = "give `--output` and `--figure` files of their own";
                return Err(Failure::usage(message, help));
            }
            Target::of(path).check().map_err(|source| Failure::write(path, source))?;
        }
        Ok(())
    }

    /// The style of a figure without modes.
    pub(crate) fn plain_style(&self, question: &Question) -> Style {
        self.wording.style(question).design_of(&question.study)
    }

    /// The style of a figure of so many modes.
    pub(crate) fn style(&self, question: &Question, modes: usize) -> Result<Style, Failure> {
        if self.is_wanted() {
            self.wording.check(question, modes)?;
        }
        Ok(self.plain_style(question))
    }

    /// Draws the figure, if one is requested.
    pub(crate) fn draw(&self, figure: impl FnOnce() -> Result<Figure, eigentol_figures::Error>) -> Result<(), Failure> {
        if let Some(path) = &self.figure {
            let file = figure()?.file(Form::of(path)?)?;
            Target::of(path).write(&file).map_err(|source| Failure::write(path, source))?;
        }
        Ok(())
    }
}
