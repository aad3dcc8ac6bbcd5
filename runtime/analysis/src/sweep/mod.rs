//! Studies along an input: equilibria and modes at successive values, and where they become critical, resonant or
//! unstable.

mod answers;
mod condition;
mod critical;
mod crossing;
mod driver;
mod event_sensitivity;
mod event_tolerance;
mod points;
mod range;
mod search;
mod sensitivity_sweep;
#[expect(clippy::module_inception, reason = "the question that gives the room its name")]
mod sweep;
mod track;

pub use answers::sweep_table;
pub(crate) use answers::{event_columns, meeting, unresolved};
pub use condition::{Change, Condition, Crossing, Line};
pub use critical::critical_state;
pub(crate) use crossing::first_crossing;
pub use crossing::{crossings, events, flutter_onsets};
pub(crate) use event_sensitivity::{Crossed, bordered};
pub use event_sensitivity::{critical_sensitivity, crossing_sensitivity};
pub use event_tolerance::{Event, EventTolerance, critical_tolerance, crossing_tolerance};
pub use points::{CriticalState, Sweep, SweepPoint};
pub use range::Range;
pub use search::{Events, Gap, Searched, Unresolved};
pub(crate) use search::{Sought, growing};
pub use sensitivity_sweep::sensitivity_sweep;
#[doc(hidden)]
pub use sensitivity_sweep::states_each;
pub(crate) use sweep::between;
pub use sweep::{sweep, sweep_each};
pub use track::Following;
pub(crate) use track::Tracker;
