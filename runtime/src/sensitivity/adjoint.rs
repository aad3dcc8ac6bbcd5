//! Derivatives of all modes by all variables through the adjoint. For undamped modes
//! `dlambda/db = da/db - (dg/db)^T w`, `a = phi^T (Khat - lambda Mhat) phi`; for general ones the same with
//! `a = psi^T (s^2 Mhat + s Chat + Khat) phi`, divided by `-psi^T (2 s Mhat + Chat) phi`. In both `Khat^T w = da/dq`.

use super::gradients::{Source, of_general, of_undamped};
use super::pencil::{ComplexGradient, Form, form_gradient};
use super::{Method, ModeSensitivity, Sensitivities, assemble, check_state, redundancy};
use crate::algebra::{Cholesky, Lu, Matrix, Vector, add_to, dot_complex};
use crate::kernels::{Gradient, Kernels, LinearPartials, ResidualPartials};
use crate::modes::{Family, pencil_slope_times};
use crate::{Complex, Equilibrium, Error, Mode, Modes};

/// Total derivatives of every mode by every input and design variable.
///
/// # Errors
/// [`Error::CriticalState`] when `Khat` is singular, [`Error::ClosesHereOnly`] where redundant constraints contradict each
/// other as soon as a variable changes, [`Error::OutsideDomain`] when a derivative is not finite.
pub fn sensitivities(
    mechanism: &dyn Kernels,
    at: &Equilibrium,
    modes: &Modes,
) -> Result<Sensitivities, Error> {
    check_state(mechanism, at)?;
    redundancy::check(mechanism, at)?;
    let mut adjoint = Adjoint::new(mechanism, at, modes.family, Factors::new(at)?);
    assemble(at, modes, Method::Adjoint, |own, mode| {
        adjoint.set(own, mode)
    })
}

/// What all modes share, and room for what one has by itself.
struct Adjoint<'a> {
    mechanism: &'a dyn Kernels,
    at: &'a Equilibrium,
    family: Family,
    factors: Factors,
    /// Explicit partials of the matrices, where gradients of forms come from them.
    matrices: Option<LinearPartials>,
    /// Explicit partials of the residual, where its gradients come from them.
    residual: Option<ResidualPartials>,
    phi: Vector,
    /// Of the form; of undamped modes there is a real part alone.
    direct: ComplexGradient,
    adjoint: Vector,
    /// What the motion of the equilibrium changes.
    shift: Gradient,
}

impl<'a> Adjoint<'a> {
    #[inline(always)]
    fn new(
        mechanism: &'a dyn Kernels,
        at: &'a Equilibrium,
        family: Family,
        factors: Factors,
    ) -> Self {
        let sizes = mechanism.sizes();
        let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
        let (matrices, residual) = match Source::cheapest(&at.description, family) {
            Source::Partials => {
                let (matrices, residual) = mechanism.partials(q, u, b);
                (Some(matrices), Some(residual))
            }
            Source::ResidualPartials => (None, Some(mechanism.residual_partials(q, u, b))),
            Source::Reverse => (None, None),
        };
        let imaginary = match family {
            Family::Undamped => Gradient::default(),
            Family::General => Gradient::zeros(sizes),
        };
        Self {
            mechanism,
            at,
            family,
            factors,
            matrices,
            residual,
            phi: Vector::zeros(sizes.coordinates),
            direct: [Gradient::zeros(sizes), imaginary],
            adjoint: Vector::zeros(sizes.coordinates),
            shift: Gradient::zeros(sizes),
        }
    }

