//! Checks the table of all files in the documentation against the actual results. `UPDATE_ROBOTS=1` rewrites it.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs};

use eigentol_compiler::compile;
use eigentol_compiler::mechanics::Limits;
use eigentol_urdf::{Base, Import, ImportError, Note, Options, Reason, Resistance, import};
use roxmltree::Document;

use super::files::read;
use super::package::{package_or_skip, urdf_files};

const HEAD: &str = "\
# Every file of example-robot-data

What becomes of the URDF files of the package [example-robot-data](https://pypi.org/project/example-robot-data/) 6.0.0: on a fixed base,
with the springs of `Options::default()` unless something else is said. Every declaration compiles; with springs, on a fixed and on
a floating base, their numbers are those of Pinocchio to 1e-9 (`tests/tests/language/urdf.rs`), except where inertias were replaced. \"Resisted\" is what
`Resistance::Drives` leaves free: what gravity or another joint holds.

";

/// The data of one file shown in the table.
struct Row {
    file: String,
    counts: String,
    result: String,
}

fn imported(text: &str, options: &Options) -> Result<(Import, usize), ImportError> {
    let import = import(text, options)?;
    let tokens = import.declaration.parse().expect("tokens");
    let limits = Limits { explicit_partials: 0, partial_operations: usize::MAX, motion_linear: 0 };
    let compiled = compile(tokens, limits).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let unknowns = compiled.topology.free.len();
    Ok((import, unknowns))
}

fn said(error: &ImportError) -> String {
    let reasons: Vec<String> = error
        .mistakes
        .iter()
        .map(|mistake| match &mistake.reason {
            Reason::Inertia { links, .. } => format!("`{}`", links.join("`, `")),
            reason => reason.to_string(),
        })
        .collect();
    let is_inertia = |reason: &Reason| matches!(reason, Reason::Inertia { .. });
    let mut reasons = match error.mistakes.iter().all(|mistake| is_inertia(&mistake.reason)) {
        true => vec![format!("inertias that no body has: {}", reasons.join(", "))],
        false => reasons,
    };
    let mut seen = BTreeSet::new();
    reasons.retain(|reason| seen.insert(reason.clone()));
    format!("refused: {}", reasons.join("; "))
}

fn row(folder: &Path, file: &Path) -> Row {
    let text = read(file);
    let document = Document::parse(&text).expect("XML");
    let count = |tag: &str| {
        let children = document.root_element().children();
        children.filter(|child| child.has_tag_name(tag)).count()
    };
    let (links, joints) = (count("link"), count("joint"));
    let mut result = String::new();
    let mut free = "-".to_owned();
    let mut kept = "-".to_owned();
    let mut options = Options::default();
    for attempt in 0..4 {
        match imported(&text, &options) {
            Ok((import, unknowns)) => {
                free = unknowns.to_string();
                result += "imported";
                result += &remarks(&import);
                let drives = options.clone().resistance(Resistance::Drives);
                kept = match imported(&text, &drives) {
                    Ok((_, unknowns)) => unknowns.to_string(),
                    Err(_) => "0".to_owned(),
                };
                let alone = options.clone().resistance(Resistance::KernelsOnly);
                assert!(imported(&text, &alone).is_ok(), "{}", file.display());
                break;
            }
            Err(error) => {
                let _ = write!(result, "{}. ", said(&error));
                let is = |wanted: fn(&Reason) -> bool| error.mistakes.iter().all(|one| wanted(&one.reason));
                if attempt < 3 && is(|reason| matches!(reason, Reason::Inertia { .. })) {
                    result += "With `nearest_inertias`: ";
                    options = options.nearest_inertias(true);
                } else if attempt < 3 && is(|reason| matches!(reason, Reason::NothingMoves(_))) {
                    result += "With a floating base: ";
                    options = options.base(Base::Floating);
                } else {
                    break;
                }
            }
        }
    }
    let name = file.strip_prefix(folder).expect("a file of the folder");
    Row {
        file: name.to_string_lossy().into_owned(),
        counts: format!("{links} | {joints} | {free} | {kept}"),
        result: result.trim_end().to_owned(),
    }
}

fn remarks(import: &Import) -> String {
    let mut remarks = Vec::new();
    let couplings = import.declaration.matches("coupling(").count();
    if couplings > 0 {
        remarks.push(format!("{couplings} couplings"));
    }
    if !import.names.is_empty() {
        remarks.push(format!("{} names changed", import.names.len()));
    }
    let driven = import.notes.iter().filter(|note| matches!(note, Note::Driven { .. })).count();
    if driven > 0 {
        remarks.push(format!("{driven} without mass driven at 0"));
    }
    match remarks.as_slice() {
        [] => String::new(),
        remarks => format!(": {}", remarks.join(", ")),
    }
}

#[test]
fn the_table_says_what_happens() {
    let Some((folder, _)) = package_or_skip("the table of robots") else {
        return;
    };
    let mut table = HEAD.to_owned();
    table += "| file | links | joints | free | resisted | result |\n| --- | ---: | ---: | ---: | ---: | --- |\n";
    for file in urdf_files(&folder) {
        let Row { file, counts, result } = row(&folder, &file);
        let _ = writeln!(table, "| {file} | {counts} | {result} |");
    }
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../macros/urdf/ROBOTS.md");
    if env::var_os("UPDATE_ROBOTS").is_some() {
        fs::write(&page, &table).expect("the page can be written");
    }
    assert_eq!(read(&page), table, "UPDATE_ROBOTS=1 writes the table anew");
}
