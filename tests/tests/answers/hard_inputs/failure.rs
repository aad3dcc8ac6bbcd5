//! Failure where a search is easily misled: designs without an equilibrium, limits without a design point, centres that
//! are extrema or lie inside a forbidden band, values too rare for samples. Against closed forms.

use eigentol::allocation::{Choices, Cost, HalfWidth};
use eigentol::requirement::Requirement;
use eigentol::response::Response;
use eigentol::sensitivity::Quantity;
use eigentol::summary::Doubt;
use eigentol::{Error, Study};
use eigentol_interpreter::Interpreted;

/// The standard normal distribution function.
fn phi(z: f64) -> f64 {
    eigentol_statistics::normal::cdf(z)
}

fn of_mode(quantity: Quantity) -> Response {
    Response::Mode { mode: 0, quantity }
}

/// A mass on a spring of 40 N/mm with this tolerance.
fn mount(tolerance: &str) -> Study<Interpreted> {
    read(&format!(
        "mechanism Mount {{
            design k = 40 N/mm {tolerance};
            body b: point(mass: 10 kg);
            joint x: prismatic(x) from ground to b;
            force s: spring(on: x, stiffness: k);
        }}"
    ))
}

/// Standard normal numbers `e`, `g`, `h` and an output.
fn numbers(output: &str) -> Study<Interpreted> {
    read(&format!(
        "mechanism Numbers {{
            design e = 0 +/- 3;
            design g = 0 +/- 3;
            design h = 0 +/- 3;
            body b: point(mass: 1 kg);
            joint x: prismatic(x) from ground to b;
            force s: spring(on: x, stiffness: 1 N/m);
            output y = {output};
        }}"
    ))
}

fn read(text: &str) -> Study<Interpreted> {
    Study::new(Interpreted::from_text(text).expect("a declaration"))
}

fn output(study: &Study<Interpreted>) -> Response {
    Response::Output(study.find_output("y").expect("it is declared").any())
}

/// The damper loses its force in seven of a thousand designs.
#[test]
fn unstable_designs_fail_requirements_on_their_modes() {
    let study = read(
        "mechanism Whirling {
            input w: rad/s;
            design c = 20 N*s/m +/- 30%;
            design a = 0.2 kg +/- 30%;
            body b: point(mass: 10 kg);
            joint x: prismatic(x) from ground to b;
            force s: spring(on: x, stiffness: 40 N/mm);
            force d: generalized(on: x, value: -(c - a*w)*rate(x));
        }",
    );
    let w = study.find_input("w").expect("it is declared");
    let study = study.input(w, 70.0).samples(20_000);
    let expected = phi(-6.0 / 2.0_f64.hypot(0.02 * 70.0));
    let wanted = [Requirement::at_least(of_mode(Quantity::DampingRatio), 0.0)];
    let run = study.chances(&wanted).expect("samples").all;
    let share = run.failure();
    assert_eq!(run.untold, 0);
    assert!((share - expected).abs() < 4.0 * (expected / 20_000.0).sqrt(), "{share} {expected}");
    let found = study.probability(&wanted).expect("a probability");
    let interval = found.each[0].interval;
    assert!(interval.lower <= expected && expected <= interval.upper, "{found} {expected}");
}

/// `stable` has no design point, and its failures lie on the other side of the nominal design.
#[test]
fn failures_without_a_design_point_are_found() {
    let study = mount("+/- 100%");
    let frequency = of_mode(Quantity::Frequency);
    let wanted = [Requirement::Stable, Requirement::at_most(frequency, 100.0)];
    let found = study.probability(&wanted).expect("a probability");
    let expected = phi(-3.0) + phi(-4.5);
    let interval = found.any.interval;
    assert!(interval.lower <= expected && expected <= interval.upper, "{found} {expected}");
    assert!(interval.upper < 1.1 * expected, "{found}");
}

/// From inside a forbidden band both sides are safe: neither tangent plane bounds failure.
#[test]
fn the_centre_inside_a_forbidden_band_has_no_design_point() {
    let band = |low, high| {
        let response = of_mode(Quantity::Frequency);
        [Requirement::Outside { response, low, high }]
    };
    let study = mount("+/- 10%").samples(20_000);
    let inside = study.reliability(&band(62.0, 64.0)).expect("limits");
    let points = &inside.limits[0].design_points;
    assert!(matches!(points, Err(Error::Setting { setting: "forbidden band", .. })), "{points:?}");
    assert!(inside.beta_of(0).is_none());
    let at = |frequency: f64| (frequency * frequency * 10.0 - 40e3) / (4000.0 / 3.0);
    let share = study.chances(&band(62.0, 64.0)).expect("samples").all.failure();
    assert!((share - phi(at(64.0)) + phi(at(62.0))).abs() < 0.015, "{share}");
    let beside = study.reliability(&band(66.5, 67.0)).expect("limits");
    assert!((beside.limits[0].beta().expect("a design point") - at(66.5)).abs() < 1e-6);
}

