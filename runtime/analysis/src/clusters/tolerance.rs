//! Clusters of modes that mix within the tolerances, and their spread: the mean of the eigenvalues, which has
//! derivatives, and the sorted members, by sampling.

use super::couplings::{ModalCouplings, PairSpreads, coupled_eigenvalue, modal_couplings};
use super::sampling::{ClusterSpread, frequency_of, operations, sample_cluster};
use crate::algebra::{Matrix, Vector};
use crate::kernels::DirectionalKernels;
use crate::modes::{CLUSTER_GAP, Family, merged};
use crate::sensitivity::Quantity;
use crate::tolerance::{Sampling, Spread, TRUSTED_DISTANCE, Tolerances};
use crate::{Behaviour, Complex, Description, Equilibrium, Error, Modes, Shared};

/// Limit on the additions and multiplications spent on the samples of one cluster, and the smallest number of samples.
const BUDGET: f64 = 1.5e8;
const FEWEST: usize = 256;
/// A number of samples that is enough for any cluster.
const SAMPLES: usize = 4096;

/// Relative difference of eigenvalues, by nominal values and within tolerances, that is rounding.
const EQUAL: f64 = 1e-9;

/// Modes that mix within the tolerances, or that rounding cannot tell apart.
///
/// A mode that has merged with its own conjugate is a defective cluster of one.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ClusterTolerance {
    /// Positions of the modes, from 0, ascending.
    pub modes: Vec<usize>,
    /// The family of the modes.
    pub family: Family,
    /// Nominal eigenvalues: `lambda` (1/s^2) for undamped modes, `s` (1/s) for general ones.
    pub eigenvalues: Vec<Complex>,
    /// Smallest distance between two members, in standard deviations of the effects that change their difference
    /// ([`clusters`] defines it); zero for equal eigenvalues.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub distance: f64,
    /// Whether the eigenvalues are equal in every design: no tolerance splits them, so each has the spread of the mean.
    #[cfg_attr(feature = "serde", serde(default))]
    pub equal: bool,
    /// Mean of the eigenvalues with its derivatives; `None` for a defective cluster.
    pub mean: Option<MeanEigenvalue>,
    /// Spread of the sorted members from up to 4096 samples with a fixed seed, or the reason why there is none:
    /// [`Error::Defective`], or [`Error::Setting`] for tolerances beyond the range of a double.
    pub spread: Result<ClusterSpread, Error>,
    /// Number of standard deviations that a tolerance and a band represent.
    pub sigma_level: f64,
    /// The inputs of the operating point, SI.
    pub inputs: Vector,
    /// The mechanism they belong to.
    pub description: Shared<Description>,
}

impl ClusterTolerance {
    /// Whether the members have merged into one eigenvalue without derivatives.
    #[must_use]
    pub fn defective(&self) -> bool {
        matches!(self.spread, Err(Error::Defective { .. }))
    }
}

/// Mean of the eigenvalues of a cluster. It always has exact derivatives, because it is a trace.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MeanEigenvalue {
    /// The mean of `lambda` (1/s^2) or of `s` (1/s).
    pub value: Complex,
    /// Total derivatives with respect to the inputs, per SI unit.
    pub by_input: Vector<Complex>,
    /// Total derivatives with respect to the design variables, per SI unit.
    pub by_design: Vector<Complex>,
    /// Standard deviation of the real part: of `lambda`, or of the growth rate.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub sigma_re: f64,
    /// Standard deviation of the imaginary part; zero for undamped modes.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub sigma_im: f64,
    /// First-order spread of the frequency of the mean, `sqrt(lambda)` or `Im s`, rad/s; `None` if it does not
    /// oscillate.
    pub frequency: Option<Spread>,
    /// First-order spread of the damping ratio of the mean; `None` for undamped modes or without a frequency.
    pub damping_ratio: Option<Spread>,
}

