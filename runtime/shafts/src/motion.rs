//! Motions of all unknowns.

use eigentol_numerics::Complex;
use eigentol_numerics::algebra::Vector;

use crate::chain::Along;

/// A motion of all unknowns, or the weights of all equations.
#[derive(Clone, Debug)]
pub struct Motion {
    /// At the stations.
    pub stations: Vector<Complex>,
    pub(crate) spans: Vec<Vec<Along>>,
}

/// Which directions of planar motion a vector has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kept {
    All,
    /// Of a real motion, whose second is the conjugate of the first.
    First,
}

/// Of which side a vector is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Right,
    Left,
}

impl Motion {
    pub(crate) fn add(&mut self, factor: Complex, other: &Self) {
        let others: Vec<&[Complex]> = other.lists().collect();
        for (to, from) in self.lists_mut().zip(others) {
            to.iter_mut().zip(from).for_each(|(to, from)| *to += factor * from);
        }
    }

    pub(crate) fn scale(&mut self, factor: Complex) {
        self.lists_mut().flatten().for_each(|x| *x *= factor);
    }

    /// Scales to one; returns the factor.
    pub(crate) fn normalise(&mut self) -> f64 {
        let factor = self.flat().map(|x| x.norm_sqr()).sum::<f64>().sqrt().recip();
        self.scale(Complex::new(factor, 0.0));
        factor
    }

    /// The sum of the weights of all equations times the loads there.
    pub(crate) fn product(&self, loads: &Self) -> Complex {
        self.flat().zip(loads.flat()).map(|(a, b)| a * b).sum()
    }

    /// The unknowns of the stations and of the elements; those of the nodes are among them.
    fn lists(&self) -> impl Iterator<Item = &[Complex]> {
        core::iter::once(&self.stations[..]).chain(self.spans.iter().flatten().map(|along| &along.inner[..]))
    }

    fn lists_mut(&mut self) -> impl Iterator<Item = &mut [Complex]> {
        let spans = self.spans.iter_mut().flatten().map(|along| &mut along.inner[..]);
        core::iter::once(&mut self.stations[..]).chain(spans)
    }

    /// All numbers, for products of vectors.
    pub(crate) fn flat(&self) -> impl Iterator<Item = Complex> + '_ {
        self.lists().flatten().copied()
    }

    /// Adds all numbers of a real motion, times a factor, to a list.
    pub(crate) fn reals_into(&self, factor: f64, to: &mut Vec<f64>) {
        to.extend(self.stations.iter().map(|x| factor * x.re));
        for along in self.spans.iter().flatten() {
            for x in &along.inner {
                to.extend_from_slice(&[factor * x.re, factor * x.im]);
            }
        }
    }

    /// Sets them, in the same order.
    pub(crate) fn set_reals(&mut self, from: &[f64], factor: f64) {
        let (stations, within) = from.split_at(self.stations.len());
        self.stations.iter_mut().zip(stations).for_each(|(to, x)| *to = Complex::new(factor * x, 0.0));
        let mut within = within;
        for along in self.spans.iter_mut().flatten() {
            let (own, rest) = within.split_at(2 * along.inner.len());
            let pairs = along.inner.iter_mut().zip(own.chunks_exact(2));
            pairs.for_each(|(to, x)| *to = Complex::new(factor * x[0], factor * x[1]));
            within = rest;
        }
    }
}
