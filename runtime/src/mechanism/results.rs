//! What kernels return.

use crate::dual::Dual;

/// A physical requirement that is not met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Violation<T> {
    /// What is wrong, for example `mass of bar1`.
    pub quantity: &'static str,
    /// What it has to be, for example `positive`.
    pub requirement: &'static str,
    /// What it is, SI.
    pub value: T,
}

/// How far a joint is from the pose in which its coordinates fail.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseMargin<T> {
    /// Name of the joint.
    pub joint: &'static str,
    /// Volume spanned by its three unit axes: one when they are perpendicular, zero in the singular pose.
    pub margin: T,
}

/// The residual at rest in two parts, `g = inertia - applied` (eq. 10).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestParts<T, const N: usize> {
    /// `B_R^T (M Bdot_D u + gyroscopic terms)`: N or N m by coordinate.
    pub inertia: [T; N],
    /// `B_R^T Q`: gravity, springs and dampers.
    pub applied: [T; N],
}

/// Linearised mass, damping and stiffness (eqs. 15-17), or a derivative of the three.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear<T, const N: usize> {
    /// `Mhat`, symmetric.
    pub mass: [[T; N]; N],
    /// `Chat`.
    pub damping: [[T; N]; N],
    /// `Khat`.
    pub stiffness: [[T; N]; N],
}

impl<T, const N: usize> Linear<Dual<T>, N> {
    /// The derivatives.
    #[inline]
    pub(super) fn slopes(self) -> Linear<T, N> {
        let slopes = |matrix: [[Dual<T>; N]; N]| matrix.map(|row| row.map(|entry| entry.slope));
        Linear {
            mass: slopes(self.mass),
            damping: slopes(self.damping),
            stiffness: slopes(self.stiffness),
        }
    }
}

impl<T: Copy + Default, const N: usize> Default for Linear<T, N> {
    fn default() -> Self {
        let zero = [[T::default(); N]; N];
        Self {
            mass: zero,
            damping: zero,
            stiffness: zero,
        }
    }
}

/// Explicit partial derivatives of the linearised matrices; `by_coordinate[k]` is the derivative by coordinate `k`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearPartials<T, const N: usize, const U: usize, const P: usize> {
    /// By each free coordinate.
    pub by_coordinate: [Linear<T, N>; N],
    /// By each input.
    pub by_input: [Linear<T, N>; U],
    /// By each design variable.
    pub by_design: [Linear<T, N>; P],
}

impl<T: Copy + Default, const N: usize, const U: usize, const P: usize> Default
    for LinearPartials<T, N, U, P>
{
    fn default() -> Self {
        Self {
            by_coordinate: [Linear::default(); N],
            by_input: [Linear::default(); U],
            by_design: [Linear::default(); P],
        }
    }
}

/// Partial derivatives of one scalar by everything it depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gradient<T, const N: usize, const U: usize, const P: usize> {
    /// By each free coordinate.
    pub coordinates: [T; N],
    /// By each input.
    pub inputs: [T; U],
    /// By each design variable.
    pub design: [T; P],
}

impl<T, const N: usize, const U: usize, const P: usize> Gradient<Dual<T>, N, U, P> {
    /// The derivatives.
    #[inline]
    pub(super) fn slopes(self) -> Gradient<T, N, U, P> {
        Gradient {
            coordinates: self.coordinates.map(|entry| entry.slope),
            inputs: self.inputs.map(|entry| entry.slope),
            design: self.design.map(|entry| entry.slope),
        }
    }
}

impl<T: Copy + Default, const N: usize, const U: usize, const P: usize> Default
    for Gradient<T, N, U, P>
{
    fn default() -> Self {
        Self {
            coordinates: [T::default(); N],
            inputs: [T::default(); U],
            design: [T::default(); P],
        }
    }
}
