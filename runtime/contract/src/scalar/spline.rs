//! Curves through tabulated points.

/// A cubic spline, or its derivative of order `derivative`, at `x`.
///
/// Each piece consists of its start and four coefficients: `c0 + c1 t + c2 t^2 + c3 t^3` with `t = x - start`. The
/// first piece applies before the starts of all others. The piece is found by counting starts, without a branch. Zero
/// if there are no pieces.
///
/// ```
/// # use eigentol_contract as eigentol;
/// use eigentol::scalar::spline;
///
/// // x^2 from 0 on, 0 before
/// let pieces = [[0.0, 0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0, 0.0]];
/// assert_eq!([0, 1, 2, 3].map(|order| spline(3.0, &pieces, order)), [9.0, 6.0, 2.0, 0.0]);
/// assert_eq!(spline(-3.0, &pieces, 0), 0.0);
/// ```
#[inline]
#[must_use]
pub fn spline(x: f64, pieces: &[[f64; 5]], derivative: usize) -> f64 {
    let Some((first, rest)) = pieces.split_first() else {
        return 0.0;
    };
    let mut started = 0;
    for piece in rest {
        started += usize::from(x >= piece[0]);
    }
    let [start, c0, c1, c2, c3] = *started.checked_sub(1).map_or(first, |last| &rest[last]);
    let t = x - start;
    match derivative {
        0 => c0 + t * (c1 + t * (c2 + t * c3)),
        1 => c1 + t * (2.0 * c2 + t * (3.0 * c3)),
        2 => 2.0 * c2 + t * (6.0 * c3),
        3 => 6.0 * c3,
        _ => 0.0,
    }
}
