//! Damping ratios along an input.

use eigentol::Campbell;

use super::along::{Course, finished};
use super::campbell::{bands, changes_stability, oscillation};
use super::ends::Ends;
use super::events;
use super::scale::words;
use super::tracks::{TrackPoint, tracks};
use crate::Error;
use crate::figure::{Axis, Figure, Panel};
use crate::style::Style;

/// Damping ratios of the oscillating modes with their bands; negative for growing modes. Stability limits are numbered.
///
/// # Errors
/// [`Error::Nothing`] where no mode oscillates.
pub fn damping_ratios(result: &Campbell, style: &Style) -> Result<Figure, Error> {
    let result = &result.shown();
    let course = Course::of(result);
    let mut panel = Panel::new(course.axis(), Axis::new("damping ratio", "%"));
    let mut ends = Ends::default();
    for track in tracks(&course.stations, &course.critical) {
        if track.oscillates() {
            let curve = oscillation(&track, style, percent);
            ends.add(&track, &curve);
            panel.curve(curve);
        }
    }
    if panel.is_empty() {
        return Err(Error::nothing("no mode oscillates at any of the values"));
    }
    let mut fitted = panel.clone();
    fitted.fit();
    let length = fitted.y.range[1] - fitted.y.range[0];
    let times = bands(&mut panel, result, (style, length), 100.0, |x| x.damping_ratio.as_ref());
    panel.marks.extend(style.marks());
    let lines = events::draw(&mut panel, result, style, |event| changes_stability(event).then_some(0.0));
    panel.fit();
    if let Some(top) = style.top() {
        panel.y.range[1] = top;
    }
    let [low, high] = panel.y.range;
    panel.y.range = [low.min(0.0), high.max(0.0)];
    panel.level_line(0.0);
    ends.write(&mut panel, style);
    let mut caption = course.caption(style);
    if !panel.bands.is_empty() {
        caption.push(words(result.sigma_level, times));
    }
    caption.push("Below zero a vibration grows.".to_owned());
    caption.extend(lines);
    Ok(finished(style, &result.description, "damping ratios", caption, vec![panel]))
}

/// Damping ratio in percent.
pub(super) fn percent(state: &TrackPoint) -> f64 {
    let size = state.s.norm();
    if size > 0.0 { -100.0 * state.s.re / size } else { 0.0 }
}
