//! Statistics gathered by lane.

use super::super::statistics::Moments;
use crate::scalar::{Batch, Lanes};

/// Sums over the accepted samples of a chunk, by place in the batch; merged in that order, whatever the vectors were.
pub(in crate::tolerance) struct Sums {
    count: usize,
    modes: Vec<Mode>,
}

/// Of the deviation from the nominal frequency, which loses no digits as the frequency itself would.
#[derive(Clone, Copy)]
struct Mode {
    sum: Batch,
    squares: Batch,
    min: Batch,
    max: Batch,
}

impl Sums {
    pub(in crate::tolerance) fn new(n: usize) -> Self {
        let empty = Mode {
            sum: Batch::all(0.0),
            squares: Batch::all(0.0),
            min: Batch::all(f64::INFINITY),
            max: Batch::all(f64::NEG_INFINITY),
        };
        Self {
            count: 0,
            modes: vec![empty; n],
        }
    }

    /// Counts accepted samples.
    pub(super) fn count(&mut self, number: u32) {
        self.count += number as usize;
    }

    /// Adds the deviations of mode `r` in the states from `at` on where `accepted` is one.
    #[inline(always)]
    pub(super) fn add<V: Lanes>(&mut self, r: usize, at: usize, deviation: V, accepted: V) {
        let mode = &mut self.modes[r];
        let own = V::constant(1.0).at_most(accepted);
        let value = V::choose(own, deviation, V::constant(0.0));
        (V::load(&mode.sum, at) + value).store(&mut mode.sum, at);
        (V::load(&mode.squares, at) + value * value).store(&mut mode.squares, at);
        let (min, max) = (V::load(&mode.min, at), V::load(&mode.max, at));
        let least = V::choose(own, deviation, min);
        V::choose(least.at_most(min), least, min).store(&mut mode.min, at);
        let most = V::choose(own, deviation, max);
        V::choose(max.at_most(most), most, max).store(&mut mode.max, at);
    }

    /// Moments of the frequency of mode `r`, whose nominal value is `frequency`.
    pub(in crate::tolerance) fn frequency(&self, r: usize, frequency: f64) -> Moments {
        let mode = &self.modes[r];
        let total = |batch: &Batch| batch.0.iter().sum::<f64>();
        let least = mode.min.0.iter().copied().fold(f64::INFINITY, f64::min);
        let most = mode.max.0.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Moments::of_deviations(
            self.count,
            frequency,
            (total(&mode.sum), total(&mode.squares)),
            (least, most),
        )
    }

    /// Moments of the damping ratio: undamped modes have none.
    pub(in crate::tolerance) fn damping_ratio(&self) -> Moments {
        Moments::of_deviations(self.count, 0.0, (0.0, 0.0), (0.0, 0.0))
    }
}
