//! Shafts of random steps: against the same with each section in four, against `beam`s, and derivatives against
//! differences.

use std::fmt::Write;

use eigentol::response::Vibration;
use eigentol::{Complex, DesignVariable, Excitation, Input, Output, Stability, Study};
use eigentol_interpreter::Interpreted;

use crate::beams::compared::machine;

/// Numbers without a pattern, always the same.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A rotor of eight random sections with a disk in the middle, two bearings and an unbalance; each section is written as so
/// many rows.
fn rotor(seed: u64, split: usize) -> String {
    let mut random = Random(seed);
    let (mut rows, mut before) = (String::new(), [0.0; 9]);
    let mut lengths = [0.0; 8];
    for (k, length) in lengths.iter_mut().enumerate() {
        *length = random.between(40.0, 120.0);
        let (outer, share) = (random.between(30.0, 60.0), random.between(0.0, 0.6));
        before[k + 1] = before[k] + *length;
        let outer = if k == 3 { "outer".to_owned() } else { format!("{outer} mm") };
        for _ in 0..split {
            let layer = if k == 5 { ", steel, 70 mm, 60 mm, brass" } else { "" };
            let row = if k == 5 { "60 mm, 20 mm".to_owned() } else { format!("{outer}, {} mm", 30.0 * share) };
            let length = if k == 2 { "length".to_owned() } else { format!("{length} mm") };
            write!(rows, "[{length} / {split}, {row}{layer}], ").expect("text");
        }
    }
    let station = |section: usize| split * section;
    let mut bearings = String::new();
    for k in [1, 7] {
        let [y, z] = [0; 2].map(|_| random.between(20.0, 60.0));
        let [c, cross] = [0; 2].map(|_| random.between(0.5, 3.0));
        write!(
            bearings,
            "point journal{k}: rotor at station {}; point seat{k}: ground at [{}, 0, 0];
            force film{k}: bushing(from: seat{k}, to: journal{k},
                stiffness: [[0, 0, 0], [0, {y} MN/m, {cross} MN/m], [0, -{cross} MN/m, {z} MN/m]],
                damping: [0, {c}e3, {c}e3] N*s/m);",
            station(k),
            if k == 1 { format!("{} mm", before[1]) } else { format!("{} mm + length", before[7] - lengths[2]) },
        )
        .expect("text");
    }
    format!(
        "mechanism Rotor {{
            input omega: rad/s;
            design outer = 45 mm; design length = {} mm; design modulus = 205 GPa; design density = 7800 kg/m^3;
            design lag = 4 us; design drag = 20 N*s/m^2; design mass = 12 kg;
            material steel: density density, modulus modulus, poisson 0.3;
            material brass: density 8500 kg/m^3, modulus 100 GPa, poisson 0.34;
            gravity 9.81 m/s^2 along -z;
            body rotor: shaft(along: x, up: z, material: steel, lag: lag, drag: drag, lines: [bending, torsion, stretch],
                sections: [{rows}]) spinning at omega;
            body disk: disk(mass: mass, radius: 120 mm, axis: x);
            joint turns: revolute(x) from rotor at station {} to disk, driven at omega;
            {bearings}
            point end_of_it: rotor at tip; point behind: ground at [{} mm + length, 0, 0];
            force coupling: bushing(from: behind, to: end_of_it, stiffness: [3, 0, 0] MN/m, damping: [200, 0, 0] N*s/m,
                turning_stiffness: [5e3, 0, 0] N*m/rad, turning_damping: [3, 0, 0] N*m*s/rad);
            unbalance heavy: on disk, amount: 100 g*mm, angle: 20 deg;
            point hub: rotor at station {};
            output y = position(hub).y; output z = position(hub).z; output x = position(end_of_it).x;
        }}",
        lengths[2],
        station(4),
        before[8] - lengths[2],
        station(4)
    )
}

fn study(seed: u64, split: usize) -> Study<Interpreted> {
    Study::new(machine(&rotor(seed, split))).input(Input::new(0), 300.0)
}

