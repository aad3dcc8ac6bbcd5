//! What a result says, in order, and the one trait by which every result says it.

use core::fmt;

use eigentol_contract::{Description, Input, Shared};

use crate::columns::Columns;
use crate::grid::{Grid, lines};
use crate::table::Table;
use crate::title::title;

/// A result that describes itself.
///
/// Text, tables, CSV, Parquet, JSON, HTML and Python follow from this one description: a new result needs its type and
/// an implementation of this trait beside it.
pub trait Answer {
    /// The kind of result, as documents name it.
    const KIND: &'static str;

    /// The mechanism and operating point the result belongs to; `None` for an empty list.
    fn subject(&self) -> Option<Subject<'_>>;

    /// What it says: a title, tables and sentences.
    fn findings(&self) -> Findings;

    /// The beginning of what it says: mechanism and operating point, and what is computed there.
    fn titled(&self, what: impl fmt::Display) -> Findings {
        match self.subject() {
            Some(of) => of.titled(what),
            None => Findings::titled(what.to_string()),
        }
    }

    /// Tables as large as a run, such as its samples, which no text shows or counts.
    fn details(&self) -> Vec<Table> {
        Vec::new()
    }

    /// Its tables, the answer first, then details. The operating point is in the last columns of each.
    fn tables(&self) -> Vec<Table> {
        let mut tables = self.findings().into_tables();
        tables.extend(self.details());
        if let Some(of) = self.subject() {
            for table in &mut tables {
                table.operating_point(of.description, of.inputs, of.varied);
            }
        }
        tables
    }
}

impl<A: Answer + ?Sized> Answer for &A {
    const KIND: &'static str = A::KIND;

    fn subject(&self) -> Option<Subject<'_>> {
        (**self).subject()
    }

    fn findings(&self) -> Findings {
        (**self).findings()
    }

    fn details(&self) -> Vec<Table> {
        (**self).details()
    }
}

/// A result of which there are often several, which describe themselves together.
pub trait Listed: Sized {
    /// The kind of a list, as documents name it.
    const KIND: &'static str;

    /// The mechanism and operating point of one of them.
    fn subject(&self) -> Option<Subject<'_>>;

    /// What all of them say.
    fn findings(all: &[Self]) -> Findings;
}

impl<T: Listed> Answer for [T] {
    const KIND: &'static str = T::KIND;

    fn subject(&self) -> Option<Subject<'_>> {
        self.first()?.subject()
    }

    fn findings(&self) -> Findings {
        T::findings(self)
    }
}

impl<T: Listed> Answer for Vec<T> {
    const KIND: &'static str = T::KIND;

    fn subject(&self) -> Option<Subject<'_>> {
        self.first()?.subject()
    }

    fn findings(&self) -> Findings {
        T::findings(self)
    }
}

/// The mechanism and the operating point that a result belongs to.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// The mechanism.
    pub description: &'a Shared<Description>,
    /// Its inputs, SI; empty if the result does not record them.
    pub inputs: &'a [f64],
    /// The input that varies.
    pub varied: Option<Input>,
}

impl<'a> Subject<'a> {
    /// A mechanism at an operating point; without inputs where the result does not record them.
    pub fn at(description: &'a Shared<Description>, inputs: &'a [f64]) -> Self {
        Self { description, inputs, varied: None }
    }

    /// A mechanism along an input.
    pub fn along(description: &'a Shared<Description>, inputs: &'a [f64], varied: Input) -> Self {
        Self { varied: Some(varied), ..Self::at(description, inputs) }
    }

    /// `Rotor at speed = 3000 rpm, load = 2 N`. An input that varies has no value.
    pub fn title(&self) -> String {
        title(self.description, self.inputs, self.varied)
    }

    /// A title, and what is computed there.
    pub fn titled(&self, what: impl fmt::Display) -> Findings {
        Findings::titled(format!("{}: {what}", self.title()))
    }
}

/// Inside of an [`Answer`] with the fields `description` and `inputs`: they are its subject.
#[macro_export]
macro_rules! at_point {
    () => {
        fn subject(&self) -> Option<$crate::Subject<'_>> {
            Some($crate::Subject::at(&self.description, &self.inputs))
        }
    };
}

/// What a result says: titles, tables and sentences, in order. As text, the width of the format is that of the page:
/// `format!("{findings:80}")`; without one, sentences stand on one line each.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    parts: Vec<Part>,
}

#[derive(Clone, Debug)]
enum Part {
    Title(String),
    Text(Grid),
    Data(Table),
    Note(String),
}

impl Findings {
    /// Nothing but a title yet.
    #[must_use]
    pub fn titled(title: String) -> Self {
        Self { parts: vec![Part::Title(title)] }
    }

    /// Adds a sentence.
    pub fn note(&mut self, sentence: impl Into<String>) {
        self.parts.push(Part::Note(sentence.into()));
    }

