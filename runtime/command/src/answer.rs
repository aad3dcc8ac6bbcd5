//! An answer: results as readable text, tables or documents.
//!
//! # What is not shown is not computed
//!
//! A command asks for the results its form will show (`Answer::shown`), and second derivatives of all modes share the
//! motion of the state: one factorisation and one pass over the kernels per direction, then blocks of modes
//! (`second_order/`). `tolerance` of 150 storeys took 29 s and takes 2.1 s; only its first-order table, 0.2 s.
//! `tests/runtime/chance/work.rs` counts the kernels that each question calls.

use eigentol_compiler::base::nearest::nearest;
use eigentol_tables::{Table, csv, json, parquet};
use serde::Serialize;

use crate::advice;
use crate::failure::Failure;

/// The results of a question; the one that answers it comes first.
pub(crate) struct Answer {
    form: Form,
    /// Characters on a line of text.
    page: Option<usize>,
    results: Vec<Written>,
    /// The last mode that a result rests on, if the machine has beams.
    last_mode: usize,
}

/// The format in which results are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    Text,
    Csv,
    Json,
    Parquet,
}

impl Form {
    /// Whether the format holds a single table.
    pub(crate) fn has_rows(self) -> bool {
        matches!(self, Self::Csv | Self::Parquet)
    }
}

/// A formatted result.
struct Written {
    kind: &'static str,
    /// The result as text or as a document.
    text: String,
    tables: Vec<Table>,
    aside: bool,
}

impl Answer {
    /// An answer in this form, texts with so many characters on a line if that is known.
    pub(crate) fn new(form: Form, page: Option<usize>) -> Self {
        Self { form, page, results: Vec::new(), last_mode: 0 }
    }

    /// Which of the results of a question [`Self::written`] will show: only those need to be computed. `kinds` are all
    /// results that there can be, in order, each with whether it is set aside.
    pub(crate) fn shown(&self, kinds: &[(&str, bool)], kind: Option<&str>) -> Result<Vec<bool>, Failure> {
        if self.form == Form::Text && kind.is_none() {
            return Ok(kinds.iter().map(|(_, aside)| !aside).collect());
        }
        let wanted = named("result", kinds, kind, |pair| pair.0)?.0;
        Ok(kinds.iter().map(|(x, _)| *x == wanted).collect())
    }

    /// Adds a result.
    pub(crate) fn add<R: eigentol_tables::Answer + Serialize>(&mut self, result: &R) -> Result<(), Failure> {
        let kind = R::KIND;
        let (text, tables) = match self.form {
            Form::Text => {
                let findings = result.findings();
                let text = match self.page {
                    Some(page) => format!("{findings:page$}"),
                    None => findings.to_string(),
                };
                (text, Vec::new())
            }
            Form::Csv | Form::Parquet => (String::new(), result.tables()),
            Form::Json => (json::to_string(result)?, Vec::new()),
        };
        let of_few = self.form == Form::Text && kind == "Campbell diagram";
        if advice::has_beams() && kind != "convergence" && !of_few {
            self.last_mode = self.last_mode.max(advice::last_mode(&result.tables()));
        }
        self.results.push(Written { kind, text, tables, aside: false });
        Ok(())
    }

    /// Says that the answer rests on modes up to this one.
    pub(crate) fn rests_on(&mut self, mode: usize) {
        self.last_mode = self.last_mode.max(mode);
    }

    /// What beams are too coarse for.
    pub(crate) fn advice(&self) -> Option<String> {
        advice::on_beams(self.last_mode)
    }

    /// Adds a result whose text is shown only on request, because another result already includes it.
    pub(crate) fn add_aside<R: eigentol_tables::Answer + Serialize>(&mut self, result: &R) -> Result<(), Failure> {
        self.add(result)?;
        if let Some(result) = self.results.last_mut() {
            result.aside = true;
        }
        Ok(())
    }

