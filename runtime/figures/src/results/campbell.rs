//! Campbell diagrams.

use eigentol::Campbell;
use eigentol::campbell::CampbellMode;
use eigentol::modes::Sense;
use eigentol::sweep::{Condition, Event};
use eigentol::tolerance::Spread;

use super::along::{Course, finished, input_unit};
use super::ends::Ends;
use super::events;
use super::scale::{self, factor, words};
use super::tracks::{Motion, Track, tracks};
use crate::Error;
use crate::caption::{in_unit, number};
use crate::figure::{Axis, Colour, Curve, Figure, Panel, Point, Stroke};
use crate::style::Style;

/// The Campbell diagram: frequencies with their bands (backward whirl dashed), excitation lines, and numbered crossings
/// and stability changes.
///
/// Each event has a bar of as many standard deviations as the tolerances span.
///
/// ```
/// use eigentol::{Study, mechanism};
/// use eigentol_figures::{Style, campbell};
///
/// mechanism! {
///     mechanism Pendulum {
///         input omega: rad/s;
///         design l = 1 m +/- 3%;
///         gravity 9.81 m/s^2 along -z;
///         body shaft: massless;
///         body bar: rod(mass: 3 kg, length: l, along: -z);
///         joint spin: revolute(z) from ground to shaft, driven at omega;
///         joint theta: revolute(y) from shaft to bar;
///     }
/// }
///
/// let study = Study::new(Pendulum).start(Pendulum::theta, 1.0);
/// let found = study.campbell(Pendulum::omega, &[4.0, 5.0, 6.0], &[1.0])?;
/// let figure = campbell(&found, &Style::of(&study).name_mode(0, "swing"))?;
/// assert_eq!(figure.panels[0].curves.len(), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Error::Nothing`] where no mode oscillates.
pub fn campbell(result: &Campbell, style: &Style) -> Result<Figure, Error> {
    let few = result.shown();
    let modes_left_out = result.modes_left_out(&few);
    let result = &few;
    let course = Course::of(result);
    let (scale, symbol) = style.frequency(&result.description);
    let mut panel = Panel::new(course.axis(), Axis::new("frequency", &*symbol));
    let mut ends = Ends::default();
    for track in tracks(&course.stations, &course.critical) {
        if track.oscillates() {
            let curve = oscillation(&track, style, |x| scale * x.s.im);
            ends.add(&track, &curve);
            panel.curve(curve);
        }
    }
    let curves = panel.curves.iter().flat_map(|curve| &curve.pieces).flatten();
    let markers = panel.markers.iter().flat_map(|marker| &marker.points);
    let highest = curves.chain(markers).fold(0.0, |most: f64, p| most.max(p[1]));
    if panel.is_empty() {
        return Err(Error::nothing("no mode oscillates at any of the values"));
    }
    let top = style.top().unwrap_or_else(|| match (1.05 * highest, reached(&panel, result, scale)) {
        (all, Some(reached)) if reached < all => reached,
        (all, _) if all > 0.0 => all,
        _ => 1.0,
    });
    let bottom = style.bottom().min(0.99 * top);
    panel.y.range = [bottom, top];
    let times = bands(&mut panel, result, (style, top - bottom), scale, |x| x.frequency.as_ref());
    let seen = |point: &Point| (bottom..=top).contains(&point[1]);
    let all = panel.curves.len();
    panel.curves.retain(|curve| curve.pieces.iter().flatten().any(seen));
    let beyond = all - panel.curves.len();
    orders(&mut panel, result, scale);
    panel.marks.extend(style.marks());
    ends.write(&mut panel, style);
    let lines = events::draw(&mut panel, result, style, |event| {
        let height = match event {
            Event::Crossing { s, .. } => scale * s.im,
            _ => 0.0,
        };
        (bottom..=top).contains(&height).then_some(height)
    });
    let mut caption = course.caption(style);
    if !panel.bands.is_empty() {
        caption.push(words(result.sigma_level, times));
    }
    caption.extend(lines);
    caption.extend(result.left_out());
    caption.extend(modes_left_out);
    if beyond > 0 && style.top().is_none() {
        let lines = if beyond == 1 { "line lies" } else { "lines lie" };
        caption.push(format!("{beyond} more {lines} above the diagram"));
    }
    Ok(finished(style, &result.description, "Campbell diagram", caption, vec![panel]))
}

