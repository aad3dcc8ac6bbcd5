//! First-order spread: `sigma^2 = S Sigma S^T` (eq. 27 for several variables), with a measure of its reliability.

use core::f64::consts::TAU;

use super::{Spread, Tolerances};
use crate::algebra::Vector;
use crate::modes::Family;
use crate::sensitivity::{ModeSensitivity, Quantity, root_rate};
use crate::{Behaviour, Complex, Description, Error, Mode, Modes, Sensitivities, Shared};

/// Closer to the critical state or to another mode than this many standard deviations, first order is not reliable: its
/// error grows without bound.
///
/// This is a warning threshold, not a bound on the error beyond it. For the rotating bar, compared with quadrature of
/// the exact distribution, first order misses the standard deviation at this distance by -3.4, -4.5 and -7.4 % for
/// tolerances of 3, 6 and 12 %; at 12 % an error of a few percent needs about 6 standard deviations. Under large
/// tolerances the frequency itself is nonlinear, which a distance to the critical state does not show.
pub const TRUSTED_DISTANCE: f64 = 4.5;

/// First-order spread of one mode.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModeTolerance {
    /// The behaviour of the mode, including the nominal frequency if it oscillates.
    pub behaviour: Behaviour,
    /// `-Re s^2`, 1/s^2: for an undamped mode, the eigenvalue. The standard deviation is infinite for a general mode
    /// without a derivative (a defective eigenvalue).
    pub lambda: Spread,
    /// Distance, in standard deviations, between this mode and the state where its stiffness vanishes.
    ///
    /// This is `lambda` over its standard deviation, with `|s|^2` in place of `lambda` for a general mode. Negative if
    /// the mode diverges, zero if it is neutral, infinite if nothing moves it or it has no derivative.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub distance_to_critical: f64,
    /// Distance, in standard deviations, between the growth of this mode and zero.
    ///
    /// Negative if the mode grows; zero if it neither grows nor decays within rounding although tolerances move its
    /// growth; infinite if nothing moves the growth beyond rounding, as for undamped modes.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub distance_to_instability: f64,
    /// Distance, in standard deviations of the difference, between this mode's eigenvalue and the nearest one. Where it
    /// is small, samples exchange the two modes or mix their shapes. Infinite for a single mode or if nothing moves the
    /// difference, as between the modes of two equal oscillators, which the difference of their stiffnesses mixes
    /// without moving: see `clusters`.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub distance_to_neighbour: f64,
    /// The mode belongs to a cluster of nearly equal eigenvalues ([`Modes::cluster_of`]): first order does not apply to
    /// it, and the numbers here hold for the computed basis of the cluster. Whether tolerances mix modes farther apart
    /// is reported by `clusters` and `summary`.
    pub clustered: bool,
    /// The nominal eigenvalue.
    value: Complex,
    /// Contribution to `lambda` of means that differ from the nominal values.
    shift: f64,
    /// For a general mode, the spreads of its first four quantities in the order of [`Quantity::ALL`]. Those of an undamped mode
    /// are that of `lambda`, scaled: its eigenvalue is a root.
    general: Option<[Option<Spread>; 4]>,
}

impl ModeTolerance {
    /// An empty spread of a mode, to be overwritten.
    fn blank() -> Self {
        Self {
            behaviour: Behaviour::Neutral,
            lambda: Spread::blank(),
            distance_to_critical: f64::INFINITY,
            distance_to_instability: f64::INFINITY,
            distance_to_neighbour: f64::INFINITY,
            clustered: false,
            value: Complex::ZERO,
            shift: 0.0,
            general: None,
        }
    }

    /// The spread of a quantity of the mode.
    ///
    /// `None` if the mode has no such quantity or it has no derivative; a mode that does not oscillate only has a
    /// growth.
    #[must_use]
    pub fn of(&self, quantity: Quantity) -> Option<Spread> {
        if quantity == Quantity::LogDecrement {
            return self.log_decrement();
        }
        if let Some(all) = &self.general {
            return all[quantity as usize].clone();
        }
        if self.value == Complex::ZERO {
            return None;
        }
        // s = sqrt(-lambda), real or imaginary
        let oscillates = self.value.im > 0.0;
        let rate = root_rate(self.value);
        match quantity {
            Quantity::Frequency | Quantity::NaturalFrequency if oscillates => {
                Some(self.lambda.scaled(rate, self.value.im + rate * self.shift))
            }
            Quantity::DampingRatio | Quantity::Growth if oscillates => Some(self.lambda.still(0.0)),
            Quantity::Growth => Some(self.lambda.scaled(-rate, self.value.re - rate * self.shift)),
            _ => None,
        }
    }

