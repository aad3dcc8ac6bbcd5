//! The compiler's own interpreter as [`Kernels`]: runs the program it would emit, without rustc.

use eigentol_compiler::base::diagnostics::Diagnostics;
use eigentol_compiler::compile;
use eigentol_compiler::mechanics::Limits;
use eigentol_compiler::program::Program;
use proc_macro2::TokenStream;

use eigentol_oracle::declaration::declaration;
use eigentol_oracle::kernels::{At, Gradient, Kernels, Pencil};
use eigentol_oracle::model::Model;
use eigentol_oracle::{Linear, LinearPartials};

use eigentol_consistency::interpreter::interpret_along;

/// No limit on explicit partial derivatives.
const EVERYTHING: Limits = Limits::NONE;

/// A compiled model.
pub struct Compiled {
    program: Program,
    inputs: usize,
    design: usize,
}

impl Compiled {
    /// Compiles the declaration of a model.
    ///
    /// # Errors
    /// The compiler's messages, if it refuses the declaration.
    pub fn new(model: &Model) -> Result<Self, Diagnostics> {
        let tokens: TokenStream = declaration(model).parse().expect("the declaration has tokens");
        let (inputs, design) = (model.inputs.len(), model.design.len());
        Ok(Self { program: compile(tokens, EVERYTHING)?.program, inputs, design })
    }

    /// One vector per returned array.
    fn evaluate<const ARRAYS: usize>(&self, kernel: &str, arguments: &[&[f64]]) -> [Vec<f64>; ARRAYS] {
        let results = self.program.evaluate(kernel, arguments);
        arrays(kernel, results.expect("a kernel of the contract"))
    }

    /// Derivatives along a direction, computed as in the runtime.
    fn along<const ARRAYS: usize>(
        &self,
        kernel: &str,
        arguments: &[&[f64]],
        direction: &[&[f64]],
    ) -> [Vec<f64>; ARRAYS] {
        let found = self.program.kernel(kernel);
        let found = found.expect("a kernel of the contract");
        arrays(kernel, interpret_along(found, arguments, direction))
    }
}

/// Converts to a fixed number of arrays.
fn arrays<const ARRAYS: usize>(kernel: &str, arrays: Vec<Vec<f64>>) -> [Vec<f64>; ARRAYS] {
    let count = arrays.len();
    arrays.try_into().unwrap_or_else(|_| panic!("{kernel} returns {ARRAYS} arrays, not {count}"))
}

fn linear([mass, damping, stiffness]: [Vec<f64>; 3]) -> Linear<f64> {
    Linear { mass, damping, stiffness }
}

/// Splits three arrays into the matrices of `count` derivatives; the index of differentiation is the outermost.
fn derivatives(count: usize, n: usize, arrays: [Vec<f64>; 3]) -> Vec<Linear<f64>> {
    for array in &arrays {
        assert_eq!(array.len(), count * n * n, "one n x n matrix per derivative");
    }
    let slice = |array: &Vec<f64>, k: usize| array[k * n * n..(k + 1) * n * n].to_vec();
    (0..count).map(|k| linear(arrays.each_ref().map(|array| slice(array, k)))).collect()
}

impl Kernels for Compiled {
    fn residual(&self, [q, u, b]: At) -> Vec<f64> {
        let [residual] = self.evaluate("residual", &[q, u, b]);
        residual
    }

    fn residual_parts(&self, [q, u, b]: At) -> [Vec<f64>; 2] {
        self.evaluate("residual_parts", &[q, u, b])
    }

    fn motion_residual(&self, acceleration: &[f64], velocity: &[f64], [q, u, b]: At) -> Vec<f64> {
        let [residual] = self.evaluate("motion_residual", &[acceleration, velocity, q, u, b]);
        residual
    }

    fn motion(&self, velocity: &[f64], [q, u, b]: At) -> [Vec<f64>; 2] {
        self.evaluate("motion", &[velocity, q, u, b])
    }

    fn residual_and_stiffness(&self, [q, u, b]: At) -> [Vec<f64>; 2] {
        self.evaluate("residual_and_stiffness", &[q, u, b])
    }

    fn linear(&self, [q, u, b]: At) -> Linear<f64> {
        linear(self.evaluate("linear", &[q, u, b]))
    }

    fn residual_partials(&self, [q, u, b]: At) -> [Vec<f64>; 2] {
        self.evaluate("residual_partials", &[q, u, b])
    }

    fn linear_partials(&self, [q, u, b]: At) -> LinearPartials {
        let [m, c, k, mu, cu, ku, mb, cb, kb] = self.evaluate("linear_partials", &[q, u, b]);
        LinearPartials {
            by_coordinate: derivatives(q.len(), q.len(), [m, c, k]),
            by_input: derivatives(self.inputs, q.len(), [mu, cu, ku]),
            by_design: derivatives(self.design, q.len(), [mb, cb, kb]),
        }
    }

    fn linear_along(&self, [q, u, b]: At, [dq, du, db]: At) -> Linear<f64> {
        linear(self.along("linear", &[q, u, b], &[dq, du, db]))
    }

    fn mode_gradient(&self, [q, u, b]: At, phi: &[f64], lambda: f64) -> Gradient {
        self.evaluate("mode_gradient", &[q, u, b, phi, &[lambda]])
    }

    fn pencil_gradient(&self, at: At, pencil: Pencil) -> Gradient {
        self.evaluate("pencil_gradient", &[&at[..], &pencil].concat())
    }

    fn residual_gradient(&self, [q, u, b]: At, w: &[f64]) -> Gradient {
        self.evaluate("residual_gradient", &[q, u, b, w])
    }

    fn whirl(&self, [q, u, b]: At, real: &[f64], imaginary: &[f64]) -> Vec<f64> {
        // As in the runtime: there is no such kernel where nothing rotates.
        if self.program.kernel("whirl").is_none() {
            return vec![0.0; 7];
        }
        let [whirl] = self.evaluate("whirl", &[q, u, b, real, imaginary]);
        whirl
    }

    fn mode_gradient_along(
        &self,
        [q, u, b]: At,
        (phi, lambda): (&[f64], f64),
        [dq, du, db]: At,
        (dphi, dlambda): (&[f64], f64),
    ) -> Gradient {
        let (lambda, dlambda) = ([lambda], [dlambda]);
        let direction = [dq, du, db, dphi, &dlambda];
        self.along("mode_gradient", &[q, u, b, phi, &lambda], &direction)
    }

    fn pencil_gradient_along(&self, at: At, pencil: Pencil, along: At, pencil_along: Pencil) -> Gradient {
        let [arguments, direction] =
            [(at, pencil), (along, pencil_along)].map(|(at, pencil)| [&at[..], &pencil].concat());
        self.along("pencil_gradient", &arguments, &direction)
    }

    fn residual_gradient_along(&self, [q, u, b]: At, w: &[f64], [dq, du, db]: At, dw: &[f64]) -> Gradient {
        self.along("residual_gradient", &[q, u, b, w], &[dq, du, db, dw])
    }
}
