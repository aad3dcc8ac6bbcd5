//! Directional derivatives of equal eigenvalues against closed forms, and what reports say about single-mode
//! derivatives.

use eigentol::{DampingKind, Description, Error, Family, Real, Study, Violation, mechanism};

use super::within;
use crate::common::derived::{Derived, Model};
use crate::common::models::{Follower, Pair};
use crate::common::{METRE, NUMBER, STIFFNESS, coordinate, description, design, sizes};

mechanism! {
    /// A disc in a bearing as stiff in `x` as in `y`, with a strut at an angle that is not there yet.
    mechanism SquareShaft {
        design k  = 400 N/m +/- 4 N/m;
        design kx = 0 N/m +/- 1 N/m;
        design kn = 0 N/m +/- 1 N/m;
        body slide: massless;
        body disc: sphere(mass: 4 kg, radius: 0.1 m);
        joint x: prismatic(x) from ground to slide;
        joint y: prismatic(y) from slide to disc;
        force bx: spring(on: x, stiffness: k + kx);
        force by: spring(on: y, stiffness: k);
        point far: ground at [3e6 m, 4e6 m, 0];
        point hub: disc;
        force strut: spring_damper(from: hub, to: far, stiffness: kn, length: 5e6 m);
    }
}

/// Two equal unit masses with stiffness 100 and damping 2. `c` and `f` are the stiffnesses through which the second
/// acts on the first and the first on the second; `d` damps only the first.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Twins;

impl Model for Twins {
    sizes!(2, 0, 3, 0);

    const DESCRIPTION: Description = description!(
        "Twins",
        &[coordinate("x", METRE), coordinate("y", METRE)],
        &[],
        &[design("c", STIFFNESS, 0.0, 1.0), design("f", STIFFNESS, 0.0, 1.0), design("d", NUMBER, 0.0, 0.0),],
        false,
        DampingKind::General
    );

    fn inertia<T: Real>(&self, a: &[T; 2], _: &[T; 2], _: &[T; 2], _: &[T; 0], _: &[T; 3]) -> [T; 2] {
        *a
    }

    fn applied<T: Real>(&self, v: &[T; 2], q: &[T; 2], _: &[T; 0], b: &[T; 3]) -> [T; 2] {
        let (two, hundred) = (T::constant(2.0), T::constant(100.0));
        [-(hundred * q[0] + b[0] * q[1] + (two + b[2]) * v[0]), -(b[1] * q[0] + hundred * q[1] + two * v[1])]
    }

    fn violation<T: Real + PartialOrd>(&self, _: &[T; 0], _: &[T; 3]) -> Option<Violation<T>> {
        None
    }
}

/// `d(K - lambda M)` is `dkx e_x e_x^T + dkn n n^T + dk` in a plane without preferred directions, `n = (0.6, 0.8)`.
#[test]
fn a_square_shaft_splits_as_the_direction_says() {
    let study = Study::new(SquareShaft);
    for (dk, dkx, dkn) in
        [(1.0_f64, 0.0_f64, 0.0_f64), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.0, 1.0, -1.0), (2.0, -0.5, 3.0)]
    {
        let (a, b, d) = (dkx + 0.36 * dkn, 0.48 * dkn, 0.64 * dkn);
        let root = (0.5 * (a - d)).hypot(b);
        let expected = [-root, root].map(|root| (dk + 0.5 * (a + d) + root) / 4.0);
        let found = study.directional_derivatives(1, (&[], &[dk, dkx, dkn])).unwrap();
        assert_eq!((found.modes.as_slice(), found.family), (&[0, 1][..], Family::Undamped));
        for (slope, expected) in found.eigenvalues.iter().zip(expected) {
            within(slope.re, expected, 1e-9);
            assert_eq!(slope.im, 0.0);
        }
        // omega = 10 rad/s.
        for (slope, expected) in found.frequencies.unwrap().iter().zip(expected) {
            within(*slope, expected / 20.0, 1e-10);
        }
    }
}

