//! The output format of an answer.

use std::env;
use std::io::{self, IsTerminal as _};
use std::path::Path;

use clap::Args;
use eigentol_tables::Table;
use serde::Serialize;

use crate::answer::{Answer, Form};
use crate::destination::{Destination, is_same};
use crate::diagnostics;
use crate::failure::Failure;
use crate::rows::Rows;

/// Form and place of the answer.
#[derive(Args, Debug)]
pub(crate) struct Output {
    /// Numbers as one JSON document, with every digit; also for `--output FILE.json`
    #[arg(long, conflicts_with_all = ["csv", "parquet"])]
    json: bool,
    /// Numbers as CSV, units in the headings; also for `--output FILE.csv`
    #[arg(long, conflicts_with = "parquet")]
    csv: bool,
    /// Numbers as a Parquet file, units in the names of columns; also for `--output FILE.parquet`
    #[arg(long)]
    parquet: bool,
    /// Which result to write, if there are several [default for JSON, CSV and Parquet: the one that answers it]
    #[arg(long, value_name = "NAME")]
    result: Option<String>,
    /// Which table of the result to write as CSV or Parquet [default: the one that answers the question]
    #[arg(long, value_name = "NAME")]
    table: Option<String>,
    #[command(flatten)]
    place: Destination,
}

/// Fewest characters on a line.
const NARROWEST: usize = 40;
/// Endings of files that hold a text.
const TEXTS: [&str; 5] = ["txt", "text", "md", "log", "out"];

impl Output {
    /// Rejects unwritable files and inconsistent options before any long computation.
    pub(crate) fn check(&self) -> Result<(), Failure> {
        let form = self.form();
        if let (Form::Text, Some(path)) = (form, self.place.path())
            && eigentol_figures::Form::of(path).is_ok()
        {
            let message = format!("`{}` is a picture, and the answer is a text", path.display());
            let help = "`modes`, `tolerance`, `campbell` and `branches` draw it with `--figure FILE`";
            return Err(Failure::usage(message, help));
        }
        if let (Form::Text, Some(path)) = (form, self.place.path())
            && let Some(ending) = path.extension().and_then(|ending| ending.to_str())
            && !TEXTS.contains(&ending)
        {
            let message = format!("`.{ending}` is the ending of no format that is known here");
            let help = "numbers go to `.csv`, `.json` and `.parquet`, a text to `.txt`";
            return Err(Failure::usage(message, help));
        }
        if self.table.is_some() && !form.has_rows() {
            let help = "add `--csv` or `--parquet`, or an `--output` that ends in `.csv` or `.parquet`";
            return Err(Failure::usage("a table is written only as CSV or Parquet", help));
        }
        if form == Form::Parquet && !eigentol_tables::PARQUET {
            let help = "install it with `--features parquet`, or write `--csv`";
            return Err(Failure::usage("this `eigentol` was built without Parquet files", help));
        }
        if form == Form::Parquet && self.place.path().is_none() && io::stdout().is_terminal() {
            let help = "name a file: `--output FILE.parquet`";
            return Err(Failure::usage("Parquet is binary and not written to a terminal", help));
        }
        self.place.check()
    }

    /// Whether the answer is written to this file.
    pub(crate) fn is_written_to(&self, path: &Path) -> bool {
        self.place.path().is_some_and(|x| is_same(x, path))
    }

    fn form(&self) -> Form {
        let ending = self.place.path().and_then(|path| path.extension()?.to_str());
        match (self.json, self.csv, self.parquet) {
            (true, ..) => Form::Json,
            (_, true, _) => Form::Csv,
            (.., true) => Form::Parquet,
            _ => match ending {
                Some("json") => Form::Json,
                Some("csv") => Form::Csv,
                Some("parquet") => Form::Parquet,
                _ => Form::Text,
            },
        }
    }

    /// Whether rows are written as they arrive.
    pub(crate) fn streams(&self) -> bool {
        self.form().has_rows()
    }

    /// An empty answer in this format.
    pub(crate) fn answer(&self) -> Answer {
        Answer::new(self.form(), self.page())
    }

    /// Writes one result.
    pub(crate) fn show<R: eigentol_tables::Answer + Serialize>(&self, result: &R) -> Result<(), Failure> {
        let mut answer = self.answer();
        answer.add(result)?;
        self.write(&answer)
    }

    /// Characters on a line of text: as many as the terminal has, or as `COLUMNS` says.
    fn page(&self) -> Option<usize> {
        if self.place.path().is_some() {
            return None;
        }
        let terminal = terminal_size::terminal_size_of(io::stdout()).map(|(width, _)| usize::from(width.0));
        Some(terminal.or_else(|| env::var("COLUMNS").ok()?.parse().ok())?.max(NARROWEST))
    }

    /// Which of the results that a question can have will be shown ([`Answer::shown`]).
    pub(crate) fn shown(&self, kinds: &[(&str, bool)]) -> Result<Vec<bool>, Failure> {
        self.answer().shown(kinds, self.result.as_deref())
    }

    /// Whether the table of this name is the only one requested.
    pub(crate) fn wants_table(&self, name: &str) -> bool {
        self.form().has_rows() && self.table.as_deref() == Some(name)
    }

    /// The rows of the table that answers the question, written as they arrive; `None` if something else is requested.
    pub(crate) fn rows<'a, T>(
        &'a self,
        (kind, table): (&str, &str),
        make: impl Fn(&[T]) -> Table + 'a,
    ) -> Result<Option<Rows<'a, T>>, Failure> {
        let matches = |wanted: &Option<String>, name: &str| wanted.as_deref().is_none_or(|wanted| wanted == name);
        let asked = matches(&self.result, kind) && matches(&self.table, table);
        match self.form() {
            form if form.has_rows() && asked => Rows::begin(&self.place, form, Box::new(make)).map(Some),
            _ => Ok(None),
        }
    }

    /// Writes a text that has only one format.
    pub(crate) fn write_text(&self, text: &str) -> Result<(), Failure> {
        self.place.write(text)
    }

    pub(crate) fn write(&self, answer: &Answer) -> Result<(), Failure> {
        let content = answer.written(self.result.as_deref(), self.table.as_deref())?;
        self.place.write_bytes(&content)?;
        if let Some(advice) = answer.advice() {
            diagnostics::note(&advice);
        }
        Ok(())
    }
}
