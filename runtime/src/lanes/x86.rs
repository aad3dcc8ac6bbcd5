//! Vectors of x86-64: four lanes of AVX2, eight of AVX-512.
//!
//! The only unsafe code of the project. It rests on one fact: values of these types exist only inside tasks that [`Avx2`] and
//! [`Avx512`] run, and these two exist only where the processor has been asked for the instructions.
#![allow(unsafe_code)]

use core::arch::x86_64::*;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::instructions::Task;
use super::vector::{BELOW_ONE, INTEGER, LEAST, MANTISSA, ONE, SHIFT};
use super::{Batch, Vector, WIDTH};
use crate::{Real, trigonometry};

/// That the processor has a set of instructions: proof, and door to it.
macro_rules! set {
    ($(#[$doc:meta])* $name:ident $feature:tt $vector:ident $run:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) struct $name(());

        impl $name {
            /// Asks the processor; without the standard library, the target that is compiled for.
            #[inline]
            pub(super) fn detect() -> Option<Self> {
                #[cfg(feature = "std")]
                let found = std::is_x86_feature_detected!($feature);
                #[cfg(not(feature = "std"))]
                let found = cfg!(target_feature = $feature);
                found.then_some(Self(()))
            }

            /// Runs a task with these instructions.
            #[inline]
            pub(super) fn run<T: Task>(self, task: T) -> T::Output {
                // SAFETY: `self` exists, so the processor has the feature.
                unsafe { $run(task) }
            }
        }

        #[target_feature(enable = $feature)]
        fn $run<T: Task>(task: T) -> T::Output {
            task.run::<$vector>()
        }
    };
}

set! {
    /// Vectors of four lanes.
    Avx2 "avx2" Four avx2
}
set! {
    /// Vectors of eight lanes.
    Avx512 "avx512f" Eight avx512
}

/// Runs a task on numbers with the instructions of AVX where the processor has them: these name the register of their
/// result, which saves a copy where both operands are needed again. Code shrinks by a quarter, and thousands of operations
/// fit into the cache of instructions.
#[inline]
pub(crate) fn compact<R>(task: impl FnOnce() -> R) -> R {
    #[cfg(feature = "std")]
    let found = std::is_x86_feature_detected!("avx");
    #[cfg(not(feature = "std"))]
    let found = cfg!(target_feature = "avx");
    if found {
        // SAFETY: the processor has the feature.
        unsafe { avx(task) }
    } else {
        task()
    }
}

#[target_feature(enable = "avx")]
fn avx<R>(task: impl FnOnce() -> R) -> R {
    task()
}

/// Sines and cosines of numbers, two at a time: every processor of this kind has vectors of two.
#[inline(always)]
pub(crate) fn sines_and_cosines<const K: usize>(angles: [f64; K]) -> [(f64, f64); K] {
    let mut results = [(0.0, 0.0); K];
    for (results, angles) in results.chunks_mut(2).zip(angles.chunks(2)) {
        match (results, angles) {
            ([first, second], &[a, b]) => {
                let (sines, cosines) = Two::of([a, b]).sin_cos();
                let ([sine_a, sine_b], [cosine_a, cosine_b]) = (sines.array(), cosines.array());
                *first = (sine_a, cosine_a);
                *second = (sine_b, cosine_b);
            }
            (results, angles) => {
                for (result, &angle) in results.iter_mut().zip(angles) {
                    *result = trigonometry::sin_cos(angle);
                }
            }
        }
    }
    results
}

/// Two lanes of SSE2, which is part of x86-64.
#[derive(Clone, Copy)]
pub(super) struct Two(__m128d);

/// Four lanes of AVX2.
#[derive(Clone, Copy)]
pub(super) struct Four(__m256d);

/// Eight lanes of AVX-512.
#[derive(Clone, Copy)]
pub(super) struct Eight(__m512d);

/// What is the same for both but for the names of the instructions.
macro_rules! real {
    ($vector:ident, $lanes:literal, $set1:ident, $load:ident, $store:ident, $sqrt:ident, $($trait:ident $method:ident $operation:ident)*) => {
        $(impl $trait for $vector {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: see the module.
                Self(unsafe { $operation(self.0, other.0) })
            }
        })*

        impl $vector {
            #[inline(always)]
            fn array(self) -> [f64; $lanes] {
                let mut lanes = [0.0; $lanes];
                // SAFETY: see the module; the array has room for the vector.
                unsafe { $store(lanes.as_mut_ptr(), self.0) };
                lanes
            }

            #[inline(always)]
            fn of(lanes: [f64; $lanes]) -> Self {
                // SAFETY: see the module; the array is as long as the vector.
                Self(unsafe { $load(lanes.as_ptr()) })
            }

            #[inline(always)]
            fn with(self, other: Self, function: impl Fn(f64, f64) -> f64) -> Self {
                let (a, b) = (self.array(), other.array());
                Self::of(core::array::from_fn(|l| function(a[l], b[l])))
            }

            /// Each lane by the scalar function, for angles of any size.
            #[cold]
            #[inline(never)]
            fn sin_cos_beyond(angles: &[f64; $lanes]) -> [[f64; $lanes]; 2] {
                let pairs = angles.map(trigonometry::sin_cos);
                [pairs.map(|pair| pair.0), pairs.map(|pair| pair.1)]
            }
        }

        impl Real for $vector {
            #[inline(always)]
            fn constant(value: f64) -> Self {
                // SAFETY: see the module.
                Self(unsafe { $set1(value) })
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                // SAFETY: see the module.
                Self(unsafe { $sqrt(self.0) })
            }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                if Self::every(self.abs().at_most(Self::constant(trigonometry::LIMIT))) {
                    return trigonometry::sin_cos_within(self);
                }
                let [sines, cosines] = Self::sin_cos_beyond(&self.array());
                (Self::of(sines), Self::of(cosines))
            }
            #[inline(always)]
            fn tan(self) -> Self {
                self.each(|x| Real::tan(x))
            }
            #[inline(always)]
            fn asin(self) -> Self {
                self.each(|x| Real::asin(x))
            }
            #[inline(always)]
            fn acos(self) -> Self {
                self.each(|x| Real::acos(x))
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                self.with(x, |y, x| Real::atan2(y, x))
            }
            #[inline(always)]
            fn exp(self) -> Self {
                self.each(|x| Real::exp(x))
            }
            #[inline(always)]
            fn ln(self) -> Self {
                self.each(|x| Real::ln(x))
            }
            #[inline(always)]
            fn powi(self, exponent: i32) -> Self {
                crate::real::integer_power(self, exponent)
            }
            #[inline(always)]
            fn powf(self, exponent: Self) -> Self {
                self.with(exponent, |x, y| Real::powf(x, y))
            }
        }
    };
}

