//! Forced vibration at the operating point and along an input.

use eigentol::bode::Bode;
use eigentol::forced::ForcedResponse;
use eigentol::kernels::SummaryKernels;
use eigentol::peaks::Peaks;
use eigentol::propagation::Propagation;
use eigentol::response::Vibration;
use eigentol::{Description, Error, Input, Study};

use crate::answer::answer;

/// Number of designs solved anew to check each band.
const CHECKED: usize = 8;

/// Number of vibrations whose curves are refined.
const DRAWN: usize = 6;

/// The vibration of every output under every harmonic.
pub(crate) struct Forced {
    pub(crate) response: Result<ForcedResponse, Error>,
    /// How tolerances spread the amplitudes; `None` if nothing has a tolerance, or nothing vibrates.
    pub(crate) spread: Option<Result<Propagation, Error>>,
    /// `None` if no input is swept.
    pub(crate) along: Option<ForcedAlong>,
}

/// Forced vibration along an input.
pub(crate) struct ForcedAlong {
    pub(crate) bode: Result<Bode, Error>,
    /// One entry for each vibration.
    pub(crate) peaks: Vec<(Vibration, Result<Peaks, Error>)>,
}

impl Forced {
    pub(crate) fn of<M: SummaryKernels>(
        study: &Study<M>,
        along: Option<(Input<M>, &[f64])>,
        varies: bool,
    ) -> Result<Self, Error> {
        let response = answer(study.forced_response())?;
        let wanted = Vibration::all(study.description());
        let spread = varies && response.is_ok() && !wanted.is_empty();
        let spread = spread.then(|| answer(study.vibration_spread(&wanted)));
        let along = along.map(|(input, values)| {
            let ends = (values.first(), values.last());
            let peaks = match ends {
                (Some(&first), Some(&last)) if first != last => peaks(study, &wanted, input, (first, last)),
                _ => Vec::new(),
            };
            let bode =
                if varies { study.bode_bands(input, values, &wanted, CHECKED) } else { study.bode(input, values) };
            let between: Vec<f64> =
                peaks.iter().take(DRAWN).filter_map(|(_, peaks)| peaks.as_ref().ok()).flat_map(Peaks::bends).collect();
            let bode = if between.is_empty() {
                bode
            } else {
                bode.and_then(|bode| Ok(bode.with_between(study.bode(input, &between)?)))
            };
            ForcedAlong { bode, peaks }
        });
        Ok(Self { response, spread: spread.transpose()?, along })
    }
}

/// The peaks of all vibrations.
fn peaks<M: SummaryKernels>(
    study: &Study<M>,
    wanted: &[Vibration],
    input: Input<M>,
    (first, last): (f64, f64),
) -> Vec<(Vibration, Result<Peaks, Error>)> {
    let each = wanted.iter().copied();
    match study.peaks_of(wanted, input, first, last) {
        Ok(peaks) => each.zip(peaks.into_iter().map(Ok)).collect(),
        Err(error) => each.map(|x| (x, Err(error.clone()))).collect(),
    }
}

/// The first excitation of each harmonic.
pub(crate) fn harmonics(d: &Description) -> Vec<usize> {
    d.excitations.iter().enumerate().filter(|(k, info)| info.with == *k).map(|(k, _)| k).collect()
}

/// The names of all excitations of the harmonic of one.
pub(crate) fn excitations(d: &Description, harmonic: usize) -> String {
    let names: Vec<&str> = d.excitations.iter().filter(|info| info.with == harmonic).map(|info| &*info.name).collect();
    names.join(", ")
}
