//! Outputs that have a value but no derivative do not vibrate with the frequency of an excitation. They say so, and leave
//! all others as they are.

use eigentol::forced::{ForcedSensitivities, Measure};
use eigentol::{Error, Input, Output, Study};
use eigentol_interpreter::Interpreted;

/// A wheel with an unbalance on a shaft with equal springs across, whose bearing carries no load at rest.
fn study(outputs: &str) -> Study<Interpreted> {
    let text = format!(
        "mechanism Blower {{
            input speed: rad/s; design mass = 12 kg; design shaft = 1.9 MN/m; design oil = 310 N*s/m;
            body bracket: massless; body hub: massless;
            body wheel: disk(mass: mass, radius: 0.2 m, axis: z);
            joint across: prismatic(x) from ground to bracket;
            joint up: prismatic(y) from bracket to hub;
            joint spin: revolute(z) from hub to wheel, driven at speed;
            every displacement: spring_damper(stiffness: shaft, damping: oil);
            unbalance u: on wheel, eccentricity: 0.04 mm;
            point middle: hub;
            {outputs} }}"
    );
    let machine = Interpreted::from_text(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    Study::new(machine).input(Input::new(0), 377.0)
}

/// What all machines have besides.
const SMOOTH: &str = "output fx = reaction_force(spin).x; output shake = across;";

fn of_smooth(found: &ForcedSensitivities, first: usize) -> Vec<String> {
    let outputs = (first..first + 2).map(Output::new);
    outputs
        .map(|output| {
            let value = found.response.harmonics[0].amplitude(output, Measure::Displacement);
            let slopes = found.complex(0, output, Measure::Displacement);
            format!("{:?} {:?}", value.expect("a value"), slopes.expect("slopes"))
        })
        .collect()
}

#[test]
fn without_derivative_in_any_design() {
    let expected = study(SMOOTH).forced_sensitivities().expect("derivatives");
    let expected = of_smooth(&expected, 0);
    for output in [
        "norm(reaction_force(spin))",
        "2 * norm(reaction_force(spin)) - 1 N",
        "sqrt(dot(reaction_force(spin), reaction_force(spin)))",
        "norm(reaction_force(spin)) * cos(up / (1 m))",
    ] {
        let study = study(&format!("output load = {output}; {SMOOTH}"));
        let found = study.forced_sensitivities().unwrap_or_else(|error| panic!("{output}: {error}"));
        let harmonic = &found.response.harmonics[0];
        assert_eq!(harmonic.outputs[0], None, "{output}");
        assert_eq!(harmonic.shares[0].outputs[0], None, "{output}");
        assert_eq!(found.complex(0, Output::new(0), Measure::Velocity), None);
        assert_eq!(of_smooth(&found, 1), expected, "{output}");
        let text = found.to_string();
        assert!(text.contains("output `load` has a value here but no derivative"), "{text}");
        let json = serde_json::to_string(&found).expect("JSON");
        let back: ForcedSensitivities = serde_json::from_str(&json).expect("a result");
        assert_eq!(back, found);
        let second = study.forced_curvature().expect("second derivatives");
        assert!(second.complex(0, Output::new(0), Measure::Displacement).is_none());
        assert!(second.complex(0, Output::new(1), Measure::Displacement).is_some());
    }
}

/// A length is smooth where it is not zero, and what multiplies it may make up for it where it is.
#[test]
fn with_derivative() {
    for (output, expected) in [
        ("norm(reaction_force(spin) + [0, 0, 1] * 3 N)", 0.0),
        ("norm(reaction_force(spin)) * reaction_force(spin).x / (1 N)", 0.0),
        ("norm(reaction_force(spin) + [1, 0, 0] * 3 N)", 1.0),
    ] {
        let study = study(&format!("output load = {output}; {SMOOTH}"));
        let found = study.forced_sensitivities().expect("derivatives");
        let [load, fx] = [0, 1].map(|k| found.response.harmonics[0].outputs[k].expect("smooth"));
        assert!((load - fx * expected).norm() <= 1e-12 * fx.norm(), "{output}: {load}");
    }
}

/// Where only this design has no derivative, the response leaves the output out, and derivatives name it.
#[test]
fn without_derivative_by_value() {
    let study = study(&format!("output radius = norm(position(middle)); {SMOOTH}"));
    let found = study.forced_response().expect("a response");
    assert_eq!(found.harmonics[0].outputs[0], None);
    assert!(found.harmonics[0].outputs[1].is_some());
    let error = study.forced_sensitivities().expect_err("no derivative");
    assert!(matches!(&error, Error::NotSmooth { output } if output == "radius"), "{error}");
    let text = found.to_string();
    assert!(text.contains("output `radius` has a value here but no derivative"), "{text}");
}
