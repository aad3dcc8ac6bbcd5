//! Total derivatives of the modes in every lane: `dlambda/db = da/db - (dg/db)^T w`, `Khat^T w = da/dq`,
//! `a = phi^T (Khat - lambda Mhat) phi`, the counterpart of [`sensitivities`](crate::sensitivity::sensitivities) for
//! one state.

use super::algebra::{self, Row, Square, for_size, load_matrix};
use super::block::{Block, POSITIVE};
use super::closed::FactoredMatrix;
use super::room::BatchArena;
use crate::Description;
use crate::kernels::{BatchGradient, BatchKernels, BatchLinear, BatchPartials, Costs, Sizes};
use crate::modes::Family;
use crate::scalar::{Batch, Instructions, Lanes, Task, WIDTH};
use crate::sensitivity::Source;

/// Buffers for intermediate kernel results.
pub(super) enum Slopes<'a> {
    /// Partial derivatives, shared by all modes, if they cost less than one gradient per mode.
    Partials(Partials<'a>),
    /// Gradients of `a` and of `w^T g` by reverse differentiation, one mode after the other.
    Gradients(Gradients<'a>),
}

/// Partial derivatives of the matrices, and of the residual with respect to inputs and design variables.
pub(super) struct Partials<'a> {
    matrices: BatchPartials<'a>,
    residual: [&'a mut [Batch]; 2],
}

pub(super) struct Gradients<'a> {
    direct: BatchGradient<'a>,
    shift: BatchGradient<'a>,
    /// `w`.
    adjoint: &'a mut [Batch],
}

impl<'a> Slopes<'a> {
    /// Maximum number of batches that they take.
    pub(super) fn size(sizes: Sizes) -> usize {
        let (n, variables) = (sizes.coordinates, sizes.inputs + sizes.design);
        let partials = 2 * n * n * (n + variables) + n * variables;
        let gradients = 2 * (n + variables) + n;
        partials.max(gradients)
    }

    pub(super) fn new(room: &mut BatchArena<'a>, description: &Description, sizes: Sizes) -> Self {
        let n = sizes.coordinates;
        if Source::cheapest(Costs::of(description), sizes, Family::Undamped) == Source::Partials {
            let mut matrices = |count| BatchLinear {
                mass: room.take(count * n * n),
                damping: &mut [],
                stiffness: room.take(count * n * n),
            };
            let matrices = BatchPartials {
                by_coordinate: matrices(n),
                by_input: matrices(sizes.inputs),
                by_design: matrices(sizes.design),
            };
            let residual = [sizes.inputs, sizes.design].map(|columns| room.take(n * columns));
            Self::Partials(Partials { matrices, residual })
        } else {
            let mut gradient = || BatchGradient {
                coordinates: room.take(n),
                inputs: room.take(sizes.inputs),
                design: room.take(sizes.design),
            };
            Self::Gradients(Gradients { direct: gradient(), shift: gradient(), adjoint: room.take(n) })
        }
    }
}

/// Adds the derivatives of the modes of a block. Keeps the flags of lanes where they are finite.
pub(super) fn slopes<'m>(
    kernels: &dyn BatchKernels,
    instructions: Instructions,
    block: &mut Block<'m>,
    slopes: &mut Slopes<'m>,
) {
    match slopes {
        Slopes::Partials(partials) => {
            let Partials { matrices, residual } = partials;
            let residual = residual.each_mut().map(|list| &mut **list);
            kernels.partials_batch(instructions, block.point(), matrices, residual);
            instructions.run(FromPartials { block, partials });
        }
        Slopes::Gradients(gradients) => {
            for mode in 0..block.lambda.len() {
                let Gradients { direct, .. } = gradients;
                let phi = &block.shapes[mode * block.lambda.len()..][..block.lambda.len()];
                let lambda = &block.lambda[mode];
                kernels.mode_gradient_batch(instructions, block.point(), phi, lambda, direct);
                instructions.run(Adjoint { block, gradients });
                let Gradients { shift, adjoint, .. } = gradients;
                kernels.residual_gradient_batch(instructions, block.point(), adjoint, shift);
                instructions.run(TotalDerivatives { block, gradients, mode });
            }
        }
    }
}

/// The derivatives of all modes from partial derivatives.
struct FromPartials<'a, 'b> {
    block: &'a mut Block<'b>,
    partials: &'a Partials<'b>,
}

impl Task for FromPartials<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { block, partials } = self;
        for_size!(block.coordinates.len(), |n, N| {
            for at in (0..WIDTH).step_by(V::WIDTH) {
                from_partials::<V, N>(n, partials, block, at);
            }
        });
    }
}

