//! Derivatives of all modes with respect to all variables by the adjoint method.
//!
//! For undamped modes `dlambda/db = da/db - (dg/db)^T w`, `a = phi^T (Khat - lambda Mhat) phi`. For general modes the
//! same holds with `a = psi^T (s^2 Mhat + s Chat + Khat) phi`, divided by `-psi^T (2 s Mhat + Chat) phi`. In both cases
//! `Khat^T w = da/dq`.

use super::gradients::{Form, Source, of_general};
use super::pencil::{BilinearForm, ComplexGradient, form_gradient};
use super::{Method, ModeSensitivity, Sensitivities, assemble_into, check_state, free_directions, redundancy};
use crate::algebra::{Cholesky, Lu, Matrix, Vector, add_to, dot_complex, for_size};
use crate::kernels::{Gradient, Kernels, PartialMatrices, ResidualPartials, Sizes, residual_partials_zeros};
use crate::modes::{Family, pencil_slope_times};
use crate::shafts::{FormGradient, ShaftSlopes};
use crate::{Complex, Equilibrium, Error, Mode, Modes};

/// Total derivatives of every mode with respect to every input and design variable.
///
/// # Errors
/// [`Error::CriticalState`] if `Khat` is singular, [`Error::ClosesHereOnly`] if redundant constraints contradict each
/// other as soon as a variable changes, [`Error::OutsideDomain`] if a derivative is not finite.
pub fn sensitivities(mechanism: &dyn Kernels, at: &Equilibrium, modes: &Modes) -> Result<Sensitivities, Error> {
    let mut sensitivities = Sensitivities::blank(at, modes, Method::Adjoint);
    Adjoint::new(mechanism, modes.family).sensitivities_into(at, modes, &mut sensitivities)?;
    Ok(sensitivities)
}

/// Computes [`sensitivities`] for a sequence of states.
#[doc(hidden)]
pub struct Adjoint<'a> {
    mechanism: &'a dyn Kernels,
    source: Source,
    /// Explicit partials, if gradients are computed from them; sized for no variables otherwise.
    matrices: PartialMatrices,
    residual: ResidualPartials,
    factors: Factors,
}

impl<'a> Adjoint<'a> {
    #[doc(hidden)]
    pub fn new(mechanism: &'a dyn Kernels, family: Family) -> Self {
        let sizes = mechanism.sizes();
        let source = Source::cheapest(mechanism.costs(), sizes, family);
        let where_used = |used| if used { sizes } else { Sizes::default() };
        Self {
            mechanism,
            source,
            matrices: PartialMatrices::zeros(where_used(source == Source::Partials)),
            residual: residual_partials_zeros(where_used(source != Source::Reverse)),
            factors: Factors::default(),
        }
    }

