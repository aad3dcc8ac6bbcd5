//! The entries of a legend.

use crate::Figure;
use crate::figure::{Colour, Panel, Shape, Stroke};

/// The longest label, in letters, that fits into a third of the width.
const SHORT: usize = 29;

/// An entry of the legend.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    pub(super) label: String,
    pub(super) symbol: Symbol,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Symbol {
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
