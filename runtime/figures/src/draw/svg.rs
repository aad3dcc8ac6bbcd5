//! Figures as SVG text.

use plotters::prelude::{IntoDrawingArea, SVGBackend};

use super::draw;
use super::layout::{Layout, SCALE, WIDTH, px};
use crate::{Error, Figure};

impl Figure {
    /// The figure as an SVG document, 960 pixels wide; text uses the fonts of the reader's system.
    ///
    /// # Errors
    /// [`Error::Drawing`].
    pub fn svg(&self) -> Result<String, Error> {
        #[cfg(feature = "png")]
        super::png::register_font()?;
        let layout = Layout::of(self);
        let mut text = String::new();
        let size = (px(WIDTH), layout.height);
        let area = SVGBackend::with_string(&mut text, (size.0 as u32, size.1 as u32));
        let area = area.into_drawing_area();
        let drawn = draw(self, &layout, &area);
        drop(area);
        drawn.map_err(Error::Drawing)?;
        let large = format!("width=\"{}\" height=\"{}\"", size.0, size.1);
        let shown = format!("width=\"{}\" height=\"{}\"", size.0 / SCALE, size.1 / SCALE);
        Ok(text.replacen(&large, &shown, 1))
    }
}
