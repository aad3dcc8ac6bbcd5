//! Eigenvalues of a Hessenberg matrix by double-shift QR iteration. It follows LAPACK's `dlahqr` and `dlanv2` in
//! features whose absence makes textbook versions hang or lose digits: the deflation criterion of Ahues and Tisseur
//! (LAPACK Working Note 122), exceptional shifts, and a bound on the iterations.

use core::ops::Range;

use num_complex::Complex64;

use super::scaling::largest;
use crate::scalar::Real;

const ULP: f64 = f64::EPSILON;
/// Number of steps without deflation from one exceptional shift to the next.
const EXCEPTIONAL: usize = 10;

/// Eigenvalues of an upper Hessenberg matrix, row by row, which is destroyed; conjugate pairs are adjacent, the one with positive
/// imaginary part first. Returns the number of steps; `None` if the iteration did not converge.
pub fn eigenvalues(n: usize, h: &mut [f64], values: &mut [Complex64]) -> Option<usize> {
    let small = negligible(n, h);
    let most_steps = 30 * n.max(10);
    let mut end = n;
    let mut steps = 0;
    while end > 0 {
        let last = end - 1;
        let mut first = 0;
        let mut converged = false;
        for step in 1..=most_steps {
            first = active_start(n, h, first, last, small);
            if first > 0 {
                h[first * n + first - 1] = 0.0;
            }
            if first + 1 >= last {
                converged = true;
                break;
            }
            steps += 1;
            let shifts = shifts(n, h, first, last, step);
            f64::run(
                #[inline(always)]
                || sweep(n, h, first, last, shifts),
            );
        }
        if !converged {
            return None;
        }
        if first == last {
            values[last] = Complex64::new(h[last * n + last], 0.0);
        } else {
            let block = [h[first * n + first], h[first * n + last], h[last * n + first], h[last * n + last]];
            [values[first], values[last]] = two(block);
        }
        end = first;
    }
    Some(steps)
}

/// Size below which an element of `h` is zero. On a diagonal that is exactly zero no other criterion can find it
/// small; its square must not underflow before it does.
fn negligible(n: usize, h: &[f64]) -> f64 {
    f64::MIN_POSITIVE.sqrt() * (n as f64 / ULP) * largest(&h[..n * n])
}

/// First row of the unreduced block that ends in row `last`.
fn active_start(n: usize, h: &[f64], first: usize, last: usize, small: f64) -> usize {
    let at = |i: usize, j: usize| h[i * n + j].abs();
    let mut k = last;
    while k > first {
        let below = at(k, k - 1);
        if below <= small {
            break;
        }
        let mut test = at(k - 1, k - 1) + at(k, k);
        if test == 0.0 {
            if k >= 2 {
                test += at(k - 1, k - 2);
            }
            if k + 1 < n {
                test += at(k + 1, k);
            }
        }
        if below <= ULP * test {
            let above = at(k - 1, k);
            let (ab, ba) = (below.max(above), below.min(above));
            let corner = at(k, k);
            let difference = (h[(k - 1) * n + k - 1] - h[k * n + k]).abs();
            let (aa, bb) = (corner.max(difference), corner.min(difference));
            let sum = aa + ab;
            if ba * (ab / sum) <= small.max(ULP * (bb * (aa / sum))) {
                break;
            }
        }
        k -= 1;
    }
    k
}

