//! Kinds of modes: of uniform shafts in closed form, of shafts with masses beside their axes, and of blades.

use std::f64::consts::PI;

use eigentol::modes::{Kind, Modes, Sense, Whirl, Whirls};
use eigentol::{Input, Study};
use eigentol_interpreter::Interpreted;

fn study(text: &str, speed: f64) -> Study<Interpreted> {
    let machine = Interpreted::from_text(text).unwrap_or_else(|mistakes| panic!("{text}\n{mistakes:?}"));
    Study::new(machine).input(Input::new(0), speed)
}

fn found(study: &Study<Interpreted>) -> (Modes, Whirls) {
    let modes = study.modes().expect("modes");
    (modes.clone(), study.whirls().expect("kinds"))
}

/// A slender steel shaft in two stiff bearings, along an axis, free to turn and to slide on soft springs.
fn shaft(along: &str, up: &str, placed: &str) -> String {
    format!(
        "mechanism Shaft {{
            input speed: rad/s;
            material steel: density 7850 kg/m^3, modulus 210 GPa, shear_modulus 80 GPa;
            body shaft: beam(length: 1 m, along: {along}, up: {up}, section: circle(radius: 5 mm), material: steel,
                bending: 8, torsion: 7, stretch: 7) spinning at speed;
            joint float: free(px: x, py: y, pz: z, a: x, b: y, c: z) from ground to shaft {placed};
            point root: shaft at root;
            point tip: shaft at tip;
            point seat: ground {placed};
            point other: ground at [1, 0, 0] m;
            force left: bushing(from: seat, to: root, stiffness: [1e3, 1e9, 1e9] N/m);
            force right: bushing(from: other, to: tip, stiffness: [1e3, 1e9, 1e9] N/m);
            force turn: spring(on: a, stiffness: 0.1 N*m/rad);
        }}"
    )
}

/// `(n pi / l)^2 sqrt(E I / (rho A))` in bearings; `n pi / l` times `sqrt(G / rho)` and `sqrt(E / rho)` with free ends.
#[test]
fn a_uniform_shaft_bends_twists_and_stretches() {
    let (modes, whirls) = found(&study(&shaft("x", "z", ""), 50.0));
    let bending = |n: f64| (n * PI).powi(2) * (210e9_f64 / 7850.0).sqrt() * 2.5e-3;
    let twisting = |n: f64| n * PI * (80e9_f64 / 7850.0).sqrt();
    let stretching = |n: f64| n * PI * (210e9_f64 / 7850.0).sqrt();
    let near = |omega: f64, kind: Kind, bar: f64| {
        let pairs = modes.modes.iter().zip(whirls.iter());
        let close = pairs.filter(|(mode, _)| (mode.s.im / omega - 1.0).abs() < bar);
        let whirls: Vec<Whirl> = close.filter_map(|(_, whirl)| *whirl).collect();
        let of_kind = whirls.iter().filter(|whirl| whirl.kind == kind);
        of_kind.copied().collect::<Vec<_>>()
    };
    for n in [1.0, 2.0, 3.0] {
        let pair = near(bending(n), Kind::Lateral, 2e-3);
        let senses: Vec<_> = pair.iter().map(|whirl| whirl.sense()).collect();
        assert_eq!(senses, [Some(Sense::Backward), Some(Sense::Forward)]);
        assert!(pair.iter().all(|x| (x.spin - 50.0).abs() < 1e-9));
    }
    for n in [1.0, 2.0] {
        for (omega, kind) in [(twisting(n), Kind::Torsional), (stretching(n), Kind::Axial)] {
            let [only] = near(omega, kind, 2e-3)[..] else { panic!("{kind} {omega}") };
            assert_eq!((only.ratio, only.sense()), (None, None));
            assert!(only.with_spin < 1e-9 && !only.is_excited_at(50.0));
            assert!(only.is_excited_at(100.0));
        }
    }
}

/// Numbers between 0 and 1.
fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
    (*state >> 11) as f64 / (1_u64 << 53) as f64
}

/// A disk on a shaft that bends and twists, seen from the shaft, with a mass beside the axis.
struct Eccentric {
    mass: f64,
    /// Mass and distance of what is beside the axis.
    lump: [f64; 2],
    inertia: f64,
    stiffness: [f64; 3],
}

impl Eccentric {
    fn new(state: &mut u64) -> Self {
        let mut number = |from: f64, to: f64| from * (to / from).powf(random(state));
        let (mass, inertia) = (number(1.0, 10.0), number(0.02, 0.2));
        let lateral = number(1e4, 1e6);
        // Torsion up to four times as fast or as slow as bending.
        let twist = lateral / mass * inertia * number(1.0 / 16.0, 16.0);
        Self {
            mass,
            lump: [mass * number(0.01, 0.3), number(0.05, 0.2)],
            inertia,
            stiffness: [lateral, lateral * number(1.0, 2.0), twist],
        }
    }

