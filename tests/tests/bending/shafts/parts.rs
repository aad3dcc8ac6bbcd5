//! Shafts of which parts have nothing to do with each other: no part hides the modes of another.

use std::f64::consts::PI;

use eigentol::{Complex, Error, Input, Quantity, Stability, Study};

use crate::beams::compared::machine;

const STEEL: &str = "material steel: density 7850 kg/m^3, modulus 205 GPa, poisson 0.3;";
const DENSITY: f64 = 7850.0;
const MODULUS: f64 = 205e9;

/// The speeds of waves that stretch and that twist.
fn waves() -> [f64; 2] {
    [MODULUS, MODULUS / 2.6].map(|modulus| (modulus / DENSITY).sqrt())
}

fn modes(text: &str) -> Vec<Complex> {
    let modes = Study::new(machine(text)).input(Input::new(0), 100.0).modes().expect("modes");
    modes.modes.iter().map(|mode| mode.s).collect()
}

fn assert_has(all: &[Complex], expected: f64, tolerance: f64, what: &str) {
    let near = all.iter().filter(|s| (**s - Complex::new(0.0, expected)).norm() < tolerance * expected).count();
    assert_eq!(near, 1, "{what}: {expected} in {all:?}");
}

/// Bars held at one end by springs along and about their axis: `k cos y = S y sin y / l` for both.
#[test]
fn lines_of_a_shaft_hide_none_of_each_other() {
    let mut seed = 7_u64;
    let mut random = |low: f64, high: f64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low * (high / low).powf((seed >> 11) as f64 / (1_u64 << 53) as f64)
    };
    for draw in 0..24 {
        let [length, diameter] = [random(0.2, 2.0), random(0.01, 0.15)];
        let (area, polar) = (PI * diameter.powi(2) / 4.0, PI * diameter.powi(4) / 32.0);
        let resistances = [MODULUS * area / length, MODULUS / 2.6 * polar / length];
        let springs = resistances.map(|own| own * random(1e-6, 1e3));
        let all = modes(&format!(
            "mechanism Bar {{ input omega: rad/s; {STEEL}
                body rotor: shaft(along: x, up: z, material: steel, lines: [torsion, stretch], sections: [[{length} m, {diameter} m]])
                    spinning at omega;
                point g: ground; point p: rotor;
                force held: bushing(from: g, to: p, stiffness: [{}, 0, 0] N/m, turning_stiffness: [{}, 0, 0] N*m/rad); }}",
            springs[0], springs[1]
        ));
        let highest = all.iter().map(|s| s.im).fold(0.0, f64::max);
        let mut count = 0;
        for (wave, ratio) in waves().into_iter().zip([0, 1].map(|k| springs[k] / resistances[k])) {
            for turn in 0..12 {
                let mut y = [PI * f64::from(turn), PI * (f64::from(turn) + 0.5)];
                for _ in 0..100 {
                    let middle = 0.5 * (y[0] + y[1]);
                    let above = middle * middle.sin() * (1.0 - 2.0 * f64::from(turn % 2)) > ratio * middle.cos().abs();
                    y[usize::from(above)] = middle;
                }
                let omega = y[0] * wave / length;
                if omega < 1.0001 * highest {
                    count += 1;
                    assert_has(&all, omega, 1e-7, &format!("draw {draw}"));
                }
            }
        }
        assert_eq!(count, all.len(), "draw {draw}: {all:?}");
    }
}

