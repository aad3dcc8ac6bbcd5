//! Checks the import directions of ARCHITECTURE.md: absent dependencies must stay absent.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Each room of the compiler, and the rooms it may import.
const ROOMS: [(&str, &[&str]); 3] = [
    ("topology", &["base", "model"]),
    ("mechanics", &["base", "model", "topology", "algebra"]),
    ("emit", &["base", "algebra", "program", "model", "topology", "mechanics"]),
];

/// The rooms of `macros/language` and `macros/symbolic` that the compiler's rooms find beside their own.
const OTHER_ROOMS: [&str; 5] = ["base", "syntax", "model", "algebra", "program"];

/// The subfolders of `mechanics`, in order: each may import the earlier ones and the shared types.
const MECHANICS: [&str; 8] = ["setup", "motion", "inertia", "loads", "equations", "linear", "checks", "kernels"];

/// The types that the subfolders of `mechanics` share with other rooms.
const TYPES: [&str; 3] = ["functions", "kernel_name", "picture"];

/// The crates of the product, in order: each may depend on those named here, and has at most this many kilobytes of code
/// outside its tests. One rises only where another falls by as much.
const CRATES: [(&str, &[&str], usize); 23] = [
    ("runtime/contract", &[], 53),
    ("runtime/statistics", &[], 140),
    ("runtime/numerics", &["eigentol-contract", "eigentol-statistics"], 147),
    ("runtime/results", &["eigentol-contract"], 23),
    (
        "runtime/solve",
        &["eigentol-contract", "eigentol-numerics", "eigentol-results", "eigentol-shafts", "eigentol-statistics"],
        378,
    ),
    (
        "runtime/tolerance",
        &["eigentol-contract", "eigentol-numerics", "eigentol-results", "eigentol-solve", "eigentol-statistics"],
        162,
    ),
    (
        "runtime/analysis",
        &[
            "eigentol-contract",
            "eigentol-numerics",
            "eigentol-results",
            "eigentol-solve",
            "eigentol-statistics",
            "eigentol-tolerance",
        ],
        482,
    ),
    (
        "runtime/uncertainty",
        &[
            "eigentol-analysis",
            "eigentol-contract",
            "eigentol-numerics",
            "eigentol-results",
            "eigentol-solve",
            "eigentol-statistics",
            "eigentol-tolerance",
        ],
        182,
    ),
    (
        "runtime",
        &[
            "eigentol-analysis",
            "eigentol-contract",
            "eigentol-macros",
            "eigentol-numerics",
            "eigentol-results",
            "eigentol-solve",
            "eigentol-tolerance",
            "eigentol-uncertainty",
        ],
        59,
    ),
    ("runtime/shafts", &["eigentol-contract", "eigentol-numerics"], 79),
    ("macros/symbolic", &[], 69),
    ("macros/language", &["eigentol-symbolic"], 507),
    ("macros/compiler", &["eigentol-language", "eigentol-symbolic"], 424),
    ("macros", &["eigentol-compiler"], 1),
    ("macros/build", &["eigentol-compiler"], 22),
    ("macros/urdf", &["eigentol-compiler"], 86),
    ("runtime/interpreter", &["eigentol", "eigentol-compiler"], 62),
    ("runtime/tables", &["eigentol-contract", "eigentol-results"], 20),
    ("runtime/figures", &["eigentol"], 116),
    ("runtime/report", &["eigentol", "eigentol-figures", "eigentol-tables"], 65),
    (
        "runtime/live",
        &["eigentol", "eigentol-compiler", "eigentol-figures", "eigentol-interpreter", "eigentol-report"],
        22,
    ),
    (
        "runtime/command",
        &[
            "eigentol",
            "eigentol-compiler",
            "eigentol-figures",
            "eigentol-interpreter",
            "eigentol-live",
            "eigentol-report",
            "eigentol-results",
            "eigentol-tables",
            "eigentol-urdf",
        ],
        175,
    ),
    (
        "runtime/python",
        &[
            "eigentol",
            "eigentol-figures",
            "eigentol-interpreter",
            "eigentol-language",
            "eigentol-live",
            "eigentol-report",
            "eigentol-results",
            "eigentol-tables",
            "eigentol-urdf",
        ],
        114,
    ),
];

