use eigentol::second_order::{EventCurvature, ModeCurvature, OutputCurvature, SecondDerivatives};
use eigentol::shapes::ShapeSensitivity;
use eigentol::{Complex, Matrix, Text, Unit};

use super::Tables;
use super::names::{by, in_unit, per_unit, variables};
use crate::Table;

/// Entry of a matrix, which a damaged file may have truncated.
fn entry<T: Copy>(matrix: &Matrix<T>, i: usize, j: usize) -> Option<T> {
    matrix.iter().nth(i)?.get(j).copied()
}

/// All pairs of some variables, one row each.
struct Pairs<'a>(Vec<(&'a Text, &'a Unit)>);

impl Pairs<'_> {
    fn iter(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let count = self.0.len();
        (0..count).flat_map(move |i| (0..count).map(move |j| (i, j)))
    }

    /// Adds the names and units of both variables.
    fn columns(&self, table: &mut Table) {
        for (title, which) in [
            ("by", (|(i, _)| i) as fn((usize, usize)) -> usize),
            ("and by", |(_, j)| j),
        ] {
            let own = |pair| self.0.get(which(pair));
            let name = |pair| own(pair).map(|(name, _)| name.to_string());
            table.texts(title, self.iter().map(name));
            let unit = |pair| own(pair).and_then(|(_, unit)| by(unit));
            table.texts("unit", self.iter().map(unit));
        }
    }

    /// Converts a second derivative to declared units.
    fn scaled(&self, (i, j): (usize, usize), value: f64) -> Option<f64> {
        let (by_first, by_second) = (self.0.get(i)?.1, self.0.get(j)?.1);
        Some(per_unit(per_unit(value, by_first), by_second))
    }
}

/// `second derivatives`: a row for each pair of variables, derivatives of `lambda` and of the eigenvalue `s` per `unit`
/// of the first and `unit 2` of the second.
impl Tables for ModeCurvature {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let pairs = Pairs(variables(d).collect());
        let inputs = d.inputs.len();
        let mut table = Table::new("second derivatives");
        table.whole("mode", pairs.iter().map(|_| self.mode + 1));
        pairs.columns(&mut table);
        let lambda = |pair| pairs.scaled(pair, element(&self.lambda, inputs, pair)?);
        table.numbers("lambda", "1/s^2 per units", pairs.iter().map(lambda));
        for (title, part) in [
            ("Re s", (|s| s.re) as fn(Complex) -> f64),
            ("Im s", |s| s.im),
        ] {
            let value = |pair| {
                let own = element(self.eigenvalue.as_ref()?, inputs, pair)?;
                pairs.scaled(pair, part(own))
            };
            table.numbers(title, "1/s per units", pairs.iter().map(value));
        }
        vec![table]
    }
}

/// `second derivatives`: a row for each pair of variables, the derivative of the output per `unit` of the first and
/// `unit 2` of the second.
impl Tables for OutputCurvature {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let pairs = Pairs(variables(d).collect());
        let mut table = Table::new("second derivatives");
        pairs.columns(&mut table);
        if let Some(info) = d.outputs.get(self.output.index()) {
            let value = |pair| {
                let own = element(&self.second, d.inputs.len(), pair)?;
                Some(in_unit(pairs.scaled(pair, own)?, &info.unit))
            };
            let unit = format!("{} per units", info.unit.symbol);
            table.numbers(&*info.name, &unit, pairs.iter().map(value));
        }
        vec![table]
    }
}

/// `second derivatives`: a row for each pair of design variables, the derivative of the critical value per `unit` of
/// the first and `unit 2` of the second.
impl Tables for EventCurvature {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let design = d.design.iter().map(|info| (&info.name, &info.unit));
        let pairs = Pairs(design.collect());
        let mut table = Table::new("second derivatives");
        pairs.columns(&mut table);
        if let Some(info) = d.inputs.get(self.input.index()) {
            let value = |(i, j)| {
                let own = entry(&self.second, i, j)?;
                Some(in_unit(pairs.scaled((i, j), own)?, &info.unit))
            };
            let unit = format!("{} per units", info.unit.symbol);
            table.numbers(&*info.name, &unit, pairs.iter().map(value));
        }
        vec![table]
    }
}

/// The second derivative with respect to two variables, inputs first.
fn element<T: Copy>(
    own: &SecondDerivatives<T>,
    inputs: usize,
    (i, j): (usize, usize),
) -> Option<T> {
    match (i.checked_sub(inputs), j.checked_sub(inputs)) {
        (None, None) => entry(&own.by_input, i, j),
        (None, Some(j)) => entry(&own.by_input_and_design, i, j),
        (Some(i), None) => entry(&own.by_input_and_design, j, i),
        (Some(i), Some(j)) => entry(&own.by_design, i, j),
    }
}

/// `shape sensitivities`: a row for each unknown and variable, derivatives of the right and left vector components per
/// `unit` of the variable.
impl Tables for ShapeSensitivity {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let all: Vec<_> = variables(d).collect();
        let inputs = d.inputs.len();
        let unknowns = d.coordinates.iter().enumerate();
        let rows = || {
            let each = unknowns.clone();
            each.flat_map(|(i, info)| {
                all.iter()
                    .enumerate()
                    .map(move |(j, own)| (i, info, j, own))
            })
        };
        let mut table = Table::new("shape sensitivities");
        table.texts(
            "unknown",
            rows().map(|(_, info, ..)| Some(info.name.to_string())),
        );
        table.texts("by", rows().map(|(.., (name, _))| Some(name.to_string())));
        table.texts("unit", rows().map(|(.., (_, unit))| by(unit)));
        for (side, by_input, by_design) in [
            ("shape", &self.right_by_input, &self.right_by_design),
            ("left", &self.left_by_input, &self.left_by_design),
        ] {
            for (part, of) in [
                ("Re", (|own| own.re) as fn(Complex) -> f64),
                ("Im", |own| own.im),
            ] {
                let value = rows().map(|(i, _, j, (_, unit))| {
                    let slope = match j.checked_sub(inputs) {
                        None => entry(by_input, j, i),
                        Some(j) => entry(by_design, j, i),
                    };
                    Some(per_unit(of(slope?), unit))
                });
                table.numbers(format!("{part} {side}"), "per unit", value);
            }
        }
        vec![table]
    }
}
