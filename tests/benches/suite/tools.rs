//! The tools of the peers: a Python with CasADi, a C compiler and a C++ compiler. A missing tool is reported as a
//! reason, not a failure.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// What peers are compiled for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Target {
    /// This machine, for timing.
    Native,
    /// AVX2 and FMA without AVX-512, which valgrind does not support.
    Counted,
}

/// Where peers are kept between runs, and the tools that build them.
pub(crate) struct Tools {
    folder: PathBuf,
    target: Target,
    python: Result<PathBuf, String>,
}

impl Tools {
    /// Finds the tools; build products are kept in `folder`.
    pub(crate) fn new(folder: &Path, target: Target) -> Self {
        Self { folder: folder.to_owned(), target, python: Err("not looked for".to_owned()) }
    }

    /// Runs a script from the folder `peers` in a Python that has CasADi.
    pub(crate) fn casadi(&mut self, script: &str, arguments: &[&str]) -> Result<String, String> {
        if self.python.is_err() {
            self.python = interpreter(&self.folder);
        }
        let python = self.python.as_ref().map_err(Clone::clone)?;
        let output = Command::new(python)
            .arg(source(script))
            .args(arguments)
            .stderr(Stdio::inherit())
            .output()
            .map_err(|error| format!("{}: {error}", python.display()))?;
        match output.status.success() {
            true => Ok(String::from_utf8_lossy(&output.stdout).into_owned()),
            false => Err(format!("{script} failed")),
        }
    }

    /// The folder for sources that a script writes.
    pub(crate) fn written(&self) -> Result<PathBuf, String> {
        let folder = self.folder.join("peers");
        fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        Ok(folder)
    }

    /// Compiles one file to a shared library, unless an up-to-date one exists.
    pub(crate) fn library(&self, source: &Path) -> Result<PathBuf, String> {
        let architecture = match self.target {
            Target::Native => "native",
            Target::Counted => "x86-64-v3",
        };
        self.library_for(architecture, &[], source)
    }

    /// Compiles C that CasADi generated with vectors of eight numbers in place of its numbers: for this machine, or with vectors
    /// of four for what has our vectors of four.
    pub(crate) fn eight_wide(&self, c: &Path, lanes: &str) -> Result<PathBuf, String> {
        let header = source("eight.hpp");
        let name = c.file_stem().unwrap_or_default().to_string_lossy();
        let file = c.with_file_name(format!("{name}_eight.cpp"));
        if !newer(&file, c) || !newer(&file, &header) {
            let text = format!("#include {header:?}\n#include {c:?}\n");
            fs::write(&file, text).map_err(|error| format!("{}: {error}", file.display()))?;
        }
        let architecture = if lanes == "lanes4" { "x86-64-v3" } else { "native" };
        self.library_for(architecture, &["-lmvec"], &file)
    }

    fn library_for(&self, architecture: &str, flags: &[&str], source: &Path) -> Result<PathBuf, String> {
        let cpp = source.extension().is_some_and(|name| name == "cpp");
        let (variable, default) = if cpp { ("CXX", "c++") } else { ("CC", "cc") };
        let compiler = env::var(variable).unwrap_or_else(|_| default.to_owned());
        let name = source.file_stem().unwrap_or_default().to_string_lossy();
        let library = self.written()?.join(format!("{name}-{architecture}.so"));
        if newer(&library, source) {
            return Ok(library);
        }
        eprintln!("compiling {} for {architecture}", source.display());
        let status = Command::new(&compiler)
            .args(["-O3", &format!("-march={architecture}"), "-shared", "-fPIC"])
            .arg(source)
            .arg("-o")
            .arg(&library)
            .args(flags)
            .arg("-lm")
            .status()
            .map_err(|error| format!("{compiler}: {error}"))?;
        match status.success() {
            true => Ok(library),
            false => Err(format!("{compiler} refused {}", source.display())),
        }
    }
}

/// Names and versions of the measurement setup, as far as they can be determined.
pub(crate) fn setting() -> Vec<(String, String)> {
    let version = |program: String| {
        let output = Command::new(program).arg("--version").output().ok()?;
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        text.lines().next().map(str::to_owned)
    };
    let named = |variable: &str, default: &str| version(env::var(variable).unwrap_or_else(|_| default.to_owned()));
    let processor = fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
        let line = text.lines().find(|line| line.starts_with("model name"))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    });
    let found = [
        ("processor", processor),
        ("C", named("CC", "cc")),
        ("C++", named("CXX", "c++")),
        ("Rust", named("RUSTC", "rustc")),
    ];
    let found = found.into_iter();
    found.map(|(name, value)| (name.to_owned(), value.unwrap_or_else(|| "-".to_owned()))).collect()
}

/// A file of the folder `peers`.
pub(crate) fn source(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("peers").join(name)
}

/// Whether `made` exists and is no older than `source`.
pub(crate) fn newer(made: &Path, source: &Path) -> bool {
    let time = |path: &Path| fs::metadata(path).and_then(|data| data.modified());
    matches!((time(made), time(source)), (Ok(made), Ok(source)) if made >= source)
}

/// The interpreter named by `EIGENTOL_BENCH_PYTHON`, or the interpreter of a virtual environment created here.
fn interpreter(folder: &Path) -> Result<PathBuf, String> {
    let named = env::var_os("EIGENTOL_BENCH_PYTHON").map(PathBuf::from);
    let environment = folder.join("venv");
    let python = named.unwrap_or_else(|| environment.join("bin/python"));
    if has_casadi(&python) {
        return Ok(python);
    }
    eprintln!("installing CasADi in {}", environment.display());
    let run = |program: &Path, arguments: &[&str]| {
        let status = Command::new(program).args(arguments).stdout(Stdio::null()).status();
        matches!(status, Ok(status) if status.success())
    };
    let place = environment.to_string_lossy();
    let python = environment.join("bin/python");
    let packages = ["-m", "pip", "install", "--quiet", "casadi==3.8.*", "numpy"];
    if !run(Path::new("python3"), &["-m", "venv", &place]) {
        Err("no Python that makes virtual environments".to_owned())
    } else if !run(&python, &packages) || !has_casadi(&python) {
        Err("CasADi could not be installed".to_owned())
    } else {
        Ok(python)
    }
}

fn has_casadi(python: &Path) -> bool {
    let status = Command::new(python).args(["-c", "import casadi"]).stderr(Stdio::null()).status();
    matches!(status, Ok(status) if status.success())
}
