//! Designs, equilibria, modes and sums of the samples of one batch.

use super::{Prepared, Sums};
use crate::batched::algebra::{congruent, constants, keep};
use crate::batched::closed::{self, Solver};
use crate::lanes::{Batch, Task, Vector, WIDTH, load, load_matrix, store, store_matrix};
use crate::tolerance::normal::standard_normal_pair;
use crate::tolerance::sampling::Bits;
use crate::{Linear, Mechanism};

/// Steps of Newton's method; one does where second derivatives predict the equilibrium well.
const STEPS: usize = 6;
/// A correction this small, relative to the coordinate and a millimetre or milliradian, is the last: it takes the nominal change
/// of the stiffness, so that what remains is a share of it like that of the tolerances.
const LAST_CORRECTION: f64 = 1e-12;
const SMALL_MOTION: f64 = 1e-3;
/// Least pivot of a stiffness on the way, relative to its diagonal element.
const POSITIVE: f64 = 1e-10;
/// Least pivot of the stiffness between the nominal position and its mirror image about the equilibrium.
const CLEARLY_POSITIVE: f64 = 1e-3;
/// Least and greatest `lambda` relative to the nominal one: what changes more may have changed on its way too.
const WEAKENED: f64 = 0.5;
const STIFFENED: f64 = 2.0;
/// Greatest displacement from the nominal position, in displacements of one standard deviation.
pub(super) const FAR: f64 = 6.0;

/// Batches that go through each stage together: a stage waits for its own results most of the time, and meanwhile the
/// processor can work on the next batch.
pub(in crate::tolerance) const TOGETHER: usize = 8;

/// Samples of one batch.
pub(in crate::tolerance) struct Solved<const N: usize, const P: usize> {
    pub(in crate::tolerance) design: [Batch; P],
    pub(in crate::tolerance) coordinates: [Batch; N],
    pub(in crate::tolerance) frequencies: [Batch; N],
    /// Bit `k`: sample `k` passed every check. Of others only the design means anything.
    pub(in crate::tolerance) accepted: u32,
    /// Random bits, by pair of design variables.
    pub(in crate::tolerance) bits: [[Bits; 2]; P],
    /// How many of them are samples.
    pub(in crate::tolerance) members: usize,
    /// One for those that passed every check so far.
    flags: Batch,
    /// One for those at whose equilibrium Newton's method came to rest.
    resting: Batch,
    residual: [Batch; N],
    /// In coordinates on the way to the equilibrium, between the nominal modes there.
    stiffness: [[Batch; N]; N],
    mass: [[Batch; N]; N],
}

impl<const N: usize, const P: usize> Solved<N, P> {
    pub(in crate::tolerance) const fn new() -> Self {
        Self {
            design: [Batch([0.0; WIDTH]); P],
            coordinates: [Batch([0.0; WIDTH]); N],
            frequencies: [Batch([0.0; WIDTH]); N],
            accepted: 0,
            bits: [[[0; WIDTH]; 2]; P],
            members: 0,
            flags: Batch([0.0; WIDTH]),
            resting: Batch([0.0; WIDTH]),
            residual: [Batch([0.0; WIDTH]); N],
            stiffness: [[Batch([0.0; WIDTH]); N]; N],
            mass: [[Batch([0.0; WIDTH]); N]; N],
        }
    }
}

impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Prepared<'_, M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    /// Solves the members of some batches from their random bits, and adds them to `sums`.
    pub(in crate::tolerance) fn solve(&self, batches: &mut [Solved<N, P>], sums: &mut Sums<N>) {
        self.instructions.run(Work {
            prepared: self,
            batches,
            sums,
        });
    }
}

struct Work<'a, M, const N: usize, const U: usize, const P: usize, const O: usize> {
    prepared: &'a Prepared<'a, M, N, U, P, O>,
    batches: &'a mut [Solved<N, P>],
    sums: &'a mut Sums<N>,
}

impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Task
    for Work<'_, M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self) {
        let Self {
            prepared,
            batches,
            sums,
        } = self;
        let one = V::constant(1.0);
        for batch in &mut *batches {
            for at in (0..batch.members).step_by(V::WIDTH) {
                let design: [V; P] = draw(prepared, &batch.bits, at);
                store(&mut batch.design, at, &design);
                store(&mut batch.coordinates, at, &predicted(prepared, &design));
            }
            batch.resting = Batch([0.0; WIDTH]);
            let all = prepared.all_possible && batch.members == WIDTH;
            batch.flags = if all {
                Batch::all(1.0)
            } else {
                possible(prepared, &batch.design, batch.members)
            };
        }
        for _ in 0..STEPS {
            let mut moving = false;
            for batch in &mut *batches {
                for at in (0..batch.members).step_by(V::WIDTH) {
                    if !rests::<V, N, P>(batch, at) {
                        moving = true;
                        evaluate::<V, M, N, U, P, O>(prepared, batch, at);
                    }
                }
            }
            if !moving {
                break;
            }
            for batch in &mut *batches {
                for at in (0..batch.members).step_by(V::WIDTH) {
                    if !rests::<V, N, P>(batch, at) {
                        improve::<V, M, N, U, P, O>(prepared, batch, at);
                    }
                }
            }
        }
        for batch in &mut *batches {
            for at in (0..batch.members).step_by(V::WIDTH) {
                matrices::<V, M, N, U, P, O>(prepared, batch, at);
            }
        }
        for batch in &mut *batches {
            batch.accepted = 0;
            for at in (0..batch.members).step_by(V::WIDTH) {
                let (lambda, flag) = modes::<V, M, N, U, P, O>(prepared, batch, at);
                for (r, lambda) in lambda.into_iter().enumerate() {
                    let frequency = lambda.sqrt();
                    frequency.store(&mut batch.frequencies[r], at);
                    let nominal = V::constant(prepared.frequencies[r]);
                    sums.add(r, at, frequency - nominal, flag);
                }
                let accepted = V::bits(one.at_most(flag));
                sums.count(accepted.count_ones());
                batch.accepted |= accepted << at;
            }
        }
    }
}

/// Whether all of these samples have come to rest.
#[inline(always)]
fn rests<V: Vector, const N: usize, const P: usize>(batch: &Solved<N, P>, at: usize) -> bool {
    V::every(V::constant(1.0).at_most(V::load(&batch.resting, at)))
}

/// `b = b_nominal + L z`, `z` standard normal.
#[inline(always)]
fn draw<V: Vector, M, const N: usize, const U: usize, const P: usize, const O: usize>(
    prepared: &Prepared<'_, M, N, U, P, O>,
    pairs: &[[Bits; 2]; P],
    at: usize,
) -> [V; P] {
    let mut standard = [V::constant(0.0); P];
    for pair in 0..P.div_ceil(2) {
        if prepared.drawn[pair] {
            let [radius, angle] = &pairs[pair];
            let (first, second) =
                standard_normal_pair(V::probability(radius, at), V::probability(angle, at));
            standard[2 * pair] = first;
            if 2 * pair + 1 < P {
                standard[2 * pair + 1] = second;
            }
        }
    }
    let mut design: [V; P] = constants(&prepared.nominal.design);
    for &(i, j, factor) in &prepared.shared {
        design[i] = design[i] + V::constant(factor) * standard[j];
    }
    for ((design, standard), factor) in design.iter_mut().zip(standard).zip(&prepared.own) {
        *design = *design + V::constant(*factor) * standard;
    }
    design
}

