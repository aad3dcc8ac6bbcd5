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

/// Types that are checked when they are read: they derive serde's traits with `serde(remote = "Self")` and have a method
/// `checked(self) -> Result<Self, &'static str>`.
#[macro_export]
macro_rules! checked {
    ($type:ty) => {
        impl serde::Serialize for $type {
            fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
                Self::serialize(self, to)
            }
        }

        impl<'de> serde::Deserialize<'de> for $type {
            fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
                Self::deserialize(from)?.checked().map_err(serde::de::Error::custom)
            }
        }
    };
}