    /// The formatted answer: as text, the result of this kind or else all results not set aside; otherwise the result
    /// of this kind or the first.
    pub(crate) fn written(&self, kind: Option<&str>, table: Option<&str>) -> Result<Vec<u8>, Failure> {
        if self.form == Form::Text && kind.is_none() {
            let shown = self.results.iter().filter(|result| !result.aside);
            let all: Vec<&str> = shown.map(|shown| shown.text.as_str()).collect();
            return Ok(all.join("\n").into_bytes());
        }
        let result = named("result", &self.results, kind, |x| x.kind)?;
        if !self.form.has_rows() {
            return Ok(result.text.clone().into_bytes());
        }
        let table = named("table", &result.tables, table, |x| &x.name)?;
        let mut file = Vec::new();
        match self.form {
            Form::Parquet => parquet::write(table, &mut file)?,
            _ => csv::write(table, &mut file)?,
        }
        Ok(file)
    }
}

/// The item with this name, or the first if no name is given.
fn named<'a, T>(
    what: &str,
    all: &'a [T],
    name: Option<&str>,
    name_of: impl Fn(&'a T) -> &'a str,
) -> Result<&'a T, Failure> {
    let found = match name {
        Some(name) => meant(name, all, &name_of),
        None => all.first(),
    };
    found.ok_or_else(|| {
        let name = name.unwrap_or_default();
        let names: Vec<&str> = all.iter().map(name_of).collect();
        let listed = format!("there are `{}`", names.join("`, `"));
        let help = match nearest(name, names.iter().copied()) {
            Some(near) => format!("did you mean `{near}`? {listed}"),
            None => listed,
        };
        Failure::usage(format!("the answer has no {what} `{name}`"), help)
    })
}

/// What headings call some results, apart from the machine and the operating point.
const HEADINGS: [(&str, &str); 7] = [
    ("natural modes", "modes"),
    ("equilibrium,", "equilibrium"),
    ("what tolerances do to the frequencies", "summary"),
    ("first order spread of the outputs", "output tolerances"),
    ("sensitivities of the frequencies", "sensitivities"),
    ("shift of the equilibrium", "equilibrium shift"),
    ("outputs", "output sensitivities"),
];

/// The item with exactly this name or its heading, or the only one whose name begins with these words.
///
/// Case is ignored, and `_`, `-` and spaces are equivalent: the library's `first_order` matches
/// `first-order tolerances`.
fn meant<'a, T>(name: &str, all: &'a [T], name_of: impl Fn(&'a T) -> &'a str) -> Option<&'a T> {
    let plain = |text: &str| text.to_lowercase().replace(['-', '_'], " ");
    let name = plain(name);
    let heading = name.rsplit(": ").next().unwrap_or(&name);
    let headed = HEADINGS.iter().find(|x| heading.starts_with(x.0));
    let exact = |wanted: &str| all.iter().find(|x| plain(name_of(x)) == wanted);
    let found = exact(&name).or_else(|| exact(headed?.1));
    if found.is_some() {
        return found;
    }
    let begins = |item: &&'a T| plain(name_of(item)).starts_with(&format!("{name} "));
    let mut candidates = all.iter().filter(begins);
    candidates.next().filter(|_| candidates.next().is_none())
}

#[cfg(test)]
mod tests {
    use super::meant;

    #[test]
    fn names_as_the_library_writes_them() {
        let all = ["first-order tolerances", "summary", "output tolerances", "output shares"];
        for (name, expected) in [
            ("first-order tolerances", Some(all[0])),
            ("first_order", Some(all[0])),
            ("First Order", Some(all[0])),
            ("output_tolerances", Some(all[2])),
            ("SUMMARY", Some(all[1])),
            ("Rotor at speed = 3 rpm: first-order spread of the outputs", Some(all[2])),
            ("what tolerances do", None),
            ("output", None),
            ("first_ord", None),
            ("", None),
        ] {
            let found = meant(name, &all, |x| x).copied();
            assert_eq!(found, expected, "{name}");
        }
    }
}
