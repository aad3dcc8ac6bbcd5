//! The whirl sense of vibrations, in cases where it is obvious.

use eigentol::{Mechanism, mechanism};

mechanism! {
    /// A disk that slides across its axis and is spun after that.
    pub mechanism Sliding {
        input speed: rad/s;
        design m = 2 kg;
        body across: massless;
        body carrier: massless;
        body wheel: disk(mass: m, radius: 0.3 m, axis: z);
        joint x: prismatic(x) from ground to across;
        joint y: prismatic(y) from across to carrier;
        joint spin: revolute(z) from carrier to wheel, driven at speed;
        force hold_x: spring(on: x, stiffness: 1 kN/m);
        force hold_y: spring(on: y, stiffness: 1 kN/m);
    }
}

mechanism! {
    /// A disk that only tilts, about its centre or about a point below it.
    pub mechanism Tilting {
        input speed: rad/s;
        design m = 2 kg;
        design r = 0.3 m;
        design height = 0.2 m;
        body outer: massless;
        body inner: massless;
        body wheel: disk(mass: m, radius: r, axis: z, center: [0, 0, height]);
        joint alpha: revolute(x) from ground to outer;
        joint beta: revolute(y) from outer to inner;
        joint spin: revolute(z) from inner to wheel, driven at speed;
        force hold_alpha: spring(on: alpha, stiffness: 40 N*m/rad);
        force hold_beta: spring(on: beta, stiffness: 40 N*m/rad);
    }
}

mechanism! {
    /// Two disks, one above the other in one bearing, driven in opposite senses, and a heavy frame that does not turn.
    pub mechanism Pair {
        input speed: rad/s;
        body across: box(mass: 5 kg, size: [1, 1, 1] m);
        body frame: massless;
        body lower: disk(mass: 2 kg, radius: 0.3 m, axis: z);
        body upper: point(mass: 1 kg, center: [0, 0, 0.5 m]) + sphere(mass: 0.5 kg, radius: 0.2 m, center: [0, 0, 0.5 m]);
        joint x: prismatic(x) from ground to across;
        joint y: prismatic(y) from across to frame;
        joint spin: revolute(z) from frame to lower, driven at speed;
        joint counter: revolute(z) from frame to upper, driven at -3 * speed;
        force hold_x: spring(on: x, stiffness: 1 kN/m);
        force hold_y: spring(on: y, stiffness: 1 kN/m);
    }
}

mechanism! {
    /// A drive that only slides, and an arm that only swings.
    pub mechanism Lift {
        input speed: m/s;
        gravity 9.81 m/s^2 along -z;
        body cabin: box(mass: 5 kg, size: [1, 1, 1] m);
        body arm: rod(mass: 3 kg, length: 1 m, along: -z);
        joint rise: prismatic(z) from ground to cabin, driven at speed;
        joint swing: universal(a: x, b: y) from cabin to arm;
    }
}

/// Real and imaginary parts.
type Vibration = ([f64; 2], [f64; 2]);

/// `(1, -i)`: `(cos w t, sin w t)`, counterclockwise.
const COUNTERCLOCKWISE: Vibration = ([1.0, 0.0], [0.0, -1.0]);
/// `(1, i)`.
const CLOCKWISE: Vibration = ([1.0, 0.0], [0.0, 1.0]);
/// `(1, 1)`.
const STRAIGHT: Vibration = ([1.0, 1.0], [0.0, 0.0]);
/// `(2, -i)`: an ellipse of half-axes 2 and 1.
const ELLIPSE: Vibration = ([2.0, 0.0], [0.0, -1.0]);

fn whirl(machine: &dyn eigentol::Kernels, speed: f64, (real, imaginary): Vibration) -> [f64; 7] {
    let description = machine.description();
    let b: Vec<f64> = description.design.iter().map(|info| info.nominal).collect();
    machine.whirl(&[0.0; 2], &[speed], &b, &real, &imaginary)
}

/// Moment and lateral sum; nothing turns about its axis or moves along it, or lies beside it.
#[track_caller]
fn assert_close(values: [f64; 7], expected: [f64; 2]) {
    let expected = [expected[0], expected[1], 0.0, 0.0, 0.0];
    for (one, other) in values.iter().zip(expected) {
        assert!((one - other).abs() <= 1e-14 * expected[1].abs(), "{values:?}, not {expected:?}");
    }
}

#[test]
fn a_sliding_disk_circles_with_or_against_its_spin() {
    for speed in [20.0, -7.0] {
        let square = 2.0 * speed * speed;
        let sense = f64::signum(speed);
        let found = |vibration| whirl(&Sliding, speed, vibration);
        assert_close(found(COUNTERCLOCKWISE), [sense * square, square]);
        assert_close(found(CLOCKWISE), [-sense * square, square]);
        assert_close(found(STRAIGHT), [0.0, square]);
        assert_close(found(ELLIPSE), [2.0 * sense * square, 2.5 * square]);
    }
}

