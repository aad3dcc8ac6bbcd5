//! Fields of fixed width, and the formats in which Fortran programs write numbers.

use eigentol_compiler::matrix_market::{Mistake, Word, end};

/// The trimmed text of a line from a byte on, which is empty beyond its end.
pub(super) fn field(line: Word<'_>, from: usize, width: usize) -> Word<'_> {
    let from = from.min(line.text.len());
    let text = line.text.get(from..from.saturating_add(width).min(line.text.len())).unwrap_or("\u{fffd}");
    line.at(from + text.len() - text.trim_start().len(), text.trim())
}

/// Numbers to a line and characters to a number, as in `(1P,5E16.8)`.
#[derive(Clone, Copy)]
pub(super) struct Layout {
    per_line: usize,
    width: usize,
}

impl Layout {
    pub(super) fn of(format: Word<'_>) -> Result<Self, Mistake> {
        let read = || {
            let text = format.text.to_ascii_uppercase();
            let (before, after) = text.split_once(['E', 'D', 'F', 'G', 'I'])?;
            let count = before.rsplit(|c: char| !c.is_ascii_digit()).next().filter(|count| !count.is_empty());
            let width = after.trim_start_matches(['S', 'N']).split(|c: char| !c.is_ascii_digit()).next()?;
            let layout = Self { per_line: count.unwrap_or("1").parse().ok()?, width: width.parse().ok()? };
            (layout.per_line > 0 && layout.width > 0 && before.matches('(').count() < 2).then_some(layout)
        };
        read().ok_or_else(|| format.mistake(format!("`{}` is not a format such as `(1P,5E16.8)`", format.shown())))
    }

    /// The next numbers of a file.
    pub(super) fn fields<'t>(
        self,
        text: &str,
        lines: &mut impl Iterator<Item = Word<'t>>,
        count: usize,
    ) -> Result<Vec<Word<'t>>, Mistake> {
        let mut all = Vec::new();
        while all.len() < count {
            let missing = || end(text, format!("the file ends after {} of {count} numbers", all.len()));
            let line = lines.next().ok_or_else(missing)?;
            let expected = self.per_line.min(count - all.len());
            let words = line.words();
            if words.len() == expected {
                // Some programs write other widths than they say.
                all.extend(words);
                continue;
            }
            for k in 0..expected {
                let field = field(line, k.saturating_mul(self.width), self.width);
                if field.text.is_empty() {
                    return Err(field.mistake(format!("the line ends after {k} of {expected} numbers")));
                }
                all.push(field);
            }
        }
        Ok(all)
    }
}
