//! Designs, equilibria, modes and sums of the samples of one batch.

use super::{Prepared, Sums};
use crate::batched::algebra::{congruent, constants, keep};
use crate::batched::closed::{self, Solver};
use crate::lanes::{Batch, Task, Vector};
use crate::tolerance::normal::standard_normal_pair;
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

/// Samples of one batch.
pub(in crate::tolerance) struct Solved<const N: usize, const P: usize> {
    pub(in crate::tolerance) design: [Batch; P],
    pub(in crate::tolerance) coordinates: [Batch; N],
    pub(in crate::tolerance) frequencies: [Batch; N],
    /// Bit `k`: sample `k` passed every check. Of others only the design means anything.
    pub(in crate::tolerance) accepted: u32,
}

impl<const N: usize, const P: usize> Solved<N, P> {
    pub(in crate::tolerance) fn new() -> Self {
        Self {
            design: [Batch::default(); P],
            coordinates: [Batch::default(); N],
            frequencies: [Batch::default(); N],
            accepted: 0,
        }
    }
}

impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Prepared<'_, M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    /// Solves the first `number` samples of a batch from pairs of probabilities, and adds them to `sums`.
    pub(in crate::tolerance) fn solve(
        &self,
        pairs: &[[Batch; 2]; P],
        number: usize,
        solved: &mut Solved<N, P>,
        sums: &mut Sums<N>,
    ) {
        self.instructions.run(Work {
            prepared: self,
            pairs,
            number,
            solved,
            sums,
        });
    }
}

struct Work<'a, M, const N: usize, const U: usize, const P: usize, const O: usize> {
    prepared: &'a Prepared<'a, M, N, U, P, O>,
    pairs: &'a [[Batch; 2]; P],
    number: usize,
    solved: &'a mut Solved<N, P>,
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
            pairs,
            number,
            solved,
            sums,
        } = self;
        solved.accepted = 0;
        for at in (0..number).step_by(V::WIDTH) {
            let design = draw::<V, M, N, U, P, O>(prepared, pairs, at);
            for (batch, value) in solved.design.iter_mut().zip(design) {
                value.store(batch, at);
            }
            let samples = at..(at + V::WIDTH).min(number);
            let possible = if prepared.all_possible && samples.len() == V::WIDTH {
                V::constant(1.0)
            } else {
                V::load(&possible(prepared, &solved.design, samples), at)
            };
            let (q, found) = equilibrium(prepared, &design);
            let flag = keep(possible, V::constant(1.0).at_most(found));
            let (lambda, flag) = modes(prepared, &design, &q, flag);
            for (batch, value) in solved.coordinates.iter_mut().zip(q) {
                value.store(batch, at);
            }
            for (r, lambda) in lambda.into_iter().enumerate() {
                let frequency = lambda.sqrt();
                frequency.store(&mut solved.frequencies[r], at);
                let nominal = V::constant(prepared.frequencies[r]);
                sums.add(r, at, frequency - nominal, flag);
            }
            let accepted = V::bits(V::constant(1.0).at_most(flag));
            sums.count(accepted.count_ones());
            solved.accepted |= accepted << at;
        }
    }
}

/// `b = b_nominal + L z`, `z` standard normal.
#[inline(always)]
fn draw<V: Vector, M, const N: usize, const U: usize, const P: usize, const O: usize>(
    prepared: &Prepared<'_, M, N, U, P, O>,
    pairs: &[[Batch; 2]; P],
    at: usize,
) -> [V; P] {
    let mut standard = [V::constant(0.0); P];
    for &pair in &prepared.drawn {
        let [radius, angle] = &pairs[pair];
        let (first, second) = standard_normal_pair(V::load(radius, at), V::load(angle, at));
        standard[2 * pair] = first;
        if 2 * pair + 1 < P {
            standard[2 * pair + 1] = second;
        }
    }
    let mut design: [V; P] = constants(&prepared.nominal.design);
    for &(i, j, factor) in &prepared.draws {
        design[i] = design[i] + V::constant(factor) * standard[j];
    }
    design
}

