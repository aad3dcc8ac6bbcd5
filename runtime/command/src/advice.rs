//! Advice on errors that depends on what the machine is made of.

use std::sync::OnceLock;

use eigentol::kernels::PictureKernels as _;
use eigentol::{Error, Role};
use eigentol_compiler::Compilation;
use eigentol_interpreter::Interpreted;
use eigentol_tables::{Column, Table, Values};

/// Beams without `stretch` of the machine that the command is about, if its loops could hold them at both ends.
static INEXTENSIBLE: OnceLock<Vec<String>> = OnceLock::new();

/// How many of the first modes of that machine have coordinates enough by the rule, if it has beams.
static GOOD: OnceLock<Option<usize>> = OnceLock::new();

/// Where `check` says that it has no equilibrium.
static UNBALANCED: OnceLock<Option<String>> = OnceLock::new();

/// Remembers the machine.
pub(crate) fn remember(machine: &Interpreted, compilation: &Compilation) {
    let _ = UNBALANCED.set(compilation.functions.free.unbalanced.clone());
    let d = machine.description();
    let _ = GOOD.set(d.resolved_modes);
    let unknowns = || d.coordinates.iter();
    let stretches = |beam: &str| {
        unknowns().any(|item| {
            let rest = item.name.strip_prefix(beam);
            let rest = rest.filter(|rest| rest.starts_with('_'));
            // A load splits a beam into parts, which are numbered.
            let part = |c: char| c == '_' || c.is_ascii_digit();
            rest.is_some_and(|rest| rest.trim_start_matches(part).starts_with("stretch_"))
        })
    };
    let picture = machine.picture_info();
    let is_shaft = |name: &str| picture.joints.iter().any(|joint| &*joint.kind == "station" && &*joint.name == name);
    let beams = picture.beams.iter().map(|beam| beam.name.to_string()).filter(|name| !is_shaft(name));
    let closed = unknowns().any(|x| x.role == Role::PositionReaction);
    let inextensible = beams.filter(|beam| closed && !stretches(beam)).collect();
    let _ = INEXTENSIBLE.set(inextensible);
}

/// The last mode, counted from 1, that tables rest on: by their rows, by their columns, and at least one for a critical
/// value and for each peak.
pub(crate) fn last_mode(tables: &[Table]) -> usize {
    let by_rows = |table: &Table| match &table.column("mode")?.values {
        Values::Whole(modes) => usize::try_from(*modes.iter().flatten().max()?).ok(),
        _ => None,
    };
    let by_columns = |table: &Table| {
        let filled = |column: &&Column| match &column.values {
            Values::Numbers(values) => values.iter().any(Option::is_some),
            _ => false,
        };
        let filled = table.columns.iter().filter(filled);
        filled.filter_map(|column| column.name.strip_prefix("frequency ")?.parse().ok()).max()
    };
    let least = |table: &Table| match &*table.name {
        "critical states" | "special points" => Some(1),
        "peaks" => Some(table.rows()),
        _ => None,
    };
    tables.iter().flat_map(|x| [by_rows(x), by_columns(x), least(x)]).flatten().max().unwrap_or(0)
}

/// What to say of an answer that rests on modes up to `last`, if beams have fewer good ones.
pub(crate) fn on_beams(last: usize) -> Option<String> {
    let good = (*GOOD.get()?)?;
    let modes = if good == 1 { "mode" } else { "modes" };
    (last > good).then(|| {
        format!(
            "m modes of a plane of bending take 1.5 m + 2 coordinates: by this rule the beams have enough for {good} \
             {modes}; `eigentol converge` tells how far each mode changes with more, and with `--sweep` critical \
             values, onsets and peaks"
        )
    })
}

/// Whether the machine has beams, so that answers rest on the number of their coordinates.
pub(crate) fn has_beams() -> bool {
    matches!(GOOD.get(), Some(Some(_)))
}

/// A failure of that machine in words.
pub(crate) fn message(error: &Error) -> String {
    match (error, UNBALANCED.get()) {
        (Error::NoEquilibrium { .. }, Some(Some(why))) => format!("no equilibrium found: {why}"),
        _ => error.to_string(),
    }
}

/// Advice on a failure of that machine.
pub(crate) fn on(error: &Error) -> Option<String> {
    let beams = INEXTENSIBLE.get()?;
    let singular = matches!(
        error,
        Error::NotAssembled { .. }
            | Error::SingularConfiguration { .. }
            | Error::UnboundedReactions { .. }
            | Error::NoEquilibrium { .. }
    );
    let names = || beams.join("`, `");
    (singular && !beams.is_empty()).then(|| {
        format!(
            "a straight beam that is held at both ends needs coordinates of `stretch`, and `{}` has none: `stretch: 2`",
            names()
        )
    })
}
