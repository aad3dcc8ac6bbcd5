//! Every machine of the corpus, read from text at run time, gives the same results as its compiled twin, bit for bit:
//! the same operations in another order, each on the same numbers.

use eigentol::kernels::{BatchKernels, CurvatureKernels, MotionKernels, PictureKernels};
use eigentol::response::Vibration;
use eigentol::{Coordinate, Description, Excitation, Input, Law, Mechanism, Policy, Study, ToleranceInfo};
use eigentol_interpreter::{Interpreted, ReadError};
use eigentol_tests::corpus::{self, Visitor};
use eigentol_tests::fits::{self, Fits};
use eigentol_tests::rederived::{Operation, operating_points};

/// The results of a study as text that shows every bit.
fn answers<M: BatchKernels + CurvatureKernels + PictureKernels + Clone>(
    machine: M,
    operation: &Operation,
) -> Vec<(&'static str, String)> {
    let mut study = Study::new(machine).policy(operation.policy).samples(100).threads(1).keep_samples(true);
    for (k, &value) in operation.inputs.iter().enumerate() {
        study = study.input(Input::new(k), value);
    }
    for (k, &value) in operation.start.iter().enumerate() {
        study = study.guess(Coordinate::new(k), value);
    }
    let state = study.equilibrium().expect("an equilibrium with modes");
    let modes = study.modes().expect("an equilibrium with modes");
    let mut answers = vec![
        ("equilibrium", format!("{state:?}")),
        ("modes", format!("{modes:?}")),
        ("whirls", format!("{:?}", study.whirls())),
        ("shift", format!("{:?}", study.equilibrium_shift())),
        ("sensitivities", format!("{:?}", study.sensitivities())),
        ("first order", format!("{:?}", study.first_order())),
        ("outputs", format!("{:?}", study.outputs())),
        ("spreads of outputs", format!("{:?}", study.output_tolerances())),
        ("curvature", format!("{:?}", study.mode_curvature(0))),
        ("shape", format!("{:?}", study.shape_sensitivity(0))),
        ("samples", format!("{:?}", study.monte_carlo())),
        ("picture", format!("{:?}", study.picture())),
        ("swing", format!("{:?}", study.mode_pictures(0, 4, 0.1))),
    ];
    let vibrations = Vibration::all(study.description());
    if let Some(&first) = vibrations.first() {
        let all = &vibrations[..];
        answers.extend([
            ("response", format!("{:?}", study.forced_response())),
            ("its slopes", format!("{:?}", study.forced_sensitivities())),
            ("its shares", format!("{:?}", study.share_sensitivities())),
            ("its curvature", format!("{:?}", study.forced_curvature())),
            ("its spread", format!("{:?}", study.vibration_spread(all))),
            ("its pictures", format!("{:?}", study.vibration_pictures(Excitation::new(0), 4, 0.1))),
        ]);
        for (input, &value) in operation.inputs.iter().enumerate() {
            let input = Input::new(input);
            let (low, high) = (0.4 * value, 1.2 * value);
            let bode = study.bode(input, &[low, value, high]);
            let peaks = study.peaks(first, input, low, high);
            answers.push(("along an input", format!("{bode:?} {peaks:?}")));
        }
    }
    if let Some(&value) = operation.inputs.first() {
        let values: Vec<f64> = (0..20).map(|k| value * (1.0 + 0.002 * f64::from(k))).collect();
        let sweep = study.sweep(Input::new(0), &values);
        answers.push(("sweep", format!("{sweep:?}")));
    }
    answers
}

/// The same for the kernels of the motion.
fn motion(machine: &dyn MotionKernels, operation: &Operation) -> String {
    let description = machine.description();
    let (q, u) = (&operation.start, &operation.inputs);
    let q: Vec<f64> = (0..description.coordinates.len()).map(|k| q.get(k).copied().unwrap_or(0.1)).collect();
    let b: Vec<f64> = description.design.iter().map(|info| info.nominal).collect();
    let rates: Vec<f64> = (0..q.len()).map(|k| 0.3 - 0.1 * k as f64).collect();
    format!(
        "{:?} {:?} {:?}",
        machine.motion(&rates, &q, u, &b),
        machine.motion_residual(&rates, &rates, &q, u, &b),
        machine.motion_linear(&rates, &rates, &q, u, &b),
    )
}

struct Twins(usize);

