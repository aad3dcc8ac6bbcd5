//! Errors that are answers.

use eigentol::Error;

/// Separates errors of the caller from refusals of an analysis, which are answers.
pub(crate) fn answer<T>(outcome: Result<T, Error>) -> Result<Result<T, Error>, Error> {
    match outcome {
        Err(
            mistake @ (Error::Setting { .. }
            | Error::NotFinite { .. }
            | Error::WrongLength { .. }
            | Error::UnknownHandle { .. }
            | Error::Threads(_)),
        ) => Err(mistake),
        outcome => Ok(outcome),
    }
}
