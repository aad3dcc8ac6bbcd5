//! Forced vibration along an input as text and tables.

use eigentol_results::numbers::{converted, given, number, percent, short, with_unit};
use eigentol_results::relevance::{EVERYTHING, shown};
use eigentol_results::{Answer, Columns, Findings, Subject, displayed};

use super::{Bands, Bode};
use crate::along::{not_reached, place, varied};
use crate::forced::Harmonic;
use crate::propagation::{ResponseSpread, VibrationCheck};
use crate::response::{Response, Vibration};
use crate::{Complex, Description, Error};

/// What every amplitude and phase means.
const CONVENTIONS: &str = "Amplitudes are from 0 to peak, half of peak to peak; a positive phase is ahead of cos(w t).";
/// An error of a model's spread that is worth a word.
const WORTH_SAYING: f64 = 0.01;

/// `forced vibration`: a row for each output of each harmonic at each value of the input; `bands`, if there are any: a
/// row for each vibration at each value.
impl Answer for Bode {
    const KIND: &'static str = "forced vibration along an input";

    fn subject(&self) -> Option<Subject<'_>> {
        Some(Subject::along(&self.description, &self.inputs, self.input))
    }

    fn findings(&self) -> Findings {
        let d = &self.description;
        let mut said = self.titled("forced vibration");
        not_reached(&mut said, self.unreached);
        let points = shown(self.points.len());
        let rows = self.rows();
        let mut table = Columns::new("forced vibration", &rows);
        let visible = rows.iter().enumerate().filter(|(_, row)| points.contains(&row.point));
        table.show_rows(visible.map(|(k, _)| k).collect());
        varied(&mut table, d, self.input, given, &|row| row.value);
        let excitations = |row: &Row<'_>| Some(row.found?.0.excitations(d));
        let column = table.words("excitations", &excitations);
        if self.harmonics() > 1 {
            column.shown();
        }
        table.number("frequency", "rad/s", &|row| Some(row.found?.0.frequency)).digits_in(&d.frequency, number);
        table.words("output", &|row| Some(row.name(d)?.to_owned())).shown();
        table.words("unit", &|row| Some(row.unit(d)?.to_owned())).shown();
        table.number("amplitude", "", &|row| row.scaled(d, Complex::norm)).digits(number);
        table
            .number("phase", "deg", &|row| Some(row.amplitude().filter(|y| *y != Complex::ZERO)?.arg().to_degrees()))
            .digits(short);
        table.number("Re", "", &|row| row.scaled(d, |y| y.re));
        table.number("Im", "", &|row| row.scaled(d, |y| y.im));
        table.words("stable", &|row| row.found.map(|_| if row.stable { "yes" } else { "no" }.to_owned()));
        table.words("error", &|row| row.error.map(ToString::to_string));
        said.columns(table);
        self.bands(&mut said, &points);
        let (few, all) = (points.len(), self.points.len());
        if few < all {
            said.note(format!("{few} of {all} points are shown: {EVERYTHING}."));
        }
        self.greatest(&mut said, &rows);
        if let Some(error) = self.points.iter().find_map(|point| point.vibration.as_ref().err()) {
            let failed = self.points.iter().filter(|point| point.vibration.is_err());
            let failed = failed.count();
            said.note(format!("{failed} of {all} points have no vibration; the first: {error}."));
        }
        self.unstable(&mut said);
        said.note(CONVENTIONS);
        said
    }
}

displayed!(Bode);

/// An output of a harmonic at a value of the input, or the reason why there is none.
struct Row<'a> {
    point: usize,
    value: f64,
    stable: bool,
    found: Option<(&'a Harmonic, usize)>,
    error: Option<&'a Error>,
}

impl Row<'_> {
    fn amplitude(&self) -> Option<Complex> {
        let (harmonic, output) = self.found?;
        harmonic.outputs.get(output).copied().flatten()
    }

    /// A part of the amplitude in the unit of the output.
    fn scaled(&self, d: &Description, part: fn(Complex) -> f64) -> Option<f64> {
        let unit = &d.outputs.get(self.found?.1)?.unit;
        Some(converted(part(self.amplitude()?), unit))
    }

    fn name<'d>(&self, d: &'d Description) -> Option<&'d str> {
        Some(&d.outputs.get(self.found?.1)?.name)
    }

    fn unit<'d>(&self, d: &'d Description) -> Option<&'d str> {
        Some(&d.outputs.get(self.found?.1)?.unit.symbol)
    }
}

/// The band of a vibration at a value of the input.
struct Band<'a> {
    point: usize,
    value: f64,
    vibration: &'a Vibration,
    spread: Option<&'a ResponseSpread>,
    check: Option<&'a VibrationCheck>,
}

impl Band<'_> {
    fn quantile(&self, index: usize) -> Option<f64> {
        Some(self.spread?.quantiles.get(index)?.value)
    }
}