/// The rooms of other crates that have several, in order: each may import the earlier ones.
const CRATE_ROOMS: [(&str, &[&str]); 8] = [
    ("macros/symbolic", &["base", "algebra", "program"]),
    ("macros/language", &["base", "matrix_market", "syntax", "mistakes", "include", "model"]),
    ("runtime/contract", &["scalar", "mechanism"]),
    ("runtime/numerics", &["algebra", "linear", "rounding", "eigenproblem"]),
    (
        "runtime/solve",
        &[
            "error",
            "arguments",
            "watch",
            "kernels",
            "constraints",
            "free",
            "rounding",
            "state",
            "shafts",
            "modes",
            "equilibrium",
            "sensitivity",
        ],
    ),
    ("runtime/tolerance", &["batched", "tolerance"]),
    (
        "runtime/analysis",
        &[
            "along",
            "variables",
            "branches",
            "sweep",
            "shapes",
            "clusters",
            "second_order",
            "forced",
            "peaks",
            "response",
            "quadratic",
            "campbell",
            "event_map",
            "convergence",
            "picture",
            "mistuning",
            "motion",
        ],
    ),
    ("runtime/uncertainty", &["deviations", "judge", "propagation", "bode", "requirement", "allocation", "summary"]),
];

/// Files that define the types passed between stages, and the modules of their own room that they may import.
const TYPE_FILES: [(&str, &[&str]); 14] = [
    ("language/src/syntax/ast.rs", &[]),
    (
        "language/src/model/mechanism.rs",
        &["beam", "constraint", "excitation", "expression", "shaft", "shape", "superelement", "tolerance", "unit"],
    ),
    ("language/src/model/beam.rs", &["expression"]),
    ("language/src/model/shaft.rs", &["expression"]),
    ("language/src/model/shape.rs", &["expression"]),
    ("language/src/model/constraint.rs", &["expression", "unit"]),
    ("language/src/model/unit.rs", &[]),
    ("language/src/model/tolerance.rs", &[]),
    ("language/src/model/expression.rs", &[]),
    ("compiler/src/topology/mod.rs", &[]),
    ("symbolic/src/algebra/function.rs", &["count", "graph"]),
    ("compiler/src/mechanics/functions.rs", &["picture"]),
    ("compiler/src/mechanics/kernel_name.rs", &[]),
    ("compiler/src/mechanics/picture.rs", &[]),
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
            // skip the output of `cargo build` in a nested workspace
            if !path.ends_with("target") {
                files.extend(sources(&path));
            }
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}

