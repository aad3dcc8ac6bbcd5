//! Exact moments of expansions.

use super::expansion::Expansion;
use crate::algebra::{Matrix, Vector, dot, form, times};
use crate::tolerance::Tolerances;

/// Moments of an expansion, SI; `None` where there is no closed form for these tolerances.
#[derive(Clone, Copy, Debug)]
pub(super) struct ExactMoments {
    pub(super) mean: f64,
    pub(super) sigma: Option<f64>,
    pub(super) skewness: Option<f64>,
}

/// Skewness and excess kurtosis of independent variables `y` of unit variance with `b = mean + L y`; `None` for
/// dependent variables that are not normal.
fn shape(tolerances: &Tolerances) -> Option<Vec<[f64; 2]>> {
    let Some((joint, _)) = tolerances.joint() else {
        return Some(vec![[0.0; 2]; tolerances.sigmas().len()]);
    };
    let variables = joint.variables().iter();
    (joint.is_independent())
        .then(|| variables.map(|variable| [variable.skewness(), variable.excess_kurtosis()]).collect())
}

/// First order: mean `f0 + S m`, variance `|a|^2`, third moment `sum a^3 g`, with `a = L^T S`, the shift `m` of the
/// means, and the skewness `g` of each independent variable.
pub(super) fn first_order(expansion: &Expansion, tolerances: &Tolerances) -> ExactMoments {
    let sigma = tolerances.sigma(&expansion.slopes);
    let a = times(&tolerances.factor().transpose(), &expansion.slopes);
    let third =
        |shape: Vec<[f64; 2]>| a.iter().zip(shape).map(|(a, [skewness, _])| (a / sigma).powi(3) * skewness).sum();
    ExactMoments {
        mean: expansion.value + tolerances.mean_shift(&expansion.slopes),
        sigma: Some(sigma),
        skewness: shape(tolerances).filter(|_| sigma > 0.0).map(third),
    }
}

/// Second order, for any distribution: with `a = L^T (S + H m)` and `B = L^T H L`, the mean is
/// `f0 + S m + m^T H m / 2 + tr(B) / 2`. For independent variables of skewness `g` and excess kurtosis `k`, the
/// variance is `sum a^2 + sum a_j B_jj g_j + sum B_jj^2 k_j / 4 + sum_jk B_jk^2 / 2`.
pub(super) fn second_order(expansion: &Expansion, curvature: &Matrix, tolerances: &Tolerances) -> ExactMoments {
    let shifts = tolerances.shifts();
    let columns = tolerances.factor().transpose();
    let bent = times(curvature, shifts);
    let slopes: Vector = expansion.slopes.iter().zip(&bent).map(|(s, h)| s + h).collect();
    let a = times(&columns, &slopes);
    let size = a.len();
    let b = Matrix::from_fn(size, size, |j, k| form(&columns[j], curvature, &columns[k]));
    let trace: f64 = (0..size).map(|j| b[j][j]).sum();
    let variance = |shape: Vec<[f64; 2]>| {
        let squares: f64 = b.as_flattened().iter().map(|element| element * element).sum();
        let terms = shape.iter().enumerate();
        let terms =
            terms.map(|(j, [skewness, kurtosis])| a[j] * b[j][j] * skewness + 0.25 * b[j][j] * b[j][j] * kurtosis);
        dot(&a, &a) + terms.sum::<f64>() + 0.5 * squares
    };
    ExactMoments {
        mean: expansion.first_order(shifts) + 0.5 * dot(shifts, &bent) + 0.5 * trace,
        sigma: shape(tolerances).map(|shape| variance(shape).max(0.0).sqrt()),
        skewness: None,
    }
}
