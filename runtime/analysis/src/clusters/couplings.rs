//! Coupling of modes by design variables: the derivatives of the matrices in modal coordinates. Where eigenvalues are
//! (nearly) equal, the eigenvalues of these small matrices are the derivatives that exist (Prells and Friswell 1997,
//! Dailey 1989).

use crate::algebra::{Matrix, Vector, dot_complex, times_columns};
use crate::kernels::{DirectionalKernels, Kernels, Linear};
use crate::modes::{Family, pencil_times};
use crate::scalar::Real as _;
use crate::sensitivity::{check_modes, directions, normaliser};
use crate::shafts::{FormGradient, ShaftSlopes, form};
use crate::tolerance::Tolerances;
use crate::{Behaviour, Complex, Equilibrium, Error, Mode, Modes};

/// First-order motion of several modes together: for a change `db` their eigenvalues are those of
/// `diag(eigenvalues) + sum_k db_k by_design[k]`.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModalCouplings {
    /// Positions of the modes.
    pub modes: Vec<usize>,
    /// Which eigenvalue is meant: `lambda` (1/s^2) for undamped modes, `s` (1/s) for general ones.
    pub family: Family,
    /// The eigenvalues of the modes.
    pub eigenvalues: Vec<Complex>,
    /// One square matrix per input, per SI unit. The diagonal holds the derivatives of the eigenvalues as if each mode
    /// stood alone; the other elements tell how the input mixes the modes.
    pub by_input: Vec<Matrix<Complex>>,
    /// One such matrix per design variable.
    pub by_design: Vec<Matrix<Complex>>,
}

impl ModalCouplings {
    /// Creates couplings by design variables only, for modes in the order of their eigenvalues.
    #[must_use]
    pub fn new(family: Family, eigenvalues: Vec<Complex>, by_design: Vec<Matrix<Complex>>) -> Self {
        Self { modes: (0..eigenvalues.len()).collect(), family, eigenvalues, by_input: Vec::new(), by_design }
    }

    /// Mean of the eigenvalues.
    #[must_use]
    pub fn mean(&self) -> Complex {
        self.eigenvalues.iter().sum::<Complex>() / self.modes.len().max(1) as f64
    }

    /// Total derivatives of the mean eigenvalue with respect to the inputs.
    #[must_use]
    pub fn mean_by_input(&self) -> Vec<Complex> {
        self.by_input.iter().map(|x| self.trace(x)).collect()
    }

    /// Total derivatives of the mean eigenvalue with respect to the design variables; they exist even where those of
    /// single modes do not.
    #[must_use]
    pub fn mean_by_design(&self) -> Vec<Complex> {
        self.by_design.iter().map(|x| self.trace(x)).collect()
    }

    /// Trace of a matrix divided by its size.
    fn trace(&self, matrix: &Matrix<Complex>) -> Complex {
        let count = self.modes.len();
        (0..count).map(|i| matrix[i][i]).sum::<Complex>() / count.max(1) as f64
    }

    /// Element (`i`, `j`) of the matrix of each design variable.
    pub(crate) fn element(&self, i: usize, j: usize) -> impl Iterator<Item = Complex> {
        self.by_design.iter().map(move |matrix| matrix[i][j])
    }

    /// The couplings among a subset of these modes, given by their places here.
    pub(crate) fn among(&self, places: &[usize]) -> Self {
        let size = places.len();
        let minor = |matrix: &Matrix<Complex>| Matrix::from_fn(size, size, |i, j| matrix[places[i]][places[j]]);
        Self {
            modes: places.iter().map(|&i| self.modes[i]).collect(),
            family: self.family,
            eigenvalues: places.iter().map(|&i| self.eigenvalues[i]).collect(),
            by_input: self.by_input.iter().map(minor).collect(),
            by_design: self.by_design.iter().map(minor).collect(),
        }
    }
}

/// Elements of couplings below this, relative to the largest or to what the whole variable could change, are rounding.
const ROUNDING: f64 = 1e-8;

