//! CPU time of the first-order analysis against Monte Carlo (tables 1 and 2 of the paper).
//!
//! Both run on the calling thread alone and their own CPU time is measured, so neither a busy machine nor the number of
//! threads changes the ratio; Monte Carlo takes its samples one by one, as the analysis takes its speeds. Each is a
//! single call to [`Study`], as a user would make it, and both search for the equilibrium of each speed from the start
//! value of the study, as the paper does.

use std::hint::black_box;
use std::time::Duration;

use cpu_time::ThreadTime;
use eigentol::tolerance::Sampling;
use eigentol::{Mechanism, Study};

use crate::Question;

/// The first-order analysis is repeated for at least this long: a single pass is too short to measure.
const MEASURABLE: Duration = Duration::from_millis(100);

/// Maximum number of samples timed, that of the paper: more would only prolong the same comparison.
const MOST_SAMPLES: usize = 3000;

/// CPU time for one tolerance over all speeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// The tolerance.
    pub level: f64,
    /// One pass of equilibrium, modes, sensitivities and first-order spread at every speed.
    pub first_order: Duration,
    /// The number of passes averaged.
    pub passes: u32,
    /// One pass of equilibrium, modes and all samples at every speed.
    pub monte_carlo: Duration,
    /// Samples at each speed.
    pub samples: usize,
}

impl Cost {
    /// How many times longer Monte Carlo takes.
    pub fn ratio(&self) -> f64 {
        self.monte_carlo.as_secs_f64() / self.first_order.as_secs_f64().max(1e-9)
    }

    /// Measures one tolerance at all speeds; the time spent on a failing speed counts for both methods.
    pub fn measure<M: Mechanism>(
        study: &Study<M>,
        question: &Question,
        level: f64,
        speeds: &[f64],
        sampling: &Sampling<'_>,
    ) -> Self {
        let samples = sampling.samples.min(MOST_SAMPLES);
        let ready = question
            .varied_by(study, level)
            .samples(samples)
            .seed(sampling.seed)
            .vectors(None)
            .threads(1);
        let at = |&speed: &f64| ready.clone().input(question.input(), speed);
        let studies: Vec<_> = speeds.iter().map(at).collect();

        let start = ThreadTime::now();
        let mut passes = 0;
        while passes == 0 || start.elapsed() < MEASURABLE {
            for study in &studies {
                black_box(study.first_order()).ok();
            }
            passes += 1;
        }
        let first_order = start.elapsed() / passes;

        let start = ThreadTime::now();
        for study in &studies {
            black_box(study.monte_carlo()).ok();
        }
        Self {
            level,
            first_order,
            passes,
            monte_carlo: start.elapsed(),
            samples,
        }
    }
}
