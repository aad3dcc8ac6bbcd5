//! Models to evaluate at points of the standard normal space.

use super::space::Space;
use crate::algebra::Vector;
use crate::response::{Response, Responses, Workspace};
use crate::tolerance::side_by_side::{DesignWorkspace, SideBySide};
use crate::tolerance::{Outcome, Tolerances};
use crate::{Equilibrium, Error};

/// A design (SI), its outcome and its responses.
pub(super) struct Evaluated<'a> {
    pub(super) design: &'a [f64],
    pub(super) outcome: Outcome,
    pub(super) values: &'a [Option<f64>],
}

/// Receives the evaluated design of a point, with the position of the point.
pub(super) type Take<'a> = dyn FnMut(usize, Evaluated<'_>) -> Result<(), Error> + 'a;

/// Computes responses of designs, by the mechanism itself or by a model of it.
pub(super) trait Model: Sync {
    /// Workspace of a thread.
    type Room;

    fn room(&self) -> Self::Room;

    /// Evaluates the designs of at most [`TOGETHER`] points, each with one standard normal number per design variable.
    fn evaluate(&self, room: &mut Self::Room, points: &[Vector], take: &mut Take<'_>) -> Result<(), Error>;
}

/// Maximum number of points evaluated at a time.
pub(super) const TOGETHER: usize = SideBySide::MOST;

/// The mechanism itself.
pub(super) struct Designs<'a> {
    responses: &'a Responses<'a>,
    space: &'a Space<'a>,
    /// If designs can be solved in vectorised blocks and every response is one of the equilibrium at the nominal inputs.
    side_by_side: Option<SideBySide<'a>>,
}

impl<'a> Designs<'a> {
    pub(super) fn new(responses: &'a Responses<'a>, space: &'a Space<'a>) -> Self {
        Self { responses, space, side_by_side: side_by_side(responses, space.tolerances) }
    }

    pub(super) fn side_by_side(&self) -> bool {
        self.side_by_side.is_some()
    }
}

impl DesignRoom {
    /// For designs whose stability is not asked for.
    pub(super) fn unjudged(self) -> Self {
        Self { alone: self.alone.unjudged(), ..self }
    }
}

fn side_by_side<'a>(responses: &Responses<'a>, tolerances: &'a Tolerances) -> Option<SideBySide<'a>> {
    let (at, modes) = (responses.nominal(), responses.modes());
    let here = |response: &Response| matches!(response, Response::Mode { .. } | Response::Vibration(_));
    if !responses.wanted().iter().all(here) {
        return None;
    }
    let (mechanism, vectors) = responses.batches()?;
    SideBySide::new(mechanism, at, modes, tolerances, vectors)
}

/// Workspace for solving designs.
pub(super) struct DesignRoom {
    alone: Workspace,
    design: Vector,
    /// The state of a design that was solved beside others.
    state: Equilibrium,
    lanes: Option<DesignWorkspace>,
    values: Vec<Option<f64>>,
}

impl Model for Designs<'_> {
    type Room = DesignRoom;

    fn room(&self) -> DesignRoom {
        let lanes = self.side_by_side.as_ref();
        DesignRoom {
            alone: self.responses.workspace(),
            design: self.space.nominal.into(),
            state: self.responses.nominal().clone(),
            lanes: lanes.map(SideBySide::room),
            values: vec![None; self.responses.wanted().len()],
        }
    }

    fn evaluate(&self, room: &mut DesignRoom, points: &[Vector], take: &mut Take<'_>) -> Result<(), Error> {
        let responses = self.responses;
        let DesignRoom { alone, design, state, lanes, values } = room;
        let mut solve = |design: &[f64], values: &mut Vec<Option<f64>>| {
            let realisation = responses.at(alone, design)?;
            *values = realisation.values;
            Ok::<Outcome, Error>(realisation.outcome)
        };
        let (Some(lanes), Some(side_by_side)) = (lanes, &self.side_by_side) else {
            for (k, z) in points.iter().enumerate() {
                self.space.design(z, design);
                let outcome = solve(design, values)?;
                take(k, Evaluated { design, outcome, values })?;
            }
            return Ok(());
        };
        side_by_side.solve(lanes, points, |k, design, solved| {
            let outcome = match solved {
                Some(solved) => {
                    responses.counted()?;
                    responses.of_solved(design, &solved, state, values);
                    Outcome::Stable
                }
                None => solve(design, values)?,
            };
            take(k, Evaluated { design, outcome, values })
        })
    }
}
