//! Pretwisted beams in two planes.

use crate::beams::compared::{Bars, compare, design, numbers, parameter, study, truth};

#[test]
fn pretwisted_beams_at_rest_and_spinning() {
    let file = truth(include_str!("../../../truth/flexible/F6_pretwisted.json"));
    let parameters = [
        ("L", "m"),
        ("R", "m"),
        ("EI1", "N*m^2"),
        ("EI2", "N*m^2"),
        ("rhoA", "kg/m"),
        ("twist", "rad"),
        ("setting", "rad"),
    ];
    let cases = file["at_rest"].as_array().expect("cases").iter();
    for case in cases.chain([&file["rotating"]]) {
        let text = format!(
            "mechanism Twisted {{
                input omega: rad/s; {}
                body hub: massless;
                joint spin: revolute(z) from ground to hub, driven at omega;
                body blade: beam(length: L, along: x, up: z, mass_per_length: rhoA, stiffness_y: EI2,
                    stiffness_z: EI1, bending: 10, twist: twist);
                joint clamp: fixed from hub to blade at [R, 0, 0] rotated(x, setting);
            }}",
            design(case, &parameters)
        );
        let study = study(&text, Some(parameter(case, "Omega")));
        let bars = Bars {
            values: &[3e-11, 2e-9, 2e-5, 6e-4],
            first: &[1e-8, 1e-7, 4e-4, 4e-2],
            second: &[1e-7, 1e-6, 3e-3, 3e-2],
        };
        let what = format!("{}", case["parameters"]);
        compare(&what, &study, case, &numbers(&case["frequencies"]), &bars);
    }
}
