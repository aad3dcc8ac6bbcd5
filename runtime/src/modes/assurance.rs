//! Identity of modes: which mode here is which mode there (modal assurance criterion), and which cannot be told apart.

use crate::Modes;
use crate::array::{Square, form, times};

/// Modal assurance criterion weighted with a mass matrix: `matrix[i][j]` is the squared cosine between shape `i` of
/// `from` and shape `j` of `to` (1: same shape, 0: orthogonal).
pub fn assurance<const N: usize>(
    from: &Modes<N>,
    to: &Modes<N>,
    mass: &[[f64; N]; N],
) -> [[f64; N]; N] {
    let weighted: Square<N> = core::array::from_fn(|j| times(mass, &to.modes[j].shape));
    let to_size: [f64; N] =
        core::array::from_fn(|j| crate::array::dot(&weighted[j], &to.modes[j].shape));
    core::array::from_fn(|i| {
        let shape = &from.modes[i].shape;
        let size = form(shape, mass, shape);
        core::array::from_fn(|j| {
            let product = crate::array::dot(shape, &weighted[j]);
            let scale = size * to_size[j];
            if scale > 0.0 {
                product * product / scale
            } else {
                0.0
            }
        })
    })
}

/// For each mode of `from` the position of the mode of `to` that is the same motion: `order[i]`.
///
/// Pairs are taken in descending order of assurance, ties by position, so the answer is a permutation and is the same
/// every time.
pub fn match_modes<const N: usize>(
    from: &Modes<N>,
    to: &Modes<N>,
    mass: &[[f64; N]; N],
) -> [usize; N] {
    if N < 2 {
        return [0; N];
    }
    let table = assurance(from, to, mass);
    // The shapes of one set are orthogonal, so a row has at most one element above one half.
    if (0..N).all(|i| table[i][i] > 0.6) {
        return core::array::from_fn(|i| i);
    }
    let mut order = [0; N];
    let (mut from_used, mut to_used) = ([false; N], [false; N]);
    for _ in 0..N {
        let mut best = None;
        for i in (0..N).filter(|&i| !from_used[i]) {
            for j in (0..N).filter(|&j| !to_used[j]) {
                if best.is_none_or(|(_, _, most)| table[i][j] > most) {
                    best = Some((i, j, table[i][j]));
                }
            }
        }
        if let Some((i, j, _)) = best {
            order[i] = j;
            from_used[i] = true;
            to_used[j] = true;
        }
    }
    order
}

/// Marks the modes whose eigenvalue lies within `gap` of another one, relative to the larger of the two: they share a
/// cluster and have no derivative of their own.
pub fn clusters<const N: usize>(modes: &Modes<N>, gap: f64) -> [bool; N] {
    core::array::from_fn(|i| {
        let own = modes.modes[i].lambda;
        (0..N).any(|j| {
            let other = modes.modes[j].lambda;
            i != j && (own - other).abs() <= gap * own.abs().max(other.abs())
        })
    })
}
