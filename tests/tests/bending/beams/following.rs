//! Cantilevers bent by forces that turn with their sections, against the equations of the elastica integrated from the tip,
//! where everything is known in the axes of the tip.

use eigentol::Study;

use crate::beams::compared::machine;

const STIFFNESS: f64 = 3.0;
const LENGTH: f64 = 1.5;

/// What bends the cantilever: a follower force at the tip, along it and across it, and the same per length.
struct Load {
    tip: [f64; 2],
    along: [f64; 2],
}

/// Place of the tip along and across the root, its slope, and the moment at the root.
type Bent = [f64; 4];

/// The state from the tip towards the root, in the axes of the tip: slope, place, the force and the moment that the part
/// beyond exerts.
fn integrated(load: &Load) -> Bent {
    // by s: slope' = M / EI, place' = (cos, sin), force' = -f(slope), M' = -(cos Fy - sin Fx)
    let rate = |[slope, _, _, fx, fy, moment]: [f64; 6]| {
        let (sine, cosine) = slope.sin_cos();
        let [along, across] = load.along;
        [
            moment / STIFFNESS,
            cosine,
            sine,
            sine * across - cosine * along,
            -(sine * along + cosine * across),
            sine * fx - cosine * fy,
        ]
    };
    let steps = 4000;
    let h = -LENGTH / f64::from(steps);
    let moved = |x: [f64; 6], v: [f64; 6], h: f64| -> [f64; 6] { std::array::from_fn(|i| x[i] + h * v[i]) };
    let mut x = [0.0, 0.0, 0.0, load.tip[0], load.tip[1], 0.0];
    for _ in 0..steps {
        let a = rate(x);
        let b = rate(moved(x, a, h / 2.0));
        let c = rate(moved(x, b, h / 2.0));
        let d = rate(moved(x, c, h));
        let mean = std::array::from_fn(|i| (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]) / 6.0);
        x = moved(x, mean, h);
    }
    // the root is at `x` in the axes of the tip; the tip, in those of the root:
    let [slope, along, across, _, _, moment] = x;
    let (sine, cosine) = slope.sin_cos();
    [-(cosine * along + sine * across), sine * along - cosine * across, -slope, moment]
}

fn found(load: &Load) -> Bent {
    let [[tx, ty], [ax, ay]] = [load.tip, load.along];
    let machine = machine(&format!(
        "mechanism Bent {{
            body blade: beam(length: {LENGTH} m, along: x, up: z, mass_per_length: 0.4 kg/m, stiffness_y: {STIFFNESS} N*m^2,
                bending_y: 10);
            joint clamp: fixed from ground to blade;
            point end: blade at tip;
            force pull: follower(at: end, force: [{tx}, 0, {ty}] N);
            force blow: distributed(on: blade, follower: [{ax}, 0, {ay}] N/m);
            output along = position(end).x;
            output across = position(end).z;
            output root = reaction_moment(clamp).y;
        }}"
    ));
    let study = Study::new(machine);
    let outputs = study.outputs().expect("outputs").values;
    let equilibrium = study.equilibrium().expect("an equilibrium");
    // the first coordinate is the turn of the tip, about y, which lowers z
    [outputs[0], outputs[1], -equilibrium.coordinates[0], outputs[2]]
}

#[test]
fn follower_forces_bend_like_the_elastica() {
    let loads = [
        // a force across the tip
        ([0.0, 2.0], [0.0, 0.0]),
        ([0.4, -1.0], [0.0, 0.0]),
        // a pressure, and a flow along the blade
        ([0.0, 0.0], [0.0, 3.0]),
        ([0.0, 0.0], [-0.5, -2.0]),
        ([-0.3, 1.0], [0.4, 1.0]),
    ];
    for (tip, along) in loads {
        let load = Load { tip, along };
        let (found, expected) = (found(&load), integrated(&load));
        assert!(expected[2].abs() > 0.2, "{expected:?}");
        let what = format!("{tip:?}, {along:?}: {found:?} instead of {expected:?}");
        for k in 0..3 {
            assert!((found[k] - expected[k]).abs() < 1e-8, "{what}");
        }
        // the ground holds the root against what acts beyond it
        assert!((found[3].abs() - expected[3].abs()).abs() < 1e-8, "{what}");
    }
}
