//! The layout of a figure, in drawing pixels.

use super::entries::{self, Entry};
use crate::Figure;
use crate::figure::Panel;

/// plotters places everything on whole pixels; drawing at three times the shown size keeps curves smooth.
pub(super) const SCALE: i32 = 3;
/// Widths and heights, in shown pixels.
pub(super) const WIDTH: i32 = 960;
pub(super) const TITLE_HEIGHT: i32 = 48;
pub(super) const LEGEND_HEIGHT: i32 = 24;
pub(super) const CAPTION_HEIGHT: i32 = 20;
const LEFT: i32 = 92;
const RIGHT: i32 = 28;
const BELOW: i32 = 58;
const ABOVE: i32 = 10;
/// Maximum room for a label that hangs below the horizontal axis.
pub(super) const HANGING: i32 = 150;
/// Characters per caption line.
const LINE: usize = 116;

/// Converts shown pixels to drawing pixels.
pub(super) const fn px(shown: i32) -> i32 {
    SCALE * shown
}

/// A rectangle between the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    pub(super) left: i32,
    pub(super) right: i32,
    pub(super) top: i32,
    pub(super) bottom: i32,
}

/// The layout of a figure.
#[derive(Debug)]
pub(super) struct Layout {
    pub(super) height: i32,
    pub(super) legend: Vec<Entry>,
    pub(super) columns: usize,
    pub(super) panels: Vec<Frame>,
    pub(super) caption: Vec<String>,
    pub(super) caption_top: i32,
}

impl Layout {
    pub(super) fn of(figure: &Figure) -> Self {
        let legend = entries::entries(figure);
        let columns = entries::columns(&legend);
        let rows = legend.len().div_ceil(columns) as i32;
        let mut y = px(TITLE_HEIGHT + LEGEND_HEIGHT * rows);
        let mut panels = Vec::new();
        for panel in &figure.panels {
            let frame = Frame {
                left: px(left(panel)),
                right: px(WIDTH - RIGHT),
                top: y + px(ABOVE),
                bottom: y + px(ABOVE + height(panel, figure.panels.len())),
            };
            y = frame.bottom + px(below(panel));
            panels.push(frame);
        }
        let caption: Vec<String> = figure.caption.iter().flat_map(|x| wrapped(x)).collect();
        let caption_top = y + px(8);
        Self {
            height: caption_top + px(CAPTION_HEIGHT * caption.len() as i32 + 12),
            legend,
            columns,
            panels,
            caption,
            caption_top,
        }
    }
}

/// Room for the labels below the horizontal axis; categories that do not fit side by side hang vertically.
pub(super) fn below(panel: &Panel) -> i32 {
    let names = panel.x.categories.iter().map(|category| category.chars().count());
    match names.max() {
        Some(longest) if hanging(panel) => BELOW + (9 * longest as i32).min(HANGING),
        _ => BELOW,
    }
}

/// Whether the categories of the horizontal axis do not fit side by side.
pub(super) fn hanging(panel: &Panel) -> bool {
    let names = panel.x.categories.iter().map(|category| category.chars().count());
    let slot = (WIDTH - left(panel) - RIGHT) / panel.x.categories.len().max(1) as i32;
    names.max().is_some_and(|longest| 9 * longest as i32 > slot)
}

/// Room for the labels beside the vertical axis.
fn left(panel: &Panel) -> i32 {
    let names = panel.y.categories.iter().map(|category| category.chars().count());
    match names.max() {
        Some(longest) => (24 + 10 * longest as i32).clamp(LEFT, WIDTH / 3),
        None => LEFT,
    }
}

fn height(panel: &Panel, panels: usize) -> i32 {
    match (panel.y.categories.len(), panels) {
        (0, 1) => 440,
        (0, 2) => 280,
        (0, _) => 200,
        (rows, _) => 40 + 34 * rows as i32,
    }
}

/// Breaks a text into lines.
fn wrapped(text: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    let words = text.split(' ').flat_map(|word| {
        let letters: Vec<char> = word.chars().collect();
        letters.chunks(LINE).map(|piece| piece.iter().collect()).collect::<Vec<String>>()
    });
    for word in words {
        let full = |line: &String| line.chars().count() + word.chars().count() >= LINE;
        match lines.last_mut() {
            Some(line) if line.is_empty() => line.push_str(&word),
            Some(line) if !full(line) => {
                line.push(' ');
                line.push_str(&word);
            }
            _ => lines.push(word),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lines_are_wrapped_at_spaces() {
        let text = "word ".repeat(60);
        let lines = wrapped(text.trim());
        assert!(lines.len() == 3 && lines.iter().all(|line| line.len() <= LINE), "{lines:?}");
        assert_eq!(lines.join(" "), text.trim());
    }
}
