//! Derivatives of equal eigenvalues, which exist only along one direction at a time (Prells and Friswell 1997, Dailey
//! 1989).

use super::couplings::modal_couplings;
use crate::arguments::check_count;
use crate::eigenproblem::eigenvalues;
use crate::kernels::DirectionalKernels;
use crate::modes::{Family, merged};
use crate::sensitivity::outside_domain;
use crate::{Complex, Description, Equilibrium, Error, Modes, Shared, Vector};

/// Derivatives of the eigenvalues of a cluster along one direction.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DirectionalDerivatives {
    /// Positions of its modes, from 0. Which derivative belongs to which mode is undefined.
    pub modes: Vec<usize>,
    /// Which eigenvalue is meant: `lambda` (1/s^2) for undamped modes, `s` (1/s) for general ones.
    pub family: Family,
    /// Derivatives of the eigenvalues, sorted by real part, then by imaginary part.
    pub eigenvalues: Vec<Complex>,
    /// Derivatives of the frequencies, rad/s, ascending; `None` for modes that do not oscillate.
    pub frequencies: Option<Vec<f64>>,
    /// The inputs of the operating point, SI.
    pub inputs: Vector,
    /// The mechanism they belong to.
    pub description: Shared<Description>,
}

/// Derivatives of the eigenvalues in the cluster of mode number `mode` along the change `du` of the inputs and `db` of
/// the design variables (SI), including the shift of the equilibrium. They are the eigenvalues of
/// `Phi^T (dKhat - lambda dMhat) Phi`, for general modes those of the couplings
/// `-psi_i^T (s^2 dMhat + s dChat + dKhat) phi_j / psi_i^T (2 s Mhat + Chat) phi_i`. The opposite direction has the
/// opposite derivatives; derivatives along other directions do not add up, because each direction splits the cluster in
/// its own way. For a mode apart from all others it is the ordinary derivative.
///
/// # Errors
/// [`Error::WrongLength`], [`Error::NoSuchMode`], [`Error::Defective`] if eigenvalues have merged,
/// [`Error::CriticalState`] if `Khat` is singular, [`Error::OutsideDomain`] if a derivative is not finite.
pub fn directional_derivatives(
    mechanism: &dyn DirectionalKernels,
    at: &Equilibrium,
    modes: &Modes,
    mode: usize,
    (du, db): (&[f64], &[f64]),
) -> Result<DirectionalDerivatives, Error> {
    check_count("changes of inputs", du, at.inputs.len())?;
    check_count("changes of design variables", db, at.design.len())?;
    let count = modes.modes.len();
    if mode >= count {
        return Err(Error::NoSuchMode { mode, count });
    }
    let cluster = modes.cluster_of(mode);
    if cluster.iter().any(|&member| merged(modes, member)) {
        return Err(Error::Defective { modes: cluster });
    }
    let couplings = modal_couplings(mechanism, at, modes, &cluster)?;
    let m = cluster.len();
    let mut matrix = vec![Complex::ZERO; m * m];
    let changes = couplings.by_input.iter().zip(du);
    for (slopes, &change) in changes.chain(couplings.by_design.iter().zip(db)) {
        for (sum, slope) in matrix.iter_mut().zip(slopes.as_flattened()) {
            *sum += slope * change;
        }
    }
    let mut derivatives = vec![Complex::ZERO; m];
    let finite = matrix.iter().all(|value| value.is_finite());
    if !(finite && eigenvalues(&mut matrix, &mut derivatives)) {
        return Err(outside_domain(at));
    }
    if modes.family == Family::Undamped {
        // The matrix is symmetric: an imaginary part is rounding.
        derivatives.iter_mut().for_each(|value| value.im = 0.0);
    }
    derivatives.sort_by(|a, b| a.re.total_cmp(&b.re).then(a.im.total_cmp(&b.im)));
    let mode = &modes.modes[mode];
    let frequencies = mode.frequency().map(|omega| {
        let slope = |value: &Complex| match modes.family {
            Family::Undamped => value.re / (2.0 * omega),
            Family::General => value.im,
        };
        let mut slopes: Vec<f64> = derivatives.iter().map(slope).collect();
        slopes.sort_by(f64::total_cmp);
        slopes
    });
    Ok(DirectionalDerivatives {
        modes: cluster,
        family: modes.family,
        eigenvalues: derivatives,
        frequencies,
        inputs: at.inputs.clone(),
        description: at.description.clone(),
    })
}
