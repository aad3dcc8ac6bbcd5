#![doc = include_str!("../README.md")]

mod answer;
mod charts;
mod content;
mod error;
mod forced;
mod html;
mod page;
mod part;
mod pictures;
mod report;
mod scene;
mod sections;
mod tables;
mod words;

pub use eigentol_figures::Style;
pub use error::Error;
pub use page::frame;
pub use part::{Part, Section};
pub use report::{Report, motion};
