//! Rows that are written as they are computed.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};
use std::thread::sleep;
use std::time::Duration;

use eigentol_tables::{Table, Values, csv, json, parquet};

use crate::interrupt::{interrupt, listens, works_for};
use crate::program::{answer, command, folder, pendulum, run, swept};

const ROTOR: &str = "jeffcott_rotor.mechanism";
const SPEEDS: [&str; 4] = ["--sweep", "speed=2000..4000rpm", "--points", "20"];
const SAMPLES: [&str; 4] = ["--tol", "l=10%", "--samples", "700"];

fn table_of_file(path: &Path) -> Table {
    parquet::read(fs::File::open(path).unwrap()).unwrap()
}

/// The table of a JSON document, which is written once all results are known.
pub(crate) fn documented(arguments: &[&str], name: &str) -> Table {
    let text = answer(&[arguments, &["--json"]].concat());
    let tables = json::read_tables(text.as_bytes()).unwrap();
    tables.into_iter().find(|table| table.name == name).unwrap()
}

/// The streamed rows of a question match those of its document, as CSV and as Parquet.
#[track_caller]
fn streams_what_is_documented(arguments: &[&str], streamed: &[&str], name: &str) {
    let whole = documented(arguments, name);
    let text = answer(&[streamed, &["--csv", "--table", name]].concat());
    assert!(text == csv::to_string(&whole).unwrap(), "{name}: other rows");
    let path = folder(&format!("streamed {name}")).join("rows.parquet");
    let file = path.display().to_string();
    assert_eq!(answer(&[streamed, &["--table", name, "--output", &file]].concat()), "");
    assert!(table_of_file(&path) == whole, "{name}: other rows");
    assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
}

#[test]
fn samples_are_those_that_are_kept_otherwise() {
    let streamed = pendulum("sample", &SAMPLES);
    let kept = [&streamed[..], &["--keep"]].concat();
    streams_what_is_documented(&kept, &streamed, "samples");
}

#[test]
fn diagrams_and_branches_are_those_of_documents() {
    let diagram = [&["campbell", ROTOR], &SPEEDS[..]].concat();
    streams_what_is_documented(&diagram, &diagram, "Campbell diagram");
    let branches = ["branches", "rotating_pendulum.mechanism", "--sweep", "omega=0..8 rad/s"];
    streams_what_is_documented(&branches, &branches, "branches");
}

/// There are columns for every motion that may occur.
#[test]
fn sweeps_are_those_of_documents() {
    let sweep = [&["sweep", ROTOR], &SPEEDS[..]].concat();
    let whole = documented(&sweep, "sweep");
    let text = answer(&[&sweep[..], &["--csv"]].concat());
    let streamed = csv::read("sweep", text.as_bytes()).unwrap();
    assert_eq!(streamed.rows(), 20);
    for column in &whole.columns {
        let own = streamed.column(&column.name).unwrap();
        match (&own.values, &column.values) {
            // A text column with no text reads back as a column without numbers.
            (Values::Numbers(numbers), Values::Texts(_)) => {
                assert!(numbers.iter().all(Option::is_none))
            }
            (values, other) => assert_eq!(values, other, "{}", column.name),
        }
    }
    assert!(answer(&sweep).starts_with("JeffcottRotor"));
}

/// A part that already exists comes first, and the numbers identify the samples.
#[test]
fn resumed_samples_are_written_too() {
    let folder = folder("resumed rows");
    let half = folder.join("half.json").display().to_string();
    let arguments = pendulum("sample", &SAMPLES);
    answer(&[&arguments[..], &["--keep", "--shard", "1/2", "-o", &half]].concat());
    let rows = ["--resume", &half, "--csv", "--table", "samples"];
    let rows = answer(&[&arguments[..], &rows].concat());
    let whole = answer(&[&arguments[..], &["--csv", "--table", "samples"]].concat());
    assert!(rows == whole, "other rows");
}

#[test]
fn forms_follow_from_the_ending_of_a_file() {
    let folder = folder("endings");
    let written = |name: &str, more: &[&str]| {
        let path = folder.join(name);
        let file = path.display().to_string();
        answer(&pendulum("modes", &[&["-o", &file], more].concat()));
        fs::read(path).unwrap()
    };
    let printed = |form: &str| answer(&pendulum("modes", &[form])).into_bytes();
    assert_eq!(written("a.json", &[]), printed("--json"));
    assert_eq!(written("a.csv", &[]), printed("--csv"));
    assert_eq!(written("a.parquet", &[]), written("b.txt", &["--parquet"]));
    // An explicit option takes precedence.
    assert_eq!(written("b.csv", &["--json"]), printed("--json"));
    let modes = table_of_file(&folder.join("a.parquet"));
    let text = printed("--csv");
    assert_eq!(csv::to_string(&modes).unwrap().into_bytes(), text);
}

