use eigentol_results::numbers::converted;
use eigentol_results::{Answer, Columns, Findings, Subject};

use crate::second_order::{EventCurvature, ModeCurvature, OutputCurvature, SecondDerivatives};
use crate::variables::{Variable, design_variables, entry, variables};
use crate::{Description, Shared, Unit};

/// `second derivatives`: a row for each pair of variables, derivatives of `lambda` and of the eigenvalue `s` per `unit`
/// of the first and `unit 2` of the second.
impl Answer for ModeCurvature {
    const KIND: &'static str = "second derivatives";

    fn subject(&self) -> Option<Subject<'_>> {
        Some(Subject::at(&self.description, &[]))
    }

    fn findings(&self) -> Findings {
        let d = &self.description;
        let number = self.mode + 1;
        let inputs = d.inputs.len();
        let pairs = pairs(&variables(d));
        let mut table = Columns::new("second derivatives", &pairs);
        table.whole("mode", &|_| Some(number));
        names(&mut table, &|pair| pair);
        table.number("lambda", "1/s^2 per units", &|pair| Some(pair.scaled(pair.of(&self.lambda, inputs)?)));
        let s = |pair: &Pair<'_>| pair.of(self.eigenvalue.as_ref()?, inputs);
        table.number("Re s", "1/s per units", &|pair| Some(pair.scaled(s(pair)?.re)));
        table.number("Im s", "1/s per units", &|pair| Some(pair.scaled(s(pair)?.im)));
        data(d, &format!("mode {number}"), table)
    }
}

/// `second derivatives`: a row for each pair of variables, the derivative of the output per `unit` of the first and
/// `unit 2` of the second.
impl Answer for OutputCurvature {
    const KIND: &'static str = "second derivatives of an output";

    fn subject(&self) -> Option<Subject<'_>> {
        Some(Subject::at(&self.description, &[]))
    }

    fn findings(&self) -> Findings {
        let d = &self.description;
        let pairs = pairs(&variables(d));
        let info = d.outputs.get(self.output.index());
        let info = info.map(|info| (&*info.name, &info.unit));
        derivatives(d, &pairs, info, &|pair| pair.of(&self.second, d.inputs.len()))
    }
}

/// `second derivatives`: a row for each pair of design variables, the derivative of the critical value per `unit` of
/// the first and `unit 2` of the second.
impl Answer for EventCurvature {
    const KIND: &'static str = "second derivatives of an event";

    fn subject(&self) -> Option<Subject<'_>> {
        Some(Subject::at(&self.description, &[]))
    }

    fn findings(&self) -> Findings {
        let d = &self.description;
        let pairs = pairs(&design_variables(d).collect::<Vec<_>>());
        let info = d.inputs.get(self.input.index());
        let info = info.map(|info| (&*info.name, &info.unit));
        derivatives(d, &pairs, info, &|pair| {
            let [i, j] = pair.places;
            entry(&self.second, i, j)
        })
    }
}

/// Two of some variables, and their places among them.
pub(crate) struct Pair<'a> {
    places: [usize; 2],
    variables: [Variable<'a>; 2],
}

pub(crate) fn pairs<'a>(all: &[Variable<'a>]) -> Vec<Pair<'a>> {
    let each = all.iter().copied().enumerate();
    let pair = |(i, first), (j, second)| Pair { places: [i, j], variables: [first, second] };
    each.clone().flat_map(|first| each.clone().map(move |second| pair(first, second))).collect()
}

impl Pair<'_> {
    /// The second derivative with respect to both, inputs first, SI.
    pub(crate) fn of<T: Copy>(&self, second_derivatives: &SecondDerivatives<T>, inputs: usize) -> Option<T> {
        let [i, j] = self.places;
        match (i.checked_sub(inputs), j.checked_sub(inputs)) {
            (None, None) => entry(&second_derivatives.by_input, i, j),
            (None, Some(j)) => entry(&second_derivatives.by_input_and_design, i, j),
            (Some(i), None) => entry(&second_derivatives.by_input_and_design, j, i),
            (Some(i), Some(j)) => entry(&second_derivatives.by_design, i, j),
        }
    }

    /// A second derivative per declared units.
    pub(crate) fn scaled(&self, value: f64) -> f64 {
        let [first, second] = self.variables;
        value * first.unit.scale * second.unit.scale
    }
}

/// The names and units of both variables.
pub(crate) fn names<'a, R>(table: &mut Columns<'_, R>, of: &dyn Fn(&R) -> &Pair<'a>) {
    for (k, title) in ["by", "and by"].into_iter().enumerate() {
        let variable = |row: &R| of(row).variables[k];
        table.words(title, &|row| Some(variable(row).name.to_string()));
        table.words("unit", &|row| Some(variable(row).unit.symbol.to_string()));
    }
}

/// The second derivatives of a quantity with this name and unit.
fn derivatives(
    d: &Shared<Description>,
    pairs: &[Pair<'_>],
    quantity: Option<(&str, &Unit)>,
    of: &dyn Fn(&Pair<'_>) -> Option<f64>,
) -> Findings {
    let mut table = Columns::new("second derivatives", pairs);
    names(&mut table, &|pair| pair);
    if let Some((name, unit)) = quantity {
        let units = format!("{} per units", unit.symbol);
        table.number(name, &units, &|pair| Some(converted(pair.scaled(of(pair)?), unit)));
    }
    data(d, quantity.map_or("?", |(name, _)| name), table)
}

fn data(d: &Shared<Description>, of: &str, table: Columns<'_, Pair<'_>>) -> Findings {
    let mut said = Subject::at(d, &[]).titled(format_args!("second derivatives of {of}"));
    said.columns(table);
    said
}
