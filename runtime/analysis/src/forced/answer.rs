//! Forced vibration at one operating point as text and tables.

use eigentol_results::numbers::{converted, frequency_in, in_unit as number_in, number, short, with_unit};
use eigentol_results::{Answer, Columns, Findings, Subject, at_point, displayed};

use super::{ForcedCurvature, ForcedResponse, ForcedSensitivities, Harmonic, Measure, Share};
use crate::second_order::{Pair, names, pairs};
use crate::sensitivity::Slopes;
use crate::sensitivity::derivatives::{Derived, data, say, variables};
use crate::{Complex, Description, Error, Output, Unit};

displayed!(ForcedResponse, ForcedSensitivities);

/// What every amplitude and phase means.
pub(crate) const CONVENTIONS: &str =
    "Amplitudes are from 0 to peak, half of peak to peak; a positive phase is ahead of cos(w t).";

/// `forced response`: a row for each output of each harmonic; `shares`: a row for each excitation besides; `vibration of
/// unknowns`: a row for each unknown of each harmonic.
impl Answer for ForcedResponse {
    const KIND: &'static str = "forced response";

    at_point!();

    fn findings(&self) -> Findings {
        let d = &self.description;
        let mut said = self.titled("forced vibration");
        let rows = self.rows();
        let mut table = Columns::new("forced response", &rows);
        of_harmonic(&mut table, d, &|row| row.harmonic);
        of_output(&mut table, d, &|row| row.output, &|row| row.amplitude());
        said.columns(table);
        let rows: Vec<(&Row<'_>, usize)> =
            (rows.iter()).flat_map(|row| (0..row.harmonic.shares.len()).map(move |share| (row, share))).collect();
        let mut table = Columns::new("shares", &rows);
        let excitation = |row: &_| Some(d.excitations.get(share(row)?.excitation)?.name.to_string());
        table.words("excitation", &excitation).shown();
        of_output(&mut table, d, &|row| row.0.output, &|row| share(row)?.outputs.get(row.0.output).copied().flatten());
        if self.harmonics.iter().any(|harmonic| harmonic.shares.len() > 1) {
            said.columns(table)
        } else {
            said.data(table.finish().0)
        }
        self.unknowns(&mut said);
        self.together(&mut said);
        self.unknown_phases(&mut said);
        self.rough(&mut said);
        said.note(CONVENTIONS);
        said
    }
}

impl ForcedResponse {
    /// What outputs do under all excitations at once: the root of the mean square of vibrations of several frequencies, and the
    /// sum of their amplitudes, which they reach if their peaks ever meet.
    fn together(&self, said: &mut Findings) {
        if self.harmonics.len() < 2 {
            return;
        }
        let d = &self.description;
        let amplitudes = |output: usize| -> Vec<f64> {
            self.harmonics
                .iter()
                .filter_map(|harmonic| *harmonic.outputs.get(output)?)
                .map(Complex::norm)
                .filter(|amplitude| *amplitude > 0.0)
                .collect()
        };
        let rows: Vec<(usize, Vec<f64>)> = (0..d.outputs.len()).map(|output| (output, amplitudes(output))).collect();
        let rows: Vec<_> = rows.into_iter().filter(|(_, amplitudes)| amplitudes.len() > 1).collect();
        let mut table = Columns::new("all excitations", &rows);
        let info = |row: &(usize, Vec<f64>)| d.outputs.get(row.0);
        table.words("output", &|row| Some(info(row)?.name.to_string())).shown().headed("under all excitations");
        table.words("unit", &|row| Some(info(row)?.unit.symbol.to_string())).shown();
        let sum =
            |row: &(usize, Vec<f64>), of: fn(f64) -> f64| row.1.iter().map(|amplitude| of(*amplitude)).sum::<f64>();
        let rms = |row: &_| Some(converted((0.5 * sum(row, |x| x * x)).sqrt(), &info(row)?.unit));
        table.number("rms", "", &rms).digits(number);
        table.number("at most", "", &|row| Some(converted(sum(row, |x| x), &info(row)?.unit))).digits(number);
        said.columns(table);
    }

    /// What remains true if only the amounts of several excitations are known.
    fn unknown_phases(&self, said: &mut Findings) {
        let d = &self.description;
        for row in self.rows() {
            let name = row.name(self);
            let sum = row.harmonic.unknown_phases(Output::new(row.output), Measure::Displacement);
            let several = row.harmonic.shares.len() > 1;
            let (true, Ok(sum)) = (several, sum) else {
                continue;
            };
            let Some(info) = d.outputs.get(row.output) else {
                continue;
            };
            let Ok(upper) = sum.quantile(0.95) else {
                continue;
            };
            said.note(format!(
                "With unknown phases, {name} is at most {}, in 95 % of cases below {}.",
                with_unit(number_in(sum.greatest(), &info.unit), &info.unit),
                with_unit(number_in(upper, &info.unit), &info.unit)
            ));
        }
    }

