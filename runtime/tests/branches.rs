//! Branches of equilibria: followed through folds and into each other, located to rounding, each once.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::branching::{
    Away, Edge, Exchange, Field, Free, Imperfect, Lopsided, LopsidedSnap, NearlyTwo, Nothing,
    Quintic, Ring, Rotor, Snap,
};
use common::chain::DOUBLE;
use common::derived::Derived;
use common::models::Plate;
use common::pendulum::{Pendulum, W};
use common::{GRAVITY, close};
use eigentol::equilibrium::{
    Branch, BranchEnd, BranchPoint, Branches, Continuation, Search, SpecialKind, SpecialPoint,
    branch, branches, equilibrium, find_equilibria,
};
use eigentol::{Equilibrium, Error, Input, Mechanism, Policy, Stability, Study};

const BAR: [f64; 2] = [3.0, 1.0];
const BARS: [f64; 4] = [1.0, 1.0, 3.0, 3.0];
const SOFT: SpecialKind = SpecialKind::Pitchfork {
    supercritical: Some(true),
};
const HARD: SpecialKind = SpecialKind::Pitchfork {
    supercritical: Some(false),
};

fn range(low: f64, high: f64) -> Continuation {
    Continuation::new(Input(0), low, high)
}

fn near(actual: f64, expected: f64, tolerance: f64) {
    assert!(
        (actual - expected).abs() <= tolerance,
        "{actual:e} is not {expected:e} to {tolerance:e}"
    );
}

/// All branches of a machine with one input, checked for what holds of any branch.
fn of<M, const N: usize, const P: usize, const O: usize>(
    machine: &M,
    b: [f64; P],
    start: [f64; N],
    settings: Continuation,
    search: Option<&Search<N>>,
) -> Branches<N, 1, P>
where
    M: Mechanism<N, 1, P, O>,
{
    let found = branches(machine, &[0.0], &b, &start, &settings, search).unwrap();
    println!("{found}");
    assert!(!found.truncated);
    for branch in &found.branches {
        assert_sound(machine, branch, &settings);
    }
    found
}

fn assert_sound<M, const N: usize, const P: usize, const O: usize>(
    machine: &M,
    branch: &Branch<N, 1, P>,
    settings: &Continuation,
) where
    M: Mechanism<N, 1, P, O>,
{
    let range = (settings.high - settings.low).abs();
    for (end, point) in [branch.points.first(), branch.points.last()]
        .into_iter()
        .enumerate()
    {
        let value = point.unwrap().value;
        match branch.ends[end] {
            BranchEnd::Low => assert_eq!(value, settings.low),
            BranchEnd::High => assert_eq!(value, settings.high),
            _ => {}
        }
    }
    for pair in branch.points.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        let unit = |i: usize| settings.size + a.equilibrium.coordinates[i].abs();
        let mut along = (b.value - a.value) * a.input_tangent / range.powi(2);
        let mut length = (a.input_tangent / range).powi(2);
        let mut distance = ((b.value - a.value) / range).powi(2);
        for i in 0..N {
            let step = (b.equilibrium.coordinates[i] - a.equilibrium.coordinates[i]) / unit(i);
            along += step * a.tangent[i] / unit(i);
            length += (a.tangent[i] / unit(i)).powi(2);
            distance += step.powi(2);
        }
        near(length, 1.0, 1e-12);
        assert!(
            along > 0.8 * distance.sqrt() - 1e-9,
            "{} {}",
            a.value,
            b.value
        );
        assert!(distance.sqrt() < 1.5 * settings.max_step);
    }
    for point in &branch.points {
        let at = &point.equilibrium;
        assert_eq!(at.inputs, [point.value]);
        assert!(at.relative_residual <= 2e-10);
        // A tangent keeps the residual at zero.
        let (by_input, _) = machine.residual_partials(&at.coordinates, &at.inputs, &at.design);
        for (i, by_input) in by_input.iter().enumerate() {
            let (mut sum, mut size) =
                (by_input[0] * point.input_tangent, by_input[0].abs() * range);
            for j in 0..N {
                sum += at.linear.stiffness[i][j] * point.tangent[j];
                size += at.linear.stiffness[i][j].abs() * (settings.size + at.coordinates[j].abs());
            }
            assert!(sum.abs() <= 1e-9 * size + 1e-13, "{i}: {sum:e} of {size:e}");
        }
    }
    for special in &branch.special {
        assert!(
            branch
                .points
                .iter()
                .any(|point| point.value == special.value)
        );
        let at = &special.equilibrium;
        for i in 0..N {
            let right: f64 = (0..N)
                .map(|j| at.linear.stiffness[i][j] * special.v[j])
                .sum();
            let left: f64 = (0..N)
                .map(|j| at.linear.stiffness[j][i] * special.w[j])
                .sum();
            near(right, 0.0, 1e-11);
            near(left, 0.0, 1e-11);
        }
        let mass = at.linear.mass;
        let form = |x: &[f64; N], y: &[f64; N]| -> f64 {
            (0..N)
                .flat_map(|i| (0..N).map(move |j| x[i] * mass[i][j] * y[j]))
                .sum()
        };
        near(form(&special.v, &special.v), 1.0, 1e-13);
        near(form(&special.w, &special.v), 1.0, 1e-13);
    }
}

