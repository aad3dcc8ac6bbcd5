//! Build cost: the macro's stages, and rustc on the generated code. `tests/benches/README.md` explains the results.

mod builds;
mod clock;
#[path = "../chain.rs"]
mod declaration;
mod expansion;
mod machines;
mod report;

use std::env;
use std::error::Error;
use std::fs;
use std::path::Path;

use report::Report;

fn main() -> Result<(), Box<dyn Error>> {
    let scratch = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let folder = scratch.parent().unwrap_or(scratch).join("eigentol-bench");
    fs::create_dir_all(&folder)?;
    let machines = machines::all();
    let expansions = expansion::measure(&machines)?;
    let builds = match env::args().any(|argument| argument == "expansion") {
        true => Vec::new(),
        false => builds::measure(&folder.join("build_cost"), &machines)?,
    };
    let report = Report { expansions, builds };
    let table = report.table();
    print!("{table}");
    fs::write(folder.join("build_cost.md"), table)?;
    fs::write(folder.join("build_cost.json"), format!("{:#}\n", report.json()))?;
    Ok(())
}
