//! What a user sees: the messages of rustc on wrong declarations and on wrong uses of right ones. The diagnostics themselves
//! are tested in `tests/diagnostics.rs`; here they have gone through the macro.
//!
//! The texts follow rustc; `TRYBUILD=overwrite cargo test -p eigentol-compile-errors` writes them anew.

#[test]
fn messages() {
    trybuild::TestCases::new().compile_fail("cases/*.rs");
}
