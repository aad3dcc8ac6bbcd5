//! Integer pencils with exactly known spectra: blocks with known roots under unimodular transformations, `M = R^T R`,
//! `C = R^T (S C0 S^-1) R`, `K = R^T (S K0 S^-1) R`. Nothing is rounded.

use rand_chacha::ChaCha8Rng;

use super::checks::{check, check_product, check_sum, cross, rank};
use super::pencils::below;
use super::*;

/// An exact root with its algebraic and geometric multiplicity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exact {
    pub(super) s: Complex64,
    pub(super) algebraic: usize,
    pub(super) geometric: usize,
}

pub(super) struct Known {
    pub(super) linear: Linear,
    pub(super) spectrum: Vec<Exact>,
}

/// Roots of one block: a pair of integers, real or conjugate.
fn block_roots(rng: &mut ChaCha8Rng) -> [Complex64; 2] {
    let a = below(rng, 6) as f64 - 4.0;
    let b = below(rng, 5) as f64 - 3.0;
    if below(rng, 2) == 0 {
        [Complex64::new(a, 0.0), Complex64::new(b, 0.0)]
    } else {
        let im = 1.0 + below(rng, 4) as f64;
        let re = if below(rng, 2) == 0 { 0.0 } else { a };
        [Complex64::new(re, im), Complex64::new(re, -im)]
    }
}

/// Adds `factor` times row `j` to row `i`, and applies the inverse to the columns: `E X E^-1`.
fn conjugate_by(x: &mut Matrix, i: usize, j: usize, factor: f64) {
    for k in 0..x.column_count() {
        x[i][k] += factor * x[j][k];
    }
    for row in x.iter_mut() {
        row[j] -= factor * row[i];
    }
}

/// `E^T X E`.
fn congruence(x: &mut Matrix, i: usize, j: usize, factor: f64) {
    for k in 0..x.column_count() {
        x[i][k] += factor * x[j][k];
    }
    for row in x.iter_mut() {
        row[i] += factor * row[j];
    }
}

/// A random pencil; `chains` allows defective blocks.
pub(super) fn known(n: usize, rng: &mut ChaCha8Rng, chains: bool) -> Known {
    let mut damping = zeros(n);
    let mut stiffness = zeros(n);
    let mut spectrum: Vec<Exact> = Vec::new();
    let mut roots = block_roots(rng);
    let mut i = 0;
    while i < n {
        if i == 0 || below(rng, 3) > 0 {
            roots = block_roots(rng);
            while !chains && roots[0] == roots[1] {
                roots = block_roots(rng);
            }
        }
        let size = if chains && i + 1 < n && below(rng, 3) == 0 { 2 } else { 1 };
        for j in i..i + size {
            damping[j][j] = -(roots[0] + roots[1]).re;
            stiffness[j][j] = (roots[0] * roots[1]).re;
        }
        if size == 2 {
            stiffness[i][i + 1] = 1.0;
        }
        let double = roots[0] == roots[1];
        for s in &roots[..if double { 1 } else { 2 }] {
            let algebraic = size * if double { 2 } else { 1 };
            match spectrum.iter_mut().find(|exact| exact.s == *s) {
                Some(exact) => {
                    exact.algebraic += algebraic;
                    exact.geometric += 1;
                }
                None => spectrum.push(Exact { s: *s, algebraic, geometric: 1 }),
            }
        }
        i += size;
    }
    let mut mass = identity(n);
    if n > 1 {
        let pick = |rng: &mut ChaCha8Rng| {
            let i = below(rng, n as u32) as usize;
            let j = (i + 1 + below(rng, n as u32 - 1) as usize) % n;
            (i, j, if below(rng, 2) == 0 { 1.0 } else { -1.0 })
        };
        for _ in 0..below(rng, 2 * n as u32) {
            let (i, j, factor) = pick(rng);
            conjugate_by(&mut damping, i, j, factor);
            conjugate_by(&mut stiffness, i, j, factor);
        }
        for _ in 0..below(rng, n as u32 + 1) {
            let (i, j, factor) = pick(rng);
            for matrix in [&mut mass, &mut damping, &mut stiffness] {
                congruence(matrix, i, j, factor);
            }
        }
    }
    Known { linear: linear(mass, damping, stiffness), spectrum }
}

/// Checks an answer against the exact spectrum: every root within its error, the right number of each, and independent
/// vectors for semisimple roots.
pub(super) fn check_known(known: &Known) -> Result<(), String> {
    let roots = solve(&known.linear).map_err(|trouble| format!("{trouble:?}"))?;
    check(&known.linear, &roots)?;
    let (mut trace, mut determinant) = (0.0, Complex64::ONE);
    for exact in &known.spectrum {
        trace -= exact.algebraic as f64 * exact.s.re;
        determinant *= exact.s.powu(exact.algebraic as u32);
    }
    check_sum(&roots, trace)?;
    check_product(&roots, determinant.re)?;
    let nearest = |s: Complex64| {
        let distance = |exact: &Exact| (exact.s - s).norm();
        let nearer = |a: &usize, b: &usize| distance(&known.spectrum[*a]).total_cmp(&distance(&known.spectrum[*b]));
        (0..known.spectrum.len()).min_by(nearer).unwrap()
    };
    let mut counts = vec![0; known.spectrum.len()];
    for s in all(&roots) {
        counts[nearest(s)] += 1;
    }
    for (i, exact) in known.spectrum.iter().enumerate() {
        if counts[i] != exact.algebraic {
            return Err(format!("{exact:?} found {} times", counts[i]));
        }
        let of: Vec<&Root> = roots.iter().filter(|root| nearest(root.s) == i).collect();
        for root in &of {
            let error = (root.s - exact.s).norm();
            if error > root.error {
                return Err(format!("{exact:?}: error {error:e}: {root:?}"));
            }
            let semisimple = exact.algebraic == exact.geometric;
            if semisimple && root.error > 1e-11 * (1.0 + exact.s.norm()) * root.condition {
                return Err(format!("{exact:?}: pessimistic: {root:?}"));
            }
        }
        if exact.algebraic == exact.geometric && exact.s.im >= 0.0 {
            let right: Vec<_> = of.iter().map(|root| &root.right[..]).collect();
            let left: Vec<_> = of.iter().map(|root| &root.left[..]).collect();
            if rank(&known.linear, &right) < of.len() || rank(&known.linear, &left) < of.len() {
                return Err(format!("{exact:?}: dependent vectors"));
            }
            for (a, one) in of.iter().enumerate() {
                for other in of.iter().skip(a + 1) {
                    let value = cross(&known.linear, one, one).norm();
                    let theirs = cross(&known.linear, other, other).norm();
                    let mixed = cross(&known.linear, one, other).norm().max(cross(&known.linear, other, one).norm());
                    if mixed > 1e-6 * value.max(theirs) {
                        return Err(format!("{exact:?}: not biorthogonal: {mixed:e}"));
                    }
                }
            }
        }
    }
    Ok(())
}