    fn set(&mut self, own: &mut ModeSensitivity, mode: &Mode) {
        match self.family {
            Family::Undamped => {
                self.undamped_gradient(mode);
                self.total(0);
                let [lambda, _] = &self.direct;
                let (inputs, design) = (lambda.inputs.iter(), lambda.design.iter());
                own.set_undamped(mode, inputs.copied(), design.copied());
            }
            Family::General => {
                self.general_gradient(mode);
                self.total(0);
                self.total(1);
                let [re, im] = &self.direct;
                let scale = -normaliser(self.at, mode);
                let slope = |(&re, &im): (&f64, &f64)| Complex { re, im } / scale;
                let by_input = re.inputs.iter().zip(&im.inputs).map(slope);
                let by_design = re.design.iter().zip(&im.design).map(slope);
                own.set_general(mode, by_input, by_design);
            }
        }
    }

    fn undamped_gradient(&mut self, mode: &Mode) {
        for (phi, value) in self.phi.iter_mut().zip(&mode.shape) {
            *phi = value.re;
        }
        let (phi, lambda, gradient) = (&self.phi, mode.lambda, &mut self.direct[0]);
        match &self.matrices {
            Some(matrices) => {
                let symmetric = self.at.description.symmetric_stiffness;
                of_undamped(matrices, phi, lambda, symmetric, gradient);
            }
            None => {
                let (q, u, b) = (&self.at.coordinates, &self.at.inputs, &self.at.design);
                self.mechanism
                    .mode_gradient_into(q, u, b, phi, lambda, gradient);
            }
        }
    }

    fn general_gradient(&mut self, mode: &Mode) {
        match &self.matrices {
            Some(matrices) => of_general(matrices, mode, &mut self.direct),
            None => {
                let form = Form::of(&mode.left, mode.s, &mode.shape);
                let room = &mut self.shift;
                form_gradient(self.mechanism, self.at, &form, room, &mut self.direct);
            }
        }
    }

    /// Takes what the motion of the equilibrium changes into a part of the gradient.
    fn total(&mut self, part: usize) {
        let direct = &mut self.direct[part];
        self.adjoint.copy_from_slice(&direct.coordinates);
        self.factors.solve(&mut self.adjoint);
        match &self.residual {
            Some((by_input, by_design)) => {
                combine(&self.adjoint, by_input, &mut self.shift.inputs);
                combine(&self.adjoint, by_design, &mut self.shift.design);
            }
            None => {
                let (q, u, b) = (&self.at.coordinates, &self.at.inputs, &self.at.design);
                self.mechanism
                    .residual_gradient_into(q, u, b, &self.adjoint, &mut self.shift);
            }
        }
        add_to(&mut direct.inputs, -1.0, &self.shift.inputs);
        add_to(&mut direct.design, -1.0, &self.shift.design);
    }
}

/// Factors of the transposed `Khat`.
enum Factors {
    Definite(Cholesky),
    General(Lu<f64>),
}

impl Factors {
    fn new(at: &Equilibrium) -> Result<Self, Error> {
        let stiffness = &at.linear.stiffness;
        if at.description.symmetric_stiffness
            && let Ok(factors) = Cholesky::new(stiffness)
        {
            return Ok(Self::Definite(factors));
        }
        let factors = Lu::new(&stiffness.transpose());
        factors.map(Self::General).ok_or(Error::CriticalState)
    }

    /// Writes the solution over the right-hand side.
    fn solve(&self, x: &mut Vector) {
        match self {
            Self::Definite(factors) => factors.solve_in_place(x),
            Self::General(factors) => *x = factors.solve(x),
        }
    }
}

/// `sum = w^T partials`.
fn combine(w: &[f64], partials: &Matrix, sum: &mut [f64]) {
    sum.fill(0.0);
    let rows = partials.as_flattened().chunks_exact(sum.len().max(1));
    for (w, row) in w.iter().zip(rows) {
        add_to(sum, *w, row);
    }
}

/// `psi^T (2 s Mhat + Chat) phi`; zero where the eigenvalue has merged with another.
pub(crate) fn normaliser(at: &Equilibrium, mode: &Mode) -> Complex {
    dot_complex(
        &mode.left,
        &pencil_slope_times(&at.linear, mode.s, &mode.shape),
    )
}