/// The two shifts of a step, a conjugate pair or a double real one.
fn shifts(n: usize, h: &[f64], first: usize, last: usize, step: usize) -> [Complex64; 2] {
    let at = |i: usize, j: usize| h[i * n + j];
    let exceptional = |corner: f64, size: f64| {
        let diagonal = 0.75 * size + corner;
        [diagonal, -0.4375 * size, size, diagonal]
    };
    let [h11, h12, h21, h22] = if step.is_multiple_of(2 * EXCEPTIONAL) {
        let size = at(last, last - 1).abs() + at(last - 1, last - 2).abs();
        exceptional(at(last, last), size)
    } else if step.is_multiple_of(EXCEPTIONAL) {
        let size = at(first + 1, first).abs() + at(first + 2, first + 1).abs();
        exceptional(at(first, first), size)
    } else {
        [at(last - 1, last - 1), at(last - 1, last), at(last, last - 1), at(last, last)]
    };
    let size = h11.abs() + h12.abs() + h21.abs() + h22.abs();
    if size == 0.0 {
        return [Complex64::ZERO; 2];
    }
    let inverse = 1.0 / size;
    let (h11, h12, h21, h22) = (h11 * inverse, h12 * inverse, h21 * inverse, h22 * inverse);
    let mean = 0.5 * (h11 + h22);
    let determinant = (h11 - mean) * (h22 - mean) - h12 * h21;
    let root = determinant.abs().sqrt();
    if determinant >= 0.0 {
        let shift = Complex64::new(mean * size, root * size);
        return [shift, shift.conj()];
    }
    let (high, low) = (mean + root, mean - root);
    let nearer = if (high - h22).abs() <= (low - h22).abs() { high } else { low };
    [Complex64::new(nearer * size, 0.0); 2]
}

/// One implicit double-shift step on rows and columns `first..=last`, at least three.
#[inline(always)]
fn sweep(n: usize, h: &mut [f64], first: usize, last: usize, [one, two]: [Complex64; 2]) {
    let mut start = last - 2;
    let mut v;
    loop {
        let m = start;
        let diagonal = h[m * n + m];
        let below = h[(m + 1) * n + m];
        let size = (diagonal - two.re).abs() + two.im.abs() + below.abs();
        let inverse = 1.0 / size;
        let ratio = below * inverse;
        let next = h[(m + 1) * n + m + 1];
        v = [
            ratio * h[m * n + m + 1] + (diagonal - one.re) * ((diagonal - two.re) * inverse)
                - one.im * (two.im * inverse),
            ratio * (diagonal + next - one.re - two.re),
            ratio * h[(m + 2) * n + m + 1],
        ];
        if m == first {
            break;
        }
        let before = h[(m - 1) * n + m - 1].abs();
        if h[m * n + m - 1].abs() * (v[1].abs() + v[2].abs())
            <= ULP * v[0].abs() * (before + diagonal.abs() + next.abs())
        {
            break;
        }
        start -= 1;
    }
    let mut wave = Wave::new(start);
    for k in start..last - 1 {
        if k > start {
            v = [h[k * n + k - 1], h[(k + 1) * n + k - 1], h[(k + 2) * n + k - 1]];
        }
        let (beta, tau, v2, v3) = reflector(v);
        if k > start {
            h[k * n + k - 1] = beta;
            h[(k + 1) * n + k - 1] = 0.0;
            h[(k + 2) * n + k - 1] = 0.0;
        } else if start > first {
            h[k * n + k - 1] *= 1.0 - tau;
        }
        let reflector = Reflector { tau, v2, v3, t2: tau * v2, t3: tau * v3 };
        reflector.reflect_rows(&mut h[k * n..(k + 3) * n], n, k..last + 1);
        if wave.count == WAVE {
            wave.reflect_columns(n, h, first);
            wave = Wave::new(k);
        }
        for row in h[wave.start * n..(last.min(k + 3) + 1) * n].chunks_exact_mut(n) {
            let [a, b, c] = reflector.reflected([row[k], row[k + 1], row[k + 2]]);
            (row[k], row[k + 1], row[k + 2]) = (a, b, c);
        }
        wave.reflectors[wave.count] = reflector;
        wave.count += 1;
    }
    wave.reflect_columns(n, h, first);
    let k = last - 1;
    let (beta, tau, v2, _) = reflector([h[k * n + k - 1], h[last * n + k - 1], 0.0]);
    (h[k * n + k - 1], h[last * n + k - 1]) = (beta, 0.0);
    let t2 = tau * v2;
    for j in k..=last {
        let sum = h[k * n + j] + v2 * h[last * n + j];
        h[k * n + j] -= sum * tau;
        h[last * n + j] -= sum * t2;
    }
    for row in h[first * n..(last + 1) * n].chunks_exact_mut(n) {
        let sum = row[k] + v2 * row[last];
        row[k] -= sum * tau;
        row[last] -= sum * t2;
    }
}

/// `I - tau v v^T` on three components, `v = (1, v2, v3)`.
#[derive(Clone, Copy, Default)]
struct Reflector {
    tau: f64,
    v2: f64,
    v3: f64,
    t2: f64,
    t3: f64,
}

