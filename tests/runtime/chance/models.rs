//! Spreads from models near states where models fail: nothing is claimed about their errors, and samples are preferred.

use eigentol::judge::Doubt;
use eigentol::propagation::{Method, Propagation, first_order, propagate, sampled, second_order};
use eigentol::response::{Response, Responses};
use eigentol::tolerance::{Points, Sampling};
use eigentol::{Error, Quantity, Study, mechanism};

use super::oracle::speed;

mechanism! {
    mechanism Bar {
        input omega: rad/s;
        design l = 1.0 m;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: 3 kg, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
        output angle = theta;
    }
}

/// By first order, second order, and what is chosen when a few designs may be solved, and by many samples; for the frequency, the
/// angle and the critical speed.
fn spreads(ratio: f64, tolerance: f64) -> Result<[Propagation; 4], Error> {
    let study = Study::new(Bar).input(Bar::omega, speed(ratio)).start(Bar::theta, 1.0).tolerance(Bar::l, tolerance);
    let tolerances = study.tolerances()?;
    let state = study.equilibrium()?;
    let modes = study.modes()?;
    let frequency = Response::Mode { mode: 0, quantity: Quantity::Frequency };
    let wanted = vec![frequency, Response::Output(Bar::angle.any())];
    let responses = Responses::new(&Bar, &state, &modes, wanted)?;
    let sampling = Sampling::default().samples(4096);
    Ok([
        first_order(&Bar, &responses, &tolerances)?,
        second_order(&Bar, &responses, &tolerances)?,
        propagate(&Bar, &responses, &tolerances, 200, &sampling)?,
        sampled(&responses, &tolerances, &sampling.points(Points::Sobol))?.propagation()?,
    ])
}

#[test]
fn near_a_critical_state_nothing_is_known_about_errors() {
    let [models @ .., chosen, _] = spreads(1.03, 0.12).unwrap();
    for model in &models {
        let [[Doubt::NearCritical { distance }], [Doubt::BranchNear { mode: 0, distance: other }]] =
            [&model.doubts[0][..], &model.doubts[1]]
        else {
            panic!("{model}")
        };
        assert!((distance - 1.57).abs() < 0.01 && other == distance);
        for spread in model.spreads.iter().flatten() {
            assert_eq!(spread.mean.error, None, "{model}");
            assert_eq!(spread.sigma.unwrap().error, None, "{model}");
            assert!(spread.quantiles.iter().all(|own| own.error.is_none()));
        }
        let text = model.to_string();
        assert!(text.contains("Doubtful for frequency 1: the critical state is 1.57"), "{text}");
        assert!(text.contains("Nothing is known about their errors"), "{text}");
    }
    assert!(matches!(chosen.method, Method::Sampled(_)), "{chosen}");
    assert!(chosen.reason.contains("doubt on any model"), "{chosen}");
    assert!(chosen.doubts.iter().all(Vec::is_empty));
    assert!(chosen.spreads[0].as_ref().unwrap().sigma.unwrap().error.is_some());
}

/// Far from it the errors are stated, and hold.
#[test]
fn far_from_it_errors_are_stated() {
    let [first, second, chosen, fine] = spreads(1.3, 0.03).unwrap();
    assert_eq!(chosen.method, Method::SecondOrder, "{chosen}");
    let exact = fine.spreads[0].as_ref().unwrap().sigma.unwrap().value;
    for found in [&first, &second] {
        assert!(found.doubts.iter().all(Vec::is_empty), "{found}");
        let sigma = found.spreads[0].as_ref().unwrap().sigma.unwrap();
        assert!((sigma.value - exact).abs() <= sigma.error.unwrap() + 1e-4 * exact, "{found}");
        assert!(!found.to_string().contains("Nothing is known"));
    }
}

#[test]
fn without_a_tolerance_there_is_no_doubt() {
    let [first, ..] = match spreads(1.0001, 0.0) {
        Ok(propagations) => propagations,
        Err(error) => panic!("{error}"),
    };
    assert!(first.doubts.iter().all(Vec::is_empty), "{first}");
}
