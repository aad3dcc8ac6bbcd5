//! A cluster of nearly equal eigenvalues: no member has a derivative, but the small matrix that splits them has.

use super::distribution::diagonalise;
use super::sampling::Draw;
use super::statistics::Moments;
use super::{Statistics, Tolerances};
use crate::Error;

/// First-order model of `m` nearly equal eigenvalues: those of `diag(values) + sum_k slopes_k x_k` for deviations `x` of the
/// design variables.
#[derive(Clone, Copy, Debug)]
pub struct Cluster<'a, const P: usize> {
    /// The `m` eigenvalues at the nominal design.
    pub values: &'a [f64],
    /// For each design variable the derivative of the small matrix, `m` x `m`, row by row.
    pub slopes: &'a [Vec<f64>; P],
    /// Whether the matrices are symmetric. Others are taken for pairs only (`m = 2`).
    pub symmetric: bool,
}

/// How to sample a cluster.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClusterSampling {
    /// Number of samples.
    pub samples: usize,
    /// The same seed gives bit-identical results.
    pub seed: u64,
    /// Which of the independent sequences of the seed.
    pub stream: u64,
}

impl Default for ClusterSampling {
    fn default() -> Self {
        Self {
            samples: 4096,
            seed: 0,
            stream: 0,
        }
    }
}

/// Spread of a cluster.
#[derive(Clone, Debug, PartialEq)]
pub struct ClusterSpread {
    /// Mean of the eigenvalues at the nominal design; the mean over all designs too, as it is linear in them.
    pub mean: f64,
    /// Standard deviation of the mean of the eigenvalues (a trace), exact for the model.
    pub mean_sigma: f64,
    /// The sampled eigenvalues by position, ascending (by their real parts when complex).
    pub members: Vec<MemberSpread>,
    /// Samples with a complex pair.
    pub complex: usize,
    /// Modulus of the imaginary parts over those samples; `None` without any.
    pub imaginary: Option<Statistics>,
    /// Number of samples.
    pub samples: usize,
}

impl ClusterSpread {
    /// The least eigenvalue; `None` for an empty cluster.
    pub fn lowest(&self) -> Option<&MemberSpread> {
        self.members.first()
    }

    /// The greatest eigenvalue; `None` for an empty cluster.
    pub fn highest(&self) -> Option<&MemberSpread> {
        self.members.last()
    }
}

/// Spread of one position of a sorted cluster.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MemberSpread {
    /// The eigenvalue, its real part when complex; `None` without samples.
    pub value: Option<Statistics>,
    /// The function of the eigenvalue over the samples that have it; `None` without any.
    pub function: Option<Statistics>,
    /// Samples whose eigenvalue is complex or outside of the domain of the function.
    pub without: usize,
}

/// Samples the eigenvalues of a cluster, and a `function` of each, such as the frequency `sqrt(lambda)` where there is one.
///
/// # Errors
/// [`Error::Setting`] for matrices of a wrong size, not finite, said to be symmetric and not, or not symmetric and larger
/// than 2 x 2, and for samples beyond the range of a double.
pub fn sample_cluster<const P: usize>(
    cluster: &Cluster<'_, P>,
    tolerances: &Tolerances<P>,
    sampling: &ClusterSampling,
    function: fn(f64) -> Option<f64>,
) -> Result<ClusterSpread, Error> {
    let m = cluster.values.len();
    cluster.check()?;
    let mut sums = vec![(Moments::EMPTY, Moments::EMPTY); m];
    let mut imaginary = Moments::EMPTY;
    let mut complex = 0;
    let mut work = Work::new(m);
    let mut draw = Draw::from((sampling.seed, sampling.stream), 0, &[0.0; P], tolerances);
    for _ in 0..sampling.samples {
        work.fill(cluster, &draw.next());
        if !work.matrix.iter().all(|value| value.abs() < LARGEST) {
            return Err(refuse("a sample exceeds the range of a double".to_owned()));
        }
        let part = work.solve(cluster.symmetric);
        if let Some(part) = part {
            complex += 1;
            imaginary.add(part);
        }
        for ((values, functions), &value) in sums.iter_mut().zip(&work.values) {
            values.add(value);
            let image = if part.is_none() {
                function(value)
            } else {
                None
            };
            if let Some(image) = image.filter(|image| image.is_finite()) {
                functions.add(image);
            }
        }
    }
    let (mean, mean_sigma) = cluster.mean(tolerances);
    Ok(ClusterSpread {
        mean,
        mean_sigma,
        members: sums
            .iter()
            .map(|(values, functions)| {
                let function = functions.statistics();
                MemberSpread {
                    value: values.statistics(),
                    function,
                    without: sampling.samples - function.map_or(0, |found| found.count),
                }
            })
            .collect(),
        complex,
        imaginary: imaginary.statistics(),
        samples: sampling.samples,
    })
}

