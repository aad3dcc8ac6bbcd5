//! Checks the oracle against short closed-form solutions.

use eigentol_oracle::examples::{
    anisotropic_bearing, blade, jeffcott_in_the_ground, jeffcott_in_the_shaft, screw_pendulum, steadied_by_the_shaft,
    top,
};
use eigentol_oracle::kernels::Kernels;
use eigentol_oracle::model::{Amount, Model, ORIGIN, Part, Placement, Shape, Value, ZERO};
use eigentol_oracle::{Linear, Oracle};

const G: f64 = 9.81;

fn number(number: f64) -> Value {
    Value::Number(number)
}

fn assert_close(values: &[f64], expected: &[f64]) {
    assert_eq!(values.len(), expected.len());
    let scale = expected.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
    for (one, other) in values.iter().zip(expected) {
        assert!((one - other).abs() < 1e-12 * scale, "{values:?}, not {expected:?}");
    }
}

fn at_rest(model: &Model, q: &[f64], u: &[f64]) -> (Vec<f64>, Linear<f64>) {
    let oracle = Oracle::new(model);
    let at = [q, u, &[]];
    (Kernels::residual(&oracle, at), Kernels::linear(&oracle, at))
}

/// `A tilt'' = A W^2 sin cos - C (n + W cos) W sin + m g l sin`, where `A` and `C` are the inertias of the body about
/// the pivot, across and along its axis, `W` is the precession and `n` the spin. Without gravity it precesses steadily
/// where `C n = (A - C) W cos`.
#[test]
fn a_top_precesses_steadily() {
    let (m, r, h, l) = (1.3, 0.25, 0.1, 0.4);
    let shape = || Shape::Cylinder {
        mass: Amount::Mass(number(m)),
        radius: number(r),
        length: number(h),
        axis: [0.0, 0.0, 1.0],
        center: [ZERO, ZERO, number(l)],
    };
    let a = m * (3.0 * r * r + h * h) / 12.0 + m * l * l;
    let c = m * r * r / 2.0;
    let heavy = top(shape(), [ZERO, ZERO, number(-G)]);
    for (tilt, precession, spin) in [(0.3_f64, 2.0, 40.0), (-1.1, 5.0, -3.0), (2.0, -1.5, 12.0)] {
        let (sine, cosine) = tilt.sin_cos();
        let w = precession;
        let (residual, linear) = at_rest(&heavy, &[tilt], &[precession, spin]);
        let moment = c * (spin + w * cosine) * w - a * w * w * cosine - m * G * l;
        assert_close(&residual, &[moment * sine]);
        assert_close(&linear.mass, &[a]);
        assert_close(&linear.damping, &[0.0]);
        let slope = (a - c) * w * w * sine * sine + moment * cosine;
        assert_close(&linear.stiffness, &[slope]);

        let free = top(shape(), ORIGIN);
        let steady = (a - c) * w * cosine / c;
        let (residual, linear) = at_rest(&free, &[tilt], &[precession, steady]);
        assert_close(&residual, &[0.0]);
        assert_close(&linear.stiffness, &[(a - c) * w * w * sine * sine]);
    }
}

