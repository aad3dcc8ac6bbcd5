//! What the figures of the paper show, taken from a sweep.

use super::{Curve, Figure, Markers, Point, Shape};
use crate::question::percent;
use crate::sweep::{Row, Spread, Sweep};

/// What a figure is drawn from.
#[derive(Clone, Copy, Debug)]
pub struct Sweeps<'a> {
    /// Many speeds without Monte Carlo: the curves.
    pub curve: &'a Sweep,
    /// The speeds with Monte Carlo: the markers.
    pub sampled: &'a Sweep,
    /// Critical speed, rad/s.
    pub critical: f64,
}

/// Palette entry of things that only compare.
const GREY: usize = 4;
/// Palette entry of sums.
const BLACK: usize = 5;

/// Equilibrium angles from the axis.
pub fn angles(sweeps: &Sweeps<'_>, name: &str, title: &str) -> Figure {
    let count = sweeps.curve.rows.first().map_or(0, |row| row.angles.len());
    let curves = (0..count)
        .map(|k| Curve {
            label: bar_label("angle", k, count),
            colour: k,
            dashed: k > 0,
            pieces: sweeps.pieces(|row| row.angles[k]),
        })
        .collect();
    sweeps.figure(
        (name, title),
        "angle from the axis [rad]",
        curves,
        Vec::new(),
    )
}

/// Natural frequencies, with the drive speed itself: where they meet, a mode is in resonance.
pub fn frequencies(sweeps: &Sweeps<'_>, name: &str, title: &str) -> Figure {
    let count = sweeps.curve.modes;
    let mut curves: Vec<Curve> = (0..count)
        .map(|mode| Curve {
            label: mode_label(mode, count),
            colour: mode,
            dashed: false,
            pieces: sweeps.pieces(|row| row.frequencies[mode]),
        })
        .collect();
    curves.push(Curve {
        label: "drive speed".to_owned(),
        colour: GREY,
        dashed: true,
        pieces: sweeps.pieces(|row| Some(row.speed)),
    });
    sweeps.figure(
        (name, title),
        "natural frequency [rad/s]",
        curves,
        Vec::new(),
    )
}

/// Mean frequencies of all modes: first order, which is the nominal frequency whatever the tolerance, and Monte Carlo.
pub fn means(sweeps: &Sweeps<'_>, name: &str, title: &str) -> Figure {
    let count = sweeps.curve.modes;
    let curves = (0..count)
        .map(|mode| Curve {
            label: format!("first order, {}", mode_label(mode, count)),
            colour: if mode == 0 { BLACK } else { GREY },
            dashed: mode > 0,
            pieces: sweeps.pieces(|row| row.spreads.first()?.first_order[mode].mean),
        })
        .collect();
    let levels = sweeps.sampled.question.levels.iter().enumerate();
    let markers = levels
        .map(|(k, &level)| Markers {
            label: format!("Monte Carlo {} %", percent(level)),
            colour: k,
            shape: Shape::of(k),
            points: (0..count)
                .flat_map(|mode| sweeps.points(move |row| row.spreads[k].sampled[mode].mean))
                .collect(),
        })
        .collect();
    let mut figure = sweeps.figure(
        (name, title),
        "mean natural frequency [rad/s]",
        curves,
        markers,
    );
    figure.note =
        "At first order the mean is the nominal frequency, whatever the tolerance.".to_owned();
    figure
}

/// Standard deviation of one mode under the first `levels` tolerances; for one tolerance alone the paper's central
/// differences are shown too.
pub fn deviations(
    sweeps: &Sweeps<'_>,
    name: &str,
    title: &str,
    mode: usize,
    levels: usize,
) -> Figure {
    let (mut curves, mut markers) = (Vec::new(), Vec::new());
    for (k, &level) in sweeps
        .sampled
        .question
        .levels
        .iter()
        .take(levels)
        .enumerate()
    {
        let level = percent(level);
        curves.push(Curve {
            label: format!("first order {level} %"),
            colour: k,
            dashed: false,
            pieces: sweeps.pieces(|row| row.spreads[k].first_order[mode].sigma),
        });
        markers.push(Markers {
            label: format!("Monte Carlo {level} %"),
            colour: if levels == 1 { 1 } else { k },
            shape: Shape::of(k),
            points: sweeps.points(|row| row.spreads[k].sampled[mode].sigma),
        });
    }
    if levels == 1 {
        curves.push(Curve {
            label: "central differences".to_owned(),
            colour: BLACK,
            dashed: true,
            pieces: sweeps.pieces(|row| row.spreads[0].differences[mode].sigma),
        });
    }
    sweeps.spread_figure((name, title), curves, markers)
}

