//! Allocation of the cheapest tolerances that meet the requirements.

use clap::Args;
use eigentol::allocation::{Choices, Cost, HalfWidth, Nominal};
use eigentol::requirement::Requirement;
use eigentol::response::Response;
use eigentol::sweep::{Condition, Line, Range};
use eigentol::{Parameter, Quantity, Study, Unit};
use eigentol_interpreter::Interpreted;

use crate::failure::Failure;
use crate::output::Output;
use crate::point::{Point, Question, design, parameter, samples, unknown, whole, written};
use crate::progress;
use crate::study_file::{self, Choose, Require, Written};
use crate::sweep::{multiple, range};
use crate::verdict::Verdict;

/// The keys of a study file that this question needs.
const KEYS: &str = r#"The study file:
  [[require]]                    # once for each requirement
  failure = 0.001                # greatest probability of violating it
  at_least = "59 rad/s"          # and, or instead, at_most; or outside = ["4 Hz", "5 Hz"]
                                 # of one of these:
  mode = 1                       #   a mode, counted from 1; its quantity is "frequency", "natural_frequency",
  quantity = "frequency"         #   "damping_ratio" or "growth"
  output = "angle"               #   an output of the declaration
  critical = "speed=0..6000rpm"  #   the speed at which the equilibrium loses its stiffness
  resonance = "speed=0..6000rpm" #   with mode: the speed at which its frequency is order (1) times the speed
  order = 1
  flutter = "speed=0..6000rpm"   #   with mode: the speed at which it begins to grow
  stable = true                  #   the equilibrium is stable; without limits

  [[choose]]                     # once for each choice
  tolerance = "k"                # a half-width T with its cost; or nominal = "k", without a cost
  least = "0.4 N/mm"
  most = "12 N/mm"
  cost = { fixed = 0, factor = 1.0, power = 1 }   # fixed + factor / T^power, T in the declared unit

Other keys: mechanism, set, start, guess, tolerance, correlation, sigma_level, samples, seed, stream"#;

/// The cheapest tolerances that meet requirements; a study file states the requirements and the choices
#[derive(Args, Debug)]
#[command(after_long_help = KEYS)]
pub(crate) struct Allocate {
    #[command(flatten)]
    point: Point,
    /// Samples that check the result [default: 3000]
    #[arg(long, value_name = "COUNT", value_parser = whole, allow_negative_numbers = true)]
    samples: Option<usize>,
    #[command(flatten)]
    output: Output,
}

impl Allocate {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        let question = self.point.question()?;
        let Question { study, file, .. } = question;
        if file.require.is_empty() || file.choose.is_empty() {
            let help = "a study file has `[[require]]` and `[[choose]]`: `eigentol help allocate`";
            let message = "nothing is required, or nothing may be chosen";
            return Err(Failure::usage(message, help));
        }
        let bar = progress::bar("choices and samples", None);
        let study = progress::watched(study, &bar)
            .samples(samples(self.samples, &file)?)
            .seed(file.seed.unwrap_or(0))
            .stream(file.stream.unwrap_or(0));
        let wanted = file.require.iter().map(|own| requirement(&study, own));
        let wanted = wanted.collect::<Result<Vec<_>, _>>()?;
        let failure = file.require.iter().map(|own| own.failure).collect();
        let mut choices = Choices {
            half_widths: Vec::new(),
            nominals: Vec::new(),
            failure,
        };
        for choice in &file.choose {
            choose(&study, choice, &mut choices)?;
        }
        let found = study.allocation(&wanted, &choices)?;
        bar.finish_and_clear();
        let mut answer = self.output.answer();
        answer.add(&found)?;
        self.output.write(&answer)?;
        if found.stopped {
            let tried = found.evaluations;
            return Ok(Verdict::Stopped(format!(
                "after {tried} choices: there may be cheaper tolerances"
            )));
        }
        let (samples, planned) = (found.chances.all.samples(), found.chances.planned);
        if samples < planned {
            return Ok(Verdict::stopped(samples, planned, "samples"));
        }
        Ok(match found.refuted.first() {
            None => Verdict::Yes,
            Some(k) => Verdict::No(format!("samples refute requirement {}", k + 1)),
        })
    }
}

fn requirement(study: &Study<Interpreted>, own: &Require) -> Result<Requirement, Failure> {
    all_used(own)?;
    if own.stable && !about_a_number(own) {
        return Ok(Requirement::Stable);
    }
    let response = response(study, own)?;
    let unit = response.unit(study.description());
    let read = |place: &str, text: &Written| written(place, text, &unit);
    match (&own.at_least, &own.at_most, &own.outside) {
        (None, None, Some([low, high])) => Ok(Requirement::Outside {
            response,
            low: read("outside", low)?,
            high: read("outside", high)?,
        }),
        (None, None, None) | (_, _, Some(_)) => Err(Failure::usage(
            "a requirement has limits",
            "give `at_least`, `at_most` or both, or a forbidden band: `outside = [\"4 Hz\", \"5 Hz\"]`",
        )),
        (low, high, None) => Ok(Requirement::Within {
            response,
            low: low
                .as_ref()
                .map_or(Ok(f64::NEG_INFINITY), |text| read("at_least", text))?,
            high: high
                .as_ref()
                .map_or(Ok(f64::INFINITY), |text| read("at_most", text))?,
        }),
    }
}

