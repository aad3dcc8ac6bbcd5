//! Requirements on a design, from a study file or the command line.

use eigentol::forced::Measure;
use eigentol::peaks::PeakQuantity;
use eigentol::requirement::Requirement;
use eigentol::response::{Response, Vibration};
use eigentol::sweep::{Condition, Line, Range};
use eigentol::{Excitation, Output, Quantity, Study};
use eigentol_interpreter::Interpreted;

use crate::ends::with_unit_of;
use crate::failure::Failure;
use crate::point::{input, unknown, written};
use crate::study_file::{self, Require, Written};
use crate::sweep::{multiple, range};

/// The keys of a study file that state requirements.
macro_rules! require_keys {
    () => {
        r#"  [[require]]                    # once for each requirement
  failure = 0.001                # greatest probability of violating it
  at_least = "59 rad/s"          # and, or instead, at_most; or outside = ["4 Hz", "5 Hz"]; or, of a multiple of an input,
                                 # away_from = "2 speed by 10%"
                                 # of one of these:
  mode = 1                       #   a mode, counted from 1; its quantity is "frequency", "natural_frequency",
  quantity = "frequency"         #   "damping_ratio" or "growth"
  output = "angle"               #   an output of the declaration
  vibration = "shake"            #   the amplitude, 0 to peak, of an output under excitations; under = "u" names one of
                                 #   them if they have several frequencies; measure = "velocity" or "acceleration";
                                 #   along = "speed=0..6000rpm" is the greatest amplitude in that range,
                                 #   peak = "speed=0..6000rpm" the speed at its highest peak there
  critical = "speed=0..6000rpm"  #   the speed at which the equilibrium loses its stiffness
  resonance = "speed=0..6000rpm" #   with mode: the lowest speed at which its frequency is order (1) times the speed
  order = 1
  flutter = "speed=0..6000rpm"   #   with mode: the lowest speed at which it begins or ceases to grow
  stable = true                  #   the equilibrium is stable; without limits"#
    };
}
pub(crate) use require_keys;

/// The syntax of a requirement on the command line.
pub(crate) const HELP: &str = "write what, and its limit: `frequency 1 >= 20 Hz`, `damping_ratio 2 >= 0.05`, `growth 1 <= 0`, `vibration shake under u <= 0.1 mm`, \
                               `vibration shake along speed=0..6000rpm <= 0.1 mm`, `peak shake along speed=0..6000rpm away from speed by 15%`, \
                               `angle <= 5 deg`, `frequency 1 outside 4..5 Hz`, `frequency 1 away from 2 speed by 10%`, `critical speed=0..6000rpm >= 3000 rpm`, or `stable`";

/// Parses a requirement as written on the command line.
pub(crate) fn parsed(text: &str) -> Result<Require, String> {
    let mut require = Require::default();
    let refused = || format!("`{text}` is not a requirement: {HELP}");
    if text.trim() == "stable" {
        require.stable = true;
        return Ok(require);
    }
    let limits = [">=", "<=", ">", "<", " outside ", " within ", " away from "];
    let split = limits.into_iter().find_map(|word| {
        let (what, limit) = text.split_once(word)?;
        Some((what, word.trim(), limit.trim()))
    });
    let (what, word, limit) = split.ok_or_else(refused)?;
    let written = |text: &str| Written::Text(text.trim().to_owned());
    let ends = || limit.split_once("..").ok_or_else(refused);
    match word {
        ">=" | ">" => require.at_least = Some(written(limit)),
        "<=" | "<" => require.at_most = Some(written(limit)),
        "away from" => require.away_from = Some(limit.to_owned()),
        _ => {
            let (low, high) = ends()?;
            let (low, high) = (written(&with_unit_of(low, high)), written(high));
            match word {
                "outside" => require.outside = Some([low, high]),
                _ => (require.at_least, require.at_most) = (Some(low), Some(high)),
            }
        }
    }
    let words: Vec<&str> = what.split_whitespace().collect();
    let mode = |text: &str| text.parse().map_err(|_| refused());
    match words[..] {
        ["critical", along] => require.critical = Some(along.to_owned()),
        ["resonance", of, along] => {
            (require.mode, require.resonance) = (Some(mode(of)?), Some(along.to_owned()));
        }
        ["flutter", of, along] => {
            (require.mode, require.flutter) = (Some(mode(of)?), Some(along.to_owned()));
        }
        [what @ ("vibration" | "peak"), name, ref more @ ..] => {
            require.vibration = Some(name.to_owned());
            let (under, range) = match *more {
                [] => (None, None),
                ["under", under] => (Some(under), None),
                ["along", range] => (None, Some(range)),
                ["under", under, "along", range] => (Some(under), Some(range)),
                _ => return Err(refused()),
            };
            require.under = under.map(str::to_owned);
            let range = range.map(str::to_owned);
            match what {
                "vibration" => require.along = range,
                _ => require.peak = Some(range.ok_or_else(refused)?),
            }
        }
        [quantity, of] if study_file::Quantity::named(quantity).is_some() => {
            (require.mode, require.quantity) = (Some(mode(of)?), study_file::Quantity::named(quantity));
        }
        ["output", name] | [name] => require.output = Some(name.to_owned()),
        _ => return Err(refused()),
    }
    Ok(require)
}

