//! Forced vibration of a rotor with twelve coordinates: every amplitude with all derivatives.

use std::hint::black_box;
use std::process::Command;

use eigentol::{Equilibrium, Study, forced, mechanism};

use crate::facts::{Fact, fastest};

mechanism! {
    /// Three disks between bearings, each with two deflections and two tilts.
    mechanism Rotor {
        input omega: rad/s;
        design k = 2e6 N/m +/- 5 %;
        design c = 300 N*s/m +/- 20 %;
        design shaft = 8e6 N/m +/- 2 %;
        design bend = 4e5 N*m/rad +/- 2 %;
        design m1 = 12 kg +/- 1 %;
        design m2 = 15 kg +/- 1 %;
        design m3 = 9 kg +/- 1 %;
        design e1 = 0.02 mm +/- 50 %;
        design e2 = 0.03 mm +/- 50 %;
        design skew = 0.2 mrad +/- 50 %;
        body a: massless; body b: massless; body c1: massless;
        body disk1: disk(mass: m1, radius: 200 mm, axis: z);
        body disk2: disk(mass: m2, radius: 220 mm, axis: z);
        body disk3: disk(mass: m3, radius: 180 mm, axis: z);
        joint one: free(x1: x, y1: y, z1: z, a1: x, b1: y, t1: z) from ground to a, z1 driven at 0, t1 driven at 0;
        joint two: free(x2: x, y2: y, z2: z, a2: x, b2: y, t2: z) from ground to b at [0, 0, 300 mm], z2 driven at 0, t2 driven at 0;
        joint three: free(x3: x, y3: y, z3: z, a3: x, b3: y, t3: z) from ground to c1 at [0, 0, 600 mm], z3 driven at 0, t3 driven at 0;
        joint spin1: revolute(z) from a to disk1, driven at omega;
        joint spin2: revolute(z) from b to disk2, driven at omega;
        joint spin3: revolute(z) from c1 to disk3, driven at omega;
        point p1: a; point p2: b; point p3: c1;
        point g1: ground; point g3: ground at [0, 0, 600 mm];
        force left: bushing(from: g1, to: p1, stiffness: [k, k, k], damping: [c, c, c]);
        force right: bushing(from: g3, to: p3, stiffness: [k, k, k], damping: [c, c, c]);
        force s12: bushing(from: p1, to: p2, stiffness: [shaft, shaft, 0 N/m], turning_stiffness: [bend, bend, 0 N*m/rad]);
        force s23: bushing(from: p2, to: p3, stiffness: [shaft, shaft, 0 N/m], turning_stiffness: [bend, bend, 0 N*m/rad]);
        unbalance u1: on disk1, eccentricity: e1;
        unbalance u2: on disk2, eccentricity: e2, angle: 40 deg;
        unbalance u3: on disk3, tilt: skew;
        output ox1 = x1; output oy1 = y1; output ox2 = x2; output oy2 = y2; output ox3 = x3; output oy3 = y3;
        output fx = reaction_force(left).x; output fy = reaction_force(left).y;
        output gx = reaction_force(right).x; output gy = reaction_force(right).y;
    }
}

/// Name of the section, for the filter.
pub(crate) const ROTOR: &str = "facts/rotor";

const SPEEDS: usize = 500;

/// Times of 500 speeds at known equilibria, on one thread unless said otherwise.
pub(crate) fn rotor() -> Vec<Fact> {
    let states: Vec<Equilibrium> = (0..SPEEDS)
        .map(|k| {
            let study = Study::new(Rotor).input(Rotor::omega, 50.0 + 2.0 * k as f64);
            study.equilibrium().expect("a rotor stands straight")
        })
        .collect();
    let time = |work: &dyn Fn(&Equilibrium)| {
        let seconds = fastest(5, || states.iter().for_each(work));
        format!("{:.2} ms", 1e3 * seconds)
    };
    let values = time(&|at| {
        let _ = black_box(forced::response(&Rotor, at));
    });
    let slopes = time(&|at| {
        let _ = black_box(forced::sensitivities(&Rotor, at));
    });
    let all = everywhere(&states);
    let numpy = numpy().unwrap_or_else(|| "numpy absent".to_owned());
    let named = |what: &str, value| (format!("{ROTOR}: {what}"), value);
    vec![
        named("10 amplitudes at 500 speeds", values),
        named("the same with all derivatives", slopes),
        named("the same on all processors", all),
        named("the amplitudes alone by numpy.linalg.solve", numpy),
    ]
}

/// The time of all derivatives with the states shared out among all processors, as in a sweep.
fn everywhere(states: &[Equilibrium]) -> String {
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    let share = states.len().div_ceil(processors);
    let seconds = fastest(5, || {
        std::thread::scope(|scope| {
            for chunk in states.chunks(share) {
                scope.spawn(move || {
                    for at in chunk {
                        let _ = black_box(forced::sensitivities(&Rotor, at));
                    }
                });
            }
        });
    });
    format!("{:.2} ms on {processors}", 1e3 * seconds)
}

/// The time numpy takes for the values alone, if it is there.
fn numpy() -> Option<String> {
    const SCRIPT: &str = "
import time, numpy as np
rng = np.random.default_rng(0)
m, c, k = (rng.normal(size=(12, 12)) for _ in range(3))
f, o = rng.normal(size=12) + 0j, rng.normal(size=(10, 12))
def once():
    start = time.perf_counter()
    for w in np.linspace(50, 1050, 500):
        o @ np.linalg.solve(k + 1j * w * c - w * w * m, f)
    return time.perf_counter() - start
print(1e3 * min(once() for _ in range(5)))
";
    let python = std::env::var("EIGENTOL_BENCH_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let found = Command::new(python).args(["-c", SCRIPT]).output().ok()?;
    let time: f64 = String::from_utf8(found.stdout).ok()?.trim().parse().ok()?;
    Some(format!("{time:.2} ms"))
}
