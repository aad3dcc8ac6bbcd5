//! Subsets of the samples of a chunk.

use std::ops::Range;

/// Number of samples summed as a unit. Chunk `c` has samples `256 c` to below `256 (c + 1)`.
pub const CHUNK: usize = 256;

const WORDS: usize = CHUNK / 64;

/// One bit per sample of a chunk.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Mask([u64; WORDS]);

impl Mask {
    pub(super) fn of(places: Range<usize>) -> Self {
        let first = |count: usize| match count {
            0..64 => (1 << count) - 1,
            _ => u64::MAX,
        };
        let up_to = |end: usize, k: usize| first(end.saturating_sub(64 * k));
        Self(std::array::from_fn(|k| up_to(places.end, k) & !up_to(places.start, k)))
    }

    pub(super) fn count(self) -> usize {
        self.0.iter().map(|word| word.count_ones() as usize).sum()
    }

    pub(super) fn has(self, index: usize) -> bool {
        let word = self.0.get(index / 64).copied().unwrap_or_default();
        word >> (index % 64) & 1 == 1
    }

    pub(super) fn set(&mut self, index: usize, to: bool) {
        if let Some(word) = self.0.get_mut(index / 64) {
            let bit = 1 << (index % 64);
            *word = if to { *word | bit } else { *word & !bit };
        }
    }

    pub(super) fn and(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] & other.0[k]))
    }

    pub(super) fn or(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] | other.0[k]))
    }

    /// Distributes bits for the places from `start` on over the word of that place and the next one.
    #[inline]
    fn words(start: usize, bits: u64) -> [(usize, u64); 2] {
        let (word, shift) = (start / 64, start % 64);
        [(word, bits << shift), (word + 1, (bits >> 1) >> (63 - shift))]
    }

    /// The lowest `count` bits set.
    #[inline]
    fn first(count: usize) -> u64 {
        u64::MAX.checked_shr(64 - count.min(64) as u32).unwrap_or(0)
    }

    /// Whether all of `count` places (at most 64) from `start` on are present.
    #[inline]
    pub(super) fn has_all(&self, start: usize, count: usize) -> bool {
        let has = |(word, among): (usize, u64)| {
            let bits = self.0.get(word).copied().unwrap_or(0);
            bits & among == among
        };
        count <= 64 && Self::words(start, Self::first(count)).into_iter().all(has)
    }

    /// Sets `count` places (at most 64) from `start` on to the lowest bits of `bits`.
    #[inline]
    pub(super) fn put(&mut self, start: usize, count: usize, bits: u64) {
        let among = Self::words(start, Self::first(count));
        for ((word, among), (_, bits)) in among.into_iter().zip(Self::words(start, bits)) {
            if let Some(word) = self.0.get_mut(word) {
                *word = *word & !among | bits & among;
            }
        }
    }

    pub(super) fn is_full(self) -> bool {
        self.0 == [u64::MAX; WORDS]
    }

    pub(super) fn is_empty(self) -> bool {
        self.0 == [0; WORDS]
    }

    pub(super) fn places(self) -> impl Iterator<Item = usize> {
        self.0.into_iter().enumerate().flat_map(|(k, word)| {
            let bits = std::iter::successors(Some(word), |left| Some(left & left.wrapping_sub(1)));
            bits.take_while(|left| *left != 0).map(move |left| 64 * k + left.trailing_zeros() as usize)
        })
    }

    /// The values at these places, packed: `values` itself or a part of `room`.
    #[inline(always)]
    pub(super) fn select<'a>(self, values: &'a [f64; CHUNK], room: &'a mut [f64; CHUNK]) -> &'a [f64] {
        if self.is_full() {
            return values;
        }
        let mut count = 0;
        for (to, index) in room.iter_mut().zip(self.places()) {
            *to = values[index];
            count += 1;
        }
        &room[..count]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_of_places() {
        for range in [0..1, 0..256, 63..65, 64..128, 100..100, 255..256, 3..200] {
            let mask = Mask::of(range.clone());
            assert!(mask.places().eq(range.clone()), "{range:?}");
            assert_eq!(mask.count(), range.len());
            assert_eq!((mask.is_full(), mask.is_empty()), (range.len() == 256, range.is_empty()));
            assert!((0..300).all(|place| mask.has(place) == range.contains(&place)));
        }
    }

    #[test]
    fn bits_from_any_place() {
        for start in [0, 5, 57, 60, 64, 100, 248] {
            for count in [0, 1, 8, 64] {
                let mut mask = Mask::of(3..250);
                let mut expected = mask;
                let bits = 0x9bd1_33a7_0f55_1293;
                mask.put(start, count, bits);
                for k in 0..count {
                    expected.set(start + k, bits >> k & 1 == 1);
                }
                assert_eq!(mask, expected, "{start} {count}");
                let whole = (start..start + count).all(|index| expected.has(index));
                assert_eq!(mask.has_all(start, count), whole, "{start} {count}");
            }
        }
        assert!(!Mask::of(0..256).has_all(250, 8) && !Mask::of(0..256).has_all(0, 65));
    }

    #[test]
    fn selected_values_are_side_by_side() {
        let values = std::array::from_fn(|k| k as f64);
        let mut room = [0.0; CHUNK];
        let mut mask = Mask::of(62..67);
        mask.set(64, false);
        assert_eq!(mask.select(&values, &mut room), [62.0, 63.0, 65.0, 66.0]);
        assert_eq!(Mask::of(0..256).select(&values, &mut room), values);
        assert!(Mask::default().select(&values, &mut room).is_empty());
    }
}
