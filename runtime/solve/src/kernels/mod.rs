//! The kernels of a mechanism as a table over slices, as the solvers see them. A compiled mechanism provides them
//! through its contract, a mechanism read at run time through the interpreter.
//!
//! Arguments are those of [`Mechanism`](eigentol_contract::Mechanism): `q` the unknowns, `u` the inputs, `b` the design
//! variables, SI. A method named `.._into` overwrites every entry of buffers that have the sizes of the mechanism; the
//! one without the suffix allocates them.
//!
//! # Panics
//! Kernels may panic on a slice whose length does not match the mechanism: this is a bug in the caller. Values passed
//! by users are checked first.
//!
//! # The contract has two layers
//!
//! `Mechanism` is what generated code implements: plain arrays, any scalar, no allocation, no standard library. Its
//! sizes are associated array types (`Coordinates<T> = [T; 2]`), so one type names a mechanism. The solvers see only
//! `Kernels`, an object-safe table over slices, which every `Mechanism` gets from one blanket implementation
//! (`kernels/compiled.rs`) and an interpreted mechanism by interpretation. Five tables let a program compile only the
//! kernels its questions need: `Kernels` for one state, `DirectionalKernels` in dual numbers for second derivatives,
//! `BatchKernels` at eight states at once, `MotionKernels` for the nonlinear motion, `PictureKernels` for pictures. What a
//! table has is compiled with it, and rustc takes three times as long for vectors: at eight states, kernels that no solver
//! needs are types, of which a program compiles those that it names ([`lanes`]); tables take theirs from there.
//! What a kernel takes and returns is a row of `kernels/table.rs`; each table evaluates its rows by one method, from which
//! the typed ones follow.
//! `Study<M>` and the typed handles are a thin generic shell; everything behind it is compiled once, in the library.

mod batch;
mod compiled;
mod costs;
mod curvature;
mod deviating_inputs;
mod directional;
mod interval;
pub mod lanes;
mod motion;
mod partial_matrices;
mod picture;
mod summary;
mod table;

#[doc(hidden)]
pub use batch::lane_by_lane;
pub use batch::{BatchGradient, BatchKernels, BatchLinear, BatchPartials, BatchParts, BatchPoint};
pub use costs::Costs;
pub use curvature::CurvatureKernels;
pub use deviating_inputs::DeviatingInputs;
pub use directional::DirectionalKernels;
pub use interval::Interval;
pub use motion::MotionKernels;
pub use partial_matrices::PartialMatrices;
pub(crate) use partial_matrices::{entries_of, parts};
pub use picture::PictureKernels;
pub use summary::SummaryKernels;
pub use table::{Curvature, Directional, Extent, Kernel, MotionKernel, Shape};

use crate::algebra::{Matrix, Vector};
use crate::mechanism::{self, Description, PoseMargin, Shared, Violation};
use crate::scalar::{Batch, Dual};

pub use eigentol_numerics::linear::Linear;
pub use mechanism::Sizes;

/// The residual in two parts.
pub type RestParts<T = f64> = mechanism::RestParts<Vector<T>>;
/// Derivatives of one number.
pub type Gradient<T = f64> = mechanism::Gradient<Vector<T>>;
/// Derivatives of the three matrices.
pub type LinearPartials<T = f64> = mechanism::LinearPartials<Vec<Linear<T>>>;
/// Derivatives of the residual with respect to every input and every design variable, one row per unknown.
pub type ResidualPartials<T = f64> = (Matrix<T>, Matrix<T>);

/// Zeros.
#[inline]
pub(crate) fn residual_partials_zeros<T: Copy + Default>(sizes: Sizes) -> ResidualPartials<T> {
    let rows = sizes.coordinates;
    (Matrix::zeros(rows, sizes.inputs), Matrix::zeros(rows, sizes.design))
}

/// Zeros.
fn output_partials_zeros(sizes: Sizes) -> [Matrix; 3] {
    [sizes.coordinates, sizes.inputs, sizes.design].map(|columns| Matrix::zeros(sizes.outputs, columns))
}

/// The three matrices as results.
#[inline]
pub fn linear_results<T>(linear: &mut Linear<T>) -> [&mut [T]; 3] {
    [linear.mass.as_flattened_mut(), linear.damping.as_flattened_mut(), linear.stiffness.as_flattened_mut()]
}

