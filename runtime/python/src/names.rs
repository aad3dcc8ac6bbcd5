//! Names, and suggestions for unknown ones.

use eigentol::{Description, Text};
use eigentol_compiler::base::nearest::nearest;

/// ``; did you mean `speed`?``, or nothing if no name is near.
pub(crate) fn did_you_mean<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    match nearest(name, known) {
        Some(near) => format!("; did you mean `{near}`?"),
        None => String::new(),
    }
}

pub(crate) fn coordinates(description: &Description) -> Vec<&str> {
    let all = description.coordinates.iter();
    all.map(|info| text(&info.name)).collect()
}

pub(crate) fn inputs(description: &Description) -> Vec<&str> {
    let all = description.inputs.iter();
    all.map(|info| text(&info.name)).collect()
}

pub(crate) fn design(description: &Description) -> Vec<&str> {
    let all = description.design.iter();
    all.map(|info| text(&info.name)).collect()
}

pub(crate) fn outputs(description: &Description) -> Vec<&str> {
    let all = description.outputs.iter();
    all.map(|info| text(&info.name)).collect()
}

fn text(name: &Text) -> &str {
    name
}
