//! The subject of a report: a mechanism at an operating point.

use crate::numbers::{given_in, with_unit};
use eigentol_contract::{Description, Input};

/// The title of a computation along one input: only the others have values.
pub fn title_along(description: &Description, inputs: &[f64], varied: Input) -> String {
    title(description, inputs, Some(varied))
}

/// `Rotor at speed = 3000 rpm, load = 2 N`, without the input that varies.
pub(crate) fn title(d: &Description, inputs: &[f64], varied: Option<Input>) -> String {
    let fixed = d.inputs.iter().zip(inputs).enumerate().filter(|(k, _)| Some(*k) != varied.map(Input::index));
    let values = fixed.map(|(_, (info, &value))| {
        let value = with_unit(given_in(value, &info.unit), &info.unit);
        format!("{} = {value}", info.name)
    });
    let values: Vec<String> = values.collect();
    if values.is_empty() { d.name.to_string() } else { format!("{} at {}", d.name, values.join(", ")) }
}
