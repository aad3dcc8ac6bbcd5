//! What a declaration may say, and what the compiler answers where it may not.

mod declarations;
mod diagnostics;
mod hostile_names;
mod library;
mod links;
mod models;
mod parts;
mod units_of_measure;
mod urdf;
mod words;
