//! Why a response does not exist.

use super::{Response, Responses};
use crate::forced;
use crate::kernels::Kernels;
use crate::peaks;
use crate::sweep::{Condition, Following, critical_state, first_crossing, flutter_onsets};
use crate::{Error, Output};

impl Responses<'_> {
    /// The modes whose flutter begins or ends in the nominal design, and where, if a response is about flutter.
    #[doc(hidden)]
    #[must_use]
    pub fn nominal_flutter(&self, response: Response) -> Option<Vec<(usize, f64)>> {
        let Response::Crossing { condition: Condition::FlutterOnset, range, .. } = response else {
            return None;
        };
        let at = self.nominal();
        let (u, b, start) = (&at.inputs, &at.design, &at.coordinates);
        let onsets = flutter_onsets(self.mechanism(), u, b, start, Following::default(), range);
        let onsets = onsets.into_iter().flatten();
        Some(
            onsets
                .map(|crossing| {
                    let label = crossing.modes.modes[crossing.mode].label;
                    (label, crossing.value)
                })
                .collect(),
        )
    }

    /// Why the nominal design lacks a response; `None` if it has it.
    #[doc(hidden)]
    #[must_use]
    pub fn missing(&self, response: Response) -> Option<Error> {
        let (mechanism, at) = (self.mechanism(), self.nominal());
        let (values, start) = ((&*at.inputs, &*at.design), &at.coordinates);
        let d = &at.description;
        let name = |output: Output| d.outputs[output.index()].name.clone();
        match response {
            Response::Mode { mode, quantity } => {
                let eigenmode = self.modes().modes.get(mode)?;
                let lambda = eigenmode.lambda;
                quantity.of(eigenmode).is_none().then_some(Error::NotOscillating { mode, lambda })
            }
            Response::Output(output) => {
                let kernels: &dyn Kernels = mechanism;
                let finite = kernels.outputs(&at.coordinates, &at.inputs, &at.design).get(output.index())?.is_finite();
                (!finite).then(|| Error::InfiniteOutput { output: name(output), coordinates: at.coordinates.to_vec() })
            }
            Response::Vibration(vibration) => match forced::response(mechanism, at) {
                Ok(forced_response) => (vibration.of(&forced_response).is_none())
                    .then(|| Error::NotSmooth { output: name(vibration.output) }),
                Err(error) => Some(error),
            },
            Response::Peak { vibration, range, quantity } => {
                peaks::highest(mechanism, values, start, (vibration, range, quantity)).err()
            }
            Response::Critical(range) => critical_state(mechanism, values.0, values.1, start, range).err(),
            Response::Crossing { mode, condition, range } => {
                let (following, what) = (Following::default(), (mode, condition));
                match first_crossing(mechanism, values, start, following, range, what, None) {
                    Ok(Some(_)) => None,
                    Ok(None) => Some(range.without(met(condition), d)),
                    Err(error) => Some(error),
                }
            }
        }
    }
}

fn met(of: Condition) -> &'static str {
    match of {
        Condition::Line(_) => "crossing",
        Condition::FlutterOnset => "onset of flutter",
    }
}
