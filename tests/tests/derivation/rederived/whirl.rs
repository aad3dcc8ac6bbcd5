//! Rotors, a top and a rotating pendulum: eigenvalues and their derivatives in closed form.
//!
//! Each is isotropic: with `z = x + i y` the two real equations become one complex equation `a z'' + b z' + d z = 0`;
//! its roots and their conjugates are the eigenvalues.

use eigentol_tests::machines::{jeffcott_rotor, overhung_rotor, sleeping_top, spherical_pendulum};
use eigentol_tests::rederived::{GeneralMode, Machine, State};
use nalgebra::Complex;

use super::common::{assert_close, largest};

type C = Complex<f64>;

/// `a s^2 + b s + d`, and the derivatives of `a`, `b`, `d` by each variable.
struct Equation {
    coefficients: [C; 3],
    derivatives: Vec<[C; 3]>,
}

fn real(x: f64) -> C {
    C::from(x)
}

fn imaginary(y: f64) -> C {
    C::new(0.0, y)
}

impl Equation {
    /// Both roots, each mapped to the upper half-plane, with their derivatives.
    fn roots(&self) -> Vec<(C, Vec<C>)> {
        let [a, b, d] = self.coefficients;
        let root = (b * b - a * d * 4.0).sqrt();
        let mut all: Vec<(C, Vec<C>)> = [root, -root]
            .into_iter()
            .map(|root| {
                let s = (root - b) / (a * 2.0);
                let slope = a * s * 2.0 + b;
                let rate = |[da, db, dd]: &[C; 3]| -(da * s * s + db * s + dd) / slope;
                (s, self.derivatives.iter().map(rate).collect())
            })
            .map(|(s, rates): (C, Vec<C>)| match s.im < 0.0 {
                true => (s.conj(), rates.iter().map(C::conj).collect()),
                false => (s, rates),
            })
            .collect();
        all.sort_by(|(one, _), (other, _)| one.norm().total_cmp(&other.norm()));
        all
    }
}

fn modes(state: &State) -> Vec<GeneralMode> {
    let modes = state.general_modes().into_iter();
    modes.map(|mode| mode.expect("a simple mode")).collect()
}

/// Eigenvalues and first derivatives.
#[track_caller]
fn check(state: &State, equation: &Equation, what: &str) {
    let modes = modes(state);
    let roots = equation.roots();
    assert_eq!(modes.len(), roots.len(), "{what}");
    for (mode, (s, rates)) in modes.iter().zip(roots) {
        let found = [mode.s.re.value, mode.s.im.value];
        assert_close(&found, &[s.re, s.im], s.norm(), what);
        for (k, rate) in rates.iter().enumerate() {
            let found = [mode.s.re.gradient[k], mode.s.im.gradient[k]];
            let what = format!("{what}, {s} by variable {k}");
            assert_close(&found, &[rate.re, rate.im], largest(&found), &what);
        }
    }
}

/// Both shapes are normalised: `y = +-i x` for every pair of an isotropic machine.
fn assert_circular(mode: &GeneralMode) {
    let [x, y] = &mode.right[..] else { panic!("two coordinates") };
    let (x, y) = (C::new(x.re.value, x.im.value), C::new(y.re.value, y.im.value));
    assert!((y * y + x * x).norm() < 1e-9 * x.norm_sqr(), "{x} {y}");
    assert_eq!(mode.leads, [0, 0]);
}

#[test]
fn a_rotor_with_damping_that_turns() {
    let machine = Machine::new(jeffcott_rotor::DECLARATION);
    let b = machine.nominal().to_vec();
    let [m, k, external, internal] = b[..] else { panic!("four variables") };
    let onset = (k / m).sqrt() * (1.0 + external / internal);
    for speed in [0.0, 0.3 * onset, 0.999 * onset, onset, 1.001 * onset, 3.0 * onset] {
        let state = machine.at(&[speed], &b, &[0.0; 2]);
        // z0 = -i m g / (k - i W c_i).
        let stiffness = C::new(k, -speed * internal);
        let shift = -imaginary(m * 9.81) / stiffness;
        let values: Vec<f64> = state.equilibrium().iter().map(|q| q.value).collect();
        assert_close(&values, &[shift.re, shift.im], 1e-3, "the sag");
        let zero = real(0.0);
        let equation = Equation {
            coefficients: [real(m), real(external + internal), stiffness],
            derivatives: vec![
                [real(1.0), zero, zero],
                [zero, zero, real(1.0)],
                [zero, real(1.0), zero],
                [zero, real(1.0), imaginary(-speed)],
                [zero, zero, imaginary(-internal)],
            ],
        };
        if speed == 0.0 {
            // A double pair has no mode of its own.
            assert_eq!(state.general_modes(), [None, None]);
            let s = equation.roots()[0].0;
            for complex in state.eigenvalues() {
                assert!((complex - s).norm() < 1e-6 * s.norm(), "{complex} {s}");
            }
            continue;
        }
        check(&state, &equation, &format!("{speed} rad/s"));
        let modes = modes(&state);
        modes.iter().for_each(assert_circular);
        let growing = modes.iter().filter(|mode| mode.s.re.value > 1e-9);
        assert_eq!(growing.count(), usize::from(speed > onset));
        if speed == onset {
            let forward = modes.iter().find(|mode| mode.s.re.value.abs() < 1e-9);
            let frequency = forward.expect("neither growing nor decaying").s.im.value;
            assert_close(&[frequency], &[(k / m).sqrt()], 0.0, "at the onset");
        }
    }
}

