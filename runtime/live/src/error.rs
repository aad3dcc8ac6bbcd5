//! What keeps a page from being served.

use std::io;

use thiserror::Error as ThisError;

/// An error of [`Server::start`](crate::Server::start).
#[derive(Debug, ThisError)]
#[non_exhaustive]
pub enum Error {
    /// The port cannot be had.
    #[error("cannot listen on port {port} of 127.0.0.1: {source}")]
    Listen {
        /// As asked for; 0 is any.
        port: u16,
        /// The cause.
        source: io::Error,
    },
    /// The system gives no random numbers for the token.
    #[error("the system gives no random numbers: {0}")]
    Random(getrandom::Error),
}
