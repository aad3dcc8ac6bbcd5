//! Two equal springs: a double eigenvalue, whose modes have no identity but their order.

use eigentol::requirement::{EstimatedBy, Requirement};
use eigentol::response::{Response, Responses};
use eigentol::{Quantity, Study, mechanism};

use super::oracle::upper;
use crate::common::close;

mechanism! {
    mechanism Twins {
        design m = 1.0 kg;
        design k1 = 100.0 N/m;
        design k2 = 100.0 N/m;
        body left: sphere(mass: m, radius: 0.1 m);
        body right: sphere(mass: m, radius: 0.1 m);
        joint x: prismatic(x) from ground to left;
        joint y: prismatic(y) from ground to right;
        force hold_x: spring(on: x, stiffness: k1);
        force hold_y: spring(on: y, stiffness: k2);
    }
}

mechanism! {
    /// The same, damped, so that modes are general.
    mechanism DampedTwins {
        design c = 0.4 N*s/m;
        design k1 = 100.0 N/m;
        design k2 = 100.0 N/m;
        body left: sphere(mass: 1 kg, radius: 0.1 m);
        body right: sphere(mass: 1 kg, radius: 0.1 m);
        joint x: prismatic(x) from ground to left;
        joint y: prismatic(y) from ground to right;
        force hold_x: spring(on: x, stiffness: k1);
        force hold_y: spring(on: y, stiffness: k2);
        force damp_x: damper(on: x, damping: c);
        force damp_y: damper(on: y, damping: c);
    }
}

fn frequency(mode: usize) -> Response {
    Response::Mode { mode, quantity: Quantity::Frequency }
}

fn twins() -> Study<Twins> {
    Study::new(Twins).sigma_level(1.0).tolerance(Twins::k1, 5.0).tolerance(Twins::k2, 5.0)
}

/// A gradient exists where no variable splits the two, and only there.
#[test]
fn no_gradient_depends_on_the_basis() {
    let study = twins();
    let wanted = vec![frequency(0), frequency(1)];
    let (at, modes) = (&study.equilibrium().unwrap(), &study.modes().unwrap());
    let responses = Responses::new(&Twins, at, modes, wanted).unwrap();
    let mut room = responses.workspace();
    let found = responses.with_gradients(&mut room, &at.design).unwrap();
    assert_eq!(found.gradients, [None, None]);
    // Beside the equal stiffnesses each has its own, and the lowest comes first.
    for (k1, k2, slopes) in [(90.0, 110.0, [1.0, 0.0]), (110.0, 90.0, [0.0, 1.0])] {
        let found = responses.with_gradients(&mut room, &[1.0, k1, k2]).unwrap();
        let lowest = f64::sqrt(f64::min(k1, k2));
        close(found.values[0].unwrap(), lowest, 1e-12);
        let gradient = found.gradients[0].as_ref().unwrap();
        for (own, slope) in gradient[1..].iter().zip(slopes) {
            assert!((own - slope * 0.5 / lowest).abs() < 1e-12);
        }
    }
    // A mass that both share splits nothing.
    let shared = Study::new(Twins).tolerance(Twins::m, 0.1);
    let spread = shared.propagate(&[frequency(0)]).unwrap();
    assert!(spread.spreads[0].is_some());
}

/// The lowest of two frequencies is too low unless both are high enough.
#[test]
fn the_lowest_of_two_equal_frequencies_fails_for_either() {
    let limit = f64::sqrt(95.0);
    let wanted = [Requirement::at_least(frequency(0), limit)];
    let exact = 1.0 - (1.0 - upper(1.0)).powi(2);
    let study = twins().samples(20_000).seed(5);
    let found = study.reliability(&wanted).unwrap();
    assert!(!found.verified() && found.limits[0].probability().is_none(), "{found}");
    let judged = found.judgement.judged().unwrap();
    let error = 4.0 * judged.probability.standard_error;
    assert!(judged.settled && (judged.probability.value - exact).abs() < error, "{found}");
    let run = study.chances(&wanted).unwrap();
    let interval = run.each[0].clopper_pearson(0.9999).unwrap();
    assert!(interval.lower < exact && exact < interval.upper, "{run}");
    let answer = study.probability(&wanted).unwrap();
    assert_eq!(answer.each[0].by, EstimatedBy::Lines, "{answer}");
    assert!((answer.each[0].value - exact).abs() < 0.05 * exact, "{answer}");
    // The highest needs both to be low.
    let highest = [Requirement::at_least(frequency(1), limit)];
    let exact = upper(1.0).powi(2);
    let answer = study.probability(&highest).unwrap();
    assert!((answer.each[0].value - exact).abs() < 0.1 * exact, "{answer}");
}

/// Monte Carlo counts equal modes in ascending order, alone and side by side, damped or not.
#[test]
fn equal_modes_are_sampled_in_ascending_order() {
    let damped =
        Study::new(DampedTwins).sigma_level(1.0).tolerance(DampedTwins::k1, 5.0).tolerance(DampedTwins::k2, 5.0);
    for vectors in [None, Some(eigentol::scalar::Instructions::best())] {
        let runs = [
            twins().samples(512).keep_samples(true).vectors(vectors).monte_carlo(),
            damped.clone().samples(512).keep_samples(true).vectors(vectors).monte_carlo(),
        ];
        for run in runs {
            let run = run.unwrap();
            assert!(run.clustered);
            for sample in run.all.iter().flatten() {
                let [low, high] = sample.frequencies[..] else { panic!("{sample:?}") };
                let (k1, k2) = (sample.design[1], sample.design[2]);
                let damping = 0.25 * 0.4_f64.powi(2) * f64::from(u8::from(low != k1.min(k2).sqrt().into()));
                let exact = |k: f64| [k.sqrt(), (k - damping).sqrt()];
                let near = |value: Option<f64>, k: f64| exact(k).iter().any(|x| (value.unwrap() - x).abs() < 1e-9);
                assert!(near(low, k1.min(k2)) && near(high, k1.max(k2)), "{sample:?}");
            }
        }
    }
}
