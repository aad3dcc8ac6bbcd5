//! Vectors of the processor: all operations of a [`Real`], with one state in each lane, and selection by lane.

use super::batch::{Batch, WIDTH};
use super::real::Real;

/// A vector of as many states as the processor computes at once. Every lane of every operation gives the same bits as
/// [`f64`].
pub trait Lanes: Real {
    /// Number of lanes; divides [`WIDTH`](super::WIDTH).
    const WIDTH: usize;
    /// A truth value in each lane.
    type Mask: Copy;
    /// Loads the states from `at` on.
    fn load(from: &Batch, at: usize) -> Self;
    /// Stores the states from `at` on.
    fn store(self, to: &mut Batch, at: usize);
    /// Applies `function` to each lane.
    fn each(self, function: impl Fn(f64) -> f64) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// `self <= bound`; false for NaN.
    fn at_most(self, bound: Self) -> Self::Mask;
    /// `yes` where `mask` is true, `no` elsewhere.
    fn choose(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Bit `l` is the value in lane `l`.
    fn bits(mask: Self::Mask) -> u32;
    /// Rotates (`sine`, `cosine`) by as many right angles as the integer in the last bits of `self`.
    fn turn(self, sine: Self, cosine: Self) -> (Self, Self);
    /// (`e`, `m`) with `self = m 2^e` and `m` between 0.7 and 1.5, for positive normal numbers.
    fn split(self) -> (Self, Self);

    /// `(k + 1/2) / 2^52` for the first 52 bits `k` of the random numbers from `at` on: strictly inside (0, 1), with
    /// one bit less than a double has.
    fn probability(bits: &[u64; WIDTH], at: usize) -> Self;

    /// True in every lane.
    #[inline(always)]
    fn every(mask: Self::Mask) -> bool {
        Self::bits(mask) == (1 << Self::WIDTH) - 1
    }
}

/// A task that is written once for all vector types.
pub trait Task {
    /// The result.
    type Output;
    /// Runs the task. Mark it, and everything that it calls with vectors, `#[inline(always)]`; otherwise the vector
    /// instructions do not reach it.
    fn run<V: Lanes>(self) -> Self::Output;
}

/// Bits of the smallest mantissa of [`Lanes::split`], next to the square root of 1/2.
pub(super) const LEAST: u64 = 0x3fe6_a09e_0000_0000;
/// Added to the bits of a number, it makes the bits above [`MANTISSA`] equal to 1023 plus the exponent for that
/// mantissa.
pub(super) const SHIFT: u64 = (1023 << 52) - LEAST;
/// The bits below the exponent.
pub(super) const MANTISSA: u64 = (1 << 52) - 1;
/// Exponent of the numbers from one to two.
pub(super) const ONE: u64 = 1023 << 52;
/// `1 - 2^-53`.
pub(super) const BELOW_ONE: f64 = 1.0 - f64::EPSILON / 2.0;
/// 2^52: adding an integer to its bits adds it to its value.
pub(super) const INTEGER: f64 = 4503599627370496.0;

impl Lanes for f64 {
    const WIDTH: usize = 1;
    type Mask = bool;

    #[inline(always)]
    fn load(from: &Batch, at: usize) -> Self {
        from.0[at]
    }
    #[inline(always)]
    fn store(self, to: &mut Batch, at: usize) {
        to.0[at] = self;
    }
    #[inline(always)]
    fn each(self, function: impl Fn(f64) -> f64) -> Self {
        function(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self::from_bits(self.to_bits() & !(1 << 63))
    }
    #[inline(always)]
    fn at_most(self, bound: Self) -> bool {
        self <= bound
    }
    #[inline(always)]
    fn choose(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn bits(mask: bool) -> u32 {
        u32::from(mask)
    }
    #[inline(always)]
    fn split(self) -> (Self, Self) {
        let shifted = self.to_bits().wrapping_add(SHIFT);
        let exponent = Self::from_bits((shifted >> 52) + INTEGER.to_bits());
        let mantissa = Self::from_bits((shifted & MANTISSA) + LEAST);
        (exponent - (INTEGER + 1023.0), mantissa)
    }
    #[inline(always)]
    fn probability(bits: &[u64; WIDTH], at: usize) -> Self {
        Self::from_bits(bits[at] >> 12 | ONE) - BELOW_ONE
    }
    #[inline(always)]
    fn turn(self, sine: Self, cosine: Self) -> (Self, Self) {
        let turns = self.to_bits();
        let (s, c) = if turns & 1 == 0 { (sine, cosine) } else { (cosine, sine) };
        let sign = |bits: u64| (bits & 2) << 62;
        (Self::from_bits(s.to_bits() ^ sign(turns)), Self::from_bits(c.to_bits() ^ sign(turns.wrapping_add(1))))
    }
}
