//! Derivatives of all modes by all variables through the adjoint. For undamped modes
//! `dlambda/db = da/db - (dg/db)^T w`, `a = phi^T (Khat - lambda Mhat) phi`; for general ones the same with
//! `a = psi^T (s^2 Mhat + s Chat + Khat) phi`, divided by `-psi^T (2 s Mhat + Chat) phi`. In both `Khat^T w = da/dq`.

use super::gradients::{Cheaper, of_general, of_undamped};
use super::pencil::{Form, form_gradient, residual_gradient};
use super::{Method, Sensitivities, Slopes, redundancy};
use crate::array::{Cholesky, Lu, dot_complex, transpose};
use crate::modes::Family;
use crate::pencil::pencil_slope_times;
use crate::{Complex, Equilibrium, Error, Gradient, Mechanism, Mode, Modes};

/// Total derivatives of every mode by every input and design variable.
///
/// # Errors
/// [`Error::CriticalState`] when `Khat` is singular, [`Error::ClosesHereOnly`] where redundant constraints contradict each
/// other as soon as a variable changes, [`Error::OutsideDomain`] when a derivative is not finite.
pub fn sensitivities<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
) -> Result<Sensitivities<N, U, P>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    let mut found = Sensitivities::blank(modes, Method::Adjoint);
    sensitivities_into(mechanism, at, modes, &mut found)?;
    Ok(found)
}

/// As [`sensitivities`], written into `found`, where there is room for these modes: they are long to copy.
pub(crate) fn sensitivities_into<
    M,
    const N: usize,
    const U: usize,
    const P: usize,
    const O: usize,
>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
    found: &mut Sensitivities<N, U, P>,
) -> Result<(), Error>
where
    M: Mechanism<N, U, P, O>,
{
    redundancy::check(mechanism, at)?;
    let state = State::new(mechanism, at)?;
    match modes.family {
        Family::Undamped if const { Cheaper::<M, N, U, P, O>::MATRICES } => {
            undamped_from_partials(&state, modes, found)
        }
        Family::Undamped => undamped(&state, modes, found),
        Family::General if const { Cheaper::<M, N, U, P, O>::MATRICES_GENERAL } => {
            general_from_partials(&state, modes, found)
        }
        Family::General => general(&state, modes, found),
    }
}

/// What all modes share.
struct State<'a, M, const N: usize, const U: usize, const P: usize, const O: usize> {
    mechanism: &'a M,
    at: &'a Equilibrium<N, U, P>,
    factors: Factors<N>,
}

/// Factors of the transposed `Khat`.
enum Factors<const N: usize> {
    Definite(Cholesky<N>),
    General(Lu<f64, N>),
}

impl<const N: usize> Factors<N> {
    #[inline]
    fn solve(&self, right: &[f64; N]) -> [f64; N] {
        match self {
            Self::Definite(factors) => factors.solve(right),
            Self::General(factors) => factors.solve(right),
        }
    }

    fn solve_complex(&self, right: &[Complex; N]) -> [Complex; N] {
        let re = self.solve(&right.map(|value| value.re));
        let im = self.solve(&right.map(|value| value.im));
        core::array::from_fn(|i| Complex::new(re[i], im[i]))
    }
}

impl<'a, M, const N: usize, const U: usize, const P: usize, const O: usize> State<'a, M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    #[inline]
    fn new(mechanism: &'a M, at: &'a Equilibrium<N, U, P>) -> Result<Self, Error> {
        let stiffness = &at.linear.stiffness;
        let definite = if const { M::DESCRIPTION.symmetric_stiffness } {
            Cholesky::new(stiffness).ok()
        } else {
            None
        };
        let factors = match definite {
            Some(factors) => Factors::Definite(factors),
            None => Factors::General(Lu::new(&transpose(stiffness)).ok_or(Error::CriticalState)?),
        };
        Ok(Self {
            mechanism,
            at,
            factors,
        })
    }
}

/// Partial derivatives of the residual by inputs and design.
type ResidualPartials<const N: usize, const U: usize, const P: usize> =
    ([[f64; U]; N], [[f64; P]; N]);

/// Undamped modes, the gradient of each from reverse differentiation.
fn undamped<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    state: &State<'_, M, N, U, P, O>,
    modes: &Modes<N>,
    found: &mut Sensitivities<N, U, P>,
) -> Result<(), Error>
where
    M: Mechanism<N, U, P, O>,
{
    let (q, u, b) = (&state.at.coordinates, &state.at.inputs, &state.at.design);
    let residual = const { Cheaper::<M, N, U, P, O>::RESIDUAL }
        .then(|| state.mechanism.residual_partials(q, u, b));
    undamped_from(state, modes, found, residual.as_ref(), |mode| {
        state
            .mechanism
            .mode_gradient(q, u, b, &mode.real_shape(), mode.lambda)
    })
}