#[test]
fn conical_whirl() {
    let machine = Machine::new(overhung_rotor::DECLARATION);
    let b = machine.nominal().to_vec();
    let [it, ip, k] = b[..] else { panic!("three variables") };
    let synchronous = (k / (it - ip)).sqrt();
    for speed in [20.0, synchronous, 500.0] {
        let state = machine.at(&[speed], &b, &[0.0; 2]);
        let zero = real(0.0);
        let equation = Equation {
            coefficients: [real(it), imaginary(-speed * ip), real(k)],
            derivatives: vec![
                [real(1.0), zero, zero],
                [zero, imaginary(-speed), zero],
                [zero, zero, real(1.0)],
                [zero, imaginary(-ip), zero],
            ],
        };
        check(&state, &equation, &format!("{speed} rad/s"));
        let half = 0.5 * speed * ip / it;
        let root = (half * half + k / it).sqrt();
        let modes = modes(&state);
        let found = [modes[0].s.im.value, modes[1].s.im.value];
        assert_close(&found, &[root - half, root + half], 0.0, "whirl");
        if speed == synchronous {
            assert_close(&found[1..], &[speed], 0.0, "forward whirl at the critical speed");
        }
        modes.iter().for_each(assert_circular);
        assert_eq!(state.undamped_modes(), [None, None]);
    }
}

#[test]
fn a_sleeping_top() {
    let machine = Machine::new(sleeping_top::DECLARATION);
    let b = machine.nominal().to_vec();
    let [m, h, transverse, c] = b[..] else { panic!("four variables") };
    let (a, weight) = (transverse + m * h * h, 9.81 * m * h);
    let least = 2.0 * (a * weight).sqrt() / c;
    for spin in [0.5 * least, 1.01 * least, 3.0 * least] {
        let state = machine.at(&[spin], &b, &[0.0; 2]);
        let zero = real(0.0);
        let equation = Equation {
            coefficients: [real(a), imaginary(-spin * c), real(-weight)],
            derivatives: vec![
                [real(h * h), zero, real(-9.81 * h)],
                [real(2.0 * m * h), zero, real(-9.81 * m)],
                [real(1.0), zero, zero],
                [zero, imaginary(-spin), zero],
                [zero, imaginary(-c), zero],
            ],
        };
        if spin < least {
            // It falls in a spiral: one growing and one decaying mode, both of magnitude sqrt(m g h / A).
            let mut found = modes(&state);
            found.sort_by(|x, y| x.s.re.value.total_cmp(&y.s.re.value));
            let mut roots = equation.roots();
            roots.sort_by(|(x, _), (y, _)| x.re.total_cmp(&y.re));
            for (mode, (s, rates)) in found.iter().zip(roots) {
                let number = [mode.s.re.value, mode.s.im.value];
                assert_close(&number, &[s.re, s.im], s.norm(), "falling");
                assert_close(&[mode.magnitude.value], &[(weight / a).sqrt()], 0.0, "falling");
                for (k, rate) in rates.iter().enumerate() {
                    let found = [mode.s.re.gradient[k], mode.s.im.gradient[k]];
                    assert_close(&found, &[rate.re, rate.im], largest(&found), "falling");
                }
            }
            continue;
        }
        check(&state, &equation, &format!("{spin} rad/s"));
        let root = (spin * spin * c * c - 4.0 * a * weight).sqrt();
        let expected = [(spin * c - root) / (2.0 * a), (spin * c + root) / (2.0 * a)];
        let values: Vec<f64> = modes(&state).iter().map(|mode| mode.s.im.value).collect();
        assert_close(&values, &expected, 0.0, "precession and nutation");
    }
}

/// First derivatives, and second ones as well, since the frequencies are so simple.
#[test]
fn a_pendulum_in_a_turning_frame() {
    let machine = Machine::new(spherical_pendulum::DECLARATION);
    let b = machine.nominal().to_vec();
    let l = b[0];
    let omega = (9.81 / l).sqrt();
    let still = machine.at(&[0.0], &b, &[0.0; 2]);
    assert_eq!(still.general_modes(), [None, None]);
    for s in still.eigenvalues() {
        assert!((s - imaginary(omega)).norm() < 1e-6 * omega, "{s}");
    }
    for speed in [1e-3, 1.0, 5.0, 30.0] {
        let state = machine.at(&[speed], &b, &[0.0; 2]);
        let slope = -0.5 * omega / l;
        let side = f64::signum(omega - speed);
        let modes = modes(&state);
        for (mode, sign) in modes.iter().zip([-1.0, 1.0]) {
            // |sqrt(g / l) + sign W|, variables l, m, W.
            let outer = if sign < 0.0 { side } else { 1.0 };
            let what = format!("{speed} rad/s, {sign}");
            let frequency = outer * (omega + sign * speed);
            for number in [&mode.s.im, &mode.magnitude] {
                assert_close(&[number.value], &[frequency], 0.0, &what);
                let gradient = [outer * slope, 0.0, outer * sign];
                assert_close(&number.gradient, &gradient, 1.0, &what);
                let mut hessian = [0.0; 9];
                hessian[0] = outer * 0.75 * omega / (l * l);
                // The remaining rounding error grows as the pairs approach each other.
                let scale = 1.0 + 1e-3 / speed.powi(2);
                assert_close(&number.hessian.concat(), &hessian, scale, &what);
            }
            assert_circular(mode);
        }
    }
}
