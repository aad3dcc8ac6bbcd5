//! Folds and branch points of every kind.

use super::*;

#[test]
fn snap_through_is_followed_through_both_folds() {
    for a in [1.0, 0.37, 2.5] {
        let fold = 2.0 * (a / 3.0f64).powf(1.5);
        let found = of(&Derived(Snap), &[a], &[1.0], range(-2.0, 2.0), None);
        assert_eq!(found.branches.len(), 1);
        let branch = &found.branches[0];
        assert_eq!(ends(branch), [&BranchEnd::Low, &BranchEnd::High]);
        assert_eq!(branch.special.len(), 2);
        for (special, side) in branch.special.iter().zip([1.0, -1.0]) {
            assert_eq!(special.kind, SpecialKind::Fold);
            close(special.value, side * fold, 1e-13);
            close(special.equilibrium.coordinates[0], side * (a / 3.0).sqrt(), 1e-12);
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
    let found = of(&Derived(LopsidedSnap), &[0.2], &[1.0, 0.5], range(-1.0, 1.0), None);
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
    let found = of(&Derived(Exchange), &[d, e, s], &[0.2], range(-1.0, 1.0), None);
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
        // Straight lines, also where they cross: there the second-order terms of the equations give the directions.
        let level = branch.points.iter().all(|point| (point.equilibrium.coordinates[0] - d).abs() < 1e-9);
        for point in &branch.points {
            let slope = point.tangent[0] / point.input_tangent;
            near(slope, if level { 0.0 } else { s }, 1e-9);
        }
    }
}

#[test]
fn a_hard_loss_of_stiffness_comes_back() {
    let found = of(&Derived(Quintic), &[1.0], &[0.0], range(0.0, 2.0), None);
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
fn branch_points_of_a_nonsymmetric_stiffness() {
    let found = of(&Derived(Lopsided), &[1.0], &[0.0; 2], range(0.0, 7.0), None);
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
        let q = &point.equilibrium.coordinates;
        let (x, y) = (q[0], q[1]);
        near(y * (1.0 - point.value), x, 1e-9 * (1.0 + x.abs()));
    }
    let escapes = arms.iter().filter(|arm| arm.ends[1] == BranchEnd::Escape);
    assert_eq!(escapes.count(), 2);
}

#[test]
fn two_critical_directions_at_once_are_told() {
    for settings in [range(0.0, 2.0), range(0.3, 1.7), range(0.0, 1.9)] {
        let found = of(&Derived(Rotor), &[], &[0.0; 2], settings, None);
        assert_eq!(found.branches.len(), 1);
        let critical = only(&found);
        assert_eq!(critical.kind, SpecialKind::Degenerate);
        close(critical.value, 1.0, 1e-12);
        assert_eq!(critical.equilibrium.stability, Stability::Neutral { zero: 2 });
    }
    let equal = of(&Derived(NearlyTwo), &[0.0], &[0.0; 2], range(0.0, 1.9), None);
    assert_eq!(only(&equal).kind, SpecialKind::Degenerate);
    // Close together but separate: both pitchforks, and the secondary ones on the arms.
    for e in [1e-2, 1e-5] {
        let apart = of(&Derived(NearlyTwo), &[e], &[0.0; 2], range(0.0, 1.9), None);
        assert_eq!(apart.branches.len(), 9);
        let special = apart.special();
        assert_eq!(special.len(), 4);
        close(special[0].value, 1.0, 1e-12);
        close(special[1].value, 1.0 + e, 1e-12);
        assert_eq!(apart.stable().count(), 1 + 2 + 4);
    }
}