#[inline(always)]
fn from_partials<V: Lanes, const N: usize>(n: usize, partials: &Partials<'_>, block: &mut Block<'_>, at: usize) {
    let Partials { matrices, residual } = partials;
    let stiffness: Square<V, N> = load_matrix(n, block.linear.stiffness, at);
    let (solver, _) = FactoredMatrix::new(n, &stiffness, POSITIVE);
    let lambda: Row<V, N> = algebra::load(n, block.lambda, at);
    let phi: Square<V, N> = load_matrix(n, block.shapes, at);
    let mut right = [[V::constant(0.0); N]; N];
    for k in 0..n {
        let change = Change::load(n, &matrices.by_coordinate, k, at);
        for mode in 0..n {
            right[mode][k] = change.rate(n, &phi[mode], lambda[mode]);
        }
    }
    let mut w = [[V::constant(0.0); N]; N];
    for mode in 0..n {
        w[mode] = solver.solve(n, &right[mode]);
    }
    let mut finite = Finite::new();
    for (changes, forces, to) in [
        (&matrices.by_input, &residual[0], &mut *block.by_input),
        (&matrices.by_design, &residual[1], &mut *block.by_design),
    ] {
        let count = to.len() / n;
        let (forces, to) = (&forces[..n * count], &mut to[..n * count]);
        for k in 0..count {
            let change = Change::load(n, changes, k, at);
            let mut force = [V::constant(0.0); N];
            for i in 0..n {
                force[i] = V::load(&forces[i * count + k], at);
            }
            for mode in 0..n {
                let mut shift = V::constant(-0.0);
                for i in 0..n {
                    shift = shift + w[mode][i] * force[i];
                }
                let slope = change.rate(n, &phi[mode], lambda[mode]) - shift;
                finite.see(slope);
                slope.store(&mut to[mode * count + k], at);
            }
        }
    }
    finite.keep(&mut block.flags, at);
}

/// Computes `w` of a mode.
struct Adjoint<'a, 'b> {
    block: &'a Block<'b>,
    gradients: &'a mut Gradients<'b>,
}

impl Task for Adjoint<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { block, gradients } = self;
        for_size!(block.coordinates.len(), |n, N| {
            for at in (0..WIDTH).step_by(V::WIDTH) {
                let stiffness: Square<V, N> = load_matrix(n, block.linear.stiffness, at);
                let (solver, _) = FactoredMatrix::new(n, &stiffness, POSITIVE);
                let right = algebra::load(n, gradients.direct.coordinates, at);
                let w = solver.solve(n, &right);
                algebra::store(n, &w, gradients.adjoint, at);
            }
        });
    }
}

/// The derivatives of a mode with respect to inputs and design variables.
struct TotalDerivatives<'a, 'b> {
    block: &'a mut Block<'b>,
    gradients: &'a Gradients<'b>,
    mode: usize,
}

impl Task for TotalDerivatives<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { block, gradients: Gradients { direct, shift, .. }, mode } = self;
        for at in (0..WIDTH).step_by(V::WIDTH) {
            let mut finite = Finite::new();
            for (direct, shift, to) in [
                (&direct.inputs, &shift.inputs, &mut *block.by_input),
                (&direct.design, &shift.design, &mut *block.by_design),
            ] {
                let count = direct.len();
                let (shift, to) = (&shift[..count], &mut to[mode * count..][..count]);
                for k in 0..count {
                    let slope = V::load(&direct[k], at) - V::load(&shift[k], at);
                    finite.see(slope);
                    slope.store(&mut to[k], at);
                }
            }
            finite.keep(&mut block.flags, at);
        }
    }
}

/// Sum of the magnitudes of all values seen.
struct Finite<V>(V);

impl<V: Lanes> Finite<V> {
    #[inline(always)]
    fn new() -> Self {
        Self(V::constant(0.0))
    }

    #[inline(always)]
    fn see(&mut self, value: V) {
        self.0 = self.0 + value.abs();
    }

    /// Keeps the flags of lanes in which all values were finite.
    #[inline(always)]
    fn keep(self, flags: &mut Batch, at: usize) {
        let finite = self.0.at_most(V::constant(f64::MAX));
        algebra::keep(V::load(flags, at), finite).store(flags, at);
    }
}

/// The derivatives of the symmetric matrices with respect to one variable, on and below the diagonal.
struct Change<V, const N: usize> {
    stiffness: Square<V, N>,
    mass: Square<V, N>,
}

impl<V: Lanes, const N: usize> Change<V, N> {
    #[inline(always)]
    fn load(n: usize, changes: &BatchLinear<'_>, k: usize, at: usize) -> Self {
        let stiffness = &changes.stiffness[k * n * n..][..n * n];
        let mass = &changes.mass[k * n * n..][..n * n];
        let mut change = Self { stiffness: [[V::constant(0.0); N]; N], mass: [[V::constant(0.0); N]; N] };
        for i in 0..n {
            for j in 0..=i {
                change.stiffness[i][j] = V::load(&stiffness[i * n + j], at);
                change.mass[i][j] = V::load(&mass[i * n + j], at);
            }
        }
        change
    }

    /// `phi^T (dKhat - lambda dMhat) phi`.
    #[inline(always)]
    fn rate(&self, n: usize, phi: &Row<V, N>, lambda: V) -> V {
        let (mut diagonal, mut mixed) = (V::constant(-0.0), V::constant(-0.0));
        for i in 0..n {
            for j in 0..=i {
                let change = self.stiffness[i][j] - lambda * self.mass[i][j];
                if i == j {
                    diagonal = diagonal + phi[i] * phi[j] * change;
                } else {
                    mixed = mixed + phi[i] * phi[j] * change;
                }
            }
        }
        diagonal + (mixed + mixed)
    }
}