impl Reflector {
    #[inline(always)]
    fn reflected(&self, [a, b, c]: [f64; 3]) -> [f64; 3] {
        let sum = a + self.v2 * b + self.v3 * c;
        [a - sum * self.tau, b - sum * self.t2, c - sum * self.t3]
    }

    /// Applies it to some columns of three rows.
    #[inline(always)]
    fn reflect_rows(&self, rows: &mut [f64], n: usize, columns: Range<usize>) {
        let (first, rest) = rows.split_at_mut(n);
        let (second, third) = rest.split_at_mut(n);
        let (first, second) = (&mut first[columns.clone()], &mut second[columns.clone()]);
        for ((a, b), c) in first.iter_mut().zip(second).zip(&mut third[columns]) {
            [*a, *b, *c] = self.reflected([*a, *b, *c]);
        }
    }
}

/// Reflectors of neighbouring columns, from `start` on, which the rows above all wait for: they then take them together,
/// several rows side by side.
struct Wave {
    start: usize,
    count: usize,
    reflectors: [Reflector; WAVE],
}

/// Reflectors in a wave, and rows side by side.
const WAVE: usize = 16;
const ROWS: usize = 8;

impl Wave {
    fn new(start: usize) -> Self {
        Self { start, count: 0, reflectors: [Reflector::default(); WAVE] }
    }

    /// Applies them to the rows from `first` on above the wave.
    #[inline(always)]
    fn reflect_columns(&self, n: usize, h: &mut [f64], first: usize) {
        let columns = self.start..self.start + self.count + 2;
        let mut blocks = h[first * n..self.start * n].chunks_exact_mut(ROWS * n);
        for rows in &mut blocks {
            // Column by column, a vector of rows each.
            let mut block = [[0.0; ROWS]; WAVE + 2];
            for (r, row) in rows.chunks_exact(n).enumerate() {
                for (column, x) in block.iter_mut().zip(&row[columns.clone()]) {
                    column[r] = *x;
                }
            }
            for (k, reflector) in self.reflectors[..self.count].iter().enumerate() {
                for r in 0..ROWS {
                    let [a, b, c] = reflector.reflected([block[k][r], block[k + 1][r], block[k + 2][r]]);
                    (block[k][r], block[k + 1][r], block[k + 2][r]) = (a, b, c);
                }
            }
            for (r, row) in rows.chunks_exact_mut(n).enumerate() {
                for (column, x) in block.iter().zip(&mut row[columns.clone()]) {
                    *x = column[r];
                }
            }
        }
        for row in blocks.into_remainder().chunks_exact_mut(n) {
            let row = &mut row[columns.clone()];
            for (k, reflector) in self.reflectors[..self.count].iter().enumerate() {
                let [a, b, c] = reflector.reflected([row[k], row[k + 1], row[k + 2]]);
                (row[k], row[k + 1], row[k + 2]) = (a, b, c);
            }
        }
    }
}

/// Householder reflector that maps `x` to `(beta, 0, 0)`: `(beta, tau, v2, v3)` with `v = (1, v2, v3)`.
#[inline]
fn reflector([a, b, c]: [f64; 3]) -> (f64, f64, f64, f64) {
    let below = b * b + c * c;
    let square = a * a + below;
    if !(SAFE..1.0 / SAFE).contains(&square) || below < SAFE {
        return scaled_reflector([a, b, c]);
    }
    let beta = -square.sqrt().copysign(a);
    let divisor = a - beta;
    let inverse = 1.0 / (beta * divisor);
    let factor = beta * inverse;
    (beta, -divisor * divisor * inverse, b * factor, c * factor)
}

/// Squares between this and its inverse are far from underflow and overflow.
const SAFE: f64 = 1e-200;

#[cold]
fn scaled_reflector(x: [f64; 3]) -> (f64, f64, f64, f64) {
    let size = x[1].abs().max(x[2].abs());
    if size == 0.0 {
        return (x[0], 0.0, 0.0, 0.0);
    }
    let size = size.max(x[0].abs());
    let [a, b, c] = x.map(|component| component / size);
    let beta = -(a * a + b * b + c * c).sqrt().copysign(a);
    let divisor = a - beta;
    (beta * size, -divisor / beta, b / divisor, c / divisor)
}

