//! Maps of events over a design variable.

use clap::Args;
use eigentol_figures as figures;
use eigentol_interpreter::design_range;

use crate::failure::Failure;
use crate::output::Output;
use crate::picture::Picture;
use crate::point::{Point, whole};
use crate::progress;
use crate::sweep::{Orders, Sweep};
use crate::verdict::Verdict;

/// Default number of values.
const VALUES: usize = 13;
/// Ends farther apart than by this factor are divided in equal ratios.
const DECADE: f64 = 10.0;

/// Events along an input over a design variable, with their spreads: a critical speed map over the stiffness of bearings,
/// limits of stability over what cross-couples
#[derive(Args, Debug)]
pub(crate) struct Map {
    #[command(flatten)]
    point: Point,
    #[command(flatten)]
    sweep: Sweep,
    #[command(flatten)]
    orders: Orders,
    /// Range of a design variable: `bearing=1..1000MN/m`; in equal ratios where it spans a decade
    #[arg(long, value_name = "NAME=FROM..TO")]
    over: String,
    /// Number of its values, ends included [default: 13]
    #[arg(long, value_name = "COUNT", value_parser = whole)]
    values: Option<usize>,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    picture: Picture,
}

impl Map {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        self.picture.check(&self.output)?;
        let question = self.point.question()?;
        let range = self.sweep.range(&question)?;
        let orders = self.orders.or_first(Some(&range), &question)?;
        let (over, [low, high]) = design_range(&question.study, &self.over)?;
        let count = self.values.unwrap_or(VALUES);
        if count < 2 || low == high {
            return Err(Failure::usage("a map has two values at least", "write `--over bearing=1..1000MN/m`"));
        }
        let in_ratios = low > 0.0 && high > 0.0 && (high / low).max(low / high) >= DECADE;
        let value = |k: usize| match k as f64 / (count - 1) as f64 {
            share if in_ratios => low * (high / low).powf(share),
            share => low + share * (high - low),
        };
        let values: Vec<f64> = (0..count - 1).map(value).chain([high]).collect();
        let bar = progress::bar("states", None);
        let study = progress::watched(question.study.clone(), &bar);
        let map = study.event_map(range.input, range.low, range.high, &orders, over, &values)?;
        drop(bar);
        let style = self.picture.style(&question, usize::MAX)?;
        self.picture.draw(|| figures::event_map(&map, &style))?;
        self.output.show(&map)?;
        if map.points.iter().any(|(_, events)| events.is_ok()) {
            return Ok(Verdict::Yes);
        }
        Ok(Verdict::No("no value of the design variable has an answer".to_owned()))
    }
}
