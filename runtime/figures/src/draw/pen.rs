//! Drawing elements in the styles of the data model, on any plotters backend.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::area::{Area, Outcome, words};
use super::dash::dashes;
use super::layout::{SCALE, px};

use crate::figure::{Colour, Shape, Stroke};

pub(super) const FONT: &str = "sans-serif";
/// Width of a curve, as shown.
const LINE: i32 = 2;

/// The anchor of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Left,
    Middle,
    Right,
    /// In the middle, reading upwards.
    Upwards,
    /// At its end, reading upwards: the text hangs below the anchor.
    Below,
}

/// Width of a letter as a fraction of the font size given to plotters, a fifth of which is line spacing; most letters
/// are narrower.
pub(super) const LETTER: f64 = 0.52;
/// Smallest letters readable in print.
const SMALLEST: i32 = 10;

/// Length of a text in drawing pixels, for a letter size as shown.
pub(super) fn length(text: &str, size: i32) -> i32 {
    (LETTER * f64::from(px(size)) * text.chars().count() as f64).ceil() as i32
}

/// Font size and text that fit into the given room.
fn fit(text: &str, size: i32, room: i32) -> (i32, String) {
    let fits = |size: &i32| length(text, *size) <= room;
    if let Some(size) = (SMALLEST..=size).rev().find(fits) {
        return (size, text.to_owned());
    }
    let letters = (f64::from(room) / (LETTER * f64::from(px(SMALLEST)))) as usize;
    (SMALLEST, text.chars().take(letters.saturating_sub(3)).chain("...".chars()).collect())
}

/// A path in parts that end where it turns back: the pixel backend cuts such a spike short.
fn without_spikes(points: &[Pixel]) -> Vec<&[Pixel]> {
    let turns = |k: usize| {
        let step = |from: Pixel, to: Pixel| [i64::from(to.0 - from.0), i64::from(to.1 - from.1)];
        let [a, b] = [step(points[k - 1], points[k]), step(points[k], points[k + 1])];
        a[0] * b[0] + a[1] * b[1] < 0
    };
    let mut parts = Vec::new();
    let mut first = 0;
    for k in 1..points.len().saturating_sub(1) {
        if turns(k) {
            parts.push(&points[first..=k]);
            first = k;
        }
    }
    parts.push(&points[first..]);
    parts
}

/// Draws onto an area.
pub(super) struct Pen<'a, B: DrawingBackend> {
    area: &'a Area<B>,
}

type Pixel = (i32, i32);

fn colour(tint: Colour) -> RGBColor {
    let [red, green, blue] = tint.rgb();
    RGBColor(red, green, blue)
}

impl<'a, B: DrawingBackend> Pen<'a, B> {
    pub(super) fn new(area: &'a Area<B>) -> Self {
        Self { area }
    }

    /// Draws a text with letters of this size, as shown.
    pub(super) fn text(&self, text: &str, at: Pixel, size: i32, anchor: Anchor) -> Outcome {
        self.coloured(text, at, size, anchor, Colour::Black)
    }

    /// Draws a text into a room of this length, in drawing pixels, with smaller letters or, if these would be
    /// unreadable, truncated.
    pub(super) fn fitted(&self, text: &str, at: Pixel, size: i32, anchor: Anchor, room: i32) -> Outcome {
        let (size, text) = fit(text, size, room);
        self.text(&text, at, size, anchor)
    }

    pub(super) fn coloured(&self, text: &str, at: Pixel, size: i32, anchor: Anchor, tint: Colour) -> Outcome {
        let (horizontal, turn) = match anchor {
            Anchor::Left => (HPos::Left, FontTransform::None),
            Anchor::Middle => (HPos::Center, FontTransform::None),
            Anchor::Right => (HPos::Right, FontTransform::None),
            Anchor::Upwards => (HPos::Center, FontTransform::Rotate270),
            Anchor::Below => (HPos::Right, FontTransform::Rotate270),
        };
        let style = (FONT, size * SCALE)
            .into_font()
            .transform(turn)
            .color(&colour(tint))
            .pos(Pos::new(horizontal, VPos::Center));
        self.area.draw(&Text::new(text, at, style)).map_err(words)
    }

