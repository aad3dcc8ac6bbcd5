//! What a build costs: the macro by stages, and rustc on what it generates. `tests/benches/README.md` says how to read it.

mod builds;
mod clock;
#[path = "../chain.rs"]
mod declaration;
mod expansion;
mod machines;
mod report;

use std::error::Error;
use std::fs;
use std::path::Path;

use report::Report;

fn main() -> Result<(), Box<dyn Error>> {
    let scratch = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let folder = scratch.parent().unwrap_or(scratch).join("eigentol-bench");
    fs::create_dir_all(&folder)?;
    let machines = machines::all();
    let report = Report {
        expansions: expansion::measure(&machines)?,
        builds: builds::measure(&folder.join("build_cost"), &machines)?,
    };
    let table = report.table();
    print!("{table}");
    fs::write(folder.join("build_cost.md"), table)?;
    fs::write(
        folder.join("build_cost.json"),
        format!("{:#}\n", report.json()),
    )?;
    Ok(())
}