/// A later phase gives the same vibration: `(1, -i) e^{i p}`.
#[test]
fn the_phase_does_not_matter() {
    let (sin, cos) = f64::sin_cos(0.7);
    let turned = ([cos, sin], [sin, -cos]);
    assert_close(whirl(&Sliding, 5.0, turned), [50.0, 50.0]);
}

fn tilting(speed: f64, b: [f64; 3], (real, imaginary): Vibration) -> [f64; 7] {
    Tilting.whirl(&[0.0; 2], &[speed], &b, &real, &imaginary)
}

/// The integral of `rho^2` over a disk is `m r^2 / 2`; a tilt about a point at distance `h` adds `m h^2`.
#[test]
fn a_tilting_disk_circles_too() {
    for height in [0.0, 0.2] {
        for speed in [300.0, -100.0] {
            let b = [2.0, 0.3, height];
            let size = speed * speed * 2.0 * (0.3 * 0.3 / 2.0 + height * height);
            let sense = f64::signum(speed);
            let found = |vibration| tilting(speed, b, vibration);
            assert_close(found(COUNTERCLOCKWISE), [sense * size, size]);
            assert_close(found(CLOCKWISE), [-sense * size, size]);
            assert_close(found(STRAIGHT), [0.0, size]);
        }
    }
}

/// The gyroscopic moment stiffens forward whirl and softens backward whirl: `A w^2 -+ C Omega w - k = 0` with
/// `C = m r^2 / 2`, `A = C / 2`. The mode comes from the generated matrices.
#[test]
fn forward_whirl_of_a_gyroscope_is_the_fast_one() {
    let (b, axial, stiffness) = ([2.0, 0.3, 0.0], 0.09, 40.0);
    for speed in [30.0, -30.0] {
        let linear = Tilting.linear(&[0.0; 2], &[speed], &b);
        let slow_and_fast = [-1.0, 1.0].map(|sign| {
            let half = sign * axial * f64::abs(speed) / 2.0;
            (half + (half * half + axial / 2.0 * stiffness).sqrt()) / (axial / 2.0)
        });
        assert!(slow_and_fast[0] < slow_and_fast[1]);
        for (w, sense) in slow_and_fast.into_iter().zip([-1.0, 1.0]) {
            let residual = |(real, imaginary): Vibration| -> f64 {
                // (K - w^2 M) x - w C y and (K - w^2 M) y + w C x.
                let entry = |i: usize, j: usize, x: [f64; 2], y: [f64; 2], sign: f64| {
                    (linear.stiffness[i][j] - w * w * linear.mass[i][j]) * x[j] + sign * w * linear.damping[i][j] * y[j]
                };
                let row = |i: usize| {
                    let sum = |x, y, sign| entry(i, 0, x, y, sign) + entry(i, 1, x, y, sign);
                    let parts = [sum(real, imaginary, -1.0), sum(imaginary, real, 1.0)];
                    parts[0].hypot(parts[1])
                };
                row(0).max(row(1))
            };
            let modes = [COUNTERCLOCKWISE, CLOCKWISE];
            let mode = modes.into_iter().find(|&mode| residual(mode) < 1e-10);
            let [moment, size, ..] = tilting(speed, b, mode.expect("a circle"));
            assert!((moment - sense * size).abs() < 1e-12 * size, "{speed} {w}");
        }
    }
}

/// Every body is weighted by its mass and the square of its own speed; the non-rotating frame has no weight.
#[test]
fn contrarotating_disks_weigh_against_each_other() {
    let (lower, upper) = (2.0 * 16.0, 1.5 * 144.0);
    let values = whirl(&Pair, 4.0, COUNTERCLOCKWISE);
    assert_close(values, [lower - upper, lower + upper]);
    assert_close(whirl(&Pair, 4.0, STRAIGHT), [0.0, lower + upper]);
}

#[test]
fn at_rest_there_is_no_sense() {
    assert_eq!(whirl(&Sliding, 0.0, COUNTERCLOCKWISE)[..6], [0.0; 6]);
    assert_eq!(whirl(&Tilting, 0.0, COUNTERCLOCKWISE)[..6], [0.0; 6]);
}

#[test]
fn where_no_body_turns_there_is_no_kernel() {
    let named = |info: &&eigentol::KernelInfo| info.name == "whirl";
    assert_eq!(Lift::DESCRIPTION.kernels.iter().find(named), None);
    assert!(Pair::DESCRIPTION.kernels.iter().any(|info| named(&info)));
    assert_eq!(whirl(&Lift, 2.0, COUNTERCLOCKWISE), [0.0; 7]);
}
