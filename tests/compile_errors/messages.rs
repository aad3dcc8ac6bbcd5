//! The messages that a user sees from rustc for wrong declarations and for wrong uses of correct ones. The diagnostics
//! themselves are tested in `tests/tests/language/diagnostics.rs`; here they have passed through the macro.
//!
//! The texts depend on the rustc version; `UPDATE_MESSAGES=1 cargo test -p eigentol-compile-errors` writes them again.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// Files of a folder that a condition holds for.
fn files(folder: &Path, wanted: impl Fn(&str) -> bool) -> Vec<PathBuf> {
    let all = fs::read_dir(folder).expect("a folder").map(|file| file.expect("a file").path());
    let mut files: Vec<_> = all.filter(|file| wanted(&file.file_name().expect("a name").to_string_lossy())).collect();
    files.sort();
    files
}

/// What rustc says, with the library that cargo has built for this test: the newest.
#[test]
fn messages() {
    let test = env::current_exe().expect("a path");
    let built = test.parent().expect("a folder");
    let libraries = files(built, |name| name.starts_with("libeigentol-") && name.ends_with(".rlib"));
    let age = |file: &PathBuf| fs::metadata(file).and_then(|file| file.modified()).expect("a time");
    let library = libraries.into_iter().max_by_key(age).expect("a library");
    let cases = files(Path::new("cases"), |name| name.ends_with(".rs"));
    assert!(cases.len() > 6, "{cases:?}");
    for case in cases {
        let output = Command::new("rustc")
            .args(["--edition=2024", "--emit=metadata", "--color=never", "-o"])
            .arg(Path::new(env!("CARGO_TARGET_TMPDIR")).join("case.rmeta"))
            .args(["--extern".into(), format!("eigentol={}", library.display())])
            .args(["-L".into(), format!("dependency={}", built.display())])
            .arg(&case)
            .output()
            .expect("rustc runs");
        assert!(!output.status.success(), "{} compiles", case.display());
        // With more features, another type of that name is known.
        let found = String::from_utf8(output.stderr).expect("text").replace("eigentol::Input<", "Input<");
        // Left out: how many there were and where to read about them, and lines of the library.
        let end = found.find("error: aborting due to").expect("the last line of errors");
        let own =
            found[..end].trim_end().lines().take_while(|line| !line.contains("--> ") || line.contains("--> cases/"));
        let (found, stored) = (own.flat_map(|line| [line, "\n"]).collect::<String>(), case.with_extension("stderr"));
        if env::var_os("UPDATE_MESSAGES").is_some() {
            fs::write(stored, found).expect("a file");
        } else {
            assert_eq!(found, fs::read_to_string(&stored).expect("a file"), "{}", stored.display());
        }
    }
}
