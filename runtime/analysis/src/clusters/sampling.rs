//! Sampling of a cluster of eigenvalues that tolerances mix: no member has a derivative of its own, but the small
//! matrix that splits them does.

use eigentol_statistics::summary::{CHUNK, Moments};

use core::ops::{AddAssign, Mul};

use super::couplings::ModalCouplings;
use crate::algebra::{Matrix, Vector};
use crate::eigenproblem::{Tridiagonal, diagonalise, eigenvalues};
use crate::modes::Family;
use crate::rounding::{Sign, of_elements, sign};
use crate::tolerance::{Draw, Sampling, Statistics, Tolerances};
use crate::{Complex, Error, Quantity};

/// Spread of the sorted members of a cluster.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ClusterSpread {
    /// Number of samples.
    pub samples: usize,
    /// Frequency, rad/s: `sqrt(lambda)` or `Im s`.
    pub frequency: SortedSpread,
    /// Eigenvalue `lambda`, 1/s^2; `None` for general modes.
    pub lambda: Option<SortedSpread>,
    /// Growth `Re s`, 1/s; `None` for undamped modes.
    pub growth: Option<SortedSpread>,
    /// Damping ratio; `None` for undamped modes.
    pub damping_ratio: Option<SortedSpread>,
    /// Number of samples in which a member grows: `lambda` negative, or `Re s` positive, beyond rounding.
    pub unstable: usize,
    /// Number of samples whose eigenvalues were not found; they are excluded everywhere else.
    pub unsolved: usize,
}

/// Spread of one quantity over the members of a cluster, sorted by this quantity in every sample.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SortedSpread {
    /// By position, ascending. A member without the quantity is sorted below all others.
    pub members: Vec<MemberSpread>,
    /// Highest minus lowest, over the samples in which every member has the quantity; `None` if there are none.
    pub splitting: Option<Statistics>,
}

impl SortedSpread {
    /// The lowest; `None` for an empty cluster.
    #[must_use]
    pub fn lowest(&self) -> Option<&MemberSpread> {
        self.members.first()
    }

    /// The highest; `None` for an empty cluster.
    #[must_use]
    pub fn highest(&self) -> Option<&MemberSpread> {
        self.members.last()
    }
}

/// Spread of one position of a sorted cluster.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MemberSpread {
    /// Statistics over the samples whose member has the quantity, in its unit, without quantiles; `None` if there are
    /// none.
    pub value: Option<Statistics>,
    /// Number of samples whose member lacks the quantity, for example a frequency.
    pub without: usize,
}

/// Samples the eigenvalues of `diag(eigenvalues) + sum_k x_k by_design[k]` for deviations `x ~ N(0, Sigma)` of the
/// design variables: of `sampling`, the number of samples, seed and stream count.
///
/// # Errors
/// [`Error::Setting`] if points are not random, if matrices have the wrong number or size, are not finite, or for
/// undamped modes are not real and symmetric, and for samples beyond the range of a double.
pub fn sample_cluster(
    couplings: &ModalCouplings,
    tolerances: &Tolerances,
    sampling: &Sampling<'_>,
) -> Result<ClusterSpread, Error> {
    check(couplings, tolerances)?;
    sampling.check_random()?;
    let family = couplings.family;
    let m = couplings.eigenvalues.len();
    let mut work = Work::new(couplings);
    let mut values = vec![Complex::default(); m];
    let mut frequency = Sorted::new(m);
    let mut parts = [Sorted::new(m), Sorted::new(m)];
    let (mut unstable, mut unsolved) = (0, 0);
    let sequence = (sampling.seed, sampling.stream);
    let nominal = Vector::zeros(couplings.by_design.len());
    let mut draw = Draw::starting(sequence, 0, &nominal, tolerances);
    for _ in 0..sampling.samples {
        let Some(size) = work.fill(draw.next_design()) else {
            return Err(refuse("a sample exceeds the range of a double".to_owned()));
        };
        if !work.solve(&mut values) {
            unsolved += 1;
            continue;
        }
        let values = &values[..];
        unstable += usize::from(values.iter().any(|&value| grows(family, value, of_elements(m) * size)));
        frequency.add(values, |value| frequency_of(family, value));
        let [first, second] = &mut parts;
        first.add(values, |value| Some(value.re));
        if family == Family::General {
            second.add(values, damping_ratio);
        }
    }
    let solved = sampling.samples - unsolved;
    let [first, second] = parts.map(|part| part.spread(solved));
    let (lambda, growth, damping_ratio) = match family {
        Family::Undamped => (Some(first), None, None),
        Family::General => (None, Some(first), Some(second)),
    };
    Ok(ClusterSpread {
        samples: sampling.samples,
        frequency: frequency.spread(solved),
        lambda,
        growth,
        damping_ratio,
        unstable,
        unsolved,
    })
}

