//! Forced vibration at one state as text and tables.

use std::f64::consts::PI;

use eigentol_results::numbers::{converted, number, short};
use eigentol_results::title::title;
use eigentol_results::{Answer, Columns, Findings, Subject, displayed};

use super::{ForcedCurvature, ForcedResponse, ForcedSensitivities, Harmonic, Measure};
use crate::second_order::{Pair, names_of_pairs, pairs};
use crate::sensitivity::derivatives::{Derived, data, say, variables};
use crate::{Complex, Description, Output, Text, Unit, variables as of_pairs};

/// What every amplitude and phase means.
const CONVENTIONS: &str =
    "Amplitudes are from 0 to peak, half of peak to peak; a positive phase leads the excitation.";

displayed!(ForcedResponse, ForcedSensitivities, ForcedCurvature);

/// `forced vibration`: a row for each output of each harmonic; `shares`: a row for each output and excitation;
/// `unknowns`: a row for each unknown of each harmonic.
impl Answer for ForcedResponse {
    const KIND: &'static str = "forced vibration";

    fn subject(&self) -> Option<Subject<'_>> {
        Some(Subject::at(&self.description, &self.inputs))
    }

    fn findings(&self) -> Findings {
        let title = title(&self.description, &self.inputs);
        let mut said = Findings::titled(format!("{title}: forced vibration"));
        self.say(&mut said);
        conventions(&mut said);
        said
    }
}

/// The tables of the response; `sensitivities`: a row for the amplitude and phase, real and imaginary part, of each
/// output of each harmonic and for each variable, in `unit` per `per` of the variable.
impl Answer for ForcedSensitivities {
    const KIND: &'static str = "sensitivities of forced vibration";

    fn subject(&self) -> Option<Subject<'_>> {
        self.response.subject()
    }

    fn findings(&self) -> Findings {
        let (d, inputs) = (&self.response.description, &self.response.inputs);
        let title = title(d, inputs);
        let mut said = Findings::titled(format!("{title}: forced vibration and its derivatives"));
        self.response.say(&mut said);
        let variables = variables(d, inputs);
        let [polar, cartesian] = self.derived();
        say(&mut said, &variables, &polar);
        let all: Vec<Derived> = polar.into_iter().chain(cartesian).collect();
        said.data(data("sensitivities", "quantity", &variables, &all));
        conventions(&mut said);
        said
    }
}

/// `second derivatives`: a row for each output of each harmonic and pair of variables, derivatives in `unit`, phases in
/// degrees, per `unit 2` of the first variable and `unit 3` of the second.
impl Answer for ForcedCurvature {
    const KIND: &'static str = "second derivatives of forced vibration";

    fn subject(&self) -> Option<Subject<'_>> {
        self.first.subject()
    }

    fn findings(&self) -> Findings {
        let response = &self.first.response;
        let (d, inputs) = (&response.description, &response.inputs);
        let title = title(d, inputs);
        let mut said = Findings::titled(format!("{title}: second derivatives of forced vibration"));
        let pairs = pairs(&of_pairs::variables(d));
        let each = (0..self.harmonics.len()).flat_map(|harmonic| {
            (0..d.outputs.len()).map(move |output| (harmonic, Output::new(output)))
        });
        let second = |(harmonic, output): (usize, Output)| {
            let modulus = self.modulus(harmonic, output, Measure::Displacement);
            let phase = self.phase(harmonic, output, Measure::Displacement);
            let complex = self.complex(harmonic, output, Measure::Displacement);
            (harmonic, output.index(), (modulus, phase, complex))
        };
        let each: Vec<_> = each.map(second).collect();
        let rows: Vec<_> = each
            .iter()
            .flat_map(|own| pairs.iter().map(move |pair| (own, pair)))
            .collect();
        let count = d.inputs.len();
        let mut table = Columns::new("second derivatives", &rows);
        vibrating(&mut table, d, &|((harmonic, output, _), _)| {
            Some((response.harmonics.get(*harmonic)?, *output))
        });
        names_of_pairs(&mut table, &|row| row.1);
        let scaled = |output: usize, pair: &Pair<'_>, value: f64| {
            Some(converted(pair.scaled(value), &d.outputs.get(output)?.unit))
        };
        table.number("amplitude", "", &|((_, output, second), pair)| {
            scaled(*output, pair, pair.of(second.0.as_ref()?, count)?)
        });
        table.number("phase", "deg per units", &|((_, _, second), pair)| {
            Some(
                pair.scaled(pair.of(second.1.as_ref()?, count)?)
                    .to_degrees(),
            )
        });
        table.number("Re", "", &|((_, output, second), pair)| {
            scaled(*output, pair, pair.of(second.2.as_ref()?, count)?.re)
        });
        table.number("Im", "", &|((_, output, second), pair)| {
            scaled(*output, pair, pair.of(second.2.as_ref()?, count)?.im)
        });
        said.columns(table);
        conventions(&mut said);
        said
    }
}

