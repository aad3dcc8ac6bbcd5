//! Branches of equilibria: followed through folds and into each other, located to rounding, each found once.

mod ends;
mod pendulums;
mod settings;
mod special;

use crate::common::branching::{
    Away, Edge, Exchange, Field, Free, Imperfect, Lopsided, LopsidedSnap, NearlyTwo, Nothing, Quintic, Ring, Rotor,
    Snap,
};
use crate::common::chain::DOUBLE;
use crate::common::derived::Derived;
use crate::common::models::Plate;
use crate::common::pendulum::{Pendulum, W};
use crate::common::{GRAVITY, close};
use eigentol::branches::{
    Branch, BranchEnd, BranchPoint, Branches, Continuation, SpecialKind, SpecialPoint, branch, branches,
};
use eigentol::equilibrium::{Search, equilibrium, find_equilibria};
use eigentol::kernels::{DirectionalKernels, Kernels};
use eigentol::{Equilibrium, Error, Input, Policy, Stability, Study};

const BAR: [f64; 2] = [3.0, 1.0];
const BARS: [f64; 4] = [1.0, 1.0, 3.0, 3.0];
const SOFT: SpecialKind = SpecialKind::Pitchfork { supercritical: Some(true) };
const HARD: SpecialKind = SpecialKind::Pitchfork { supercritical: Some(false) };

fn range(low: f64, high: f64) -> Continuation {
    Continuation::new(Input::new(0), low, high)
}

fn near(actual: f64, expected: f64, tolerance: f64) {
    assert!((actual - expected).abs() <= tolerance, "{actual:e} is not {expected:e} to {tolerance:e}");
}

/// All branches of a machine with one input, checked for the properties of every branch.
fn of(
    machine: &dyn DirectionalKernels,
    b: &[f64],
    start: &[f64],
    settings: Continuation,
    search: Option<&Search>,
) -> Branches {
    let branches = branches(machine, &[0.0], b, start, &settings, search).unwrap();
    println!("{branches}");
    assert!(!branches.truncated);
    for branch in &branches.branches {
        assert_sound(machine, branch, &settings);
    }
    branches
}

fn assert_sound(machine: &dyn Kernels, branch: &Branch, settings: &Continuation) {
    let n = machine.sizes().coordinates;
    let range = (settings.high - settings.low).abs();
    for (end, point) in [branch.points.first(), branch.points.last()].into_iter().enumerate() {
        let value = point.unwrap().value;
        match branch.ends[end] {
            BranchEnd::Low => assert_eq!(value, settings.low.min(settings.high)),
            BranchEnd::High => assert_eq!(value, settings.low.max(settings.high)),
            _ => {}
        }
    }
    for pair in branch.points.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        let unit = |i: usize| settings.size + a.equilibrium.coordinates[i].abs();
        let mut along = (b.value - a.value) * a.input_tangent / range.powi(2);
        let mut length = (a.input_tangent / range).powi(2);
        let mut distance = ((b.value - a.value) / range).powi(2);
        for i in 0..n {
            let step = (b.equilibrium.coordinates[i] - a.equilibrium.coordinates[i]) / unit(i);
            along += step * a.tangent[i] / unit(i);
            length += (a.tangent[i] / unit(i)).powi(2);
            distance += step.powi(2);
        }
        near(length, 1.0, 1e-12);
        assert!(along > 0.8 * distance.sqrt() - 1e-9, "{} {}", a.value, b.value);
        assert!(distance.sqrt() < 1.5 * settings.max_step);
    }
    for point in &branch.points {
        let at = &point.equilibrium;
        assert_eq!(at.inputs, [point.value]);
        assert!(at.relative_residual <= 2e-10);
        // A tangent leaves the residual at zero.
        let (by_input, _) = machine.residual_partials(&at.coordinates, &at.inputs, &at.design);
        for (i, by_input) in by_input.iter().enumerate() {
            let (mut sum, mut size) = (by_input[0] * point.input_tangent, by_input[0].abs() * range);
            for j in 0..n {
                sum += at.linear.stiffness[i][j] * point.tangent[j];
                size += at.linear.stiffness[i][j].abs() * (settings.size + at.coordinates[j].abs());
            }
            assert!(sum.abs() <= 1e-9 * size + 1e-13, "{i}: {sum:e} of {size:e}");
        }
    }
    for special in &branch.special {
        assert!(branch.points.iter().any(|point| point.value == special.value));
        let at = &special.equilibrium;
        for i in 0..n {
            let right: f64 = (0..n).map(|j| at.linear.stiffness[i][j] * special.v[j]).sum();
            let left: f64 = (0..n).map(|j| at.linear.stiffness[j][i] * special.w[j]).sum();
            near(right, 0.0, 1e-11);
            near(left, 0.0, 1e-11);
        }
        let mass = &at.linear.mass;
        let form =
            |x: &[f64], y: &[f64]| -> f64 { (0..n).flat_map(|i| (0..n).map(move |j| x[i] * mass[i][j] * y[j])).sum() };
        near(form(&special.v, &special.v), 1.0, 1e-13);
        near(form(&special.w, &special.v), 1.0, 1e-13);
    }
}

fn only(branches: &Branches) -> SpecialPoint {
    let all = branches.special();
    assert_eq!(all.len(), 1);
    all[0].clone()
}

fn ends(branch: &Branch) -> [&BranchEnd; 2] {
    branch.ends.each_ref()
}
