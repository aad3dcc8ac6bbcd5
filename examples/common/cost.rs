//! CPU time of the first-order analysis against Monte Carlo (tables 1 and 2 of the paper).
//!
//! Both run on the calling thread alone and their own CPU time is measured, so that neither a busy machine nor the
//! number of threads changes the ratio. Both start each speed from the equilibrium of the speed before.

use std::hint::black_box;
use std::time::Duration;

use cpu_time::ThreadTime;
use eigentol::sensitivity::sensitivities;
use eigentol::tolerance::{Sampling, first_order, monte_carlo};
use eigentol::{Error, Mechanism, Study};

use crate::Question;

/// The first-order analysis is repeated until it took this long: one pass is too short to be measured.
const MEASURABLE: Duration = Duration::from_millis(100);

/// More samples than the paper's are not timed: they would only make the same comparison longer.
const MOST_SAMPLES: usize = 3000;

/// CPU time for one tolerance over all speeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// The tolerance.
    pub level: f64,
    /// One pass of equilibrium, modes, sensitivities and first-order spread at every speed.
    pub analytic: Duration,
    /// How many passes were averaged.
    pub passes: u32,
    /// Equilibrium, modes and all samples at every speed.
    pub monte_carlo: Duration,
    /// Samples at each speed.
    pub samples: usize,
}

impl Cost {
    /// How many times longer Monte Carlo takes.
    pub fn ratio(&self) -> f64 {
        self.monte_carlo.as_secs_f64() / self.analytic.as_secs_f64().max(1e-9)
    }

    /// Measures one tolerance at all speeds.
    ///
    /// # Errors
    /// Those of the sweep; a speed that fails is passed over by both.
    pub fn measure<M, const N: usize, const U: usize, const P: usize, const O: usize>(
        study: &Study<M, N, U, P, O>,
        question: &Question,
        level: f64,
        speeds: &[f64],
        sampling: &Sampling<'_>,
    ) -> Result<Self, Error>
    where
        M: Mechanism<N, U, P, O>,
    {
        let mechanism = study.mechanism();
        let start = ThreadTime::now();
        let mut passes = 0;
        while passes == 0 || start.elapsed() < MEASURABLE {
            for point in study.sweep(question.speed, speeds)? {
                if let (Ok(state), Ok(modes)) = (&point.equilibrium, &point.modes)
                    && let Ok(slopes) = sensitivities(mechanism, state, modes)
                {
                    let tolerances = question.tolerances(&state.design, level)?;
                    black_box(first_order(modes, &slopes, &tolerances));
                }
            }
            passes += 1;
        }
        let analytic = start.elapsed() / passes;
        let sampling = Sampling {
            samples: sampling.samples.min(MOST_SAMPLES),
            threads: 1,
            progress: None,
            ..*sampling
        };
        let start = ThreadTime::now();
        for point in study.sweep(question.speed, speeds)? {
            if let (Ok(state), Ok(modes)) = (&point.equilibrium, &point.modes) {
                let tolerances = question.tolerances(&state.design, level)?;
                black_box(monte_carlo(
                    mechanism,
                    state,
                    modes,
                    &tolerances,
                    &sampling,
                )?);
            }
        }
        Ok(Self {
            level,
            analytic,
            passes,
            monte_carlo: start.elapsed(),
            samples: sampling.samples,
        })
    }
}
