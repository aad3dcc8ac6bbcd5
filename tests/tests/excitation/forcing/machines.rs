//! Machines of textbooks, and joints in every direction.

use crate::forcing::compared::compare;
use crate::forcing::declared::{Deviation, Frequency, Law, Machine, Motion, v};

use Deviation::{Amount, Eccentricity, Tilt};
use Motion::{Coasting, Driven, Free, Shaken};

fn own(frequency: f64) -> Frequency {
    Frequency::Own(frequency)
}

fn order(order: f64, of: &str) -> Frequency {
    Frequency::Order(order, of.into())
}

fn check(machine: &Machine, excited: usize) {
    for seed in 0..3 {
        let outcome = compare(machine, seed).unwrap_or_else(|mistakes| panic!("{mistakes}\n{}", machine.excited()));
        assert!(outcome.excited >= excited, "{outcome:?}\n{}", machine.excited());
    }
}

const DISK: &str = "disk(mass: 2 kg, radius: 0.4 m, axis: z)";

/// A disk on a shaft that bends.
fn jeffcott() -> Machine {
    let mut m = Machine::default();
    m.body("seat", "massless", v(0.0, 0.0, 0.0))
        .rotor("wheel", DISK, v(0.0, 0.0, 0.0), v(0.0, 0.0, 1.0))
        .joint(
            "joint bend: planar(px: x, py: y, twist: z) from ground to seat",
            &[("/px", Free), ("/py", Free), ("twist", Driven(0.0))],
        )
        .joint("joint spin: revolute(z) from seat to wheel", &[("spin", Driven(7.0))])
        .other("force kx: spring(on: px, stiffness: 300 N/m);")
        .other("force ky: spring(on: py, stiffness: 500 N/m);")
        .other("force c: damper(on: px, damping: 3 N*s/m);")
        .unbalance("wheel", Eccentricity, 0.03, 0.5)
        .output("position(hub).x");
    m.other("point hub: wheel;").reaction("reaction_moment(spin).z", "spin");
    m
}

#[test]
fn jeffcott_rotor() {
    check(&jeffcott(), 2);
}

/// The textbook: `m e Omega^2 (cos, sin)`.
#[test]
fn jeffcott_rotor_in_closed_form() {
    use crate::forcing::compared::results;
    use eigentol::kernels::Kernel;
    let machine = eigentol_interpreter::Interpreted::from_text(&jeffcott().excited()).expect("a declaration");
    let forcing = results(&machine, Kernel::Forcing, &[&[0.1, 0.2], &[], &[]]);
    let force = 2.0 * 0.03 * 49.0;
    let (s, c) = 0.5_f64.sin_cos();
    let expected = [vec![force * c, force * s], vec![7.0], vec![-force * s, force * c]];
    for (found, expected) in [&forcing[0], &forcing[1], &forcing[3]].iter().zip(&expected) {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-13, "{forcing:?}");
        }
    }
}

/// A rigid rotor that tilts on four springs.
#[test]
fn rigid_rotor_on_a_tilting_base() {
    let mut m = Machine::default();
    m.body("base", "box(mass: 3 kg, size: [1, 1, 0.5] m)", v(0.1, 0.0, 0.2))
        .rotor(
            "rotor",
            "cylinder(mass: 5 kg, radius: 0.2 m, length: 0.9 m, axis: z)",
            v(0.0, 0.0, 0.3),
            v(0.0, 0.0, 1.0),
        )
        .joint(
            "joint stand: free(px: x, py: y, pz: z, ra: x, rb: y, rc: z) from ground to base",
            &[("/px", Free), ("/py", Free), ("/pz", Driven(0.0)), ("ra", Free), ("rb", Free), ("rc", Driven(0.0))],
        )
        .joint("joint spin: revolute(z) from base to rotor at [0.1, 0.2, 0.3] m", &[("spin", Driven(-11.0))])
        .other("gravity 9.81 m/s^2 along -z;")
        .other("point left: base at [1, 0.2, 0.1] m;")
        .other("point right: base at [-1, 0.1, 0.3] m;")
        .other("point floor: ground at [0.3, 0.1, -0.4] m;")
        .other("point ceiling: ground at [0.1, 0.1, 2] m;")
        .other("force a: spring_damper(from: left, to: floor, stiffness: 300 N/m, damping: 4 N*s/m);")
        .other("force b: spring_damper(from: right, to: floor, stiffness: 200 N/m);")
        .other("force c: spring_damper(from: left, to: ceiling, stiffness: 100 N/m);")
        .other("force d: spring_damper(from: right, to: ceiling, stiffness: 100 N/m, damping: 1 N*s/m);")
        .unbalance("rotor", Amount(v(0.1, -0.05, 0.4)), 0.02, 0.3)
        .unbalance("rotor", Amount(v(0.0, 0.0, -0.4)), 0.03, 2.3)
        .unbalance("rotor", Tilt, 0.05, -1.0)
        .unbalance("rotor", Eccentricity, 0.02, 4.0)
        .output("position(left).z")
        .output("distance(right, floor)")
        .reaction("reaction_moment(spin).z", "spin");
    check(&m, 4);
}

