//! Handles: declared names as constants of the mechanism's type.

use core::fmt;
use core::marker::PhantomData;

/// Stands for the mechanism in a handle that no longer says which one it belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Any {}

macro_rules! handle {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        ///
        /// It belongs to mechanism `M` and is not accepted by any other.
        pub struct $name<M = Any> {
            index: usize,
            mechanism: PhantomData<fn() -> M>,
        }

        impl<M> $name<M> {
            /// The handle for this position.
            pub const fn new(index: usize) -> Self {
                Self { index, mechanism: PhantomData }
            }

            /// Its position in lists of values.
            pub const fn index(self) -> usize {
                self.index
            }

            /// The same handle without its mechanism type.
            pub const fn any(self) -> $name {
                $name::new(self.index)
            }
        }

        impl<M> Clone for $name<M> {
            fn clone(&self) -> Self {
                *self
            }
        }

        impl<M> Copy for $name<M> {}

        impl<M> PartialEq for $name<M> {
            fn eq(&self, other: &Self) -> bool {
                self.index == other.index
            }
        }

        impl<M> Eq for $name<M> {}

        impl<M> fmt::Debug for $name<M> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.debug_tuple(stringify!($name)).field(&self.index).finish()
            }
        }
    };
}

handle! {
    /// A free coordinate, or a speed that is an unknown.
    Coordinate
}
handle! {
    /// An input.
    Input
}
handle! {
    /// A design variable.
    DesignVariable
}
handle! {
    /// An output.
    Output
}
handle! {
    /// A harmonic excitation.
    Excitation
}
