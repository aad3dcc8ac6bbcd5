//! The commands in both READMEs and in the guide print the output shown there.

use std::fs;
use std::path::{Path, PathBuf};

use crate::program::{examples, folder};
use crate::walkthrough::{Part, UPDATE, parts, walked};

/// Chapters whose commands take seconds each: `.ci/thorough` runs them.
const SLOW: [&str; 2] = ["flexible_rotor", CHAPTER];
/// An example of which a chapter of the guide shows a part.
const CHAPTER: &str = "rotors";
const EXAMPLE: &str = "gas_turbine.mechanism";
/// What the example reads.
const BESIDE: [&str; 3] = ["gas_turbine_rotor.csv", "gas_turbine_casing_mass.mtx", "gas_turbine_casing_stiffness.mtx"];

fn crate_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

/// Compares a text with the output of its commands: the number of commands, and the first line that differs.
fn check(path: &Path, beside: &Path, at: &Path) -> (usize, Option<String>) {
    let text = fs::read_to_string(path).unwrap();
    let place = format!("{}/", at.display());
    let new = walked(&text.replace("/tmp/", &place), beside).replace(&place, "/tmp/");
    if std::env::var_os(UPDATE).is_some() {
        fs::write(path, &new).unwrap();
    }
    let commands = |part: Part<'_>| match part {
        Part::Console(text) => text.lines().filter(|line| line.starts_with("$ ")).count(),
        _ => 0,
    };
    let commands = parts(&text).into_iter().map(commands).sum();
    let changed = (text != new).then(|| {
        let mut lines = text.lines().zip(new.lines());
        let first = lines.position(|(old, new)| old != new);
        format!("{}, line {:?}", path.display(), first.map(|line| line + 1))
    });
    (commands, changed)
}

fn unchanged(changed: &[String]) {
    let help = "write what the commands print into";
    assert!(changed.is_empty(), "set {UPDATE}=1 to {help} {changed:#?}");
}

#[test]
fn the_readme_shows_what_commands_print() {
    let readme = crate_folder().join("README.md");
    let (commands, changed) = check(&readme, &examples(), &folder("readme"));
    unchanged(&changed.into_iter().collect::<Vec<_>>());
    assert!(commands >= 10, "{commands}");

    let root = crate_folder().join("../..");
    let (commands, changed) = check(&root.join("README.md"), &root, &folder("front"));
    unchanged(&changed.into_iter().collect::<Vec<_>>());
    assert!(commands >= 1);
}

#[test]
fn the_guide_shows_what_commands_print() {
    chapters_show_what_commands_print(|name| !SLOW.contains(&name));
}

#[test]
#[ignore = "a minute and a half"]
fn slow_chapters_of_the_guide_show_what_commands_print() {
    chapters_show_what_commands_print(|name| SLOW.contains(&name));
}

fn chapters_show_what_commands_print(chosen: impl Fn(&str) -> bool) {
    let chapters = crate_folder().join("../guide/src");
    let (mut commands, mut all) = (0, Vec::new());
    for entry in fs::read_dir(&chapters).unwrap() {
        let chapter = entry.unwrap().path();
        let name = chapter.file_stem().unwrap().to_string_lossy().into_owned();
        if chapter.extension().is_some_and(|extension| extension == "md") && chosen(&name) {
            let path = folder(&format!("guide_{name}"));
            if name == CHAPTER {
                for file in BESIDE.into_iter().chain([EXAMPLE]) {
                    fs::copy(examples().join(file), path.join(file)).unwrap();
                }
            }
            let (count, changed) = check(&chapter, &path, &path);
            commands += count;
            all.extend(changed);
        }
    }
    unchanged(&all);
    assert!(commands >= 10, "{commands}");
}

#[test]
fn the_guide_shows_lines_of_the_gas_turbine() {
    let chapter = fs::read_to_string(crate_folder().join(format!("../guide/src/{CHAPTER}.md"))).unwrap();
    let example = fs::read_to_string(examples().join(EXAMPLE)).unwrap();
    let (_, section) = chapter.split_once("\n# A rotor in a flexible casing\n").unwrap();
    let (_, block) = section.split_once("```text\n").unwrap();
    let (block, _) = block.split_once("```\n").unwrap();
    let declared: Vec<&str> = example.lines().collect();
    // Places that are left out are empty lines.
    let stretches: Vec<Vec<&str>> = block.trim_end().split("\n\n").map(|lines| lines.lines().collect()).collect();
    assert!(stretches.len() > 2, "{stretches:?}");
    for lines in stretches {
        assert!(declared.windows(lines.len()).any(|own| own == lines), "{lines:#?}");
    }
}