impl Bode {
    /// The largest number of harmonics at a value.
    fn harmonics(&self) -> usize {
        let solved = self.points.iter().flat_map(|point| &point.vibration);
        solved.map(|vibration| vibration.response.harmonics.len()).max().unwrap_or(0)
    }

    /// The greatest amplitude of each output at these values, and where.
    fn greatest(&self, said: &mut Findings, rows: &[Row<'_>]) {
        let d = &self.description;
        let tops = (0..d.outputs.len()).filter_map(|output| {
            let own = rows.iter().filter(|row| row.found.is_some_and(|found| found.1 == output));
            let (height, value) = own
                .filter_map(|row| Some((row.scaled(d, Complex::norm)?, row.value)))
                .reduce(|most, own| if own.0 > most.0 { own } else { most })?;
            let info = &d.outputs[output];
            let height = with_unit(number(height), &info.unit);
            (self.points.len() > 1).then(|| format!("{} {height} at {}", info.name, place(d, self.input, value)))
        });
        let tops: Vec<String> = tops.collect();
        if !tops.is_empty() {
            let all = tops.join(", ");
            said.note(format!("Greatest at these values: {all}. Peaks between them: `eigentol response --peaks`."));
        }
    }

    /// Where the vibration exists but no machine stays there.
    fn unstable(&self, said: &mut Findings) {
        let mut unstable = self.points.iter().filter(|point| point.vibration.is_ok()).filter(|point| !point.stable);
        if let Some(first) = unstable.next() {
            let (d, all) = (&self.description, self.points.len());
            said.note(format!(
                "{} of {all} points are unstable, the first at {}: no machine stays there.",
                unstable.count() + 1,
                place(d, self.input, first.value)
            ));
        }
    }

    fn rows(&self) -> Vec<Row<'_>> {
        let mut rows = Vec::new();
        for (point, bode_point) in self.points.iter().enumerate() {
            let (value, stable) = (bode_point.value, bode_point.stable);
            let row = |found, error| Row { point, value, stable, found, error };
            match &bode_point.vibration {
                Ok(vibration) => {
                    for harmonic in &vibration.response.harmonics {
                        let outputs = 0..harmonic.outputs.len();
                        rows.extend(outputs.map(|output| row(Some((harmonic, output)), None)));
                    }
                }
                Err(error) => rows.push(row(None, Some(error))),
            }
        }
        rows
    }

    fn bands(&self, said: &mut Findings, points: &[usize]) {
        let d = &self.description;
        let mut rows = Vec::new();
        for (point, bode_point) in self.points.iter().enumerate() {
            let Some(Bands { spread, checks }) = &bode_point.bands else {
                continue;
            };
            for (k, vibration) in self.banded.iter().enumerate() {
                rows.push(Band {
                    point,
                    value: bode_point.value,
                    vibration,
                    spread: spread.spreads.get(k).and_then(Option::as_ref),
                    check: checks.get(k).and_then(Option::as_ref),
                });
            }
        }
        if rows.is_empty() {
            return;
        }
        let mut table = Columns::new("bands", &rows);
        let visible = rows.iter().enumerate().filter(|(_, row)| points.contains(&row.point));
        table.show_rows(visible.map(|(k, _)| k).collect());
        varied(&mut table, d, self.input, given, &|row| row.value);
        let named = |row: &Band<'_>| Response::Vibration(*row.vibration);
        let scaled = |row: &Band<'_>, value| Some(converted(value, &named(row).unit(d)));
        table.words("amplitude of", &|row| Some(named(row).name(d))).shown();
        table.words("unit", &|row| Some(named(row).unit(d).symbol.to_string())).shown();
        table.number("nominal", "", &|row| scaled(row, row.spread?.nominal?)).digits(number);
        table.number("mean", "", &|row| scaled(row, row.spread?.mean.value)).digits(number);
        table.number("sigma", "", &|row| scaled(row, row.spread?.sigma?.value)).digits(short);
        for (index, name) in [(1, "2.3 %"), (3, "50 %"), (5, "97.7 %"), (6, "99.9 %")] {
            table.number(name, "", &|row| scaled(row, row.quantile(index)?)).digits(number);
        }
        table.whole("designs solved anew", &|row| usize::try_from(row.check?.samples).ok());
        table.number("error of sigma", "", &|row| Some(row.check?.sigma));
        table.number("error of 99 %", "", &|row| Some(row.check?.upper));
        said.columns(table);
        let checks = || rows.iter().filter_map(|row| row.check);
        let worst = checks().map(|check| check.sigma.abs().max(check.upper.abs()));
        let Some(worst) = worst.reduce(f64::max) else {
            return;
        };
        let number = checks().map(|check| check.samples).max().unwrap_or_default();
        said.note(if worst > WORTH_SAYING {
            format!("Solving {number} designs anew at each point shows the bands up to {} off.", percent(worst))
        } else {
            format!("Solving {number} designs anew at each point confirms the bands within {}.", percent(WORTH_SAYING))
        });
    }
}
