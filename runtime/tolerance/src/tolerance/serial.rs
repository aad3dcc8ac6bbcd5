//! Reading tolerances: impossible values are refused.

use eigentol_statistics::Joint;

use super::Tolerances;
use crate::algebra::{Matrix, Vector};

eigentol_statistics::checked!(Tolerances);

impl Tolerances {
    fn checked(self) -> Result<Self, &'static str> {
        let count = self.half_widths.len();
        let square = |matrix: &Matrix| (matrix.row_count(), matrix.column_count()) == (count, count);
        let together = |(joint, nominal): &(Joint, Vector)| joint.len() == count && nominal.len() == count;
        let fits = self.sigmas.len() == count
            && self.shifts.len() == count
            && square(&self.factor)
            && self.correlation.as_ref().is_none_or(square)
            && self.joint.as_ref().is_none_or(together);
        if fits { Ok(self) } else { Err("there is not one tolerance for each variable") }
    }
}
