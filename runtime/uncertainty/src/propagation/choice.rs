//! The choice of the best affordable method.

use super::result::Propagation;
use super::sampled::sampled;
use super::space::Space;
use super::taylor::{first_order, second_order};
use crate::Error;
use crate::judge::doubts_of_models;
use crate::kernels::CurvatureKernels;
use crate::response::Responses;
use crate::tolerance::{Points, Sampling, Tolerances};

/// Fewer samples are not informative.
const FEW: u64 = 64;

/// Number of equilibrium solutions that an answer usually may cost.
pub const SOLUTIONS: u64 = 100_000;

/// Computes how tolerances spread responses, by the best affordable method; [`Propagation::reason`] says why it was
/// chosen.
///
/// The `solutions` allowed are equilibria: one for each design, and one more for each step of the range of each critical
/// value or crossing. Of `sampling`, the number of samples, seed, stream and threads count.
///
/// The first choice is sampling at scrambled Sobol' points, if affordable: it works for every response and
/// distribution, gives quantiles, and counts failures. It may be too expensive if critical values or crossings must be
/// searched for in every design. The next choice is then second order, if every response has second derivatives and no
/// distance to another state casts doubt on models ([`Propagation::doubts`]); otherwise fewer samples, but at least 64;
/// the last choice is second or first order, whichever there is.
///
/// ```
#[doc = include_str!("example.txt")]
/// use eigentol::propagation::{Method, SOLUTIONS, propagate};
/// use eigentol::tolerance::{Points, Sampling};
///
/// let sampling = Sampling::default();
/// let all = propagate(&Pendulum, &responses, &tolerances, SOLUTIONS, &sampling)?;
/// assert_eq!(all.method, Method::Sampled(Points::Sobol));
/// let dear = propagate(&Pendulum, &responses, &tolerances, 20, &sampling)?;
/// assert_eq!(dear.method, Method::SecondOrder);
/// # Ok::<(), eigentol::Error>(())
/// ```
///
/// # Errors
/// As the method that is chosen: [`sampled`], [`second_order`], [`first_order`].
pub fn propagate(
    mechanism: &dyn CurvatureKernels,
    responses: &Responses<'_>,
    tolerances: &Tolerances,
    solutions: u64,
    sampling: &Sampling<'_>,
) -> Result<Propagation, Error> {
    let space = Space::new(responses.nominal(), tolerances)?;
    let with = |propagation: Result<Propagation, Error>, reason: String| {
        propagation.map(|found| Propagation { reason, ..found })
    };
    if space.dimensions() == 0 {
        let linear = first_order(mechanism, responses, tolerances);
        return with(linear, "no tolerance is declared".to_owned());
    }
    let price = responses.price();
    let (affordable, wanted) = (solutions / price, sampling.samples as u64);
    let sample = |samples: u64, reason: String| {
        let sampling = sampling
            .clone()
            .points(Points::Sobol)
            .samples(usize::try_from(samples).unwrap_or(usize::MAX))
            .range(None)
            .progress(None)
            .stop(responses.watch().stop);
        let samples = sampled(responses, tolerances, &sampling)?;
        responses.go_on()?;
        with(samples.propagation(), reason)
    };
    let cost_of_all = wanted.saturating_mul(price);
    if wanted <= affordable {
        return sample(
            wanted,
            format!("samples cost {cost_of_all} solutions of the {solutions} allowed, and hold for any response"),
        );
    }
    let dear = format!("{wanted} samples would cost {cost_of_all} solutions, more than the {solutions} allowed");
    let doubted = !doubts_of_models(responses, tolerances).iter().all(Vec::is_empty);
    if doubted && affordable >= FEW {
        return sample(affordable, format!("{dear}; distances cast doubt on any model: so fewer samples"));
    }
    let second = second_order(mechanism, responses, tolerances)?;
    if second.spreads.iter().all(Option::is_some) {
        return with(Ok(second), dear);
    }
    let dear = format!("{dear}, and a response has no second derivatives");
    if affordable >= FEW {
        return sample(affordable, format!("{dear}: so fewer samples"));
    }
    with(first_order(mechanism, responses, tolerances), dear)
}
