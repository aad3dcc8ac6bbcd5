//! The legend: each label once, in rows above the panels.

use plotters::prelude::DrawingBackend;

use super::area::Outcome;
use super::entries::Symbol;
use super::layout::{LEGEND_HEIGHT, Layout, TITLE_HEIGHT, WIDTH, px};
use super::pen::{Anchor, Pen};

/// Left end of the legend and width of a symbol, as shown.
const LEFT: i32 = 48;
const SYMBOL: i32 = 36;

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
                let corners = vec![(x, y - half), (end, y - half), (end, y + half), (x, y + half)];
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
