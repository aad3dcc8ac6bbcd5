//! Peaks along an input as text and tables.

use std::slice;

use eigentol_results::numbers::{converted, given, heading, number, rough, short};
use eigentol_results::{Answer, Columns, Findings, Listed, Subject, Table, displayed};

use super::{HalfPower, Moving, Peak, Peaks};
use crate::Unit;
use crate::along::{name_of, place, value_of, varied};
use crate::forced::CONVENTIONS;

displayed!(Peaks);

/// A peak of a vibration, and its number among those of the vibration.
type Row<'a> = (&'a Peaks, usize, &'a Peak);

/// A number of a peak.
type Part = fn(&Peak) -> Option<&Moving>;

/// `peaks`: a row for each, heights in `unit`; `derivatives of peaks`: a row for each quantity of each peak and each design
/// variable, in its unit per `per` of the variable.
impl Answer for Peaks {
    const KIND: &'static str = "peaks";

    fn subject(&self) -> Option<Subject<'_>> {
        let input = self.range.input;
        Some(Subject::along(&self.description, &self.inputs, input))
    }

    fn findings(&self) -> Findings {
        <Self as Listed>::findings(slice::from_ref(self))
    }
}

/// The tables of one, with the rows of all vibrations.
impl Listed for Peaks {
    const KIND: &'static str = "peaks of vibrations";

    fn subject(&self) -> Option<Subject<'_>> {
        Answer::subject(self)
    }

    fn findings(all: &[Self]) -> Findings {
        let mut said = match all {
            [] => Findings::titled("no peaks".to_owned()),
            _ => Findings::default(),
        };
        for peaks in all {
            peaks.say(&mut said);
        }
        let rows: Vec<Row<'_>> = all.iter().flat_map(Peaks::rows).collect();
        if let Some(first) = all.first() {
            said.data(first.columns(&rows).finish().0);
            said.data(derivatives(&rows));
            said.note(CONVENTIONS);
        }
        said
    }
}