/// Ones for the samples whose bodies can exist.
#[inline(always)]
fn possible<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    prepared: &Prepared<'_, M, N, U, P, O>,
    design: &[Batch; P],
    samples: core::ops::Range<usize>,
) -> Batch
where
    M: Mechanism<N, U, P, O>,
{
    let mut flags = Batch::default();
    for sample in samples {
        let design = core::array::from_fn(|i| design[i].0[sample]);
        let violation = prepared
            .mechanism
            .violation(&prepared.nominal.inputs, &design);
        flags.0[sample] = f64::from(u8::from(violation.is_none()));
    }
    flags
}

/// The equilibrium by Newton's method from the predicted one; the flag says that it came to rest, through positive definite
/// stiffness, near the nominal position.
#[inline(always)]
fn equilibrium<V: Vector, M, const N: usize, const U: usize, const P: usize, const O: usize>(
    prepared: &Prepared<'_, M, N, U, P, O>,
    design: &[V; P],
) -> ([V; N], V)
where
    M: Mechanism<N, U, P, O>,
{
    let (zero, one) = (V::constant(0.0), V::constant(1.0));
    let inputs = constants(&prepared.nominal.inputs);
    let start: [V; N] = constants(&prepared.nominal.coordinates);
    let mut q = start;
    let mut change = [zero; P];
    for ((change, &i), slope) in change.iter_mut().zip(&prepared.varied).zip(&prepared.first) {
        *change = design[i] - V::constant(prepared.nominal.design[i]);
        for (q, slope) in q.iter_mut().zip(slope) {
            *q = *q + V::constant(*slope) * *change;
        }
    }
    for (j, k, coefficients) in &prepared.second {
        let product = change[*j] * change[*k];
        for (q, coefficient) in q.iter_mut().zip(coefficients) {
            *q = *q + V::constant(*coefficient) * product;
        }
    }
    let (mut resting, mut flag) = (zero, one);
    for _ in 0..STEPS {
        let (residual, stiffness) = prepared
            .mechanism
            .residual_and_stiffness_inlined(&q, &inputs, design);
        let (solver, positive) = Solver::new(&stiffness, POSITIVE);
        let step = solver.solve(&residual);
        let correction = solver.solve(&curved(&prepared.curvature, &step));
        // Lanes at rest stay where they are, so that none depends on the others.
        let moving = resting.at_most(zero);
        flag = keep(flag, one.at_most(V::choose(moving, positive, one)));
        let mut last = one;
        for ((q, step), correction) in q.iter_mut().zip(step).zip(correction) {
            let scale = V::constant(LAST_CORRECTION) * (q.abs() + V::constant(SMALL_MOTION));
            last = keep(last, correction.abs().at_most(scale));
            *q = V::choose(moving, *q - (step + correction), *q);
        }
        resting = V::choose(moving, last, resting);
        if V::every(one.at_most(resting)) {
            break;
        }
    }
    flag = keep(flag, one.at_most(resting));
    for ((q, start), reach) in q.iter().zip(start).zip(&prepared.reach) {
        let displacement = (*q - start).abs();
        flag = keep(flag, displacement.at_most(V::constant(FAR * reach)));
    }
    (q, flag)
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

/// `lambda` of the modes in the nominal order; the flag says that all are recognised, and that the stiffness is positive definite
/// here and, as far as its derivative tells, from the nominal position to its mirror image: then so it is all the way.
#[inline(always)]
fn modes<V: Vector, M, const N: usize, const U: usize, const P: usize, const O: usize>(
    prepared: &Prepared<'_, M, N, U, P, O>,
    design: &[V; P],
    q: &[V; N],
    flag: V,
) -> ([V; N], V)
where
    M: Mechanism<N, U, P, O>,
{
    let inputs = constants(&prepared.nominal.inputs);
    let Linear {
        mass, stiffness, ..
    } = prepared.mechanism.linear_inlined(q, &inputs, design);
    let mass = congruent(&mass, &prepared.shapes);
    let stiffness = congruent(&stiffness, &prepared.shapes);
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
    let one = V::constant(1.0);
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
