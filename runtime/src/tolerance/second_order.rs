//! Spread to second order: what the curvature of a frequency adds to first order, and whether the two agree.

use super::{ModelMoments, Nonlinearity, Quadratic, Tolerances};
use crate::sensitivity::{ModeCurvature, Quantity, mode_curvature};
use crate::{Description, Equilibrium, Error, Mechanism, Modes};

/// A quantity of a mode to second order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SecondOrderSpread<const P: usize> {
    /// Value, gradient and Hessian by the design variables.
    pub model: Quadratic<P>,
    /// Mean, standard deviation, skewness and kurtosis of that model.
    pub moments: ModelMoments,
    /// How much of them is due to curvature.
    pub nonlinearity: Nonlinearity,
}

/// A mode to second order.
#[derive(Clone, Debug, PartialEq)]
pub struct ModeSecondOrder<const P: usize> {
    /// Frequency `Im s`, rad/s.
    pub frequency: SecondOrderSpread<P>,
    /// Natural frequency `|s|`, rad/s.
    pub natural_frequency: SecondOrderSpread<P>,
    /// Damping ratio.
    pub damping_ratio: SecondOrderSpread<P>,
}

/// All modes to second order.
#[derive(Clone, Debug, PartialEq)]
pub struct SecondOrder<const P: usize> {
    /// In the order of the modes; a mode that does not oscillate or has no derivatives of its own says so.
    pub modes: Vec<Result<ModeSecondOrder<P>, Error>>,
    /// Standard deviations that a tolerance holds.
    pub sigma_level: f64,
    /// The mechanism they belong to.
    pub description: &'static Description,
}

impl<const U: usize, const P: usize> ModeCurvature<U, P> {
    /// The second-order model of a quantity by the design variables; `None` where the mode has no such quantity.
    pub fn quadratic(&self, quantity: Quantity) -> Option<Quadratic<P>> {
        Some(Quadratic {
            value: quantity.value(self.s),
            slopes: self.first.of(quantity)?.by_design,
            curvature: self.of(quantity)?.by_design,
        })
    }
}

/// Spread of every mode to second order (THEORY section 6): exact mean and variance of the second-order model of each
/// quantity under normally distributed design variables.
pub fn second_order<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
    tolerances: &Tolerances<P>,
) -> SecondOrder<P>
where
    M: Mechanism<N, U, P, O>,
{
    let one = |mode: usize| mode_second_order(mechanism, at, modes, mode, tolerances);
    SecondOrder {
        modes: (0..modes.modes.len()).map(one).collect(),
        sigma_level: tolerances.sigma_level(),
        description: modes.description,
    }
}

#[inline(never)]
fn mode_second_order<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
    mode: usize,
    tolerances: &Tolerances<P>,
) -> Result<ModeSecondOrder<P>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    let curvature = boxed_curvature(mechanism, at, modes, mode)?;
    let lambda = modes.modes[mode].lambda;
    let spread = |quantity| {
        let found = second_order_spread(&curvature, quantity, tolerances).transpose();
        found.unwrap_or(Err(Error::NotOscillating { mode, lambda }))
    };
    Ok(ModeSecondOrder {
        frequency: spread(Quantity::Frequency)?,
        natural_frequency: spread(Quantity::NaturalFrequency)?,
        damping_ratio: spread(Quantity::DampingRatio)?,
    })
}

/// On the heap: Hessians of many variables would fill the stack.
#[inline(never)]
fn boxed_curvature<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
    mode: usize,
) -> Result<Box<ModeCurvature<U, P>>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    mode_curvature(mechanism, at, modes, mode).map(Box::new)
}

/// The spread of one quantity; `None` where the mode has no such quantity.
#[inline(never)]
fn second_order_spread<const U: usize, const P: usize>(
    curvature: &ModeCurvature<U, P>,
    quantity: Quantity,
    tolerances: &Tolerances<P>,
) -> Result<Option<SecondOrderSpread<P>>, Error> {
    let Some(model) = curvature.quadratic(quantity) else {
        return Ok(None);
    };
    Ok(Some(SecondOrderSpread {
        moments: model.moments(tolerances)?,
        nonlinearity: model.nonlinearity(tolerances)?,
        model,
    }))
}
