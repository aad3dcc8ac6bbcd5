//! The messages that a user sees from rustc for wrong declarations and for wrong uses of correct ones. The diagnostics
//! themselves are tested in `tests/tests/language/diagnostics.rs`; here they have passed through the macro.
//!
//! The texts depend on the rustc version; `TRYBUILD=overwrite cargo test -p eigentol-compile-errors` regenerates them.

#[test]
fn messages() {
    trybuild::TestCases::new().compile_fail("cases/*.rs");
}
