//! Tolerance allocation against closed forms; its optimality conditions against finite differences.

use eigentol::allocation::{Allocation, Choices, Cost, HalfWidth, Nominal};
use eigentol::requirement::Requirement;
use eigentol::response::Response;
use eigentol::{Error, Law, Quantity, Study, mechanism};
use eigentol_statistics::normal;

use crate::common::close;

mechanism! {
    mechanism Stack {
        design a = 50 mm;
        design b = 20 mm;
        design c = 30 mm;
        design d = 10 mm;
        gravity 9.81 m/s^2 along -z;
        body bar: rod(mass: 1 kg, length: 1 m, along: -z);
        joint theta: revolute(y) from ground to bar;
        output gap = a - 2 * b + c;
        output other = a + b;
        output third = d;
    }
}

mechanism! {
    mechanism Pendulum {
        input omega: rad/s;
        design m = 3.0 kg;
        design l = 1.0 m;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
    }
}

const FREQUENCY: Response = Response::Mode { mode: 0, quantity: Quantity::Frequency };
const SLOPES: [f64; 3] = [1.0, -2.0, 1.0];
const COSTS: [f64; 3] = [1.0e-3, 4.0e-3, 2.5e-3];

fn gap() -> Response {
    Response::Output(Stack::gap.any())
}

fn stack() -> Study<Stack> {
    Study::new(Stack).tolerance(Stack::a, 0.3e-3).tolerance(Stack::b, 0.15e-3).tolerance(Stack::c, 0.6e-3)
}

fn choices<'a>(power: f64, limits: (f64, f64), failure: Vec<f64>) -> Choices<'a> {
    let each = COSTS.iter().enumerate();
    let half_widths = each.map(|(variable, factor)| HalfWidth {
        variable,
        limits,
        cost: Cost::reciprocal(0.5, factor * 1e-3_f64.powf(power - 1.0), power),
    });
    Choices { half_widths: half_widths.collect(), nominals: Vec::new(), failure }
}

fn cost_of(power: f64, half_widths: &[f64]) -> f64 {
    let each = COSTS.iter().zip(half_widths);
    each.map(|(factor, t)| 0.5 + factor * 1e-3_f64.powf(power - 1.0) / t.powf(power)).sum()
}

/// Lagrange: `T_i = scale (c_i / s_i^2)^(1 / (k + 2))`, and the standard deviation uses up the margin.
fn closed_form(power: f64, sigma: f64) -> Vec<f64> {
    let shape: Vec<f64> = (0..3).map(|i| (COSTS[i] / (SLOPES[i] * SLOPES[i])).powf(1.0 / (power + 2.0))).collect();
    let parts = shape.iter().zip(SLOPES);
    let square: f64 = parts.map(|(t, s)| (s * t / 3.0).powi(2)).sum();
    shape.iter().map(|t| t * sigma / square.sqrt()).collect()
}

fn allocate(study: &Study<Stack>, wanted: &[Requirement], choices: &Choices<'_>) -> Allocation {
    study.allocation(wanted, choices).unwrap()
}

#[test]
fn a_linear_limit_has_a_closed_form() {
    let wanted = [Requirement::at_most(gap(), 41e-3)];
    for power in [0.5, 1.0, 2.0] {
        for failure in [0.1, 1e-3, 1e-9] {
            let allocation = allocate(&stack(), &wanted, &choices(power, (1e-6, 0.1), vec![failure]));
            let beta = -normal::quantile(failure);
            let exact = closed_form(power, 1e-3 / beta);
            for (t, exact) in allocation.half_widths.iter().zip(&exact) {
                close(*t, *exact, 1e-6);
            }
            assert_eq!(allocation.half_widths[3], 0.0);
            close(allocation.cost, cost_of(power, &exact), 1e-9);
            close(allocation.reliability.beta_of(0).unwrap(), beta, 1e-8);
            assert!(allocation.reliability.verified());
            assert!(allocation.refuted.is_empty());
            assert_eq!(allocation.chances.all.samples(), 3000);
            assert_eq!(allocation.nominal[..], *stack().design_values());
        }
    }
}

/// A band has two limits: each gets half the probability, and the closed form holds for each.
#[test]
fn a_band_shares_its_probability() {
    let wanted = [Requirement::Within { response: gap(), low: 39e-3, high: 41e-3 }];
    let allocation = allocate(&stack(), &wanted, &choices(1.0, (1e-6, 0.1), vec![0.01]));
    let exact = closed_form(1.0, 1e-3 / -normal::quantile(0.005));
    for (t, exact) in allocation.half_widths.iter().zip(&exact) {
        close(*t, *exact, 1e-6);
    }
}

