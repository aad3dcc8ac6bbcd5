use eigentol::tolerance::Outcome;
use eigentol::{Coordinate, DesignVariable, Input, Stability, Study};

use super::bordered::bordered;
use super::models::{FOUR_BAR, FourBar};

#[test]
fn samples_that_do_not_close_are_counted() {
    // The longest bar is one millimetre short of the sum of the others.
    let reach = FOUR_BAR[2] + FOUR_BAR[3] + FOUR_BAR[4];
    let study = Study::new(bordered(FourBar))
        .input(Input::new(0), 0.0)
        .design(DesignVariable::new(5), reach - 1e-3)
        .guess(Coordinate::new(0), 0.4)
        .guess(Coordinate::new(1), -0.02)
        .guess(Coordinate::new(2), 1.1)
        .guess(Coordinate::new(3), -0.02)
        .tolerance(DesignVariable::new(5), 3e-3)
        .samples(120)
        .keep_samples(true);
    let state = study.equilibrium().expect("it closes");
    assert_eq!(state.stability, Stability::Stable);
    let run = study.monte_carlo().expect("valid settings");
    assert_eq!(run.counts.total(), 120);
    let all = run.all.expect("asked for");
    for sample in &all {
        let closes = sample.design[5] < sample.design[2] + sample.design[3] + sample.design[4];
        match sample.outcome {
            Outcome::Stable => assert!(closes, "{:?}", sample.design),
            Outcome::NotAssembled => assert!(!closes, "{:?}", sample.design),
            other => panic!("{other:?}: {:?}", sample.design),
        }
    }
    // One standard deviation from not closing: one sixth of the samples.
    assert!((12..30).contains(&run.counts.not_assembled), "{:?}", run.counts);
    assert!(run.counts.to_string().contains("not assembled"));
}
