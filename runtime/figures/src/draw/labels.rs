//! Labels beside points, placed so that they do not overlap.

use plotters::prelude::DrawingBackend;

use super::area::Outcome;
use super::layout::{Frame, px};
use super::pen::{Anchor, Pen, length};

/// Size of the letters, as shown.
const SIZE: i32 = 14;

/// How far labels may reach beyond the right end of the panel.
const BEYOND: i32 = px(20);

/// A box: left, right, top, bottom.
type Box = [i32; 4];

/// The occupied areas.
pub(super) struct Labels {
    frame: Frame,
    taken: Vec<Box>,
}

impl Labels {
    pub(super) fn within(frame: &Frame) -> Self {
        Self { frame: *frame, taken: Vec::new() }
    }

    /// Keeps labels out of this area.
    pub(super) fn keep_free(&mut self, (x, y): (i32, i32), half: i32) {
        self.taken.push([x - half, x + half, y - half, y + half]);
    }

    /// Keeps labels off this line if they find another place.
    pub(super) fn keep_line_free(&mut self, line: &[(i32, i32)]) {
        for pair in line.windows(2) {
            let [(x, y), (to_x, to_y)] = [pair[0], pair[1]];
            let steps = ((to_x - x).abs().max((to_y - y).abs()) / px(5)).max(1);
            for k in 0..steps {
                let at = (x + (to_x - x) * k / steps, y + (to_y - y) * k / steps);
                self.keep_free(at, px(2));
            }
        }
    }

    /// Writes a label above and to the right of a point, or elsewhere near it if that place is taken.
    pub(super) fn write<B: DrawingBackend>(&mut self, pen: &Pen<'_, B>, at: (i32, i32), text: &str) -> Outcome {
        let width = length(text, SIZE);
        let (side, half) = (px(7), px(SIZE) / 2);
        let rises = [-px(10), px(10), 0, -px(22), px(22), -px(34), px(34)];
        let places = rises.into_iter().flat_map(|rise| {
            [at.0 + side, at.0 - side - width].map(|left| {
                let y = at.1 + rise;
                [left, left + width, y - half, y + half]
            })
        });
        let places: Vec<Box> = places.collect();
        let free = |item: &&Box| self.inside(item) && !self.taken.iter().any(|other| meet(item, other));
        let inside = |x: &&Box| self.inside(x);
        let place = places.iter().find(free);
        let chosen = place.or_else(|| places.iter().find(inside)).or(places.first());
        if let Some(&[left, right, top, bottom]) = chosen {
            // If no place is inside the panel, the label is nearly as long as the panel is wide, or longer.
            let room = self.frame.right + BEYOND - self.frame.left;
            let left = left.min(self.frame.right + BEYOND - width).max(self.frame.left);
            self.taken.push([left, right, top, bottom]);
            pen.fitted(text, (left, (top + bottom) / 2), SIZE, Anchor::Left, room)?;
        }
        Ok(())
    }

    fn inside(&self, &[left, right, top, bottom]: &Box) -> bool {
        let frame = &self.frame;
        left >= frame.left && right <= frame.right + BEYOND && top >= frame.top - px(8) && bottom <= frame.bottom
    }
}

fn meet(a: &Box, b: &Box) -> bool {
    a[0] < b[1] && b[0] < a[1] && a[2] < b[3] && b[2] < a[3]
}
