//! Kernels as data: the name of each, its arguments, its results.
//!
//! Each table of kernels has one method that evaluates any of its kernels over lists of numbers; a wrapper of a table, an
//! interpreter or a counter is one function, and a new kernel one row here. Only kernels of inner loops have methods of
//! their own as well, where they keep numbers in registers.

/// What a list of numbers has one of for each, or its length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Unknowns.
    Coordinates,
    /// Inputs.
    Inputs,
    /// Design variables.
    Design,
    /// Outputs.
    Outputs,
    /// Excitations.
    Excitations,
    /// A number of entries.
    Fixed(usize),
}

use Extent::{Coordinates, Design, Excitations, Fixed, Inputs, Outputs};

const ONE: Extent = Fixed(1);

/// Rows and columns of a result, which is written row by row.
pub type Shape = [Extent; 2];

const VECTOR: Shape = [Coordinates, ONE];
const SQUARE: Shape = [Coordinates, Coordinates];
const GRADIENT: &[Shape] = &[[ONE, Coordinates], [ONE, Inputs], [ONE, Design]];

macro_rules! kernels {
    ($($(#[doc = $about:literal])* $table:ident {
        $($(#[doc = $text:literal])* $variant:ident: $name:literal, [$($argument:expr),*] -> $results:expr;)*
    })*) => {$(
        $(#[doc = $about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $table {
            $($(#[doc = $text])* $variant,)*
        }

        impl $table {
            /// All of them, in order.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];

            /// Name of the method of [`Mechanism`](eigentol_contract::Mechanism).
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }

            /// What each argument has a number for. Inputs and design variables follow each other.
            #[must_use]
            pub const fn arguments(self) -> &'static [Extent] {
                match self {
                    $(Self::$variant => &[$($argument),*],)*
                }
            }

            /// The shape of each result.
            #[must_use]
            pub const fn results(self) -> &'static [Shape] {
                match self {
                    $(Self::$variant => $results,)*
                }
            }
        }
    )*};
}

kernels! {
    /// Kernels of one state of rest.
    Kernel {
        /// The residual.
        Residual: "residual", [Coordinates, Inputs, Design] -> &[VECTOR];
        /// Inertia and applied forces.
        ResidualParts: "residual_parts", [Coordinates, Inputs, Design] -> &[VECTOR, VECTOR];
        /// The residual and `Khat`.
        ResidualAndStiffness: "residual_and_stiffness", [Coordinates, Inputs, Design] -> &[VECTOR, SQUARE];
        /// `Mhat`, `Chat` and `Khat`.
        Linear: "linear", [Coordinates, Inputs, Design] -> &[SQUARE, SQUARE, SQUARE];
        /// Derivatives of the residual by inputs and by design variables.
        ResidualPartials: "residual_partials", [Coordinates, Inputs, Design]
            -> &[[Coordinates, Inputs], [Coordinates, Design]];
        /// Gradient of `phi^T (Khat - lambda Mhat) phi`; then `phi`, `lambda`.
        ModeGradient: "mode_gradient", [Coordinates, Inputs, Design, Coordinates, ONE] -> GRADIENT;
        /// Gradient of `left^T (Mhat acceleration + Chat velocity + Khat position)`; then these four vectors.
        PencilGradient: "pencil_gradient",
            [Coordinates, Inputs, Design, Coordinates, Coordinates, Coordinates, Coordinates] -> GRADIENT;
        /// Gradient of `w^T g`; then `w`.
        ResidualGradient: "residual_gradient", [Coordinates, Inputs, Design, Coordinates] -> GRADIENT;
        /// Whirl of a vibration, seven sums; then its real and imaginary part.
        Whirl: "whirl", [Coordinates, Inputs, Design, Coordinates, Coordinates] -> &[[Fixed(7), ONE]];
        /// The declared outputs.
        Outputs: "outputs", [Coordinates, Inputs, Design] -> &[[Outputs, ONE]];
        /// Derivatives of the outputs by unknowns, inputs and design variables.
        OutputPartials: "output_partials", [Coordinates, Inputs, Design]
            -> &[[Outputs, Coordinates], [Outputs, Inputs], [Outputs, Design]];
        /// Harmonic forces of the excitations as cosine, frequency, direct cosine, sine, direct sine.
        Forcing: "forcing", [Coordinates, Inputs, Design] -> &[
            [Excitations, Coordinates], [Excitations, ONE], [Excitations, Outputs],
            [Excitations, Coordinates], [Excitations, Outputs]
        ];
        /// Derivatives of the outputs by acceleration, velocity and position.
        OutputMotion: "output_motion", [Coordinates, Inputs, Design] -> &[[Outputs, Coordinates]; 3];
        /// Gradient of a weighted response without the matrices; then weights on the outputs; acceleration, velocity,
        /// position; weights on the excitations; weights on their cosine, sine, direct cosine, direct sine; weights on
        /// the frequencies.
        ForcedGradient: "forced_gradient", [
            Coordinates, Inputs, Design, Outputs, Coordinates, Coordinates, Coordinates, Excitations, Coordinates,
            Coordinates, Outputs, Outputs, Excitations
        ] -> GRADIENT;
    }

    /// Kernels of any motion: their arguments begin with acceleration and velocity, or velocity.
    MotionKernel {
        /// The full nonlinear equations of motion.
        Residual: "motion_residual", [Coordinates, Coordinates, Coordinates, Inputs, Design] -> &[VECTOR];
        /// Mass matrix and right-hand side.
        Motion: "motion", [Coordinates, Coordinates, Inputs, Design] -> &[SQUARE, VECTOR];
        /// Derivatives of the equations by acceleration, velocity and position.
        Linear: "motion_linear", [Coordinates, Coordinates, Coordinates, Inputs, Design] -> &[SQUARE, SQUARE, SQUARE];
    }
}

/// Defines kernels that are some of [`Kernel`].
macro_rules! some_kernels {
    ($($(#[doc = $about:literal])* $table:ident { $($variant:ident),* })*) => {$(
        $(#[doc = $about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $table {
            $(#[doc = concat!("[`Kernel::", stringify!($variant), "`].")] $variant,)*
        }

        impl From<$table> for Kernel {
            fn from(kernel: $table) -> Self {
                match kernel {
                    $($table::$variant => Self::$variant,)*
                }
            }
        }
    )*};
}

some_kernels! {
    /// Kernels with a derivative along a direction.
    Directional { Linear, ResidualGradient }

    /// Kernels with a derivative along a direction that are long and that few callers need.
    Curvature { ModeGradient, PencilGradient, OutputPartials, Forcing, OutputMotion, ForcedGradient }
}
