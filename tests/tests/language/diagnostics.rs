//! Checks that every user error is marked in the source that causes it: the text of a case, with its diagnostics drawn
//! in, must match the compiler's output exactly, each at its columns.
//!
//! A case in `tests/diagnostics/*.txt` starts with `=== title`. Under a line, `//^^^ message` marks the columns of the
//! carets, and `// help: text` and `// in INSTANCE, used at LINE:COLUMN` belong to the mark above it. A case without the word `mechanism` is placed inside an
//! otherwise correct mechanism: a bar on a hinge `theta`. Tables and matrices that cases name are in `tests/diagnostics/files`.
//!
//! `UPDATE_DIAGNOSTICS=1 cargo test -p eigentol-tests --test language diagnostics::` redraws all cases; review the diff.

use std::fs;
use std::path::PathBuf;

use eigentol_compiler::base::diagnostics::Diagnostic;
use eigentol_compiler::compile;
use eigentol_compiler::include::Files;
use eigentol_compiler::mechanics::Limits;
use proc_macro2::TokenStream;

const BEFORE: &str = "mechanism Test {
    body bar: rod(mass: 3 kg, length: 1 m, along: -z);
    joint theta: revolute(y) from ground to bar;
";

/// The compiler's diagnostics for a declaration.
fn diagnose(source: &str) -> Vec<Diagnostic> {
    let tokens: TokenStream = source.parse().expect("the case consists of Rust tokens");
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("diagnostics");
    let tokens = match Files::of(&folder).tokens(tokens, &|text| text.parse().ok(), &mut Vec::new()) {
        Ok(tokens) => tokens,
        Err(diagnostic) => return vec![diagnostic],
    };
    match compile(tokens, Limits::default()) {
        Ok(_) => Vec::new(),
        Err(diagnostics) => diagnostics.iter().cloned().collect(),
    }
}

/// The case without its drawn diagnostics.
fn undrawn(case: &str) -> String {
    let is_drawing = |line: &&str| {
        let line = line.trim_start();
        ["//^", "// help: ", "// in `"].iter().any(|start| line.starts_with(start))
    };
    let lines: Vec<&str> = case.lines().filter(|line| !is_drawing(line)).collect();
    lines.join("\n")
}

/// The case with the compiler's diagnostics drawn in.
fn drawn(source: &str) -> String {
    let whole = source.contains("mechanism") || source.contains("struct");
    let (diagnostics, first) =
        if whole { (diagnose(source), 1) } else { (diagnose(&format!("{BEFORE}{source}\n}}")), 4) };
    let line_of = |diagnostic: &Diagnostic| diagnostic.span.first.start().line;
    let mut text = String::new();
    for (index, line) in source.lines().enumerate() {
        text.push_str(line);
        text.push('\n');
        let mut marks: Vec<(usize, String)> = diagnostics
            .iter()
            .filter(|diagnostic| line_of(diagnostic) == index + first)
            .map(|diagnostic| draw(diagnostic, line))
            .collect();
        marks.sort();
        text.extend(marks.into_iter().map(|(_, mark)| mark));
    }
    let lines = first..first + source.lines().count();
    for diagnostic in &diagnostics {
        if !lines.contains(&line_of(diagnostic)) {
            text.push_str(&format!("outside the case: {}\n", diagnostic.text()));
        }
    }
    text
}

fn draw(diagnostic: &Diagnostic, line: &str) -> (usize, String) {
    let (start, end) = (diagnostic.span.first.start(), diagnostic.span.last.end());
    let end = if end.line == start.line { end.column } else { line.chars().count() };
    assert!(start.column >= 2, "indent the line: {line}");
    let before = " ".repeat(start.column - 2);
    let carets = "^".repeat(end.saturating_sub(start.column).max(1));
    let mut text = format!("{before}//{carets} {}\n", diagnostic.message);
    if let Some(help) = &diagnostic.help {
        text.push_str(&format!("{before}// help: {help}\n"));
    }
    if let Some((name, at)) = &diagnostic.within {
        let used = at.first.start();
        text.push_str(&format!("{before}// in `{name}`, used at {}:{}\n", used.line, used.column + 1));
    }
    (start.column, text)
}

/// The cases of a file: title and text.
fn cases(file: &str) -> Vec<(&str, &str)> {
    let mut cases = Vec::new();
    for part in file.split("=== ").skip(1) {
        let (title, text) = part.split_once('\n').expect("a title ends its line");
        cases.push((title, text.trim_end()));
    }
    cases
}

fn files() -> Vec<PathBuf> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("diagnostics");
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .expect("the folder of cases exists")
        .map(|entry| entry.expect("the folder can be read").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "txt"))
        .collect();
    files.sort();
    files
}

#[test]
fn every_case_is_drawn_as_the_compiler_says() {
    let update = std::env::var_os("UPDATE_DIAGNOSTICS").is_some();
    let mut wrong = Vec::new();
    let mut count = 0;
    for path in files() {
        let file = fs::read_to_string(&path).expect("a case file is text");
        let mut redrawn = Vec::new();
        for (title, case) in cases(&file) {
            count += 1;
            let source = undrawn(case);
            let actual = drawn(&source);
            let actual = actual.trim_end();
            if actual == source {
                wrong.push(format!("{title}: the compiler finds nothing wrong"));
            } else if actual != case && !update {
                let message = format!("{title}: drawn\n{case}\nbut the compiler says\n{actual}");
                wrong.push(message);
            }
            redrawn.push(format!("=== {title}\n{actual}\n"));
        }
        if update {
            fs::write(&path, redrawn.join("\n")).expect("a case file can be written");
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
    assert!(count >= 100, "only {count} cases");
}

/// The harness itself fails for each of the ways in which a drawing can be wrong.
#[test]
fn a_wrong_drawing_is_noticed() {
    let right = "    let a = 1 kgg;
            //^^^ unknown unit `kgg`
            // help: did you mean `kg`?
";
    let source = undrawn(right);
    assert_eq!(drawn(&source), right);
    let wrong_column = right.replace("  //^^^", " //^^^");
    let wrong_length = right.replace("^^^", "^^");
    let wrong_message = right.replace("unknown unit", "unknown name");
    let wrong_help = right.replace("did you mean", "perhaps");
    let missing = source.clone();
    let extra = format!("{right}  //^ another mistake\n");
    let wrong_drawings = [wrong_column, wrong_length, wrong_message, wrong_help, missing, extra];
    for wrong in wrong_drawings {
        assert_eq!(undrawn(&wrong), source);
        assert_ne!(drawn(&undrawn(&wrong)), wrong);
    }
}
