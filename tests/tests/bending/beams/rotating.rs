//! Cantilevers on a spinning hub.

use eigentol::{DesignVariable, Input, Study};
use serde_json::Value;

use crate::beams::compared::{Bars, compare, design, machine, numbers, parameter, study, truth};

/// A beam with ten coordinates in one plane on a hub; `carried` hangs on its tip.
fn rotating(design: &str, motion: &str, carried: &str) -> String {
    let plane = match motion {
        "flap" => "stiffness_y: EI, bending_y: 10",
        _ => "stiffness_z: EI, bending_z: 10",
    };
    format!(
        "mechanism Rotating {{
            input omega: rad/s; {design}
            body hub: massless;
            joint spin: revolute(z) from ground to hub, driven at omega;
            body blade: beam(length: L, along: x, up: z, mass_per_length: rhoA, {plane});
            joint clamp: fixed from hub to blade at [R, 0, 0];
            {carried}
        }}"
    )
}

const PARAMETERS: [(&str, &str); 4] = [("L", "m"), ("R", "m"), ("EI", "N*m^2"), ("rhoA", "kg/m")];

#[test]
fn uniform_beams_of_every_hub_and_speed() {
    let file = truth(include_str!("../../../truth/flexible/F1_rotating_euler.json"));
    let design = "design R = 1 m; design L = 1 m; design EI = 1 N*m^2; design rhoA = 1 kg/m;";
    for motion in ["flap", "lag"] {
        let machine = machine(&rotating(design, motion, ""));
        let cases = file["dimensionless"].as_array().expect("cases").iter();
        for case in cases.filter(|case| case["motion"] == motion) {
            let number = |name: &str| case[name].as_f64().expect("a number");
            let [delta, gamma] = ["delta", "gamma"].map(number);
            // tension grows with the radius of the hub
            let values: &[f64] = match gamma * (1.0 + delta).sqrt() {
                // ten polynomials resolve the boundary layer at the root less and less
                tension if tension > 20.0 => &[5e-3, 5e-3, 5e-3],
                tension if tension > 12.0 => &[9e-6, 2e-5, 7e-6],
                tension if tension > 6.0 => &[3e-8, 7e-8, 8e-7, 1e-4],
                _ => &[9e-12, 3e-11, 1e-7, 1e-4],
            };
            let bars = Bars { values, first: &[], second: &[] };
            let study = Study::new(machine.clone()).input(Input::new(0), gamma).design(DesignVariable::new(0), delta);
            let what = format!("{motion}, delta {delta}, gamma {gamma}");
            compare(&what, &study, case, &numbers(&case["frequencies"]), &bars);
        }
    }
}

#[test]
fn derivatives_of_uniform_beams() {
    let file = truth(include_str!("../../../truth/flexible/F1_rotating_euler.json"));
    for case in file["dimensional"].as_array().expect("cases") {
        let motion = case["motion"].as_str().expect("a motion");
        let text = rotating(&design(case, &PARAMETERS), motion, "");
        let study = study(&text, Some(parameter(case, "Omega")));
        let bars = Bars { values: &[1e-12, 1e-12, 6e-8], first: &[1e-12, 2e-11], second: &[1e-11, 2e-10] };
        compare(motion, &study, case, &numbers(&case["frequencies"]), &bars);
    }
}

#[test]
fn a_heavy_tip() {
    let file = truth(include_str!("../../../truth/flexible/F2_rotating_tip_mass.json"));
    for case in file["cases"].as_array().expect("cases") {
        let motion = case["motion"].as_str().expect("a motion");
        let all = [&PARAMETERS[..], &[("m", "kg"), ("J", "kg*m^2")]].concat();
        let inertia = match motion {
            "flap" => "[J / 2, J, J / 2]",
            _ => "[J / 2, J / 2, J]",
        };
        let carried =
            format!("body tip: rigid(mass: m, inertia: {inertia}); joint end: fixed from blade at tip to tip;");
        let text = rotating(&design(case, &all), motion, &carried);
        let study = study(&text, Some(parameter(case, "Omega")));
        let bars = Bars { values: &[1e-12, 2e-12, 6e-9], first: &[1e-12, 6e-11], second: &[2e-11, 2e-9] };
        compare(motion, &study, case, &numbers(&case["frequencies"]), &bars);
    }
}

/// A thin blade whose height, or width, or both shrink in proportion; rotary inertia is below 1e-9.
#[test]
fn tapered_beams() {
    let file = truth(include_str!("../../../truth/flexible/F3_rotating_taper.json"));
    let shape = |case: &Value| ["taper", "mass_exponent", "stiffness_exponent"].map(|name| case[name].as_f64());
    let cases = file["dimensionless"].as_array().expect("cases");
    // one machine for all speeds of a shape
    for cases in cases.chunk_by(|a, b| shape(a) == shape(b)) {
        let [taper, mass, stiffness] = shape(&cases[0]).map(|number| number.expect("a number"));
        let (width, height) = match (mass, stiffness) {
            (1.0, 1.0) => (1.0 - taper, 1.0),
            (1.0, 3.0) => (1.0, 1.0 - taper),
            (2.0, 4.0) => (1.0 - taper, 1.0 - taper),
            other => panic!("{other:?}"),
        };
        // EI = E w h^3 / 12 = 1 and rho w h = 1 at the root
        let machine = machine(&format!(
            "mechanism Tapered {{
                input omega: rad/s;
                design w = 1 m; design h = 10 um;
                body hub: massless;
                joint spin: revolute(z) from ground to hub, driven at omega;
                body blade: beam(length: 1 m, along: x, up: z,
                    section: rectangle(width: w, height: h) to rectangle(width: {width} * w, height: {height} * h),
                    density: 1e5 kg/m^3, modulus: 12e15 Pa, bending_y: 10);
                joint clamp: fixed from hub to blade;
            }}"
        ));
        for case in cases {
            let gamma = case["gamma"].as_f64().expect("a number");
            let values: &[f64] = match gamma {
                gamma if gamma > 8.0 => &[1e-6, 1e-6],
                _ => &[1e-8, 1e-8],
            };
            let bars = Bars { values, first: &[], second: &[] };
            let study = Study::new(machine.clone()).input(Input::new(0), gamma);
            compare(&format!("{case}"), &study, case, &numbers(&case["flap"]), &bars);
        }
    }
}
