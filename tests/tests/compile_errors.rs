//! What a user sees: the messages of rustc on wrong declarations and on wrong uses of right ones. The diagnostics themselves
//! are tested in `diagnostics.rs`; here they have gone through the macro.
//!
//! The texts follow rustc; `TRYBUILD=overwrite cargo test -p eigentol-tests --test compile_errors` writes them anew.

#[test]
fn messages() {
    trybuild::TestCases::new().compile_fail("compile_errors/*.rs");
}
