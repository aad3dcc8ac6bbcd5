//! Random bits that depend only on a key and a number, and their conversion to a number in the open unit interval.

use crate::random::RandomNumbers;

/// Output number `word` of SplitMix64 with the state `key` (Steele, Lea and Flood, OOPSLA 2014).
pub(super) fn hash(key: u64, word: u64) -> u64 {
    let z = key.wrapping_add(word.wrapping_mul(0x9E37_79B9_7F4A_7C15));
    let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// Generates `number` independent keys.
pub(super) fn keys(seed: u64, stream: u64, number: usize) -> Vec<u64> {
    let mut random = RandomNumbers::new(seed, stream);
    (0..number).map(|_| random.bits()).collect()
}

/// Converts 64 binary digits to a fraction, with the last digit set and the result truncated to the 53 digits of a
/// float. It lies inside the open interval, and is never moved upwards out of its dyadic interval.
pub(super) fn open_unit(bits: u64) -> f64 {
    let bits = bits | 1;
    let excess = 11_u32.saturating_sub(bits.leading_zeros());
    ((bits >> excess) << excess) as f64 * 2.0_f64.powi(-64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first outputs for the seed 1234567, as in the reference implementation by Vigna.
    #[test]
    fn hash_is_splitmix64() {
        let outputs = [1, 2, 3].map(|word| hash(1_234_567, word));
        assert_eq!(outputs, [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]);
    }

    #[test]
    fn unit_numbers_lie_inside_their_dyadic_interval() {
        assert_eq!(open_unit(0), 2.0_f64.powi(-64));
        assert_eq!(open_unit(u64::MAX), 1.0 - 2.0_f64.powi(-53));
        assert_eq!(open_unit(1 << 63), 0.5);
        assert_eq!(open_unit((1 << 63) - 1), 0.5 - 2.0_f64.powi(-54));
    }
}
