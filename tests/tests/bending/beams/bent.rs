//! Beams that are far from straight where they vibrate.

use serde_json::Value;

use crate::beams::compared::{Bars, compare, design, numbers, parameter, study, truth};

const PARAMETERS: [(&str, &str); 7] =
    [("L", "m"), ("R", "m"), ("EI", "N*m^2"), ("rhoA", "kg/m"), ("m", "kg"), ("e", "m"), ("beta0", "rad")];

fn planar(case: &Value, coordinates: usize) -> String {
    format!(
        "mechanism Bent {{
            input omega: rad/s; {}
            design g = {} m/s^2; gravity g along -z;
            body hub: massless;
            joint spin: revolute(z) from ground to hub, driven at omega;
            body blade: beam(length: L, along: x, up: z, mass_per_length: rhoA, stiffness_y: EI,
                bending_y: {coordinates});
            joint clamp: fixed from hub to blade at [R, 0, 0] rotated(-y, beta0);
            body tip: point(mass: m) at [e, 0, 0];
            joint end: fixed from blade at tip to tip;
            point end_of_it: blade at tip;
            output height = position(end_of_it).z;
            output root = reaction_moment(clamp).y;
        }}",
        design(case, &PARAMETERS),
        parameter(case, "g")
    )
}

fn compared(case: &Value, coordinates: usize, bars: &Bars<'_>) {
    let study = study(&planar(case, coordinates), Some(parameter(case, "Omega")));
    let values = numbers(&case["values"]);
    let what = format!("{}", case["parameters"]);
    compare(&what, &study, case, &values[4..], bars);
    let outputs = study.outputs().expect("outputs").values;
    for (output, expected) in outputs.iter().zip([values[1], -values[3]]) {
        let error = (output.abs() - expected.abs()).abs();
        assert!(error < 1e-8, "{what}: {output} {expected}");
    }
}

#[test]
fn bent_by_weight_and_spun() {
    let file = truth(include_str!("../../../truth/flexible/F14_bent_equilibrium.json"));
    let bars = Bars { values: &[4e-11, 3e-10, 1e-8], first: &[1e-8, 1e-8], second: &[] };
    for case in file["gravity"].as_array().expect("cases") {
        compared(case, 10, &bars);
    }
    let spinning = &file["spinning"];
    let cases = match spinning.as_array() {
        Some(cases) => cases.iter().collect(),
        None => vec![spinning],
    };
    for case in cases {
        compared(case, 10, &bars);
    }
}

/// Beyond a slope of 60 degrees, six coordinates are enough for five digits of the first frequency.
#[test]
fn few_coordinates_bend_far() {
    let file = truth(include_str!("../../../truth/flexible/F14_bent_equilibrium.json"));
    let case = file["gravity"].as_array().expect("cases").last().expect("a case");
    let study = study(&planar(case, 6), Some(0.0));
    let expected = numbers(&case["values"])[4];
    let modes = study.modes().expect("modes");
    let value = modes.frequencies()[0].expect("a frequency");
    assert!((value / expected - 1.0).abs() < 1e-6, "{value} {expected}");
}

#[test]
fn a_blade_bent_in_space() {
    let file = truth(include_str!("../../../truth/flexible/F18_blade_in_space.json"));
    let parameters = [
        ("L", "m"),
        ("R", "m"),
        ("GJ", "N*m^2"),
        ("EIy", "N*m^2"),
        ("EIz", "N*m^2"),
        ("rhoA", "kg/m"),
        ("j2", "kg*m"),
        ("j3", "kg*m"),
        ("mt", "kg"),
        ("beta0", "rad"),
        ("setting", "rad"),
        ("g", "m/s^2"),
    ];
    for case in file["cases"].as_array().expect("cases") {
        let text = format!(
            "mechanism Blade {{
                input omega: rad/s; {}
                gravity g along -z;
                body hub: massless;
                joint spin: revolute(z) from ground to hub, driven at omega;
                body blade: beam(length: L, along: x, up: z, mass_per_length: rhoA, stiffness_y: EIy,
                    stiffness_z: EIz, torsion_stiffness: GJ, inertia_y: j2, inertia_z: j3, bending: 9, torsion: 9);
                joint clamp: fixed from hub to blade at [R, 0, 0] rotated(-y, beta0) rotated(x, setting);
                body tip: point(mass: mt);
                joint end: fixed from blade at tip to tip;
                point end_of_it: blade at tip;
                output height = position(end_of_it).z;
            }}",
            design(case, &parameters)
        );
        let study = study(&text, Some(parameter(case, "Omega")));
        let listed = &case["derivatives_of_tip_and_frequencies"];
        let derivatives: serde_json::Map<String, Value> = parameters
            .iter()
            .map(|(name, _)| {
                let own = numbers(&listed[*name])[3..].to_vec();
                (name.to_string(), serde_json::json!({ "first": own }))
            })
            .collect();
        let with_derivatives = serde_json::json!({
            "parameters": case["parameters"].clone(),
            "derivatives": derivatives,
        });
        let bars = Bars {
            values: &[5e-10, 6e-9, 1e-9, 8e-10, 4e-6, 1e-5],
            first: &[6e-7, 1e-6, 2e-6, 2e-6, 5e-5, 2e-2],
            second: &[],
        };
        let what = format!("{}", case["parameters"]);
        compare(&what, &study, &with_derivatives, &numbers(&case["frequencies"]), &bars);
        let height = study.outputs().expect("outputs").values[0];
        let expected = numbers(&case["tip_position"])[2];
        assert!((height - expected).abs() < 1e-9, "{height} {expected}");
    }
}
