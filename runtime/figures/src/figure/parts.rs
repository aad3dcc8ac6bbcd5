//! Elements drawn between the axes. Elements without a label do not appear in the legend.

use serde::Serialize;

use super::{Colour, Point, Shape, Stroke};

/// A line, broken into pieces where values are missing.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Curve {
    /// Its legend entry.
    pub label: String,
    /// Its colour.
    pub colour: Colour,
    /// How it is drawn.
    pub stroke: Stroke,
    /// Its pieces, each of two points or more.
    pub pieces: Vec<Vec<Point>>,
}

/// A shaded area between two curves.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Band {
    /// Its legend entry.
    pub label: String,
    /// Its colour, drawn faintly.
    pub colour: Colour,
    /// Positions along the horizontal axis, each with the lower and the upper value.
    pub edges: Vec<[f64; 3]>,
}

/// Rectangles.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Bars {
    /// Their legend entry.
    pub label: String,
    /// Their colour.
    pub colour: Colour,
    /// Left, right, lower and upper end of each.
    pub bars: Vec<[f64; 4]>,
}

/// Separate points.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Markers {
    /// Their legend entry.
    pub label: String,
    /// Their colour.
    pub colour: Colour,
    /// Their form.
    pub shape: Shape,
    /// Their positions.
    pub points: Vec<Point>,
}

/// Points with an interval about each.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ErrorBars {
    /// Their legend entry.
    pub label: String,
    /// Their colour.
    pub colour: Colour,
    /// The form of the points.
    pub shape: Shape,
    /// The points with their intervals.
    pub bars: Vec<ErrorBar>,
}

/// A point with a vertical or horizontal interval about it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ErrorBar {
    /// The point.
    pub at: Point,
    /// The lower or left end of the interval.
    pub low: Point,
    /// The upper or right end.
    pub high: Point,
}

/// A vertical line.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mark {
    /// What it marks.
    pub label: String,
    /// Its position along the horizontal axis.
    pub at: f64,
}

/// A text beside a point.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Label {
    /// The point; the text stands above and to its right.
    pub at: Point,
    /// The text.
    pub text: String,
}
