//! In which form an answer is written.

use clap::Args;

use crate::answer::{Answer, Form};
use crate::failure::Failure;
use crate::place::Place;

/// Form and place of the answer.
#[derive(Args, Debug)]
pub(crate) struct Output {
    /// Numbers as one JSON document, with every digit
    #[arg(long, conflicts_with = "csv")]
    json: bool,
    /// Numbers as CSV, units in the headings
    #[arg(long)]
    csv: bool,
    /// Which result is written, of a question with several [default for JSON and CSV: the one that answers it]
    #[arg(long, value_name = "NAME")]
    result: Option<String>,
    /// Which table of the result is written as CSV [default: the one that answers the question]
    #[arg(long, value_name = "NAME", requires = "csv")]
    table: Option<String>,
    #[command(flatten)]
    place: Place,
}

impl Output {
    /// Refuses, before long work, a file that cannot be written.
    pub(crate) fn check(&self) -> Result<(), Failure> {
        self.place.check()
    }

    /// An answer to fill.
    pub(crate) fn answer(&self) -> Answer {
        Answer::new(match (self.json, self.csv) {
            (true, _) => Form::Json,
            (false, true) => Form::Csv,
            (false, false) => Form::Text,
        })
    }

    /// Writes a text that has only one form.
    pub(crate) fn write_text(&self, text: &str) -> Result<(), Failure> {
        self.place.write(text)
    }

    pub(crate) fn write(&self, answer: &Answer) -> Result<(), Failure> {
        let text = answer.written(self.result.as_deref(), self.table.as_deref())?;
        self.place.write(&text)
    }
}
