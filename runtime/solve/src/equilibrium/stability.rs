//! Stability of an equilibrium according to the linearised mechanism.

use super::operating_point::Failure;
use crate::algebra::{Cholesky, Lu, Matrix, Vector, asymmetry, factor_rows, for_size, largest_element};
use crate::constraints::{Structure, Tangent};
use crate::eigenproblem::{Growing, growing};
use crate::free::FreeDirections;
use crate::kernels::{Kernels, Linear};
use crate::modes::{Family, Modes, SYMMETRIC, change_to_zero, deflated, free_pairs, solve_modes};
use crate::rounding::{self, CheckedState, Sign, sign};
use crate::{Behaviour, DampingKind, Description, Equilibrium, Mode, Shared, Stability};

/// Condition number beyond which an eigenvalue shares its vector with another.
const DEFECTIVE: f64 = 1e6;

/// The judgement of a state.
#[doc(hidden)]
pub struct Verdict {
    #[doc(hidden)]
    pub stability: Stability,
    /// Eigenvalues `lambda` up to this size cannot be distinguished from zero.
    #[doc(hidden)]
    pub rounding: f64,
    /// The general modes if they were needed; empty where theorems decided.
    #[doc(hidden)]
    pub modes: Vec<Mode>,
}

impl Verdict {
    /// The verdict for a state whose stability cannot be decided.
    #[doc(hidden)]
    pub fn undecided() -> Self {
        Self::without_modes(Stability::Undecided, 0.0)
    }

    pub(super) fn without_modes(stability: Stability, rounding: f64) -> Self {
        Self { stability, rounding, modes: Vec::new() }
    }
}

/// Whether `Khat` is positive definite beyond doubt.
#[inline]
pub(crate) fn clearly_definite(linear: &Linear) -> bool {
    Cholesky::new(&linear.stiffness).is_ok_and(|factors| rounding::clear(factors.pivots(), linear))
}

/// Whether `Mhat` and `Khat` are positive definite, `Khat` beyond doubt.
#[inline]
pub(super) fn clearly_stable(linear: &Linear) -> bool {
    for_size(
        linear.mass.row_count(),
        #[inline(always)]
        |n| {
            let mut factors = Cholesky::default();
            let (lower, pivots) = factors.room(n);
            factor_rows(n, linear.mass.as_flattened(), lower, pivots).is_ok()
                && factor_rows(n, linear.stiffness.as_flattened(), lower, pivots).is_ok()
                && rounding::clear(pivots, linear)
        },
    )
}

/// Judges stability by theorems where they decide, otherwise by the general eigenvalues.
///
/// A positive definite symmetric `Khat` with dissipative or gyroscopic `Chat` is stable (Kelvin, Tait, Chetaev);
/// `det Khat < 0` has a growing real solution whatever `Chat` is. The general eigenvalues decide all other cases,
/// including an odd number of negative directions next to free ones. With constraints on positions the theorems hold
/// for the directions they leave free. With speeds or constraints on velocities the general eigenvalues decide. Their modes
/// are found from those `nearby`; with `None`, they are not wanted.
pub fn judge(
    mechanism: &dyn Kernels,
    at: &CheckedState<'_>,
    linear: &Linear,
    nearby: Option<&[Mode]>,
) -> Result<Verdict, Failure> {
    let description = &mechanism.description();
    let structure = Structure::of(description);
    let held = FreeDirections::of(&linear.stiffness, description.free_directions).held(&linear.stiffness);
    let doubt = |lambda, phi: &[f64]| rounding::of_data(mechanism, at, &held, (lambda, phi));
    let count = description.free_directions;
    let general = |unstable, floor| by_eigenvalues((linear, nearby), (description, count), unstable, floor);
    if structure.open() {
        return judge_free(description, linear, linear, &doubt, &general);
    }
    let tangent = Tangent::new(linear, structure);
    if structure.holonomic() && tangent.freedom == 0 {
        return Ok(Verdict::without_modes(Stability::Stable, 0.0));
    }
    if !structure.holonomic() {
        return Ok(general((0, 0), 0.0));
    }
    let reduced = tangent.reduce_linear(linear);
    judge_free(description, linear, &reduced, &doubt, &general).map_err(|failure| match failure {
        Failure::SingularMass(direction) => Failure::SingularMass(tangent.foremost(direction)),
        other => other,
    })
}