/// The bearing between base and rotor, welded to the base: force and moment.
#[test]
fn forces_of_a_weld() {
    let mut m = Machine::default();
    m.body("base", "box(mass: 3 kg, size: [1, 1, 0.5] m)", v(0.1, 0.0, 0.2))
        .body("foot", "sphere(mass: 1 kg, radius: 0.1 m)", v(0.2, 0.0, 0.0))
        .rotor(
            "rotor",
            "cylinder(mass: 5 kg, radius: 0.2 m, length: 0.9 m, axis: y)",
            v(0.0, 0.4, 0.0),
            v(0.0, 1.0, 0.0),
        )
        .joint("joint swing: universal(ra: x, rb: z) from ground to base", &[("ra", Free), ("rb", Free)])
        .joint("joint weld: fixed from base to foot at [0.3, 0.1, -0.2] m", &[])
        .released("joint weld: free(wx: x, wy: y, wz: z, wa: x, wb: y, wc: z) from base to foot at [0.3, 0.1, -0.2] m")
        .joint("joint spin: revolute(y) from foot to rotor at [0.1, 0.2, 0.3] m", &[("spin", Driven(9.0))])
        .other("gravity 9.81 m/s^2 along -z;")
        .other("force ka: spring(on: ra, stiffness: 300 N*m/rad);")
        .other("force kb: spring(on: rb, stiffness: 300 N*m/rad);")
        .other("point tip: foot at [0.4, 0, 0] m;")
        .unbalance("rotor", Amount(v(0.0, 0.3, 0.1)), 0.1, 0.3)
        .unbalance("rotor", Tilt, 0.1, 1.0)
        .excite(Law::Load("tip".into(), v(1.0, 2.0, 3.0), v(0.5, -1.0, 0.2)), order(2.5, "spin"), 0.4)
        .excite(Law::On("ra".into(), 3.0), own(8.0), -2.0);
    for (function, prefix) in [("force", ["wx", "wy", "wz"]), ("moment", ["wa", "wb", "wc"])] {
        for (axis, row) in ["x", "y", "z"].iter().zip(prefix) {
            m.reaction(&format!("reaction_{function}(weld).{axis}"), row);
        }
    }
    check(&m, 8);
}

/// Weight across the axis, and a torsion that is free.
#[test]
fn horizontal_rotor() {
    let mut m = Machine::default();
    m.body("hub", "cylinder(mass: 1 kg, radius: 0.1 m, length: 0.3 m, axis: x)", v(0.2, 0.0, 0.0))
        .rotor(
            "wheel",
            "cylinder(mass: 2 kg, radius: 0.4 m, length: 0.3 m, axis: x)",
            v(0.1, 0.0, 0.0),
            v(1.0, 0.0, 0.0),
        )
        .joint("joint spin: revolute(x) from ground to hub", &[("spin", Driven(5.0))])
        .joint("joint twist: revolute(x) from hub to wheel", &[("twist", Free)])
        .other("gravity 9.81 m/s^2 along -z;")
        .other("force k: spring(on: twist, stiffness: 30 N*m/rad);")
        .unbalance("wheel", Eccentricity, 0.1, 0.7)
        .reaction("reaction_moment(spin).x", "spin");
    check(&m, 2);
}