/// Ones for the members whose bodies can exist.
#[inline(always)]
fn possible<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    prepared: &Prepared<'_, M, N, U, P, O>,
    design: &[Batch; P],
    members: usize,
) -> Batch
where
    M: Mechanism<N, U, P, O>,
{
    let mut flags = Batch([0.0; WIDTH]);
    for sample in 0..members {
        let design = core::array::from_fn(|i| design[i].0[sample]);
        let violation = prepared
            .mechanism
            .violation(&prepared.nominal.inputs, &design);
        flags.0[sample] = f64::from(u8::from(violation.is_none()));
    }
    flags
}

/// The equilibrium as the derivatives of the nominal one predict it.
#[inline(always)]
fn predicted<V: Vector, M, const N: usize, const U: usize, const P: usize, const O: usize>(
    prepared: &Prepared<'_, M, N, U, P, O>,
    design: &[V; P],
) -> [V; N] {
    let mut q: [V; N] = constants(&prepared.nominal.coordinates);
    let mut change = [V::constant(0.0); P];
    // Bounds that the compiler knows: these loops are unrolled.
    for k in 0..P {
        let Some(&variable) = prepared.varied.get(k) else {
            break;
        };
        change[k] = design[variable] - V::constant(prepared.nominal.design[variable]);
        let mut slope: [V; N] = constants(&prepared.first[k]);
        if let Some(second) = prepared.second.get(k) {
            for j in 0..=k {
                for (slope, coefficient) in slope.iter_mut().zip(&second[j]) {
                    *slope = *slope + V::constant(*coefficient) * change[j];
                }
            }
        }
        for (q, slope) in q.iter_mut().zip(slope) {
            *q = *q + slope * change[k];
        }
    }
    q
}

/// Residual and stiffness on the way to the equilibrium.
#[inline(always)]
fn evaluate<V: Vector, M, const N: usize, const U: usize, const P: usize, const O: usize>(
    prepared: &Prepared<'_, M, N, U, P, O>,
    batch: &mut Solved<N, P>,
    at: usize,
) where
    M: Mechanism<N, U, P, O>,
{
    let q: [V; N] = load(&batch.coordinates, at);
    let inputs = constants(&prepared.nominal.inputs);
    let design = load(&batch.design, at);
    let (residual, stiffness) = prepared
        .mechanism
        .residual_and_stiffness_inlined(&q, &inputs, &design);
    store(&mut batch.residual, at, &residual);
    store_matrix(&mut batch.stiffness, at, &stiffness);
}

/// A step of Newton's method; a sample fails where the stiffness is not positive definite on the way.
#[inline(always)]
fn improve<V: Vector, M, const N: usize, const U: usize, const P: usize, const O: usize>(
    prepared: &Prepared<'_, M, N, U, P, O>,
    batch: &mut Solved<N, P>,
    at: usize,
) where
    M: Mechanism<N, U, P, O>,
{
    let one = V::constant(1.0);
    let mut q: [V; N] = load(&batch.coordinates, at);
    let stiffness: [[V; N]; N] = load_matrix(&batch.stiffness, at);
    let (solver, positive) = Solver::new(&stiffness, POSITIVE);
    let step = solver.solve(&load(&batch.residual, at));
    let correction = solver.solve(&curved(&prepared.curvature, &step));
    // Samples at rest stay where they are, so that none depends on the others.
    let rested = V::load(&batch.resting, at);
    let moving = rested.at_most(V::constant(0.0));
    let flag = V::load(&batch.flags, at);
    let flag = keep(flag, one.at_most(V::choose(moving, positive, one)));
    flag.store(&mut batch.flags, at);
    let mut resting = one;
    for ((q, step), correction) in q.iter_mut().zip(step).zip(correction) {
        let scale = V::constant(LAST_CORRECTION) * (q.abs() + V::constant(SMALL_MOTION));
        resting = keep(resting, correction.abs().at_most(scale));
        *q = V::choose(moving, *q - (step + correction), *q);
    }
    store(&mut batch.coordinates, at, &q);
    V::choose(moving, resting, rested).store(&mut batch.resting, at);
}

