//! A matrix as a file has it, before its rows are put in order.

use std::collections::{HashMap, HashSet};

use eigentol_compiler::matrix_market::{self, MOST_ROWS, Mistake, Word};

/// A node and a direction, 1 to 6, or 0 of what has none.
pub(super) type Label = (i64, u8);

/// Row, column, value.
pub(super) type Entry = (usize, usize, f64);

/// A square matrix, with what its rows are if the file says so.
pub(super) struct Matrix {
    pub(super) order: usize,
    pub(super) labels: Option<Vec<Label>>,
    pub(super) entries: Vec<Entry>,
}

impl Matrix {
    /// Refuses a matrix with two entries in one place: programs do not agree on what they mean.
    pub(super) fn once(self) -> Result<Self, Mistake> {
        let mut listed = HashSet::new();
        let Some((row, column, _)) = self.entries.iter().find(|(row, column, _)| !listed.insert((*row, *column)))
        else {
            return Ok(self);
        };
        let [row, column] = [*row, *column].map(|k| match self.labels.as_ref().and_then(|labels| labels.get(k)) {
            Some((node, direction)) => format!("direction {direction} of node {node}"),
            None => format!("row {}", k + 1),
        });
        Err(first(format!("the entry of {row} and {column} is listed twice")))
    }
}

impl From<matrix_market::Matrix> for Matrix {
    fn from(matrix: matrix_market::Matrix) -> Self {
        Self { order: matrix.rows, labels: None, entries: matrix.entries }
    }
}

pub(super) fn direction(word: Word<'_>) -> Result<u8, Mistake> {
    match word.whole("direction of a motion")? {
        number @ 0..=6 => Ok(number),
        number => Err(word.mistake(format!("a direction is 1 to 6, or 0 of what has none, not {number}"))),
    }
}

/// Rows by what they are, in the order of their first mention.
#[derive(Default)]
pub(super) struct Rows {
    known: HashMap<Label, usize>,
    labels: Vec<Label>,
}

impl Rows {
    /// The row of a motion whose node and direction are these words.
    pub(super) fn row(&mut self, node: Word<'_>, toward: Word<'_>) -> Result<usize, Mistake> {
        let label = (node.whole("node")?, direction(toward)?);
        let next = self.labels.len();
        let row = *self.known.entry(label).or_insert(next);
        if row == next {
            if next == MOST_ROWS {
                return Err(node.mistake(format!("a matrix has at most {MOST_ROWS} rows")));
            }
            self.labels.push(label);
        }
        Ok(row)
    }

    pub(super) fn matrix(self, entries: Vec<Entry>) -> Matrix {
        Matrix { order: self.labels.len(), labels: Some(self.labels), entries }
    }
}

/// Both halves of a symmetric matrix of which a file lists the lower, the upper, or both.
pub(super) fn completed(mut entries: Vec<Entry>) -> Vec<Entry> {
    let listed: HashSet<(usize, usize)> = entries.iter().map(|(row, column, _)| (*row, *column)).collect();
    if !listed.iter().any(|(row, column)| row != column && listed.contains(&(*column, *row))) {
        let across = entries.clone().into_iter().filter(|(row, column, _)| row != column);
        entries.extend(across.map(|(row, column, value)| (column, row, value)));
    }
    entries
}

/// What a matrix is for, and the first letters of the names that finite element programs give it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Role {
    pub(super) word: &'static str,
    letters: &'static str,
}

pub(super) const MASS: Role = Role { word: "mass", letters: "M" };
pub(super) const STIFFNESS: Role = Role { word: "stiffness", letters: "KS" };
pub(super) const DAMPING: Role = Role { word: "damping", letters: "BCDV" };

/// Which matrix of a file is wanted.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'a> {
    pub(super) role: Role,
    pub(super) name: Option<&'a str>,
}

/// A matrix of a file with several, or why it cannot be used.
pub(super) type Named = (String, Result<Matrix, Mistake>);

impl Wanted<'_> {
    /// The matrix of this name, or else the only one that may have this role.
    pub(super) fn among(self, all: Vec<Named>) -> Result<Matrix, Mistake> {
        let names: Vec<String> = all.iter().map(|(name, _)| name.to_ascii_uppercase()).collect();
        let fits = |name: &str| match self.name {
            Some(wanted) => name.eq_ignore_ascii_case(wanted),
            None => {
                let is_of = |role: Role| name.starts_with(|letter| role.letters.contains(letter));
                is_of(self.role) || names.len() == 1 && ![MASS, STIFFNESS, DAMPING].into_iter().any(is_of)
            }
        };
        let mut fitting = all.into_iter().filter(|(name, _)| fits(&name.to_ascii_uppercase()));
        if let (Some((_, matrix)), None) = (fitting.next(), fitting.next()) {
            return matrix;
        }
        let role = self.role.word;
        let wanted = self.name.map_or_else(|| format!("that must be the {role}"), |name| format!("`{name}`"));
        let has = if names.is_empty() { "none".to_owned() } else { format!("`{}`", names.join("`, `")) };
        Err(first(format!("there is not one matrix {wanted}, the file has {has}: give the `name` beside `file`")))
    }
}

/// A mistake of a whole file.
pub(super) fn first(message: impl Into<String>) -> Mistake {
    Mistake { line: 1, column: 1, message: message.into() }
}
