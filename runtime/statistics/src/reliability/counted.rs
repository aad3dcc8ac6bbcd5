//! A limit state that counts and checks its evaluations.

use core::cell::{Cell, RefCell};

use super::closest::Evaluations;
use super::limit_state::{LimitState, LimitValue};
use super::vector::norm;
use crate::Error;

/// Passes on only finite values and gradients of the right length.
pub(super) struct Counted<'a> {
    limit: &'a dyn Asked,
    dimension: usize,
    total: Cell<usize>,
    without_value: Cell<usize>,
    reason: RefCell<String>,
}

/// A limit state with its error type erased, so that searches are compiled only once.
trait Asked {
    fn evaluate(&self, z: &[f64]) -> Result<LimitValue, String>;
}

impl<L: LimitState> Asked for L {
    fn evaluate(&self, z: &[f64]) -> Result<LimitValue, String> {
        LimitState::evaluate(self, z).map_err(|error| error.to_string())
    }
}

impl<'a> Counted<'a> {
    pub(super) fn new<L: LimitState>(limit: &'a L) -> Result<Self, Error> {
        let dimension = limit.dimension();
        if dimension == 0 {
            return Err(Error::setting("dimension", "a limit state needs a variable"));
        }
        Ok(Self { limit, dimension, total: Cell::new(0), without_value: Cell::new(0), reason: RefCell::default() })
    }

    pub(super) fn dimension(&self) -> usize {
        self.dimension
    }

    /// Value and gradient at `z`, if they exist.
    pub(super) fn evaluate(&self, z: &[f64]) -> Option<LimitValue> {
        self.total.set(self.total.get() + 1);
        let checked = match self.limit.evaluate(z) {
            Err(reason) => Err(reason),
            Ok(limit) if limit.gradient.len() != self.dimension => {
                Err(format!("its gradient has {} entries, expected {}", limit.gradient.len(), self.dimension))
            }
            Ok(limit) if !is_finite(&limit) => Err("its value or gradient is not finite".into()),
            Ok(limit) => Ok(limit),
        };
        match checked {
            Ok(limit) => Some(limit),
            Err(reason) => {
                self.without_value.set(self.without_value.get() + 1);
                self.reason.replace(reason);
                None
            }
        }
    }

    /// The error for a missing value at this place.
    pub(super) fn no_value(&self, place: &'static str) -> Error {
        let reason = self.reason.borrow().clone();
        Error::NoLimitValue { place, reason }
    }

    pub(super) fn evaluations(&self) -> Evaluations {
        Evaluations { total: self.total.get(), without_value: self.without_value.get() }
    }
}

fn is_finite(limit_value: &LimitValue) -> bool {
    let finite = limit_value.gradient.iter().all(|x| x.is_finite());
    limit_value.value.is_finite() && finite && norm(&limit_value.gradient).is_finite()
}
