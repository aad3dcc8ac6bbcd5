//! A range of an input: `speed=0..6000rpm`.

use clap::Args;
use eigentol::{Input, Study};
use eigentol_interpreter::{Interpreted, orders};

use crate::failure::{Failure, plural};
use crate::point::{Question, whole};

/// Default number of points of a sweep.
const POINTS: usize = 51;

/// The syntax of a range.
const HELP: &str = "write `--sweep speed=0..6000rpm`";

/// Along what.
#[derive(Args, Debug)]
pub(crate) struct Sweep {
    /// Range of an input: `speed=0..6000rpm`
    #[arg(long, value_name = "NAME=FROM..TO")]
    sweep: Option<String>,
}

/// At how many values.
#[derive(Args, Debug)]
pub(crate) struct Points {
    /// Number of values, ends included [default: 51]
    #[arg(long, value_name = "COUNT", value_parser = whole, allow_negative_numbers = true)]
    points: Option<usize>,
}

/// Which multiples of the input.
#[derive(Args, Debug)]
pub(crate) struct Orders {
    /// Engine orders whose crossings to locate: `1,2`; may be given several times
    #[arg(long = "order", value_name = "NUMBERS", value_delimiter = ',', allow_negative_numbers = true)]
    orders: Vec<f64>,
}

/// A range of an input, SI.
pub(crate) struct Range {
    pub(crate) input: Input<Interpreted>,
    pub(crate) low: f64,
    pub(crate) high: f64,
}

impl Sweep {
    pub(crate) fn range(&self, question: &Question) -> Result<Range, Failure> {
        self.range_alone(question)?.ok_or_else(|| Failure::usage("no input to sweep is given", HELP))
    }

    /// The range, if there is one, of an answer along it alone: a value of its input would have no effect.
    pub(crate) fn range_alone(&self, question: &Question) -> Result<Option<Range>, Failure> {
        let Some(range) = self.range_if_any(question)? else {
            return Ok(None);
        };
        let name = &question.study.description().inputs[range.input.index()].name;
        if question.set.iter().any(|set| **set == **name) {
            let message = format!("`--set {name}=...` has no effect: the sweep sets `{name}`");
            return Err(Failure::usage(message, "leave one of them out"));
        }
        Ok(Some(range))
    }

    /// The range; `None` if neither the command line nor a study file gives one.
    pub(crate) fn range_if_any(&self, question: &Question) -> Result<Option<Range>, Failure> {
        let text = self.sweep.as_ref().or(question.file.sweep.as_ref());
        text.map(|text| range(&question.study, text)).transpose()
    }
}

/// The mistake of an option that means nothing without a range.
pub(crate) fn unswept(option: &str) -> Failure {
    let message = format!("no input to sweep is given for `{option}`");
    Failure::usage(message, HELP)
}

/// Parses a range.
pub(crate) fn range(study: &Study<Interpreted>, text: &str) -> Result<Range, Failure> {
    let range = eigentol_interpreter::range(study, text)?;
    Ok(Range { input: Input::new(range.input.index()), low: range.low, high: range.high })
}

impl Points {
    /// Refuses a number of values of no range.
    pub(crate) fn refuse_without_sweep(&self) -> Result<(), Failure> {
        match self.points {
            None => Ok(()),
            Some(_) => Err(unswept("--points")),
        }
    }

    /// The values of a range, SI; `held` says that an answer for each is in memory at once.
    pub(crate) fn values(&self, range: &Range, question: &Question, held: bool) -> Result<Vec<f64>, Failure> {
        let count = self.points.or(question.file.points).unwrap_or(POINTS);
        if count < 2 {
            let help = "a range has two ends: `--points 2` is the least";
            return Err(Failure::usage(
                format!("{count} {} no sweep", plural(count, "point makes", "points make")),
                help,
            ));
        }
        let most = if held { MOST_POINTS } else { MOST_ROWS };
        if count > most {
            let message = format!("{count} points are more than one answer can hold");
            let help = format!(
                "`--points {most}` is the most: divide the range, or write the rows of `campbell` and `sweep` as CSV"
            );
            return Err(Failure::usage(message, help));
        }
        let step = (range.high - range.low) / (count - 1) as f64;
        Ok((0..count - 1).map(|k| range.low + k as f64 * step).chain([range.high]).collect())
    }
}

/// Most values of an input in one answer that is held at once: some kilobytes each.
const MOST_POINTS: usize = 100_000;
/// Most values whose rows are written as they come; only the values themselves are held.
const MOST_ROWS: usize = 100_000_000;

impl Orders {
    /// [`Self::along`]; the first order where none is given and the input is an angular speed.
    pub(crate) fn or_first(&self, range: Option<&Range>, question: &Question) -> Result<Vec<f64>, Failure> {
        let first = Self { orders: vec![1.0] };
        match range {
            Some(_) if self.orders.is_empty() && question.file.orders.is_none() => {
                Ok(first.along(range, question).unwrap_or_default())
            }
            _ => self.along(range, question),
        }
    }

    /// The orders, from the command line or else the study file.
    pub(crate) fn along(&self, range: Option<&Range>, question: &Question) -> Result<Vec<f64>, Failure> {
        let Some(range) = range else {
            return if self.orders.is_empty() { Ok(Vec::new()) } else { Err(unswept("--order")) };
        };
        let file = question.file.orders.as_deref().unwrap_or_default();
        let given = if self.orders.is_empty() { file } else { &self.orders };
        let along = eigentol::sweep::Range::new(range.input.any(), range.low, range.high);
        Ok(orders(&question.study, &along, given)?)
    }
}
