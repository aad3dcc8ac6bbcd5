//! Responses and requirements as text, in the shell, in study files and in Python: `frequency 1 >= 20 Hz`.

use std::f64::consts::SQRT_2;

use eigentol::forced::{Extent, Measure};
use eigentol::peaks::PeakQuantity;
use eigentol::requirement::Requirement;
use eigentol::response::{Response, Responses, Vibration};
use eigentol::sweep::{Condition, Line, Range};
use eigentol::{DesignVariable, Error, Excitation, Input, Output, Quantity, Study, Unit};
use eigentol_compiler::base::units;
use thiserror::Error as ThisError;

use crate::given::value;
use crate::mechanism::Interpreted;
use crate::mistakes::Mistakes;

/// The forms of a requirement, of which a response is the part before the limit.
pub const FORMS: &str = "write what, and its limit: `frequency 1 >= 20 Hz`, `damping_ratio 2 >= 0.05`, `log_decrement 1 >= 0.1`, `growth 1 <= 0`, `angle <= 5 deg`, \
                         `vibration shake under u <= 0.1 mm`, `velocity shake <= 4.5 mm/s rms`, \
                         `vibration shake along speed=0..6000rpm <= 100 um p-p`, `vibration major(shake, lift) <= 50 um`, \
                         `velocity shake under all <= 4.5 mm/s rms`, `peak shake along speed=0..6000rpm away from speed by 15%`, \
                         `frequency 1 within 4..5 Hz`, `frequency 1 within 1%`, `frequency 1 outside 4..5 Hz`, `frequency 1 away from 2 speed by 10%`, `critical speed=0..6000rpm >= 3000 rpm`, \
                         `resonance 1 speed=0..6000rpm order 2 >= 4000 rpm`, `flutter 1 speed=0..6000rpm >= 4000 rpm`, or `stable`";

