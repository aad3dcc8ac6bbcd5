//! Checks that the equations determine every motion: each must move some mass, and something must resist it.

use crate::algebra::{Evaluation, Graph};
use crate::base::diagnostics::Diagnostics;
use crate::base::ids::{CoordinateId, ExprId};
use crate::mechanics::linear::Jacobians;
use crate::mechanics::setup::{Context, probe, vanish};

/// Rejects a mechanism with a singular mass matrix, with a coordinate that nothing resists, or with a constraint that
/// no coordinate affects. If only the kernels are wanted, only the last is an error; for the others the coordinates are
/// returned.
pub(crate) fn require_determinate_motion(
    g: &Graph,
    context: &Context,
    jacobians: &Jacobians,
) -> Result<Vec<CoordinateId>, Diagnostics> {
    let mut diagnostics = Diagnostics::new();
    let mut undetermined = Vec::new();
    let (free, moving) = context.moving();
    let coordinate = |k: usize| {
        let topology = context.topology;
        let mut coordinates = topology.free.iter().chain(&topology.coasting);
        *coordinates.nth(k).expect("it moves")
    };
    let name = |k: usize| &context.mechanism.coordinates[coordinate(k).index()].name;
    let kernels_only = context.mechanism.kernels_only;
    let mut without_inertia = None;
    let massless = massless_motion(g, context, jacobians);
    if let (Some(motion), true) = (&massless, kernels_only) {
        undetermined.extend(motion.last().map(|&(k, _)| coordinate(k)));
    } else if let Some(motion) = &massless {
        let last = motion.last().map_or(0, |&(k, _)| k);
        let named = |&(k, _): &(usize, _)| format!("`{}`", name(k));
        let names: Vec<String> = motion.iter().map(named).collect();
        let shares: Option<Vec<String>> = motion
            .iter()
            .map(|&(k, share)| Some(format!("`{}` by {}", name(k), share?)))
            .collect();
        let (message, help) = match (names.as_slice(), shares) {
            ([only], _) => {
                without_inertia = Some(last);
                (
                    format!(
                        "no mass moves when only {only} changes, so its motion is undetermined"
                    ),
                    "give a mass to a body that this joint carries, or drive or fix the joint",
                )
            }
            (names, shares) => (
                format!(
                    "no mass moves when {} change together{}, so this motion is undetermined",
                    listed(names),
                    shares.map_or(String::new(), |shares| format!(", {}", listed(&shares)))
                ),
                "give a mass or an inertia to a body between these joints, or drive or fix one of them",
            ),
        };
        diagnostics.error_with_help(name(last).span(), message, help);
    }
    for (k, column) in jacobians.stiffness.iter().enumerate() {
        let idle = vanish(g, context, column).into_iter().all(|zero| zero);
        if !idle || without_inertia == Some(k) {
            continue;
        }
        if k < moving && kernels_only {
            if !undetermined.contains(&coordinate(k)) {
                undetermined.push(coordinate(k));
            }
        } else if k >= moving {
            let row = &context.rows[k - moving];
            let source = row.source.name(context.mechanism);
            diagnostics.error_with_help(
                source.span(),
                format!("no coordinate changes what `{}` demands", row.label),
                "remove it, or let it hold between things that move against each other",
            );
        } else if k >= free {
            diagnostics.error_with_help(
                name(k).span(),
                format!("nothing determines the speed of `{}`", name(k)),
                "drive it, or let a constraint or a damper decide how fast it runs",
            );
        } else {
            diagnostics.error_with_help(
                name(k).span(),
                format!(
                    "nothing resists `{}`: its equilibrium is not determined, and it has no natural frequency",
                    name(k)
                ),
                "add a spring on it, drive it, or make the joint fixed",
            );
        }
    }
    diagnostics.into_result(undetermined)
}

