//! Building figures: non-finite numbers are dropped, and the axes are fitted to the content.

use super::{
    Axis, Band, Bars, Colour, Curve, ErrorBar, ErrorBars, Figure, Label, Markers, Panel, Point, Shape, Stroke,
};

/// Margin around the content, as a fraction of its extent.
const ROOM: f64 = 0.05;
/// Where a logarithmic axis begins at the latest, as a fraction of its greatest value.
const LOWEST: f64 = 1e-4;

impl Curve {
    /// A solid line through points, interrupted where a point is missing or not finite.
    #[must_use]
    pub fn new(label: impl Into<String>, colour: Colour, points: impl IntoIterator<Item = Option<Point>>) -> Self {
        let mut pieces = vec![Vec::new()];
        for point in points {
            match (point.filter(finite), pieces.last_mut()) {
                (Some(point), Some(piece)) => piece.push(point),
                _ => pieces.push(Vec::new()),
            }
        }
        pieces.retain(|piece| !piece.is_empty());
        Self { label: label.into(), colour, stroke: Stroke::Solid, pieces }
    }

    /// Returns the curve with another stroke.
    #[must_use]
    pub fn stroke(mut self, stroke: Stroke) -> Self {
        self.stroke = stroke;
        self
    }
}

impl ErrorBar {
    /// A point with a vertical interval of this half-width.
    #[must_use]
    pub fn upright(at: Point, half: f64) -> Self {
        Self { at, low: [at[0], at[1] - half], high: [at[0], at[1] + half] }
    }

    /// A point with a horizontal interval of this half-width.
    #[must_use]
    pub fn level(at: Point, half: f64) -> Self {
        Self { at, low: [at[0] - half, at[1]], high: [at[0] + half, at[1]] }
    }
}

impl Panel {
    /// An empty panel.
    #[must_use]
    pub fn new(x: Axis, y: Axis) -> Self {
        Self { x, y, ..Self::default() }
    }

    /// Adds a line; a piece of one point becomes a marker.
    pub fn curve(&mut self, curve: Curve) {
        let (lines, alone): (Vec<_>, Vec<_>) = (curve.pieces.into_iter()).partition(|piece| piece.len() > 1);
        let lines: Vec<Vec<Point>> = lines.into_iter().filter(|piece| piece.iter().all(finite)).collect();
        if !alone.is_empty() {
            let label = if lines.is_empty() { curve.label.clone() } else { String::new() };
            let points = alone.into_iter().flatten();
            self.markers(label, curve.colour, Shape::Disc, points);
        }
        if !lines.is_empty() {
            self.curves.push(Curve { pieces: lines, ..curve });
        }
    }

    /// Adds the markers that are finite.
    pub fn markers(
        &mut self,
        label: impl Into<String>,
        colour: Colour,
        shape: Shape,
        points: impl IntoIterator<Item = Point>,
    ) {
        let points: Vec<Point> = points.into_iter().filter(finite).collect();
        if !points.is_empty() {
            self.markers.push(Markers { label: label.into(), colour, shape, points });
        }
    }

    /// Adds the error bars that are finite.
    pub fn error_bars(
        &mut self,
        label: impl Into<String>,
        colour: Colour,
        shape: Shape,
        bars: impl IntoIterator<Item = ErrorBar>,
    ) {
        let whole = |bar: &ErrorBar| [bar.at, bar.low, bar.high].iter().all(finite);
        let bars: Vec<ErrorBar> = bars.into_iter().filter(whole).collect();
        if !bars.is_empty() {
            self.error_bars.push(ErrorBars { label: label.into(), colour, shape, bars });
        }
    }

    /// Adds a shaded area; non-finite edges are left out.
    pub fn band(&mut self, label: impl Into<String>, colour: Colour, edges: impl IntoIterator<Item = [f64; 3]>) {
        let whole = |edge: &[f64; 3]| edge.iter().all(|value| value.is_finite());
        let edges: Vec<[f64; 3]> = edges.into_iter().filter(whole).collect();
        if edges.len() > 1 {
            self.bands.push(Band { label: label.into(), colour, edges });
        }
    }

