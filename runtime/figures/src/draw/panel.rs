//! The content between the axes.

use plotters::prelude::DrawingBackend;

use super::area::Outcome;
use super::axes::{self, PlotArea};
use super::clip::{clip, clip_band};
use super::labels::Labels;
use super::layout::{Frame, px};
use super::pen::Pen;
use crate::figure::{Panel, Point};

/// Draws a panel, clipped to the ranges of its axes.
pub(super) fn draw<B: DrawingBackend>(pen: &Pen<'_, B>, panel: &Panel, frame: &Frame) -> Outcome {
    let area = PlotArea::of(panel, frame);
    axes::draw(pen, panel, frame)?;
    let ([left, right], [low, high]) = (panel.x.range, panel.y.range);
    for band in &panel.bands {
        let edges = clip_band(&band.edges, panel.x.range);
        let lower = edges.iter().map(|&[x, low, _]| area.pixel([x, low]));
        let upper = edges.iter().rev().map(|&[x, _, high]| area.pixel([x, high]));
        let outline: Vec<_> = lower.chain(upper).collect();
        if outline.len() > 3 {
            pen.shade(outline, band.colour)?;
        }
    }
    for bars in &panel.bars {
        for &[from, to, bottom, top] in &bars.bars {
            if to >= left && from <= right && top >= low && bottom <= high {
                let corners = [area.pixel([from, top]), area.pixel([to, bottom])];
                pen.bar(corners, bars.colour)?;
            }
        }
    }
    for mark in panel.marks.iter().filter(|mark| (left..=right).contains(&mark.at)) {
        let ends = [low, high].map(|y| area.pixel([mark.at, y]));
        pen.hair(ends, 0.6)?;
    }
    let mut labels = Labels::within(frame);
    for curve in &panel.curves {
        for piece in &curve.pieces {
            for part in clip(piece, panel.x.range, panel.y.range) {
                let line: Vec<_> = part.into_iter().map(|x| area.pixel(x)).collect();
                labels.keep_line_free(&line);
                pen.curve(line, curve.colour, curve.stroke)?;
            }
        }
    }
    for errors in &panel.error_bars {
        for bar in errors.bars.iter().filter(|bar| area.holds(bar.at)) {
            let ends = [area.pixel(bar.low), area.pixel(bar.high)];
            if bar.low != bar.high {
                pen.interval(ends, errors.colour)?;
            }
            pen.marker(area.pixel(bar.at), errors.colour, errors.shape)?;
            labels.keep_free(area.pixel(bar.at), px(5));
        }
    }
    for markers in &panel.markers {
        let shown = |point: &&Point| area.holds(**point);
        for point in markers.points.iter().filter(shown) {
            pen.marker(area.pixel(*point), markers.colour, markers.shape)?;
            labels.keep_free(area.pixel(*point), px(5));
        }
    }
    for label in panel.labels.iter().filter(|label| area.holds(label.at)) {
        labels.write(pen, area.pixel(label.at), &label.text)?;
    }
    Ok(())
}
