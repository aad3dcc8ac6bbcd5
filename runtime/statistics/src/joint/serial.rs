//! Deserialisation with validation.

use super::{Dependence, Joint};

crate::checked!(Joint);

impl Joint {
    fn checked(self) -> Result<Self, &'static str> {
        let size = self.variables.len().pow(2);
        let fits = |dependence: &Dependence| dependence.correlation.len() == size && dependence.factor.len() == size;
        if self.dependence.as_ref().is_none_or(fits) {
            Ok(self)
        } else {
            Err("there is not one correlation for each pair of variables")
        }
    }
}
