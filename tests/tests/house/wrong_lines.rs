//! Every wrong line of `tests/wrong_lines/list` replaces a text that occurs once in the sources of the product.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// The lines of an entry, in order.
const KEYS: [&str; 6] = ["id", "wrong", "file", "old", "new", "test"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder");
    entries.map(|entry| entry.expect("a folder entry").path()).collect()
}

/// The files of Rust in a folder and below it.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut paths = Vec::new();
    for path in entries(folder) {
        if path.is_dir() {
            paths.extend(sources(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            paths.push(path);
        }
    }
    paths
}

/// Name and text of every file of the product.
fn product() -> Vec<(String, String)> {
    let trees = ["macros", "runtime"].map(|tree| root().join(tree));
    let crates = trees.iter().flat_map(|tree| entries(tree));
    let folders = trees.iter().cloned().chain(crates);
    let folders = folders.map(|folder| folder.join("src"));
    let files = folders.filter(|folder| folder.is_dir());
    let files = files.flat_map(|folder| sources(&folder));
    files
        .map(|path| {
            let name = path.file_name().expect("a file").to_string_lossy();
            let text = fs::read_to_string(&path).expect("a file of the product");
            (name.into_owned(), text)
        })
        .collect()
}

#[test]
fn every_wrong_line_has_its_place() {
    let list = fs::read_to_string(root().join("tests/wrong_lines/list")).expect("the list");
    let lines = list.lines().filter(|line| !line.starts_with('#'));
    let lines: Vec<&str> = lines.filter(|line| !line.is_empty()).collect();
    let product = product();
    let mut ids = BTreeSet::new();
    for entry in lines.chunks(KEYS.len()) {
        let all = KEYS.iter().zip(entry).map(|(key, line)| {
            let (found, text) = line.split_at_checked(6).unwrap_or((line, ""));
            assert_eq!(found, format!("{key:6}"), "`{line}` in {entry:#?}");
            text
        });
        let [id, wrong, file, old, new, test] = all.collect::<Vec<_>>()[..] else {
            panic!("not the {} lines of an entry: {entry:#?}", KEYS.len());
        };
        assert!(ids.insert(id), "two are called {id}");
        assert!(!wrong.is_empty() && old != new, "{id} changes nothing");
        assert!(test.starts_with("cargo test -p "), "{id}: {test}");
        let places: Vec<&str> =
            product.iter().flat_map(|(name, text)| text.matches(old).map(|_| name.as_str())).collect();
        assert_eq!(places, [file], "{id}: files with `{old}`");
    }
    assert_eq!(ids.len(), 150);
}
