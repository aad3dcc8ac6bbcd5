//! Speeds and velocity constraints against closed forms.

use eigentol::equilibrium::equilibrium;
use eigentol::kernels::{CurvatureKernels, Kernels, Linear};
use eigentol::modes::{match_modes, modes, modes_of, undamped_modes};
use eigentol::second_order::mode_curvature;
use eigentol::sensitivity::{sensitivities, sensitivities_explicit};
use eigentol::shapes::shape_sensitivity;
use eigentol::sweep::crossing_sensitivity;
use eigentol::sweep::{Range, flutter_onsets};
use eigentol::{
    Behaviour, Complex, DampingKind, Description, Equilibrium, Error, Family, Input, Mode, Modes, Policy, Real, Shared,
};

use crate::common::derived::{Derived, Model};
use crate::common::{METRE, coordinate, description, sizes};
use crate::constrained_modes::compare::{State, near, nominal};
use crate::constrained_modes::holonomic::{BAR, Bar, OMEGA};
use crate::constrained_modes::rolling::{CASTER, Caster, DRIVEN, Disk, DrivenDisk, Sleigh, Trail, rolling, speed};
use crate::constrained_modes::{FORCE, reaction};

fn solved(mechanism: &dyn Kernels, v: f64, b: &[f64], start: &[f64]) -> (Equilibrium, Modes) {
    let at = equilibrium(mechanism, &[v], b, start, Policy::Nearest).unwrap();
    let found = modes(&at).unwrap();
    assert_eq!(found.family, Family::General);
    for mode in &found.modes {
        assert!(mode.residual < 1e-12, "residual {}", mode.residual);
        let most = |x: &[Complex]| x.iter().fold(0.0_f64, |most, x| most.max(x.norm()));
        near(most(mode.left()), 1.0, 1e-14, 1.0);
    }
    (at, found)
}

/// A root of the real cubic `c3 s^3 + c2 s^2 + c1 s + c0`, by Newton's method from `start`.
fn root<const P: usize>(
    polynomial: &impl Fn(&[f64; P], f64) -> [f64; 4],
    b: &[f64; P],
    v: f64,
    start: Complex,
) -> Complex {
    let [c3, c2, c1, c0] = polynomial(b, v);
    let mut s = start;
    for _ in 0..50 {
        let value = ((s * c3 + c2) * s + c1) * s + c0;
        let slope = (3.0 * c3 * s + 2.0 * c2) * s + c1;
        s -= value / slope;
    }
    s
}

/// Derivative of the root by variable `j` (the speed comes last), by implicit differentiation. The coefficients are
/// polynomials of low degree, for which wide differences are exact except for rounding.
fn slope<const P: usize>(
    polynomial: &impl Fn(&[f64; P], f64) -> [f64; 4],
    b: &[f64; P],
    v: f64,
    start: Complex,
    j: usize,
) -> Complex {
    let s = root(polynomial, b, v, start);
    let [c3, c2, c1, _] = polynomial(b, v);
    let by_s = (3.0 * c3 * s + 2.0 * c2) * s + c1;
    let moved = |step: f64| {
        let (mut b, mut v) = (*b, v);
        if j < P {
            b[j] += step
        } else {
            v += step
        }
        let [c3, c2, c1, c0] = polynomial(&b, v);
        ((s * c3 + c2) * s + c1) * s + c0
    };
    let h = 1e-3 * if j < P { b[j].abs() } else { v.abs() };
    let one = moved(h) - moved(-h);
    let two = moved(2.0 * h) - moved(-2.0 * h);
    -((8.0 * one - two) / (12.0 * h)) / by_s
}

#[track_caller]
fn near_complex(a: Complex, b: Complex, tolerance: f64, scale: f64) {
    assert!((a - b).norm() <= tolerance * scale, "{a} is not {b}: off by {:e} of {scale:e}", (a - b).norm());
}

