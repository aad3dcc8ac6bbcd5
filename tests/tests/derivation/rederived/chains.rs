//! `W1`, `W2`, `W3`: frequencies of bars in series and their first derivatives, at bent and straight equilibria.

use eigentol_oracle::truth::Truth;
use eigentol_tests::corpus::{chain_of_eight, chain_of_four, rotating_double_pendulum, rotating_pendulum};
use eigentol_tests::rederived::{Derived, Machine};

use super::common::{assert_within, largest};

/// The file stores 17 digits of numbers that cancel.
const TIGHT: f64 = 1e-9;

fn check(declaration: &str, name: &str) {
    let machine = Machine::new(declaration);
    let case = Truth::load("w1_w2_w3").get(name);
    let b = [case.get("L").numbers(), case.get("m").numbers()].concat();
    for point in case.get("points").list() {
        let omega = point.get("Omega").number();
        let what = format!("{name} at {omega} rad/s");
        // The file has absolute angles, the machine relative ones.
        let theta = point.get("theta_star").numbers();
        let relative = |i: usize| theta[i] - if i > 0 { theta[i - 1] } else { 0.0 };
        let start: Vec<f64> = (0..theta.len()).map(relative).collect();
        let state = machine.at(&[omega], &b, &start);

        let frequencies = point.get("omega_n").numbers();
        let rates = point.get("domega_db").list();
        let modes = state.undamped_modes();
        assert_eq!(modes.len(), frequencies.len());
        for (r, mode) in modes.iter().enumerate() {
            let omega = mode.as_ref().and_then(|mode| mode.omega.as_ref());
            let omega = omega.expect("it oscillates");
            assert_within(TIGHT, &[omega.value], &frequencies[r..=r], 0.0, &what);
            let expected = rates[r].numbers();
            let scale = 1e-2 * largest(&expected);
            assert_within(TIGHT, &omega.gradient[..b.len()], &expected, scale, &what);
        }

        let angles = state.equilibrium();
        for (j, expected) in point.get("dtheta_db").list().iter().enumerate() {
            let sum = |i: usize| angles[..=i].iter().map(|q: &Derived| q.gradient[j]).sum();
            let values: Vec<f64> = (0..theta.len()).map(sum).collect();
            assert_within(TIGHT, &values, &expected.numbers(), 1e-2, &what);
        }
    }
}

#[test]
fn bars_in_series() {
    check(rotating_pendulum::DECLARATION, "W1");
    check(rotating_double_pendulum::DECLARATION, "W2");
    check(rotating_double_pendulum::DECLARATION, "W2_varied");
    check(chain_of_four::DECLARATION, "W3_n4");
    check(chain_of_four::DECLARATION, "W3_n4_varied");
    check(chain_of_eight::DECLARATION, "W3_n8");
    check(chain_of_eight::DECLARATION, "W3_n8_varied");
}