/// What is wrong with a response or a requirement.
#[derive(Debug, ThisError)]
#[non_exhaustive]
pub enum WantedError {
    /// It has no meaning.
    #[error("{message}")]
    Meaning {
        /// What is wrong.
        message: String,
        /// What to write instead.
        help: String,
    },
    /// A name that nothing has.
    #[error("{0}")]
    Name(#[from] Error),
    /// A value that cannot be read.
    #[error("{place}: {mistakes}")]
    Value {
        /// The text around it.
        place: String,
        /// The mistakes in it.
        mistakes: Mistakes,
    },
}

type Result<T> = core::result::Result<T, WantedError>;

fn wrong<T>(message: impl Into<String>, help: impl Into<String>) -> Result<T> {
    Err(WantedError::Meaning { message: message.into(), help: help.into() })
}

fn no<T>(text: &str, what: &str) -> Result<T> {
    wrong(format!("`{text}` is not {what}"), FORMS)
}

/// The requirement that a text states: a response and its limit, or `stable`.
///
/// ```
/// use eigentol::Study;
/// use eigentol_interpreter::{Interpreted, requirement};
///
/// let text = "mechanism A { body a: point(mass: 1 kg); joint x: prismatic(x) from ground to a;
///     force s: spring(on: x, stiffness: 9 N/m); }";
/// let study = Study::new(Interpreted::from_text(text)?);
/// let wanted = requirement(&study, "frequency 1 within 2..4 rad/s")?;
/// assert_eq!(wanted.text(study.description()), "frequency 1 at least 2 rad/s, at most 4 rad/s");
/// assert!(requirement(&study, "frequency 1").is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`WantedError`].
pub fn requirement(study: &Study<Interpreted>, text: &str) -> Result<Requirement> {
    if text.trim() == "stable" {
        return Ok(Requirement::Stable);
    }
    let split = [">=", "<=", ">", "<", " outside ", " within ", " away from "].into_iter().find_map(|word| {
        let (what, limit) = text.split_once(word)?;
        Some((what, word.trim(), limit.trim()))
    });
    let Some((what, word, limit)) = split else {
        return no(text, "a requirement");
    };
    let response = response(study, what)?;
    if let (Response::Peak { vibration, range, quantity: PeakQuantity::Height }, "<=" | "<") = (response, word)
        && names(limit, &study.description().inputs[range.input.index()].name)
    {
        let vibration = along_limit(study, vibration, range, limit)?;
        let response = Response::Peak { vibration, range, quantity: PeakQuantity::Height };
        return Ok(Requirement::at_most(response, 1.0));
    }
    let (response, limit) = rms_of_all(response, limit);
    let unit = response.unit(study.description());
    let varied = match response {
        Response::Peak { range, .. } | Response::Critical(range) | Response::Crossing { range, .. } => {
            Some(range.input)
        }
        _ => None,
    };
    let end = |text: &str| limit_of(&response, &at_inputs(study, text, varied)?, &unit, what.trim(), word);
    Ok(match word {
        ">=" | ">" => Requirement::Within { response, low: end(limit)?, high: f64::INFINITY },
        "<=" | "<" => Requirement::Within { response, low: f64::NEG_INFINITY, high: end(limit)? },
        "away from" => return away(study, response, limit),
        _ => {
            let (low, high) = match (limit.split_once(".."), limit.rsplit_once("+/-")) {
                (Some((low, high)), _) => (end(&with_unit_of(low, high))?, end(high)?),
                (None, Some((middle, reach))) => {
                    let middle = end(middle.trim())?;
                    let reach = match percentage(reach) {
                        Some(share) => share * middle.abs(),
                        None => end(reach.trim())?,
                    };
                    (middle - reach, middle + reach)
                }
                (None, None) => match percentage(limit) {
                    Some(share) => {
                        let middle = nominal(study, response)?;
                        (middle - share * middle.abs(), middle + share * middle.abs())
                    }
                    None => return no(text, "a requirement"),
                },
            };
            match word {
                "outside" => Requirement::Outside { response, low, high },
                _ => Requirement::Within { response, low, high },
            }
        }
    })
}

/// The requirements that a text states: one, or that of each response of `max(a, b) <= 3 mm` and `min(a, b) >= 1 mm`.
///
/// ```
/// use eigentol::Study;
/// use eigentol_interpreter::{Interpreted, requirements};
///
/// let text = "mechanism A { body a: point(mass: 1 kg); joint x: prismatic(x) from ground to a;
///     force s: spring(on: x, stiffness: 9 N/m); output left = x; output right = -x; }";
/// let study = Study::new(Interpreted::from_text(text)?);
/// assert_eq!(requirements(&study, "max(left, right) <= 3 mm")?.len(), 2);
/// assert!(requirements(&study, "max(left, right) >= 3 mm").is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`WantedError`].
pub fn requirements(study: &Study<Interpreted>, text: &str) -> Result<Vec<Requirement>> {
    let extreme = ["max", "min"].into_iter().find_map(|word| {
        let inside = text.trim().strip_prefix(word)?.trim_start().strip_prefix('(')?;
        let end = inside.find(['<', '>']).unwrap_or(inside.len());
        let (all, _) = inside[..end].rsplit_once(')')?;
        Some((word, all, inside[all.len() + 1..].trim()))
    });
    let Some((word, all, limit)) = extreme else {
        return Ok(vec![requirement(study, text)?]);
    };
    let sign = if word == "max" { '<' } else { '>' };
    if !limit.starts_with(sign) {
        let help = format!("write `{word}({all}) {sign}= ..`, or a requirement for the one that is meant");
        return wrong(format!("`{text}` asks something of one of them, and does not say of which"), help);
    }
    arguments(all).map(|what| requirement(study, &format!("{} {limit}", what.trim()))).collect()
}

/// `5%` as a fraction.
fn percentage(text: &str) -> Option<f64> {
    text.trim().strip_suffix('%')?.trim().parse::<f64>().ok().map(|percent| percent / 100.0)
}

/// The value of a response without deviations, SI.
fn nominal(study: &Study<Interpreted>, response: Response) -> Result<f64> {
    let (state, modes) = (study.equilibrium()?, study.modes()?);
    let responses = Responses::new(study.mechanism(), &state, &modes, vec![response])?;
    let found = responses.at(&mut responses.workspace(), &state.design)?.values[0];
    match (found, responses.missing(response)) {
        (Some(value), _) => Ok(value),
        (None, Some(error)) => Err(error.into()),
        (None, None) => no(&response.name(study.description()), "a response that this state has"),
    }
}

/// What commas outside brackets separate.
fn arguments(text: &str) -> impl Iterator<Item = &str> {
    let mut open = 0;
    text.split(move |c| {
        open += i32::from(c == '(') - i32::from(c == ')');
        c == ',' && open == 0
    })
}

/// Without white space inside brackets: a pair in them, as in `major(shake, lift)`, is one word.
fn joined(text: &str) -> String {
    let mut open = 0;
    let keeps = |c: &char| {
        open += i32::from(*c == '(') - i32::from(*c == ')');
        open == 0 || !c.is_whitespace()
    };
    text.chars().filter(keeps).collect()
}

/// A requirement to stay away from a multiple of an input: `2 speed by 10%`.
fn away(study: &Study<Interpreted>, response: Response, text: &str) -> Result<Requirement> {
    let parsed = || {
        let (what, fraction) = text.split_once(" by ")?;
        let number = |text: &str| text.trim().parse::<f64>().ok();
        let fraction = percentage(fraction).or_else(|| number(fraction))?;
        match what.trim().split_once(' ') {
            Some((order, name)) => Some((number(order)?, name.trim(), fraction)),
            None => Some((1.0, what.trim(), fraction)),
        }
    };
    let Some((order, name, fraction)) = parsed() else {
        let help = "write an input, perhaps a multiple of it, and a fraction: `away from 2 speed by 10%`";
        return wrong(format!("`{text}` is no multiple of an input"), help);
    };
    Ok(Requirement::Away { response, input: study.find_input(name)?.any(), order, fraction })
}

/// The response that a text names: `frequency 1`, modes counted from 1, or the name of an output.
///
/// # Errors
/// [`WantedError`].
pub fn response(study: &Study<Interpreted>, text: &str) -> Result<Response> {
    let joined = joined(text);
    let words: Vec<&str> = joined.split_whitespace().collect();
    let mode = |word: &str| match word.parse::<usize>() {
        Ok(0) => wrong("there is no mode 0", "modes are counted from 1: `frequency 1`"),
        Ok(number) => Ok(number - 1),
        Err(_) => no(text.trim(), "a response"),
    };
    // Which event is the first must not depend on the direction in which the range is written.
    let crossing = |number: &str, condition, range: Range| {
        let (low, high) = (range.low.min(range.high), range.low.max(range.high));
        Ok(Response::Crossing { mode: mode(number)?, condition, range: Range::new(range.input, low, high) })
    };
    match words[..] {
        ["critical", along] => Ok(Response::Critical(range(study, along)?)),
        ["flutter", of, along] => crossing(of, Condition::FlutterOnset, range(study, along)?),
        ["resonance", of, along, ref more @ ..] => {
            let order = match *more {
                [] => Some(1.0),
                ["order", order] => order.parse().ok(),
                _ => None,
            };
            let (Some(order), range) = (order, range(study, along)?) else {
                return no(text.trim(), "a response");
            };
            crossing(of, Condition::Line(Line::from(multiple(order, &range, study)?)), range)
        }
        [what @ ("vibration" | "peak" | "velocity" | "acceleration"), _, ..] => {
            let (mut vibration, along) = clauses(study, text.trim(), &words[1..])?;
            match what {
                "velocity" => vibration.measure = Measure::Velocity,
                "acceleration" => vibration.measure = Measure::Acceleration,
                _ => {}
            }
            match (what, along) {
                ("peak", Some(range)) => Ok(Response::Peak { vibration, range, quantity: PeakQuantity::Place }),
                ("peak", None) => no(text.trim(), "a response"),
                (_, None) => Ok(Response::Vibration(vibration)),
                (_, Some(range)) => Ok(Response::Peak { vibration, range, quantity: PeakQuantity::Height }),
            }
        }
        ["output", name] | [name] => Ok(Response::Output(output(study, name)?)),
        [name, of] => match quantity(name) {
            Some(quantity) => Ok(Response::Mode { mode: mode(of)?, quantity }),
            None => no(text.trim(), "a response"),
        },
        _ => no(text.trim(), "a response"),
    }
}

fn quantity(name: &str) -> Option<Quantity> {
    Some(match name {
        "frequency" => Quantity::Frequency,
        "natural_frequency" => Quantity::NaturalFrequency,
        "damping_ratio" => Quantity::DampingRatio,
        "growth" => Quantity::Growth,
        "log_decrement" => Quantity::LogDecrement,
        _ => return None,
    })
}

/// The vibration that a text names: `shake`, `shake under u`, `shake under u as velocity`.
///
/// # Errors
/// [`WantedError`].
pub fn vibration(study: &Study<Interpreted>, text: &str) -> Result<Vibration> {
    let joined = joined(text);
    let words: Vec<&str> = joined.split_whitespace().collect();
    match clauses(study, text, words.strip_prefix(&["vibration"]).unwrap_or(&words))? {
        (vibration, None) => Ok(vibration),
        (_, Some(_)) => no(text, "a vibration at one operating point"),
    }
}

/// An output with the excitation, the measure and the range that may follow it.
fn clauses(study: &Study<Interpreted>, text: &str, words: &[&str]) -> Result<(Vibration, Option<Range>)> {
    let Some((name, more)) = words.split_first() else {
        return no(text, "a vibration");
    };
    let (mut under, mut measure, mut along) = (None, Measure::Displacement, None);
    let (output, mut extent) = extent(study, name)?;
    for clause in more.chunk_by(|_, word| !matches!(*word, "under" | "as" | "along")) {
        match *clause {
            ["under", ref names @ ..] if !names.is_empty() => under = Some(names.join(" ")),
            ["as", "rms"] if extent == Extent::Amplitude => extent = Extent::Rms,
            ["as", "displacement"] => measure = Measure::Displacement,
            ["as", "velocity"] => measure = Measure::Velocity,
            ["as", "acceleration"] => measure = Measure::Acceleration,
            ["along", input] => along = Some(range(study, input)?),
            _ => return no(text, "a vibration"),
        }
    }
    // An excitation may have this name.
    let all = under.as_deref() == Some("all") && study.find_excitation("all").is_err();
    let excitation = match (all, extent) {
        (true, Extent::Amplitude | Extent::Rms) => {
            if extent == Extent::Amplitude {
                extent = Extent::Sum;
            }
            excitation(study, study.description().excitations.first().map(|first| &*first.name))?
        }
        (true, _) => return wrong("an orbit belongs to one frequency", "say under which excitation"),
        (false, Extent::Rms) => return wrong("`as rms` is of all excitations", "write `under all as rms`"),
        (false, _) => excitation(study, under.as_deref())?,
    };
    Ok((Vibration { output, excitation, measure, extent }, along))
}

/// An output, or a semi-axis of the orbit of two: `shake`, `major(shake,lift)`.
fn extent(study: &Study<Interpreted>, name: &str) -> Result<(Output, Extent)> {
    type Axis = fn(Output) -> Extent;
    let axes: [(&str, Axis); 2] = [("major(", Extent::Major), ("minor(", Extent::Minor)];
    let axis = axes.into_iter().find_map(|(word, of)| Some((name.strip_prefix(word)?.strip_suffix(')')?, of)));
    match axis.map(|(inside, of)| (inside.split_once(','), of)) {
        None => Ok((output(study, name)?, Extent::Amplitude)),
        Some((Some((x, y)), of)) => Ok((output(study, x)?, of(output(study, y)?))),
        Some((None, _)) => {
            wrong(format!("`{name}` is not an axis of an orbit"), "name two outputs: `major(shake, lift)`")
        }
    }
}

/// The output of this name.
///
/// # Errors
/// [`WantedError::Name`].
pub fn output(study: &Study<Interpreted>, name: &str) -> Result<Output> {
    Ok(study.find_output(name)?.any())
}

/// The excitation with a name, or the first of several that act together, as results name them: `u, v`. Without a name the
/// first, if all have one frequency.
///
/// # Errors
/// [`WantedError`].
pub fn excitation(study: &Study<Interpreted>, under: Option<&str>) -> Result<Excitation> {
    let all = &study.description().excitations;
    match under {
        Some(under) => {
            let named = under.split(',').map(|name| study.find_excitation(name.trim()));
            let named: Vec<_> = named.collect::<core::result::Result<_, _>>()?;
            let with = |excitation: &Excitation<Interpreted>| all[excitation.index()].with;
            if named.iter().all(|other| with(other) == with(&named[0])) {
                Ok(named[0].any())
            } else {
                wrong(format!("`{under}` act with different frequencies"), "name one of them")
            }
        }
        None if all.is_empty() => {
            let help = "declare one: `unbalance u: on disk, amount: 20 g*mm;`, a `harmonic` force or a `shaken` joint";
            wrong("nothing excites a vibration", help)
        }
        None if all.iter().all(|info| info.with == 0) => Ok(Excitation::new(0)),
        None => {
            let names: Vec<&str> = all.iter().map(|info| &*info.name).collect();
            let help = format!("say under which: {}", names.join(", "));
            wrong("the excitations have several frequencies", help)
        }
    }
}

/// The range of an input that a text gives: `speed=0..6000rpm`.
///
/// # Errors
/// [`WantedError`].
pub fn range(study: &Study<Interpreted>, text: &str) -> Result<Range> {
    let (name, ends) = name_and_ends(text, "an input", "speed=0..6000rpm")?;
    let input = study.find_input(name)?;
    let [low, high] = in_si(text, name, ends, &study.description().inputs[input.index()].unit)?;
    Ok(Range::new(input.any(), low, high))
}

/// Reads a range of a design variable: `bearing=1..100MN/m`, SI.
///
/// # Errors
/// As [`range`].
pub fn design_range(study: &Study<Interpreted>, text: &str) -> Result<(DesignVariable<Interpreted>, [f64; 2])> {
    let (name, ends) = name_and_ends(text, "a design variable", "bearing=1..100MN/m")?;
    let design = study.find_design(name)?;
    let ends = in_si(text, name, ends, &study.description().design[design.index()].unit)?;
    Ok((design, ends))
}

fn name_and_ends<'a>(text: &'a str, what: &str, example: &str) -> Result<(&'a str, [&'a str; 2])> {
    let parts = text.split_once('=').and_then(|(name, range)| Some((name.trim(), range.split_once("..")?)));
    let Some((name, (low, high))) = parts else {
        return wrong(format!("`{text}` is not a range"), format!("write a range of {what} as `{example}`"));
    };
    let end = example.rsplit("..").next().unwrap_or_default();
    for (given, what, instead) in [(low, "start", format!("0..{high}")), (high, "end", format!("{low}..{end}"))] {
        if given.trim().is_empty() {
            return wrong(format!("the range `{text}` has no {what}"), format!("write `{name}={instead}`"));
        }
    }
    Ok((name, [low, high]))
}

