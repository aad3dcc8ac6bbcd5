//! Whether beams have enough coordinates.

use clap::Args;
use eigentol::sweep::{self, Line};
use eigentol_interpreter::Interpreted;

use crate::failure::Failure;
use crate::output::Output;
use crate::point::{Point, whole};
use crate::progress;
use crate::sweep::{Orders, Sweep};
use crate::verdict::Verdict;

/// Changes of frequencies, damping ratios, outputs, and along an input of events and peaks, with one and two more
/// coordinates of each beam's components
#[derive(Args, Debug)]
pub(crate) struct Converge {
    #[command(flatten)]
    point: Point,
    /// How many of the first modes that oscillate are compared [default: all]
    #[arg(long, value_name = "NUMBER", value_parser = whole)]
    modes: Option<usize>,
    #[command(flatten)]
    sweep: Sweep,
    #[command(flatten)]
    orders: Orders,
    #[command(flatten)]
    output: Output,
}

impl Converge {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        let question = self.point.question()?;
        let refined = |more| Interpreted::refined(&question.text, more);
        let refined = [refined(1)?, refined(2)?];
        let range = self.sweep.range_alone(&question)?;
        let orders = self.orders.along(range.as_ref(), &question)?;
        let bar = progress::bar("states", None);
        let study = progress::watched(question.study.clone(), &bar);
        let convergence = match range {
            None => {
                question.note_unset();
                study.convergence(refined)?
            }
            Some(range) => {
                let lines: Vec<Line> = orders.into_iter().map(Line::from).collect();
                let range = sweep::Range::new(range.input, range.low, range.high);
                study.convergence_along(refined, range, &lines)?
            }
        };
        drop(bar);
        self.output.show(&convergence.of_first(self.modes.unwrap_or(usize::MAX)))?;
        Ok(Verdict::of(&question.study)?)
    }
}
