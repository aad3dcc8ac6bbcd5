//! Numbers are serialised as their bits, because many readers of decimal text lose the last one.

pub(super) mod one {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(in crate::summary) fn serialize<S: Serializer>(value: &f64, to: S) -> Result<S::Ok, S::Error> {
        value.to_bits().serialize(to)
    }

    pub(in crate::summary) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
        u64::deserialize(from).map(f64::from_bits)
    }
}

pub(super) mod two {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(in crate::summary) fn serialize<S: Serializer>(values: &[f64; 2], to: S) -> Result<S::Ok, S::Error> {
        values.map(f64::to_bits).serialize(to)
    }

    pub(in crate::summary) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<[f64; 2], D::Error> {
        <[u64; 2]>::deserialize(from).map(|bits| bits.map(f64::from_bits))
    }
}

pub(super) mod many {
    use serde::{Deserialize, Deserializer, Serializer};

    pub(in crate::summary) fn serialize<S: Serializer>(values: &[f64], to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(values.iter().map(|value| value.to_bits()))
    }

    pub(in crate::summary) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
        Ok(Vec::<u64>::deserialize(from)?.into_iter().map(f64::from_bits).collect())
    }
}
