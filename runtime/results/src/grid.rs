//! Aligned columns of text.

use core::fmt;
use std::collections::BTreeMap;

/// A table of texts with a header and rows. The first column and columns of words are left-aligned, the others
/// right-aligned. Columns that exceed the page width follow below, next to the first column again; words that exceed it
/// alone continue on lines of their own.
///
/// Rows that say the same of several members of an array are one row: `blade[0..3].mass, each`.
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

/// Where a name has an index: the text before its brackets, the number, and the text after.
fn indices(name: &str) -> impl Iterator<Item = (&str, u32, &str)> {
    name.match_indices('[').filter_map(|(open, _)| {
        let (inside, after) = name[open + 1..].split_once(']')?;
        Some((&name[..open], inside.parse().ok()?, after))
    })
}

/// Which index of a name runs, and from where to where.
type Running = (usize, u32, u32);

/// Rows of which several say the same of members of an array, as one: `blade[0..3].mass, each`.
fn folded(rows: &[Vec<String>]) -> Vec<Vec<String>> {
    let (head, body) = rows.split_at(rows.len().min(1));
    let mut all: Vec<(&Vec<String>, Option<Running>)> = Vec::new();
    let mut known: BTreeMap<(usize, &str, &str, &[String]), usize> = BTreeMap::new();
    for row in body {
        let name = row.first().map_or("", String::as_str);
        let others = row.get(1..).unwrap_or_default();
        let mut of_range = indices(name).enumerate().filter_map(|(k, (before, index, after))| {
            let place = *known.get(&(k, before, after, others))?;
            let (first, range) = &all[place];
            let own = indices(first.first()?).nth(k)?.1;
            let (start, end) = match range {
                None => (own, own + 1),
                Some((of, start, end)) if *of == k => (*start, *end),
                Some(_) => return None,
            };
            (index == end).then_some((place, (k, start, end + 1)))
        });
        if let Some((place, range)) = of_range.next() {
            all[place].1 = Some(range);
            continue;
        }
        drop(of_range);
        for (k, (before, _, after)) in indices(name).enumerate() {
            known.insert((k, before, after, others), all.len());
        }
        all.push((row, None));
    }
    let named = |(row, range): (&Vec<String>, Option<Running>)| {
        let mut row = row.clone();
        if let Some((k, start, end)) = range
            && let Some((before, _, after)) = row.first().and_then(|name| indices(name).nth(k))
        {
            let (after, unit) = after.split_at(after.find(" [").unwrap_or(after.len()));
            row[0] = format!("{before}[{start}..{end}]{after}, each{unit}");
        }
        row
    };
    head.iter().cloned().chain(all.into_iter().map(named)).collect()
}

impl fmt::Display for Grid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let grid = Self { rows: folded(&self.rows) };
        grid.write(f)
    }
}

impl Grid {
    fn write(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn first_columns(rows: &[[&str; 2]]) -> Vec<String> {
        let mut grid = Grid::new(cells(["name", "value"]));
        rows.iter().for_each(|row| grid.row(cells(*row)));
        let text = grid.to_string();
        text.lines().skip(1).map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect()
    }

    #[test]
    fn equal_members_of_an_array_are_one_row() {
        let rows = [["b[0].m [kg]", "1"], ["b[0].c", "2"], ["b[1].m [kg]", "1"], ["b[1].c", "2"], ["b[2].m [kg]", "1"]];
        assert_eq!(first_columns(&rows), ["b[0..3].m, each [kg] 1", "b[0..2].c, each 2"]);
        let rows = [["b[0]", "1"], ["b[1]", "2"], ["b[2]", "2"], ["b[4]", "2"], ["b", "2"]];
        assert_eq!(first_columns(&rows), ["b[0] 1", "b[1..3], each 2", "b[4] 2", "b 2"]);
        let rows = [["a[0][0]", "1"], ["a[0][1]", "1"], ["a[1][0]", "1"], ["a[1][1]", "1"]];
        assert_eq!(first_columns(&rows), ["a[0][0..2], each 1", "a[1][0..2], each 1"]);
    }
}
