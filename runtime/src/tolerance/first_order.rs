//! First-order spread: `sigma^2 = S Sigma S^T` (eq. 27 for several variables), with a measure of when to believe it.

use super::Tolerances;
use crate::sensitivity::OutputSensitivities;
use crate::{Description, Modes, Sensitivities};

/// Nearer to the critical state, or to another mode, than this many standard deviations, first order is not to be
/// trusted: its error grows without bound.
///
/// It is a warning, not a bound on the error beyond. For the rotating bar, against quadrature of the exact
/// distribution, first order misses the standard deviation at this distance by -3.4, -4.5 and -7.4 % for tolerances of
/// 3, 6 and 12 %; for 12 % an error of a few percent needs about 6 standard deviations. Large tolerances bend the
/// frequency itself, which a distance to the critical state does not show.
pub const TRUSTED_DISTANCE: f64 = 4.5;

/// First-order spread of one mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeTolerance<const P: usize> {
    /// Nominal eigenvalue, 1/s^2, which at first order is the mean.
    pub lambda: f64,
    /// Standard deviation of `lambda`, 1/s^2.
    pub lambda_sigma: f64,
    /// Nominal frequency, rad/s, which at first order is the mean; `None` for a mode that does not oscillate.
    pub mean: Option<f64>,
    /// Standard deviation of the frequency, rad/s.
    pub sigma: Option<f64>,
    /// Half-width of the band that holds as many standard deviations as the tolerances do, rad/s.
    pub band: Option<f64>,
    /// Share of each design variable in the variance of `lambda` (the same for the frequency); they sum to 1, or are
    /// all zero when nothing varies. Correlated variables can have negative shares.
    pub variance_shares: [f64; P],
    /// `lambda / lambda_sigma`: standard deviations between this mode and the state where its stiffness vanishes;
    /// infinite when nothing moves the mode.
    pub distance_to_critical: f64,
    /// Standard deviations of the difference between this mode's `lambda` and the nearest one: where it is small, samples
    /// exchange the two modes or mix their shapes. Infinite for a single mode or when nothing moves the difference.
    pub distance_to_neighbour: f64,
    /// The mode shares a cluster of nearly equal eigenvalues: first order does not apply to it.
    pub clustered: bool,
}

impl<const P: usize> ModeTolerance<P> {
    /// Whether no other mode is so near that tolerances bring the two together.
    pub fn alone(&self) -> bool {
        !self.clustered && self.distance_to_neighbour >= TRUSTED_DISTANCE
    }
}

/// First-order spread of all modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstOrder<const N: usize, const P: usize> {
    /// One entry for each mode.
    pub modes: [ModeTolerance<P>; N],
    /// How many standard deviations a tolerance and a band hold.
    pub sigma_level: f64,
    /// The least of the modes' distances to the critical state. Beyond the critical state the equilibrium changes
    /// branch, which bends every mode, so the nearest mode limits the trust in all.
    pub distance_to_critical: f64,
    /// The mechanism it belongs to.
    pub description: &'static Description,
}

impl<const N: usize, const P: usize> FirstOrder<N, P> {
    /// Whether the critical state and the neighbouring modes are far enough away ([`TRUSTED_DISTANCE`]).
    pub fn trusted(&self) -> bool {
        self.distance_to_critical >= TRUSTED_DISTANCE && self.modes.iter().all(ModeTolerance::alone)
    }
}

/// First-order spread of one output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutputTolerance<const P: usize> {
    /// Nominal value, SI.
    pub mean: f64,
    /// Standard deviation, SI; `None` where the output has no derivative.
    pub sigma: Option<f64>,
    /// Half-width that holds as many standard deviations as the tolerances do, SI; `None` likewise.
    pub band: Option<f64>,
    /// Share of each design variable in the variance; `None` likewise.
    pub variance_shares: Option<[f64; P]>,
}

/// First-order spread of every output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutputTolerances<const P: usize, const O: usize> {
    /// In the order of the declaration.
    pub outputs: [OutputTolerance<P>; O],
    /// Standard deviations that a tolerance holds.
    pub sigma_level: f64,
    /// The mechanism they belong to.
    pub description: &'static Description,
}

/// First-order spread of every mode.
pub fn first_order<const N: usize, const U: usize, const P: usize>(
    modes: &Modes<N>,
    sensitivities: &Sensitivities<N, U, P>,
    tolerances: &Tolerances<P>,
) -> FirstOrder<N, P> {
    let level = tolerances.sigma_level();
    let spread: [ModeTolerance<P>; N] = core::array::from_fn(|r| {
        let (mode, own) = (&modes.modes[r], &sensitivities.modes[r]);
        let (lambda_sigma, variance_shares) = tolerances.spread(&own.lambda_by_design);
        let mean = mode.frequency();
        let sigma = mean.map(|omega| lambda_sigma / (2.0 * omega));
        ModeTolerance {
            lambda: mode.lambda,
            lambda_sigma,
            mean,
            sigma,
            band: sigma.map(|sigma| level * sigma),
            variance_shares,
            distance_to_critical: if lambda_sigma > 0.0 {
                mode.lambda / lambda_sigma
            } else if mode.lambda > 0.0 {
                f64::INFINITY
            } else {
                0.0
            },
            distance_to_neighbour: distance_to_neighbour(r, modes, sensitivities, tolerances),
            clustered: own.clustered,
        }
    });
    let distance_to_critical = spread.iter().fold(f64::INFINITY, |least, mode| {
        least.min(mode.distance_to_critical)
    });
    FirstOrder {
        modes: spread,
        sigma_level: level,
        distance_to_critical,
        description: modes.description,
    }
}

/// First-order spread of every output.
pub fn output_tolerances<const U: usize, const P: usize, const O: usize>(
    outputs: &OutputSensitivities<U, P, O>,
    tolerances: &Tolerances<P>,
) -> OutputTolerances<P, O> {
    let sigma_level = tolerances.sigma_level();
    let spread = core::array::from_fn(|o| {
        let spread = outputs.by_design[o].map(|slopes| tolerances.spread(&slopes));
        let sigma = spread.map(|(sigma, _)| sigma);
        OutputTolerance {
            mean: outputs.values[o],
            sigma,
            band: sigma.map(|sigma| sigma_level * sigma),
            variance_shares: spread.map(|(_, shares)| shares),
        }
    });
    OutputTolerances {
        outputs: spread,
        sigma_level,
        description: outputs.description,
    }
}

/// Least distance of mode `r` to another one, in standard deviations of their difference.
fn distance_to_neighbour<const N: usize, const U: usize, const P: usize>(
    r: usize,
    modes: &Modes<N>,
    sensitivities: &Sensitivities<N, U, P>,
    tolerances: &Tolerances<P>,
) -> f64 {
    let own = &sensitivities.modes[r].lambda_by_design;
    (0..N)
        .filter(|&other| other != r)
        .fold(f64::INFINITY, |least, other| {
            // Halves, because a difference may exceed the range of a double.
            let neighbour = &sensitivities.modes[other].lambda_by_design;
            let slope = core::array::from_fn(|j| 0.5 * own[j] - 0.5 * neighbour[j]);
            let sigma = tolerances.sigma(&slope);
            let gap = (0.5 * modes.modes[r].lambda - 0.5 * modes.modes[other].lambda).abs();
            if sigma > 0.0 {
                least.min(gap / sigma)
            } else {
                least
            }
        })
}
