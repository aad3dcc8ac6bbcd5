//! Single measurements without a peer: the ratio reported in the paper, many speeds on two cores, and the
//! full analysis of a long chain.

use std::env;
use std::hint::black_box;
use std::thread;
use std::time::Instant;

use eigentol::equilibrium::equilibrium;
use eigentol::kernels::CurvatureKernels;
use eigentol::modes::modes;
use eigentol::scalar::Instructions;
use eigentol::second_order::mode_curvature;
use eigentol::second_order::second_order;
use eigentol::sensitivity::sensitivities;
use eigentol::{Error, Policy, Study, Tolerances, Vector};

use crate::chains::{LONGEST, Longest};
use crate::pendulum::DoublePendulum;

/// Names of the sections, for the filter.
pub(crate) const PENDULUM: &str = "facts/pendulum";
pub(crate) const LONG_CHAIN: &str = "facts/long-chain";

/// Samples and speeds used in the paper.
const SAMPLES: usize = 3000;
const SPEEDS: usize = 100;
/// How often first order is timed.
const ANALYSES: usize = 50;

/// A name and a value.
pub(crate) type Fact = (String, String);

fn speed(k: usize) -> f64 {
    8.0 * (k + 1) as f64 / SPEEDS as f64
}

type PendulumStudy = Study<DoublePendulum>;

/// One study per speed, below and above the critical speed, with the paper's start values.
fn studies() -> Vec<PendulumStudy> {
    let start = 60f64.to_radians();
    let study = Study::new(DoublePendulum).start(DoublePendulum::theta1, start).samples(SAMPLES);
    let at = |k| study.clone().input(DoublePendulum::omega, speed(k));
    (0..SPEEDS).map(at).collect()
}

/// The shortest time of several runs, in seconds.
pub(crate) fn fastest(runs: usize, mut run: impl FnMut()) -> f64 {
    fastest_with(runs, || (), |()| run())
}

/// [`fastest`] of runs each of which works on something prepared beforehand and dropped afterwards. Its memory is used
/// again: the first touch of fresh memory takes longer than an analysis.
fn fastest_with<T>(runs: usize, prepare: impl Fn() -> T, mut run: impl FnMut(&T)) -> f64 {
    let timed = (0..runs).map(|_| {
        let prepared = prepare();
        let start = Instant::now();
        run(&prepared);
        start.elapsed().as_secs_f64()
    });
    timed.fold(f64::INFINITY, f64::min)
}

/// Exact first order against Monte Carlo, with all four dimensions, on one thread; then Monte Carlo on two.
pub(crate) fn pendulum() -> Vec<Fact> {
    let studies = studies();
    // A study solves its operating point once.
    let analytic = fastest_with(ANALYSES, self::studies, |unsolved| {
        for study in unsolved {
            let _ = black_box(&study.first_order());
        }
    });
    let speeds: Vec<f64> = (0..SPEEDS).map(speed).collect();
    let along = fastest(ANALYSES, || {
        let _ = black_box(studies[0].first_order_sweep(DoublePendulum::omega, &speeds));
    });
    let sampled = |studies: &[PendulumStudy]| {
        fastest(3, || {
            for study in studies {
                let _ = black_box(&study.monte_carlo());
            }
        })
    };
    let with = |threads: usize, vectors: Option<Instructions>| -> Vec<PendulumStudy> {
        let set = |study: &PendulumStudy| study.clone().threads(threads).vectors(vectors);
        studies.iter().map(set).collect()
    };
    let best = Some(Instructions::best());
    let scalar = sampled(&with(1, None));
    let one = sampled(&with(1, best));
    let two = sampled(&with(2, best));
    let fact = |name: &str, value: String| (format!("double pendulum: {name}"), value);
    vec![
        fact("first-order analysis from a cold start, per speed", format!("{:.0} ns", analytic * 1e9 / SPEEDS as f64)),
        fact("first-order analysis along the speeds, per speed", format!("{:.0} ns", along * 1e9 / SPEEDS as f64)),
        fact(
            "Monte Carlo of 3000 samples one by one, one thread, per speed",
            format!("{:.3} ms", scalar * 1e3 / SPEEDS as f64),
        ),
        fact(
            "Monte Carlo of 3000 samples in vectors, one thread, per speed",
            format!("{:.3} ms", one * 1e3 / SPEEDS as f64),
        ),
        fact("Monte Carlo one by one against first order, both one thread", format!("{:.0}x", scalar / analytic)),
        fact(
            "Monte Carlo one by one against first order along the speeds, both one thread",
            format!("{:.0}x", scalar / along),
        ),
        fact("Monte Carlo, 3000 samples x 100 speeds, two threads", format!("{:.1} ms", two * 1e3)),
    ]
}

