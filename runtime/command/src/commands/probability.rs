//! How probable it is that requirements are failed.

use clap::Args;
use eigentol::judge;
use eigentol::requirement::Probabilities;
use eigentol_interpreter::FORMS;

use crate::failure::Failure;
use crate::interrupt;
use crate::output::Output;
use crate::point::{Point, exact, samples, whole};
use crate::progress;
use crate::requirements::{require_keys, requirements};
use crate::verdict::Verdict;

/// How requirements may be stated.
const KEYS: &str = concat!(
    "Each requirement is one text:\n",
    "  --require 'frequency 1 >= 20 Hz'      also <=; natural_frequency, damping_ratio, log_decrement, growth; modes count from 1\n",
    "  --require 'frequency 1 outside 4..5 Hz'   or within 4..5 Hz\n",
    "  --require 'frequency 1 away from 2 speed by 10%'   a multiple (1) of an input\n",
    "  --require 'angle <= 5 deg'            an output of the declaration\n",
    "  --require 'vibration shake under u <= 0.1 mm'   an amplitude, 0 to peak; `under u` may be left out if all\n",
    "                                        excitations have one frequency; `as velocity`, `as acceleration` may follow\n",
    "  --require 'velocity shake <= 4.5 mm/s rms'   also `p-p`, and `acceleration`; a limit may depend on inputs:\n",
    "                                        `vibration shake <= 25.4 um * sqrt(12000 rpm / speed) p-p`\n",
    "  --require 'vibration shake along speed=0..6000rpm <= 0.1 mm'   the greatest amplitude in a range\n",
    "  --require 'peak shake along speed=0..6000rpm away from speed by 15%'   where the highest peak is\n",
    "  --require 'critical speed=0..6000rpm >= 3000 rpm'   where the equilibrium loses its stiffness\n",
    "  --require 'resonance 1 speed=0..6000rpm order 2 >= 4000 rpm'   where frequency 1 crosses 2x (1x) the speed\n",
    "  --require 'flutter 1 speed=0..6000rpm >= 4000 rpm'   where mode 1 begins or ceases to grow\n",
    "  --require stable\n\n",
    "A study file takes the same texts; `failure`, which may be left out, is compared with what is found:\n",
    require_keys!(),
    "\n\nOther keys: mechanism, set, start, guess, tolerance, correlation, sigma_level, samples, seed, stream"
);

/// Samples where each takes a search along an input.
const SEARCHES: usize = 600;
const SEARCHES_OF_SHAFTS: usize = 100;

/// Probability of violating requirements; the method is chosen for you: design points, lines of designs, or samples
#[derive(Args, Debug)]
#[command(after_long_help = KEYS)]
pub(crate) struct Probability {
    #[command(flatten)]
    point: Point,
    /// A requirement: `frequency 1 >= 20 Hz`; may be given several times, in place of those of a study file
    #[arg(long, value_name = "REQUIREMENT")]
    require: Vec<String>,
    /// Samples, where only samples can tell [default: 3000; down to 600 if each is dear, as one that takes a search along an input]
    #[arg(long, value_name = "COUNT", value_parser = whole, allow_negative_numbers = true)]
    samples: Option<usize>,
    /// Seed of the samples [default: 0]
    #[arg(long, value_name = "NUMBER", value_parser = exact::<u64>, allow_negative_numbers = true)]
    seed: Option<u64>,
    #[command(flatten)]
    output: Output,
}

impl Probability {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        let mut question = self.point.question()?;
        let file = question.file.clone();
        let (required, allowed) =
            if self.require.is_empty() { (&file.require, file.allowed()?) } else { (&self.require, Vec::new()) };
        if required.is_empty() {
            let help = format!("state one by `--require`: {FORMS}; or by `require = [..]` in a study file");
            return Err(Failure::usage("nothing is required", help));
        }
        let (wanted, allowed) = requirements(&question.study, required, &allowed)?;
        let ranges = wanted.iter().filter_map(|wanted| wanted.response()?.range());
        let searched = ranges.inspect(|range| question.begin(range.input.index(), range.low)).count() > 0;
        let bar = progress::bar("designs", None);
        let study = progress::watched(question.study.clone(), &bar)
            .seed(self.seed.or(file.seed).unwrap_or(0))
            .stream(file.stream.unwrap_or(0));
        let usual = if searched {
            Some(if study.description().spans.is_empty() { SEARCHES } else { SEARCHES_OF_SHAFTS })
        } else {
            question.note_unset();
            study.modes().ok().map(|modes| judge::affordable(&modes, 100.0).max(SEARCHES))
        };
        let count = samples(self.samples.or(file.samples).or(usual), &file)?;
        let outcome = study.samples(count).probability(&wanted);
        drop(bar);
        let probabilities = outcome?;
        let mut answer = self.output.answer();
        answer.add(&probabilities)?;
        if let Some(reliability) = &probabilities.reliability {
            answer.add_aside(reliability)?;
        }
        if let Some(chances) = &probabilities.chances {
            answer.add_aside(chances)?;
        }
        self.output.write(&answer)?;
        if interrupt::stopped() {
            return Ok(Verdict::Stopped("the probabilities are those of the samples that were drawn".to_owned()));
        }
        Ok(verdict(&allowed, &probabilities))
    }
}

/// No if a requirement fails more often than is allowed.
fn verdict(allowed: &[Option<f64>], probabilities: &Probabilities) -> Verdict {
    let mut exceeded = allowed.iter().zip(&probabilities.each).enumerate().filter_map(|(k, (allowed, probability))| {
        let allowed = allowed.filter(|allowed| probability.value > *allowed)?;
        Some(format!(
            "requirement {} fails with a probability of {:.3e}, and {allowed} is allowed",
            k + 1,
            probability.value
        ))
    });
    exceeded.next().map_or(Verdict::Yes, Verdict::No)
}
