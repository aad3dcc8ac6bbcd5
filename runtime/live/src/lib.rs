#![doc = include_str!("../README.md")]

mod answer;
mod controls;
mod error;
mod gate;
mod given;
mod machine;
mod server;
mod work;

pub use error::Error;
pub use machine::{Subject, compiled, read_file};
pub use server::Server;