/// `a`, `b` and `c`.
fn listed(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [only] => only.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// A motion of free and coasting coordinates that moves no mass at any probed state: the coordinates that change, each
/// with its amount if that is the same at all states. With constraints, only admissible motions must move mass; along
/// all others `A^T A` replaces the mass matrix, where `A` holds the derivatives of the constraints by the speeds.
fn massless_motion(
    g: &Graph,
    context: &Context,
    jacobians: &Jacobians,
) -> Option<Vec<(usize, Option<f64>)>> {
    let (free, n) = context.moving();
    let by_rate = |matrix: &[Vec<ExprId>], next: &[Vec<ExprId>], row: usize| -> Vec<ExprId> {
        let coordinates = matrix[..free].iter();
        let speeds = next[free..n].iter();
        coordinates
            .chain(speeds)
            .map(|column| column[row])
            .collect()
    };
    let mut roots: Vec<ExprId> = (0..n)
        .flat_map(|row| by_rate(&jacobians.mass, &jacobians.damping, row))
        .collect();
    for (k, row) in context.rows.iter().enumerate() {
        let demands = if row.of_velocities {
            &jacobians.damping
        } else {
            &jacobians.stiffness
        };
        roots.extend(by_rate(demands, &jacobians.stiffness, n + k));
    }
    let motions: Option<Vec<Vec<f64>>> = probe(g, context, &roots)
        .iter()
        .map(|entries| {
            let values: Vec<f64> = entries.iter().map(|v| v.value).collect();
            let (mass, constraints) = values.split_at(n * n);
            let is_rounding = |pivot: f64, k: usize| {
                let pivot = Evaluation {
                    value: pivot,
                    ..entries[k * n + k]
                };
                pivot.is_negligible()
            };
            let masses: Vec<f64> = (0..n)
                .map(|k| &entries[k * n + k])
                .map(|own| if own.is_negligible() { 0.0 } else { own.value })
                .collect();
            null_vector(
                n,
                &with_constraints(mass, constraints, &masses),
                is_rounding,
            )
        })
        .collect();
    let motions = motions.filter(|motions| !motions.is_empty())?;
    let is_zero = |share: f64| share.abs() < 1e-7;
    let moving = (0..n).filter(|&k| motions.iter().any(|motion| !is_zero(motion[k])));
    let share = |k: usize| {
        let first = motions[0][k];
        let constant = motions.iter().all(|motion| is_zero(motion[k] - first));
        constant.then(|| format!("{first:.4}").parse().unwrap_or(first))
    };
    Some(moving.map(|k| (k, share(k))).collect())
}

/// `M + sum a a^T / (a^T D^-1 a)` over the constraints, with `D` the diagonal of `M` where it is not zero, given as
/// `masses`: each constraint counts as much as the masses it moves, whatever the units. One that moves no mass counts
/// as the largest mass.
fn with_constraints(mass: &[f64], constraints: &[f64], masses: &[f64]) -> Vec<f64> {
    let n = masses.len();
    let mut sum = mass.to_vec();
    let most = masses.iter().fold(0.0, |most: f64, own| most.max(*own));
    for a in constraints.chunks_exact(n.max(1)) {
        let square: f64 = a.iter().map(|x| x * x).sum();
        let moved = a.iter().zip(masses).filter(|(_, mass)| **mass > 0.0);
        let mobility: f64 = moved.map(|(x, mass)| x * x / mass).sum();
        let weight = match mobility > 0.0 {
            true => 1.0 / mobility,
            false => most / square,
        };
        if square > 0.0 {
            for (k, entry) in sum.iter_mut().enumerate() {
                *entry += weight * a[k / n] * a[k % n];
            }
        }
    }
    sum
}

/// A null vector of a singular symmetric matrix, with its last nonzero component one. A pivot counts as zero if it is
/// negligible compared with its diagonal entry or with the rounding error of that entry.
fn null_vector(
    n: usize,
    matrix: &[f64],
    is_rounding: impl Fn(f64, usize) -> bool,
) -> Option<Vec<f64>> {
    let mut a = matrix.to_vec();
    for k in 0..n {
        let pivot = a[k * n + k];
        if pivot <= 1e-10 * matrix[k * n + k].abs() || is_rounding(pivot, k) {
            let mut vector = vec![0.0; n];
            vector[k] = 1.0;
            for i in (0..k).rev() {
                let sum: f64 = (i + 1..=k).map(|j| a[i * n + j] * vector[j]).sum();
                vector[i] = -sum / a[i * n + i];
            }
            return Some(vector);
        }
        for i in k + 1..n {
            let factor = a[i * n + k] / a[k * n + k];
            for j in k..n {
                a[i * n + j] -= factor * a[k * n + j];
            }
        }
    }
    None
}