fn in_si(text: &str, name: &str, [low, high]: [&str; 2], unit: &Unit) -> Result<[f64; 2]> {
    let end = |end: &str| {
        let place = || format!("sweep {text}");
        value(end, unit, &format!("`{name}`")).map_err(|mistakes| WantedError::Value { place: place(), mistakes })
    };
    Ok([end(&with_unit_of(low, high))?, end(high)?])
}

/// Requires an order to be a multiple of the input with which a mode can oscillate somewhere in a range.
///
/// # Errors
/// [`WantedError::Meaning`].
pub fn multiple(order: f64, range: &Range, study: &Study<Interpreted>) -> Result<f64> {
    let info = &study.description().inputs[range.input.index()];
    let name = &info.name;
    if value("1 rad/s", &info.unit, name).is_err() {
        let message = format!(
            "an engine order is a multiple of a speed of rotation or a frequency, and `{name}` is in {}",
            match &*info.unit.symbol {
                "" => "pure numbers",
                symbol => symbol,
            }
        );
        return wrong(message, "leave the order out, or sweep an input in rpm, rad/s or Hz");
    }
    let help = match order {
        0.0 => "order 1 is once per revolution",
        order if !order.is_finite() => "give a finite number, such as order 1",
        order if order < 0.0 && range.low.min(range.high) >= 0.0 => {
            "an excitation has a positive frequency, as order 1 has"
        }
        _ => return Ok(order),
    };
    wrong(format!("order {order} crosses no mode"), help)
}