/// Derivatives with respect to the design variables of the eigenvalue of a mode with equal neighbours, where they
/// exist: where no variable splits them, because its couplings are a multiple of the identity.
pub(crate) fn common_slopes(
    mechanism: &dyn DirectionalKernels,
    at: &Equilibrium,
    modes: &Modes,
    mode: usize,
) -> Option<Vector<Complex>> {
    let couplings = modal_couplings(mechanism, at, modes, &modes.cluster_of(mode)).ok()?;
    let size = couplings.mean().norm();
    let splits = |(matrix, variable): (&Matrix<Complex>, &f64)| {
        let largest = matrix.as_flattened().iter().fold(0.0_f64, |most, element| most.max(element.norm()));
        let rounding = ROUNDING * largest.max(size / variable.abs());
        let common = couplings.trace(matrix);
        let count = couplings.modes.len();
        let off = |i: usize, j: usize| {
            let wanted = if i == j { common } else { Complex::ZERO };
            (matrix[i][j] - wanted).norm()
        };
        // A value that is not a number splits them too.
        !(0..count).all(|i| (0..count).all(|j| off(i, j) <= rounding))
    };
    let all = couplings.by_design.iter().zip(&at.design);
    let slopes = Vector::from(couplings.mean_by_design());
    (!all.into_iter().any(splits)).then_some(slopes)
}

/// The couplings among the modes at `positions`, including the shift of the equilibrium.
///
/// # Errors
/// [`Error::CriticalState`] if `Khat` is singular, [`Error::OutsideDomain`], [`Error::NoSuchMode`].
pub fn modal_couplings(
    mechanism: &dyn DirectionalKernels,
    at: &Equilibrium,
    modes: &Modes,
    positions: &[usize],
) -> Result<ModalCouplings, Error> {
    let count = modes.modes.len();
    if let Some(&mode) = positions.iter().find(|&&mode| mode >= count) {
        return Err(Error::NoSuchMode { mode, count });
    }
    check_modes(at, modes)?;
    let members: Vec<&Mode> = positions.iter().map(|&r| &modes.modes[r]).collect();
    let undamped = Undamped::new(&members);
    let damped = General::new(mechanism, at, of_family(modes.family, &members))?;
    let mut matrices = directions(mechanism, at)?.enumerate().map(|(variable, along)| {
        let change = along.linear(mechanism, at);
        match modes.family {
            Family::Undamped => undamped.couplings(&change).map(Complex::from),
            Family::General => damped.couplings(&change, variable),
        }
    });
    let by_input: Vec<_> = matrices.by_ref().take(at.inputs.len()).collect();
    let by_design: Vec<_> = matrices.collect();
    Ok(ModalCouplings {
        modes: positions.to_vec(),
        family: modes.family,
        eigenvalues: (positions.iter().map(|&r| coupled_eigenvalue(modes, r))).collect(),
        by_input,
        by_design,
    })
}

/// The eigenvalue that couplings move: `lambda` for undamped modes, `s` for general ones.
pub(super) fn coupled_eigenvalue(modes: &Modes, position: usize) -> Complex {
    let mode = &modes.modes[position];
    match (modes.family, mode.behaviour) {
        // Zero up to rounding, whose sign must not count as growth.
        (_, Behaviour::Free | Behaviour::Neutral) => Complex::ZERO,
        (Family::Undamped, _) => mode.lambda.into(),
        (Family::General, _) => mode.s,
    }
}

/// Undamped modes whose couplings are formed by products of matrices.
struct Undamped {
    lambda: Vec<f64>,
    /// One shape per row.
    rows: Matrix,
    /// One shape per column.
    columns: Matrix,
}

impl Undamped {
    fn new(members: &[&Mode]) -> Self {
        let shapes: Vec<Vector> = members.iter().map(|mode| mode.real_shape()).collect();
        let n = shapes.first().map_or(0, |shape| shape.len());
        let rows = Matrix::from_fn(shapes.len(), n, |r, i| shapes[r][i]);
        Self { lambda: members.iter().map(|mode| mode.lambda).collect(), columns: rows.transpose(), rows }
    }

    /// `phi_i^T (dK - lambda dM) phi_j`, with the mean of the two eigenvalues to keep it symmetric.
    fn couplings(&self, change: &Linear) -> Matrix {
        let [mut k, m] = [&change.stiffness, &change.mass].map(|matrix| {
            f64::run(
                #[inline(always)]
                || upper_product(&self.rows, &times_columns(matrix, &self.columns)),
            )
        });
        let count = self.lambda.len();
        for i in 0..count {
            for j in i..count {
                k[i][j] -= 0.5 * (self.lambda[i] + self.lambda[j]) * m[i][j];
                k[j][i] = k[i][j];
            }
        }
        k
    }
}

/// The product of two matrices on and above its diagonal.
#[inline(always)]
fn upper_product(rows: &Matrix, columns: &Matrix) -> Matrix {
    let mut product = Matrix::zeros(rows.row_count(), columns.column_count());
    for (i, (row, sums)) in rows.iter().zip(product.iter_mut()).enumerate() {
        for (factor, values) in row.iter().zip(columns.iter()) {
            for (sum, value) in sums[i..].iter_mut().zip(&values[i..]) {
                *sum += factor * value;
            }
        }
    }
    product
}

