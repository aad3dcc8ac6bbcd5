//! Tolerances: from the written form to SI values.

use eigentol_compiler::model::mechanism::{Law, Mechanism, Tolerance};
use eigentol_compiler::model::resolve::resolve;
use eigentol_compiler::syntax::print::print;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::common::{read, resolved};

fn with_item(item: &str) -> Mechanism {
    resolved(&format!(
        "mechanism Bar {{ {item} body bar: rod(mass: 3 kg, length: 1 m, along: -z); joint theta: revolute(y) from ground to bar; }}"
    ))
}

/// Nominal value and tolerance of a design variable.
fn design(value: &str) -> (f64, Tolerance) {
    let mechanism = with_item(&format!("design x = {value};"));
    let variable = &mechanism.design[0];
    (variable.nominal, variable.tolerance.clone())
}

fn input(unit: &str) -> Tolerance {
    with_item(&format!("input x: {unit};")).inputs[0].tolerance.clone()
}

fn tolerance(upper: f64, lower: f64, law: Law) -> Tolerance {
    Tolerance { lower, upper, relative: false, law }
}

fn assert_near(tolerance: Tolerance, expected: Tolerance, what: &str) {
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-15 * a.abs().max(b.abs());
    assert!(
        near(tolerance.lower, expected.lower)
            && near(tolerance.upper, expected.upper)
            && tolerance.law == expected.law
            && tolerance.relative == expected.relative,
        "{what}: {tolerance:?}"
    );
}

#[test]
fn limits_of_a_design_variable_are_in_si() {
    for (text, nominal, upper, lower) in [
        ("1 m", 1.0, 0.0, 0.0),
        ("1 m +/- 3%", 1.0, 0.03, -0.03),
        ("2 m +/- 3 mm", 2.0, 3e-3, -3e-3),
        ("-2 m +/- 1%", -2.0, 0.02, -0.02),
        // As on drawings: the unit once, or after each number.
        ("20 mm +0.1 -0 mm", 0.02, 1e-4, 0.0),
        ("20 mm +0.1 mm -0.05 mm", 0.02, 1e-4, -5e-5),
        ("20mm +0.1mm -50um", 0.02, 1e-4, -5e-5),
        ("-20 mm +0.1 -0.2 mm", -0.02, 1e-4, -2e-4),
        // Both limits of one sign: the fits f7, p6 and h6 of 20 mm.
        ("20 mm -0.020 -0.041 mm", 0.02, -2e-5, -4.1e-5),
        ("20 mm +0.035 +0.022 mm", 0.02, 3.5e-5, 2.2e-5),
        ("20 mm 0 -0.013 mm", 0.02, 0.0, -1.3e-5),
        ("20 mm +0.021 0 mm", 0.02, 2.1e-5, 0.0),
        ("20 mm +0.021 mm 0", 0.02, 2.1e-5, 0.0),
        ("20 mm 0 -0.013 mm", 0.02, 0.0, -1.3e-5),
        ("3 kg +2 -1 %", 3.0, 0.06, -0.03),
        ("3 kg +2% -1%", 3.0, 0.06, -0.03),
        ("3 kg 0 -1%", 3.0, 0.0, -0.03),
        ("3 kg +2% 0", 3.0, 0.06, 0.0),
        // The upper limit is the greater one, also for a negative value.
        ("-5 mm +2 -1 %", -5e-3, 1e-4, -5e-5),
        ("7 +0.5 -0.25", 7.0, 0.5, -0.25),
        ("5 1/s +1 -2 1/s", 5.0, 1.0, -2.0),
        ("30 deg +1 -0.5 mrad", 30f64.to_radians(), 1e-3, -5e-4),
        // The value before the limits may take any form.
        ("2 * 10 mm +0.1 -0.05 mm", 0.02, 1e-4, -5e-5),
        ("(19 mm + 1 mm) +0.1 mm -0.05 mm", 0.02, 1e-4, -5e-5),
        ("1 m + 2 m +3 mm -4 mm", 3.0, 3e-3, -4e-3),
        ("0 m +1 -1 mm", 0.0, 1e-3, -1e-3),
    ] {
        let (value, found) = design(text);
        assert!((value - nominal).abs() <= 1e-15, "{text}: {value}");
        assert_near(found, tolerance(upper, lower, Law::Normal), text);
    }
}

