//! Models to evaluate at points of the standard normal space.

use super::space::Space;
use crate::Error;
use crate::algebra::Vector;
use crate::response::{Response, Responses, Workspace};
use crate::sensitivity::Quantity;
use crate::tolerance::side_by_side::{DesignWorkspace, SideBySide};
use crate::tolerance::{Outcome, Tolerances};

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
    fn evaluate(
        &self,
        room: &mut Self::Room,
        points: &[Vector],
        take: &mut Take<'_>,
    ) -> Result<(), Error>;
}

/// Maximum number of points evaluated at a time.
pub(super) const TOGETHER: usize = SideBySide::MOST;

/// The mechanism itself.
pub(super) struct Designs<'a> {
    responses: &'a Responses<'a>,
    space: &'a Space<'a>,
    /// If every response is a quantity of a mode and designs can be solved in vectorised blocks: the block solver and
    /// these quantities.
    side_by_side: Option<(SideBySide<'a>, Vec<(usize, Quantity)>)>,
}

impl<'a> Designs<'a> {
    pub(super) fn new(responses: &'a Responses<'a>, space: &'a Space<'a>) -> Self {
        Self {
            responses,
            space,
            side_by_side: side_by_side(responses, space.tolerances),
        }
    }

    pub(super) fn side_by_side(&self) -> bool {
        self.side_by_side.is_some()
    }
}

fn side_by_side<'a>(
    responses: &Responses<'a>,
    tolerances: &'a Tolerances,
) -> Option<(SideBySide<'a>, Vec<(usize, Quantity)>)> {
    let (at, modes) = (responses.nominal(), responses.modes());
    let wanted = responses.wanted().iter().map(|response| match response {
        Response::Mode { mode, quantity } => Some((*mode, *quantity)),
        _ => None,
    });
    let wanted = wanted.collect::<Option<Vec<_>>>()?;
    let (mechanism, vectors) = responses.batches()?;
    let lanes = SideBySide::new(mechanism, at, modes, tolerances, vectors)?;
    Some((lanes, wanted))
}

/// Workspace for solving designs.
pub(super) struct DesignRoom {
    alone: Workspace,
    design: Vector,
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
            lanes: lanes.map(|(lanes, _)| lanes.room()),
            values: vec![None; self.responses.wanted().len()],
        }
    }

    fn evaluate(
        &self,
        room: &mut DesignRoom,
        points: &[Vector],
        take: &mut Take<'_>,
    ) -> Result<(), Error> {
        let responses = self.responses;
        let DesignRoom {
            alone,
            design,
            lanes,
            values,
        } = room;
        let mut solve = |design: &[f64], values: &mut Vec<Option<f64>>| {
            let found = responses.at(alone, design)?;
            *values = found.values;
            Ok::<Outcome, Error>(found.outcome)
        };
        let (Some(lanes), Some((side_by_side, wanted))) = (lanes, &self.side_by_side) else {
            for (k, z) in points.iter().enumerate() {
                self.space.design(z, design);
                let outcome = solve(design, values)?;
                take(
                    k,
                    Evaluated {
                        design,
                        outcome,
                        values,
                    },
                )?;
            }
            return Ok(());
        };
        side_by_side.solve(lanes, points, |k, design, eigenvalues| {
            let outcome = match eigenvalues {
                Some(all) => {
                    responses.counted()?;
                    for (value, (mode, quantity)) in values.iter_mut().zip(wanted) {
                        *value = all.get(*mode).and_then(|s| quantity.of_stable(*s));
                    }
                    Outcome::Stable
                }
                None => solve(design, values)?,
            };
            take(
                k,
                Evaluated {
                    design,
                    outcome,
                    values,
                },
            )
        })
    }
}
