//! Special cases of the compiler into which a wrong line was put on purpose and not seen: each meets a number found otherwise.

use eigentol_compiler::compile;
use eigentol_compiler::mechanics::Limits;

/// A kernel of a declaration at its nominal design.
fn at_nominal(declaration: &str, kernel: &str, before: &[&[f64]]) -> Vec<Vec<f64>> {
    let compiled = compile(declaration.parse().expect("tokens"), Limits::NONE)
        .unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let design = compiled.mechanism.design.iter();
    let nominal: Vec<f64> = design.map(|one| one.nominal).collect();
    let arguments = [before, &[&nominal]].concat();
    let found = compiled.program.evaluate(kernel, &arguments);
    found.expect("a kernel")
}

fn assert_equal(found: &[Vec<f64>], expected: &[Vec<f64>]) {
    for (one, other) in found.concat().into_iter().zip(expected.concat()) {
        assert!((one - other).abs() < 1e-13, "{one} {other}");
    }
}

/// Two links on one hinge each, and what closes the loop between their ends.
fn closed(closing: &str) -> String {
    format!(
        "pub mechanism Loop {{
            design l = 1 m;
            design e = 0 m;
            design f = 0 m;
            gravity 9.81 m/s^2 along -z;
            body left: rod(mass: 1 kg, length: l, along: -z);
            body right: box(mass: 2 kg, size: [0.1, 0.2, 0.7] m);
            joint a: universal(a1: x, a2: y) from ground to left;
            joint b: universal(b1: y, b2: z) from ground to right at [0.3, 0, 0] m;
            point eye: left at [0, 0, -l];
            point bolt: right at [0.1, 0.2, -0.3] m;
            {closing}
        }}"
    )
}

/// An axis that may be misaligned, by two variables of nominally nothing: across it there are directions all the same.
#[test]
fn an_axis_nominally_along_x_may_be_tilted() {
    let state: [&[f64]; 2] = [&[0.3, -0.4, 0.5, 0.2, 1.1, -0.7, 0.6, 0.9, -1.2], &[]];
    let joint = |kind: &str, axis: &str| {
        closed(&format!(
            "joint c: {}, cut from left to right at [0, 0, -l], at [0.1, 0.2, -0.3] m;",
            kind.replace("AXIS", axis)
        ))
    };
    let revolute = "revolute(AXIS)";
    let found = at_nominal(&joint(revolute, "[l, e, f]"), "residual", &state);
    assert!(found.concat().iter().all(|x| x.is_finite()), "{found:?}");
    assert_equal(
        &found,
        &at_nominal(&joint(revolute, "x"), "residual", &state),
    );
}

fn messages(declaration: &str) -> Vec<String> {
    match compile(declaration.parse().expect("tokens"), Limits::NONE) {
        Ok(_) => Vec::new(),
        Err(mistakes) => mistakes.iter().map(|one| one.message.clone()).collect(),
    }
}

/// A thin bar that turns about itself moves no mass, however it lies: what rounding leaves of its moment of inertia is not one.
#[test]
fn a_bar_that_turns_about_itself_has_no_inertia() {
    let lengths = [-3.0, -1.0, 0.3, 0.7, 2.0];
    for (x, y, z) in lengths
        .iter()
        .flat_map(|x| lengths.map(|y| (x, y)))
        .flat_map(|(x, y)| lengths.map(|z| (x, y, z)))
    {
        let along = format!("[{x}, {y}, {z}]");
        let alone = format!(
            "mechanism Bar {{
                design l = 1 m;
                body bar: rod(mass: 1 kg, length: l, along: {along});
                joint spin: revolute({along}) from ground to bar;
                force hold: spring(on: spin, stiffness: 1 N*m/rad);
            }}"
        );
        let found = messages(&alone);
        assert_eq!(found.len(), 1, "{along}");
        assert!(
            found[0].starts_with("no mass moves when only `spin` changes"),
            "{found:?}"
        );
    }
}

/// A light slider between two springs, the heavy one on it eleven powers of ten heavier: hard to compute with, but regular.
#[test]
fn a_light_body_below_a_heavy_one_has_its_mass() {
    let text = "mechanism Light {
        body light: point(mass: 1 mg);
        body heavy: point(mass: 200 t);
        joint a: prismatic(x) from ground to light;
        joint b: prismatic(x) from light to heavy;
        force first: spring(on: a, stiffness: 1 N/m);
        force second: spring(on: b, stiffness: 1 N/m);
    }";
    let found = at_nominal(text, "linear", &[&[0.0; 2], &[]]);
    let [light, heavy] = [1e-6, 2e5];
    assert_eq!(found[0], [light + heavy, heavy, heavy, heavy]);
}
