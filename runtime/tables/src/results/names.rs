//! Names, units and operating points as columns of tables.

use eigentol::{Behaviour, Description, Input, Text, Unit};

use crate::Table;

/// Converts an SI value to the declared unit.
pub(super) fn in_unit(value: f64, unit: &Unit) -> f64 {
    if unit.scale == 0.0 {
        value
    } else {
        unit.from_si(value)
    }
}

/// A user-chosen value as the user wrote it: 3000 rpm, not 3000.0000000000005. Rounded to 15 digits if these give the
/// same SI value.
pub(crate) fn as_written(value: f64, unit: &Unit) -> f64 {
    let own = in_unit(value, unit);
    let short = format!("{own:.14e}").parse().unwrap_or(own);
    if unit.to_si(short) == value {
        short
    } else {
        own
    }
}

/// Converts a derivative with respect to an SI value to one with respect to the declared unit.
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
            let value = as_written(value, &info.unit);
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
        let values = values.map(|value| as_written(value, &info.unit));
        table.numbers(&*info.name, &info.unit.symbol, values);
    }
}

/// One column for each unknown, for states that may be missing.
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

/// The symbol of a unit as a cell.
pub(super) fn by(unit: &Unit) -> Option<String> {
    Some(unit.symbol.to_string())
}

pub(super) fn behaviour(behaviour: Behaviour) -> Option<String> {
    word(match behaviour {
        Behaviour::Oscillating(_) => "oscillating",
        Behaviour::Damped(_) => "damped",
        Behaviour::Flutter(_) => "flutter",
        Behaviour::Decaying(_) => "decaying",
        Behaviour::Free => "free",
        Behaviour::Neutral => "neutral",
        Behaviour::Divergent(_) => "divergent",
    })
}

#[cfg(test)]
mod tests {
    use eigentol::{Text, Unit};

    use super::as_written;

    #[test]
    fn chosen_values_come_back_as_they_were_written() {
        let unit = |scale: f64| Unit {
            symbol: Text::Static("a unit"),
            scale,
        };
        let rpm = unit(core::f64::consts::PI / 30.0);
        let mut rough = 0;
        for speed in 0..=20_000 {
            let speed = 0.5 * f64::from(speed);
            rough += usize::from(rpm.from_si(rpm.to_si(speed)) != speed);
            assert_eq!(as_written(rpm.to_si(speed), &rpm), speed);
        }
        assert!(rough > 0);
        for length in [0.1, 0.3, -2.7, 1e-3, 12.345] {
            let mm = unit(1e-3);
            assert_eq!(as_written(mm.to_si(length), &mm), length);
        }
    }

    #[test]
    fn what_nobody_wrote_keeps_its_digits() {
        let one = Unit {
            symbol: Text::Static("m"),
            scale: 1.0,
        };
        for value in [core::f64::consts::PI, 1.0 / 3.0, -0.1 - 0.2, 0.0] {
            assert_eq!(as_written(value, &one), value);
        }
    }
}
