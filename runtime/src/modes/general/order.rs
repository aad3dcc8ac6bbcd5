//! The order of the answer and the phase of its vectors.

use num_complex::Complex64;

use super::pencil::modulus;

/// Sizes of eigenvalues that differ by less count as equal in the order.
const EQUAL: f64 = 1e-12;

/// A vector in its own units, largest component real and positive; a margin keeps the choice when two are equal but for
/// rounding.
pub(super) fn finish(vector: &[Complex64], units: &[f64], into: &mut [Complex64]) {
    let mut lead = 0;
    for i in 0..vector.len() {
        into[i] = vector[i] * units[i];
        if into[i].norm_sqr() > into[lead].norm_sqr() * (1.0 + 2e-9) {
            lead = i;
        }
    }
    let size = into[lead].norm();
    if size > 0.0 && !(into[lead].im == 0.0 && into[lead].re > 0.0) {
        let turn = into[lead].conj() / size;
        into.iter_mut().for_each(|x| *x *= turn);
        into[lead] = Complex64::new(size, 0.0);
    }
}

/// Ascending in size, in scaled units; those of equal size by imaginary, then by real part.
pub(super) fn sort<T>(items: &mut [T], value: impl Fn(&T) -> Complex64) {
    let size = |item: &T| modulus(value(item));
    items.sort_unstable_by(|a, b| size(a).total_cmp(&size(b)));
    let mut start = 0;
    while start < items.len() {
        let limit = size(&items[start]) * (1.0 + EQUAL);
        let run = items[start..].iter().take_while(|item| size(item) <= limit);
        let end = start + run.count().max(1);
        items[start..end].sort_unstable_by(|a, b| {
            let (a, b) = (value(a), value(b));
            a.im.total_cmp(&b.im).then(a.re.total_cmp(&b.re))
        });
        start = end;
    }
}