/// Two requirements on different dimensions: each has the closed form for its own probability.
#[test]
fn each_requirement_has_its_own_chance() {
    let study = stack().tolerance(Stack::d, 0.1e-3);
    let wanted =
        [Requirement::at_most(gap(), 41e-3), Requirement::at_most(Response::Output(Stack::third.any()), 10.5e-3)];
    for failure in [[1e-3, 0.1], [0.02, 1e-6]] {
        let mut choices = choices(1.0, (1e-6, 0.1), failure.to_vec());
        choices.half_widths.push(HalfWidth {
            variable: 3,
            limits: (1e-6, 0.1),
            cost: Cost::reciprocal(0.0, 2e-3, 1.0),
        });
        let allocation = allocate(&study, &wanted, &choices);
        let [first, second] = failure.map(|chance| -normal::quantile(chance));
        let exact = closed_form(1.0, 1e-3 / first);
        for (t, exact) in allocation.half_widths.iter().zip(&exact) {
            close(*t, *exact, 1e-5);
        }
        close(allocation.half_widths[3], 3.0 * 0.5e-3 / second, 1e-6);
        for (place, beta) in [first, second].into_iter().enumerate() {
            close(allocation.reliability.beta_of(place).unwrap(), beta, 1e-7);
        }
    }
}

/// A movable nominal value is placed in the middle of the band, where tolerances can be widest.
#[test]
fn nominal_values_move_to_the_middle() {
    let wanted = [Requirement::Within { response: gap(), low: 39.5e-3, high: 42.5e-3 }];
    let mut choices = choices(1.0, (1e-6, 0.1), vec![0.01]);
    choices.nominals.push(Nominal { variable: 3, limits: (5e-3, 15e-3) });
    choices.nominals.push(Nominal { variable: 2, limits: (25e-3, 35e-3) });
    let allocation = allocate(&stack(), &wanted, &choices);
    close(allocation.nominal[2], 31e-3, 1e-6);
    let exact = closed_form(1.0, 1.5e-3 / -normal::quantile(0.005));
    for (t, exact) in allocation.half_widths.iter().zip(&exact) {
        close(*t, *exact, 1e-5);
    }
    assert!(allocation.refuted.is_empty());
}

/// Limits on half-widths are respected: with two at their limits, the third takes the rest.
#[test]
fn limits_of_half_widths_hold() {
    let wanted = [Requirement::at_most(gap(), 41e-3)];
    let mut choices = choices(1.0, (1e-6, 0.1), vec![1e-3]);
    choices.half_widths[0].limits = (0.1e-3, 0.4e-3);
    choices.half_widths[2].limits = (0.2e-3, 0.3e-3);
    let allocation = allocate(&stack(), &wanted, &choices);
    close(allocation.half_widths[0], 0.4e-3, 1e-12);
    close(allocation.half_widths[2], 0.3e-3, 1e-12);
    let sigma = 1e-3 / -normal::quantile(1e-3);
    let left = 9.0 * sigma * sigma - 0.4e-3_f64.powi(2) - 0.3e-3_f64.powi(2);
    close(allocation.half_widths[1], 0.5 * left.sqrt(), 1e-6);
}

/// A cost that falls where a tolerance gets tighter makes no sense.
#[test]
fn senseless_costs_are_refused() {
    let wanted = [Requirement::at_most(gap(), 41e-3)];
    let infinite = f64::INFINITY;
    for (fixed, factor, power) in [
        (f64::NAN, 1.0, 1.0),
        (0.0, -1.0, 1.0),
        (0.0, 0.0, 1.0),
        (0.0, infinite, 1.0),
        (0.0, 1.0, -1.0),
        (0.0, 1.0, 0.0),
        (0.0, 1.0, f64::NAN),
    ] {
        let mut choices = choices(1.0, (1e-6, 0.1), vec![1e-3]);
        choices.half_widths[1].cost = Cost::reciprocal(fixed, factor, power);
        let refused = stack().allocation(&wanted, &choices);
        let expected = matches!(refused, Err(Error::Setting { setting: "cost", .. }));
        assert!(expected, "{fixed} {factor} {power}: {refused:?}");
    }
}

#[test]
fn a_cost_of_ones_own() {
    let wanted = [Requirement::at_most(gap(), 41e-3)];
    let own = |factor: f64| Cost::function(move |t| (0.5 + factor / t, -factor / (t * t)));
    let mut choices = choices(1.0, (1e-6, 0.1), vec![1e-3]);
    for (half_width, factor) in choices.half_widths.iter_mut().zip(COSTS) {
        half_width.cost = own(factor);
    }
    let allocation = allocate(&stack(), &wanted, &choices);
    let exact = closed_form(1.0, 1e-3 / -normal::quantile(1e-3));
    for (t, exact) in allocation.half_widths.iter().zip(&exact) {
        close(*t, *exact, 1e-6);
    }
}