    /// Overwrites derivatives of modes of the same family.
    #[doc(hidden)]
    pub fn sensitivities_into(
        &mut self,
        at: &Equilibrium,
        modes: &Modes,
        sensitivities: &mut Sensitivities,
    ) -> Result<(), Error> {
        let Self { mechanism, source, matrices, residual, factors } = self;
        check_state(*mechanism, at)?;
        redundancy::check(*mechanism, at)?;
        free_directions::check(*mechanism, at)?;
        factors.factor(at)?;
        let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
        let (matrices, residual) = match source {
            Source::Partials => {
                mechanism.partials_into(q, u, b, matrices, residual);
                if modes.family == Family::Undamped && !at.description.symmetric_stiffness {
                    matrices.symmetrise_stiffness();
                }
                at.free.add_to_partials(residual);
                (Some(&*matrices), Some(&*residual))
            }
            Source::ResidualPartials => {
                mechanism.residual_partials_into(q, u, b, residual);
                at.free.add_to_partials(residual);
                (None, Some(&*residual))
            }
            Source::Reverse => (None, None),
        };
        if let (Family::Undamped, Some(matrices), Some((by_input, by_design))) = (modes.family, matrices, residual) {
            let [of_coordinates, of_inputs, of_design] = matrices.lists();
            let of_others = [(of_inputs, by_input.as_flattened()), (of_design, by_design.as_flattened())];
            let (inputs, design) = (u.len(), b.len());
            return assemble_into(at, modes, sensitivities, |sensitivity, (_, mode)| {
                let to = sensitivity.make_undamped(mode, inputs, design);
                factors.undamped_from_partials(of_coordinates, &of_others, mode, to);
            });
        }
        let zeros = || Gradient::zeros(mechanism.sizes());
        let shafts = ShaftSlopes::of(*mechanism, at)?;
        let shafts = shafts.as_deref().map(|own| (own, own.of_modes(&modes.modes)));
        let shared = AdjointContext { mechanism: *mechanism, at, factors, residual, shafts };
        match modes.family {
            Family::Undamped => {
                let (mut gradient, mut room) = (zeros(), zeros());
                assemble_into(at, modes, sensitivities, |sensitivity, (_, mode)| {
                    shared.undamped(&mut gradient, &mut room, sensitivity, mode);
                })
            }
            Family::General => {
                let (mut gradient, mut room) = ([zeros(), zeros()], [zeros(), zeros()]);
                assemble_into(at, modes, sensitivities, |sensitivity, (position, mode)| {
                    shared.general(matrices, [&mut gradient, &mut room], sensitivity, (position, mode));
                })
            }
        }
    }
}

/// Data shared by all modes.
struct AdjointContext<'a> {
    mechanism: &'a dyn Kernels,
    at: &'a Equilibrium,
    factors: &'a Factors,
    /// Explicit partials of the residual, if its gradients are computed from them.
    residual: Option<&'a ResidualPartials>,
    /// Shafts, and how the forms of all modes change with them.
    shafts: Option<(&'a ShaftSlopes, Vec<FormGradient>)>,
}

impl AdjointContext<'_> {
    /// The derivatives of an undamped mode, with the gradient of its form from reverse differentiation.
    fn undamped(
        &self,
        gradient: &mut Gradient,
        room: &mut Gradient,
        mode_sensitivity: &mut ModeSensitivity,
        mode: &Mode,
    ) {
        let (q, u, b) = (&self.at.coordinates, &self.at.inputs, &self.at.design);
        let phi = mode.real_shape();
        self.mechanism.mode_gradient_into(q, u, b, &phi, mode.lambda, gradient);
        self.total(gradient, room);
        let (inputs, design) = (gradient.inputs.iter(), gradient.design.iter());
        mode_sensitivity.set_undamped(mode, inputs.copied(), design.copied());
    }

    /// The derivatives of a general mode.
    fn general(
        &self,
        matrices: Option<&PartialMatrices>,
        [gradient, room]: [&mut ComplexGradient; 2],
        mode_sensitivity: &mut ModeSensitivity,
        (position, mode): (usize, &Mode),
    ) {
        match matrices {
            Some(matrices) => of_general(matrices, mode, gradient),
            None => {
                let form = BilinearForm::of(mode.left(), mode.place(), &mode.shape);
                form_gradient(self.mechanism, self.at, &form, room, gradient);
            }
        }
        for part in gradient.iter_mut() {
            self.total(part, &mut room[0]);
        }
        let [re, im] = gradient;
        let moved = match &self.shafts {
            None => normaliser(self.at, None, mode),
            Some((shafts, forms)) => {
                let form = &forms[position];
                let to = re.inputs.iter_mut().chain(&mut re.design).zip(im.inputs.iter_mut().chain(&mut im.design));
                for (variable, (re, im)) in to.enumerate() {
                    let slope = shafts.along(&form.by_number, variable);
                    (*re, *im) = (*re + slope.re, *im + slope.im);
                }
                form.by_s
            }
        };
        let scale = -moved;
        let slope = |(&re, &im): (&f64, &f64)| Complex { re, im } / scale;
        let by_input = re.inputs.iter().zip(&im.inputs).map(slope);
        let by_design = re.design.iter().zip(&im.design).map(slope);
        mode_sensitivity.set_general(mode, by_input, by_design);
    }

    /// Adds the effect of the equilibrium shift to a gradient.
    fn total(&self, direct: &mut Gradient, shift: &mut Gradient) {
        let w = &mut direct.coordinates;
        self.factors.solve(w.len(), w);
        match self.residual {
            Some((by_input, by_design)) => {
                combine(w, by_input, &mut shift.inputs);
                combine(w, by_design, &mut shift.design);
            }
            None => {
                let (q, u, b) = (&self.at.coordinates, &self.at.inputs, &self.at.design);
                self.mechanism.residual_gradient_into(q, u, b, w, shift);
                let free = &self.at.free;
                free.add_to_gradient(w, &mut shift.inputs, &mut shift.design);
            }
        }
        add_to(&mut direct.inputs, -1.0, &shift.inputs);
        add_to(&mut direct.design, -1.0, &shift.design);
    }
}

