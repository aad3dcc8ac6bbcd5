//! The files of a superelement: found, recognised and read.

use std::fs;
use std::path::{Path, PathBuf};

use eigentol_compiler::include::without_mark;
use eigentol_compiler::matrix_market::{self, Mistake, end};
use serde::Deserialize;

use super::abaqus;
use super::calculix;
use super::dmig;
use super::harwell_boeing;
use super::json::{At, File, Source};
use super::matrix::{DAMPING, MASS, Matrix, Role, STIFFNESS, Wanted, first};
use super::op4;
use crate::declaration::Declaration;
use crate::failure::Failure;

const FORMATS: &str = "`matrix_market`, `abaqus`, `calculix`, `dmig`, `op4` or `harwell_boeing`";

/// Files in the folder of a description.
pub(super) struct Files<'a> {
    pub(super) file: &'a Declaration,
    pub(super) folder: &'a Path,
    pub(super) read: Vec<PathBuf>,
}

/// A matrix and the file that it is from.
pub(super) struct Found {
    pub(super) role: Role,
    pub(super) file: Declaration,
    pub(super) matrix: Matrix,
}

impl<'a> Files<'a> {
    fn wrong(&self, at: At<'_>, message: impl Into<String>) -> Failure {
        self.file.wrong()(at.mistake(&self.file.text, message))
    }

    fn get<T: Deserialize<'a>>(&self, at: At<'a>) -> Result<T, Failure> {
        at.get(&self.file.text).map_err(self.file.wrong())
    }

    /// The matrices that a description gives.
    pub(super) fn matrices(&mut self, file: &File<'a>) -> Result<Vec<Found>, Failure> {
        let [mass, stiffness] = [(MASS, &file.mass), (STIFFNESS, &file.stiffness)];
        let damping = file.damping.as_ref().map(|damping| (DAMPING, damping));
        [mass, stiffness].into_iter().chain(damping).map(|(role, source)| self.matrix(role, source)).collect()
    }

    fn matrix(&mut self, role: Role, source: &Source<'a>) -> Result<Found, Failure> {
        let (file, matrix) = match (source.matrix_market, source.file) {
            (Some(at), None) => self.inline(at)?,
            (None, Some(at)) => self.file(at, source.format, Wanted { role, name: source.name.as_deref() })?,
            _ => {
                let message = format!("give `matrix_market` or `file` of the {}, one of both", role.word);
                return Err(self.file.wrong()(first(message)));
            }
        };
        Ok(Found { role, file, matrix })
    }

    /// A matrix within the description, as one text or a list of lines.
    fn inline(&self, at: At<'a>) -> Result<(Declaration, Matrix), Failure> {
        let text = self.get(at).map(|lines: Vec<String>| lines.join("\n")).or_else(|_| self.get(at))?;
        let file = Declaration { name: self.file.name.clone(), text: self.file.text.clone() };
        match matrix_market::read(&text) {
            Ok(matrix) => Ok((file, matrix.into())),
            Err(Mistake { line, column, message }) => {
                Err(self.wrong(at, format!("line {line}, column {column} of it: {message}")))
            }
        }
    }

    fn file(
        &mut self,
        at: At<'a>,
        format: Option<At<'a>>,
        wanted: Wanted<'_>,
    ) -> Result<(Declaration, Matrix), Failure> {
        let name: String = self.get(at)?;
        let file = self.open(at, &name)?;
        let text = &*file.text;
        let known = format.map_or_else(|| Ok(recognised(text, &name).to_owned()), |format| self.get(format))?;
        let matrix = match &*known {
            "matrix_market" => matrix_market::read(text).map(Matrix::from),
            "harwell_boeing" => harwell_boeing::read(text),
            "dmig" => dmig::read(text, wanted),
            "op4" => op4::read(text, wanted),
            "abaqus" => abaqus::read(text, wanted),
            "calculix" => {
                let rows = self.open(at, &Path::new(&name).with_extension("dof").to_string_lossy())?;
                calculix::read(text, calculix::labels(&rows.text).map_err(rows.wrong())?)
            }
            _ => {
                let message = format!("`{name}` is of no format that is known: give its `format`, {FORMATS}");
                return Err(self.wrong(format.unwrap_or(at), message));
            }
        };
        let matrix = matrix.and_then(Matrix::once).map_err(file.wrong())?;
        Ok((file, matrix))
    }

    /// A file in the folder.
    fn open(&mut self, at: At<'_>, name: &str) -> Result<Declaration, Failure> {
        // A folder without a name is this one.
        let root = Path::new(".").join(self.folder);
        let unreadable = |error| self.wrong(at, format!("`{name}` cannot be read: {error}"));
        let path = root.join(name).canonicalize().map_err(unreadable)?;
        if !path.starts_with(root.canonicalize().map_err(unreadable)?) {
            return Err(self.wrong(at, format!("`{name}` is outside the folder of this file: put it beside it")));
        }
        let text = String::from_utf8(fs::read(&path).map_err(unreadable)?);
        let text = text.map_err(|_| self.wrong(at, format!("`{name}` is binary: write it in ASCII")))?;
        let file = Declaration { name: self.folder.join(name).display().to_string(), text: without_mark(text) };
        if file.text.trim().is_empty() {
            return Err(file.wrong()(first("the file is empty")));
        }
        if !file.text.ends_with('\n') {
            let message =
                "the file is cut off: its last line has no end; write it again, or end the line if it is whole";
            return Err(file.wrong()(end(&file.text, message)));
        }
        self.read.push(path);
        Ok(file)
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