/// Orders without repetitions. Where a range has negative speeds, an order is a multiple of their amount: it has the line of
/// the negative order too.
///
/// # Errors
/// As [`multiple`].
pub fn orders(study: &Study<Interpreted>, range: &Range, given: &[f64]) -> Result<Vec<f64>> {
    let mut orders = Vec::new();
    for &order in given {
        let order = multiple(order, range, study)?;
        for line in [order, -order] {
            let meets = |end: f64| line * end > 0.0;
            if !orders.contains(&line) && (meets(range.low) || meets(range.high)) {
                orders.push(line);
            }
        }
    }
    Ok(orders)
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Whether an expression names an input. A word that is a unit stays one.
fn names(text: &str, input: &str) -> bool {
    units::find(input).is_none() && text.split(|c| !is_word(c)).any(|word| word == input)
}

/// A limit with the values of the inputs in place of their names: `25.4 um * sqrt(12000 rpm / speed)`.
///
/// # Errors
/// The limit along an input names that input.
fn at_inputs(study: &Study<Interpreted>, text: &str, varied: Option<Input>) -> Result<String> {
    let inputs = &study.description().inputs;
    if let Some(own) = varied.map(|varied| &*inputs[varied.index()].name).filter(|own| names(text, own)) {
        let help = "state it at one value, or give a number";
        return wrong(
            format!("`{own}` varies in this range: a limit that depends on it holds at one value only"),
            help,
        );
    }
    let all = inputs.iter().zip(study.input_values());
    let parts = text.split_inclusive(|c| !is_word(c)).map(|part| {
        let (word, rest) = part.split_at(part.trim_end_matches(|c| !is_word(c)).len());
        match all.clone().find(|(info, _)| *info.name == *word && names(word, word)) {
            Some((info, value)) => format!("({:e} {}){rest}", info.unit.from_si(*value), info.unit.symbol),
            None => part.to_owned(),
        }
    });
    Ok(parts.collect())
}

/// A vibration over its limit along the input that sets its frequency, which a power of that input is: `25.4 um *
/// sqrt(12000 rpm / speed)`.
///
/// # Errors
/// A limit that is none, and a frequency that is no multiple of the input.
fn along_limit(study: &Study<Interpreted>, vibration: Vibration, range: Range, text: &str) -> Result<Vibration> {
    let info = &study.description().inputs[range.input.index()];
    let response = Response::Vibration(vibration);
    let unit = response.unit(study.description());
    // The frequency, what the limit leaves of the output itself, and the input.
    let at = |share: f64| -> Result<[f64; 3]> {
        let u = range.low + share * (range.high - range.low);
        let there = study.clone().input(Input::new(range.input.index()), u);
        let limit = limit_of(&response, &at_inputs(&there, text, None)?, &unit, "the vibration", "<=")?;
        let w = there.forced_response()?.harmonic(vibration.excitation).map_or(f64::NAN, |harmonic| harmonic.frequency);
        Ok([w, limit / vibration.measure.of(w, 1.0.into()).norm(), u.abs()])
    };
    let ([w, limit, u], middle) = (at(1.0)?, at(0.5)?);
    let power = (middle[1] / limit).ln() / (middle[0] / w).ln();
    let follows = |there: [f64; 3]| {
        let close = |a: f64, b: f64| (a - b).abs() <= ROUNDING * b.abs();
        close(there[1], limit * (there[0] / w).powf(power)) && close(there[0] / there[2], w / u)
    };
    if !is_of_all(vibration) && follows(at(0.6)?) && follows(at(0.9)?) {
        return Ok(vibration.measure(Measure::OfLimit { limit: limit / w.powf(power), power }));
    }
    let name = &info.name;
    let help = format!(
        "write a power of it, such as `25.4 um * sqrt(12000 rpm / {name})`, for a vibration whose frequency is a multiple of it"
    );
    wrong(format!("`{name}` varies in this range, and this limit does not follow a power of it"), help)
}

/// Relative error of a limit that rounding explains.
const ROUNDING: f64 = 1e-9;

/// What all excitations do together, as root of the mean square if that is how its limit is stated.
fn rms_of_all(response: Response, limit: &str) -> (Response, &str) {
    let as_rms = |vibration: Vibration| vibration.extent(Extent::Rms);
    match (response, limit.strip_suffix(" rms")) {
        (Response::Vibration(own), Some(limit)) if is_of_all(own) => (Response::Vibration(as_rms(own)), limit),
        (Response::Peak { vibration, range, quantity }, Some(limit)) if is_of_all(vibration) => {
            (Response::Peak { vibration: as_rms(vibration), range, quantity }, limit)
        }
        _ => (response, limit),
    }
}

fn is_of_all(vibration: Vibration) -> bool {
    matches!(vibration.extent, Extent::Sum | Extent::Rms)
}

/// Words behind a limit of a vibration, and the amplitude from 0 to peak of what they count as one.
const MEASURED: [(&str, f64); 5] = [("rms", SQRT_2), ("p-p", 0.5), ("pp", 0.5), ("peak to peak", 0.5), ("0-p", 1.0)];

/// A limit as it is written, that of a vibration as the standards state it: `4.5 mm/s rms`, `60 um p-p`.
fn limit_of(response: &Response, text: &str, unit: &Unit, what: &str, word: &str) -> Result<f64> {
    let is_amplitude = match response {
        Response::Vibration(vibration) | Response::Peak { vibration, quantity: PeakQuantity::Height, .. } => {
            vibration.extent != Extent::Rms
        }
        _ => false,
    };
    let measured = MEASURED.iter().filter(|_| is_amplitude).find_map(|&(word, amplitude)| {
        let text = text.trim().strip_suffix(word)?;
        text.ends_with(char::is_whitespace).then_some((text, amplitude))
    });
    let (text, amplitude) = measured.unwrap_or((text, 1.0));
    Ok(amplitude * read(text, unit, what, word)?)
}

fn read(text: &str, unit: &Unit, what: &str, word: &str) -> Result<f64> {
    let place = || format!("{what} {word} {}", text.trim());
    value(text.trim(), unit, &format!("`{what}`")).map_err(|mistakes| WantedError::Value { place: place(), mistakes })
}

/// The low end of a range with the unit of the high end, unless it has one.
#[must_use]
pub fn with_unit_of(low: &str, high: &str) -> String {
    if low.trim().parse::<f64>().is_err() {
        return low.to_owned();
    }
    let ends = (1..=high.len()).rev().filter(|&end| high.is_char_boundary(end));
    let number = ends.into_iter().find(|&end| high[..end].trim().parse::<f64>().is_ok()).unwrap_or(0);
    format!("{low} {}", &high[number..])
}