    /// That of the damping ratio, of which it is a function.
    fn log_decrement(&self) -> Option<Spread> {
        let (ratio, s) = (self.damping_ratio()?, self.value);
        let oscillates = s.im > 0.0;
        oscillates.then(|| {
            let rate = TAU * (s.norm() / s.im).powi(3);
            let moved = ratio.mean - Quantity::DampingRatio.value(s);
            ratio.scaled(rate, Quantity::LogDecrement.value(s) + rate * moved)
        })
    }

    /// The spread of the frequency `Im s`, rad/s; see [`Self::of`].
    #[must_use]
    pub fn frequency(&self) -> Option<Spread> {
        self.of(Quantity::Frequency)
    }

    /// The spread of the natural frequency `|s|`, rad/s; see [`Self::of`].
    #[must_use]
    pub fn natural_frequency(&self) -> Option<Spread> {
        self.of(Quantity::NaturalFrequency)
    }

    /// The spread of the damping ratio; see [`Self::of`].
    #[must_use]
    pub fn damping_ratio(&self) -> Option<Spread> {
        self.of(Quantity::DampingRatio)
    }

    /// The spread of the growth `Re s`, 1/s; see [`Self::of`].
    #[must_use]
    pub fn growth(&self) -> Option<Spread> {
        self.of(Quantity::Growth)
    }

    /// Share of each design variable in the variance of the frequency, or of `lambda` for a mode without a frequency.
    #[must_use]
    pub fn variance_shares(&self) -> &[f64] {
        let all = self.general.as_ref();
        let frequency = all.and_then(|all| all[Quantity::Frequency as usize].as_ref());
        &frequency.unwrap_or(&self.lambda).variance_shares
    }
}

/// First-order spread of all modes.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FirstOrder {
    /// One entry for each mode.
    pub modes: Vec<ModeTolerance>,
    /// How many standard deviations a tolerance and a band span.
    pub sigma_level: f64,
    /// Whether any variable has a tolerance.
    pub varies: bool,
    /// Smallest distance of any mode to the critical state. Beyond the critical state the equilibrium changes branch,
    /// which changes every mode, so the nearest mode limits the reliability of all.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub distance_to_critical: f64,
    /// The family of the modes.
    pub family: Family,
    /// The inputs it belongs to, SI.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

/// First-order spread of every mode.
///
/// # Errors
/// [`Error::WrongLength`] for tolerances of another mechanism.
pub fn first_order(modes: &Modes, sensitivities: &Sensitivities, tolerances: &Tolerances) -> Result<FirstOrder, Error> {
    tolerances.check_count(sensitivities.description.design.len())?;
    let count = modes.modes.len().min(sensitivities.modes.len());
    let mut spreads = Vec::with_capacity(count);
    spreads.resize_with(count, ModeTolerance::blank);
    let of_modes = modes.modes.iter().zip(&sensitivities.modes);
    for (spread, (mode, sensitivity)) in spreads.iter_mut().zip(of_modes) {
        match modes.family {
            Family::Undamped => undamped(mode, sensitivity, tolerances, spread),
            Family::General => general(mode, sensitivity, tolerances, spread),
        }
    }
    for r in 0..spreads.len() {
        for other in 0..r {
            let gaps = distances(r, other, modes, sensitivities, tolerances);
            for (index, distance) in [r, other].into_iter().zip(gaps) {
                let least = &mut spreads[index].distance_to_neighbour;
                *least = least.min(distance);
            }
        }
    }
    let distances = spreads.iter().map(|mode| mode.distance_to_critical);
    Ok(FirstOrder {
        distance_to_critical: distances.fold(f64::INFINITY, f64::min),
        modes: spreads,
        sigma_level: tolerances.sigma_level(),
        varies: tolerances.vary(),
        family: modes.family,
        inputs: sensitivities.inputs.clone(),
        description: modes.description.clone(),
    })
}

/// The spread of an undamped mode, without the distance to its neighbours.
fn undamped(
    mode: &Mode,
    mode_sensitivity: &ModeSensitivity,
    tolerances: &Tolerances,
    mode_tolerance: &mut ModeTolerance,
) {
    let lambda = &mut mode_tolerance.lambda;
    lambda.by_design.set(&mode_sensitivity.lambda.by_design, |slope| *slope);
    mode_tolerance.shift = lambda.finish(mode.lambda, tolerances);
    mode_tolerance.behaviour = mode.behaviour;
    mode_tolerance.value = mode.s;
    mode_tolerance.distance_to_critical = match mode.behaviour {
        Behaviour::Free => f64::INFINITY,
        // Along a free direction nothing vanishes that tolerances could bring back.
        Behaviour::Neutral if mode_tolerance.lambda.sigma <= mode.error * mode.error => f64::INFINITY,
        Behaviour::Neutral => 0.0,
        _ => in_sigmas(mode_tolerance.lambda.mean, mode_tolerance.lambda.sigma),
    };
    mode_tolerance.clustered = mode_sensitivity.clustered;
}