#[test]
fn sections_may_be_divided() {
    for seed in 1..4 {
        let (whole, split) = (study(seed, 1), study(seed, 4));
        let [a, b] = [&whole, &split].map(|study| study.modes().expect("modes"));
        for (a, b) in a.modes.iter().zip(&b.modes).take(8) {
            assert!((a.s - b.s).norm() < 2e-8 * b.s.norm(), "{seed}: {} {}", a.s, b.s);
        }
        let [a, b] = [&whole, &split].map(|study| study.forced_response().expect("a response"));
        for (a, b) in a.harmonics[0].outputs.iter().zip(&b.harmonics[0].outputs) {
            let (a, b) = (a.expect("an amplitude"), b.expect("an amplitude"));
            assert!((a - b).norm() <= 1e-8 * b.norm(), "{seed}: {a} {b}");
        }
        let [a, b] = [&whole, &split].map(|study| study.outputs().expect("outputs").values);
        for (a, b) in a.iter().zip(b.iter()) {
            assert!((a - b).abs() <= 1e-9 * b.abs().max(1e-6), "{seed}: {a} {b}");
        }
    }
}

#[test]
fn derivatives_are_those_of_differences() {
    for seed in 1..4 {
        let study = study(seed, 1);
        let modes = study.modes().expect("modes");
        let (sensitivities, forced) =
            (study.sensitivities().expect("derivatives"), study.forced_sensitivities().expect("derivatives"));
        let outputs = study.outputs().expect("derivatives");
        let variables: Vec<f64> = study.description().design.iter().map(|variable| variable.nominal).collect();
        let shapes: Vec<_> =
            (0..6).map(|mode| study.shape_sensitivity(mode).expect("derivatives of a shape")).collect();
        for (k, nominal) in variables.iter().enumerate() {
            let step = 3e-3 * nominal;
            let moved = |steps: f64| study.clone().design(DesignVariable::new(k), nominal + steps * step);
            let around = [-2.0, -1.0, 1.0, 2.0].map(moved);
            let modes_around = around.each_ref().map(|study| study.modes().expect("modes").modes);
            let slope = |[a, b, c, d]: [Complex; 4]| (a - d + 8.0 * (c - b)) / (12.0 * step);
            for (number, (mode, sensitivity)) in modes.modes.iter().zip(&sensitivities.modes).take(6).enumerate() {
                let apart = |own: &eigentol::Mode| (own.s - mode.s).norm();
                let nearest = modes_around
                    .each_ref()
                    .map(|modes| modes.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).expect("modes"));
                let (found, expected) =
                    (sensitivity.s().expect("derivatives").by_design[k], slope(nearest.map(|mode| mode.s)));
                let error = (found - expected).norm() * nominal.abs();
                assert!(error < 1e-8 * mode.s.norm(), "{seed} {k} {}: {found} {expected}", mode.s);
                let shapes = &shapes[number];
                let greatest = |shape: &[Complex]| shape.iter().map(|x| x.norm()).fold(0.0, f64::max);
                for i in 0..mode.shape.len() {
                    let (found, expected) = (shapes.right_by_design[k][i], slope(nearest.map(|mode| mode.shape[i])));
                    let error = (found - expected).norm() * nominal.abs();
                    assert!(error < 1e-6 * greatest(&mode.shape), "{seed} {k} {i}: {found} {expected}");
                    let (found, expected) = (shapes.left_by_design[k][i], slope(nearest.map(|mode| mode.left()[i])));
                    let error = (found - expected).norm() * nominal.abs();
                    assert!(error < 1e-6 * greatest(mode.left()), "{seed} {k} {i}: {found} {expected}");
                }
            }
            for output in 0..2 {
                let amplitude = |study: &Study<Interpreted>| {
                    study.forced_response().expect("a response").harmonics[0].outputs[output].expect("one")
                };
                let found = forced.harmonics[0].outputs[output].as_ref().expect("derivatives").by_design[k];
                let expected = slope(around.each_ref().map(amplitude));
                let error = (found - expected).norm() * nominal.abs();
                assert!(error < 1e-7 * amplitude(&study).norm(), "{seed} {k} output {output}: {found} {expected}");
            }
            let value = |study: &Study<Interpreted>| Complex::from(study.outputs().expect("outputs").values[1]);
            let (found, expected) =
                (outputs.by_design[1].as_ref().expect("derivatives")[k], slope(around.each_ref().map(value)).re);
            assert!(
                (found - expected).abs() * nominal.abs() < 1e-8 * value(&study).norm(),
                "{seed} {k}: {found} {expected}"
            );
        }
    }
}

