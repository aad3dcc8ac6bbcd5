//! Checks that the equations determine every motion: each must move some mass, and something must decide every speed.

use crate::algebra::{Disturbed, Evaluator, ExprId, Graph};
use crate::base::diagnostics::{Diagnostics, listed};
use crate::base::ids::CoordinateId;
use crate::mechanics::linear::Jacobians;
use crate::mechanics::setup::{Context, probe, vanish};

/// Rejects a mechanism with a singular mass matrix, with a coasting coordinate whose speed nothing determines, or with a
/// constraint that no coordinate affects. If only the kernels are wanted, only the last is an error; for the others, and
/// for coordinates that nothing resists, the coordinates are returned.
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
        let shares: Option<Vec<String>> =
            motion.iter().map(|&(k, share)| Some(format!("`{}` by {}", name(k), share?))).collect();
        let (message, help) = match (names.as_slice(), shares) {
            ([only], _) => {
                without_inertia = Some(last);
                (
                    format!("no mass moves when only {only} changes, so its motion is undetermined"),
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
    let unknowns = jacobians.stiffness.len();
    let first = if kernels_only { 0 } else { free };
    let last = moving + context.rows.len();
    let zeros = vanish(g, context, &jacobians.stiffness[first..last].concat());
    for (k, column) in (first..).zip(zeros.chunks_exact(unknowns.max(1))) {
        let idle = column.iter().all(|zero| *zero);
        if !idle || without_inertia == Some(k) {
            continue;
        }
        if k >= moving {
            let row = &context.rows[k - moving];
            let source = row.source.name(context.mechanism);
            diagnostics.error_with_help(
                source.span(),
                format!("no coordinate changes what `{}` demands", row.label),
                "remove it, or let it hold between things that move against each other",
            );
        } else if !kernels_only {
            let steady = &context.mechanism.steady;
            if steady.iter().any(|x| x.coordinate == coordinate(k)) {
                continue;
            }
            diagnostics.error_with_help(
                name(k).span(),
                format!("nothing determines the speed of `{}`", name(k)),
                format!(
                    "drive it, let a constraint or a damper decide how fast it runs, or declare its speed: `steady {} = value;`",
                    name(k)
                ),
            );
        } else if !undetermined.contains(&coordinate(k)) {
            undetermined.push(coordinate(k));
        }
    }
    diagnostics.into_result(undetermined)
}

/// A motion of free and coasting coordinates that moves no mass at any probed state: the coordinates that change, each
/// with its amount if that is the same at all states. With constraints, only admissible motions must move mass; along
/// all others `A^T A` replaces the mass matrix, where `A` holds the derivatives of the constraints by the speeds.
fn massless_motion(g: &Graph, context: &Context, jacobians: &Jacobians) -> Option<Vec<(usize, Option<f64>)>> {
    let (free, n) = context.moving();
    let by_rate = |matrix: &[Vec<ExprId>], next: &[Vec<ExprId>], row: usize| -> Vec<ExprId> {
        let coordinates = matrix[..free].iter();
        let speeds = next[free..n].iter();
        coordinates.chain(speeds).map(|column| column[row]).collect()
    };
    let mut roots: Vec<ExprId> = (0..n).flat_map(|row| by_rate(&jacobians.mass, &jacobians.damping, row)).collect();
    for (k, row) in context.rows.iter().enumerate() {
        let demands = if row.of_velocities { &jacobians.damping } else { &jacobians.stiffness };
        roots.extend(by_rate(demands, &jacobians.stiffness, n + k));
    }
    let evaluator = Evaluator::new(g, &roots);
    let motions: Option<Vec<Vec<f64>>> = probe(&evaluator, context)
        .map(|entries| {
            let (mass, constraints) = entries.split_at(n * n);
            let matrix = with_constraints(n, mass, constraints, evaluator.operations());
            null_vector(n, matrix, evaluator.operations())
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

/// `M + sum a a^T / (a^T D^-1 a)` over the constraints, with `D` the diagonal of `M` where it is not zero: each
/// constraint counts as much as the masses it moves, whatever the units. One that moves no mass counts as the largest
/// mass.
fn with_constraints(n: usize, mass: &[Disturbed], constraints: &[Disturbed], operations: usize) -> Vec<Disturbed> {
    let mut sum = mass.to_vec();
    let masses: Vec<f64> = (0..n)
        .map(|k| &mass[k * n + k])
        .map(|item| if item.is_rounding(operations) { 0.0 } else { item.value() })
        .collect();
    let most = masses.iter().fold(0.0, |most: f64, mass| most.max(*mass));
    for a in constraints.chunks_exact(n.max(1)) {
        let square: f64 = a.iter().map(|x| x.value() * x.value()).sum();
        let moved = a.iter().zip(&masses).filter(|(_, mass)| **mass > 0.0);
        let mobility: f64 = moved.map(|(x, mass)| x.value() * x.value() / mass).sum();
        let weight = if mobility > 0.0 { 1.0 / mobility } else { most / square };
        let weight = Disturbed::exact(weight);
        if square > 0.0 {
            for (k, entry) in sum.iter_mut().enumerate() {
                *entry = *entry + weight * a[k / n] * a[k % n];
            }
        }
    }
    sum
}

/// A null vector of a singular symmetric matrix, with its last nonzero component one. A pivot counts as zero if
/// rounding can explain it; one is negative where the random design has a bore larger than the outside.
fn null_vector(n: usize, mut a: Vec<Disturbed>, operations: usize) -> Option<Vec<f64>> {
    for k in 0..n {
        let pivot = a[k * n + k];
        if pivot.is_rounding(operations) {
            let mut vector = vec![0.0; n];
            vector[k] = 1.0;
            for i in (0..k).rev() {
                let sum: f64 = (i + 1..=k).map(|j| a[i * n + j].value() * vector[j]).sum();
                vector[i] = -sum / a[i * n + i].value();
            }
            return Some(vector);
        }
        for i in k + 1..n {
            let factor = a[k * n + i] / pivot;
            for j in i..n {
                a[i * n + j] = a[i * n + j] - factor * a[k * n + j];
            }
        }
    }
    None
}
