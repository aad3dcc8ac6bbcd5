//! Serialisation: vectors as lists, matrices as lists of rows.

use eigentol_statistics::serial::Exact;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{Matrix, Vector};

impl<T: Exact> Serialize for Vector<T> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(self.iter().map(T::written))
    }
}

impl<'de, T: Exact + Copy + Default> Deserialize<'de> for Vector<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        Ok(Vec::<T::Written>::deserialize(from)?.into_iter().map(T::read).collect())
    }
}

/// A matrix without rows states how many columns it would have.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Rows<T> {
    Rows(Vec<Vec<T>>),
    None { rows: usize, columns: usize },
}

impl<T: Exact> Serialize for Matrix<T> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let (rows, columns) = (self.row_count(), self.column_count());
        if !to.is_human_readable() {
            let entries: Vec<_> = self.as_flattened().iter().map(T::written).collect();
            return (rows, columns, entries).serialize(to);
        }
        if rows == 0 && columns > 0 {
            return Rows::<T::Written>::None { rows, columns }.serialize(to);
        }
        to.collect_seq(self.iter().map(|row: &[T]| row.iter().map(T::written).collect::<Vec<_>>()))
    }
}

impl<'de, T: Exact + Copy + Default> Deserialize<'de> for Matrix<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let (rows, columns, entries) = if from.is_human_readable() {
            match Rows::<T::Written>::deserialize(from)? {
                Rows::None { rows: 0, columns } => (0, columns, Vec::new()),
                Rows::None { .. } => {
                    return Err(D::Error::custom("a matrix with rows is a list of them"));
                }
                Rows::Rows(all) => {
                    let columns = all.first().map_or(0, Vec::len);
                    if all.iter().any(|row| row.len() != columns) {
                        return Err(D::Error::custom("the rows of a matrix are not equally long"));
                    }
                    (all.len(), columns, all.into_iter().flatten().collect())
                }
            }
        } else {
            <(usize, usize, Vec<T::Written>)>::deserialize(from)?
        };
        if rows.checked_mul(columns) != Some(entries.len()) {
            return Err(D::Error::custom(format!(
                "a matrix of {rows} rows and {columns} columns has {} entries",
                entries.len()
            )));
        }
        let mut matrix = Self::zeros(rows, columns);
        matrix.as_flattened_mut().iter_mut().zip(entries).for_each(|(slot, entry)| *slot = T::read(entry));
        Ok(matrix)
    }
}
