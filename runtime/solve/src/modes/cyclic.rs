//! Modes of equal instances around an axis: the patterns of a ring do not couple where hub and support are symmetric, so the
//! eigenproblem falls into one for each number of nodal diameters.
//!
//! With the orthogonal patterns `T` of each ring (collective, cosines and sines, differential), `T^T M T`, `T^T C T` and
//! `T^T K T` have blocks. They are found by what is left of each entry beside the rounding of its terms, so that what stands
//! on the axis joins the patterns that move it, and unequal instances leave one block, which is no use.

use std::f64::consts::TAU;

use eigentol_contract::RingInfo;

use super::constrained;
use crate::algebra::{Matrix, Vector};
use crate::constraints::Structure;
use crate::eigenproblem::{Eigenproblem, EigenproblemError, Pairs, Root, roots_near, symmetric};
use crate::kernels::Linear;
use crate::{Complex, Description};

/// Fewest unknowns of rings that can have blocks.
const FEWEST: usize = 3;
/// Relative difference of equal eigenvalues.
const EQUAL: f64 = 1e-12;
/// What is left of an entry by rounding, relative to the sum of its terms.
const ROUNDING: f64 = 1e-13;

/// The patterns of all rings, the three matrices in them with the sizes of their terms, and the blocks.
struct Cyclic<'a> {
    patterns: Vec<(&'a RingInfo, Matrix)>,
    turned: [(Matrix, Matrix); 3],
    blocks: Vec<Vec<usize>>,
}

impl<'a> Cyclic<'a> {
    /// `None` if there are no blocks.
    fn new(linear: &Linear, description: &'a Description) -> Option<Self> {
        let rings = || description.rings.iter().filter(|ring| !ring.patterns);
        if rings().map(|ring| ring.coordinates.len()).sum::<usize>() < FEWEST {
            return None;
        }
        let patterns: Vec<_> = rings().map(|ring| (ring, patterns(ring.members))).collect();
        let turned = [&linear.mass, &linear.damping, &linear.stiffness].map(|matrix| turned(matrix, &patterns));
        let blocks = blocks(linear.mass.row_count(), &turned);
        (blocks.len() > 1).then_some(Self { patterns, turned, blocks })
    }

    /// Mass, damping and stiffness of a block.
    fn part(&self, block: &[usize]) -> Linear {
        let part = |k: usize| Matrix::from_fn(block.len(), block.len(), |i, j| self.turned[k].0[block[i]][block[j]]);
        Linear { mass: part(0), damping: part(1), stiffness: part(2) }
    }
}

/// In ascending order; what differs by rounding stays in the order of the patterns, pairs together.
fn ascending<T>(mut all: Vec<T>, size: impl Fn(&T) -> f64) -> Vec<T> {
    let mut places: Vec<usize> = (0..all.len()).collect();
    places.sort_by(|a, b| size(&all[*a]).total_cmp(&size(&all[*b])));
    for run in places.chunk_by_mut(|a, b| size(&all[*b]) <= size(&all[*a]) * (1.0 + EQUAL)) {
        run.sort_unstable();
    }
    let mut rank = vec![0; all.len()];
    places.into_iter().enumerate().for_each(|(place, k)| rank[k] = place);
    let mut rank = rank.into_iter();
    all.sort_by_cached_key(|_| rank.next());
    all
}

/// The roots, block by block; `None` if there are no blocks.
pub(super) fn roots(
    linear: &Linear,
    description: &Description,
    structure: Structure,
) -> Option<Result<Vec<Root>, EigenproblemError>> {
    let cyclic = Cyclic::new(linear, description)?;
    let mut all: Vec<Root> = Vec::new();
    for block in &cyclic.blocks {
        let roots = match roots_near(Eigenproblem::Quadratic(&cyclic.part(block)), &[]) {
            Ok(roots) => roots,
            Err(error) => return Some(Err(error)),
        };
        for mut root in roots {
            for vector in [&mut root.right, &mut root.left] {
                *vector = expanded(linear.mass.row_count(), block, vector, &cyclic.patterns);
            }
            all.push(root);
        }
    }
    let all = ascending(all, |root| root.s.norm());
    Some(Ok(constrained::measured(linear, structure, &all)))
}

