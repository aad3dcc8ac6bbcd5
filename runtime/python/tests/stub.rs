//! `eigentol.pyi` says what the Rust source of the module says: names, arguments, types and docstrings. `UPDATE_STUB=1`
//! writes it anew.

mod stub {
    pub(crate) mod classes;
    pub(crate) mod macros;
    pub(crate) mod source;
    pub(crate) mod text;
    pub(crate) mod types;
}

use std::fs;
use std::path::Path;

use stub::source::Source;

#[test]
fn the_stub_is_that_of_the_source() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let source = Source::read(&folder.join("src"));
    let text = stub::text::stub(&source);
    let file = folder.join("eigentol.pyi");
    if std::env::var_os("UPDATE_STUB").is_some() {
        fs::write(&file, &text).expect("the stub is written");
    }
    let now = fs::read_to_string(&file).unwrap_or_default();
    let differs = now.lines().zip(text.lines()).position(|(a, b)| a != b);
    let line = differs.unwrap_or_else(|| now.lines().count().min(text.lines().count()));
    assert!(
        now == text,
        "UPDATE_STUB=1 writes eigentol.pyi anew; it differs from the source in line {}: {:?}",
        line + 1,
        text.lines().nth(line),
    );
}
