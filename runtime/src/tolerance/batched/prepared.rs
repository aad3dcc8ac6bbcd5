//! What all samples share: how the nominal state answers to the design, to first and second order.

use crate::array::{Cholesky, all_finite, all_finite_square};
use crate::constraints::Structure;
use crate::lanes::{Instructions, generated};
use crate::modes::Family;
use crate::tolerance::Tolerances;
use crate::{DampingKind, Equilibrium, Mechanism, Modes, Stability};

/// Largest mechanism that is solved in vectors.
const LARGEST: usize = 8;
/// Design variables up to which second derivatives of the equilibrium shorten Newton's method.
const FEW: usize = 8;
/// Greatest error of an eigenvalue by rounding, relative, as the nominal matrices tell it.
const ROUNDING: f64 = 1e-10;
/// Displacement (rad or m) for differences where the equilibrium does not move.
const SMALL: f64 = 1e-4;

/// The nominal state in the form that samples need.
pub(in crate::tolerance) struct Prepared<
    'a,
    M,
    const N: usize,
    const U: usize,
    const P: usize,
    const O: usize,
> {
    pub(super) mechanism: &'a M,
    pub(super) instructions: Instructions,
    pub(super) nominal: &'a Equilibrium<N, U, P>,
    /// (`i`, `j`, `L_ij`) of the factor of the covariance, row by row, without zeros.
    pub(super) draws: Vec<(usize, usize, f64)>,
    /// Random numbers that anything depends on.
    pub(super) drawn: Vec<usize>,
    /// Design variables that vary.
    pub(super) varied: Vec<usize>,
    /// `dq*/db` by varied variable.
    pub(super) first: Vec<[f64; N]>,
    /// (`j`, `k`, coefficient of `db_j db_k` in `q*`), positions in `varied`.
    pub(super) second: Vec<(usize, usize, [f64; N])>,
    /// Nominal modes, one in each row.
    pub(super) shapes: [[f64; N]; N],
    /// Their `lambda`, 1/s^2, and frequencies, rad/s.
    pub(super) lambda: [f64; N],
    pub(in crate::tolerance) frequencies: [f64; N],
    /// `dKhat/dq_k` between the nominal modes.
    pub(super) stiffening: [[[f64; N]; N]; N],
}

impl<'a, M, const N: usize, const U: usize, const P: usize, const O: usize>
    Prepared<'a, M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    /// Whether the mechanism's kind allows it: generated code, undamped modes, no constraints, few coordinates.
    pub(in crate::tolerance) const POSSIBLE: bool = N > 0
        && N <= LARGEST
        && Structure::of(&M::DESCRIPTION).open()
        && matches!(M::DESCRIPTION.damping, DampingKind::Zero)
        && M::DESCRIPTION.symmetric_stiffness
        && generated(&M::DESCRIPTION, "residual_and_stiffness")
        && generated(&M::DESCRIPTION, "linear");

    /// `None` where the nominal state is not a clear minimum with all of its modes, or nothing varies.
    pub(in crate::tolerance) fn new(
        mechanism: &'a M,
        nominal: &'a Equilibrium<N, U, P>,
        modes: &Modes<N>,
        tolerances: &Tolerances<P>,
        instructions: Instructions,
    ) -> Option<Self> {
        let complete = modes.family == Family::Undamped && modes.modes.len() == N;
        if !complete || nominal.stability != Stability::Stable {
            return None;
        }
        let shapes = core::array::from_fn(|r| modes.modes[r].real_shape());
        let lambda = core::array::from_fn(|r| modes.modes[r].lambda);
        let frequencies = lambda.map(f64::sqrt);
        if !lambda.iter().all(|&value| value > 0.0) || !well_conditioned(nominal, &shapes, &lambda)
        {
            return None;
        }
        let factor = tolerances.factor();
        let draws: Vec<_> = (0..P)
            .flat_map(|i| (0..=i).map(move |j| (i, j, factor[i][j])))
            .filter(|(_, _, value)| *value != 0.0)
            .collect();
        let drawn = (0..P)
            .filter(|j| draws.iter().any(|draw| draw.1 == *j))
            .collect();
        let varied: Vec<_> = (0..P)
            .filter(|i| draws.iter().any(|draw| draw.0 == *i))
            .collect();
        let answer = Answer { mechanism, nominal };
        let first = answer.slopes(&nominal.coordinates, &nominal.design, &varied)?;
        let deviations = tolerances.standard_deviations();
        Some(Self {
            mechanism,
            instructions,
            nominal,
            second: answer.curvatures(&varied, &first, &deviations)?,
            stiffening: answer.stiffening(&shapes, &varied, &first, &deviations)?,
            draws,
            drawn,
            varied,
            first,
            shapes,
            lambda,
            frequencies,
        })
    }
}

