//! All failures, each with advice and an exit code.

use std::fmt::Display;
use std::io;
use std::path::{Path, PathBuf};

use eigentol::Error;
use eigentol_compiler::base::nearest::nearest;
use eigentol_interpreter::{Mistakes, RefineError, WantedError};
use thiserror::Error as ThisError;

use crate::advice;
use crate::mistake::Mistake;
use crate::nearby::nearby;

#[derive(Debug, ThisError)]
pub(crate) enum Failure {
    #[error("cannot read `{}`: {source}", .path.display())]
    Read { path: PathBuf, source: io::Error },
    #[error("cannot write `{}`: {source}", .path.display())]
    Write { path: PathBuf, source: io::Error },
    #[error("cannot write to standard output: {0}")]
    Print(io::Error),
    /// Drawn in the source text.
    #[error("`{name}` has {} {}", .mistakes.len(), plural(.mistakes.len(), "mistake", "mistakes"))]
    Declaration { name: String, text: String, mistakes: Vec<Mistake> },
    #[error("`{}` is not a valid study file: {message}", .path.display())]
    StudyFile { path: PathBuf, message: String },
    #[error("`{}` cannot be merged: {message}", .path.display())]
    Part { path: PathBuf, message: String },
    #[error("cannot listen for Ctrl-C: {0}")]
    Signal(#[from] ctrlc::Error),
    #[error("`{exists}` exists already")]
    Exists { exists: String },
    #[error("{0}")]
    Usage(String, Option<String>),
    #[error("`{mechanism}` has no {kind} `{name}`")]
    UnknownName { mechanism: String, kind: String, name: String, help: String },
    #[error("{place}: {message}")]
    Value { place: String, message: String, help: Option<String> },
    #[error("{}", advice::message(.0))]
    Analysis(#[from] Error),
    #[error("{0}")]
    Serve(#[from] eigentol_live::Error),
    #[error("{0}")]
    Refine(#[from] RefineError),
    #[error("{0}")]
    Report(eigentol_report::Error),
    #[error("{0}")]
    Table(#[from] eigentol_tables::Error),
    #[error("{0}")]
    Figure(#[from] eigentol_figures::Error),
    /// The reader of a pipe has gone; not a failure.
    #[error("nobody reads the output")]
    NobodyReads,
}

/// Exit code 1 if the analysis says no, 2 for a wrong command line, 3 for a bad file.
impl Failure {
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::NobodyReads => 0,
            Self::Analysis(error) => match error {
                Error::Setting { .. }
                | Error::NotFinite { .. }
                | Error::WrongLength { .. }
                | Error::UnknownHandle { .. }
                | Error::UnknownName { .. }
                | Error::NoSuchMode { .. } => 2,
                _ => 1,
            },
            Self::Figure(error) => match error {
                eigentol_figures::Error::Nothing(_) => 1,
                eigentol_figures::Error::Ending { .. } => 2,
                _ => 3,
            },
            Self::Usage(..) | Self::Refine(_) | Self::UnknownName { .. } | Self::Value { .. } => 2,
            Self::Exists { .. }
            | Self::Table(_)
            | Self::Report(_)
            | Self::Serve(_)
            | Self::Signal(_)
            | Self::Part { .. }
            | Self::Read { .. }
            | Self::Write { .. }
            | Self::Print(_)
            | Self::Declaration { .. }
            | Self::StudyFile { .. } => 3,
        }
    }

    /// Advice on how to fix it.
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::Usage(_, help) | Self::Value { help, .. } => help.clone(),
            Self::UnknownName { help, .. } => Some(help.clone()),
            Self::Read { path, source } => nearby(path, source.kind()),
            Self::Analysis(error) => advice::on(error),
            Self::Exists { .. } => Some("choose another name, or remove it".to_owned()),
            _ => None,
        }
    }

    pub(crate) fn usage(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Usage(message.into(), Some(help.into()))
    }

    /// An unreadable value; `place` is as the user wrote it. Only the first mistake is reported.
    pub(crate) fn value(place: impl Display, mistakes: &Mistakes) -> Self {
        let first = mistakes.iter().next();
        let message = first.map_or("", |mistake| &*mistake.message);
        Self::Value {
            place: shortened(&place.to_string()),
            message: message.to_owned(),
            help: first.and_then(|mistake| mistake.help.clone()),
        }
    }

    pub(crate) fn read(path: &Path, source: io::Error) -> Self {
        Self::Read { path: path.to_owned(), source }
    }

    pub(crate) fn write(path: &Path, source: io::Error) -> Self {
        Self::Write { path: path.to_owned(), source }
    }
}

/// Reports an unknown name and suggests the nearest one.
pub(crate) fn unknown<'a>(mechanism: &str, kind: &str, name: &str, known: impl Iterator<Item = &'a str>) -> Failure {
    let known: Vec<&str> = known.collect();
    let help = match nearest(name, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None if known.is_empty() => "it has none".to_owned(),
        None => format!("it has `{}`", known.join("`, `")),
    };
    Failure::UnknownName { mechanism: mechanism.to_owned(), kind: kind.to_owned(), name: name.to_owned(), help }
}

/// Most characters of a value that are repeated in a message about it.
const LONGEST: usize = 80;

fn shortened(text: &str) -> String {
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{} ...", &text[..end]),
        None => text.to_owned(),
    }
}

impl From<WantedError> for Failure {
    fn from(error: WantedError) -> Self {
        match error {
            WantedError::Meaning { message, help } => Self::usage(message, help),
            WantedError::Value { place, mistakes } => Self::value(place, &mistakes),
            WantedError::Name(Error::UnknownName { kind, name, mechanism, known }) => {
                unknown(&mechanism, kind, &name, known.iter().map(|x| &**x))
            }
            WantedError::Name(error) => Self::Analysis(error),
            other => Self::Usage(other.to_string(), None),
        }
    }
}

impl From<eigentol_report::Error> for Failure {
    fn from(error: eigentol_report::Error) -> Self {
        match error {
            eigentol_report::Error::Study(error) => Self::Analysis(error),
            other => Self::Report(other),
        }
    }
}

pub(crate) fn plural<'a>(count: usize, one: &'a str, many: &'a str) -> &'a str {
    if count == 1 { one } else { many }
}
