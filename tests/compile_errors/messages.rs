//! The messages that a user sees from rustc for wrong declarations and for wrong uses of correct ones. The diagnostics
//! themselves are tested in `tests/tests/language/diagnostics.rs`; here they have passed through the macro.
//!
//! The texts depend on the rustc version; `TRYBUILD=overwrite cargo test -p eigentol-compile-errors` regenerates them.

use std::env;
use std::process::Command;

/// What the cases are built with: the macro is built for them once more, which takes half the time without debug
/// information and in one unit a crate.
const PROFILE: [(&str, &str); 2] =
    [("CARGO_PROFILE_DEV_DEBUG", "false"), ("CARGO_PROFILE_DEV_BUILD_OVERRIDE_CODEGEN_UNITS", "1")];

#[test]
fn messages() {
    if PROFILE.iter().all(|(name, _)| env::var_os(name).is_some()) {
        trybuild::TestCases::new().compile_fail("cases/*.rs");
        return;
    }
    // Cargo takes its profile from the environment, which only a new process can change safely.
    let mut again = Command::new(env::current_exe().expect("this program"));
    let output = again.args(["--exact", "messages", "--nocapture"]).envs(PROFILE).output().expect("it runs again");
    let texts = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    assert!(output.status.success() && texts[0].contains("1 passed"), "{}{}", texts[0], texts[1]);
}