real!(
    Two, 2, _mm_set1_pd, _mm_loadu_pd, _mm_storeu_pd, _mm_sqrt_pd,
    Add add _mm_add_pd Sub sub _mm_sub_pd Mul mul _mm_mul_pd Div div _mm_div_pd
);
real!(
    Four, 4, _mm256_set1_pd, _mm256_loadu_pd, _mm256_storeu_pd, _mm256_sqrt_pd,
    Add add _mm256_add_pd Sub sub _mm256_sub_pd Mul mul _mm256_mul_pd Div div _mm256_div_pd
);
real!(
    Eight, 8, _mm512_set1_pd, _mm512_loadu_pd, _mm512_storeu_pd, _mm512_sqrt_pd,
    Add add _mm512_add_pd Sub sub _mm512_sub_pd Mul mul _mm512_mul_pd Div div _mm512_div_pd
);

impl Neg for Two {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: see the module.
        Self(unsafe { _mm_xor_pd(self.0, _mm_set1_pd(-0.0)) })
    }
}

impl Neg for Four {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: see the module.
        Self(unsafe { _mm256_xor_pd(self.0, _mm256_set1_pd(-0.0)) })
    }
}

impl Neg for Eight {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: see the module.
        Self(unsafe { flip(self.0, _mm512_set1_epi64(i64::MIN)) })
    }
}

/// The bits of `value` changed where those of `by` are set.
#[inline(always)]
unsafe fn flip(value: __m512d, by: __m512i) -> __m512d {
    // SAFETY: see the module.
    unsafe { _mm512_castsi512_pd(_mm512_xor_si512(_mm512_castpd_si512(value), by)) }
}

impl Vector for Two {
    const WIDTH: usize = 2;
    type Mask = __m128d;

