//! Exponents by integration over one turn of the residual that the compiler derives for the same rotor with a hub that
//! turns freely, in the coordinates of each blade: nothing of multiblade coordinates is in it.

use super::hammond::BLADE;
use super::*;
use crate::free_machines::common::machine;
use eigentol::Role;
use eigentol::kernels::MotionKernels;
use nalgebra::{DMatrix, DVector};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng as _, SeedableRng as _};
use std::f64::consts::TAU;

/// A random rotor: `N` blades with hinges for lag and flap on a hub that moves along x and y and tilts about x.
fn rotor(values: &[f64], blades: usize, is_driven: bool) -> String {
    let [mx, my, kx, ky, cx, cy, tilt] = values[..7] else { panic!("seven values") };
    let (drive, ring) = match is_driven {
        true => (
            ", driven at omega",
            "cyclic blade[0..N] about z { use blade: Blade(m: m, S: S, I: I, e: e, cl: cl) with root: hub; }",
        ),
        false => (
            "",
            "for i in 0..N {
                use blade[i]: Blade(m: m, S: S, I: I, e: e, cl: cl) with root: hub rotated(z, i * (360 deg) / N);
            }",
        ),
    };
    let free = if is_driven { "" } else { "kernels only;" };
    format!(
        "{BLADE}
        mechanism Rotor {{
            {free}
            input omega: rad/s;
            let N = {blades};
            let m = 95 kg; let S = 289 kg*m; let I = 1085 kg*m^2; let e = 0.3 m; let cl = 4000 N*m*s/rad;
            body frame: point(mass: {mx:?} kg);
            body mast: point(mass: {my:?} kg);
            body head: rigid(mass: 500 kg, inertia: [900, 900, 400] kg*m^2, center: [0, 0, 1] m);
            body hub: massless;
            joint x: prismatic(x) from ground to frame;
            joint y: prismatic(y) from frame to mast;
            joint tilt: revolute(x) from mast to head;
            joint spin: revolute(z) from head to hub at [0, 0, 1.5] m{drive};
            force sx: spring(on: x, stiffness: {kx:?} N/m);
            force sy: spring(on: y, stiffness: {ky:?} N/m);
            force st: spring(on: tilt, stiffness: {tilt:?} N*m/rad);
            force dx: damper(on: x, damping: {cx:?} N*s/m);
            force dy: damper(on: y, damping: {cy:?} N*s/m);
            force dt: damper(on: tilt, damping: 2e4 N*m*s/rad);
            {ring}
        }}"
    )
}

/// The multipliers of one turn: the equations linearised about the turning rotor, integrated by implicit midpoints of fourth
/// order (Gauss).
fn multipliers(text: &str, omega: f64) -> Vec<Complex> {
    let machine = machine(text);
    let kernels: &dyn MotionKernels = &machine;
    let description = eigentol::Kernels::description(&machine);
    let n = description.coordinates.len();
    let spin = description.coordinates.iter().position(|of| &*of.name == "spin").expect("the drive");
    assert!(description.coordinates.iter().all(|of| of.role == Role::Position));
    let b: Vec<f64> = description.design.iter().map(|variable| variable.nominal).collect();
    let others: Vec<usize> = (0..n).filter(|k| *k != spin).collect();
    let slope = |psi: f64| {
        let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
        q[spin] = psi;
        v[spin] = omega;
        let linear = kernels.motion_linear(&vec![0.0; n], &v, &q, &[omega], &b);
        let [mass, damping, stiffness] = [&linear.mass, &linear.damping, &linear.stiffness]
            .map(|of| DMatrix::from_fn(others.len(), others.len(), |i, j| of[others[i]][others[j]]));
        let m = others.len();
        let inverse = mass.try_inverse().expect("masses");
        let mut slope = DMatrix::zeros(2 * m, 2 * m);
        slope.view_mut((0, m), (m, m)).fill_with_identity();
        slope.view_mut((m, 0), (m, m)).copy_from(&(-&inverse * stiffness));
        slope.view_mut((m, m), (m, m)).copy_from(&(-&inverse * damping));
        slope
    };
    let steps = 960;
    let h = TAU / omega / f64::from(steps);
    let size = 2 * others.len();
    let mut turn = DMatrix::<f64>::identity(size, size);
    let root = 3_f64.sqrt();
    for k in 0..steps {
        let at = |c: f64| slope(omega * h * (f64::from(k) + c));
        let [first, second] = [0.5 - root / 6.0, 0.5 + root / 6.0].map(at);
        // Two stages of Gauss: K1 = A1 (x + h (K1/4 + (1/4 - r) K2)), K2 = A2 (x + h ((1/4 + r) K1 + K2/4))
        let r = root / 6.0;
        let mut system = DMatrix::<f64>::identity(2 * size, 2 * size);
        let mut put = |i: usize, j: usize, block: DMatrix<f64>| {
            let mut view = system.view_mut((i * size, j * size), (size, size));
            view -= block;
        };
        put(0, 0, &first * (h * 0.25));
        put(0, 1, &first * (h * (0.25 - r)));
        put(1, 0, &second * (h * (0.25 + r)));
        put(1, 1, &second * (h * 0.25));
        let mut right = DMatrix::zeros(2 * size, size);
        right.view_mut((0, 0), (size, size)).copy_from(&(&first * &turn));
        right.view_mut((size, 0), (size, size)).copy_from(&(&second * &turn));
        let stages = system.lu().solve(&right).expect("stages");
        turn += (stages.view((0, 0), (size, size)) + stages.view((size, 0), (size, size))) * (h * 0.5);
    }
    let values: DVector<_> = turn.complex_eigenvalues();
    values.iter().map(|value| Complex::new(value.re, value.im)).collect()
}

