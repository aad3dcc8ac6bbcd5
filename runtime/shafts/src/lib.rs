#![doc = include_str!("../README.md")]

mod assembly;
mod basis;
mod chain;
mod element;
mod error;
mod modes;
mod section;

pub use assembly::{Assembly, At, Motion, Place, Span, SpanGradient};
pub use eigentol_numerics::{Complex, Matrix};
pub use error::Error;
pub use modes::Mode;
pub use section::{Line, Number, Section};
