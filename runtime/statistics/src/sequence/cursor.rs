//! Sequential iteration over points.

use super::random::draw;
use super::{Kind, Sequence};
use crate::random::RandomNumbers;

/// Iterates over a [`Sequence`]: see [`Sequence::from`].
#[derive(Clone, Debug)]
pub struct Cursor<'a> {
    sequence: &'a Sequence,
    next: u64,
    state: State,
    point: Vec<f64>,
}

/// Data that one point leaves for the next.
#[derive(Clone, Debug)]
enum State {
    Random(Box<RandomNumbers>),
    Sobol(Vec<u64>),
    Nothing,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(sequence: &'a Sequence, first: u64) -> Self {
        let first = first.min(sequence.points);
        let state = match &sequence.kind {
            Kind::Random(random) => State::Random(random.at(first).into()),
            Kind::Sobol(sobol) => State::Sobol(sobol.digits(first)),
            Kind::LatinHypercube(_) => State::Nothing,
        };
        Self { sequence, next: first, state, point: vec![0.5; sequence.dimensions] }
    }

    /// Coordinates of the next point, strictly between 0 and 1; `None` after the last one.
    pub fn next_point(&mut self) -> Option<&[f64]> {
        let k = self.next;
        if k >= self.sequence.points {
            return None;
        }
        match (&self.sequence.kind, &mut self.state) {
            (Kind::Sobol(sobol), State::Sobol(digits)) => {
                sobol.write(digits, &mut self.point);
                sobol.advance(k, digits);
            }
            (Kind::LatinHypercube(sample), _) => sample.write(k, &mut self.point),
            (_, State::Random(random)) => draw(random, &mut self.point),
            _ => return None,
        }
        self.next += 1;
        Some(&self.point)
    }
}