/// Up to this size, elements can be squared and summed in the eigenvalue iteration.
const LARGEST: f64 = 1e150;
/// For an oscillation of constant amplitude, the computed `Re s` is below this, relative to `|s|`.
const ROUNDING: f64 = 1e-9;

/// Whether a member grows beyond rounding; `rounding` is the rounding error of `lambda`.
fn grows(family: Family, value: Complex, rounding: f64) -> bool {
    match family {
        Family::Undamped => sign(value.re, rounding) == Sign::Negative,
        Family::General => sign(value.re, ROUNDING * value.norm()) == Sign::Positive,
    }
}

/// `sqrt(lambda)` or `Im s`, where positive.
pub(super) fn frequency_of(family: Family, value: Complex) -> Option<f64> {
    match family {
        Family::Undamped => (value.re > 0.0).then(|| value.re.sqrt()),
        Family::General => (value.im > 0.0).then_some(value.im),
    }
}

fn damping_ratio(s: Complex) -> Option<f64> {
    (s.norm() > 0.0).then(|| Quantity::DampingRatio.value(s))
}

/// Checks that the matrices have the right number and size, are finite, and are symmetric where the method relies on
/// it.
fn check(couplings: &ModalCouplings, tolerances: &Tolerances) -> Result<(), Error> {
    let m = couplings.eigenvalues.len();
    let (count, variables) = (couplings.by_design.len(), tolerances.half_widths().len());
    if count != variables {
        return Err(refuse(format!("{count} matrices for {variables} design variables")));
    }
    for (k, matrix) in couplings.by_design.iter().enumerate() {
        let (rows, columns) = (matrix.row_count(), matrix.column_count());
        if (rows, columns) != (m, m) {
            return Err(refuse(format!("matrix {k} is {rows} by {columns} and must be {m} by {m}")));
        }
    }
    let mut numbers = couplings.eigenvalues.iter().chain(couplings.by_design.iter().flat_map(Matrix::as_flattened));
    if let Some(value) = numbers.find(|value| !value.is_finite()) {
        return Err(refuse(format!("an element is {value}")));
    }
    if couplings.family == Family::General {
        return Ok(());
    }
    if couplings.eigenvalues.iter().any(|value| value.im != 0.0) {
        return Err(refuse("eigenvalues of undamped modes are real".to_owned()));
    }
    for (k, matrix) in couplings.by_design.iter().enumerate() {
        let size = matrix.as_flattened().iter().fold(0.0_f64, |most, x| most.max(x.l1_norm()));
        let mirrored = |i: usize, j: usize| (matrix[i][j] - matrix[j][i].conj()).l1_norm();
        let wrong = |i: usize, j: usize| mirrored(i, j).max(matrix[i][j].im.abs());
        if (0..m).any(|i| (0..m).any(|j| wrong(i, j) > SYMMETRIC * size)) {
            return Err(refuse(format!("matrix {k} is not real and symmetric")));
        }
    }
    Ok(())
}

/// Mirrored elements may differ by this much due to rounding.
const SYMMETRIC: f64 = 1e-9;

fn refuse(reason: String) -> Error {
    Error::setting("cluster", reason)
}

/// Members from which the reduction to tridiagonal form is cheaper than rotations.
const MANY: usize = 8;

