//! The kernels at several states at once, with the processor's vector instructions.
//!
//! A [`Batch`] holds one number for each of [`WIDTH`] states, so that a list of `N` batches is `WIDTH` sets of
//! unknowns. Every result is, bit for bit, what the kernel gives for that state alone, whatever the processor: the
//! operations are the same, each is rounded once, and none are fused.

use core::slice;

use super::{DirectionalKernels, Kernels};
use crate::mechanism::{Array, Gradient, GradientOf, Linear, LinearPartials, Mechanism, RestParts, Square};
use crate::scalar::{Batch, Instructions, Lanes, Task, WIDTH};
use crate::{DampingKind, Description};

/// Unknowns, inputs and design variables of a batch of states.
#[derive(Clone, Copy, Debug)]
pub struct BatchPoint<'a> {
    /// Unknowns.
    pub q: &'a [Batch],
    /// Inputs.
    pub u: &'a [Batch],
    /// Design variables.
    pub b: &'a [Batch],
}

/// Buffers for the residual in two parts.
pub type BatchParts<'a> = RestParts<&'a mut [Batch]>;
/// Buffers for mass, damping and stiffness, row by row. A damping matrix that is always zero is not written: its buffer
/// may be empty.
pub type BatchLinear<'a> = Linear<&'a mut [Batch]>;
/// Buffers for derivatives of the three matrices: of each matrix with respect to one variable after the other.
pub type BatchPartials<'a> = LinearPartials<BatchLinear<'a>>;
/// Buffers for derivatives of one number.
pub type BatchGradient<'a> = Gradient<&'a mut [Batch]>;

/// The kernels that sweeps and Monte Carlo need, evaluated at every state of a batch. Results are written to slices of
/// exactly their length, matrices row by row.
pub trait BatchKernels: DirectionalKernels {
    /// [`Kernels::evaluate`](super::Kernels::evaluate) at every state with these instructions.
    fn evaluate_states(
        &self,
        instructions: Instructions,
        kernel: super::Kernel,
        arguments: &[&[Batch]],
        results: &mut [&mut [Batch]],
    );

    /// [`Kernels::partials_into`](super::Kernels::partials_into); `residual` holds the derivatives with respect to
    /// inputs and to design variables.
    fn partials_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        matrices: &mut BatchPartials<'_>,
        residual: [&mut [Batch]; 2],
    );

    /// [`Kernels::parts_and_linear_into`](super::Kernels::parts_and_linear_into).
    fn parts_and_linear_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        parts: &mut BatchParts<'_>,
        linear: &mut BatchLinear<'_>,
    ) {
        let results = &mut [&mut *parts.inertia, &mut *parts.applied];
        self.evaluate_states(instructions, super::Kernel::ResidualParts, &at.lists(), results);
        self.linear_batch(instructions, at, linear);
    }

    /// [`Kernels::residual_and_stiffness_into`](super::Kernels::residual_and_stiffness_into).
    fn residual_and_stiffness_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        residual: &mut [Batch],
        stiffness: &mut [Batch],
    ) {
        let results = &mut [residual, stiffness];
        self.evaluate_states(instructions, super::Kernel::ResidualAndStiffness, &at.lists(), results);
    }

    /// [`Kernels::linear_into`](super::Kernels::linear_into).
    fn linear_batch(&self, instructions: Instructions, at: BatchPoint<'_>, linear: &mut BatchLinear<'_>) {
        let results = &mut [&mut *linear.mass, &mut *linear.damping, &mut *linear.stiffness];
        self.evaluate_states(instructions, super::Kernel::Linear, &at.lists(), results);
    }

    /// [`Kernels::mode_gradient_into`](super::Kernels::mode_gradient_into), with a separate mode for each state.
    fn mode_gradient_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        phi: &[Batch],
        lambda: &Batch,
        gradient: &mut BatchGradient<'_>,
    ) {
        let arguments = [at.q, at.u, at.b, phi, slice::from_ref(lambda)];
        self.evaluate_states(instructions, super::Kernel::ModeGradient, &arguments, &mut results(gradient));
    }

    /// [`Kernels::residual_gradient_into`](super::Kernels::residual_gradient_into).
    fn residual_gradient_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        w: &[Batch],
        gradient: &mut BatchGradient<'_>,
    ) {
        let arguments = [at.q, at.u, at.b, w];
        self.evaluate_states(instructions, super::Kernel::ResidualGradient, &arguments, &mut results(gradient));
    }
}

