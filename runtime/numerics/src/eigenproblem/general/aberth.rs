//! The fallback method: simultaneous iteration of Ehrlich and Aberth on `det Q(s)` (Bini and Noferini 2013). It works
//! on the pencil itself, so that small eigenvalues do not carry the rounding of the large ones; the linearisation is
//! faster.

use num_complex::Complex64;

use super::census;
use super::lu::Lu;
use super::pencil::Pencil;

/// A value below this is zero in a scaled pencil.
const NOTHING: f64 = 1e-36;
/// Steps below this end the search for an eigenvalue of zero.
const SMALL: f64 = 1e-40;
const SWEEPS: usize = 150;
/// For pencils that are not small, a sweep costs too much to wait for slow convergence.
const FEW_SWEEPS: usize = 10;
/// Size up to which a pencil is small.
const FEW: usize = 16;
/// Size beyond which the method is too slow for a whole spectrum.
pub(super) const LARGE: usize = 32;

/// Improves those of the eigenvalues that are `open`, and closes them as they settle. `work` needs `2 n^2` numbers.
pub(super) fn improve(
    pencil: &Pencil,
    values: &mut [Complex64],
    open: &mut [bool],
    q: &mut [Complex64],
    order: &mut [usize],
    work: &mut [Complex64],
) {
    let sweeps = if pencil.n <= FEW { SWEEPS } else { FEW_SWEEPS };
    for _ in 0..sweeps {
        let mut settled = true;
        for i in 0..values.len() {
            if !open[i] {
                continue;
            }
            let s = values[i];
            let trace = logarithmic_derivative(pencil, s, q, order, work);
            let repulsion: Complex64 = values.iter().filter(|&&other| other != s).map(|other| (s - other).inv()).sum();
            let newton = trace.inv().norm();
            let alone = newton * repulsion.norm() <= 0.5;
            if newton <= SMALL || (newton <= f64::EPSILON * s.norm() && alone) {
                open[i] = false;
                continue;
            }
            let step = (trace - repulsion).inv();
            let new = s - step;
            if !(new.re.is_finite() && new.im.is_finite()) {
                open[i] = false;
                continue;
            }
            values[i] = new;
            if step.norm() <= 4.0 * f64::EPSILON * new.norm() + SMALL {
                open[i] = false;
            } else {
                settled = false;
            }
        }
        if settled {
            break;
        }
    }
}

/// `d/ds ln det Q(s) = tr(Q^-1 (2 s M + C))`.
fn logarithmic_derivative(
    pencil: &Pencil,
    s: Complex64,
    q: &mut [Complex64],
    order: &mut [usize],
    work: &mut [Complex64],
) -> Complex64 {
    census::note(|census| census.second += 1);
    let n = pencil.n;
    pencil.at(s, q);
    let lu = Lu::new(n, q, order);
    let (slopes, work) = work.split_at_mut(n * n);
    for (i, slope) in slopes.iter_mut().enumerate() {
        *slope = 2.0 * s * pencil.mass[i] + pencil.damping[i];
    }
    lu.trace_of_quotient(slopes, &mut work[..n * n])
}

/// Makes the marked values symmetric about the real axis again: each is paired with the value nearest to its conjugate,
/// or made real if that is itself. They move to the end, with conjugates adjacent.
pub(super) fn symmetrise(values: &mut [Complex64], marked: &mut [bool]) {
    let count = values.len();
    for value in values.iter_mut() {
        if value.norm_sqr() < NOTHING * NOTHING {
            *value = Complex64::ZERO;
        }
    }
    let mut start = 0;
    for i in 0..count {
        if !marked[i] {
            values[start..=i].rotate_right(1);
            marked[start..=i].rotate_right(1);
            start += 1;
        }
    }
    while start < count {
        let mut first = start;
        for i in start..count {
            if values[i].im.abs() > values[first].im.abs() {
                first = i;
            }
        }
        values.swap(start, first);
        let wanted = values[start].conj();
        let mut partner = start;
        for i in start..count {
            if (values[i] - wanted).norm() < (values[partner] - wanted).norm() {
                partner = i;
            }
        }
        if partner == start {
            values[start].im = 0.0;
            start += 1;
        } else {
            values.swap(start + 1, partner);
            let mean = (wanted + values[start + 1]) * 0.5;
            let upper = Complex64::new(mean.re, mean.im.abs());
            (values[start], values[start + 1]) = (upper, upper.conj());
            start += 2;
        }
    }
}