    #[inline(always)]
    fn load(from: &Batch, at: usize) -> Self {
        Self::of([from.0[at], from.0[at + 1]])
    }
    #[inline(always)]
    fn store(self, to: &mut Batch, at: usize) {
        [to.0[at], to.0[at + 1]] = self.array();
    }
    #[inline(always)]
    fn each(self, function: impl Fn(f64) -> f64) -> Self {
        Self::of(self.array().map(function))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: see the module.
        Self(unsafe { _mm_andnot_pd(_mm_set1_pd(-0.0), self.0) })
    }
    #[inline(always)]
    fn at_most(self, bound: Self) -> __m128d {
        // SAFETY: see the module.
        unsafe { _mm_cmple_pd(self.0, bound.0) }
    }
    #[inline(always)]
    fn choose(mask: __m128d, yes: Self, no: Self) -> Self {
        // SAFETY: see the module.
        Self(unsafe { _mm_or_pd(_mm_and_pd(mask, yes.0), _mm_andnot_pd(mask, no.0)) })
    }
    #[inline(always)]
    fn bits(mask: __m128d) -> u32 {
        // SAFETY: see the module.
        unsafe { _mm_movemask_pd(mask) }.cast_unsigned()
    }
    #[inline(always)]
    fn split(self) -> (Self, Self) {
        let [(e0, m0), (e1, m1)] = self.array().map(Vector::split);
        (Self::of([e0, e1]), Self::of([m0, m1]))
    }
    #[inline(always)]
    fn probability(bits: &[u64; WIDTH], at: usize) -> Self {
        assert!(at + 2 <= WIDTH);
        // SAFETY: see the module; within the array by the assertion.
        let number = unsafe {
            let bits = _mm_loadu_si128(bits.as_ptr().add(at).cast());
            let one = _mm_set1_epi64x(ONE.cast_signed());
            _mm_castsi128_pd(_mm_or_si128(_mm_srli_epi64::<12>(bits), one))
        };
        Self(number) - Self::constant(BELOW_ONE)
    }
    #[inline(always)]
    fn turn(self, sine: Self, cosine: Self) -> (Self, Self) {
        // SAFETY: see the module.
        unsafe {
            let turns = _mm_castpd_si128(self.0);
            let one = _mm_set1_epi64x(1);
            let even = _mm_sub_epi64(_mm_and_si128(turns, one), one);
            let even = _mm_castsi128_pd(even);
            let two = _mm_set1_epi64x(2);
            let sign = |turns| _mm_castsi128_pd(_mm_slli_epi64::<62>(_mm_and_si128(turns, two)));
            let next = _mm_add_epi64(turns, one);
            let s = Self::choose(even, sine, cosine);
            let c = Self::choose(even, cosine, sine);
            (
                Self(_mm_xor_pd(s.0, sign(turns))),
                Self(_mm_xor_pd(c.0, sign(next))),
            )
        }
    }
}

impl Vector for Four {
    const WIDTH: usize = 4;
    type Mask = __m256d;

    #[inline(always)]
    fn load(from: &Batch, at: usize) -> Self {
        assert!(at + 4 <= WIDTH);
        // SAFETY: see the module; within the batch by the assertion.
        Self(unsafe { _mm256_loadu_pd(from.0.as_ptr().add(at)) })
    }
    #[inline(always)]
    fn store(self, to: &mut Batch, at: usize) {
        assert!(at + 4 <= WIDTH);
        // SAFETY: see the module; within the batch by the assertion.
        unsafe { _mm256_storeu_pd(to.0.as_mut_ptr().add(at), self.0) };
    }
    #[inline(always)]
    fn each(self, function: impl Fn(f64) -> f64) -> Self {
        Self::of(self.array().map(function))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: see the module.
        Self(unsafe { _mm256_andnot_pd(_mm256_set1_pd(-0.0), self.0) })
    }
    #[inline(always)]
    fn at_most(self, bound: Self) -> __m256d {
        // SAFETY: see the module.
        unsafe { _mm256_cmp_pd::<_CMP_LE_OQ>(self.0, bound.0) }
    }
    #[inline(always)]
    fn choose(mask: __m256d, yes: Self, no: Self) -> Self {
        // SAFETY: see the module.
        Self(unsafe { _mm256_blendv_pd(no.0, yes.0, mask) })
    }
    #[inline(always)]
    fn bits(mask: __m256d) -> u32 {
        // SAFETY: see the module.
        unsafe { _mm256_movemask_pd(mask) }.cast_unsigned()
    }
    #[inline(always)]
    fn split(self) -> (Self, Self) {
        // SAFETY: see the module.
        unsafe {
            let all = |bits: u64| _mm256_set1_epi64x(bits.cast_signed());
            let shifted = _mm256_add_epi64(_mm256_castpd_si256(self.0), all(SHIFT));
            let exponent = _mm256_srli_epi64::<52>(shifted);
            let exponent = _mm256_add_epi64(exponent, all(INTEGER.to_bits()));
            let mantissa = _mm256_and_si256(shifted, all(MANTISSA));
            let mantissa = _mm256_add_epi64(mantissa, all(LEAST));
            (
                Self(_mm256_castsi256_pd(exponent)) - Self::constant(INTEGER + 1023.0),
                Self(_mm256_castsi256_pd(mantissa)),
            )
        }
    }
    #[inline(always)]
    fn probability(bits: &[u64; WIDTH], at: usize) -> Self {
        assert!(at + 4 <= WIDTH);
        // SAFETY: see the module; within the array by the assertion.
        let number = unsafe {
            let bits = _mm256_loadu_si256(bits.as_ptr().add(at).cast());
            let one = _mm256_set1_epi64x(ONE.cast_signed());
            _mm256_castsi256_pd(_mm256_or_si256(_mm256_srli_epi64::<12>(bits), one))
        };
        Self(number) - Self::constant(BELOW_ONE)
    }
    #[inline(always)]
    fn turn(self, sine: Self, cosine: Self) -> (Self, Self) {
        // SAFETY: see the module.
        unsafe {
            let turns = _mm256_castpd_si256(self.0);
            // The choice looks at the first bit of a lane only.
            let odd = _mm256_castsi256_pd(_mm256_slli_epi64::<63>(turns));
            let two = _mm256_set1_epi64x(2);
            let sign =
                |turns| _mm256_castsi256_pd(_mm256_slli_epi64::<62>(_mm256_and_si256(turns, two)));
            let next = _mm256_add_epi64(turns, _mm256_set1_epi64x(1));
            let s = _mm256_blendv_pd(sine.0, cosine.0, odd);
            let c = _mm256_blendv_pd(cosine.0, sine.0, odd);
            (
                Self(_mm256_xor_pd(s, sign(turns))),
                Self(_mm256_xor_pd(c, sign(next))),
            )
        }
    }
}

