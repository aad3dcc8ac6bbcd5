//! Individual degenerate cases.

use super::checks::check;
use super::*;

#[test]
fn nothing_resists() {
    let pencil = linear([[1.0, 0.2], [0.2, 1.3]], zeros(2), zeros(2));
    let roots = solve(&pencil).unwrap();
    check(&pencil, &roots).unwrap();
    assert_eq!(roots.len(), 4);
    for root in &roots {
        assert_eq!(root.s, Complex64::ZERO);
        assert!(root.error < 1e-20 && root.condition == f64::INFINITY);
    }
}

/// `M s^2 + C s` with regular `C`: zero is semisimple, with as many copies as there are coordinates.
#[test]
fn only_dampers() {
    let pencil = linear(identity(3), [[3.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 1.0]], zeros(3));
    let roots = solve(&pencil).unwrap();
    check(&pencil, &roots).unwrap();
    let zeros = &roots[..3];
    assert!(zeros.iter().all(|root| root.s.norm() <= root.error));
    assert!(zeros.iter().all(|root| root.error < 1e-14));
    let vectors: Vec<_> = zeros.iter().map(|root| &root.right[..]).collect();
    assert_eq!(checks::rank(&pencil, &vectors), 3);
}

/// A Jordan block of `K`: `s = +- i sqrt(2)`, twice each, with one vector.
#[test]
fn jordan_block() {
    let pencil = linear(identity(2), zeros(2), [[2.0, 1.0], [0.0, 2.0]]);
    let roots = solve(&pencil).unwrap();
    check(&pencil, &roots).unwrap();
    for root in &roots {
        assert!((root.s - Complex64::new(0.0, 2.0_f64.sqrt())).norm() <= root.error);
        assert!(root.error < 1e-6 && root.condition > 1e7);
        assert!(root.right[1].norm() < 1e-6 && root.left[0].norm() < 1e-6);
    }
}

#[test]
fn critically_damped() {
    let roots = solve(&linear([[1.0]], [[2.0]], [[1.0]])).unwrap();
    let [a, b] = &roots[..] else { panic!("{roots:?}") };
    for root in [a, b] {
        assert!((root.s + 1.0).norm() <= root.error && root.error < 1e-6);
    }
}

#[test]
fn failures_are_answers() {
    let singular = solve(&linear([[1.0, 1.0], [1.0, 1.0]], zeros(2), zeros(2)));
    assert_eq!(singular.err(), Some(EigenproblemError::SingularMass(1)));
    let negative = solve(&linear(diagonal(&[-1.0, 1.0]), zeros(2), zeros(2)));
    assert_eq!(negative.err(), Some(EigenproblemError::SingularMass(0)));
    for bad in [f64::NAN, f64::INFINITY] {
        for index in 0..3 {
            let mut matrices = [identity(2), identity(2), identity(2)];
            matrices[index][0][1] = bad;
            let [mass, damping, stiffness] = matrices;
            assert!(solve(&linear(mass, damping, stiffness)).is_err());
        }
    }
    assert_eq!(solve(&linear(zeros(0), zeros(0), zeros(0))), Ok(Vec::new()));
}

/// A chain of equal masses and springs: `omega = 2 sin(pi r / (2 (n + 1)))`.
#[test]
fn twelve_coordinates() {
    const N: usize = 12;
    let mut stiffness = diagonal(&[2.0; N]);
    for i in 1..N {
        stiffness[i][i - 1] = -1.0;
        stiffness[i - 1][i] = -1.0;
    }
    let pencil = linear(identity(N), zeros(N), stiffness);
    let roots = solve(&pencil).unwrap();
    check(&pencil, &roots).unwrap();
    for (r, root) in roots.iter().enumerate() {
        let angle = core::f64::consts::PI * (r + 1) as f64 / (2.0 * (N + 1) as f64);
        let expected = Complex64::new(0.0, 2.0 * angle.sin());
        assert!((root.s - expected).norm() <= root.error, "{root:?}");
        assert!(root.error < 1e-13);
    }
}

#[test]
fn the_same_bits_every_time() {
    let pencil = linear(
        identity(3),
        [[0.0, 1.0, 0.0], [-1.0, 0.0, 2.0], [0.0, -2.0, 0.0]],
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    );
    let once = solve(&pencil).unwrap();
    assert_eq!(once, solve(&pencil).unwrap());
}
