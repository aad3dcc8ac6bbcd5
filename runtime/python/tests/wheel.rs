//! Builds the wheel, installs it in a virtual environment under the target folder, and runs its tests there, if Python
//! is available.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The reason why the tests cannot be run.
struct Skipped(String);

fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The output of a command; if it cannot be started or fails, the error is the last line it wrote.
fn answer(command: &mut Command) -> Result<Output, String> {
    let output = command.output().map_err(|error| error.to_string())?;
    if output.status.success() {
        return Ok(output);
    }
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    let last = text.lines().rev().find(|line| !line.trim().is_empty());
    Err(last.unwrap_or("it failed without a word").to_owned())
}

/// A virtual environment with these packages; an existing one is reused.
struct Environment {
    folder: PathBuf,
}

impl Environment {
    fn new(name: &str, packages: &[&str]) -> Result<Self, Skipped> {
        let own = Self { folder: Path::new(env!("CARGO_TARGET_TMPDIR")).join(name) };
        if own.python().output().is_err() {
            let check = "import sys; sys.exit(sys.version_info < (3, 9))";
            answer(Command::new("python3").args(["-c", check]))
                .map_err(|_| Skipped("there is no Python 3.9 or later".to_owned()))?;
            let made = answer(Command::new("python3").args(["-m", "venv"]).arg(&own.folder));
            made.map_err(|why| Skipped(format!("no virtual environment can be made: {why}")))?;
        }
        own.install(packages).map_err(|why| Skipped(format!("{} cannot be installed: {why}", packages.join(", "))))?;
        Ok(own)
    }

    fn python(&self) -> Command {
        let program = if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" };
        Command::new(self.folder.join(program))
    }

    fn install(&self, what: &[&str]) -> Result<Output, String> {
        let pip = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"];
        answer(self.python().args(pip).args(["--retries", "0"]).args(what))
    }

    /// Builds the current wheel and installs it in place of any other.
    fn install_wheel(&self) {
        let wheels = self.folder.join("wheels");
        let _ = std::fs::remove_dir_all(&wheels);
        // Reuses the dependencies built by the Rust tests.
        let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent();
        let mut build = self.python();
        build
            .args(["-m", "maturin", "build", "--quiet", "--profile", "dev", "--out"])
            .arg(&wheels)
            .env("CARGO_TARGET_DIR", target.expect("the target folder"))
            .current_dir(folder());
        if let Err(why) = answer(&mut build) {
            panic!("the wheel cannot be built: {why}");
        }
        let wheel = std::fs::read_dir(&wheels).expect("a folder of wheels");
        let wheel = wheel.flatten().next().expect("a wheel").path();
        let wheel = wheel.to_str().expect("a path in Unicode");
        if let Err(why) = self.install(&["--force-reinstall", "--no-deps", wheel]) {
            panic!("the wheel cannot be installed: {why}");
        }
    }

    /// Runs tests and prints their reasons for skipping.
    fn test(&self, files: &[&str]) {
        let pytest = ["-m", "pytest", "-q", "-rs", "--tb=short", "-p", "no:cacheprovider"];
        let run = self
            .python()
            .args(pytest)
            .args(files)
            .env("PYTHONDONTWRITEBYTECODE", "1")
            .current_dir(folder().join("tests"))
            .output()
            .expect("pytest runs");
        let text = String::from_utf8_lossy(&run.stdout);
        print!("{text}");
        let errors = String::from_utf8_lossy(&run.stderr);
        // A third-party program may terminate the interpreter without a message.
        assert!(run.status.success() && text.contains(" passed"), "tests of Python fail:\n{text}\n{errors}");
    }
}

fn run(name: &str, packages: &[&str], files: &[&str]) {
    match Environment::new(name, packages) {
        Err(Skipped(why)) => println!("skipped, the Python module is not tested: {why}"),
        Ok(environment) => {
            environment.install_wheel();
            environment.test(files);
        }
    }
}

#[test]
#[ignore = "builds the module once more, and installs NumPy and SciPy"]
fn the_module_passes_its_tests() {
    let packages = ["maturin>=1.9.4,<2", "jsonschema", "numpy", "pytest", "scipy"];
    let files = [
        "test_beams.py",
        "test_documents.py",
        "test_equilibria.py",
        "test_forced.py",
        "test_kernels.py",
        "test_live.py",
        "test_mistakes.py",
        "test_motion.py",
        "test_parts.py",
        "test_pendulum.py",
        "test_report.py",
        "test_results.py",
        "test_rigid_rotor.py",
        "test_robots.py",
        "test_tables.py",
    ];
    run("python", &packages, &files);
}

/// PyTorch, which downloads gigabytes, is tested where the environment has it.
#[test]
#[ignore = "installs CasADi, FMPy, JAX, OpenMDAO and MuJoCo, and builds a shared library"]
fn the_module_works_inside_other_tools() {
    let tools = ["casadi", "fmpy", "jax", "openmdao", "mujoco", "gymnasium", "dm_control"];
    let packages = [&["maturin>=1.9.4,<2", "numpy", "pytest", "scipy"][..], &tools].concat();
    run("python-tools", &packages, &["test_mjcf.py", "test_shared_library.py", "test_tools.py"]);
}

/// Downloads hundreds of megabytes.
#[test]
#[ignore = "installs ROSS, OpenTURNS, Dask, mypy, pandas and polars"]
fn the_module_agrees_with_its_peers() {
    let packages = [
        "maturin>=1.9.4,<2",
        "numpy",
        "pytest",
        "scipy",
        "dask[distributed]",
        "openturns",
        "pandas",
        "polars",
        // ROSS 2 refers to a kind of figure that plotly 6 has removed.
        "plotly<6",
        "ross-rotordynamics>=2,<3",
        "example-robot-data",
        "mypy",
        "typing_extensions",
    ];
    run(
        "python-peers",
        &packages,
        &[
            "test_openturns.py",
            "test_peers.py",
            "test_parts.py",
            "test_rigid_rotor.py",
            "test_robots.py",
            "test_stubs.py",
        ],
    );
}