/// Eigenvalues, first derivatives by two methods and second derivatives of all modes against the roots of a cubic.
fn against_cubic<const P: usize>(
    mechanism: &dyn CurvatureKernels,
    b: [f64; P],
    v: f64,
    start: &[f64],
    polynomial: &impl Fn(&[f64; P], f64) -> [f64; 4],
) {
    let (at, found) = solved(mechanism, v, &b, start);
    let size = found.modes.iter().fold(0.0_f64, |most, mode| most.max(mode.s.norm()));
    let weight = |mode: &Mode| if mode.s.im > 0.0 { 2 } else { 1 };
    assert_eq!(found.modes.iter().map(weight).sum::<usize>(), 3);
    let adjoint = sensitivities(mechanism, &at, &found).unwrap();
    let explicit = sensitivities_explicit(mechanism, &at, &found).unwrap();
    for (r, mode) in found.modes.iter().enumerate() {
        near_complex(mode.s, root(polynomial, &b, v, mode.s), 1e-12, size);
        let exact = |b: &[f64; P], v: f64, j: usize| slope(polynomial, b, v, mode.s, j);
        let [own, other] = [&adjoint, &explicit].map(|all| all.modes[r].s().unwrap());
        let curvature = mode_curvature(mechanism, &at, &found, r).unwrap();
        assert!(curvature.asymmetry < 1e-8, "asymmetry {}", curvature.asymmetry);
        let second = curvature.eigenvalue.unwrap();
        for j in 0..P {
            let wanted = exact(&b, v, j);
            let scale = wanted.norm().max(1e-6 * size / b[j].abs());
            near_complex(own.by_design[j], wanted, 1e-10, scale);
            near_complex(other.by_design[j], wanted, 1e-10, scale);
            for i in 0..P {
                let at = |step: f64| {
                    let mut b = b;
                    b[i] += step;
                    exact(&b, v, j)
                };
                let h = 2e-3 * b[i].abs();
                let one = at(h) - at(-h);
                let two = at(2.0 * h) - at(-2.0 * h);
                let wanted = (8.0 * one - two) / (12.0 * h);
                let scale = wanted.norm().max(size / (b[i] * b[j]).abs());
                near_complex(second.by_design[i][j], wanted, 2e-9, scale);
            }
        }
        let wanted = exact(&b, v, P);
        near_complex(own.by_input[0], wanted, 1e-10, wanted.norm().max(1e-6 * size / v));
        near_complex(other.by_input[0], wanted, 1e-10, wanted.norm().max(1e-6 * size / v));
    }
}

#[test]
fn a_massless_trail_swings_back() {
    for v in [0.5, 3.0, -2.0] {
        let (at, found) = solved(&Derived(Trail), v, &[0.3], &[0.1, 0.0]);
        assert_eq!(found.modes.len(), 1);
        let s = found.modes[0].s;
        near_complex(s, Complex::new(-v / 0.3, 0.0), 1e-14, v.abs() / 0.3);
        assert_eq!(found.stable(), v > 0.0);
        let slopes = sensitivities(&Derived(Trail), &at, &found).unwrap();
        let own = slopes.modes[0].s().unwrap();
        near_complex(own.by_design[0], Complex::new(v / 0.09, 0.0), 1e-13, v.abs() / 0.09);
        near_complex(own.by_input[0], Complex::new(-1.0 / 0.3, 0.0), 1e-13, 3.3);
        let second = mode_curvature(&Derived(Trail), &at, &found, 0).unwrap();
        let by_a = second.eigenvalue.unwrap().by_design[0][0];
        near_complex(by_a, Complex::new(-2.0 * v / 0.027, 0.0), 1e-12, 80.0 * v.abs());
        assert!(matches!(undamped_modes(&at), Err(Error::NoUndampedModes)));
    }
}

fn caster(b: &[f64; 8], v: f64) -> [f64; 4] {
    let [m, j, a, centre, k, kt, _, damper] = *b;
    let lever = a - centre;
    [j + m * lever * lever, m * v * lever + damper, k * a * a + kt, k * a * v]
}

