//! The kernels of the runtime's contract by name.

macro_rules! kernel_names {
    ($($(#[doc = $text:literal])* $variant:ident $name:literal,)*) => {
        /// A kernel of the runtime's contract.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum KernelName {
            $($(#[doc = $text])* $variant,)*
        }

        impl KernelName {
            /// Name of the generated method.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }

            /// The kernel of a name.
            pub fn named(name: &str) -> Option<Self> {
                match name {
                    $($name => Some(Self::$variant),)*
                    _ => None,
                }
            }
        }
    };
}

kernel_names! {
    /// The residual at rest.
    Residual "residual",
    /// Its parts: inertia and applied forces.
    ResidualParts "residual_parts",
    /// The residual along any motion.
    MotionResidual "motion_residual",
    /// Mass matrix and force along any motion.
    Motion "motion",
    /// The residual at rest with its stiffness.
    ResidualAndStiffness "residual_and_stiffness",
    /// The three linearised matrices.
    Linear "linear",
    /// Derivatives of the residual by inputs and design variables.
    ResidualPartials "residual_partials",
    /// Gradient of the functional of an undamped mode.
    ModeGradient "mode_gradient",
    /// Gradient of a bilinear form of the three matrices.
    PencilGradient "pencil_gradient",
    /// Gradient of a weighted residual.
    ResidualGradient "residual_gradient",
    /// The outputs.
    Outputs "outputs",
    /// Derivatives of the outputs.
    OutputPartials "output_partials",
    /// The harmonic forces of the excitations.
    Forcing "forcing",
    /// Derivatives of the outputs by acceleration, velocity and position.
    OutputMotion "output_motion",
    /// Gradient of a weighted response without the matrices.
    ForcedGradient "forced_gradient",
    /// The three matrices linearised along any motion.
    MotionLinear "motion_linear",
    /// Derivatives of the three matrices.
    LinearPartials "linear_partials",
    /// The direction in which a vibration whirls.
    Whirl "whirl",
    /// Poses and shapes of the bodies.
    Picture "picture",
    /// The first physical requirement that is violated.
    Violation "violation",
    /// How far joints are from their singular poses.
    PoseMargin "pose_margin",
    /// Values of unknowns that select a steady motion.
    HeldValues "held_values",
    /// Speeds of the spans of shafts and numbers of their sections.
    Spans "spans",
}
