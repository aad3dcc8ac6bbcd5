//! Peaks along an input as text and tables.

use eigentol_results::numbers::{converted, given, number, rough, short};
use eigentol_results::title::title_along;
use eigentol_results::{Answer, Columns, Findings, Subject, displayed};

use super::{HalfPower, Moving, Peak, Peaks};
use crate::along::{name_of, value_of, varied};
use crate::forced::CONVENTIONS;
use crate::{Text, Unit};

displayed!(Peaks);

/// A number of a peak.
type Part = fn(&Peak) -> Option<&Moving>;

/// `peaks`: a row for each; `derivatives of peaks`: a row for each quantity of each peak and each design variable, in its
/// unit per `unit` of the variable.
impl Answer for Peaks {
    const KIND: &'static str = "peaks";

    fn subject(&self) -> Option<Subject<'_>> {
        let input = self.range.input;
        Some(Subject::along(&self.description, &self.inputs, input))
    }

    fn findings(&self) -> Findings {
        let (d, input) = (&self.description, self.range.input);
        let name = self.vibration.name(d);
        let title = title_along(d, &self.inputs, input);
        let mut said = Findings::titled(format!("{title}: peaks of the vibration, {name}"));
        let units = self.units();
        let sigma = |of: Option<&Moving>| Some(of?.spread.as_ref()?.sigma);
        let spread = self.sigma_level.is_some();
        let mut table = Columns::new("peaks", &self.peaks);
        varied(&mut table, d, input, number, &|peak| peak.place.value);
        let half = |peak: &Peak, k: usize| Some(peak.half_power[k].place()?.value);
        let columns: [(&str, &Unit, Part); 4] = [
            ("place", &units[0], |peak| Some(&peak.place)),
            ("frequency", &units[1], |peak| Some(&peak.frequency)),
            ("height", &units[2], |peak| Some(&peak.height)),
            ("amplification", &units[3], |peak| {
                peak.amplification.as_ref()
            }),
        ];
        for (k, (what, unit, of)) in columns.into_iter().enumerate() {
            if k > 0 {
                let value = |peak: &Peak| Some(of(peak)?.value);
                table.measured(what, unit, &value).digits(number);
            }
            let column = table.measured(&format!("sigma of {what}"), unit, &|peak| sigma(of(peak)));
            if spread {
                column.digits(rough);
            }
        }
        table
            .number("phase", "deg", &|peak| Some(peak.phase.to_degrees()))
            .digits(short);
        for (k, what) in ["half power before", "half power after"]
            .into_iter()
            .enumerate()
        {
            table
                .measured(what, &units[0], &|peak| half(peak, k))
                .digits(number);
            table.words(&format!("{what} missing"), &|peak| {
                Some(missing(&peak.half_power[k])?.to_owned())
            });
        }
        said.columns(table);
        self.derivatives(&mut said, &units);
        if self.peaks.is_empty() {
            said.note("No peak in the range.");
        }
        self.reasons(&mut said);
        said.note(CONVENTIONS);
        said
    }
}

impl Peaks {
    /// The units of place, frequency, height and amplification factor.
    fn units(&self) -> [Unit; 4] {
        let plain = |symbol| Unit {
            symbol: Text::Static(symbol),
            scale: 1.0,
        };
        let d = &self.description;
        let place = d.inputs.get(self.range.input.index());
        [
            place.map_or(plain(""), |info| info.unit.clone()),
            plain("rad/s"),
            self.vibration.unit(d).unwrap_or(plain("")),
            plain(""),
        ]
    }

    fn derivatives(&self, said: &mut Findings, units: &[Unit; 4]) {
        let d = &self.description;
        let mut rows = Vec::new();
        for (number, peak) in self.peaks.iter().enumerate() {
            let all = [
                ("place", &units[0], Some(&peak.place)),
                ("frequency", &units[1], Some(&peak.frequency)),
                ("height", &units[2], Some(&peak.height)),
                ("half power before", &units[0], peak.half_power[0].place()),
                ("half power after", &units[0], peak.half_power[1].place()),
                ("amplification", &units[3], peak.amplification.as_ref()),
            ];
            for (what, unit, of) in all {
                let Some(of) = of else { continue };
                rows.extend((0..d.design.len()).map(|k| (number + 1, what, unit, of, k)));
            }
        }
        let mut table = Columns::new("derivatives of peaks", &rows);
        table.whole("peak", &|row| Some(row.0));
        table.words("quantity", &|row| Some(row.1.to_owned()));
        table.words("unit", &|row| Some(row.2.symbol.to_string()));
        table.words("by", &|row| Some(d.design[row.4].name.to_string()));
        table.words("per", &|row| Some(d.design[row.4].unit.symbol.to_string()));
        table.number("derivative", "", &|row| {
            let slope = row.3.by_design.get(row.4)? * d.design[row.4].unit.scale;
            Some(converted(slope, row.2))
        });
        said.data(table.finish().0);
    }

    /// Why numbers are missing.
    fn reasons(&self, said: &mut Findings) {
        let (d, input) = (&self.description, self.range.input);
        for peak in &self.peaks {
            for (side, place) in [
                (&peak.half_power[0], "before"),
                (&peak.half_power[1], "after"),
            ] {
                if let Some(reason) = missing(side) {
                    let value = value_of(d, input, peak.place.value);
                    said.note(format!(
                        "No half-power point {place} the peak at {value}: {reason}."
                    ));
                }
            }
        }
        for gap in &self.gaps {
            let [from, to] = [gap.from, gap.to].map(|value| match d.inputs.get(input.index()) {
                Some(info) => given(info.unit.from_si(value)),
                None => given(value),
            });
            let name = name_of(d, input);
            said.note(format!(
                "Not searched, {name} from {from} to {to}: {}.",
                gap.reason
            ));
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
