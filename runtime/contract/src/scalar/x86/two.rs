//! Two lanes.

use core::arch::x86_64::*;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::real::{memory, real};
use crate::scalar::batch::{Batch, WIDTH};
use crate::scalar::lanes::{BELOW_ONE, Lanes, ONE};
use crate::scalar::real::Real;
use crate::scalar::trigonometry;

/// Sines and cosines of numbers, two at a time: every x86-64 processor has vectors of two.
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

real!(
    Two, 2, _mm_set1_pd, _mm_loadu_pd, _mm_storeu_pd, _mm_sqrt_pd,
    Add add _mm_add_pd Sub sub _mm_sub_pd Mul mul _mm_mul_pd Div div _mm_div_pd
);

impl Neg for Two {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: see the module.
        Self(unsafe { _mm_xor_pd(self.0, _mm_set1_pd(-0.0)) })
    }
}

impl Lanes for Two {
    memory!(2, _mm_loadu_pd, _mm_storeu_pd);
    type Mask = __m128d;

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
        let [(e0, m0), (e1, m1)] = self.array().map(Lanes::split);
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
            (Self(_mm_xor_pd(s.0, sign(turns))), Self(_mm_xor_pd(c.0, sign(next))))
        }
    }
}
