//! What all samples share: how the nominal state answers to the design, to first and second order.

use eigentol_statistics::Joint;

use crate::algebra::{Cholesky, Matrix, Vector, all_finite, all_finite_matrix, form, largest};
use crate::batched::algebra::{LARGEST, Row, Square, small};
use crate::batched::possible;
use crate::kernels::{BatchKernels, Kernels};
use crate::modes::Family;
use crate::scalar::{Batch, Instructions};
use crate::tolerance::Tolerances;
use crate::tolerance::normal_sampling::GREATEST_NORMAL;
use crate::{Equilibrium, Modes, Stability};

/// Design variables up to which second derivatives of the equilibrium shorten Newton's method.
pub(super) const FEW: usize = 8;
/// Greatest error of an eigenvalue by rounding, relative, as the nominal matrices tell it.
const ROUNDING: f64 = 1e-10;
/// Displacement (rad or m) for differences where the equilibrium does not move.
const SMALL: f64 = 1e-4;
/// Change of the stiffness of a mode that may come of second derivatives over the displacement of one standard deviation,
/// relative to it: [`FAR`](super::stages::FAR) of these leave three quarters of it.
const STRAIGHT: f64 = 0.007;
/// The kernels that samples need.
const KERNELS: [&str; 2] = ["residual_and_stiffness", "linear"];

/// The nominal state in the form that samples need.
pub(in crate::tolerance) struct TaylorModel<'a> {
    pub(super) kernels: &'a dyn BatchKernels,
    pub(in crate::tolerance) instructions: Instructions,
    pub(super) nominal: &'a Equilibrium,
    /// Where values are not normal: functions of a standard normal number each, and what is added to them.
    pub(super) joint: Option<(&'a Joint, Vector)>,
    /// Means, of normal values.
    pub(super) means: Vector,
    /// The same inputs in every lane.
    pub(super) inputs: Vector<Batch>,
    /// Diagonal of the factor `L` of the covariance; of values that are not normal, of the correlation of the normal numbers behind them.
    pub(super) own: Vector,
    /// (`i`, `j`, `L_ij`) beside the diagonal, row by row, without zeros.
    pub(super) shared: Vec<(usize, usize, f64)>,
    /// Pairs of random numbers on which anything depends.
    pub(super) drawn: Vec<bool>,
    /// Design variables that vary.
    pub(super) varied: Vec<usize>,
    /// `dq*/db` by varied variable.
    pub(super) first: Vec<Row<f64>>,
    /// Coefficient of `db_j db_k` in `q*` by `k` and `j <= k`, positions in `varied`; empty without.
    pub(super) second: Vec<Square<f64>>,
    /// Nominal modes, one in each row.
    pub(super) shapes: Square<f64>,
    /// Their `lambda`, 1/s^2.
    pub(super) lambda: Row<f64>,
    /// No design that can be drawn breaks a physical requirement: samples need not ask.
    pub(super) all_possible: bool,
    /// Displacements that one standard deviation of every variable causes.
    pub(super) reach: Row<f64>,
    /// `1/2 dKhat/dq_k` by `k` and row, rows beside the diagonal twice, the rows after `k` not used: the quadratic terms of the
    /// residual.
    pub(super) curvature: Vec<Square<f64>>,
    /// `dKhat/dq_k` between the nominal modes.
    pub(super) stiffening: Vec<Square<f64>>,
}