/// `1/2 d2g/dq2 step step`, which a Newton step leaves of the residual: `curvature` holds `1/2 dKhat/dq_k`, off its diagonal
/// in `k` and `j` twice.
#[inline(always)]
fn curved<V: Vector, const N: usize>(curvature: &[[[f64; N]; N]; N], step: &[V; N]) -> [V; N] {
    let mut rest = [V::constant(0.0); N];
    for (k, slopes) in curvature.iter().enumerate() {
        for (j, slopes) in slopes[..=k].iter().enumerate() {
            let product = step[k] * step[j];
            for (rest, slope) in rest.iter_mut().zip(slopes) {
                *rest = *rest + V::constant(*slope) * product;
            }
        }
    }
    rest
}

/// Mass and stiffness at the equilibrium, between the nominal modes.
#[inline(always)]
fn matrices<V: Vector, M, const N: usize, const U: usize, const P: usize, const O: usize>(
    prepared: &Prepared<'_, M, N, U, P, O>,
    batch: &mut Solved<N, P>,
    at: usize,
) where
    M: Mechanism<N, U, P, O>,
{
    let q: [V; N] = load(&batch.coordinates, at);
    let inputs = constants(&prepared.nominal.inputs);
    let design = load(&batch.design, at);
    let Linear {
        mass, stiffness, ..
    } = prepared.mechanism.linear_inlined(&q, &inputs, &design);
    store_matrix(&mut batch.mass, at, &congruent(&mass, &prepared.shapes));
    let stiffness = congruent(&stiffness, &prepared.shapes);
    store_matrix(&mut batch.stiffness, at, &stiffness);
}

/// `lambda` of the modes in the nominal order; the flag says that every check was passed: at last, that all modes are recognised,
/// the equilibrium is near the nominal one, and the stiffness is positive definite here and, as far as its derivative
/// tells, from the nominal position to its mirror image: then so it is all the way.
#[inline(always)]
fn modes<V: Vector, M, const N: usize, const U: usize, const P: usize, const O: usize>(
    prepared: &Prepared<'_, M, N, U, P, O>,
    batch: &Solved<N, P>,
    at: usize,
) -> ([V; N], V)
where
    M: Mechanism<N, U, P, O>,
{
    let one = V::constant(1.0);
    let q: [V; N] = load(&batch.coordinates, at);
    let mass = load_matrix(&batch.mass, at);
    let stiffness: [[V; N]; N] = load_matrix(&batch.stiffness, at);
    let at_rest = one.at_most(V::load(&batch.resting, at));
    let mut flag = keep(V::load(&batch.flags, at), at_rest);
    let mut nearby = stiffness;
    let displacements = q.iter().zip(&prepared.nominal.coordinates);
    for ((q, nominal), stiffening) in displacements.zip(&prepared.stiffening) {
        let twice = (*q - V::constant(*nominal)) * V::constant(2.0);
        for (row, slopes) in nearby.iter_mut().zip(stiffening) {
            for (entry, slope) in row.iter_mut().zip(slopes) {
                *entry = *entry - V::constant(*slope) * twice;
            }
        }
    }
    let displacements = q.iter().zip(&prepared.nominal.coordinates);
    for ((q, nominal), reach) in displacements.zip(&prepared.reach) {
        let displacement = (*q - V::constant(*nominal)).abs();
        flag = keep(flag, displacement.at_most(V::constant(FAR * reach)));
    }
    let flag = keep(
        flag,
        one.at_most(closed::definite(&nearby, CLEARLY_POSITIVE)),
    );
    let (lambda, recognised) = closed::eigenvalues(&stiffness, &mass);
    let mut flag = keep(flag, one.at_most(recognised));
    for (lambda, nominal) in lambda.iter().zip(prepared.lambda) {
        flag = keep(flag, V::constant(WEAKENED * nominal).at_most(*lambda));
        flag = keep(flag, lambda.at_most(V::constant(STIFFENED * nominal)));
    }
    (lambda, flag)
}