#[test]
fn a_caster_has_the_roots_of_its_cubic() {
    for v in [1.0, 4.0, 12.0] {
        against_cubic(&Derived(Caster), nominal::<Caster>(), v, &[0.0; 3], &caster);
    }
}

/// The speed above which the caster shimmies: `c1 c2 = c0 c3`.
fn shimmy(b: &[f64; 8]) -> f64 {
    let [m, j, a, centre, k, kt, _, damper] = *b;
    let lever = a - centre;
    let stiff = k * a * a + kt;
    damper * stiff / (k * a * (j + m * lever * lever) - stiff * m * lever)
}

#[test]
fn a_caster_shimmies_beyond_its_speed() {
    let b = CASTER;
    let onset = shimmy(&b);
    assert!(onset > 1.0 && onset < 20.0, "{onset}");
    for v in [0.9 * onset, 1.1 * onset] {
        let (at, found) = solved(&Derived(Caster), v, &b, &[0.0; 3]);
        assert_eq!(found.stable(), v < onset);
        assert_eq!(at.stability.holds(), found.stable());
    }
    let range = Range::new(Input::new(0), 0.3 * onset, 2.0 * onset).steps(20);
    let mechanism = Derived(Caster);
    let found = flutter_onsets(&mechanism, &[1.0], &b, &[0.0; 3], Policy::Nearest, range).unwrap();
    assert_eq!(found.len(), 1);
    near(found[0].value, onset, 1e-11, onset);
    let slopes = crossing_sensitivity(&mechanism, &found[0]).unwrap();
    for j in 0..8 {
        let at = |step: f64| {
            let mut b = b;
            b[j] += step;
            shimmy(&b)
        };
        let h = 2e-4 * b[j];
        let wanted = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
        near(slopes[j], wanted, 1e-8, wanted.abs().max(1e-3 * onset / b[j]));
    }
}

fn driven(b: &[f64; 5], v: f64) -> [f64; 4] {
    let [m, r, axial, transverse, c] = *b;
    let omega = v / r;
    let (lean, fall) = (transverse + m * r * r, m * 9.81 * r);
    [lean * transverse, lean * c, axial * (axial + m * r * r) * omega * omega - fall * transverse, -fall * c]
}

#[test]
fn a_driven_disk_has_the_roots_of_its_cubic() {
    for v in [0.4, 1.5, 3.0] {
        against_cubic(
            &Derived(DrivenDisk),
            nominal::<DrivenDisk>(),
            v,
            &[0.0, 0.3, v, 0.0, 0.0, 0.0, 0.0, 0.0],
            &driven,
        );
    }
}

/// A free disk: `s^2 = -(C (C + m r^2) spin^2 / A - m g r) / (A + m r^2)`, and two zero eigenvalues, because it may
/// roll at another speed or in a circle.
#[test]
fn a_free_disk_stands_by_its_spin() {
    let [m, r, axial, transverse] = [2.0, 0.3, 0.1, 0.05];
    for spin in [1.0_f64, 2.0, 4.0, 20.0] {
        let b = [m, r, axial, transverse, 0.0];
        let start = [0.0, r, r * spin, 0.0, 0.0, spin, -m * 9.81, 0.0, 0.0];
        let mechanism: &dyn Kernels = &Derived(Disk);
        let linear = mechanism.linear(&start, &[0.0], &b);
        let modes = modes_of(&linear, Family::General, &mechanism.description()).unwrap();
        let held = axial * (axial + m * r * r) * spin * spin / transverse - m * 9.81 * r;
        let square = -held / (transverse + m * r * r);
        let neutral: Vec<_> = modes.modes.iter().filter(|mode| mode.behaviour == Behaviour::Neutral).collect();
        assert_eq!(neutral.len(), 2, "{spin}: {:?}", modes.frequencies());
        assert!(neutral.iter().all(|mode| mode.condition < 1e3));
        if held > 0.0 {
            assert_eq!(modes.modes.len(), 3);
            let omega = modes.modes[2].frequency().unwrap();
            near(omega, (-square).sqrt(), 1e-12, omega);
            assert!(matches!(modes.modes[2].behaviour, Behaviour::Oscillating(_)));
            assert!(modes.stable());
        } else {
            assert_eq!(modes.modes.len(), 4);
            let rate = square.sqrt();
            for (mode, wanted) in modes.modes[2..].iter().zip([-rate, rate]) {
                near_complex(mode.s, wanted.into(), 1e-12, rate);
            }
            assert!(!modes.stable());
        }
        // A neutral mode consisting only of a speed is recognised as the same mode.
        let order = match_modes(&modes, &modes, &linear);
        assert!(order.iter().enumerate().all(|(i, place)| *place == Some(i)));
    }
}

