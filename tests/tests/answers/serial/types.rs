//! Every public data type of the runtime can be written and read, or the reason why not is listed here.

use std::fs;
use std::path::{Path, PathBuf};

/// Types that cannot be written, and why.
const NOT_WRITTEN: [(&str, &str); 32] = [
    ("Any", "has no values"),
    ("Axes", "borrows its values"),
    ("Batch", "a register"),
    ("BatchPoint", "borrows its values"),
    ("Choices", "holds functions"),
    ("Cost", "a function"),
    ("Coordinate", "written by hand"),
    ("DesignVariable", "written by hand"),
    ("DeviatingInputs", "kernels"),
    ("Dual", "a scalar of kernels"),
    ("Extent", "a property of kernels"),
    ("Following", "holds what the processor can do"),
    ("HalfWidth", "holds a function"),
    ("InDeclaredUnit", "an argument"),
    ("Input", "written by hand"),
    ("Instructions", "what the processor can do"),
    ("Interval", "a scalar of kernels"),
    ("Output", "written by hand"),
    ("Excitation", "written by hand"),
    ("Banded", "settings"),
    ("Derived", "derivatives on their way to a text"),
    ("Variable", "a name and a unit for texts"),
    ("PartialMatrices", "an intermediate result of kernels"),
    ("Requirements", "borrows a mechanism"),
    ("Responses", "borrows a mechanism"),
    ("Sampling", "holds a function"),
    ("Shared", "written by hand"),
    ("Sizes", "an intermediate result of kernels"),
    ("Solved", "borrows its mechanism"),
    ("Study", "holds a mechanism"),
    ("Watch", "holds a function"),
    ("Workspace", "room for computations"),
];

/// The same list for the statistics crate.
const STATISTICS_NOT_WRITTEN: [(&str, &str); 10] = [
    ("Cursor", "borrows its sequence"),
    ("DesignWalk", "borrows its design"),
    ("LimitFunction", "a function"),
    ("LineSampler", "made from settings and directions"),
    ("Number", "written by hand"),
    ("RandomNumbers", "made from a seed"),
    ("SaltelliDesign", "made from a seed and sizes"),
    ("Sample", "values of the user's own"),
    ("Sequence", "made from a seed and sizes"),
    ("Sorted", "values of the user's own, in order"),
];

pub(super) fn sources(folder: &Path, paths: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            sources(&path, paths);
        } else if path.extension().is_some_and(|x| x == "rs") {
            paths.push(path);
        }
    }
}

/// Names of the public types in a source text that are neither serialisable nor hidden from users.
fn not_written(text: &str) -> Vec<String> {
    let mut texts = Vec::new();
    let mut written = false;
    for line in text.lines() {
        if line.starts_with("#[cfg_attr(feature = \"serde\", derive(serde::Serialize")
            || line.starts_with("    derive(serde::Serialize, serde::Deserialize)")
            || line == "#[doc(hidden)]"
        {
            written = true;
        }
        for word in ["pub struct ", "pub enum "] {
            if let Some(rest) = line.strip_prefix(word) {
                let name = rest.chars().take_while(char::is_ascii_alphanumeric);
                if !written {
                    texts.push(name.collect());
                }
            }
        }
        // Attributes come together, before the item they belong to.
        if !(line.starts_with('#') || line.starts_with("///") || line.starts_with(' ') || line.starts_with(")]")) {
            written = false;
        }
    }
    texts
}

/// Fails for a type in the crates that is neither serialisable nor excused, and for an unused excuse.
fn check(folders: &[&str], least: usize, excuses: &[(&str, &str)], by_macro: &[&str]) {
    let mut files = Vec::new();
    for folder in folders {
        let folder = format!("../runtime/{folder}src");
        sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join(folder), &mut files);
    }
    assert!(files.len() > least);
    let mut used = by_macro.to_vec();
    for file in files {
        let text = fs::read_to_string(&file).expect("text");
        for name in not_written(&text) {
            let place = file.display();
            let excuse = excuses.iter().find(|(x, _)| *x == name);
            let (own, _) = excuse.unwrap_or_else(|| {
                panic!("{place}: `{name}` cannot be written: derive serde's traits under the feature")
            });
            used.push(own);
        }
    }
    for (name, _) in excuses {
        assert!(used.contains(name), "`{name}` needs no excuse");
    }
}

#[test]
fn every_type_is_written_or_excused() {
    let by_macro = ["Coordinate", "DesignVariable", "Excitation", "Input", "Output"];
    let crates = ["contract/", "solve/", "tolerance/", "analysis/", "uncertainty/", ""];
    check(&crates, 200, &NOT_WRITTEN, &by_macro);
    check(&["statistics/"], 50, &STATISTICS_NOT_WRITTEN, &[]);
}

#[test]
fn a_type_without_is_found() {
    let text = "/// One.\n#[derive(Clone)]\npub struct One {\n    field: f64,\n}\n";
    assert_eq!(not_written(text), ["One"]);
    let with = format!("#[cfg_attr(feature = \"serde\", derive(serde::Serialize, serde::Deserialize))]\n{text}");
    assert_eq!(not_written(&with), Vec::<String>::new());
    assert_eq!(not_written(&format!("{with}{text}")), ["One"]);
}
