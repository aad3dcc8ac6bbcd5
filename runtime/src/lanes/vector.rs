//! What a vector of the processor can do: everything a [`Real`] can, one state in each lane, and a choice by lane.

use super::Batch;
use crate::Real;

/// As many states as the processor computes at once. Every lane of every operation gives the bits that [`f64`] gives.
#[cfg_attr(not(feature = "std"), allow(dead_code))]
pub(crate) trait Vector: Real {
    /// Number of lanes; divides [`WIDTH`](super::WIDTH).
    const WIDTH: usize;
    /// A truth value in each lane.
    type Mask: Copy;
    /// The states from `at` on.
    fn load(from: &Batch, at: usize) -> Self;
    /// Writes the states from `at` on.
    fn store(self, to: &mut Batch, at: usize);
    /// `function` in each lane.
    fn each(self, function: impl Fn(f64) -> f64) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// `self <= bound`; false for what is not a number.
    fn at_most(self, bound: Self) -> Self::Mask;
    /// `yes` where `mask` is true, `no` elsewhere.
    fn choose(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Lane `l` in bit `l`.
    fn bits(mask: Self::Mask) -> u32;
    /// With an integer in the last bits of `self`: (`sine`, `cosine`) turned by so many right angles.
    fn turn(self, sine: Self, cosine: Self) -> (Self, Self);

    /// True in every lane.
    #[inline(always)]
    fn every(mask: Self::Mask) -> bool {
        Self::bits(mask) == (1 << Self::WIDTH) - 1
    }
}

impl Vector for f64 {
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
    fn turn(self, sine: Self, cosine: Self) -> (Self, Self) {
        let turns = self.to_bits();
        let (s, c) = if turns & 1 == 0 {
            (sine, cosine)
        } else {
            (cosine, sine)
        };
        let sign = |bits: u64| (bits & 2) << 62;
        (
            Self::from_bits(s.to_bits() ^ sign(turns)),
            Self::from_bits(c.to_bits() ^ sign(turns.wrapping_add(1))),
        )
    }
}
