//! A starter project.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::failure::Failure;
use crate::place::print;
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
        let name = name.filter(|name| is_package(name)).ok_or_else(|| {
            let message = format!("`{}` is not a valid package name", self.folder.display());
            let help = "a name has letters, digits, `-` and `_`, and starts with a letter";
            Failure::usage(message, help)
        })?;
        let version = env!("CARGO_PKG_VERSION");
        let dependency = match &self.path {
            None => format!("\"{version}\""),
            Some(path) => {
                let path = fs::canonicalize(path).map_err(|source| Failure::read(path, source))?;
                format!(
                    "{{ version = \"{version}\", path = {:?} }}",
                    path.display().to_string()
                )
            }
        };
        let manifest = MANIFEST
            .replace("NAME", name)
            .replace("DEPENDENCY", &dependency);
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
            io::ErrorKind::AlreadyExists => Failure::Exists {
                exists: folder.display().to_string(),
            },
            _ => Failure::write(folder, source),
        })
    }
}

fn is_package(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_alphabetic())
        && (name.chars()).all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_')
}
