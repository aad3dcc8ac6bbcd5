//! A starter project.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::destination::print;
use crate::failure::Failure;
use crate::verdict::Verdict;

const MANIFEST: &str = include_str!("../../starter/manifest.toml");
const PROGRAM: &str = include_str!("../../starter/program.rs");
const DECLARATION: &str = include_str!("../../starter/pendulum.mechanism");

/// Start a Rust project: a mechanism, a program that studies it, and a manifest
#[derive(Args, Debug)]
pub(crate) struct New {
    /// Folder to create; the package takes its name
    folder: PathBuf,
    /// Folder of the crate `eigentol` to build against, instead of the published one
    #[arg(long, value_name = "FOLDER")]
    path: Option<PathBuf>,
}

impl New {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        let name = self.folder.file_name().and_then(|name| name.to_str());
        let refused = |help: &str| {
            let message = format!("`{}` is not a valid package name", self.folder.display());
            Failure::usage(message, help)
        };
        let name = name
            .filter(|name| is_package(name))
            .ok_or_else(|| refused("a name has letters, digits, `-` and `_`, and starts with a letter"))?;
        if let Some(why) = reserved(name) {
            return Err(refused(&format!("{why}; choose another, such as `{name}-study`")));
        }
        let version = env!("CARGO_PKG_VERSION");
        let dependency = match &self.path {
            None => format!("\"{version}\""),
            Some(path) => {
                let path = fs::canonicalize(path).map_err(|source| Failure::read(path, source))?;
                format!("{{ version = \"{version}\", path = {:?} }}", path.display().to_string())
            }
        };
        let manifest = MANIFEST.replace("NAME", name).replace("DEPENDENCY", &dependency);
        let files = [
            ("Cargo.toml", manifest.as_str()),
            ("src/main.rs", PROGRAM),
            ("pendulum.mechanism", DECLARATION),
            (".gitignore", "/target\n"),
        ];
        self.create(&self.folder)?;
        self.create(&self.folder.join("src"))?;
        for (file, content) in files {
            let path = self.folder.join(file);
            fs::write(&path, content).map_err(|source| Failure::write(&path, source))?;
        }
        let folder = self.folder.display();
        print(&format!("created `{folder}`: go there and `cargo run`\n"))?;
        Ok(Verdict::Yes)
    }

    fn create(&self, folder: &Path) -> Result<(), Failure> {
        fs::create_dir(folder).map_err(|source| match source.kind() {
            io::ErrorKind::AlreadyExists => Failure::Exists { exists: folder.display().to_string() },
            _ => Failure::write(folder, source),
        })
    }
}

/// Why cargo or the library reserves a name.
fn reserved(name: &str) -> Option<&'static str> {
    let lower = name.to_ascii_lowercase();
    if FOLDERS.contains(&lower.as_str()) {
        Some("cargo keeps this name for a folder of its own")
    } else if KEYWORDS.contains(&name) {
        Some("the name is a keyword of Rust")
    } else if LIBRARIES.contains(&name.replace('-', "_").as_str()) {
        Some("a library has this name")
    } else if DEVICES.contains(&lower.as_str()) {
        Some("Windows keeps this name for a device")
    } else {
        None
    }
}

/// The names that `cargo new` refuses or warns of (`restricted_names.rs` of cargo).
const FOLDERS: [&str; 4] = ["build", "deps", "examples", "incremental"];
const KEYWORDS: [&str; 51] = [
    "Self", "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do", "dyn",
    "else", "enum", "extern", "false", "final", "fn", "for", "if", "impl", "in", "let", "loop", "macro", "match",
    "mod", "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static", "struct", "super", "trait",
    "true", "try", "type", "typeof", "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];
const LIBRARIES: [&str; 6] = ["alloc", "core", "eigentol", "proc_macro", "std", "test"];
const DEVICES: [&str; 22] = [
    "aux", "com1", "com2", "com3", "com4", "com5", "com6", "com7", "com8", "com9", "con", "lpt1", "lpt2", "lpt3",
    "lpt4", "lpt5", "lpt6", "lpt7", "lpt8", "lpt9", "nul", "prn",
];

fn is_package(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_alphabetic())
        && (name.chars()).all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_')
}
