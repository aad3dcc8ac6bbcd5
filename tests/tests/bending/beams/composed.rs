//! The same beam, declared in several ways.

use crate::beams::compared::{assert_alike, frequencies, study};

const BAR: &str = "along: x, up: z, mass_per_length: mu, stiffness_y: EI, bending_y: 6);";
const NUMBERS: &str = "design EI = 3 N*m^2; design mu = 1.2 kg/m; design L = 0.9 m; gravity 9.81 m/s^2 along -z;";

/// A mass on the beam splits it: that is the same as two beams in series.
#[test]
fn a_load_splits_a_beam() {
    let split = study(
        &format!(
            "mechanism Split {{ {NUMBERS}
                body bar: beam(length: L, {BAR}
                joint clamp: fixed from ground to bar;
                body middle: point(mass: 0.4 kg);
                joint seat: fixed from bar at 0.4 length to middle;
                point gauge: bar at 0.7 length;
                output height = position(gauge).z;
                output strain = curvature(gauge).y;
            }}"
        ),
        None,
    );
    let series = study(
        &format!(
            "mechanism Series {{ {NUMBERS}
                body inner: beam(length: 0.4 * L, {BAR}
                joint clamp: fixed from ground to inner;
                body outer: beam(length: 0.6 * L, {BAR}
                joint weld: fixed from inner at tip to outer;
                body middle: point(mass: 0.4 kg);
                joint seat: fixed from outer to middle;
                point gauge: outer at 0.5 length;
                output height = position(gauge).z;
                output strain = curvature(gauge).y;
            }}"
        ),
        None,
    );
    assert_alike(&frequencies(&split), &frequencies(&series), 1e-11);
    let values = [&split, &series].map(|x| x.outputs().expect("outputs").values);
    assert_alike(&values[0], &values[1], 1e-10);
}

/// Weight as a force per length is gravity; a follower is not.
#[test]
fn distributed_weight() {
    let of = |law: &str| {
        study(
            &format!(
                "mechanism Weighed {{
                    body bar: beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 3 N*m^2,
                        bending_y: 6);
                    joint hinge: revolute(y) from ground to bar;
                    force spring: spring(on: hinge, stiffness: 9 N*m/rad);
                    {law}
                    point end_of_it: bar at tip;
                    output height = position(end_of_it).z;
                    output support = reaction_force(hinge).z;
                }}"
            ),
            None,
        )
    };
    let per_length = of("force weight: distributed(on: bar, force: [0, 0, -9.81] N/m);");
    let gravity = of("gravity 9.81 m/s^2 along -z;");
    let follower = of("force weight: distributed(on: bar, follower: [0, 0, -9.81] N/m);");
    let values = [&per_length, &gravity, &follower].map(|x| x.outputs().expect("outputs").values);
    assert_alike(&values[0], &values[1], 1e-11);
    assert!((values[2][1] - values[1][1]).abs() > 0.1, "{:?}", values[2]);
    assert_alike(&frequencies(&per_length), &frequencies(&gravity), 1e-8);
}

/// Clamped at both ends with one end free to slide, and a hinge in a loop: `cosh b cos b = 1`, `b^2 = 22.3733`.
#[test]
fn both_ends_held() {
    let held = study(
        "mechanism Held {
            body bar: beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 1 N*m^2, bending_y: 10);
            joint left: fixed from ground to bar;
            joint right: prismatic(x) from bar at tip to ground at [1, 0, 0] m on ground;
        }",
        None,
    );
    let free = study(
        "mechanism Free {
            body bar: beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 1 N*m^2, bending_y: 10);
            joint floating: planar(px: x, pz: z, ry: y) from ground to bar;
        }",
        None,
    );
    for found in [&frequencies(&held), &frequencies(&free)] {
        assert_alike(&found[..3], &[22.373_285_448_061, 61.672_822_868, 120.903_391_727], 2e-5);
        assert!((found[0] - 22.373_285_448_061).abs() < 1e-8, "{}", found[0]);
    }
}

/// A column under its own load: the frequency vanishes at Euler's load, and beyond it the column is bent.
#[test]
fn a_column_buckles_at_the_load_of_euler() {
    let column = |load: f64| {
        study(
            "mechanism Column {
                input load: N;
                body bar: beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 10 N*m^2,
                    bending_y: 6);
                joint left: fixed from ground to bar;
                point end_of_it: bar at tip;
                force press: load(at: end_of_it, force: [-load, 0, 0]);
                output height = position(end_of_it).z;
            }",
            Some(load),
        )
    };
    let critical = std::f64::consts::PI.powi(2) * 10.0 / 4.0;
    let squares = [0.9, 0.99].map(|share| frequencies(&column(share * critical))[0].powi(2));
    // lambda falls to zero almost in a straight line
    let zero = 0.99 + 0.09 * squares[1] / (squares[0] - squares[1]);
    assert!((zero - 1.0).abs() < 2e-4, "{zero}");
}