#[test]
fn two_drives_about_one_axis() {
    for (first, second) in [("z", "z"), ("z", "-z"), ("-z", "z")] {
        let sense = if second == "z" { 1.0 } else { -1.0 };
        let mut m = Machine::default();
        m.body("base", "sphere(mass: 3 kg, radius: 0.3 m)", v(0.0, 0.0, 0.0))
            .body("cage", "cylinder(mass: 1 kg, radius: 0.3 m, length: 0.3 m, axis: z)", v(0.0, 0.0, 0.2))
            .rotor("wheel", DISK, v(0.0, 0.0, 0.3), v(0.0, 0.0, sense))
            .joint("joint tilt: universal(ra: x, rb: y) from ground to base", &[("ra", Free), ("rb", Free)])
            .joint(&format!("joint outer: revolute({first}) from base to cage"), &[("outer", Driven(5.0))])
            .joint(&format!("joint inner: revolute({second}) from cage to wheel"), &[("inner", Driven(-3.5))])
            .other("gravity 9.81 m/s^2 along -z;")
            .unbalance("wheel", Amount(v(0.1, 0.0, 0.2)), 0.1, 0.7)
            .reaction(&format!("reaction_moment(outer).z * ({})", if first == "z" { "1" } else { "-1" }), "outer");
        check(&m, 2);
    }
}

#[test]
fn coasting_spin() {
    let mut m = Machine::default();
    m.body("base", "sphere(mass: 3 kg, radius: 0.3 m)", v(0.0, 0.0, 0.0))
        .rotor("wheel", DISK, v(0.0, 0.0, 0.3), v(0.0, 0.0, 1.0))
        .joint("joint tilt: universal(ra: x, rb: y) from ground to base", &[("ra", Free), ("rb", Free)])
        .joint("joint spin: revolute(z) from base to wheel", &[("spin", Coasting)])
        .other("gravity 9.81 m/s^2 along -z;")
        .other("force motor: generalized(on: spin, value: 1 N*m - 0.1 N*m*s * rate(spin));")
        .unbalance("wheel", Amount(v(0.0, 0.0, 0.1)), 0.1, 0.7)
        .unbalance("wheel", Tilt, 0.1, 1.7)
        .excite(Law::On("ra".into(), 2.0), order(3.0, "spin"), 0.4)
        .excite(Law::On("spin".into(), 2.0), order(2.0, "spin"), 0.1);
    check(&m, 3);
}

/// A wheel that coasts on a driven cage.
#[test]
fn coasting_on_a_drive() {
    let mut m = Machine::default();
    m.body("base", "sphere(mass: 3 kg, radius: 0.3 m)", v(0.0, 0.0, 0.0))
        .body("cage", "cylinder(mass: 1 kg, radius: 0.3 m, length: 0.3 m, axis: z)", v(0.0, 0.0, 0.2))
        .rotor("wheel", DISK, v(0.0, 0.0, 0.3), v(0.0, 0.0, 1.0))
        .joint("joint tilt: universal(ra: x, rb: y) from ground to base", &[("ra", Free), ("rb", Free)])
        .joint("joint outer: revolute(z) from base to cage", &[("outer", Driven(5.0))])
        .joint("joint spin: revolute(z) from cage to wheel", &[("spin", Coasting)])
        .other("gravity 9.81 m/s^2 along -x;")
        .other("force motor: generalized(on: spin, value: 1 N*m - 0.1 N*m*s * rate(spin));")
        .unbalance("wheel", Eccentricity, 0.1, 0.7);
    check(&m, 3);
}

