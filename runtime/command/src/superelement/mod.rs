//! Superelements: linear parts that a finite element program has reduced to stations and internal coordinates, translated into
//! declarations with their matrices beside them.

mod abaqus;
mod assembly;
mod calculix;
mod dmig;
mod files;
mod fortran;
mod harwell_boeing;
mod json;
mod matrix;
mod op4;
mod part;
mod units;

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use eigentol_compiler::early_stages_of_text;
use eigentol_compiler::matrix_market::{MOST_ROWS, Mistake, digits, rounding, write};

use self::assembly::{Order, Row};
use self::files::{Files, Found};
use self::json::File;
use self::matrix::{STIFFNESS, first};
use self::part::Part;
pub(crate) use self::part::identifier;
use crate::declaration::Declaration;
use crate::failure::Failure;
use crate::mistake;

/// From which rounding on a note says so: of six digits and fewer.
const COARSE: f64 = 1e-5;

/// A declaration, and what belongs beside it.
pub(crate) struct Superelement {
    pub(crate) declaration: String,
    /// Names and texts of the files of its matrices.
    pub(crate) matrices: Vec<(String, String)>,
    pub(crate) notes: Vec<String>,
    /// The files that were read.
    pub(crate) read: Vec<PathBuf>,
}

/// Whether a text describes a superelement.
pub(crate) fn is_superelement(text: &str) -> bool {
    text.trim_start().starts_with('{') && text.contains("\"superelement\"")
}

/// Translates the superelement that a file describes; its matrices are in `folder`, and the names of what belongs beside the
/// declaration begin with `stem`.
pub(crate) fn import(
    file: &Declaration,
    folder: &Path,
    stem: &str,
    mechanism: Option<&str>,
) -> Result<Superelement, Failure> {
    let part = Part::read(&file.text).map_err(file.wrong())?;
    let mut files = Files { file, folder, read: Vec::new() };
    let found = files.matrices(&part.file)?;
    let rows = part.rows(&found)?;
    let listed: HashSet<Row> = rows.iter().flatten().copied().collect();
    let mut notes = part.lacking(&listed).map_err(file.wrong())?;
    let order = Order::of(part.file.stations.len(), listed);
    let many = || first(format!("there are more than {MOST_ROWS} rows: retain fewer"));
    let order = order.ok_or_else(many).map_err(file.wrong())?;
    let (mut matrices, mut arguments) = (Vec::new(), String::new());
    for (found, rows) in found.iter().zip(&rows) {
        let word = found.role.word;
        let (factor, length) = (part.scales.of_matrix(found.role), part.scales.length);
        let whole = order.assembled(&found.matrix, rows, factor, length);
        let large = || first(format!("the {word} is too large in SI: look at the units"));
        let whole = whole.ok_or_else(large).map_err(found.file.wrong())?;
        let beside = format!("{stem}_{word}.mtx");
        arguments += &format!("{word}: \"{beside}\", ");
        notes.extend(rounded(found));
        matrices.push((beside, write(&whole)));
    }
    let declaration = part.declaration(mechanism, &arguments);
    check(file, &part.file, &declaration, &matrices)?;
    Ok(Superelement { declaration, matrices, notes, read: files.read })
}

/// What the digits of a stiffness leave of motions that nothing should resist.
fn rounded(found: &Found) -> Option<String> {
    let part = rounding(&found.matrix.entries);
    let is_coarse = found.role == STIFFNESS && part > COARSE;
    is_coarse.then(|| {
        let (digits, percent) = (digits(&found.matrix.entries), 100.0 * part);
        format!(
            "the stiffness has {digits} digits: motions as a rigid body may be resisted by {percent:.1e} % of its terms"
        )
    })
}

/// Whether what is written can be read: what is wrong is in a matrix that the description names.
fn check(file: &Declaration, part: &File<'_>, declaration: &str, matrices: &[(String, String)]) -> Result<(), Failure> {
    let files: String = matrices.iter().map(|(name, text)| format!("file {name:?} {text:?};\n")).collect();
    let of = |mistake: &eigentol_compiler::Mistake| {
        let line = declaration.lines().nth(mistake.line - 1).unwrap_or_default();
        let rest: String = line.chars().skip(mistake.column).collect();
        let is_at = |name: &str| rest.split('"').next() == Some(name);
        let sources = [Some(&part.mass), Some(&part.stiffness), part.damping.as_ref()];
        let source = matrices.iter().position(|(name, _)| is_at(name)).and_then(|k| sources[k]);
        let message = mistake.message.clone();
        let placed = match source.and_then(|source| source.file.or(source.matrix_market)) {
            Some(at) => at.mistake(&file.text, message),
            None => first(message),
        };
        mistake::Mistake { help: mistake.help.clone(), ..placed.into() }
    };
    match early_stages_of_text(&format!("{declaration}{files}")) {
        Ok(_) => Ok(()),
        Err(mistakes) => Err(file.refused(mistakes.iter().map(of).collect())),
    }
}

impl Declaration {
    /// The failure that a mistake in this file is.
    fn wrong(&self) -> impl Fn(Mistake) -> Failure {
        |mistake| self.refused(vec![mistake.into()])
    }
}
