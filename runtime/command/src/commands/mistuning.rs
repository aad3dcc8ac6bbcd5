//! The worst blade of a rotor.

use clap::Args;
use eigentol::mistuning::EngineOrder;

use crate::failure::Failure;
use crate::output::Output;
use crate::point::{Point, exact, samples, whole};
use crate::progress;
use crate::verdict::Verdict;

/// How much higher the worst blade of a ring vibrates than equal blades would, under a force of an engine order, and its
/// distribution within the tolerances
#[derive(Args, Debug)]
pub(crate) struct Mistuning {
    #[command(flatten)]
    point: Point,
    /// The engine order: neighbouring blades feel the force with a phase of so many turns by the number of blades
    #[arg(long, value_name = "NUMBER", value_parser = exact::<usize>, allow_negative_numbers = true)]
    order: usize,
    /// The ring of blades [default: the first]
    #[arg(long, value_name = "NAME")]
    ring: Option<String>,
    /// The coordinate of each blade along which the force acts, and which is measured: `flap` [default: the first]
    #[arg(long, value_name = "NAME")]
    coordinate: Option<String>,
    /// Number of samples [default: 3000]
    #[arg(long, value_name = "COUNT", value_parser = whole, allow_negative_numbers = true)]
    samples: Option<usize>,
    /// Seed of the samples [default: 0]
    #[arg(long, value_name = "NUMBER", value_parser = exact::<u64>, allow_negative_numbers = true)]
    seed: Option<u64>,
    #[command(flatten)]
    output: Output,
}

impl Mistuning {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        let question = self.point.question()?;
        question.note_unset();
        let asked = EngineOrder {
            samples: samples(self.samples, &question.file)?,
            seed: self.seed.or(question.file.seed).unwrap_or(0),
            ..EngineOrder::of(
                question.study.description(),
                self.ring.as_deref(),
                self.coordinate.as_deref(),
                self.order,
            )?
        };
        let bar = progress::bar("samples", Some(asked.samples as u64));
        let study = progress::watched(question.study.clone(), &bar);
        let found = study.mistuning(asked)?;
        drop(bar);
        self.output.show(&found)?;
        Ok(Verdict::of(&question.study)?)
    }
}
