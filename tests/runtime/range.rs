//! Results beyond the range of a double are errors, never NaN.

use crate::common::FREQUENCY;
use crate::common::derived::Derived;
use crate::common::models::{Pair, Plate, Spring};
use crate::common::pendulum::Pendulum;
use eigentol::requirement::Requirement;
use eigentol::sweep::Line;
use eigentol::{DesignVariable, Error, Family, Input, Mechanism, Study};

/// The place of a NaN or an infinite eigenvalue in a result, with the text before it.
fn look(text: &str) -> Option<&str> {
    if let Some(at) = text.find("lambda: -inf").or(text.find("lambda: inf")) {
        return Some(&text[at..at + 12]);
    }
    // An error may report that something is NaN, as `value`.
    let at = text.match_indices("NaN").find(|(at, _)| !text[..*at].ends_with("value: "))?.0;
    Some(&text[at.saturating_sub(200)..at + 3])
}

fn wide<M>(k: usize) -> DesignVariable<M> {
    DesignVariable::new(k)
}

fn ask<M: Mechanism>(name: &str, study: &Study<M>) {
    for family in [Family::Undamped, Family::General] {
        let study = study.clone().family(family).samples(20).threads(1);
        let summary = study.summary();
        let mut answers = vec![
            ("first", format!("{:?}", study.first_order())),
            ("second", format!("{:?}", study.second_order())),
            ("sensitivities", format!("{:?}", study.sensitivities())),
            ("curvature", format!("{:?}", study.mode_curvature(0))),
            ("summary", format!("{summary:?}")),
            ("summary", summary.map_or(String::new(), |found| found.to_string())),
            ("samples", format!("{:?}", study.monte_carlo())),
        ];
        if let Some(&u) = study.input_values().first() {
            let values = [0.5 * u, 0.8 * u, 0.9 * u, u, 1.1 * u, 1.3 * u, 1.5 * u];
            let line = Line { ratio: 1.0, offset: 0.0 };
            let diagram = study.campbell(Input::new(0), &values, &[line]);
            answers.extend([
                ("sweep", format!("{:?}", study.sweep(Input::new(0), &values))),
                ("slopes", format!("{:?}", study.first_order_sweep(Input::new(0), &values))),
                ("campbell", format!("{diagram:?}")),
                ("campbell", diagram.map_or(String::new(), |diagram| diagram.to_string())),
            ]);
        }
        for (what, answer) in answers {
            let text = look(&answer);
            assert!(text.is_none(), "{name}, {family:?}, {what}: {text:?}");
        }
    }
}

#[test]
fn no_answer_has_a_nan_in_it() {
    none_has_a_nan(&[153, 307]);
}

#[test]
#[ignore = "half a minute"]
fn no_answer_of_any_size_has_a_nan_in_it() {
    none_has_a_nan(&[100, 149, 151, 153, 155, 160, 200, 250, 300, 307]);
}

fn none_has_a_nan(exponents: &[i32]) {
    for &exponent in exponents {
        for x in [10.0_f64.powi(exponent), 10.0_f64.powi(-exponent)] {
            let spring = Study::new(Derived(Spring)).input(Input::new(0), 1.0);
            let spring = spring.relative_tolerance(wide(0), 0.01);
            ask(&format!("stiffness {x:e}"), &spring.clone().input(Input::new(0), x));
            ask(&format!("mass {x:e}"), &spring.clone().design(wide(0), x));
            ask(&format!("both {x:e}"), &spring.clone().design(wide(0), x).input(Input::new(0), x));
            let bent = spring.design(wide(1), 1.0);
            ask(&format!("force {x:e}"), &bent.clone().design(wide(2), x));
            ask(&format!("tolerance {x:e}"), &bent.tolerance(wide(2), x).tolerance(wide(0), x));
            let pendulum = Study::new(Pendulum).input(Input::new(0), 3.0).relative_tolerance(wide(0), 0.01);
            ask(&format!("speed {x:e}"), &pendulum.clone().input(Input::new(0), x));
            ask(&format!("length {x:e}"), &pendulum.clone().design(wide(1), x));
            ask(&format!("heavy {x:e}"), &pendulum.design(wide(0), x));
            let plate = Study::new(Derived(Plate)).input(Input::new(0), 3.0);
            ask(&format!("plate {x:e}"), &plate.clone().design(wide(1), x).relative_tolerance(wide(1), 0.01));
            ask(&format!("damped {x:e}"), &plate.clone().design(wide(3), x).relative_tolerance(wide(3), 0.01));
            ask(&format!("fast {x:e}"), &plate.input(Input::new(0), x));
            let pair = Study::new(Derived(Pair));
            ask(&format!("pair {x:e}"), &pair.clone().design(wide(0), x).relative_tolerance(wide(0), 0.01));
            ask(&format!("coupled {x:e}"), &pair.clone().tolerance(wide(2), x));
        }
    }
}

#[test]
fn an_eigenvalue_whose_square_overflows_is_named() {
    let plate = Study::new(Derived(Plate)).input(Input::new(0), 3.0);
    let found = plate.design(DesignVariable::new(3), 1e200).modes();
    let Err(Error::EigenvalueRange { mode, size }) = found else { panic!("{found:?}") };
    // c / m; for the other mode the eigenvalue is approximately -k / c.
    assert!(mode >= 1 && (size / 2e200 - 1.0).abs() < 1e-12, "{size}");
}

#[test]
fn a_band_around_something_infinite_is_refused() {
    let study = Study::new(Pendulum).input(Input::new(0), 5.0);
    for (order, fraction) in [
        (f64::INFINITY, 0.1),
        (f64::NEG_INFINITY, 0.1),
        (f64::NAN, 0.1),
        (1e308, 0.1),
        (1.0, f64::MAX),
        (1.0, f64::INFINITY),
        (1.0, f64::NAN),
        (1.0, -0.1),
    ] {
        for speed in [0.0, 5.0] {
            let wanted = Requirement::Away { response: FREQUENCY, input: Input::new(0), order, fraction };
            let study = study.clone().input(Input::new(0), speed);
            let found = study.tolerance(DesignVariable::new(0), 0.03).reliability(&[wanted]);
            let in_range = speed == 0.0 && order.is_finite() && fraction > 0.0 && fraction.is_finite();
            match found {
                Err(Error::Setting { setting, .. }) => assert_eq!(setting, "requirement"),
                Ok(margin) => {
                    let text = format!("{margin:?}");
                    assert!(in_range && !text.contains("NaN"), "{text}");
                }
                other => panic!("{other:?}"),
            }
        }
    }
}

/// A million threads are reduced to a sensible number, and the result is the same as with one.
#[test]
fn a_million_threads_are_not_started() {
    let study = Study::new(Pendulum).input(Input::new(0), 3.0).samples(1000);
    let many = study.clone().threads(1_000_000).monte_carlo().unwrap();
    assert_eq!(many, study.threads(1).monte_carlo().unwrap());
}