/// The spread of a general mode, without the distance to its neighbours; each quantity is spread by its own
/// derivatives.
fn general(
    mode: &Mode,
    mode_sensitivity: &ModeSensitivity,
    tolerances: &Tolerances,
    mode_tolerance: &mut ModeTolerance,
) {
    let slopes = &mode_sensitivity.lambda.by_design;
    let lambda = &mut mode_tolerance.lambda;
    match mode_sensitivity.general() {
        None => lambda.set_without_derivatives(mode.lambda, f64::INFINITY, slopes.len()),
        Some(_) => *lambda = Spread::new(mode.lambda, slopes.clone(), tolerances),
    }
    let [all @ .., _] = Quantity::ALL;
    let all = all.map(|quantity| {
        let slopes = mode_sensitivity.of(quantity)?.by_design;
        Some(Spread::new(quantity.of(mode)?, slopes, tolerances))
    });
    let [_, natural, _, growth] = all.each_ref().map(Option::as_ref);
    mode_tolerance.distance_to_critical = distance_to_zero(mode, natural, growth);
    mode_tolerance.distance_to_instability =
        growth.filter(|spread| !keeps_amplitude(mode, spread)).map_or(f64::INFINITY, |spread| match mode.behaviour {
            Behaviour::Oscillating(_) => 0.0,
            _ => in_sigmas(-spread.mean, spread.sigma),
        });
    mode_tolerance.behaviour = mode.behaviour;
    mode_tolerance.value = mode.s;
    mode_tolerance.clustered = mode_sensitivity.clustered;
    mode_tolerance.general = Some(all);
}

/// Whether neither the growth nor the contribution of tolerances to it can be distinguished from zero.
fn keeps_amplitude(mode: &Mode, growth: &Spread) -> bool {
    matches!(mode.behaviour, Behaviour::Oscillating(_)) && growth.sigma <= mode.error
}

/// Distance of a general mode to `s = 0`: of `|s|^2` for an oscillation, of `s` otherwise.
fn distance_to_zero(mode: &Mode, natural: Option<&Spread>, growth: Option<&Spread>) -> f64 {
    match (mode.behaviour, natural, growth) {
        (Behaviour::Free, ..) => f64::INFINITY,
        (Behaviour::Neutral, _, Some(growth)) if growth.sigma <= mode.error => f64::INFINITY,
        (Behaviour::Neutral, ..) => 0.0,
        (_, Some(natural), _) => in_sigmas(0.5 * natural.mean, natural.sigma),
        (_, None, Some(growth)) => in_sigmas(-growth.mean, growth.sigma),
        (_, None, None) => f64::INFINITY,
    }
}

/// A value in standard deviations; infinite, with its sign, if nothing moves it.
fn in_sigmas(value: f64, sigma: f64) -> f64 {
    if sigma > 0.0 {
        value / sigma
    } else if value == 0.0 {
        0.0
    } else {
        value.signum() * f64::INFINITY
    }
}

/// Distance of two modes in standard deviations of their difference, as seen from either of them.
fn distances(
    r: usize,
    other: usize,
    modes: &Modes,
    sensitivities: &Sensitivities,
    tolerances: &Tolerances,
) -> [f64; 2] {
    let (a, b) = (&modes.modes[r], &modes.modes[other]);
    if [a, b].iter().any(|mode| mode.behaviour == Behaviour::Free) {
        return [f64::INFINITY; 2];
    }
    let (da, db) = (&sensitivities.modes[r], &sensitivities.modes[other]);
    // Halved, because a difference may exceed the range of a double.
    let (gap, sigma) = match (modes.family, da.general(), db.general()) {
        (Family::Undamped, ..) => {
            let slopes = da.lambda.by_design.iter().zip(&db.lambda.by_design);
            let slopes: Vector = slopes.map(|(a, b)| 0.5 * a - 0.5 * b).collect();
            let gap = (0.5 * a.lambda - 0.5 * b.lambda).abs();
            (gap, tolerances.sigma(&slopes))
        }
        (Family::General, Some(da), Some(db)) => {
            let part = |pick: fn(&Complex) -> f64| {
                let slopes = da.by_design.iter().zip(&db.by_design);
                let slopes: Vector = slopes.map(|(a, b)| 0.5 * pick(a) - 0.5 * pick(b)).collect();
                tolerances.sigma(&slopes)
            };
            let gap = 0.5 * (a.s - b.s).norm();
            (gap, part(|value| value.re).hypot(part(|value| value.im)))
        }
        // A merged mode may have merged with the other one, so its distance is unknown (zero). For the other mode it
        // does not count.
        (Family::General, one, another) => {
            return [one, another].map(|slopes| slopes.map_or(0.0, |_| f64::INFINITY));
        }
    };
    [if sigma > 0.0 { gap / sigma } else { f64::INFINITY }; 2]
}
