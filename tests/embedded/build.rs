//! Writes the generated text of many declarations to one file, as a user's build script would.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::{env, fs};

use eigentol_build::try_compile_for_c;
use eigentol_compiler::compile;
use eigentol_compiler::mechanics::Limits;
use proc_macro2::{TokenStream, TokenTree};

/// Folders and files that declare mechanisms.
const SOURCES: [&str; 5] = ["src/smallest.rs", "../src/corpus", "../src/loops", "../src/machines", "../src/wheels"];

fn main() -> Result<(), Box<dyn Error>> {
    let mut text = String::new();
    for source in SOURCES {
        println!("cargo::rerun-if-changed={source}");
        for file in files(Path::new(source))? {
            for (k, declaration) in declarations(&file)?.into_iter().enumerate() {
                let items =
                    compile(declaration, Limits::default()).map_err(|mistakes| mistakes.to_string())?.emit_text();
                let folder = source.rsplit('/').next().unwrap_or_default();
                let name = file.file_stem().unwrap_or_default().to_string_lossy();
                let module = format!("{}_{name}_{k}", folder.trim_end_matches(".rs"));
                text += &format!("/// Of `{name}`.\npub mod {module} {{\n{items}\n}}\n");
            }
        }
    }
    let out = PathBuf::from(env::var("OUT_DIR")?);
    fs::write(out.join("mechanisms.rs"), text)?;
    for name in ["ball", "swing"] {
        let header = out.join(name).with_extension("h");
        try_compile_for_c(format!("mechanisms/{name}.mechanism"), header)?;
    }
    Ok(())
}

/// A file, or the files of a folder in order.
fn files(source: &Path) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    if source.is_file() {
        return Ok(vec![source.to_owned()]);
    }
    let mut files = Vec::new();
    for entry in fs::read_dir(source)? {
        files.push(entry?.path());
    }
    files.sort();
    Ok(files)
}

/// The contents of the braces after `mechanism!` and `machine!`.
fn declarations(file: &Path) -> Result<Vec<TokenStream>, Box<dyn Error>> {
    let tokens: TokenStream =
        fs::read_to_string(file)?.parse().map_err(|error| format!("{}: {error}", file.display()))?;
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let found = tokens.windows(3).filter_map(|three| match three {
        [TokenTree::Ident(name), TokenTree::Punct(_), TokenTree::Group(group)]
            if name == "mechanism" || name == "machine" =>
        {
            Some(group.stream())
        }
        _ => None,
    });
    Ok(found.collect())
}