/// A gradient as results.
fn results<'a>(gradient: &'a mut BatchGradient<'_>) -> [&'a mut [Batch]; 3] {
    [&mut *gradient.coordinates, &mut *gradient.inputs, &mut *gradient.design]
}

impl<'a> BatchPoint<'a> {
    fn lists(&self) -> [&'a [Batch]; 3] {
        [self.q, self.u, self.b]
    }
}

#[inline(always)]
fn load<V: Lanes, A: Array<V>>(from: &[Batch], at: usize) -> A {
    // Loops, here and below: an iterator adaptor that is not inlined loses the vector instructions.
    let mut vectors = A::filled(V::constant(0.0));
    let from = &from[..A::LEN];
    for (k, vector) in vectors.as_mut().iter_mut().enumerate() {
        *vector = V::load(&from[k], at);
    }
    vectors
}

#[inline(always)]
fn store<V: Lanes>(from: &[V], to: &mut [Batch], at: usize) {
    let to = &mut to[..from.len()];
    for (k, from) in from.iter().enumerate() {
        from.store(&mut to[k], at);
    }
}

/// Stores a matrix row by row.
#[inline(always)]
fn store_rows<V: Lanes, R: Array<V>>(from: &[R], to: &mut [Batch], at: usize) {
    let to = &mut to[..R::LEN * from.len()];
    for (i, from) in from.iter().enumerate() {
        store(from.as_ref(), &mut to[R::LEN * i..], at);
    }
}

#[inline(always)]
fn store_gradient<V: Lanes, M: Mechanism>(from: &GradientOf<M, V>, to: &mut BatchGradient<'_>, at: usize) {
    store(from.coordinates.as_ref(), to.coordinates, at);
    store(from.inputs.as_ref(), to.inputs, at);
    store(from.design.as_ref(), to.design, at);
}

/// Stores matrices one after the other. A damping matrix that is always zero is not read, so the kernel need not write
/// it.
#[inline(always)]
fn store_linears<V: Lanes, M: Mechanism>(from: &[Linear<Square<M, V>>], to: &mut BatchLinear<'_>, at: usize) {
    let size = M::Coordinates::<V>::LEN * M::Coordinates::<V>::LEN;
    for (k, from) in from.iter().enumerate() {
        let first = k * size;
        store_rows(from.mass.as_ref(), &mut to.mass[first..], at);
        store_rows(from.stiffness.as_ref(), &mut to.stiffness[first..], at);
        if const { damped(const { &M::DESCRIPTION }) } {
            store_rows(from.damping.as_ref(), &mut to.damping[first..], at);
        }
    }
}

/// A kernel of a compiled mechanism, as a task for a set of instructions.
struct Call<'a, M, F> {
    mechanism: &'a M,
    /// By reference: slices just written one word at a time are slow to copy.
    at: &'a BatchPoint<'a>,
    kernel: F,
}

/// Unknowns, inputs and design variables in vectors.
type Point<'a, M, V> =
    (&'a <M as Mechanism>::Coordinates<V>, &'a <M as Mechanism>::Inputs<V>, &'a <M as Mechanism>::Design<V>);

/// The body of a [`Call`] for the states from `at` on.
trait Kernel<M: Mechanism> {
    fn run<V: Lanes>(&mut self, mechanism: &M, point: Point<'_, M, V>, at: usize);
}

impl<M: Mechanism, F: Kernel<M>> Task for Call<'_, M, F> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(mut self) {
        for at in (0..WIDTH).step_by(V::WIDTH) {
            let q: M::Coordinates<V> = load(self.at.q, at);
            let u: M::Inputs<V> = load(self.at.u, at);
            let b: M::Design<V> = load(self.at.b, at);
            self.kernel.run::<V>(self.mechanism, (&q, &u, &b), at);
        }
    }
}

