//! Derivatives as text, per declared unit of each variable.

use core::fmt;

use crate::Sensitivities;
use crate::modes::Family;
use crate::report::undamped;
use crate::sensitivity::{EquilibriumShift, Method, OutputSensitivities, Quantity};
use crate::{Description, Text, Unit};
use eigentol_results::numbers::{heading, number, of_mode, per, rough, with_unit};
use eigentol_results::relevance::{BELOW, largest, names, relevant, unless_rounding};
use eigentol_results::table::{Table, cells};
use eigentol_results::title::title;

/// Name, unit and value (SI) of each variable, inputs first.
fn variables<'a>(
    d: &'a Description,
    inputs: &'a [f64],
) -> impl Iterator<Item = (&'a Text, &'a Unit, f64)> {
    let of_inputs = d.inputs.iter().zip(inputs);
    let of_inputs = of_inputs.map(|(info, value)| (&info.name, &info.unit, *value));
    let design = d.design.iter();
    of_inputs.chain(design.map(|info| (&info.name, &info.unit, info.nominal)))
}

/// Derivatives by variable and quantity.
struct Derivatives<'a> {
    description: &'a Description,
    inputs: &'a [f64],
    /// Headings of the quantities.
    columns: Vec<String>,
}

impl Derivatives<'_> {
    /// Writes one row for each variable that matters, in its declared unit, and one column for each quantity that
    /// depends on any. A variable matters if the derivative times its value is among the large ones in a column; a
    /// variable whose value is zero cannot be judged.
    fn write(
        &self,
        f: &mut fmt::Formatter<'_>,
        value: impl Fn(usize, usize) -> Option<f64>,
        clustered: impl Fn(usize) -> bool,
    ) -> fmt::Result {
        let variables: Vec<_> = variables(self.description, self.inputs).collect();
        let effect = |column: usize, j: usize| {
            let size = variables[j].2.abs();
            value(column, j).map(|value| value * if size > 0.0 { size } else { 1.0 })
        };
        let every = 0..variables.len();
        let most = |column: usize| largest(every.clone().filter_map(|j| effect(column, j)));
        let most: Vec<f64> = (0..self.columns.len()).map(most).collect();
        let depends =
            |column: &usize| unless_rounding(most[*column], 0.0) != 0.0 || clustered(*column);
        let (columns, still): (Vec<usize>, Vec<usize>) = (0..self.columns.len()).partition(depends);
        let matters = |j: &usize| {
            let own = |column: &usize| match effect(*column, *j) {
                Some(own) if variables[*j].2 == 0.0 => unless_rounding(own, most[*column]) != 0.0,
                Some(own) => relevant(own, most[*column]),
                None => false,
            };
            columns
                .iter()
                .any(|column| clustered(*column) || own(column))
        };
        let (rows, left): (Vec<usize>, Vec<usize>) = every.partition(matters);
        let mut head = cells(["derivative by"]);
        head.extend(columns.iter().map(|&column| self.columns[column].clone()));
        let mut table = Table::new(head);
        for j in rows {
            let (name, unit, _) = variables[j];
            let mut row = vec![per(name, unit)];
            row.extend(columns.iter().map(|&column| {
                let own = effect(column, j).map(|own| unless_rounding(own, most[column]));
                let shown = value(column, j).filter(|_| own.is_some());
                let shown = shown.map(|value| if own == Some(0.0) { 0.0 } else { value });
                of_mode(
                    shown.map(|value| value * unit.scale),
                    clustered(column),
                    rough,
                )
            }));
            table.row(row);
        }
        if !table.is_empty() {
            write!(f, "{table}")?;
        }
        let exists = |column: &usize| variables.is_empty() || value(*column, 0).is_some();
        let (zero, none): (Vec<usize>, Vec<usize>) = still.into_iter().partition(exists);
        for (columns, what) in [(zero, "Zero"), (none, "No derivative")] {
            let all: Vec<&str> = (columns.iter())
                .map(|&column| self.columns[column].as_str())
                .collect();
            if !all.is_empty() {
                writeln!(f, "  {what}: {}.", names(&all, "columns"))?;
            }
        }
        if !left.is_empty() && !columns.is_empty() {
            let left: Vec<&str> = left.iter().map(|&j| &**variables[j].0).collect();
            let names = names(&left, "variables");
            writeln!(
                f,
                "  Left out, relative effect {BELOW} of the strongest: {names}."
            )?;
        }
        Ok(())
    }
}

