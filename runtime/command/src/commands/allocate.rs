//! The cheapest tolerances that meet requirements.

use clap::Args;
use eigentol::allocation::{Choices, Cost, HalfWidth, Nominal};
use eigentol::requirement::Requirement;
use eigentol::response::Response;
use eigentol::{Parameter, Study};
use eigentol::{Quantity, Unit};
use eigentol_interpreter::Interpreted;

use crate::failure::Failure;
use crate::output::Output;
use crate::point::{Point, Question, design, parameter, unknown, whole, written};
use crate::progress;
use crate::study_file::{self, Choose, Require, Written};
use crate::verdict::Verdict;

/// The cheapest tolerances that meet requirements; a study file says what is required and what may be chosen
#[derive(Args, Debug)]
pub(crate) struct Allocate {
    #[command(flatten)]
    point: Point,
    /// Samples that check the result [default: 3000]
    #[arg(long, value_name = "COUNT", value_parser = whole)]
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
            .samples(self.samples.or(file.samples).unwrap_or(3000))
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
    let (response, unit) = match (own.stable, own.mode, &own.output) {
        (true, None, None) => return Ok(Requirement::Stable),
        (false, Some(mode), None) => {
            let quantity = own.quantity.into();
            let mode = mode
                .checked_sub(1)
                .ok_or_else(|| Failure::usage("there is no mode 0", "modes are counted from 1"))?;
            (Response::Mode { mode, quantity }, unit_of(quantity))
        }
        (false, None, Some(name)) => output(study, name)?,
        _ => {
            let help = "a requirement is about `mode = 1`, `output = \"name\"` or `stable = true`";
            let message = "a requirement is about one thing";
            return Err(Failure::usage(message, help));
        }
    };
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

fn output(study: &Study<Interpreted>, name: &str) -> Result<(Response, Unit), Failure> {
    let all = &study.description().outputs;
    match study.find_output(name) {
        Ok(found) => Ok((
            Response::Output(found.any()),
            all[found.index()].unit.clone(),
        )),
        Err(_) => {
            let known = all.iter().map(|info| &info.name);
            Err(unknown(study.description(), "output", name, known))
        }
    }
}

fn unit_of(quantity: Quantity) -> Unit {
    let symbol = match quantity {
        Quantity::DampingRatio => "1",
        Quantity::Growth => "1/s",
        _ => "rad/s",
    };
    Unit {
        symbol: symbol.to_owned().into(),
        scale: 1.0,
    }
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

/// Position among the design variables, tolerances of inputs after them.
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
            let help = format!("give `{name}` any tolerance, which says how it is distributed");
            Failure::usage(format!("`{name}` has no tolerance"), help)
        })
}
