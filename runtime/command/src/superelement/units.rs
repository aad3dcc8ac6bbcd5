//! Factors that turn the units of a file into SI.

use eigentol::Unit;
use eigentol_compiler::matrix_market::Mistake;
use eigentol_interpreter::value;

use super::json::{At, Units};
use super::matrix::{MASS, Role, STIFFNESS};

/// Length, mass and time of a file in SI.
#[derive(Clone, Copy)]
pub(super) struct Scales {
    pub(super) length: f64,
    mass: f64,
    time: f64,
}

impl Scales {
    pub(super) fn of(units: &Units<'_>, text: &str) -> Result<Self, Mistake> {
        let scale = |what: &str, of: Option<At<'_>>, si: &str| {
            let Some(at) = of else { return Ok(1.0) };
            let symbol: String = at.get(text)?;
            let unit = Unit { symbol: si.to_owned().into(), scale: 1.0 };
            let scale = value(&format!("1 {symbol}"), &unit, &format!("`{what}`")).ok();
            let positive = scale.filter(|scale| *scale > 0.0 && scale.is_finite());
            positive.ok_or_else(|| at.mistake(text, format!("`{symbol}` is not a unit of {what}, as `{si}` is")))
        };
        let (length, time) = (scale("length", units.length, "m")?, scale("time", units.time, "s")?);
        let mass = match (units.mass, units.force) {
            (Some(_), Some(force)) => {
                return Err(force.mistake(text, "give the unit of mass or that of force, not both"));
            }
            (None, Some(_)) => scale("force", units.force, "N")? * time * time / length,
            (mass, None) => scale("mass", mass, "kg")?,
        };
        Ok(Self { length, mass, time })
    }

    /// The factor of the entries of a matrix between motions along an axis.
    pub(super) fn of_matrix(self, role: Role) -> f64 {
        match role {
            MASS => self.mass,
            STIFFNESS => self.mass / (self.time * self.time),
            _ => self.mass / self.time,
        }
    }

    /// A length in metres, without the error of a factor such as 0.001.
    pub(super) fn metres(self, length: f64) -> f64 {
        if self.length < 1.0 { length / (1.0 / self.length) } else { length * self.length }
    }
}
