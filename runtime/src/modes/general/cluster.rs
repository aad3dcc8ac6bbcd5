//! Eigenvalues that the pencil cannot tell apart: one mean value, and vectors that span the eigenspaces.

use num_complex::Complex64;

use super::lu::Lu;
use super::pair::{Pair, Solver};
use super::pencil::bound;

/// The pairs found so far; the vectors of pair `i` are the components `i n .. (i + 1) n`.
pub(super) struct Found<'a> {
    pub(super) count: usize,
    pub(super) pairs: &'a mut [Pair],
    pub(super) right: &'a mut [Complex64],
    pub(super) left: &'a mut [Complex64],
}

/// One eigenvalue of multiplicity `members` and what was found of its eigenspaces.
struct Cluster {
    s: Complex64,
    multiplicity: usize,
    /// Distance of the eigenvalues that it stands for.
    spread: f64,
    nullity: usize,
    /// Vectors `0..regular` belong to semisimple eigenvalues.
    regular: usize,
}

/// Merges what cannot be told apart. Returns whether a pair was found twice in place of two different ones.
pub(super) fn merge(solver: &mut Solver, found: &mut Found, label: &mut [usize]) -> bool {
    let count = found.count;
    for i in 0..count {
        label[i] = i;
    }
    let mut any = false;
    for i in 0..count {
        let pair = &found.pairs[i];
        any |= pair.conjugate && pair.reaches(2.0 * pair.s.im);
        for j in 0..i {
            let other = &found.pairs[j];
            let distance = (pair.s - other.s).norm();
            if pair.reaches(distance) || other.reaches(distance) {
                any = true;
                let (old, new) = (label[i].max(label[j]), label[i].min(label[j]));
                label[..count]
                    .iter_mut()
                    .filter(|label| **label == old)
                    .for_each(|label| *label = new);
            }
        }
    }
    if !any {
        return false;
    }
    let mut collapsed = false;
    for first in 0..count {
        if label[first] == first {
            collapsed |= merge_one(solver, found, &label[..count], first);
        }
    }
    collapsed
}

fn merge_one(solver: &mut Solver, found: &mut Found, label: &[usize], first: usize) -> bool {
    let members = || (0..label.len()).filter(|&i| label[i] == first);
    let real = members().any(|i| {
        let pair = &found.pairs[i];
        !pair.conjugate || pair.reaches(2.0 * pair.s.im)
    });
    let weight = |i: usize| {
        if real && found.pairs[i].conjugate {
            2
        } else {
            1
        }
    };
    let multiplicity: usize = members().map(weight).sum();
    if multiplicity < 2 {
        return false;
    }
    let mut s = Complex64::ZERO;
    for i in members() {
        s += found.pairs[i].s * weight(i) as f64 / multiplicity as f64;
    }
    if real {
        s.im = 0.0;
    }
    let spread = members().fold(0.0_f64, |most, i| most.max((found.pairs[i].s - s).norm()));
    let mut cluster = Cluster {
        s,
        multiplicity,
        spread,
        nullity: 0,
        regular: 0,
    };
    solver.eigenspaces(&mut cluster);
    if cluster.nullity < multiplicity && cluster.regular == cluster.nullity {
        return true;
    }
    // The members keep their places; what a real cluster has more of goes to the end.
    let end = found.count;
    let extra = multiplicity - members().count();
    found.count += extra;
    for (k, place) in members().chain(end..end + extra).enumerate() {
        solver.place(&cluster, k, !real, place, found);
    }
    false
}