#[test]
fn a_sleigh_goes_straight_with_its_edge_behind() {
    let b = nominal::<Sleigh>();
    let [m, j, a, d] = b;
    for v in [0.3, 2.0, -1.0] {
        let (at, found) = solved(&Derived(Sleigh), v, &b, &[v, 0.0, 0.0, 0.0]);
        let wanted = [-d / m, -m * a * v / (j + m * a * a)];
        assert_eq!(found.modes.len(), 2);
        assert_eq!(found.stable(), v > 0.0);
        let all = sensitivities(&Derived(Sleigh), &at, &found).unwrap();
        for (mode, own) in found.modes.iter().zip(&all.modes) {
            let straight = (mode.s.re - wanted[0]).abs() < 1e-9;
            near_complex(mode.s, wanted[usize::from(!straight)].into(), 1e-13, 1.0);
            let slopes = own.s().unwrap().by_design.map(|value| value.re);
            let inertia = j + m * a * a;
            let exact = if straight {
                [d / (m * m), 0.0, 0.0, -1.0 / m]
            } else {
                [
                    -a * v * j / (inertia * inertia),
                    m * a * v / (inertia * inertia),
                    -m * v * (j - m * a * a) / (inertia * inertia),
                    0.0,
                ]
            };
            for (slope, exact) in slopes.iter().zip(exact) {
                near(*slope, exact, 1e-12, 1.0);
            }
        }
    }
    // Nothing holds the speed: a neutral mode consisting only of a speed.
    let free = [m, j, a, 0.0];
    let mechanism: &dyn Kernels = &Derived(Sleigh);
    let linear = mechanism.linear(&[2.0, 0.0, 0.0, 0.0], &[2.0], &free);
    let description = &mechanism.description();
    let modes = modes_of(&linear, Family::General, description).unwrap();
    assert_eq!(modes.modes[0].behaviour, Behaviour::Neutral);
    near(modes.modes[0].shape[0].norm(), 1.0, 1e-14, 1.0);
}

/// Derivatives of left and right shapes against modes at a changed design.
#[test]
fn shapes_with_speeds_move_with_the_design() {
    let start = [0.0, 0.3, 1.5, 0.0, 0.0, 0.0, 0.0, 0.0];
    let b = DRIVEN;
    let (at, found) = solved(&Derived(DrivenDisk), 1.5, &b, &start);
    for r in 0..found.modes.len() {
        let slopes = shape_sensitivity(&Derived(DrivenDisk), &at, &found, r).unwrap();
        for j in 0..5 {
            let at = |step: f64| {
                let mut b = b;
                b[j] += step;
                solved(&Derived(DrivenDisk), 1.5, &b, &start).1.modes[r].clone()
            };
            let h = 1e-3 * b[j];
            let (up, down, up2, down2) = (at(h), at(-h), at(2.0 * h), at(-2.0 * h));
            let by = |part: fn(&Mode) -> &[Complex], i: usize| {
                let one = part(&up)[i] - part(&down)[i];
                let two = part(&up2)[i] - part(&down2)[i];
                (8.0 * one - two) / (12.0 * h)
            };
            for i in 0..8 {
                let scale = slopes.right_by_design[j].iter().fold(1e-3_f64, |m, x| m.max(x.norm()));
                near_complex(slopes.right_by_design[j][i], by(|m| &m.shape, i), 1e-7, scale);
                let scale = slopes.left_by_design[j].iter().fold(1e-3_f64, |m, x| m.max(x.norm()));
                near_complex(slopes.left_by_design[j][i], by(Mode::left, i), 1e-7, scale);
            }
        }
    }
}

