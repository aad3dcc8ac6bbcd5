//! Allocation of the cheapest tolerances that meet the requirements.

use clap::Args;
use eigentol::allocation::{Choices, Cost, HalfWidth, Nominal};
use eigentol::{Parameter, Study, Unit};
use eigentol_interpreter::{Interpreted, design, parameter};

use crate::failure::Failure;
use crate::output::Output;
use crate::point::{Point, Question, samples, whole, written};
use crate::progress;
use crate::requirements::{require_keys, requirements};
use crate::study_file::Choose;
use crate::verdict::Verdict;

/// The keys of a study file that this question needs.
const KEYS: &str = concat!(
    "The study file:\n",
    require_keys!(),
    r#"

  [[choose]]                     # once for each choice
  tolerance = "k"                # a half-width T with its cost; or nominal = "k", without a cost
  least = "0.4 N/mm"
  most = "12 N/mm"
  cost = { fixed = 0, factor = 1.0, power = 1 }   # fixed + factor / T^power, T in the declared unit

Other keys: mechanism, set, start, guess, tolerance, correlation, sigma_level, samples, seed, stream"#
);

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
            let help = "a study file has `require = [..]` and `[[choose]]`: `eigentol help allocate`";
            let message = "nothing is required, or nothing may be chosen";
            return Err(Failure::usage(message, help));
        }
        let bar = progress::bar("choices and samples", None);
        let study = progress::watched(study, &bar)
            .samples(samples(self.samples, &file)?)
            .seed(file.seed.unwrap_or(0))
            .stream(file.stream.unwrap_or(0));
        let (wanted, allowed) = requirements(&study, &file.require, &file.allowed()?)?;
        let allowed = allowed.into_iter().enumerate().map(|(k, allowed)| {
            let help = "give the greatest probability of violating it: `failure = 0.001`";
            allowed.ok_or_else(|| Failure::usage(format!("requirement {} allows no failure", k + 1), help))
        });
        let failure = allowed.collect::<Result<Vec<_>, _>>()?;
        let mut choices = Choices { half_widths: Vec::new(), nominals: Vec::new(), failure };
        for choice in &file.choose {
            choose(&study, choice, &mut choices)?;
        }
        let allocation = study.allocation(&wanted, &choices)?;
        drop(bar);
        self.output.show(&allocation)?;
        if allocation.stopped {
            let tried = allocation.evaluations;
            return Ok(Verdict::Stopped(format!("after {tried} choices: there may be cheaper tolerances")));
        }
        let (samples, planned) = (allocation.chances.all.samples(), allocation.chances.planned);
        if samples < planned {
            return Ok(Verdict::stopped(samples, planned, "samples"));
        }
        Ok(match allocation.refuted.first() {
            None => Verdict::Yes,
            Some(k) => Verdict::No(format!("samples refute requirement {}", k + 1)),
        })
    }
}

fn choose(study: &Study<Interpreted>, choose: &Choose, choices: &mut Choices<'_>) -> Result<(), Failure> {
    let limits = |unit: &Unit| -> Result<(f64, f64), Failure> {
        Ok((written("least", &choose.least, unit)?, written("most", &choose.most, unit)?))
    };
    match (&choose.tolerance, &choose.nominal, choose.cost) {
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
            choices.nominals.push(Nominal { variable: variable.index(), limits: limits(&unit)? });
        }
        _ => {
            let help = "write `tolerance = \"l\"` with a `cost`, or `nominal = \"l\"` without one";
            return Err(Failure::usage("a choice is a tolerance or a nominal value", help));
        }
    }
    Ok(())
}

/// Index among the design variables, followed by the input tolerances.
fn place(study: &Study<Interpreted>, name: &str, parameter: Parameter<Interpreted>) -> Result<usize, Failure> {
    let input = match parameter {
        Parameter::Design(variable) => return Ok(variable.index()),
        Parameter::Input(input) => input,
    };
    let position = study.deviating_inputs().iter().position(|x| *x == input);
    position.map(|k| study.design_values().len() + k).ok_or_else(|| {
        let help = format!("give `{name}` any tolerance: it says how the variable is distributed");
        Failure::usage(format!("`{name}` has no tolerance"), help)
    })
}