/// The modes if they are general.
fn of_family<'a>(family: Family, members: &'a [&'a Mode]) -> &'a [&'a Mode] {
    if family == Family::General { members } else { &[] }
}

/// General modes, with what their couplings need of shafts.
struct General<'a> {
    members: &'a [&'a Mode],
    normalisers: Vec<Complex>,
    /// For each two modes, row by row, the derivatives of `psi_i^T T(s_j) phi_j`.
    shafts: Option<(Box<ShaftSlopes>, Vec<FormGradient>)>,
}

impl<'a> General<'a> {
    fn new(mechanism: &dyn Kernels, at: &Equilibrium, members: &'a [&'a Mode]) -> Result<Self, Error> {
        let shafts = ShaftSlopes::of(mechanism, at)?;
        let normalisers = members.iter().map(|a| normaliser(at, shafts.as_deref(), a)).collect();
        let shafts = shafts.map(|shafts| {
            let each = members.iter().flat_map(|a| members.iter().map(move |b| form(a, b)));
            let between = shafts.shafts.gradients(&each.collect::<Vec<_>>());
            (shafts, between)
        });
        Ok(Self { members, normalisers, shafts })
    }

    /// `-psi_i^T (s_j^2 dM + s_j dC + dK) phi_j / psi_i^T (2 s_i M + C) phi_i`: the change of the first-order system
    /// between its left and right vectors, with an input or, behind these, a design variable.
    fn couplings(&self, change: &Linear, variable: usize) -> Matrix<Complex> {
        let Self { members, normalisers, shafts } = self;
        let count = members.len();
        let moved: Vec<_> = members.iter().map(|b| pencil_times(change, b.place(), &b.shape)).collect();
        Matrix::from_fn(count, count, |i, j| {
            let compiled = dot_complex(members[i].left(), &moved[j]);
            let of_shafts =
                shafts.as_ref().map(|(shafts, between)| shafts.along(&between[i * count + j].by_number, variable));
            -(compiled + of_shafts.unwrap_or_default()) / normalisers[i]
        })
    }
}

/// Standard deviations of what moves and mixes each pair of modes.
pub(super) struct PairSpreads {
    /// Of the difference of their eigenvalues, as if each mode stood alone.
    pub(super) apart: Matrix,
    /// Of their couplings.
    pub(super) coupling: Matrix,
}

impl PairSpreads {
    /// From the couplings of all modes, of which only sums are kept; `None` if variables are correlated or a sum
    /// exceeds the range of a double.
    pub(super) fn of_independent(
        mechanism: &dyn DirectionalKernels,
        at: &Equilibrium,
        modes: &Modes,
        tolerances: &Tolerances,
    ) -> Result<Option<Self>, Error> {
        check_modes(at, modes)?;
        if tolerances.correlation().is_some() {
            return Ok(None);
        }
        let members: Vec<&Mode> = modes.modes.iter().collect();
        let count = members.len();
        let undamped = Undamped::new(&members);
        let damped = General::new(mechanism, at, of_family(modes.family, &members))?;
        let zeros = || Matrix::zeros(count, count);
        let (mut apart, mut coupling) = (zeros(), zeros());
        let directions = directions(mechanism, at)?.enumerate().skip(at.inputs.len());
        for ((variable, along), sigma) in directions.zip(tolerances.sigmas()) {
            if *sigma == 0.0 {
                continue;
            }
            let change = along.linear(mechanism, at);
            let variance = sigma * sigma;
            match modes.family {
                Family::Undamped => {
                    let projection = undamped.couplings(&change);
                    for i in 0..count {
                        for j in 0..count {
                            apart[i][j] += variance * (projection[i][i] - projection[j][j]).powi(2);
                            coupling[i][j] += variance * projection[i][j].powi(2);
                        }
                    }
                }
                Family::General => {
                    let projection = damped.couplings(&change, variable);
                    for i in 0..count {
                        for j in 0..count {
                            apart[i][j] += variance * (projection[i][i] - projection[j][j]).norm_sqr();
                            coupling[i][j] += variance * projection[i][j].norm_sqr();
                        }
                    }
                }
            }
        }
        let ordinary = |sum: &f64| *sum == 0.0 || (SMALLEST..LARGEST).contains(sum);
        let usable = apart.as_flattened().iter().chain(coupling.as_flattened()).into_iter().all(ordinary);
        Ok(usable.then(|| Self { apart: apart.map(f64::sqrt), coupling: coupling.map(f64::sqrt) }))
    }
}

/// Sums of squares that neither overflow nor lose digits.
const SMALLEST: f64 = 1e-200;
const LARGEST: f64 = 1e200;
