//! Eigenvalues: their parts along an input, and their paths in the plane.

use eigentol::Campbell;

use super::along::{Along, Course, finished};
use super::campbell::changes_stability;
use super::ends::Ends;
use super::events;
use super::tracks::{Track, tracks};
use crate::Error;
use crate::caption::number;
use crate::figure::{Axis, Colour, Curve, Figure, Panel, Shape, Stroke};
use crate::style::Style;

/// Margin to the left and right of the paths in the plane, as a fraction of their width.
const ROOM: f64 = 0.04;

/// Real parts (solid) and imaginary parts (dashed) of the eigenvalues along the input, with the stability limits.
///
/// Each limit has a bar of as many standard deviations as the tolerances span.
///
/// # Errors
/// [`Error::Nothing`] if there are no modes.
pub fn eigenvalues(result: &Campbell, style: &Style) -> Result<Figure, Error> {
    let course = Course::of(result);
    let mut panel = Panel::new(course.axis(), Axis::new("eigenvalue", "1/s"));
    let mut ends = Ends::default();
    for track in tracks(&course.stations, &course.critical) {
        let real = if track.oscillates() {
            format!("{}, real part", style.mode(track.label))
        } else {
            format!("{}, real", style.mode(track.label))
        };
        let curve = Curve {
            label: real,
            colour: Colour::Series(track.label),
            stroke: Stroke::Solid,
            pieces: track.points(|point| [point.value, point.s.re]),
        };
        ends.add(&track, &curve);
        panel.curve(curve);
        if track.oscillates() {
            panel.curve(Curve {
                label: format!("{}, imaginary part", style.mode(track.label)),
                colour: Colour::Series(track.label),
                stroke: Stroke::Dashed,
                pieces: track.points(|point| [point.value, point.s.im]),
            });
        }
    }
    if panel.is_empty() {
        return Err(Error::nothing("no value has modes"));
    }
    if let Some(top) = style.top() {
        panel.y.range = [-top, top];
    }
    panel.marks.extend(style.marks());
    let lines = events::draw(&mut panel, result, style, |event| changes_stability(event).then_some(0.0));
    panel.fit();
    panel.level_line(0.0);
    ends.write(&mut panel, style);
    let mut caption = course.caption(style);
    caption.extend(lines);
    Ok(finished(style, &result.description, "eigenvalues", caption, vec![panel]))
}

/// The paths of the eigenvalues in the complex plane as the input varies.
///
/// The real part is to the right, the imaginary part upwards; each path goes from a ring to a disc. To the right of
/// zero the motion grows.
///
/// # Errors
/// [`Error::Nothing`] if there are no modes.
pub fn root_locus<R: Along + ?Sized>(result: &R, style: &Style) -> Result<Figure, Error> {
    let course = Course::of(result);
    let mut panel = Panel::new(Axis::new("Re s", "1/s"), Axis::new("Im s", "1/s"));
    let all = tracks(&course.stations, &course.critical);
    for track in &all {
        let kind = if track.oscillates() { "" } else { ", real" };
        panel.curve(Curve {
            label: format!("{}{kind}", style.mode(track.label)),
            colour: Colour::Series(track.label),
            stroke: Stroke::of(track.label),
            pieces: track.points(|point| [point.s.re, point.s.im]),
        });
    }
    if panel.is_empty() {
        return Err(Error::nothing("no value has modes"));
    }
    let [first, last] = course.axis().range;
    let unit = course.axis().unit;
    let words = |value: f64| if unit.is_empty() { number(value) } else { format!("{} {unit}", number(value)) };
    for (value, shape) in [(first, Shape::Ring), (last, Shape::Disc)] {
        let here =
            all.iter().flat_map(|track: &Track| track.pieces.iter().flatten()).filter(|state| state.value == value);
        let points: Vec<_> = here.map(|state| [state.s.re, state.s.im]).collect();
        let label = format!("{} = {}", course.axis().name, words(value));
        panel.markers(label, Colour::Black, shape, points);
    }
    panel.fit();
    // Without this margin the frame would cut the end markers in half.
    let [low, high] = panel.x.range;
    let room = ROOM * (high - low);
    panel.x.range = [low - room, (high + room).max(room)];
    if let Some(top) = style.top() {
        panel.y.range[1] = top;
    }
    panel.marks.push(crate::figure::Mark { label: "motions to the right grow".to_owned(), at: 0.0 });
    let caption = course.caption(style);
    Ok(finished(style, course.description, "root locus", caption, vec![panel]))
}
