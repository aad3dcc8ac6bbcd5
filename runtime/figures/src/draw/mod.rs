//! Drawing of a figure: title, legend in rows of its own so that it hides no data, panels, caption.
//!
//! # Figures are data first
//!
//! `runtime/figures` turns results into curves, bands, markers and captions in the units of the axes (`figure/`), and
//! draws them separately (`draw/`); a report in a browser takes the same data. plotters draws both formats. SVG keeps
//! words as text, in the reader's fonts. PNG needs its own font: plotters' `ab_glyph` reads it from a part of DejaVu
//! Sans in the crate, without a system library; with the pixel backend and the crate `png` that is 17 more crates
//! (`cargo tree`). PNG is a feature of the crate, which the command enables.

mod area;
mod axes;
mod clip;
mod dash;
mod entries;
mod labels;
mod layout;
mod legend;
mod panel;
mod pen;
#[cfg(feature = "png")]
mod png;
mod save;
mod svg;

pub use self::save::Form;

use plotters::prelude::DrawingBackend;

use self::area::{Area, Outcome, words};
use self::layout::{CAPTION_HEIGHT, Frame, Layout, TITLE_HEIGHT, WIDTH, px};
use self::pen::{Anchor, Pen};
use crate::Figure;
use crate::figure::{Colour, Panel};

/// A panel with the same scale along both axes of a frame.
fn equalised(panel: &Panel, frame: &Frame) -> Panel {
    let mut panel = panel.clone();
    let (wide, high) = (frame.right - frame.left, frame.bottom - frame.top);
    panel.equalise(f64::from(wide) / f64::from(high));
    panel
}

/// Draws a figure onto an area of the size its layout requires.
fn draw<B: DrawingBackend>(figure: &Figure, layout: &Layout, area: &Area<B>) -> Outcome {
    area.fill(&plotters::style::WHITE).map_err(words)?;
    let pen = Pen::new(area);
    let middle = px(WIDTH) / 2;
    let title = (middle, px(TITLE_HEIGHT) / 2);
    pen.fitted(&figure.title, title, 22, Anchor::Middle, px(WIDTH - 48))?;
    legend::draw(&pen, layout)?;
    for (panel, frame) in figure.panels.iter().zip(&layout.panels) {
        let panel = panel.straightened();
        if panel.equal_scales {
            panel::draw(&pen, &equalised(&panel, frame), frame)?
        } else {
            panel::draw(&pen, &panel, frame)?
        }
    }
    for (k, line) in layout.caption.iter().enumerate() {
        let y = layout.caption_top + px(CAPTION_HEIGHT) * k as i32 + px(CAPTION_HEIGHT) / 2;
        pen.coloured(line, (px(24), y), 14, Anchor::Left, Colour::Grey)?;
    }
    area.present().map_err(words)
}
