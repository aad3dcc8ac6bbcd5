//! Times rustc on generated code: a user package in its own workspace, rebuilt repeatedly with different sources.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::clock::Children;
use crate::machines::{Extent, Machine};

/// Profile settings of a user's manifest: none, the lines that the README recommends, and all macro-related packages
/// optimised.
const SETTINGS: [(&str, &str); 3] = [
    ("default", ""),
    (
        "compiler",
        "[profile.dev.package.eigentol-compiler]\nopt-level = 3\n\
         [profile.dev.package.eigentol-symbolic]\nopt-level = 3\n\
         [profile.release.package.eigentol-compiler]\nopt-level = 3\n\
         [profile.release.package.eigentol-symbolic]\nopt-level = 3\n",
    ),
    (
        "build-override",
        "[profile.dev.build-override]\nopt-level = 3\n[profile.release.build-override]\nopt-level = 3\n",
    ),
];

const PROFILES: [&str; 2] = ["dev", "release"];

/// Which kernels the source calls.
const CALLS: [&str; 3] = ["nothing", "one", "all"];

/// Processor time of one build, in seconds.
pub(crate) struct Build {
    /// The declaration, or the stage built before any declaration.
    pub(crate) machine: String,
    pub(crate) settings: &'static str,
    pub(crate) profile: &'static str,
    pub(crate) calls: &'static str,
    pub(crate) seconds: f64,
}

/// Builds everything in packages under the folder.
///
/// # Errors
/// When a package cannot be written or does not build.
pub(crate) fn measure(folder: &Path, machines: &[Machine]) -> Result<Vec<Build>, Box<dyn Error>> {
    let mut builds = Vec::new();
    for (settings, lines) in SETTINGS {
        let package = Package::new(&folder.join(settings), lines)?;
        for profile in PROFILES {
            let mut add = |machine: &str, calls, source: &str| -> Result<(), Box<dyn Error>> {
                let seconds = package.build(profile, source)?;
                builds.push(Build { machine: machine.to_owned(), settings, profile, calls, seconds });
                Ok(())
            };
            add("dependencies", "nothing", "fn main() {}")?;
            add("empty program", "nothing", "fn main() { }")?;
            for machine in machines {
                for calls in calls(settings, profile, machine.extent) {
                    add(&machine.name, calls, &source(machine, calls))?;
                }
            }
        }
    }
    Ok(builds)
}

/// All cases for the README's settings; for the others only what the macro adds, which is the same in both profiles.
fn calls(settings: &str, profile: &str, extent: Extent) -> &'static [&'static str] {
    match extent {
        Extent::Expanded => &[],
        Extent::Called if settings == "compiler" => &CALLS,
        _ if profile == "dev" => &CALLS[..1],
        _ => &[],
    }
}

/// A program that declares a mechanism and calls some of its kernels, each for `f64`.
fn source(machine: &Machine, calls: &str) -> String {
    let Machine { kind, text, .. } = machine;
    let call = match calls {
        "nothing" => String::new(),
        _ => format!("{calls}({kind});"),
    };
    let uses = include_str!("uses.rs");
    format!("{uses}\nmechanism! {{ {text} }}\n\nfn main() {{ {call} }}\n")
}

/// A user package with the solvers: with the standard library, each `f64` kernel is compiled for two instruction sets.
struct Package {
    folder: PathBuf,
}

impl Package {
    /// Writes a new package with the given profile settings.
    fn new(folder: &Path, profiles: &str) -> Result<Self, Box<dyn Error>> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        if folder.exists() {
            fs::remove_dir_all(folder)?;
        }
        fs::create_dir_all(folder.join("src"))?;
        let manifest = format!(
            "[package]\nname = \"user\"\nedition = \"2024\"\n\n[dependencies.eigentol]\n\
             path = {:?}\n\n[workspace]\n\n{profiles}",
            root.join("runtime")
        );
        fs::write(folder.join("Cargo.toml"), manifest)?;
        fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock"))?;
        Ok(Self { folder: folder.to_owned() })
    }

    /// Processor time of a build of the package with this source, in seconds.
    fn build(&self, profile: &str, source: &str) -> Result<f64, Box<dyn Error>> {
        fs::write(self.folder.join("src/main.rs"), source)?;
        let clock = Children::start();
        let status = Command::new(env!("CARGO"))
            .args(["build", "--quiet", "--profile", profile, "--target-dir", "target"])
            .current_dir(&self.folder)
            .env_remove("CARGO_TARGET_DIR")
            .env("CARGO_INCREMENTAL", "0")
            .status()?;
        match status.success() {
            true => Ok(clock.seconds()),
            false => Err(format!("{} does not build", self.folder.display()).into()),
        }
    }
}
