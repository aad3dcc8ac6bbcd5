//! Messages in the style of rustc.

use std::fmt::Display;
use std::fs;
use std::io::{IsTerminal as _, Write as _, stderr};
use std::ops::Range;
use std::path::PathBuf;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use eigentol_compiler::include::{library, without_mark};

use crate::color::Color;
use crate::declaration::Declaration;
use crate::failure::Failure;
use crate::mistake::Mistake;

/// Most mistakes that are drawn.
const MOST: usize = 50;

/// Writes a failure to standard error.
pub(crate) fn say(failure: &Failure, color: Color) {
    write(&told(failure, &renderer(color)));
}

/// A failure without colours, for another place than standard error.
pub(crate) fn plain(failure: &Failure) -> String {
    told(failure, &Renderer::plain())
}

fn told(failure: &Failure, renderer: &Renderer) -> String {
    let mut text = String::new();
    if let Failure::Declaration { name, text: source, mistakes } = failure {
        for mistake in mistakes.iter().take(MOST) {
            text += &drawn(Level::ERROR, name, source, mistake, renderer);
            text += "\n\n";
        }
        if mistakes.len() > MOST {
            text += &format!("These are the first {MOST} mistakes.\n\n");
        }
    }
    text + &title(&failure.to_string(), failure.help().as_deref(), renderer)
}

/// Writes a warning about a declaration to standard error.
pub(crate) fn warn(declaration: &Declaration, warning: &Mistake, color: Color) {
    let Declaration { name, text } = declaration;
    let warning = drawn(Level::WARNING, name, text, warning, &renderer(color));
    write(&format!("{warning}\n"));
}

/// Writes to standard error why the answer is negative or incomplete.
pub(crate) fn say_no(word: &str, reason: &str, color: Color) {
    let group = Group::with_title(Level::WARNING.with_name(word).primary_title(reason));
    write(&renderer(color).render(&[group]));
}

/// Writes a note to standard error.
pub(crate) fn note(note: &impl Display) {
    write(&format!("note: {note}"));
}

/// If standard error cannot be written to, nothing can be reported.
fn write(text: &str) {
    let _ = writeln!(stderr(), "{text}");
}

fn renderer(color: Color) -> Renderer {
    if color.on(stderr().is_terminal()) { Renderer::styled() } else { Renderer::plain() }
}

fn title(message: &str, help: Option<&str>, renderer: &Renderer) -> String {
    let mut group = Group::with_title(Level::ERROR.primary_title(message));
    if let Some(help) = help {
        group = group.element(Level::HELP.message(help));
    }
    renderer.render(&[group])
}

/// Draws a mistake below its source line.
fn drawn(level: Level<'_>, name: &str, source: &str, mistake: &Mistake, renderer: &Renderer) -> String {
    let included = |file: &PathBuf| {
        let name = file.display().to_string();
        let text = fs::read_to_string(file).ok().map(without_mark).or_else(|| Some(library(&name)?.1.to_owned()));
        Some((name, text?))
    };
    let file = mistake.file.as_ref().and_then(included);
    let (name, source) = file.as_ref().map_or((name, source), |(name, source)| (name, source));
    let annotation = AnnotationKind::Primary.span(bytes(source, mistake));
    let snippet = Snippet::source(source).path(name).annotation(annotation);
    let title = level.primary_title(&*mistake.message);
    let mut group = Group::with_title(title).element(snippet);
    if let Some(help) = &mistake.help {
        group = group.element(Level::HELP.message(&**help));
    }
    renderer.render(&[group])
}

/// The byte range between two positions, whose lines and characters count from 1.
fn bytes(source: &str, mistake: &Mistake) -> Range<usize> {
    let start = byte(source, mistake.start);
    let end = byte(source, mistake.end);
    // At the end of the text, only its last character can be marked.
    let start = start.min(source.trim_end().len().saturating_sub(1));
    let start = (0..=start).rev().find(|&at| source.is_char_boundary(at));
    let start = start.unwrap_or(0);
    start..end.max(start)
}

fn byte(source: &str, (line, column): (usize, usize)) -> usize {
    let mut lines = source.split_inclusive('\n');
    let before: usize = lines.clone().take(line.saturating_sub(1)).map(str::len).sum();
    let text = lines.nth(line.saturating_sub(1)).unwrap_or("").trim_end_matches(['\n', '\r']);
    before + text.char_indices().nth(column.saturating_sub(1)).map_or(text.len(), |(at, _)| at)
}

#[cfg(test)]
mod tests {
    use super::byte;

    #[test]
    fn lines_and_characters_become_bytes() {
        let text = "ab\nµ c\r\nd";
        for (location, expected) in [((1, 1), 0), ((2, 1), 3), ((2, 2), 5), ((2, 9), 7), ((3, 1), 9)] {
            assert_eq!(byte(text, location), expected, "{location:?}");
        }
        assert_eq!(byte(text, (9, 1)), text.len());
        assert_eq!(byte("", (1, 1)), 0);
    }
}
