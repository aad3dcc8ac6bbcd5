//! Monte Carlo: no sample is lost, and results do not depend on the number of threads.

use eigentol::tolerance::Outcome;
use eigentol::{DesignVariable, Mechanism, MonteCarlo, Study};
use eigentol_tests::corpus::governor::Governor;
use eigentol_tests::corpus::rotating_double_pendulum::RotatingDoublePendulum;
use eigentol_tests::corpus::turntable_slider::TurntableSlider;

use eigentol_tests::statically_unstable::{SprungMass, StandingBar};

/// Checks that counts sum to the samples, samples agree with counts, and statistics agree with samples.
fn assert_complete(run: &MonteCarlo, samples: usize) {
    assert_eq!((run.samples, run.counts.total()), (samples, samples));
    let all = run.all.as_ref().expect("samples were asked for");
    assert_eq!(all.len(), samples);
    let count = |outcome| all.iter().filter(|sample| sample.outcome == outcome).count();
    assert_eq!(run.counts.stable, count(Outcome::Stable));
    assert_eq!(run.counts.divergent, count(Outcome::Divergent));
    assert_eq!(run.counts.no_equilibrium, count(Outcome::NoEquilibrium));
    assert_eq!(run.counts.unphysical, count(Outcome::Unphysical));
    for (mode, found) in run.modes.iter().enumerate() {
        let values: Vec<f64> = all
            .iter()
            .filter(|sample| sample.outcome == Outcome::Stable)
            .filter_map(|sample| sample.frequencies[mode])
            .collect();
        assert!(values.iter().all(|value| value.is_finite()));
        let Some(found) = found else {
            assert!(values.is_empty());
            continue;
        };
        let number = values.len() as f64;
        let mean = values.iter().sum::<f64>() / number;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        let deviation = (squares / (number - 1.0)).sqrt();
        assert_eq!(found.count, values.len() as u64);
        assert!((found.mean - mean).abs() <= 1e-12 * mean);
        let sigma = found.sigma.expect("several values");
        assert!((sigma - deviation).abs() <= 1e-9 * deviation);
        assert!(found.min <= mean && mean <= found.max);
    }
}

/// Checks for equal results with any number of threads and different ones with another seed. The chunks are neither all
/// full nor a multiple of the threads.
fn assert_reproducible(study: &Study<impl Mechanism>) -> MonteCarlo {
    const SAMPLES: usize = 2500;
    let run = |threads: usize, seed: u64| {
        let study = study.clone().samples(SAMPLES).keep_samples(true);
        study.threads(threads).seed(seed).monte_carlo().expect("samples")
    };
    let one = run(1, 42);
    assert_complete(&one, SAMPLES);
    for threads in [1, 2, 3, 7, 0] {
        assert_eq!(bits(&run(threads, 42)), bits(&one), "{threads} threads");
    }
    let other = run(1, 43);
    assert_complete(&other, SAMPLES);
    assert_ne!(bits(&other), bits(&one));
    one
}

/// Every number of a run to the last bit: `Debug` prints the shortest text that reads back as the same number.
fn bits(run: &MonteCarlo) -> String {
    format!("{:?} {:?} {:?}", run.counts, run.modes, run.all)
}

#[test]
fn double_pendulum_about_its_critical_speed() {
    let study = Study::new(RotatingDoublePendulum).input(RotatingDoublePendulum::omega, 2.69);
    let run = assert_reproducible(&study);
    assert_eq!(run.counts.stable, run.samples);
    assert!(run.left_nominal_branch > 0);
}

#[test]
fn governor_and_slider() {
    let study = Study::new(Governor).input(Governor::speed, 20.0).input(Governor::collar, 0.19);
    assert_eq!(assert_reproducible(&study).counts.stable, 2500);
    let study = Study::new(TurntableSlider).input(TurntableSlider::omega, 2.0);
    assert_eq!(assert_reproducible(&study).counts.stable, 2500);
}

/// Near the limit of the spring's capacity every outcome occurs, and all are counted.
#[test]
fn samples_that_fail_are_counted() {
    let study = Study::new(SprungMass)
        .input(SprungMass::omega, 9.9)
        .tolerance(SprungMass::m, 1.2)
        .tolerance(SprungMass::k, 10.0);
    let run = assert_reproducible(&study);
    assert!(run.counts.unphysical > 0, "masses below zero: {:?}", run.counts);
    assert!(run.counts.divergent > 500, "{:?}", run.counts);
    assert!(run.counts.stable > 500, "{:?}", run.counts);

    // A spring that may or may not hold the bar upright.
    let study = Study::new(StandingBar).design(StandingBar::k, 9.81).tolerance(DesignVariable::new(2), 0.5);
    let run = assert_reproducible(&study);
    assert_eq!(run.counts.stable, run.samples);
}

#[test]
fn no_samples_and_one_sample() {
    let study = Study::new(RotatingDoublePendulum).keep_samples(true);
    let none = study.clone().samples(0).monte_carlo().expect("nothing to do");
    assert_eq!((none.counts.total(), none.samples), (0, 0));
    assert_eq!(*none.modes, [None, None]);
    assert_eq!(none.all.as_deref(), Some(&[][..]));
    let one = study.samples(1).monte_carlo().expect("one sample");
    let mode = one.modes[0].as_ref().expect("one value");
    assert_eq!((mode.count, mode.sigma), (1, None));
}
