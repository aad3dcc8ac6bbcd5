//! Vibration under excitations of which only the amounts are known.

use eigentol_statistics::random_phases::RandomPhases;

use super::measure::Measure;
use super::response::Harmonic;
use crate::{Error, Output};

impl Harmonic {
    /// The amplitude of an output if the phases of the excitations, such as the angles of unbalances, are unknown:
    /// independent and uniform over the turn. An output is proportional to each excitation, so no design is solved:
    /// its amplitude is the length of a sum of vectors of known lengths in random directions.
    ///
    /// # Errors
    /// [`Error::Setting`] for an output that has no amplitude, and for one of another mechanism.
    pub fn unknown_phases(&self, output: Output, measure: Measure) -> Result<RandomPhases, Error> {
        let share = |y: crate::Complex| measure.of(self.frequency, y).norm();
        let lengths: Option<Vec<f64>> =
            self.shares.iter().map(|x| x.outputs.get(output.index()).copied().flatten().map(share)).collect();
        let lengths = lengths
            .ok_or_else(|| Error::setting("output", format!("output {} has no amplitude", output.index() + 1)))?;
        Ok(RandomPhases::new(&lengths)?)
    }
}
