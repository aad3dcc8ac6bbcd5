//! Sine and cosine without branches, for `f64` and for vectors of the processor, and without fused operations, so that
//! all give the same bits everywhere.

use core::f64::consts::FRAC_2_PI;

use super::lanes::Lanes;

/// Largest `|x|` that [`sin_cos_within`] accepts, rad: beyond it the multiple of pi/2 has more bits than [`PI_2`]
/// leaves free.
pub(crate) const LIMIT: f64 = 1e5;

/// pi/2 in three parts, the first two of 36 bits: their products with an integer up to 2^16 are exact. The missing
/// remainder is below 2^-130.
const PI_2: [f64; 3] = [1.5707963267923333, 2.5633441515839558e-12, 1.0562999066987428e-23];

/// 1.5 * 2^52: adding and subtracting it rounds to an integer, and the last bits of the sum are those of the integer.
const ROUND: f64 = 6755399441055744.0;

/// `sin r = r + r^3 (S0 + S1 r^2 + ..)` on `|r| <= pi/4`, relative error below 2^-57 (Remez, coefficients rounded in
/// turn).
const SINE: [f64; 6] = [
    -0.1666666666666663,
    0.00833333333332184,
    -0.0001984126982935853,
    2.7557313538516423e-6,
    -2.5050734389815377e-8,
    1.5895433334855847e-10,
];

/// `cos r = 1 - r^2/2 + r^4 (C0 + C1 r^2 + ..)` on `|r| <= pi/4`, absolute error below 2^-64.
const COSINE: [f64; 6] = [
    0.0416666666666666,
    -0.001388888888887447,
    2.4801587289666912e-5,
    -2.755731439926948e-7,
    2.0875728994954886e-9,
    -1.1359917371461161e-11,
];

/// Sine and cosine of `x` rad for `|x| <=` [`LIMIT`], each within one unit in the last place; meaningless in other
/// lanes.
///
/// The argument is reduced by multiples of pi/2 after Cody and Waite (1980), carrying the rounding error of the
/// difference along, so that no digits are lost where `x` is close to a multiple.
#[inline(always)]
pub(crate) fn sin_cos_within<V: Lanes>(x: V) -> (V, V) {
    let number = V::constant;
    let shifted = x * number(FRAC_2_PI) + number(ROUND);
    let turns = shifted - number(ROUND);
    // r - rest = x - turns pi/2
    let first = x - turns * number(PI_2[0]);
    let second = turns * number(PI_2[1]);
    let r = first - second;
    let lost = (first - r) - second;
    let rest = turns * number(PI_2[2]) - lost;

    let z = r * r;
    let w = z * z;
    let half = number(0.5) * z;
    let near_one = number(1.0) - half;
    let slope = number(SINE[0]) + z * sine_terms(z, w);
    let sine = r - (rest * near_one - (z * r) * slope);
    let correction = w * cosine_terms(z, w) + r * rest;
    let cosine = near_one + (((number(1.0) - near_one) - half) + correction);
    shifted.turn(sine, cosine)
}

/// Sine and cosine of an angle in full turns, between zero and one, to a few rounding units of one.
#[inline(always)]
#[cfg(feature = "std")]
pub fn sin_cos_of_turns<V: Lanes>(turns: V) -> (V, V) {
    let number = V::constant;
    let quarters = turns * number(4.0);
    let shifted = quarters + number(ROUND);
    let r = (quarters - (shifted - number(ROUND))) * number(core::f64::consts::FRAC_PI_2);
    let z = r * r;
    let w = z * z;
    let (sine, cosine) = (sine_terms(z, w), cosine_terms(z, w));
    let sine = r + z * r * (number(SINE[0]) + z * sine);
    let cosine = (number(1.0) - number(0.5) * z) + w * cosine;
    shifted.turn(sine, cosine)
}

/// `S1 + S2 z + ..`, `z = r^2`, `w = z^2`.
#[inline(always)]
fn sine_terms<V: Lanes>(z: V, w: V) -> V {
    let number = V::constant;
    (number(SINE[1]) + z * number(SINE[2])) + w * ((number(SINE[3]) + z * number(SINE[4])) + w * number(SINE[5]))
}

/// `C0 + C1 z + ..`.
#[inline(always)]
fn cosine_terms<V: Lanes>(z: V, w: V) -> V {
    let number = V::constant;
    let low = number(COSINE[0]) + z * (number(COSINE[1]) + z * number(COSINE[2]));
    let high = (number(COSINE[3]) + z * number(COSINE[4])) + w * number(COSINE[5]);
    low + (z * w) * high
}

/// Sine and cosine of `x` rad, each within one unit in the last place, with the same bits on every machine. NaN for
/// arguments that are not finite.
#[inline(always)]
pub(crate) fn sin_cos(x: f64) -> (f64, f64) {
    let near = sin_cos_within(x);
    if x.abs() <= LIMIT { near } else { beyond(x) }
}

#[cold]
#[inline(never)]
fn beyond(x: f64) -> (f64, f64) {
    libm::sincos(x)
}