/// A shaft whose tip is pushed away in both planes, whose root is on springs of which so many are replaced by constraints: it
/// gives way in each plane where what pushes is stiffer than all that holds the tip, whose compliances add.
#[test]
fn what_is_pushed_away_gives_way_in_as_many_directions() {
    let (length, radius, modulus, poisson): (f64, f64, f64, f64) = (0.5, 0.015, 210e9, 0.3);
    let inertia = std::f64::consts::FRAC_PI_4 * radius.powi(4);
    let shear = modulus / (2.0 * (1.0 + poisson)) * std::f64::consts::PI * radius * radius;
    let shear = shear * 6.0 * (1.0 + poisson) / (7.0 + 6.0 * poisson);
    let constraints = [
        "constraint held_y: equation(zero: position(root).y);",
        "constraint held_z: equation(zero: position(root).z);",
        "constraint turn_z: equation(zero: position(ahead).z);",
        "constraint turn_y: equation(zero: position(ahead).y);",
    ];
    let mut random = Random(7);
    let mut seen = [0; 3];
    for count in 0..=4 {
        for _ in 0..12 {
            let compliance = |held: bool, turned: bool| {
                let own = length.powi(3) / (3.0 * modulus * inertia) + length / shear;
                own + if held { 0.0 } else { 1.0 / 3e6 } + if turned { 0.0 } else { length * length / 2e4 }
            };
            let pushes = [random.between(-2.0, 1.0), random.between(-2.0, 1.0)];
            let holds = [compliance(count >= 1, count >= 4), compliance(count >= 2, count >= 3)];
            let [y, z] = [pushes[0] / holds[0], pushes[1] / holds[1]];
            let text = format!(
                "mechanism Pushed {{ input omega: rad/s;
                    material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;
                    body rotor: shaft(along: x, up: z, material: steel, sections: [[500 mm, 30 mm]]) spinning at omega;
                    body disk: disk(mass: 3 kg, radius: 80 mm, axis: x);
                    joint turns: revolute(x) from rotor at tip to disk, driven at omega;
                    point seat: ground at [500 mm, 0, 0]; point journal: rotor at tip;
                    force film: bushing(from: seat, to: journal, stiffness: [0, {y}, {z}] N/m, damping: [0, 200, 100] N*s/m);
                    point root: rotor at root; point base: ground at [0, 0, 0];
                    force soft: bushing(from: base, to: root, stiffness: [0, 3e6, 3e6] N/m, damping: [0, 100, 100] N*s/m,
                        turning_stiffness: [0, 2e4, 2e4] N*m/rad, turning_damping: [0, 5, 5] N*m*s/rad);
                    body arm: massless; joint weld: fixed from rotor to arm; point ahead: arm at [1 m, 0, 0]; {} }}",
                constraints[..count].concat()
            );
            let negative = pushes.iter().filter(|push| **push < -1.0).count();
            let expected = if negative == 0 { Stability::Stable } else { Stability::Divergent { negative } };
            let study = Study::new(machine(&text)).input(Input::new(0), 20.0);
            assert_eq!(study.equilibrium().expect("a state").stability, expected, "{count} {pushes:?}");
            seen[negative] += 1;
        }
    }
    assert!(seen.iter().all(|count| *count > 5), "{seen:?}");
}

/// A uniform shaft whose root is held is a beam that spins, with a disk and a bearing at its tip; gravity is so weak that the beam
/// stays straight.
#[test]
fn a_beam_is_the_same() {
    compare("[500 mm, 30 mm]", "circle(radius: 15 mm)", 1e-7);
}

/// Solid and hollow.
#[test]
fn a_tapered_beam_is_the_same() {
    compare("[500 mm, taper(40 mm, 24 mm)]", "circle(radius: 20 mm) to circle(radius: 12 mm)", 5e-7);
    let tube = "tube(outer: 20 mm, inner: 8 mm) to tube(outer: 12 mm, inner: 6 mm)";
    compare("[500 mm, taper(40 mm, 24 mm), taper(16 mm, 12 mm)]", tube, 5e-7);
}

