//! What can be changed on a page.

use eigentol::{Role, Study, Unit};
use eigentol_compiler::syntax::ast::Ast;
use eigentol_interpreter::{Interpreted, declared_tolerances};
use serde::Serialize;

/// A value that a page can change.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Control {
    pub(crate) name: String,
    pub(crate) kind: Kind,
    /// As it is written in the language; empty for a pure number.
    pub(crate) unit: String,
    /// In that unit.
    pub(crate) value: f64,
    /// As it is written, without the sign; `None` where nothing can have one, empty where there is none.
    pub(crate) tolerance: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Kind {
    Input,
    Design,
    Start,
}

/// Inputs, design variables, starts.
pub(crate) fn controls(study: &Study<Interpreted>, of: &Ast, settings: &toml::Table) -> Vec<Control> {
    let d = study.description();
    let declared = declared_tolerances(of, d);
    let given = settings.get("tolerance").and_then(toml::Value::as_table);
    let tolerance = |name: &str| {
        let given = given.and_then(|given| given.get(name)?.as_str());
        let text = given.or_else(|| declared.get(name).map(|text| &**text)).unwrap_or_default();
        Some(text.trim_start_matches("+/-").trim().to_owned())
    };
    let control = |(kind, name, unit, value): (Kind, &str, &Unit, f64)| Control {
        name: name.to_owned(),
        kind,
        unit: unit.symbol.to_string(),
        value: in_unit(unit, value),
        tolerance: if kind == Kind::Start { None } else { tolerance(name) },
    };
    values(study).map(control).collect()
}

/// Kind, name, unit and value (SI) of inputs, design variables and starts.
pub(crate) fn values(study: &Study<Interpreted>) -> impl Iterator<Item = (Kind, &str, &Unit, f64)> {
    let d = study.description();
    let inputs = d.inputs.iter().zip(study.input_values());
    let inputs = inputs.map(|(info, &value)| (Kind::Input, &*info.name, &info.unit, value));
    let design = d.design.iter().zip(study.design_values());
    let design = design.map(|(info, &value)| (Kind::Design, &*info.name, &info.unit, value));
    let starts = d.coordinates.iter().zip(study.start_values());
    let starts = starts.filter(|(info, _)| matches!(info.role, Role::Position | Role::Speed));
    let starts = starts.map(|(info, &value)| (Kind::Start, &*info.name, &info.unit, value));
    inputs.chain(design).chain(starts)
}

/// A value (SI) in a unit, without what the conversion adds.
pub(crate) fn in_unit(unit: &Unit, value: f64) -> f64 {
    rounded(unit.from_si(value))
}

fn rounded(value: f64) -> f64 {
    format!("{value:.12e}").parse().unwrap_or(value)
}

/// The range of an input along which modes are followed unless the page says another: from rest to twice the value of the first
/// input that has one.
pub(crate) fn usual_sweep(study: &Study<Interpreted>) -> Option<String> {
    let mut all = study.description().inputs.iter().zip(study.input_values());
    let (info, value) = all.find(|(_, value)| **value != 0.0)?;
    let symbol = &info.unit.symbol;
    Some(format!("{}=0..{} {symbol}", info.name, in_unit(&info.unit, 2.0 * value)))
}

#[cfg(test)]
mod tests {
    use super::rounded;

    #[test]
    fn units_leave_no_digits_behind() {
        assert_eq!(rounded(0.1 + 0.2), 0.3);
        assert_eq!(rounded(-2.5e-9), -2.5e-9);
        assert_eq!(rounded(0.0), 0.0);
    }
}
