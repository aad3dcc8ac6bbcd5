//! Quantities stored in no file, mainly shapes: first derivatives against differences of values, second derivatives
//! against differences of first ones, with equilibria solved again.

use eigentol_tests::corpus::{bearing_rotor, flap_lag_blade, governor, rotor_blade, screw_press};
use eigentol_tests::rederived::{Derived, Machine, State, operating_points};

use super::common::largest;

/// All quantities of a state, with lead components and eigenvalues followed from `modes`.
fn numbers(state: &State, modes: &[(nalgebra::Complex<f64>, [usize; 2])]) -> Vec<(String, Derived)> {
    let mut list = Vec::new();
    let mut push = |name: String, derived: &Derived| list.push((name, derived.clone()));
    for (i, q) in state.equilibrium().iter().enumerate() {
        push(format!("coordinate {i}"), q);
    }
    for (r, mode) in state.undamped_modes().iter().enumerate() {
        let mode = mode.as_ref().expect("a simple mode");
        push(format!("lambda {r}"), &mode.lambda);
        for (i, x) in mode.shape.iter().enumerate() {
            push(format!("undamped shape {r}, {i}"), x);
        }
    }
    for (r, (s, leads)) in modes.iter().enumerate() {
        let mode = state.general_mode(*s, leads.map(Some)).expect("a simple mode");
        push(format!("Re s {r}"), &mode.s.re);
        push(format!("Im s {r}"), &mode.s.im);
        push(format!("|s| {r}"), &mode.magnitude);
        push(format!("damping ratio {r}"), &mode.damping_ratio);
        for (side, shape) in [("right", &mode.right), ("left", &mode.left)] {
            for (i, x) in shape.iter().enumerate() {
                push(format!("Re {side} {r}, {i}"), &x.re);
                push(format!("Im {side} {r}, {i}"), &x.im);
            }
        }
    }
    list
}

/// Returns the number of derivatives compared.
fn check(name: &str, declaration: &str, relative_step: f64) -> usize {
    let machine = Machine::new(declaration);
    let point = &operating_points(name)[0];
    let b = machine.nominal().to_vec();
    let state = machine.at(&point.inputs, &b, &point.start);
    let modes: Vec<_> = state
        .general_modes()
        .into_iter()
        .map(|mode| {
            let mode = mode.expect("a simple mode");
            (nalgebra::Complex::new(mode.s.re.value, mode.s.im.value), mode.leads)
        })
        .collect();
    let here = numbers(&state, &modes);
    let mut compared = 0;
    for variable in 0..b.len() + point.inputs.len() {
        let value = [&b[..], &point.inputs].concat()[variable];
        let width = if value == 0.0 { 1.0 } else { value.abs() };
        let step = relative_step * width;
        let moved = |count: f64| {
            let (mut b, mut u) = (b.clone(), point.inputs.clone());
            match variable.checked_sub(b.len()) {
                None => b[variable] += count * step,
                Some(input) => u[input] += count * step,
            }
            numbers(&machine.at(&u, &b, &state.coordinates), &modes)
        };
        let [near, far] = [1.0, 2.0].map(|count| (moved(count), moved(-count)));
        for (k, (name_of, number)) in here.iter().enumerate() {
            // Fourth order.
            let difference = |of: &dyn Fn(&Derived) -> f64| {
                let slope = |pair: &(Vec<_>, Vec<_>), width: f64| {
                    let (up, down): (&(String, Derived), &(String, Derived)) = (&pair.0[k], &pair.1[k]);
                    (of(&up.1) - of(&down.1)) / (width * step)
                };
                (4.0 * slope(&near, 2.0) - slope(&far, 4.0)) / 3.0
            };
            let what = format!("{name} {name_of} by {variable}");
            let size = number.value.abs() + 1e-3;
            let rate = number.gradient[variable];
            let error = (difference(&|x| x.value) - rate).abs();
            let scale = rate.abs() + 1e-1 * size / width;
            assert!(error <= 1e-6 * scale, "{what}: {rate:e} is off by {error:e}");
            for (other, curvature) in number.hessian[variable].iter().enumerate() {
                let error = (difference(&|x| x.gradient[other]) - curvature).abs();
                let scale = largest(&number.hessian[other]) + number.gradient[other].abs() / width;
                assert!(error <= 1e-6 * scale + 1e-9 * size, "{what} and {other}: {curvature:e} is off by {error:e}");
                compared += 1;
            }
        }
    }
    compared
}

#[test]
fn derivatives_are_limits_of_differences() {
    let step = 1e-3;
    let compared = [
        check("governor", governor::DECLARATION, step),
        check("flap_lag_blade", flap_lag_blade::DECLARATION, step),
        check("rotor_blade", rotor_blade::DECLARATION, step),
        check("bearing_rotor", bearing_rotor::DECLARATION, step),
        check("screw_press", screw_press::DECLARATION, step),
    ];
    assert!(compared.iter().all(|&count| count > 100), "{compared:?}");
}
