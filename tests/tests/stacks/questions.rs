//! Every question, in the order of `runtime/src/study`.

use std::hint::black_box;
use std::ops::ControlFlow;

use eigentol::allocation::{Choices, Cost, HalfWidth};
use eigentol::equilibrium::Search;
use eigentol::kernels::{BatchKernels, CurvatureKernels, PictureKernels};
use eigentol::mistuning::EngineOrder;
use eigentol::requirement::Requirement;
use eigentol::response::{Response, Vibration};
use eigentol::sensitivity::Quantity;
use eigentol::{DesignVariable, Error, Excitation, Input, Output, Study, sweep};

/// Where the interesting ranges of a machine lie.
#[derive(Clone, Copy)]
pub(crate) struct Range {
    /// Range of the sweep.
    pub(crate) sweep: [f64; 3],
    /// Range of the branches.
    pub(crate) branches: [f64; 2],
    /// Range that contains a critical state.
    pub(crate) critical: [f64; 2],
    /// Range in which frequencies cross a multiple of the input.
    pub(crate) crossings: [f64; 2],
    /// That multiple.
    pub(crate) order: f64,
}

/// A question with its name: the one that overflows its stack is named in the message.
pub(crate) type Question<M> = (&'static str, fn(&Study<M>, &Range));

fn growth<M: BatchKernels + CurvatureKernels + PictureKernels>(study: &Study<M>) -> Response {
    Response::Mode { mode: mode(study), quantity: Quantity::Growth }
}

fn answered<T>(answer: Result<T, Error>) {
    black_box(answer.expect("an answer"));
}

fn input<M>() -> Input<M> {
    Input::new(0)
}

/// The first mode that oscillates.
fn mode<M: BatchKernels + CurvatureKernels + PictureKernels>(study: &Study<M>) -> usize {
    let frequencies = study.modes().expect("modes").frequencies();
    let oscillates = frequencies.iter().position(Option::is_some);
    oscillates.expect("one that oscillates")
}

/// Unit steps in all variables.
fn direction<M: BatchKernels + CurvatureKernels + PictureKernels>(study: &Study<M>) -> (Vec<f64>, Vec<f64>) {
    let (u, b) = (study.input_values(), study.design_values());
    (vec![1.0; u.len()], vec![1.0; b.len()])
}

fn search<M: BatchKernels + CurvatureKernels + PictureKernels>(study: &Study<M>) -> Search {
    let start = study.start_values();
    let shifted = |by: f64| start.iter().map(|value| value + by).collect::<Vec<f64>>();
    Search::new(shifted(-0.01), shifted(0.01)).starts(1)
}

/// Questions about one state.
pub(crate) fn at_one_state<M: BatchKernels + CurvatureKernels + PictureKernels + Clone>() -> Vec<Question<M>> {
    vec![
        ("equilibrium", |s, _| answered(s.equilibrium())),
        ("assembly", |s, _| answered(s.assembly())),
        ("equilibria", |s, _| answered(s.equilibria(&search(s)))),
        // Some machines need bounds.
        ("search", |s, _| drop(black_box(s.search(&[])))),
        ("modes", |s, _| answered(s.modes())),
        ("equilibrium_shift", |s, _| answered(s.equilibrium_shift())),
        ("outputs", |s, _| answered(s.outputs())),
        ("output_tolerances", |s, _| answered(s.output_tolerances())),
        ("sensitivities", |s, _| answered(s.sensitivities())),
        ("first_order", |s, _| answered(s.first_order())),
        ("whirls", |s, _| answered(s.whirls())),
        ("picture", |s, _| answered(s.picture())),
        ("vibration_pictures", |s, _| {
            let pictures = s.vibration_pictures(Excitation::new(0), 4, 0.1);
            let _ = black_box(pictures);
        }),
        ("mode_pictures", |s, _| answered(s.mode_pictures(mode(s), 2, 0.1))),
        ("directional_derivatives", |s, _| {
            let (u, b) = direction(s);
            answered(s.directional_derivatives(mode(s), (&u, &b)));
        }),
        ("shape_sensitivity", |s, _| {
            answered(s.shape_sensitivity(mode(s)));
        }),
        ("convergence", |s, _| {
            let again = || s.mechanism().clone();
            answered(s.convergence([again(), again()]));
        }),
        ("convergence_along", |s, range| {
            let again = || s.mechanism().clone();
            let [low, high] = range.crossings;
            let range = sweep::Range::new(input(), low, high);
            answered(s.convergence_along([again(), again()], range, &[]));
        }),
        ("mode_curvature", |s, _| answered(s.mode_curvature(mode(s)))),
        ("output_curvature", |s, _| {
            answered(s.output_curvature(Output::new(0)));
        }),
        ("second_order", |s, _| answered(s.second_order())),
        // Most machines have no blades.
        ("mistuning", |s, _| {
            let asked = EngineOrder { ring: 0, coordinate: 0, order: 1, samples: 1, seed: 0 };
            drop(black_box(s.mistuning(asked)));
        }),
        ("clusters", |s, _| answered(s.clusters())),
        ("monte_carlo", |s, _| answered(s.monte_carlo())),
        ("samples_between", |s, _| answered(s.samples_between(0..1))),
        ("sample_modes", |s, _| answered(s.sample_modes(&s.sampling()))),
        ("resume_samples", |s, _| {
            let mut part = s.samples_between(1..2).expect("samples");
            answered(s.resume_samples(&mut part, &s.sampling()));
        }),
        ("summary", |s, _| answered(s.summary())),
        ("summary_within", |s, _| answered(s.summary_within(1e5))),
    ]
}

/// Statistical questions.
pub(crate) fn of_chance<M: BatchKernels + CurvatureKernels + PictureKernels>() -> Vec<Question<M>> {
    const SAMPLES: usize = 8;
    fn wanted<M: BatchKernels + CurvatureKernels + PictureKernels>(study: &Study<M>) -> [Requirement; 2] {
        [Requirement::at_most(growth(study), 1e3), Requirement::Stable]
    }
    // An answer or an error will do: only the depth of the calls matters for overflow.
    fn replied<T>(answer: Result<T, Error>) {
        let _ = black_box(answer);
    }
    vec![
        ("propagate", |s, _| replied(s.propagate(&[growth(s)]))),
        ("sample_responses", |s, _| {
            let sampling = s.sampling().samples(SAMPLES);
            answered(s.sample_responses(&[growth(s)], &sampling));
        }),
        ("worst_case", |s, _| replied(s.worst_case(&[growth(s)]))),
        ("influence", |s, _| replied(s.influence(&[growth(s)]))),
        ("chances", |s, _| answered(s.chances(&wanted(s)))),
        ("chances_by", |s, _| {
            answered(s.chances_by(&wanted(s), &s.sampling()));
        }),
        ("reliability", |s, _| replied(s.reliability(&wanted(s)))),
        ("probability", |s, _| replied(s.probability(&wanted(s)))),
        ("allocation", |s, _| {
            let widths = HalfWidth { variable: 0, limits: (1e-6, 1e-3), cost: Cost::reciprocal(0.0, 1.0, 1.0) };
            let choices = Choices { half_widths: vec![widths], nominals: Vec::new(), failure: vec![0.5, 0.5] };
            replied(s.allocation(&wanted(s), &choices));
        }),
    ]
}

/// Questions about forced vibration; a machine without excitations has none.
pub(crate) fn of_vibration<M: BatchKernels + CurvatureKernels + PictureKernels>() -> Vec<Question<M>> {
    fn told<M: BatchKernels + CurvatureKernels + PictureKernels, T>(study: &Study<M>, answer: Result<T, Error>) {
        match study.description().excitations.is_empty() {
            true => drop(black_box(answer)),
            false => answered(answer),
        }
    }
    fn wanted<M>() -> Vibration {
        Vibration::new::<M>(Output::new(0), Excitation::new(0))
    }
    vec![
        ("forced_response", |s, _| told(s, s.forced_response())),
        ("forced_sensitivities", |s, _| {
            told(s, s.forced_sensitivities());
        }),
        ("share_sensitivities", |s, _| {
            told(s, s.share_sensitivities());
        }),
        ("forced_curvature", |s, _| told(s, s.forced_curvature())),
        ("peaks", |s, range| {
            let [low, high] = range.crossings;
            told(s, s.peaks(wanted::<M>(), input(), low, high));
        }),
        ("peaks_of", |s, range| {
            let [low, high] = range.crossings;
            told(s, s.peaks_of(&[wanted::<M>(); 2], input(), low, high));
        }),
        ("vibration_spread", |s, _| {
            told(s, s.vibration_spread(&[wanted::<M>()]));
        }),
        ("bode", |s, range| told(s, s.bode(input(), &range.sweep))),
        ("bode_bands", |s, range| {
            let bands = s.bode_bands(input(), &range.sweep, &[wanted::<M>()], 4);
            told(s, bands);
        }),
    ]
}

/// Questions along the first input.
pub(crate) fn along_an_input<M: BatchKernels + CurvatureKernels + PictureKernels>() -> Vec<Question<M>> {
    macro_rules! between {
        ($name:ident, $range:ident) => {
            (stringify!($name), |s, range| {
                let [low, high] = range.$range;
                answered(s.$name(input(), low, high));
            })
        };
    }
    macro_rules! crossings {
        ($name:ident) => {
            (stringify!($name), |s, range| {
                let [low, high] = range.crossings;
                answered(s.$name(input(), low, high, range.order));
            })
        };
    }
    vec![
        ("sweep", |s, range| answered(s.sweep(input(), &range.sweep))),
        ("sweep_each", |s, range| {
            answered(s.sweep_each(input(), &range.sweep, |_| ControlFlow::Continue(())));
        }),
        ("sensitivity_sweep", |s, range| {
            answered(s.sensitivity_sweep(input(), &range.sweep, |_, slopes| assert!(slopes.is_ok())));
        }),
        ("first_order_sweep", |s, range| {
            answered(s.first_order_sweep(input(), &range.sweep));
        }),
        ("campbell", |s, range| {
            answered(s.campbell(input(), &range.sweep, &[range.order]));
        }),
        ("campbell_each", |s, range| {
            let each = |_| ControlFlow::Continue(());
            answered(s.campbell_each(input(), &range.sweep, &[range.order], each));
        }),
        ("events", |s, range| {
            let [low, high] = range.crossings;
            answered(s.events(input(), low, high, &[range.order]));
        }),
        ("event_map", |s, range| {
            let [low, high] = range.crossings;
            let over = DesignVariable::new(0);
            let value = s.design_values()[0];
            answered(s.event_map(input(), low, high, &[range.order], over, &[value]));
        }),
        between!(branches, branches),
        ("branches_with", |s, range| {
            let [low, high] = range.branches;
            let continuation = s.continuation(input(), low, high).expect("an input");
            answered(s.branches_with(&continuation, Some(&search(s))));
        }),
        ("branches_each", |s, range| {
            let [low, high] = range.branches;
            let continuation = s.continuation(input(), low, high).expect("an input");
            answered(s.branches_each(&continuation, None, |_| {}));
        }),
        between!(continuation, branches),
        between!(critical_state, critical),
        between!(critical_tolerance, critical),
        between!(critical_curvature, critical),
        crossings!(crossings),
        crossings!(crossing_tolerances),
        between!(flutter_onsets, crossings),
        between!(flutter_onset_tolerances, crossings),
    ]
}
