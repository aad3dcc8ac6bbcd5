//! Monte Carlo in vectors against the solvers for one state: the same outcome for every sample, the same numbers up to
//! rounding, the same bits with every instruction set and any number of threads.

use eigentol::equilibrium::{Branch, equilibrium};
use eigentol::kernels::{BatchKernels, Kernels};
use eigentol::modes::{Family, modes};
use eigentol::scalar::Instructions;
use eigentol::tolerance::{Counts, Outcome, Sampling, monte_carlo};
use eigentol::{MonteCarlo, Policy, Stability, Tolerances, Vector, mechanism};

mechanism! {
    mechanism Pendulum {
        input omega: rad/s;
        design m = 3.0 kg;
        design l = 1.0 m +/- 3%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
    }
}

mechanism! {
    mechanism Double {
        input omega: rad/s;
        design m1 = 3.0 kg +/- 2%;
        design m2 = 3.0 kg;
        design l1 = 1.0 m +/- 3%;
        design l2 = 1.0 m +/- 3%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar1: rod(mass: m1, length: l1, along: -z);
        body bar2: rod(mass: m2, length: l2, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -l1];
    }
}

mechanism! {
    /// Three coordinates of different kinds, five variables.
    mechanism Triple {
        input omega: rad/s;
        design m1 = 3.0 kg +/- 2%;
        design m2 = 2.0 kg +/- 2%;
        design l1 = 1.0 m +/- 2%;
        design l2 = 0.7 m +/- 2%;
        design k = 400.0 N/m +/- 5%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar1: rod(mass: m1, length: l1, along: -z);
        body bar2: rod(mass: m2, length: l2, along: -z);
        body slider: point(mass: 0.5 kg);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -l1];
        joint x: prismatic(z) from bar2 to slider at [0, 0, -l2 / 2];
        force spring: spring(on: x, stiffness: k);
    }
}

fn nominal(m: &dyn Kernels) -> Vector {
    let description = m.description();
    description.design.iter().map(|info| info.nominal).collect()
}

fn compare(m: &dyn BatchKernels, omega: f64, start: &[f64], tolerances: &Tolerances) -> (Counts, bool) {
    compare_at(m, (omega, &nominal(m)), start, tolerances)
}

/// Runs every instruction set, compares with single samples, and returns the outcomes and whether any sample was solved
/// in vectors, as rounding reveals.
fn compare_at(
    m: &dyn BatchKernels,
    (omega, b): (f64, &[f64]),
    start: &[f64],
    tolerances: &Tolerances,
) -> (Counts, bool) {
    let state = equilibrium(m, &[omega], b, start, Policy::Stable).expect("an equilibrium");
    let found = modes(&state).expect("modes");
    let run = |vectors, threads| -> MonteCarlo {
        let sampling = Sampling::default().samples(1003).seed(42).threads(threads).vectors(vectors).keep_samples(true);
        monte_carlo(m, &state, &found, tolerances, &sampling).expect("a run")
    };
    let alone = run(None, 1);
    let first = run(Some(Instructions::SCALAR), 1);
    for set in Instructions::available() {
        for threads in [1, 2] {
            assert!(run(Some(set), threads) == first, "{set:?}, {threads} threads");
        }
    }
    // The result reports which it was, and so does the text unless it was one by one.
    let said = |run: &MonteCarlo| run.to_string().contains("side by side in vectors");
    assert!(!alone.side_by_side && !said(&alone));
    assert_eq!(first.side_by_side, said(&first));
    assert!(first.side_by_side || first.modes == alone.modes);
    assert_eq!(first.counts, alone.counts);
    assert_eq!(first.counts.total(), 1003);
    assert_eq!(first.left_nominal_branch, alone.left_nominal_branch);
    let near = |a: f64, b: f64, scale: f64| assert!((a - b).abs() <= 1e-11 * scale, "{a} {b}");
    let (Some(own), Some(other)) = (&first.all, &alone.all) else { panic!("samples were asked for") };
    let branch = Branch::of(m, &state);
    let stable = other.iter().filter(|x| x.outcome == Outcome::Stable);
    let left = stable.filter(|stable| {
        let q = stable.coordinates.as_ref().expect("an equilibrium");
        !branch.holds(&stable.design, q)
    });
    assert_eq!(left.count(), alone.left_nominal_branch);
    assert_eq!(own.len(), other.len());
    for (own, other) in own.iter().zip(other) {
        assert_eq!(own.design, other.design);
        assert_eq!(own.outcome, other.outcome);
        assert_eq!(own.coordinates.is_some(), other.coordinates.is_some());
        for (a, b) in own.coordinates.iter().zip(&other.coordinates) {
            a.iter().zip(b).for_each(|(a, b)| near(*a, *b, 1.0));
        }
        assert_eq!(own.damping_ratios.len(), other.damping_ratios.len());
        for (a, b) in own.damping_ratios.iter().zip(&other.damping_ratios) {
            assert_eq!(a.is_some(), b.is_some());
            near(a.unwrap_or(0.0), b.unwrap_or(0.0), 1.0);
        }
        assert_eq!(own.frequencies.len(), other.frequencies.len());
        for (a, b) in own.frequencies.iter().zip(&other.frequencies) {
            assert_eq!(a.is_some(), b.is_some());
            let (a, b) = (a.unwrap_or(1.0), b.unwrap_or(1.0));
            // A frequency near zero is the square root of a difference.
            near(a * a, b * b, b * b + 1.0);
        }
        for (a, b) in own.eigenvalues.iter().zip(&other.eigenvalues) {
            assert_eq!(a.is_some(), b.is_some());
            if let (Some(a), Some(b), Family::General) = (a, b, found.family) {
                near(a.re, b.re, b.norm());
                near(a.im, b.im, b.norm());
            }
        }
    }
    for (own, other) in [(&first.modes, &alone.modes), (&first.damping_ratios, &alone.damping_ratios)] {
        assert_eq!(own.len(), other.len());
        for (own, other) in own.iter().zip(other.iter()) {
            let (Some(own), Some(other)) = (own, other) else {
                assert_eq!(own, other);
                continue;
            };
            assert_eq!(own.count, other.count);
            for (a, b) in [(own.mean, other.mean), (own.min, other.min), (own.max, other.max)] {
                near(a, b, b.abs() + 0.1);
            }
            near(own.sigma.expect("several"), other.sigma.expect("several"), other.mean.abs() + 0.1);
        }
    }
    (first.counts, first.modes != alone.modes)
}

