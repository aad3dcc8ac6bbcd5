//! [`Real`] for the two floating-point types.

use super::real::{Real, integer_power};
use super::spline::spline;
use super::trigonometry::sin_cos;

/// [`sin_cos`] of several angles, with vector instructions if the target has them.
#[inline(always)]
fn sin_cos_all<const K: usize>(angles: [f64; K]) -> [(f64, f64); K] {
    #[cfg(target_arch = "x86_64")]
    return super::x86::sines_and_cosines(angles);
    #[cfg(not(target_arch = "x86_64"))]
    angles.map(sin_cos)
}

/// One implementation for both floating-point types, based on the standard library or libm. Sine and cosine of `f64`
/// are our own.
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
                super::x86::compact(kernel)
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
        fn spline(self, pieces: &[[f64; 5]], derivative: usize) -> Self {
            spline(self.into(), pieces, derivative) as $float
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

float!(f64, sin_cos, sin_cos_all, sqrt, tan, asin, acos, atan2, exp, log, pow);
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