/// One signed number, three, or two followed by more terms, are terms of a sum.
#[test]
fn other_sums_are_sums() {
    for (text, nominal) in [
        ("1 m + 2 m", 3.0),
        ("1 m + 2 m - 2 * 1 m", 1.0),
        ("1 m + 2 m - 1 m / 2", 2.5),
        ("1 m + 2 m - 2^2 * 1 m", -1.0),
        ("(1 m + 2 m - 0.5 m)", 2.5),
        ("1 m + 2 m - (0.5 m)", 2.5),
        ("1 m + 2 m * 3 - 4 m", 3.0),
        ("1 m + 2 m / 4", 1.5),
        ("1 m + (2 m / -4)", 0.5),
    ] {
        assert_eq!(design(text), (nominal, Tolerance::NONE), "{text}");
    }
    let (nominal, found) = design("1 m + 2 m - (0.5 m) +/- 1 mm uniform");
    assert_eq!(nominal, 2.5);
    assert_eq!(found, tolerance(1e-3, -1e-3, Law::Uniform));
}

#[test]
fn a_law_follows_the_limits() {
    let beta = Law::Beta { alpha: 2.0, beta: 3.5 };
    for (text, law) in [
        ("", Law::Normal),
        ("normal", Law::Normal),
        ("truncated normal", Law::TruncatedNormal),
        ("uniform", Law::Uniform),
        ("triangular", Law::Triangular),
        ("lognormal", Law::Lognormal),
        ("weibull", Law::Weibull),
        ("beta(2, 7 / 2)", beta),
    ] {
        for limits in ["+/- 0.5", "+/- 10 %", "+/- (1 / 2)", "+0.5 -0.5", "+10% -10%"] {
            let text = format!("5 {limits} {text}");
            assert_near(design(&text).1, tolerance(0.5, -0.5, law.clone()), &text);
        }
        let text = format!("5 m +/- 50 cm {text}");
        assert_near(design(&text).1, tolerance(0.5, -0.5, law), &text);
    }
}

/// Values arrive unchanged; the limits, and the positions between them, follow from the values.
#[test]
fn a_list_says_what_a_value_may_be() {
    for (text, values) in [
        ("2 mm one of [1.9, 2.0, 2.1] mm", [(1.9, 1.0), (2.0, 1.0), (2.1, 1.0)].as_slice()),
        ("2 mm one of [2.1 mm, 1900 um] weighted [1, 3]", &[(2.1, 1.0), (1.9, 3.0)]),
        ("2 mm one of [2.05, 2.05, 2.01] mm", &[(2.05, 1.0), (2.05, 1.0), (2.01, 1.0)]),
        ("2 mm one of [2.5 * 1 mm] weighted [0.5]", &[(2.5, 0.5)]),
        ("2 mm one of [0, -1, 1] mm weighted [1, 0, 2 * 2]", &[(0.0, 1.0), (-1.0, 0.0), (1.0, 4.0)]),
    ] {
        let (nominal, found) = design(text);
        let Law::OneOf(places) = &found.law else { panic!("{text}: {found:?}") };
        assert!(!found.relative && found.lower <= found.upper && places.len() == values.len());
        for ((place, weight), (value, expected)) in places.iter().zip(values) {
            let arrived = nominal + found.lower + place * (found.upper - found.lower);
            assert!((arrived - 1e-3 * value).abs() < 1e-15, "{text}: {arrived}");
            assert_eq!(weight, expected, "{text}");
        }
    }
    let (_, plain) = design("3 one of [2.9, 3.2]");
    assert_eq!(plain.law, Law::OneOf(vec![(0.0, 1.0), (1.0, 1.0)]));
}