    /// In units of length and mass that are `length` m and `mass` kg, placed in space, with the origin of the body moved.
    fn text(&self, [length, mass]: [f64; 2], placed: &str, [dx, dy, dz]: [f64; 3]) -> String {
        let [lump, distance] = self.lump;
        let [kx, ky, kt] = self.stiffness.map(|k| k / mass);
        let kt = kt / length.powi(2);
        let j = self.inertia / mass / length.powi(2);
        let place = |x: f64, y: f64, z: f64| {
            let [x, y, z] = [x, y, z].map(|x| x / length);
            format!("[{x}, {y}, {z}] m")
        };
        format!(
            "mechanism Eccentric {{
                input speed: rad/s;
                body shaft: massless;
                body one: massless;
                body two: massless;
                body disk: rigid(mass: {} kg, inertia: [{j}, {j}, {j}] kg*m^2, center: {}) + point(mass: {} kg, center: {});
                joint spin: revolute(z) from ground to shaft{placed}, driven at speed;
                joint x: prismatic(x) from shaft to one;
                joint y: prismatic(y) from one to two;
                joint t: revolute(z) from two to disk at {} on disk;
                force kx: spring(on: x, stiffness: {kx} N/m);
                force ky: spring(on: y, stiffness: {ky} N/m);
                force kt: spring(on: t, stiffness: {kt} N*m/rad);
            }}",
            self.mass / mass,
            place(dx, dy, dz),
            lump / mass,
            place(dx + distance, dy, dz),
            place(dx, dy, dz),
        )
    }
}

/// Kinds agree with the energies of the shapes, written for these three coordinates by hand, in any units, orientation
/// and reference point.
#[test]
fn masses_beside_an_axis_mix_bending_and_torsion() {
    let mut state = 7;
    let mut counts = [0; 3];
    for _ in 0..30 {
        let rotor = Eccentric::new(&mut state);
        let slowest = (rotor.stiffness[0] / rotor.mass / 1.3).sqrt();
        let speed = 0.3 * random(&mut state) * slowest;
        let plain = study(&rotor.text([1.0, 1.0], "", [0.0; 3]), speed);
        let (modes, whirls) = found(&plain);
        let at = plain.equilibrium().expect("a steady state").coordinates.clone();
        let mass = rotor.mass + rotor.lump[0];
        let offset = rotor.lump[0] * rotor.lump[1] / mass;
        let inertia = rotor.inertia + rotor.lump[0] * rotor.lump[1].powi(2) - mass * offset * offset;
        let (sin, cos) = at[2].sin_cos();
        let arm = [at[0] + offset * cos, at[1] + offset * sin];
        for (mode, whirl) in modes.modes.iter().zip(whirls.iter()) {
            let whirl = whirl.expect("it spins");
            let s = &mode.shape;
            // Of the centre, less the swing about the axis.
            let x = s[0] - s[2] * (offset * sin) + s[2] * arm[1];
            let y = s[1] + s[2] * (offset * cos) - s[2] * arm[0];
            let lateral = mass * (x.norm_sqr() + y.norm_sqr());
            let reach = arm[0].powi(2) + arm[1].powi(2);
            let torsional = (inertia + mass * reach) * s[2].norm_sqr();
            let share = lateral / (lateral + torsional);
            let kind = match share {
                0.9.. => Kind::Lateral,
                ..=0.1 => Kind::Torsional,
                _ => Kind::Mixed,
            };
            assert_eq!(whirl.kind, kind, "{share}");
            let all = [Kind::Lateral, Kind::Torsional, Kind::Mixed];
            for (count, one) in counts.iter_mut().zip(all) {
                *count += usize::from(kind == one);
            }
            assert_eq!(whirl.sense().is_some(), share >= 0.1);
        }
        for (units, placed, moved) in [
            ([1e-3, 1e-3], "", [0.0; 3]),
            ([1.0, 1.0], " rotated(x, 37 deg) rotated(y, -110 deg)", [0.0; 3]),
            ([1.0, 1.0], "", [0.3, -0.7, 1.1]),
        ] {
            let (_, others) = found(&study(&rotor.text(units, placed, moved), speed));
            for (one, other) in whirls.iter().zip(others.iter()) {
                let (one, other) = (one.expect("a kind"), other.expect("a kind"));
                assert_eq!(one.kind, other.kind, "{units:?} {placed} {moved:?}");
                assert!((one.with_spin - other.with_spin).abs() < 1e-6);
                assert!((one.spin - other.spin).abs() < 1e-9 * speed);
            }
        }
    }
    assert!(counts.iter().all(|count| *count > 5), "{counts:?}");
}

/// Blades hinged or clamped beside a hub that turns are no shafts, whatever their Coriolis forces.
#[test]
fn a_single_blade_does_not_whirl() {
    let mut state = 3;
    for k in 0..12 {
        let mut number = |from: f64, to: f64| from + (to - from) * random(&mut state);
        let (hub, length, stagger) = (number(0.0, 0.3), number(0.2, 0.5), number(-80.0, 80.0));
        let blade = match k % 2 {
            0 => format!(
                "body blade: rod(mass: 1 kg, length: {length} m, along: x);
                joint root: universal(flap: y, lag: z) from hub to blade at [{hub}, 0, 0] m rotated(x, {stagger} deg);
                force flap_spring: spring(on: flap, stiffness: 4 kN*m/rad);
                force lag_spring: spring(on: lag, stiffness: 9 kN*m/rad);"
            ),
            _ => format!(
                "material steel: density 7850 kg/m^3, modulus 206 GPa, poisson 0.3;
                body blade: beam(length: {length} m, along: x, up: z, material: steel, bending: 3,
                    section: rectangle(width: 60 mm, height: 12 mm) to rectangle(width: 30 mm, height: 4 mm));
                joint clamp: fixed from hub to blade at [{hub}, 0, 0] m rotated(x, {stagger} deg);"
            ),
        };
        let text = format!(
            "mechanism Blade {{
                input speed: rad/s;
                body hub: massless;
                joint spin: revolute(z) from ground to hub, driven at speed;
                {blade}
            }}"
        );
        for speed in [10.0, 300.0] {
            let (_, whirls) = found(&study(&text, speed));
            assert!(whirls.iter().all(Option::is_none), "{text}");
        }
    }
}
