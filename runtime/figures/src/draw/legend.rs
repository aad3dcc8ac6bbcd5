//! The legend: each label once, in rows above the panels.

use plotters::prelude::DrawingBackend;

use super::Outcome;
use super::layout::{LEGEND_HEIGHT, Layout, TITLE_HEIGHT, WIDTH, px};
use super::pen::{Anchor, Pen};
use crate::Figure;
use crate::figure::{Colour, Panel, Shape, Stroke};

/// Left end of the legend and width of a symbol, as shown.
const LEFT: i32 = 48;
const SYMBOL: i32 = 36;
/// The longest label, in letters, that fits into a third of the width.
const SHORT: usize = 29;

/// An entry of the legend.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    label: String,
    symbol: Symbol,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Symbol {
    Line(Colour, Stroke),
    Area(Colour),
    Bar(Colour),
    Interval(Colour, Shape),
    Point(Colour, Shape),
    Mark,
}

/// All labelled elements, each label once.
pub(super) fn entries(figure: &Figure) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    for (label, symbol) in figure.panels.iter().flat_map(symbols) {
        if !label.is_empty() && !entries.iter().any(|own| own.label == label) {
            let label = label.to_owned();
            entries.push(Entry { label, symbol });
        }
    }
    entries
}

fn symbols(panel: &Panel) -> Vec<(&str, Symbol)> {
    let curves = panel.curves.iter();
    let curves = curves.map(|own| (&*own.label, Symbol::Line(own.colour, own.stroke)));
    let bands = panel
        .bands
        .iter()
        .map(|own| (&*own.label, Symbol::Area(own.colour)));
    let bars = panel
        .bars
        .iter()
        .map(|own| (&*own.label, Symbol::Bar(own.colour)));
    let errors = panel.error_bars.iter();
    let errors = errors.map(|own| (&*own.label, Symbol::Interval(own.colour, own.shape)));
    let markers = panel.markers.iter();
    let markers = markers.map(|own| (&*own.label, Symbol::Point(own.colour, own.shape)));
    let marks = panel.marks.iter().map(|own| (&*own.label, Symbol::Mark));
    curves
        .chain(bands)
        .chain(bars)
        .chain(errors)
        .chain(markers)
        .chain(marks)
        .collect()
}

/// The largest number of columns in which the labels fit.
pub(super) fn columns(entries: &[Entry]) -> usize {
    let longest = entries.iter().map(|own| own.label.chars().count()).max();
    match longest.unwrap_or(0) {
        0..=16 => 4,
        17..=SHORT => 3,
        _ => 2,
    }
}

pub(super) fn draw<B: DrawingBackend>(pen: &Pen<'_, B>, layout: &Layout) -> Outcome {
    let width = (WIDTH - LEFT) / layout.columns as i32;
    for (k, entry) in layout.legend.iter().enumerate() {
        let (row, column) = (k / layout.columns, k % layout.columns);
        let x = px(LEFT + width * column as i32);
        let y = px(TITLE_HEIGHT + LEGEND_HEIGHT * row as i32 + LEGEND_HEIGHT / 2);
        let (end, middle) = (x + px(SYMBOL), x + px(SYMBOL) / 2);
        let half = px(LEGEND_HEIGHT) / 4;
        match entry.symbol {
            Symbol::Line(colour, stroke) => pen.curve(vec![(x, y), (end, y)], colour, stroke)?,
            Symbol::Area(colour) => {
                let corners = vec![
                    (x, y - half),
                    (end, y - half),
                    (end, y + half),
                    (x, y + half),
                ];
                pen.shade(corners, colour)?;
            }
            Symbol::Bar(colour) => pen.bar([(x, y - half), (end, y + half)], colour)?,
            Symbol::Interval(colour, shape) => {
                let reach = px(12);
                pen.interval([(middle - reach, y), (middle + reach, y)], colour)?;
                pen.marker((middle, y), colour, shape)?;
            }
            Symbol::Point(colour, shape) => pen.marker((middle, y), colour, shape)?,
            Symbol::Mark => pen.hair([(middle, y - half), (middle, y + half)], 0.6)?,
        }
        let room = px(width - SYMBOL - 16);
        pen.fitted(&entry.label, (end + px(8), y), 15, Anchor::Left, room)?;
    }
    Ok(())
}
