//! What kernels return.

use super::shared::Text;

/// A physical requirement that is not met.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Violation<T> {
    /// What is wrong, for example `mass of bar1`.
    pub quantity: Text,
    /// What it has to be, for example `positive`.
    pub requirement: Text,
    /// What it is, SI.
    pub value: T,
}

/// How far a joint is from the pose in which its coordinates fail.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PoseMargin<T> {
    /// Name of the joint.
    pub joint: Text,
    /// Volume spanned by its three unit axes: one when they are perpendicular, zero in the singular pose.
    pub margin: T,
}

/// The residual at rest in two parts, `g = inertia - applied` (eq. 10); `V` a list of `N` numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RestParts<V> {
    /// `B_R^T (M Bdot_D u + gyroscopic terms)`: N or N m by coordinate.
    pub inertia: V,
    /// `B_R^T Q`: gravity, springs and dampers.
    pub applied: V,
}

/// Linearised mass, damping and stiffness (eqs. 15-17), or a derivative of the three; `A` an `N` by `N` matrix.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Linear<A> {
    /// `Mhat`, symmetric.
    pub mass: A,
    /// `Chat`.
    pub damping: A,
    /// `Khat`.
    pub stiffness: A,
}

impl<A> Linear<A> {
    /// The same of each matrix.
    pub fn map<B>(self, mut matrix: impl FnMut(A) -> B) -> Linear<B> {
        Linear {
            mass: matrix(self.mass),
            damping: matrix(self.damping),
            stiffness: matrix(self.stiffness),
        }
    }
}

/// Explicit partial derivatives of the linearised matrices, each list one of [`Linear`]; `by_coordinate[k]` is the derivative
/// by coordinate `k`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LinearPartials<C, I = C, D = C> {
    /// By each free coordinate.
    pub by_coordinate: C,
    /// By each input.
    pub by_input: I,
    /// By each design variable.
    pub by_design: D,
}

/// Partial derivatives of one scalar by everything it depends on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Gradient<C, I = C, D = C> {
    /// By each free coordinate.
    pub coordinates: C,
    /// By each input.
    pub inputs: I,
    /// By each design variable.
    pub design: D,
}