    /// A curve.
    pub(super) fn curve(&self, points: Vec<Pixel>, colour: Colour, stroke: Stroke) -> Outcome {
        let pattern: &[i32] = match stroke {
            Stroke::Solid => return self.line(points, colour, LINE),
            Stroke::Dashed => &[8, 5],
            Stroke::Dotted => &[2, 4],
            Stroke::DashDotted => &[10, 4, 2, 4],
        };
        let pattern: Vec<f64> = pattern.iter().map(|x| f64::from(px(*x))).collect();
        for dash in dashes(&points, &pattern) {
            self.line(dash, colour, LINE)?;
        }
        Ok(())
    }

    /// A solid line of this width, as shown.
    pub(super) fn line(&self, mut points: Vec<Pixel>, tint: Colour, width: i32) -> Outcome {
        points.dedup();
        let style = colour(tint).stroke_width(px(width) as u32);
        for part in without_spikes(&points) {
            self.area.draw(&PathElement::new(part.to_vec(), style)).map_err(words)?;
        }
        Ok(())
    }

    /// A thin faint line.
    pub(super) fn hair(&self, ends: [Pixel; 2], strength: f64) -> Outcome {
        let style = BLACK.mix(strength).stroke_width(SCALE as u32);
        self.area.draw(&PathElement::new(ends, style)).map_err(words)
    }

    /// A faint area.
    pub(super) fn shade(&self, outline: Vec<Pixel>, tint: Colour) -> Outcome {
        let style = colour(tint).mix(0.22).filled();
        self.area.draw(&Polygon::new(outline, style)).map_err(words)
    }

    /// A bar with an outline.
    pub(super) fn bar(&self, corners: [Pixel; 2], tint: Colour) -> Outcome {
        let strength = if tint == Colour::Grey { 0.35 } else { 0.75 };
        let fill = Rectangle::new(corners, colour(tint).mix(strength).filled());
        self.area.draw(&fill).map_err(words)?;
        self.outline(corners, BLACK.mix(0.7).stroke_width(SCALE as u32))
    }

    /// Draws the four sides of a rectangle as lines: plotters does not write a rectangle's stroke width to SVG.
    fn outline(&self, [(left, top), (right, bottom)]: [Pixel; 2], style: ShapeStyle) -> Outcome {
        let half = style.stroke_width as i32 / 2;
        for ends in [
            [(left - half, top), (right + half, top)],
            [(left - half, bottom), (right + half, bottom)],
            [(left, top), (left, bottom)],
            [(right, top), (right, bottom)],
        ] {
            let side = PathElement::new(ends, style);
            self.area.draw(&side).map_err(words)?;
        }
        Ok(())
    }

    /// A marker.
    pub(super) fn marker(&self, (x, y): Pixel, tint: Colour, shape: Shape) -> Outcome {
        let (thin, filled) = (colour(tint).stroke_width(px(4) as u32 / 3), colour(tint).filled());
        let size = px(4);
        let drawn = match shape {
            Shape::Ring => self.area.draw(&Circle::new((x, y), size, thin)),
            Shape::Disc => self.area.draw(&Circle::new((x, y), size, filled)),
            Shape::Triangle => self.area.draw(&TriangleMarker::new((x, y), px(5), filled)),
            Shape::Cross => self.area.draw(&Cross::new((x, y), size, thin)),
            Shape::Square => {
                let corners = [(x - size, y - size), (x + size, y + size)];
                return self.outline(corners, thin);
            }
            Shape::Diamond => {
                let size = px(5);
                let corners = vec![(x, y - size), (x + size, y), (x, y + size), (x - size, y)];
                self.area.draw(&Polygon::new(corners, filled))
            }
        };
        drawn.map_err(words)
    }

    /// An interval about a point: a line with a cap at either end.
    pub(super) fn interval(&self, [from, to]: [Pixel; 2], colour: Colour) -> Outcome {
        let level = from.1 == to.1;
        self.line(vec![from, to], colour, 1)?;
        let stop = px(4);
        for (x, y) in [from, to] {
            let ends = if level { vec![(x, y - stop), (x, y + stop)] } else { vec![(x - stop, y), (x + stop, y)] };
            self.line(ends, colour, 1)?;
        }
        Ok(())
    }
}