/// Like [`judge`], for the matrices along the free directions.
///
/// `whole` are the matrices over all unknowns, `doubt` tells how far rounding of the data moves an eigenvalue, and
/// `general` judges by the general eigenvalues ([`by_eigenvalues`]).
fn judge_free(
    description: &Shared<Description>,
    whole: &Linear,
    linear: &Linear,
    doubt: &dyn Fn(f64, &[f64]) -> f64,
    general: &dyn Fn((usize, usize), f64) -> Verdict,
) -> Result<Verdict, Failure> {
    if let Err(row) = Cholesky::new(&linear.mass) {
        return Err(Failure::SingularMass(row));
    }
    // Stability is that of the other motions.
    let Some(rest) = deflated(linear, description.free_directions) else {
        return Ok(general((0, 0), 0.0));
    };
    let free = linear.mass.row_count() - rest.mass.row_count();
    let linear = &*rest;
    if !description.symmetric_stiffness && asymmetry(&linear.stiffness) > SYMMETRIC {
        let negative = Lu::new(&linear.stiffness).is_some_and(|factors| factors.negative_determinant());
        return Ok(if negative {
            Verdict::without_modes(Stability::Divergent { negative: 1 }, 0.0)
        } else {
            general((0, 0), 0.0)
        });
    }
    let (mut negative, mut zero, mut floor) = (0, free, 0.0_f64);
    if !clearly_definite(linear) {
        let Ok(pairs) = free_pairs(whole, description) else {
            return Ok(general((0, 0), 0.0));
        };
        for (&lambda, phi) in pairs.lambda.iter().zip(pairs.shapes.iter()).skip(free) {
            if lambda.abs() < rounding::SLOW {
                let moved = doubt(lambda, phi);
                floor = floor.max(if moved.is_finite() { moved } else { 0.0 });
            }
        }
        for (&lambda, &error) in pairs.lambda.iter().zip(&pairs.errors).skip(free) {
            match sign(lambda, error.max(floor)) {
                Sign::Negative => negative += 1,
                Sign::Zero => zero += 1,
                Sign::Positive => {}
            }
        }
    }
    let damped =
        description.damping != DampingKind::Zero && linear.damping.as_flattened().iter().any(|&value| value != 0.0);
    let stability = if negative > 0 && (!damped || (zero == 0 && negative % 2 == 1)) {
        Stability::Divergent { negative }
    } else if negative > 0 || (damped && !dissipates(linear)) {
        return Ok(general((negative, zero), floor));
    } else if zero > 0 {
        Stability::Neutral { zero }
    } else {
        Stability::Stable
    };
    Ok(Verdict::without_modes(stability, floor))
}

/// Judges a member of a family of steady motions. Each of its parameters is a zero, as each free direction is.
pub(super) fn judge_member(at: &Equilibrium) -> Verdict {
    let count = at.description.free_directions + at.free.held.len();
    by_eigenvalues((&at.linear, Some(&[])), (&at.description, count), (0, 0), 0.0)
}

/// Judges by the general eigenvalues, `count` of which are zero in any case, with `negative` directions of negative and
/// `free` ones of zero stiffness; a `lambda` not beyond `floor` counts as zero.
fn by_eigenvalues(
    (linear, nearby): (&Linear, Option<&[Mode]>),
    (description, count): (&Shared<Description>, usize),
    (negative, free): (usize, usize),
    floor: f64,
) -> Verdict {
    let conservative = description.symmetric_stiffness && description.damping != DampingKind::General;
    let by_signs = nearby.is_none() && Structure::of(description).open() && !conservative && count + free == 0;
    if by_signs
        && floor == 0.0
        && let Some(Growing { real, pairs }) = growing(linear)
    {
        let stability = match (real, pairs) {
            (0, 0) => Stability::Stable,
            (0, growing) => Stability::Flutter { growing },
            (negative, _) => Stability::Divergent { negative },
        };
        return Verdict::without_modes(stability, floor);
    }
    let mut spectrum = Modes::empty(Family::General, description);
    if spectrum.solve_near(linear, (count, floor), nearby.unwrap_or_default()).is_err() {
        return Verdict::without_modes(Stability::Undecided, floor);
    }
    let count = |wanted: fn(Behaviour) -> bool| {
        spectrum.modes.iter().map(|mode| mode.behaviour).filter(|&behaviour| wanted(behaviour)).count()
    };
    let divergent = count(|behaviour| matches!(behaviour, Behaviour::Divergent(_)));
    let growing = count(|behaviour| matches!(behaviour, Behaviour::Flutter(_)));
    let zero = count(|behaviour| matches!(behaviour, Behaviour::Free | Behaviour::Neutral));
    let constant = count(|behaviour| matches!(behaviour, Behaviour::Oscillating(_)));
    // Two that share an eigenvector grow in proportion to time, as a motion that drifts does.
    let drifts = |mode: &&Mode| {
        let near = |other: &Mode| (mode.s - other.s).norm() <= mode.error + other.error;
        let oscillates = matches!(mode.behaviour, Behaviour::Oscillating(_));
        oscillates && mode.condition > DEFECTIVE && spectrum.modes.iter().filter(|other| near(other)).count() > 1
    };
    let zero = zero + spectrum.modes.iter().filter(drifts).count();
    let stability = if divergent > 0 {
        Stability::Divergent { negative: divergent }
    } else if growing > 0 {
        Stability::Flutter { growing }
    } else if zero > 0 {
        // A direction without resistance has two zero eigenvalues `s`.
        Stability::Neutral { zero: if free > 0 { free } else { zero } }
    } else if constant == 0 {
        Stability::Stable
    } else if negative > 0 && skew(&linear.damping) {
        Stability::GyroscopicallyStabilised { negative }
    } else {
        Stability::Marginal
    };
    Verdict { stability, rounding: floor, modes: spectrum.modes }
}

