//! First-order spread: `sigma^2 = S Sigma S^T` (eq. 27 for several variables), with a measure of when to believe it.

use super::Tolerances;
use crate::array::greater;
use crate::modes::{Family, PerMode};
use crate::sensitivity::{ModeSensitivity, OutputSensitivities, Quantity};
use crate::{Behaviour, Description, Mode, Modes, Sensitivities};

/// Nearer to the critical state, or to another mode, than this many standard deviations, first order is not to be
/// trusted: its error grows without bound.
///
/// It is a warning, not a bound on the error beyond. For the rotating bar, against quadrature of the exact
/// distribution, first order misses the standard deviation at this distance by -3.4, -4.5 and -7.4 % for tolerances of
/// 3, 6 and 12 %; for 12 % an error of a few percent needs about 6 standard deviations. Large tolerances bend the
/// frequency itself, which a distance to the critical state does not show.
pub const TRUSTED_DISTANCE: f64 = 4.5;

/// First-order spread of one quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread<const P: usize> {
    /// Nominal value, SI, which at first order is the mean.
    pub mean: f64,
    /// Standard deviation, SI.
    pub sigma: f64,
    /// Half-width of the band that holds as many standard deviations as the tolerances do, SI.
    pub band: f64,
    /// Share of each design variable in the variance; they sum to 1, or are all zero when nothing varies. Correlated
    /// variables can have negative shares.
    pub variance_shares: [f64; P],
}

impl<const P: usize> Spread<P> {
    /// The spread of a quantity from its value and its derivatives.
    pub fn new(mean: f64, slopes: &[f64; P], tolerances: &Tolerances<P>) -> Self {
        let (sigma, variance_shares) = tolerances.spread(slopes);
        Self {
            mean,
            sigma,
            band: tolerances.sigma_level() * sigma,
            variance_shares,
        }
    }
}

/// First-order spread of one mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeTolerance<const P: usize> {
    /// Nominal `-Re s^2`, 1/s^2: of an undamped mode the eigenvalue.
    pub lambda: f64,
    /// Standard deviation of `lambda`, 1/s^2; infinite for a general mode without a derivative (a defective eigenvalue).
    pub lambda_sigma: f64,
    /// Nominal frequency `Im s`, rad/s, which at first order is the mean; `None` for a mode that does not oscillate.
    pub mean: Option<f64>,
    /// Standard deviation of the frequency, rad/s.
    pub sigma: Option<f64>,
    /// Half-width of the band that holds as many standard deviations as the tolerances do, rad/s.
    pub band: Option<f64>,
    /// Share of each design variable in the variance of the frequency, or of `lambda` for a mode that does not oscillate;
    /// they sum to 1, or are all zero when nothing varies. Correlated variables can have negative shares.
    pub variance_shares: [f64; P],
    /// The natural frequency `|s|`, rad/s; `None` for a mode that does not oscillate.
    pub natural_frequency: Option<Spread<P>>,
    /// The damping ratio; `None` for a mode that does not oscillate.
    pub damping_ratio: Option<Spread<P>>,
    /// The growth `Re s`, 1/s; `None` where the eigenvalue has no derivative.
    pub growth: Option<Spread<P>>,
    /// Standard deviations between this mode and the state where its stiffness vanishes: `lambda / lambda_sigma`, with
    /// `|s|^2` for `lambda` of a general mode; negative when the mode diverges, zero when it is neutral, infinite when nothing moves it or when
    /// it has no derivative that would tell.
    pub distance_to_critical: f64,
    /// Standard deviations between the growth of this mode and zero: negative when it grows, zero when it neither grows nor
    /// decays within rounding though tolerances move its growth. Infinite when nothing moves the growth beyond rounding, as for undamped
    /// modes.
    pub distance_to_instability: f64,
    /// Standard deviations of the difference between this mode's eigenvalue and the nearest one: where it is small, samples
    /// exchange the two modes or mix their shapes. Infinite for a single mode or when nothing moves the difference.
    pub distance_to_neighbour: f64,
    /// The mode is a member of a cluster of nearly equal eigenvalues ([`Modes::cluster_of`]): first order does not apply to it,
    /// and the numbers here belong to the computed basis of the cluster. That tolerances mix modes
    /// farther apart is told by [`clusters`](super::clusters) and [`summary`](super::summary).
    pub clustered: bool,
}

impl<const P: usize> ModeTolerance<P> {
    /// What stands where a spread is going to be written.
    const BLANK: Self = Self {
        lambda: 0.0,
        lambda_sigma: 0.0,
        mean: None,
        sigma: None,
        band: None,
        variance_shares: [0.0; P],
        natural_frequency: None,
        damping_ratio: None,
        growth: None,
        distance_to_critical: 0.0,
        distance_to_instability: 0.0,
        distance_to_neighbour: 0.0,
        clustered: false,
    };

