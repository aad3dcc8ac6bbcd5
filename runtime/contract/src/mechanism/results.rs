//! Return types of kernels.

use super::shared::Text;

/// A physical requirement that is violated.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Violation<T> {
    /// The quantity at fault, for example `mass of bar1`.
    pub quantity: Text,
    /// The requirement, for example `positive`.
    pub requirement: Text,
    /// Its value, SI.
    pub value: T,
}

/// How far a joint of three turns, or a beam that turns about more than one axis, is from the pose in which its
/// coordinates become singular.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PoseMargin<T> {
    /// Name of the joint or the beam.
    pub joint: Text,
    /// Zero in the singular pose. Of a joint, the volume spanned by its three unit axes: one when they are
    /// perpendicular. Of a beam, the squared cosine of half the largest angle by which a section has turned relative to
    /// the root: one where it is straight, 0.067 at 150 degrees.
    pub margin: T,
    /// The margin below which there is no result: 0 for a joint, 0.067 for a beam; two beams in series bend farther.
    pub least: T,
}

/// The residual at rest in two parts, `g = inertia - applied` (eq. 10); `V` is a list of `N` numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RestParts<V> {
    /// `B_R^T (M Bdot_D u + gyroscopic terms)`: N or N m by coordinate.
    pub inertia: V,
    /// `B_R^T Q`: gravity, springs and dampers.
    pub applied: V,
}

/// Linearised mass, damping and stiffness (eqs. 15-17), or a derivative of the three; `A` is an `N` by `N` matrix.
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
    /// Applies a function to each matrix.
    pub fn map<B>(self, mut matrix: impl FnMut(A) -> B) -> Linear<B> {
        Linear { mass: matrix(self.mass), damping: matrix(self.damping), stiffness: matrix(self.stiffness) }
    }
}

/// Explicit partial derivatives of the linearised matrices, each a list of [`Linear`]; `by_coordinate[k]` is the
/// derivative with respect to coordinate `k`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LinearPartials<C, I = C, D = C> {
    /// With respect to each free coordinate.
    pub by_coordinate: C,
    /// With respect to each input.
    pub by_input: I,
    /// With respect to each design variable.
    pub by_design: D,
}

/// Partial derivatives of one scalar with respect to everything it depends on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Gradient<C, I = C, D = C> {
    /// With respect to each free coordinate.
    pub coordinates: C,
    /// With respect to each input.
    pub inputs: I,
    /// With respect to each design variable.
    pub design: D,
}

/// Harmonic excitations. Excitation `k` exerts `cosine[k] cos(w t) + sine[k] sin(w t)` on the equations of motion, with
/// the sign of an applied force, and adds `direct_cosine[k] cos(w t) + direct_sine[k] sin(w t)` to the outputs of a
/// mechanism that does not move, `w = frequency[k]`. Their complex amplitudes, `Re(F e^{i w t})`, are
/// `F = cosine - i sine`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Forcing<V, F, D> {
    /// By excitation: N or N m by unknown.
    pub cosine: V,
    /// By excitation: rad/s; negative if it turns against its drive's positive direction.
    pub frequency: F,
    /// By excitation: by output, in its unit.
    pub direct_cosine: D,
    /// By excitation: N or N m by unknown.
    pub sine: V,
    /// By excitation: by output, in its unit.
    pub direct_sine: D,
}

/// Numbers of unknowns, inputs, design variables, outputs and excitations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sizes {
    /// Unknowns.
    pub coordinates: usize,
    /// Inputs.
    pub inputs: usize,
    /// Design variables.
    pub design: usize,
    /// Outputs.
    pub outputs: usize,
    /// Excitations.
    pub excitations: usize,
}

/// A list of `n` numbers, or an `n` by `n` matrix, that is filled with zeros.
pub trait Zeros {
    /// Zeros.
    fn zeros(n: usize) -> Self;
}

impl<A: Zeros> Zeros for Linear<A> {
    #[inline]
    fn zeros(n: usize) -> Self {
        Self { mass: A::zeros(n), damping: A::zeros(n), stiffness: A::zeros(n) }
    }
}

impl<A: Zeros> Linear<A> {
    /// Zeros for `n` unknowns.
    #[must_use]
    #[inline]
    pub fn zeros(n: usize) -> Self {
        Zeros::zeros(n)
    }
}

impl<V: Zeros> RestParts<V> {
    /// Zeros for `n` unknowns.
    #[must_use]
    #[inline]
    pub fn zeros(n: usize) -> Self {
        Self { inertia: V::zeros(n), applied: V::zeros(n) }
    }
}

impl<V: Zeros> Gradient<V> {
    /// Zeros.
    #[must_use]
    #[inline]
    pub fn zeros(sizes: Sizes) -> Self {
        Self {
            coordinates: V::zeros(sizes.coordinates),
            inputs: V::zeros(sizes.inputs),
            design: V::zeros(sizes.design),
        }
    }
}

impl<L: IntoIterator<Item: Zeros> + FromIterator<L::Item>> LinearPartials<L> {
    /// Zeros.
    #[must_use]
    pub fn zeros(sizes: Sizes) -> Self {
        let list = |count: usize| (0..count).map(|_| L::Item::zeros(sizes.coordinates)).collect();
        Self { by_coordinate: list(sizes.coordinates), by_input: list(sizes.inputs), by_design: list(sizes.design) }
    }
}