fn compare(row: &str, section: &str, bar: f64) {
    let common = "input omega: rad/s; gravity 9.81e-4 m/s^2 along -z;
        material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;
        body disk: disk(mass: 3 kg, radius: 80 mm, axis: x); joint turns: revolute(x) from rotor at tip to disk, driven at omega;
        point seat: ground at [500 mm, 0, 0]; point journal: rotor at tip;
        force film: bushing(from: seat, to: journal, stiffness: [0, 3e5, 5e5] N/m, damping: [0, 200, 100] N*s/m);
        unbalance heavy: on disk, amount: 10 g*mm, angle: 0 deg;
        output y = position(journal).y; output z = position(journal).z;";
    let shaft = format!(
        "mechanism Shaft {{ {common}
            body rotor: shaft(along: x, up: z, material: steel, sections: [{row}]) spinning at omega;
            point root: rotor at root; body arm: massless; joint weld: fixed from rotor to arm; point ahead: arm at [1 m, 0, 0];
            constraint held_y: equation(zero: position(root).y); constraint held_z: equation(zero: position(root).z);
            constraint turn_y: equation(zero: position(ahead).z); constraint turn_z: equation(zero: position(ahead).y); }}"
    );
    let beam = format!(
        "mechanism Beam {{ {common}
            body rotor: beam(length: 500 mm, along: x, up: z, material: steel, section: {section},
                bending: 12, shear: 12, torsion: 0) spinning at omega;
            joint clamp: fixed from ground to rotor; }}"
    );
    let [a, b] = [shaft, beam].map(|text| Study::new(machine(&text)).input(Input::new(0), 400.0));
    let [of_shaft, of_beam] = [&a, &b].map(|study| study.modes().expect("modes"));
    let lateral = of_shaft.modes.iter().filter(|mode| mode.s.im > 0.0).take(6);
    for mode in lateral {
        let near = |other: &eigentol::Mode| (other.s - mode.s).norm() < bar * mode.s.norm();
        let all: Vec<_> = of_beam.modes.iter().map(|mode| mode.s).take(8).collect();
        assert!(of_beam.modes.iter().any(near), "{} {all:?}", mode.s);
    }
    let [of_shaft, of_beam] = [&a, &b].map(|study| study.forced_response().expect("a response"));
    for (a, b) in of_shaft.harmonics[0].outputs.iter().zip(&of_beam.harmonics[0].outputs) {
        let (a, b) = (a.expect("an amplitude"), b.expect("an amplitude"));
        assert!((a - b).norm() < 1e-6 * b.norm(), "{a} {b}");
    }
    let [of_shaft, of_beam] = [&a, &b].map(|study| study.outputs().expect("outputs"));
    for (a, b) in of_shaft.values.iter().zip(&of_beam.values) {
        assert!((a - b).abs() < 1e-7 * b.abs().max(1e-12), "{a} {b}");
    }
}

/// Second derivatives of modes and vibrations, and derivatives of shapes: differences of those that were compared above.
#[test]
fn second_derivatives_are_those_of_differences() {
    let study = study(2, 1);
    let modes = study.modes().expect("modes");
    let variables: Vec<f64> = study.description().design.iter().map(|variable| variable.nominal).collect();
    let curvatures: Vec<_> = (0..4).map(|mode| study.mode_curvature(mode).expect("second derivatives")).collect();
    for (k, nominal) in variables.iter().enumerate() {
        let step = 2e-3 * nominal;
        let around = [-2.0, -1.0, 1.0, 2.0].map(|steps| {
            let moved = study.clone().design(DesignVariable::new(k), nominal + steps * step);
            (moved.modes().expect("modes").modes, moved.sensitivities().expect("derivatives").modes)
        });
        for (mode, curvature) in curvatures.iter().enumerate() {
            let second = curvature.eigenvalue.as_ref().expect("second derivatives");
            let s = modes.modes[mode].s;
            assert!(curvature.asymmetry < 1e-7, "{}", curvature.asymmetry);
            let slopes = around.each_ref().map(|(modes, sensitivities)| {
                let apart = |k: &usize| (modes[*k].s - s).norm();
                let own = (0..modes.len()).min_by(|a, b| apart(a).total_cmp(&apart(b))).expect("modes");
                sensitivities[own].s().expect("derivatives")
            });
            for (l, other) in variables.iter().enumerate() {
                let [a, b, c, d] = slopes.each_ref().map(|slopes| slopes.by_design[l]);
                let expected = (a - d + 8.0 * (c - b)) / (12.0 * step);
                let found = second.by_design[k][l];
                let error = (found - expected).norm() * (nominal * other).abs();
                assert!(error < 2e-7 * s.norm(), "{mode} {k} {l}: {found} {expected}");
            }
        }
    }
    let forced = study.forced_curvature().expect("second derivatives");
    assert!(forced.asymmetry < 1e-7, "{}", forced.asymmetry);
    let response = study.forced_response().expect("a response");
    for (k, nominal) in variables.iter().enumerate() {
        let step = 2e-3 * nominal;
        let around = [-2.0, -1.0, 1.0, 2.0].map(|steps| {
            let moved = study.clone().design(DesignVariable::new(k), nominal + steps * step);
            moved.forced_sensitivities().expect("derivatives").harmonics.swap_remove(0)
        });
        for output in 0..2 {
            let size = response.harmonics[0].outputs[output].expect("an amplitude").norm();
            let second = forced.harmonics[0].outputs[output].as_ref().expect("second derivatives");
            for (l, other) in variables.iter().enumerate() {
                let of = |own: &eigentol::sensitivity::Slopes<Complex>| own.by_design[l];
                let [a, b, c, d] = around.each_ref().map(|own| of(own.outputs[output].as_ref().expect("derivatives")));
                let expected = (a - d + 8.0 * (c - b)) / (12.0 * step);
                let found = second.by_design[k][l];
                let error = (found - expected).norm() * (nominal * other).abs();
                assert!(error < 1e-6 * size, "output {output} {k} {l}: {found} {expected}");
            }
        }
    }
}