/// Factors of the transposed `Khat`.
#[derive(Default)]
struct Factors {
    definite: Cholesky,
    /// Where it is not positive definite.
    general: Option<Lu<f64>>,
}

impl Factors {
    /// Overwrites the factors with those at a state.
    fn factor(&mut self, at: &Equilibrium) -> Result<(), Error> {
        let stiffness = &*at.held_stiffness();
        let definite = at.description.symmetric_stiffness && self.definite.factor(stiffness).is_ok();
        self.general = None;
        if !definite {
            self.general = Some(Lu::of(stiffness.transpose()).ok_or(Error::CriticalState)?);
        }
        Ok(())
    }

    /// The derivatives of an undamped mode by inputs and design variables, from explicit partials alone: of the matrices by
    /// coordinates, then of matrices and residual by each.
    fn undamped_from_partials(
        &self,
        by_coordinate: &[f64],
        by_others: &[(&[f64], &[f64]); 2],
        mode: &Mode,
        to: [&mut [f64]; 2],
    ) {
        for_size(
            mode.shape.len(),
            #[inline(always)]
            |n| {
                let (mut weights, mut w) = (Matrix::zeros(n, n), Vector::zeros(n));
                let (weights, w) = (&mut weights.as_flattened_mut()[..n * n], &mut w[..n]);
                let form = Form::new(n, &mode.shape[..n], mode.lambda, weights);
                for (w, change) in w.iter_mut().zip(form.changes(by_coordinate)) {
                    *w = form.rate(change);
                }
                self.solve(n, w);
                for ((matrices, residual), to) in by_others.iter().zip(to) {
                    total_rates(&form, matrices, (w, residual), to);
                }
            },
        );
    }

    /// Solves in place for a right-hand side of `n` numbers; see [`for_size`].
    #[inline(always)]
    fn solve(&self, n: usize, x: &mut [f64]) {
        match &self.general {
            None => self.definite.solve_of(n, x),
            Some(factors) => x.copy_from_slice(&factors.solve(x)),
        }
    }
}

/// `phi^T (dKhat - lambda dMhat) phi - w^T dg` for several variables, from the derivatives of matrices and residual
/// with respect to them.
#[inline(always)]
fn total_rates(form: &Form<'_>, matrices: &[f64], (w, residual): (&[f64], &[f64]), to: &mut [f64]) {
    let columns = to.len();
    for (k, (to, change)) in to.iter_mut().zip(form.changes(matrices)).enumerate() {
        let shift = (0..w.len()).fold(0.0, |sum, i| sum + w[i] * residual[i * columns + k]);
        *to = form.rate(change) - shift;
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

/// `psi^T (2 s Mhat + Chat) phi`, with shafts `psi^T T'(s) phi`; zero where the eigenvalue has merged with another.
pub fn normaliser(at: &Equilibrium, shafts: Option<&ShaftSlopes>, mode: &Mode) -> Complex {
    let moved = match shafts {
        Some(own) => own.shafts.slope(mode.place()).iter().map(|row| dot_complex(row, &mode.shape)).collect(),
        None => pencil_slope_times(&at.linear, mode.s, &mode.shape),
    };
    dot_complex(mode.left(), &moved)
}