/// The small matrices, and workspace for one sample of them.
enum Work<'a> {
    Undamped { couplings: &'a ModalCouplings, slopes: Vec<Vec<f64>>, matrix: Vec<f64>, room: Tridiagonal },
    General { couplings: &'a ModalCouplings, matrix: Vec<Complex> },
}

impl<'a> Work<'a> {
    fn new(couplings: &'a ModalCouplings) -> Self {
        let m = couplings.eigenvalues.len();
        match couplings.family {
            Family::Undamped => {
                let real = |matrix: &Matrix<Complex>| matrix.as_flattened().iter().map(|x| x.re).collect();
                Self::Undamped {
                    couplings,
                    slopes: couplings.by_design.iter().map(real).collect(),
                    matrix: vec![0.0; m * m],
                    room: Tridiagonal::new(m),
                }
            }
            Family::General => Self::General { couplings, matrix: vec![Complex::default(); m * m] },
        }
    }

    /// Sets the matrix `diag(eigenvalues) + sum_k x_k by_design[k]` and returns the size of its largest element, unless
    /// that is beyond [`LARGEST`].
    fn fill(&mut self, x: &[f64]) -> Option<f64> {
        match self {
            Self::Undamped { couplings, slopes, matrix, .. } => {
                let values = couplings.eigenvalues.iter().map(|value| value.re);
                combine(matrix, values, slopes, x);
                below_largest(matrix.iter().map(|value| value.abs()))
            }
            Self::General { couplings, matrix } => {
                let slopes: Vec<&[Complex]> = couplings.by_design.iter().map(Matrix::as_flattened).collect();
                combine(matrix, couplings.eigenvalues.iter().copied(), &slopes, x);
                below_largest(matrix.iter().map(|value| value.l1_norm()))
            }
        }
    }

    /// Computes the eigenvalues; `false` if they were not found.
    fn solve(&mut self, values: &mut [Complex]) -> bool {
        let m = values.len();
        match self {
            Self::Undamped { matrix, .. } if m < MANY => {
                diagonalise(matrix, m, &mut []);
                for (i, value) in values.iter_mut().enumerate() {
                    *value = matrix[i * m + i].into();
                }
                true
            }
            Self::Undamped { matrix, room, .. } => {
                let Some(eigenvalues) = room.eigenvalues(matrix) else {
                    return false;
                };
                for (value, eigenvalue) in values.iter_mut().zip(eigenvalues) {
                    *value = (*eigenvalue).into();
                }
                true
            }
            Self::General { matrix, .. } => eigenvalues(matrix, values),
        }
    }
}

/// The largest of these sizes; `None` if one of them is not below [`LARGEST`].
fn below_largest(mut sizes: impl Iterator<Item = f64>) -> Option<f64> {
    sizes.try_fold(0.0, |most: f64, size| (size < LARGEST).then(|| most.max(size)))
}

/// `diag(values) + sum_k x_k slopes[k]`.
fn combine<T, S: AsRef<[T]>>(matrix: &mut [T], values: impl ExactSizeIterator<Item = T>, slopes: &[S], x: &[f64])
where
    T: Copy + Default + AddAssign + Mul<f64, Output = T>,
{
    let m = values.len();
    matrix.fill(T::default());
    for (i, value) in values.enumerate() {
        matrix[i * m + i] = value;
    }
    for (slopes, x) in slopes.iter().zip(x).filter(|(_, x)| **x != 0.0) {
        for (sum, slope) in matrix.iter_mut().zip(slopes.as_ref()) {
            *sum += *slope * *x;
        }
    }
}

/// Operations of one sample: the matrix, and its eigenvalues.
pub(super) fn operations(couplings: &ModalCouplings, tolerances: &Tolerances) -> f64 {
    let m = couplings.eigenvalues.len() as f64;
    let (fill, solve) = (tolerances.sigmas().iter().filter(|sigma| **sigma > 0.0).count() as f64 * m * m, m * m * m);
    match couplings.family {
        Family::Undamped if m < MANY as f64 => 2.0 * fill + 20.0 * solve,
        Family::Undamped => 2.0 * fill + 1.5 * solve + 60.0 * m * m,
        Family::General => 4.0 * fill + 200.0 * solve,
    }
}

/// Moments of a stream of values, summed in batches.
#[derive(Clone, Default)]
struct Sums {
    moments: Moments,
    behind: Vec<f64>,
}

impl Sums {
    fn add(&mut self, value: f64) {
        if self.behind.len() == CHUNK {
            self.moments.merge(&Moments::of(&self.behind));
            self.behind.clear();
        }
        self.behind.push(value);
    }

    fn statistics(&self) -> Option<Statistics> {
        let mut all = self.moments;
        all.merge(&Moments::of(&self.behind));
        Statistics::of(&all, None)
    }
}

/// Sums, over samples, of one quantity of the members, sorted by it.
struct Sorted {
    values: Vec<f64>,
    members: Vec<Sums>,
    splitting: Sums,
}

impl Sorted {
    fn new(m: usize) -> Self {
        Self { values: vec![0.0; m], members: vec![Sums::default(); m], splitting: Sums::default() }
    }

    fn add(&mut self, eigenvalues: &[Complex], quantity: impl Fn(Complex) -> Option<f64>) {
        for (value, &s) in self.values.iter_mut().zip(eigenvalues) {
            *value = quantity(s).unwrap_or(f64::NEG_INFINITY);
        }
        self.values.sort_unstable_by(f64::total_cmp);
        for (sums, &value) in self.members.iter_mut().zip(&self.values) {
            if value.is_finite() {
                sums.add(value);
            }
        }
        if let (Some(low), Some(high)) = (self.values.first(), self.values.last())
            && low.is_finite()
        {
            self.splitting.add(high - low);
        }
    }

    fn spread(&self, samples: usize) -> SortedSpread {
        let member = |sums: &Sums| {
            let value = sums.statistics();
            let count = value.as_ref().map_or(0, |value| value.count);
            MemberSpread { value, without: samples - count as usize }
        };
        SortedSpread { members: self.members.iter().map(member).collect(), splitting: self.splitting.statistics() }
    }
}
