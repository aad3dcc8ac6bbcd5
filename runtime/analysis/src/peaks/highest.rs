//! The greatest amplitude in a range, and where the highest peak is: what a requirement limits.

use super::Search;
use super::scan::scan;
use super::state::{Along, Curve};
use crate::algebra::Vector;
use crate::forced::Vibration;
use crate::kernels::CurvatureKernels;
use crate::sweep::{Following, Range};
use crate::{Error, Watch};

/// What is asked about a vibration in a range of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum PeakQuantity {
    /// The greatest amplitude, 0 to peak, at a peak or at an end of the range, SI.
    Height,
    /// The value of the input at the highest peak within the range, SI.
    Place,
}

/// A quantity and its total derivatives by the design, which an amplitude of zero does not have.
///
/// # Errors
/// [`Error::NotInRange`] without a peak whose place is asked for; the reason for a stretch of the range without an
/// equilibrium or a vibration.
pub(crate) fn highest(
    mechanism: &dyn CurvatureKernels,
    values: (&[f64], &[f64]),
    start: &[f64],
    (vibration, range, quantity): (Vibration, Range, PeakQuantity),
) -> Result<(f64, Option<Vector>), Error> {
    let vibrations = [vibration];
    let of = (&range, &vibrations[..]);
    let along = Along::new(mechanism, values, Following::default(), of, Watch::default())?;
    let scanned = scan(&along, &range, start)?;
    if let Some(gap) = scanned.gaps.first() {
        return Err(gap.reason.clone());
    }
    let none = || range.without("peak", &mechanism.description());
    let search =
        Search { along: &along, scan: &scanned, ascending: range.high > range.low, tolerances: None, which: 0 };
    let tops = search.tops()?.into_iter().map(|top| top.1);
    let (value, slopes) = match quantity {
        PeakQuantity::Height => {
            let ends = [scanned.states.first(), scanned.states.last()];
            let ends = ends.into_iter().flatten();
            let ends = ends.map(|end| along.curve(end.value, &end.equilibrium.coordinates, 0));
            let ends: Vec<Curve> = ends.collect::<Result<_, Error>>()?;
            let all = tops.map(|top| (top.top_by_design(), top));
            let ends = ends.into_iter().map(|end| (end.square_by_design(), end));
            let greatest = all.chain(ends).max_by(|a, b| lower(&a.1, &b.1));
            let (slopes, greatest) = greatest.ok_or_else(none)?;
            (greatest.heard().height(), greatest.height_by_design(&slopes))
        }
        PeakQuantity::Place => {
            let top = tops.max_by(lower).ok_or_else(none)?;
            (top.point.value, top.place_by_design())
        }
    };
    Ok((value, slopes.iter().all(|slope| slope.is_finite()).then_some(slopes)))
}

fn lower(a: &Curve, b: &Curve) -> core::cmp::Ordering {
    let [a, b] = [a, b].map(|curve| curve.heard().square().value);
    a.total_cmp(&b)
}
