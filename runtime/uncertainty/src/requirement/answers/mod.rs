//! Probabilities of meeting requirements, and design points, as text and tables.

mod chances;
mod probabilities;
mod reliability;
mod words;
