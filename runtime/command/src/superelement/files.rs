//! The files of a superelement: found, recognised and read.

use std::fs;
use std::path::{Path, PathBuf};

use super::json::{At, File, Source};
use super::matrix::{DAMPING, MASS, Matrix, Role, STIFFNESS, Wanted};
use super::{Wrong, abaqus, calculix, dmig, first, harwell_boeing, op4};
use eigentol_compiler::matrix_market::{self, Mistake, end};

const FORMATS: &str = "`matrix_market`, `abaqus`, `calculix`, `dmig`, `op4` or `harwell_boeing`";

/// Files in the folder of a description.
pub(super) struct Files<'a> {
    name: &'a str,
    text: &'a str,
    folder: &'a Path,
    pub(super) read: Vec<PathBuf>,
}

/// A matrix and the file that it is from.
pub(super) struct Found {
    pub(super) role: Role,
    name: String,
    text: String,
    pub(super) matrix: Matrix,
}

impl Found {
    /// What is wrong with the whole matrix.
    pub(super) fn wrong(&self, message: impl Into<String>) -> Wrong {
        Wrong { name: self.name.clone(), text: self.text.clone(), mistake: first(message) }
    }
}

impl<'a> Files<'a> {
    pub(super) fn of((name, text): (&'a str, &'a str), folder: &'a Path) -> Self {
        Self { name, text, folder, read: Vec::new() }
    }

    fn wrong(&self, at: At<'_>, message: impl Into<String>) -> Wrong {
        self.here(at.mistake(self.text, message))
    }

    fn here(&self, mistake: Mistake) -> Wrong {
        Wrong { name: self.name.to_owned(), text: self.text.to_owned(), mistake }
    }

    /// The matrices that a description gives.
    pub(super) fn matrices(&mut self, file: &File<'a>) -> Result<Vec<Found>, Wrong> {
        let [mass, stiffness] = [(MASS, &file.mass), (STIFFNESS, &file.stiffness)];
        let damping = file.damping.as_ref().map(|damping| (DAMPING, damping));
        [mass, stiffness].into_iter().chain(damping).map(|(role, source)| self.matrix(role, source)).collect()
    }

    fn matrix(&mut self, role: Role, source: &Source<'a>) -> Result<Found, Wrong> {
        let (name, text, matrix) = match (source.matrix_market, source.file) {
            (Some(at), None) => (self.name.to_owned(), self.text.to_owned(), self.inline(at)?),
            (None, Some(at)) => self.file(at, source.format, Wanted { role, name: source.name.as_deref() })?,
            (Some(at), Some(_)) => return Err(self.wrong(at, "give `matrix_market` or `file`, not both")),
            (None, None) => {
                let message = format!("the {} has neither `matrix_market` nor `file`: give one", role.word);
                return Err(self.here(first(message)));
            }
        };
        Ok(Found { role, name, text, matrix })
    }

    /// A matrix within the description, as one text or a list of lines.
    fn inline(&self, at: At<'a>) -> Result<Matrix, Wrong> {
        let lines = at.get(self.text).map(|lines: Vec<String>| lines.join("\n"));
        let text = lines.or_else(|_| at.get(self.text)).map_err(|mistake| self.here(mistake))?;
        matrix_market::read(&text).map(Matrix::from).map_err(|mistake| {
            self.wrong(at, format!("line {}, column {} of it: {}", mistake.line, mistake.column, mistake.message))
        })
    }

    /// A matrix with the name and the text of its file.
    fn file(
        &mut self,
        at: At<'a>,
        format: Option<At<'a>>,
        wanted: Wanted<'_>,
    ) -> Result<(String, String, Matrix), Wrong> {
        let file: String = at.get(self.text).map_err(|mistake| self.here(mistake))?;
        let text = self.open(at, &file)?;
        let known = match format {
            Some(format) => format.get(self.text).map_err(|mistake| self.here(mistake))?,
            None => recognised(&text, &file).to_owned(),
        };
        let read = match &*known {
            "matrix_market" => matrix_market::read(&text).map(Matrix::from),
            "harwell_boeing" => harwell_boeing::read(&text),
            "dmig" => dmig::read(&text, wanted),
            "op4" => op4::read(&text, wanted),
            "abaqus" => abaqus::read(&text, wanted),
            "calculix" => {
                let beside = Path::new(&file).with_extension("dof").to_string_lossy().into_owned();
                let rows = self.open(at, &beside)?;
                let labels = calculix::labels(&rows);
                calculix::read(
                    &text,
                    labels.map_err(|mistake| Wrong { name: self.shown(&beside), text: rows, mistake })?,
                )
            }
            _ => {
                let message = match format {
                    Some(_) => format!("`{known}` is not a format that is read: they are {FORMATS}"),
                    None => format!("the format of `{file}` is not recognised: give its `format`, {FORMATS}"),
                };
                return Err(self.wrong(format.unwrap_or(at), message));
            }
        };
        let name = self.shown(&file);
        match read {
            Ok(matrix) => Ok((name, text, matrix)),
            Err(mistake) => Err(Wrong { name, text, mistake }),
        }
    }

    fn shown(&self, file: &str) -> String {
        self.folder.join(file).display().to_string()
    }

    /// The text of a file in the folder.
    fn open(&mut self, at: At<'_>, file: &str) -> Result<String, Wrong> {
        // A folder without a name is this one.
        let root = Path::new(".").join(self.folder);
        let unreadable = |error| self.wrong(at, format!("`{file}` cannot be read: {error}"));
        let path = root.join(file).canonicalize().map_err(unreadable)?;
        if !path.starts_with(root.canonicalize().map_err(unreadable)?) {
            return Err(self.wrong(at, format!("`{file}` is outside the folder of this file: put it beside it")));
        }
        let text = String::from_utf8(fs::read(&path).map_err(unreadable)?);
        let text =
            text.map_err(|_| self.wrong(at, format!("`{file}` is not text: write it in ASCII, not as binary data")))?;
        if !text.ends_with('\n') {
            let message =
                "the file is cut off: its last line has no end; write it again, or end the line if it is whole";
            return Err(Wrong { name: self.shown(file), mistake: end(&text, message), text });
        }
        self.read.push(path);
        Ok(text)
    }
}

/// The format of a text; only CalculiX needs the ending of its name.
fn recognised(text: &str, file: &str) -> &'static str {
    let ending = Path::new(file).extension().unwrap_or_default().to_ascii_lowercase();
    match text {
        _ if text.get(..14).is_some_and(|word| word.eq_ignore_ascii_case("%%MatrixMarket")) => "matrix_market",
        _ if harwell_boeing::is_it(text) => "harwell_boeing",
        _ if dmig::is_it(text) => "dmig",
        _ if op4::is_it(text) => "op4",
        _ if ["sti", "mas"].iter().any(|known| ending == *known) => "calculix",
        _ if abaqus::is_it(text) => "abaqus",
        _ => "",
    }
}
