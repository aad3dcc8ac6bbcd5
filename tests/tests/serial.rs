//! What is written comes back: every result of every machine, bit by bit. Every public type of the runtime can be written.

#[path = "serial/answers.rs"]
mod answers;
#[path = "serial/types.rs"]
mod types;
