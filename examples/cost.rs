//! What Monte Carlo costs against first order (tables 1 and 2 of the paper): CPU time of the calling thread alone, so that
//! neither a busy machine nor the number of threads changes the ratio.

use std::error::Error;
use std::hint::black_box;
use std::io::Write;
use std::time::Duration;

use cpu_time::ThreadTime;
use eigentol::{Input, Mechanism, Study};

/// Samples at each speed, as in the paper.
const SAMPLES: usize = 3000;

/// Writes how many times longer Monte Carlo takes than first order over all `speeds`; `paper` is the paper's ratio.
pub(crate) fn compare<M: Mechanism>(
    out: &mut dyn Write,
    study: &Study<M>,
    (input, speeds): (Input<M>, &[f64]),
    paper: f64,
) -> Result<(), Box<dyn Error>> {
    let vectors = study.clone().samples(SAMPLES).threads(1);
    let one_by_one = vectors.clone().vectors(None);
    let anew = time(|| {
        for &speed in speeds {
            black_box(one_by_one.clone().input(input, speed).first_order()).ok();
        }
    });
    let along = time(|| {
        black_box(one_by_one.first_order_sweep(input, speeds)).ok();
    });
    writeln!(
        out,
        "CPU time of one thread over {} speeds. First order: equilibrium, modes, their derivatives, spread.\n\
         Monte Carlo: equilibrium and modes of {SAMPLES} samples at each speed.\n  \
         first order, each speed anew   {:10.3} ms\n  \
         first order, along the speeds  {:10.3} ms",
        speeds.len(),
        1e3 * anew,
        1e3 * along
    )?;
    let in_paper = format!(" (in the paper {paper})");
    for (how, study, paper) in [("one by one", one_by_one, &*in_paper), ("in vectors", vectors, "")] {
        let sampled = time(|| {
            for &speed in speeds {
                black_box(study.clone().input(input, speed).monte_carlo()).ok();
            }
        });
        writeln!(
            out,
            "  Monte Carlo, samples {how}{:10.3} ms: {:.0} times first order anew{paper}, {:.0} times along",
            1e3 * sampled,
            sampled / anew,
            sampled / along
        )?;
    }
    Ok(())
}

/// CPU time of one call in seconds, the mean of as many as take a tenth of a second.
fn time(mut work: impl FnMut()) -> f64 {
    let start = ThreadTime::now();
    let mut calls = 0;
    while calls == 0 || start.elapsed() < Duration::from_millis(100) {
        work();
        calls += 1;
    }
    start.elapsed().as_secs_f64() / f64::from(calls)
}
