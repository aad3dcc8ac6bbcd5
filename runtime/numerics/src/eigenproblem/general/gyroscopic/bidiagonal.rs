//! Singular values and vectors of a bidiagonal matrix by implicit QR steps (Golub and Kahan 1965), with the shift zero
//! where it is negligible (Demmel and Kahan, "Accurate singular values of bidiagonal matrices", 1990).

use crate::scalar::Real;

/// Bound on the steps per singular value; about two are needed.
const STEPS: usize = 60;

/// Diagonalises `B` with `diagonal` and the elements `beside` above it. `diagonal` becomes the singular values, in no
/// particular order and not negative; rows `k` of `left` and `right`, unit matrices before, become the vectors `u` and
/// `v` of value `k`, `B v = sigma u`. `false` if the iteration did not converge.
pub(super) fn singular_values(diagonal: &mut [f64], beside: &mut [f64], left: &mut [f64], right: &mut [f64]) -> bool {
    f64::run(
        #[inline(always)]
        || iterate(diagonal, beside, left, right),
    )
}

#[inline(always)]
fn iterate(d: &mut [f64], f: &mut [f64], left: &mut [f64], right: &mut [f64]) -> bool {
    let n = d.len();
    let size = d.iter().chain(&*f).fold(0.0, |most: f64, x| most.max(x.abs()));
    let nothing = f64::EPSILON * f64::EPSILON * size;
    let mut steps = STEPS * n;
    let mut last = n.saturating_sub(1);
    while last > 0 {
        let first = active_start(d, f, last, nothing);
        if first == last {
            last -= 1;
            continue;
        }
        if steps == 0 {
            return false;
        }
        steps -= 1;
        match (first..last).find(|&k| d[k].abs() <= nothing) {
            Some(zero) => split(d, f, left, (zero, last)),
            None => step(d, f, left, right, (first, last)),
        }
    }
    for (d, v) in d.iter_mut().zip(right.chunks_exact_mut(n.max(1))) {
        if *d < 0.0 {
            *d = -*d;
            v.iter_mut().for_each(|x| *x = -*x);
        }
    }
    true
}

/// First row of the undivided block that ends in row `last`.
#[inline(always)]
fn active_start(d: &[f64], f: &mut [f64], last: usize, nothing: f64) -> usize {
    for k in (0..last).rev() {
        let beside = 0.5 * f64::EPSILON * (d[k].abs() + d[k + 1].abs());
        if f[k].abs() <= beside.max(nothing) {
            f[k] = 0.0;
            return k + 1;
        }
    }
    0
}

/// Rotations of rows that remove the element beside a zero on the diagonal.
#[inline(always)]
fn split(d: &mut [f64], f: &mut [f64], left: &mut [f64], (zero, last): (usize, usize)) {
    d[zero] = 0.0;
    let mut extra = std::mem::take(&mut f[zero]);
    for i in zero + 1..=last {
        let (c, s, r) = rotation(d[i], extra);
        d[i] = r;
        if i < last {
            extra = -s * f[i];
            f[i] *= c;
        }
        rotate(left, d.len(), (i, zero), c, s);
    }
}

/// One QR step on rows `first..=last`, the bulge chased down.
#[inline(always)]
fn step(d: &mut [f64], f: &mut [f64], left: &mut [f64], right: &mut [f64], (first, last): (usize, usize)) {
    let n = d.len();
    let shift = shift(d, f, first, last);
    let (mut y, mut z) = (d[first], f[first]);
    if shift > f64::EPSILON * y * y {
        y -= shift / y;
    }
    for i in first..last {
        let (c, s, r) = rotation(y, z);
        if i > first {
            f[i - 1] = r;
        }
        let (x, bulge) = (c * d[i] + s * f[i], s * d[i + 1]);
        f[i] = c * f[i] - s * d[i];
        d[i + 1] *= c;
        rotate(right, n, (i, i + 1), c, s);
        let (c, s, r) = rotation(x, bulge);
        d[i] = r;
        (f[i], d[i + 1]) = (c * f[i] + s * d[i + 1], c * d[i + 1] - s * f[i]);
        rotate(left, n, (i, i + 1), c, s);
        if i + 1 < last {
            (y, z) = (f[i], s * f[i + 1]);
            f[i + 1] *= c;
        }
    }
}

/// The eigenvalue of the last 2 x 2 block of `B^T B` that is nearer to its last element.
#[inline(always)]
fn shift(d: &[f64], f: &[f64], first: usize, last: usize) -> f64 {
    let before = if last > first + 1 { f[last - 2] } else { 0.0 };
    let (a, b, g) = (d[last - 1], d[last], f[last - 1]);
    let (above, off, corner) = (a * a + before * before, a * g, b * b + g * g);
    let half = 0.5 * (above - corner);
    let shift = corner - off * off / (half + half.hypot(off).copysign(half));
    if shift.is_finite() { shift } else { corner }
}

/// `(c, s, r)` with `c a + s b = r` and `c b - s a = 0`.
#[inline(always)]
fn rotation(a: f64, b: f64) -> (f64, f64, f64) {
    let r = a.hypot(b);
    if r == 0.0 { (1.0, 0.0, 0.0) } else { (a / r, b / r, r) }
}

/// Rows `i` and `j` become `c i + s j` and `c j - s i`.
#[inline(always)]
fn rotate(rows: &mut [f64], n: usize, (i, j): (usize, usize), c: f64, s: f64) {
    let (low, high) = (i.min(j), i.max(j));
    let (head, tail) = rows.split_at_mut(high * n);
    let (low_row, high_row) = (&mut head[low * n..(low + 1) * n], &mut tail[..n]);
    let s = if i < j { s } else { -s };
    for (x, y) in low_row.iter_mut().zip(high_row) {
        (*x, *y) = (c * *x + s * *y, c * *y - s * *x);
    }
}