/// The requirements of a study file or a command line.
pub(crate) fn requirements(study: &Study<Interpreted>, all: &[Require]) -> Result<Vec<Requirement>, Failure> {
    all.iter().map(|x| requirement(study, x)).collect()
}

fn requirement(study: &Study<Interpreted>, require: &Require) -> Result<Requirement, Failure> {
    all_used(require)?;
    if require.stable && !about_a_number(require) {
        return Ok(Requirement::Stable);
    }
    let response = response(study, require)?;
    let unit = response.unit(study.description());
    let read = |label: &str, text: &Written| written(label, text, &unit);
    if let Some(text) = &require.away_from {
        return away(study, response, text);
    }
    match (&require.at_least, &require.at_most, &require.outside) {
        (None, None, Some([low, high])) => {
            Ok(Requirement::Outside { response, low: read("outside", low)?, high: read("outside", high)? })
        }
        (None, None, None) | (_, _, Some(_)) => Err(Failure::usage(
            "a requirement has limits",
            "give `at_least`, `at_most` or both, or a forbidden band: `outside = [\"4 Hz\", \"5 Hz\"]`",
        )),
        (low, high, None) => Ok(Requirement::Within {
            response,
            low: low.as_ref().map_or(Ok(f64::NEG_INFINITY), |text| read("at_least", text))?,
            high: high.as_ref().map_or(Ok(f64::INFINITY), |text| read("at_most", text))?,
        }),
    }
}

/// A requirement to stay away from a multiple of an input: `2 speed by 10%`.
fn away(study: &Study<Interpreted>, response: Response, text: &str) -> Result<Requirement, Failure> {
    let refused = || {
        let help = "write an input, perhaps a multiple of it, and a fraction: `away_from = \"2 speed by 10%\"`";
        Failure::usage(format!("`{text}` is no multiple of an input"), help)
    };
    let number = |text: &str| text.trim().parse::<f64>().map_err(|_| refused());
    let (what, fraction) = text.split_once(" by ").ok_or_else(refused)?;
    let fraction = match fraction.trim().strip_suffix('%') {
        Some(percent) => number(percent)? / 100.0,
        None => number(fraction)?,
    };
    let (order, name) = match what.trim().split_once(' ') {
        Some((order, name)) => (number(order)?, name.trim()),
        None => (1.0, what.trim()),
    };
    let (input, _) = input(study, name)?;
    Ok(Requirement::Away { response, input: input.any(), order, fraction })
}

