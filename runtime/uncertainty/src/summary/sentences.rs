//! Assessment of the spread of each mode, in sentences.

use core::fmt;

use eigentol_results::naming::{capital, named};
use eigentol_results::numbers::{frequency_in, number, rough, short};

use crate::summary::{Advice, Chance, Check, Doubt, Measured, Sampling, Summary, Trust};
use crate::tolerance::{ModeTolerance, Outcome, doubt_sentences};

/// Distance between mean and nominal frequency, in standard deviations, from which it is worth a sentence.
const NOTICED: f64 = 0.1;

/// A sentence of a [`Summary`].
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sentence {
    /// Its meaning for the reader.
    pub news: News,
    /// The sentence, with a capital letter and a full stop.
    pub text: String,
}

/// The meaning of a sentence for its reader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum News {
    /// First order can be used.
    Good,
    /// Something deviates from first order.
    Bad,
    /// A measurement or a recommendation.
    Fact,
}

impl fmt::Display for Sentence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl Summary {
    /// The assessment, in the order a reader needs it: each doubt once, with all the modes that share it; the errors of
    /// first and second order compared to the samples of those modes; recommendations; the outcomes of the samples.
    ///
    /// ```
    /// use eigentol::summary::News;
    /// use eigentol::{Study, mechanism};
    ///
    /// mechanism! {
    ///     mechanism Pendulum {
    ///         design l = 1 m +/- 3%;
    ///         gravity 9.81 m/s^2 along -z;
    ///         body bar: rod(mass: 3 kg, length: l, along: -z);
    ///         joint theta: revolute(y) from ground to bar;
    ///     }
    /// }
    ///
    /// let sentences = Study::new(Pendulum).summary()?.sentences();
    /// assert_eq!(sentences[0].news, News::Good);
    /// assert!(sentences[0].text.starts_with("Mode 1: nothing contradicts the first-order sigma"));
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    #[must_use]
    pub fn sentences(&self) -> Vec<Sentence> {
        let mut all = self.doubts();
        let doubted = self.trust.iter().filter(|x| !x.trusted());
        let checks = doubted.flat_map(|doubted| doubted.checks.iter().map(|check| (doubted.mode, check)));
        let converges = |mode| self.second_order_sigma(mode).is_some();
        all.extend(checks.map(|(mode, check)| fact(measured(mode, check, converges(mode)))));
        all.extend(self.advice());
        all.extend(self.displaced().into_iter().map(fact));
        all.extend(self.about_samples().into_iter().map(fact));
        all
    }

    fn doubts(&self) -> Vec<Sentence> {
        let all: Vec<&[Doubt]> = self.trust.iter().map(|x| &x.doubts[..]).collect();
        let bad = |text| Sentence { news: News::Bad, text };
        doubt_sentences(&all).into_iter().map(bad).collect()
    }

    fn advice(&self) -> Vec<Sentence> {
        if self.unmoved() {
            return Vec::new();
        }
        let all = [Advice::FirstOrder, Advice::SecondOrder, Advice::Sampling];
        let sentence = |advice: Advice| {
            let oscillates = |trust: &&Trust| !trust.doubts.contains(&Doubt::NoFrequency);
            let advised = || self.trust.iter().filter(oscillates).filter(|x| x.advice == advice);
            let modes: Vec<usize> = advised().map(|x| x.mode).collect();
            let (news, text) = match advice {
                Advice::FirstOrder => (
                    News::Good,
                    format!(
                        "nothing contradicts the first-order sigma{}.",
                        confirmed(advised().flat_map(|advised| &advised.checks))
                    ),
                ),
                Advice::SecondOrder => (News::Fact, "use second order, which agrees with the samples.".to_owned()),
                _ => (News::Fact, "use Monte Carlo.".to_owned()),
            };
            let text = format!("{}: {text}", capital(named(&modes)));
            (!modes.is_empty()).then_some(Sentence { news, text })
        };
        all.into_iter().filter_map(sentence).collect()
    }

    /// Modes whose mean is not their nominal frequency: the mean of a variable is not its nominal value.
    fn displaced(&self) -> Vec<String> {
        let modes = self.first.modes.iter().enumerate();
        let sentence = |(r, mode): (usize, &ModeTolerance)| {
            let (nominal, spread) = (mode.behaviour.frequency()?, mode.frequency()?);
            let sigmas = (spread.mean - nominal) / spread.sigma;
            let counts = self.cluster_of(r).is_none() && sigmas.abs() > NOTICED;
            let side = if sigmas > 0.0 { "above" } else { "below" };
            counts.then(|| {
                format!(
                    "Mode {}: the mean frequency is {}, {} sigma {side} the nominal one: the limits of a variable \
                     are not centred on its nominal value.",
                    r + 1,
                    frequency_in(spread.mean, &self.description.frequency, number),
                    short(sigmas.abs())
                )
            })
        };
        modes.filter_map(sentence).collect()
    }

