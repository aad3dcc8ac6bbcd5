//! The benchmark suite: eigentol against its strongest peers. `tests/benches/README.md` explains how to run and read
//! it.

mod arm;
mod casadi;
mod chains;
mod corpus;
mod counting;
#[path = "../chain.rs"]
mod declaration;
mod facts;
mod growth;
mod interpreted;
mod lanes;
mod operations;
mod pendulum;
mod report;
mod rotor;
mod samples;
mod timing;
mod tools;
mod work;

use std::env;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use criterion::Criterion;

use report::{Growth, Report, Row};
use tools::{Target, Tools};
use work::{Task, difference};

/// A C compiler takes minutes for its peer, so it is compiled only once and its instructions are not counted.
const SLOW_TO_COMPILE: &str = "chain16/all";

fn main() -> Result<(), Box<dyn Error>> {
    let folder = results_folder();
    fs::create_dir_all(&folder)?;
    let wanted = |name: &str| filter().is_none_or(|part| name.contains(&part));
    if counting::counted() {
        let mut tools = Tools::new(&folder, Target::Counted);
        let quick = |name: &str| wanted(name) && name != SLOW_TO_COMPILE;
        counting::run(tasks(&quick, &mut tools)?);
        return Ok(());
    }

    let mut tools = Tools::new(&folder, Target::Native);
    let mut criterion = timing::criterion().output_directory(&folder.join("criterion"));
    let mut rows = Vec::new();
    for task in tasks(&wanted, &mut tools)? {
        rows.push(measure(&mut criterion, task)?);
    }
    let growth = growth::kernels().into_iter();
    let growth = growth.filter(|grown| wanted(&grown.name()));
    let growth = growth.map(|mut grown| Growth {
        kernel: grown.kernel,
        bars: grown.bars,
        operations: grown.operations,
        bytes: grown.bytes,
        time: timing::time(&mut criterion, &grown.name(), 1, &mut *grown.work),
    });
    let growth = growth.collect();
    criterion.final_summary();

    let operations = match wanted("operations") {
        true => operations::count(&mut tools)?,
        false => Vec::new(),
    };
    let mut singles = tools::setting();
    if wanted(facts::PENDULUM) {
        singles.extend(facts::pendulum());
    }
    if wanted(samples::SAMPLES) {
        singles.extend(samples::samples());
    }
    if wanted(rotor::ROTOR) {
        singles.extend(rotor::rotor());
    }
    if wanted(facts::LONG_CHAIN) {
        singles.extend(facts::long_chain());
    }
    let report = Report { counts: counting::count(&folder), rows, operations, growth, facts: singles };
    report.write(&folder)?;
    println!("{}", report.table());
    println!("written to {}", folder.display());
    Ok(())
}

/// Every task that has a peer.
fn tasks(wanted: &dyn Fn(&str) -> bool, tools: &mut Tools) -> Result<Vec<Task>, Box<dyn Error>> {
    let mut tasks = pendulum::tasks(wanted, tools)?;
    tasks.extend(arm::tasks(wanted, tools));
    tasks.extend(chains::tasks(wanted, tools));
    tasks.extend(lanes::tasks(wanted, tools));
    tasks.extend(interpreted::tasks(wanted));
    Ok(tasks)
}

/// Compares the results of both sides, then times them.
fn measure(criterion: &mut Criterion, mut task: Task) -> Result<Row, String> {
    let name = task.name;
    let mut worst = None;
    if let Ok(peer) = &mut task.peer {
        for state in 0..peer.states() {
            let value = difference(&task.ours.results(state), &peer.results(state))
                .map_err(|reason| format!("{name}: {reason}"))?;
            if value > task.agreement {
                return Err(format!("{name}: results differ by {value:e}"));
            }
            worst = Some(value.max(worst.unwrap_or(0.0)));
        }
    }
    let id = |side: &str| format!("{name} {side}");
    let [our_units, peer_units] = task.units;
    let ours = timing::time(criterion, &id("eigentol"), our_units, &mut *task.ours);
    let (peer, absent) = match &mut task.peer {
        Ok(peer) => (timing::time(criterion, &id("peer"), peer_units, &mut **peer), None),
        Err(reason) => (None, Some(reason.clone())),
    };
    Ok(Row { name, ours, peer, absent, difference: worst })
}

/// `target/eigentol-bench`.
fn results_folder() -> PathBuf {
    let scratch = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let target = scratch.parent().unwrap_or(scratch);
    target.join("eigentol-bench")
}

/// Criterion's filter: the first argument that is not an option.
fn filter() -> Option<String> {
    env::args().skip(1).find(|argument| !argument.starts_with('-'))
}
