//! The scalar that generated code computes with.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// A real-number type: `f64`, `f32`, or a type that carries more than a value (dual numbers, intervals).
///
/// Generated kernels are generic over it and use no other operations. Angles are in radians.
pub trait Real:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// The number `value`, exact or rounded to nearest.
    fn constant(value: f64) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);
    /// Tangent.
    fn tan(self) -> Self;
    /// Inverse sine, in [-pi/2, pi/2].
    fn asin(self) -> Self;
    /// Inverse cosine, in [0, pi].
    fn acos(self) -> Self;
    /// Angle of the point (`x`, `self`) from the x axis, in (-pi, pi].
    fn atan2(self, x: Self) -> Self;
    /// Natural exponential.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Power with an integer exponent.
    fn powi(self, exponent: i32) -> Self;
    /// Power with a real exponent; the base must be positive.
    fn powf(self, exponent: Self) -> Self;
    /// A piecewise cubic spline, or its derivative of a given order: see [`spline`](crate::scalar::spline).
    fn spline(self, pieces: &[[f64; 5]], derivative: usize) -> Self;
    /// Sine only.
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    /// Cosine only.
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    /// Sines and cosines of several angles, with the same results as one by one.
    #[inline(always)]
    fn sin_cos_all<const K: usize>(angles: [Self; K]) -> [(Self, Self); K] {
        // A loop: code called by an iterator adaptor loses the vector instructions.
        let zero = Self::constant(0.0);
        let mut results = [(zero, zero); K];
        for (result, angle) in results.iter_mut().zip(&angles) {
            *result = angle.sin_cos();
        }
        results
    }
    /// Runs a kernel with suitable instructions of the processor, which do not affect the result. Called by generated
    /// code; the kernel must be marked `#[inline(always)]`.
    #[doc(hidden)]
    #[inline(always)]
    fn run<R>(kernel: impl FnOnce() -> R) -> R {
        kernel()
    }
}

/// Power by repeated squaring, written out because the standard library does not specify which products are formed.
#[cfg(any(feature = "std", feature = "libm"))]
#[inline(always)]
pub fn integer_power<T: Real>(base: T, exponent: i32) -> T {
    let (mut power, mut square) = (T::constant(1.0), base);
    let mut rest = exponent.unsigned_abs();
    while rest > 0 {
        if rest & 1 == 1 {
            power = power * square;
        }
        square = square * square;
        rest >>= 1;
    }
    if exponent < 0 { T::constant(1.0) / power } else { power }
}