/// The names after `prefix` in the text, with or without braces.
fn imported(text: &str, prefix: &str) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for (start, _) in text.match_indices(prefix) {
        let rest = &text[start + prefix.len()..];
        let list = match rest.strip_prefix('{') {
            Some(group) => &group[..group.find('}').unwrap_or(group.len())],
            None => rest,
        };
        for (k, item) in list.split(',').enumerate() {
            let name: String = item.trim().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
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
            let text = read(&file);
            let mut names = imported(&text, "crate::");
            names.extend(imported(&text, "eigentol_language::"));
            names.extend(imported(&text, "eigentol_symbolic::"));
            for name in names {
                let mut others = ROOMS.iter().map(|(other, _)| other).chain(&OTHER_ROOMS);
                let own = name == room || others.all(|other| *other != name);
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
fn the_language_knows_no_expression_graph() {
    for file in sources(&root().join("macros/language/src")) {
        for name in imported(&read(&file), "eigentol_symbolic::") {
            assert!(["base", "id"].contains(&name.as_str()), "{} imports `{name}`", file.display());
        }
    }
}

#[test]
fn no_two_subfolders_of_mechanics_import_each_other() {
    let mechanics = root().join("macros/compiler/src/mechanics");
    let folders: BTreeSet<String> = folders(&mechanics);
    assert_eq!(folders, MECHANICS.map(str::to_owned).into());
    for (place, folder) in MECHANICS.iter().enumerate() {
        for file in sources(&mechanics.join(folder)) {
            let text = read(&file);
            let mut names = imported(&text, "crate::mechanics::");
            names.extend(imported(&text, "super::super::"));
            for name in names {
                assert!(
                    TYPES.contains(&name.as_str()) || MECHANICS[..place].contains(&name.as_str()),
                    "{} imports `{name}`, which {folder} may not",
                    file.display()
                );
            }
        }
    }
}

#[test]
fn files_import_each_other_in_one_direction() {
    for (path, ..) in CRATES {
        let source = root().join(path).join("src");
        let files = rooms_of(&source).into_values().flatten().collect();
        assert_one_direction(&source, files);
    }
}

fn assert_one_direction(source: &Path, files: Vec<PathBuf>) {
    let modules: BTreeMap<String, PathBuf> = files
        .into_iter()
        .filter(|file| !file.ends_with("tests.rs"))
        .map(|file| (module(source, &file), file))
        .collect();
    let imports: BTreeMap<&str, BTreeSet<String>> =
        modules.iter().map(|(name, file)| (name.as_str(), uses(&read(file), name, &modules))).collect();
    if let Some(circle) = circle(&imports) {
        panic!("these import each other: {}", circle.join(", "));
    }
}

/// The rooms of a crate: folders, or top-level files.
fn rooms_of(source: &Path) -> BTreeMap<String, Vec<PathBuf>> {
    let mut rooms: BTreeMap<String, Vec<PathBuf>> = BTreeMap::new();
    for file in sources(source) {
        let path = file.strip_prefix(source).expect("a file of the crate");
        let first = path.iter().next().and_then(|name| name.to_str());
        let room = first.unwrap_or_default().trim_end_matches(".rs");
        if !["lib", "main"].contains(&room) && !is_test(path) {
            rooms.entry(room.to_owned()).or_default().push(file);
        }
    }
    rooms
}

fn is_test(path: &Path) -> bool {
    path.iter().any(|name| name.to_str().is_some_and(|name| name.trim_end_matches(".rs").ends_with("tests")))
}

#[test]
fn rooms_of_other_crates_import_those_before_them() {
    for (path, order) in CRATE_ROOMS {
        let source = root().join(path).join("src");
        let rooms = rooms_of(&source);
        let names: BTreeSet<&str> = rooms.keys().map(String::as_str).collect();
        assert_eq!(names, BTreeSet::from_iter(order.iter().copied()));
        for (place, room) in order.iter().enumerate() {
            for file in &rooms[*room] {
                for other in crate_imports(&read(file)) {
                    assert!(
                        !order[place + 1..].contains(&other.as_str()),
                        "{} imports `{other}`, which {room} may not",
                        file.display()
                    );
                }
            }
        }
    }
}

#[test]
fn no_crate_exceeds_its_size() {
    for (path, _, budget) in CRATES {
        let source = root().join(path).join("src");
        let files = sources(&source);
        let product = (files.iter()).filter(|file| !is_test(file.strip_prefix(&source).expect("a file of the crate")));
        let size: usize = product.map(|file| size(&read(file))).sum();
        assert!(size <= 1_000 * budget, "{path}: {size} bytes of {budget} kB");
        assert!(4 * size + 4_000 > 3_000 * budget, "{path}: {size} bytes, and a budget of {budget} kB: lower it");
    }
}

/// Bytes of code before the tests of a file: neither comments on lines of their own nor white space count, so that formatting
/// buys nothing.
fn size(text: &str) -> usize {
    code(text).split_whitespace().map(str::len).sum()
}

/// A file without its comments and tests.
fn code(text: &str) -> String {
    let code = text.split("mod tests {").next().unwrap_or(text);
    code.lines().filter(|line| !line.trim_start().starts_with("//")).flat_map(|line| [line, "\n"]).collect()
}

/// The crate items that a file refers to outside its tests and comments.
fn crate_imports(text: &str) -> BTreeSet<String> {
    let code = code(text);
    let declared = code.split("use crate::").skip(1).flat_map(|rest| {
        let tree = rest.split(';').next().unwrap_or_default();
        paths(tree)
    });
    let inline = code.split("crate::").skip(1).map(str::to_owned);
    let inline = inline.filter(|rest| !rest.starts_with('{'));
    let first = |path: String| -> String {
        let end = path.find(|c: char| !c.is_alphanumeric() && c != '_');
        path[..end.unwrap_or(path.len())].to_owned()
    };
    declared.chain(inline).map(first).collect()
}

/// The path of a file as a module, for example `mechanics::motion::frame`.
fn module(source: &Path, file: &Path) -> String {
    let path = file.strip_prefix(source).expect("a file of the sources");
    let names: Vec<&str> = path
        .iter()
        .filter_map(|name| name.to_str())
        .map(|name| name.trim_end_matches(".rs"))
        .filter(|name| *name != "mod")
        .collect();
    names.join("::")
}

/// The modules that a module refers to outside its tests, except its own children whose items it re-exports with
/// `pub use`.
fn uses(text: &str, own: &str, modules: &BTreeMap<String, PathBuf>) -> BTreeSet<String> {
    let code = code(text);
    // a visibility is not an import
    let code = &code.replace("pub(in crate::", "pub(");
    let declared = code.match_indices("use ").flat_map(|(at, word)| {
        let line = code[..at].rsplit('\n').next().unwrap_or_default();
        let tree = code[at + word.len()..].split(';').next();
        let list = tree.map(paths).unwrap_or_default();
        let handed_on = |path: &str| line.starts_with("pub") && !path.starts_with("super::");
        list.into_iter().filter(move |path| !handed_on(path))
    });
    let is_path = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let inline = code.split(|c: char| !is_path(c)).map(str::to_owned);
    let inline = inline.filter(|path| path.starts_with("crate::") || path.starts_with("super::"));
    let module_of = |path: String| {
        let full = absolute(&path, own);
        let lengths = (1..=full.len()).rev();
        let mut names = lengths.map(|length| full[..length].join("::"));
        names.find(|name| modules.contains_key(name))
    };
    let all = declared.chain(inline).filter_map(module_of);
    all.filter(|name| name != own).collect()
}

/// The paths of a `use` declaration, with its braces expanded.
fn paths(tree: &str) -> Vec<String> {
    let Some(open) = tree.find('{') else {
        return vec![tree.to_owned()];
    };
    let (prefix, inner) = (&tree[..open], &tree[open + 1..]);
    let inner = &inner[..inner.rfind('}').unwrap_or(inner.len())];
    let (mut depth, mut start, mut list) = (0, 0, Vec::new());
    for (at, sign) in inner.char_indices() {
        match sign {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                list.push(&inner[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    list.push(&inner[start..]);
    list.iter()
        .map(|item| item.trim())
        .filter(|item| !item.is_empty())
        .flat_map(paths)
        .map(|item| format!("{prefix}{item}"))
        .collect()
}

/// The segments of a path from the root of the crate.
fn absolute(path: &str, text: &str) -> Vec<String> {
    let mut full: Vec<String> = text.split("::").map(str::to_owned).collect();
    for (k, segment) in path.split("::").enumerate() {
        match (k, segment) {
            (0, "crate") => full.clear(),
            (_, "self") => {}
            (_, "super") => drop(full.pop()),
            (_, segment) => full.push(segment.to_owned()),
        }
    }
    full
}

/// Finds modules that import each other in a cycle.
fn circle(imports: &BTreeMap<&str, BTreeSet<String>>) -> Option<Vec<String>> {
    let mut left = imports.clone();
    loop {
        let rest: BTreeSet<String> = left.keys().map(|name| (*name).to_owned()).collect();
        let before = left.len();
        let named: BTreeSet<String> = left.values().flatten().cloned().collect();
        left.retain(|name, names| named.contains(*name) && !names.is_disjoint(&rest));
        if left.is_empty() {
            return None;
        }
        if left.len() == before {
            return Some(left.keys().map(|name| (*name).to_owned()).collect());
        }
    }
}

fn folders(of: &Path) -> BTreeSet<String> {
    fs::read_dir(of)
        .unwrap_or_else(|error| panic!("{of:?}: {error}"))
        .map(|entry| entry.expect("a folder entry").path())
        .filter(|path| path.is_dir())
        .filter_map(|path| Some(path.file_name()?.to_str()?.to_owned()))
        .collect()
}

#[test]
fn every_room_is_guarded() {
    let rooms = folders(&root().join("macros/compiler/src"));
    let guarded: BTreeSet<String> = ROOMS.iter().map(|(room, _)| (*room).to_owned()).collect();
    assert_eq!(rooms, guarded);
}

#[test]
fn type_files_import_no_pass() {
    let macros = root().join("macros");
    for (file, allowed) in TYPE_FILES {
        for name in imported(&read(&macros.join(file)), "super::") {
            assert!(allowed.contains(&name.as_str()), "{file} imports the pass `{name}`");
        }
    }
}

#[test]
fn crates_depend_only_on_those_they_may() {
    let dependencies = |folder: &str| -> BTreeSet<String> {
        let text = read(&root().join(folder).join("Cargo.toml"));
        let lines = text.lines().skip_while(|line| *line != "[dependencies]");
        let lines = lines.skip(1).take_while(|line| !line.starts_with('['));
        let names = lines.filter_map(|line| line.split(['.', ' ', '=']).next());
        let names = names.filter(|name| name.starts_with("eigentol"));
        names.map(str::to_owned).collect()
    };
    for (folder, allowed, _) in CRATES {
        let allowed: BTreeSet<String> = allowed.iter().map(|name| (*name).to_owned()).collect();
        assert_eq!(dependencies(folder), allowed, "{folder}");
    }
    assert_eq!(dependencies("tests/oracle"), BTreeSet::new());
}

#[test]
fn solver_types_never_enter_the_compiler() {
    for file in sources(&root().join("macros")) {
        let text = read(&file);
        for solver in ["nalgebra", "rayon"] {
            assert!(!text.contains(solver), "{} mentions {solver}", file.display());
        }
    }
}

#[test]
fn unsafe_code_stays_in_one_place() {
    let crates = ["runtime", "macros", "examples"];
    let files = crates.iter().flat_map(|folder| sources(&root().join(folder)));
    let allowed: BTreeSet<PathBuf> = files.filter(|file| read(file).contains("allow(unsafe_code")).collect();
    // The second one writes it into the text of C functions.
    let generator = root().join("macros/build/src/c/mod.rs");
    assert_eq!(allowed, [root().join("runtime/contract/src/scalar/x86/mod.rs"), generator].into());
}

#[test]
fn the_guard_reads_imports() {
    let text = "use crate::{a::B, c};\nuse crate::d::{E, F};\nlet x = crate::g::h();";
    let names = ["a", "c", "d", "g"].map(str::to_owned);
    assert_eq!(imported(text, "crate::"), BTreeSet::from(names));
}

#[test]
fn the_guard_finds_circles() {
    let modules: BTreeMap<String, PathBuf> =
        ["a", "a::b", "a::b::c", "a::d"].map(|name| (name.to_owned(), PathBuf::new())).into();
    let of = |text: &str, x: &str| uses(text, x, &modules);
    let text = "//! Text.\n\nuse super::c::{D, e};\nuse crate::a::d::F;\npub(in crate::a::b::c) fn g() {}\n";
    let found = of(text, "a::b");
    assert_eq!(found, BTreeSet::from(["a", "a::d"].map(str::to_owned)));
    let found = of("mod c;\n\nuse c::{H, i::J};\nuse super::{d::{K, l}, M};", "a::b");
    let expected = ["a", "a::b::c", "a::d"].map(str::to_owned);
    assert_eq!(found, BTreeSet::from(expected));
    let found = of("pub use b::G;\npub(super) use super::a::d::F;", "a");
    assert_eq!(found, BTreeSet::from(["a::d".to_owned()]));
    let names = |list: &[&str]| -> BTreeSet<String> { list.iter().map(|name| (*name).to_owned()).collect() };
    let tree = BTreeMap::from([("a", names(&["b"])), ("b", names(&["c"]))]);
    assert_eq!(circle(&tree), None);
    let round = BTreeMap::from([("a", names(&["b"])), ("b", names(&["a"]))]);
    assert_eq!(circle(&round), Some(vec!["a".to_owned(), "b".to_owned()]));
}