/// The derivatives of all numbers of these peaks.
fn derivatives(all: &[Row<'_>]) -> Table {
    let mut rows = Vec::new();
    for row @ (of, _, peak) in all {
        let units = of.units();
        let all = [
            ("place", &units[0], Some(&peak.place)),
            ("frequency", &units[1], Some(&peak.frequency)),
            ("height", &units[2], Some(&peak.height)),
            ("half power before", &units[0], peak.half_power[0].place()),
            ("half power after", &units[0], peak.half_power[1].place()),
            ("amplification", &units[3], peak.amplification.as_ref()),
        ];
        for (what, unit, moving) in all {
            let Some(moving) = moving else { continue };
            rows.extend(
                of.description
                    .design
                    .iter()
                    .enumerate()
                    .map(|(k, by)| (row, what, unit.clone(), (by, moving.by_design.get(k)))),
            );
        }
    }
    let mut table = Columns::new("derivatives of peaks", &rows);
    table.words("vibration", &|row| Some(row.0.0.name()));
    table.whole("peak", &|row| Some(row.0.1));
    table.words("quantity", &|row| Some(row.1.to_owned()));
    table.words("unit", &|row| Some(row.2.symbol.to_string()));
    table.words("by", &|row| Some(row.3.0.name.to_string()));
    table.words("per", &|row| Some(row.3.0.unit.symbol.to_string()));
    table
        .number("derivative", "", &|(_, _, unit, (by, slope))| Some(converted(*slope.as_ref()? * by.unit.scale, unit)));
    table.finish().0
}

impl Peaks {
    /// The units of place, frequency, height and amplification factor.
    fn units(&self) -> [Unit; 4] {
        let d = &self.description;
        let input = d.inputs.get(self.range.input.index());
        [
            input.map_or(Unit::si(""), |info| info.unit.clone()),
            Unit::si("rad/s"),
            self.vibration.unit(d).unwrap_or(Unit::si("")),
            Unit::si(""),
        ]
    }

    pub(super) fn name(&self) -> String {
        self.vibration.name(&self.description)
    }

    fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.peaks.iter().enumerate().map(move |(k, peak)| (self, k + 1, peak))
    }

    /// The text about the peaks of one vibration.
    fn say(&self, said: &mut Findings) {
        said.join(self.titled(format_args!("peaks of the vibration, {}", self.name())));
        let rows: Vec<Row<'_>> = self.rows().collect();
        said.text(self.columns(&rows).finish().1);
        if self.peaks.is_empty() {
            said.note("No peak in the range.");
        }
        self.reasons(said);
    }

    /// The columns about peaks along the same input. Vibrations have units of their own, which the text says in the
    /// headings: its rows are those of one.
    fn columns<'a>(&self, rows: &'a [Row<'a>]) -> Columns<'a, Row<'a>> {
        let (d, input, units) = (&self.description, self.range.input, self.units());
        let mut table = Columns::new("peaks", rows);
        table.words("vibration", &|row| Some(row.0.name()));
        varied(&mut table, d, input, number, &|row| row.2.place.value);
        let columns: [(&str, usize, Part); 4] = [
            ("place", 0, |peak| Some(&peak.place)),
            ("frequency", 1, |peak| Some(&peak.frequency)),
            ("height", 2, |peak| Some(&peak.height)),
            ("amplification", 3, |peak| peak.amplification.as_ref()),
        ];
        for (what, k, of) in columns {
            let is_height = what == "height";
            if is_height {
                table.words("unit", &|row| Some(row.0.units()[k].symbol.to_string()));
            }
            let mut add = |name: &str, form: Option<fn(f64) -> String>, value: &dyn Fn(&Moving) -> Option<f64>| {
                let value = |row: &Row<'_>| Some(converted(value(of(row.2)?)?, &row.0.units()[k]));
                let unit = if is_height { "" } else { &units[k].symbol };
                let column = table.number(name, unit, &value);
                match form {
                    Some(form) if what == "frequency" => drop(column.digits_in(&d.frequency, form)),
                    Some(form) => column.digits(form).headed(&heading(name, &units[k])),
                    None => {}
                }
            };
            if k > 0 {
                add(what, Some(number), &|x| Some(x.value));
            }
            let form = self.sigma_level.map(|_| rough as fn(f64) -> String);
            add(&format!("sigma of {what}"), form, &|item| Some(item.spread.as_ref()?.sigma));
        }
        let phase = |row: &Row<'_>| Some(row.2.phase?.to_degrees());
        table.number("phase", "deg", &phase).digits(short);
        for (k, what) in ["half power before", "half power after"].into_iter().enumerate() {
            let location = |row: &Row<'_>| Some(row.2.half_power[k].place()?.value);
            table.measured(what, &units[0], &location).digits(number);
            table.words(&format!("{what} missing"), &|row| Some(missing(&row.2.half_power[k])?.to_owned()));
        }
        table.words("stable", &|row| Some(if row.2.stable { "yes" } else { "no" }.to_owned()));
        table
    }

    /// Why numbers are missing, and which mean less than they seem to.
    fn reasons(&self, said: &mut Findings) {
        let (d, input) = (&self.description, self.range.input);
        for peak in &self.peaks {
            if !peak.stable {
                let value = place(d, input, peak.place.value);
                said.note(format!("Unstable at {value}: no machine stays in this vibration."));
            }
            let unknown = |moving: &Moving| moving.by_design.is_empty() && !d.design.is_empty();
            if unknown(&peak.height) || peak.amplification.as_ref().is_some_and(unknown) {
                let value = value_of(d, input, peak.place.value);
                let none = unknown(&peak.place).then(|| {
                    format!("The peak at {value} has no derivatives: a variable turns a circle into an ellipse.")
                });
                said.note(none.unwrap_or_else(|| format!(
                    "The peak at {value} is so narrow that rounding decides how its height or amplification changes with \
                     the design: no derivatives of them, and no spread."
                )));
            }
            for (side, word) in [(&peak.half_power[0], "before"), (&peak.half_power[1], "after")] {
                if let Some(reason) = missing(side) {
                    let value = value_of(d, input, peak.place.value);
                    said.note(format!("No half-power point {word} the peak at {value}: {reason}."));
                }
            }
        }
        for gap in &self.gaps {
            let [from, to] = [gap.from, gap.to].map(|value| match d.inputs.get(input.index()) {
                Some(info) => given(info.unit.from_si(value)),
                None => given(value),
            });
            let name = name_of(d, input);
            let place =
                if from == to { format!("at {name} = {from}") } else { format!("for {name} from {from} to {to}") };
            said.note(format!("No vibration {place}: {}.", gap.reason));
        }
    }
}

fn missing(side: &HalfPower) -> Option<&'static str> {
    match side {
        HalfPower::At(_) => None,
        HalfPower::EndOfRange => Some("the range ends before it"),
        HalfPower::RisesAgain => Some("the amplitude rises again before it"),
    }
}
