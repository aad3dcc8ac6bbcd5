//! Eight blades on a disc at rest, tuned and mistuned, in closed form.

use super::*;
use std::path::Path;

fn truth() -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("truth/flexible/F17_bladed_disc.json");
    serde_json::from_str(&std::fs::read_to_string(path).expect("values")).expect("JSON")
}

fn disc(truth: &Value, deviations: &[f64]) -> Study<Interpreted> {
    let of = |name: &str| number(&truth["parameters"][name]);
    let text = format!(
        "part Blade(J: kg*m^2) {{
            design k = {:?} N*m/rad;
            port root;
            body arm: rigid(mass: 1 kg, inertia: [J / 2, J / 2, J]);
            joint flap: revolute(z) from root to arm;
            force hinge: spring(on: flap, stiffness: k);
        }}
        mechanism Disc {{
            design kc = {:?} N*m/rad;
            design J = {:?} kg*m^2;
            body disk: massless;
            joint seat: fixed from ground to disk;
            cyclic blade[0..8] about z {{ use blade: Blade(J: J) with root: disk at [50 mm, 0, 0]; }}
            for i in 0..8 {{
                force tie[i]: potential(energy: kc * (blade[i].flap - blade[(i + 1) % 8].flap)^2 / 2);
            }}
        }}",
        of("k"),
        of("kc"),
        of("J")
    );
    let mut study = study(&text);
    for (k, deviation) in deviations.iter().enumerate() {
        let place = design(&study, &format!("blade[{k}].k"));
        study = study.design(eigentol::DesignVariable::new(place), of("k") * (1.0 + deviation));
    }
    study
}

#[test]
fn a_tuned_disc_has_nodal_diameters() {
    let truth = truth();
    let study = disc(&truth, &[]);
    let expected = numbers(&truth["tuned"]);
    let whirls = study.whirls().expect("kinds");
    let found = study.modes().expect("modes").frequencies();
    for (frequency, whirl) in found.iter().zip(whirls.iter()) {
        let pattern = whirl.and_then(|whirl| whirl.blades).expect("a pattern");
        let own = expected[pattern.nodal_diameters];
        assert!((frequency.expect("it oscillates") - own).abs() < 1e-12 * own, "{pattern:?}");
        assert!(pattern.share > 1.0 - 1e-12, "{pattern:?}");
    }
    let names: Vec<String> = whirls.iter().map(|whirl| whirl.expect("a kind").to_string()).collect();
    let pairs = ["1 diameter", "2 diameters", "3 diameters"].into_iter().flat_map(|name| [name; 2]);
    let names_expected: Vec<&str> = ["collective"].into_iter().chain(pairs).chain(["differential"]).collect();
    assert_eq!(names, names_expected);
}

#[test]
fn a_mistuned_disc_has_derivatives_by_each_blade() {
    let truth = truth();
    let deviations = numbers(&truth["deviations"]);
    let study = disc(&truth, &deviations);
    let expected = numbers(&truth["mistuned"]);
    let k = number(&truth["parameters"]["k"]);
    let found = study.modes().expect("modes").frequencies();
    for (r, expected) in expected.iter().enumerate() {
        let frequency = found[r].expect("it oscillates");
        assert!((frequency - expected).abs() < 1e-12 * expected, "{r}: {frequency}");
    }
    for blade in 0..8 {
        let by = derivatives(&study, &format!("blade[{blade}].k"));
        for (r, by) in by.into_iter().enumerate() {
            let expected = number(&truth["mistuned_derivatives"][blade][r]) / k;
            close(by.expect("simple"), Complex::new(0.0, expected), 1e-10, 1e-3, &format!("{blade} {r}"));
        }
    }
}

#[test]
fn blades_that_are_not_equal_are_refused() {
    let text = |extra: &str| {
        format!(
            "mechanism Disc {{
                body disk: massless;
                joint seat: fixed from ground to disk;
                body arm[0..3]: rod(mass: 1 kg, length: 1 m, along: x);
                joint flap[0]: revolute(z) from disk to arm[0];
                joint flap[1]: revolute(z) from disk to arm[1] rotated(z, 120 deg);
                joint flap[2]: revolute(z) from disk to arm[2] rotated(z, 240 deg);
                for i in 0..3 {{ force hinge[i]: spring(on: flap[i], stiffness: 1 N*m/rad); }}
                {extra}
                cyclic flap[0..3] about z;
            }}"
        )
    };
    study(&text(""));
    let mistake = Interpreted::from_text(&text("force more: spring(on: flap[1], stiffness: 1 N*m/rad, rest: 0.1);"));
    let mistake = mistake.map(drop).expect_err("refused").to_string();
    assert!(mistake.contains("`flap[1]` feels other forces than `flap[0]`"), "{mistake}");
}