fn declared(m: &dyn Kernels) -> Tolerances {
    Tolerances::declared(&m.description()).expect("declared")
}

#[test]
fn chains_of_one_two_and_three() {
    let one = compare(&Pendulum, 5.0, &[1.0], &declared(&Pendulum));
    let two = compare(&Double, 6.0, &[1.0, 0.1], &declared(&Double));
    let three = compare(&Triple, 6.0, &[1.0, 0.1, 0.0], &declared(&Triple));
    for (counts, in_vectors) in [one, two, three] {
        assert!(counts.stable == 1003 && in_vectors);
    }
    // At rest the equilibrium does not move.
    let hanging = compare(&Double, 0.0, &[0.0; 2], &declared(&Double));
    assert!(hanging.0.stable == 1003 && hanging.1);
}

mechanism! {
    /// Damped, with a potential: oscillating modes and, with a great damper, real ones.
    mechanism Damped {
        input omega: rad/s;
        design m1 = 3.0 kg +/- 2%;
        design l1 = 1.0 m +/- 2%;
        design l2 = 0.7 m +/- 2%;
        design c = 0.8 N*m*s +/- 20%;
        design k = 400.0 N/m +/- 5%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar1: rod(mass: m1, length: l1, along: -z);
        body bar2: rod(mass: 2 kg, length: l2, along: -z);
        body slider: point(mass: 0.5 kg);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(x) from bar1 to bar2 at [0, 0, -l1];
        joint x: prismatic(z) from bar2 to slider at [0, 0, -l2 / 2];
        force spring: spring(on: x, stiffness: k);
        force pin1: damper(on: theta1, damping: c);
        force pin2: damper(on: theta2, damping: 0.3 N*m*s);
        force slide: damper(on: x, damping: 2 N*s/m);
    }
}

mechanism! {
    /// A gyroscope on springs: its modes keep their amplitudes.
    mechanism Gyroscope {
        input omega: rad/s;
        design radius = 0.2 m +/- 1%;
        design k1 = 900.0 N*m/rad +/- 5%;
        design k2 = 1300.0 N*m/rad +/- 5%;
        body ring: massless;
        body cradle: massless;
        body disk: cylinder(density: 7850 kg/m^3, radius: radius, length: 30 mm, axis: z);
        joint alpha: revolute(x) from ground to ring;
        joint beta: revolute(y) from ring to cradle;
        joint spin: revolute(z) from cradle to disk, driven at omega;
        force s1: spring(on: alpha, stiffness: k1);
        force s2: spring(on: beta, stiffness: k2);
    }
}

mechanism! {
    /// Forces without a potential: a disk on a shaft whose material damps, in a seal. It sags.
    pub(crate) mechanism Rotor {
        input omega: rad/s;
        design mass = 12.0 kg +/- 1%;
        design k = 200.0 kN/m +/- 4%;
        design lag = 50 us +/- 20%;
        design seal = 5.0 N*s/m +/- 20%;
        gravity 9.81 m/s^2 along -y;
        body line: massless;
        body across: massless;
        body disk: point(mass: mass);
        joint turn: revolute(z) from ground to line, driven at omega;
        joint x: prismatic(x) from ground to across;
        joint y: prismatic(y) from across to disk;
        point hub: line at [0, 0, 0];
        point rim: disk at [0, 0, 0];
        force shaft: bushing(from: hub, to: rim, stiffness: [k, k, 0], damping: [lag * k, lag * k, 0]);
        force up: spring(on: y, stiffness: 10 kN/m);
        force seal_x: damper(on: x, damping: seal);
        force seal_y: damper(on: y, damping: seal);
    }
}

