//! Every result of every machine survives writing and reading, bit for bit. Every public type of the runtime can be
//! written.

#[path = "serial/answers.rs"]
mod answers;
#[path = "serial/types.rs"]
mod types;
