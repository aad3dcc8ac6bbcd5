//! Aligned columns of text.

use core::fmt;

/// A table of texts with a header and rows. The first column and columns of words are left-aligned, the others
/// right-aligned. Columns that exceed the page width follow below, next to the first column again; words that exceed it
/// alone continue on lines of their own.
///
/// The width of the format is the page: `format!("{grid:80}")`, 150 characters without one.
#[derive(Clone, Debug, Default)]
pub struct Grid {
    rows: Vec<Vec<String>>,
}

/// Page width in characters.
const WIDTH: usize = 150;
/// Least width of a column of words that is broken into lines.
const BROKEN: usize = 24;

impl Grid {
    /// A table with this header.
    pub fn new(head: Vec<String>) -> Self {
        Self { rows: vec![head] }
    }

    /// Appends a row.
    pub fn row(&mut self, cells: Vec<String>) {
        self.rows.push(cells);
    }

    /// Whether there are no rows below the header, or no columns.
    pub fn is_empty(&self) -> bool {
        self.rows.len() < 2 || self.rows[0].is_empty()
    }

    fn width(&self, column: usize) -> usize {
        self.rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max().unwrap_or(0)
    }

    fn is_words(&self, column: usize) -> bool {
        let cells = self.rows.iter().skip(1).filter_map(|row| row.get(column));
        let mut cells = cells.filter(|cell| !cell.is_empty() && *cell != "-");
        column == 0 || cells.all(|cell| cell.starts_with(char::is_alphabetic) && cell != "inf")
    }

    /// Groups of columns that fit next to the first one: as few blocks as possible, all of about the same width.
    fn blocks(widths: &[usize], page: usize) -> Vec<Vec<usize>> {
        let fewest = within(widths, page);
        let mut limits = (1..page).rev();
        let wider = limits.find(|&limit| within(widths, limit).len() > fewest.len());
        within(widths, wider.map_or(page, |limit| limit + 1))
    }
}

/// The words of a text on lines of this width at most; a longer word has a line of its own.
pub fn lines(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// As many columns per block as the limit allows, but at least one.
fn within(widths: &[usize], limit: usize) -> Vec<Vec<usize>> {
    let first = widths.first().map_or(0, |width| width + 2);
    let mut blocks = vec![vec![0]];
    let mut used = first;
    for (column, width) in widths.iter().enumerate().skip(1) {
        if used + width + 2 > limit && used > first {
            blocks.push(vec![0]);
            used = first;
        }
        used += width + 2;
        if let Some(block) = blocks.last_mut() {
            block.push(column);
        }
    }
    blocks
}

impl fmt::Display for Grid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let page = f.width().unwrap_or(WIDTH);
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let mut widths: Vec<usize> = (0..columns).map(|column| self.width(column)).collect();
        let words: Vec<bool> = (0..columns).map(|column| self.is_words(column)).collect();
        for column in 0..columns {
            let room = match column {
                0 => 2 * page / 3,
                _ => page.saturating_sub(widths[0] + 4),
            };
            if words[column] {
                widths[column] = widths[column].min(room.max(BROKEN));
            }
        }
        for (k, block) in Self::blocks(&widths, page).into_iter().enumerate() {
            if k > 0 {
                writeln!(f)?;
            }
            for row in &self.rows {
                let cells = block.iter().filter_map(|&column| Some((column, lines(row.get(column)?, widths[column]))));
                let cells: Vec<(usize, Vec<String>)> = cells.collect();
                let height = cells.iter().map(|(_, lines)| lines.len()).max().unwrap_or(0);
                for k in 0..height {
                    let mut line = String::new();
                    for (column, lines) in &cells {
                        let (text, width) = (lines.get(k).map_or("", String::as_str), widths[*column]);
                        line.push_str("  ");
                        line.push_str(&if words[*column] {
                            format!("{text:<width$}")
                        } else {
                            format!("{text:>width$}")
                        });
                    }
                    writeln!(f, "{}", line.trim_end())?;
                }
            }
        }
        Ok(())
    }
}

/// The texts as cells of a row.
pub fn cells<const N: usize>(texts: [&str; N]) -> Vec<String> {
    texts.map(str::to_owned).to_vec()
}