    /// Adds the bars that are finite.
    pub fn bars(&mut self, label: impl Into<String>, colour: Colour, bars: impl IntoIterator<Item = [f64; 4]>) {
        let whole = |bar: &[f64; 4]| bar.iter().all(|value| value.is_finite());
        let bars: Vec<[f64; 4]> = bars.into_iter().filter(whole).collect();
        if !bars.is_empty() {
            self.bars.push(Bars { label: label.into(), colour, bars });
        }
    }

    /// Adds a text beside a point.
    pub fn label(&mut self, at: Point, text: impl Into<String>) {
        if finite(&at) {
            let text = text.into();
            self.labels.push(Label { at, text });
        }
    }

    /// Adds a thin horizontal line across the panel. The horizontal axis must already have its range.
    pub fn level_line(&mut self, at: f64) {
        let [low, high] = self.x.range;
        let line = [Some([low, at]), Some([high, at])];
        self.curves.insert(0, Curve::new("", Colour::Grey, line).stroke(Stroke::Dotted));
    }

    /// Fits axes that have no range to the content, bands and intervals included, with some margin above and below.
    pub fn fit(&mut self) {
        let points = self.points();
        if !self.x.has_range() {
            self.x.range = range(points.iter().map(|point| point[0]), 0.0);
        }
        if !self.y.has_range() {
            self.y.range = range(points.iter().map(|point| point[1]), ROOM);
        }
    }

    /// Makes the vertical axis logarithmic, if the content spans more than this factor. It begins at most four decades below
    /// its top; what is not positive is left out.
    pub fn logarithmic_beyond(&mut self, factor: f64) {
        let positive = self.points().into_iter().map(|point| point[1]).filter(|value| *value > 0.0);
        let Some([low, high]) = positive.fold(None, |ends: Option<[f64; 2]>, value| {
            let [low, high] = ends.unwrap_or([value, value]);
            Some([low.min(value), high.max(value)])
        }) else {
            return;
        };
        if high <= factor * low {
            return;
        }
        let low = low.max(high * LOWEST);
        self.y.logarithmic = true;
        self.y.range = [0.9 * low, high * 10f64.powf(ROOM * (high / low).log10())];
        let floor = self.y.range[0];
        let curves = std::mem::take(&mut self.curves);
        self.curves =
            curves.into_iter().map(|curve| Curve { pieces: positive_pieces(&curve.pieces), ..curve }).collect();
        self.curves.retain(|curve| !curve.pieces.is_empty());
        for edge in self.bands.iter_mut().flat_map(|band| &mut band.edges) {
            *edge = [edge[0], edge[1].max(floor), edge[2].max(floor)];
        }
        for markers in &mut self.markers {
            markers.points.retain(|point| point[1] > 0.0);
        }
    }

    /// The panel as it is drawn on axes of equal steps: logarithms on a logarithmic axis.
    #[cfg(feature = "draw")]
    #[must_use]
    pub(crate) fn straightened(&self) -> Self {
        let mut panel = self.clone();
        let logarithmic = [panel.x.logarithmic, panel.y.logarithmic];
        if logarithmic == [false; 2] {
            return panel;
        }
        let straight = |value: f64, axis: usize| if logarithmic[axis] { value.log10() } else { value };
        panel.x.range = panel.x.range.map(|end| straight(end, 0));
        panel.y.range = panel.y.range.map(|end| straight(end, 1));
        let pieces = panel.curves.iter_mut().flat_map(|curve| &mut curve.pieces).flatten();
        let markers = panel.markers.iter_mut().flat_map(|markers| &mut markers.points);
        let bars = panel.error_bars.iter_mut().flat_map(|errors| &mut errors.bars);
        let bars = bars.flat_map(|bar| [&mut bar.at, &mut bar.low, &mut bar.high]);
        let labels = panel.labels.iter_mut().map(|label| &mut label.at);
        for point in pieces.chain(markers).chain(bars).chain(labels) {
            *point = [straight(point[0], 0), straight(point[1], 1)];
        }
        for edge in panel.bands.iter_mut().flat_map(|band| &mut band.edges) {
            *edge = [straight(edge[0], 0), straight(edge[1], 1), straight(edge[2], 1)];
        }
        panel
    }