    /// The outcomes of the samples, or why there are none.
    fn about_samples(&self) -> Vec<String> {
        match &self.sampling {
            Sampling::NotNeeded => Vec::new(),
            Sampling::TooDear { operations, budget } => vec![format!(
                "Not checked by samples: sampling needs about {operations:.1e} operations; the limit is {budget:.1e}. The verdicts \
                 rest on distances and second order."
            )],
            Sampling::Done(sampled) => {
                let checks = || self.trust.iter().flat_map(|x| &x.checks);
                let missing = checks().any(|check| check.count < check.samples).then(|| {
                    "Sampled sigmas are those of the samples that are stable and in which the mode oscillates; in others it has no \
                     frequency."
                        .to_owned()
                });
                let other = sampled.other_branch;
                let other = other.and_then(|other| chance("Stable on another branch", other));
                let outcomes = sampled.outcomes.iter();
                let outcomes = outcomes.filter_map(|(outcome, x)| chance(name_of(*outcome)?, *x));
                missing.into_iter().chain(other).chain(outcomes).collect()
            }
        }
    }
}

fn fact(text: String) -> Sentence {
    Sentence { news: News::Fact, text }
}

/// The largest error of first order compared to the samples; empty without samples.
fn confirmed<'a>(checks: impl Iterator<Item = &'a Check> + Clone) -> String {
    let errors = checks.filter_map(|check| Some((check.first_order_error?, check.count)));
    let several = errors.clone().nth(1).is_some();
    let most = errors.max_by(|(a, _), (b, _)| a.value.abs().total_cmp(&b.value.abs()));
    match most {
        None => String::new(),
        Some((error, count)) => format!(
            ", which is off by {}{:.1} % (+- {:.1}) over {count} samples",
            if several { "up to " } else { "" },
            100.0 * error.value.abs(),
            200.0 * error.standard_error
        ),
    }
}

/// Errors of first and second order compared to the samples; where the series does not converge, second order has no
/// sigma.
fn measured(mode: usize, check: &Check, converges: bool) -> String {
    let percent = |error: Measured| {
        let (value, uncertain) = (100.0 * error.value, 200.0 * error.standard_error);
        format!("{value:+.1} % (+- {uncertain:.1})")
    };
    let name = check.quantity;
    let count = match check.count {
        all if all == check.samples => format!("{all} samples"),
        some => format!("{some} of {} samples", check.samples),
    };
    let sigma = rough(check.sigma.value);
    let first = check.first_order_error;
    let first = first.map(|item| format!("; first order is off by {}", percent(item)));
    let second = check.second_order_error;
    let second = second.map(|item| {
        if converges {
            format!(", second order by {}", percent(item))
        } else {
            "; the second-order series does not converge".to_owned()
        }
    });
    let errors = first.unwrap_or_default() + &second.unwrap_or_default();
    let number = mode + 1;
    format!("Mode {number}: sigma of the {name} over {count} {sigma}{errors}.")
}

/// A probability with its interval; `None` if the event occurred in no sample.
fn chance(name: &str, estimate: Chance) -> Option<String> {
    let percent = |share: f64| format!("{:.3}", 100.0 * share);
    (estimate.count > 0).then(|| {
        format!(
            "{name}: {} % of {} samples (95 %: {} to {} %).",
            percent(estimate.value()),
            estimate.samples,
            percent(estimate.lower),
            percent(estimate.upper)
        )
    })
}

/// A name for the outcome of samples that are not stable on the nominal branch.
fn name_of(outcome: Outcome) -> Option<&'static str> {
    Some(match outcome {
        Outcome::Stable => return None,
        Outcome::Divergent => "Unstable without oscillation",
        Outcome::Flutter => "Unstable in a growing oscillation",
        Outcome::Undecided => "Stability not decided",
        Outcome::NoEquilibrium => "No equilibrium",
        Outcome::NotAssembled => "Loops do not close",
        Outcome::Unphysical => "Impossible (no such body, or beyond the end of a curve)",
        Outcome::NoModes => "Modes not found",
    })
}
