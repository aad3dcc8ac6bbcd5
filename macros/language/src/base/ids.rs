//! Typed indices: a body can never be looked up with the number of a joint.

eigentol_symbolic::id! {
    /// An input.
    InputId;
    /// A design variable.
    DesignId;
    /// A named constant (`let`).
    ConstantId;
    /// A body; the ground has none.
    BodyId;
    /// A beam.
    BeamId;
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
}
