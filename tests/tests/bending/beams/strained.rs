//! Beams that shear and stretch.

use eigentol::{DesignVariable, Input, Study};

use crate::beams::compared::{Bars, compare, design, machine, numbers, parameter, study, truth};

const PARAMETERS: [(&str, &str); 5] = [("L", "m"), ("EI", "N*m^2"), ("kGA", "N"), ("rhoA", "kg/m"), ("rhoI", "kg*m")];

/// A thick bar with `shear` and what holds it.
fn thick(design: &str, shear: &str, held: &str) -> String {
    format!(
        "mechanism Thick {{
            {design}
            body bar: beam(length: L, along: x, up: z, mass_per_length: rhoA, stiffness_y: EI, inertia_y: rhoI,
                shear_stiffness_z: kGA, bending_y: 10, shear: {shear});
            {held}
        }}"
    )
}

/// Ten coordinates of bending and nine of shear are exact to many digits; shear that follows from the moments saves the
/// nine, and loses some.
#[test]
fn thick_beams_at_rest() {
    let file = truth(include_str!("../../../truth/flexible/F4_timoshenko_at_rest.json"));
    let bearing = "point tip: bar at tip; point seat: ground at [L, 0, 0];
        constraint slides: coincident(from: seat, to: tip, along: [z]);";
    for case in file["cases"].as_array().expect("cases") {
        let case = &serde_json::json!({
            "parameters": file["parameters"].clone(),
            "frequencies": case["frequencies"].clone(),
            "derivatives": case["derivatives"].clone(),
            "ends": case["ends"].clone(),
        });
        let ends = [&case["ends"][0], &case["ends"][1]].map(|end| end.as_str().expect("an end"));
        let held = match ends {
            ["clamped", "free"] => "joint left: fixed from ground to bar;".to_owned(),
            ["pinned", "pinned"] => {
                format!("joint left: revolute(y) from ground to bar; {bearing}")
            }
            ["clamped", "pinned"] => format!("joint left: fixed from ground to bar; {bearing}"),
            ["clamped", "clamped"] => "joint left: fixed from ground to bar;
                joint right: prismatic(x) from bar at tip to ground at [L, 0, 0] on ground;"
                .to_owned(),
            ["free", "free"] => "joint left: planar(px: x, pz: z, ry: y) from ground to bar;".to_owned(),
            other => panic!("{other:?}"),
        };
        let coordinates = Bars {
            values: &[2e-10, 1e-8],
            first: if ends == ["clamped", "free"] { &[1e-12, 1e-9] } else { &[] },
            second: if ends == ["clamped", "free"] { &[1e-7, 1e-6] } else { &[] },
        };
        let statically = Bars { values: &[1e-4, 1e-3], first: &[], second: &[] };
        for (shear, bars) in [("9", &coordinates), ("static", &statically)] {
            let text = thick(&design(case, &PARAMETERS), shear, &held);
            let study = study(&text, None);
            compare(&format!("{ends:?}, shear {shear}"), &study, case, &numbers(&case["frequencies"]), bars);
        }
    }
}

/// Shear as coordinates on a spinning hub. Where tension acts, shear from the moments alone misses its part.
#[test]
fn thick_beams_that_spin() {
    let file = truth(include_str!("../../../truth/flexible/F5_rotating_timoshenko.json"));
    let of_flap = "bending_y: 10, stiffness_y: 1 N*m^2, inertia_y: I, shear_stiffness_z: S";
    let of_lag = "bending_z: 10, stiffness_z: 1 N*m^2, inertia_z: I, shear_stiffness_y: S";
    for (motion, plane) in [("flap", of_flap), ("lag", of_lag)] {
        for (shear, values) in [("9", &[1e-7, 6e-7][..]), ("static", &[4e-5, 1e-3])] {
            let machine = machine(&format!(
                "mechanism Spun {{
                    input omega: rad/s;
                    design R = 1 m; design I = {} kg*m; design S = {} N;
                    body hub: massless;
                    joint spin: revolute(z) from ground to hub, driven at omega;
                    body bar: beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, {plane}, shear: {shear});
                    joint clamp: fixed from hub to bar at [R, 0, 0];
                }}",
                1.0 / 900.0,
                900.0 / 3.059
            ));
            let bars = Bars { values, first: &[], second: &[] };
            let cases = file["dimensionless"].as_array().expect("cases").iter();
            let cases = cases.filter(|case| case["form"] == "centre line" && case["motion"] == motion);
            for case in cases {
                let number = |name: &str| case[name].as_f64().expect("a number");
                let study = Study::new(machine.clone())
                    .input(Input::new(0), number("gamma"))
                    .design(DesignVariable::new(0), number("delta"));
                let what = format!("{case}, shear {shear}");
                compare(&what, &study, case, &numbers(&case["frequencies"]), &bars);
            }
        }
    }
}

