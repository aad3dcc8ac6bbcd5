//! Nested uniform scrambling (Owen 1995): each digit is flipped or not at random, depending on the preceding digits.

use super::bits::hash;

/// Number of binary digits that are scrambled: no two of the first `2^DIGITS` points of a Sobol' sequence agree in all
/// of them.
pub(super) const DIGITS: u32 = 36;

/// Number of digits that share one hash: its 63 flips belong to the nodes of a binary tree of this depth.
const BLOCK: u32 = 6;

/// Scrambles a binary fraction of [`DIGITS`] digits and appends random digits up to 64. Because the points are
/// distinct, these are independent, as the scrambled digits of a longer fraction would be.
pub(super) fn scramble(key: u64, digits: u64) -> u64 {
    let mut scrambled = 0;
    for before in (0..DIGITS).step_by(BLOCK as usize) {
        let above = digits >> (DIGITS - before);
        let flips = hash(key, 1 << before | above);
        let block = digits >> (DIGITS - before - BLOCK) & ((1 << BLOCK) - 1);
        for depth in 0..BLOCK {
            let node = 1 << depth | block >> (BLOCK - depth);
            let digit = block >> (BLOCK - 1 - depth) & 1;
            scrambled = scrambled << 1 | (digit ^ (flips >> node & 1));
        }
    }
    let rest = u64::BITS - DIGITS;
    scrambled << rest | hash(key, 1 << DIGITS | digits) >> DIGITS
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two fractions share as many leading digits after scrambling as before, and the next digit differs.
    #[test]
    fn common_prefixes_are_kept() {
        for number in 0..2000_u64 {
            let x = hash(1, number) >> (64 - DIGITS);
            for digit in 0..DIGITS {
                let below = hash(2, number) & ((1 << digit) - 1);
                let y = (x ^ 1 << digit) & !((1 << digit) - 1) | below;
                let common = DIGITS - 1 - digit;
                let key = hash(3, number);
                let difference = scramble(key, x) ^ scramble(key, y);
                assert_eq!(difference.leading_zeros(), common);
            }
        }
    }

    /// The flips of any two nodes are independent and fair: counts over keys are within four standard deviations.
    #[test]
    fn flips_are_even_and_independent() {
        let keys = 4096;
        let x = 0xA_5C3E_9071;
        let y = x ^ (1 << 20);
        let mut ones = [0_i32; 64];
        let mut agree = [0_i32; 64];
        for number in 0..keys {
            let key = hash(9, number);
            let (a, b) = (scramble(key, x), scramble(key, y));
            for digit in 0..64 {
                ones[digit] += (a >> digit & 1) as i32;
                agree[digit] += ((a ^ b) >> digit & 1) as i32;
            }
        }
        let even = |count: i32| (count - 2048).abs() < 4 * 32;
        assert!(ones.into_iter().all(even));
        // Digits after the first difference.
        assert!(agree[..(20 + 28)].iter().copied().all(even));
    }
}