impl<'a> TaylorModel<'a> {
    /// `None` where the mechanism is not of the kind that is solved in vectors, the nominal state is not a clear minimum with
    /// all of its modes, or nothing varies.
    pub(in crate::tolerance) fn new(
        kernels: &'a dyn BatchKernels,
        nominal: &'a Equilibrium,
        modes: &Modes,
        tolerances: &'a Tolerances,
        instructions: Instructions,
    ) -> Option<Self> {
        let n = nominal.coordinates.len();
        let complete = modes.family == Family::Undamped && modes.modes.len() == n;
        let stable = nominal.stability == Stability::Stable;
        if !possible(&nominal.description, &KERNELS) || !complete || !stable {
            return None;
        }
        let shapes = modes.real_shapes();
        let lambda: Vector = modes.modes.iter().map(|mode| mode.lambda).collect();
        if !lambda.iter().all(|&value| value > 0.0) || !well_conditioned(nominal, &shapes, &lambda)
        {
            return None;
        }
        let p = nominal.design.len();
        let joint = tolerances.joint();
        let copula =
            joint.map(|(joint, _)| Matrix::from_fn(p, p, |i, j| joint.normal_factor(i, j)));
        let factor = copula.as_ref().unwrap_or(tolerances.factor());
        let shared: Vec<_> = (0..p)
            .flat_map(|i| (0..i).map(move |j| (i, j)))
            .map(|(i, j)| (i, j, factor[i][j]))
            .filter(|(_, _, value)| *value != 0.0)
            .collect();
        let own = Vector::from_fn(p, |i| factor[i][i]);
        let used = |j: usize| own[j] != 0.0 || shared.iter().any(|one| one.1 == j);
        let pairs = 0..p.div_ceil(2);
        let drawn = pairs
            .map(|pair| (2 * pair..p.min(2 * pair + 2)).any(used))
            .collect();
        let shifts = tolerances.shifts();
        let varied: Vec<_> = (0..p)
            .filter(|&i| tolerances.sigmas()[i] != 0.0 || shifts[i] != 0.0)
            .collect();
        let answer = Answer {
            mechanism: kernels,
            nominal,
        };
        let first = answer.slopes(&nominal.coordinates, &nominal.design, &varied)?;
        let deviations = &Vector::from_fn(p, |i| shifts[i].hypot(tolerances.sigmas()[i]));
        let reach = answer.reach(&varied, &first, deviations);
        let slopes = answer.stiffening(&reach, &shapes, &lambda)?;
        let limits = Vector::from_fn(p, |i| {
            let sum: f64 = factor[i].iter().map(|value| value.abs()).sum();
            let greatest = GREATEST_NORMAL * sum;
            match joint {
                None => shifts[i].abs() + greatest,
                Some((joint, about)) => {
                    let ends = [-greatest, greatest].map(|z| joint.variables()[i].from_normal(z));
                    largest(&ends.map(|end| end - about[i]))
                }
            }
        });
        Some(Self {
            kernels,
            instructions,
            nominal,
            inputs: nominal.inputs.map(Batch::all),
            joint: joint.map(|(joint, about)| {
                let moved = Vector::from_fn(p, |i| nominal.design[i] - about[i]);
                (joint, moved)
            }),
            means: Vector::from_fn(p, |i| nominal.design[i] + shifts[i]),
            second: answer.curvatures(&varied, &first, deviations)?,
            curvature: slopes.iter().enumerate().map(quadratic_terms).collect(),
            all_possible: kernels.possible_within(&nominal.inputs, &nominal.design, &limits),
            reach: row(&reach),
            stiffening: slopes
                .iter()
                .map(|slope| small(&between(slope, &shapes)))
                .collect(),
            own,
            shared,
            drawn,
            varied,
            first: first.iter().map(|slope| row(slope)).collect(),
            shapes: small(&shapes),
            lambda: row(&lambda),
        })
    }
}

fn row(values: &[f64]) -> Row<f64> {
    core::array::from_fn(|i| values.get(i).copied().unwrap_or(0.0))
}

/// Whether `phi^T Khat phi` gives every eigenvalue to enough digits.
fn well_conditioned(nominal: &Equilibrium, shapes: &Matrix, lambda: &[f64]) -> bool {
    let n = lambda.len();
    let linear = &nominal.linear;
    shapes.iter().zip(lambda).all(|(shape, lambda)| {
        let terms = (0..n)
            .flat_map(|i| (0..n).map(move |j| (i, j)))
            .map(|(i, j)| {
                let size = linear.stiffness[i][j].abs() + lambda * linear.mass[i][j].abs();
                (shape[i] * shape[j]).abs() * size
            });
        terms.sum::<f64>() * f64::EPSILON <= ROUNDING * lambda
    })
}

/// The nominal state and its neighbours.
struct Answer<'a> {
    mechanism: &'a dyn Kernels,
    nominal: &'a Equilibrium,
}

