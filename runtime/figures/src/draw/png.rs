//! Figures as PNG files.

use std::sync::OnceLock;

use plotters::prelude::{BitMapBackend, IntoDrawingArea};
use plotters::style::FontStyle;

use super::draw;
use super::layout::{Layout, WIDTH, px};
use super::pen::FONT;
use crate::{Error, Figure};

/// Latin, Greek, Cyrillic and mathematical glyphs of DejaVu Sans 2.37.
static LETTERS: &[u8] = include_bytes!("../../fonts/DejaVuSans-subset.ttf");

/// Pixels per metre on paper: 300 per inch.
const DENSITY: u32 = 11_811;

/// Registers the font, since plotters ships none.
pub(super) fn register_font() -> Result<(), Error> {
    static DONE: OnceLock<bool> = OnceLock::new();
    let register = || plotters::style::register_font(FONT, FontStyle::Normal, LETTERS).is_ok();
    if *DONE.get_or_init(register) { Ok(()) } else { Err(Error::Drawing("the letters cannot be read".to_owned())) }
}

impl Figure {
    /// The figure as a PNG file, 2880 pixels wide, at 300 pixels per inch.
    ///
    /// Letters other than Latin, Greek and Cyrillic appear as boxes; SVG shows them.
    ///
    /// # Errors
    /// [`Error::Drawing`].
    pub fn png(&self) -> Result<Vec<u8>, Error> {
        register_font()?;
        let layout = Layout::of(self);
        let (width, height) = (px(WIDTH) as u32, layout.height as u32);
        let mut pixels = vec![0; 3 * width as usize * height as usize];
        let area = BitMapBackend::with_buffer(&mut pixels, (width, height)).into_drawing_area();
        let drawn = draw(self, &layout, &area);
        drop(area);
        drawn.map_err(Error::Drawing)?;
        encode(&pixels, width, height).map_err(|error| Error::Drawing(error.to_string()))
    }
}

fn encode(pixels: &[u8], width: u32, height: u32) -> Result<Vec<u8>, png::EncodingError> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_pixel_dims(Some(png::PixelDimensions { xppu: DENSITY, yppu: DENSITY, unit: png::Unit::Meter }));
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(file)
}
