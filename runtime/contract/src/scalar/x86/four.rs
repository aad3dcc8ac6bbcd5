//! Four lanes.

use core::arch::x86_64::*;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::real::{memory, real};
use crate::scalar::batch::{Batch, WIDTH};
use crate::scalar::lanes::{BELOW_ONE, INTEGER, LEAST, Lanes, MANTISSA, ONE, SHIFT};
use crate::scalar::real::Real;
use crate::scalar::trigonometry;

/// Four lanes of AVX2.
#[derive(Clone, Copy)]
pub(super) struct Four(__m256d);

real!(
    Four, 4, _mm256_set1_pd, _mm256_loadu_pd, _mm256_storeu_pd, _mm256_sqrt_pd,
    Add add _mm256_add_pd Sub sub _mm256_sub_pd Mul mul _mm256_mul_pd Div div _mm256_div_pd
);

impl Neg for Four {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: see the module.
        Self(unsafe { _mm256_xor_pd(self.0, _mm256_set1_pd(-0.0)) })
    }
}

impl Lanes for Four {
    memory!(4, _mm256_loadu_pd, _mm256_storeu_pd);
    type Mask = __m256d;

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
            // The selection only looks at the first bit of a lane.
            let odd = _mm256_castsi256_pd(_mm256_slli_epi64::<63>(turns));
            let two = _mm256_set1_epi64x(2);
            let sign = |turns| _mm256_castsi256_pd(_mm256_slli_epi64::<62>(_mm256_and_si256(turns, two)));
            let next = _mm256_add_epi64(turns, _mm256_set1_epi64x(1));
            let s = _mm256_blendv_pd(sine.0, cosine.0, odd);
            let c = _mm256_blendv_pd(cosine.0, sine.0, odd);
            (Self(_mm256_xor_pd(s, sign(turns))), Self(_mm256_xor_pd(c, sign(next))))
        }
    }
}
