//! Branches of the paper's pendulums.

use super::*;

#[test]
fn the_pendulum_bends_to_both_sides() {
    let found = of(&Pendulum, &BAR, &[0.3], range(0.0, 6.0), None);
    assert_eq!(found.branches.len(), 3);
    let critical = only(&found);
    assert_eq!(critical.kind, SOFT);
    close(critical.value, W.sqrt(), 1e-13);
    near(critical.equilibrium.coordinates[0], 0.0, 1e-13);
    assert_eq!(critical.equilibrium.stability, Stability::Neutral { zero: 1 });
    assert_eq!(ends(&found.branches[0]), [&BranchEnd::Low, &BranchEnd::High]);
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
    // Downwards from a bent state, through the pitchfork into the other branches.
    let found = of(&Pendulum, &BAR, &[0.3], range(6.0, 1.0), None);
    assert_eq!(found.branches.len(), 3);
    close(only(&found).value, W.sqrt(), 1e-13);
    assert_eq!(only(&found).kind, SOFT);
    assert_eq!(ends(&found.branches[0]), [&BranchEnd::High, &BranchEnd::BranchPoint]);
}

#[test]
fn full_turns_are_the_same_branch() {
    let search = Search::new([-20.0], [20.0]).starts(60).seed(3);
    let found = of(&Pendulum, &BAR, &[0.3], range(0.0, 6.0), Some(&search));
    // Hanging, two bent, upside down.
    assert_eq!(found.branches.len(), 4);
    assert_eq!(found.special().len(), 1);
}

#[test]
fn the_double_pendulum_has_two_pitchforks() {
    let found = of(&DOUBLE, &BARS, &[0.3; 2], range(0.0, 8.0), None);
    // lambda^2 - 6 g lambda + 27/7 g^2 = 0 at rest; Omega_c^2 = lambda.
    let root = 6.0 / 7f64.sqrt();
    let special = found.special();
    assert_eq!(special.len(), 2);
    close(special[0].value, (GRAVITY * (3.0 - root)).sqrt(), 1e-13);
    close(special[1].value, (GRAVITY * (3.0 + root)).sqrt(), 1e-13);
    assert!(special.iter().all(|special| special.kind == SOFT));
    assert_eq!(special[1].equilibrium.stability, Stability::Divergent { negative: 1 });
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
            let from = &point.equilibrium.coordinates;
            let again = equilibrium(&DOUBLE, &[point.value], &BARS, from, Policy::Nearest).unwrap();
            for (x, y) in again.coordinates.iter().zip(from) {
                near(*x, *y, 1e-11);
            }
        }
    }
    // 50-digit reference from an ordinary solve at 4 rad/s, met by the line between two points.
    let bent = &found.branches[2];
    let after = bent.points.iter().position(|point| point.value > 4.0).unwrap();
    let (a, b) = (&bent.points[after - 1], &bent.points[after]);
    let share = (4.0 - a.value) / (b.value - a.value);
    let theta = a.equilibrium.coordinates[0] + share * (b.equilibrium.coordinates[0] - a.equilibrium.coordinates[0]);
    near(theta.abs(), 1.055_011_451_297_718_3, 2e-3);
}

#[test]
fn ranges_that_end_at_a_critical_value() {
    let critical = W.sqrt();
    for (low, high) in [(0.0, critical), (critical, 6.0), (6.0, critical), (critical, 0.0)] {
        let found = of(&Pendulum, &BAR, &[0.3], range(low, high), None);
        assert!(!found.branches.is_empty());
        for branch in &found.branches {
            assert!(!branch.ends.iter().any(|end| matches!(end, BranchEnd::Lost(_))));
        }
    }
    let fold = 2.0 / 27f64.sqrt();
    for (low, high) in [(-1.0, fold), (fold, 1.0), (fold, -1.0), (-fold, fold)] {
        let found = of(&Derived(Snap), &[1.0], &[0.9], range(low, high), None);
        assert!(!found.branches.is_empty());
        println!("{found}");
    }
    let second = (GRAVITY * (3.0 - 6.0 / 7f64.sqrt())).sqrt();
    for (low, high) in [(0.0, second), (second, 5.0), (5.0, second)] {
        let found = of(&DOUBLE, &BARS, &[0.3; 2], range(low, high), None);
        for branch in &found.branches {
            assert!(!branch.ends.iter().any(|end| matches!(end, BranchEnd::Lost(_))));
        }
    }
}
