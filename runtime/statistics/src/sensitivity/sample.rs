//! Correlation of a result with randomly sampled inputs.

use super::indices::at_least;
use crate::Error;

/// Inputs and results of a random sample, excluding the rows without a result.
///
/// ```
/// use eigentol_statistics::sensitivity::Sample;
///
/// let inputs = [vec![1.0, 0.0], vec![2.0, 1.0], vec![3.0, 0.0], vec![4.0, 2.0], vec![5.0, 5.0]];
/// let results = [Some(1.0), Some(4.0), Some(9.0), Some(16.0), None];
/// let sample = Sample::new(&inputs, &results)?;
/// assert_eq!((sample.rows(), sample.dropped()), (4, 1));
/// assert!((sample.spearman()[0] - 1.0).abs() < 1e-15);
/// assert!(sample.pearson()[0] < 0.99);
/// # Ok::<(), eigentol_statistics::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Sample {
    /// One column per input, with mean 0 and length 1.
    pub(super) columns: Vec<Vec<f64>>,
    pub(super) result: Vec<f64>,
    dropped: usize,
}

impl Sample {
    /// Creates a sample from inputs by row and results, `None` where the model has none.
    ///
    /// # Errors
    /// - [`Error::WrongLength`] if the rows differ in length, or if their number differs from that of the results;
    /// - [`Error::NotFinite`] if an input or a result is not finite;
    /// - [`Error::TooFew`] if fewer than three rows have a result, or for zero inputs;
    /// - [`Error::Constant`] if an input or the result does not vary.
    pub fn new(inputs: &[Vec<f64>], results: &[Option<f64>]) -> Result<Self, Error> {
        let length = |kind, found, expected| {
            if found == expected {
                return Ok(());
            }
            Err(Error::WrongLength { kind, found, expected })
        };
        length("results", results.len(), inputs.len())?;
        let number = inputs.first().map_or(0, Vec::len);
        at_least("inputs", number, 1)?;
        for row in inputs {
            length("inputs", row.len(), number)?;
        }
        let complete: Vec<(&Vec<f64>, f64)> =
            inputs.iter().zip(results).filter_map(|(row, result)| result.map(|result| (row, result))).collect();
        at_least("rows with a result", complete.len(), 3)?;
        let column = |j: usize| {
            let column = complete.iter().map(|(row, _)| row[j]).collect();
            standardised(column, || format!("input {j}"))
        };
        let result = complete.iter().map(|(_, result)| *result).collect();
        Ok(Self {
            columns: (0..number).map(column).collect::<Result<_, _>>()?,
            result: standardised(result, || "the result".into())?,
            dropped: inputs.len() - complete.len(),
        })
    }

    /// Number of rows with a result.
    pub fn rows(&self) -> usize {
        self.result.len()
    }

    /// Number of rows without a result.
    pub fn dropped(&self) -> usize {
        self.dropped
    }

    /// Pearson correlation coefficient of the result with each input, between -1 and 1.
    pub fn pearson(&self) -> Vec<f64> {
        let product =
            |column: &Vec<f64>| column.iter().zip(&self.result).map(|(x, y)| x * y).sum::<f64>().clamp(-1.0, 1.0);
        self.columns.iter().map(product).collect()
    }

    /// Spearman rank correlation coefficient of the result with each input: 1 for any increasing function.
    pub fn spearman(&self) -> Vec<f64> {
        self.ranked().pearson()
    }

    /// The sample with ranks in place of numbers; equal numbers share the mean of their ranks.
    ///
    /// Its regression gives the coefficients known as SRRC and PRCC.
    pub fn ranked(&self) -> Self {
        let ranked = |values: &Vec<f64>| centred(ranks(values));
        Self { columns: self.columns.iter().map(ranked).collect(), result: ranked(&self.result), dropped: self.dropped }
    }
}

fn standardised(values: Vec<f64>, what: impl FnOnce() -> String) -> Result<Vec<f64>, Error> {
    if values.iter().any(|value| !value.is_finite()) {
        return Err(Error::NotFinite { kind: "an input or a result" });
    }
    if values.iter().all(|value| *value == values[0]) {
        return Err(Error::Constant { what: what() });
    }
    let scale = values.iter().fold(0.0_f64, |m, value| m.max(value.abs()));
    Ok(centred(values.into_iter().map(|value| value / scale).collect()))
}

/// Scales to mean 0 and length 1. The values must not all be equal.
fn centred(mut values: Vec<f64>) -> Vec<f64> {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    values.iter_mut().for_each(|value| *value -= mean);
    let length = values.iter().map(|value| value * value).sum::<f64>().sqrt();
    values.iter_mut().for_each(|value| *value /= length);
    values
}

fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&i, &j| values[i].total_cmp(&values[j]));
    let mut ranks = vec![0.0; values.len()];
    let mut before = 0;
    for equal in order.chunk_by(|&i, &j| values[i] == values[j]) {
        for &i in equal {
            ranks[i] = before as f64 + 0.5 * (equal.len() as f64 - 1.0);
        }
        before += equal.len();
    }
    ranks
}