/// A blade is a line of particles, `I = sum m r^2`, `S = sum m r`. At flap `b` and lag `z`,
/// `g = [I W^2 sb cb cz^2 - S G cb cz, -I W^2 sb^2 sz cz + S G sb sz]`, `M = I diag(cz^2, 1)`, and the Coriolis
/// coupling is `C12 = -C21 = 2 I W sb cz^2`. Half of it comes from `M Bdot_D u`, the other half from `M Bdot_R qdot_R`,
/// which the linearisation must not omit.
#[test]
fn flap_and_lag_are_coupled() {
    let (m, r, w) = (2.3, 0.9, 4.0);
    let particle = Shape::Point { mass: number(m), center: [number(r), ZERO, ZERO] };
    let rod =
        Shape::Rod { mass: Amount::Density(number(m / r)), length: number(r), along: [1.0, 0.0, 0.0], center: None };
    for (shape, i, s) in [(particle, m * r * r, m * r), (rod, m * r * r / 3.0, m * r / 2.0)] {
        let model = blade(shape);
        for (flap, lag) in [(0.4_f64, -0.3_f64), (-0.9, 0.6)] {
            let ((sb, cb), (sz, cz)) = (flap.sin_cos(), lag.sin_cos());
            let (residual, linear) = at_rest(&model, &[flap, lag], &[w]);
            let flapping = i * w * w * sb * cb * cz * cz - s * G * cb * cz;
            let lagging = -i * w * w * sb * sb * sz * cz + s * G * sb * sz;
            assert_close(&residual, &[flapping, lagging]);
            assert_close(&linear.mass, &[i * cz * cz, 0.0, 0.0, i]);
            let coriolis = 2.0 * i * w * sb * cz * cz;
            assert_close(&linear.damping, &[0.0, coriolis, -coriolis, 0.0]);
            let corner = -2.0 * i * w * w * sb * cb * sz * cz + s * G * cb * sz;
            let flap = i * w * w * (cb * cb - sb * sb) * cz * cz + s * G * sb * cz;
            let lag = -i * w * w * sb * sb * (cz * cz - sz * sz) + s * G * sb * cz;
            assert_close(&linear.stiffness, &[flap, corner, corner, lag]);
        }
    }
}

/// `m (a^2 + h^2) q'' + m G (h sin(rise) + a cos(rise) sin q) = 0` for lead `h` per radian and arm `a`.
#[test]
fn a_screw_pendulum_climbs() {
    let (m, a, h) = (1.7, 0.6, -0.15);
    for rise in [0.0, 0.5, std::f64::consts::FRAC_PI_2] {
        let model = screw_pendulum(m, a, h, rise);
        let q: f64 = 0.8;
        let (residual, linear) = at_rest(&model, &[q], &[]);
        let weight = m * G * (h * rise.sin() + a * rise.cos() * q.sin());
        assert_close(&residual, &[weight]);
        assert_close(&linear.mass, &[m * (a * a + h * h)]);
        assert_close(&linear.stiffness, &[m * G * a * rise.cos() * q.cos()]);
    }
}

const MASS: f64 = 3.0;
const SPIN: f64 = 20.0;

/// In ground coordinates an anisotropic bearing is just two springs, and external damping is ordinary damping.
#[test]
fn a_rotor_on_an_anisotropic_bearing() {
    let model = jeffcott_in_the_ground(MASS, [500.0, 800.0], 2.0);
    let (residual, linear) = at_rest(&model, &[0.01, -0.02], &[SPIN]);
    assert_close(&residual, &[5.0, -16.0]);
    assert_close(&linear.mass, &[MASS, 0.0, 0.0, MASS]);
    assert_close(&linear.damping, &[2.0, 0.0, 0.0, 2.0]);
    assert_close(&linear.stiffness, &[500.0, 0.0, 0.0, 800.0]);
}

/// In shaft coordinates the same bearing rotates: after half a turn it is unchanged, after a quarter turn its
/// stiffnesses are exchanged.
#[test]
fn an_anisotropic_bearing_seen_from_the_shaft_is_not_steady() {
    let model = anisotropic_bearing(MASS, [500.0, 800.0]);
    let at = [&[0.01, -0.02][..], &[0.0], &[]];
    let stiffness = |turn: f64| Kernels::linear(&Oracle::new(&model).with_driven(&[turn]), at);
    let quarter = std::f64::consts::FRAC_PI_2;
    assert_close(&stiffness(0.0).stiffness, &[500.0, 0.0, 0.0, 800.0]);
    assert_close(&stiffness(quarter).stiffness, &[800.0, 0.0, 0.0, 500.0]);
    // k I + dk (cos 2t, -sin 2t; -sin 2t, -cos 2t)
    let (sine, cosine) = (2.0 * 0.4_f64).sin_cos();
    let (mean, half) = (650.0, -150.0);
    let turned = [mean + half * cosine, -half * sine, -half * sine, mean - half * cosine];
    assert_close(&stiffness(0.4).stiffness, &turned);
}

