//! All requirements of a design.

use super::deviations::Deviations;
use super::kinds::Requirement;
use super::limit::Limit;
use crate::kernels::DirectionalKernels;
use crate::response::{Realisation, Response, Responses};
use crate::tolerance::Tolerances;
use crate::{Equilibrium, Error, Modes, Watch};

/// Requirements of the designs near a nominal one, to be met all at once.
///
/// A design without a response does not tell whether it meets a requirement on it. It counts as neither meeting nor failing,
/// unless another requirement decides: require [`Requirement::Stable`] where a design without a stable equilibrium has failed.
pub struct Requirements<'a> {
    wanted: Vec<Requirement>,
    responses: Responses<'a>,
    deviations: Deviations<'a>,
}

impl<'a> Requirements<'a> {
    /// Requirements of designs that vary by `tolerances` about the nominal one.
    ///
    /// # Errors
    /// [`Error::Setting`] for no requirement or a band that is empty or asks for nothing; what [`Responses::new`] refuses;
    /// [`Error::WrongLength`] for tolerances of another mechanism.
    pub fn new(
        mechanism: &'a dyn DirectionalKernels,
        nominal: &'a Equilibrium,
        modes: &'a Modes,
        tolerances: &'a Tolerances,
        wanted: Vec<Requirement>,
    ) -> Result<Self, Error> {
        if wanted.is_empty() {
            return Err(Error::Setting {
                setting: "requirements",
                reason: "at least one is needed".to_owned(),
            });
        }
        wanted.iter().try_for_each(Requirement::check)?;
        let about: Vec<Response> = wanted.iter().filter_map(Requirement::response).collect();
        Ok(Self {
            responses: Responses::new(mechanism, nominal, modes, about)?,
            deviations: Deviations::new(tolerances, &nominal.design)?,
            wanted,
        })
    }

    /// Lets `watch` see each design, and end the evaluation with [`Error::Stopped`].
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

    /// The limits of failure, in the order of the requirements, each with the place of its response.
    pub(crate) fn limits(&self) -> Vec<(usize, Limit)> {
        let mut place = 0;
        let mut limits = Vec::new();
        for (requirement, wanted) in self.wanted.iter().enumerate() {
            let Some(response) = wanted.response() else {
                continue;
            };
            for edge in wanted.edges() {
                let limit = Limit {
                    requirement,
                    response,
                    edge,
                };
                limits.push((place, limit));
            }
            place += 1;
        }
        limits
    }

    /// Whether each requirement is met.
    pub(super) fn each_met(&self, found: &Realisation) -> Vec<Option<bool>> {
        let mut values = found.values.iter();
        let each = self.wanted.iter().map(|wanted| {
            let own = wanted.response().and_then(|_| values.next().copied());
            wanted.met(found.outcome, own.flatten())
        });
        each.collect()
    }
}

/// Whether all are met, as far as can be told: one that is not decides.
pub(super) fn all_met(each: &[Option<bool>]) -> Option<bool> {
    match each.contains(&Some(false)) {
        true => Some(false),
        false => (!each.contains(&None)).then_some(true),
    }
}
