#![doc = include_str!("../README.md")]

mod answer;
mod charts;
mod content;
mod error;
mod forced;
mod html;
mod page;
mod pictures;
mod report;
mod scene;
mod sections;
mod tables;
mod words;

pub use eigentol_figures::Style;
pub use error::Error;
pub use page::frame;
pub use report::{Part, Report, Section, motion};
