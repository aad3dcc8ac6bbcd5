//! Serialisation of numbers and words in results, for any format.
//!
//! JSON has no infinite numbers. In human-readable formats they are written as the words `Infinity`, `-Infinity` and
//! `NaN`, which Python's `float` and JavaScript's `Number` can read.

mod number;
pub mod word;

pub use number::{Exact, Number};

/// Numbers that may be infinite: `#[serde(with = "exact")]`.
pub mod exact {
    use super::Exact;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    /// # Errors
    /// Those of the format.
    pub fn serialize<T: Exact, S: Serializer>(value: &T, to: S) -> Result<S::Ok, S::Error> {
        value.written().serialize(to)
    }

    /// # Errors
    /// Those of the format.
    pub fn deserialize<'de, T: Exact, D: Deserializer<'de>>(from: D) -> Result<T, D::Error> {
        T::Written::deserialize(from).map(T::read)
    }
}