/// The modes of a slow round rotor are pairs, forward and backward, nearly equal: none is lost, and each moves away from the
/// value at rest in proportion to the speed.
#[test]
fn slow_rotors_have_their_modes_in_pairs() {
    let text = "mechanism Slow { input omega: rad/s;
        material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;
        body rotor: shaft(along: x, up: z, material: steel, lag: 5 us, drag: 4 N*s/m^2,
            sections: [[200 mm, 30 mm], [150 mm, 45 mm], [250 mm, 35 mm, 10 mm]]) spinning at omega;
        body disk: disk(mass: 9 kg, radius: 120 mm, axis: x);
        joint turns: revolute(x) from rotor at station 2 to disk, driven at omega;
        point left: rotor at root; point right: rotor at tip; point a: ground at [0, 0, 0]; point b: ground at [0.6, 0, 0] m;
        force film_a: bushing(from: a, to: left, stiffness: [0, 20, 20] MN/m, damping: [0, 1, 1] kN*s/m);
        force film_b: bushing(from: b, to: right, stiffness: [0, 30, 30] MN/m, damping: [0, 2, 2] kN*s/m); }";
    let study = Study::new(machine(text));
    let at = |omega: f64| -> Vec<Complex> {
        let modes = study.clone().input(Input::new(0), omega).modes().expect("modes").modes;
        assert_eq!(modes.len(), 12, "{omega}");
        modes.iter().map(|mode| mode.s).collect()
    };
    let rest = at(0.0);
    for pair in rest.chunks_exact(2) {
        assert!((pair[0] - pair[1]).norm() < 1e-9 * pair[0].norm(), "{pair:?}");
    }
    let apart = |omega: f64| -> Vec<Complex> {
        let modes = at(omega);
        let pairs = modes.chunks_exact(2).zip(rest.chunks_exact(2));
        let each = pairs.map(|(pair, rest)| {
            let mean = 0.5 * (pair[0] + pair[1]);
            assert!(
                (mean - rest[0]).norm() < 1e-9 * rest[0].norm() + 1e-4 * omega * omega,
                "{omega} {mean} {}",
                rest[0]
            );
            let half = 0.5 * (pair[0] - pair[1]);
            half * half / (omega * omega)
        });
        each.collect()
    };
    let expected = apart(10.0);
    for omega in [1e-2, 0.1, 0.5, 1.0, 3.0] {
        for (k, (found, expected)) in apart(omega).iter().zip(&expected).enumerate() {
            assert!((found - expected).norm() < 1e-3 * expected.norm(), "{omega} pair {k}: {found} {expected}");
        }
    }
}

/// Slow masses beside a short, fast shaft: the modes are the slowest of all, and one that grows or gives way is seen.
#[test]
fn slow_motions_beside_a_fast_shaft_are_found() {
    for length in [60.0, 400.0, 2000.0] {
        let study = |law: &str| {
            let text = format!(
                "mechanism Few {{
                    material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;
                    body rotor: shaft(along: x, up: z, material: steel, sections: [[{length} mm, 60 mm]]);
                    point a: rotor at root; point b: rotor at tip;
                    point seat0: ground; point seat1: ground at [{length} mm, 0, 0];
                    force left: bushing(from: seat0, to: a, stiffness: [0, 1, 1] MN/m, damping: [0, 10, 10] N*s/m);
                    force right: bushing(from: seat1, to: b, stiffness: [0, 1, 1] MN/m, damping: [0, 10, 10] N*s/m);
                    body mass[0..16]: point(mass: 1 kg);
                    for i in 0..16 {{
                        joint slide[i]: prismatic(x) from ground to mass[i];
                        force soft[i]: spring(on: slide[i], stiffness: (i + 1)^2 * 30 N/m);
                        force slow[i]: damper(on: slide[i], damping: 0.01 N*s/m);
                    }}
                    {law}
                }}"
            );
            Study::new(machine(&text))
        };
        let modes = study("").modes().expect("modes").modes;
        assert_eq!(modes.len(), 12);
        let omega = |n: f64| (30.0 * n * n - 0.005 * 0.005_f64).sqrt();
        for (n, mode) in (1..).zip(&modes) {
            let expected = Complex::new(-0.005, omega(f64::from(n)));
            assert!((mode.s - expected).norm() < 1e-9 * expected.norm(), "{length} {n}: {} {expected}", mode.s);
        }
        let grows = study("force pushed: damper(on: slide[7], damping: -0.02 N*s/m);");
        let stability = grows.equilibrium().expect("a state").stability;
        assert_eq!(stability, Stability::Flutter { growing: 1 }, "{length}");
        let gives = study("force pushed: spring(on: slide[7], stiffness: -2000 N/m);");
        let stability = gives.equilibrium().expect("a state").stability;
        assert_eq!(stability, Stability::Divergent { negative: 1 }, "{length}");
    }
}

