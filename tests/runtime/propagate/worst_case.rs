//! Worst cases at the corners of the box, for monotonic and other responses.

use eigentol::propagation::worst_case;
use eigentol::sweep::Range;
use eigentol::tolerance::Outcome;

use super::*;
use crate::common::close;

#[test]
fn a_monotonic_response() {
    for (length, low, high) in [
        (Distribution::uniform(0.94, 1.06).unwrap(), 0.94, 1.06),
        (Distribution::normal(1.01, 0.02).unwrap(), 0.95, 1.07),
        (Distribution::lognormal(1.0, 0.1).unwrap(), 0.7377, 1.3422),
    ] {
        let worst = ask(&bar(), vec![FREQUENCY], |responses| worst_case(responses, &varied(length)).unwrap());
        let response = &worst.responses[0];
        let (least, greatest) = (response.least.as_ref().unwrap(), response.greatest.as_ref().unwrap());
        close(least.design[1], low, 1e-3);
        close(greatest.design[1], high, 1e-3);
        close(least.value, frequency(least.design[1]), 1e-11);
        close(greatest.value, frequency(greatest.design[1]), 1e-11);
        // The mass does not matter.
        assert_eq!((least.design[0], worst.evaluations), (3.0, 3));
        assert!(response.is_monotonic());
        close(response.nominal.unwrap(), frequency(1.0), 1e-12);
    }
}

/// The corners of a linear response, exact in each variable separately.
#[test]
fn a_linear_response() {
    let tolerances = Tolerances::new([0.0, 0.0, 0.1, 0.2, 0.3], 3.0, None).unwrap();
    let worst = ask_sum(outputs(), |responses| worst_case(responses, &tolerances).unwrap());
    let [sum, product] = [0, 1].map(|k| &worst.responses[k]);
    close(sum.greatest.as_ref().unwrap().value, -4.0 + 0.1 + 0.4 + 0.9, 1e-13);
    close(sum.least.as_ref().unwrap().value, -4.0 - 1.4, 1e-13);
    close(product.greatest.as_ref().unwrap().value, 1.1 * 2.2, 1e-13);
    assert_eq!(product.least.as_ref().unwrap().design[4], 3.0);
    assert!(sum.is_monotonic() && product.is_monotonic());
}

/// A product of two variables about zero is largest in two corners and smallest in two; gradients alone find one of
/// each.
#[test]
fn a_response_that_turns() {
    let limits = [1.5, 3.0].map(|high| Distribution::uniform(-1.0, high).unwrap());
    let [a, b] = limits;
    let fixed = |value| Distribution::constant(value).unwrap();
    let all = vec![fixed(2.0), fixed(8.0), a, b, fixed(3.0)];
    let nominal = [2.0, 8.0, 1.0, 2.0, 3.0];
    let tolerances = Tolerances::distributed(&nominal, all, 3.0, None).unwrap();
    let worst = ask_sum(outputs(), |responses| worst_case(responses, &tolerances).unwrap());
    let product = &worst.responses[1];
    assert_eq!(product.turning, [2, 3]);
    assert!(!product.is_monotonic());
    close(product.greatest.as_ref().unwrap().value, 4.5, 1e-13);
    close(product.least.as_ref().unwrap().value, -3.0, 1e-13);
    assert!(worst.responses[0].is_monotonic());
}

mechanism! {
    /// A beam on a spring, with outputs that are stationary at the nominal design.
    mechanism Balance {
        design e = 0 m;
        design f = 0 m;
        design idle = 1 m;
        body beam: rigid(mass: 1 kg, inertia: [1, 1, 1] kg*m^2, center: [0, 0, 0] m);
        joint turn: revolute(y) from ground to beam;
        force hold: spring(on: turn, stiffness: 9 N*m/rad);
        output parabola = 1 m^2 + e^2;
        output saddle = e * f;
        output other = idle;
    }
}

/// A response that is stationary at the nominal design is not constant, although its gradient there is zero.
#[test]
fn a_stationary_response_turns() {
    let study = Study::new(Balance).tolerance(Balance::e, 0.2).tolerance(Balance::f, 0.5).tolerance(Balance::idle, 0.3);
    let wanted = [Balance::parabola, Balance::saddle].map(|x| Response::Output(x.any()));
    let worst = study.worst_case(&wanted).unwrap();
    let ends = |k: usize| {
        let response = &worst.responses[k];
        let value = |end: &Option<eigentol::propagation::Extreme>| end.as_ref().unwrap().value;
        (value(&response.least), value(&response.greatest))
    };
    let [parabola, saddle] = [&worst.responses[0], &worst.responses[1]];
    assert_eq!(parabola.turning, [Balance::e.index()]);
    close(ends(0).0, 1.0, 1e-15);
    close(ends(0).1, 1.04, 1e-15);
    assert_eq!(saddle.turning, [Balance::e.index(), Balance::f.index()]);
    close(ends(1).0, -0.1, 1e-15);
    close(ends(1).1, 0.1, 1e-15);
    assert!(!parabola.is_monotonic() && !saddle.is_monotonic());
    // A variable without effect stays nominal.
    assert_eq!(parabola.greatest.as_ref().unwrap().design[2], 1.0);
}

#[test]
fn a_corner_without_value_is_said() {
    let worst = ask(&bar(), vec![FREQUENCY], |responses| {
        worst_case(responses, &varied(Distribution::uniform(-0.5, 1.5).unwrap())).unwrap()
    });
    let response = &worst.responses[0];
    assert_eq!(response.missing.len(), 1);
    assert_eq!(response.missing[0].outcome, Outcome::Unphysical);
    assert_eq!(response.missing[0].design[1], -0.5);
    // The frequency falls towards the corner that has none: its minimum is unknown.
    assert!(response.least.is_none() && !response.is_monotonic());
    assert!(response.greatest.as_ref().unwrap().confirmed);
}

/// The speed above which the bar swings out, `sqrt(1.5 g / l)`.
#[test]
fn critical_speeds() {
    let range = Range::new(Bar::omega.any(), 0.5, 8.0).steps(20);
    let worst = ask(&bar(), vec![Response::Critical(range)], |responses| {
        worst_case(responses, &varied(Distribution::uniform(0.9, 1.2).unwrap())).unwrap()
    });
    let response = &worst.responses[0];
    let speed = |length: f64| (1.5 * GRAVITY / length).sqrt();
    close(response.greatest.as_ref().unwrap().value, speed(0.9), 1e-8);
    close(response.least.as_ref().unwrap().value, speed(1.2), 1e-8);
}
