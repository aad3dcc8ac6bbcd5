//! Two machines with known positions, and one with every shape.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use eigentol::kernels::DeviatingInputs;
use eigentol::picture::{Scene, Shape, scene};
use eigentol::{Input, Study, equilibrium::assemble};
use eigentol_interpreter::Interpreted;
use eigentol_tests::loops::SliderCrank;

use crate::pictures::space::{difference, norm, subtract};

fn read(text: &str) -> Interpreted {
    Interpreted::from_text(text).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

/// The crank angle determines everything: `x = base + r cos + sqrt(l^2 - (h - r sin)^2)`.
#[test]
fn slider_crank() {
    let study = Study::new(SliderCrank);
    let design = &study.description().design;
    let b: Vec<f64> = design.iter().map(|info| info.nominal).collect();
    let (crank, rod, height, base) = (0.08, 0.2, 0.015, 0.06);
    for angle in [0.2_f64, 0.9, 1.7, -0.8] {
        let (sine, cosine) = angle.sin_cos();
        let rise = height - crank * sine;
        let reach = (rod * rod - rise * rise).sqrt();
        let unknowns = study.description().coordinates.iter();
        let start: Vec<f64> = unknowns
            .map(|unknown| match &*unknown.name {
                "crank_angle" => angle,
                "pin" => rise.atan2(reach) - angle + 0.01,
                "wrist" => -rise.atan2(reach),
                "guide" => crank * cosine + reach,
                _ => 0.0,
            })
            .collect();
        let held = [SliderCrank::crank_angle.any()];
        let closed = assemble(&SliderCrank, &[2.0], &b, &start, &held).expect("it closes");
        let seen = scene(&SliderCrank, &closed.coordinates, &[2.0], &b).expect("a picture");
        let body = |name: &str| {
            let body = seen.bodies.iter().find(|body| body.name == *name);
            body.expect("a body")
        };
        let arm = body("arm").pose;
        assert!(norm(subtract(arm.position, [base, 0.0, 0.0])) < 1e-12);
        let expected = [[cosine, 0.0, -sine], [0.0, 1.0, 0.0], [sine, 0.0, cosine]];
        assert!(difference(arm.rotation.as_flattened(), expected.as_flattened()) < 1e-12);
        let coupler = body("coupler").pose.position;
        let pin = [base + crank * cosine, 0.0, crank * sine];
        assert!(norm(subtract(coupler, pin)) < 1e-12, "{coupler:?} {pin:?}");
        let slider = body("slider").pose.position;
        let expected = [base + crank * cosine + reach, 0.0, height];
        assert!(norm(subtract(slider, expected)) < 1e-9, "{slider:?} {expected:?}");
    }
}

/// The flap axis turns with the pitch, and so on: a chain of multi-axis joints, calculated by hand.
#[test]
fn universal_joint_on_a_screw() {
    let machine = read(
        "mechanism Corkscrew {
            gravity 9.81 m/s^2 along -z;
            body nut: rigid(mass: 2 kg, inertia: [1, 1, 1, 0, 0, 0] kg*m^2);
            body arm: rod(mass: 1 kg, length: 1 m, along: x);
            joint twist: screw(z, lead: 1 m) from ground to nut at [0, 0, 1] m;
            joint hook: universal(flap: y, lag: z) from nut to arm at [0.2, 0, 0] m;
            every angle: spring(stiffness: 100 N*m/rad);
        }",
    );
    let (twist, flap, lag) = (0.3_f64, 0.4_f64, -0.7_f64);
    let seen = scene(&machine, &[twist, flap, lag], &[], &[]).expect("a picture");
    let (s, c) = twist.sin_cos();
    let height = 1.0 + twist / TAU;
    let nut = seen.bodies[0].pose;
    assert!(norm(subtract(nut.position, [0.0, 0.0, height])) < 1e-15);
    let arm = seen.bodies[1].pose;
    assert!(norm(subtract(arm.position, [0.2 * c, 0.2 * s, height])) < 1e-15);
    // x of the arm: Rz(twist) Ry(flap) Rz(lag) e_x
    let (sf, cf) = flap.sin_cos();
    let (sl, cl) = lag.sin_cos();
    let expected = [c * cf * cl - s * sl, s * cf * cl + c * sl, -sf * cl];
    assert!(norm(subtract(arm.direction([1.0, 0.0, 0.0]), expected)) < 1e-15);
    let hook = &seen.joints[1];
    assert_eq!(hook.kind, "universal");
    assert_eq!(hook.from.axis, Some([0.0, 1.0, 0.0]));
    assert_eq!(hook.to.axis, Some([0.0, 0.0, 1.0]));
    assert_eq!((hook.from.body, hook.to.body), (Some(0), Some(1)));
}

fn museum() -> (Interpreted, Scene) {
    let machine = read(
        "mechanism Museum {
            design r = 0.3 m;
            design l = 2 m;
            gravity 9.81 m/s^2 along -z;
            body all: point(mass: 3 kg, center: [1, 2, 3] m)
                + rod(mass: 1 kg, length: l, along: y)
                + disk(mass: 1 kg, radius: r, axis: z, center: [0, 0, l]) at [1 m, 0, 0] rotated(x, 90 deg)
                + cylinder(mass: 1 kg, radius: r, length: l, axis: x)
                + tube(mass: 1 kg, inner: 0.1 m, outer: r, length: l, axis: x)
                + box(mass: 1 kg, size: [1, 2, 3] m) rotated(z, 45 deg)
                + sphere(mass: 1 kg, radius: r)
                + rigid(mass: 12 kg, inertia: [13, 10, 5, 0, 0, 0] kg*m^2)
                - sphere(mass: 0.1 kg, radius: 0.1 m);
            joint slide: prismatic(x) from ground to all;
            point near: all at [r, 0, 0];
            point far: ground at [-1, 0, 0] m;
            force pull: spring_damper(from: far, to: near, stiffness: 100 N/m);
        }",
    );
    let seen = scene(&machine, &[0.5], &[], &[0.3, 2.0]).expect("a picture");
    (machine, seen)
}

