//! Reading tolerances: impossible values are refused.

use eigentol_statistics::Joint;

use super::Tolerances;
use crate::algebra::{Matrix, Vector};

/// [`Tolerances`] as read, before validation.
#[derive(serde::Deserialize)]
#[serde(expecting = "tolerances")]
pub(super) struct Unchecked {
    half_widths: Vector,
    sigma_level: f64,
    sigmas: Vector,
    shifts: Vector,
    correlation: Option<Matrix>,
    factor: Matrix,
    joint: Option<(Joint, Vector)>,
}

impl TryFrom<Unchecked> for Tolerances {
    type Error = &'static str;

    fn try_from(read: Unchecked) -> Result<Self, &'static str> {
        let count = read.half_widths.len();
        let square = |matrix: &Matrix| (matrix.row_count(), matrix.column_count()) == (count, count);
        let together = |(joint, nominal): &(Joint, Vector)| joint.len() == count && nominal.len() == count;
        let fits = read.sigmas.len() == count
            && read.shifts.len() == count
            && square(&read.factor)
            && read.correlation.as_ref().is_none_or(square)
            && read.joint.as_ref().is_none_or(together);
        if !fits {
            return Err("there is not one tolerance for each variable");
        }
        Ok(Self {
            half_widths: read.half_widths,
            sigma_level: read.sigma_level,
            sigmas: read.sigmas,
            shifts: read.shifts,
            correlation: read.correlation,
            factor: read.factor,
            joint: read.joint,
        })
    }
}