impl Vector for Eight {
    const WIDTH: usize = 8;
    type Mask = __mmask8;

    #[inline(always)]
    fn load(from: &Batch, at: usize) -> Self {
        assert!(at + 8 <= WIDTH);
        // SAFETY: see the module; within the batch by the assertion.
        Self(unsafe { _mm512_loadu_pd(from.0.as_ptr().add(at)) })
    }
    #[inline(always)]
    fn store(self, to: &mut Batch, at: usize) {
        assert!(at + 8 <= WIDTH);
        // SAFETY: see the module; within the batch by the assertion.
        unsafe { _mm512_storeu_pd(to.0.as_mut_ptr().add(at), self.0) };
    }
    #[inline(always)]
    fn each(self, function: impl Fn(f64) -> f64) -> Self {
        Self::of(self.array().map(function))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: see the module.
        Self(unsafe { _mm512_abs_pd(self.0) })
    }
    #[inline(always)]
    fn at_most(self, bound: Self) -> __mmask8 {
        // SAFETY: see the module.
        unsafe { _mm512_cmp_pd_mask::<_CMP_LE_OQ>(self.0, bound.0) }
    }
    #[inline(always)]
    fn choose(mask: __mmask8, yes: Self, no: Self) -> Self {
        // SAFETY: see the module.
        Self(unsafe { _mm512_mask_blend_pd(mask, no.0, yes.0) })
    }
    #[inline(always)]
    fn bits(mask: __mmask8) -> u32 {
        u32::from(mask)
    }
    #[inline(always)]
    fn split(self) -> (Self, Self) {
        // SAFETY: see the module.
        unsafe {
            let all = |bits: u64| _mm512_set1_epi64(bits.cast_signed());
            let shifted = _mm512_add_epi64(_mm512_castpd_si512(self.0), all(SHIFT));
            let exponent = _mm512_srli_epi64::<52>(shifted);
            let exponent = _mm512_add_epi64(exponent, all(INTEGER.to_bits()));
            let mantissa = _mm512_and_si512(shifted, all(MANTISSA));
            let mantissa = _mm512_add_epi64(mantissa, all(LEAST));
            (
                Self(_mm512_castsi512_pd(exponent)) - Self::constant(INTEGER + 1023.0),
                Self(_mm512_castsi512_pd(mantissa)),
            )
        }
    }
    #[inline(always)]
    fn probability(bits: &[u64; WIDTH], at: usize) -> Self {
        assert!(at + 8 <= WIDTH);
        // SAFETY: see the module; within the array by the assertion.
        let number = unsafe {
            let bits = _mm512_loadu_si512(bits.as_ptr().add(at).cast());
            let one = _mm512_set1_epi64(ONE.cast_signed());
            _mm512_castsi512_pd(_mm512_or_si512(_mm512_srli_epi64::<12>(bits), one))
        };
        Self(number) - Self::constant(BELOW_ONE)
    }
    #[inline(always)]
    fn turn(self, sine: Self, cosine: Self) -> (Self, Self) {
        // SAFETY: see the module.
        unsafe {
            let turns = _mm512_castpd_si512(self.0);
            let odd = _mm512_test_epi64_mask(turns, _mm512_set1_epi64(1));
            let two = _mm512_set1_epi64(2);
            let sign = |turns| _mm512_slli_epi64::<62>(_mm512_and_si512(turns, two));
            let next = _mm512_add_epi64(turns, _mm512_set1_epi64(1));
            let s = _mm512_mask_blend_pd(odd, sine.0, cosine.0);
            let c = _mm512_mask_blend_pd(odd, cosine.0, sine.0);
            (Self(flip(s, sign(turns))), Self(flip(c, sign(next))))
        }
    }
}