/// Judges a critical state by its general eigenvalues, of which the `zero` smallest count as zero.
pub fn judge_critical(linear: &Linear, description: &Shared<Description>, zero: usize) -> Option<Verdict> {
    /// Both eigenvalues of a direction without stiffness are as far from zero as each other but for rounding.
    const MARGIN: f64 = 4.0;
    let mut modes = solve_modes(linear, Family::General, description, 0.0).ok()?.modes;
    modes.sort_by(|a, b| a.s.norm().total_cmp(&b.s.norm()));
    let critical = modes.get(zero.checked_sub(1)?)?;
    let floor = MARGIN * change_to_zero(linear, critical);
    let description = (description, description.free_directions);
    Some(by_eigenvalues((linear, Some(&[])), description, (0, zero), floor))
}

/// Whether a matrix is skew-symmetric to rounding.
fn skew(matrix: &Matrix) -> bool {
    let threshold = SYMMETRIC * largest_element(matrix);
    (0..matrix.row_count()).all(|i| (0..=i).all(|j| (matrix[i][j] + matrix[j][i]).abs() <= threshold))
}

/// Whether the symmetric part of `Chat` feeds no motion with energy, but for rounding of the elements of `Chat`: as that of
/// gyroscopic terms, which cancel in it.
fn dissipates(linear: &Linear) -> bool {
    /// Several times the smallest pivot that a factorisation takes, relative to its element.
    const MARGIN: f64 = 4.0;
    let damping = &linear.damping;
    let n = damping.row_count();
    let unit = linear.mass.iter().enumerate().map(|(i, row)| row[i].sqrt());
    let unit: Vector = unit.collect();
    let rounding = |i: usize| {
        let sum = unit[i] * (0..n).map(|j| (damping[i][j].abs() + damping[j][i].abs()) / unit[j]).sum::<f64>();
        if sum > 0.0 { MARGIN * rounding::of_elements(n) * sum } else { 1.0 }
    };
    let symmetric_part = |i: usize, j: usize| 0.5 * (damping[i][j] + damping[j][i]);
    let raised = |i, j| symmetric_part(i, j) + if i == j { rounding(i) } else { 0.0 };
    Cholesky::new(&Matrix::from_fn(n, n, raised)).is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `G^T G` with `rank` rows and gyroscopic terms, each unknown in a unit of its own.
    fn damped(n: usize, rank: usize, seed: u64) -> Linear {
        let mut state = seed;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let units: Vec<f64> = (0..n).map(|_| 10_f64.powf(6.0 * random())).collect();
        let rows = Matrix::from_fn(rank, n, |_, j| random() * units[j]);
        let gyroscopic = Matrix::from_fn(n, n, |_, _| 1e3 * random());
        let mut linear = Linear::zeros(n);
        for i in 0..n {
            linear.mass[i][i] = units[i] * units[i];
            for j in 0..n {
                let turned = (gyroscopic[i][j] - gyroscopic[j][i]) * units[i] * units[j];
                linear.damping[i][j] = turned + (0..rank).map(|k| rows[k][i] * rows[k][j]).sum::<f64>();
            }
        }
        linear
    }

    #[test]
    fn damping_of_any_rank_dissipates_and_less_than_it_feeds() {
        for seed in 0..400 {
            let n = 1 + seed as usize % 20;
            let rank = (seed as usize / 3) % n;
            let mut linear = damped(n, rank, seed);
            assert!(dissipates(&linear), "{seed}");
            // Something is negative along a motion that nothing damps.
            let k = seed as usize % n;
            let part = 1e-7 * linear.mass[k][k];
            for j in 0..n {
                if j != k {
                    (linear.damping[k][j], linear.damping[j][k]) = (0.0, 0.0);
                }
            }
            linear.damping[k][k] = -part;
            assert!(!dissipates(&linear), "{seed}");
        }
    }
}