/// A gradient as results.
#[inline]
pub fn gradient_results<T>(gradient: &mut Gradient<T>) -> [&mut [T]; 3] {
    [&mut gradient.coordinates, &mut gradient.inputs, &mut gradient.design]
}

/// Matrices as results.
#[inline]
fn matrix_results<const N: usize>(matrices: [&mut Matrix; N]) -> [&mut [f64]; N] {
    matrices.map(Matrix::as_flattened_mut)
}

/// A number with two first derivatives and the mixed second one.
pub type Second = Dual<Dual<f64>>;

/// The kernels needed at any single state.
pub trait Kernels: Sync {
    /// Names, units, nominal values and what the compiler proved.
    fn description(&self) -> Shared<Description>;

    /// Numbers of unknowns, inputs, design variables and outputs.
    fn sizes(&self) -> Sizes;

    /// The input of which a design variable is the deviation ([`DeviatingInputs`]).
    ///
    /// Anything that follows that input, as an engine order follows the speed, follows the deviation too.
    fn input_of_deviation(&self, _design: usize) -> Option<usize> {
        None
    }

    /// Costs of the kernels from which gradients can be computed.
    fn costs(&self) -> Costs {
        Costs::of(&self.description())
    }

    /// Evaluates a kernel: arguments and results are those of [`Kernel::arguments`] and [`Kernel::results`], and every
    /// entry of the results is overwritten.
    fn evaluate(&self, kernel: Kernel, arguments: &[&[f64]], results: &mut [&mut [f64]]);

    /// [`Self::evaluate`] with [`WIDTH`](crate::scalar::WIDTH) sets of arguments, one in each lane; the bits of a result
    /// are those of its lane alone.
    fn evaluate_batch(&self, kernel: Kernel, arguments: &[&[Batch]], results: &mut [&mut [Batch]]) {
        batch::lane_by_lane(arguments, results, |arguments, results| {
            self.evaluate(kernel, arguments, results);
        });
    }

    /// [`Mechanism::residual`](eigentol_contract::Mechanism::residual).
    fn residual_into(&self, q: &[f64], u: &[f64], b: &[f64], residual: &mut [f64]) {
        self.evaluate(Kernel::Residual, &[q, u, b], &mut [residual]);
    }

    /// [`Mechanism::residual_parts`](eigentol_contract::Mechanism::residual_parts).
    fn residual_parts_into(&self, q: &[f64], u: &[f64], b: &[f64], parts: &mut RestParts) {
        let results = &mut [&mut parts.inertia[..], &mut parts.applied];
        self.evaluate(Kernel::ResidualParts, &[q, u, b], results);
    }

