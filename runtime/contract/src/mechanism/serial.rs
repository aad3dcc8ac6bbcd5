//! Serialisation: shared values as plain values, handles as their positions.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{Coordinate, DesignVariable, Excitation, Input, List, Output, Shared, Text};

impl<T: Serialize + ?Sized> Serialize for Shared<T> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        (**self).serialize(to)
    }
}

impl<'de> Deserialize<'de> for Text {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        String::deserialize(from).map(Self::from)
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for List<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        Vec::deserialize(from).map(Self::from)
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Shared<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        T::deserialize(from).map(|value| Self::Counted(value.into()))
    }
}

macro_rules! handles {
    ($($name:ident),+) => {
        $(
            impl<M> Serialize for $name<M> {
                fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
                    self.index().serialize(to)
                }
            }

            impl<'de, M> Deserialize<'de> for $name<M> {
                fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
                    usize::deserialize(from).map(Self::new)
                }
            }
        )+
    };
}

handles!(Coordinate, Input, DesignVariable, Output, Excitation);
