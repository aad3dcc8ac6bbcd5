//! Typed indices: a node can never be looked up with the number of a symbol.

/// Defines an index type and the accessors that every table needs.
#[doc(hidden)]
#[macro_export]
macro_rules! id {
    ($($(#[$doc:meta])* $name:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(pub u32);

        impl $name {
            /// The id of entry `index` of its table.
            #[inline]
            pub fn new(index: usize) -> Self {
                Self(u32::try_from(index).expect("a table has fewer than 2^32 entries"))
            }

            /// Position in its table.
            #[inline]
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    )*};
}

id! {
    /// A node of the expression graph.
    ExprId;
    /// A symbol of the expression graph.
    SymbolId;
}