    /// Adds a sentence, if there is one.
    pub fn note_if_any(&mut self, sentence: Option<String>) {
        self.parts.extend(sentence.map(Part::Note));
    }

    /// Adds a table: its data, and its text if any of its columns belongs there.
    pub fn columns<R>(&mut self, columns: Columns<'_, R>) {
        let (data, text) = columns.finish();
        self.text(text);
        self.data(data);
    }

    /// Adds a table of the text alone. An empty one is left out.
    pub fn text(&mut self, grid: Grid) {
        if !grid.is_empty() {
            self.parts.push(Part::Text(grid));
        }
    }

    /// Adds a table of data that the text does not show.
    pub fn data(&mut self, table: Table) {
        self.parts.push(Part::Data(table));
    }

    /// Adds all that another result says.
    pub fn join(&mut self, other: Self) {
        self.parts.extend(other.parts);
    }

    /// Adds what another result says in its text, without its data.
    pub fn quote(&mut self, other: Self) {
        self.parts.extend(other.parts.into_iter().filter(|part| !matches!(part, Part::Data(_))));
    }

    /// The sentences.
    pub fn notes(&self) -> impl Iterator<Item = &str> {
        self.parts.iter().filter_map(|part| match part {
            Part::Note(sentence) => Some(sentence.as_str()),
            _ => None,
        })
    }

    /// The tables of data.
    #[must_use]
    pub fn into_tables(self) -> Vec<Table> {
        let tables = self.parts.into_iter().filter_map(|part| match part {
            Part::Data(table) => Some(table),
            _ => None,
        });
        tables.collect()
    }
}

impl fmt::Display for Findings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut below_table = false;
        self.parts.iter().try_for_each(|part| {
            // Tables that follow each other stand apart.
            match part {
                Part::Text(_) if below_table => writeln!(f)?,
                Part::Text(_) => below_table = true,
                Part::Data(_) => {}
                Part::Title(_) | Part::Note(_) => below_table = false,
            }
            match (part, f.width()) {
                (Part::Title(title), None) => writeln!(f, "{title}"),
                (Part::Title(title), Some(page)) => written(f, &lines(title, page), ["", "  "]),
                (Part::Text(grid), _) => grid.fmt(f),
                (Part::Note(sentence), None) => writeln!(f, "  {sentence}"),
                (Part::Note(sentence), Some(page)) => {
                    written(f, &lines(sentence, page.saturating_sub(4)), ["  ", "    "])
                }
                (Part::Data(_), _) => Ok(()),
            }
        })
    }
}

/// Writes lines, the first and the others with these indents.
fn written(f: &mut fmt::Formatter<'_>, lines: &[String], [first, others]: [&str; 2]) -> fmt::Result {
    let mut indent = first;
    for line in lines {
        writeln!(f, "{indent}{line}")?;
        indent = others;
    }
    Ok(())
}

/// The text of results: what they say ([`Answer::findings`]).
#[macro_export]
macro_rules! displayed {
    ($($result:ty),+ $(,)?) => {
        $(
            impl ::core::fmt::Display for $result {
                fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                    ::core::fmt::Display::fmt(&$crate::Answer::findings(self), f)
                }
            }
        )+
    };
}

#[cfg(test)]
mod tests {
    use super::Findings;
    use crate::columns::Columns;
    use crate::numbers::rough;

    fn said() -> Findings {
        let mut said = Findings::titled("Rod: modes".to_owned());
        let mut table = Columns::new("modes", &[2.5, 7.0]);
        table.number("square", "rad^2/s^2", &|omega| Some(omega * omega));
        said.columns(table);
        said.note("Damping is ignored.");
        said
    }

    #[test]
    fn a_table_without_columns_in_the_text_is_data_alone() {
        assert_eq!(said().to_string(), "Rod: modes\n  Damping is ignored.\n");
        let notes: Vec<String> = said().notes().map(str::to_owned).collect();
        assert_eq!(notes, ["Damping is ignored."]);
        assert_eq!(said().into_tables()[0].rows(), 2);
    }

    #[test]
    fn a_quotation_has_no_data_and_what_is_joined_has() {
        let (mut quoted, mut joined) = (Findings::default(), Findings::default());
        quoted.quote(said());
        joined.join(said());
        assert_eq!(quoted.to_string(), joined.to_string());
        assert!(quoted.into_tables().is_empty());
        assert_eq!(joined.into_tables().len(), 1);
    }

    #[test]
    fn only_the_rows_of_the_text_are_left_out() {
        let mut table = Columns::new("modes", &[2.5, 7.0, 9.0]);
        table.show_rows(vec![0, 2]);
        table.whole("place", &|omega| Some(*omega as usize)).shown();
        let omega = table.number("frequency", "rad/s", &|omega| Some(*omega));
        omega.digits(rough).headed("omega");
        let (data, text) = table.finish();
        assert_eq!(data.rows(), 3);
        assert_eq!(text.to_string(), "  place  omega\n  2      2.500\n  9      9.000\n");
    }
}