/// Finds the clusters of a set of modes under tolerances, each once, in the order of their first modes.
///
/// For a change `x` of the design variables, two modes differ by `sqrt((gap + d)^2 + 4 o_ij o_ji)` with
/// `d = x.(S_ii - S_jj)` and `o = x.S`, where `S` are the couplings of [`modal_couplings`]. This lies within
/// `|d| + 2 sqrt|o_ij o_ji|` of the gap. Adding the standard deviations of both terms gives
/// `spread = sigma(d) + 2 sqrt(sigma(o_ij) sigma(o_ji))`, where the standard deviation of a complex number is that of
/// its distance from the mean. Two modes belong together if `gap / spread` is less than [`TRUSTED_DISTANCE`], or if the
/// gap is within rounding (1e-6 of the larger eigenvalue); clusters are chains of such pairs. For two modes about to
/// merge into a defective one, `gap / spread` is the distance to that state: half the gap squared over the standard
/// deviation of the discriminant.
///
/// # Errors
/// [`Error::CriticalState`] if `Khat` is singular, [`Error::OutsideDomain`], [`Error::WrongLength`] for tolerances of
/// another mechanism.
pub fn clusters(
    mechanism: &dyn DirectionalKernels,
    at: &Equilibrium,
    modes: &Modes,
    tolerances: &Tolerances,
) -> Result<Vec<ClusterTolerance>, Error> {
    let groups = groups(mechanism, at, modes, tolerances)?;
    let members: Vec<usize> = groups.iter().flatten().copied().collect();
    if members.is_empty() {
        return Ok(Vec::new());
    }
    let couplings = modal_couplings(mechanism, at, modes, &members)?;
    let mut first = 0;
    Ok(groups
        .iter()
        .map(|group| {
            let places: Vec<usize> = (first..first + group.len()).collect();
            first += group.len();
            tolerance(&couplings.among(&places), modes, tolerances)
        })
        .collect())
}

/// The positions of the modes of each cluster, as [`clusters`] finds them.
pub fn groups(
    mechanism: &dyn DirectionalKernels,
    at: &Equilibrium,
    modes: &Modes,
    tolerances: &Tolerances,
) -> Result<Vec<Vec<usize>>, Error> {
    tolerances.check_count(at.design.len())?;
    let count = modes.modes.len();
    if count == 0 || count == 1 && !merged(modes, 0) {
        return Ok(Vec::new());
    }
    let all: Vec<usize> = (0..count).collect();
    let spreads = PairSpreads::of_independent(mechanism, at, modes, tolerances)?;
    let stored = match &spreads {
        Some(_) => None,
        None => Some(modal_couplings(mechanism, at, modes, &all)?),
    };
    let pair = |(i, j): (usize, usize)| match (&spreads, &stored) {
        (Some(spreads), _) => Some(Pair::of(spreads, modes, (i, j))),
        (None, Some(couplings)) => Some(Pair::new(couplings, (i, j), tolerances)),
        (None, None) => None,
    };
    let mut label = all;
    for i in 0..count {
        for j in 0..i {
            let mixes = |pair: Pair| together(&pair, modes, (i, j));
            // Nothing mixes a free direction with another mode.
            let free = |r: usize| modes.modes[r].behaviour == Behaviour::Free;
            if free(i) || free(j) {
                continue;
            }
            if label[i] != label[j] && pair((i, j)).is_some_and(mixes) {
                let (old, new) = (label[i].max(label[j]), label[i].min(label[j]));
                label.iter_mut().filter(|x| **x == old).for_each(|x| *x = new);
            }
        }
    }
    let members = |first| (0..count).filter(|&i| label[i] == first).collect();
    let wanted = |group: &Vec<usize>| group.len() > 1 || group.iter().any(|&mode| merged(modes, mode));
    Ok((0..count).map(members).filter(wanted).collect())
}

/// The effects that change the difference of two modes.
struct Pair {
    gap: f64,
    /// Standard deviation of the difference as if each mode stood alone.
    apart: f64,
    /// Standard deviation of the mixing, `2 sqrt(sigma(o_ij) sigma(o_ji))`.
    mixing: f64,
}

impl Pair {
    fn of(spreads: &PairSpreads, modes: &Modes, (i, j): (usize, usize)) -> Self {
        let coupled = |i: usize, j: usize| spreads.coupling[i][j].sqrt();
        Self {
            gap: (coupled_eigenvalue(modes, i) - coupled_eigenvalue(modes, j)).norm(),
            apart: spreads.apart[i][j],
            mixing: 2.0 * coupled(i, j) * coupled(j, i),
        }
    }

    fn new(couplings: &ModalCouplings, (i, j): (usize, usize), tolerances: &Tolerances) -> Self {
        let sigma = |slopes: &Vector<Complex>| {
            let part = |pick: fn(Complex) -> f64| tolerances.sigma(&slopes.map(pick));
            part(|value| value.re).hypot(part(|value| value.im))
        };
        let difference = couplings.element(i, i).zip(couplings.element(j, j));
        let apart = sigma(&difference.map(|(a, b)| a - b).collect());
        let mixed = |i, j| sigma(&couplings.element(i, j).collect()).sqrt();
        Self {
            gap: (couplings.eigenvalues[i] - couplings.eigenvalues[j]).norm(),
            apart,
            mixing: 2.0 * mixed(i, j) * mixed(j, i),
        }
    }

