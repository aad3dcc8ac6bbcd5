use eigentol::sweep::{Condition, CriticalState, Crossing, Event, EventTolerance};

use super::Tables;
use super::equilibrium::stability;
use super::modes::sense;
use super::names::{operating_point, unknowns, varied};
use crate::Table;

/// Adds the mode that meets each line: mode number, ratio, offset.
fn meetings(table: &mut Table, all: &[Option<(usize, Condition)>]) {
    let all = all.iter().copied();
    table.whole("mode", all.clone().map(|own| Some(own?.0 + 1)));
    let line = |own: Option<(usize, Condition)>| match own?.1 {
        Condition::Line(line) => Some(line),
        _ => None,
    };
    let lines = all.map(line);
    table.numbers("ratio", "", lines.clone().map(|line| Some(line?.ratio)));
    table.numbers("offset", "rad/s", lines.map(|line| Some(line?.offset)));
}

/// `critical states`: a row for each.
impl Tables for [CriticalState] {
    fn tables(&self) -> Vec<Table> {
        let Some(one) = self.first() else {
            return Vec::new();
        };
        let d = &one.equilibrium.description;
        let mut table = Table::new("critical states");
        varied(&mut table, d, one.input, self.iter().map(|own| own.value));
        table.texts("kind", self.iter().map(|own| Some(own.kind.to_string())));
        let states = self
            .iter()
            .map(|own| Some(&own.equilibrium.coordinates[..]));
        unknowns(&mut table, d, states);
        operating_point(&mut table, d, &one.equilibrium.inputs, Some(one.input));
        vec![table]
    }
}

/// Written as a list of one.
impl Tables for CriticalState {
    fn tables(&self) -> Vec<Table> {
        std::slice::from_ref(self).tables()
    }
}

/// `crossings`: a row for each frequency that equals `ratio` times the input plus `offset`, or for each flutter onset,
/// where both are empty.
impl Tables for [Crossing] {
    fn tables(&self) -> Vec<Table> {
        let Some(one) = self.first() else {
            return Vec::new();
        };
        let d = &one.equilibrium.description;
        let mut table = Table::new("crossings");
        varied(&mut table, d, one.input, self.iter().map(|own| own.value));
        let what: Vec<_> = self
            .iter()
            .map(|own| Some((own.mode, own.condition)))
            .collect();
        meetings(&mut table, &what);
        let frequency = self
            .iter()
            .map(|own| own.modes.modes.get(own.mode)?.frequency());
        table.numbers("frequency", "rad/s", frequency);
        let states = self
            .iter()
            .map(|own| Some(&own.equilibrium.coordinates[..]));
        unknowns(&mut table, d, states);
        table.texts(
            "stability",
            self.iter().map(|own| stability(&own.equilibrium)),
        );
        operating_point(&mut table, d, &one.equilibrium.inputs, Some(one.input));
        vec![table]
    }
}

/// Written as a list of one.
impl Tables for Crossing {
    fn tables(&self) -> Vec<Table> {
        std::slice::from_ref(self).tables()
    }
}

/// One row for each event along the input.
pub(super) fn events(name: &str, all: &[EventTolerance]) -> Vec<Table> {
    let Some(one) = all.first() else {
        return Vec::new();
    };
    let d = &one.description;
    let mut table = Table::new(name);
    let each = all.iter();
    varied(&mut table, d, one.input, each.clone().map(|own| own.value));
    let event = |own: &EventTolerance| match own.event {
        Event::Crossing {
            mode, condition, ..
        } => Some((mode, condition)),
        _ => None,
    };
    meetings(&mut table, &each.clone().map(event).collect::<Vec<_>>());
    let whirl = |own: &EventTolerance| match own.event {
        Event::Crossing { whirl, .. } => whirl.and_then(sense),
        _ => None,
    };
    table.texts("whirl", each.clone().map(whirl));
    if let Some(info) = d.inputs.get(one.input.index()) {
        let (unit, scale) = (&info.unit.symbol, info.unit.scale);
        let spreads = each.clone().map(|own| own.spread.as_ref().ok());
        let sigma = spreads.clone().map(|own| Some(own?.sigma / scale));
        table.numbers("sigma", unit, sigma);
        let band = spreads.clone().map(|own| Some(own?.band / scale));
        table.numbers("band", unit, band);
        for (k, variable) in d.design.iter().enumerate() {
            let share = spreads
                .clone()
                .map(|own| own?.variance_shares.get(k).copied());
            table.numbers(format!("variance share of {}", variable.name), "", share);
        }
    }
    table.numbers("sigma level", "", each.clone().map(|own| own.sigma_level));
    table.texts(
        "error",
        each.map(|own| Some(own.spread.as_ref().err()?.to_string())),
    );
    operating_point(&mut table, d, &one.inputs, Some(one.input));
    vec![table]
}

/// `events`: a row for each, with its place along the input and how far tolerances shift it.
impl Tables for [EventTolerance] {
    fn tables(&self) -> Vec<Table> {
        events("events", self)
    }
}

/// Written as a list of one.
impl Tables for EventTolerance {
    fn tables(&self) -> Vec<Table> {
        events("events", std::slice::from_ref(self))
    }
}