#[test]
fn every_shape_is_what_was_declared() {
    let (_, seen) = museum();
    let solids = &seen.bodies[0].solids;
    let (center, shape): (Vec<_>, Vec<_>) = solids.iter().map(|solid| (solid.center, &solid.shape)).unzip();
    assert_eq!((center[0], shape[0]), ([1.0, 2.0, 3.0], &Shape::Point { mass: 3.0 }));
    let rod = Shape::Rod { along: [0.0, 1.0, 0.0], length: 2.0 };
    assert_eq!((center[1], shape[1]), ([0.0, 1.0, 0.0], &rod));
    // z has become -y.
    assert!(norm(subtract(center[2], [1.0, -2.0, 0.0])) < 1e-15, "{center:?}");
    let Shape::Disk { axis, radius } = shape[2] else { panic!("{shape:?}") };
    assert!(norm(subtract(*axis, [0.0, -1.0, 0.0])) < 1e-15 && *radius == 0.3);
    let cylinder = Shape::Cylinder { axis: [1.0, 0.0, 0.0], radius: 0.3, length: 2.0 };
    assert_eq!(shape[3], &cylinder);
    let tube = Shape::Tube { axis: [1.0, 0.0, 0.0], inner: 0.1, outer: 0.3, length: 2.0 };
    assert_eq!(shape[4], &tube);
    let Shape::Box { edges, size } = shape[5] else { panic!("{shape:?}") };
    assert_eq!(*size, [1.0, 2.0, 3.0]);
    let h = FRAC_1_SQRT_2;
    let expected = [[h, h, 0.0], [-h, h, 0.0], [0.0, 0.0, 1.0]];
    assert!(difference(edges.as_flattened(), expected.as_flattened()) < 1e-15);
    assert_eq!(shape[6], &Shape::Sphere { radius: 0.3 });
    let Shape::Ellipsoid { semi_axes, .. } = shape[7] else { panic!("{shape:?}") };
    let expected = [1.0, 2.0, 3.0].map(|edge: f64| edge * (5.0_f64 / 12.0).sqrt());
    assert!(difference(semi_axes, &expected) < 1e-14, "{semi_axes:?}");
    assert_eq!(shape[8], &Shape::Sphere { radius: 0.1 });
    let holes: Vec<bool> = solids.iter().map(|solid| solid.hole).collect();
    assert_eq!(holes, [false, false, false, false, false, false, false, false, true]);
}

#[test]
fn points_and_links_are_what_was_declared() {
    let (_, seen) = museum();
    assert_eq!(seen.bodies[0].pose.position, [0.5, 0.0, 0.0]);
    assert_eq!(seen.points[0].place, [0.3, 0.0, 0.0]);
    assert_eq!((seen.points[0].body, seen.points[1].body), (Some(0), None));
    let link = &seen.links[0];
    assert!(link.name == "pull" && link.kind == "spring_damper");
    assert_eq!(link.ends, [1, 0]);
    // Ends of the point, of the disk, of the box: x from far to the cylinder or the point, z from the box to the point.
    let [low, high] = seen.bounds;
    let box_y = (1.0 + 2.0) / 2.0 * FRAC_1_SQRT_2;
    assert!((low[0] + 1.0).abs() < 1e-15, "{low:?}");
    assert!((high[0] - (0.5 + 1.0 + 0.3)).abs() < 1e-15, "{high:?}");
    assert!((low[1] + 2.0).abs() < 1e-15 && high[1] == 2.0, "{low:?} {box_y}");
    assert!(high[2] == 3.0, "{high:?}");
}

/// Items placed by an input move with the deviation of that input.
#[test]
fn inputs_that_deviate_move_what_they_place() {
    let machine = read(
        "mechanism Ladder {
            input reach: m;
            body arm: rod(mass: 1 kg, length: 1 m, along: x);
            joint lift: revolute(y) from ground to arm at [0, 0, reach];
            force hold: spring(on: lift, stiffness: 3 N*m/rad);
        }",
    );
    let wide = DeviatingInputs::new(&machine, &[Input::new(0)]).expect("an input");
    let seen = scene(&wide, &[0.3], &[2.0], &[0.25]).expect("a picture");
    assert_eq!(seen.bodies[0].pose.position, [0.0, 0.0, 2.25]);
    let expected = scene(&machine, &[0.3], &[2.25], &[]).expect("a picture");
    assert_eq!(seen, expected);
}

#[test]
fn wrong_lists_are_refused() {
    let (machine, _) = museum();
    for (q, b) in [(vec![], vec![0.3, 2.0]), (vec![0.1], vec![0.3])] {
        let error = scene(&machine, &q, &[], &b).unwrap_err();
        assert!(matches!(error, eigentol::Error::WrongLength { .. }), "{error}");
    }
    let error = scene(&machine, &[f64::NAN], &[], &[0.3, 2.0]).unwrap_err();
    assert!(matches!(error, eigentol::Error::OutsideDomain { .. }), "{error}");
}