fn only<const N: usize, const P: usize>(found: &Branches<N, 1, P>) -> SpecialPoint<N, 1, P> {
    let all = found.special();
    assert_eq!(all.len(), 1);
    *all[0]
}

fn ends<const N: usize, const P: usize>(branch: &Branch<N, 1, P>) -> [&BranchEnd; 2] {
    branch.ends.each_ref()
}

#[test]
fn the_pendulum_bends_to_both_sides() {
    let found = of(&Pendulum, BAR, [0.3], range(0.0, 6.0), None);
    assert_eq!(found.branches.len(), 3);
    let critical = only(&found);
    assert_eq!(critical.kind, SOFT);
    close(critical.value, W.sqrt(), 1e-13);
    near(critical.equilibrium.coordinates[0], 0.0, 1e-13);
    assert_eq!(
        critical.equilibrium.stability,
        Stability::Neutral { zero: 1 }
    );
    assert_eq!(
        ends(&found.branches[0]),
        [&BranchEnd::Low, &BranchEnd::High]
    );
    let mut sides = 0.0;
    for (k, branch) in found.branches.iter().enumerate() {
        for point in &branch.points {
            let theta = point.equilibrium.coordinates[0];
            let speed = point.value;
            if k == 0 {
                near(theta, 0.0, 1e-13);
            } else {
                near(theta.cos() * speed * speed, W, 1e-12);
                if speed != critical.value {
                    sides += theta.signum();
                }
                if theta.abs() > 1e-3 {
                    // dtheta/dOmega = 2 cos / (Omega sin).
                    let slope = 2.0 * theta.cos() / (speed * theta.sin());
                    close(point.tangent[0] / point.input_tangent, slope, 1e-9);
                }
            }
            let expected = if speed == critical.value {
                Stability::Neutral { zero: 1 }
            } else if k == 0 && speed > critical.value {
                Stability::Divergent { negative: 1 }
            } else {
                Stability::Stable
            };
            assert_eq!(point.equilibrium.stability, expected, "{speed} {theta}");
        }
        if k > 0 {
            assert_eq!(ends(branch), [&BranchEnd::BranchPoint, &BranchEnd::High]);
            assert_eq!(branch.special.len(), 1);
        }
    }
    assert_eq!(sides, 0.0);
    let stable: Vec<_> = found.stable().collect();
    assert_eq!(stable.len(), 3);
    assert_eq!(stable[0].1.last().unwrap().value, critical.value);
    assert_eq!(stable[1].1.last().unwrap().value, 6.0);
}

#[test]
fn the_bent_branch_leads_to_the_hanging_one() {
    // Downwards from a bent state: through the pitchfork into the other branches.
    let found = of(&Pendulum, BAR, [0.3], range(6.0, 1.0), None);
    assert_eq!(found.branches.len(), 3);
    close(only(&found).value, W.sqrt(), 1e-13);
    assert_eq!(only(&found).kind, SOFT);
    assert_eq!(
        ends(&found.branches[0]),
        [&BranchEnd::Low, &BranchEnd::BranchPoint]
    );
}

#[test]
fn full_turns_are_the_same_branch() {
    let search = Search {
        lower: [-20.0],
        upper: [20.0],
        starts: 60,
        seed: 3,
    };
    let found = of(&Pendulum, BAR, [0.3], range(0.0, 6.0), Some(&search));
    // Hanging, two bent, upside down.
    assert_eq!(found.branches.len(), 4);
    assert_eq!(found.special().len(), 1);
}

