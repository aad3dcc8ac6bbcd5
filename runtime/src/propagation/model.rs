//! What is evaluated at designs.

use crate::Error;
use crate::response::{Responses, Workspace};
use crate::tolerance::Outcome;

/// Responses of a design: those of the mechanism, or of a model of it.
pub(super) trait Model: Sync {
    /// What a thread works in.
    type Room;

    fn room(&self) -> Self::Room;

    /// The outcome of a design, SI; writes its responses.
    fn evaluate(
        &self,
        room: &mut Self::Room,
        design: &[f64],
        values: &mut [Option<f64>],
    ) -> Result<Outcome, Error>;
}

impl Model for Responses<'_> {
    type Room = Workspace;

    fn room(&self) -> Workspace {
        self.workspace()
    }

    fn evaluate(
        &self,
        room: &mut Workspace,
        design: &[f64],
        values: &mut [Option<f64>],
    ) -> Result<Outcome, Error> {
        let found = self.at(room, design)?;
        values.copy_from_slice(&found.values);
        Ok(found.outcome)
    }
}
