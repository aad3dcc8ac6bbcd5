//! Bases of the left and right eigenspaces of one eigenvalue.

use num_complex::Complex64;

use super::accuracy::{DEFECTIVE, MARGIN};
use super::cluster::{Cluster, ComputedPairs};
use super::lu::Lu;
use super::measure::{Pair, ZERO, normalise};
use super::pair::INACCURATE;
use super::pencil::{bound, modulus};
use super::solver::PairSolver;

/// Newton steps per cluster.
const STEPS: usize = 4;

impl PairSolver<'_> {
    /// Writes bases of the eigenspaces to `basis_right` and `basis_left`: the right one orthonormal in the mass matrix,
    /// the left one dual to it if the eigenvalue is semisimple.
    pub(super) fn eigenspaces(&mut self, cluster: &mut Cluster) {
        for _ in 0..2 {
            let start = cluster.s;
            self.bases(cluster);
            if cluster.regular < cluster.multiplicity {
                break;
            }
            self.centre(cluster);
            if modulus(cluster.s - start) <= cluster.reach {
                break;
            }
        }
    }

    fn bases(&mut self, cluster: &mut Cluster) {
        if self.iterated_bases(cluster) {
            return;
        }
        let n = self.pencil.n;
        self.pencil.at(cluster.s, self.q);
        let size = self.pencil.size(cluster.s);
        let lu = Lu::new(n, self.q, self.order);
        let rounding = 16.0 * n as f64 * f64::EPSILON * size;
        let distance = 4.0 * cluster.spread * self.pencil.slope_size(cluster.s);
        let threshold = (rounding + distance) / lu.unit;
        let nullity = lu.nullity(threshold).min(cluster.multiplicity);
        for k in 0..nullity {
            lu.null_right(nullity, k, &mut self.basis_right[k * n..(k + 1) * n]);
            lu.null_left(nullity, k, &mut self.basis_left[k * n..(k + 1) * n]);
        }
        cluster.nullity = nullity;
        self.orthonormalise(nullity);
        cluster.regular = self.dualise(cluster.s, nullity);
    }

    /// Bases by inverse iteration from several vectors; `false` unless the eigenvalue is semisimple and they are as good
    /// as those of single eigenvalues.
    fn iterated_bases(&mut self, cluster: &mut Cluster) -> bool {
        let (n, count) = (self.pencil.n, cluster.multiplicity);
        let Some(iteration) = &mut self.iteration else {
            return false;
        };
        if count > n || cluster.condition > DEFECTIVE {
            return false;
        }
        iteration.bases(
            &self.linearisation,
            cluster.s,
            &mut self.basis_right[..count * n],
            &mut self.basis_left[..count * n],
        );
        self.orthonormalise(count);
        cluster.nullity = count;
        cluster.regular = self.dualise(cluster.s, count);
        cluster.regular == count && (0..count).all(|k| self.basis_pair(cluster.s, k).residual <= INACCURATE)
    }

    /// Whether a vector does not belong to the eigenvalue.
    pub(super) fn is_poor(&mut self, cluster: &Cluster, k: usize) -> bool {
        let pair = self.basis_pair(cluster.s, k);
        let n = self.pencil.n;
        let (right, left) = (&self.basis_right[k * n..(k + 1) * n], &self.basis_left[k * n..(k + 1) * n]);
        pair.residual > INACCURATE
            && (modulus(pair.newton) > 4.0 * cluster.spread + cluster.reach
                || !self.is_rounding(cluster.s, right, left, 1.0))
    }

    /// Moves the eigenvalue to the mean of its Rayleigh quotients.
    fn centre(&mut self, cluster: &mut Cluster) {
        let allowed = 4.0 * cluster.spread + cluster.radius;
        let mut moved = 0.0;
        for _ in 0..STEPS {
            let mut step = Complex64::ZERO;
            for k in 0..cluster.nullity {
                step += self.basis_pair(cluster.s, k).newton / cluster.nullity as f64;
            }
            if cluster.s.im == 0.0 {
                step.im = 0.0;
            }
            moved += modulus(step);
            let next = cluster.s - step;
            let crosses = cluster.s.im > 0.0 && next.im <= 0.0;
            if step == Complex64::ZERO || moved.is_nan() || moved > allowed || crosses {
                break;
            }
            cluster.s = next;
        }
        if cluster.s.norm_sqr() < ZERO * ZERO {
            let zero = Cluster { s: Complex64::ZERO, ..*cluster };
            if !(0..cluster.nullity).any(|k| self.is_poor(&zero, k)) {
                cluster.s = zero.s;
            }
        }
    }

    fn basis_pair(&mut self, s: Complex64, k: usize) -> Pair {
        let n = self.pencil.n;
        let range = k * n..(k + 1) * n;
        self.pencil.multiply(&self.basis_right[range.clone()], false, &mut self.of_right);
        self.pencil.multiply(&self.basis_left[range.clone()], true, &mut self.of_left);
        self.measure(s, &self.basis_left[range])
    }

    /// Makes the first vectors of `basis_right` orthonormal in the mass matrix.
    fn orthonormalise(&mut self, nullity: usize) {
        let n = self.pencil.n;
        // Their products with the mass matrix.
        let weighed = &mut self.cross[..nullity * n];
        for k in 0..nullity {
            let (done, rest) = self.basis_right.split_at_mut(k * n);
            let x = &mut rest[..n];
            for _ in 0..2 {
                for (done, weighed) in done.chunks_exact(n).zip(weighed.chunks_exact(n)) {
                    let part: Complex64 = x.iter().zip(weighed).map(|(x, mass)| x * mass.conj()).sum();
                    for (x, done) in x.iter_mut().zip(done) {
                        *x -= part * done;
                    }
                }
                self.pencil.multiply(x, false, &mut self.of_right);
                normalise(&self.pencil, x, &mut self.of_right);
            }
            self.pencil.multiply(x, false, &mut self.of_right);
            let product = self.pencil.weighed(&self.of_right);
            weighed[k * n..(k + 1) * n].copy_from_slice(product);
        }
    }

    /// Gauss-Jordan elimination on `Psi^T (2 s M + C) Phi`, with row operations on the left vectors and the largest
    /// element of each column as pivot. Returns the number of pivots; columns without a pivot, and the remaining left
    /// vectors, move to the end.
    fn dualise(&mut self, s: Complex64, nullity: usize) -> usize {
        let n = self.pencil.n;
        let mut tolerance = 0.0_f64;
        for j in 0..nullity {
            self.pencil.multiply(&self.basis_right[j * n..(j + 1) * n], false, &mut self.of_right);
            for i in 0..nullity {
                let left = &self.basis_left[i * n..(i + 1) * n];
                let pair = self.measure(s, left);
                self.cross[i * nullity + j] = pair.slope;
                tolerance = tolerance.max((pair.rounding * pair.mass_terms).sqrt());
            }
        }
        let sum = |x: &[Complex64]| x.iter().map(|&x| bound(x)).sum::<f64>() / nullity as f64;
        let vectors = sum(&self.basis_left[..nullity * n]) * sum(&self.basis_right[..nullity * n]);
        let rounding = 8.0 * n as f64 * f64::EPSILON * self.pencil.slope_size(s);
        tolerance = (4.0 * tolerance).max(rounding * vectors);
        let mut regular = 0;
        let mut column = 0;
        let mut columns = nullity;
        while column < columns {
            let mut best = regular;
            for i in regular..nullity {
                if bound(self.cross[i * nullity + column]) > bound(self.cross[best * nullity + column]) {
                    best = i;
                }
            }
            let pivot = self.cross[best * nullity + column];
            if bound(pivot) <= tolerance {
                // This right vector moves to the end.
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
        // Removes from defective right vectors their components along the others.
        for j in regular..nullity {
            for i in 0..regular {
                let factor = self.cross[i * nullity + j] / self.cross[i * nullity + i];
                subtract(self.basis_right, n, j, factor, i);
            }
        }
        regular
    }

    /// Writes root `k` of the cluster to its position.
    pub(super) fn place(
        &mut self,
        cluster: &Cluster,
        k: usize,
        conjugate: bool,
        index: usize,
        computed: &mut ComputedPairs,
    ) {
        let n = self.pencil.n;
        let regular = k < cluster.regular;
        let defective = cluster.nullity - cluster.regular;
        let vector = if regular { k } else { cluster.regular + (k - cluster.regular) % defective };
        let right = &mut computed.right[index * n..(index + 1) * n];
        let left = &mut computed.left[index * n..(index + 1) * n];
        right.copy_from_slice(&self.basis_right[vector * n..(vector + 1) * n]);
        left.copy_from_slice(&self.basis_left[vector * n..(vector + 1) * n]);
        let mut pair = self.examine(cluster.s, right, left);
        pair.conjugate = conjugate;
        if regular {
            pair.condition = self.condition(&pair, right, left);
            pair.error = MARGIN * pair.doubt() + 2.0 * modulus(pair.newton) + pair.rounding();
        } else {
            let block = (cluster.multiplicity - cluster.regular).div_ceil(defective).max(2);
            let relative = self.relative();
            let size = self.pencil.rate(pair.s);
            let of_block = |relative: f64| size * relative.powf(1.0 / block as f64);
            // The step may be a quotient of two rounding errors, and the residual relative to one.
            let step = 2.0 * cluster.multiplicity as f64 * modulus(pair.newton);
            pair.condition = f64::INFINITY;
            pair.error = (2.0 * cluster.spread)
                .max(of_block(relative))
                .max(step.min(of_block(pair.residual)))
                .min(size * relative.powf(0.5 / n as f64));
        }
        pair.merged = true;
        computed.pairs[index] = pair;
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
