use eigentol::second_order::ModeCurvature;
use eigentol::shapes::ShapeSensitivity;
use eigentol::{Complex, Matrix};

use super::Tables;
use super::names::{by, per_unit, variables};
use crate::Table;

/// Entry of a matrix that a damaged file may have cut.
fn entry<T: Copy>(matrix: &Matrix<T>, i: usize, j: usize) -> Option<T> {
    matrix.iter().nth(i)?.get(j).copied()
}

/// `second derivatives`: a row for each pair of variables, derivatives of `lambda` and of the eigenvalue `s` per `unit` of the first and
/// `unit 2` of the second one.
impl Tables for ModeCurvature {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let all: Vec<_> = variables(d).collect();
        let inputs = d.inputs.len();
        let pairs = || (0..all.len()).flat_map(|i| (0..all.len()).map(move |j| (i, j)));
        let name = |k: usize| all.get(k).map(|(name, _)| name.to_string());
        let unit = |k: usize| all.get(k).and_then(|(_, unit)| by(unit));
        let scaled = |(i, j): (usize, usize), value: f64| {
            Some(per_unit(per_unit(value, all.get(i)?.1), all.get(j)?.1))
        };
        let mut table = Table::new("second derivatives");
        table.whole("mode", pairs().map(|_| self.mode + 1));
        table.texts("by", pairs().map(|(i, _)| name(i)));
        table.texts("unit", pairs().map(|(i, _)| unit(i)));
        table.texts("and by", pairs().map(|(_, j)| name(j)));
        table.texts("unit", pairs().map(|(_, j)| unit(j)));
        let lambda = pairs().map(|(i, j)| {
            let own = &self.lambda;
            let parts = (&own.by_input, &own.by_input_and_design, &own.by_design);
            scaled((i, j), element(parts, inputs, i, j)?)
        });
        table.numbers("lambda", "1/s^2 per units", lambda);
        for (title, part) in [
            ("Re s", (|s| s.re) as fn(Complex) -> f64),
            ("Im s", |s| s.im),
        ] {
            let value = pairs().map(|(i, j)| {
                let own = self.eigenvalue.as_ref()?;
                let parts = (&own.by_input, &own.by_input_and_design, &own.by_design);
                scaled((i, j), part(element(parts, inputs, i, j)?))
            });
            table.numbers(title, "1/s per units", value);
        }
        vec![table]
    }
}

/// The second derivative by variables `i` and `j`, inputs first.
fn element<T: Copy>(
    (by_input, mixed, by_design): (&Matrix<T>, &Matrix<T>, &Matrix<T>),
    inputs: usize,
    i: usize,
    j: usize,
) -> Option<T> {
    match (i.checked_sub(inputs), j.checked_sub(inputs)) {
        (None, None) => entry(by_input, i, j),
        (None, Some(j)) => entry(mixed, i, j),
        (Some(i), None) => entry(mixed, j, i),
        (Some(i), Some(j)) => entry(by_design, i, j),
    }
}

/// `shape sensitivities`: a row for each unknown and variable, derivatives of the components of the right and the left vector per `unit` of the variable.
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
                        None => entry(by_input, i, j),
                        Some(j) => entry(by_design, i, j),
                    };
                    Some(per_unit(of(slope?), unit))
                });
                table.numbers(format!("{part} {side}"), "per unit", value);
            }
        }
        vec![table]
    }
}
