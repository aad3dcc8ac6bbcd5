//! The front door of the library: a mechanism, its operating point, and the questions to ask about it.

// The documentation of `Study` shows its methods in the order of these modules: `Study::new` first.
mod at_point;
mod builder;
mod cache;
mod deviating;
mod events;
mod over_input;
mod parameter;
mod propagation;
mod requirements;
mod settings;
mod value;
mod variation;
mod watcher;

pub use builder::Study;
pub use parameter::Parameter;
pub use value::{InDeclaredUnit, Value};
