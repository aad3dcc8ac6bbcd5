//! Outputs beyond coordinates and points, in closed form: joint reactions, energies, and the distance from singular
//! poses.

use eigentol::{Mechanism, Study, mechanism};

const G: f64 = 9.81;

mechanism! {
    /// A bar on a spinning shaft, with its hinge declared towards the shaft in the second of two equal copies.
    pub mechanism Swing {
        input omega: rad/s;
        design m = 3 kg +/- 1%;
        design l = 1 m +/- 3%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);
        body twin: rod(mass: m, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
        joint phi: revolute(y) from twin to shaft;
        force stay: spring(on: theta, stiffness: 2 N*m/rad);
        output pull_x = reaction_force(theta).x;
        output pull_z = reaction_force(theta).z;
        output hinge = reaction_moment(theta).y;
        output back_x = reaction_force(phi).x;
        output back_z = reaction_force(phi).z;
        output weight = reaction_force(spin).z;
        output torque = reaction_moment(spin).z;
        output kinetic = kinetic_energy();
        output potential = potential_energy();
    }
}

/// A bar at `theta` from the axis: its centre of mass moves on a circle of radius `l/2 sin(theta)`.
#[test]
fn a_swinging_bar_on_a_turning_shaft() {
    let (omega, m, l) = (4.0_f64, 3.0_f64, 1.0_f64);
    let (theta, phi) = (0.7_f64, 0.3_f64);
    let got = Swing.outputs(&[theta, phi], &[omega], &[m, l]);
    // `theta` turns the bar about y, so its lower end moves to -x; the twin turns against `phi` and moves to +x.
    let centripetal = |angle: f64| m * omega.powi(2) * 0.5 * l * angle.sin();
    let moment_of_inertia = |angle: f64| m * l * l / 3.0 * angle.sin().powi(2);
    let inertia_moment = moment_of_inertia(theta) * omega.powi(2) / theta.tan();
    let weight_moment = m * G * 0.5 * l * theta.sin();
    // The force of `twin` on `shaft`, in the axes of `twin`.
    let on_twin = [-centripetal(phi), m * G];
    let in_twin = [phi.cos() * on_twin[0] + phi.sin() * on_twin[1], -phi.sin() * on_twin[0] + phi.cos() * on_twin[1]];
    let spring = 0.5 * 2.0 * theta * theta;
    let expected = [
        centripetal(theta),
        m * G,
        weight_moment - inertia_moment,
        -in_twin[0],
        -in_twin[1],
        2.0 * m * G,
        0.0,
        0.5 * omega.powi(2) * (moment_of_inertia(theta) + moment_of_inertia(phi)),
        -m * G * 0.5 * l * (theta.cos() + phi.cos()) + spring,
    ];
    for (k, (x, y)) in got.iter().zip(expected).enumerate() {
        assert!((x - y).abs() < 1e-12 * (1.0 + y.abs()), "{}: {x} {y}", Swing::DESCRIPTION.outputs[k].name);
    }
}

mechanism! {
    /// A ball joint with its angles about z, y and x.
    pub mechanism Bracket {
        design side = 40 mm +/- 5 mm;
        gravity 9.81 m/s^2 along -z;
        body bob: point(mass: 1 kg, center: [side, 0, -0.5 m]) + sphere(mass: 1 kg, radius: 0.1 m);
        joint ball: spherical(yaw: z, pitch: y, roll: x) from ground to bob;
        force hold: spring(on: yaw, stiffness: 1 N*m/rad);
        force aim: spring(on: pitch, stiffness: 500 N*m/rad, rest: 89 deg);
        force twist: spring(on: roll, stiffness: 10 N*m/rad);
    }
}

/// The axes z, y (turned by yaw) and x (turned by yaw and pitch) span the volume `|cos(pitch)|`.
#[test]
fn near_singular_poses_are_reported() {
    for pitch in [0.0, 0.5, -1.2, 1.57, 3.0] {
        let pose = Bracket.pose_margin(&[0.4, pitch, -0.8], &[], &[0.04]).expect("a ball joint");
        assert_eq!(pose.joint, "ball");
        assert!((pose.margin - f64::cos(pitch).abs()).abs() < 1e-15);
    }
    assert!(Swing.pose_margin(&[0.1, 0.2], &[1.0], &[3.0, 1.0]).is_none());

    let state = Study::new(Bracket).start(Bracket::pitch, 1.5).equilibrium().expect("a position");
    let pose = state.pose.as_ref().expect("a ball joint");
    assert!((pose.margin - state.coordinates[1].cos().abs()).abs() < 1e-15);
    assert!(pose.margin < 0.1, "{}", pose.margin);
    assert!(state.to_string().contains("ball is near its singular pose"), "{state}");
}

