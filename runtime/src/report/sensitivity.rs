//! Derivatives as text, per declared unit of each variable.

use core::fmt;

use super::table::{Table, cells, heading, number, of_mode, per, undamped};
use super::title::title;
use crate::Sensitivities;
use crate::modes::Family;
use crate::sensitivity::{EquilibriumShift, Method, OutputSensitivities, Quantity};
use crate::{Description, Text, Unit};

/// Names and units of all variables, inputs first.
fn variables(d: &Description) -> impl Iterator<Item = (&Text, &Unit)> {
    let inputs = d.inputs.iter().map(|info| (&info.name, &info.unit));
    inputs.chain(d.design.iter().map(|info| (&info.name, &info.unit)))
}

/// A table of derivatives: one row for each variable, in its declared unit.
fn derivatives(
    d: &Description,
    columns: Vec<String>,
    value: impl Fn(usize, usize) -> Option<f64>,
    clustered: impl Fn(usize) -> bool,
) -> Table {
    let mut head = cells(["derivative by"]);
    let count = columns.len();
    head.extend(columns);
    let mut table = Table::new(head);
    for (j, (name, unit)) in variables(d).enumerate() {
        let mut row = vec![per(name, unit)];
        row.extend((0..count).map(|column| {
            let value = value(column, j).map(|value| value * unit.scale);
            of_mode(value, clustered(column))
        }));
        table.row(row);
    }
    table
}

/// Element `j` of inputs followed by design variables.
fn pick(inputs: &[f64], design: &[f64], j: usize) -> Option<f64> {
    inputs
        .get(j)
        .or_else(|| design.get(j.checked_sub(inputs.len())?))
        .copied()
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Frequency => "frequency",
            Self::NaturalFrequency => "natural frequency",
            Self::DampingRatio => "damping ratio",
            Self::Growth => "growth",
        })
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}",
            match self {
                Self::Adjoint => "exact (adjoint)",
                Self::Explicit => "exact (explicit partials)",
                Self::FrozenEquilibrium => "equilibrium frozen: NOT the true derivatives",
                Self::FiniteDifference => "central differences",
            }
        )
    }
}

impl fmt::Display for Sensitivities {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{}: sensitivities of the frequencies, {}",
            title(&self.description, &self.inputs),
            self.method
        )?;
        let numbers = 1..=self.modes.len();
        let mut columns: Vec<String> = numbers
            .clone()
            .map(|r| format!("omega{r} [rad/s]"))
            .collect();
        if self.family == Family::General {
            columns.extend(numbers.map(|r| format!("damping ratio {r}")));
        }
        let count = self.modes.len();
        let mode = |column: usize| &self.modes[column % count.max(1)];
        let value = |column: usize, j| {
            let quantity = match column < count {
                true => Quantity::Frequency,
                false => Quantity::DampingRatio,
            };
            let slopes = mode(column).of(quantity)?;
            pick(&slopes.by_input, &slopes.by_design, j)
        };
        let clustered = |column| mode(column).clustered;
        let table = derivatives(&self.description, columns, value, clustered);
        write!(f, "{table}")?;
        undamped(f, self.family, &self.description)?;
        for (r, mode) in self.modes.iter().enumerate() {
            if mode.clustered {
                writeln!(
                    f,
                    "  Mode {} has nearly equal neighbours: a derivative of its own does not exist. `directional_derivatives` has \
                     those of the cluster.",
                    r + 1
                )?;
            }
        }
        Ok(())
    }
}

impl fmt::Display for EquilibriumShift {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        writeln!(f, "{}: shift of the equilibrium", title(d, &self.inputs))?;
        let columns = d
            .coordinates
            .iter()
            .map(|info| heading(&info.name, &info.unit))
            .collect();
        let value = |i: usize, j| {
            let scale = d.coordinates.get(i)?.unit.scale;
            Some(pick(&self.by_input[i], &self.by_design[i], j)? / scale)
        };
        let table = derivatives(d, columns, value, |_| false);
        write!(f, "{table}")
    }
}

impl fmt::Display for OutputSensitivities {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        writeln!(f, "{}: outputs", title(d, &self.inputs))?;
        for (info, &value) in d.outputs.iter().zip(&self.values) {
            let value = number(value / info.unit.scale);
            writeln!(f, "  {} = {value} {}", info.name, info.unit.symbol)?;
        }
        let columns = d
            .outputs
            .iter()
            .map(|info| heading(&info.name, &info.unit))
            .collect();
        let value = |o: usize, j| {
            let unit = &d.outputs.get(o)?.unit;
            let (inputs, design) = (
                self.by_input.get(o)?.as_ref()?,
                self.by_design.get(o)?.as_ref()?,
            );
            Some(pick(inputs, design, j)? / unit.scale)
        };
        let table = derivatives(d, columns, value, |_| false);
        write!(f, "{table}")
    }
}
