//! Every result of every machine survives writing and reading, bit for bit. Every public type of the runtime can be
//! written, and the schema names every kind of document.

#[path = "serial/answers.rs"]
mod answers;
#[path = "serial/kinds.rs"]
mod kinds;
#[path = "serial/types.rs"]
mod types;