#[test]
fn damped_modes() {
    // At rest, and on a branch that turns: three of each.
    for omega in [0.0, 5.0] {
        let (counts, in_vectors) = compare(&Damped, omega, &[0.8, 0.1, 0.0], &declared(&Damped));
        assert!(counts.stable == 1003 && in_vectors, "{omega}: {counts:?}");
    }
    // Wide tolerances: negative dampers, impossible bodies, modes that stop oscillating.
    let wide = Tolerances::new([0.9, 0.1, 0.1, 0.8, 100.0], 3.0, None).expect("valid");
    let (counts, in_vectors) = compare(&Damped, 0.0, &[0.1, 0.1, 0.0], &wide);
    assert!(counts.stable > 900 && in_vectors, "{counts:?}");
}

/// Where two real eigenvalues meet and begin to oscillate, and on both sides of it.
#[test]
fn modes_that_stop_oscillating() {
    let mut oscillating = 0;
    for c in [1.0, 20.0, 36.0, 38.0, 40.0, 80.0] {
        let tolerances = Tolerances::new([0.03, 0.01, 0.01, 0.05 * c, 1.0], 3.0, None).expect("valid");
        let m = &Damped;
        let mut b = nominal(m);
        b[3] = c;
        let (counts, _) = compare_at(m, (0.0, &b), &[0.0; 3], &tolerances);
        assert_eq!(counts.stable, 1003, "{c}");
        let state = equilibrium(m, &[0.0], &b, &[0.0; 3], Policy::Stable).expect("an equilibrium");
        let found = modes(&state).expect("modes");
        oscillating += found.frequencies().iter().flatten().count();
    }
    assert!(oscillating < 18, "all of them oscillate");
}

#[test]
fn gyroscopic_modes() {
    for omega in [10.0, 150.0, 900.0] {
        let (counts, in_vectors) = compare(&Gyroscope, omega, &[0.0; 2], &declared(&Gyroscope));
        assert!(counts.stable == 1003 && in_vectors, "{omega}: {counts:?}");
    }
}

/// Below, at and beyond the speed at which material damping of the shaft makes the rotor whirl.
#[test]
fn forces_without_a_potential() {
    let mut unstable = 0;
    for omega in [0.0, 150.0, 300.0, 450.0, 520.0, 540.0, 560.0, 700.0] {
        let state = equilibrium(&Rotor, &[omega], &nominal(&Rotor), &[0.0; 2], Policy::Nearest);
        let stable = state.expect("an equilibrium").stability == Stability::Stable;
        if !stable {
            unstable += 1;
            continue;
        }
        let (counts, in_vectors) = compare(&Rotor, omega, &[0.0; 2], &declared(&Rotor));
        assert!(counts.stable > 300 && in_vectors, "{omega}: {counts:?}");
        let wide = Tolerances::new([3.0, 6e4, 4e-5, 4.0], 3.0, None).expect("valid");
        compare(&Rotor, omega, &[0.0; 2], &wide);
    }
    assert!((1..4).contains(&unstable), "{unstable}");
}

/// Wide tolerances: impossible bodies, negative springs, equilibria on another branch.
#[test]
fn samples_that_fail_are_what_they_are_alone() {
    let wide = Tolerances::new([3.0, 0.0, 0.6, 0.9], 2.0, None).expect("valid");
    let (counts, _) = compare(&Double, 6.0, &[1.0, 0.1], &wide);
    assert!(counts.unphysical > 30 && counts.stable > 500, "{counts:?}");
    let correlation = [
        [1.0, 0.5, 0.2, 0.0, -0.3],
        [0.5, 1.0, 0.0, 0.1, 0.0],
        [0.2, 0.0, 1.0, 0.9, 0.0],
        [0.0, 0.1, 0.9, 1.0, 0.0],
        [-0.3, 0.0, 0.0, 0.0, 1.0],
    ];
    let wide = Tolerances::new([0.6, 0.4, 0.2, 0.2, 390.0], 3.0, Some(correlation.into())).expect("valid");
    let (counts, _) = compare(&Triple, 6.0, &[1.0, 0.1, 0.0], &wide);
    assert!(counts.stable > 900, "{counts:?}");
}

/// Near the speed at which the pendulum leaves the vertical: some samples hang, some have left it.
#[test]
fn near_a_critical_state() {
    let critical = (1.5_f64 * 9.81).sqrt();
    for factor in [0.97, 0.9999, 1.0001, 1.03] {
        for width in [0.001, 0.05] {
            let tolerances = Tolerances::new([0.0, width], 3.0, None).expect("valid");
            let (counts, _) = compare(&Pendulum, factor * critical, &[0.3], &tolerances);
            assert_eq!(counts.stable, 1003, "{factor} {width}");
        }
    }
}
