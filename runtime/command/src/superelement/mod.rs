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

use eigentol_compiler::matrix_market::{MOST_ROWS, Mistake, write};

use self::assembly::{Order, Row};
use self::files::Files;
use self::part::Part;

/// A declaration, and what belongs beside it.
pub(crate) struct Superelement {
    pub(crate) declaration: String,
    /// Names and texts of the files of its matrices.
    pub(crate) matrices: Vec<(String, String)>,
    pub(crate) notes: Vec<String>,
    /// The files that were read.
    pub(crate) read: Vec<PathBuf>,
}

/// A mistake in one of the files.
pub(crate) struct Wrong {
    pub(crate) name: String,
    pub(crate) text: String,
    pub(crate) mistake: Mistake,
}

/// Whether a text describes a superelement.
pub(crate) fn is_superelement(text: &str) -> bool {
    text.trim_start().starts_with('{') && text.contains("\"superelement\"")
}

/// Translates the superelement that a file of this name and text describes; its matrices are in `folder`, and the names of what
/// belongs beside the declaration begin with `stem`.
pub(crate) fn import(
    (name, text): (&str, &str),
    folder: &Path,
    stem: &str,
    mechanism: Option<&str>,
) -> Result<Superelement, Wrong> {
    let here = |mistake| Wrong { name: name.to_owned(), text: text.to_owned(), mistake };
    let part = Part::read(text).map_err(here)?;
    let mut files = Files::of((name, text), folder);
    let found = files.matrices(&part.file)?;
    let rows = part.rows(&found, here)?;
    let listed: HashSet<Row> = rows.iter().flatten().copied().collect();
    let notes = part.lacking(&listed).map_err(here)?;
    let order = Order::of(part.file.stations.len(), listed);
    let order = order.ok_or_else(|| here(first(format!("there are more than {MOST_ROWS} rows: retain fewer"))))?;
    let (mut matrices, mut arguments) = (Vec::new(), String::new());
    for (found, rows) in found.iter().zip(&rows) {
        let word = found.role.word;
        let (factor, length) = (part.scales.of_matrix(found.role), part.scales.length);
        let whole = order.assembled(&found.matrix, rows, factor, length);
        let whole = whole.ok_or_else(|| found.wrong(format!("the {word} is too large in SI: look at the units")))?;
        let file = format!("{stem}_{word}.mtx");
        arguments += &format!("{word}: \"{file}\", ");
        matrices.push((file, write(&whole)));
    }
    let declaration = part.declaration(mechanism, &arguments);
    Ok(Superelement { declaration, matrices, notes, read: files.read })
}

/// A mistake of a whole file.
fn first(message: impl Into<String>) -> Mistake {
    Mistake { line: 1, column: 1, message: message.into() }
}

/// A name that a declaration and a file can have.
pub(crate) fn identifier(text: &str) -> String {
    let plain: String = text.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if plain.starts_with(|c: char| c.is_ascii_alphabetic()) { plain } else { format!("part_{plain}") }
}
