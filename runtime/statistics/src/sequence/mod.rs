//! Point sets in the open unit cube, for sampling.
//!
//! Point `k` depends only on the settings, the seed, the stream and `k`, and has the same bits on every machine, so a
//! set can be divided in any way. Point sets of different streams are independent, so the scatter of a mean over a few
//! streams shows how accurate the mean is.
//!
//! | points | error of a mean over `n` points |
//! | --- | --- |
//! | [`Sequence::random`] | `n^-1/2` for any function |
//! | [`Sequence::latin_hypercube`] | as for random points, without the part that is a sum of functions of one variable each |
//! | [`Sequence::sobol`] | nearly `n^-3/2` for a smooth function of few variables |

mod bits;
mod cursor;
mod direction_numbers;
mod latin_hypercube;
#[cfg(test)]
mod net_tests;
mod permutation;
mod random;
mod scrambling;
mod sobol;
#[cfg(test)]
mod tests;

use crate::Error;
use direction_numbers::MAX_DIMENSIONS;
use latin_hypercube::LatinHypercube;
use random::{Random, draw};
use scrambling::DIGITS;
use sobol::Sobol;

pub use cursor::Cursor;

/// A point set in the open unit cube of some dimension.
///
/// ```
/// use eigentol_statistics::sequence::Sequence;
///
/// let sequence = Sequence::sobol(2, 7, 0)?;
/// let mut walk = sequence.from(0);
/// let mut sum = 0.0;
/// for _ in 0..1024 {
///     let Some(point) = walk.next_point() else { break };
///     sum += point[0] * point[1];
/// }
/// assert!((sum / 1024.0 - 0.25).abs() < 1e-4);
///
/// let mut point = [0.0; 2];
/// sequence.point(1_000_000, &mut point)?;
/// assert_eq!(sequence.from(1_000_000).next_point(), Some(&point[..]));
/// # Ok::<(), eigentol_statistics::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Sequence {
    dimensions: usize,
    points: u64,
    kind: Kind,
}

#[derive(Clone, Debug)]
enum Kind {
    Random(Random),
    LatinHypercube(LatinHypercube),
    Sobol(Sobol),
}

impl Sequence {
    /// Independent random points from the ChaCha8 generator.
    ///
    /// # Errors
    /// [`Error::Setting`] for zero dimensions.
    pub fn random(dimensions: usize, seed: u64, stream: u64) -> Result<Self, Error> {
        let random = Random { dimensions, seed, stream };
        Self::new(dimensions, u64::MAX, || Kind::Random(random))
    }

    /// A Latin hypercube sample of `points` points (McKay, Beckman and Conover, Technometrics 21, 1979): in each
    /// dimension, every interval `p/n..(p+1)/n` contains one of the `n` points, at a random place.
    ///
    /// # Errors
    /// [`Error::Setting`] for zero dimensions, zero points or more than 2^32 points.
    pub fn latin_hypercube(dimensions: usize, points: u64, seed: u64, stream: u64) -> Result<Self, Error> {
        if points == 0 || points > 1 << 32 {
            return Err(Error::setting("points", format!("a Latin hypercube has between 1 and 2^32, not {points}")));
        }
        Self::new(dimensions, points, || Kind::LatinHypercube(LatinHypercube::new(dimensions, points, seed, stream)))
    }

    /// The first 2^36 points of the Sobol' sequence with the direction numbers of Joe and Kuo (SIAM J. Sci. Comput. 30,
    /// 2008) and nested uniform scrambling (Owen 1995). Use `2^m` points starting at a multiple of `2^m`: only such
    /// sets are balanced.
    ///
    /// # Errors
    /// [`Error::Setting`] for zero or more than 2048 dimensions.
    pub fn sobol(dimensions: usize, seed: u64, stream: u64) -> Result<Self, Error> {
        Self::new_sobol(dimensions, || Sobol::scrambled(dimensions, seed, stream))
    }

    /// The Sobol' sequence without scrambling. Each coordinate is 2^-37 larger than in the literature, where the first
    /// point is 0.
    ///
    /// # Errors
    /// Those of [`Sequence::sobol`].
    pub fn unscrambled_sobol(dimensions: usize) -> Result<Self, Error> {
        Self::new_sobol(dimensions, || Sobol::plain(dimensions))
    }

    fn new_sobol(dimensions: usize, sobol: impl FnOnce() -> Sobol) -> Result<Self, Error> {
        if dimensions > MAX_DIMENSIONS {
            return Err(Error::setting(
                "dimensions",
                format!(
                    "a Sobol' sequence has at most {MAX_DIMENSIONS}, not {dimensions}: take random points or a Latin hypercube"
                ),
            ));
        }
        Self::new(dimensions, 1 << DIGITS, || Kind::Sobol(sobol()))
    }

    fn new(dimensions: usize, points: u64, kind: impl FnOnce() -> Kind) -> Result<Self, Error> {
        if dimensions == 0 {
            return Err(Error::setting("dimensions", "a point has at least one coordinate"));
        }
        Ok(Self { dimensions, points, kind: kind() })
    }

    /// Number of coordinates of a point.
    pub fn dimensions(&self) -> usize {
        self.dimensions
    }

    /// Number of points in the set: that of a Latin hypercube, 2^36 for a Sobol' sequence, `u64::MAX` for random
    /// points.
    pub fn points(&self) -> u64 {
        self.points
    }

    /// Writes the coordinates of point `k`, strictly between 0 and 1.
    ///
    /// # Errors
    /// [`Error::WrongLength`] if `into` does not have one place per dimension, [`Error::BeyondLast`] if there is no
    /// point `k`.
    pub fn point(&self, k: u64, into: &mut [f64]) -> Result<(), Error> {
        if into.len() != self.dimensions {
            return Err(Error::WrongLength { kind: "coordinates", found: into.len(), expected: self.dimensions });
        }
        if k >= self.points {
            return Err(Error::BeyondLast { kind: "point", index: k, number: self.points });
        }
        match &self.kind {
            Kind::Random(random) => draw(&mut random.at(k), into),
            Kind::LatinHypercube(sample) => sample.write(k, into),
            Kind::Sobol(sobol) => sobol.write(&sobol.digits(k), into),
        }
        Ok(())
    }

    /// Iterates over the points, starting at point `first`; faster than computing them individually.
    pub fn from(&self, first: u64) -> Cursor<'_> {
        Cursor::new(self, first)
    }
}
