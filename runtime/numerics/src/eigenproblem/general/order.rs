//! The order of the results and the phase of their vectors.

use num_complex::Complex64;

use super::pencil::modulus;
use crate::algebra::Vector;

/// Relative difference below which sizes of eigenvalues count as equal in the order.
const EQUAL: f64 = 1e-12;

/// A vector in its own units, with its largest component real and positive; a margin keeps the choice stable when two
/// are equal up to rounding.
pub(super) fn finish(vector: &[Complex64], units: &[f64]) -> Vector<Complex64> {
    let mut x: Vector<_> = vector.iter().zip(units).map(|(x, unit)| x * unit).collect();
    let mut lead = 0;
    for i in 0..x.len() {
        if x[i].norm_sqr() > x[lead].norm_sqr() * (1.0 + 2e-9) {
            lead = i;
        }
    }
    let size = x[lead].norm();
    if size > 0.0 && !(x[lead].im == 0.0 && x[lead].re > 0.0) {
        let turn = x[lead].conj() / size;
        x.iter_mut().for_each(|x| *x *= turn);
        x[lead] = Complex64::new(size, 0.0);
    }
    x
}

/// Sorts by size, in scaled units, then by imaginary part, then by real part, all ascending.
pub(super) fn sort<T>(items: &mut [T], value: impl Fn(&T) -> Complex64) {
    let size = |item: &T| modulus(value(item));
    items.sort_unstable_by(|a, b| size(a).total_cmp(&size(b)));
    let mut start = 0;
    while start < items.len() {
        let limit = size(&items[start]) * (1.0 + EQUAL);
        let end = start + items[start..].iter().take_while(|item| size(item) <= limit).count().max(1);
        items[start..end].sort_unstable_by(|a, b| {
            let (a, b) = (value(a), value(b));
            a.im.total_cmp(&b.im).then(a.re.total_cmp(&b.re))
        });
        start = end;
    }
}