pub(crate) fn conventions(said: &mut Findings) {
    said.note(CONVENTIONS);
}

impl Harmonic {
    /// The names of its excitations.
    fn names(&self, d: &Description) -> String {
        let infos = self.shares.iter();
        let names = infos.filter_map(|share| Some(&*d.excitations.get(share.excitation)?.name));
        names.collect::<Vec<&str>>().join(", ")
    }
}

/// Columns that say which output vibrates in which harmonic.
fn vibrating<R>(
    table: &mut Columns<'_, R>,
    d: &Description,
    of: &dyn Fn(&R) -> Option<(&Harmonic, usize)>,
) {
    let under = table.words("under", &|row| Some(of(row)?.0.names(d)));
    if d.excitations.iter().any(|info| info.with > 0) {
        under.shown();
    }
    table
        .number("frequency", "rad/s", &|row| Some(of(row)?.0.frequency))
        .digits(number);
    let info = |row: &R| d.outputs.get(of(row)?.1);
    table
        .words("output", &|row| Some(info(row)?.name.to_string()))
        .shown();
    table
        .words("unit", &|row| Some(info(row)?.unit.symbol.to_string()))
        .shown();
}

/// Columns of an amplitude, in the unit that goes with it.
fn amplitudes<'d, R>(table: &mut Columns<'_, R>, of: &dyn Fn(&R) -> Option<(Complex, &'d Unit)>) {
    let part = |row: &R, part: fn(Complex) -> f64| {
        let (amplitude, unit) = of(row)?;
        Some(converted(part(amplitude), unit))
    };
    table
        .number("amplitude", "", &|row| part(row, Complex::norm))
        .digits(number);
    table
        .number("phase", "deg", &|row| Some(of(row)?.0.arg().to_degrees()))
        .digits(short);
    table.number("Re", "", &|row| part(row, |own| own.re));
    table.number("Im", "", &|row| part(row, |own| own.im));
}

/// Columns of the vibration of an output of a harmonic.
pub(crate) fn vibrations<R>(
    table: &mut Columns<'_, R>,
    d: &Description,
    of: &dyn Fn(&R) -> Option<(&Harmonic, usize)>,
) {
    vibrating(table, d, of);
    amplitudes(table, &|row| {
        let (harmonic, output) = of(row)?;
        Some((*harmonic.outputs.get(output)?, &d.outputs.get(output)?.unit))
    });
}

impl ForcedResponse {
    fn say(&self, said: &mut Findings) {
        let d = &*self.description;
        let outputs = d.outputs.len();
        let each = self.harmonics.iter();
        let rows: Vec<_> = each
            .flat_map(|own| (0..outputs).map(move |output| (own, output)))
            .collect();
        let mut table = Columns::new("forced vibration", &rows);
        vibrations(&mut table, d, &|row| Some(*row));
        said.columns(table);
        self.shares(said);
        self.unknowns(said);
    }

