//! What derivatives say, per declared unit of each variable.

use eigentol_results::columns::Columns;
use eigentol_results::numbers::{frequency_symbol, in_unit, with_unit};
use eigentol_results::{Answer, Findings, at_point, displayed};

use super::derivatives::{Derived, Variable, data, say, variables};
use super::{EquilibriumShift, ModeSensitivity, OutputSensitivities, Quantity, Sensitivities};
use crate::modes::{Behaviour, Family, undamped};

displayed!(Sensitivities, EquilibriumShift, OutputSensitivities);

/// `sensitivities`: a row for each mode and variable, the derivatives of all quantities per `unit` of the variable.
impl Answer for Sensitivities {
    const KIND: &'static str = "sensitivities";

    at_point!();

    fn findings(&self) -> Findings {
        let method = self.method;
        let mut said = self.titled(format_args!("sensitivities of the frequencies, {method}"));
        let variables = variables(&self.description, &self.inputs);
        self.data(&mut said, &variables);
        let behaviours: Vec<Behaviour> = self.modes.iter().map(ModeSensitivity::behaviour).collect();
        let (resolved, left_out) = Behaviour::resolved(&behaviours, &self.description);
        say(&mut said, &variables, &self.shown(&resolved));
        said.note_if_any(left_out);
        self.free(&mut said);
        undamped(&mut said, self.family, &self.description);
        self.clusters(&mut said);
        said
    }
}

impl Sensitivities {
    fn data(&self, said: &mut Findings, variables: &[Variable<'_>]) {
        let mut rows = Vec::new();
        for (r, mode) in self.modes.iter().enumerate() {
            let slopes = Quantity::ALL.map(|of| if mode.clustered { Vec::new() } else { slopes(mode, of) });
            let values_of = |j| slopes.each_ref().map(|slopes| slopes.get(j).copied());
            rows.extend(variables.iter().enumerate().map(|(j, variable)| (r, variable, values_of(j))));
        }
        let mut table = Columns::new("sensitivities", &rows);
        table.whole("mode", &|row| Some(row.0 + 1));
        table.words("by", &|row| Some(row.1.name.to_string()));
        table.words("unit", &|row| Some(row.1.unit.symbol.to_string()));
        for (k, quantity) in Quantity::ALL.into_iter().enumerate() {
            let unit = format!("{} per unit", quantity.unit().symbol);
            table.number(&quantity.to_string(), unit.trim_start(), &|row| Some(row.2[k]? * row.1.unit.scale));
        }
        said.columns(table);
    }

    /// The quantities in the text: one of each mode that is not free, then damping ratios.
    fn shown(&self, resolved: &[usize]) -> Vec<Derived> {
        let moving = resolved.iter().map(|&k| (k, &self.modes[k]));
        let moving = moving.filter(|(_, mode)| !mode.is_free());
        let frequency = &self.description.frequency;
        let derived = |(r, of, mode): (usize, Quantity, &ModeSensitivity)| Derived {
            name: match of {
                Quantity::Growth => format!("growth{}", r + 1),
                Quantity::DampingRatio => format!("damping ratio {}", r + 1),
                _ => format!("{}{}", frequency_symbol(frequency), r + 1),
            },
            unit: if of == Quantity::Frequency { frequency.clone() } else { of.unit() },
            clustered: mode.clustered,
            slopes: slopes(mode, of),
        };
        let mut shown: Vec<Derived> = moving.clone().map(|(r, mode)| (r, first(mode), mode)).map(derived).collect();
        if self.family == Family::General {
            let oscillating = moving.filter(|(_, mode)| first(mode) == Quantity::Frequency);
            shown.extend(oscillating.map(|(r, mode)| (r, Quantity::DampingRatio, mode)).map(derived));
        }
        shown
    }

    fn free(&self, said: &mut Findings) {
        let free = self.modes.iter().enumerate();
        let free = free.filter(|(_, mode)| mode.is_free());
        let numbers: Vec<String> = free.map(|(r, _)| (r + 1).to_string()).collect();
        let says = "free: zero at every design, without derivatives";
        match &numbers[..] {
            [] => {}
            [one] => said.note(format!("Mode {one} is {says}.")),
            [others @ .., last] => said.note(format!("Modes {} and {last} are {says}.", others.join(", "))),
        }
    }

    fn clusters(&self, said: &mut Findings) {
        for (r, mode) in self.modes.iter().enumerate() {
            if mode.clustered {
                said.note(format!(
                    "Mode {} has nearly equal neighbours: a derivative of its own does not exist. The modes of a cluster have \
                     derivatives only together, along one direction of change; those of a defective eigenvalue have none.",
                    r + 1
                ));
            }
        }
    }
}

/// The quantity of a mode that comes first: a mode that does not oscillate has only a rate, a free one not even that.
fn first(mode: &ModeSensitivity) -> Quantity {
    let oscillates = mode.oscillates() || mode.clustered;
    if !oscillates && mode.of(Quantity::Growth).is_some() { Quantity::Growth } else { Quantity::Frequency }
}

/// Derivatives of a quantity by inputs and design variables; empty if it has none.
fn slopes(mode: &ModeSensitivity, of: Quantity) -> Vec<f64> {
    let slopes = mode.of(of);
    slopes.map_or_else(Vec::new, |slopes| [&slopes.by_input[..], &slopes.by_design].concat())
}

/// `equilibrium shift`: a row for each unknown and variable.
impl Answer for EquilibriumShift {
    const KIND: &'static str = "equilibrium shift";

    at_point!();

    fn findings(&self) -> Findings {
        let d = &self.description;
        let mut said = self.titled("shift of the equilibrium");
        let all = d.coordinates.iter().enumerate().map(|(i, info)| Derived {
            name: info.name.to_string(),
            unit: info.unit.clone(),
            clustered: false,
            slopes: [&self.by_input[i], &self.by_design[i]].concat(),
        });
        let (all, variables) = (all.collect::<Vec<_>>(), variables(d, &self.inputs));
        say(&mut said, &variables, &all);
        said.data(data("equilibrium shift", "unknown", &variables, &all));
        said
    }
}

/// `outputs`: one row, a column for each output; `output sensitivities`: a row for each output and variable.
impl Answer for OutputSensitivities {
    const KIND: &'static str = "output sensitivities";

    at_point!();

    fn findings(&self) -> Findings {
        let d = &self.description;
        let mut said = self.titled("outputs");
        let rows = [&self.values[..]];
        let mut table = Columns::new("outputs", &rows);
        for (o, info) in d.outputs.iter().enumerate() {
            table.measured(&info.name, &info.unit, &|values| values.get(o).copied());
        }
        said.columns(table);
        for (info, &value) in d.outputs.iter().zip(&self.values) {
            let value = with_unit(in_unit(value, &info.unit), &info.unit);
            said.note(format!("{} = {value}", info.name));
        }
        let all = d.outputs.iter().enumerate().map(|(o, info)| Derived {
            name: info.name.to_string(),
            unit: info.unit.clone(),
            clustered: false,
            slopes: self.slopes(o),
        });
        let (all, variables) = (all.collect::<Vec<_>>(), variables(d, &self.inputs));
        say(&mut said, &variables, &all);
        said.data(data("output sensitivities", "output", &variables, &all));
        said
    }
}

impl OutputSensitivities {
    /// Derivatives of output `o` by inputs and design variables; empty if it has none.
    fn slopes(&self, o: usize) -> Vec<f64> {
        match (self.by_input.get(o), self.by_design.get(o)) {
            (Some(Some(inputs)), Some(Some(design))) => [&inputs[..], design].concat(),
            _ => Vec::new(),
        }
    }
}
