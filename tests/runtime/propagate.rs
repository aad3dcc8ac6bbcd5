//! Propagation of tolerances to any response, against the exact distribution of the rotating bar, whose frequency is a
//! function of its length, and of the spring oscillator, whose frequency and output are simple.

mod crossing;
mod influence;
mod sampling;
mod taylor;
mod worst_case;

use eigentol::propagation::{Propagation, ResponseSpread};
use eigentol::response::{Response, Responses};
use eigentol::tolerance::Distribution;
use eigentol::{Error, Quantity, Study, Tolerances, mechanism};

use crate::common::GRAVITY;

mechanism! {
    mechanism Bar {
        input omega: rad/s;
        design m = 3.0 kg;
        design l = 1.0 m;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
        output length = 2 * l;
        output angle = theta;
    }
}

mechanism! {
    mechanism Sum {
        design m = 2.0 kg;
        design k = 8.0 N/m;
        design a = 1.0 m;
        design b = 2.0 m;
        design c = 3.0 m;
        body block: sphere(mass: m, radius: 0.1 m);
        joint x: prismatic(x) from ground to block;
        force hold: spring(on: x, stiffness: k);
        output sum = a + 2 * b - 3 * c;
        output product = a * b;
        output fourth = a * a * a * a;
    }
}

pub(crate) const SPEED: f64 = 5.0;
const FREQUENCY: Response = Response::Mode { mode: 0, quantity: Quantity::Frequency };

fn frequency(length: f64) -> f64 {
    let natural = 1.5 * GRAVITY / length;
    (SPEED.powi(2) - (natural / SPEED).powi(2)).sqrt()
}

fn bar() -> Study<Bar> {
    Study::new(Bar).input(Bar::omega, SPEED).start(Bar::theta, 1.0)
}

/// Puts a question about the responses of a study.
fn ask<R>(study: &Study<Bar>, wanted: Vec<Response>, question: impl FnOnce(&Responses<'_>) -> R) -> R {
    let state = study.equilibrium().unwrap();
    let modes = study.modes().unwrap();
    let responses = Responses::new(&Bar, &state, &modes, wanted).unwrap();
    question(&responses)
}

/// Puts a question to the mechanism with simple outputs.
fn ask_sum<R>(wanted: Vec<Response>, question: impl FnOnce(&Responses<'_>) -> R) -> R {
    let study = Study::new(Sum);
    let state = study.equilibrium().unwrap();
    let modes = study.modes().unwrap();
    let responses = Responses::new(&Sum, &state, &modes, wanted).unwrap();
    question(&responses)
}

fn outputs() -> Vec<Response> {
    vec![Response::Output(Sum::sum.any()), Response::Output(Sum::product.any())]
}

fn varied(length: Distribution) -> Tolerances {
    let mass = Distribution::constant(3.0).unwrap();
    Tolerances::distributed(&[3.0, 1.0], vec![mass, length], 3.0, None).unwrap()
}

/// Mean, standard deviation, skewness, and quantiles derived from those of the length.
struct Exact {
    mean: f64,
    sigma: f64,
    skewness: f64,
    length: Distribution,
}

impl Exact {
    /// By the midpoint rule over probabilities.
    fn new(length: &Distribution) -> Self {
        let number = 200_000;
        let at = |k: u32| frequency(length.quantile((f64::from(k) + 0.5) / f64::from(number)));
        let mean = (0..number).map(at).sum::<f64>() / f64::from(number);
        let power = |n: i32| {
            let all = (0..number).map(|k| (at(k) - mean).powi(n));
            all.sum::<f64>() / f64::from(number)
        };
        let sigma = power(2).sqrt();
        Self { mean, sigma, skewness: power(3) / sigma.powi(3), length: length.clone() }
    }

    /// The frequency increases with the length.
    fn quantile(&self, probability: f64) -> f64 {
        frequency(self.length.quantile(probability))
    }
}

fn lengths() -> [Distribution; 2] {
    [Distribution::normal(1.01, 0.02).unwrap(), Distribution::uniform(0.94, 1.06).unwrap()]
}

fn spread(all: &Propagation, response: usize) -> &ResponseSpread {
    all.spreads[response].as_ref().unwrap()
}

fn is_setting(found: Result<impl Sized, Error>, wanted: &str) -> bool {
    matches!(found, Err(Error::Setting { setting, .. }) if setting == wanted)
}