#[test]
fn what_is_no_list_of_values_is_refused() {
    for (text, expected) in [
        ("2 mm one of 1.9 mm", "the values are listed in brackets"),
        ("2 mm one of [] mm", "no value is listed"),
        ("2 mm one of [1, 2] kg", "must be a length (mm), this is a mass (kg)"),
        ("2 mm one of [1 mm, 2 kg]", "one dimension"),
        ("2 mm one of [1, 2]", "`[1, 2]` has no unit; a length is expected"),
        ("2 mm one of [1, 2] mm weighted [1]", "1 weights for 2 values"),
        ("2 mm one of [1, 2] mm weighted [1, -1]", "a weight is not negative"),
        ("2 mm one of [1, 2] mm weighted [0, 0]", "all weights are zero"),
        ("2 mm one of [1, 2] mm weighted [1, 2] mm", "a weight must be"),
        ("2 mm one of [m, 2] mm", "listed values are"),
        ("2 mm one off [1, 2] mm", "write `one of [1.9, 2.0, 2.1] mm`"),
        ("2 mm one of [1, 2] mm uniform", "the list says how they are distributed"),
        ("2 mm +/- 1 mm one of [1, 2] mm", "unknown law `one`"),
    ] {
        let source = format!(
            "mechanism Bar {{ design m = 3 kg; design x = {text}; body bar: rod(mass: m, length: 1 m, along: -z);
                joint theta: revolute(y) from ground to bar; }}"
        );
        let tokens = source.parse().expect("tokens");
        let found = match eigentol_compiler::syntax::parse::parse(tokens) {
            Err(mistakes) => mistakes,
            Ok(ast) => resolve(&ast).expect_err(text),
        };
        let messages: Vec<String> = found.iter().map(|x| x.text()).collect();
        assert!(messages.iter().any(|own| own.contains(expected)), "{text}: {messages:?}");
    }
    let source = "mechanism Bar { input x: N one of [1, 2] N; body bar: rod(mass: 1 kg, length: 1 m, along: -z);
        joint theta: revolute(y) from ground to bar; }";
    let refused = resolve(&read(source)).expect_err("an input");
    assert!(refused.to_string().contains("an input has no value of its own"), "{refused}");
}

#[test]
fn an_input_wanders() {
    let relative = |upper, lower, law| Tolerance { relative: true, ..tolerance(upper, lower, law) };
    assert_eq!(input("rad/s"), Tolerance::NONE);
    for (text, expected) in [
        ("rad/s +/- 1%", relative(0.01, -0.01, Law::Normal)),
        ("rad/s +2 -1 % uniform", relative(0.02, -0.01, Law::Uniform)),
        ("rad/s 0 -1% weibull", relative(0.0, -0.01, Law::Weibull)),
        ("rad/s +/- 0.5 rad/s uniform", tolerance(0.5, -0.5, Law::Uniform)),
        ("kN +1 -0 N", tolerance(1.0, 0.0, Law::Normal)),
        ("1 +/- 3 triangular", tolerance(3.0, -3.0, Law::Triangular)),
        ("1 +2 -1", tolerance(2.0, -1.0, Law::Normal)),
        ("1 +/- sqrt(0.25) * cos(0) * norm([3, 0, 4]) * atan2(0, 1)", tolerance(0.0, 0.0, Law::Normal)),
        ("1 +/- sqrt(0.25) * cos(0) * norm([3, 0, 4])", tolerance(2.5, -2.5, Law::Normal)),
    ] {
        assert_near(input(text), expected, text);
    }
    let turn = std::f64::consts::TAU / 60.0;
    let rpm = tolerance(30.0 * turn, -10.0 * turn, Law::Normal);
    assert_near(input("rad/s +30 -10 rpm"), rpm, "rpm");
}

/// The keywords of laws are ordinary names and units where no law can appear.
#[test]
fn words_of_laws_are_no_keywords() {
    let mechanism = resolved(
        "mechanism Words {
            input uniform: rad/s +/- 1% uniform;
            design normal = 3 kg +/- 1% normal;
            design beta = 10 cm +0.1 -0 cm beta(1, 2);
            let truncated = 2 * beta;
            body lognormal: rod(mass: normal, length: truncated, along: -z);
            joint weibull: revolute(y) from ground to lognormal;
        }",
    );
    assert_eq!(mechanism.design.len(), 2);
    assert_eq!(mechanism.inputs[0].tolerance.law, Law::Uniform);
}