/// A table in a file is the same as its rows in the declaration: units above and in cells, comments, quotes and expressions.
#[test]
fn sections_in_a_file_are_those_of_the_declaration() {
    let study = |sections: &str, after: &str| {
        let text = format!(
            "mechanism Tables {{ input omega: rad/s; design wear = 0.3 mm;
                material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;
                material brass: density 8500 kg/m^3, modulus 100 GPa, poisson 0.34;
                body rotor: shaft(along: x, up: z, sections: {sections}) spinning at omega;
                point a: rotor at root; point b: rotor at tip; point seat_a: ground; point seat_b: ground at [380, 0, 0] mm;
                force left: bushing(from: seat_a, to: a, stiffness: [0, 9, 8] MN/m, damping: [0, 1, 1] kN*s/m);
                force right: bushing(from: seat_b, to: b, stiffness: [0, 7, 9] MN/m, damping: [0, 1, 2] kN*s/m); }} {after}"
        );
        Study::new(machine(&text)).input(Input::new(0), 400.0)
    };
    let rows = "[[120 mm, 40 mm, steel], [80 mm, 60 mm + wear, 20 mm, steel], [180 mm, taper(50 mm, 30 mm), brass]]";
    let table = "length [mm]; outer [mm]; inner [mm]; material\n# steps\n120; 40; ; steel\n\n80; 60 mm + wear; 20; steel\n\
        18 cm; taper(50 mm, 30 mm); ; brass\n";
    let commas = "0.12 m, 40 mm, , steel\n80 mm, 60 mm + wear, 20 mm, steel\n180 mm, \"taper(50 mm, 30 mm)\", , brass";
    let expected = study(rows, "").modes().expect("modes").modes;
    for text in [table, commas] {
        let found = study("\"rotor.csv\"", &format!("file \"rotor.csv\" {text:?};")).modes().expect("modes").modes;
        for (a, b) in found.iter().zip(&expected) {
            assert!((a.s - b.s).norm() < 1e-12 * b.s.norm(), "{} {}", a.s, b.s);
        }
    }
}

/// Where a peak is, the vibration is higher than on both sides of it.
#[test]
fn a_peak_is_higher_than_what_is_beside_it() {
    let study = study(2, 1);
    let vibration = Vibration::new(Output::<Interpreted>::new(0), Excitation::new(0));
    let peaks = study.peaks(vibration, Input::new(0), 100.0, 1200.0).expect("peaks").peaks;
    assert!(!peaks.is_empty());
    let height = |speed: f64| {
        let response = study.clone().input(Input::new(0), speed).forced_response().expect("a response");
        response.harmonics[0].outputs[0].expect("an amplitude").norm()
    };
    for peak in &peaks {
        let (place, top) = (peak.place.value, peak.height.value);
        assert!((height(place) / top - 1.0).abs() < 1e-9, "{place}");
        let [before, after] = [-1e-4, 1e-4].map(|part| height(place * (1.0 + part)));
        // A parabola: the top is where both sides are as low.
        let aside = 0.5e-4 * (after - before) / (2.0 * top - before - after);
        assert!(before < top && after < top && aside.abs() < 1e-6, "{place}: {before} {top} {after}, {aside}");
    }
}

