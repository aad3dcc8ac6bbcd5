//! Forces and strains inside beams against the weight, the tension of spin and the stress of what lies farther out.

use crate::beams::compared::study;

fn outputs(text: &str) -> Vec<f64> {
    study(text, None).outputs().expect("outputs").values.to_vec()
}

fn assert_close(value: f64, exact: f64, accuracy: f64) {
    assert!((value - exact).abs() <= accuracy, "{value} {exact}");
}

#[test]
fn the_force_inside_a_bent_beam_is_the_weight_of_its_outer_part() {
    let study = study(
        "mechanism Arm {
            gravity 9.81 m/s^2 along -z;
            body arm: beam(length: 1 m, along: x, up: z, mass_per_length: 1.2 kg/m, stiffness_y: 3 N*m^2, bending_y: 6);
            joint clamp: fixed from ground to arm;
            body pod: point(mass: 0.4 kg);
            joint seat: fixed from arm at tip to pod;
            point gauge: arm at 0.4 length;
            point end: arm at tip;
            output fx = inner_force(gauge).x; output fz = inner_force(gauge).z;
            output ex = inner_force(end).x; output ez = inner_force(end).z;
        }",
        None,
    );
    let values = study.outputs().expect("outputs").values;
    let state = study.equilibrium().expect("it hangs");
    let names = &state.description.coordinates;
    let turn = |name: &str| {
        let place = names.iter().position(|x| &*x.name == name);
        state.coordinates[place.expect("a coordinate")]
    };
    // Of the first part, the first coordinate is the rotation of its end; the second part turns relative to that.
    let (inner, outer) = (turn("arm_1.bend_y[0]"), turn("arm_2.bend_y[0]"));
    assert!(inner > 0.2, "{inner}");
    let pod = 0.4 * 9.81;
    for ([x, z], angle, weight) in
        [([values[0], values[1]], inner, pod + 0.6 * 1.2 * 9.81), ([values[2], values[3]], inner + outer, pod)]
    {
        assert_close(x, weight * angle.sin(), 1e-9);
        assert_close(z, -weight * angle.cos(), 1e-9);
    }
}

#[test]
fn the_force_inside_a_spinning_beam_is_the_pull_of_its_outer_part() {
    let text = "mechanism Blade {
        body hub: massless;
        body blade: beam(length: 0.9 m, along: x, up: z, mass_per_length: 0.7 kg/m, stiffness_y: 30 N*m^2, bending_y: 4);
        joint spin: revolute(z) from ground to hub, driven at 20 rad/s;
        joint clamp: fixed from hub to blade at [0.1 m, 0, 0];
        point gauge: blade at 0.5 length;
        output tension = inner_force(gauge).x;
    }";
    let (from, to): (f64, f64) = (0.1 + 0.45, 1.0);
    let exact = 0.7 * 400.0 * 0.5 * (to.powi(2) - from.powi(2));
    assert_close(outputs(text)[0], exact, 1e-10 * exact);
}

/// What is inside is along the beam, across it and up, however these lie in its frame.
#[test]
fn what_is_inside_has_the_axes_of_the_section() {
    let inside = |along: &str, up: &str, load: &str| {
        outputs(&format!(
            "mechanism Arm {{
                body arm: beam(length: 1 m, along: {along}, up: {up}, mass_per_length: 1 kg/m, stiffness_y: 2 N*m^2,
                    stiffness_z: 3 N*m^2, torsion_stiffness: 1 N*m^2, inertia_y: 1 g*m, inertia_z: 1 g*m, axial_stiffness: 900 N,
                    shear_stiffness_y: 300 N, shear_stiffness_z: 400 N, bending: 3, torsion: 2, stretch: 2, shear: 2);
                joint clamp: fixed from ground to arm;
                point end: arm at tip; point q: arm at 0.4 length;
                force pull: load(at: end, force: {load} mN);
                output a = inner_force(q).x; output b = inner_force(q).y; output c = inner_force(q).z;
                output d = moment(q).y; output e = moment(q).z; output f = strain(q).x; output g = strain(q).y;
                output h = curvature(q).y;
            }}"
        ))
    };
    let expected = inside("x", "z", "[1, 2, 3]");
    assert_close(expected[0], 1e-3, 1e-5);
    assert_close(expected[2], 3e-3, 1e-5);
    for (along, up, load) in
        [("-x", "z", "[-1, -2, 3]"), ("y", "x", "[3, 1, 2]"), ("z", "x", "[3, -2, 1]"), ("-z", "-y", "[2, -3, -1]")]
    {
        for (found, expected) in inside(along, up, load).iter().zip(&expected) {
            assert_close(*found, *expected, 1e-9 * expected.abs());
        }
    }
}

#[test]
fn stretch_and_shear_follow_the_force_inside() {
    let hanging = "mechanism Rope {
        gravity 9.81 m/s^2 along -z;
        body rope: beam(length: 2 m, along: -z, up: x, mass_per_length: 1.5 kg/m, stiffness_y: 4 N*m^2, bending_y: 2,
            axial_stiffness: 5000 N, stretch: 2);
        joint clamp: fixed from ground to rope;
        point a: rope at root; point b: rope at 0.25 length; point c: rope at tip;
        output at_root = strain(a).x; output between = strain(b).x; output at_tip = strain(c).x;
    }";
    let found = outputs(hanging);
    for (strain, above) in found.iter().zip([2.0, 1.5, 0.0]) {
        assert_close(*strain, 1.5 * 9.81 * above / 5000.0, 1e-12);
    }
    let stubby = "mechanism Post {
        gravity [0, 0, 0];
        body post: beam(length: 0.1 m, along: x, up: z, mass_per_length: 1 kg/m, inertia_y: 1e-4 kg*m,
            stiffness_y: 1e5 N*m^2, bending_y: 3,
            shear_stiffness_z: 2e5 N, shear: 3);
        joint clamp: fixed from ground to post;
        point end: post at tip; point middle: post at 0.5 length;
        force push: load(at: end, force: [0, 0, 10] N);
        output shear = strain(middle).z; output inside = inner_force(middle).z;
    }";
    let found = outputs(stubby);
    assert_close(found[1], 10.0, 1e-6);
    assert_close(found[0], 10.0 / 2e5, 1e-10);
}