    /// [`Mechanism::residual_and_stiffness`](eigentol_contract::Mechanism::residual_and_stiffness), with the matrix row
    /// by row.
    fn residual_and_stiffness_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        residual: &mut [f64],
        stiffness: &mut [f64],
    ) {
        let results = &mut [residual, stiffness];
        self.evaluate(Kernel::ResidualAndStiffness, &[q, u, b], results);
    }

    /// [`Mechanism::linear`](eigentol_contract::Mechanism::linear).
    fn linear_into(&self, q: &[f64], u: &[f64], b: &[f64], linear: &mut Linear) {
        self.evaluate(Kernel::Linear, &[q, u, b], &mut linear_results(linear));
    }

    /// [`Kernels::residual_parts_into`] and [`Kernels::linear_into`]; common terms are computed once where that pays.
    fn parts_and_linear_into(&self, q: &[f64], u: &[f64], b: &[f64], parts: &mut RestParts, linear: &mut Linear) {
        self.residual_parts_into(q, u, b, parts);
        self.linear_into(q, u, b, linear);
    }

    /// [`Mechanism::residual_partials`](eigentol_contract::Mechanism::residual_partials).
    fn residual_partials_into(&self, q: &[f64], u: &[f64], b: &[f64], partials: &mut ResidualPartials) {
        let results = &mut matrix_results([&mut partials.0, &mut partials.1]);
        self.evaluate(Kernel::ResidualPartials, &[q, u, b], results);
    }

    /// [`Mechanism::linear_partials`](eigentol_contract::Mechanism::linear_partials).
    fn linear_partials_into(&self, q: &[f64], u: &[f64], b: &[f64], partials: &mut PartialMatrices);

    /// Partial derivatives of the matrices and of the residual; common terms are computed once where that pays.
    fn partials_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        matrices: &mut PartialMatrices,
        residual: &mut ResidualPartials,
    ) {
        self.linear_partials_into(q, u, b, matrices);
        self.residual_partials_into(q, u, b, residual);
    }

    /// [`Mechanism::mode_gradient`](eigentol_contract::Mechanism::mode_gradient).
    fn mode_gradient_into(&self, q: &[f64], u: &[f64], b: &[f64], phi: &[f64], lambda: f64, gradient: &mut Gradient) {
        let arguments = &[q, u, b, phi, &[lambda]];
        self.evaluate(Kernel::ModeGradient, arguments, &mut gradient_results(gradient));
    }

    /// [`Mechanism::pencil_gradient`](eigentol_contract::Mechanism::pencil_gradient).
    fn pencil_gradient_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        [left, acceleration, velocity, position]: [&[f64]; 4],
        gradient: &mut Gradient,
    ) {
        let arguments = &[q, u, b, left, acceleration, velocity, position];
        let results = &mut gradient_results(gradient);
        self.evaluate(Kernel::PencilGradient, arguments, results);
    }

    /// [`pencil_gradient_into`](Self::pencil_gradient_into) for several sets of vectors.
    fn pencil_gradients_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        vectors: &[[&[f64]; 4]],
        gradients: &mut [&mut Gradient],
    ) {
        for (vectors, gradient) in vectors.iter().zip(gradients) {
            self.pencil_gradient_into(q, u, b, *vectors, gradient);
        }
    }

    /// [`Mechanism::residual_gradient`](eigentol_contract::Mechanism::residual_gradient).
    fn residual_gradient_into(&self, q: &[f64], u: &[f64], b: &[f64], w: &[f64], gradient: &mut Gradient) {
        let results = &mut gradient_results(gradient);
        self.evaluate(Kernel::ResidualGradient, &[q, u, b, w], results);
    }

    /// [`Mechanism::whirl`](eigentol_contract::Mechanism::whirl).
    fn whirl(&self, q: &[f64], u: &[f64], b: &[f64], real: &[f64], imaginary: &[f64]) -> [f64; 7] {
        let mut whirl = [0.0; 7];
        let arguments = &[q, u, b, real, imaginary];
        self.evaluate(Kernel::Whirl, arguments, &mut [&mut whirl]);
        whirl
    }

    /// [`Mechanism::violation`](eigentol_contract::Mechanism::violation).
    fn violation(&self, u: &[f64], b: &[f64]) -> Option<Violation<f64>>;

    /// Whether certainly no design within `reach` of `b`, each variable independently, has a violation. `false` means
    /// unknown.
    fn possible_within(&self, u: &[f64], b: &[f64], reach: &[f64]) -> bool;

    /// [`Mechanism::pose_margin`](eigentol_contract::Mechanism::pose_margin).
    fn pose_margin(&self, q: &[f64], u: &[f64], b: &[f64]) -> Option<PoseMargin<f64>>;

    /// [`Mechanism::held_values`](eigentol_contract::Mechanism::held_values) with first and second derivatives.
    fn held_values_into(&self, u: &[Second], b: &[Second], values: &mut [Second]);

    /// [`Mechanism::spans`](eigentol_contract::Mechanism::spans) with first and second derivatives.
    fn spans_into(&self, u: &[Second], b: &[Second], numbers: &mut [Second]);

    /// [`Mechanism::outputs`](eigentol_contract::Mechanism::outputs).
    fn outputs_into(&self, q: &[f64], u: &[f64], b: &[f64], outputs: &mut [f64]) {
        self.evaluate(Kernel::Outputs, &[q, u, b], &mut [outputs]);
    }

    /// [`Mechanism::output_partials`](eigentol_contract::Mechanism::output_partials), with respect to unknowns, inputs
    /// and design variables, one row per output.
    fn output_partials_into(&self, q: &[f64], u: &[f64], b: &[f64], partials: [&mut Matrix; 3]) {
        let results = &mut matrix_results(partials);
        self.evaluate(Kernel::OutputPartials, &[q, u, b], results);
    }
}