/// Spreads of an amplitude at a resonance are those of as many designs, each solved.
#[test]
fn spreads_at_a_resonance_are_those_of_designs() {
    let vibration = Vibration::new(Output::<Interpreted>::new(0), Excitation::new(0));
    for seed in [2, 4] {
        let study = study(seed, 1);
        let peaks = study.peaks(vibration, Input::new(0), 100.0, 1200.0).expect("peaks").peaks;
        // Beside the peak, where the amplitude has a slope.
        let study = study.input(Input::new(0), 1.02 * peaks[0].place.value);
        let nominal = study.description().design[2].nominal;
        let sigma = 0.01 * nominal;
        let spread = study.clone().tolerance(DesignVariable::new(2), 3.0 * sigma);
        let spread = spread.vibration_spread(&[vibration]).expect("a spread");
        let spread = spread.spreads[0].as_ref().expect("a spread");
        let height = |deviation: f64| {
            let response = study.clone().design(DesignVariable::new(2), nominal + deviation).forced_response();
            response.expect("a response").harmonics[0].outputs[0].expect("an amplitude").norm()
        };
        let steps: Vec<f64> = (-20..=20).map(|k| f64::from(k) / 4.0).collect();
        let weights: Vec<f64> = steps.iter().map(|x| (-0.5 * x * x).exp()).collect();
        let heights: Vec<f64> = steps.iter().map(|x| height(x * sigma)).collect();
        let all: f64 = weights.iter().sum();
        let mean = |of: &dyn Fn(f64) -> f64| heights.iter().zip(&weights).map(|(x, w)| of(*x) * w).sum::<f64>() / all;
        let center = mean(&|x| x);
        let deviation = mean(&|x| (x - center).powi(2)).sqrt();
        let found = [spread.mean.value, spread.sigma.expect("a spread").value];
        assert!(deviation > 0.005 * center, "the amplitude hardly changes: {deviation} of {center}");
        assert!((found[0] - center).abs() < 5e-3 * center, "{seed}: {found:?} {center}");
        assert!((found[1] - deviation).abs() < 5e-2 * deviation, "{seed}: {found:?} {deviation}");
    }
}

/// Lists of modes are complete: of a rotor that bends, twists and stretches, with nothing that holds it along and about its axis, and of
/// the same with each section in three, slow, fast and standing still; none of either is missing in the other.
#[test]
fn no_mode_is_missed() {
    for seed in 20..24 {
        let text = |split: usize| {
            let text = rotor(seed, split);
            if seed % 2 == 0 { text.replace("design lag = 4 us", "design lag = 0 us") } else { text }
        };
        let studies = [1, 3].map(|split| Study::new(machine(&text(split))));
        for speed in [0.0, 1.0, 1500.0] {
            let [a, b] = studies.each_ref().map(|study| {
                let study = study.clone().input(Input::new(0), speed);
                study.modes().unwrap_or_else(|error| panic!("{seed} {speed}: {error}")).modes
            });
            assert_eq!([a.len(), b.len()], [12; 2], "{seed} {speed}");
            for (a, b) in a.iter().zip(&b) {
                assert!((a.s - b.s).norm() < 1e-6 * b.s.norm(), "{seed} {speed}: {} {}", a.s, b.s);
            }
        }
    }
}

/// Short thick rotors on bearings that are nearly as stiff in both directions, by a ten-thousandth up to a hundredth: each mode has another
/// one near it, which a Krylov space knows long after the first.
#[test]
fn bearings_that_are_nearly_round_have_modes_in_pairs() {
    for seed in 1..13 {
        let mut random = Random(seed);
        let rows: String = (0..3)
            .map(|_| format!("[{} mm, {} mm],", random.between(80.0, 260.0), random.between(190.0, 360.0)))
            .collect();
        let [stiffness, apart] =
            [random.between(1.0, 12.0), random.between(-4.0, -2.0)].map(|power| 10_f64.powf(power));
        let more = 1.0 + apart;
        let text = format!(
            "mechanism Paired {{ input omega: rad/s;
                material titanium: density 4430 kg/m^3, modulus 114 GPa, poisson 0.33;
                body rotor: shaft(along: x, up: z, material: titanium, sections: [{rows}], lag: 1 us) spinning at omega;
                body disk: rigid(mass: 40 kg, inertia: [0.6, 0.4, 0.4] kg*m^2);
                joint turns: revolute(x) from rotor at station 1 to disk, driven at omega;
                point a: rotor at root; point seat_a: ground;
                force left: bushing(from: seat_a, to: a, stiffness: {stiffness} * [0, 1, {more}] kN/m, damping: [0, 10, 11] kN*s/m,
                    turning_stiffness: {stiffness} * [0, 1, {more}] kN*m/rad); }}"
        );
        let modes = Study::new(machine(&text)).modes().expect("modes").modes;
        assert_eq!(modes.len(), 12, "{seed}");
        for pair in modes.chunks_exact(2) {
            let apart = (pair[0].s.im - pair[1].s.im).abs() / pair[1].s.im;
            assert!(apart < 0.03, "{seed}: {} {}", pair[0].s, pair[1].s);
        }
    }
}