/// Single-mode derivatives are all arbitrary, either half the trace or dependent on the basis; none is printed.
#[test]
fn numbers_of_a_cluster_are_not_printed_as_ordinary_ones() {
    let study = Study::new(SquareShaft);
    let slopes = study.sensitivities().unwrap();
    assert!(slopes.modes.iter().all(|mode| mode.clustered));
    let first = study.first_order().unwrap();
    assert!(first.modes.iter().all(|mode| mode.clustered));
    for (text, columns) in [(slopes.to_string(), 2), (first.to_string(), 3)] {
        let rows: Vec<_> = text.lines().filter(|line| line.contains("cluster")).collect();
        let cells = rows.iter().map(|row| row.matches("  cluster").count());
        assert!(cells.clone().all(|count| count == columns || count == 0), "{text}");
        assert!(cells.sum::<usize>() >= 2 * columns, "{text}");
    }
    let found = study.modes().unwrap();
    assert_eq!(found.cluster_of(0), [0, 1]);
    assert!(found.cluster_of(2).is_empty());
    // Separated, they are ordinary modes again.
    let apart = study.design(SquareShaft::kx, 40.0);
    assert_eq!(apart.modes().unwrap().cluster_of(1), [1]);
    assert!(!apart.sensitivities().unwrap().to_string().contains("cluster"));
    let alone = apart.directional_derivatives(1, (&[], &[0.0, 1.0, 0.0])).unwrap();
    let slope = apart.sensitivities().unwrap().modes[1].lambda.by_design[1];
    assert_eq!(alone.modes, [1]);
    within(alone.eigenvalues[0].re, slope, 1e-12);
    within(slope, 0.25, 1e-12);
}

/// `s^2 + 2 s + 100 = 0` twice: `ds = -mu / (2 s + 2)`, with `mu` the eigenvalues of `[[s dd, dc], [df, 0]]`.
#[test]
fn damped_twins_split_as_the_direction_says() {
    let study = Study::new(Derived(Twins));
    let s = eigentol::Complex::new(-1.0, 99.0_f64.sqrt());
    for (dc, df, dd) in [(1.0, 1.0, 0.0), (1.0, -1.0, 0.0), (0.0, 0.0, 1.0), (2.0, 0.5, -0.3)] {
        let half = 0.5 * dd * s;
        let root = (half * half + dc * df).sqrt();
        let mut expected = [half - root, half + root].map(|mu| -mu / (2.0 * s + 2.0));
        expected.sort_by(|a, b| (a.re, a.im).partial_cmp(&(b.re, b.im)).unwrap());
        let found = study.directional_derivatives(0, (&[], &[dc, df, dd])).unwrap();
        assert_eq!((found.modes.as_slice(), found.family), (&[0, 1][..], Family::General));
        let apart = |order: [usize; 2]| {
            let pairs = order.into_iter().zip(expected);
            pairs.map(|(i, value)| (found.eigenvalues[i] - value).norm()).fold(0.0, f64::max)
        };
        // With equal real parts their order depends on rounding.
        assert!(apart([0, 1]).min(apart([1, 0])) < 1e-12, "{found:?} {expected:?}");
        let mut frequencies = expected.map(|ds| ds.im);
        frequencies.sort_by(f64::total_cmp);
        for (slope, expected) in found.frequencies.unwrap().iter().zip(frequencies) {
            within(*slope, expected, 1e-12);
        }
    }
}

#[test]
fn the_general_family_agrees_with_the_undamped_one() {
    let study = Study::new(Derived(Pair));
    let direction = [0.3, -0.1, 1.0];
    let both = [Family::Undamped, Family::General].map(|family| {
        let study = study.clone().family(family);
        let found = study.directional_derivatives(0, (&[], &direction)).unwrap();
        found.frequencies.unwrap()
    });
    let root = 0.2_f64.hypot(1.0);
    for (k, expected) in [0.1 - root, 0.1 + root].into_iter().enumerate() {
        within(both[0][k], expected / 20.0, 1e-13);
        within(both[1][k], expected / 20.0, 1e-13);
    }
}

#[test]
fn what_has_merged_has_no_derivative_along_any_direction() {
    // Ziegler's column where its two frequencies merge.
    let study = Study::new(Derived(Follower)).input(eigentol::Input::new(0), 0.5 * (7.0 - 8.0_f64.sqrt()));
    let found = study.directional_derivatives(0, (&[0.0], &[1.0]));
    assert!(matches!(found, Err(Error::Defective { .. })), "{found:?}");
    let none = Study::new(Derived(Pair)).directional_derivatives(2, (&[], &[0.0; 3]));
    assert_eq!(none, Err(Error::NoSuchMode { mode: 2, count: 2 }));
}