#[test]
fn exponents_are_those_of_an_integration_over_a_turn() {
    let mut random = ChaCha8Rng::seed_from_u64(62);
    let mut unit = || f64::from(random.next_u32()) / f64::from(u32::MAX);
    for (trial, blades) in [4, 3, 5, 6].into_iter().enumerate() {
        let mut values: Vec<f64> =
            [4000.0, 3000.0, 1.2e6, 1.2e6, 4e4, 3e4, 8e6].into_iter().map(|of| of * (0.5 + unit())).collect();
        values[3] = values[2] * (1.3 + unit());
        let omega = (60.0 + 260.0 * trial as f64 / 3.0) * TAU / 60.0;
        let study = at(&rotor(&values, blades, true), omega);
        let modes = study.modes().expect("modes");
        let period = TAU / omega;
        let mut found: Vec<Complex> = Vec::new();
        for mode in &modes.modes {
            let value = (mode.s * period).exp();
            found.push(value);
            if mode.s.im > 0.0 {
                found.push(value.conj());
            }
        }
        let expected = multipliers(&rotor(&values, blades, false), omega);
        assert_eq!(found.len(), expected.len(), "{modes}");
        for multiplier in expected {
            let distance = |of: &Complex| (of - multiplier).norm();
            let nearest =
                (0..found.len()).min_by(|a, b| distance(&found[*a]).total_cmp(&distance(&found[*b]))).expect("one");
            let nearest = found.swap_remove(nearest);
            assert!(distance(&nearest) < 1e-6, "{blades} blades at {omega}: {nearest} instead of {multiplier}");
        }
    }
}

/// A rotor with gravity across its axis.
fn turbine(blades: usize, gravity: f64, is_driven: bool) -> String {
    let (drive, ring) = match is_driven {
        true => (", driven at omega", "cyclic blade[0..N] about z { use blade: Blade() with root: hub; }"),
        false => ("", "for i in 0..N { use blade[i]: Blade() with root: hub rotated(z, i * (360 deg) / N); }"),
    };
    let free = if is_driven { "" } else { "kernels only;" };
    format!(
        "part Blade() {{
            port root;
            body arm: rigid(mass: 6000 kg, inertia: [0, 386000, 386000] kg*m^2, center: [12, 0, 0] m);
            joint lag: revolute(z) from root to arm at [1.5, 0, 0] m;
            force hinge: spring(on: lag, stiffness: 2.6e7 N*m/rad);
            force damp: damper(on: lag, damping: 4e5 N*m*s/rad);
        }}
        mechanism Turbine {{
            {free}
            input omega: rad/s;
            let N = {blades};
            gravity {gravity:?} m/s^2 along -y;
            body frame: massless;
            body nacelle: point(mass: 90000 kg);
            body hub: massless;
            joint x: prismatic(x) from ground to frame;
            joint y: prismatic(y) from frame to nacelle;
            joint spin: revolute(z) from nacelle to hub{drive};
            force sx: spring(on: x, stiffness: 2.1e6 N/m);
            force sy: spring(on: y, stiffness: 2e7 N/m);
            force dx: damper(on: x, damping: 2e4 N*s/m);
            force dy: damper(on: y, damping: 4e4 N*s/m);
            {ring}
        }}"
    )
}

/// The equations of a rotor whose hub turns at a speed: state `(q, dq/dt)` of everything else.
struct Turning<'a> {
    kernels: &'a dyn MotionKernels,
    spin: usize,
    others: Vec<usize>,
    omega: f64,
}

