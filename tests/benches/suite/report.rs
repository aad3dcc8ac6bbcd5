//! The result file and the table.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::counting::Counts;
use crate::operations::Operations;

/// Measurements of one task.
pub(crate) struct Row {
    pub(crate) name: String,
    /// Nanoseconds per unit; `None` if the filter excluded it.
    pub(crate) ours: Option<f64>,
    pub(crate) peer: Option<f64>,
    /// Why there is no peer.
    pub(crate) absent: Option<String>,
    /// Largest relative difference of the results.
    pub(crate) difference: Option<f64>,
}

/// Growth measurements of one kernel.
pub(crate) struct Growth {
    pub(crate) kernel: &'static str,
    pub(crate) bars: usize,
    pub(crate) operations: usize,
    pub(crate) bytes: usize,
    pub(crate) time: Option<f64>,
}

/// All measurements.
pub(crate) struct Report {
    pub(crate) rows: Vec<Row>,
    pub(crate) counts: Result<Counts, String>,
    pub(crate) operations: Vec<Operations>,
    pub(crate) growth: Vec<Growth>,
    /// Single facts: name and value.
    pub(crate) facts: Vec<(String, String)>,
}

impl Report {
    /// Writes `results.json` and `results.md` to the folder.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub(crate) fn write(&self, folder: &Path) -> std::io::Result<()> {
        fs::write(folder.join("results.json"), format!("{:#}\n", self.json()))?;
        fs::write(folder.join("results.md"), self.table())
    }

    fn json(&self) -> Value {
        let rows = self.rows.iter().map(|row| {
            let [ours, peer] = self.counted(&row.name);
            json!({
                "task": row.name,
                "nanoseconds": { "eigentol": row.ours, "peer": row.peer },
                "instructions": { "eigentol": ours, "peer": peer },
                "peer_absent": row.absent,
                "difference": row.difference,
            })
        });
        let operations = self.operations.iter().map(|row| {
            json!({
                "set": row.set, "eigentol": row.ours, "signs": row.signs,
                "casadi_typed": row.typed, "casadi_energies": row.energies,
            })
        });
        let growth = self.growth.iter().map(|row| {
            json!({
                "kernel": row.kernel, "bars": row.bars, "operations": row.operations,
                "bytes": row.bytes, "nanoseconds": row.time,
            })
        });
        json!({
            "times": rows.collect::<Vec<_>>(),
            "operations": operations.collect::<Vec<_>>(),
            "growth": growth.collect::<Vec<_>>(),
            "facts": self.facts.iter().cloned().collect::<std::collections::BTreeMap<_, _>>(),
            "instructions_absent": self.counts.as_ref().err(),
        })
    }

    fn counted(&self, name: &str) -> [Option<f64>; 2] {
        let counts = self.counts.as_ref().ok();
        counts.and_then(|counts| counts.get(name)).copied().unwrap_or_default()
    }

    /// The table as Markdown.
    pub(crate) fn table(&self) -> String {
        let mut text = String::new();
        if !self.rows.is_empty() {
            text += "| task | eigentol ns | peer ns | ratio | instructions | peer | ratio |\n";
            text += "| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n";
        }
        for row in &self.rows {
            let [ours, peer] = self.counted(&row.name);
            let absent = row.absent.as_ref().map(|_| "peer absent".to_owned());
            let _ = writeln!(
                text,
                "| {} | {} | {} | {} | {} | {} | {} |",
                row.name,
                number(row.ours),
                absent.unwrap_or_else(|| number(row.peer)),
                ratio(row.ours, row.peer),
                number(ours),
                number(peer),
                ratio(ours, peer),
            );
        }
        if !self.operations.is_empty() {
            text += "\n| operations | eigentol | of them signs | CasADi | ratio | CasADi, energies |\n";
            text += "| --- | ---: | ---: | ---: | ---: | ---: |\n";
        }
        for row in &self.operations {
            let count = |count: Option<u64>| count.map_or("-".to_owned(), |x| x.to_string());
            let _ = writeln!(
                text,
                "| {} | {} | {} | {} | {} | {} |",
                row.set,
                row.ours,
                row.signs,
                count(row.typed),
                ratio(Some(row.ours as f64), row.typed.map(|x| x as f64)),
                count(row.energies),
            );
        }
        if !self.growth.is_empty() {
            text += "\n| kernel | bars | operations | bytes of text, both kernels | ns | ns per bar |\n";
            text += "| --- | ---: | ---: | ---: | ---: | ---: |\n";
        }
        for row in &self.growth {
            let _ = writeln!(
                text,
                "| {} | {} | {} | {} | {} | {} |",
                row.kernel,
                row.bars,
                row.operations,
                row.bytes,
                number(row.time),
                number(row.time.map(|time| time / row.bars as f64)),
            );
        }
        if !self.facts.is_empty() {
            text += "\n| fact | value |\n| --- | ---: |\n";
        }
        for (name, value) in &self.facts {
            let _ = writeln!(text, "| {name} | {value} |");
        }
        text
    }
}

fn number(value: Option<f64>) -> String {
    match value {
        None => "-".to_owned(),
        Some(value) if value < 100.0 => format!("{value:.1}"),
        Some(value) => format!("{value:.0}"),
    }
}

fn ratio(ours: Option<f64>, peer: Option<f64>) -> String {
    match (ours, peer) {
        (Some(ours), Some(peer)) => format!("{:.2}", ours / peer),
        _ => "-".to_owned(),
    }
}
