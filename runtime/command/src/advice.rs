//! Advice on errors that depends on what the machine is made of.

use std::sync::OnceLock;

use eigentol::kernels::PictureKernels as _;
use eigentol::{Error, Role};
use eigentol_compiler::Compilation;
use eigentol_interpreter::Interpreted;

/// Beams without `stretch` of the machine that the command is about, if its loops could hold them at both ends.
static INEXTENSIBLE: OnceLock<Vec<String>> = OnceLock::new();

/// Where `check` says that it has no equilibrium.
static UNBALANCED: OnceLock<Option<String>> = OnceLock::new();

/// Remembers the machine.
pub(crate) fn remember(machine: &Interpreted, compilation: &Compilation) {
    let _ = UNBALANCED.set(compilation.functions.free.unbalanced.clone());
    let d = eigentol::kernels::Kernels::description(machine);
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
    let beams = picture.beams.iter().map(|beam| beam.name.to_string());
    let closed = unknowns().any(|x| x.role == Role::PositionReaction);
    let inextensible = beams.filter(|beam| closed && !stretches(beam)).collect();
    let _ = INEXTENSIBLE.set(inextensible);
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
