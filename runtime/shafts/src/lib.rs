#![doc = include_str!("../README.md")]

mod assembly;
mod basis;
mod chain;
mod element;
mod error;
mod gradients;
mod krylov;
mod modes;
mod motion;
mod number;
mod parts;
mod pencil;
mod section;
mod span;
mod varied;

pub use assembly::{Assembly, At, Condensed};
pub use eigentol_numerics::{Complex, Matrix};
pub use error::Error;
pub use gradients::{Form, SpanForm};
pub use modes::{Found, Mode};
pub use motion::Motion;
pub use parts::Others;
pub use pencil::Pencil;
pub use section::{Line, Number, Section};
pub use span::{Place, Span};
pub use varied::{Changes, LUMPED, Second, Varied, lumped};
