//! Evaluation points of a model for its variance-based indices.

use crate::Error;
use crate::sequence::{Cursor, Sequence};

/// The design of Saltelli et al. (Comput. Phys. Commun. 181, 2010, table 1).
///
/// Each row of two independent samples `A` and `B` of `d` inputs gives `d + 2` points: the row of `A`, that of `B`, and
/// for each input `i` the row of `A` with input `i` taken from `B`.
///
/// Evaluation `k` belongs to row `k / (d + 2)`, in this order. Inputs are probabilities: apply the quantile functions
/// of the inputs.
///
/// ```
/// use eigentol_statistics::sensitivity::{Bootstrap, Estimator, SaltelliDesign, sobol_indices};
/// use eigentol_statistics::sequence::Sequence;
///
/// // Two inputs, four dimensions. The second input makes four fifths of the variance.
/// let design = SaltelliDesign::new(Sequence::sobol(4, 1, 0)?, 1024)?;
/// let mut values = Vec::new();
/// let mut walk = design.from(0);
/// while let Some(x) = walk.next_point() {
///     values.push(Some(x[0] + 2.0 * x[1]));
/// }
/// let indices = sobol_indices(2, &values, Estimator::Jansen, Bootstrap::default())?;
/// assert!((indices.first[1].value - 0.8).abs() < 0.01);
/// # Ok::<(), eigentol_statistics::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct SaltelliDesign {
    sequence: Sequence,
    rows: u64,
}

impl SaltelliDesign {
    /// Creates a design from the first `rows` points of a sequence; the first half of the coordinates belongs to `A`,
    /// the second to `B`.
    ///
    /// # Errors
    /// [`Error::Setting`] if the number of dimensions is odd, if the sequence has fewer points, or for zero rows.
    pub fn new(sequence: Sequence, rows: u64) -> Result<Self, Error> {
        let dimensions = sequence.dimensions();
        let setting = |setting, reason| Err(Error::setting(setting, reason));
        if !dimensions.is_multiple_of(2) {
            let reason = format!("{dimensions}: two are needed for each input");
            return setting("dimensions", reason);
        }
        let most = sequence.points().min(u64::MAX / (dimensions as u64 + 2));
        if !(1..=most).contains(&rows) {
            return setting("rows", format!("{rows}, not between 1 and {most}"));
        }
        Ok(Self { sequence, rows })
    }

    /// Number of inputs of the model.
    pub fn inputs(&self) -> usize {
        self.sequence.dimensions() / 2
    }

    /// Number of evaluations of the model: `rows (inputs + 2)`.
    pub fn evaluations(&self) -> u64 {
        self.rows * self.blocks()
    }

    /// Writes the inputs of evaluation `k`.
    ///
    /// # Errors
    /// [`Error::WrongLength`] if `into` does not have one place per input, [`Error::BeyondLast`] if there is no
    /// evaluation `k`.
    pub fn point(&self, k: u64, into: &mut [f64]) -> Result<(), Error> {
        if into.len() != self.inputs() {
            return Err(Error::WrongLength { kind: "inputs", found: into.len(), expected: self.inputs() });
        }
        let point = self.from(k).next_point().map(|point| into.copy_from_slice(point));
        point.ok_or(Error::BeyondLast { kind: "evaluation", index: k, number: self.evaluations() })
    }

    /// Iterates over the evaluations, starting at number `first`.
    pub fn from(&self, first: u64) -> DesignWalk<'_> {
        let first = first.min(self.evaluations());
        DesignWalk {
            rows: self.sequence.from(first / self.blocks()),
            row: None,
            blocks: self.blocks(),
            next: first,
            end: self.evaluations(),
            point: vec![0.5; self.inputs()],
        }
    }

    /// Number of evaluations per row.
    fn blocks(&self) -> u64 {
        self.inputs() as u64 + 2
    }
}

/// Iterates over a [`SaltelliDesign`].
#[derive(Clone, Debug)]
pub struct DesignWalk<'a> {
    rows: Cursor<'a>,
    /// `A` and `B`, concatenated.
    row: Option<Vec<f64>>,
    blocks: u64,
    next: u64,
    end: u64,
    point: Vec<f64>,
}

impl DesignWalk<'_> {
    /// The inputs of the next evaluation; `None` after the last one.
    pub fn next_point(&mut self) -> Option<&[f64]> {
        if self.next >= self.end {
            return None;
        }
        let block = (self.next % self.blocks) as usize;
        if block == 0 || self.row.is_none() {
            self.row = Some(self.rows.next_point()?.to_vec());
        }
        let (a, b) = self.row.as_ref()?.split_at(self.point.len());
        self.point.copy_from_slice(if block == 1 { b } else { a });
        if let Some(input) = block.checked_sub(2) {
            self.point[input] = b[input];
        }
        self.next += 1;
        Some(&self.point)
    }
}