    /// Distance in standard deviations.
    fn distance(&self) -> f64 {
        if self.gap == 0.0 {
            return 0.0;
        }
        self.gap / (self.apart + self.mixing)
    }

    /// Whether the difference under tolerances results from cancellation: near a defective eigenvalue, couplings grow
    /// without bound and cancel in the observable difference `(gap + d)^2 + 4 o_ij o_ji`.
    fn hidden_by_rounding(&self, condition: f64) -> bool {
        const WELL_CONDITIONED: f64 = 1e4;
        const NOTICEABLE: f64 = 1e-3;
        let rounding = 16.0 * f64::EPSILON * condition * (self.apart + self.mixing).powi(2);
        let seen = self.gap * (self.gap + 2.0 * self.apart);
        condition > WELL_CONDITIONED && (rounding.is_nan() || rounding > NOTICEABLE * seen)
    }
}

fn together(pair: &Pair, modes: &Modes, (i, j): (usize, usize)) -> bool {
    let values = [i, j].map(|r| coupled_eigenvalue(modes, r));
    let (a, b) = (&modes.modes[i], &modes.modes[j]);
    if pair.gap <= CLUSTER_GAP * values[0].norm().max(values[1].norm()) {
        return true;
    }
    if merged(modes, i) || merged(modes, j) {
        // Their couplings are meaningless: only rounding errors can be compared.
        let error = if a.error < b.error { b.error } else { a.error };
        return error.is_finite() && pair.gap <= error;
    }
    pair.distance() < TRUSTED_DISTANCE
}

fn tolerance(couplings: &ModalCouplings, modes: &Modes, tolerances: &Tolerances) -> ClusterTolerance {
    let mode_at = |index: usize| &modes.modes[couplings.modes[index]];
    let count = couplings.modes.len();
    let mut defective = couplings.modes.iter().any(|&mode| merged(modes, mode));
    let mut distance = f64::INFINITY;
    let mut equal = count > 1;
    for i in 0..count {
        for j in 0..i {
            let pair = Pair::new(couplings, (i, j), tolerances);
            let condition = mode_at(i).condition.max(mode_at(j).condition);
            defective = defective || pair.hidden_by_rounding(condition);
            distance = distance.min(pair.distance());
            let values = [i, j].map(|index| couplings.eigenvalues[index].norm());
            equal &= pair.gap + pair.apart + pair.mixing <= EQUAL * values[0].max(values[1]);
        }
    }
    let finite = couplings.by_design.iter().chain(&couplings.by_input);
    defective = defective || !finite.flat_map(Matrix::as_flattened).all(|value| value.is_finite());
    let spread = if defective {
        let modes = couplings.modes.clone();
        Err(Error::Defective { modes })
    } else {
        let affordable = (BUDGET / operations(couplings, tolerances)) as usize;
        let samples = affordable.clamp(FEWEST, SAMPLES);
        sample_cluster(couplings, tolerances, &Sampling::default().samples(samples))
    };
    ClusterTolerance {
        modes: couplings.modes.clone(),
        family: couplings.family,
        eigenvalues: couplings.eigenvalues.clone(),
        distance: if defective || equal { 0.0 } else { distance },
        equal: equal && !defective,
        mean: (!defective).then(|| MeanEigenvalue::new(couplings, tolerances)),
        spread,
        sigma_level: tolerances.sigma_level(),
        inputs: modes.inputs.clone(),
        description: modes.description.clone(),
    }
}

impl MeanEigenvalue {
    fn new(couplings: &ModalCouplings, tolerances: &Tolerances) -> Self {
        let (value, family) = (couplings.mean(), couplings.family);
        let by_design = Vector::from(couplings.mean_by_design());
        let spread = |mean, slope: &dyn Fn(Complex) -> f64| Spread::new(mean, by_design.map(slope), tolerances);
        let frequency = frequency_of(family, value);
        Self {
            value,
            by_input: couplings.mean_by_input().into(),
            sigma_re: tolerances.sigma(&by_design.map(|slope| slope.re)),
            sigma_im: tolerances.sigma(&by_design.map(|slope| slope.im)),
            frequency: frequency.map(|mean| match family {
                Family::Undamped => spread(mean, &|slope| 0.5 * slope.re / mean),
                Family::General => spread(mean, &|slope| slope.im),
            }),
            damping_ratio: frequency.filter(|_| family == Family::General).map(|_| {
                let ratio = Quantity::DampingRatio;
                spread(ratio.value(value), &|slope| ratio.slope(value, slope))
            }),
            by_design,
        }
    }
}