/// Rejects settings that would have no effect in this requirement.
fn all_used(require: &Require) -> Result<(), Failure> {
    let ends = require.at_least.is_some() || require.at_most.is_some() || require.outside.is_some();
    let limited = ends || require.away_from.is_some();
    let elsewhere = [&require.output, &require.vibration, &require.critical, &require.resonance, &require.flutter];
    let of_a_mode = require.mode.is_some() && elsewhere.iter().all(|text| text.is_none());
    let refuse = |message: &str, help: &str| Err(Failure::usage(message, help));
    if require.order.is_some() && require.resonance.is_none() {
        let help = "`order` goes with `resonance = \"speed=0..6000rpm\"`: the excitation frequency is this many times the input";
        return refuse("`order` belongs to a resonance", help);
    }
    if require.vibration.is_none() && (require.under.is_some() || require.measure.is_some()) {
        let help = "`under` and `measure` go with `vibration = \"output\"`";
        return refuse("`under` and `measure` belong to a vibration", help);
    }
    if require.vibration.is_none() && (require.along.is_some() || require.peak.is_some()) {
        let help = "`along` and `peak` go with `vibration = \"output\"`";
        return refuse("`along` and `peak` belong to a vibration", help);
    }
    if require.along.is_some() && require.peak.is_some() {
        let help = "state another requirement for the other";
        return refuse("`along` asks for an amplitude and `peak` for a speed", help);
    }
    if require.quantity.is_some() && !of_a_mode {
        let help = "`quantity` goes with `mode = 1` alone, at the operating point";
        return refuse("`quantity` belongs to a mode", help);
    }
    if ends && require.away_from.is_some() {
        let help = "state another requirement for the other limits";
        return refuse("`away_from` takes no further limits", help);
    }
    if require.stable && limited {
        let help = "`stable = true` takes `failure` and nothing else";
        return refuse("`stable` takes no limits", help);
    }
    Ok(())
}

fn about_a_number(require: &Require) -> bool {
    let texts = [&require.output, &require.vibration, &require.critical, &require.resonance, &require.flutter];
    require.mode.is_some() || texts.into_iter().any(Option::is_some)
}

fn response(study: &Study<Interpreted>, require: &Require) -> Result<Response, Failure> {
    let mode = || {
        let help = "modes are counted from 1: `mode = 1`";
        let index = require.mode.and_then(|mode| mode.checked_sub(1));
        index.ok_or_else(|| Failure::usage("there is no such mode", help))
    };
    let along = |text: &str| {
        let interval = range(study, text)?;
        Ok::<_, Failure>(Range::new(interval.input.any(), interval.low, interval.high))
    };
    // Which event is the first must not depend on the direction in which the range is written.
    let crossing = |condition, text: &str| {
        let mode = mode()?;
        let interval = range(study, text)?;
        let (low, high) = (interval.low.min(interval.high), interval.low.max(interval.high));
        Ok(Response::Crossing { mode, condition, range: Range::new(interval.input.any(), low, high) })
    };
    let stated = [&require.output, &require.critical, &require.resonance, &require.flutter];
    if let Some(name) = &require.vibration
        && require.mode.is_none()
        && !require.stable
        && stated.into_iter().all(Option::is_none)
    {
        let vibration = vibration(study, name, require)?;
        let (text, quantity) = match (&require.along, &require.peak) {
            (None, None) => return Ok(Response::Vibration(vibration)),
            (Some(text), _) => (text, PeakQuantity::Height),
            (_, Some(text)) => (text, PeakQuantity::Place),
        };
        return Ok(Response::Peak { vibration, range: along(text)?, quantity });
    }
    match (&require.output, &require.critical, &require.resonance, &require.flutter) {
        _ if require.stable || require.vibration.is_some() => {}
        (None, None, None, None) if require.mode.is_some() => {
            let quantity = require.quantity.map_or(Quantity::Frequency, Quantity::from);
            return Ok(Response::Mode { mode: mode()?, quantity });
        }
        (Some(name), None, None, None) if require.mode.is_none() => {
            return output(study, name).map(Response::Output);
        }
        (None, Some(text), None, None) if require.mode.is_none() => {
            return Ok(Response::Critical(along(text)?));
        }
        (None, None, Some(text), None) => {
            let order = multiple(require.order.unwrap_or(1.0), &range(study, text)?, study)?;
            return crossing(Condition::Line(Line::from(order)), text);
        }
        (None, None, None, Some(text)) => return crossing(Condition::FlutterOnset, text),
        _ => {}
    }
    Err(Failure::usage(
        "a requirement states one thing",
        "it is `mode = 1`, `output = \"name\"`, `vibration = \"name\"`, `critical = \"speed=0..6000rpm\"`, `resonance` or `flutter` of a `mode` along such a \
         range, or `stable = true`",
    ))
}

