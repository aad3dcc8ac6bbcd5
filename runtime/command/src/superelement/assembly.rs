//! Matrices in SI with their rows in one order: six of each station, then the internal coordinates.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use eigentol_compiler::matrix_market::{self, ALL_DIGITS, MOST_ROWS, digits};

use super::matrix::{Label, Matrix};

/// What a row is.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Row {
    /// Six times the station and the direction.
    Station(usize),
    /// Node and direction, counted where they are the same.
    Internal(Label, usize),
}

/// What the rows of a matrix are.
pub(super) fn rows(labels: &[Label], stations: &HashMap<i64, usize>) -> Result<Vec<Row>, String> {
    let (mut seen, mut counts) = (HashSet::new(), HashMap::new());
    let one = |&(node, direction): &Label| {
        let row = match (stations.get(&node), direction) {
            (Some(station), 1..) => Row::Station(6 * station + usize::from(direction) - 1),
            _ => {
                let count = counts.entry((node, direction)).or_insert(0);
                *count += usize::from(direction == 0);
                Row::Internal((node, direction), *count)
            }
        };
        match direction {
            7.. => Err(format!("node {node} has no direction {direction}: they are 1 to 6, or 0 of what has none")),
            _ if !seen.insert(row) => Err(format!("direction {direction} of node {node} is listed twice")),
            _ => Ok(row),
        }
    };
    labels.iter().map(one).collect()
}

/// The rows of a matrix that are six of each station and then internal ones.
pub(super) fn in_order(order: usize, stations: usize) -> Vec<Row> {
    (0..order).map(|k| if k < 6 * stations { Row::Station(k) } else { Row::Internal((0, 0), k) }).collect()
}

/// The order of all rows.
pub(super) struct Order {
    stations: usize,
    internal: BTreeMap<Row, usize>,
}

impl Order {
    pub(super) fn of(stations: usize, all: impl IntoIterator<Item = Row>) -> Option<Self> {
        let internal: BTreeSet<Row> = all.into_iter().filter(|row| matches!(row, Row::Internal(..))).collect();
        let internal: BTreeMap<Row, usize> = internal.into_iter().zip(6 * stations..).collect();
        (6 * stations + internal.len() <= MOST_ROWS).then_some(Self { stations, internal })
    }

    fn at(&self, row: Row) -> usize {
        match row {
            Row::Station(row) => row,
            Row::Internal(..) => self.internal.get(&row).copied().unwrap_or_default(),
        }
    }

    /// The whole matrix, times a factor, and times a length for each turn; `None` if a number is too large.
    pub(super) fn assembled(
        &self,
        matrix: &Matrix,
        rows: &[Row],
        factor: f64,
        length: f64,
    ) -> Option<matrix_market::Matrix> {
        let places: Vec<(usize, f64)> = rows
            .iter()
            .map(|row| (self.at(*row), if matches!(row, Row::Station(row) if row % 6 > 2) { length } else { 1.0 }))
            .collect();
        let digits = digits(&matrix.entries);
        let entries = matrix.entries.iter().map(|(row, column, value)| {
            let ((row, turns), (column, turned)) = (places[*row], places[*column]);
            (row, column, to_digits(value * (factor * (turns * turned)), digits))
        });
        let mut entries: Vec<_> = entries.filter(|(_, _, value)| *value != 0.0).collect();
        entries.sort_by_key(|(row, column, _)| (*row, *column));
        let is_finite = entries.iter().all(|(_, _, value)| value.is_finite());
        is_finite.then(|| matrix_market::Matrix { rows: 6 * self.stations + self.internal.len(), entries })
    }
}

/// Rounded again after a change of units: how many digits a matrix has says how far its terms cancel.
fn to_digits(value: f64, digits: usize) -> f64 {
    if digits == ALL_DIGITS { value } else { format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value) }
}
