//! A compiled rotor: its handles, and the same numbers as the interpreter's, also side by side.

use eigentol::Study;
use eigentol_interpreter::Interpreted;

macro_rules! both {
    ($name:ident, $($declaration:tt)*) => {
        eigentol::mechanism! { $($declaration)* }
        const $name: &str = stringify!($($declaration)*);
    };
}

both! { GROUND,
    part Blade(kl: N*m/rad) {
        design cl = 4000 N*m*s/rad +/- 10%;
        port root;
        body arm: rigid(mass: 95 kg, inertia: [0, 204, 204] kg*m^2, center: [3, 0, 0] m);
        joint lag: revolute(z) from root to arm at [0.3, 0, 0] m;
        force hinge: spring(on: lag, stiffness: kl);
        force damp: damper(on: lag, damping: cl);
    }
    mechanism Ground {
        input omega: rad/s;
        design kx = 1.2e6 N/m +/- 5%;
        design kl = 2e4 N*m/rad +/- 5%;
        gravity 9.81 m/s^2 along -z;
        body frame: point(mass: 4000 kg);
        body mast: point(mass: 3000 kg);
        body hub: massless;
        joint x: prismatic(x) from ground to frame;
        joint y: prismatic(y) from frame to mast;
        joint spin: revolute(z) from mast to hub, driven at omega;
        force sx: spring(on: x, stiffness: kx);
        force sy: spring(on: y, stiffness: 1.5 * kx);
        force dx: damper(on: x, damping: 4e4 N*s/m);
        force dy: damper(on: y, damping: 3e4 N*s/m);
        cyclic blade[0..5] about z { use blade: Blade(kl: kl) with root: hub; }
    }
}

#[test]
fn a_compiled_rotor_has_the_numbers_of_the_interpreter() {
    let compiled = Study::new(Ground).input(Ground::omega, 25.0).samples(500);
    let handle = Ground::blades.lag.cosine._2;
    assert_eq!(compiled.description().coordinates[handle.index()].name, *"blades.lag.cosine[2]");
    assert_eq!(compiled.description().design[Ground::blade[3].cl.index()].name, *"blade[3].cl");
    let text = Interpreted::from_text(GROUND).expect("a declaration");
    let read = Study::new(text).input(eigentol::Input::new(0), 25.0).samples(500);
    let [one, other] = [compiled.modes(), read.modes()].map(|modes| modes.expect("modes"));
    for (one, other) in one.modes.iter().zip(&other.modes) {
        assert!((one.s - other.s).norm() < 1e-12 * other.s.norm(), "{} {}", one.s, other.s);
    }
    let [one, other] = [compiled.summary(), read.summary()].map(|summary| summary.expect("a summary").to_string());
    assert_eq!(one, other);
    let [one, other] = [compiled.monte_carlo(), read.monte_carlo()].map(|run| run.expect("samples"));
    for (one, other) in one.modes.iter().zip(&other.modes) {
        let [one, other] = [one, other].map(|of| of.as_ref().map_or(0.0, |of| of.mean));
        assert!((one - other).abs() <= 1e-9 * other, "{one} {other}");
    }
}
