//! Frequencies and damping ratios along an input.

use super::along::{Along, Course, finished};
use super::campbell::oscillation;
use super::damping::percent;
use super::ends::Ends;
use super::tracks::tracks;
use crate::Error;
use crate::figure::{Axis, Figure, Panel};
use crate::style::Style;

/// Frequencies of the modes along the input and, if any mode is damped, their damping ratios below.
///
/// # Errors
/// [`Error::Nothing`] where no mode oscillates.
pub fn frequencies<R: Along + ?Sized>(result: &R, style: &Style) -> Result<Figure, Error> {
    let course = Course::of(result);
    let (scale, symbol) = style.frequency(course.description);
    let mut upper = Panel::new(course.axis(), Axis::new("frequency", &*symbol));
    let mut lower = Panel::new(course.axis(), Axis::new("damping ratio", "%"));
    let mut damped = false;
    let mut ends = Ends::default();
    for track in tracks(&course.stations, &course.critical) {
        if track.oscillates() {
            let curve = oscillation(&track, style, |x| scale * x.s.im);
            ends.add(&track, &curve);
            upper.curve(curve);
            lower.curve(oscillation(&track, style, percent));
            let states = track.pieces.iter().flatten();
            damped |= states.into_iter().any(|state| state.s.re != 0.0);
        }
    }
    if upper.is_empty() {
        return Err(Error::nothing("no mode oscillates at any of the values"));
    }
    upper.fit();
    upper.y.range = [0.0, style.top().unwrap_or(upper.y.range[1])];
    ends.write(&mut upper, style);
    let mut panels = vec![upper];
    if damped {
        lower.fit();
        lower.y.range = [lower.y.range[0].min(0.0), lower.y.range[1].max(0.0)];
        lower.level_line(0.0);
        panels.push(lower);
    }
    for panel in &mut panels {
        panel.marks.extend(style.marks());
    }
    Ok(finished(style, course.description, "frequencies", course.caption(style), panels))
}