mechanism! {
    /// A bar whose tip is on the axis while it hangs.
    pub mechanism Hanging {
        input omega: rad/s;
        design l = 1 m +/- 3%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: 3 kg, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
        point tip: bar at [0, 0, -l];
        output radius = distance_from_axis(tip, z);
        output height = position(tip).z;
    }
}

/// The distance from the axis has a kink there: it has a value but no derivative, while the other output has both.
#[test]
fn an_output_without_a_derivative_keeps_its_value() {
    let study = Study::new(Hanging).input(Hanging::omega, 2.0);
    let outputs = study.outputs().expect("values");
    assert_eq!(outputs.values, [0.0, -1.0]);
    assert!(outputs.by_design[0].is_none());
    let slopes = outputs.by_design[1].as_ref().expect("derivatives");
    assert_eq!(*slopes, [-1.0]);
    let spread = study.output_tolerances().expect("spreads");
    assert_eq!((spread.values[0], &spread.spreads[0]), (0.0, &None));
    let height = spread.spreads[1].as_ref().expect("a spread");
    assert!((height.sigma - 0.01).abs() < 1e-15);
    let text = spread.to_string();
    assert!(text.contains("height [m]") && text.contains("100.0 %"), "{text}");
}

/// Components of cross products share subexpressions; without sharing, translating a nested tree of them would never
/// finish.
#[test]
fn nested_vector_functions_are_translated_once() {
    let nested = (0..40).fold("[l, 2 * l, 3 * l]".to_owned(), |v, _| format!("cross({v}, w)"));
    let declaration = format!(
        "mechanism Deep {{ design l = 1 m; let w = [1, 2, l / (1 m)]; gravity 9.81 m/s^2 along -z;
         body bar: rod(mass: 1 kg, length: l, along: -z); joint theta: revolute(y) from ground to bar;
         output o = norm({nested}) / (1 m); }}"
    );
    eigentol_compiler::program(declaration.parse().expect("tokens")).unwrap_or_else(|mistakes| panic!("{mistakes}"));
}

mod constants {
    /// A constant in the user's module with the name of a design variable, and a mechanism named like one.
    pub(super) const G: f64 = 9.81;

    eigentol::mechanism! {
        pub(super) mechanism L {
            design L = 1 m;
            design G = 9.81 m/s^2;
            design least = 2 kg;
            gravity G along -z;
            body bar: rod(mass: least, length: L, along: -z);
            joint theta: revolute(y) from ground to bar;
            output tiny = 1e200 * (1e200 * (L / (1e300 m)));
        }
    }

    macro_rules! doubled {
        ($name:ident, $value:expr) => {
            eigentol::mechanism! {
                pub(super) mechanism $name {
                    design f = $value * 2;
                    gravity 9.81 m/s^2 along -z;
                    body bar: rod(mass: f * 1 kg, length: 1 m, along: -z);
                    joint theta: revolute(y) from ground to bar;
                }
            }
        };
    }
    doubled!(Doubled, 1.0 + 2.0);
}

#[test]
fn names_of_the_users_module_are_no_patterns() {
    let expected = 2.0 * constants::G * 0.5 * f64::sin(0.3);
    let got = constants::L.residual(&[0.3], &[], &[1.0, 9.81, 2.0])[0];
    assert!((got - expected).abs() < 1e-14);
}

#[test]
fn a_fragment_of_macro_rules_belongs_together() {
    assert_eq!(constants::Doubled::DESCRIPTION.design[0].nominal, 6.0);
}

mechanism! {
    /// A coordinate driven at zero is locked: an anisotropic spring to the ground may act beyond it.
    pub mechanism Locked {
        gravity 9.81 m/s^2 along -z;
        body bar: rod(mass: 3 kg, length: 1 m, along: -z);
        joint swing: universal(turn: z, tilt: y) from ground to bar, turn driven at 0;
        point tip: bar at [0, 0, -1 m];
        point hook: ground at [1 m, 0, 0];
        force side: spring_damper(from: tip, to: hook, stiffness: 10 N/m);
        output pull = reaction_force(swing).z;
    }
}

#[test]
fn a_coordinate_driven_at_zero_is_locked() {
    let state = Study::new(Locked).start(Locked::tilt, 0.1).equilibrium().expect("a position");
    assert!(state.stability.holds());
}