impl Visitor for Twins {
    fn visit<M: Mechanism + Copy>(&mut self, name: &'static str, declaration: &'static str, machine: M) {
        let twin = Interpreted::from_text(declaration).expect("a declaration");
        assert_eq!(twin.picture_info(), machine.picture_info(), "{name}");
        for operation in operating_points(name) {
            let found = answers(twin.clone(), &operation);
            for ((what, expected), (_, found)) in answers(machine, &operation).iter().zip(&found) {
                assert!(expected == found, "{name}, {what}:\n{expected}\n{found}");
                self.0 += 1;
            }
            assert_eq!(motion(&twin, &operation), motion(&machine, &operation), "{name}");
        }
    }
}

#[test]
fn twins_answer_alike() {
    let mut twins = Twins(0);
    corpus::visit(&mut twins);
    assert!(twins.0 > 200, "{}", twins.0);
}

/// Tolerances are constants of the compiled type; those of its interpreted twin come from the compiler's tables.
#[test]
fn twins_have_the_same_tolerances() {
    const DESCRIPTION: Description = Fits::DESCRIPTION;
    let compiled = DESCRIPTION;
    let twin = Interpreted::from_text(fits::DECLARATION).expect("a declaration");
    let twin = Study::new(twin);
    assert_eq!(twin.description().inputs, compiled.inputs);
    assert_eq!(twin.description().design, compiled.design);
    let limits = |lower, upper, law: Law| ToleranceInfo { lower, upper, relative: false, law };
    let one_percent = ToleranceInfo { relative: true, ..ToleranceInfo::half_width(0.01) };
    let inputs = compiled.inputs.iter().map(|info| info.tolerance.clone());
    let expected = [one_percent, limits(0.0, 0.5, Law::Uniform), ToleranceInfo::NONE];
    assert!(inputs.eq(expected), "{:?}", compiled.inputs);
    let beta = Law::Beta { alpha: 2.0, beta: 3.5 };
    let Law::OneOf(places) = &compiled.design[7].tolerance.law else { panic!("a list of values") };
    for (found, expected) in places.iter().zip([(0.0, 1.0), (0.25, 6.0), (1.0, 1.0)]) {
        assert!((found.0 - expected.0).abs() < 1e-12 && found.1 == expected.1);
    }
    let shim = Law::OneOf(places.clone());
    let expected = [
        limits(-0.02, 0.04, Law::Lognormal),
        limits(-63.0, 63.0, Law::Weibull),
        limits(-5e-5, 1e-4, Law::Normal),
        limits(0.0, 2.1e-5, Law::Triangular),
        limits(-4.1e-5, -2e-5, beta),
        ToleranceInfo::half_width(2e-4),
        limits(-2e-3, 2e-3, Law::TruncatedNormal),
        limits(-1e-4, 3e-4, shim),
    ];
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-15 * b.abs();
    for (info, expected) in compiled.design.iter().zip(expected) {
        let ToleranceInfo { lower, upper, law, .. } = &info.tolerance;
        assert!(near(*lower, expected.lower) && near(*upper, expected.upper) && *law == expected.law, "{info:?}");
        assert!(!info.tolerance.relative);
    }
}

#[test]
fn names_are_handles() {
    let governor = corpus::declarations().into_iter().find(|(name, _)| *name == "governor").expect("it is there");
    let governor = Interpreted::from_text(governor.1).expect("a declaration");
    let study = Study::new(governor);
    let speed = study.find_input("speed").expect("declared");
    assert_eq!(speed.index(), 0);
    assert!(study.find_input("no such input").is_err());
    let first = study.description().design[0].name.clone();
    assert_eq!(study.find_design(&first).expect("declared").index(), 0);
    let study = study.input(speed, 11.0).policy(Policy::Nearest);
    assert_eq!(study.input_values()[0], 11.0);
}

#[test]
fn mistakes_have_lines_and_columns() {
    let text = "mechanism Broken {\n    body bar: rod(mass: 3 kg, length: 1 m, along: -z);\n    joint theta: revolute(y) from gruond to bar;\n}\n";
    let mistakes = Interpreted::from_text(text).expect_err("`gruond` is no body");
    let first = mistakes.iter().next().expect("one at least");
    assert_eq!((first.line, first.column), (3, 35), "{mistakes}");
    assert_eq!((first.end_line, first.end_column), (3, 41));
    assert!(first.message.contains("gruond"), "{mistakes}");
    let unclosed = Interpreted::from_text("mechanism Open {").expect_err("no end");
    assert_eq!(unclosed.iter().count(), 1, "{unclosed}");
    assert!(matches!(Interpreted::from_file("no such file"), Err(ReadError::File { .. })));
}
