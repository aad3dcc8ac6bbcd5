//! Campbell diagrams.

use clap::Args;
use eigentol_figures as figures;

use crate::failure::Failure;
use crate::output::Output;
use crate::picture::Picture;
use crate::point::Point;
use crate::sweep::{Points, Sweep};
use crate::verdict::Verdict;

/// Modes along an input with their spread, critical values, crossings of engine orders and onsets of flutter
#[derive(Args, Debug)]
pub(crate) struct Campbell {
    #[command(flatten)]
    point: Point,
    #[command(flatten)]
    sweep: Sweep,
    #[command(flatten)]
    points: Points,
    /// Engine orders whose crossings are located: `1,2`; may be given several times [default: none]
    #[arg(long = "order", value_name = "NUMBERS", value_delimiter = ',')]
    orders: Vec<f64>,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    picture: Picture,
}

impl Campbell {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        self.picture.check()?;
        let question = self.point.question()?;
        let range = self.sweep.range(&question)?;
        let values = self.points.values(&range, &question)?;
        let given = question.file.orders.clone().unwrap_or_default();
        let orders = if self.orders.is_empty() {
            &given
        } else {
            &self.orders
        };
        let found = question.study.campbell(range.input, &values, orders)?;
        let mut answer = self.output.answer();
        answer.add(&found)?;
        let style = self.picture.style(&question);
        self.picture.draw(|| figures::campbell(&found, &style))?;
        self.output.write(&answer)?;
        let mut states = found.points.iter().map(|point| point.modes.is_ok());
        if states.any(|found| found) {
            return Ok(Verdict::Yes);
        }
        Ok(Verdict::No("no value of the range has modes".to_owned()))
    }
}
