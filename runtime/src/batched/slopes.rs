//! Total derivatives of the modes in every lane: `dlambda/db = da/db - (dg/db)^T w`, `Khat^T w = da/dq`,
//! `a = phi^T (Khat - lambda Mhat) phi`, as [`sensitivities`](crate::sensitivity::sensitivities) has them for one state.

use super::algebra::{self, LARGEST, Row, Square, for_size, load_matrix};
use super::block::{Block, POSITIVE};
use super::closed::Solver;
use crate::Description;
use crate::algebra::{Matrix, Vector};
use crate::kernels::{
    BatchKernels, Costs, Gradient, Linear, LinearPartials, ResidualPartials, Sizes,
    residual_partials_zeros,
};
use crate::modes::Family;
use crate::scalar::{Batch, Instructions, Lanes, Task, WIDTH};
use crate::sensitivity::Source;

/// What kernels write on the way.
pub(super) struct Slopes {
    /// Where the partial derivatives, which all modes share, cost less than a gradient for each.
    partials: Option<(LinearPartials<Batch>, ResidualPartials<Batch>)>,
    direct: Gradient<Batch>,
    shift: Gradient<Batch>,
    adjoint: Vector<Batch>,
    /// Sum of the sizes of all derivatives.
    total: Batch,
}

impl Slopes {
    pub(super) fn new(description: &Description, sizes: Sizes) -> Self {
        let partials = || {
            let matrices = LinearPartials::zeros(sizes);
            (matrices, residual_partials_zeros(sizes))
        };
        Self {
            partials: (Source::cheapest(Costs::of(description), sizes, Family::Undamped)
                == Source::Partials)
                .then(partials),
            direct: Gradient::zeros(sizes),
            shift: Gradient::zeros(sizes),
            adjoint: Vector::zeros(sizes.coordinates),
            total: Batch::default(),
        }
    }
}

/// Adds the derivatives of the modes of a block. Keeps the flags of lanes where they are finite.
pub(super) fn slopes(
    kernels: &dyn BatchKernels,
    instructions: Instructions,
    block: &mut Block,
    slopes: &mut Slopes,
) {
    slopes.total = Batch::all(0.0);
    if let Some((matrices, residual)) = &mut slopes.partials {
        kernels.partials_batch(instructions, block.point(), matrices, residual);
    }
    for mode in 0..block.coordinates.len() {
        if slopes.partials.is_none() {
            let (phi, lambda) = (&block.shapes[mode], &block.lambda[mode]);
            let direct = &mut slopes.direct;
            kernels.mode_gradient_batch(instructions, block.point(), phi, lambda, direct);
        }
        instructions.run(Adjoint {
            block,
            slopes,
            mode,
        });
        if slopes.partials.is_none() {
            let (w, shift) = (&slopes.adjoint, &mut slopes.shift);
            kernels.residual_gradient_batch(instructions, block.point(), w, shift);
        }
        instructions.run(Difference {
            block,
            slopes,
            mode,
        });
    }
    for (flag, total) in block.flags.0.iter_mut().zip(slopes.total.0) {
        *flag = if total <= f64::MAX { *flag } else { 0.0 };
    }
}

/// `w` of a mode, and with partial derivatives the gradients of `a` and of `w^T g`.
struct Adjoint<'a> {
    block: &'a Block,
    slopes: &'a mut Slopes,
    mode: usize,
}

impl Task for Adjoint<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self {
            block,
            slopes,
            mode,
        } = self;
        for_size(
            block.coordinates.len(),
            #[inline(always)]
            |n| {
                for at in (0..WIDTH).step_by(V::WIDTH) {
                    if let Some((matrices, _)) = &slopes.partials {
                        let phi: Row<V> = algebra::load(n, &block.shapes[mode], at);
                        let lambda = V::load(&block.lambda[mode], at);
                        let mut products = [[V::constant(0.0); LARGEST]; LARGEST];
                        for i in 0..n {
                            for j in 0..n {
                                products[i][j] = phi[i] * phi[j];
                            }
                        }
                        let form = (&products, lambda);
                        let direct = &mut slopes.direct;
                        rates(
                            n,
                            &matrices.by_coordinate,
                            form,
                            &mut direct.coordinates,
                            at,
                        );
                        rates(n, &matrices.by_input, form, &mut direct.inputs, at);
                        rates(n, &matrices.by_design, form, &mut direct.design, at);
                    }
                    let stiffness = load_matrix::<V>(n, &block.linear.stiffness, at);
                    let (solver, _) = Solver::new(n, &stiffness, POSITIVE);
                    let right = algebra::load(n, &slopes.direct.coordinates, at);
                    let w = solver.solve(n, &right);
                    algebra::store(n, &w, &mut slopes.adjoint, at);
                    if let Some((_, (by_input, by_design))) = &slopes.partials {
                        combined(n, &w, by_input, &mut slopes.shift.inputs, at);
                        combined(n, &w, by_design, &mut slopes.shift.design, at);
                    }
                }
            },
        );
    }
}

/// The derivatives of a mode by inputs and design variables.
struct Difference<'a> {
    block: &'a mut Block,
    slopes: &'a mut Slopes,
    mode: usize,
}

impl Task for Difference<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Slopes {
            direct,
            shift,
            total,
            ..
        } = self.slopes;
        for at in (0..WIDTH).step_by(V::WIDTH) {
            let mut sum = V::load(total, at);
            let inputs = &mut self.block.by_input[self.mode];
            difference::<V>(&direct.inputs, &shift.inputs, inputs, &mut sum, at);
            let design = &mut self.block.by_design[self.mode];
            difference::<V>(&direct.design, &shift.design, design, &mut sum, at);
            sum.store(total, at);
        }
    }
}

/// `phi^T (dKhat - lambda dMhat) phi` of each change, all matrices symmetric.
#[inline(always)]
fn rates<V: Lanes>(
    n: usize,
    changes: &[Linear<Batch>],
    (products, lambda): (&Square<V>, V),
    rates: &mut [Batch],
    at: usize,
) {
    for (rate, change) in rates.iter_mut().zip(changes) {
        let stiffness = &change.stiffness.as_flattened()[..n * n];
        let mass = &change.mass.as_flattened()[..n * n];
        let (mut own, mut mixed) = (V::constant(-0.0), V::constant(-0.0));
        for i in 0..n {
            for j in 0..=i {
                let stiffness = V::load(&stiffness[i * n + j], at);
                let change = stiffness - lambda * V::load(&mass[i * n + j], at);
                if i == j {
                    own = own + products[i][j] * change;
                } else {
                    mixed = mixed + products[i][j] * change;
                }
            }
        }
        (own + (mixed + mixed)).store(rate, at);
    }
}

/// `w^T partials`.
#[inline(always)]
fn combined<V: Lanes>(
    n: usize,
    w: &Row<V>,
    partials: &Matrix<Batch>,
    combined: &mut [Batch],
    at: usize,
) {
    for (k, to) in combined.iter_mut().enumerate() {
        let mut sum = V::constant(-0.0);
        for i in 0..n {
            sum = sum + w[i] * V::load(&partials[i][k], at);
        }
        sum.store(to, at);
    }
}

/// `direct - shift`; adds its sizes to `total`.
#[inline(always)]
fn difference<V: Lanes>(
    direct: &[Batch],
    shift: &[Batch],
    difference: &mut [Batch],
    total: &mut V,
    at: usize,
) {
    for ((to, direct), shift) in difference.iter_mut().zip(direct).zip(shift) {
        let own = V::load(direct, at) - V::load(shift, at);
        *total = *total + own.abs();
        own.store(to, at);
    }
}