#[test]
fn the_double_pendulum_has_two_pitchforks() {
    let found = of(&DOUBLE, BARS, [0.3; 2], range(0.0, 8.0), None);
    // lambda^2 - 6 g lambda + 27/7 g^2 = 0 at rest; Omega_c^2 = lambda.
    let root = 6.0 / 7f64.sqrt();
    let special = found.special();
    assert_eq!(special.len(), 2);
    close(special[0].value, (GRAVITY * (3.0 - root)).sqrt(), 1e-13);
    close(special[1].value, (GRAVITY * (3.0 + root)).sqrt(), 1e-13);
    assert!(special.iter().all(|special| special.kind == SOFT));
    assert_eq!(
        special[1].equilibrium.stability,
        Stability::Divergent { negative: 1 }
    );
    assert_eq!(found.branches.len(), 5);
    assert_eq!(found.stable().count(), 3);
    let unstable = |k: usize| found.branches[k].stretches();
    let count = |k: usize| unstable(k).iter().map(|run| run.0).collect::<Vec<_>>();
    let negative = |negative| Stability::Divergent { negative };
    assert_eq!(count(0), [Stability::Stable, negative(1), negative(2)]);
    assert_eq!(count(3), [negative(1)]);
    // An ordinary solve finds the same states.
    for branch in &found.branches {
        for point in branch.points.iter().step_by(7) {
            let from = point.equilibrium.coordinates;
            let again =
                equilibrium(&DOUBLE, &[point.value], &BARS, &from, Policy::Nearest).unwrap();
            for (x, y) in again.coordinates.iter().zip(from) {
                near(*x, y, 1e-11);
            }
        }
    }
    // 50-digit reference of an ordinary solve at 4 rad/s, met by the line between two points.
    let bent = &found.branches[2];
    let after = bent
        .points
        .iter()
        .position(|point| point.value > 4.0)
        .unwrap();
    let (a, b) = (&bent.points[after - 1], &bent.points[after]);
    let share = (4.0 - a.value) / (b.value - a.value);
    let theta = a.equilibrium.coordinates[0]
        + share * (b.equilibrium.coordinates[0] - a.equilibrium.coordinates[0]);
    near(theta.abs(), 1.055_011_451_297_718_3, 2e-3);
}

#[test]
fn snap_through_is_followed_through_both_folds() {
    for a in [1.0, 0.37, 2.5] {
        let fold = 2.0 * (a / 3.0f64).powf(1.5);
        let found = of(&Derived(Snap), [a], [1.0], range(-2.0, 2.0), None);
        assert_eq!(found.branches.len(), 1);
        let branch = &found.branches[0];
        assert_eq!(ends(branch), [&BranchEnd::Low, &BranchEnd::High]);
        assert_eq!(branch.special.len(), 2);
        for (special, side) in branch.special.iter().zip([1.0, -1.0]) {
            assert_eq!(special.kind, SpecialKind::Fold);
            close(special.value, side * fold, 1e-13);
            close(
                special.equilibrium.coordinates[0],
                side * (a / 3.0).sqrt(),
                1e-12,
            );
        }
        let stability: Vec<_> = branch.stretches().iter().map(|run| run.0).collect();
        let unstable = Stability::Divergent { negative: 1 };
        assert_eq!(stability, [Stability::Stable, unstable, Stability::Stable]);
        for point in &branch.points {
            let q = point.equilibrium.coordinates[0];
            near(q * q * q - a * q + point.value, 0.0, 1e-14);
        }
    }
}

#[test]
fn folds_of_a_nonsymmetric_stiffness() {
    let found = of(
        &Derived(LopsidedSnap),
        [0.2],
        [1.0, 0.5],
        range(-1.0, 1.0),
        None,
    );
    let special = found.special();
    assert_eq!((found.branches.len(), special.len()), (1, 2));
    for (special, side) in special.iter().zip([1.0, -1.0]) {
        assert_eq!(special.kind, SpecialKind::Fold);
        close(special.value, side * 2.0 * 0.3f64.powf(1.5), 1e-12);
        assert!((special.v[1] - special.w[1]).abs() > 0.1);
    }
}

