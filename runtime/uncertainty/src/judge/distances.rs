//! The doubts that distances raise about first order.

use super::Doubt;
use crate::Error;
use crate::response::{Response, Responses};
use crate::sensitivity::sensitivities;
use crate::tolerance::{FirstOrder, Tolerances, first_order};

/// A first-order standard deviation with a larger error is not to be trusted.
pub const TRUSTED_SIGMA_ERROR: f64 = 0.05;

/// First order at the nominal design, which knows the distances to other states.
pub(crate) fn distances(responses: &Responses<'_>, tolerances: &Tolerances) -> Result<FirstOrder, Error> {
    let (at, modes) = (responses.nominal(), responses.modes());
    let slopes = sensitivities(responses.mechanism(), at, modes)?;
    first_order(modes, &slopes, tolerances)
}

/// The doubts that distances raise about models of each response that are fitted at the nominal design.
pub(crate) fn doubts_of_models(responses: &Responses<'_>, tolerances: &Tolerances) -> Vec<Vec<Doubt>> {
    let critical = Doubt::NearCritical { distance: 0.0 };
    let first_order = tolerances.vary().then(|| distances(responses, tolerances));
    let of = |response: &Response| match (&first_order, response) {
        (Some(Ok(first)), Response::Mode { mode, .. }) => {
            let mut doubts = first.doubts(*mode);
            doubts.retain(|doubt| *doubt != Doubt::NoFrequency);
            doubts
        }
        (Some(Ok(first)), Response::Output(_)) => {
            let nearest = first.nearest_critical();
            let nearest = nearest.map(|(mode, distance)| Doubt::BranchNear { mode, distance });
            Vec::from_iter(nearest)
        }
        (Some(Err(Error::CriticalState)), response) if response.of_state() => {
            vec![critical.clone()]
        }
        _ => Vec::new(),
    };
    responses.wanted().iter().map(of).collect()
}
