//! Documents with commands, files and edits: checks that a reader gets exactly what they show.
//!
//! | block | meaning |
//! | --- | --- |
//! | `console` | lines after `$` are commands, the others what they print |
//! | `text FILE` | the content of a file |
//! | `diff FILE` | lines of a file after `-`, and what takes their place after `+` |
//! | `sh` | commands without what they print |
//! | `rust FILE` | a program |

use std::fs;
use std::path::Path;

use crate::program::command_in;

/// Set this to write the output of the commands into the texts.
pub(crate) const UPDATE: &str = "UPDATE_README";

/// A part of a text.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Part<'a> {
    /// Prose, and code that is not for a shell.
    Prose(&'a str),
    /// Commands and their output.
    Console(&'a str),
    /// A file and its content.
    File(&'a str, &'a str),
    /// A file and a change to it.
    Change(&'a str, &'a str),
    /// Commands without output.
    Shell(&'a str),
    /// A file and the program in it.
    Program(&'a str, &'a str),
}

/// The parts of a text, in order; fences count as prose.
pub(crate) fn parts(text: &str) -> Vec<Part<'_>> {
    let mut parts = Vec::new();
    let mut rest = text;
    let mut begin = 0;
    while let Some((line, after)) = next_fence(rest, begin) {
        let end = after + rest[after..].find("```\n").expect("an end of the block");
        let block = &rest[after..end];
        let part = match line.split_once(' ') {
            None if line == "console" => Part::Console(block),
            None if line == "sh" => Part::Shell(block),
            Some(("rust", file)) => Part::Program(file, block),
            Some(("text", file)) => Part::File(file, block),
            Some(("diff", file)) => Part::Change(file, block),
            _ => {
                begin = end + 4;
                continue;
            }
        };
        parts.push(Part::Prose(&rest[..after]));
        parts.push(part);
        rest = &rest[end..];
        begin = 4;
    }
    parts.push(Part::Prose(rest));
    parts
}

/// The info string of the next opening fence, and the start of its block.
fn next_fence(text: &str, from: usize) -> Option<(&str, usize)> {
    let open = from + text.get(from..)?.find("```")?;
    let end = open + text[open..].find('\n')?;
    Some((&text[open + 3..end], end + 1))
}

/// The text as it should be: runs its commands in `folder`, where files are written and changed.
pub(crate) fn walked(text: &str, folder: &Path) -> String {
    let mut new = String::new();
    for part in parts(text) {
        match part {
            Part::Prose(text) | Part::Shell(text) | Part::Program(_, text) => new += text,
            Part::Console(shown) => {
                for line in shown.lines().filter(|line| line.starts_with("$ ")) {
                    new += line;
                    new.push('\n');
                    new += &printed(line, folder);
                }
            }
            Part::File(name, content) => {
                fs::write(folder.join(name), content).unwrap();
                new += content;
            }
            Part::Change(name, change) => {
                apply(&folder.join(name), change);
                new += change;
            }
        }
    }
    new
}

/// Replaces the lines of a file given after `-` by those after `+`.
pub(crate) fn apply(file: &Path, change: &str) {
    let text = fs::read_to_string(file).unwrap();
    let lines = |sign: char| -> String {
        let own = change.lines().filter_map(|line| line.strip_prefix(sign));
        own.flat_map(|line| [line, "\n"]).collect()
    };
    let (old, new) = (lines('-'), lines('+'));
    assert_eq!(text.matches(&old).count(), 1, "{}: {old}", file.display());
    fs::write(file, text.replacen(&old, &new, 1)).unwrap();
}

/// The output of a shell line in a folder; `| head -N` is the only other tool supported.
pub(crate) fn printed(line: &str, folder: &Path) -> String {
    let line = line.trim_start_matches("$ eigentol ");
    let (line, lines) = match line.split_once(" | head -") {
        Some((line, lines)) => (line, lines.parse().unwrap()),
        None => (line, usize::MAX),
    };
    let words = words(line);
    let arguments: Vec<&str> = words.iter().map(String::as_str).collect();
    let output = command_in(folder, &arguments).output().unwrap();
    let out = String::from_utf8(output.stdout).unwrap();
    let mut text: String = out.split_inclusive('\n').take(lines).collect();
    text += &String::from_utf8(output.stderr).unwrap();
    text
}

/// The words of a line, with quotes removed.
pub(crate) fn words(line: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quoted = false;
    for c in line.chars() {
        match c {
            '"' | '\'' => quoted = !quoted,
            ' ' if !quoted => words.push(String::new()),
            _ => words.last_mut().unwrap().push(c),
        }
    }
    words
}

#[test]
fn texts_are_taken_apart() {
    let text = "a\n```rust\nb\n```\n```text c.d\ne\n```\nf\n```console\n$ g\n```\n```diff c.d\n-e\n+h\n```\n";
    let found = parts(text);
    assert_eq!(
        found[1..],
        [
            Part::File("c.d", "e\n"),
            Part::Prose("```\nf\n```console\n"),
            Part::Console("$ g\n"),
            Part::Prose("```\n```diff c.d\n"),
            Part::Change("c.d", "-e\n+h\n"),
            Part::Prose("```\n"),
        ]
    );
}
