//! Names and lists that are constants of generated code or belong to a mechanism read at run time.
//!
//! # Names are shared
//!
//! A `Description` is a constant of generated code, or owned by a mechanism read at run time. `Shared` is either a
//! `'static` reference or a counted one; without the standard library only the first exists.

use core::fmt;
use core::ops::Deref;
#[cfg(feature = "std")]
use std::sync::Arc;

/// A value that lives as long as the program or its last owner; cheap to clone. Dereferences to the value.
pub enum Shared<T: ?Sized + 'static> {
    /// A constant.
    Static(&'static T),
    /// Created at run time.
    #[cfg(feature = "std")]
    Counted(Arc<T>),
}

/// A name or a unit.
pub type Text = Shared<str>;
/// A list of descriptions.
pub type List<T> = Shared<[T]>;

impl<T: ?Sized> Clone for Shared<T> {
    fn clone(&self) -> Self {
        match self {
            Self::Static(value) => Self::Static(value),
            #[cfg(feature = "std")]
            Self::Counted(value) => Self::Counted(value.clone()),
        }
    }
}

impl<T: ?Sized> Deref for Shared<T> {
    type Target = T;

    fn deref(&self) -> &T {
        match self {
            Self::Static(value) => value,
            #[cfg(feature = "std")]
            Self::Counted(value) => value,
        }
    }
}

impl<T: ?Sized + fmt::Debug> fmt::Debug for Shared<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        (**self).fmt(f)
    }
}

impl<T: ?Sized + fmt::Display> fmt::Display for Shared<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        (**self).fmt(f)
    }
}

impl<T: ?Sized + PartialEq> PartialEq for Shared<T> {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl<T: ?Sized + Eq> Eq for Shared<T> {}

impl PartialEq<str> for Text {
    fn eq(&self, other: &str) -> bool {
        **self == *other
    }
}

impl PartialEq<&str> for Text {
    fn eq(&self, other: &&str) -> bool {
        **self == **other
    }
}

impl<T: ?Sized> From<&'static T> for Shared<T> {
    fn from(value: &'static T) -> Self {
        Self::Static(value)
    }
}

#[cfg(feature = "std")]
impl<T> From<T> for Shared<T> {
    fn from(value: T) -> Self {
        Self::Counted(value.into())
    }
}

#[cfg(feature = "std")]
impl From<String> for Text {
    fn from(value: String) -> Self {
        Self::Counted(value.into())
    }
}

#[cfg(feature = "std")]
impl<T> From<Vec<T>> for List<T> {
    fn from(values: Vec<T>) -> Self {
        Self::Counted(values.into())
    }
}
