//! Coupling of modes by design variables: the derivatives of the matrices in modal coordinates. Where eigenvalues are
//! (nearly) equal, the eigenvalues of these small matrices are the derivatives that exist (Prells and Friswell 1997,
//! Dailey 1989).

use crate::algebra::{Matrix, Vector, dot_complex, times_complex};
use crate::kernels::{DirectionalKernels, Linear};
use crate::modes::{Family, pencil_times};
use crate::sensitivity::{check_modes, directions, normaliser};
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
        Self {
            modes: (0..eigenvalues.len()).collect(),
            family,
            eigenvalues,
            by_input: Vec::new(),
            by_design,
        }
    }

    /// Mean of the eigenvalues.
    #[must_use]
    pub fn mean(&self) -> Complex {
        self.eigenvalues.iter().sum::<Complex>() / self.modes.len().max(1) as f64
    }

    /// Total derivatives of the mean eigenvalue with respect to the inputs.
    #[must_use]
    pub fn mean_by_input(&self) -> Vec<Complex> {
        self.by_input.iter().map(|own| self.trace(own)).collect()
    }

    /// Total derivatives of the mean eigenvalue with respect to the design variables; they exist even where those of
    /// single modes do not.
    #[must_use]
    pub fn mean_by_design(&self) -> Vec<Complex> {
        self.by_design.iter().map(|own| self.trace(own)).collect()
    }

    /// Trace of a matrix divided by its size.
    fn trace(&self, matrix: &Matrix<Complex>) -> Complex {
        let count = self.modes.len();
        let diagonal = (0..count).map(|i| matrix[i][i]);
        diagonal.sum::<Complex>() / count.max(1) as f64
    }

    /// Element (`i`, `j`) of the matrix of each design variable.
    pub(crate) fn element(&self, i: usize, j: usize) -> impl Iterator<Item = Complex> {
        self.by_design.iter().map(move |matrix| matrix[i][j])
    }

    /// The couplings among a subset of these modes, given by their places here.
    pub(crate) fn among(&self, places: &[usize]) -> Self {
        let size = places.len();
        let minor = |matrix: &Matrix<Complex>| {
            Matrix::from_fn(size, size, |i, j| matrix[places[i]][places[j]])
        };
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
        let elements = matrix.as_flattened().iter();
        let largest = elements.fold(0.0_f64, |most, own| most.max(own.norm()));
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
    let mut matrices = directions(mechanism, at)?.map(|along| {
        let change = along.linear(mechanism, at);
        match modes.family {
            Family::Undamped => undamped(&members, &change),
            Family::General => general(at, &members, &change),
        }
    });
    let by_input: Vec<_> = matrices.by_ref().take(at.inputs.len()).collect();
    let by_design: Vec<_> = matrices.collect();
    let eigenvalue = |mode: &&Mode| match (modes.family, mode.behaviour) {
        // Zero up to rounding, whose sign must not count as growth.
        (_, Behaviour::Free | Behaviour::Neutral) => Complex::ZERO,
        (Family::Undamped, _) => mode.lambda.into(),
        (Family::General, _) => mode.s,
    };
    Ok(ModalCouplings {
        modes: positions.to_vec(),
        family: modes.family,
        eigenvalues: members.iter().map(eigenvalue).collect(),
        by_input,
        by_design,
    })
}

/// `phi_i^T (dK - lambda dM) phi_j`, with the mean of the two eigenvalues to keep it symmetric.
fn undamped(members: &[&Mode], change: &Linear) -> Matrix<Complex> {
    matrix(members, |b| {
        let k = times_complex(&change.stiffness, &b.shape);
        let m = times_complex(&change.mass, &b.shape);
        move |a| {
            let lambda = 0.5 * (a.lambda + b.lambda);
            dot_complex(a.left(), &k) - lambda * dot_complex(a.left(), &m)
        }
    })
}

/// `-psi_i^T (s_j^2 dM + s_j dC + dK) phi_j / psi_i^T (2 s_i M + C) phi_i`: the change of the first-order system
/// between its left and right vectors.
fn general(at: &Equilibrium, members: &[&Mode], change: &Linear) -> Matrix<Complex> {
    matrix(members, |b| {
        let moved = pencil_times(change, b.s, &b.shape);
        move |a| -dot_complex(a.left(), &moved) / normaliser(at, a)
    })
}

/// Builds a matrix; `column` precomputes, for one right vector, what all left vectors share.
fn matrix<'a, F: Fn(&Mode) -> Complex>(
    members: &[&'a Mode],
    column: impl Fn(&'a Mode) -> F,
) -> Matrix<Complex> {
    let count = members.len();
    let mut matrix = Matrix::zeros(count, count);
    for (j, b) in members.iter().enumerate() {
        let element = column(b);
        for (i, a) in members.iter().enumerate() {
            matrix[i][j] = element(a);
        }
    }
    matrix
}