    /// Outputs without amplitude.
    fn rough(&self, said: &mut Findings) {
        let all = self
            .harmonics
            .iter()
            .take(1)
            .flat_map(|harmonic| harmonic.outputs.iter().zip(self.description.outputs.iter()));
        for (_, info) in all.filter(|(amplitude, _)| amplitude.is_none()) {
            let output = info.name.clone();
            said.note(Error::NotSmooth { output }.to_string());
        }
    }

    fn rows(&self) -> Vec<Row<'_>> {
        let harmonics = self.harmonics.iter().enumerate();
        harmonics
            .flat_map(|(index, harmonic)| {
                (0..harmonic.outputs.len()).map(move |output| Row { place: index, harmonic, output })
            })
            .collect()
    }

    fn unknowns(&self, said: &mut Findings) {
        let d = &self.description;
        let harmonics = self.harmonics.iter();
        let rows: Vec<(&Harmonic, usize)> =
            harmonics.flat_map(|harmonic| (0..harmonic.unknowns.len()).map(move |i| (harmonic, i))).collect();
        let mut table = Columns::new("vibration of unknowns", &rows);
        table.number("frequency", "rad/s", &|row| Some(row.0.frequency));
        let info = |row: &(&Harmonic, usize)| d.coordinates.get(row.1);
        table.words("unknown", &|row| Some(info(row)?.name.to_string()));
        table.words("unit", &|row| Some(info(row)?.unit.symbol.to_string()));
        let value = |row: &(&Harmonic, usize), part: fn(Complex) -> f64| {
            Some(converted(part(*row.0.unknowns.get(row.1)?), &info(row)?.unit))
        };
        table.number("Re", "", &|row| value(row, |x| x.re));
        table.number("Im", "", &|row| value(row, |x| x.im));
        said.data(table.finish().0);
    }
}

/// One of the excitations that act on an output.
fn share<'a>((row, share): &(&'a Row<'_>, usize)) -> Option<&'a Share> {
    row.harmonic.shares.get(*share)
}

/// An output of a harmonic.
struct Row<'a> {
    place: usize,
    harmonic: &'a Harmonic,
    output: usize,
}

impl Row<'_> {
    fn amplitude(&self) -> Option<Complex> {
        self.harmonic.outputs.get(self.output).copied().flatten()
    }

    /// `x at 380.0 rad/s`, or only the output if there is one harmonic; `x under u` if several have this frequency.
    fn name(&self, of: &ForcedResponse) -> String {
        let info = of.description.outputs.get(self.output);
        let name = info.map_or("?", |info| &*info.name);
        let frequency = self.harmonic.frequency;
        let same = of.harmonics.iter().filter(|harmonic| harmonic.frequency == frequency);
        match (of.harmonics.len(), same.count()) {
            (1, _) => name.to_owned(),
            (_, 1) => format!("{name} at {}", frequency_in(frequency, &of.description.frequency, short)),
            _ => {
                let under = self.harmonic.excitations(&of.description);
                format!("{name} under {under}")
            }
        }
    }

    fn unit(&self, of: &Description) -> Unit {
        let info = of.outputs.get(self.output);
        info.map_or(Unit::si(""), |info| info.unit.clone())
    }
}

impl Harmonic {
    /// The names of its excitations.
    #[doc(hidden)]
    #[must_use]
    pub fn excitations(&self, d: &Description) -> String {
        let names: Vec<&str> = self
            .shares
            .iter()
            .filter_map(|share| d.excitations.get(share.excitation))
            .map(|info| &*info.name)
            .collect();
        names.join(", ")
    }
}

/// Columns of the excitations and the frequency of a harmonic.
fn of_harmonic<R>(table: &mut Columns<'_, R>, d: &Description, of: &dyn Fn(&R) -> &Harmonic) {
    table.words("excitations", &|row| Some(of(row).excitations(d))).shown();
    table.number("frequency", "rad/s", &|row| Some(of(row).frequency)).digits_in(&d.frequency, number);
}

