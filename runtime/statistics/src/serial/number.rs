//! Numbers that may be infinite.

use core::fmt;

use num_complex::Complex64;
use serde::de::{DeserializeOwned, Error, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A number in a form that every format can write.
#[derive(Clone, Copy, Debug)]
pub struct Number(pub f64);

/// A type composed of such numbers.
pub trait Exact: Sized {
    /// Its serialised form, which every format can write.
    type Written: Serialize + DeserializeOwned;

    /// Converts to the serialised form.
    fn written(&self) -> Self::Written;

    /// Converts from the serialised form.
    fn read(written: Self::Written) -> Self;
}

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        if self.0.is_finite() || !to.is_human_readable() {
            to.serialize_f64(self.0)
        } else if self.0.is_nan() {
            to.serialize_str("NaN")
        } else if self.0 > 0.0 {
            to.serialize_str("Infinity")
        } else {
            to.serialize_str("-Infinity")
        }
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        if from.is_human_readable() { from.deserialize_any(Any) } else { f64::deserialize(from).map(Self) }
    }
}

struct Any;

impl Visitor<'_> for Any {
    type Value = Number;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or `Infinity`, `-Infinity` or `NaN`")
    }

    fn visit_f64<E>(self, value: f64) -> Result<Number, E> {
        Ok(Number(value))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Number, E> {
        Ok(Number(value as f64))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Number, E> {
        Ok(Number(value as f64))
    }

    fn visit_str<E: Error>(self, word: &str) -> Result<Number, E> {
        match word {
            "Infinity" => Ok(Number(f64::INFINITY)),
            "-Infinity" => Ok(Number(f64::NEG_INFINITY)),
            "NaN" => Ok(Number(f64::NAN)),
            _ => Err(E::invalid_value(serde::de::Unexpected::Str(word), &self)),
        }
    }
}

impl Exact for f64 {
    type Written = Number;

    fn written(&self) -> Number {
        Number(*self)
    }

    fn read(written: Number) -> Self {
        written.0
    }
}

impl Exact for Complex64 {
    type Written = (Number, Number);

    fn written(&self) -> Self::Written {
        (Number(self.re), Number(self.im))
    }

    fn read((re, im): Self::Written) -> Self {
        Self::new(re.0, im.0)
    }
}

impl Exact for bool {
    type Written = Self;

    fn written(&self) -> Self {
        *self
    }

    fn read(written: Self) -> Self {
        written
    }
}

impl<T: Exact> Exact for Option<T> {
    type Written = Option<T::Written>;

    fn written(&self) -> Self::Written {
        self.as_ref().map(T::written)
    }

    fn read(written: Self::Written) -> Self {
        written.map(T::read)
    }
}

impl<T: Exact> Exact for Vec<T> {
    type Written = Vec<T::Written>;

    fn written(&self) -> Self::Written {
        self.iter().map(T::written).collect()
    }

    fn read(written: Self::Written) -> Self {
        written.into_iter().map(T::read).collect()
    }
}

impl<A: Exact, B: Exact> Exact for (A, B) {
    type Written = (A::Written, B::Written);

    fn written(&self) -> Self::Written {
        (self.0.written(), self.1.written())
    }

    fn read((a, b): Self::Written) -> Self {
        (A::read(a), B::read(b))
    }
}
