//! The greatest amplitude in a range and the place of the highest peak as requirements.

use eigentol::peaks::PeakQuantity;
use eigentol::requirement::Requirement;
use eigentol::response::{Response, Responses, Vibration};
use eigentol::sweep::Range;
use eigentol::{DesignVariable, Excitation, Input, Output, Study};
use eigentol_interpreter::Interpreted;

const ROTOR: &str = "mechanism Rotor {
    input speed: rad/s;
    design m = 12 kg +/- 1%;
    design k = 1.9e6 N/m +/- 4%;
    design e = 0.04 mm +/- 20%;
    body hub: massless;
    body disk: disk(mass: m, radius: 0.2 m, axis: z);
    joint x: prismatic(x) from ground to hub;
    joint spin: revolute(z) from hub to disk, driven at speed;
    force shaft: spring(on: x, stiffness: k);
    force oil: damper(on: x, damping: 310 N*s/m);
    unbalance u: on disk, eccentricity: e;
    output shake = x;
}";

fn rotor() -> Study<Interpreted> {
    let machine = Interpreted::from_text(ROTOR).expect("a declaration");
    Study::new(machine).input(Input::new(0), 300.0).samples(100)
}

fn shake() -> Vibration {
    Vibration::new::<Interpreted>(Output::new(0), Excitation::new(0))
}

fn peak(low: f64, high: f64, quantity: PeakQuantity) -> Response {
    Response::Peak { vibration: shake(), range: Range::new(Input::new(0), low, high), quantity }
}

/// A response and its derivatives.
fn answer(study: &Study<Interpreted>, wanted: Response) -> (Option<f64>, Option<Vec<f64>>) {
    let (state, modes) = (study.equilibrium(), study.modes());
    let (state, modes) = (state.expect("a state"), modes.expect("modes"));
    let all = Responses::new(study.mechanism(), &state, &modes, vec![wanted]).expect("responses");
    let found = all.with_gradients(&mut all.workspace(), &state.design);
    let found = found.expect("a realisation");
    let slopes = found.gradients[0].as_ref().map(|gradient| gradient.to_vec());
    (found.values[0], slopes)
}

#[test]
fn a_peak_is_the_one_that_peaks_find() {
    let study = rotor();
    let found = study.peaks(shake(), Input::new(0), 200.0, 600.0);
    let own = &found.expect("peaks").peaks[0];
    for (quantity, expected) in [(PeakQuantity::Height, &own.height), (PeakQuantity::Place, &own.place)] {
        for (low, high) in [(200.0, 600.0), (600.0, 200.0)] {
            let (value, slopes) = answer(&study, peak(low, high, quantity));
            let value = value.expect("a peak");
            assert!((value / expected.value - 1.0).abs() < 1e-11, "{value}");
            for (slope, exact) in slopes.expect("slopes").iter().zip(&expected.by_design) {
                assert!((slope - exact).abs() <= 1e-8 * exact.abs(), "{slope} {exact}");
            }
        }
    }
}

#[test]
fn without_a_peak_an_end_is_greatest() {
    let study = rotor();
    let (value, slopes) = answer(&study, peak(200.0, 300.0, PeakQuantity::Height));
    let there = study.forced_sensitivities().expect("a vibration");
    let modulus = there.response.harmonics[0].outputs[0].expect("an amplitude").norm();
    assert!((value.expect("an end") / modulus - 1.0).abs() < 1e-12);
    let exact = there.modulus(0, Output::new(0), shake().measure);
    let exact = exact.expect("smooth").by_design;
    for (slope, exact) in slopes.expect("slopes").iter().zip(&exact) {
        assert!((slope - exact).abs() <= 1e-9 * exact.abs(), "{slope} {exact}");
    }
    let none = answer(&study, peak(200.0, 300.0, PeakQuantity::Place));
    assert_eq!(none, (None, None));
}

#[test]
fn derivatives_are_those_of_differences() {
    const STEP: f64 = 1e-5;
    for quantity in [PeakQuantity::Height, PeakQuantity::Place] {
        let wanted = peak(200.0, 600.0, quantity);
        let slopes = answer(&rotor(), wanted).1.expect("slopes");
        let design = rotor().design_values().to_vec();
        for (k, (slope, at)) in slopes.iter().zip(design).enumerate() {
            let end = |step: f64| {
                let study = rotor().design(DesignVariable::new(k), at * (1.0 + step));
                answer(&study, wanted).0.expect("a peak")
            };
            let difference = (end(STEP) - end(-STEP)) / (2.0 * STEP * at);
            let size = slope.abs() + 1e-4 * end(0.0) / at;
            assert!((difference - slope).abs() <= 1e-6 * size, "{k}: {difference} {slope}");
        }
    }
}

#[test]
fn requirements_limit_it() {
    are_limited(false);
}

#[test]
#[ignore = "half a minute"]
fn several_requirements_limit_it() {
    are_limited(true);
}

/// The place of the peak, and its height too where `both` are wanted.
fn are_limited(both: bool) {
    let study = rotor();
    let height = peak(300.0, 500.0, PeakQuantity::Height);
    let response = peak(300.0, 500.0, PeakQuantity::Place);
    let nominal = answer(&study, height).0.expect("a peak");
    let at_most = Requirement::at_most(height, 1.1 * nominal);
    let all = [at_most, Requirement::away(response, Input::new(0), 0.31)];
    let wanted = &all[usize::from(!both)..];
    let found = study.probability(wanted).expect("probabilities");
    let sampled = study.clone().samples(300).chances(wanted).expect("chances");
    let distances: Vec<f64> = found.each.iter().map(|x| x.value).collect();
    for (own, counted) in found.each.iter().zip(&sampled.each) {
        let share = counted.failed as f64 / sampled.all.samples() as f64;
        assert!(own.value > 0.0 && own.value < 0.5, "{distances:?}");
        assert!((own.value - share).abs() < 0.05, "{distances:?} {share}");
    }
    let text = found.to_string();
    let names = ["greatest shake under u along speed", "speed at the peak of shake under u"];
    for name in &names[usize::from(!both)..] {
        assert!(text.contains(name), "{text}");
    }
    let spread = study.propagate(&[height, response]).expect("a spread");
    assert!(spread.spreads.iter().all(Option::is_some));
}
