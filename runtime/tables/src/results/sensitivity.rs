use eigentol::sensitivity::{EquilibriumShift, OutputSensitivities};
use eigentol::{Quantity, Sensitivities};

use super::Tables;
use super::names::{both, by, in_unit, operating_point, per_unit, variables};
use crate::Table;

const QUANTITIES: [Quantity; 4] = [
    Quantity::Frequency,
    Quantity::NaturalFrequency,
    Quantity::DampingRatio,
    Quantity::Growth,
];

/// `sensitivities`: a row for each mode and variable, the derivatives of all quantities per `unit` of the variable.
impl Tables for Sensitivities {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let all: Vec<_> = variables(d).collect();
        let rows = || (0..self.modes.len()).flat_map(|r| all.iter().map(move |own| (r, own)));
        let mut table = Table::new("sensitivities");
        table.whole("mode", rows().map(|(r, _)| r + 1));
        table.texts("by", rows().map(|(_, (name, _))| Some(name.to_string())));
        table.texts("unit", rows().map(|(_, (_, unit))| by(unit)));
        for quantity in QUANTITIES {
            let slopes = self.modes.iter().flat_map(|mode| {
                let slopes = mode.of(quantity).filter(|_| !mode.clustered);
                let slopes = slopes.map(|own| both(&own.by_input, &own.by_design).collect());
                let slopes: Vec<f64> = slopes.unwrap_or_default();
                let each = all.iter().enumerate();
                each.map(move |(j, (_, unit))| Some(per_unit(*slopes.get(j)?, unit)))
                    .collect::<Vec<_>>()
            });
            let unit = format!("{} per unit", quantity.unit().symbol);
            table.numbers(quantity.to_string(), unit.trim_start(), slopes);
        }
        operating_point(&mut table, d, &self.inputs, None);
        vec![table]
    }
}

/// `equilibrium shift`: a row for each unknown and variable, the derivative in `unit` of the unknown per `per` of the
/// variable.
impl Tables for EquilibriumShift {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let all: Vec<_> = variables(d).collect();
        let infos = || d.coordinates.iter().enumerate();
        let rows = || infos().flat_map(|(i, info)| all.iter().map(move |own| (i, info, own)));
        let mut table = Table::new("equilibrium shift");
        let names = rows().map(|(_, info, _)| Some(info.name.to_string()));
        table.texts("unknown", names);
        table.texts("unit", rows().map(|(_, info, _)| by(&info.unit)));
        table.texts("by", rows().map(|(_, _, (name, _))| Some(name.to_string())));
        table.texts("per", rows().map(|(_, _, (_, unit))| by(unit)));
        let slopes = infos().flat_map(|(i, info)| {
            let inputs = self.by_input.iter().nth(i).unwrap_or_default();
            let design = self.by_design.iter().nth(i).unwrap_or_default();
            let slopes = both(inputs, design).zip(&all);
            slopes.map(|(slope, (_, unit))| in_unit(per_unit(slope, unit), &info.unit))
        });
        table.numbers("derivative", "", slopes);
        operating_point(&mut table, d, &self.inputs, None);
        vec![table]
    }
}

/// `outputs`: one row, a column for each output; `output sensitivities`: a row for each output and variable, the
/// derivative in `unit` of the output per `per` of the variable.
impl Tables for OutputSensitivities {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let mut values = Table::new("outputs");
        for (info, &value) in d.outputs.iter().zip(&self.values) {
            let value = in_unit(value, &info.unit);
            values.numbers(&*info.name, &info.unit.symbol, [value]);
        }
        operating_point(&mut values, d, &self.inputs, None);
        let all: Vec<_> = variables(d).collect();
        let infos = || d.outputs.iter().enumerate();
        let rows = || infos().flat_map(|(o, info)| all.iter().map(move |own| (o, info, own)));
        let mut table = Table::new("output sensitivities");
        let names = rows().map(|(_, info, _)| Some(info.name.to_string()));
        table.texts("output", names);
        table.texts("unit", rows().map(|(_, info, _)| by(&info.unit)));
        table.texts("by", rows().map(|(_, _, (name, _))| Some(name.to_string())));
        table.texts("per", rows().map(|(_, _, (_, unit))| by(unit)));
        let slopes = infos().flat_map(|(o, info)| {
            let slopes = match (self.by_input.get(o), self.by_design.get(o)) {
                (Some(Some(inputs)), Some(Some(design))) => both(inputs, design).collect(),
                _ => Vec::new(),
            };
            let each = all.iter().enumerate();
            each.map(move |(j, (_, unit))| {
                Some(in_unit(per_unit(*slopes.get(j)?, unit), &info.unit))
            })
            .collect::<Vec<_>>()
        });
        table.numbers("derivative", "", slopes);
        operating_point(&mut table, d, &self.inputs, None);
        vec![values, table]
    }
}
