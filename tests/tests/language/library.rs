//! Every part of the library against a closed form.

use std::path::Path;

use eigentol::kernels::Kernels;
use eigentol::{Input, Study};
use eigentol_compiler::with_included;
use eigentol_interpreter::Interpreted;

/// A machine that includes parts of the library.
fn study(text: &str) -> Study<Interpreted> {
    let (text, files) =
        with_included(text, Path::new("machine.mechanism")).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    assert!(files.is_empty(), "the library is no file");
    let machine = Interpreted::from_text(&text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    Study::new(machine)
}

fn frequencies(study: &Study<Interpreted>) -> Vec<f64> {
    study.modes().expect("modes").frequencies().iter().map(|x| x.expect("oscillates")).collect()
}

#[track_caller]
fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * expected.abs(), "{found} {expected}");
}

/// Two wheels whose angles are `p` and `q`, the first on a spring.
const WHEELS: &str =
    "body one: disk(mass: 1 kg, radius: 60 mm, axis: z); body two: disk(mass: 3 kg, radius: 120 mm, axis: z);
    joint p: revolute(z) from ground to one; joint q: revolute(z) from ground to two at [1 m, 0, 0];
    force shaft: spring(on: p, stiffness: 50 N*m/rad);";

/// Frequencies of two inertias with `stiffness (a p + b q)^2 / 2` and a spring on `p`.
fn of_wheels(stiffness: f64, a: f64, b: f64) -> [f64; 2] {
    let [first, second] = [0.5 * 0.06 * 0.06, 0.5 * 3.0 * 0.12 * 0.12];
    // w^2 of [[50 + s a a, s a b], [s a b, s b b]] over the inertias.
    let (k11, k22, k12) = (50.0 + stiffness * a * a, stiffness * b * b, stiffness * a * b);
    let sum = k11 / first + k22 / second;
    let product = (50.0 * stiffness * b * b) / (first * second);
    assert!((k11 * k22 - k12 * k12 - 50.0 * stiffness * b * b).abs() < 1e-9 * k11 * k22);
    let large = 0.5 * (sum + (sum * sum - 4.0 * product).sqrt());
    [(product / large).sqrt(), large.sqrt()]
}

#[test]
fn gears_and_belts_couple_two_wheels() {
    let gears = study(&format!(
        "include \"gear_pair.part\"; mechanism M {{ {WHEELS}
         use mesh: GearPair(first_teeth: 20, second_teeth: 40) with first: p, second: q; }}"
    ));
    let base = 1e-3 * 20.0_f64.to_radians().cos();
    let expected = of_wheels(20e9 * 0.02, 20.0 * base, 40.0 * base);
    frequencies(&gears).into_iter().zip(expected).for_each(|(found, expected)| near(found, expected, 1e-9));
    let belt =
        study(&format!("include \"belt.part\"; mechanism M {{ {WHEELS} use belt: Belt with first: p, second: q; }}"));
    let expected = of_wheels(2.0 * 80e3 / 0.5, 0.06, -0.12);
    frequencies(&belt).into_iter().zip(expected).for_each(|(found, expected)| near(found, expected, 1e-9));
}

/// A ball of 10 kg that moves in a plane, or freely.
const BALL: &str = "body ball: sphere(mass: 10 kg, radius: 5 cm);";
const PLANE: &str =
    "body rail: massless; joint x: prismatic(x) from ground to rail; joint y: prismatic(y) from rail to ball;";

#[test]
fn mounts_and_couplings_hold_by_their_stiffnesses() {
    let free = "joint f: free(x: x, y: y, z: z, a: x, b: y, c: z) from ground to ball;";
    let inertia = 0.4 * 10.0 * 0.05 * 0.05_f64;
    let mount = study(&format!(
        "include \"mount.part\"; mechanism M {{ {BALL} {free}
         use m: Mount(lag: 0 s) with foot: ground, machine: ball; }}"
    ));
    let mut expected = [1e6 / 10.0, 1e6 / 10.0, 3e6 / 10.0, 5e3 / inertia, 5e3 / inertia, 2e3 / inertia].map(f64::sqrt);
    expected.sort_by(f64::total_cmp);
    frequencies(&mount).into_iter().zip(expected).for_each(|(found, expected)| near(found, expected, 1e-9));
    let coupling = study(&format!(
        "include \"flexible_coupling.part\"; mechanism M {{ {BALL} {free}
         use disks: FlexibleCoupling(torsion_damping: 0 N*m*s/rad) with driving: ground, driven: ball; }}"
    ));
    let mut expected =
        [2e6 / 10.0, 2e6 / 10.0, 1e6 / 10.0, 1e3 / inertia, 1e3 / inertia, 20e3 / inertia].map(f64::sqrt);
    expected.sort_by(f64::total_cmp);
    frequencies(&coupling).into_iter().zip(expected).for_each(|(found, expected)| near(found, expected, 1e-9));
}

#[test]
fn a_rolling_bearing_has_the_stiffness_of_its_load() {
    let bearing = study(&format!(
        "include \"rolling_bearing.part\"; mechanism M {{ {BALL} {PLANE}
         use b: RollingBearing(load: 98.1 N, balls: 8, damping: 0 N*s/m) with seat: ground, journal: ball; }}"
    ));
    let along = 13e6 * 8.0_f64.powf(2.0 / 3.0) * 0.012_f64.cbrt() * 98.1_f64.cbrt();
    let expected = [0.46 * along, along].map(|k| (k / 10.0).sqrt());
    frequencies(&bearing).into_iter().zip(expected).for_each(|(found, expected)| near(found, expected, 1e-9));
}