#[test]
fn one_table_is_of_csv_and_parquet() {
    for form in [&[][..], &["--json"]] {
        let run = run(&pendulum("modes", &[&["--table", "modes"], form].concat()));
        assert_eq!(run.code, 2);
        assert!(run.err.contains("add `--csv` or `--parquet`"), "{}", run.err);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_reported_while_rows_come() {
    let rows = ["--csv", "--table", "samples", "-o", "/dev/full"];
    let run = run(&pendulum("sample", &rows));
    assert_eq!(
        (run.code, run.err.as_str()),
        (3, "error: cannot write `/dev/full`: No space left on device (os error 28)\n")
    );
}

#[test]
fn nobody_has_to_read_all_rows() {
    let mut rows = command(&pendulum("sample", &["--csv", "--table", "samples"]));
    let mut child = (rows.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn()).unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), output.stderr), (Some(0), Vec::new()));
}

/// A run far longer than a test, writing its rows to the file of this name.
struct Endless {
    child: Child,
    path: PathBuf,
}

impl Endless {
    fn campbell(name: &str) -> Self {
        let path = folder(&format!("endless {name}")).join(name);
        fs::write(&path, "old").unwrap();
        let file = path.display().to_string();
        let sweep = ["--sweep", "omega=4..8 rad/s", "--points", "5000000", "-o", &file];
        let mut command = command(&swept("campbell", &sweep));
        let child = command.stderr(Stdio::piped()).spawn().unwrap();
        listens(&child);
        let begun = Self { child, path };
        begun.until(|sizes| sizes.len() == 2);
        begun
    }

    /// Waits for a condition on the sizes of the old and the new file.
    fn until(&self, wanted: impl Fn(&[u64]) -> bool) {
        for _ in 0..2400 {
            let files = fs::read_dir(self.path.parent().unwrap()).unwrap();
            let sizes = files.map(|file| file.unwrap().metadata().map_or(0, |x| x.len()));
            if wanted(&sizes.collect::<Vec<u64>>()) {
                return;
            }
            sleep(Duration::from_millis(50));
        }
        panic!("not after two minutes");
    }

    /// Waits until this many bytes are written beside the existing file.
    fn grows_to(&self, bytes: u64) {
        self.until(|sizes| sizes.iter().any(|size| *size >= bytes));
    }

    /// Its peak memory, in kB.
    #[cfg(target_os = "linux")]
    fn most_memory(&self) -> u64 {
        let status = fs::read_to_string(format!("/proc/{}/status", self.child.id())).unwrap();
        let most = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let most = most.unwrap().trim().trim_end_matches("kB");
        most.trim().parse().unwrap()
    }

    /// Sends Ctrl-C; returns the file and the number of finished values reported.
    fn interrupted(self) -> (PathBuf, usize) {
        interrupt(&self.child);
        let output = self.child.wait_with_output().unwrap();
        let err = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(130), "{err}");
        let done = err.strip_prefix("stopped: after ").and_then(|x| x.split_once(' '));
        let (done, rest) = done.unwrap_or_else(|| panic!("{err}"));
        assert_eq!(rest.trim(), "of 5000000 values");
        assert_eq!(fs::read_dir(self.path.parent().unwrap()).unwrap().count(), 1);
        (self.path, done.parse().unwrap())
    }
}

/// The old file stays until then; the new one is complete and contains all finished rows.
#[test]
fn ctrl_c_leaves_a_csv_file_with_what_is_done() {
    let endless = Endless::campbell("rows.csv");
    endless.grows_to(50_000);
    assert_eq!(fs::read_to_string(&endless.path).unwrap(), "old");
    let (path, done) = endless.interrupted();
    let table = csv::read("rows", fs::File::open(path).unwrap()).unwrap();
    assert!(done > 0 && table.rows() == done, "{done} {}", table.rows());
}

#[test]
fn ctrl_c_leaves_a_parquet_file_with_what_is_done() {
    let endless = Endless::campbell("rows.parquet");
    works_for(&endless.child, 0.5);
    let (path, done) = endless.interrupted();
    assert_eq!(table_of_file(&path).rows(), done);
}

/// A point takes some kilobytes: if they were kept, ten thousand would show.
#[cfg(target_os = "linux")]
#[test]
fn memory_does_not_grow_with_the_rows() {
    let endless = Endless::campbell("long.csv");
    endless.grows_to(200_000);
    let early = endless.most_memory();
    endless.grows_to(2_000_000);
    let late = endless.most_memory();
    let (path, done) = endless.interrupted();
    assert!(fs::metadata(path).unwrap().len() >= 2_000_000 && done > 10_000);
    assert!(late < early + 4096, "{early} kB, later {late} kB");
}
