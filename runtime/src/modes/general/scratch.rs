//! Room to work in: on the stack up to eight coordinates, on the heap beyond.

use num_complex::Complex64;

use super::measure::Pair;

/// Numbers of every kind, taken from the front.
pub(super) struct Work<'a> {
    pub(super) real: &'a mut [f64],
    pub(super) complex: &'a mut [Complex64],
    pub(super) indices: &'a mut [usize],
    pub(super) flags: &'a mut [bool],
    pub(super) pairs: &'a mut [Pair],
}

/// Numbers of each kind that a problem of size `n` needs, in units of `n` times `n`.
const REALS: usize = 24;
const COMPLEXES: usize = 17;

fn on_stack<const N: usize, T>(job: impl FnOnce(&mut Work) -> T) -> T {
    job(&mut Work {
        real: [[[0.0; N]; N]; REALS].as_flattened_mut().as_flattened_mut(),
        complex: [[[Complex64::ZERO; N]; N]; COMPLEXES]
            .as_flattened_mut()
            .as_flattened_mut(),
        indices: [[0; N]; 6].as_flattened_mut(),
        flags: [[false; N]; 4].as_flattened_mut(),
        pairs: [[Pair::NONE; N]; 2].as_flattened_mut(),
    })
}

/// Gives `job` the room that `n` coordinates need.
pub(super) fn with_work<T>(n: usize, job: impl FnOnce(&mut Work) -> T) -> T {
    match n {
        0..=2 => on_stack::<2, T>(job),
        3..=4 => on_stack::<4, T>(job),
        5..=8 => on_stack::<8, T>(job),
        _ => job(&mut Work {
            real: &mut vec![0.0; REALS * n * n],
            complex: &mut vec![Complex64::ZERO; COMPLEXES * n * n],
            indices: &mut vec![0; 6 * n],
            flags: &mut vec![false; 4 * n],
            pairs: &mut vec![Pair::NONE; 2 * n],
        }),
    }
}

/// Takes the next `count` numbers of a store.
pub(super) fn take<'a, T>(store: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    let (taken, rest) = std::mem::take(store).split_at_mut(count);
    *store = rest;
    taken
}
