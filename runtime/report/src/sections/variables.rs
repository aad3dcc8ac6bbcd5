//! Inputs and design variables with their values and tolerances.

use eigentol::Unit;
use eigentol::tolerance::Distribution;
use eigentol_tables::Table;

use crate::content::{Content, Setup};

/// An input or a design variable.
pub(super) struct Variable<'a> {
    pub(super) name: &'a str,
    pub(super) kind: &'static str,
    pub(super) unit: &'a Unit,
    /// SI.
    pub(super) value: f64,
    /// SI; zero if it does not vary.
    pub(super) half_width: f64,
    /// Mean minus value, SI.
    pub(super) shift: f64,
    pub(super) law: Option<&'a Distribution>,
}

/// Inputs first.
pub(super) fn variables(content: &Content) -> Vec<Variable<'_>> {
    let (d, setup) = (&content.description, &content.setup);
    let variable = |name, kind, unit, value, index: Option<usize>| {
        let of = |values: &[f64]| index.and_then(|place| values.get(place).copied());
        Variable {
            name,
            kind,
            unit,
            value,
            half_width: of(setup.tolerances.half_widths()).unwrap_or_default(),
            shift: of(setup.tolerances.shifts()).unwrap_or_default(),
            law: index.and_then(|place| setup.distributions.get(place)),
        }
    };
    let inputs = d.inputs.iter().zip(&setup.inputs).enumerate();
    let inputs =
        inputs.map(|(k, (info, &value))| variable(&*info.name, "input", &info.unit, value, setup.place_of_input(k)));
    let design = d.design.iter().zip(&setup.design).enumerate();
    let design = design.map(|(k, (info, &value))| variable(&*info.name, "design variable", &info.unit, value, Some(k)));
    inputs.chain(design).collect()
}

/// A row for each variable, in its own unit.
pub(super) fn table(all: &[Variable<'_>]) -> Table {
    let of = |pick: fn(&Variable<'_>, &Distribution) -> f64| -> Vec<Option<f64>> {
        let one = |variable: &Variable<'_>| Some(variable.unit.from_si(pick(variable, variable.law?)));
        all.iter().map(|x| one(x).filter(|value| *value != 0.0)).collect()
    };
    let mut table = Table::new("variables");
    table.texts("name", all.iter().map(|x| Some(x.name.to_owned())));
    table.texts("kind", all.iter().map(|x| Some(x.kind.to_owned())));
    table.numbers("value", "", all.iter().map(|x| x.unit.from_si(x.value)));
    table.numbers("half-width", "", of(|x, _| x.half_width));
    table.numbers("sigma", "", of(|_, law| law.sigma()));
    table.numbers("mean less value", "", of(|x, _| x.shift));
    let law = |variable: &Variable<'_>| variable.law.filter(|law| law.sigma() > 0.0).map(Distribution::name);
    table.texts("law", all.iter().map(|x| law(x).map(str::to_owned)));
    let symbols = all.iter().map(|x| Some(x.unit.symbol.to_string()));
    table.texts("unit", symbols);
    table
}

impl Setup {
    /// Index of an input's tolerance; those of inputs follow those of the design variables.
    fn place_of_input(&self, input: usize) -> Option<usize> {
        let index = self.deviating.iter().position(|x| *x == input)?;
        Some(self.design.len() + index)
    }
}
