use eigentol_results::{Answer, Columns, Findings, Subject};

use super::ShapeSensitivity;
use crate::algebra::Matrix;
use crate::variables::{Variable, entry, variables};
use crate::{Complex, Text};

/// `shape sensitivities`: a row for each unknown and variable, derivatives of the right and left vector components per
/// `unit` of the variable.
impl Answer for ShapeSensitivity {
    const KIND: &'static str = "shape sensitivities";

    fn subject(&self) -> Option<Subject<'_>> {
        Some(Subject::at(&self.description, &[]))
    }

    fn findings(&self) -> Findings {
        let d = &self.description;
        let mut said = self.titled("derivatives of a mode shape");
        let variables = variables(d);
        let mut rows = Vec::new();
        for (unknown, info) in d.coordinates.iter().enumerate() {
            rows.extend(variables.iter().enumerate().map(|(column, by)| Row {
                unknown,
                name: &info.name,
                place: column,
                by: *by,
            }));
        }
        let inputs = d.inputs.len();
        let mut table = Columns::new("shape sensitivities", &rows);
        table.words("unknown", &|row| Some(row.name.to_string()));
        table.words("by", &|row| Some(row.by.name.to_string()));
        table.words("unit", &|row| Some(row.by.unit.symbol.to_string()));
        for (side, slopes) in [
            ("shape", [&self.right_by_input, &self.right_by_design]),
            ("left", [&self.left_by_input, &self.left_by_design]),
        ] {
            table.number(&format!("Re {side}"), "per unit", &|row| {
                Some(row.slope(slopes, inputs)?.re * row.by.unit.scale)
            });
            table.number(&format!("Im {side}"), "per unit", &|row| {
                Some(row.slope(slopes, inputs)?.im * row.by.unit.scale)
            });
        }
        said.columns(table);
        said
    }
}

/// An unknown and a variable, with their places.
struct Row<'a> {
    unknown: usize,
    name: &'a Text,
    place: usize,
    by: Variable<'a>,
}

impl Row<'_> {
    /// The derivative per SI unit.
    fn slope(&self, [by_input, by_design]: [&Matrix<Complex>; 2], inputs: usize) -> Option<Complex> {
        match self.place.checked_sub(inputs) {
            None => entry(by_input, self.place, self.unknown),
            Some(column) => entry(by_design, column, self.unknown),
        }
    }
}
