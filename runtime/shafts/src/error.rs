//! What can be wrong with an assembly.

use crate::basis::MOST;
use crate::section::Number;

/// What can be wrong with an assembly.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The degree is none.
    #[error("elements have polynomials of degree 1 to {MOST}, not {degree}")]
    Degree {
        /// As given.
        degree: usize,
    },
    /// Matrices of different sizes.
    #[error("mass, damping and stiffness of the stations are square and of the same size, for one unknown at least")]
    Sizes,
    /// A span without sections, or a section without elements.
    #[error("span {span} has no section, or a section that is divided into no element")]
    NoSections {
        /// From 0.
        span: usize,
    },
    /// An end that moves with an unknown that is none.
    #[error("span {span} ends at an unknown beyond the {count} of the stations")]
    Place {
        /// From 0.
        span: usize,
        /// The number of unknowns.
        count: usize,
    },
    /// A number that is not finite, or not positive where it must be.
    #[error(
        "{number:?} of section {section} of span {span} is {value}: it must be finite, and positive where it resists or is a length or a mass"
    )]
    Number {
        /// From 0.
        span: usize,
        /// From 0.
        section: usize,
        /// Which.
        number: Number,
        /// As given, SI.
        value: f64,
    },
    /// The modes were not found.
    #[error("the modes did not converge")]
    NotConverged,
}
