//! Names, units and operating points, as reports have them.

use eigentol::response::Response;
use eigentol::{Behaviour, Description, Input, Quantity, Text, Unit};

use crate::Table;

/// A value in the declared unit.
pub(super) fn in_unit(value: f64, unit: &Unit) -> f64 {
    if unit.scale == 0.0 {
        value
    } else {
        unit.from_si(value)
    }
}

/// A derivative by an SI value as one by a value in the declared unit.
pub(super) fn per_unit(slope: f64, unit: &Unit) -> f64 {
    slope * unit.scale
}

/// The operating point as the last columns, without the input that varies.
pub(super) fn operating_point(
    table: &mut Table,
    d: &Description,
    inputs: &[f64],
    varied: Option<Input>,
) {
    let rows = table.rows();
    let varied = varied.map(Input::index);
    for (k, (info, &value)) in d.inputs.iter().zip(inputs).enumerate() {
        if Some(k) != varied {
            let value = in_unit(value, &info.unit);
            table.numbers(&*info.name, &info.unit.symbol, vec![value; rows]);
        }
    }
}

/// The varied input as a column.
pub(super) fn varied(
    table: &mut Table,
    d: &Description,
    input: Input,
    values: impl Iterator<Item = f64>,
) {
    if let Some(info) = d.inputs.get(input.index()) {
        let values = values.map(|value| in_unit(value, &info.unit));
        table.numbers(&*info.name, &info.unit.symbol, values);
    }
}

/// One column for each unknown, of states that may be missing.
pub(super) fn unknowns<'a>(
    table: &mut Table,
    d: &Description,
    states: impl Iterator<Item = Option<&'a [f64]>> + Clone,
) {
    for (i, info) in d.coordinates.iter().enumerate() {
        let value = |state: Option<&[f64]>| {
            let value = state?.get(i)?;
            Some(in_unit(*value, &info.unit))
        };
        table.numbers(&*info.name, &info.unit.symbol, states.clone().map(value));
    }
}

/// One column for each design variable.
pub(super) fn design<'a>(
    table: &mut Table,
    d: &Description,
    designs: impl Iterator<Item = &'a [f64]> + Clone,
) {
    for (k, info) in d.design.iter().enumerate() {
        let value = |design: &[f64]| Some(in_unit(*design.get(k)?, &info.unit));
        table.numbers(&*info.name, &info.unit.symbol, designs.clone().map(value));
    }
}

/// Names and units of all variables, inputs first.
pub(super) fn variables(d: &Description) -> impl Iterator<Item = (&Text, &Unit)> {
    let inputs = d.inputs.iter().map(|info| (&info.name, &info.unit));
    inputs.chain(d.design.iter().map(|info| (&info.name, &info.unit)))
}

/// Inputs followed by design variables.
pub(super) fn both<'a>(
    inputs: &'a [f64],
    design: &'a [f64],
) -> impl Iterator<Item = f64> + Clone + 'a {
    inputs.iter().chain(design).copied()
}

/// A word as a cell.
pub(super) fn word(text: &str) -> Option<String> {
    Some(text.to_owned())
}

/// What stands after a number that is a fraction of one, and of `value` per `unit`.
pub(super) fn by(unit: &Unit) -> Option<String> {
    Some(unit.symbol.to_string())
}

pub(super) fn behaviour(behaviour: Behaviour) -> Option<String> {
    word(match behaviour {
        Behaviour::Oscillating(_) => "oscillating",
        Behaviour::Damped(_) => "damped",
        Behaviour::Flutter(_) => "flutter",
        Behaviour::Decaying(_) => "decaying",
        Behaviour::Neutral => "neutral",
        Behaviour::Divergent(_) => "divergent",
    })
}

/// What a quantity of a mode is measured in.
pub(super) fn unit_of(quantity: Quantity) -> Unit {
    let symbol = match quantity {
        Quantity::Frequency | Quantity::NaturalFrequency => "rad/s",
        Quantity::Growth => "1/s",
        _ => "",
    };
    Unit {
        symbol: symbol.into(),
        scale: 1.0,
    }
}

/// What a response is called, and the unit of its values.
pub(super) fn response(response: &Response, d: &Description) -> (String, Unit) {
    let declared = |own: Option<(&Text, &Unit)>, what: &str| match own {
        Some((name, unit)) => (format!("{what}{name}"), unit.clone()),
        None => (what.to_owned(), unit_of(Quantity::DampingRatio)),
    };
    match response {
        Response::Mode { mode, quantity } => {
            (format!("{quantity} {}", mode + 1), unit_of(*quantity))
        }
        Response::Output(output) => {
            let info = d.outputs.get(output.index());
            declared(info.map(|info| (&info.name, &info.unit)), "")
        }
        Response::Critical(range) => {
            let info = d.inputs.get(range.input.index());
            declared(info.map(|info| (&info.name, &info.unit)), "critical ")
        }
        other => (format!("{other:?}"), unit_of(Quantity::DampingRatio)),
    }
}
