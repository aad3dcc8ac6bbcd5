//! The table and the result file.

use std::fmt::Write;

use serde_json::{Value, json};

use crate::builds::Build;
use crate::expansion::{Expansion, STAGES};

/// All measurements.
pub(crate) struct Report {
    pub(crate) expansions: Vec<Expansion>,
    pub(crate) builds: Vec<Build>,
}

impl Report {
    pub(crate) fn json(&self) -> Value {
        let expansions = self.expansions.iter().map(|expansion| {
            json!({
                "machine": expansion.name,
                "instructions": expansion.instructions,
                "bytes": expansion.bytes,
                "milliseconds": expansion.milliseconds(),
                "stages": STAGES.iter().zip(expansion.stages).collect::<Vec<_>>(),
            })
        });
        let builds = self.builds.iter().map(|build| {
            json!({
                "machine": build.machine,
                "settings": build.settings,
                "profile": build.profile,
                "calls": build.calls,
                "seconds": build.seconds,
            })
        });
        json!({
            "expansions": expansions.collect::<Vec<_>>(),
            "builds": builds.collect::<Vec<_>>(),
        })
    }

    pub(crate) fn table(&self) -> String {
        let mut text = String::from("| expansion | instructions | bytes |");
        for stage in STAGES {
            let _ = write!(text, " {stage} |");
        }
        text += " milliseconds |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n";
        for expansion in &self.expansions {
            let Expansion { name, instructions, bytes, stages } = expansion;
            let _ = write!(text, "| {name} | {instructions} | {bytes} |");
            for stage in stages {
                let _ = write!(text, " {stage:.2} |");
            }
            let _ = writeln!(text, " {:.1} |", expansion.milliseconds());
        }
        text += "\n| build | settings | profile | calls | seconds |\n| --- | --- | --- | --- | --- |\n";
        for build in &self.builds {
            let Build { machine, settings, profile, calls, seconds } = build;
            let _ = writeln!(text, "| {machine} | {settings} | {profile} | {calls} | {seconds:.1} |");
        }
        text
    }
}