#[test]
fn branches_exchange_their_stability() {
    let (d, e, s) = (0.1, -0.2, 0.7);
    let found = of(&Derived(Exchange), [d, e, s], [0.2], range(-1.0, 1.0), None);
    assert_eq!(found.branches.len(), 2);
    let critical = only(&found);
    assert_eq!(critical.kind, SpecialKind::Transcritical);
    close(critical.value, d + (d - e) / s, 1e-13);
    near(critical.equilibrium.coordinates[0], d, 1e-13);
    for branch in &found.branches {
        assert_eq!(ends(branch), [&BranchEnd::Low, &BranchEnd::High]);
        assert_eq!(branch.stretches().len(), 2);
        assert_eq!(branch.stable().len(), 1);
        for point in &branch.points {
            let q = point.equilibrium.coordinates[0];
            let off = (q - d) * (q - e - s * (point.value - d));
            near(off, 0.0, 1e-15);
        }
    }
}

#[test]
fn an_isolated_branch_needs_more_starts() {
    for e in [1e-2, 1e-5, 1e-8] {
        let imperfect = Derived(Imperfect);
        let alone = of(&imperfect, [e, 0.0], [0.0], range(-1.0, 1.0), None);
        assert_eq!(alone.branches.len(), 1, "{e}");
        assert!(alone.special().is_empty());
        assert_eq!(alone.stable().count(), 1);
        let search = Search {
            lower: [-2.0],
            upper: [2.0],
            starts: 12,
            seed: 1,
        };
        let both = of(&imperfect, [e, 0.0], [0.0], range(-1.0, 1.0), Some(&search));
        assert_eq!(both.branches.len(), 2, "{e}");
        let fold = only(&both);
        assert_eq!(fold.kind, SpecialKind::Fold);
        close(fold.value, 3.0 * (0.5 * e).powf(2.0 / 3.0), 1e-12);
        assert_eq!(
            ends(&both.branches[1]),
            [&BranchEnd::High, &BranchEnd::High]
        );
    }
}

#[test]
fn a_hard_loss_of_stiffness_comes_back() {
    let found = of(&Derived(Quintic), [1.0], [0.0], range(0.0, 2.0), None);
    assert_eq!(found.branches.len(), 3);
    let special = found.special();
    assert_eq!(special.len(), 3);
    assert_eq!(special[0].kind, HARD);
    close(special[0].value, 1.0, 1e-13);
    for fold in &special[1..] {
        assert_eq!(fold.kind, SpecialKind::Fold);
        close(fold.value, 0.75, 1e-13);
        close(fold.equilibrium.coordinates[0].abs(), 0.5f64.sqrt(), 1e-12);
    }
}

#[test]
fn a_line_through_a_ring() {
    let (d, r) = (0.2, 0.5);
    let found = of(&Derived(Ring), [d, r], [d], range(0.0, 2.0), None);
    assert_eq!(found.branches.len(), 2);
    let ring = &found.branches[1];
    assert_eq!(ends(ring), [&BranchEnd::Closed; 2]);
    let special = found.special();
    let kinds = |kind| {
        special
            .iter()
            .filter(|special| special.kind == kind)
            .count()
    };
    assert_eq!(kinds(SpecialKind::Fold), 2);
    assert_eq!(kinds(SpecialKind::Transcritical), 2);
    for special in special {
        let half = match special.kind {
            SpecialKind::Fold => r,
            _ => (r * r - d * d).sqrt(),
        };
        close((special.value - 1.0).abs(), half, 1e-12);
    }
    for point in &ring.points {
        let q = point.equilibrium.coordinates[0];
        near(q.hypot(point.value - 1.0), r, 1e-12);
    }
}

#[test]
fn branch_points_of_a_nonsymmetric_stiffness() {
    let found = of(&Derived(Lopsided), [1.0], [0.0; 2], range(0.0, 7.0), None);
    let special = found.special();
    let values: Vec<f64> = special.iter().map(|special| special.value).collect();
    close(values[0], 3.0 - 8f64.sqrt(), 1e-12);
    close(values[1], 3.0 + 8f64.sqrt(), 1e-12);
    assert_eq!(special.len(), 2);
    for special in special {
        assert!(matches!(special.kind, SpecialKind::Pitchfork { .. }));
        assert!((special.v[1] - special.w[1]).abs() > 0.1);
    }
    let arms = &found.branches[1..];
    assert_eq!(arms.len(), 4);
    for point in arms.iter().flat_map(|branch| &branch.points) {
        let [x, y] = point.equilibrium.coordinates;
        near(y * (1.0 - point.value), x, 1e-9 * (1.0 + x.abs()));
    }
    let escapes = arms.iter().filter(|arm| arm.ends[1] == BranchEnd::Escape);
    assert_eq!(escapes.count(), 2);
}

