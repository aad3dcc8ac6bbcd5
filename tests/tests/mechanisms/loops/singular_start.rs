//! Branches that start in a singular configuration, in which constraints look redundant that are not.

use eigentol::branches::BranchEnd;
use eigentol::{Study, mechanism};

mechanism! {
    /// A governor: two arms carry one sleeve by rods of their own length. At rest they hang straight down.
    mechanism Hanging {
        input speed: rad/s;
        gravity 10 m/s^2 along -z;
        body shaft: massless;
        body left: point(mass: 1 kg, center: [0, 0, -1] m);
        body right: point(mass: 1 kg, center: [0, 0, -1] m);
        body sleeve: point(mass: 1 kg);
        joint spin: revolute(z) from ground to shaft, driven at speed;
        joint a: revolute(-y) from shaft to left at [0.1 m, 0, 0];
        joint b: revolute(y) from shaft to right at [-0.1 m, 0, 0];
        joint h: prismatic(z) from shaft to sleeve;
        point left_end: left at [0, 0, -1] m;
        point right_end: right at [0, 0, -1] m;
        point left_seat: sleeve at [0.1 m, 0, 0];
        point right_seat: sleeve at [-0.1 m, 0, 0];
        constraint left_rod: distance(from: left_end, to: left_seat, length: 1 m);
        constraint right_rod: distance(from: right_end, to: right_seat, length: 1 m);
    }
}

/// `w^2 (e + sin a) cos a = 2 g sin a`, with both arms at the same angle and the sleeve at `-2 cos a`.
#[test]
fn a_branch_from_hanging_arms_meets_both_rods() {
    let study = Study::new(Hanging).start(Hanging::a, 0.6).guess(Hanging::b, 0.6).guess(Hanging::h, -1.6);
    let found = study.branches(Hanging::speed, 0.0, 8.0).expect("branches");
    assert_eq!(found.branches.len(), 1);
    let branch = &found.branches[0];
    assert_eq!(branch.ends, [BranchEnd::Low, BranchEnd::High]);
    for point in &branch.points {
        let [a, b, h, pulls @ ..] = &point.equilibrium.coordinates[..] else { panic!("five unknowns") };
        let what = format!("{}: {}", point.value, point.equilibrium);
        assert!((a - b).abs() < 1e-6 && (h + 2.0 * a.cos()).abs() < 1e-9, "{what}");
        let force = point.value.powi(2) * (0.1 + a.sin()) * a.cos() - 20.0 * a.sin();
        assert!(force.abs() < 1e-6, "{what}");
        // Each rod carries half of the sleeve.
        for pull in pulls {
            assert!((pull.abs() * a.cos() - 5.0).abs() < 1e-6, "{what}");
        }
    }
}
