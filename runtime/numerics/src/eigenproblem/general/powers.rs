//! Binary exponents and powers of two: multiplying by them causes no rounding.

/// Binary exponent: `2^exponent <= |x| < 2^(exponent + 1)` for normal numbers.
pub(super) fn exponent(x: f64) -> i32 {
    ((x.to_bits() >> 52) & 0x7ff) as i32 - 1023
}

/// `2^exponent`, within the range of normal numbers.
pub(super) fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent.clamp(-1022, 1023) + 1023) as u64) << 52)
}
