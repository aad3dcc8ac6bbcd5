//! The recipe of an example: events, sweep with Monte Carlo, smooth curves, CPU times, then files and summary.

use std::io::Write;

use eigentol::tolerance::Sampling;
use eigentol::{Error, Mechanism, Study};

use crate::cost::Cost;
use crate::events::Events;
use crate::pictures::{Named, Sweeps};
use crate::summary::{self, Paper};
use crate::{Failure, Options, Question, Sweep, progress, record, speeds};

/// All results for one question.
#[derive(Clone, Debug, PartialEq)]
pub struct Analysis {
    /// Speeds at which something happens.
    pub events: Events,
    /// The sweep with Monte Carlo.
    pub sampled: Sweep,
    /// A denser sweep without Monte Carlo, for smooth curves.
    pub curve: Sweep,
    /// CPU times, by tolerance.
    pub costs: Vec<Cost>,
    /// Mechanism, what varies, samples and seed: the caption of every figure.
    pub caption: String,
}

impl Analysis {
    /// Answers `question`.
    ///
    /// # Errors
    /// Errors that concern the whole sweep; a speed that fails is reported in the summary.
    pub fn run<M: Mechanism>(
        study: &Study<M>,
        question: &Question,
        options: &Options,
    ) -> Result<Self, Error> {
        let events = Events::find(study, question)?;
        let critical = events.critical.speed;
        let places = speeds::around(options.speeds, question.range, critical);
        let bar = progress::bar(places.len() * question.levels.len() * options.samples);
        let count = |samples: usize| bar.inc(samples as u64);
        let sampling = Sampling::default()
            .samples(options.samples)
            .seed(options.seed)
            .stream(0)
            .threads(options.threads)
            .progress(Some(&count));
        let sampled = Sweep::run(study, question, &places, Some(&sampling))?;
        bar.finish_and_clear();
        let dense = speeds::dense(question.range, critical);
        let curve = Sweep::run(study, question, &dense, None)?;
        let cost = |&level: &f64| Cost::measure(study, question, level, &places, &sampling);
        let varied: Vec<&str> = sampled.variables.iter().map(|own| &**own).collect();
        let caption = format!(
            "{}, tolerances of {}. Monte Carlo: {} samples at each speed, seed {}.",
            study.description().name,
            varied.join(", "),
            options.samples,
            options.seed
        );
        Ok(Self {
            caption,
            events,
            sampled,
            curve,
            costs: question.levels.iter().map(cost).collect(),
        })
    }

    /// The data for the figures.
    pub fn sweeps(&self) -> Sweeps<'_> {
        Sweeps {
            curve: &self.curve,
            sampled: &self.sampled,
            critical: self.events.critical.speed,
            caption: self.caption.clone(),
        }
    }

    /// Writes the sweep and the figures to the results directory.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn save(&self, options: &Options, table: &str, figures: &[Named]) -> Result<(), Failure> {
        record::write(&self.sampled, &options.file(table))?;
        for (name, figure) in figures {
            figure.save(options.file(&format!("{name}.svg")))?;
        }
        Ok(())
    }

    /// Prints the summary under a heading.
    ///
    /// # Errors
    /// [`Failure::Print`].
    pub fn print(
        &self,
        out: &mut dyn Write,
        heading: &str,
        paper: Option<&Paper>,
    ) -> Result<(), Failure> {
        writeln!(out, "{heading}\n")?;
        summary::events(out, &self.sampled, &self.events, paper)?;
        summary::by_speed(out, &self.sampled)?;
        summary::checks(out, &self.sampled)?;
        summary::costs(out, self.sampled.rows.len(), &self.costs, paper)?;
        Ok(())
    }
}