/// Undamped modes, their gradients from explicit partials.
fn undamped_from_partials<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    state: &State<'_, M, N, U, P, O>,
    modes: &Modes<N>,
    found: &mut Sensitivities<N, U, P>,
) -> Result<(), Error>
where
    M: Mechanism<N, U, P, O>,
{
    let (q, u, b) = (&state.at.coordinates, &state.at.inputs, &state.at.design);
    // Borrowed: to move them would take as long as to use them.
    let partials = state.mechanism.partials(q, u, b);
    let (matrices, residual) = &partials;
    let symmetric = const { M::DESCRIPTION.symmetric_stiffness };
    undamped_from(state, modes, found, Some(residual), |mode| {
        of_undamped(matrices, &mode.real_shape(), mode.lambda, symmetric)
    })
}

#[inline]
fn undamped_from<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    state: &State<'_, M, N, U, P, O>,
    modes: &Modes<N>,
    found: &mut Sensitivities<N, U, P>,
    residual: Option<&ResidualPartials<N, U, P>>,
    direct: impl Fn(&Mode<N>) -> Gradient<f64, N, U, P>,
) -> Result<(), Error>
where
    M: Mechanism<N, U, P, O>,
{
    let (mechanism, at) = (state.mechanism, state.at);
    let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
    found.fill(at, modes, |mode| {
        let direct = direct(mode);
        let adjoint = state.factors.solve(&direct.coordinates);
        let (inputs, design) = match residual {
            Some((by_input, by_design)) => {
                (combine(&adjoint, by_input), combine(&adjoint, by_design))
            }
            None => {
                let shift = mechanism.residual_gradient(q, u, b, &adjoint);
                (shift.inputs, shift.design)
            }
        };
        Slopes {
            by_input: core::array::from_fn(|j| (direct.inputs[j] - inputs[j]).into()),
            by_design: core::array::from_fn(|j| (direct.design[j] - design[j]).into()),
        }
    })
}

/// General modes, the gradient of each from reverse differentiation.
fn general<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    state: &State<'_, M, N, U, P, O>,
    modes: &Modes<N>,
    found: &mut Sensitivities<N, U, P>,
) -> Result<(), Error>
where
    M: Mechanism<N, U, P, O>,
{
    let (q, u, b) = (&state.at.coordinates, &state.at.inputs, &state.at.design);
    let residual = const { Cheaper::<M, N, U, P, O>::RESIDUAL_GENERAL }
        .then(|| state.mechanism.residual_partials(q, u, b));
    general_from(state, modes, found, residual.as_ref(), |mode| {
        let form = Form::of(&mode.left, mode.s, &mode.shape);
        form_gradient(state.mechanism, state.at, &form)
    })
}

/// General modes, their gradients from explicit partials.
fn general_from_partials<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    state: &State<'_, M, N, U, P, O>,
    modes: &Modes<N>,
    found: &mut Sensitivities<N, U, P>,
) -> Result<(), Error>
where
    M: Mechanism<N, U, P, O>,
{
    let (q, u, b) = (&state.at.coordinates, &state.at.inputs, &state.at.design);
    // Borrowed: to move them would take as long as to use them.
    let partials = state.mechanism.partials(q, u, b);
    let (matrices, residual) = &partials;
    general_from(state, modes, found, Some(residual), |mode| {
        of_general(matrices, mode)
    })
}

#[inline]
fn general_from<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    state: &State<'_, M, N, U, P, O>,
    modes: &Modes<N>,
    found: &mut Sensitivities<N, U, P>,
    residual: Option<&ResidualPartials<N, U, P>>,
    direct: impl Fn(&Mode<N>) -> Gradient<Complex, N, U, P>,
) -> Result<(), Error>
where
    M: Mechanism<N, U, P, O>,
{
    let (mechanism, at) = (state.mechanism, state.at);
    found.fill(at, modes, |mode| {
        let direct = direct(mode);
        let adjoint = state.factors.solve_complex(&direct.coordinates);
        let (inputs, design) = match residual {
            Some((by_input, by_design)) => {
                (combine(&adjoint, by_input), combine(&adjoint, by_design))
            }
            None => {
                let shift = residual_gradient(mechanism, at, &adjoint);
                (shift.inputs, shift.design)
            }
        };
        let scale = -normaliser(at, mode);
        Slopes {
            by_input: core::array::from_fn(|j| (direct.inputs[j] - inputs[j]) / scale),
            by_design: core::array::from_fn(|j| (direct.design[j] - design[j]) / scale),
        }
    })
}

/// `w^T partials`.
#[inline]
fn combine<T, const N: usize, const K: usize>(w: &[T; N], partials: &[[f64; K]; N]) -> [T; K]
where
    T: Copy + Default + core::ops::AddAssign + core::ops::Mul<f64, Output = T>,
{
    let mut sum = [T::default(); K];
    for (w, row) in w.iter().zip(partials) {
        for (sum, &slope) in sum.iter_mut().zip(row) {
            *sum += *w * slope;
        }
    }
    sum
}

/// `psi^T (2 s Mhat + Chat) phi`; zero where the eigenvalue has merged with another.
pub(super) fn normaliser<const N: usize, const U: usize, const P: usize>(
    at: &Equilibrium<N, U, P>,
    mode: &Mode<N>,
) -> Complex {
    dot_complex(
        &mode.left,
        &pencil_slope_times(&at.linear, mode.s, &mode.shape),
    )
}