/// Stack size for the long chain, whose kernels return arrays. `RUST_MIN_STACK` overrides it.
const STACK: usize = 1 << 29;

/// Every step of the analysis of the longest chain, with all its design variables and second derivatives.
pub(crate) fn long_chain() -> Vec<Fact> {
    let builder = match env::var_os("RUST_MIN_STACK") {
        Some(_) => thread::Builder::new(),
        None => thread::Builder::new().stack_size(STACK),
    };
    let steps = builder.spawn(|| analysis(&Longest::default()));
    let steps = match steps.map(|thread| thread.join()) {
        Ok(Ok(steps)) => steps,
        _ => vec![("thread".to_owned(), Err("it could not run".to_owned()))],
    };
    let fact = |(step, outcome): (String, Result<f64, String>)| {
        let value = match outcome {
            Ok(seconds) => format!("{:.3} ms", seconds * 1e3),
            Err(reason) => format!("failed: {reason}"),
        };
        (format!("{LONGEST} bars, {} variables: {step}", 2 * LONGEST), value)
    };
    steps.into_iter().map(fact).collect()
}

type Step = (String, Result<f64, String>);

/// Time of each step; stops at the first that fails.
fn analysis(chain: &dyn CurvatureKernels) -> Vec<Step> {
    let mut steps = Vec::new();
    if let Err(error) = measure(chain, &mut steps) {
        steps.push(("stopped".to_owned(), Err(error.to_string())));
    }
    steps
}

fn measure(chain: &dyn CurvatureKernels, steps: &mut Vec<Step>) -> Result<(), Error> {
    let description = chain.description();
    let n = description.coordinates.len();
    let u = [1.0];
    let b: Vector = description.design.iter().map(|info| info.nominal).collect();
    let tolerances = Tolerances::declared(&description)?;
    let mut timed = |name: &str, runs: usize, run: &mut dyn FnMut()| {
        steps.push((name.to_owned(), Ok(fastest(runs, run))));
    };
    let hanging = vec![0.1; n];
    let find = || equilibrium(chain, &u, &b, &hanging, Policy::Stable);
    let state = find()?;
    timed("equilibrium", 5, &mut || {
        let _ = black_box(&find());
    });
    let found = modes(&state)?;
    timed("modes", 5, &mut || {
        let _ = black_box(&modes(&state));
    });
    sensitivities(chain, &state, &found)?;
    timed("sensitivities of all modes", 5, &mut || {
        let _ = black_box(&sensitivities(chain, &state, &found));
    });
    mode_curvature(chain, &state, &found, 0)?;
    timed("Hessian of one mode", 3, &mut || {
        let _ = black_box(&mode_curvature(chain, &state, &found, 0));
    });
    let mut solved = 0;
    timed("second order of all modes", 1, &mut || {
        let spreads = second_order(chain, &state, &found, &tolerances);
        solved = spreads.modes.iter().filter(|mode| mode.is_ok()).count();
        black_box(&spreads);
    });
    if solved < n {
        let reason = format!("{} of {n} modes", n - solved);
        steps.push(("second order".to_owned(), Err(reason)));
    }
    Ok(())
}