/// Element `j` of the inputs followed by the design variables.
fn pick(inputs: &[f64], design: &[f64], j: usize) -> Option<f64> {
    inputs
        .get(j)
        .or_else(|| design.get(j.checked_sub(inputs.len())?))
        .copied()
}

impl Quantity {
    /// The unit of the quantity.
    #[must_use]
    pub fn unit(self) -> Unit {
        Unit {
            symbol: Text::Static(match self {
                Self::Frequency | Self::NaturalFrequency => "rad/s",
                Self::DampingRatio => "",
                Self::Growth => "1/s",
            }),
            scale: 1.0,
        }
    }
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
        // A mode that does not oscillate has only a rate, a free one not even that.
        let first = |r: usize| match &self.modes[r] {
            mode if mode.oscillates() || mode.clustered => Quantity::Frequency,
            mode if mode.of(Quantity::Growth).is_some() => Quantity::Growth,
            _ => Quantity::Frequency,
        };
        let (free, moving): (Vec<usize>, Vec<usize>) =
            (0..self.modes.len()).partition(|&r| self.modes[r].is_free());
        let mut shown: Vec<(usize, Quantity)> = moving.iter().map(|&r| (r, first(r))).collect();
        if self.family == Family::General {
            let oscillating = moving.iter().filter(|&&r| first(r) == Quantity::Frequency);
            shown.extend(oscillating.map(|&r| (r, Quantity::DampingRatio)));
        }
        let heading = |&(r, quantity): &(usize, Quantity)| match quantity {
            Quantity::Growth => format!("growth{} [1/s]", r + 1),
            Quantity::DampingRatio => format!("damping ratio {}", r + 1),
            _ => format!("omega{} [rad/s]", r + 1),
        };
        let columns: Vec<String> = shown.iter().map(heading).collect();
        let value = |column: usize, j| {
            let (r, quantity) = shown[column];
            let slopes = self.modes[r].of(quantity)?;
            pick(&slopes.by_input, &slopes.by_design, j)
        };
        let clustered = |column: usize| self.modes[shown[column].0].clustered;
        let table = Derivatives {
            description: &self.description,
            inputs: &self.inputs,
            columns,
        };
        table.write(f, value, clustered)?;
        let numbers: Vec<String> = free.iter().map(|r| (r + 1).to_string()).collect();
        let says = "free: zero at every design, without derivatives";
        match &numbers[..] {
            [] => {}
            [one] => writeln!(f, "  Mode {one} is {says}.")?,
            [others @ .., last] => {
                writeln!(f, "  Modes {} and {last} are {says}.", others.join(", "))?;
            }
        }
        undamped(f, self.family, &self.description)?;
        for (r, mode) in self.modes.iter().enumerate() {
            if mode.clustered {
                writeln!(
                    f,
                    "  Mode {} has nearly equal neighbours: a derivative of its own does not exist. The modes of a cluster have \
                     derivatives only together, along one direction of change; those of a defective eigenvalue have none.",
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
        let table = Derivatives {
            description: d,
            inputs: &self.inputs,
            columns,
        };
        table.write(f, value, |_| false)
    }
}

impl fmt::Display for OutputSensitivities {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        writeln!(f, "{}: outputs", title(d, &self.inputs))?;
        for (info, &value) in d.outputs.iter().zip(&self.values) {
            let value = with_unit(number(value / info.unit.scale), &info.unit);
            writeln!(f, "  {} = {value}", info.name)?;
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
        let table = Derivatives {
            description: d,
            inputs: &self.inputs,
            columns,
        };
        table.write(f, value, |_| false)
    }
}
