//! Aligned columns of text.

use core::fmt;

use crate::modes::Family;
use crate::{DampingKind, Description, Quantity, Text, Unit};

/// A table: a head and rows of equal length; the first column is left-aligned, the others right.
pub(super) struct Table {
    rows: Vec<Vec<String>>,
}

impl Table {
    pub(super) fn new(head: Vec<String>) -> Self {
        Self { rows: vec![head] }
    }

    pub(super) fn row(&mut self, cells: Vec<String>) {
        self.rows.push(cells);
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let mut widths = vec![0; columns];
        for row in &self.rows {
            for (width, cell) in widths.iter_mut().zip(row) {
                *width = (*width).max(cell.chars().count());
            }
        }
        for row in &self.rows {
            let mut line = String::new();
            for (column, (cell, &width)) in row.iter().zip(&widths).enumerate() {
                if column == 0 {
                    line.push_str(&format!("  {cell:<width$}"));
                } else {
                    line.push_str(&format!("  {cell:>width$}"));
                }
            }
            writeln!(f, "{}", line.trim_end())?;
        }
        Ok(())
    }
}

/// A number with six significant digits, in scientific form where that is shorter to read.
pub(super) fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if !value.is_finite() {
        if value > 0.0 {
            "inf".to_owned()
        } else {
            format!("{value}")
        }
    } else if !(1e-3..1e6).contains(&size) {
        format!("{value:.5e}")
    } else {
        let before = size.log10().floor() as i32 + 1;
        let decimals = (6 - before).clamp(0, 8) as usize;
        format!("{value:.decimals$}")
    }
}

pub(super) fn optional(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), number)
}

/// What stands in place of a number that a member of a cluster of equal eigenvalues does not have.
pub(super) const CLUSTER: &str = "cluster";

/// As [`optional`], of a mode that may be a member of a cluster.
pub(super) fn of_mode(value: Option<f64>, clustered: bool) -> String {
    if clustered {
        CLUSTER.to_owned()
    } else {
        optional(value)
    }
}

/// A value converted from SI to a declared unit.
pub(super) fn in_unit(value: f64, unit: &Unit) -> String {
    number(if unit.scale == 0.0 {
        value
    } else {
        value / unit.scale
    })
}

/// The unit of a quantity of a mode.
pub(super) fn unit_of(quantity: Quantity) -> Unit {
    Unit {
        symbol: Text::Static(match quantity {
            Quantity::Frequency | Quantity::NaturalFrequency => "rad/s",
            Quantity::DampingRatio => "",
            Quantity::Growth => "1/s",
        }),
        scale: 1.0,
    }
}

/// `name [unit]`.
pub(super) fn heading(name: &str, unit: &Unit) -> String {
    if unit.symbol.is_empty() {
        name.to_owned()
    } else {
        format!("{name} [{}]", unit.symbol)
    }
}

/// `top per unit`, for derivatives.
pub(super) fn per(name: &str, unit: &Unit) -> String {
    if unit.symbol.is_empty() {
        format!("/ {name}")
    } else {
        format!("/ {name} [{}]", unit.symbol)
    }
}

pub(super) fn cells<const N: usize>(texts: [&str; N]) -> Vec<String> {
    texts.map(str::to_owned).to_vec()
}

/// Says of results that rest on undamped modes what they leave out.
pub(super) fn undamped(
    f: &mut fmt::Formatter<'_>,
    family: Family,
    description: &Description,
) -> fmt::Result {
    let what = match (family, description.damping) {
        (Family::General, _) | (_, DampingKind::Zero) => return Ok(()),
        (Family::Undamped, DampingKind::Gyroscopic) => "Gyroscopic forces (Chat)",
        (Family::Undamped, DampingKind::General) => "Damping and gyroscopic forces (Chat)",
    };
    writeln!(f, "  {what} of this mechanism are ignored: undamped modes.")
}
