//! How the parameters of a study vary.

use crate::Error;
use crate::tolerance::{Distribution, distribution};
use crate::{Law, ToleranceInfo};

/// The variation of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Variation {
    /// About its nominal value.
    About(ToleranceInfo),
    /// Distributed independently of its nominal value, SI.
    Values(Distribution),
}

impl Variation {
    /// Sets limits about the nominal value. The law is kept; an explicit distribution is replaced by a normal one.
    pub(super) fn set_limits(&mut self, (lower, upper): (f64, f64), relative: bool) {
        let law = match self {
            Self::About(info) => info.law.clone(),
            Self::Values(_) => Law::Normal,
        };
        *self = Self::About(ToleranceInfo { lower, upper, relative, law });
    }

    /// Sets the law. The limits are kept; an explicit distribution is replaced by one without limits.
    pub(super) fn set_law(&mut self, law: Law) {
        let info = match self {
            Self::About(info) => info.clone(),
            Self::Values(_) => ToleranceInfo::NONE,
        };
        *self = Self::About(ToleranceInfo { law, ..info });
    }

    /// Whether the parameter does not vary at all.
    pub(super) fn is_none(&self) -> bool {
        matches!(self, Self::About(info) if info.lower == 0.0 && info.upper == 0.0)
    }

    /// Whether the tolerances are independent of the nominal value.
    pub(super) fn is_fixed(&self) -> bool {
        matches!(self, Self::About(info) if !info.relative && info.normal_half_width(0.0).is_some())
    }

    /// The half-width of a normal variable about this value; `None` for any other distribution.
    pub(super) fn normal_half_width(&self, value: f64) -> Option<f64> {
        match self {
            Self::About(info) => info.normal_half_width(value),
            Self::Values(_) => None,
        }
    }

    /// The distribution of the parameter for a nominal value.
    pub(super) fn distribution(&self, value: f64, sigma_level: f64) -> Result<Distribution, Error> {
        match self {
            Self::About(info) => distribution(value, info, sigma_level),
            Self::Values(values) => Ok(values.clone()),
        }
    }
}