/// Length and speed of the bar: the requested probability is met exactly, and no trade of one half-width for the other
/// reduces the cost.
#[test]
fn a_curved_limit_with_uniform_variables() {
    let study = Study::new(Pendulum)
        .input(Pendulum::omega, 5.0)
        .start(Pendulum::theta, 1.0)
        .limits(Pendulum::l, -0.02, 0.04)
        .law(Pendulum::l, Law::Uniform)
        .tolerance(Pendulum::omega, 0.15)
        .samples(20_000);
    let wanted = [Requirement::at_least(FREQUENCY, 3.9)];
    let costs = [0.02, 0.1];
    let length = |t: f64| (costs[0] / t, -costs[0] / (t * t));
    let choices = Choices {
        half_widths: vec![
            HalfWidth { variable: 1, limits: (1e-3, 0.5), cost: Cost::function(length) },
            HalfWidth { variable: 2, limits: (1e-2, 1.0), cost: Cost::reciprocal(0.0, costs[1], 1.0) },
        ],
        nominals: Vec::new(),
        failure: vec![0.01],
    };
    let found = study.allocation(&wanted, &choices).unwrap();
    close(found.reliability.beta_of(0).unwrap(), -normal::quantile(0.01), 1e-6);
    let at = &found.reliability.limits[0].design_points.as_ref().unwrap()[0];
    assert!(at.verified);
    let ratio = |k: usize, cost: f64| {
        let t = found.half_widths[k];
        at.by_half_width[k].beta * t * t / cost
    };
    close(ratio(1, costs[0]), ratio(2, costs[1]), 1e-4);
    assert!(found.refuted.is_empty(), "{found}");
    // The same tolerances restated: a half-width of three standard deviations is 3^(1/2) times the hard limit about the
    // mean.
    let hard = found.half_widths[1] / 3.0_f64.sqrt();
    let anew =
        (study.clone()).limits(Pendulum::l, 0.01 - hard, 0.01 + hard).tolerance(Pendulum::omega, found.half_widths[2]);
    close(anew.reliability(&wanted).unwrap().beta_of(0).unwrap(), -normal::quantile(0.01), 1e-6);
    let interval = found.chances.all.clopper_pearson(0.9999).unwrap();
    assert!(interval.lower < 0.012 && interval.upper > 0.008, "{interval:?}");
    let text = found.to_string();
    assert!(text.starts_with("Pendulum at omega = 5 rad/s: allocation, cost"), "{text}");
}

#[test]
fn what_cannot_be_met_says_how_near_it_comes() {
    let wanted = [Requirement::at_most(gap(), 41e-3)];
    let tight = choices(1.0, (1e-3, 0.1), vec![1e-3]);
    let sigma = 6.0_f64.sqrt() * 1e-3 / 3.0;
    match stack().allocation(&wanted, &tight) {
        Err(Error::Infeasible { half_widths, requirement: 0, probability, wanted, .. }) => {
            assert!(half_widths[..3].iter().all(|t| (t / 1e-3 - 1.0).abs() < 1e-6));
            close(probability, normal::cdf(-1e-3 / sigma), 1e-6);
            assert_eq!(wanted, 1e-3);
        }
        other => panic!("{other:?}"),
    }
    // The nominal design itself fails.
    let wrong = [Requirement::at_most(gap(), 39e-3)];
    assert!(matches!(
        stack().allocation(&wrong, &choices(1.0, (1e-6, 0.1), vec![1e-3])),
        Err(Error::Infeasible { probability, .. }) if probability > 0.5
    ));
}

#[test]
fn what_makes_no_sense_is_refused() {
    let wanted = [Requirement::at_most(gap(), 41e-3)];
    let refused = |change: &dyn Fn(&mut Choices<'_>)| {
        let mut choices = choices(1.0, (1e-6, 0.1), vec![1e-3]);
        change(&mut choices);
        match stack().allocation(&wanted, &choices) {
            Err(Error::Setting { setting, .. }) => setting,
            Err(Error::WrongLength { kind, .. } | Error::UnknownHandle { kind, .. }) => kind,
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(refused(&|all| all.half_widths.clear()), "allocation");
    assert_eq!(refused(&|all| all.half_widths[1].variable = 0), "allocation");
    assert_eq!(refused(&|all| all.half_widths[1].variable = 7), "design variable");
    assert_eq!(refused(&|all| all.half_widths[1].variable = 3), "half-width");
    assert_eq!(refused(&|all| all.half_widths[1].limits = (0.0, 1.0)), "half-width");
    assert_eq!(refused(&|all| all.half_widths[1].limits = (2.0, 1.0)), "half-width");
    assert_eq!(refused(&|all| all.failure[0] = 1.0), "failure");
    assert_eq!(refused(&|all| all.failure[0] = f64::NAN), "failure");
    assert_eq!(refused(&|all| all.failure.push(0.1)), "allowed probabilities of failure");
    assert_eq!(refused(&|all| all.half_widths[0].cost = Cost::function(|_| (f64::NAN, 0.0))), "cost");
    assert_eq!(
        refused(&|all| all.nominals.push(Nominal { variable: 2, limits: (1.0, f64::INFINITY) })),
        "nominal value"
    );
}