#[test]
fn shaken_pendulum_on_a_turntable() {
    for quantity in ["amplitude", "velocity", "acceleration"] {
        for frequency in [own(6.0), order(1.5, "spin")] {
            let mut m = Machine::default();
            m.body("lift", "sphere(mass: 1 kg, radius: 0.1 m)", v(0.0, 0.0, 0.0))
                .body("table", DISK, v(0.0, 0.0, 0.0))
                .body("bar", "rod(mass: 1 kg, length: 1 m, along: z, center: [0, 0, 0])", v(0.0, 0.0, -0.5))
                .joint(
                    "joint heave: prismatic(z) from ground to lift",
                    &[("/heave", Shaken(quantity, 0.3, frequency, 0.4))],
                )
                .joint("joint spin: revolute(z) from lift to table", &[("spin", Driven(3.0))])
                .joint("joint swing: revolute(y) from table to bar at [0.3, 0, 0] m", &[("swing", Free)])
                .other("gravity 9.81 m/s^2 along -z;")
                .other("point tip: bar at [0, 0, -1] m;")
                .output("position(tip).z")
                .reaction("reaction_force(heave).z", "heave");
            check(&m, 3);
        }
    }
}

/// Crank and rocker, shaken at a slide that carries one of the bearings.
#[test]
fn four_bar_with_a_shaken_bearing() {
    let rod = "rod(mass: 1 kg, length: 1 m, along: x, center: [0, 0, 0])";
    let mut m = Machine::default();
    m.body("crank", rod, v(0.5, 0.0, 0.0))
        .body("link", rod, v(0.5, 0.0, 0.0))
        .body("slide", "sphere(mass: 1 kg, radius: 0.1 m)", v(0.0, 0.0, 0.0))
        .body("rocker", rod, v(0.5, 0.0, 0.0))
        .joint("joint a: revolute(y) from ground to crank", &[("a", Free)])
        .joint("joint b: revolute(y) from crank to link at [1, 0, 0] m", &[("b", Free)])
        .joint(
            "joint s: prismatic([1, 0, 1]) from ground to slide at [1.5, 0, 0] m",
            &[("/s", Shaken("amplitude", 0.2, own(9.0), 0.3))],
        )
        .joint("joint d: revolute(y) from slide to rocker", &[("d", Free)])
        .joint("joint c: revolute(y) from link to rocker at [1, 0, 0] m, at [1, 0, 0] m on rocker, cut", &[])
        .other("gravity 9.81 m/s^2 along -z;")
        .other("force k: spring(on: a, stiffness: 30 N*m/rad);")
        .excite(Law::On("b".into(), 2.0), own(9.0), 1.4)
        .reaction("(reaction_force(s).x + reaction_force(s).z) / sqrt(2)", "s");
    check(&m, 5);
}

#[test]
fn gear_train() {
    let mut m = Machine::default();
    m.body("base", "sphere(mass: 3 kg, radius: 0.3 m)", v(0.0, 0.0, 0.0))
        .rotor("pinion", DISK, v(0.0, 0.0, 0.1), v(0.0, 0.0, 1.0))
        .rotor("wheel", DISK, v(0.0, 0.0, 0.2), v(0.0, 0.0, 1.0))
        .joint("joint heave: universal(ra: x, rb: y) from ground to base", &[("ra", Free), ("rb", Free)])
        .joint("joint p: revolute(z) from base to pinion at [1, 0, 0] m", &[("p", Driven(6.0))])
        .joint("joint w: revolute(z) from base to wheel", &[("w", Coasting)])
        .other("gravity 9.81 m/s^2 along -z;")
        .other("constraint mesh: coupling(of: w, with: p, ratio: -0.5);")
        .unbalance("pinion", Eccentricity, 0.1, 0.3)
        .unbalance("wheel", Eccentricity, 0.1, 0.7)
        .excite(Law::On("ra".into(), 2.0), order(20.0, "p"), 0.4)
        .rates_coupled
        .push("mesh".into());
    check(&m, 2);
}