/// A shaft that nothing holds, and several of them: `pi c / l` along and about the axis, next to bending. Nothing grows.
#[test]
fn free_shafts_have_their_frequencies() {
    let shaft = |name: &str, lines: &str, length: f64| {
        format!(
            "body {name}: shaft(along: x, up: z, material: steel, lines: {lines}, sections: [[{length} mm, 50 mm]])
                 spinning at omega;"
        )
    };
    let [stretch, torsion] = waves().map(|wave| PI * wave);
    for (lines, all) in [("[bending, torsion]", vec![torsion]), ("[bending, stretch]", vec![stretch])] {
        for length in [700.0, 957.0, 1000.0, 1014.0] {
            let found =
                modes(&format!("mechanism Free {{ input omega: rad/s; {STEEL} {} }}", shaft("a", lines, length)));
            for wave in &all {
                assert_has(&found, wave * 1e3 / length, 1e-7, lines);
            }
        }
    }
    let lengths = [900.0, 950.0, 1000.0, 1050.0, 1100.0];
    let names = ["a", "b", "c", "d", "e"];
    let all: String =
        names.iter().zip(lengths).map(|(name, length)| shaft(name, "[torsion, stretch]", length)).collect();
    let study = Study::new(machine(&format!("mechanism Five {{ input omega: rad/s; {STEEL} {all} }}")));
    assert_eq!(study.equilibrium().expect("an equilibrium").stability, Stability::Marginal);
    let found: Vec<Complex> = study.modes().expect("modes").modes.iter().map(|mode| mode.s).collect();
    for length in lengths {
        for wave in [torsion, stretch] {
            assert_has(&found, wave * 1e3 / length, 1e-7, "five");
        }
    }
    let two = [shaft("a", "[bending, torsion]", 1000.0), shaft("b", "[bending, torsion]", 1000.0)].concat();
    let found = modes(&format!("mechanism Two {{ input omega: rad/s; {STEEL} {two} }}"));
    let near = |s: &&Complex| (s.im - torsion).abs() < 1e-7 * torsion;
    assert_eq!(found.iter().filter(near).count(), 2, "{found:?}");
}

/// Of free bars, whose frequencies are those of held ones too, next to which the shaft resists without bound: derivatives by the
/// length and the modulus, `omega = n pi sqrt(E / rho) / l`; second ones away from these, or none.
#[test]
fn free_shafts_have_derivatives() {
    for (rows, seconds) in
        [("[l, 50 mm]", 0), ("[l / 2, 50 mm], [l / 2, 50 mm]", 6), ("[0.31 * l, 50 mm], [0.69 * l, 50 mm]", 12)]
    {
        let text = format!(
            "mechanism Free {{ input omega: rad/s; design l = 1.3 m +/- 1 mm; design e = 205 GPa +/- 1 GPa;
                material steel: density 7850 kg/m^3, modulus e, poisson 0.3;
                body rotor: shaft(along: x, up: z, material: steel, lines: [torsion, stretch], sections: [{rows}])
                    spinning at omega;
                {} }}",
            if seconds > 0 { "point p: rotor at station 1;" } else { "" }
        );
        let study = Study::new(machine(&text));
        let sensitivities = study.sensitivities().expect("derivatives");
        let mut with_second = 0;
        for (k, own) in sensitivities.modes.iter().enumerate() {
            let omega = study.modes().expect("modes").modes[k].s.im;
            let first = own.frequency().expect("a frequency").by_design;
            let (l, e) = (1.3, MODULUS);
            for (found, expected) in [(first[0], -omega / l), (first[1], omega / (2.0 * e))] {
                assert!((found / expected - 1.0).abs() < 1e-5, "{rows}, mode {k}: {found} {expected}");
            }
            let curvature = match study.mode_curvature(k) {
                Err(Error::NextToPole { mode }) if mode == k => continue,
                other => other.expect("second derivatives"),
            };
            with_second += 1;
            let second = curvature.of(Quantity::Frequency).expect("a frequency").by_design;
            let all = [
                (second[0][0], 2.0 * omega / (l * l)),
                (second[0][1], -omega / (2.0 * e * l)),
                (second[1][1], -omega / (4.0 * e * e)),
            ];
            for (found, expected) in all {
                assert!((found / expected - 1.0).abs() < 1e-4, "{rows}, mode {k}, second: {found} {expected}");
            }
        }
        assert_eq!(with_second, seconds, "{rows}");
    }
}