/// What each variable alone contributes to the standard deviation of one mode, under the first tolerance.
pub fn contributions(sweeps: &Sweeps<'_>, name: &str, title: &str, mode: usize) -> Figure {
    let mut curves = vec![Curve {
        label: "first order, all together".to_owned(),
        colour: BLACK,
        dashed: false,
        pieces: sweeps.pieces(|row| row.spreads[0].first_order[mode].sigma),
    }];
    for (k, name) in sweeps.curve.variables.iter().enumerate() {
        curves.push(Curve {
            label: format!("{name} alone"),
            colour: k,
            dashed: k % 2 == 1,
            pieces: sweeps.pieces(|row| row.spreads[0].contribution(mode, k)),
        });
    }
    let markers = vec![Markers {
        label: "Monte Carlo, all together".to_owned(),
        colour: BLACK,
        shape: Shape::Ring,
        points: sweeps.points(|row| row.spreads[0].sampled[mode].sigma),
    }];
    sweeps.spread_figure((name, title), curves, markers)
}

impl Spread {
    /// Standard deviation of `mode` when only variable number `variable` varies, at first order.
    pub fn contribution(&self, mode: usize, variable: usize) -> Option<f64> {
        let share = self.shares[mode].get(variable)?;
        Some(share.max(0.0).sqrt() * self.first_order[mode].sigma?)
    }
}

impl Sweeps<'_> {
    /// A curve over the dense sweep, interrupted where there is no value and where the branch changes.
    fn pieces(&self, value: impl Fn(&Row) -> Option<f64>) -> Vec<Vec<Point>> {
        let mut pieces = vec![Vec::new()];
        let mut last: Option<f64> = None;
        for row in &self.curve.rows {
            let Some(value) = value(row) else {
                last = None;
                continue;
            };
            let same_branch =
                last.is_some_and(|last| (last < self.critical) == (row.speed < self.critical));
            if !same_branch {
                pieces.push(Vec::new());
            }
            if let Some(piece) = pieces.last_mut() {
                piece.push((row.speed, value));
            }
            last = Some(row.speed);
        }
        pieces.retain(|piece| piece.len() > 1);
        pieces
    }

    fn points(&self, value: impl Fn(&Row) -> Option<f64>) -> Vec<Point> {
        let rows = self.sampled.rows.iter();
        rows.filter_map(|row| Some((row.speed, value(row)?)))
            .collect()
    }

    /// A figure with room for everything in it.
    fn figure(
        &self,
        (name, title): (&str, &str),
        values: &str,
        curves: Vec<Curve>,
        markers: Vec<Markers>,
    ) -> Figure {
        let lines = curves
            .iter()
            .flat_map(|curve| curve.pieces.iter().flatten());
        let top = highest(lines.chain(markers.iter().flat_map(|markers| &markers.points)));
        Figure {
            name: name.to_owned(),
            title: title.to_owned(),
            speed: "drive speed [rad/s]".to_owned(),
            values: values.to_owned(),
            speeds: self.curve.question.range,
            range: (0.0, 1.05 * top),
            mark: (
                self.critical,
                format!("critical {:.3} rad/s", self.critical),
            ),
            curves,
            markers,
            ..Figure::default()
        }
    }

    /// A figure of standard deviations: high enough for what was sampled, not for the spike of first order.
    fn spread_figure(
        &self,
        heading: (&str, &str),
        curves: Vec<Curve>,
        markers: Vec<Markers>,
    ) -> Figure {
        let mut figure = self.figure(
            heading,
            "standard deviation of the frequency [rad/s]",
            curves,
            markers,
        );
        let sampled = highest(figure.markers.iter().flat_map(|markers| &markers.points));
        if 1.25 * sampled < figure.range.1 && sampled > 0.0 {
            figure.range.1 = 1.25 * sampled;
            figure.note =
                "First order grows without bound at the critical speed and is cut off here; \
                           Monte Carlo stays finite."
                    .to_owned();
        }
        figure
    }
}

fn highest<'a>(points: impl Iterator<Item = &'a Point>) -> f64 {
    let highest = points.fold(0.0, |most: f64, point| most.max(point.1));
    if highest > 0.0 { highest } else { 1.0 }
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