#[test]
fn two_critical_directions_at_once_are_told() {
    for settings in [range(0.0, 2.0), range(0.3, 1.7), range(0.0, 1.9)] {
        let found = of(&Derived(Rotor), [], [0.0; 2], settings, None);
        assert_eq!(found.branches.len(), 1);
        let critical = only(&found);
        assert_eq!(critical.kind, SpecialKind::Degenerate);
        close(critical.value, 1.0, 1e-12);
        assert_eq!(
            critical.equilibrium.stability,
            Stability::Neutral { zero: 2 }
        );
    }
    let equal = of(&Derived(NearlyTwo), [0.0], [0.0; 2], range(0.0, 1.9), None);
    assert_eq!(only(&equal).kind, SpecialKind::Degenerate);
    // Close together, but apart: both pitchforks, and the second ones on the arms.
    for e in [1e-2, 1e-5] {
        let apart = of(&Derived(NearlyTwo), [e], [0.0; 2], range(0.0, 1.9), None);
        assert_eq!(apart.branches.len(), 9);
        let special = apart.special();
        assert_eq!(special.len(), 4);
        close(special[0].value, 1.0, 1e-12);
        close(special[1].value, 1.0 + e, 1e-12);
        assert_eq!(apart.stable().count(), 1 + 2 + 4);
    }
}

#[test]
fn branches_end_at_the_edge_of_a_domain_and_at_infinity() {
    let edge = of(&Derived(Edge), [], [0.5], range(0.0, 2.0), None);
    let branch = &edge.branches[0];
    assert!(matches!(
        branch.ends[1],
        BranchEnd::Domain(Error::OutsideDomain { .. })
    ));
    near(branch.points.last().unwrap().value, 1.0, 1e-12);
    assert!(edge.special().is_empty());

    let away = of(&Derived(Away), [], [0.0], range(0.0, 2.0), None);
    assert_eq!(away.branches[0].ends[1], BranchEnd::Escape);
    assert!(away.special().is_empty());
    near(away.branches[0].points.last().unwrap().value, 1.0, 1e-5);

    // A point mass on a spinning plate is thrown out at its critical speed; the damping says nothing here.
    let design = [0.5, 40.0, 60.0, 0.3];
    let plate = of(&Derived(Plate), design, [0.0; 2], range(0.0, 10.0), None);
    assert_eq!(plate.branches[0].ends[1], BranchEnd::Escape, "{plate}");
}

#[test]
fn the_least_mechanisms_have_branches() {
    let nothing = of(&Derived(Nothing), [], [], range(0.0, 2.0), None);
    assert_eq!(nothing.branches.len(), 1);
    assert_eq!(
        ends(&nothing.branches[0]),
        [&BranchEnd::Low, &BranchEnd::High]
    );
    // A free coordinate rests anywhere: no line of equilibria to follow.
    let free = branches(&Derived(Free), &[0.0], &[], &[7.0], &range(1.0, 2.0), None).unwrap();
    assert!(
        matches!(free.branches[0].ends[1], BranchEnd::Lost(_)),
        "{free}"
    );
    assert_eq!(free.branches[0].points.len(), 1);
}

#[test]
fn ranges_that_end_at_a_critical_value() {
    let critical = W.sqrt();
    for (low, high) in [
        (0.0, critical),
        (critical, 6.0),
        (6.0, critical),
        (critical, 0.0),
    ] {
        let found = of(&Pendulum, BAR, [0.3], range(low, high), None);
        assert!(!found.branches.is_empty());
        for branch in &found.branches {
            assert!(
                !branch
                    .ends
                    .iter()
                    .any(|end| matches!(end, BranchEnd::Lost(_)))
            );
        }
    }
    let fold = 2.0 / 27f64.sqrt();
    for (low, high) in [(-1.0, fold), (fold, 1.0), (fold, -1.0), (-fold, fold)] {
        let found = of(&Derived(Snap), [1.0], [0.9], range(low, high), None);
        assert!(!found.branches.is_empty());
        println!("{found}");
    }
    let second = (GRAVITY * (3.0 - 6.0 / 7f64.sqrt())).sqrt();
    for (low, high) in [(0.0, second), (second, 5.0), (5.0, second)] {
        let found = of(&DOUBLE, BARS, [0.3; 2], range(low, high), None);
        for branch in &found.branches {
            assert!(
                !branch
                    .ends
                    .iter()
                    .any(|end| matches!(end, BranchEnd::Lost(_)))
            );
        }
    }
}

