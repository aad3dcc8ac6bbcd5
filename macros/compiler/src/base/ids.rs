//! Typed indices: a body can never be looked up with the number of a joint.

/// Defines an index type and the accessors that every table needs.
macro_rules! id {
    ($($(#[$doc:meta])* $name:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(pub u32);

        impl $name {
            /// The id of entry `index` of its table.
            pub fn new(index: usize) -> Self {
                Self(u32::try_from(index).expect("a table has fewer than 2^32 entries"))
            }

            /// Position in its table.
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    )*};
}

id! {
    /// An input.
    InputId;
    /// A design variable.
    DesignId;
    /// A named constant (`let`).
    ConstantId;
    /// A body; the ground has none.
    BodyId;
    /// A joint.
    JointId;
    /// A joint coordinate, free, driven or coasting, in order of declaration.
    CoordinateId;
    /// A named point.
    PointId;
    /// A force element.
    ForceId;
    /// A constraint.
    ConstraintId;
    /// An output.
    OutputId;
    /// A node of the expression graph.
    ExprId;
    /// A symbol of the expression graph.
    SymbolId;
}
