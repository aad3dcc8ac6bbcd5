//! All requirements of a design.

use eigentol_results::numbers::{short, with_unit};

use super::kinds::Requirement;
use crate::deviations::Deviations;
use crate::kernels::CurvatureKernels;
use crate::response::{Realisation, Response, Responses};
use crate::tolerance::Tolerances;
use crate::{Equilibrium, Error, Modes, Watch};

/// A limit that a requirement sets.
#[derive(Clone, Copy)]
pub(crate) struct Limit {
    /// Position of the requirement.
    pub(crate) requirement: usize,
    /// Position of its response among those of all requirements.
    pub(crate) place: usize,
    /// The limit as a requirement of its own ([`Requirement::limits`]).
    pub(crate) alone: Requirement,
}

/// Requirements on designs near a nominal one, all to be met at once.
///
/// A design without a stable equilibrium fails every requirement on its modes and outputs. If a design lacks a response
/// for another reason (the mode does not oscillate, the range has no critical value, the design cannot exist), it
/// counts as neither meeting nor failing a requirement on it, unless another requirement decides. A requirement on a
/// response that no design has is refused where its probability is asked for ([`Requirements::probabilities`]).
pub struct Requirements<'a> {
    wanted: Vec<Requirement>,
    responses: Responses<'a>,
    deviations: Deviations<'a>,
}

impl<'a> Requirements<'a> {
    /// Requirements on designs that vary by `tolerances` about the nominal one.
    ///
    /// # Errors
    /// [`Error::Setting`] for an empty list, an empty band, a band that excludes nothing, or an upper limit of a
    /// frequency or an amplitude that is not positive; the errors of [`Responses::new`]; [`Error::WrongLength`] for
    /// tolerances of another mechanism.
    pub fn new(
        mechanism: &'a dyn CurvatureKernels,
        nominal: &'a Equilibrium,
        modes: &'a Modes,
        tolerances: &'a Tolerances,
        wanted: Vec<Requirement>,
    ) -> Result<Self, Error> {
        if wanted.is_empty() {
            return Err(Error::setting("requirements", "at least one is needed"));
        }
        wanted.iter().try_for_each(|requirement: &Requirement| requirement.check(mechanism, nominal))?;
        let about: Vec<Response> = wanted.iter().filter_map(Requirement::response).collect();
        Ok(Self {
            responses: Responses::new(mechanism, nominal, modes, about)?,
            deviations: Deviations::new(tolerances, &nominal.design)?,
            wanted,
        })
    }

    /// Reports every design to `watch`, which can end the evaluation with [`Error::Stopped`].
    #[must_use]
    pub fn watched(mut self, watch: Watch<'a>) -> Self {
        self.responses = self.responses.watched(watch);
        self
    }

    /// The requirements in order.
    #[must_use]
    pub fn wanted(&self) -> &[Requirement] {
        &self.wanted
    }

    pub(crate) fn responses(&self) -> &Responses<'a> {
        &self.responses
    }

    pub(crate) fn deviations(&self) -> &Deviations<'a> {
        &self.deviations
    }

    /// The limits of failure, in the order of the requirements.
    pub(crate) fn limits(&self) -> Vec<Limit> {
        let mut index = 0;
        let mut limits = Vec::new();
        for (requirement, wanted) in self.wanted.iter().enumerate() {
            limits.extend(wanted.limits().into_iter().map(|alone| Limit { requirement, place: index, alone }));
            index += usize::from(wanted.response().is_some());
        }
        limits
    }

    /// Whether the nominal design has every response.
    pub(super) fn nominal_has_all(&self) -> bool {
        let mut all = self.responses.wanted().iter();
        all.all(|x| self.responses.missing(*x).is_none())
    }

    /// Refuses the flutter of a mode that has none in the nominal design, where another has: names that one at once.
    pub(super) fn check_flutter(&self) -> Result<(), Error> {
        for response in self.responses.wanted() {
            let Response::Crossing { mode, .. } = *response else {
                continue;
            };
            let onsets = self.responses.nominal_flutter(*response).unwrap_or_default();
            let own = onsets.iter().any(|(other, _)| *other == mode);
            if let Some((other, value)) = onsets.first().filter(|_| !own) {
                let of = &self.responses.nominal().description;
                let unit = response.unit(of);
                return Err(Error::setting(
                    "requirement",
                    format!(
                        "the nominal design has no `{}`; mode {} flutters from {} on",
                        response.name(of),
                        other + 1,
                        with_unit(short(value / unit.scale), &unit)
                    ),
                ));
            }
        }
        Ok(())
    }

    /// The error of a requirement whose response no design has.
    pub(super) fn untold(&self, requirement: usize) -> Error {
        let response = self.wanted[requirement].response();
        let of = &self.responses.nominal().description;
        let reason = response.and_then(|response| self.responses.missing(response));
        Error::NoDesignTells {
            requirement,
            response: response.map_or_else(String::new, |response| response.name(of)),
            reason: reason.map(Box::new),
        }
    }

    /// Whether each requirement is met.
    pub(super) fn each_met(&self, design: &[f64], realisation: &Realisation) -> Vec<Option<bool>> {
        self.distances(design, realisation).into_iter().map(|distance| Some(distance? >= 0.0)).collect()
    }

    /// Distance from failing each requirement, as [`Requirement::distance`].
    pub(super) fn distances(&self, design: &[f64], realisation: &Realisation) -> Vec<Option<f64>> {
        let mut values = realisation.values.iter();
        self.wanted
            .iter()
            .map(|wanted| {
                let value = wanted.response().and_then(|_| values.next().copied());
                wanted.distance(&self.responses, design, realisation.outcome, value.flatten())
            })
            .collect()
    }
}

/// Whether all requirements are met, as far as can be told: a single failure decides.
pub(super) fn all_met(each: &[Option<bool>]) -> Option<bool> {
    if each.contains(&Some(false)) { Some(false) } else { (!each.contains(&None)).then_some(true) }
}

/// Distance from failing any requirement, as far as can be told: a single failure decides.
pub(super) fn least(distances: &[Option<f64>]) -> Option<f64> {
    let least = distances.iter().flatten().fold(f64::INFINITY, |least, x| least.min(*x));
    (least < 0.0 || !distances.contains(&None)).then_some(least)
}