    /// What each excitation contributes; in the text where several act together.
    fn shares(&self, said: &mut Findings) {
        let d = &*self.description;
        let shares = self.harmonics.iter().flat_map(|own| &own.shares);
        let outputs = 0..d.outputs.len();
        let rows: Vec<_> = shares
            .flat_map(|share| outputs.clone().map(move |output| (share, output)))
            .collect();
        let mut table = Columns::new("shares", &rows);
        table
            .words("share of", &|(share, _)| {
                Some(d.excitations.get(share.excitation)?.name.to_string())
            })
            .shown();
        let info = |row: &(_, usize)| d.outputs.get(row.1);
        table
            .words("output", &|row| Some(info(row)?.name.to_string()))
            .shown();
        table
            .words("unit", &|row| Some(info(row)?.unit.symbol.to_string()))
            .shown();
        amplitudes(&mut table, &|row| {
            Some((*row.0.outputs.get(row.1)?, &info(row)?.unit))
        });
        table.flag("reversed", &|(share, _)| Some(share.reversed));
        match self.harmonics.iter().any(|own| own.shares.len() > 1) {
            true => said.columns(table),
            false => said.data(table.finish().0),
        }
    }

    /// The vibration of the unknowns; in the text where no output is declared.
    fn unknowns(&self, said: &mut Findings) {
        let d = &*self.description;
        let each = self.harmonics.iter();
        let rows: Vec<_> = each
            .flat_map(|own| {
                d.coordinates
                    .iter()
                    .zip(&own.unknowns)
                    .map(move |(info, y)| (own, info, y))
            })
            .collect();
        let mut table = Columns::new("unknowns", &rows);
        table.words("under", &|row| Some(row.0.names(d))).shown();
        table
            .number("frequency", "rad/s", &|row| Some(row.0.frequency))
            .digits(number);
        table
            .words("unknown", &|row| Some(row.1.name.to_string()))
            .shown();
        table
            .words("unit", &|row| Some(row.1.unit.symbol.to_string()))
            .shown();
        amplitudes(&mut table, &|row| Some((*row.2, &row.1.unit)));
        match d.outputs.is_empty() {
            true => said.columns(table),
            false => said.data(table.finish().0),
        }
    }
}

impl ForcedSensitivities {
    /// Amplitudes and phases, and real and imaginary parts, of all outputs of all harmonics.
    fn derived(&self) -> [Vec<Derived>; 2] {
        let d = &self.response.description;
        let degrees = Unit {
            symbol: Text::from("deg"),
            scale: PI / 180.0,
        };
        let (mut polar, mut cartesian) = (Vec::new(), Vec::new());
        for (harmonic, own) in self.response.harmonics.iter().enumerate() {
            let under = match self.response.harmonics.len() {
                1 => String::new(),
                _ => format!(" under {}", own.names(d)),
            };
            for (o, info) in d.outputs.iter().enumerate() {
                let output = Output::new(o);
                let place = (harmonic, output, Measure::Displacement);
                let derived = |what: &str, unit: &Unit, slopes: Option<Vec<f64>>| Derived {
                    name: format!("{what}{}{under}", info.name),
                    unit: unit.clone(),
                    clustered: false,
                    slopes: slopes.unwrap_or_default(),
                };
                let modulus = self.modulus(place.0, place.1, place.2);
                let phase = self.phase(place.0, place.1, place.2);
                let complex = self.complex(place.0, place.1, place.2);
                let part = |part: fn(Complex) -> f64| {
                    let slopes = complex.as_ref();
                    slopes.map(|own| own.iter().map(part).collect())
                };
                let listed = |own: crate::sensitivity::Slopes<f64>| own.iter().collect();
                polar.push(derived("", &info.unit, modulus.map(listed)));
                polar.push(derived("phase of ", &degrees, phase.map(listed)));
                cartesian.push(derived("Re ", &info.unit, part(|own| own.re)));
                cartesian.push(derived("Im ", &info.unit, part(|own| own.im)));
            }
        }
        [polar, cartesian]
    }
}