/// Equations that rounding makes singular at an eigenvalue, and beside it the more the slower it is: stretching that nothing else shares,
/// free shafts that turn slowly. From a thousandth to a thousand of the speed there is an answer.
#[test]
fn singular_equations_have_answers() {
    let held = |stiffness: f64| {
        format!(
            "point a: rotor at root; point b: rotor at tip; point seat_a: ground; point seat_b: ground at [650, 0, 0] mm;
            force left: bushing(from: seat_a, to: a, stiffness: {stiffness} * [1, 1, 2] MN/m);
            force right: bushing(from: seat_b, to: b, stiffness: {stiffness} * [0, 1, 2] MN/m);"
        )
    };
    let free = "body disk: rigid(mass: 5 kg, inertia: [0.03, 0.02, 0.02] kg*m^2);
        joint turns: revolute(x) from rotor at station 1 to disk, driven at omega;"
        .to_owned();
    for (lines, around) in [
        ("[bending, stretch]", held(1.0)),
        ("[bending, stretch]", held(1e-4)),
        ("[bending, torsion, stretch]", held(30.0)),
        ("bending", free),
    ] {
        let study = Study::new(machine(&format!(
            "mechanism Singular {{ input omega: rad/s;
                material steel: density 7850 kg/m^3, modulus 205 GPa, poisson 0.29;
                body rotor: shaft(along: x, up: z, material: steel, lines: {lines},
                    sections: [[250 mm, 60 mm], [200 mm, 70 mm], [200 mm, 60 mm]]) spinning at omega;
                {around} }}"
        )));
        for speed in [0.0, 0.001, 0.1, 1.0, 10.0, 100.0, 1000.0] {
            let modes = study.clone().input(Input::new(0), speed).modes();
            let modes = modes.unwrap_or_else(|error| panic!("{lines} {speed}: {error}")).modes;
            assert_eq!(modes.len(), 12, "{lines} {speed}");
        }
    }
}

/// What lags has motions that die away at once, infinitely many: they do not hide the others, nor the speed from which one grows.
#[test]
fn motions_that_die_away_at_once_hide_none() {
    let text = |lag: f64| {
        format!(
            "mechanism Lagging {{ input omega: rad/s;
                material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;
                body rotor: shaft(along: x, up: z, material: steel, lag: {lag} us, sections: [[300 mm, 60 mm], [300 mm, 60 mm]])
                    spinning at omega;
                body disk: disk(mass: 20 kg, radius: 120 mm, axis: x);
                joint turns: revolute(x) from rotor at station 1 to disk, driven at omega;
                point a: rotor at root; point b: rotor at tip; point seat_a: ground; point seat_b: ground at [600, 0, 0] mm;
                force left: bushing(from: seat_a, to: a, stiffness: [0, 9, 8] MN/m, damping: [0, 1, 1] kN*s/m);
                force right: bushing(from: seat_b, to: b, stiffness: [0, 9, 8] MN/m, damping: [0, 1, 1] kN*s/m); }}"
        )
    };
    // With little lag the modes are those without; the damping that it adds grows in proportion.
    let modes = |lag: f64| Study::new(machine(&text(lag))).input(Input::new(0), 200.0).modes().expect("modes").modes;
    let [none, little, much] = [0.0, 1.0, 100.0].map(modes);
    for (none, little) in none.iter().zip(&little).take(2) {
        let added = (little.s - none.s) * 100.0;
        let apart = |own: &eigentol::Mode| (own.s - none.s - added).norm() / added.norm();
        let nearest = much.iter().map(apart).fold(f64::INFINITY, f64::min);
        assert!(nearest < 0.1, "{} and {added} more: {nearest}", none.s);
    }
    let stable = |speed: f64| {
        let study = Study::new(machine(&text(100.0))).input(Input::new(0), speed);
        study.equilibrium().expect("a state").stability == Stability::Stable
    };
    // The limit is between, and is found.
    let study = Study::new(machine(&text(100.0))).input(Input::new(0), 200.0);
    let found = study.flutter_onsets(Input::new(0), 2000.0, 3000.0).expect("onsets").swap_remove(0);
    assert!(stable(0.999 * found.value) && !stable(1.001 * found.value), "{}", found.value);
}
