//! Eight lanes.

use core::arch::x86_64::*;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::real::{memory, real};
use crate::scalar::batch::{Batch, WIDTH};
use crate::scalar::lanes::{BELOW_ONE, INTEGER, LEAST, Lanes, MANTISSA, ONE, SHIFT};
use crate::scalar::real::Real;
use crate::scalar::trigonometry;

/// Eight lanes of AVX-512.
#[derive(Clone, Copy)]
pub(super) struct Eight(__m512d);

real!(
    Eight, 8, _mm512_set1_pd, _mm512_loadu_pd, _mm512_storeu_pd, _mm512_sqrt_pd,
    Add add _mm512_add_pd Sub sub _mm512_sub_pd Mul mul _mm512_mul_pd Div div _mm512_div_pd
);

impl Neg for Eight {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: see the module.
        Self(unsafe { flip(self.0, _mm512_set1_epi64(i64::MIN)) })
    }
}

/// Flips the bits of `value` where those of `by` are set.
#[inline(always)]
unsafe fn flip(value: __m512d, by: __m512i) -> __m512d {
    // SAFETY: see the module.
    unsafe { _mm512_castsi512_pd(_mm512_xor_si512(_mm512_castpd_si512(value), by)) }
}

impl Lanes for Eight {
    memory!(8, _mm512_loadu_pd, _mm512_storeu_pd);
    type Mask = __mmask8;

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