/// Force of the film on a journal at rest or moving, over `viscosity diameter length^3 / (4 clearance^2)`: Ocvirk's
/// pressure integrated over the loaded half.
fn film([x, y]: [f64; 2], [vx, vy]: [f64; 2], speed: f64) -> [f64; 2] {
    let e = x.hypot(y);
    let ([rx, ry], [tx, ty]) = ([x / e, y / e], [-y / e, x / e]);
    let (grows, turns) = (vx * rx + vy * ry, (vx * tx + vy * ty) / e);
    let s = 1.0 - e * e;
    let radial = -((speed - 2.0 * turns) * 2.0 * e * e / (s * s)
        + std::f64::consts::PI * grows * (1.0 + 2.0 * e * e) / s.powf(2.5));
    let tangential = (speed - 2.0 * turns) * std::f64::consts::PI * e / (2.0 * s.powf(1.5)) + 4.0 * e * grows / (s * s);
    [radial * rx + tangential * tx, radial * ry + tangential * ty]
}

/// Stiffness and damping of the part at several speeds against differences of the film's forces.
#[test]
fn a_journal_bearing_has_the_coefficients_of_its_film() {
    let machine = study(&format!(
        "include \"journal_bearing.part\"; mechanism M {{ input speed: rad/s; {BALL} {PLANE}
         use j: JournalBearing(speed: speed, load: 400 N) with seat: ground, journal: ball; }}"
    ));
    for speed in [20.0, 100.0, 400.0] {
        let scale = 0.1 * 0.1 * 0.03_f64.powi(3) / (4.0 * 1e-4_f64.powi(2));
        // The eccentricity by bisection, then the place at which the force is along y.
        let [mut low, mut high] = [1e-6, 1.0 - 1e-6];
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            let [fx, fy] = film([middle, 0.0], [0.0; 2], speed);
            if scale * fx.hypot(fy) > 400.0 { high = middle } else { low = middle }
        }
        let [fx, fy] = film([low, 0.0], [0.0; 2], speed);
        let turn = std::f64::consts::FRAC_PI_2 - fy.atan2(fx);
        let at = [low * turn.cos(), low * turn.sin()];
        let force = |moved: [f64; 2], moving: [f64; 2]| film(moved, moving, speed).map(|x| scale * x);
        let h = 1e-6;
        let kernels: &dyn Kernels = machine.mechanism();
        let linear = kernels.linear(&[0.0; 2], &[speed], machine.design_values());
        for j in 0..2 {
            let ends = |k: f64| {
                let (mut moved, mut moving) = (at, [0.0; 2]);
                moved[j] += k * h;
                moving[j] += k * h;
                [force(moved, [0.0; 2]), force(at, moving)]
            };
            let (up, down) = (ends(1.0), ends(-1.0));
            for i in 0..2 {
                let slope = |of: usize| -(up[of][i] - down[of][i]) / (2.0 * h) / 1e-4;
                let size = 400.0 / 1e-4;
                assert!((linear.stiffness[i][j] - slope(0)).abs() < 1e-3 * size, "{speed} {i} {j}");
                assert!((linear.damping[i][j] - slope(1)).abs() < 1e-3 * size / speed * 10.0, "{speed} {i} {j}");
            }
        }
    }
}

#[test]
fn a_universal_joint_swings_in_two_planes() {
    let swing = study(
        "include \"universal_joint.part\"; mechanism M { gravity 9.81 m/s^2 along -z;
         body bar: rod(mass: 1 kg, length: 1 m, along: -z); use u: UniversalJoint with driving: ground, driven: bar; }",
    );
    frequencies(&swing).into_iter().for_each(|found| near(found, (1.5 * 9.81_f64).sqrt(), 1e-9));
}

#[test]
fn leaves_and_blades_bend_as_their_beams() {
    // A heavy mass on a light leaf: `3 E I / l^3`, with 33/140 of the leaf's mass.
    let leaf = study(
        "include \"leaf_spring.part\"; mechanism M { use spring: LeafSpring(density: 1 kg/m^3) with root: ground;
         body weight: sphere(mass: 2 kg, radius: 1 mm); joint weld: fixed from spring.leaf at tip to weight; }",
    );
    let stiffness = 3.0 * 210e9 * 0.04 * 0.003_f64.powi(3) / 12.0 / 0.3_f64.powi(3);
    near(frequencies(&leaf)[0], (stiffness / 2.0).sqrt(), 1e-4);
    // An even blade without twist, standing still: 3.516 sqrt(E I / (m l^4)), but for the rotary inertia of its sections.
    let blade = study(
        "include \"blade.part\"; mechanism M { input speed: rad/s; body hub: massless;
         joint spin: revolute(z) from ground to hub, driven at speed;
         for i in 0..2 { use b[i]: Blade(radius: 0.1 m, taper: 1, twist: 0 rad) with root: hub rotated(z, i * 180 deg); } }",
    );
    let even = 3.516_015_269 * (110e9 * 0.004 * 0.004 / 12.0 / 4430.0_f64).sqrt() / 0.04;
    let found = frequencies(&blade.input(Input::new(0), 0.0));
    [found[0], found[1]].into_iter().for_each(|found| near(found, even, 2e-4));
}
