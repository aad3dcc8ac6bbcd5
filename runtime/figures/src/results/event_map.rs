//! Events along an input over a design variable: critical speed maps and limits of stability.

use eigentol::EventMap;
use eigentol::sweep::{Condition, Event};

use super::along::{finished, input_unit};
use super::events::words;
use crate::Error;
use crate::caption::in_unit;
use crate::figure::{Axis, Band, Colour, Curve, Figure, Panel, Stroke};
use crate::style::Style;

/// The events of each mode as a line over the values of the design variable, logarithmic where these span a decade, with bands of
/// as many standard deviations as the tolerances span.
///
/// ```
/// use eigentol::{Study, mechanism};
/// use eigentol_figures::{Style, event_map};
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
/// let study = Study::new(Pendulum);
/// let map = study.event_map(Pendulum::omega, 0.5, 20.0, &[1.0], Pendulum::l, &[0.2, 1.0, 5.0])?;
/// let panel = &event_map(&map, &Style::of(&study))?.panels[0];
/// // The bar swings outwards where omega^2 = 3 g / (2 l); its frequency crosses the speed at half of that.
/// assert!(panel.x.logarithmic && panel.curves.len() == 2 && panel.bands.len() == 2);
/// let highest = panel.curves.iter().map(|curve| curve.pieces[0][1][1]).fold(0.0, f64::max);
/// assert!((highest * highest - 14.715).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Error::Nothing`] where nothing happens at any of the values.
pub fn event_map(map: &EventMap, style: &Style) -> Result<Figure, Error> {
    let d = &map.description;
    let (over, unit) = (&d.design[map.over.index()], input_unit(d, map.input));
    let name = d.inputs.get(map.input.index()).map_or("", |info| &*info.name);
    let mut panel = Panel::new(Axis::new(&*over.name, &*over.unit.symbol), Axis::new(name, &*unit.symbol));
    // What happens, whether it is a limit of stability, and where, with its band.
    let mut lines: Vec<(String, bool, Vec<[f64; 3]>)> = Vec::new();
    for (value, event) in map.events() {
        let place = [in_unit(value, &over.unit), in_unit(event.value, &unit)];
        let half = event.sigma_level * event.sigma().map_or(0.0, |sigma| in_unit(sigma, &unit));
        let words = words(event, style);
        let point = [place[0], place[1] - half, place[1] + half];
        let limit = matches!(event.event, Event::Crossing { condition: Condition::FlutterOnset, .. });
        let ends_before = |points: &[[f64; 3]]| points.last().is_none_or(|last| last[0] != place[0]);
        match lines.iter_mut().find(|(known, _, points)| *known == words && ends_before(points)) {
            Some((_, _, points)) => points.push(point),
            None => lines.push((words, limit, vec![point])),
        }
    }
    if lines.is_empty() {
        return Err(Error::nothing("nothing happens at any of the values"));
    }
    for (k, (words, limit, edges)) in lines.into_iter().enumerate() {
        let points = edges.iter().map(|[x, low, high]| [*x, 0.5 * (low + high)]).collect();
        let (colour, stroke) = (Colour::Series(k), if limit { Stroke::Dashed } else { Stroke::Solid });
        panel.curve(Curve { label: words, colour, stroke, pieces: vec![points] });
        if edges.iter().any(|[_, low, high]| low < high) {
            panel.bands.push(Band { label: String::new(), colour, edges });
        }
    }
    let values: Vec<f64> = map.points.iter().map(|(value, _)| in_unit(*value, &over.unit)).collect();
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    panel.x.logarithmic = least > 0.0 && most >= 10.0 * least;
    Ok(finished(style, d, &format!("events over {}", over.name), Vec::new(), vec![panel]))
}
