//! Where branches begin and end, and which branches are found.

use super::*;

#[test]
fn an_isolated_branch_needs_more_starts() {
    for e in [1e-2, 1e-5, 1e-8] {
        let imperfect = Derived(Imperfect);
        let alone = of(&imperfect, &[e, 0.0], &[0.0], range(-1.0, 1.0), None);
        assert_eq!(alone.branches.len(), 1, "{e}");
        assert!(alone.special().is_empty());
        assert_eq!(alone.stable().count(), 1);
        let search = Search::new([-2.0], [2.0]).starts(12).seed(1);
        let both = of(&imperfect, &[e, 0.0], &[0.0], range(-1.0, 1.0), Some(&search));
        assert_eq!(both.branches.len(), 2, "{e}");
        let fold = only(&both);
        assert_eq!(fold.kind, SpecialKind::Fold);
        close(fold.value, 3.0 * (0.5 * e).powf(2.0 / 3.0), 1e-12);
        assert_eq!(ends(&both.branches[1]), [&BranchEnd::High, &BranchEnd::High]);
    }
}

#[test]
fn a_line_through_a_ring() {
    let (d, r) = (0.2, 0.5);
    let found = of(&Derived(Ring), &[d, r], &[d], range(0.0, 2.0), None);
    assert_eq!(found.branches.len(), 2);
    let ring = &found.branches[1];
    assert_eq!(ends(ring), [&BranchEnd::Closed; 2]);
    let special = found.special();
    let kinds = |kind| special.iter().filter(|special| special.kind == kind).count();
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
fn branches_end_at_the_edge_of_a_domain_and_at_infinity() {
    let edge = of(&Derived(Edge), &[], &[0.5], range(0.0, 2.0), None);
    let branch = &edge.branches[0];
    assert!(matches!(branch.ends[1], BranchEnd::Domain(Error::OutsideDomain { .. })));
    near(branch.points.last().unwrap().value, 1.0, 1e-12);
    assert!(edge.special().is_empty());

    let away = of(&Derived(Away), &[], &[0.0], range(0.0, 2.0), None);
    assert_eq!(away.branches[0].ends[1], BranchEnd::Escape);
    assert!(away.special().is_empty());
    near(away.branches[0].points.last().unwrap().value, 1.0, 1e-5);

    // A point mass on a spinning plate is thrown outwards at its critical speed; damping plays no part here.
    let design = [0.5, 40.0, 60.0, 0.3];
    let plate = of(&Derived(Plate), &design, &[0.0; 2], range(0.0, 10.0), None);
    assert_eq!(plate.branches[0].ends[1], BranchEnd::Escape, "{plate}");
}

#[test]
fn the_least_mechanisms_have_branches() {
    let nothing = of(&Derived(Nothing), &[], &[], range(0.0, 2.0), None);
    assert_eq!(nothing.branches.len(), 1);
    assert_eq!(ends(&nothing.branches[0]), [&BranchEnd::Low, &BranchEnd::High]);
    // A free coordinate is in equilibrium anywhere: there is no branch to follow.
    let free = branches(&Derived(Free), &[0.0], &[], &[7.0], &range(1.0, 2.0), None).unwrap();
    assert!(matches!(free.branches[0].ends[1], BranchEnd::Lost(_)), "{free}");
    assert_eq!(free.branches[0].points.len(), 1);
}

/// Random quartic fields: every equilibrium that a search finds in the range lies on a branch.
#[test]
fn no_equilibrium_of_a_random_field_is_missed() {
    let mut state = 1_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        ((state >> 33) as f64 / (1_u64 << 31) as f64) * 2.0 - 1.0
    };
    let search = Search::new([-3.0; 2], [3.0; 2]).starts(40).seed(5);
    let (mut folds, mut crossings) = (0, 0);
    for trial in 0..18 {
        let mut b: [f64; 7] = std::array::from_fn(|_| random());
        if trial % 3 == 0 {
            // Mirror symmetry: q0 and -q0 are equivalent.
            (b[1], b[4], b[6]) = (0.0, 0.0, 0.0);
        }
        if trial % 2 == 0 {
            b[6] = 0.0;
        }
        let settings = range(-2.0, 2.5);
        let field = Derived(Field);
        let found = of(&field, &b, &[0.0; 2], settings, Some(&search));
        let special = found.special();
        folds += special.iter().filter(|x| x.kind == SpecialKind::Fold).count();
        crossings += special.iter().filter(|x| x.kind != SpecialKind::Fold).count();
        for branch in &found.branches {
            assert!(
                !branch
                    .ends
                    .iter()
                    .any(|end| matches!(end, BranchEnd::Lost(_) | BranchEnd::Domain(_) | BranchEnd::PointLimit)),
                "{trial}"
            );
        }
        for _ in 0..4 {
            let value = 1.9 * random();
            let there = find_equilibria(&field, &[value], &b, &[0.0; 2], &search, eigentol::Watch::default()).unwrap();
            let crossed = |state: &Equilibrium| {
                found.branches.iter().any(|branch| {
                    branch.points.windows(2).any(|pair| {
                        let [a, b] = [&pair[0], &pair[1]];
                        let place = |point: &BranchPoint| {
                            let q = &point.equilibrium.coordinates;
                            [q[0], q[1], point.value / 4.5]
                        };
                        let (a, b) = (place(a), place(b));
                        let q = &state.coordinates;
                        let c = [q[0], q[1], value / 4.5];
                        let dot = |x: [f64; 3], y: [f64; 3]| -> f64 { x.iter().zip(y).map(|(x, y)| x * y).sum() };
                        let minus = |x: [f64; 3], y: [f64; 3]| [0, 1, 2].map(|i| x[i] - y[i]);
                        let (along, off) = (minus(b, a), minus(c, a));
                        let share = (dot(off, along) / dot(along, along)).clamp(0.0, 1.0);
                        let rest = minus(off, along.map(|x| share * x));
                        dot(rest, rest).sqrt() < 0.01
                    })
                })
            };
            for state in there.iter() {
                assert!(crossed(state), "{trial} {value} {state}\n{found}");
            }
            let passes: usize = found
                .branches
                .iter()
                .map(|branch| {
                    let pairs = branch.points.windows(2);
                    pairs.filter(|pair| (pair[0].value > value) != (pair[1].value > value)).count()
                })
                .sum();
            // An odd field has an odd number of zeros, at most nine; the search may miss some.
            assert!(passes % 2 == 1 && passes <= 9, "{trial} {value}: {passes}");
            assert!(passes >= there.len(), "{trial} {value}: {passes}");
        }
    }
    assert!(folds > 10 && crossings > 5, "{folds} {crossings}");
}
