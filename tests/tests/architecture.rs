//! The import directions of ARCHITECTURE.md: what is absent stays absent.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Each room of the compiler and the rooms it may import.
const ROOMS: [(&str, &[&str]); 8] = [
    ("base", &[]),
    ("syntax", &["base"]),
    ("model", &["base", "syntax"]),
    ("topology", &["base", "model"]),
    ("algebra", &["base"]),
    ("mechanics", &["base", "model", "topology", "algebra"]),
    ("program", &["base", "algebra"]),
    (
        "emit",
        &[
            "base",
            "algebra",
            "program",
            "model",
            "topology",
            "mechanics",
        ],
    ),
];

/// Files that define the types between the stages, and the modules of their own room that they may name.
const TYPE_FILES: [(&str, &[&str]); 7] = [
    ("syntax/ast.rs", &[]),
    ("model/mechanism.rs", &["constraint", "expression"]),
    ("model/constraint.rs", &["expression", "mechanism"]),
    ("model/expression.rs", &[]),
    ("topology/mod.rs", &[]),
    ("algebra/function.rs", &["count", "graph"]),
    ("mechanics/functions.rs", &[]),
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{folder:?}: {error}"));
    for entry in entries {
        let path = entry.expect("a folder entry").path();
        if path.is_dir() {
            files.extend(sources(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}

/// The names that follow `prefix` in the text, in braces or not.
fn imported(text: &str, prefix: &str) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for (start, _) in text.match_indices(prefix) {
        let rest = &text[start + prefix.len()..];
        let list = match rest.strip_prefix('{') {
            Some(group) => &group[..group.find('}').unwrap_or(group.len())],
            None => rest,
        };
        for (k, item) in list.split(',').enumerate() {
            let name: String = item
                .trim()
                .chars()
                .take_while(|c| c.is_alphanumeric() || *c == '_')
                .collect();
            if k == 0 || rest.starts_with('{') {
                names.insert(name);
            }
        }
    }
    names
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{path:?}: {error}"))
}

#[test]
fn every_room_imports_only_what_it_may() {
    let compiler = root().join("macros/compiler/src");
    for (room, allowed) in ROOMS {
        for file in sources(&compiler.join(room)) {
            for name in imported(&read(&file), "crate::") {
                let own = name == room || ROOMS.iter().all(|(other, _)| *other != name);
                assert!(
                    own || allowed.contains(&name.as_str()),
                    "{} imports `{name}`, which {room} may not",
                    file.display()
                );
            }
        }
    }
}

#[test]
fn every_room_is_guarded() {
    let rooms: BTreeSet<String> = fs::read_dir(root().join("macros/compiler/src"))
        .expect("the compiler's sources")
        .map(|entry| entry.expect("a folder entry").path())
        .filter(|path| path.is_dir())
        .filter_map(|path| Some(path.file_name()?.to_str()?.to_owned()))
        .collect();
    let guarded: BTreeSet<String> = ROOMS.iter().map(|(room, _)| (*room).to_owned()).collect();
    assert_eq!(rooms, guarded);
}

#[test]
fn type_files_import_no_pass() {
    let compiler = root().join("macros/compiler/src");
    for (file, allowed) in TYPE_FILES {
        for name in imported(&read(&compiler.join(file)), "super::") {
            assert!(
                allowed.contains(&name.as_str()),
                "{file} imports the pass `{name}`"
            );
        }
    }
}

#[test]
fn compiler_runtime_and_oracle_never_import_each_other() {
    let dependencies = |manifest: &str| {
        let text = read(&root().join(manifest));
        text.lines()
            .skip_while(|line| *line != "[dependencies]")
            .skip(1)
            .take_while(|line| !line.starts_with('['))
            .filter(|line| line.starts_with("eigentol"))
            .map(|line| {
                line.split(['.', ' ', '='])
                    .next()
                    .unwrap_or_default()
                    .to_owned()
            })
            .collect::<BTreeSet<_>>()
    };
    assert_eq!(dependencies("macros/compiler/Cargo.toml"), BTreeSet::new());
    assert_eq!(
        dependencies("macros/Cargo.toml"),
        BTreeSet::from(["eigentol-compiler".to_owned()])
    );
    assert_eq!(
        dependencies("runtime/Cargo.toml"),
        BTreeSet::from(["eigentol-macros".to_owned()])
    );
    assert_eq!(dependencies("tests/oracle/Cargo.toml"), BTreeSet::new());
    for file in sources(&root().join("runtime/src")) {
        assert!(
            !read(&file).contains("eigentol_compiler"),
            "{}",
            file.display()
        );
    }
}

#[test]
fn solver_types_never_enter_the_compiler() {
    for file in sources(&root().join("macros")) {
        let text = read(&file);
        for solver in ["nalgebra", "rayon"] {
            assert!(
                !text.contains(solver),
                "{} mentions {solver}",
                file.display()
            );
        }
    }
}

#[test]
fn unsafe_code_stays_in_one_place() {
    let runtime = root().join("runtime/src");
    let crates = ["runtime/src", "macros", "examples"];
    let files = crates
        .iter()
        .flat_map(|folder| sources(&root().join(folder)));
    let allowed: Vec<PathBuf> = files
        .filter(|file| read(file).contains("allow(unsafe_code)"))
        .collect();
    assert_eq!(allowed, [runtime.join("lanes/x86/mod.rs")]);
}

#[test]
fn the_guard_reads_imports() {
    let text = "use crate::{a::B, c};\nuse crate::d::{E, F};\nlet x = crate::g::h();";
    let names = ["a", "c", "d", "g"].map(str::to_owned);
    assert_eq!(imported(text, "crate::"), BTreeSet::from(names));
}
