//! Counts of deviations in buckets whose width is between `2^-9` and `2^-8` of the deviation.

/// Number of fraction bits that distinguish buckets.
const FRACTION: u32 = 8;
const SHIFT: u32 = f64::MANTISSA_DIGITS - 1 - FRACTION;

/// Number of buckets between two powers of two.
const OCTAVE: i32 = 1 << FRACTION;

/// Deviations below `2^-24` of the scale, rounded down to a power of two, share one bucket.
const SMALLEST_SHARE: i32 = 24;

/// Exponent and leading digits of a magnitude; it increases with the magnitude.
#[inline(always)]
fn key(deviation: f64) -> i32 {
    (deviation.abs().to_bits() >> SHIFT) as i32
}

/// Positions of the buckets. Place 0 contains the reference, place 1 is the first one above it, place -1 the first
/// below.
#[derive(Clone, Copy)]
pub(super) struct Places {
    /// The smallest key outside place 0.
    smallest: i32,
}

impl Places {
    pub(super) fn of(scale: f64) -> Self {
        let octave = key(scale) / OCTAVE - SMALLEST_SHARE;
        Self { smallest: octave.max(1) * OCTAVE }
    }

    #[inline(always)]
    pub(super) fn of_deviation(self, deviation: f64) -> i32 {
        let bin = (key(deviation) - self.smallest + 1).max(0);
        if deviation < 0.0 { -bin } else { bin }
    }

    /// The smallest and largest deviation of a place.
    pub(super) fn edges(self, bin: i32) -> (f64, f64) {
        let magnitude = |key: i32| f64::from_bits(u64::from(key.unsigned_abs()) << SHIFT);
        let inner = magnitude(self.smallest + bin.abs() - 1);
        let outer = magnitude(self.smallest + bin.abs());
        match bin {
            0 => (-outer, outer),
            1.. => (inner, outer),
            _ => (-outer, -inner),
        }
    }
}

/// The counts of one octave of places.
type Octave = Box<[u64; OCTAVE as usize]>;

/// Counts by octaves of places, from the first nonempty one to the last. Empty octaves, such as most of those near the
/// reference, take no memory.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(into = "Vec<(i32, u64)>", try_from = "Vec<(i32, u64)>"))]
pub(super) struct Buckets {
    /// Index of the first octave.
    first: i32,
    octaves: Vec<Option<Octave>>,
}

impl Buckets {
    /// Allocates the octaves for the places from `least` to `greatest`.
    pub(super) fn reach(&mut self, least: i32, greatest: i32) {
        let (first, last) = (least.div_euclid(OCTAVE), greatest.div_euclid(OCTAVE));
        if self.octaves.is_empty() {
            self.first = first;
        }
        if first < self.first {
            let missing = self.first - first;
            self.octaves.splice(..0, (0..missing).map(|_| None));
            self.first = first;
        }
        let length = (last + 1 - self.first).unsigned_abs() as usize;
        if length > self.octaves.len() {
            self.octaves.resize(length, None);
        }
    }

    /// Counts deviations at these places, which must be allocated.
    #[inline(always)]
    pub(super) fn count(&mut self, places: &[i32]) {
        places.iter().for_each(|bin| self.count_equal(*bin, 1));
    }

    /// Counts `number` deviations at one place, which must be allocated.
    #[inline(always)]
    pub(super) fn count_equal(&mut self, bin: i32, number: u64) {
        let octave = (bin.div_euclid(OCTAVE) - self.first) as usize;
        if let Some(octave) = self.octaves.get_mut(octave) {
            let counts = octave.get_or_insert_with(empty);
            counts[bin.rem_euclid(OCTAVE) as usize] += number;
        }
    }

    pub(super) fn merge(&mut self, other: &Self) {
        if other.octaves.is_empty() {
            return;
        }
        let last = other.first + other.octaves.len() as i32 - 1;
        self.reach(other.first * OCTAVE, last * OCTAVE);
        let start = (other.first - self.first).unsigned_abs() as usize;
        for (octave, other) in self.octaves[start..].iter_mut().zip(&other.octaves) {
            match (octave, other) {
                (octave @ None, other) => octave.clone_from(other),
                (Some(own), Some(other)) => {
                    own.iter_mut().zip(&**other).for_each(|(x, other)| *x += other);
                }
                (Some(_), None) => {}
            }
        }
    }

    /// The places with values and their counts, in order.
    pub(super) fn counted(&self) -> impl Iterator<Item = (i32, u64)> {
        let octaves = (self.first..).zip(&self.octaves);
        octaves
            .flat_map(|(octave, counts)| {
                let counts = counts.iter().flat_map(|counts| counts.iter());
                (octave * OCTAVE..).zip(counts)
            })
            .filter(|(_, count)| **count > 0)
            .map(|(bin, count)| (bin, *count))
    }

