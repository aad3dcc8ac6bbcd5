//! The commands of the README print what stands there.

use std::fs;
use std::path::Path;

use crate::program::{folder, run};

/// Set to write what the commands print into the README.
const UPDATE: &str = "UPDATE_README";

#[test]
fn the_readme_shows_what_commands_print() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md");
    let text = fs::read_to_string(&path).unwrap();
    let folder = folder("readme");
    let mut new = String::new();
    let mut commands = 0;
    let mut rest = text.as_str();
    while let Some((before, block)) = rest.split_once("```console\n") {
        let (shown, after) = block.split_once("```\n").unwrap();
        new += before;
        new += "```console\n";
        for line in shown.lines().filter(|line| line.starts_with("$ ")) {
            commands += 1;
            new += line;
            new.push('\n');
            new += &printed(line, &folder);
        }
        new += "```\n";
        rest = after;
    }
    new += rest;
    if std::env::var_os(UPDATE).is_some() {
        fs::write(&path, &new).unwrap();
    }
    assert!(commands >= 10, "{commands}");
    assert_eq!(text, new, "set {UPDATE}=1 to write this into the README");
}

/// What a line of a shell prints, with `| head -N` as the only tool beside the command.
fn printed(line: &str, folder: &Path) -> String {
    let line = line.trim_start_matches("$ eigentol ");
    let (line, lines) = match line.split_once(" | head -") {
        Some((line, lines)) => (line, lines.parse().unwrap()),
        None => (line, usize::MAX),
    };
    let arguments: Vec<String> = words(line);
    let place = |word: String| match word.strip_prefix("/tmp/") {
        Some(name) => folder.join(name).display().to_string(),
        None => word,
    };
    let arguments: Vec<String> = arguments.into_iter().map(place).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let run = run(&arguments);
    let mut text: String = (run.out.split_inclusive('\n')).take(lines).collect();
    text += &run.err;
    text.replace(&format!("{}/", folder.display()), "/tmp/")
}

/// The words of a line, quotes taken away.
fn words(line: &str) -> Vec<String> {
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
