//! The scalar that generated code computes with.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// A real-number type: `f64`, `f32`, or a type that carries more than a value (dual numbers, intervals).
///
/// Generated kernels are generic over it and use nothing else of a number. Angles are in radians.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The number `value`, exactly or rounded to the nearest.
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
    /// Power with a real exponent; the base is positive.
    fn powf(self, exponent: Self) -> Self;
    /// Sine alone.
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    /// Cosine alone.
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    /// Sines and cosines of several angles, the same numbers as one by one.
    #[inline(always)]
    fn sin_cos_all<const K: usize>(angles: [Self; K]) -> [(Self, Self); K] {
        // A loop: what an adaptor of an iterator calls leaves the instructions of the lanes behind.
        let zero = Self::constant(0.0);
        let mut results = [(zero, zero); K];
        for (result, angle) in results.iter_mut().zip(&angles) {
            *result = angle.sin_cos();
        }
        results
    }
    /// Runs a kernel with the instructions of the processor that suit it. Its result does not depend on them. Generated
    /// code calls it; the kernel is to be marked `#[inline(always)]`.
    #[doc(hidden)]
    #[inline(always)]
    fn run<R>(kernel: impl FnOnce() -> R) -> R {
        kernel()
    }
}

/// Power by repeated squaring; written out, because the standard library leaves open which products are formed.
#[cfg(any(feature = "std", feature = "libm"))]
#[inline(always)]
pub(crate) fn integer_power<T: Real>(base: T, exponent: i32) -> T {
    let (mut power, mut square) = (T::constant(1.0), base);
    let mut rest = exponent.unsigned_abs();
    while rest > 0 {
        if rest & 1 == 1 {
            power = power * square;
        }
        square = square * square;
        rest >>= 1;
    }
    if exponent < 0 {
        T::constant(1.0) / power
    } else {
        power
    }
}

/// One implementation for the two floating-point types, over the standard library's functions or libm's. Sine and cosine
/// of `f64` are our own.
#[cfg(any(feature = "std", feature = "libm"))]
macro_rules! float {
    ($float:ident, $sin_cos:expr, $sin_cos_all:expr, $($libm:ident),*) => {
        impl Real for $float {
            #[inline]
            fn constant(value: f64) -> Self {
                value as $float
            }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                $sin_cos(self)
            }
            #[inline(always)]
            fn sin_cos_all<const K: usize>(angles: [Self; K]) -> [(Self, Self); K] {
                $sin_cos_all(angles)
            }
            #[cfg(target_arch = "x86_64")]
            #[inline(always)]
            fn run<R>(kernel: impl FnOnce() -> R) -> R {
                crate::lanes::compact(kernel)
            }
            float!(@functions $float, $($libm),*);
        }
    };
    (@functions $float:ident, $sqrt:ident, $tan:ident, $asin:ident, $acos:ident,
     $atan2:ident, $exp:ident, $log:ident, $pow:ident) => {
        #[inline]
        fn sqrt(self) -> Self {
            #[cfg(feature = "std")]
            return self.sqrt();
            #[cfg(not(feature = "std"))]
            return libm::$sqrt(self);
        }
        #[inline]
        fn tan(self) -> Self {
            #[cfg(feature = "std")]
            return self.tan();
            #[cfg(not(feature = "std"))]
            return libm::$tan(self);
        }
        #[inline]
        fn asin(self) -> Self {
            #[cfg(feature = "std")]
            return self.asin();
            #[cfg(not(feature = "std"))]
            return libm::$asin(self);
        }
        #[inline]
        fn acos(self) -> Self {
            #[cfg(feature = "std")]
            return self.acos();
            #[cfg(not(feature = "std"))]
            return libm::$acos(self);
        }
        #[inline]
        fn atan2(self, x: Self) -> Self {
            #[cfg(feature = "std")]
            return self.atan2(x);
            #[cfg(not(feature = "std"))]
            return libm::$atan2(self, x);
        }
        #[inline]
        fn exp(self) -> Self {
            #[cfg(feature = "std")]
            return self.exp();
            #[cfg(not(feature = "std"))]
            return libm::$exp(self);
        }
        #[inline]
        fn ln(self) -> Self {
            #[cfg(feature = "std")]
            return self.ln();
            #[cfg(not(feature = "std"))]
            return libm::$log(self);
        }
        #[inline]
        fn powi(self, exponent: i32) -> Self {
            integer_power(self, exponent)
        }
        #[inline]
        fn powf(self, exponent: Self) -> Self {
            #[cfg(feature = "std")]
            return self.powf(exponent);
            #[cfg(not(feature = "std"))]
            return libm::$pow(self, exponent);
        }
    };
}

#[cfg(any(feature = "std", feature = "libm"))]
float!(
    f64,
    crate::trigonometry::sin_cos,
    crate::trigonometry::sin_cos_all,
    sqrt,
    tan,
    asin,
    acos,
    atan2,
    exp,
    log,
    pow
);
#[cfg(any(feature = "std", feature = "libm"))]
float!(
    f32,
    libm::sincosf,
    |angles: [f32; K]| angles.map(libm::sincosf),
    sqrtf,
    tanf,
    asinf,
    acosf,
    atan2f,
    expf,
    logf,
    powf
);