/// Rejects settings that would have no effect in this requirement.
fn all_used(own: &Require) -> Result<(), Failure> {
    let limited = own.at_least.is_some() || own.at_most.is_some() || own.outside.is_some();
    let elsewhere = [&own.output, &own.critical, &own.resonance, &own.flutter];
    let of_a_mode = own.mode.is_some() && elsewhere.iter().all(|text| text.is_none());
    let refuse = |message: &str, help: &str| Err(Failure::usage(message, help));
    if own.order.is_some() && own.resonance.is_none() {
        let help = "`order` goes with `resonance = \"speed=0..6000rpm\"`: the excitation frequency is this many times the input";
        return refuse("`order` belongs to a resonance", help);
    }
    if own.quantity.is_some() && !of_a_mode {
        let help = "`quantity` goes with `mode = 1` alone, at the operating point";
        return refuse("`quantity` belongs to a mode", help);
    }
    if own.stable && limited {
        let help = "`stable = true` takes `failure` and nothing else";
        return refuse("`stable` takes no limits", help);
    }
    Ok(())
}

fn about_a_number(own: &Require) -> bool {
    let texts = [&own.output, &own.critical, &own.resonance, &own.flutter];
    own.mode.is_some() || texts.into_iter().any(Option::is_some)
}

fn response(study: &Study<Interpreted>, own: &Require) -> Result<Response, Failure> {
    let mode = || {
        let help = "modes are counted from 1: `mode = 1`";
        let place = own.mode.and_then(|mode| mode.checked_sub(1));
        place.ok_or_else(|| Failure::usage("there is no such mode", help))
    };
    let along = |text: &str| {
        let found = range(study, text)?;
        Ok::<_, Failure>(Range::new(found.input.any(), found.low, found.high))
    };
    let crossing = |condition, text: &str| {
        Ok(Response::Crossing {
            mode: mode()?,
            condition,
            range: along(text)?,
        })
    };
    match (&own.output, &own.critical, &own.resonance, &own.flutter) {
        _ if own.stable => {}
        (None, None, None, None) if own.mode.is_some() => {
            let quantity = own.quantity.map_or(Quantity::Frequency, Quantity::from);
            return Ok(Response::Mode {
                mode: mode()?,
                quantity,
            });
        }
        (Some(name), None, None, None) if own.mode.is_none() => return output(study, name),
        (None, Some(text), None, None) if own.mode.is_none() => {
            return Ok(Response::Critical(along(text)?));
        }
        (None, None, Some(text), None) => {
            let order = multiple(own.order.unwrap_or(1.0), &range(study, text)?, study)?;
            return crossing(Condition::Line(Line::from(order)), text);
        }
        (None, None, None, Some(text)) => return crossing(Condition::FlutterOnset, text),
        _ => {}
    }
    Err(Failure::usage(
        "a requirement states one thing",
        "it is `mode = 1`, `output = \"name\"`, `critical = \"speed=0..6000rpm\"`, `resonance` or `flutter` of a `mode` along such a \
         range, or `stable = true`",
    ))
}

fn output(study: &Study<Interpreted>, name: &str) -> Result<Response, Failure> {
    let all = &study.description().outputs;
    study
        .find_output(name)
        .map(|found| Response::Output(found.any()))
        .map_err(|_| {
            let known = all.iter().map(|info| &info.name);
            unknown(study.description(), "output", name, known)
        })
}

impl From<study_file::Quantity> for Quantity {
    fn from(own: study_file::Quantity) -> Self {
        match own {
            study_file::Quantity::Frequency => Self::Frequency,
            study_file::Quantity::NaturalFrequency => Self::NaturalFrequency,
            study_file::Quantity::DampingRatio => Self::DampingRatio,
            study_file::Quantity::Growth => Self::Growth,
        }
    }
}

fn choose(
    study: &Study<Interpreted>,
    own: &Choose,
    choices: &mut Choices<'_>,
) -> Result<(), Failure> {
    let limits = |unit: &Unit| -> Result<(f64, f64), Failure> {
        Ok((
            written("least", &own.least, unit)?,
            written("most", &own.most, unit)?,
        ))
    };
    match (&own.tolerance, &own.nominal, own.cost) {
        (Some(name), None, Some(cost)) => {
            let (parameter, unit) = parameter(study, name)?;
            let factor = cost.factor * unit.scale.powf(cost.power);
            choices.half_widths.push(HalfWidth {
                variable: place(study, name, parameter)?,
                limits: limits(&unit)?,
                cost: Cost::reciprocal(cost.fixed, factor, cost.power),
            });
        }
        (None, Some(name), None) => {
            let (variable, unit) = design(study, name)?;
            choices.nominals.push(Nominal {
                variable: variable.index(),
                limits: limits(&unit)?,
            });
        }
        _ => {
            let help = "write `tolerance = \"l\"` with a `cost`, or `nominal = \"l\"` without one";
            return Err(Failure::usage(
                "a choice is a tolerance or a nominal value",
                help,
            ));
        }
    }
    Ok(())
}

/// Index among the design variables, followed by the input tolerances.
fn place(
    study: &Study<Interpreted>,
    name: &str,
    parameter: Parameter<Interpreted>,
) -> Result<usize, Failure> {
    let input = match parameter {
        Parameter::Design(variable) => return Ok(variable.index()),
        Parameter::Input(input) => input,
    };
    let found = study
        .deviating_inputs()
        .iter()
        .position(|own| *own == input);
    found
        .map(|k| study.design_values().len() + k)
        .ok_or_else(|| {
            let help =
                format!("give `{name}` any tolerance: it says how the variable is distributed");
            Failure::usage(format!("`{name}` has no tolerance"), help)
        })
}
