//! Derivatives of what each excitation contributes, and of orbits, against differences.

use eigentol::forced::{Extent, Measure};
use eigentol::response::Vibration;
use eigentol::sensitivity::Slopes;
use eigentol::{Complex, DesignVariable, Excitation, Input, Output, Study};
use eigentol_interpreter::Interpreted;
use eigentol_tests::corpus::declarations;

/// A fan with three unbalances, shaken, with a harmonic force and a moment.
fn fan() -> Study<Interpreted> {
    let all = declarations();
    let own = all.iter().find(|pair| pair.0 == "balanced_fan");
    let machine = Interpreted::from_text(own.expect("the fan").1).expect("a declaration");
    Study::new(machine).input(Input::new(0), 150.0).input(Input::new(1), 90.0)
}

/// Compares derivatives of numbers with central differences.
fn compare(study: &Study<Interpreted>, of: impl Fn(&Study<Interpreted>) -> Vec<Complex>, slopes: &[Slopes<Complex>]) {
    const STEP: f64 = 1e-5;
    let values = of(study);
    assert_eq!(values.len(), slopes.len());
    let inputs = study.input_values().to_vec();
    let design = study.design_values().to_vec();
    let check = |name: &str, at: f64, ends: [Vec<Complex>; 2], exact: Vec<Complex>| {
        for (k, exact) in exact.into_iter().enumerate() {
            let difference = (ends[1][k] - ends[0][k]) / (2.0 * STEP * at);
            let size = exact.norm() + (values[k] / at).norm();
            assert!((difference - exact).norm() <= 1e-6 * size, "{name}, {k}: {difference} {exact}");
        }
    };
    for (k, &at) in inputs.iter().enumerate() {
        let moved = |step: f64| of(&study.clone().input(Input::new(k), at * (1.0 + step)));
        let exact = slopes.iter().map(|slope| slope.by_input[k]).collect();
        check("input", at, [moved(-STEP), moved(STEP)], exact);
    }
    for (k, &at) in design.iter().enumerate() {
        let variable = DesignVariable::new(k);
        let moved = |step: f64| of(&study.clone().design(variable, at * (1.0 + step)));
        let exact = slopes.iter().map(|slope| slope.by_design[k]).collect();
        check("design", at, [moved(-STEP), moved(STEP)], exact);
    }
}

#[test]
fn shares_have_the_derivatives_of_differences() {
    let study = fan();
    let found = study.share_sensitivities().expect("shares");
    let count = study.description().excitations.len();
    let excitations: Vec<usize> =
        (found.response.harmonics.iter()).map(|harmonic| harmonic.shares[0].excitation).collect();
    assert_eq!(excitations, (0..count).collect::<Vec<_>>());
    let shares = |study: &Study<Interpreted>| {
        let response = study.forced_response().expect("a vibration");
        let harmonics = response.harmonics.iter();
        let mut all: Vec<_> = harmonics.flat_map(|harmonic| &harmonic.shares).collect();
        all.sort_by_key(|x| x.excitation);
        let values = all.iter().flat_map(|x| x.outputs.iter().map(|y| y.expect("an amplitude")));
        values.collect()
    };
    let slopes = found.harmonics.iter().flat_map(|harmonic| harmonic.outputs.iter());
    let slopes: Vec<_> = slopes.map(|slope| slope.clone().expect("smooth")).collect();
    compare(&study, shares, &slopes);
    let text = found.to_string();
    assert!(text.contains("across under screw") && text.contains("rad/s"), "{text}");
}

#[test]
fn shares_add_up_to_the_vibration() {
    let study = fan();
    let (all, each) =
        (study.forced_sensitivities().expect("a vibration"), study.share_sensitivities().expect("shares"));
    for (of, harmonic) in all.response.harmonics.iter().zip(&all.harmonics) {
        for (output, slopes) in harmonic.outputs.iter().enumerate() {
            let slopes = slopes.as_ref().expect("smooth");
            let mut sum = vec![Complex::ZERO; slopes.iter().count()];
            let mut size = 0.0;
            for share in &of.shares {
                let own = each.complex(share.excitation, Output::new(output), Measure::Displacement);
                for (sum, slope) in sum.iter_mut().zip(own.expect("smooth").iter()) {
                    *sum += slope;
                    size += slope.norm();
                }
            }
            for (sum, slope) in sum.iter().zip(slopes.iter()) {
                assert!((sum - slope).norm() <= 1e-11 * size, "{sum} {slope}");
            }
        }
    }
}

#[test]
fn orbits_have_the_derivatives_of_differences() {
    let study = fan();
    let [x, y] = ["height", "across"].map(|x| study.find_output(x).expect("an output").any());
    let found = study.forced_sensitivities().expect("a vibration");
    let axes: Vec<Vibration> = (found.response.description.excitations.iter().enumerate())
        .filter(|(k, info)| info.with == *k)
        .flat_map(|(k, _)| [Extent::Major(y), Extent::Minor(y)].map(|x| (k, x)))
        .map(|(k, extent)| Vibration::new(x, Excitation::new(k)).extent(extent))
        .collect();
    let values = |study: &Study<Interpreted>| {
        let response = study.forced_response().expect("a vibration");
        let orbits = response.harmonics.iter().map(|harmonic| harmonic.orbit(x, y));
        orbits.flat_map(|orbit| orbit.expect("outputs").semi_axes().map(Complex::from)).collect()
    };
    let slopes: Vec<_> = axes.iter().map(|x| x.slopes(&found).expect("smooth").map(Complex::from)).collect();
    compare(&study, values, &slopes);
    assert_eq!(Vibration::new(x, Excitation::new(99)).extent(Extent::Major(y)).slopes(&found), None);
}
