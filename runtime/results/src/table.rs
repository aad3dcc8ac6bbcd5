//! Named columns of equal length, each with a unit.

use eigentol_contract::{Description, Input};

use crate::numbers::as_written;

/// A table: columns of equal length.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Table {
    /// The subject of the table in one or two words: `modes`.
    pub name: String,
    /// The columns. No two have the same heading.
    pub columns: Vec<Column>,
}

/// One column of a table.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Column {
    /// The name of the column.
    pub name: String,
    /// The unit symbol as written in declarations; empty if the column has no unit.
    pub unit: String,
    /// One entry per row; `None` for a missing or non-finite value.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub values: Values,
}

/// The entries of a column.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "kind", content = "values", rename_all = "lowercase"))]
pub enum Values {
    /// Finite numbers.
    Numbers(Vec<Option<f64>>),
    /// Whole numbers.
    Whole(Vec<Option<i64>>),
    /// Words.
    Texts(Vec<Option<String>>),
    /// Yes or no.
    Flags(Vec<Option<bool>>),
}

impl Values {
    /// The number of entries, including missing ones.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Numbers(values) => values.len(),
            Self::Whole(values) => values.len(),
            Self::Texts(values) => values.len(),
            Self::Flags(values) => values.len(),
        }
    }

    /// Whether there are no entries.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Column {
    /// The heading: `name [unit]`, or the name alone if there is no unit.
    #[must_use]
    pub fn heading(&self) -> String {
        if self.unit.is_empty() { self.name.clone() } else { format!("{} [{}]", self.name, self.unit) }
    }
}

impl Table {
    /// Creates a table without columns.
    #[must_use]
    pub fn new(name: &str) -> Self {
        Self { name: name.to_owned(), columns: Vec::new() }
    }

    /// The first column with this name.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|column| column.name == name)
    }

    /// The number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |column| column.values.len())
    }

    /// Adds a column of numbers; non-finite values become missing.
    pub fn numbers<V: Into<Option<f64>>>(&mut self, name: &str, unit: &str, values: impl IntoIterator<Item = V>) {
        let finite = |value: V| value.into().filter(|value| value.is_finite());
        let values = values.into_iter().map(finite).collect();
        self.add(name, unit, Values::Numbers(values));
    }

    /// Adds a column of whole numbers.
    pub fn whole<V: Into<Option<usize>>>(&mut self, name: &str, values: impl IntoIterator<Item = V>) {
        let values = values.into_iter().map(|value: V| value.into().and_then(|x| i64::try_from(x).ok())).collect();
        self.add(name, "", Values::Whole(values));
    }

    /// Adds a column of words.
    pub fn texts<V: Into<Option<String>>>(&mut self, name: &str, values: impl IntoIterator<Item = V>) {
        let values = values.into_iter().map(Into::into).collect();
        self.add(name, "", Values::Texts(values));
    }

    /// Adds a column of yes/no values.
    pub fn flags<V: Into<Option<bool>>>(&mut self, name: &str, values: impl IntoIterator<Item = V>) {
        let values = values.into_iter().map(Into::into).collect();
        self.add(name, "", Values::Flags(values));
    }

    /// Adds a column. A name the table already has gets a number appended, `mode 2`.
    fn add(&mut self, name: &str, unit: &str, values: Values) {
        let taken = |name: &str| self.columns.iter().any(|column| column.name == name);
        let mut unique = name.to_owned();
        let mut number = 2;
        while taken(&unique) {
            unique = format!("{name} {number}");
            number += 1;
        }
        self.columns.push(Column { name: unique, unit: unit.to_owned(), values });
    }

    /// Adds the operating point as the last columns, without an input that varies.
    pub fn operating_point(&mut self, d: &Description, inputs: &[f64], varied: Option<Input>) {
        let rows = self.rows();
        let varied = varied.map(Input::index);
        for (k, (info, &value)) in d.inputs.iter().zip(inputs).enumerate() {
            if Some(k) != varied {
                let value = as_written(value, &info.unit);
                self.numbers(&info.name, &info.unit.symbol, vec![value; rows]);
            }
        }
    }
}
