use std::slice;

use eigentol_results::numbers::number;
use eigentol_results::{Answer, Columns, Findings, Listed, Subject, displayed};

use super::events::{meeting, meetings};
use crate::along::{critical_vectors, happening, name_of, together, varied};
use crate::sweep::{CriticalState, Crossing};

/// `critical states`: one row.
impl Answer for CriticalState {
    const KIND: &'static str = "critical state";

    fn subject(&self) -> Option<Subject<'_>> {
        let at = &self.equilibrium;
        Some(Subject::along(&at.description, &at.inputs, self.input))
    }

    fn findings(&self) -> Findings {
        let d = &self.equilibrium.description;
        let what = |place| format!("critical at {place}, {}", self.kind);
        let mut said = happening(&self.equilibrium, self.input, self.value, what);
        critical_vectors(&mut said, d, &self.v, &self.w);
        if let Some(table) = critical_columns(slice::from_ref(self)) {
            said.data(table.finish().0);
        }
        said
    }
}

/// `critical states`: a row for each.
impl Listed for CriticalState {
    const KIND: &'static str = "critical states";

    fn subject(&self) -> Option<Subject<'_>> {
        Answer::subject(self)
    }

    fn findings(all: &[Self]) -> Findings {
        together(all, critical_columns(all), "critical state")
    }
}

/// `crossings`: one row.
impl Answer for Crossing {
    const KIND: &'static str = "crossing";

    fn subject(&self) -> Option<Subject<'_>> {
        let at = &self.equilibrium;
        Some(Subject::along(&at.description, &at.inputs, self.input))
    }

    fn findings(&self) -> Findings {
        let what = |place| format!("{} at {place}", self.what_happens());
        let mut said = happening(&self.equilibrium, self.input, self.value, what);
        said.quote(self.modes.findings());
        if let Some(table) = crossing_columns(slice::from_ref(self)) {
            said.data(table.finish().0);
        }
        said
    }
}

/// `crossings`: a row for each frequency that equals `ratio` times the input plus `offset`, or for each flutter onset,
/// where both are empty.
impl Listed for Crossing {
    const KIND: &'static str = "crossings";

    fn subject(&self) -> Option<Subject<'_>> {
        Answer::subject(self)
    }

    fn findings(all: &[Self]) -> Findings {
        together(all, crossing_columns(all), "crossing")
    }
}

displayed!(CriticalState, Crossing);

impl Crossing {
    fn what_happens(&self) -> String {
        let name = name_of(&self.equilibrium.description, self.input);
        meeting(self.mode, self.condition, self.change, name)
    }
}

pub(super) fn critical_columns(all: &[CriticalState]) -> Option<Columns<'_, CriticalState>> {
    let one = all.first()?;
    let d = &one.equilibrium.description;
    let mut table = Columns::new("critical states", all);
    varied(&mut table, d, one.input, number, &|x| x.value);
    table.words("kind", &|row| Some(row.kind.to_string())).shown();
    table.unknowns(d, &|row| Some(&row.equilibrium.coordinates[..]));
    Some(table)
}

fn crossing_columns(all: &[Crossing]) -> Option<Columns<'_, Crossing>> {
    let one = all.first()?;
    let d = &one.equilibrium.description;
    let mut table = Columns::new("crossings", all);
    table.cells("what happens", &|row| row.what_happens());
    varied(&mut table, d, one.input, number, &|x| x.value);
    meetings(&mut table, &|x| Some((x.mode, x.condition)));
    let frequency = |crossing: &Crossing| crossing.modes.modes.get(crossing.mode)?.frequency();
    table.number("frequency", "rad/s", &frequency).digits_in(&d.frequency, number);
    table.unknowns(d, &|row| Some(&row.equilibrium.coordinates[..]));
    table.words("stability", &|row| Some(row.equilibrium.stability_word())).shown().headed("state");
    Some(table)
}