impl dyn Kernels + '_ {
    /// The deviation of an input, SI.
    #[doc(hidden)]
    pub fn deviation(&self, input: usize, b: &[f64]) -> f64 {
        let of_input = |(design, _): &(usize, &f64)| self.input_of_deviation(*design) == Some(input);
        b.iter().enumerate().filter(of_input).map(|(_, deviation)| deviation).sum()
    }

    /// Residual at rest.
    pub fn residual(&self, q: &[f64], u: &[f64], b: &[f64]) -> Vector {
        let mut residual = Vector::zeros(q.len());
        self.residual_into(q, u, b, &mut residual);
        residual
    }

    /// Inertia and applied forces at rest.
    pub fn residual_parts(&self, q: &[f64], u: &[f64], b: &[f64]) -> RestParts {
        let mut parts = RestParts::zeros(q.len());
        self.residual_parts_into(q, u, b, &mut parts);
        parts
    }

    /// Residual at rest and `Khat`.
    pub fn residual_and_stiffness(&self, q: &[f64], u: &[f64], b: &[f64]) -> (Vector, Matrix) {
        let n = q.len();
        let (mut residual, mut stiffness) = (Vector::zeros(n), Matrix::zeros(n, n));
        let entries = stiffness.as_flattened_mut();
        self.residual_and_stiffness_into(q, u, b, &mut residual, entries);
        (residual, stiffness)
    }

    /// `Mhat`, `Chat` and `Khat`.
    pub fn linear(&self, q: &[f64], u: &[f64], b: &[f64]) -> Linear {
        let mut linear = Linear::zeros(q.len());
        self.linear_into(q, u, b, &mut linear);
        linear
    }

    /// Inertia, applied forces and the three matrices.
    pub fn parts_and_linear(&self, q: &[f64], u: &[f64], b: &[f64]) -> (RestParts, Linear) {
        let (mut parts, mut linear) = (RestParts::zeros(q.len()), Linear::zeros(q.len()));
        self.parts_and_linear_into(q, u, b, &mut parts, &mut linear);
        (parts, linear)
    }

    /// Derivatives of the residual with respect to inputs and design variables.
    pub fn residual_partials(&self, q: &[f64], u: &[f64], b: &[f64]) -> ResidualPartials {
        let mut partials = residual_partials_zeros(self.sizes());
        self.residual_partials_into(q, u, b, &mut partials);
        partials
    }

    /// Derivatives of the three matrices.
    pub fn linear_partials(&self, q: &[f64], u: &[f64], b: &[f64]) -> LinearPartials {
        let mut partials = PartialMatrices::zeros(self.sizes());
        self.linear_partials_into(q, u, b, &mut partials);
        partials.to_lists()
    }

    /// Derivatives of the three matrices; the derivatives of the residual are written to `residual`.
    pub fn partials(&self, q: &[f64], u: &[f64], b: &[f64], residual: &mut ResidualPartials) -> PartialMatrices {
        let mut matrices = PartialMatrices::zeros(self.sizes());
        self.partials_into(q, u, b, &mut matrices, residual);
        matrices
    }

    /// Gradient of `phi^T (Khat - lambda Mhat) phi`.
    pub fn mode_gradient(&self, q: &[f64], u: &[f64], b: &[f64], phi: &[f64], lambda: f64) -> Gradient {
        let mut gradient = Gradient::zeros(self.sizes());
        self.mode_gradient_into(q, u, b, phi, lambda, &mut gradient);
        gradient
    }

    /// Gradient of `left^T (Mhat acceleration + Chat velocity + Khat position)`.
    pub fn pencil_gradient(&self, q: &[f64], u: &[f64], b: &[f64], vectors: [&[f64]; 4]) -> Gradient {
        let mut gradient = Gradient::zeros(self.sizes());
        self.pencil_gradient_into(q, u, b, vectors, &mut gradient);
        gradient
    }

    /// Gradient of `w^T g`.
    pub fn residual_gradient(&self, q: &[f64], u: &[f64], b: &[f64], w: &[f64]) -> Gradient {
        let mut gradient = Gradient::zeros(self.sizes());
        self.residual_gradient_into(q, u, b, w, &mut gradient);
        gradient
    }

    /// The declared outputs.
    pub fn outputs(&self, q: &[f64], u: &[f64], b: &[f64]) -> Vector {
        let mut outputs = Vector::zeros(self.sizes().outputs);
        self.outputs_into(q, u, b, &mut outputs);
        outputs
    }

    /// Explicit derivatives of the outputs with respect to unknowns, inputs and design variables, one row per output.
    pub fn output_partials(&self, q: &[f64], u: &[f64], b: &[f64]) -> [Matrix; 3] {
        let mut partials = output_partials_zeros(self.sizes());
        self.output_partials_into(q, u, b, partials.each_mut());
        partials
    }
}