/// Rotors about every axis, declared in both directions, on a base that can do everything.
#[test]
fn axes_and_directions() {
    let axes = [
        ("x", v(1.0, 0.0, 0.0)),
        ("y", v(0.0, 1.0, 0.0)),
        ("-z", v(0.0, 0.0, -1.0)),
        ("-x", v(-1.0, 0.0, 0.0)),
        ("[1, 2, 2]", v(1.0, 2.0, 2.0) / 3.0),
        ("[-1, 0, 3]", v(-1.0, 0.0, 3.0).normalize()),
        ("[0, 1, -3]", v(0.0, 1.0, -3.0).normalize()),
    ];
    for (word, axis) in axes {
        for reversed in [false, true] {
            let (ends, own) = match reversed {
                false => ("from base to wheel at [0.1, 0.2, 0.3] m", axis),
                true => ("from wheel to base, at [0.1, 0.2, 0.3] m on base", -axis),
            };
            let mut m = Machine::default();
            m.body("base", "box(mass: 3 kg, size: [1, 2, 0.5] m)", v(0.1, 0.0, 0.2))
                .rotor("wheel", &format!("disk(mass: 2 kg, radius: 0.4 m, axis: {word})"), axis * 0.3, own)
                .joint(
                    "joint stand: free(px: x, py: y, pz: z, ra: x, rb: y, rc: z) from ground to base",
                    &[("/px", Free), ("/py", Free), ("/pz", Free), ("ra", Free), ("rb", Free), ("rc", Free)],
                )
                .joint(&format!("joint spin: revolute({word}) {ends}"), &[("spin", Driven(4.0))])
                .unbalance("wheel", Amount(v(0.1, -0.05, 0.4)), 0.2, 0.3)
                .unbalance("wheel", Tilt, 0.05, -1.0)
                .unbalance("wheel", Eccentricity, 0.02, 4.0);
            m.kernels_only = true;
            check(&m, 6);
        }
    }
}

/// Spherical and universal joints carry the drive, and a drive is one of several motions of a joint.
#[test]
fn joints_with_several_motions() {
    let rod = "rod(mass: 1 kg, length: 1 m, along: x, center: [0, 0, 0])";
    let mut m = Machine::default();
    m.body("arm", rod, v(0.5, 0.0, 0.0))
        .body("hand", rod, v(0.3, 0.1, 0.0))
        .rotor("drum", "cylinder(mass: 2 kg, radius: 0.4 m, length: 0.2 m, axis: y)", v(0.0, 0.2, 0.0), v(0.0, 1.0, 0.0))
        .joint("joint hip: spherical(ha: z, hb: y, hc: x) from ground to arm", &[("ha", Free), ("hb", Shaken("velocity", 0.2, own(3.0), 0.2)), ("hc", Free)])
        .joint("joint wrist: universal(wa: y, wb: z) from arm to hand at [1, 0, 0] m rotated(z, 0.3 rad)", &[("wa", Free), ("wb", Free)])
        .joint("joint quill: cylindrical(lift: y, turn: y) from hand to drum at [1, 0, 0] m rotated(x, 0.4 rad), at [0, 0.1, 0] m on drum", &[("/lift", Free), ("turn", Driven(8.0))])
        .other("gravity 9.81 m/s^2 along -z;")
        .other("point tip: hand at [1, 1, 1] m;")
        .unbalance("drum", Amount(v(0.1, -0.05, 0.4)), 0.2, 0.3)
        .excite(Law::Load("tip".into(), v(1.0, 0.0, 2.0), v(0.0, 1.0, 0.0)), order(1.0, "turn"), 0.0);
    m.kernels_only = true;
    check(&m, 5);
}

/// A rotor on the ground: only its bearing feels it.
#[test]
fn force_in_a_rigid_bearing() {
    let mut m = Machine::default();
    m.rotor("fan", DISK, v(0.0, 0.0, 0.2), v(0.0, 0.0, 1.0))
        .body("bob", "sphere(mass: 1 kg, radius: 0.1 m)", v(0.0, 0.0, -1.0))
        .joint("joint spin: revolute(z) from ground to fan", &[("spin", Driven(5.0))])
        .released("joint hold: free(wx: x, wy: y, wz: z, spin: z, wa: x, wb: y) from ground to fan")
        .joint("joint swing: revolute(x) from ground to bob", &[("swing", Free)])
        .other("gravity 9.81 m/s^2 along -z;")
        .unbalance("fan", Eccentricity, 0.1, 0.7)
        .reaction("reaction_force(spin).x", "wx")
        .reaction("reaction_force(spin).y", "wy")
        .reaction("reaction_force(spin).z", "wz");
    check(&m, 2);
}
