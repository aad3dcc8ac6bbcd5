//! Properties that any answer must have, computed without the solver's own code.

use super::*;

/// Checks one answer; `Err` describes the fault.
pub(super) fn check(linear: &Linear, roots: &[Root]) -> Result<(), String> {
    let mut weight = 0;
    for (i, root) in roots.iter().enumerate() {
        weight += if root.s.im > 0.0 { 2 } else { 1 };
        check_root(linear, root).map_err(|what| format!("root {i}: {what}: {root:?}"))?;
    }
    let n = linear.mass.row_count();
    if weight != 2 * n {
        return Err(format!("{weight} eigenvalues in place of {}", 2 * n));
    }
    for pair in roots.windows(2) {
        let (a, b) = (pair[0].s, pair[1].s);
        if a.norm() > b.norm() * (1.0 + 1e-11) {
            return Err(format!("order: {a} before {b}"));
        }
    }
    Ok(())
}

fn check_root(linear: &Linear, root: &Root) -> Result<(), String> {
    let numbers = [root.s.re, root.s.im, root.residual, root.error, root.condition];
    if numbers.iter().any(|x| x.is_nan()) || !root.s.norm().is_finite() {
        return Err("not a number".into());
    }
    if root.s.im < 0.0 || root.residual > 1e-9 || root.error < 0.0 || root.condition < 1.0 {
        return Err("out of range".into());
    }
    for (vector, transposed) in [(&root.right, false), (&root.left, true)] {
        if vector.iter().any(|x| !(x.re.is_finite() && x.im.is_finite())) {
            return Err("vector not finite".into());
        }
        let norm = mass_product(linear, vector, vector);
        if (norm - 1.0).norm() > 1e-9 {
            return Err(format!("norm {norm}"));
        }
        let most = vector.iter().fold(0.0_f64, |most, x| most.max(x.norm()));
        if !vector.iter().any(|x| x.re > 0.0 && x.im == 0.0 && x.re >= most * (1.0 - 1e-8)) {
            return Err("largest component not real and positive".into());
        }
        let (by_terms, by_matrices) = residuals(linear, root.s, vector, transposed);
        if by_terms > 1e-9 && by_matrices > 3e-14 {
            return Err(format!("residual {by_terms:e}"));
        }
    }
    Ok(())
}

/// `x^H M y`.
pub(super) fn mass_product(linear: &Linear, x: &[Complex64], y: &[Complex64]) -> Complex64 {
    let mut sum = Complex64::ZERO;
    for i in 0..x.len() {
        for j in 0..y.len() {
            sum += x[i].conj() * linear.mass[i][j] * y[j];
        }
    }
    sum
}

/// Largest component of `Q(s) x`, or of `x^T Q(s)`, relative to the terms and to the matrices, in units with unit
/// masses.
fn residuals(linear: &Linear, s: Complex64, x: &[Complex64], transposed: bool) -> (f64, f64) {
    let (mut most, mut terms, mut elements, mut largest) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
    for i in 0..x.len() {
        let (mut sum, mut size) = (Complex64::ZERO, 0.0);
        for j in 0..x.len() {
            let (row, column) = if transposed { (j, i) } else { (i, j) };
            let unit = (linear.mass[i][i] * linear.mass[j][j]).sqrt();
            let x = x[j] * linear.mass[j][j].sqrt();
            let m = s * s * linear.mass[row][column] / unit;
            let c = s * linear.damping[row][column] / unit;
            let k = linear.stiffness[row][column] / unit;
            sum += (m + c + k) * x;
            size += (m.norm() + c.norm() + k.abs()) * x.norm();
            elements = elements.max(m.norm() + c.norm() + k.abs());
        }
        most = most.max(sum.norm());
        terms = terms.max(size);
        largest = largest.max(x[i].norm() * linear.mass[i][i].sqrt());
    }
    let ratio = |size: f64| if most == 0.0 { 0.0 } else { most / size };
    (ratio(terms), ratio(elements * largest))
}

/// `sum of all s = -tr(M^-1 C)`, within the errors of the roots.
pub(super) fn check_sum(roots: &[Root], trace: f64) -> Result<(), String> {
    let (mut sum, mut error) = (0.0, 1e-15 * trace.abs());
    for root in roots {
        let weight = if root.s.im > 0.0 { 2.0 } else { 1.0 };
        sum += weight * root.s.re;
        error += weight * (root.error + 1e-15 * root.s.norm());
    }
    if (sum + trace).abs() <= error { Ok(()) } else { Err(format!("sum {sum:e} for trace {trace:e}, error {error:e}")) }
}

/// `product of all s = det K / det M`, within the errors of the roots.
pub(super) fn check_product(roots: &[Root], quotient: f64) -> Result<(), String> {
    let (mut product, mut most) = (1.0, 1.0);
    for root in roots {
        let size = root.s.norm();
        let factor = if root.s.im > 0.0 { size * size } else { root.s.re };
        let upper = size + root.error + 1e-15 * size;
        product *= factor;
        most *= if root.s.im > 0.0 { upper * upper } else { upper };
    }
    let allowed = most - product.abs() + 1e-13 * most;
    if (product - quotient).abs() <= allowed {
        Ok(())
    } else {
        Err(format!("product {product:e} for {quotient:e}, error {allowed:e}"))
    }
}

/// Dimension of the span of some vectors that are normalised in the mass matrix.
pub(super) fn rank(linear: &Linear, vectors: &[&[Complex64]]) -> usize {
    let mut basis: Vec<Vector<Complex64>> = Vec::new();
    for &vector in vectors {
        let mut rest = Vector::from(vector);
        for _ in 0..2 {
            for base in &basis {
                let part = mass_product(linear, base, &rest);
                for i in 0..rest.len() {
                    rest[i] -= part * base[i];
                }
            }
        }
        let size = mass_product(linear, &rest, &rest).re.sqrt();
        if size > 1e-5 {
            basis.push(rest.map(|x| x / size));
        }
    }
    basis.len()
}

/// `psi_i^T ((s_i + s_j) M + C) phi_j`.
pub(super) fn cross(linear: &Linear, i: &Root, j: &Root) -> Complex64 {
    let mut sum = Complex64::ZERO;
    for k in 0..i.left.len() {
        for l in 0..j.right.len() {
            let element = (i.s + j.s) * linear.mass[k][l] + linear.damping[k][l];
            sum += i.left[k] * element * j.right[l];
        }
    }
    sum
}