#[test]
fn the_canonical_text_keeps_what_was_written() {
    for (text, canonical) in [
        ("20 mm+0.1-0mm", "20.0 mm +0.1 -0.0 mm"),
        ("20 mm 0 -41 um", "20.0 mm +0.0 -41.0 um"),
        ("20 mm +1e-7 m -0.05", "20.0 mm +1e-7 m -0.05"),
        ("3 +2-1%truncated normal", "3.0 +2.0 -1.0% truncated normal"),
        ("3 +/- 5e-1 % beta(2,3)", "3.0 +/- 0.5% beta(2.0, 3.0)"),
        ("2 mm one of[1.9,2]mm", "2.0 mm one of [1.9, 2.0] mm"),
        ("2 one of [1, 2 + 1] weighted [3, 4]", "2.0 one of [1.0, 2.0 + 1.0] weighted [3.0, 4.0]"),
    ] {
        let source = format!("mechanism M {{ design x = {text}; }}");
        let printed = print(&read(&source));
        assert!(printed.contains(&format!("design x = {canonical};\n")), "{printed}");
        assert_eq!(read(&printed), read(&source));
    }
}

/// A choice from a short list.
fn one_of<'a, T>(random: &mut ChaCha8Rng, list: &'a [T]) -> &'a T {
    &list[random.next_u32() as usize % list.len()]
}

/// Limits, units, percentages and laws in every combination: the text is read back as the numbers it was made from.
#[test]
fn random_tolerances_arrive_as_written() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let random = &mut random;
    let beta = Law::Beta { alpha: 0.5, beta: 3.0 };
    let laws = [
        ("", Law::Normal),
        ("normal", Law::Normal),
        ("truncated normal", Law::TruncatedNormal),
        ("uniform", Law::Uniform),
        ("triangular", Law::Triangular),
        ("lognormal", Law::Lognormal),
        ("weibull", Law::Weibull),
        ("beta(1 / 2, 3)", beta),
    ];
    let (mut accepted, mut refused) = (0, 0);
    for _ in 0..2000 {
        let &(nominal, value) = one_of(
            random,
            &[("20 mm", 0.02), ("-5 mm", -5e-3), ("0.4 m", 0.4), ("2 * 10 mm", 0.02), ("1 m - 1 cm", 0.99)],
        );
        let numbers = [-0.041, -0.02, 0.0, 0.0, 0.021, 0.1, 2.0];
        let (upper, lower) = (*one_of(random, &numbers), *one_of(random, &numbers));
        let &(unit, scale) = one_of(random, &[("mm", 1e-3), ("um", 1e-6), ("%", 0.01 * f64::abs(value))]);
        let (law_text, law) = one_of(random, &laws);
        let signed = |random: &mut ChaCha8Rng, number: f64| match number {
            0.0 => (*one_of(random, &["0", "+0", "-0"])).to_string(),
            number => format!("{number:+}"),
        };
        let space = *one_of(random, &["", " "]);
        let unit_of_upper = if *one_of(random, &[true, false]) { unit } else { "" };
        let text = format!(
            "mechanism M {{ design x = {nominal} {}{space}{unit_of_upper} {}{space}{unit} {law_text};
                body bar: rod(mass: 3 kg, length: 1 m, along: -z); joint theta: revolute(y) from ground to bar; }}",
            signed(random, upper),
            signed(random, lower),
        );
        let ast = read(&text);
        assert_eq!(read(&print(&ast)), ast, "{text}");
        let mean = value + 0.5 * scale * (upper + lower);
        let is_positive_law = matches!(law, Law::Lognormal | Law::Weibull);
        let is_right = upper >= lower && (mean > 0.0 || !is_positive_law);
        match resolve(&ast) {
            Ok(mechanism) => {
                assert!(is_right, "{text}");
                let expected = tolerance(scale * upper, scale * lower, law.clone());
                assert_near(mechanism.design[0].tolerance.clone(), expected, &text);
                accepted += 1;
            }
            Err(mistakes) => {
                assert!(!is_right && mistakes.iter().count() == 1, "{text}\n{mistakes}");
                refused += 1;
            }
        }
    }
    assert!(accepted > 500 && refused > 500, "{accepted} {refused}");
}
