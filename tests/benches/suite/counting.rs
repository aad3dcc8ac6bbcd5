//! Counts instructions with valgrind: the suite runs itself again under callgrind, which writes one profile per task.

use std::collections::BTreeMap;
use std::env;
use std::fs;
use std::hint::black_box;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::work::{Task, Work};

/// Set in the run under valgrind.
const VARIABLE: &str = "EIGENTOL_BENCH_COUNTED";

/// Whether this is the run under valgrind.
pub(crate) fn counted() -> bool {
    env::var_os(VARIABLE).is_some()
}

/// Instructions per unit: ours, and the peer's.
pub(crate) type Counts = BTreeMap<String, [Option<f64>; 2]>;

/// The symbol that callgrind watches: it resets its counters on entry and writes them out on return.
#[inline(never)]
#[allow(unsafe_code)]
// SAFETY: no other symbol of the program has this name.
#[unsafe(no_mangle)]
fn eigentol_bench_counted(work: &mut dyn Work) {
    work.run(work.inputs() as u64);
    // Prevents a tail call: callgrind has to see the return.
    black_box(());
}

/// In the run under valgrind: prints the name of every task and runs it once over all inputs.
pub(crate) fn run(tasks: Vec<Task>) {
    for mut task in tasks {
        task.ours.run(1);
        eigentol_bench_counted(&mut *task.ours);
        println!("{} 0 {}", task.name, task.ours.inputs() * task.units[0]);
        if let Ok(peer) = &mut task.peer {
            peer.run(1);
            eigentol_bench_counted(&mut **peer);
            println!("{} 1 {}", task.name, peer.inputs() * task.units[1]);
        }
    }
}

/// Counts the instructions of all tasks selected by the program's arguments.
///
/// # Errors
/// When valgrind is missing or fails.
pub(crate) fn count(folder: &Path) -> Result<Counts, String> {
    let program = env::current_exe().map_err(|error| error.to_string())?;
    let profiles = folder.join("callgrind");
    fs::remove_dir_all(&profiles).ok();
    fs::create_dir_all(&profiles).map_err(|error| error.to_string())?;
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--quiet"])
        .arg("--zero-before=eigentol_bench_counted")
        .arg("--dump-after=eigentol_bench_counted")
        .arg(format!("--callgrind-out-file={}", profiles.join("out").display()))
        .arg(program)
        .args(env::args_os().skip(1))
        .env(VARIABLE, "1")
        .stderr(Stdio::inherit())
        .output()
        .map_err(|error| format!("valgrind: {error}"))?;
    if !output.status.success() {
        return Err(format!("valgrind: {}", output.status));
    }
    let mut counts = Counts::new();
    for (index, line) in String::from_utf8_lossy(&output.stdout).lines().enumerate() {
        let [name, side, runs] = line.split(' ').collect::<Vec<_>>()[..] else {
            return Err(format!("unexpected line {line}"));
        };
        let total = total(&profiles.join(format!("out.{}", index + 1)))?;
        let (side, runs): (usize, f64) = match (side.parse(), runs.parse()) {
            (Ok(side), Ok(runs)) => (side, runs),
            _ => return Err(format!("unexpected line {line}")),
        };
        counts.entry(name.to_owned()).or_default()[side] = Some(total / runs);
    }
    Ok(counts)
}

/// The total of a profile, from its line `summary: N`.
fn total(profile: &Path) -> Result<f64, String> {
    let text = fs::read_to_string(profile).map_err(|error| format!("{}: {error}", profile.display()))?;
    text.lines()
        .find_map(|line| line.strip_prefix("summary: "))
        .and_then(|number| number.trim().parse().ok())
        .ok_or_else(|| format!("no summary in {}", profile.display()))
}
