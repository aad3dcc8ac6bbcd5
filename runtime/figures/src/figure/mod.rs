//! What a figure consists of, whoever draws it.
//!
//! Numbers are in the units of the axes, and finite. Serialised, a figure is a tree of lists and plain objects: points are
//! `[x, y]`, colours `"#0072b2"`, everything else has the names of the fields here.

mod axis;
mod build;
mod look;
mod parts;

pub use axis::Axis;
pub use look::{Colour, Shape, Stroke};
pub use parts::{Band, Bars, Curve, ErrorBar, ErrorBars, Label, Mark, Markers};

use serde::Serialize;

/// A point: position along the horizontal axis, position along the vertical axis.
pub type Point = [f64; 2];

/// A figure: panels one below the other.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Figure {
    /// What it shows.
    pub title: String,
    /// Lines below it: operating point, parameters, samples and seed, what shades and markers mean.
    pub caption: Vec<String>,
    /// Its panels, from top to bottom.
    pub panels: Vec<Panel>,
}

/// One pair of axes and what is drawn between them: first bands and bars, then marks, curves, error bars, markers and labels.
///
/// What lies outside the ranges of the axes is not seen.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Panel {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Shaded areas.
    pub bands: Vec<Band>,
    /// Bars of histograms, shares and shapes.
    pub bars: Vec<Bars>,
    /// Vertical lines.
    pub marks: Vec<Mark>,
    /// Lines.
    pub curves: Vec<Curve>,
    /// Points with an interval about each.
    pub error_bars: Vec<ErrorBars>,
    /// Separate points.
    pub markers: Vec<Markers>,
    /// Words.
    pub labels: Vec<Label>,
}
