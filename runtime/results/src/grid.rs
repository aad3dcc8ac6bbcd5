//! Aligned columns of text.

use core::fmt;

/// A table of texts with a header and rows. The first column and columns of words are left-aligned, the others
/// right-aligned. Columns that exceed the page width follow below, next to the first column again.
#[derive(Clone, Debug, Default)]
pub struct Grid {
    rows: Vec<Vec<String>>,
}

/// Page width in characters.
const WIDTH: usize = 150;

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
        let cells = self.rows.iter().filter_map(|row| row.get(column));
        let widths = cells.map(|cell| cell.chars().count());
        widths.max().unwrap_or(0)
    }

    fn is_words(&self, column: usize) -> bool {
        let cells = self.rows.iter().skip(1).filter_map(|row| row.get(column));
        let mut cells = cells.filter(|cell| !cell.is_empty() && *cell != "-");
        column == 0 || cells.all(|cell| cell.starts_with(char::is_alphabetic) && cell != "inf")
    }

    /// Groups of columns that fit next to the first one: as few blocks as possible, all of about the same width.
    fn blocks(widths: &[usize]) -> Vec<Vec<usize>> {
        let fewest = within(widths, WIDTH);
        let mut limits = (1..WIDTH).rev();
        let wider = limits.find(|&limit| within(widths, limit).len() > fewest.len());
        within(widths, wider.map_or(WIDTH, |limit| limit + 1))
    }
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
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let widths: Vec<usize> = (0..columns).map(|column| self.width(column)).collect();
        let words: Vec<bool> = (0..columns).map(|column| self.is_words(column)).collect();
        for block in Self::blocks(&widths) {
            for row in &self.rows {
                let mut line = String::new();
                for &column in &block {
                    let (Some(cell), width) = (row.get(column), widths[column]) else {
                        continue;
                    };
                    line.push_str("  ");
                    line.push_str(&match words[column] {
                        true => format!("{cell:<width$}"),
                        false => format!("{cell:>width$}"),
                    });
                }
                writeln!(f, "{}", line.trim_end())?;
            }
        }
        Ok(())
    }
}

/// The texts as cells of a row.
pub fn cells<const N: usize>(texts: [&str; N]) -> Vec<String> {
    texts.map(str::to_owned).to_vec()
}
