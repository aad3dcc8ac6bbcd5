//! Probabilities of meeting requirements, and design points, as text and tables.

mod chances;
mod probabilities;
mod rare;
mod reliability;
mod second_order;
mod words;