impl Answer<'_> {
    /// `dq*/db = -Khat^-1 dg/db` of the varied variables at a state next to an equilibrium.
    fn slopes(&self, q: &[f64], b: &[f64], varied: &[usize]) -> Option<Vec<Vector>> {
        let inputs = &self.nominal.inputs;
        let (_, stiffness) = self.mechanism.residual_and_stiffness(q, inputs, b);
        let (_, by_design) = self.mechanism.residual_partials(q, inputs, b);
        let factors = Cholesky::new(&stiffness).ok()?;
        let slope = |&j: &usize| {
            let right = Vector::from_fn(q.len(), |i| -by_design[i][j]);
            factors.solve(&right)
        };
        let slopes: Vec<Vector> = varied.iter().map(slope).collect();
        slopes
            .iter()
            .all(|slope| all_finite(slope))
            .then_some(slopes)
    }

    /// Half of `d2q*/db_j db_k` for equal variables, all of it for others, `j <= k`: secants of the slopes over one standard
    /// deviation along the equilibria.
    fn curvatures(
        &self,
        varied: &[usize],
        first: &[Vector],
        deviations: &[f64],
    ) -> Option<Vec<Square<f64>>> {
        let mut second = Vec::new();
        if varied.len() > FEW {
            return Some(second);
        }
        for (k, &variable) in varied.iter().enumerate() {
            let step = deviations[variable];
            let at = |step: f64| {
                let mut b = self.nominal.design.clone();
                b[variable] += step;
                let nominal = self.nominal.coordinates.iter();
                let q: Vector = nominal
                    .zip(&first[k])
                    .map(|(q, slope)| q + step * slope)
                    .collect();
                self.slopes(&q, &b, varied)
            };
            let (above, below) = (at(step)?, at(-step)?);
            let mut rows = [[0.0; LARGEST]; LARGEST];
            for (j, row) in rows.iter_mut().enumerate().take(k + 1) {
                let share = if j == k { 0.25 } else { 0.5 };
                for (i, value) in row.iter_mut().enumerate().take(first[k].len()) {
                    *value = share * (above[j][i] - below[j][i]) / step;
                }
            }
            second.push(rows);
        }
        let finite = second.iter().flatten().all(|row| all_finite(row));
        finite.then_some(second)
    }

    /// How far one standard deviation of every varied variable moves each coordinate, all in one sense; something where the
    /// equilibrium does not move.
    fn reach(&self, varied: &[usize], first: &[Vector], deviations: &[f64]) -> Vector {
        Vector::from_fn(self.nominal.coordinates.len(), |k| {
            let motions = first.iter().zip(varied);
            motions.fold(SMALL, |sum, (slope, &j)| {
                sum + (slope[k] * deviations[j]).abs()
            })
        })
    }

    /// `dKhat/dq_k` by differences over this displacement; `None` where the stiffness of a mode bends on the way.
    fn stiffening(&self, reach: &[f64], shapes: &Matrix, lambda: &[f64]) -> Option<Vec<Matrix>> {
        let Equilibrium {
            coordinates,
            inputs,
            design,
            ..
        } = self.nominal;
        let n = coordinates.len();
        let here = &self.nominal.linear.stiffness;
        let mut slopes = Vec::with_capacity(n);
        for k in 0..n {
            let at = |step: f64| {
                let mut q = coordinates.clone();
                q[k] += step;
                self.mechanism.residual_and_stiffness(&q, inputs, design).1
            };
            let (above, below) = (at(reach[k]), at(-reach[k]));
            let slope =
                Matrix::from_fn(n, n, |i, j| (above[i][j] - below[i][j]) / (2.0 * reach[k]));
            let bend = Matrix::from_fn(n, n, |i, j| 0.5 * (above[i][j] + below[i][j]) - here[i][j]);
            let bend = between(&bend, shapes);
            let straight = (0..n).all(|r| {
                (0..n).all(|s| bend[r][s].abs() <= STRAIGHT * (lambda[r] * lambda[s]).sqrt())
            });
            if !straight || !all_finite_matrix(&slope) {
                return None;
            }
            slopes.push(slope);
        }
        Some(slopes)
    }
}

/// `1/2 dKhat/dq_k`, row `j < k` standing for row `k` of `j` too.
fn quadratic_terms((k, slope): (usize, &Matrix)) -> Square<f64> {
    let mut terms = small(slope);
    for (j, row) in terms.iter_mut().enumerate() {
        let share = if j == k { 0.5 } else { 1.0 };
        row.iter_mut().for_each(|slope| *slope *= share);
    }
    terms
}

/// A symmetric matrix between the modes.
fn between(matrix: &Matrix, shapes: &Matrix) -> Matrix {
    let n = shapes.row_count();
    Matrix::from_fn(n, n, |r, s| form(&shapes[r], matrix, &shapes[s]))
}