impl Turning<'_> {
    /// The rate of a state at an angle, and of its change by the first state.
    fn rate(&self, psi: f64, x: &DVector<f64>, change: &DMatrix<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let (m, n) = (self.others.len(), self.others.len() + 1);
        let (mut q, mut v, mut a) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        (q[self.spin], v[self.spin]) = (psi, self.omega);
        for (k, &i) in self.others.iter().enumerate() {
            (q[i], v[i]) = (x[k], x[m + k]);
        }
        let (mass, force) = self.kernels.motion(&v, &q, &[self.omega], &[]);
        let mass = DMatrix::from_fn(m, m, |i, j| mass[self.others[i]][self.others[j]]);
        let inverse = mass.try_inverse().expect("masses");
        let acceleration = &inverse * DVector::from_fn(m, |k, _| force[self.others[k]]);
        for (k, &i) in self.others.iter().enumerate() {
            a[i] = acceleration[k];
        }
        let linear = self.kernels.motion_linear(&a, &v, &q, &[self.omega], &[]);
        let part = |stiffness: bool| {
            let of = if stiffness { &linear.stiffness } else { &linear.damping };
            DMatrix::from_fn(m, m, |i, j| of[self.others[i]][self.others[j]])
        };
        let mut slope = DMatrix::zeros(2 * m, 2 * m);
        slope.view_mut((0, m), (m, m)).fill_with_identity();
        slope.view_mut((m, 0), (m, m)).copy_from(&(-&inverse * part(true)));
        slope.view_mut((m, m), (m, m)).copy_from(&(-&inverse * part(false)));
        let rate = DVector::from_fn(2 * m, |k, _| if k < m { x[m + k] } else { acceleration[k - m] });
        (rate, slope * change)
    }

    /// The state after one turn, and its derivative by the first.
    fn turn(&self, x: &DVector<f64>, steps: u32) -> (DVector<f64>, DMatrix<f64>) {
        let (mut x, mut change) = (x.clone(), DMatrix::identity(x.len(), x.len()));
        let h = TAU / self.omega / f64::from(steps);
        for k in 0..steps {
            let at = |part: f64| self.omega * h * (f64::from(k) + part);
            let (a, da) = self.rate(at(0.0), &x, &change);
            let (b, db) = self.rate(at(0.5), &(&x + &a * (h / 2.0)), &(&change + &da * (h / 2.0)));
            let (c, dc) = self.rate(at(0.5), &(&x + &b * (h / 2.0)), &(&change + &db * (h / 2.0)));
            let (d, dd) = self.rate(at(1.0), &(&x + &c * h), &(&change + &dc * h));
            x += (a + (b + c) * 2.0 + d) * (h / 6.0);
            change += (da + (db + dc) * 2.0 + dd) * (h / 6.0);
        }
        (x, change)
    }
}

#[test]
fn gravity_across_the_axis_against_integration_about_the_periodic_motion() {
    for (blades, gravity, omega) in [(4, 9.81, 1.8), (3, 30.0, 1.5), (5, 20.0, 2.0)] {
        let what = format!("{blades} blades, {gravity} m/s^2, {omega} rad/s");
        let free = machine(&turbine(blades, gravity, false));
        let description = eigentol::Kernels::description(&free);
        let n = description.coordinates.len();
        let spin = description.coordinates.iter().position(|of| &*of.name == "spin").expect("the drive");
        let others = (0..n).filter(|k| *k != spin).collect();
        let turning = Turning { kernels: &free, spin, others, omega };
        let mut start = DVector::zeros(2 * n - 2);
        let mut monodromy = DMatrix::zeros(0, 0);
        for steps in [500, 1000, 3000] {
            let (end, change) = turning.turn(&start, steps);
            let identity = DMatrix::identity(2 * n - 2, 2 * n - 2);
            start += (identity - &change).lu().solve(&(end - &start)).expect("a periodic motion");
            monodromy = change;
        }
        let study = at(&turbine(blades, gravity, true), omega);
        let modes = study.modes().expect("modes");
        let period = TAU / omega;
        let mut found: Vec<(Complex, f64)> = Vec::new();
        for mode in &modes.modes {
            let value = (mode.s * period).exp();
            let error = value.norm() * mode.error * period;
            found.push((value, error));
            if mode.s.im > 0.0 {
                found.push((value.conj(), error));
            }
        }
        let expected = monodromy.complex_eigenvalues();
        assert_eq!(found.len(), expected.len(), "{what}");
        for multiplier in expected.iter().map(|value| Complex::new(value.re, value.im)) {
            let distance = |of: &(Complex, f64)| (of.0 - multiplier).norm();
            let nearest = (0..found.len()).min_by(|a, b| distance(&found[*a]).total_cmp(&distance(&found[*b])));
            let nearest = found.swap_remove(nearest.expect("one"));
            let gap = distance(&nearest);
            assert!(
                gap <= nearest.1 + 3e-8,
                "{what}: {} instead of {multiplier}, {gap:.1e} of {:.1e}",
                nearest.0,
                nearest.1
            );
            assert!(gap < 2e-4, "{what}: {gap:.1e}");
        }
    }
}
