//! The header, by cbindgen.

use std::path::Path;

use cbindgen::{Builder, Config, Language};

use super::Interface;
use crate::error::Error;

impl Interface {
    /// The header of the functions, which cbindgen reads in a file.
    pub(crate) fn header(&self, declaration: &Path, functions: &Path) -> Result<String, Error> {
        let name = declaration.file_name().unwrap_or_default();
        let config = Config {
            language: Language::C,
            cpp_compat: true,
            no_includes: true,
            sys_includes: vec!["stdint.h".to_owned()],
            include_guard: Some(format!("{}_H", self.names.shouted)),
            header: Some(opening(&self.names.rust, &name.to_string_lossy())),
            ..Config::default()
        };
        let bindings = Builder::new()
            .with_config(config)
            .with_src(functions)
            .generate()
            .map_err(|reason| Error::Header {
                path: declaration.to_owned(),
                reason: reason.to_string(),
            })?;
        let mut text = Vec::new();
        bindings.write(&mut text);
        Ok(String::from_utf8_lossy(&text).into_owned())
    }
}

fn opening(name: &str, file: &str) -> String {
    format!(
        "/* Kernels of the mechanism {name}, generated from {file} by eigentol-build: do not edit.
 *
 * Numbers are SI, angles in radians. `q` are the unknowns, `u` the inputs, `b` the design variables; matrices are
 * stored row by row. Each array has to be at least as long as the comment of its function says; results may overlap
 * arguments, not each other.
 *
 * Functions return 0, or, without doing anything, the position, from 1, of the first argument that is a null pointer;
 * where an array has no entries null is allowed. They keep no state, allocate nothing and may be called from several
 * threads at once. Outside of the domain of the equations they give NaN or infinity.
 */"
    )
}
