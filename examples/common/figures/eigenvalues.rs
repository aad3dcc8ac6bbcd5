//! Eigenvalues over a speed: real parts solid, imaginary parts dashed, each motion in a colour of its own.

use eigentol::Campbell;
use eigentol::campbell::CampbellMode;
use eigentol::sweep::EventTolerance;

use super::{Band, Curve, Figure, Markers, Point, Shape};

/// Palette entry of what only compares.
const GREY: usize = 4;
/// Palette entry of the axis and of events.
const BLACK: usize = 5;

/// The eigenvalues of a diagram up to `top` in size, 1/s, and the speeds at which stability changes with the bands that
/// tolerances give them. `speed` is the name and unit of the axis.
pub fn eigenvalues(
    (name, title): (&str, &str),
    campbell: &Campbell,
    speed: &str,
    top: f64,
) -> Figure {
    let values = campbell.points.iter().map(|point| point.value);
    let ends = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (value.min(low), value.max(high))
    });
    let changes = || campbell.critical.iter().chain(&campbell.flutter_onsets);
    let mut figure = Figure {
        name: name.to_owned(),
        title: title.to_owned(),
        note: format!(
            "Shaded: {} standard deviations of the speeds at which stability changes.",
            campbell.sigma_level
        ),
        speed: speed.to_owned(),
        values: "eigenvalue [1/s]".to_owned(),
        speeds: ends,
        range: (-top, top),
        mark: (f64::NAN, String::new()),
        ..Figure::default()
    };
    for label in campbell.labels() {
        for (part, dashed) in [(real as Part, false), (imaginary as Part, true)] {
            let pieces = pieces(campbell, label, part);
            if !pieces.is_empty() {
                let word = if dashed { "imaginary" } else { "real" };
                figure.curves.push(Curve {
                    label: format!("mode {}, {word} part", label + 1),
                    colour: label % GREY,
                    dashed,
                    pieces,
                });
            }
        }
    }
    figure.curves.push(Curve {
        label: String::new(),
        colour: BLACK,
        dashed: false,
        pieces: vec![vec![(ends.0, 0.0), (ends.1, 0.0)]],
    });
    figure.bands = changes().filter_map(|event| band(event, top)).collect();
    figure.markers = vec![Markers {
        label: "stability changes".to_owned(),
        colour: BLACK,
        shape: Shape::Cross,
        points: changes().map(|event| (event.value, 0.0)).collect(),
    }];
    figure
}

/// A part of an eigenvalue; `None` where it is not drawn.
type Part = fn(&CampbellMode) -> Option<f64>;

fn real(mode: &CampbellMode) -> Option<f64> {
    Some(mode.s.re)
}

fn imaginary(mode: &CampbellMode) -> Option<f64> {
    mode.behaviour.frequency()
}

fn pieces(campbell: &Campbell, label: usize, part: Part) -> Vec<Vec<Point>> {
    let mut pieces: Vec<Vec<Point>> = vec![Vec::new()];
    for point in &campbell.points {
        let modes = point.modes.as_deref().unwrap_or_default();
        let mode = modes.iter().find(|mode| mode.label == label);
        match (mode.and_then(part), pieces.last_mut()) {
            (Some(value), Some(piece)) => piece.push((point.value, value)),
            _ => pieces.push(Vec::new()),
        }
    }
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

fn band(event: &EventTolerance, top: f64) -> Option<Band> {
    let half = event.spread.as_ref().ok()?.band;
    let edges = [event.value - half, event.value + half];
    Some(Band {
        label: String::new(),
        colour: GREY,
        edges: edges.map(|value| (value, -top, top)).to_vec(),
    })
}
