//! Figures over the speed, as SVG files.

mod campbell;
mod clip;
mod content;
mod draw;
mod eigenvalues;

pub use campbell::Whirling;
pub use content::{Sweeps, angles, contributions, deviations, frequencies, means};
pub use eigenvalues::eigenvalues;

use std::fs;
use std::path::Path;

use crate::Failure;

/// A point of a figure: speed and value.
pub type Point = (f64, f64);

/// A figure: curves for what is computed, markers for what is sampled or happens at one speed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figure {
    /// Name of its file, without the ending.
    pub name: String,
    /// What it shows.
    pub title: String,
    /// A sentence below the figure; may be empty.
    pub note: String,
    /// Name and unit of the speed.
    pub speed: String,
    /// Name and unit of the values.
    pub values: String,
    /// Range of the speeds.
    pub speeds: (f64, f64),
    /// Range of the values; what lies outside is cut off.
    pub range: (f64, f64),
    /// A thin vertical line, and what it marks; none without words.
    pub mark: (f64, String),
    /// Shaded areas, behind everything else.
    pub bands: Vec<Band>,
    /// Lines.
    pub curves: Vec<Curve>,
    /// Markers.
    pub markers: Vec<Markers>,
    /// Words in the figure, to the right of the points they belong to and below.
    pub labels: Vec<(Point, String)>,
}

/// A shaded area between two curves.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// What it is; without a label it is not in the legend.
    pub label: String,
    /// Position in the palette.
    pub colour: usize,
    /// Speeds with the lower and the upper value.
    pub edges: Vec<(f64, f64, f64)>,
}

/// A line, in pieces where values are missing.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// What it is; without a label it is not in the legend.
    pub label: String,
    /// Position in the palette.
    pub colour: usize,
    /// Whether it is dashed.
    pub dashed: bool,
    /// Its pieces.
    pub pieces: Vec<Vec<Point>>,
}

/// Separate points.
#[derive(Clone, Debug, PartialEq)]
pub struct Markers {
    /// What they are.
    pub label: String,
    /// Position in the palette.
    pub colour: usize,
    /// Their form.
    pub shape: Shape,
    /// Where they lie.
    pub points: Vec<Point>,
}

/// Form of a marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A ring.
    Ring,
    /// A filled triangle.
    Triangle,
    /// A diagonal cross.
    Cross,
}

impl Shape {
    /// The form of series number `index`.
    pub fn of(index: usize) -> Self {
        [Self::Ring, Self::Triangle, Self::Cross][index % 3]
    }
}

impl Figure {
    /// Writes the figure as SVG into `directory`.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn save(&self, directory: &Path) -> Result<(), Failure> {
        let path = directory.join(format!("{}.svg", self.name));
        let written = draw::svg(self).and_then(|text| Ok(fs::write(&path, text)?));
        written.map_err(|error| Failure::Output {
            path,
            reason: error.to_string(),
        })
    }
}