/// Random fields of fourth order: what a search finds anywhere in the range lies on a branch.
#[test]
fn no_equilibrium_of_a_random_field_is_missed() {
    let mut state = 1_u64;
    let mut random = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        ((state >> 33) as f64 / (1_u64 << 31) as f64) * 2.0 - 1.0
    };
    let search = Search {
        lower: [-3.0; 2],
        upper: [3.0; 2],
        starts: 40,
        seed: 5,
    };
    let (mut folds, mut crossings) = (0, 0);
    for trial in 0..40 {
        let mut b: [f64; 7] = std::array::from_fn(|_| random());
        if trial % 3 == 0 {
            // A mirror: q0 and -q0 are equivalent.
            (b[1], b[4], b[6]) = (0.0, 0.0, 0.0);
        }
        if trial % 2 == 0 {
            b[6] = 0.0;
        }
        let settings = range(-2.0, 2.5);
        let field = Derived(Field);
        let found = of(&field, b, [0.0; 2], settings, Some(&search));
        let special = found.special();
        folds += special
            .iter()
            .filter(|x| x.kind == SpecialKind::Fold)
            .count();
        crossings += special
            .iter()
            .filter(|x| x.kind != SpecialKind::Fold)
            .count();
        for branch in &found.branches {
            assert!(
                !branch.ends.iter().any(|end| matches!(
                    end,
                    BranchEnd::Lost(_) | BranchEnd::Domain(_) | BranchEnd::PointLimit
                )),
                "{trial}"
            );
        }
        for _ in 0..4 {
            let value = 1.9 * random();
            let there = find_equilibria(&field, &[value], &b, &[0.0; 2], &search).unwrap();
            let crossed = |state: &Equilibrium<2, 1, 7>| {
                found.branches.iter().any(|branch| {
                    branch.points.windows(2).any(|pair| {
                        let [a, b] = [&pair[0], &pair[1]];
                        let place = |point: &BranchPoint<2, 1, 7>| {
                            let [x, y] = point.equilibrium.coordinates;
                            [x, y, point.value / 4.5]
                        };
                        let (a, b) = (place(a), place(b));
                        let [x, y] = state.coordinates;
                        let c = [x, y, value / 4.5];
                        let dot = |x: [f64; 3], y: [f64; 3]| -> f64 {
                            x.iter().zip(y).map(|(x, y)| x * y).sum()
                        };
                        let minus = |x: [f64; 3], y: [f64; 3]| [0, 1, 2].map(|i| x[i] - y[i]);
                        let (along, off) = (minus(b, a), minus(c, a));
                        let share = (dot(off, along) / dot(along, along)).clamp(0.0, 1.0);
                        let rest = minus(off, along.map(|x| share * x));
                        dot(rest, rest).sqrt() < 0.01
                    })
                })
            };
            for state in &there {
                assert!(crossed(state), "{trial} {value} {state}\n{found}");
            }
            let passes: usize = found
                .branches
                .iter()
                .map(|branch| {
                    let pairs = branch.points.windows(2);
                    pairs
                        .filter(|pair| (pair[0].value > value) != (pair[1].value > value))
                        .count()
                })
                .sum();
            // An odd field has an odd number of zeros, nine at most; the search may miss some.
            assert!(passes % 2 == 1 && passes <= 9, "{trial} {value}: {passes}");
            assert!(passes >= there.len(), "{trial} {value}: {passes}");
        }
    }
    assert!(folds > 20 && crossings > 10, "{folds} {crossings}");
}

#[test]
fn limits_are_kept_and_told() {
    let few = Continuation {
        max_points: 5,
        ..range(0.0, 6.0)
    };
    let short = branch(&Pendulum, &[0.0], &BAR, &[0.3], &few).unwrap();
    assert_eq!(short.ends, [BranchEnd::Low, BranchEnd::PointLimit]);
    assert_eq!(short.points.len(), 6);
    let few = Continuation {
        max_branches: 2,
        ..range(0.0, 6.0)
    };
    let some = branches(&Pendulum, &[0.0], &BAR, &[0.3], &few, None).unwrap();
    assert!(some.truncated);
    assert_eq!(some.branches.len(), 2);
}

