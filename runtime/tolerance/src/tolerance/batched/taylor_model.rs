//! Data shared by all samples: how the nominal state depends on the design, to first and second order.

use eigentol_statistics::Joint;

use super::nominal::{FEW, Nominal};
use super::statics::{Statics, row};
use crate::algebra::{Matrix, Vector, largest};
use crate::batched::algebra::Row;
use crate::constraints::Structure;
use crate::eigenproblem::Reference;
use crate::kernels::BatchKernels;
use crate::modes::{Family, equal_groups};
use crate::scalar::Batch;
use crate::tolerance::Tolerances;
use crate::tolerance::normal_sampling::GREATEST_NORMAL;
use crate::{Equilibrium, Mode, Modes, Stability};

/// The nominal state in the form that samples need.
pub(in crate::tolerance) struct TaylorModel<'a, const N: usize> {
    pub(super) kernels: &'a dyn BatchKernels,
    pub(super) nominal: &'a Equilibrium,
    /// For values that are not normal: functions of one standard normal number each, and offsets to be added.
    pub(super) joint: Option<(&'a Joint, Vector)>,
    /// Means of normal values.
    pub(super) means: Vector,
    /// The inputs, equal in every lane.
    pub(super) inputs: Vector<Batch>,
    /// The nominal design, equal in every lane.
    pub(super) design: Vector<Batch>,
    /// Diagonal of the factor `L` of the covariance; for values that are not normal, of the correlation of the normal
    /// numbers behind them.
    pub(super) diagonal: Vector,
    /// (`i`, `j`, `L_ij`) off the diagonal, row by row, without zeros.
    pub(super) shared: Vec<(usize, usize, f64)>,
    /// Which pairs of random numbers are used.
    pub(super) drawn: Vec<bool>,
    /// Design variables that vary.
    pub(super) varied: Vec<usize>,
    /// `dq*/db`, by varied variable.
    pub(super) first: Vec<Row<f64, N>>,
    /// Coefficients of `db_j db_k` in `q*`, by `k` and `j <= k`, as positions in `varied`; empty if second derivatives
    /// are not used.
    pub(super) second: Vec<[Row<f64, N>; FEW]>,
    pub(super) statics: Statics<N>,
    /// Number of unknowns that are coordinates.
    pub(super) motions: usize,
    /// The nominal pairs, if modes are damped or constrained.
    pub(super) reference: Option<Reference>,
    /// Groups of nominal modes with equal eigenvalues.
    pub(super) groups: Vec<Vec<usize>>,
    /// No design that can be drawn violates a physical requirement, so samples need no check.
    pub(super) all_possible: bool,
    /// Displacements caused by one standard deviation of every variable.
    pub(super) reach: Row<f64, N>,
}

impl<'a, const N: usize> TaylorModel<'a, N> {
    /// `None` if the mechanism is not of a kind that is solved in vectors, the nominal state is not a clear minimum
    /// with all of its modes, or nothing varies.
    pub(super) fn new(
        kernels: &'a dyn BatchKernels,
        (nominal, modes): (&'a Equilibrium, &Modes),
        tolerances: &'a Tolerances,
    ) -> Option<Self> {
        let n = nominal.coordinates.len();
        if nominal.stability != Stability::Stable {
            return None;
        }
        let structure = Structure::of(&nominal.description);
        let reference = if modes.family == Family::Undamped && structure.open() {
            None
        } else {
            let pairs: Vec<_> = modes.modes.iter().map(Mode::near).collect();
            let motions = structure.motions();
            Some(Reference::new(&nominal.linear, motions, &pairs)?)
        };
        if reference.is_none() && modes.modes.len() != n {
            return None;
        }
        let p = nominal.design.len();
        let joint = tolerances.joint();
        let copula = joint.map(|(joint, _)| Matrix::from_fn(p, p, |i, j| joint.normal_factor(i, j)));
        let factor = copula.as_ref().unwrap_or(tolerances.factor());
        let shared: Vec<_> = (0..p)
            .flat_map(|i| (0..i).map(move |j| (i, j)))
            .map(|(i, j)| (i, j, factor[i][j]))
            .filter(|(_, _, value)| *value != 0.0)
            .collect();
        let diagonal = Vector::from_fn(p, |i| factor[i][i]);
        let used = |j: usize| diagonal[j] != 0.0 || shared.iter().any(|one| one.1 == j);
        let pairs = 0..p.div_ceil(2);
        let drawn = pairs.map(|pair| (2 * pair..p.min(2 * pair + 2)).any(used)).collect();
        let shifts = tolerances.shifts();
        let varied: Vec<_> = (0..p).filter(|&i| tolerances.sigmas()[i] != 0.0 || shifts[i] != 0.0).collect();
        let answer = Nominal {
            mechanism: kernels,
            state: nominal,
            potential: structure.open() && nominal.description.symmetric_stiffness,
        };
        let first = answer.slopes(&nominal.coordinates, &nominal.design, &varied)?;
        let deviations = &Vector::from_fn(p, |i| shifts[i].hypot(tolerances.sigmas()[i]));
        let reach = answer.reach(&varied, &first, deviations);
        let statics = Statics::new(&answer, (modes, reference.as_ref()), &reach)?;
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
            nominal,
            inputs: nominal.inputs.map(Batch::all),
            design: nominal.design.map(Batch::all),
            joint: joint.map(|(joint, about)| {
                let moved = Vector::from_fn(p, |i| nominal.design[i] - about[i]);
                (joint, moved)
            }),
            means: Vector::from_fn(p, |i| nominal.design[i] + shifts[i]),
            second: answer.curvatures(&varied, &first, deviations)?,
            all_possible: kernels.possible_within(&nominal.inputs, &nominal.design, &limits),
            reach: row(&reach),
            groups: equal_groups(modes),
            statics,
            motions: structure.motions(),
            reference,
            diagonal,
            shared,
            drawn,
            varied,
            first: first.iter().map(|slope| row(slope)).collect(),
        })
    }
}
