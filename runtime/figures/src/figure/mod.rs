//! The contents of a figure, independent of how it is drawn.
//!
//! All numbers are finite and in the units of the axes. A serialised figure is a tree of lists and plain objects:
//! points are `[x, y]`, colours `"#0072b2"`, and all other keys are the field names below.

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
    /// Its title.
    pub title: String,
    /// Lines below the panels: operating point, parameters, samples and seed, the meaning of shades and markers.
    pub caption: Vec<String>,
    /// Its panels, from top to bottom.
    pub panels: Vec<Panel>,
}

/// One pair of axes and the elements between them, drawn in this order: bands, bars, marks, curves, error bars,
/// markers, labels.
///
/// Anything outside the ranges of the axes is clipped.
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
    /// Texts beside points.
    pub labels: Vec<Label>,
    /// A unit is equally long along both axes: where it is drawn, one of the ranges is widened.
    pub equal_scales: bool,
}
