//! The figures of the paper, drawn from a sweep.

use eigentol_figures::Figure;
use eigentol_figures::figure::{Axis, Colour, Curve, ErrorBar, Mark, Panel, Point, Shape, Stroke};

use crate::question::percent;
use crate::sweep::{Row, Spread, Sweep};

/// The data for a figure.
#[derive(Clone, Debug)]
pub struct Sweeps<'a> {
    /// Many speeds without Monte Carlo, for the curves.
    pub curve: &'a Sweep,
    /// The speeds with Monte Carlo, for the markers.
    pub sampled: &'a Sweep,
    /// Critical speed, rad/s.
    pub critical: f64,
    /// Mechanism, what varies, samples and seed.
    pub caption: String,
}

/// A figure and its file name without extension.
pub type Named = (&'static str, Figure);

/// Equilibrium angles from the axis.
pub fn angles(sweeps: &Sweeps<'_>, name: &'static str, title: &str) -> Named {
    let count = sweeps.curve.rows.first().map_or(0, |row| row.angles.len());
    let mut panel = sweeps.panel("angle from the axis", "rad");
    for k in 0..count {
        let points = sweeps.points(|row| row.angles[k]);
        let label = bar_label("angle", k, count);
        panel.curve(Curve::new(label, Colour::Series(k), points).stroke(Stroke::of(k)));
    }
    (name, sweeps.figure(title, "", vec![panel]))
}

/// Natural frequencies, with the drive speed itself: where they meet, a mode is in resonance.
pub fn frequencies(sweeps: &Sweeps<'_>, name: &'static str, title: &str) -> Named {
    let count = sweeps.curve.modes;
    let mut panel = sweeps.panel("natural frequency", "rad/s");
    for mode in 0..count {
        let points = sweeps.points(|row| row.frequencies[mode]);
        panel.curve(Curve::new(
            mode_label(mode, count),
            Colour::Series(mode),
            points,
        ));
    }
    let drive = Curve::new(
        "drive speed",
        Colour::Grey,
        sweeps.points(|row| Some(row.speed)),
    );
    panel.curve(drive.stroke(Stroke::Dashed));
    panel.fit();
    panel.y.range[0] = 0.0;
    (name, sweeps.figure(title, "", vec![panel]))
}

/// Sampled mean frequencies minus the nominal ones, with standard errors; one panel per mode.
///
/// The nominal frequencies are the means at first order.
pub fn means(sweeps: &Sweeps<'_>, name: &'static str, title: &str) -> Named {
    let (count, samples) = (sweeps.curve.modes, sweeps.sampled.samples as f64);
    let panel = |mode: usize| {
        let name = format!("mean less nominal, {}", mode_label(mode, count));
        let mut panel = sweeps.panel(&name, "rad/s");
        for (k, &level) in sweeps.sampled.question.levels.iter().enumerate() {
            let bars = sweeps.sampled.rows.iter().filter_map(|row| {
                let own = row.spreads[k].sampled[mode];
                let error = own.sigma? / samples.sqrt();
                let at = [row.speed, own.mean? - row.frequencies[mode]?];
                Some(ErrorBar::upright(at, error))
            });
            let label = format!("Monte Carlo {} %", percent(level));
            panel.error_bars(label, Colour::Series(k), Shape::of(k), bars);
        }
        panel.level_line(0.0);
        panel
    };
    let note = "At first order the mean is the nominal frequency, whatever the tolerance. Bars: standard errors.";
    (
        name,
        sweeps.figure(title, note, (0..count).map(panel).collect()),
    )
}

/// Standard deviation of one mode under the first `levels` tolerances.
///
/// For a single tolerance, the paper's central differences are included.
pub fn deviations(
    sweeps: &Sweeps<'_>,
    name: &'static str,
    title: &str,
    mode: usize,
    levels: usize,
) -> Named {
    let mut panel = sweeps.panel("standard deviation of the frequency", "rad/s");
    let asked = sweeps.sampled.question.levels.iter().take(levels);
    for (k, &level) in asked.enumerate() {
        let (level, colour) = (percent(level), Colour::Series(k));
        let points = sweeps.points(|row| row.spreads[k].first_order[mode].sigma);
        let curve = Curve::new(format!("first order {level} %"), colour, points);
        panel.curve(curve.stroke(Stroke::of(k)));
        let colour = Colour::Series(if levels == 1 { 5 } else { k });
        let points = sweeps.sampled(|row| row.spreads[k].sampled[mode].sigma);
        panel.markers(
            format!("Monte Carlo {level} %"),
            colour,
            Shape::of(k),
            points,
        );
    }
    if levels == 1 {
        let points = sweeps.points(|row| row.spreads[0].differences[mode].sigma);
        let curve = Curve::new("central differences", Colour::Black, points);
        panel.curve(curve.stroke(Stroke::Dotted));
    }
    (name, sweeps.spread_figure(title, panel))
}

/// The contribution of each variable alone to the standard deviation of one mode, under the first tolerance.
pub fn contributions(sweeps: &Sweeps<'_>, name: &'static str, title: &str, mode: usize) -> Named {
    let mut panel = sweeps.panel("standard deviation of the frequency", "rad/s");
    let whole = sweeps.points(|row| row.spreads[0].first_order[mode].sigma);
    panel.curve(Curve::new(
        "first order, all together",
        Colour::Black,
        whole,
    ));
    for (k, name) in sweeps.curve.variables.iter().enumerate() {
        let points = sweeps.points(|row| row.spreads[0].contribution(mode, k));
        let curve = Curve::new(format!("{name} alone"), Colour::Series(k), points);
        panel.curve(curve.stroke(Stroke::of(k)));
    }
    let points = sweeps.sampled(|row| row.spreads[0].sampled[mode].sigma);
    panel.markers(
        "Monte Carlo, all together",
        Colour::Black,
        Shape::Ring,
        points,
    );
    (name, sweeps.spread_figure(title, panel))
}

impl Spread {
    /// First-order standard deviation of `mode` when only variable `variable` varies.
    pub fn contribution(&self, mode: usize, variable: usize) -> Option<f64> {
        let share = self.shares[mode].get(variable)?;
        Some(share.max(0.0).sqrt() * self.first_order[mode].sigma?)
    }
}

impl Sweeps<'_> {
    /// Points of the dense sweep, interrupted where the branch changes.
    fn points(&self, value: impl Fn(&Row) -> Option<f64>) -> Vec<Option<Point>> {
        let mut points = Vec::new();
        let mut below = true;
        for row in &self.curve.rows {
            if below && row.speed >= self.critical {
                points.push(None);
            }
            below = row.speed < self.critical;
            points.push(value(row).map(|value| [row.speed, value]));
        }
        points
    }

    fn sampled(&self, value: impl Fn(&Row) -> Option<f64>) -> Vec<Point> {
        let rows = self.sampled.rows.iter();
        rows.filter_map(|row| Some([row.speed, value(row)?]))
            .collect()
    }

    fn panel(&self, name: &str, unit: &str) -> Panel {
        let mut speed = Axis::new("drive speed", "rad/s");
        speed.range = self.curve.question.range.into();
        let mut panel = Panel::new(speed, Axis::new(name, unit));
        panel.marks.push(Mark {
            label: format!("critical {:.3} rad/s", self.critical),
            at: self.critical,
        });
        panel
    }

    fn figure(&self, title: &str, note: &str, panels: Vec<Panel>) -> Figure {
        Figure::new(title, vec![self.caption.clone(), note.to_owned()], panels)
    }

    /// A figure of standard deviations, scaled to the samples rather than to the spike of first order.
    fn spread_figure(&self, title: &str, mut panel: Panel) -> Figure {
        let sampled = panel.markers.iter().flat_map(|own| &own.points);
        let highest = sampled.fold(0.0, |most: f64, point| most.max(point[1]));
        panel.fit();
        panel.y.range[0] = 0.0;
        let mut note = "";
        if highest > 0.0 && 1.25 * highest < panel.y.range[1] {
            panel.y.range[1] = 1.25 * highest;
            note = "First order grows without bound at the critical speed and is cut off here; Monte Carlo stays finite.";
        }
        self.figure(title, note, vec![panel])
    }
}

fn bar_label(name: &str, index: usize, count: usize) -> String {
    if count > 1 {
        format!("{name} of bar {}", index + 1)
    } else {
        format!("{name} of the bar")
    }
}

fn mode_label(mode: usize, count: usize) -> String {
    if count > 1 {
        format!("mode {}", mode + 1)
    } else {
        "natural frequency".to_owned()
    }
}