    /// Whether no other mode is so near that tolerances bring the two together.
    pub fn alone(&self) -> bool {
        !self.clustered && self.distance_to_neighbour >= TRUSTED_DISTANCE
    }
}

/// First-order spread of all modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstOrder<const N: usize, const P: usize> {
    /// One entry for each mode.
    pub modes: PerMode<ModeTolerance<P>, N>,
    /// How many standard deviations a tolerance and a band hold.
    pub sigma_level: f64,
    /// The least of the modes' distances to the critical state. Beyond the critical state the equilibrium changes
    /// branch, which bends every mode, so the nearest mode limits the trust in all.
    pub distance_to_critical: f64,
    /// Which modes they belong to.
    pub family: Family,
    /// The mechanism it belongs to.
    pub description: &'static Description,
}

impl<const N: usize, const P: usize> FirstOrder<N, P> {
    /// Whether the critical state and the neighbouring modes are far enough away ([`TRUSTED_DISTANCE`]). It looks at each
    /// mode alone; [`summary`](super::summary) also sees what mixes modes and how frequencies bend.
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
// Inlined, as what it returns is long to copy.
#[inline(always)]
pub fn first_order<const N: usize, const U: usize, const P: usize>(
    modes: &Modes<N>,
    sensitivities: &Sensitivities<N, U, P>,
    tolerances: &Tolerances<P>,
) -> FirstOrder<N, P> {
    let mut found = FirstOrder {
        modes: const { PerMode::blank(ModeTolerance::BLANK) },
        sigma_level: tolerances.sigma_level(),
        distance_to_critical: f64::INFINITY,
        family: modes.family,
        description: modes.description,
    };
    let of_modes = modes.modes.iter().zip(&sensitivities.modes);
    let places = found.modes.places(sensitivities.modes.len()).iter_mut();
    for (spread, (mode, own)) in places.zip(of_modes) {
        *spread = match modes.family {
            Family::Undamped => undamped(mode, own, tolerances),
            Family::General => general(mode, own, tolerances),
        };
        found.distance_to_critical = found.distance_to_critical.min(spread.distance_to_critical);
    }
    for r in 0..found.modes.len() {
        for other in 0..r {
            let own = distances(r, other, modes, sensitivities, tolerances);
            for (place, distance) in [r, other].into_iter().zip(own) {
                let least = &mut found.modes[place].distance_to_neighbour;
                *least = least.min(distance);
            }
        }
    }
    found
}

/// The spread of an undamped mode, its neighbours left out: `s` is a root of `lambda`, so that every spread is that of `lambda`, or nothing.
#[inline]
fn undamped<const N: usize, const U: usize, const P: usize>(
    mode: &Mode<N>,
    own: &ModeSensitivity<U, P>,
    tolerances: &Tolerances<P>,
) -> ModeTolerance<P> {
    let (lambda_sigma, lambda_shares) = tolerances.spread(&own.lambda_by_design);
    let level = tolerances.sigma_level();
    let moving = |mean: f64| {
        let sigma = lambda_sigma / (2.0 * greater(mode.s.re, mode.s.im));
        Spread {
            mean,
            sigma,
            band: level * sigma,
            variance_shares: lambda_shares,
        }
    };
    let still = |mean: f64| Spread {
        mean,
        sigma: 0.0,
        band: level * 0.0,
        variance_shares: [0.0; P],
    };
    let mean = mode.frequency();
    let frequency = own.s.and(mean).map(moving);
    let growth = own.s.map(|_| match mean {
        Some(_) => still(mode.s.re),
        None => moving(mode.s.re),
    });
    ModeTolerance {
        lambda: mode.lambda,
        lambda_sigma,
        mean,
        sigma: frequency.map(|spread| spread.sigma),
        band: frequency.map(|spread| spread.band),
        variance_shares: lambda_shares,
        natural_frequency: frequency,
        damping_ratio: frequency.map(|_| still(0.0)),
        growth,
        distance_to_critical: match mode.behaviour {
            Behaviour::Neutral => 0.0,
            _ => in_sigmas(mode.lambda, lambda_sigma),
        },
        distance_to_instability: f64::INFINITY,
        distance_to_neighbour: f64::INFINITY,
        clustered: own.clustered,
    }
}

/// The spread of a general mode, its neighbours left out: that of each quantity by its own derivatives.
fn general<const N: usize, const U: usize, const P: usize>(
    mode: &Mode<N>,
    own: &ModeSensitivity<U, P>,
    tolerances: &Tolerances<P>,
) -> ModeTolerance<P> {
    let (lambda_sigma, lambda_shares) = match own.s {
        None => (f64::INFINITY, [0.0; P]),
        Some(_) => tolerances.spread(&own.lambda_by_design),
    };
    let of = |quantity: Quantity| {
        let slopes = own.of(quantity)?;
        Some(Spread::new(
            quantity.of(mode)?,
            &slopes.by_design,
            tolerances,
        ))
    };
    let (frequency, natural_frequency) = (of(Quantity::Frequency), of(Quantity::NaturalFrequency));
    let growth = of(Quantity::Growth);
    ModeTolerance {
        lambda: mode.lambda,
        lambda_sigma,
        mean: mode.frequency(),
        sigma: frequency.map(|spread| spread.sigma),
        band: frequency.map(|spread| spread.band),
        variance_shares: frequency.map_or(lambda_shares, |spread| spread.variance_shares),
        natural_frequency,
        damping_ratio: of(Quantity::DampingRatio),
        growth,
        distance_to_critical: distance_to_zero(mode, natural_frequency, growth),
        distance_to_instability: growth
            .filter(|spread| !keeps_amplitude(mode, spread))
            .map_or(f64::INFINITY, |spread| match mode.behaviour {
                Behaviour::Oscillating(_) => 0.0,
                _ => in_sigmas(-spread.mean, spread.sigma),
            }),
        distance_to_neighbour: f64::INFINITY,
        clustered: own.clustered,
    }
}

/// Whether neither the growth nor what tolerances add to it can be told from zero.
fn keeps_amplitude<const N: usize, const P: usize>(mode: &Mode<N>, growth: &Spread<P>) -> bool {
    matches!(mode.behaviour, Behaviour::Oscillating(_)) && growth.sigma <= mode.error
}

/// Distance of a general mode to `s = 0`: that of `|s|^2` for an oscillation, that of `s` otherwise.
fn distance_to_zero<const N: usize, const P: usize>(
    mode: &Mode<N>,
    natural: Option<Spread<P>>,
    growth: Option<Spread<P>>,
) -> f64 {
    match (mode.behaviour, natural, growth) {
        (Behaviour::Neutral, ..) => 0.0,
        (_, Some(natural), _) => in_sigmas(0.5 * natural.mean, natural.sigma),
        (_, None, Some(growth)) => in_sigmas(-growth.mean, growth.sigma),
        (_, None, None) => f64::INFINITY,
    }
}

/// A value in standard deviations; infinite, with its sign, when nothing moves it.
fn in_sigmas(value: f64, sigma: f64) -> f64 {
    if sigma > 0.0 {
        value / sigma
    } else if value == 0.0 {
        0.0
    } else {
        value.signum() * f64::INFINITY
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

/// Distance of two modes in standard deviations of their difference, as either of them sees it.
#[inline]
fn distances<const N: usize, const U: usize, const P: usize>(
    r: usize,
    other: usize,
    modes: &Modes<N>,
    sensitivities: &Sensitivities<N, U, P>,
    tolerances: &Tolerances<P>,
) -> [f64; 2] {
    let (a, b) = (&modes.modes[r], &modes.modes[other]);
    let (da, db) = (&sensitivities.modes[r], &sensitivities.modes[other]);
    // Halves, because a difference may exceed the range of a double.
    let (gap, sigma) = match (modes.family, da.s, db.s) {
        (Family::Undamped, ..) => {
            let (da, db) = (&da.lambda_by_design, &db.lambda_by_design);
            let slopes = core::array::from_fn(|j| 0.5 * da[j] - 0.5 * db[j]);
            let gap = (0.5 * a.lambda - 0.5 * b.lambda).abs();
            (gap, tolerances.sigma(&slopes))
        }
        (Family::General, Some(da), Some(db)) => {
            let part = |pick: fn(crate::Complex) -> f64| {
                let (da, db) = (da.by_design, db.by_design);
                tolerances.sigma(&core::array::from_fn(|j| {
                    0.5 * pick(da[j]) - 0.5 * pick(db[j])
                }))
            };
            let gap = 0.5 * (a.s - b.s).norm();
            (gap, part(|value| value.re).hypot(part(|value| value.im)))
        }
        // One that has merged did so perhaps with the other: nothing tells what moves them. To the other it says nothing.
        (Family::General, one, another) => {
            return [one, another].map(|slopes| slopes.map_or(0.0, |_| f64::INFINITY));
        }
    };
    [if sigma > 0.0 {
        gap / sigma
    } else {
        f64::INFINITY
    }; 2]
}