/// Elements up to here can be squared and added by the eigenvalue iteration.
const LARGEST: f64 = 1e150;

impl<const P: usize> Cluster<'_, P> {
    /// Mean of the eigenvalues and its standard deviation.
    fn mean(&self, tolerances: &Tolerances<P>) -> (f64, f64) {
        let m = self.values.len();
        let share = 1.0 / m.max(1) as f64;
        let trace = |slopes: &Vec<f64>| (0..m).map(|i| share * slopes[i * m + i]).sum();
        let slopes = self.slopes.each_ref().map(trace);
        let mean = self.values.iter().map(|value| share * value).sum();
        (mean, tolerances.sigma(&slopes))
    }

    fn check(&self) -> Result<(), Error> {
        let m = self.values.len();
        if !self.symmetric && m > 2 {
            return Err(refuse(format!(
                "{m} eigenvalues of nonsymmetric matrices: more than two are not sampled"
            )));
        }
        for (k, slopes) in self.slopes.iter().enumerate() {
            if slopes.len() != m * m {
                return Err(refuse(format!(
                    "matrix {k} has {} elements and must have {}",
                    slopes.len(),
                    m * m
                )));
            }
            let size = slopes.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            let mirrored = |e: usize| (slopes[e] - slopes[e % m * m + e / m]).abs();
            if self.symmetric && (0..m * m).any(|e| mirrored(e) > 1e-9 * size) {
                return Err(refuse(format!("matrix {k} is not symmetric")));
            }
        }
        let mut numbers = self.values.iter().chain(self.slopes.iter().flatten());
        match numbers.find(|value| !value.is_finite()) {
            Some(value) => Err(refuse(format!("an element is {value}"))),
            None => Ok(()),
        }
    }
}

fn refuse(reason: String) -> Error {
    Error::Setting {
        setting: "cluster",
        reason,
    }
}

/// Space for one sample.
struct Work {
    matrix: Vec<f64>,
    values: Vec<f64>,
}

impl Work {
    fn new(m: usize) -> Self {
        Self {
            matrix: vec![0.0; m * m],
            values: vec![0.0; m],
        }
    }

    /// `diag(values) + sum_k slopes_k x_k`.
    fn fill<const P: usize>(&mut self, cluster: &Cluster<'_, P>, x: &[f64; P]) {
        let m = cluster.values.len();
        self.matrix.fill(0.0);
        for (i, &value) in cluster.values.iter().enumerate() {
            self.matrix[i * m + i] = value;
        }
        for (slopes, &x) in cluster.slopes.iter().zip(x) {
            for (sum, slope) in self.matrix.iter_mut().zip(slopes) {
                *sum += slope * x;
            }
        }
    }

    /// Fills the values, ascending; the imaginary part of a complex pair.
    fn solve(&mut self, symmetric: bool) -> Option<f64> {
        let m = self.values.len();
        let mut imaginary = None;
        if !symmetric && m == 2 {
            let middle = 0.5 * (self.matrix[0] + self.matrix[3]);
            let half = 0.5 * (self.matrix[0] - self.matrix[3]);
            let inside = half * half + self.matrix[1] * self.matrix[2];
            let root = inside.abs().sqrt();
            let apart = if inside < 0.0 { 0.0 } else { root };
            imaginary = (inside < 0.0).then_some(root);
            self.values
                .copy_from_slice(&[middle - apart, middle + apart]);
        } else {
            diagonalise(&mut self.matrix, m, &mut []);
            for (i, value) in self.values.iter_mut().enumerate() {
                *value = self.matrix[i * m + i];
            }
            self.values.sort_by(f64::total_cmp);
        }
        imaginary
    }
}