/// Eigenvalues of a 2 x 2 matrix, given row by row.
fn two([a, b, c, d]: [f64; 4]) -> [Complex64; 2] {
    let real = |x: f64, y: f64| [Complex64::new(x, 0.0), Complex64::new(y, 0.0)];
    let pair = |re: f64, im: f64| [Complex64::new(re, im), Complex64::new(re, -im)];
    if b == 0.0 || c == 0.0 {
        return real(a, d);
    }
    let opposite = b.is_sign_negative() != c.is_sign_negative();
    let difference = a - d;
    if difference == 0.0 && opposite {
        return pair(a, b.abs().sqrt() * c.abs().sqrt());
    }
    let p = 0.5 * difference;
    let greater = b.abs().max(c.abs());
    let lesser = b.abs().min(c.abs()) * if opposite { -1.0 } else { 1.0 };
    let scale = p.abs().max(greater);
    let z = (p / scale) * p + (greater / scale) * lesser;
    if z >= 4.0 * ULP * scale {
        let z = p + (scale.sqrt() * z.sqrt()).copysign(p);
        return real(d + z, d - (greater / z) * lesser);
    }
    // Complex, or real and almost equal: a rotation equalises the diagonal elements.
    let sum = b + c;
    let tau = sum.hypot(difference);
    let cosine = (0.5 * (1.0 + sum.abs() / tau)).sqrt();
    let sine = -(p / (tau * cosine)) * 1.0_f64.copysign(sum);
    let (aa, bb) = (a * cosine + b * sine, -a * sine + b * cosine);
    let (cc, dd) = (c * cosine + d * sine, -c * sine + d * cosine);
    let (a, b) = (aa * cosine + cc * sine, bb * cosine + dd * sine);
    let (c, d) = (-aa * sine + cc * cosine, -bb * sine + dd * cosine);
    let mean = 0.5 * (a + d);
    if b == 0.0 || c == 0.0 {
        return real(mean, mean);
    }
    let root = b.abs().sqrt() * c.abs().sqrt();
    if b.is_sign_negative() == c.is_sign_negative() { real(mean + root, mean - root) } else { pair(mean, root) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What QR leaves of a matrix whose diagonal is exactly zero: the element between its two blocks has a square that
    /// underflows.
    const LEFT_OVER: f64 = -2.17e-165;

    fn two_blocks() -> [f64; 16] {
        let mut h = [0.0; 16];
        for (index, value) in [(1, 3.0), (4, -3.0), (11, 2.0), (14, -2.0)] {
            h[index] = value;
        }
        h[9] = LEFT_OVER;
        h
    }

    #[test]
    fn what_is_left_of_a_zero_diagonal_is_negligible() {
        let h = two_blocks();
        assert_eq!(active_start(4, &h, 0, 3, negligible(4, &h)), 2);
        let mut values = [Complex64::ZERO; 4];
        assert!(eigenvalues(4, &mut two_blocks(), &mut values).is_some());
        for (value, exact) in values.into_iter().zip([3.0, -3.0, 2.0, -2.0]) {
            assert!(value.re == 0.0 && (value.im - exact).abs() < 4.0 * ULP);
        }
    }

    /// `H x = (beta, 0, 0)`, however small the other components are beside the first.
    #[test]
    fn reflector_maps_small_components_to_zero() {
        for b in [LEFT_OVER, 1e-300, 1e-110, 1e-20, 0.5] {
            for (x, c) in [(1.0, 0.0), (-3.0, b), (2e-165, 3.0 * b), (0.0, b)] {
                let (beta, tau, v2, v3) = reflector([x, b, c]);
                let along = x + v2 * b + v3 * c;
                let size = beta.abs();
                assert!(((x - tau * along) / size - beta / size).abs() < 4.0 * ULP);
                assert!((b - tau * v2 * along).abs() <= 4.0 * ULP * b.abs());
                assert!((c - tau * v3 * along).abs() <= 4.0 * ULP * c.abs());
            }
        }
        assert_eq!(reflector([7.0, 0.0, 0.0]), (7.0, 0.0, 0.0, 0.0));
    }
}
