//! Orbits of two vibrating outputs.

use std::f64::consts::TAU;

use eigentol::forced::{ForcedResponse, Orbit, Turning};
use eigentol::response::{Response, Vibration};
use eigentol::{Complex, Excitation, Output, Unit};

use super::along::with_notes;
use crate::Error;
use crate::caption::{in_unit, number, operating_point, with_unit};
use crate::figure::{Axis, Colour, Curve, Figure, Panel, Point, Shape};
use crate::style::Style;

/// Number of points of an orbit.
const POINTS: usize = 180;
/// Where the disc is, as a share of the period.
const LATER: f64 = 0.125;

/// The ellipse on which two outputs move with the frequency of an excitation, passed from a ring at phase 0 to a disc an
/// eighth of a period later.
///
/// # Errors
/// [`Error::Nothing`] if there is no such vibration, if it stands still, or if the outputs have different units.
pub fn orbit<M>(
    result: &ForcedResponse,
    [x, y]: [Output<M>; 2],
    excitation: Excitation<M>,
    style: &Style,
) -> Result<Figure, Error> {
    let d = &*result.description;
    let harmonic = result.harmonic(excitation);
    let pair = [x, y].map(|output| d.outputs.get(output.index()));
    let (Some(harmonic), [Some(first), Some(second)]) = (harmonic, pair) else {
        return Err(Error::nothing("there is no such vibration"));
    };
    if first.unit != second.unit {
        let text = format!("{} and {} have different units", first.name, second.name);
        return Err(Error::nothing(text));
    }
    let unit = &first.unit;
    let amplitudes = [x, y].map(|output| harmonic.outputs.get(output.index()).copied().flatten());
    let [Some(across), Some(up)] = amplitudes else {
        return Err(Error::nothing("there is no such vibration"));
    };
    if across == Complex::ZERO && up == Complex::ZERO {
        let text = format!("{} and {} stand still", first.name, second.name);
        return Err(Error::nothing(text));
    }
    let at = |share: f64| -> Point {
        let turn = Complex::from_polar(1.0, TAU * share);
        [across, up].map(|x| in_unit((x * turn).re, unit))
    };
    let mut panel = Panel::new(Axis::new(&*first.name, &*unit.symbol), Axis::new(&*second.name, &*unit.symbol));
    panel.equal_scales = true;
    let points = (0..=POINTS).map(|k| Some(at(k as f64 / POINTS as f64)));
    panel.curve(Curve::new("", Colour::Series(0), points));
    panel.markers("phase 0", Colour::Black, Shape::Ring, [at(0.0)]);
    let later = "an eighth of a period later";
    panel.markers(later, Colour::Black, Shape::Disc, [at(LATER)]);
    let names = [&*first.name, &*second.name];
    let (scale, symbol) = style.frequency(d);
    let frequency = format!("{} {symbol}", number(scale * harmonic.frequency));
    let vibration = Response::Vibration(Vibration::new(x, excitation)).name(d);
    let under = vibration.split_once(" under ").map_or("?", |pair| pair.1);
    let caption = vec![
        operating_point(d, &result.inputs, None),
        format!("Under {under}, {frequency}; displacements from the equilibrium."),
        about(&Orbit::of(across, up), names, unit),
    ];
    let caption = with_notes(caption, style, d);
    let title = format!("{}: orbit of {} and {}", d.name, names[0], names[1]);
    Ok(Figure::new(style.titled(title), caption, vec![panel]))
}

/// `Semi-axes 0.12 mm and 0.07 mm, the longer one 31 deg from across towards up; passed forward, from across to up.`
fn about(orbit: &Orbit, [x, y]: [&str; 2], unit: &Unit) -> String {
    let [long, short] = orbit.semi_axes().map(|value| with_unit(value, unit));
    let direction = orbit.direction().map(|angle| {
        let angle = number(angle.to_degrees());
        format!(", the longer one {angle} deg from {x} towards {y}")
    });
    let sense = match orbit.turning() {
        Some(Turning::Forward) => format!("passed forward, from {x} to {y}"),
        Some(Turning::Backward) => format!("passed backward, from {y} to {x}"),
        None => "a straight line".to_owned(),
    };
    let direction = direction.unwrap_or_default();
    format!("Semi-axes {long} and {short}{direction}; {sense}.")
}