/// Whether `phi^T Khat phi` gives every eigenvalue to enough digits.
fn well_conditioned<const N: usize, const U: usize, const P: usize>(
    nominal: &Equilibrium<N, U, P>,
    shapes: &[[f64; N]; N],
    lambda: &[f64; N],
) -> bool {
    let linear = &nominal.linear;
    shapes.iter().zip(lambda).all(|(shape, lambda)| {
        let terms = (0..N)
            .flat_map(|i| (0..N).map(move |j| (i, j)))
            .map(|(i, j)| {
                let size = linear.stiffness[i][j].abs() + lambda * linear.mass[i][j].abs();
                (shape[i] * shape[j]).abs() * size
            });
        terms.sum::<f64>() * f64::EPSILON <= ROUNDING * lambda
    })
}

/// The nominal state and its neighbours.
struct Answer<'a, M, const N: usize, const U: usize, const P: usize> {
    mechanism: &'a M,
    nominal: &'a Equilibrium<N, U, P>,
}

impl<M, const N: usize, const U: usize, const P: usize> Answer<'_, M, N, U, P> {
    /// `dq*/db = -Khat^-1 dg/db` of the varied variables at a state next to an equilibrium.
    fn slopes<const O: usize>(
        &self,
        q: &[f64; N],
        b: &[f64; P],
        varied: &[usize],
    ) -> Option<Vec<[f64; N]>>
    where
        M: Mechanism<N, U, P, O>,
    {
        let inputs = &self.nominal.inputs;
        let (_, stiffness) = self.mechanism.residual_and_stiffness(q, inputs, b);
        let (_, by_design) = self.mechanism.residual_partials(q, inputs, b);
        let factors = Cholesky::new(&stiffness).ok()?;
        let slope = |&j: &usize| {
            let slope = factors.solve(&core::array::from_fn(|i| -by_design[i][j]));
            all_finite(&slope).then_some(slope)
        };
        varied.iter().map(slope).collect()
    }

    /// Half of `d2q*/db_j db_k` for equal variables, all of it for others: secants of the slopes over one standard deviation
    /// along the equilibria.
    fn curvatures<const O: usize>(
        &self,
        varied: &[usize],
        first: &[[f64; N]],
        deviations: &[f64; P],
    ) -> Option<Vec<(usize, usize, [f64; N])>>
    where
        M: Mechanism<N, U, P, O>,
    {
        let mut second = Vec::new();
        if varied.len() > FEW {
            return Some(second);
        }
        for (k, &variable) in varied.iter().enumerate() {
            let step = deviations[variable];
            let at = |step: f64| {
                let mut b = self.nominal.design;
                b[variable] += step;
                let q = core::array::from_fn(|i| self.nominal.coordinates[i] + step * first[k][i]);
                self.slopes(&q, &b, varied)
            };
            let (above, below) = (at(step)?, at(-step)?);
            for j in 0..=k {
                let share = if j == k { 0.25 } else { 0.5 };
                let change = |i: usize| share * (above[j][i] - below[j][i]) / step;
                second.push((j, k, core::array::from_fn(change)));
            }
        }
        let finite = second.iter().all(|(_, _, value)| all_finite(value));
        finite.then_some(second)
    }

    /// `dKhat/dq_k` between the modes, by differences over the displacement that one standard deviation causes.
    fn stiffening<const O: usize>(
        &self,
        shapes: &[[f64; N]; N],
        varied: &[usize],
        first: &[[f64; N]],
        deviations: &[f64; P],
    ) -> Option<[[[f64; N]; N]; N]>
    where
        M: Mechanism<N, U, P, O>,
    {
        let Equilibrium {
            coordinates,
            inputs,
            design,
            ..
        } = self.nominal;
        let mut stiffening = [[[0.0; N]; N]; N];
        for (k, result) in stiffening.iter_mut().enumerate() {
            let motions = first
                .iter()
                .zip(varied)
                .map(|(slope, &j)| (slope[k] * deviations[j]).abs());
            let step = motions.fold(SMALL, f64::max);
            let at = |step: f64| {
                let mut q = *coordinates;
                q[k] += step;
                self.mechanism.residual_and_stiffness(&q, inputs, design).1
            };
            let (above, below) = (at(step), at(-step));
            for r in 0..N {
                for s in 0..N {
                    for i in 0..N {
                        for j in 0..N {
                            let slope = (above[i][j] - below[i][j]) / (2.0 * step);
                            result[r][s] += shapes[r][i] * slope * shapes[s][j];
                        }
                    }
                }
            }
            if !all_finite_square(result) {
                return None;
            }
        }
        Some(stiffening)
    }
}
