//! A range of an input: `speed=0..6000rpm`.

use clap::Args;
use eigentol::{Input, Study};
use eigentol_interpreter::{Interpreted, value};

use crate::failure::Failure;
use crate::point::{Question, input, whole};

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
    #[arg(long, value_name = "COUNT", value_parser = whole)]
    points: Option<usize>,
}

/// A range of an input, SI.
pub(crate) struct Range {
    pub(crate) input: Input<Interpreted>,
    pub(crate) low: f64,
    pub(crate) high: f64,
}

impl Sweep {
    pub(crate) fn range(&self, question: &Question) -> Result<Range, Failure> {
        let found = self.range_if_any(question)?;
        found.ok_or_else(|| Failure::usage("no input to sweep is given", HELP))
    }

    /// The range; `None` if neither the command line nor a study file gives one.
    pub(crate) fn range_if_any(&self, question: &Question) -> Result<Option<Range>, Failure> {
        let text = self.sweep.as_ref().or(question.file.sweep.as_ref());
        text.map(|text| range(&question.study, text)).transpose()
    }
}

/// Parses a range.
pub(crate) fn range(study: &Study<Interpreted>, text: &str) -> Result<Range, Failure> {
    let parts = text
        .split_once('=')
        .and_then(|(name, range)| Some((name.trim(), range.split_once("..")?)));
    let Some((name, (low, high))) = parts else {
        return Err(Failure::usage(format!("`{text}` is not a range"), HELP));
    };
    let (input, unit) = input(study, name)?;
    let refused = |mistakes| Failure::value(format!("sweep {text}"), &mistakes);
    let end = |text: &str| value(text, &unit, &format!("`{name}`")).map_err(refused);
    Ok(Range {
        input,
        low: end(&with_unit_of(low, high))?,
        high: end(high)?,
    })
}

impl Points {
    /// The values, SI.
    pub(crate) fn values(&self, range: &Range, question: &Question) -> Result<Vec<f64>, Failure> {
        let count = self.points.or(question.file.points).unwrap_or(POINTS);
        if count < 2 {
            let help = "a range has two ends: `--points 2` is the least";
            return Err(Failure::usage(
                format!("{count} points do not make a sweep"),
                help,
            ));
        }
        let step = (range.high - range.low) / (count - 1) as f64;
        let inner = (0..count - 1).map(|k| range.low + k as f64 * step);
        Ok(inner.chain([range.high]).collect())
    }
}

/// Lets the low end of a range take its unit from the high end.
fn with_unit_of(low: &str, high: &str) -> String {
    if low.trim().parse::<f64>().is_err() {
        return low.to_owned();
    }
    format!("{low} {}", &high[number(high)..])
}

/// Length of the number at the start of a text.
fn number(text: &str) -> usize {
    let ends = (1..=text.len())
        .rev()
        .filter(|&end| text.is_char_boundary(end));
    let mut numbers = ends.filter(|&end| text[..end].trim().parse::<f64>().is_ok());
    numbers.next().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::with_unit_of;

    #[test]
    fn the_low_end_takes_the_unit_of_the_high_end() {
        for (low, high, expected) in [
            ("0", "6000rpm", "0 rpm"),
            ("-1e3", "1.5e3 rad/s", "-1e3 rad/s"),
            ("10Hz", "6000rpm", "10Hz"),
            ("1", "2", "1 "),
            ("1", "rpm", "1 rpm"),
        ] {
            assert_eq!(with_unit_of(low, high), expected);
        }
    }
}
