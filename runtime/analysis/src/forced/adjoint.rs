//! The gradient of one output's amplitude at fixed equilibrium, by one adjoint.
//!
//! With `D^T p = c`, the amplitude `y = c . z + d` has the derivatives of `h = c . z + d + p . (F - D z)`, in which `z`
//! and `p` are held fixed. `h` is bilinear in complex numbers that hold still, so real kernels give its gradient: four
//! calls for `p . D z`, one for each of the real and the imaginary part of the rest (two if excitations of one harmonic
//! turn both ways). The frequency enters as `dh/dw` times the derivative of `w`.

use super::forces::Seen;
use super::response::{Solved, Vibration};
use crate::algebra::{Vector, dot_complex};
use crate::kernels::{Gradient, Kernel, Kernels, Linear, Sizes, gradient_results};
use crate::modes::pencil_slope_times;
use crate::sensitivity::{BilinearForm, ComplexGradient, form_gradient, subtract};
use crate::{Complex, Equilibrium};

/// One output of a harmonic and its adjoint.
pub(super) struct OutputAdjoint<'a> {
    pub(super) solved: &'a Solved<'a>,
    pub(super) vibration: &'a Vibration,
    pub(super) output: usize,
    pub(super) factors: Factors,
}

/// What stands beside the kernels in `h`, or the change of it: each enters linearly.
pub(super) struct Factors {
    /// `p`.
    pub(super) left: Vector<Complex>,
    /// `s^2 z`, `s z`, `z`.
    pub(super) motion: [Vector<Complex>; 3],
    /// `dh/dw`.
    pub(super) slope: Complex,
}

impl Factors {
    pub(super) fn form(&self) -> BilinearForm {
        let [acceleration, velocity, position] = &self.motion;
        BilinearForm::new([&self.left, acceleration, velocity, position])
    }
}

impl<'a> OutputAdjoint<'a> {
    /// `None` if the output sees a direction in which `D` vanishes: its derivatives are infinite.
    pub(super) fn new(
        solved: &'a Solved<'a>,
        vibration: &'a Vibration,
        output: usize,
    ) -> Option<Self> {
        let harmonic = &vibration.harmonic;
        let (s, z) = (harmonic.s(), &harmonic.unknowns);
        let left = (vibration.stiffness).solve_transposed(&solved.seen.row(output, s))?;
        let factors = Factors {
            slope: slope(&solved.seen, &solved.at.linear, output, (s, z, &left)),
            motion: [
                z.map(|value| s * s * value),
                z.map(|value| s * value),
                z.clone(),
            ],
            left,
        };
        Some(Self {
            solved,
            vibration,
            output,
            factors,
        })
    }

    /// The gradient of `-h` at fixed equilibrium.
    pub(super) fn gradient(&self) -> ComplexGradient {
        let (mechanism, at) = (self.solved.mechanism, self.solved.at);
        let zeros = || Gradient::zeros(mechanism.sizes());
        let (mut total, mut room) = ([zeros(), zeros()], zeros());
        form_gradient(mechanism, at, &self.factors.form(), &mut room, &mut total);
        for (total, weights) in total.iter_mut().zip(self.weights(&self.factors, 1.0)) {
            for weights in weights {
                weights.gradient_into(mechanism, at, &mut room);
                subtract(total, &room);
            }
        }
        total
    }

    /// The weights of the real and the imaginary part of `h`, for each direction in which excitations turn; what does
    /// not depend on `factors` is multiplied by `fixed`.
    pub(super) fn weights(&self, factors: &Factors, fixed: f64) -> [Vec<Weights>; 2] {
        let sizes = self.solved.mechanism.sizes();
        let shares = &self.vibration.harmonic.shares;
        let turning = |part: Part| {
            let each = [1.0, -1.0].into_iter();
            let each = each.filter(|turn| shares.iter().any(|share| share.turn() == *turn));
            each.enumerate()
                .map(|(k, turn)| {
                    let mut own = Weights::zeros(sizes);
                    let members = shares.iter().filter(|share| share.turn() == turn);
                    members.for_each(|share| own.share[share.excitation] = fixed);
                    own.cosine = factors.left.map(part);
                    own.sine = factors.left.map(|p| turn * part(Complex::new(p.im, -p.re)));
                    own.direct_cosine[self.output] = fixed * part(Complex::ONE);
                    own.direct_sine[self.output] = fixed * turn * part(-Complex::I);
                    if k == 0 {
                        own.output[self.output] = fixed;
                        own.motion = (factors.motion.each_ref()).map(|x| x.map(part));
                        let first = &shares[0];
                        own.frequency[first.excitation] = first.turn() * part(factors.slope);
                    }
                    own
                })
                .collect()
        };
        [turning(|value| value.re), turning(|value| value.im)]
    }
}

type Part = fn(Complex) -> f64;

/// `dh/dw = i (dc/ds . z - p . (2 s M + C) z)`.
fn slope(
    seen: &Seen,
    linear: &Linear,
    output: usize,
    (s, z, p): (Complex, &[Complex], &[Complex]),
) -> Complex {
    let slope = pencil_slope_times(linear, s, z);
    Complex::I * (dot_complex(&seen.row_slope(output, s), z) - dot_complex(p, &slope))
}

/// Arguments of `forced_gradient` after the state.
pub(super) struct Weights {
    output: Vector,
    motion: [Vector; 3],
    share: Vector,
    cosine: Vector,
    sine: Vector,
    direct_cosine: Vector,
    direct_sine: Vector,
    frequency: Vector,
}

impl Weights {
    pub(super) fn zeros(sizes: Sizes) -> Self {
        let (n, o, e) = (sizes.coordinates, sizes.outputs, sizes.excitations);
        Self {
            output: Vector::zeros(o),
            motion: [(); 3].map(|()| Vector::zeros(n)),
            share: Vector::zeros(e),
            cosine: Vector::zeros(n),
            sine: Vector::zeros(n),
            direct_cosine: Vector::zeros(o),
            direct_sine: Vector::zeros(o),
            frequency: Vector::zeros(e),
        }
    }

    /// Of the frequency of a harmonic alone.
    pub(super) fn of_frequency(sizes: Sizes, vibration: &Vibration) -> Self {
        let mut own = Self::zeros(sizes);
        let first = &vibration.harmonic.shares[0];
        own.frequency[first.excitation] = first.turn();
        own
    }

    /// All arguments, after these of the state or of its direction.
    pub(super) fn after<'a>(&'a self, [q, u, b]: [&'a [f64]; 3]) -> [&'a [f64]; 13] {
        let [acceleration, velocity, position] = &self.motion;
        [
            q,
            u,
            b,
            &self.output,
            acceleration,
            velocity,
            position,
            &self.share,
            &self.cosine,
            &self.sine,
            &self.direct_cosine,
            &self.direct_sine,
            &self.frequency,
        ]
    }

    pub(super) fn gradient_into(
        &self,
        mechanism: &dyn Kernels,
        at: &Equilibrium,
        gradient: &mut Gradient,
    ) {
        let state: [&[f64]; 3] = [&at.coordinates, &at.inputs, &at.design];
        let results = &mut gradient_results(gradient);
        mechanism.evaluate(Kernel::ForcedGradient, &self.after(state), results);
    }
}