/// The bar described by its tip, with its length also held as a rate: a redundant velocity constraint.
#[derive(Clone, Copy, Debug)]
struct Rated;

impl Model for Rated {
    sizes!(4, 1, 3, 0);

    const DESCRIPTION: Description = description!(
        "Rated",
        &[coordinate("x", METRE), coordinate("z", METRE), reaction("length", FORCE), rolling("rate"),],
        OMEGA,
        BAR,
        false,
        DampingKind::General
    );

    fn inertia<T: Real>(&self, a: &[T; 4], v: &[T; 4], q: &[T; 4], u: &[T; 1], b: &[T; 3]) -> [T; 4] {
        let size = (q[0] * q[0] + q[1] * q[1]).sqrt();
        let both = q[2] + q[3];
        let [x, z, length] = Bar::<1>.inertia(&[a[0], a[1], a[2]], &[v[0], v[1], v[2]], &[q[0], q[1], both], u, b);
        [x, z, length, (q[0] * v[0] + q[1] * v[1]) / size]
    }

    fn applied<T: Real>(&self, _: &[T; 4], _: &[T; 4], _: &[T; 1], _: &[T; 3]) -> [T; 4] {
        [T::constant(0.0); 4]
    }
}

#[test]
fn a_constraint_stated_again_as_a_rate_changes_nothing() {
    let omega = 4.2;
    let b = nominal::<Bar<1>>();
    let (at, found) = solved(&Derived(Rated), omega, &b, &[0.55, 0.83, 30.0, 0.0]);
    let once = State::new(Bar::<1>, &[omega], &[0.55, 0.83, 0.0]);
    assert_eq!(found.modes.len(), 1);
    near_complex(found.modes[0].s, once.modes.modes[0].s, 1e-12, 1.0);
    let own = sensitivities(&Derived(Rated), &at, &found).unwrap();
    let other = sensitivities(&*once.mechanism, &once.at, &once.modes).unwrap();
    let [own, other] = [&own, &other].map(|all| all.modes[0].s().unwrap());
    for j in 0..3 {
        near_complex(own.by_design[j], other.by_design[j], 1e-10, 1.0);
    }
}

/// A mass that slides freely beside one stopped by a dashpot: it rests anywhere, and drifts.
#[test]
fn a_free_mass_drifts() {
    static DRIFT: Shared<Description> = Shared::Static(&description!(
        "Drift",
        &[coordinate("x", METRE), speed("v", METRE)],
        &[],
        &[],
        false,
        DampingKind::General
    ));
    let linear = Linear {
        mass: [[2.0, 0.0], [0.0, 0.0]].into(),
        damping: [[0.0, 0.0], [0.0, 1.0]].into(),
        stiffness: [[0.0, 0.0], [0.0, 0.5]].into(),
    };
    let modes = modes_of(&linear, Family::General, &DRIFT).unwrap();
    assert_eq!(modes.modes.len(), 3);
    let neutral = |mode: &&Mode| mode.behaviour == Behaviour::Neutral;
    assert_eq!(modes.modes.iter().filter(neutral).count(), 2);
    assert!(modes.modes.iter().filter(neutral).all(|mode| mode.condition.is_infinite()));
    near_complex(modes.modes[2].s, (-0.5).into(), 1e-14, 1.0);
}
