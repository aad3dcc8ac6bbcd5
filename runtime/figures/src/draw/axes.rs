//! Axes: frame, ticks at round numbers, headings.

use plotters::prelude::DrawingBackend;

use super::area::Outcome;
use super::layout::{Frame, HANGING, below, hanging, px};
use super::pen::{Anchor, Pen};
use crate::figure::{Axis, Panel, Point};

/// Size of tick labels, as shown.
const TICK: i32 = 15;

/// Converts positions in a panel to pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlotArea {
    x: [f64; 2],
    y: [f64; 2],
    frame: Frame,
}

impl PlotArea {
    pub(super) fn of(panel: &Panel, frame: &Frame) -> Self {
        let (x, y) = (panel.x.range, panel.y.range);
        Self { x, y, frame: *frame }
    }

    pub(super) fn pixel(&self, point: Point) -> (i32, i32) {
        let Frame { left, right, top, bottom } = self.frame;
        let share = |value: f64, [low, high]: [f64; 2]| ((value - low) / (high - low)).clamp(0.0, 1.0);
        let x = f64::from(left) + share(point[0], self.x) * f64::from(right - left);
        let y = f64::from(bottom) - share(point[1], self.y) * f64::from(bottom - top);
        (x.round() as i32, y.round() as i32)
    }

    pub(super) fn holds(&self, point: Point) -> bool {
        (self.x[0]..=self.x[1]).contains(&point[0]) && (self.y[0]..=self.y[1]).contains(&point[1])
    }
}

/// Draws grid lines, ticks with their numbers, and headings.
pub(super) fn draw<B: DrawingBackend>(pen: &Pen<'_, B>, panel: &Panel, frame: &Frame) -> Outcome {
    let area = PlotArea::of(panel, frame);
    let Frame { left, right, top, bottom } = *frame;
    let hanging = hanging(panel);
    for (value, text) in ticks(&panel.x, 9.0) {
        let (x, _) = area.pixel([value, panel.y.range[0]]);
        if panel.x.categories.is_empty() {
            pen.hair([(x, top), (x, bottom)], 0.12)?;
            pen.hair([(x, bottom), (x, bottom + px(5))], 1.0)?;
        }
        if hanging {
            pen.fitted(&text, (x, bottom + px(10)), TICK, Anchor::Below, px(HANGING))?
        } else {
            pen.text(&text, (x, bottom + px(16)), TICK, Anchor::Middle)?
        }
    }
    for (value, text) in ticks(&panel.y, f64::from(bottom - top) / f64::from(px(52))) {
        let (_, y) = area.pixel([panel.x.range[0], value]);
        if panel.y.categories.is_empty() {
            pen.hair([(left, y), (right, y)], 0.12)?;
            pen.hair([(left - px(5), y), (left, y)], 1.0)?;
        }
        let room = left - px(12);
        pen.fitted(&text, (left - px(9), y), TICK, Anchor::Right, room)?;
    }
    pen.hair([(left, bottom), (right, bottom)], 1.0)?;
    pen.hair([(left, top), (left, bottom)], 1.0)?;
    let middle = ((left + right) / 2, (top + bottom) / 2);
    let heading = (middle.0, bottom + px(below(panel) - 17));
    pen.fitted(&panel.x.heading(), heading, 17, Anchor::Middle, right - left)?;
    if panel.y.categories.is_empty() {
        let (heading, point) = (panel.y.heading(), (px(18), middle.1));
        pen.fitted(&heading, point, 17, Anchor::Upwards, bottom - top)?;
    }
    Ok(())
}