#[test]
fn one_branch_tells_what_crosses_it() {
    let hanging = branch(&Pendulum, &[0.0], &BAR, &[0.3], &range(0.0, 6.0)).unwrap();
    assert_sound(&Pendulum, &hanging, &range(0.0, 6.0));
    assert_eq!(hanging.special.len(), 1);
    assert_eq!(hanging.stable().len(), 1);
}

#[test]
fn reports_name_what_they_show() {
    let study = Study::new(Pendulum).start(eigentol::Coordinate(0), 0.3);
    let found = study.branches(Input(0), 0.0, 6.0).unwrap();
    let text = found.to_string();
    for part in [
        "Pendulum: 3 branches",
        "from omega [rad/s]",
        "theta [rad]",
        "supercritical pitchfork",
        "3.83601",
        "branch 2: branch point to high end of the range",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    let one = found.branches[1].to_string();
    assert!(one.contains("begins: branch point; ends: high end of the range"));
    assert!(found.special()[0].to_string().contains("critical mode v"));
}

#[test]
fn nasty_settings_are_refused_and_nasty_values_end_in_answers() {
    let ask = |settings: Continuation, start: f64, b: [f64; 2]| {
        branches(&Pendulum, &[0.0], &b, &[start], &settings, None)
    };
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for settings in [
            range(bad, 1.0),
            range(0.0, bad),
            Continuation {
                max_step: bad,
                ..range(0.0, 1.0)
            },
            Continuation {
                min_step: bad,
                ..range(0.0, 1.0)
            },
            Continuation {
                size: bad,
                ..range(0.0, 1.0)
            },
        ] {
            let refused = ask(settings, 0.1, BAR);
            assert!(matches!(refused, Err(Error::Setting { .. })), "{refused:?}");
        }
        assert!(matches!(
            ask(range(0.0, 1.0), bad, BAR),
            Err(Error::NotFinite { .. })
        ));
        assert!(matches!(
            ask(range(0.0, 1.0), 0.1, [3.0, bad]),
            Err(Error::NotFinite { .. })
        ));
    }
    for settings in [
        range(1.0, 1.0),
        range(-1e308, 1e308),
        Continuation {
            max_points: 0,
            ..range(0.0, 1.0)
        },
        Continuation {
            max_branches: 0,
            ..range(0.0, 1.0)
        },
        Continuation {
            escape: 0.5,
            ..range(0.0, 1.0)
        },
    ] {
        assert!(matches!(
            ask(settings, 0.1, BAR),
            Err(Error::Setting { .. })
        ));
    }
    let foreign = Continuation::new(Input(1), 0.0, 1.0);
    assert!(matches!(
        ask(foreign, 0.1, BAR),
        Err(Error::UnknownHandle { index: 1, .. })
    ));
    assert!(matches!(
        ask(range(0.0, 1.0), 0.1, [3.0, -1.0]),
        Err(Error::Unphysical { .. })
    ));
    let wild = [0.0, -1.0, 3.836_013_555_763_326_5, 6.0, -1e9, 1e160, 1e300];
    for low in wild {
        for high in wild {
            for start in [0.1, -1e7, 1e200] {
                assert_numbers(ask(range(low, high), start, BAR), low, high);
                for (b, u) in [([1.0, 1e-3], low), ([1e-200, 1e200], high)] {
                    let found = branches(
                        &Derived(Imperfect),
                        &[u],
                        &b,
                        &[start],
                        &range(low, high),
                        None,
                    );
                    assert_numbers(found, low, high);
                }
            }
        }
    }
}

fn assert_numbers<const P: usize>(found: Result<Branches<1, 1, P>, Error>, low: f64, high: f64) {
    for branch in found.iter().flat_map(|found| &found.branches) {
        for point in &branch.points {
            let (least, most) = (low.min(high), low.max(high));
            assert!(
                (least..=most).contains(&point.value),
                "{least:e} {:e} {most:e}",
                point.value
            );
            let q = point.equilibrium.coordinates[0];
            let numbers = [q, point.tangent[0], point.input_tangent];
            assert!(numbers.iter().all(|value| value.is_finite()));
        }
    }
}
