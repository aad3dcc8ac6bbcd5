//! Every result of every machine survives writing and reading, bit for bit. Every public type of the runtime can be
//! written, and the schema names every kind of document.

mod answers;
mod kinds;
mod schema;
mod types;
