//! Monte Carlo on damped, larger and closed-loop mechanisms, one sample at a time and several in vectors.

use std::hint::black_box;

use crate::corpus::{BearingRotor, ChainOfEight, FiveBar, ScrewPress};
use crate::facts::{Fact, fastest};
use eigentol::scalar::Instructions;
use eigentol::{Coordinate, Input, Mechanism, Study};

/// Name of the section, for the filter.
pub(crate) const SAMPLES: &str = "facts/samples";

const COUNT: usize = 8192;

struct Timed(Vec<Fact>);

impl Timed {
    /// Times the samples of a study.
    fn add<M: Mechanism>(&mut self, name: &str, study: &Study<M>) {
        let study = study.clone().samples(COUNT).threads(1);
        for (way, vectors) in [("one by one", None), ("in vectors", Some(Instructions::best()))] {
            let study = study.clone().vectors(vectors);
            let seconds = fastest(5, || {
                let _ = black_box(&study.monte_carlo());
            });
            self.0.push((
                format!("{name}: Monte Carlo {way}, one thread, per sample"),
                format!("{:.2} us", seconds * 1e6 / COUNT as f64),
            ));
        }
    }
}

fn at<M: Mechanism>(machine: M, inputs: &[f64], start: &[f64]) -> Study<M> {
    let mut study = Study::new(machine);
    for (k, &value) in inputs.iter().enumerate() {
        study = study.input(Input::new(k), value);
    }
    for (k, &value) in start.iter().enumerate() {
        study = study.guess(Coordinate::new(k), value);
    }
    study
}

/// A gyroscopic rotor, a linkage with four angles and two reactions, a long chain, and a damped press with nine
/// coordinates.
pub(crate) fn samples() -> Vec<Fact> {
    let mut timed = Timed(Vec::new());
    let rotor = at(BearingRotor, &[314.0], &[]);
    timed.add("rotor in a soft bearing", &rotor);
    let linkage = at(FiveBar, &[5.0], &[2.0, 1.0, -1.2, 1.1]);
    timed.add("five-bar linkage", &linkage);
    timed.add("chain of eight bars", &at(ChainOfEight, &[2.5], &[0.9, 0.1]));
    timed.add("screw press", &at(ScrewPress, &[], &[]));
    timed.0
}