/// Defines a kernel with its buffers.
macro_rules! kernel {
    ($task:ident<$($life:lifetime),+> { $($field:ident: $kind:ty),* }, $m:ident, ($q:ident, $u:ident, $b:ident), $at:ident, $v:ident => $body:block) => {
        struct $task<$($life),+> {
            $($field: $kind,)*
        }

        impl<$($life,)+ M: Mechanism> Kernel<M> for $task<$($life),+> {
            #[inline(always)]
            fn run<$v: Lanes>(
                &mut self,
                $m: &M,
                ($q, $u, $b): Point<'_, M, $v>,
                $at: usize,
            ) {
                let Self { $($field),* } = self;
                $body
            }
        }
    };
}

/// Calls a kernel in its inlined form, which vectors need, or in the form compiled for callers with a single state.
macro_rules! call {
    ($v:ident: $m:ident.$kernel:ident or $inlined:ident $arguments:tt) => {
        if const { pays::<M>() && $v::WIDTH > 1 } {
            $m.$inlined $arguments
        } else {
            $m.$kernel $arguments
        }
    };
}

kernel! {
    ResidualAndStiffnessTask<'a> { residual: &'a mut [Batch], stiffness: &'a mut [Batch] },
    m, (q, u, b), at, V => {
        let found = call!(V: m.residual_and_stiffness or residual_and_stiffness_inlined(q, u, b));
        store(found.0.as_ref(), residual, at);
        store_rows(found.1.as_ref(), stiffness, at);
    }
}
kernel! {
    LinearTask<'a, 'b> { linear: &'a mut BatchLinear<'b> },
    m, (q, u, b), at, V => {
        let found = call!(V: m.linear or linear_inlined(q, u, b));
        store_linears::<V, M>(&[found], linear, at);
    }
}
kernel! {
    PartsAndLinear<'a, 'b, 'c> { parts: &'a mut BatchParts<'b>, linear: &'a mut BatchLinear<'c> },
    m, (q, u, b), at, V => {
        let found = call!(V: m.residual_parts or residual_parts_inlined(q, u, b));
        store(found.inertia.as_ref(), parts.inertia, at);
        store(found.applied.as_ref(), parts.applied, at);
        let found = call!(V: m.linear or linear_inlined(q, u, b));
        store_linears::<V, M>(&[found], linear, at);
    }
}
kernel! {
    Partials<'a, 'b> { matrices: &'a mut BatchPartials<'b>, residual: [&'a mut [Batch]; 2] },
    m, (q, u, b), at, V => {
        let found = call!(V: m.linear_partials or linear_partials_inlined(q, u, b));
        store_linears::<V, M>(found.by_coordinate.as_ref(), &mut matrices.by_coordinate, at);
        store_linears::<V, M>(found.by_input.as_ref(), &mut matrices.by_input, at);
        store_linears::<V, M>(found.by_design.as_ref(), &mut matrices.by_design, at);
        let found = call!(V: m.residual_partials or residual_partials_inlined(q, u, b));
        store_rows(found.0.as_ref(), residual[0], at);
        store_rows(found.1.as_ref(), residual[1], at);
    }
}
kernel! {
    ModeGradientTask<'a, 'b> { phi: &'a [Batch], lambda: &'a Batch, gradient: &'a mut BatchGradient<'b> },
    m, (q, u, b), at, V => {
        let found = call!(V: m.mode_gradient or mode_gradient_inlined(q, u, b, &load(phi, at), V::load(lambda, at)));
        store_gradient::<V, M>(&found, gradient, at);
    }
}
kernel! {
    ResidualGradientTask<'a, 'b> { w: &'a [Batch], gradient: &'a mut BatchGradient<'b> },
    m, (q, u, b), at, V => {
        let found = call!(V: m.residual_gradient or residual_gradient_inlined(q, u, b, &load(w, at)));
        store_gradient::<V, M>(&found, gradient, at);
    }
}

kernel! {
    PencilGradient<'a, 'b> { factors: &'a [&'a [Batch]], gradient: BatchGradient<'b> },
    m, (q, u, b), at, V => {
        let [left, acceleration, velocity, position] = [0, 1, 2, 3].map(#[inline(always)] |k| load(factors[k], at));
        let (l, x) = (&left, (&acceleration, &velocity, &position));
        let found = if const { V::WIDTH > 1 } {
            m.pencil_gradient_inlined(q, u, b, l, x.0, x.1, x.2)
        } else {
            m.pencil_gradient(q, u, b, l, x.0, x.1, x.2)
        };
        store_gradient::<V, M>(&found, gradient, at);
    }
}
kernel! {
    ForcedGradient<'a, 'b> { factors: &'a [&'a [Batch]], gradient: BatchGradient<'b> },
    m, (q, u, b), at, V => {
        let [acceleration, velocity, position, cosine, sine] =
            [1, 2, 3, 5, 6].map(#[inline(always)] |k| load(factors[k], at));
        let [output, direct_cosine, direct_sine] = [0, 7, 8].map(#[inline(always)] |k| load(factors[k], at));
        let [share, frequency] = [4, 9].map(#[inline(always)] |k| load(factors[k], at));
        let (a, v, x) = (&acceleration, &velocity, &position);
        let (c, s, dc, ds) = (&cosine, &sine, &direct_cosine, &direct_sine);
        let found = if const { V::WIDTH > 1 } {
            m.forced_gradient_inlined(q, u, b, &output, a, v, x, &share, c, s, dc, ds, &frequency)
        } else {
            m.forced_gradient(q, u, b, &output, a, v, x, &share, c, s, dc, ds, &frequency)
        };
        store_gradient::<V, M>(&found, gradient, at);
    }
}

/// [`Kernels::evaluate_batch`](super::Kernels::evaluate_batch) of a compiled mechanism: in vectors the two gradients that
/// forced vibration takes by the dozen, lane by lane everything else.
pub(super) fn evaluate_batch<M: Mechanism>(
    mechanism: &M,
    kernel: super::Kernel,
    arguments: &[&[Batch]],
    results: &mut [&mut [Batch]],
) {
    if const { forced_in_vectors::<M>() }
        && let [coordinates, inputs, design] = &mut *results
    {
        let [q, u, b] = [arguments[0], arguments[1], arguments[2]];
        let (at, factors) = (BatchPoint { q, u, b }, &arguments[3..]);
        let gradient = BatchGradient { coordinates, inputs, design };
        let instructions = Instructions::best();
        match kernel {
            super::Kernel::PencilGradient => {
                return instructions.run(Call { mechanism, at: &at, kernel: PencilGradient { factors, gradient } });
            }
            super::Kernel::ForcedGradient => {
                return instructions.run(Call { mechanism, at: &at, kernel: ForcedGradient { factors, gradient } });
            }
            _ => {}
        }
    }
    lane_by_lane(arguments, results, |arguments, results| {
        mechanism.evaluate(kernel, arguments, results);
    });
}

/// Operations up to which rustc compiles a kernel for each kind of vector in no time.
const SHORT: usize = 2000;

const fn forced_in_vectors<M: Mechanism>() -> bool {
    let description = const { &M::DESCRIPTION };
    M::Excitations::<f64>::LEN > 0
        && is_short(description, "pencil_gradient")
        && is_short(description, "forced_gradient")
}

const fn is_short(description: &Description, kernel: &str) -> bool {
    match description.static_kernel(kernel) {
        Some(kernel) => kernel.operations <= SHORT,
        None => false,
    }
}

/// Evaluates a kernel of plain numbers for each lane.
pub(super) fn lane_by_lane(
    arguments: &[&[Batch]],
    results: &mut [&mut [Batch]],
    mut evaluate: impl FnMut(&[&[f64]], &mut [&mut [f64]]),
) {
    for lane in 0..WIDTH {
        let lane_of = |list: &&[Batch]| list.iter().map(|value| value.0[lane]).collect();
        let lists: Vec<Vec<f64>> = arguments.iter().map(lane_of).collect();
        let mut values: Vec<Vec<f64>> = results.iter().map(|to| vec![0.0; to.len()]).collect();
        let lists: Vec<&[f64]> = lists.iter().map(Vec::as_slice).collect();
        let mut to: Vec<&mut [f64]> = values.iter_mut().map(Vec::as_mut_slice).collect();
        evaluate(&lists, &mut to);
        for (to, numbers) in results.iter_mut().zip(&values) {
            for (to, value) in to.iter_mut().zip(numbers) {
                to.0[lane] = *value;
            }
        }
    }
}

/// Whether vectors pay. For larger mechanisms rustc takes minutes per vector type, and the solvers take other
/// mechanisms one state at a time.
const fn pays<M: Mechanism>() -> bool {
    let description = const { &M::DESCRIPTION };
    let conservative = !damped(description) && description.symmetric_stiffness;
    M::Coordinates::<f64>::LEN <= 16 && conservative
}

/// Runs a kernel. If vectors do not pay, or the compiler did not generate the kernel and so there is no inlined form,
/// it is called state by state.
#[inline]
fn run<M: Mechanism>(
    mechanism: &M,
    instructions: Instructions,
    at: BatchPoint<'_>,
    generated: bool,
    kernel: impl Kernel<M>,
) {
    let call = Call { mechanism, at: &at, kernel };
    if const { pays::<M>() } && generated {
        instructions.run(call);
    } else {
        call.run::<f64>();
    }
}

impl<M: Mechanism> BatchKernels for M {
    fn evaluate_states(
        &self,
        instructions: Instructions,
        kernel: super::Kernel,
        arguments: &[&[Batch]],
        results: &mut [&mut [Batch]],
    ) {
        use super::Kernel::{Linear, ModeGradient, ResidualAndStiffness, ResidualGradient};
        let at = BatchPoint { q: arguments[0], u: arguments[1], b: arguments[2] };
        match (kernel, results) {
            (ResidualAndStiffness, [residual, stiffness]) => {
                let generated = const { generated(const { &M::DESCRIPTION }, "residual_and_stiffness") };
                run(self, instructions, at, generated, ResidualAndStiffnessTask { residual, stiffness });
            }
            (Linear, [mass, damping, stiffness]) => {
                let generated = const { generated(const { &M::DESCRIPTION }, "linear") };
                let linear = &mut BatchLinear { mass, damping, stiffness };
                run(self, instructions, at, generated, LinearTask { linear });
            }
            (ModeGradient, [coordinates, inputs, design]) => {
                let generated = const { generated(const { &M::DESCRIPTION }, "mode_gradient") };
                let gradient = &mut BatchGradient { coordinates, inputs, design };
                let (phi, lambda) = (arguments[3], &arguments[4][0]);
                run(self, instructions, at, generated, ModeGradientTask { phi, lambda, gradient });
            }
            (ResidualGradient, [coordinates, inputs, design]) => {
                let generated = const { generated(const { &M::DESCRIPTION }, "residual_gradient") };
                let gradient = &mut BatchGradient { coordinates, inputs, design };
                run(self, instructions, at, generated, ResidualGradientTask { w: arguments[3], gradient });
            }
            (_, results) => lane_by_lane(arguments, results, |arguments, results| {
                self.evaluate(kernel, arguments, results);
            }),
        }
    }

    fn parts_and_linear_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        parts: &mut BatchParts<'_>,
        linear: &mut BatchLinear<'_>,
    ) {
        let generated = const { generated(const { &M::DESCRIPTION }, "linear") };
        run(self, instructions, at, generated, PartsAndLinear { parts, linear });
    }

    fn partials_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        matrices: &mut BatchPartials<'_>,
        residual: [&mut [Batch]; 2],
    ) {
        let generated = const { generated(const { &M::DESCRIPTION }, "linear_partials") };
        run(self, instructions, at, generated, Partials { matrices, residual });
    }
}

const fn damped(description: &Description) -> bool {
    !matches!(description.damping, DampingKind::Zero)
}

/// Whether the compiler generated this kernel.
const fn generated(description: &Description, kernel: &str) -> bool {
    description.static_kernel(kernel).is_some()
}
