//! The unit of timing: one implementation of a task over prepared inputs.

use std::hint::black_box;

use eigentol::Array;

/// Number of prepared inputs per task; a run cycles through them, so that no work can be carried over between calls.
pub(crate) const INPUTS: usize = 64;

/// Required agreement of both sides' results, relative to the largest entry of their array; otherwise nothing is timed.
pub(crate) const AGREEMENT: f64 = 1e-12;

/// An implementation of a task.
pub(crate) trait Work {
    /// Number of prepared inputs.
    fn inputs(&self) -> usize;
    /// Evaluates one input and passes the results to `black_box`.
    fn evaluate(&mut self, input: usize);
    /// Number of results: of inputs, or of the states in them.
    fn states(&self) -> usize {
        self.inputs()
    }
    /// The results for one state, array by array, for comparison with another implementation.
    fn results(&mut self, state: usize) -> Vec<Vec<f64>>;

    /// Evaluates `repetitions` times, cycling through the inputs.
    fn run(&mut self, repetitions: u64) {
        let count = self.inputs();
        let mut next = 0;
        for _ in 0..repetitions {
            self.evaluate(next);
            next += 1;
            if next == count {
                next = 0;
            }
        }
    }
}

/// A task for both sides, or for ours alone if the peer is absent.
pub(crate) struct Task {
    /// Section and task, for example `chain8/linear`.
    pub(crate) name: String,
    /// Evaluations, speeds or samples in one repetition, ours and the peer's: times and counts are given per unit.
    pub(crate) units: [usize; 2],
    /// Required agreement of the results.
    pub(crate) agreement: f64,
    pub(crate) ours: Box<dyn Work>,
    /// The peer, or why it is absent.
    pub(crate) peer: Result<Box<dyn Work>, String>,
}

/// An implementation made of two closures over the inputs: `evaluate` passes its results to `black_box` itself, so that
/// large ones need not be moved.
pub(crate) struct Closures<S, E, R> {
    pub(crate) inputs: Vec<S>,
    pub(crate) evaluate: E,
    pub(crate) results: R,
}

impl<S, E, R> Work for Closures<S, E, R>
where
    E: FnMut(&S),
    R: FnMut(&S) -> Vec<Vec<f64>>,
{
    fn inputs(&self) -> usize {
        self.inputs.len()
    }

    fn evaluate(&mut self, input: usize) {
        (self.evaluate)(black_box(&self.inputs[input]));
    }

    fn results(&mut self, input: usize) -> Vec<Vec<f64>> {
        (self.results)(&self.inputs[input])
    }
}

/// The largest difference between two sets of results, relative to the largest entry of its array.
///
/// # Errors
/// When shapes differ or a number is not finite.
pub(crate) fn difference(ours: &[Vec<f64>], peer: &[Vec<f64>]) -> Result<f64, String> {
    let shape = |results: &[Vec<f64>]| results.iter().map(Vec::len).collect::<Vec<_>>();
    if shape(ours) != shape(peer) {
        return Err(format!("shapes {:?} and {:?}", shape(ours), shape(peer)));
    }
    let mut worst = 0.0_f64;
    for (a, b) in ours.iter().zip(peer) {
        let greatest = b.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        for (x, y) in a.iter().zip(b) {
            if !(x.is_finite() && y.is_finite()) {
                return Err(format!("not finite: {x} and {y}"));
            }
            let apart = (x - y).abs();
            if apart > 0.0 {
                worst = worst.max(apart / greatest.max(x.abs()));
            }
        }
    }
    Ok(worst)
}

/// The entries of a matrix, by rows.
pub(crate) fn flat<R: AsRef<[f64]>>(rows: impl AsRef<[R]>) -> Vec<f64> {
    let rows = rows.as_ref().iter();
    rows.flat_map(|row| row.as_ref()).copied().collect()
}

/// Random numbers for inputs (splitmix64), the same in every run.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// Uniform between `low` and `high`.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        bits ^= bits >> 31;
        low + (high - low) * ((bits >> 11) as f64 / (1_u64 << 53) as f64)
    }

    pub(crate) fn array<A: Array<f64>>(&mut self, low: f64, high: f64) -> A {
        A::from_fn(|_| self.between(low, high))
    }
}
