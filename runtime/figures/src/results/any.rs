//! The figure of a result, whatever its type.

use core::any::Any;

use eigentol::bode::Bode;
use eigentol::branches::Branches;
use eigentol::response::Vibration;
use eigentol::summary::Summary;
use eigentol::sweep::Sweep;
use eigentol::{Campbell, FirstOrder, Modes, MonteCarlo};

use super::{Histogram, bode, branches, campbell, frequencies, mode_shapes, shares_of_all};
use crate::Error;
use crate::figure::Figure;
use crate::style::Style;

/// The figure that shows a result as a whole: of vibrations along an input the first one, of samples the first mode. `None`
/// if results of this type have no figure.
#[must_use]
pub fn figure_of(result: &dyn Any, style: &Style) -> Option<Result<Figure, Error>> {
    fn of<R: 'static>(
        result: &dyn Any,
        draw: impl FnOnce(&R) -> Result<Figure, Error>,
    ) -> Option<Result<Figure, Error>> {
        result.downcast_ref().map(draw)
    }
    of(result, |result: &Campbell| campbell(result, style))
        .or_else(|| of(result, |result: &Sweep| frequencies(result, style)))
        .or_else(|| of(result, |result: &Branches| branches(result, style)))
        .or_else(|| of(result, |result: &Modes| mode_shapes(result, style)))
        .or_else(|| of(result, |result: &FirstOrder| shares_of_all(result, style)))
        .or_else(|| of(result, |result: &Summary| shares_of_all(&result.first, style)))
        .or_else(|| of(result, |result: &MonteCarlo| Histogram::new(result, 0).figure(style)))
        .or_else(|| {
            of(result, |result: &Bode| {
                bode(
                    result,
                    Vibration::all(&result.description)
                        .into_iter()
                        .next()
                        .ok_or_else(|| Error::nothing("the mechanism has no output"))?,
                    &[],
                    style,
                )
            })
        })
}
