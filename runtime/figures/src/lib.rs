#![doc = include_str!("../README.md")]

pub mod figure;

pub use figure::Figure;