/// A collar hardly longer than a tenth of its diameter, or less, is as good as rigid: its slow modes are those of rigid bodies.
#[test]
fn a_collar_is_rigid() {
    for length in [0.001, 0.008, 0.016, 0.07] {
        let attached = |root: &str, tip: &str| {
            format!(
                "point ga: ground; point a: {root}; point gb: ground at [{length}, 0, 0] m; point b: {tip};
                 force left: bushing(from: ga, to: a, stiffness: [0, 200, 300] kN/m, damping: [0, 10, 10] N*s/m,
                     turning_stiffness: [0, 0.5, 1] kN*m/rad);
                 force right: bushing(from: gb, to: b, stiffness: [0, 100, 100] kN/m, damping: [0, 10, 5] N*s/m);"
            )
        };
        let wheel = "body wheel: rigid(mass: 5 kg, inertia: [0.02, 0.012, 0.012] kg*m^2);";
        let (mass, radius) = (DENSITY * PI * 0.035_f64.powi(2) * length, 0.035_f64);
        let across = mass * (radius.powi(2) / 4.0 + length.powi(2) / 12.0);
        let rigid = modes(&format!(
            "mechanism Rigid {{ input omega: rad/s;
                body hub: rigid(mass: 1e-9 kg, inertia: [1e-12, 1e-12, 1e-12] kg*m^2);
                joint f: free(x: x, py: y, pz: z, pitch: y, yaw: z, roll: x) from ground to hub,
                    x driven at 0 m/s, roll driven at 0 rad/s;
                body rotor: rigid(mass: {mass} kg, inertia: [{}, {across}, {across}] kg*m^2);
                joint s: revolute(x) from hub to rotor, at [{}, 0, 0] m on hub, driven at omega;
                {wheel} joint turns: revolute(x) from hub to wheel, at [{length}, 0, 0] m on hub, driven at omega; {} }}",
            mass * radius.powi(2) / 2.0,
            length / 2.0,
            attached("hub", &format!("hub at [{length}, 0, 0] m"))
        ));
        for shear in ["", "shear: 0,"] {
            let collar = format!(
                "body rotor: shaft(along: x, up: z, material: steel, {shear} sections: [[{length} m, 70 mm]]) spinning at omega;
                 {wheel} joint turns: revolute(x) from rotor at tip to wheel, driven at omega; {}",
                attached("rotor at root", "rotor at tip")
            );
            let found = modes(&format!("mechanism Collar {{ input omega: rad/s; {STEEL} {collar} }}"));
            for (found, rigid) in found.iter().zip(&rigid) {
                // Slender ones of a millimetre are known to a hundredth.
                let tolerance = if shear.is_empty() || length > 0.002 { 2e-4 } else { 2e-3 };
                assert!((*found - *rigid).norm() < tolerance * rigid.norm(), "{length} {shear}: {found} {rigid}");
                assert!((found.re / rigid.re - 1.0).abs() < 2e-2, "{length} {shear}: {found} {rigid}");
            }
            let other =
                "body long: shaft(along: x, up: z, material: steel, sections: [[400 mm, 40 mm], [300 mm, 50 mm]])
                             spinning at omega;
                         point hc: ground; point c: long; point hd: ground at [0.7, 0, 0] m; point d: long at tip;
                         force third: bushing(from: hc, to: c, stiffness: [0, 2, 3] MN/m);
                         force fourth: bushing(from: hd, to: d, stiffness: [0, 2, 2] MN/m);";
            let alone = modes(&format!("mechanism Alone {{ input omega: rad/s; {STEEL} {other} }}"));
            let beside = modes(&format!("mechanism Beside {{ input omega: rad/s; {STEEL} {collar} {other} }}"));
            for (k, mode) in alone.iter().enumerate().take(8) {
                let has = beside.iter().any(|own| (*own - *mode).norm() < 1e-7 * mode.norm());
                assert!(has, "{length} {shear}, mode {k}: {mode} in {beside:?}");
            }
        }
    }
}