/// In shaft coordinates there are Coriolis and centrifugal forces, and external damping `-c (v + W x p)` couples the
/// displacements. In ground coordinates internal damping `-ci (v - W x p)` couples them, with the opposite sign.
#[test]
fn damping_of_a_rotor_depends_on_where_it_is_fixed() {
    let (k, internal, external) = (700.0, 1.5, 2.0);
    let both = internal + external;

    let model = jeffcott_in_the_shaft(MASS, k, internal, external);
    let (_, linear) = at_rest(&model, &[0.01, -0.02], &[SPIN]);
    let (coriolis, central) = (2.0 * MASS * SPIN, k - MASS * SPIN * SPIN);
    let circulation = external * SPIN;
    assert_close(&linear.mass, &[MASS, 0.0, 0.0, MASS]);
    assert_close(&linear.damping, &[both, -coriolis, coriolis, both]);
    let stiffness = [central, -circulation, circulation, central];
    assert_close(&linear.stiffness, &stiffness);

    let model = steadied_by_the_shaft(MASS, k, internal, external);
    let (_, linear) = at_rest(&model, &[0.01, -0.02], &[SPIN]);
    let circulation = internal * SPIN;
    assert_close(&linear.damping, &[both, 0.0, 0.0, both]);
    assert_close(&linear.stiffness, &[k, circulation, -circulation, k]);
}

/// The same top, with its mass declared in other ways, has the same equations.
#[test]
fn one_body_can_be_declared_in_many_ways() {
    let axis = [0.3, -0.4, 1.2];
    let center = [number(0.1), number(-0.2), number(0.3)];
    let (inner, outer, length, density) = (0.1, 0.25, 0.6, 2000.0);
    let pi = std::f64::consts::PI;
    let mass = density * pi * length * (outer * outer - inner * inner);
    let tube = |amount| Shape::Tube {
        mass: amount,
        inner: number(inner),
        outer: number(outer),
        length: number(length),
        axis,
        center,
    };
    let cylinder = |radius: f64, center| Shape::Cylinder {
        mass: Amount::Density(number(density)),
        radius: number(radius),
        length: number(length),
        axis,
        center,
    };
    let hole = |shape, placement| Part { hole: true, shape, placement };
    // The tensor of the tube about the origin: along and across its axis, then the parallel-axis terms.
    let squares = inner * inner + outer * outer;
    let (along, across) = (mass * squares / 2.0, mass * (3.0 * squares + length * length) / 12.0);
    let e = axis.map(|component| component / 1.3);
    let c = [0.1, -0.2, 0.3];
    let square: f64 = c.iter().map(|x| x * x).sum();
    let entry = |i: usize, j: usize| {
        let same = f64::from(i == j);
        let steiner = mass * (square * same - c[i] * c[j]);
        number(across * same + (along - across) * e[i] * e[j] + steiner)
    };
    let rigid = Shape::Rigid {
        mass: number(mass),
        center,
        inertia: [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)],
        about: Some(ORIGIN),
    };
    // Rotating a bore about its axis makes no difference, nor does where its offset is declared.
    let bore = Placement { offset: center, rotations: vec![(axis, number(0.7))] };
    let bodies = [
        vec![Part::whole(tube(Amount::Mass(number(mass))))],
        vec![Part::whole(tube(Amount::Density(number(density))))],
        vec![Part::whole(cylinder(outer, center)), hole(cylinder(inner, ORIGIN), bore)],
        vec![Part::whole(rigid)],
    ];
    let residuals = bodies.map(|parts| {
        let mut model =
            top(Shape::Point { mass: number(1.0), center: ORIGIN }, [number(1.0), number(2.0), number(-9.0)]);
        model.bodies[0].parts = parts;
        let at = [&[0.7][..], &[2.0, -5.0], &[]];
        Kernels::motion_residual(&Oracle::new(&model), &[1.3], &[-0.8], at)
    });
    for residual in &residuals[1..] {
        let relative = residual[0] / residuals[0][0];
        assert_close(&[relative], &[1.0]);
    }
}
