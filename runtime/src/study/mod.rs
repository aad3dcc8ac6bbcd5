//! The front door of the library: a mechanism, its operating point, and the questions to ask about it.

// The documentation of `Study` shows its methods in the order of these modules: `Study::new` first.
mod at_point;
#[cfg(feature = "analysis")]
mod beyond_first_order;
mod builder;
mod cache;
#[cfg_attr(not(feature = "analysis"), allow(dead_code, reason = "questions of the feature use the rest"))]
mod deviating;
#[cfg(feature = "analysis")]
mod events;
#[cfg(feature = "analysis")]
mod forced;
#[cfg(feature = "analysis")]
mod over_input;
mod parameter;
#[cfg(feature = "analysis")]
mod propagation;
#[cfg(feature = "analysis")]
mod requirements;
#[cfg_attr(not(feature = "analysis"), allow(dead_code, reason = "questions of the feature use the rest"))]
mod settings;
mod value;
mod variation;
mod watcher;

pub use builder::Study;
pub use parameter::Parameter;
pub use value::{InDeclaredUnit, Value};
