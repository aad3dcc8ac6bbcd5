//! One file per subcommand.

pub(crate) mod allocate;
pub(crate) mod branches;
pub(crate) mod campbell;
pub(crate) mod check;
pub(crate) mod completions;
pub(crate) mod converge;
pub(crate) mod equilibria;
pub(crate) mod expand;
pub(crate) mod grade;
pub(crate) mod import;
#[cfg(feature = "man")]
pub(crate) mod man;
pub(crate) mod map;
pub(crate) mod merge;
pub(crate) mod mistuning;
pub(crate) mod modes;
pub(crate) mod new;
pub(crate) mod probability;
pub(crate) mod report;
pub(crate) mod response;
pub(crate) mod sample;
pub(crate) mod schema;
pub(crate) mod sensitivities;
pub(crate) mod serve;
pub(crate) mod sweep;
pub(crate) mod tolerance;