/// A product of three normal numbers is large in four octants.
#[test]
fn design_points_that_are_reflections_are_found() {
    let study = numbers("e*g*h");
    let wanted = [Requirement::at_most(output(&study), 20.0)];
    let about = study.reliability(&wanted).expect("design points");
    let points = about.limits[0].design_points.as_ref().expect("four");
    assert_eq!(points.len(), 4);
    // Twice the integral of phi(e) phi(g) Phi(-20 / (e g)) over e, g > 0, times two for the sign of e g.
    let steps = 300;
    let width = 12.0 / f64::from(steps);
    let at = |k: i32| (f64::from(k) + 0.5) * width;
    let density = eigentol_statistics::normal::density;
    let row = |i| (0..steps).map(move |j| density(at(i)) * density(at(j)) * phi(-20.0 / (at(i) * at(j))));
    let expected: f64 = 4.0 * width * width * (0..steps).flat_map(row).sum::<f64>();
    let probability = about.judgement.judged().expect("designs").probability;
    assert!((probability.value - expected).abs() < 4.0 * probability.standard_error, "{about} {expected}");
}

/// At one corner the mass has no frequency: what lies on the way is unknown.
#[test]
fn the_worst_case_beyond_stability_is_unknown() {
    let worst = mount("+/- 100%").worst_case(&[of_mode(Quantity::Frequency)]).expect("corners");
    let response = &worst.responses[0];
    let greatest = response.greatest.as_ref().map(|end| (end.value, end.confirmed));
    assert_eq!((response.least.is_none(), response.missing.len()), (true, 1));
    assert!(greatest.is_some_and(|(value, sure)| sure && (value - 8000_f64.sqrt()).abs() < 1e-9));
}

/// At `e = 0` the response is an extremum: it has no slope there, and fails on both sides.
#[test]
fn tolerances_about_an_extremum_are_allocated() {
    let study = numbers("e^2").samples(20_000);
    let wanted = [Requirement::at_most(output(&study), 1.0)];
    let half_width = HalfWidth {
        variable: study.find_design("e").expect("it is declared").index(),
        limits: (0.1, 6.0),
        cost: Cost::reciprocal(0.0, 1.0, 1.0),
    };
    let choices = Choices { half_widths: vec![half_width], nominals: vec![], failure: vec![0.01] };
    let found = study.allocation(&wanted, &choices).expect("an allocation");
    // 2 Phi(-3 / T) = 0.01.
    let expected = 3.0 / 2.575_829_303_548_901;
    let half_width = found.half_widths[0];
    assert!((half_width - expected).abs() < 1e-5, "{half_width} {expected}");
    assert!(found.refuted.is_empty());
    assert!((found.reliability.beta_of(0).expect("two points") - 2.326_347_874).abs() < 1e-5);
}

/// A few designs have a much stiffer spring, to which most of the variance is due.
#[test]
fn samples_that_miss_rare_values_confirm_nothing() {
    let listed = |stiff: f64, weight: f64| {
        let list = format!("one of [39.8, 40, 40.2, {stiff}] N/mm weighted [33, 33, 33, {weight}]");
        mount(&list).summary().expect("a summary")
    };
    for (stiff, weight) in [(80.0, 0.01), (80.0, 0.05), (80.0, 0.2), (4000.0, 1e-3), (4000.0, 1e-4)] {
        let summary = listed(stiff, weight);
        assert!(!summary.trust[0].trusted(), "{stiff} {weight}: {summary}");
    }
    let rare = listed(4000.0, 1e-4);
    let text = rare.to_string();
    assert!(text.contains("due to values too rare to be among the samples"), "{text}");
    let doubt = Doubt::Unrepresentative { quantity: Quantity::Frequency };
    assert!(rare.trust[0].doubts.contains(&doubt));
    let check = &rare.trust[0].checks[0];
    assert!(!check.representative && check.first_order_error.is_none());
    // Common values are represented.
    let common = mount("one of [39.8, 40, 40.2] N/mm").summary();
    let common = common.expect("a summary");
    assert!(common.trust[0].trusted(), "{common}");
}
