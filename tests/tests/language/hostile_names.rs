//! Any legal Rust name may be the name of a mechanism or of anything in it, whatever names the generated code and the
//! surrounding modules use.

use eigentol::Kernels;

/// The surroundings of every declaration: items spelt like variables of the generated code.
#[allow(non_upper_case_globals, non_camel_case_types, dead_code)]
mod surroundings {
    pub(super) const theta: f64 = 1.0;
    pub(super) const omega: f64 = 2.0;
    pub(super) const mass: f64 = 2.0;
    pub(super) static m: u8 = 0;
    pub(super) static sin_theta: u8 = 0;
    pub(super) struct sum;
    pub(super) struct product;
    pub(super) struct result;
    pub(super) struct value;
    pub(super) struct zero;
    pub(super) struct q;
    pub(super) struct u;
    pub(super) struct b;
    pub(super) struct real;
    pub(super) struct known;
}

/// A pendulum on a shaft whose input, design variables, coordinate and output have the given names.
macro_rules! pendulum {
    ($module:ident: $name:ident, $omega:ident, $m:ident, $l:ident, $theta:ident, $height:ident) => {
        #[allow(non_upper_case_globals, non_camel_case_types)]
        mod $module {
            #[allow(unused_imports)]
            use super::surroundings::*;

            eigentol::mechanism! {
                pub(super) mechanism $name {
                    input $omega: rad/s;
                    design $m = 3 kg;
                    design $l = 1 m +/- 3%;
                    gravity 9.81 m/s^2 along -z;
                    body shaft: massless;
                    body bar: rod(mass: $m, length: $l, along: -z);
                    joint spin: revolute(z) from ground to shaft, driven at $omega;
                    joint $theta: revolute(y) from shaft to bar;
                    point tip: bar at [0, 0, -$l];
                    output $height = position(tip).z;
                }
            }

            #[test]
            fn is_a_pendulum() {
                super::check(&$name);
                let _: eigentol::Input<$name> = $name::$omega;
                let _: [eigentol::DesignVariable<$name>; 2] = [$name::$m, $name::$l];
                let _: eigentol::Coordinate<$name> = $name::$theta;
                let _: eigentol::Output<$name> = $name::$height;
            }
        }
    };
}

/// Closed forms of a thin bar on a hinge that turns about the vertical:
/// `m l^2/3 (theta'' - omega^2 sin cos) + m g l/2 sin`.
fn check(pendulum: &dyn Kernels) {
    let (q, omega, m, l): (f64, f64, f64, f64) = (0.4, 3.0, 2.0, 0.7);
    let (inputs, design) = ([omega], [m, l]);
    let inertia = m * l * l / 3.0;
    let (sin, cos) = q.sin_cos();
    let rest = m * 9.81 * l / 2.0 * sin - inertia * omega * omega * sin * cos;
    let stiffness = m * 9.81 * l / 2.0 * cos - inertia * omega * omega * (cos * cos - sin * sin);
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} {b}");
    near(pendulum.residual(&[q], &inputs, &design)[0], rest);
    let linear = pendulum.linear(&[q], &inputs, &design);
    near(linear.mass[0][0], inertia);
    near(linear.stiffness[0][0], stiffness);
    near(pendulum.outputs(&[q], &inputs, &design)[0], -l * cos);
    assert!(pendulum.violation(&inputs, &design).is_none());
    let violation = pendulum.violation(&inputs, &[-1.0, l]).expect("a negative mass");
    assert_eq!(violation.value, -1.0);
    assert_eq!(pendulum.description().design.len(), 2);
}

// Parameters and variables of the kernels.
pendulum!(parameters: q, u, b, qdot, result, known);
pendulum!(variables: theta, sum, product, zero, value, sin_theta);
pendulum!(marked: q_, u_, b_, theta_, result_, zero_);
// Names that the kernels refer to.
pendulum!(paths: core, eigentol, std, alloc, crate_, super_);
pendulum!(types: T, f64, usize, u8, bool, str);
pendulum!(prelude: Option, Some, None, Vec, String, Box);
// Members of the trait, and of the traits that the type derives.
pendulum!(members: Mechanism, DESCRIPTION, residual, linear, violation, outputs);
pendulum!(derived: Clone, clone, eq, fmt, default, ne);
pendulum!(results: Linear, mass, stiffness, damping, by_design, by_input);
// Words reserved by Rust only in some places, and names that differ only in case.
pendulum!(weak: union, auto, raw, safe, macro_rules, r);
pendulum!(cases: Theta, THETA, Sum, SUM, tHETA, sUM);

mod unused {
    //! An unreferenced item is a rustc warning, which this lint setting turns into an error.
    #![deny(warnings)]

    #[allow(non_upper_case_globals)]
    pub(super) const spare: f64 = 1.0;

    eigentol::mechanism! {
        #[allow(unused_variables)]
        pub(super) mechanism Spares {
            design spare = 3 kg;
            design SPARE = 1 m;
            gravity 9.81 m/s^2 along -z;
            body bar: rod(mass: 1 kg, length: 1 m, along: -z);
            joint theta: revolute(y) from ground to bar;
        }
    }

    eigentol::mechanism! {
        pub(super) mechanism Meant {
            design _spare = 3 kg;
            gravity 9.81 m/s^2 along -z;
            body bar: rod(mass: 1 kg, length: 1 m, along: -z);
            joint theta: revolute(y) from ground to bar;
        }
    }

    #[test]
    fn are_silent_when_told() {
        let _ = (Spares::spare, Spares::SPARE, Meant::_spare, spare);
    }
}