/// The vibration written as `shake` or `shake under u`.
pub(crate) fn named_vibration(study: &Study<Interpreted>, text: &str) -> Result<Vibration, Failure> {
    let (name, under) = match text.split_once(" under ") {
        Some((name, under)) => (name, Some(under.trim().to_owned())),
        None => (text, None),
    };
    let require = Require { under, ..Require::default() };
    vibration(study, name.trim(), &require)
}

/// The orbit written as `shake,lift` or `shake,lift under u`.
pub(crate) fn named_orbit(study: &Study<Interpreted>, text: &str) -> Result<([Output; 2], Excitation), Failure> {
    let (pair, under) = match text.split_once(" under ") {
        Some((pair, under)) => (pair, Some(under.trim())),
        None => (text, None),
    };
    Ok((named_pair(study, pair)?, excitation(study, under)?))
}

/// The two outputs of an orbit written as `shake,lift`.
pub(crate) fn named_pair(study: &Study<Interpreted>, text: &str) -> Result<[Output; 2], Failure> {
    match text.split_once(',') {
        Some((x, y)) => Ok([output(study, x.trim())?, output(study, y.trim())?]),
        None => {
            let message = format!("`{text}` is no pair of outputs");
            Err(Failure::usage(message, "write `--orbit shake,lift`"))
        }
    }
}

/// The amplitude of an output under one of the excitations.
fn vibration(study: &Study<Interpreted>, name: &str, require: &Require) -> Result<Vibration, Failure> {
    Ok(Vibration {
        output: output(study, name)?,
        excitation: excitation(study, require.under.as_deref())?,
        measure: match require.measure {
            None | Some(study_file::Measure::Displacement) => Measure::Displacement,
            Some(study_file::Measure::Velocity) => Measure::Velocity,
            Some(study_file::Measure::Acceleration) => Measure::Acceleration,
        },
    })
}

/// The excitation with a name, or the first of several that act together, as results name them: `u, v`. Without a name the
/// first, if all have one frequency.
fn excitation(study: &Study<Interpreted>, under: Option<&str>) -> Result<Excitation, Failure> {
    let d = study.description();
    let known = d.excitations.iter().map(|info| &info.name);
    match under {
        Some(under) => {
            let mut names = under.split(',').map(str::trim);
            let index = |name: &str| {
                let found = d.excitations.iter().position(|info| info.name == *name);
                found.ok_or_else(|| unknown(d, "excitation", name, known.clone()))
            };
            let first = index(names.next().unwrap_or_default())?;
            for name in names {
                let other = index(name)?;
                if d.excitations[other].with != d.excitations[first].with {
                    let message = format!("`{under}` act with different frequencies");
                    return Err(Failure::usage(message, "name one of them"));
                }
            }
            Ok(Excitation::new(first))
        }
        None if d.excitations.is_empty() => {
            let help = "declare one: `unbalance u: on disk, amount: 20 g*mm;`, a `harmonic` force or a `shaken` joint";
            Err(Failure::usage("nothing excites a vibration", help))
        }
        None if d.excitations.iter().all(|info| info.with == 0) => Ok(Excitation::new(0)),
        None => {
            let names: Vec<&str> = known.map(|name| &**name).collect();
            let help = format!("say under which: {}", names.join(", "));
            Err(Failure::usage("the excitations have several frequencies", help))
        }
    }
}

fn output(study: &Study<Interpreted>, name: &str) -> Result<Output, Failure> {
    let all = &study.description().outputs;
    study.find_output(name).map(|handle| handle.any()).map_err(|_| {
        let known = all.iter().map(|info| &info.name);
        unknown(study.description(), "output", name, known)
    })
}

impl From<study_file::Quantity> for Quantity {
    fn from(quantity: study_file::Quantity) -> Self {
        match quantity {
            study_file::Quantity::Frequency => Self::Frequency,
            study_file::Quantity::NaturalFrequency => Self::NaturalFrequency,
            study_file::Quantity::DampingRatio => Self::DampingRatio,
            study_file::Quantity::Growth => Self::Growth,
        }
    }
}
