//! Checks links within the repository: every linked file and every linked heading must exist.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Every Markdown page of the project.
fn pages(folder: &Path) -> Vec<PathBuf> {
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("a folder entry").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() && name != "target" && !name.starts_with('.') {
            paths.extend(pages(&path));
        } else if name.ends_with(".md") {
            paths.push(path);
        }
    }
    paths.sort();
    paths
}

/// The lines of a page outside code blocks.
fn prose(text: &str) -> Vec<&str> {
    let mut inside = false;
    let mut lines = Vec::new();
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            inside = !inside;
        } else if !inside {
            lines.push(line);
        }
    }
    lines
}

/// The link targets of a page: `[words](target)` and `![words](target)`, not within `code`.
fn targets(text: &str) -> Vec<String> {
    let mut texts = Vec::new();
    for line in prose(text) {
        let outside: String = line.split('`').step_by(2).collect();
        let links = outside.split("](").skip(1);
        texts.extend(links.filter_map(|rest| Some(rest.split_once(')')?.0.to_owned())));
    }
    texts
}

/// The anchors that GitHub and rustdoc give the headings of a page.
fn anchors(text: &str) -> BTreeSet<String> {
    let headings = prose(text)
        .into_iter()
        .filter_map(|line| line.trim_start_matches('#').strip_prefix(' ').filter(|_| line.starts_with('#')));
    let anchor = |heading: &str| -> String {
        let letters = heading.trim().to_lowercase();
        let kept = letters.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
        kept.map(|c| if c == ' ' { '-' } else { c }).collect()
    };
    headings.map(anchor).collect()
}

/// The fault of a link, if any. Web addresses are not checked; Rust paths are left to rustdoc.
fn mistake(page: &Path, text: &str, target: &str) -> Option<String> {
    if target.contains("://") || target.contains("::") {
        return None;
    }
    let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
    let to = match file {
        "" => page.to_owned(),
        _ => page.parent().unwrap_or(page).join(file),
    };
    if !to.exists() {
        return Some(format!("{}: no file `{file}`", page.display()));
    }
    let other = match file {
        "" => text.to_owned(),
        _ if anchor.is_empty() => return None,
        _ => fs::read_to_string(&to).ok()?,
    };
    let known = anchor.is_empty() || anchors(&other).contains(anchor);
    (!known).then(|| format!("{}: no heading `#{anchor}` in {}", page.display(), to.display()))
}

#[test]
fn links_lead_somewhere() {
    let (mut links, mut mistakes) = (0, Vec::new());
    for page in pages(&root()) {
        let text = fs::read_to_string(&page).expect("a page");
        for target in targets(&text) {
            links += 1;
            mistakes.extend(mistake(&page, &text, &target));
        }
    }
    assert!(mistakes.is_empty(), "{mistakes:#?}");
    assert!(links > 20, "{links}");
}

#[test]
fn the_check_finds_what_is_wrong() {
    let text = "# What a build costs: all\n[a](#what-a-build-costs-all), [b](#missing), [c](no.md)\n\
                ```text\n[d](e.md)\n```\n`[f](g.md)` [h](https://i) [j](k::l) ![m](main.rs)\n";
    let page = root().join("tests/tests/language/links.rs");
    let texts = targets(text);
    assert_eq!(texts.len(), 6, "{texts:?}");
    let mistakes: Vec<String> = (texts.iter()).filter_map(|target| mistake(&page, text, target)).collect();
    assert_eq!(mistakes.len(), 2, "{mistakes:?}");
    assert!(mistakes[0].contains("#missing") && mistakes[1].contains("no.md"));
}