    /// Widens one range about its middle until both axes have the same scale in a frame of these proportions, width over
    /// height.
    pub fn equalise(&mut self, proportions: f64) {
        let [wide, high] = [&self.x, &self.y].map(|axis| axis.range[1] - axis.range[0]);
        if wide < proportions * high {
            self.x.widen(proportions * high);
        } else {
            self.y.widen(wide / proportions);
        }
    }

    /// Whether the panel has any content besides axes and marks.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.points().is_empty()
    }

    /// All points that the axes must include.
    fn points(&self) -> Vec<Point> {
        let curves = self.curves.iter().flat_map(|curve| &curve.pieces).flatten();
        let markers = self.markers.iter().flat_map(|marker| &marker.points);
        let errors = self.error_bars.iter().flat_map(|error_bar| &error_bar.bars);
        let errors = errors.flat_map(|bar| [bar.at, bar.low, bar.high]);
        let bands = self.bands.iter().flat_map(|band| &band.edges);
        let bands = bands.flat_map(|&[x, low, high]| [[x, low], [x, high]]);
        let bars = self.bars.iter().flat_map(|bar| &bar.bars);
        let bars = bars.flat_map(|&[left, right, low, high]| [[left, low], [right, high]]);
        (curves.chain(markers).copied()).chain(errors).chain(bands).chain(bars).collect()
    }
}

impl Figure {
    /// A figure of these panels; axes without a range are fitted to the content.
    #[must_use]
    pub fn new(title: impl Into<String>, caption: Vec<String>, mut panels: Vec<Panel>) -> Self {
        for panel in &mut panels {
            panel.fit();
        }
        Self { title: title.into(), caption: caption.into_iter().filter(|line| !line.is_empty()).collect(), panels }
    }
}

impl Axis {
    fn has_range(&self) -> bool {
        self.range[0] < self.range[1]
    }

    fn widen(&mut self, length: f64) {
        let middle = f64::midpoint(self.range[0], self.range[1]);
        self.range = [middle - 0.5 * length, middle + 0.5 * length];
    }
}

/// The parts of a curve whose values are positive.
fn positive_pieces(pieces: &[Vec<Point>]) -> Vec<Vec<Point>> {
    pieces
        .iter()
        .flat_map(|piece| piece.split(|point| point[1] <= 0.0))
        .filter(|part| part.len() > 1)
        .map(<[Point]>::to_vec)
        .collect()
}

fn finite(point: &Point) -> bool {
    point.iter().all(|value| value.is_finite())
}

/// The range of these values with a margin; a single value gets half its size to either side, zero half a unit.
fn range(values: impl Iterator<Item = f64>, room: f64) -> [f64; 2] {
    let ends = values.fold(None, |ends: Option<[f64; 2]>, value| {
        let [low, high] = ends.unwrap_or([value, value]);
        Some([low.min(value), high.max(value)])
    });
    let [low, high] = ends.unwrap_or([0.0, 1.0]);
    let width = high - low;
    if width > 1e-9 * low.abs().max(high.abs()) {
        [low - room * width, high + room * width]
    } else {
        let half = if low == 0.0 { 0.5 } else { 0.5 * low.abs() };
        [low - half, high + half]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gap_cuts_a_curve_and_a_lone_point_is_a_marker() {
        let points = [Some([0.0, 1.0]), Some([1.0, 2.0]), None, Some([3.0, f64::NAN]), Some([4.0, 5.0])];
        let mut panel = Panel::new(Axis::new("x", "m"), Axis::new("y", ""));
        panel.curve(Curve::new("a", Colour::Series(0), points));
        assert_eq!(panel.curves[0].pieces, [[[0.0, 1.0], [1.0, 2.0]]]);
        assert_eq!(panel.markers[0].points, [[4.0, 5.0]]);
        panel.fit();
        assert_eq!(panel.x.range, [0.0, 4.0]);
        assert_eq!(panel.y.range, [0.8, 5.2]);
    }

    #[test]
    fn one_point_has_a_range_about_it() {
        let mut panel = Panel::default();
        panel.markers("", Colour::Black, Shape::Ring, [[2.0, 0.0]]);
        panel.fit();
        assert_eq!((panel.x.range, panel.y.range), ([1.0, 3.0], [-0.5, 0.5]));
    }
}
