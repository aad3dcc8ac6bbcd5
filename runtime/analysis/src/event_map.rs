//! How events along an input move with a design variable: critical speeds over the stiffness of bearings, limits of stability over
//! the level of what cross-couples.

use eigentol_results::numbers::{as_written, given, number, rough};
use eigentol_results::shares::mostly;
use eigentol_results::{Answer, Columns, Findings, Subject, displayed};

use crate::algebra::Vector;
use crate::along::varied;
use crate::campbell::Campbell;
use crate::sweep::EventTolerance;
use crate::{Description, DesignVariable, Error, Input, Shared};

/// Events along an input at several values of a design variable.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EventMap {
    /// The input along which events were sought.
    pub input: Input,
    /// The design variable that varies.
    pub over: DesignVariable,
    /// Its values, SI, with the events at each in order, or the reason why there are none.
    pub points: Vec<(f64, Result<Vec<EventTolerance>, Error>)>,
    /// The inputs, SI; the one along which events were sought has no meaning.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl EventMap {
    /// From the Campbell diagrams at values of a design variable, at these inputs.
    #[doc(hidden)]
    pub fn of(
        (input, over): (Input, DesignVariable),
        (inputs, description): (&[f64], Shared<Description>),
        diagrams: impl Iterator<Item = (f64, Result<Campbell, Error>)>,
    ) -> Self {
        let events = |Campbell { mut crossings, critical, flutter_onsets, .. }: Campbell| {
            crossings.extend(critical);
            crossings.extend(flutter_onsets);
            crossings.sort_by(|a, b| a.value.total_cmp(&b.value));
            crossings
        };
        let points = diagrams.map(|(value, diagram)| (value, diagram.map(events))).collect();
        Self { input, over, points, inputs: inputs.into(), description }
    }

    /// All events, each with the value of the design variable, SI.
    pub fn events(&self) -> impl Iterator<Item = (f64, &EventTolerance)> {
        self.points.iter().flat_map(|(value, events)| events.iter().flatten().map(|event| (*value, event)))
    }
}

/// `event map`: a row for each event at each value of the design variable.
impl Answer for EventMap {
    const KIND: &'static str = "event map";

    fn subject(&self) -> Option<Subject<'_>> {
        Some(Subject::along(&self.description, &self.inputs, self.input))
    }

    fn findings(&self) -> Findings {
        let d = &self.description;
        let over = &d.design[self.over.index()];
        let mut said = self.titled(format_args!("events over {}", over.name));
        let rows: Vec<(f64, &EventTolerance)> = self.events().collect();
        let mut table = Columns::new("event map", &rows);
        let value = |row: &(f64, &EventTolerance)| Some(as_written(row.0, &over.unit));
        table.number(&over.name, &over.unit.symbol, &value).digits(given);
        table.words("what happens", &|row| Some(row.1.what_happens()));
        table.cells("what happens", &|row| row.1.what_happens());
        varied(&mut table, d, self.input, number, &|row| row.1.value);
        if let (Some(info), Some((_, one))) = (d.inputs.get(self.input.index()), rows.first()) {
            let spread = |row: &(f64, &EventTolerance)| Some(row.1.spread.as_ref().ok()?.band);
            table.measured("band", &info.unit, &spread).digits(rough).headed(&format!("{} sigma", one.sigma_level));
        }
        table.shares(d, &|row| Some(&row.1.spread.as_ref().ok()?.variance_shares[..]));
        let error = |row: &(f64, &EventTolerance)| Some(row.1.spread.as_ref().err()?.to_string());
        table.words("error", &error);
        table.cells("mostly from", &|row| {
            let spread = row.1.spread.as_ref().ok();
            error(row).or_else(|| spread.map(|x| mostly(d, &x.variance_shares))).unwrap_or_default()
        });
        said.columns(table);
        for (value, error) in self.points.iter().filter_map(|(value, events)| Some((value, events.as_ref().err()?))) {
            said.note(format!("{} = {}: {error}", over.name, given(as_written(*value, &over.unit))));
        }
        said
    }
}

displayed!(EventMap);
