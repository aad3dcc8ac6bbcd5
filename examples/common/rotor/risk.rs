//! The effect of tolerances at the running speed: spread of every mode to second order, the probability that a
//! frequency lies near the running speed or that the rotor is unstable, and the same by Monte Carlo.

use eigentol::modes::Whirl;
use eigentol::second_order::{Band, Quadratic, SecondOrderSpread};
use eigentol::tolerance::{Outcome, Sample, Tolerances};
use eigentol::{Complex, Error, Mechanism, Study};

use super::RotorQuestion;
use crate::progress;

/// Number of samples held in memory at a time.
const BLOCK: usize = 1 << 14;

/// The rotor at its running speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Risk {
    /// One entry for each mode, by ascending natural frequency.
    pub modes: Vec<ModeRisk>,
    /// Probability that the rotor is unstable; at first and second order, that its least damped mode is.
    pub unstable: Chance,
}

/// One mode at the running speed.
#[derive(Clone, Debug, PartialEq)]
pub struct ModeRisk {
    /// Nominal eigenvalue, 1/s.
    pub s: Complex,
    /// Its whirl.
    pub whirl: Option<Whirl>,
    /// Its frequency to second order, rad/s; `None` if the mode has no derivatives of its own.
    pub frequency: Option<SecondOrderSpread>,
    /// Its damping ratio to second order; `None` if the mode has no derivatives of its own.
    pub damping_ratio: Option<SecondOrderSpread>,
    /// Its frequency over all samples in which it oscillates, rad/s.
    pub sampled_frequency: Sampled,
    /// Its damping ratio over the same samples.
    pub sampled_damping_ratio: Sampled,
    /// Probability that its frequency lies in the forbidden band.
    pub in_band: Chance,
}

/// A probability computed in three ways; the models give `None` if a mode has no derivatives of its own.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Chance {
    /// At first order.
    pub first_order: Option<f64>,
    /// Exact probability of the second-order model.
    pub second_order: Option<f64>,
    /// Number of samples that meet the condition.
    pub hits: usize,
    /// Number of samples.
    pub samples: usize,
}

impl Chance {
    /// The sampled probability and its standard error.
    pub fn sampled(&self) -> (f64, f64) {
        let samples = self.samples.max(1) as f64;
        let share = self.hits as f64 / samples;
        (share, (share * (1.0 - share) / samples).sqrt())
    }
}

/// Running sums of a sampled quantity about its nominal value.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sampled {
    nominal: f64,
    count: f64,
    sum: f64,
    squares: f64,
}

impl Sampled {
    fn about(nominal: f64) -> Self {
        Self {
            nominal,
            ..Self::default()
        }
    }

    fn add(&mut self, value: f64) {
        let difference = value - self.nominal;
        self.count += 1.0;
        self.sum += difference;
        self.squares += difference * difference;
    }

    /// Mean; `None` without samples.
    pub fn mean(&self) -> Option<f64> {
        (self.count > 0.0).then(|| self.nominal + self.sum / self.count)
    }

    /// Standard deviation; `None` with fewer than two samples.
    pub fn sigma(&self) -> Option<f64> {
        let spread = self.squares - self.sum * self.sum / self.count;
        (self.count > 1.0).then(|| (spread.max(0.0) / (self.count - 1.0)).sqrt())
    }
}

impl Risk {
    /// Assesses the rotor at its running speed, over `samples` samples with the seed of `study`.
    ///
    /// # Errors
    /// The errors of [`Study::modes`], [`Study::second_order`] and [`Study::monte_carlo`].
    pub fn assess<M: Mechanism>(
        study: &Study<M>,
        question: &RotorQuestion,
        samples: usize,
    ) -> Result<Self, Error> {
        let study = study.clone().input(question.input(), question.running);
        let tolerances = study.tolerances()?;
        let (modes, whirls) = (study.modes()?, study.whirls()?);
        let spreads = study.second_order()?.modes;
        let one = |(r, spread)| {
            let mode = &modes.modes[r];
            let band = Band::around(question.speed, question.margin);
            let margin = study.margin(r, band).ok().map(|found| found.margin);
            let spread: Option<&eigentol::second_order::ModeSecondOrder> = spread;
            ModeRisk {
                s: mode.s,
                whirl: whirls[r],
                frequency: spread.map(|spread| spread.frequency.clone()),
                damping_ratio: spread.map(|spread| spread.damping_ratio.clone()),
                sampled_frequency: Sampled::about(mode.s.im),
                sampled_damping_ratio: Sampled::about(mode.damping_ratio().unwrap_or(0.0)),
                in_band: Chance {
                    first_order: margin.as_ref().map(|margin| margin.first_order),
                    second_order: margin.as_ref().map(|margin| margin.corrected.value),
                    ..Chance::default()
                },
            }
        };
        let spreads = spreads.iter().map(|spread| spread.as_ref().ok());
        let mut risk = Self {
            modes: spreads.enumerate().map(one).collect(),
            unstable: Chance::default(),
        };
        risk.unstable = risk.of_instability(&tolerances);
        risk.sample(&study, question, samples)?;
        Ok(risk)
    }

    /// Probability that the damping ratio of the least damped mode is negative, by the models of that mode.
    fn of_instability(&self, tolerances: &Tolerances) -> Chance {
        let models = self
            .modes
            .iter()
            .filter_map(|mode| mode.damping_ratio.as_ref());
        let models = models.map(|spread| &*spread.model);
        let least = models.min_by(|a, b| a.value.total_cmp(&b.value));
        let negative = (f64::NEG_INFINITY, 0.0);
        let first = |model: &Quadratic| model.probability_first_order(tolerances, negative).ok();
        let second = |model: &Quadratic| model.probability(tolerances, negative).ok();
        Chance {
            first_order: least.and_then(first),
            second_order: least.and_then(second).map(|found| found.value),
            ..Chance::default()
        }
    }

    fn sample<M: Mechanism>(
        &mut self,
        study: &Study<M>,
        question: &RotorQuestion,
        samples: usize,
    ) -> Result<(), Error> {
        let bar = progress::bar(samples);
        let count = |done: usize| bar.inc(done as u64);
        let blocks = (0..samples).step_by(BLOCK).zip(0..);
        for (first, stream) in blocks {
            let block = study.clone().keep_samples(true).stream(stream);
            let block = block.samples(BLOCK.min(samples - first));
            let found = block.monte_carlo_with_progress(&count)?;
            for sample in found.all.iter().flatten() {
                self.add(sample, question.band());
            }
        }
        bar.finish_and_clear();
        Ok(())
    }

    fn add(&mut self, sample: &Sample, (low, high): (f64, f64)) {
        self.unstable.samples += 1;
        self.unstable.hits += usize::from(sample.outcome != Outcome::Stable);
        let damping_ratios = sample.damping_ratios.iter();
        let values = sample.frequencies.iter().zip(damping_ratios);
        for (mode, (&frequency, &damping_ratio)) in self.modes.iter_mut().zip(values) {
            mode.in_band.samples += 1;
            let Some(frequency) = frequency else { continue };
            mode.in_band.hits += usize::from((low..=high).contains(&frequency));
            mode.sampled_frequency.add(frequency);
            if let Some(damping_ratio) = damping_ratio {
                mode.sampled_damping_ratio.add(damping_ratio);
            }
        }
    }
}
