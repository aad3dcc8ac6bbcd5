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
        if !label.is_empty() && !entries.iter().any(|entry| entry.label == label) {
            let label = label.to_owned();
            entries.push(Entry { label, symbol });
        }
    }
    entries
}

fn symbols(panel: &Panel) -> Vec<(&str, Symbol)> {
    let curves = panel.curves.iter();
    let curves = curves.map(|curve| (&*curve.label, Symbol::Line(curve.colour, curve.stroke)));
    let bands = panel.bands.iter().map(|band| (&*band.label, Symbol::Area(band.colour)));
    let bars = panel.bars.iter().map(|bar| (&*bar.label, Symbol::Bar(bar.colour)));
    let errors = panel.error_bars.iter();
    let errors = errors.map(|error| (&*error.label, Symbol::Interval(error.colour, error.shape)));
    let markers = panel.markers.iter();
    let markers = markers.map(|marker| (&*marker.label, Symbol::Point(marker.colour, marker.shape)));
    let marks = panel.marks.iter().map(|mark| (&*mark.label, Symbol::Mark));
    curves.chain(bands).chain(bars).chain(errors).chain(markers).chain(marks).collect()
}

/// The largest number of columns in which the labels fit.
pub(super) fn columns(entries: &[Entry]) -> usize {
    let longest = entries.iter().map(|entry| entry.label.chars().count()).max();
    match longest.unwrap_or(0) {
        0..=16 => 4,
        17..=SHORT => 3,
        _ => 2,
    }
}
