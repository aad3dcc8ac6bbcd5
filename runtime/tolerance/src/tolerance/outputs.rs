//! First-order spread of the outputs.

use super::{Spread, Tolerances};
use crate::algebra::Vector;
use crate::sensitivity::OutputSensitivities;
use crate::{Description, Error, Shared};

/// First-order spread of every output.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OutputTolerances {
    /// Nominal values in the order of declaration, SI.
    pub values: Vector,
    /// Their spreads; `None` if the output has no derivative.
    pub spreads: Vec<Option<Spread>>,
    /// Standard deviations that a tolerance spans.
    pub sigma_level: f64,
    /// Whether any variable has a tolerance.
    pub varies: bool,
    /// The inputs they belong to, SI.
    pub inputs: Vector,
    /// The mechanism they belong to.
    pub description: Shared<Description>,
}

/// First-order spread of every output.
///
/// # Errors
/// [`Error::WrongLength`] for tolerances of another mechanism.
pub fn output_tolerances(outputs: &OutputSensitivities, tolerances: &Tolerances) -> Result<OutputTolerances, Error> {
    tolerances.check_count(outputs.description.design.len())?;
    let spread = |(mean, slopes): (&f64, &Option<Vector>)| {
        slopes.as_ref().map(|slopes| Spread::new(*mean, slopes.clone(), tolerances))
    };
    let each = outputs.values.iter().zip(&outputs.by_design);
    Ok(OutputTolerances {
        values: outputs.values.clone(),
        spreads: each.map(spread).collect(),
        sigma_level: tolerances.sigma_level(),
        varies: tolerances.vary(),
        inputs: outputs.inputs.clone(),
        description: outputs.description.clone(),
    })
}