/// Positions and labels of the ticks, approximately as many as wanted.
fn ticks(axis: &Axis, wanted: f64) -> Vec<(f64, String)> {
    if !axis.categories.is_empty() {
        return axis.categories.iter().enumerate().map(|(k, name)| (k as f64, name.clone())).collect();
    }
    if axis.logarithmic {
        return ratios(axis, wanted);
    }
    let [low, high] = axis.range;
    let rough = (high - low) / wanted.max(2.0);
    if !rough.is_normal() || rough < 0.0 {
        return Vec::new();
    }
    let step = step(rough, &axis.unit);
    let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
    let count = (last - first).clamp(0.0, 100.0) as usize;
    (0..=count).map(|k| first + k as f64).map(|x| x * step).map(|value| (value, number(value, step))).collect()
}

/// Ticks of a logarithmic axis, whose range is in powers of ten: at tens, also at twice and five times these where there is
/// room; within one power of ten at equal steps.
fn ratios(axis: &Axis, wanted: f64) -> Vec<(f64, String)> {
    let [low, high] = axis.range;
    let decades = high - low;
    if decades < 1.0 {
        let within = Axis { range: axis.range.map(|power| 10f64.powf(power)), logarithmic: false, ..axis.clone() };
        return ticks(&within, wanted).into_iter().map(|(value, text)| (value.log10(), text)).collect();
    }
    let factors: &[f64] = match wanted / decades {
        room if room >= 3.0 => &[1.0, 2.0, 5.0],
        _ => &[1.0],
    };
    let powers = (low.floor() as i32..=high.ceil() as i32).map(|power| 10f64.powi(power));
    let inside = powers
        .flat_map(|power| factors.iter().map(move |factor| factor * power))
        .filter(|value| (low..=high).contains(&value.log10()));
    let text = |value: f64| if (1e-3..1e5).contains(&value) { number(value, value) } else { format!("{value:e}") };
    inside.map(|value| (value.log10(), text(value))).collect()
}

/// The next larger round number; for angles, one that divides a turn.
fn step(rough: f64, unit: &str) -> f64 {
    let power = 10f64.powf(rough.log10().floor());
    let decimal = [1.0, 2.0, 2.5, 5.0, 10.0].map(|x| x * power);
    let turns: &[f64] = match unit {
        "deg" => &[15.0, 30.0, 45.0, 90.0, 180.0],
        _ => &[],
    };
    let all = if rough > 10.0 { turns.iter().chain(&decimal) } else { [].iter().chain(&decimal) };
    let mut wide = all.copied().filter(|x| *x >= 0.999 * rough);
    wide.next().unwrap_or(10.0 * power)
}

/// Formats a number with as many decimals as the step requires.
fn number(value: f64, step: f64) -> String {
    let size = value.abs().max(step);
    if !(1e-4..1e7).contains(&size) || step < 1e-6 {
        let digits = (size.log10().floor() - step.log10().floor()).clamp(0.0, 6.0) as usize + 1;
        return if value.abs() < 0.5 * step { "0".to_owned() } else { format!("{value:.digits$e}") };
    }
    let decimals = (1.0 - step.log10().floor()).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0" } else { text }.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(low: f64, high: f64) -> Vec<String> {
        let mut axis = Axis::new("", "");
        axis.range = [low, high];
        ticks(&axis, 5.0).into_iter().map(|tick| tick.1).collect()
    }

    #[test]
    fn ticks_stand_at_round_numbers() {
        assert_eq!(words(0.0, 6000.0), ["0", "2000", "4000", "6000"]);
        assert_eq!(words(-0.1, 0.11), ["-0.1", "-0.05", "0", "0.05", "0.1"]);
        assert_eq!(words(0.0, 10.0), ["0", "2", "4", "6", "8", "10"]);
        assert!(words(0.0, 3e-7).iter().all(|own| own == "0" || own.contains("e-")));
        assert!(words(1.0, 1.0).is_empty());
        let mut turn = Axis::new("phase", "deg");
        turn.range = [-195.0, 195.0];
        let words: Vec<String> = ticks(&turn, 5.0).into_iter().map(|tick| tick.1).collect();
        assert_eq!(words, ["-180", "-90", "0", "90", "180"]);
    }
}