impl Solver<'_> {
    /// Bases of the eigenspaces in `basis_right` and `basis_left`, the right one orthonormal by the mass matrix, the left
    /// one dual to it where the eigenvalue is semisimple.
    fn eigenspaces(&mut self, cluster: &mut Cluster) {
        let n = self.pencil.n;
        self.pencil.at(cluster.s, self.q);
        let size = self.pencil.size(cluster.s);
        let lu = Lu::new(n, self.q, self.order);
        let threshold = 16.0 * n as f64 * f64::EPSILON * size / lu.unit;
        let nullity = lu.nullity(threshold).min(cluster.multiplicity);
        for k in 0..nullity {
            lu.null_right(nullity, k, &mut self.basis_right[k * n..(k + 1) * n]);
            lu.null_left(nullity, k, &mut self.basis_left[k * n..(k + 1) * n]);
        }
        cluster.nullity = nullity;
        self.orthonormalise(nullity);
        cluster.regular = self.dualise(cluster.s, nullity);
        if cluster.regular == cluster.multiplicity {
            // The mean of the Rayleigh quotients.
            let mut step = Complex64::ZERO;
            for k in 0..nullity {
                let pair = self.basis_pair(cluster.s, k);
                step += pair.newton / nullity as f64;
            }
            if step.norm() <= 4.0 * cluster.spread {
                cluster.s -= step;
            }
        }
    }

    fn basis_pair(&mut self, s: Complex64, k: usize) -> Pair {
        let n = self.pencil.n;
        let range = k * n..(k + 1) * n;
        self.pencil
            .multiply(&self.basis_right[range.clone()], false, &mut self.of_right);
        self.measure(s, &self.basis_left[range])
    }

    /// Makes the first vectors of `basis_right` orthonormal by the mass matrix.
    fn orthonormalise(&mut self, nullity: usize) {
        let n = self.pencil.n;
        for k in 0..nullity {
            for _ in 0..2 {
                for other in 0..k {
                    let (done, rest) = self.basis_right.split_at_mut(k * n);
                    let (done, x) = (&done[other * n..(other + 1) * n], &mut rest[..n]);
                    self.pencil.multiply(done, false, &mut self.of_right);
                    let part: Complex64 = x
                        .iter()
                        .zip(self.of_right.mass.iter())
                        .map(|(x, mass)| x * mass.conj())
                        .sum();
                    for (x, done) in x.iter_mut().zip(done) {
                        *x -= part * done;
                    }
                }
                let x = &mut self.basis_right[k * n..(k + 1) * n];
                self.pencil.multiply(x, false, &mut self.of_right);
                super::pair::normalise(x, &mut self.of_right);
            }
        }
    }

    /// Gauss-Jordan elimination on `Psi^T (2 s M + C) Phi`: row operations on the left vectors, pivots the largest in their
    /// columns. Returns the number of pivots; columns without one, and the left vectors that remain, are moved behind.
    fn dualise(&mut self, s: Complex64, nullity: usize) -> usize {
        let n = self.pencil.n;
        let mut tolerance = 0.0_f64;
        for j in 0..nullity {
            self.pencil.multiply(
                &self.basis_right[j * n..(j + 1) * n],
                false,
                &mut self.of_right,
            );
            for i in 0..nullity {
                let left = &self.basis_left[i * n..(i + 1) * n];
                let pair = self.measure(s, left);
                self.cross[i * nullity + j] = pair.slope;
                tolerance = tolerance.max((pair.rounding * pair.mass_terms).sqrt());
            }
        }
        tolerance *= 4.0;
        let mut regular = 0;
        let mut column = 0;
        let mut columns = nullity;
        while column < columns {
            let mut best = regular;
            for i in regular..nullity {
                if bound(self.cross[i * nullity + column])
                    > bound(self.cross[best * nullity + column])
                {
                    best = i;
                }
            }
            let pivot = self.cross[best * nullity + column];
            if bound(pivot) <= tolerance {
                // This right vector goes behind.
                columns -= 1;
                swap_blocks(self.basis_right, n, column, columns);
                for i in 0..nullity {
                    self.cross.swap(i * nullity + column, i * nullity + columns);
                }
                continue;
            }
            swap_blocks(self.basis_left, n, regular, best);
            swap_blocks(self.cross, nullity, regular, best);
            for i in (0..nullity).filter(|&i| i != regular) {
                let factor = self.cross[i * nullity + column] / pivot;
                subtract(self.cross, nullity, i, factor, regular);
                subtract(self.basis_left, n, i, factor, regular);
            }
            regular += 1;
            column += 1;
        }
        // Defective right vectors lose what they have of the others.
        for j in regular..nullity {
            for i in 0..regular {
                let factor = self.cross[i * nullity + j] / self.cross[i * nullity + i];
                subtract(self.basis_right, n, j, factor, i);
            }
        }
        regular
    }

    /// Writes root `k` of the cluster to its place.
    fn place(
        &mut self,
        cluster: &Cluster,
        k: usize,
        conjugate: bool,
        place: usize,
        found: &mut Found,
    ) {
        let n = self.pencil.n;
        let regular = k < cluster.regular;
        let defective = cluster.nullity - cluster.regular;
        let vector = if regular {
            k
        } else {
            cluster.regular + (k - cluster.regular) % defective
        };
        let right = &mut found.right[place * n..(place + 1) * n];
        let left = &mut found.left[place * n..(place + 1) * n];
        right.copy_from_slice(&self.basis_right[vector * n..(vector + 1) * n]);
        left.copy_from_slice(&self.basis_left[vector * n..(vector + 1) * n]);
        let mut pair = self.examine(cluster.s, right, left);
        pair.conjugate = conjugate;
        pair.newton = Complex64::ZERO;
        if regular {
            pair.condition = self.condition(&pair, right, left);
            pair.error = pair.doubt() + cluster.spread.min(self.noise(pair.condition));
        } else {
            let block = (cluster.multiplicity - cluster.regular).div_ceil(defective);
            let relative = (n as f64 + 4.0) * f64::EPSILON;
            // rounding = relative size^2 mass_terms
            let size = (pair.rounding / (relative * pair.mass_terms)).sqrt();
            pair.condition = f64::INFINITY;
            pair.error = (2.0 * cluster.spread).max(size * relative.powf(1.0 / block as f64));
        }
        pair.merged = true;
        found.pairs[place] = pair;
    }
}

fn swap_blocks(x: &mut [Complex64], length: usize, i: usize, j: usize) {
    for k in 0..length {
        x.swap(i * length + k, j * length + k);
    }
}

/// Subtracts `factor` times block `from` from block `of`.
fn subtract(x: &mut [Complex64], length: usize, of: usize, factor: Complex64, from: usize) {
    for k in 0..length {
        let part = factor * x[from * length + k];
        x[of * length + k] -= part;
    }
}