/// Somewhat above the excitation lines and the lowest frequency: no frequency higher up meets a line.
fn reached(panel: &Panel, result: &Campbell, scale: f64) -> Option<f64> {
    let unit = input_unit(&result.description, result.input);
    let ends = panel.x.range.map(|end| unit.to_si(end));
    let lines = result.orders.iter();
    let lines = lines.flat_map(|line| ends.map(|end| scale * (line.ratio * end + line.offset))).reduce(f64::max)?;
    let greatest = |curve: &Curve| curve.pieces.iter().flatten().fold(0.0, |most: f64, point| most.max(point[1]));
    let lowest = panel.curves.iter().map(greatest).reduce(f64::min)?;
    Some((1.2 * lines).max(1.2 * lowest))
}

/// Draws a motion in the colour of its mode; backward whirl is dashed, and if nothing whirls every mode has its own
/// stroke.
pub(super) fn oscillation(track: &Track, style: &Style, height: impl Fn(&super::tracks::TrackPoint) -> f64) -> Curve {
    let character = match track.motion {
        Motion::Oscillation(character) => character,
        Motion::Real => None,
    };
    Curve {
        label: style.whirling(track.label, character),
        colour: Colour::Series(track.label),
        stroke: match character.and_then(|x| x.sense) {
            Some(Sense::Backward) => Stroke::Dashed,
            Some(Sense::Planar) => Stroke::DashDotted,
            Some(Sense::Forward) => Stroke::Solid,
            None => Stroke::of(track.label),
        },
        pieces: track.points(|point| [point.value, height(point)]),
    }
}

/// Shades a band of as many standard deviations as the tolerances span about each mode, and returns the factor by which
/// it is exaggerated. Modes of a cluster have no spread of their own.
pub(super) fn bands(
    panel: &mut Panel,
    result: &Campbell,
    (style, length): (&Style, f64),
    scale: f64,
    quantity: impl Fn(&CampbellMode) -> Option<&Spread>,
) -> f64 {
    let unit = input_unit(&result.description, result.input);
    let quantity = |mode: &CampbellMode| {
        let spread = quantity(mode).filter(|_| !mode.clustered)?;
        spread.band.is_finite().then_some((scale * spread.mean, scale * spread.band))
    };
    let modes = result.points.iter().flat_map(|point| point.modes.iter().flatten());
    let times = if style.is_widened() { factor(modes.filter_map(quantity).map(|pair| pair.1), length) } else { 1.0 };
    let mut legend = scale::legend(result.sigma_level, times);
    for label in result.labels() {
        let mut edges = Vec::new();
        let colour = Colour::Series(label);
        for point in &result.points {
            let mode = point.modes.as_deref().unwrap_or_default().iter().find(|mode| mode.label == label);
            match mode.and_then(quantity) {
                Some((mean, half)) => {
                    let value = in_unit(point.value, &unit);
                    edges.push([value, mean - times * half, mean + times * half]);
                }
                None => panel.band("", colour, std::mem::take(&mut edges)),
            }
        }
        // One entry of the legend stands for all bands.
        let entry = if edges.len() > 1 { std::mem::take(&mut legend) } else { String::new() };
        panel.band(entry, colour, edges);
    }
    times
}

/// Adds the excitation lines, as far as they lie within the panel.
fn orders(panel: &mut Panel, result: &Campbell, scale: f64) {
    let unit = input_unit(&result.description, result.input);
    let ([low, high], [bottom, top]) = (panel.x.range, panel.y.range);
    let label = |first: bool| if first { "excitation" } else { "" };
    for (k, line) in result.orders.iter().enumerate() {
        let value = |value: f64| scale * (line.ratio * unit.to_si(value) + line.offset);
        let ends: [Point; 2] = [[low, value(low)], [high, value(high)]];
        panel.curve(Curve::new(label(k == 0), Colour::Grey, ends.map(Some)).stroke(Stroke::Dotted));
        let inside = |t: &f64| (bottom..=0.97 * top).contains(&value(low + t * (high - low)));
        let fraction = (1..=19).rev().map(|k| 0.05 * f64::from(k)).find(inside);
        if let Some(t) = fraction.filter(|_| line.ratio != 0.0) {
            let at = low + t * (high - low);
            panel.label([at, value(at)], format!("{} x", number(line.ratio)));
        }
    }
}

/// Whether an event is a stability limit rather than a crossing of a line.
pub(super) fn changes_stability(event: &Event) -> bool {
    !matches!(event, Event::Crossing { condition: Condition::Line(_), .. })
}