/// Columns of an output and its amplitude, in the text too.
fn of_output<R>(
    table: &mut Columns<'_, R>,
    d: &Description,
    output: &dyn Fn(&R) -> usize,
    of: &dyn Fn(&R) -> Option<Complex>,
) {
    table.words("output", &|row| Some(d.outputs.get(output(row))?.name.to_string())).shown();
    table.words("unit", &|row| Some(d.outputs.get(output(row))?.unit.symbol.to_string())).shown();
    let value = |row: &R, part: fn(Complex) -> f64| Some(converted(part(of(row)?), &d.outputs.get(output(row))?.unit));
    table.number("amplitude", "", &|row| value(row, |x| x.norm())).digits(number);
    let phase = |row: &R| of(row).filter(|x| *x != Complex::ZERO).map(|x| x.arg().to_degrees());
    table.number("phase", "deg", &phase).digits(short);
    table.number("Re", "", &|row| value(row, |x| x.re));
    table.number("Im", "", &|row| value(row, |x| x.im));
}

/// The tables of the response; `derivatives of forced vibration`: a row for each amplitude, phase and frequency and each
/// variable.
impl Answer for ForcedSensitivities {
    const KIND: &'static str = "forced sensitivities";

    fn subject(&self) -> Option<Subject<'_>> {
        Answer::subject(&self.response)
    }

    fn findings(&self) -> Findings {
        let mut said = self.response.findings();
        let of = &self.response;
        let variables = variables(&of.description, &of.inputs);
        let rows = of.rows();
        let list = |slopes: Option<Slopes<f64>>| slopes.map_or(Vec::new(), |slopes| slopes.iter().collect());
        let derived = |name: String, unit: Unit, slopes: Option<Slopes<f64>>| Derived {
            name,
            unit,
            clustered: false,
            slopes: list(slopes),
        };
        let (mut amplitudes, mut others) = (Vec::new(), Vec::new());
        for row in &rows {
            let (output, measure) = (Output::new(row.output), Measure::Displacement);
            let name = |what: &str| format!("{what} of {}", row.name(of));
            let modulus = self.modulus(row.place, output, measure);
            amplitudes.push(derived(name("amplitude"), row.unit(&of.description), modulus));
            let phase = self.phase(row.place, output, measure);
            others.push(derived(name("phase"), Unit::si("rad"), phase));
        }
        for (harmonic, sensitivity) in of.harmonics.iter().zip(&self.harmonics) {
            let name = format!("frequency {}", short(harmonic.frequency));
            others.push(derived(name, Unit::si("rad/s"), Some(sensitivity.frequency.clone())));
        }
        say(&mut said, &variables, &amplitudes);
        amplitudes.append(&mut others);
        let table = "derivatives of forced vibration";
        said.data(data(table, "quantity", &variables, &amplitudes));
        said
    }
}

/// `second derivatives`: a row for each output of each harmonic and each pair of variables, derivatives of the complex
/// amplitude and of its modulus, `in` the unit of the output per `unit` of the first and `unit 2` of the second.
impl Answer for ForcedCurvature {
    const KIND: &'static str = "second derivatives of forced vibration";

    fn subject(&self) -> Option<Subject<'_>> {
        Answer::subject(&self.first.response)
    }

    fn findings(&self) -> Findings {
        let of = &self.first.response;
        let d = &of.description;
        let mut said = self.titled("second derivatives of forced vibration");
        let (pairs, inputs) = (pairs(&crate::variables::variables(d)), d.inputs.len());
        let rows = of.rows();
        let second = |row: &Row<'_>| {
            let (output, measure) = (Output::new(row.output), Measure::Displacement);
            let modulus = self.modulus(row.place, output, measure);
            (self.complex(row.place, output, measure), modulus)
        };
        let all: Vec<_> = rows.iter().map(|row| (row, second(row))).collect();
        let rows: Vec<_> = (all.iter()).flat_map(|x| pairs.iter().map(move |pair| (x, pair))).collect();
        let mut table = Columns::new("second derivatives", &rows);
        table.words("output", &|((row, _), _)| Some(row.name(of)));
        table.words("in", &|((row, _), _)| Some(row.unit(d).symbol.to_string()));
        names(&mut table, &|row| row.1);
        let scaled = |row: &Row<'_>, pair: &Pair<'_>, value: f64| Some(converted(pair.scaled(value), &row.unit(d)));
        table.number("Re", "per units", &|((row, (complex, _)), pair)| {
            scaled(row, pair, pair.of(complex.as_ref()?, inputs)?.re)
        });
        table.number("Im", "per units", &|((row, (complex, _)), pair)| {
            scaled(row, pair, pair.of(complex.as_ref()?, inputs)?.im)
        });
        table.number("amplitude", "per units", &|((row, (_, modulus)), pair)| {
            scaled(row, pair, pair.of(modulus.as_ref()?, inputs)?)
        });
        said.columns(table);
        said
    }
}