/// The undamped modes, block by block; `None` if there are no blocks.
pub(super) fn pairs_into(
    linear: &Linear,
    description: &Description,
    pairs: &mut Pairs,
) -> Option<Result<(), EigenproblemError>> {
    let cyclic = Cyclic::new(linear, description)?;
    let n = linear.mass.row_count();
    let mut all: Vec<(f64, f64, f64, Vector)> = Vec::new();
    for block in &cyclic.blocks {
        let part = cyclic.part(block);
        if let Err(error) = symmetric::solve_into(&part.stiffness, &part.mass, pairs) {
            return Some(Err(error));
        }
        for r in 0..pairs.lambda.len() {
            let shape: Vec<Complex> = pairs.shapes[r].iter().copied().map(Complex::from).collect();
            let mut shape = expanded(n, block, &shape, &cyclic.patterns).map(|value| value.re);
            symmetric::fix_sign(&mut shape);
            all.push((pairs.lambda[r], pairs.errors[r], pairs.residuals[r], shape));
        }
    }
    let all = ascending(all, |pair| pair.0);
    *pairs = Pairs {
        lambda: all.iter().map(|pair| pair.0).collect(),
        errors: all.iter().map(|pair| pair.1).collect(),
        residuals: all.iter().map(|pair| pair.2).collect(),
        shapes: Matrix::from_fn(n, n, |r, i| all[r].3[i]),
    };
    Some(Ok(()))
}

/// The orthogonal patterns of `n` instances: row `i` belongs to an instance.
fn patterns(n: usize) -> Matrix {
    let size = (n as f64).recip().sqrt();
    Matrix::from_fn(n, n, |i, j| {
        let angle = TAU * ((j.div_ceil(2) * i) % n) as f64 / n as f64;
        match j {
            0 => size,
            _ if 2 * j.div_ceil(2) == n => size * if i % 2 == 0 { 1.0 } else { -1.0 },
            _ if j % 2 == 1 => 2.0_f64.sqrt() * size * angle.cos(),
            _ => 2.0_f64.sqrt() * size * angle.sin(),
        }
    })
}

/// `T^T A T`, and the sums of the sizes of the terms of each entry.
fn turned(matrix: &Matrix, patterns: &[(&RingInfo, Matrix)]) -> (Matrix, Matrix) {
    let n = matrix.row_count();
    let rows = |mut all: Matrix, size: fn(f64) -> f64| {
        for (ring, pattern) in patterns {
            for slots in ring.coordinates.chunks_exact(ring.members) {
                for line in 0..n {
                    let row: Vec<f64> = slots.iter().map(|&k| all[line][k]).collect();
                    for (j, &k) in slots.iter().enumerate() {
                        all[line][k] = row.iter().enumerate().map(|(i, value)| value * size(pattern[i][j])).sum();
                    }
                }
            }
        }
        all.transpose()
    };
    let both = |size: fn(f64) -> f64| rows(rows(Matrix::from_fn(n, n, |i, j| size(matrix[i][j])), size), size);
    (both(|value| value), both(f64::abs))
}

/// Unknowns that couple, with each other and with no others.
fn blocks(n: usize, turned: &[(Matrix, Matrix); 3]) -> Vec<Vec<usize>> {
    let mut of: Vec<usize> = (0..n).collect();
    for i in 0..n {
        for j in 0..n {
            let couples = |(value, size): &(Matrix, Matrix)| value[i][j].abs() > ROUNDING * size[i][j];
            if of[i] != of[j] && turned.iter().any(couples) {
                let (keep, drop) = (of[i].min(of[j]), of[i].max(of[j]));
                of.iter_mut().filter(|own| **own == drop).for_each(|own| *own = keep);
            }
        }
    }
    let blocks = (0..n).map(|k| (0..n).filter(|i| of[*i] == k).collect::<Vec<usize>>());
    blocks.filter(|block| !block.is_empty()).collect()
}

/// A vector of a block in the coordinates of the instances.
fn expanded(n: usize, block: &[usize], of_block: &[Complex], patterns: &[(&RingInfo, Matrix)]) -> Vector<Complex> {
    let mut all = Vector::zeros(n);
    for (&k, value) in block.iter().zip(of_block) {
        all[k] = *value;
    }
    for (ring, pattern) in patterns {
        for slots in ring.coordinates.chunks_exact(ring.members) {
            let values: Vec<Complex> = slots.iter().map(|&k| all[k]).collect();
            for (i, &k) in slots.iter().enumerate() {
                all[k] = values.iter().enumerate().map(|(j, value)| value * pattern[i][j]).sum();
            }
        }
    }
    all
}
