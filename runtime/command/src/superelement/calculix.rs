//! Matrices that CalculiX stores with `*FREQUENCY, SOLVER=MATRIXSTORAGE`: `.sti` and `.mas`, one half each, with the node and the
//! direction of each row in `.dof` (CalculiX, `matrixstorage.c`).

use eigentol_compiler::matrix_market::{Mistake, Word, end, lines};

use super::abaqus;
use super::matrix::{Label, Matrix, direction};

/// The rows, one `node.direction` to a line.
pub(super) fn labels(text: &str) -> Result<Vec<Label>, Mistake> {
    let label = |word: Word<'_>| {
        let parts = word.text.split_once('.');
        let (node, toward) = parts.ok_or_else(|| word.mistake("a line has a node and a direction, as in `12.3`"))?;
        Ok((word.at(0, node).whole("node")?, direction(word.at(node.len() + 1, toward))?))
    };
    lines(text).flat_map(Word::words).map(label).collect()
}

pub(super) fn read(text: &str, labels: Vec<Label>) -> Result<Matrix, Mistake> {
    let matrix = abaqus::sparse(text)?;
    // The whole diagonal is always written.
    let diagonal = matrix.entries.iter().filter(|(row, column, _)| row == column).count();
    if diagonal != labels.len() || matrix.order != diagonal {
        let message =
            format!("the matrix ends after {diagonal} rows, the `.dof` file has {}: store both again", labels.len());
        return Err(end(text, message));
    }
    Ok(Matrix { labels: Some(labels), ..matrix })
}
