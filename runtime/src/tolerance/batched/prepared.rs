//! What all samples share: how the nominal state answers to the design, to first and second order.

use super::range::Range;
use crate::array::{Cholesky, Square, all_finite, all_finite_square, form};
use crate::constraints::Structure;
use crate::lanes::{Instructions, generated};
use crate::modes::Family;
use crate::tolerance::Tolerances;
use crate::tolerance::normal::GREATEST_NORMAL;
use crate::{DampingKind, Equilibrium, Mechanism, Modes, Real, Stability};

/// Largest mechanism that is solved in vectors.
const LARGEST: usize = 8;
/// Design variables up to which second derivatives of the equilibrium shorten Newton's method.
const FEW: usize = 8;
/// Greatest error of an eigenvalue by rounding, relative, as the nominal matrices tell it.
const ROUNDING: f64 = 1e-10;
/// Displacement (rad or m) for differences where the equilibrium does not move.
const SMALL: f64 = 1e-4;
/// Change of the stiffness of a mode that may come of second derivatives over the displacement of one standard deviation,
/// relative to it: [`FAR`](super::stages::FAR) of these leave three quarters of it.
const STRAIGHT: f64 = 0.007;

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
    pub(in crate::tolerance) instructions: Instructions,
    pub(super) nominal: &'a Equilibrium<N, U, P>,
    /// Diagonal of the factor `L` of the covariance.
    pub(super) own: [f64; P],
    /// (`i`, `j`, `L_ij`) beside the diagonal, row by row, without zeros.
    pub(super) shared: Vec<(usize, usize, f64)>,
    /// Pairs of random numbers on which anything depends.
    pub(super) drawn: [bool; P],
    /// Design variables that vary.
    pub(super) varied: Vec<usize>,
    /// `dq*/db` by varied variable.
    pub(super) first: [[f64; N]; P],
    /// Coefficient of `db_j db_k` in `q*` by `k` and `j <= k`, positions in `varied`; empty without.
    pub(super) second: Vec<[[f64; N]; P]>,
    /// Nominal modes, one in each row.
    pub(super) shapes: [[f64; N]; N],
    /// Their `lambda`, 1/s^2, and frequencies, rad/s.
    pub(super) lambda: [f64; N],
    pub(in crate::tolerance) frequencies: [f64; N],
    /// No design that can be drawn breaks a physical requirement: samples need not ask.
    pub(super) all_possible: bool,
    /// Displacements that one standard deviation of every variable causes.
    pub(super) reach: [f64; N],
    /// `1/2 dKhat/dq_k` by `k` and row, rows beside the diagonal twice, the rows after `k` not used: the quadratic terms of the
    /// residual.
    pub(super) curvature: [[[f64; N]; N]; N],
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
        let shared: Vec<_> = (0..P)
            .flat_map(|i| (0..i).map(move |j| (i, j, factor[i][j])))
            .filter(|(_, _, value)| *value != 0.0)
            .collect();
        let own = core::array::from_fn(|i| factor[i][i]);
        let used = |j: usize| own[j] != 0.0 || shared.iter().any(|one| one.1 == j);
        let drawn = core::array::from_fn(|pair| (2 * pair..P.min(2 * pair + 2)).any(used));
        let varied: Vec<_> = (0..P)
            .filter(|&i| factor[i].iter().any(|value| *value != 0.0))
            .collect();
        let answer = Answer { mechanism, nominal };
        let first = answer.slopes(&nominal.coordinates, &nominal.design, &varied)?;
        let deviations = tolerances.standard_deviations();
        let reach = answer.reach(&varied, &first, &deviations);
        let slopes = answer.stiffening(&reach, &shapes, &lambda)?;
        Some(Self {
            mechanism,
            instructions,
            nominal,
            second: answer.curvatures(&varied, &first, &deviations)?,
            curvature: quadratic_terms(&slopes),
            all_possible: all_possible(mechanism, nominal, factor),
            reach,
            stiffening: slopes.map(|slope| between(&slope, &shapes)),
            own,
            shared,
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

/// Whether every design in the box of all that can be drawn describes bodies that can exist.
fn all_possible<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    nominal: &Equilibrium<N, U, P>,
    factor: &[[f64; P]; P],
) -> bool
where
    M: Mechanism<N, U, P, O>,
{
    let inputs = nominal.inputs.map(Range::constant);
    let design = core::array::from_fn(|i| {
        let sum: f64 = factor[i].iter().map(|value| value.abs()).sum();
        Range::about(nominal.design[i], GREATEST_NORMAL * sum)
    });
    mechanism.violation(&inputs, &design).is_none()
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
    ) -> Option<[[f64; N]; P]>
    where
        M: Mechanism<N, U, P, O>,
    {
        let inputs = &self.nominal.inputs;
        let (_, stiffness) = self.mechanism.residual_and_stiffness(q, inputs, b);
        let (_, by_design) = self.mechanism.residual_partials(q, inputs, b);
        let factors = Cholesky::new(&stiffness).ok()?;
        let mut slopes = [[0.0; N]; P];
        for (slope, &j) in slopes.iter_mut().zip(varied) {
            *slope = factors.solve(&core::array::from_fn(|i| -by_design[i][j]));
        }
        slopes.iter().all(all_finite).then_some(slopes)
    }

    /// Half of `d2q*/db_j db_k` for equal variables, all of it for others, `j <= k`: secants of the slopes over one standard deviation
    /// along the equilibria.
    fn curvatures<const O: usize>(
        &self,
        varied: &[usize],
        first: &[[f64; N]],
        deviations: &[f64; P],
    ) -> Option<Vec<[[f64; N]; P]>>
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
            let mut row = [[0.0; N]; P];
            for (j, row) in row.iter_mut().enumerate().take(k + 1) {
                let share = if j == k { 0.25 } else { 0.5 };
                *row = core::array::from_fn(|i| share * (above[j][i] - below[j][i]) / step);
            }
            second.push(row);
        }
        let finite = second.iter().flatten().all(all_finite);
        finite.then_some(second)
    }

    /// How far one standard deviation of every varied variable moves each coordinate, all in one sense; something where the
    /// equilibrium does not move.
    fn reach(&self, varied: &[usize], first: &[[f64; N]], deviations: &[f64; P]) -> [f64; N] {
        core::array::from_fn(|k| {
            let motions = first.iter().zip(varied);
            motions.fold(SMALL, |sum, (slope, &j)| {
                sum + (slope[k] * deviations[j]).abs()
            })
        })
    }

    /// `dKhat/dq_k` by differences over this displacement; `None` where the stiffness of a mode bends on the way.
    fn stiffening<const O: usize>(
        &self,
        reach: &[f64; N],
        shapes: &[[f64; N]; N],
        lambda: &[f64; N],
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
        let here = &self.nominal.linear.stiffness;
        let mut slopes = [[[0.0; N]; N]; N];
        for (k, slope) in slopes.iter_mut().enumerate() {
            let at = |step: f64| {
                let mut q = *coordinates;
                q[k] += step;
                self.mechanism.residual_and_stiffness(&q, inputs, design).1
            };
            let (above, below) = (at(reach[k]), at(-reach[k]));
            let matrix = |entry: &dyn Fn(usize, usize) -> f64| -> Square<N> {
                core::array::from_fn(|i| core::array::from_fn(|j| entry(i, j)))
            };
            *slope = matrix(&|i, j| (above[i][j] - below[i][j]) / (2.0 * reach[k]));
            let bend = matrix(&|i, j| 0.5 * (above[i][j] + below[i][j]) - here[i][j]);
            let bend = between(&bend, shapes);
            let straight = (0..N).all(|r| {
                (0..N).all(|s| bend[r][s].abs() <= STRAIGHT * (lambda[r] * lambda[s]).sqrt())
            });
            if !straight || !all_finite_square(slope) {
                return None;
            }
        }
        Some(slopes)
    }
}

/// `1/2 dKhat/dq_k`, row `j < k` standing for row `k` of `j` too.
fn quadratic_terms<const N: usize>(slopes: &[[[f64; N]; N]; N]) -> [[[f64; N]; N]; N] {
    core::array::from_fn(|k| {
        core::array::from_fn(|j| {
            let share = if j == k { 0.5 } else { 1.0 };
            slopes[k][j].map(|slope| share * slope)
        })
    })
}

/// A symmetric matrix between the modes.
fn between<const N: usize>(matrix: &[[f64; N]; N], shapes: &[[f64; N]; N]) -> [[f64; N]; N] {
    core::array::from_fn(|r| core::array::from_fn(|s| form(&shapes[r], matrix, &shapes[s])))
}