#[test]
fn derivatives_of_thick_beams_that_spin() {
    let file = truth(include_str!("../../../truth/flexible/F5_rotating_timoshenko.json"));
    let parameters = [("L", "m"), ("R", "m"), ("EI", "N*m^2"), ("kGA", "N"), ("rhoA", "kg/m"), ("rhoI", "kg*m")];
    let cases = file["dimensional"].as_array().expect("cases").iter();
    for case in cases.filter(|case| case["form"] == "centre line") {
        let motion = case["motion"].as_str().expect("a motion");
        let plane = match motion {
            "flap" => "bending_y: 10, stiffness_y: EI, inertia_y: rhoI, shear_stiffness_z: kGA",
            _ => "bending_z: 10, stiffness_z: EI, inertia_z: rhoI, shear_stiffness_y: kGA",
        };
        let text = format!(
            "mechanism Spun {{
                input omega: rad/s; {}
                body hub: massless;
                joint spin: revolute(z) from ground to hub, driven at omega;
                body bar: beam(length: L, along: x, up: z, mass_per_length: rhoA, {plane}, shear: 9);
                joint clamp: fixed from hub to bar at [R, 0, 0];
            }}",
            design(case, &parameters)
        );
        let study = study(&text, Some(parameter(case, "Omega")));
        let bars = Bars { values: &[1e-14, 6e-11], first: &[4e-13, 1e-9], second: &[4e-13, 2e-9] };
        let what = format!("derivatives, {motion}");
        compare(&what, &study, case, &numbers(&case["frequencies"]), &bars);
    }
}

/// A bar that only stretches: `b tan b = rhoA L / m`.
#[test]
fn a_bar_in_tension_and_compression() {
    let case = truth(include_str!("../../../truth/flexible/F16_bar_with_tip_mass.json"));
    let parameters = [("L", "m"), ("EA", "N"), ("rhoA", "kg/m"), ("m", "kg")];
    let text = format!(
        "mechanism Bar {{
            {}
            body bar: beam(length: L, along: x, up: z, mass_per_length: rhoA, axial_stiffness: EA, bending: 0,
                stretch: 10);
            joint left: fixed from ground to bar;
            body tip: point(mass: m);
            joint right: fixed from bar at tip to tip;
        }}",
        design(&case, &parameters)
    );
    let bars = Bars { values: &[1e-14, 1e-14, 1e-8], first: &[1e-14, 3e-13], second: &[2e-14, 1e-12] };
    compare("bar", &study(&text, None), &case, &numbers(&case["frequencies"]), &bars);
    assert!(parameter(&case, "m") > 0.0);
}

/// With torsion, taper and twist, static shear stays near shear with coordinates of its own.
#[test]
fn static_shear_of_a_twisted_blade() {
    let frequencies = |shear: &str, height: f64| -> Vec<f64> {
        let text = format!(
            "mechanism Blade {{
                material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;
                body blade: beam(length: 1 m, along: x, up: z,
                    section: rectangle(width: 60 mm, height: {height} mm) to rectangle(width: 40 mm, height: {} mm),
                    material: steel, twist: 40 deg, bending: 7, torsion: 4{shear});
                joint clamp: fixed from ground to blade;
            }}",
            0.7 * height
        );
        let modes = study(&text, None).modes().expect("modes");
        modes.frequencies().into_iter().flatten().take(3).collect()
    };
    for (height, bar) in [(20.0, 2e-4), (40.0, 5e-4)] {
        let [none, statically, own] = ["", ", shear: static", ", shear: 6"].map(|shear| frequencies(shear, height));
        for k in 0..3 {
            let softened = (none[k] - own[k]) / own[k];
            let error = (statically[k] - own[k]).abs() / own[k];
            assert!(softened > 0.0, "shear softens: {none:?} {own:?}");
            assert!(error < bar, "mode {k}: {statically:?} {own:?}");
        }
    }
}