    /// The sum of all counts; `None` if the octaves are not those from `least` to `greatest`.
    #[cfg(feature = "serde")]
    pub(super) fn total(&self, least: i32, greatest: i32) -> Option<u64> {
        let mut expected = Self::default();
        if !self.octaves.is_empty() {
            expected.reach(least, greatest);
        }
        let fits = (expected.first, expected.octaves.len()) == (self.first, self.octaves.len());
        let sum = self.counted().try_fold(0_u64, |sum, (_, count)| sum.checked_add(count))?;
        fits.then_some(sum)
    }
}

#[cold]
fn empty() -> Octave {
    Box::new([0; OCTAVE as usize])
}

/// Only nonempty places are written, because most are empty.
#[cfg(feature = "serde")]
impl From<Buckets> for Vec<(i32, u64)> {
    fn from(buckets: Buckets) -> Self {
        buckets.counted().collect()
    }
}

#[cfg(feature = "serde")]
impl TryFrom<Vec<(i32, u64)>> for Buckets {
    type Error = &'static str;

    fn try_from(counted: Vec<(i32, u64)>) -> Result<Self, &'static str> {
        // The limits for arbitrary numbers.
        let greatest = key(f64::MAX);
        let known = |bin: i32| (-greatest..=greatest).contains(&bin);
        if !counted.iter().all(|(bin, count)| known(*bin) && *count > 0)
            || !counted.is_sorted_by(|(before, _), (bin, _)| before < bin)
        {
            return Err("these are not the buckets of a sketch");
        }
        let mut buckets = Self::default();
        if let (Some(first), Some(last)) = (counted.first(), counted.last()) {
            buckets.reach(first.0, last.0);
        }
        for (bin, count) in counted {
            buckets.count_equal(bin, count);
        }
        Ok(buckets)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buckets_are_a_256th_of_their_deviation_wide() {
        let places = Places::of(1.0);
        for magnitude in [1e-7, 0.3, 1.0, 1.999, 7e12, 2e300] {
            let bin = places.of_deviation(magnitude);
            let (lower, upper) = places.edges(bin);
            assert!(lower <= magnitude && magnitude < upper);
            assert!(upper - lower <= lower / 256.0 && upper - lower >= lower / 512.0);
            assert_eq!(places.of_deviation(-magnitude), -bin);
            assert_eq!(places.edges(-bin), (-upper, -lower));
            assert_eq!(places.edges(bin - 1).1, lower);
        }
        let smallest = 0.5_f64.powi(24);
        assert_eq!(places.edges(0), (-smallest, smallest));
        assert_eq!(places.edges(1).0, smallest);
        for (deviation, bin) in [(smallest, 1), (-smallest, -1), (0.9999 * smallest, 0), (-0.0, 0)] {
            assert_eq!(places.of_deviation(deviation), bin);
        }
        assert_eq!(places.of_deviation(2.0) - places.of_deviation(1.0), OCTAVE);
    }

    #[test]
    fn any_scale_has_places() {
        for scale in [f64::from_bits(1), f64::MIN_POSITIVE, 1e300] {
            let places = Places::of(scale);
            assert_eq!(places.of_deviation(0.0), 0);
            assert!(places.of_deviation(2e300) > 0 && places.edges(0).1 > 0.0);
        }
    }

    #[test]
    fn octaves_without_values_take_no_room() {
        let mut far = Buckets::default();
        far.reach(-9000, 7000);
        far.count(&[7000, -9000, 7000]);
        assert_eq!(far.octaves.iter().flatten().count(), 2);
        let mut near = Buckets::default();
        near.reach(0, 1);
        near.count(&[0, 1]);
        let (mut one, mut other) = (far.clone(), near.clone());
        one.merge(&near);
        other.merge(&far);
        assert_eq!(one, other);
        let all: Vec<_> = one.counted().collect();
        assert_eq!(all, [(-9000, 1), (0, 1), (1, 1), (7000, 2)]);
        assert_eq!(one.octaves.iter().flatten().count(), 3);
    }

    #[cfg(feature = "serde")]
    #[test]
    fn a_bucket_is_read_once() {
        let read = |counted: &[(i32, u64)]| Buckets::try_from(counted.to_vec());
        assert!(read(&[(-3, 1), (5, 2)]).is_ok());
        assert!(read(&[(5, 1), (5, 2)]).is_err());
        assert!(read(&[(5, 1), (-3, 2)]).is_err());
    }
}
