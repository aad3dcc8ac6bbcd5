//! Total second derivatives of forced vibrations: the adjoint gradient, differentiated along the change of equilibrium,
//! frequency, vibration and adjoint with each variable.

use super::adjoint::{Factors, Motion, OutputAdjoint, PARTS, Weights};
use super::extent::Extent;
use super::forces::{Forces, Seen};
use super::measure::Measure;
use super::response::{Solved, Vibration};
use super::sensitivities::{ForcedSensitivities, first_derivatives};
use crate::algebra::{Matrix, Vector, dot, dot_complex, times_complex};
use crate::kernels::{Curvature, CurvatureKernels, Gradient, Linear, gradient_results};
use crate::modes::{pencil_slope_times, pencil_times, transposed};
use crate::second_order::{Adjoint, SecondDerivatives, joined, symmetric};
use crate::sensitivity::{ComplexGradient, Direction, Slopes, directions, form_gradients_along, subtract};
use crate::shafts::ShaftsAlong;
use crate::{Complex, Equilibrium, Error, Output};

/// A forced response with its total first and second derivatives.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ForcedCurvature {
    /// The response and its first derivatives.
    pub first: ForcedSensitivities,
    /// One entry for each harmonic.
    pub harmonics: Vec<HarmonicCurvature>,
    /// Largest difference between mirrored second derivatives of an output before averaging, relative to the largest
    /// derivative: zero in exact arithmetic.
    pub asymmetry: f64,
}

/// Total second derivatives of one harmonic.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct HarmonicCurvature {
    /// Of the frequency, rad/s per SI units.
    pub frequency: SecondDerivatives<f64>,
    /// Of the complex amplitude of each output, SI; `None` as for the first derivatives.
    pub outputs: Vec<Option<SecondDerivatives<Complex>>>,
}

impl HarmonicCurvature {
    fn finite(&self) -> bool {
        let mut all = (self.outputs.iter().flatten()).flat_map(SecondDerivatives::iter);
        self.frequency.iter().all(|x| x.is_finite()) && all.all(|x| x.is_finite())
    }
}

impl ForcedCurvature {
    /// Second derivatives of the complex amplitude of an output of a harmonic, as a displacement, velocity or
    /// acceleration; `None` if it has none.
    #[must_use]
    pub fn complex(&self, harmonic: usize, output: Output, measure: Measure) -> Option<SecondDerivatives<Complex>> {
        let (of, first) = self.first.pair(harmonic)?;
        let second = self.harmonics.get(harmonic)?;
        let o = output.index();
        let slopes = first.frequency.zip(first.outputs.get(o)?.as_ref()?);
        let value = (of.frequency, (*of.outputs.get(o)?)?);
        Some(
            second
                .frequency
                .zip(second.outputs.get(o)?.as_ref()?)
                .combine(&slopes, |a, b, ab| measure.curvature(value, [a, b], ab)),
        )
    }

    /// Second derivatives of the modulus `|y|`; `None` also where it is zero.
    #[must_use]
    pub fn modulus(&self, harmonic: usize, output: Output, measure: Measure) -> Option<SecondDerivatives<f64>> {
        let y = self.first.value(harmonic, output, measure)?;
        let slopes = self.first.complex(harmonic, output, measure)?;
        Some(
            self.complex(harmonic, output, measure)?
                .combine(&slopes, |a, b, ab| Extent::Amplitude.curvature(&[y], [&[a], &[b]], &[ab])),
        )
    }

    /// Second derivatives of the phase, rad; `None` also where the modulus is zero.
    #[must_use]
    pub fn phase(&self, harmonic: usize, output: Output, measure: Measure) -> Option<SecondDerivatives<f64>> {
        let y = self.first.value(harmonic, output, measure)?;
        let slopes = self.first.complex(harmonic, output, measure)?;
        Some(self.complex(harmonic, output, measure)?.combine(&slopes, |a, b, ab| (ab / y - a / y * (b / y)).im))
    }
}

/// The forced response with total first and second derivatives by every input and design variable.
///
/// # Errors
/// Those of [`sensitivities`](super::sensitivities).
pub fn second_derivatives(mechanism: &dyn CurvatureKernels, at: &Equilibrium) -> Result<ForcedCurvature, Error> {
    let solved = Solved::new(mechanism, at)?;
    let slopes = first_derivatives(&solved)?;
    let adjoint = Adjoint::new(mechanism, at)?;
    let all: Vec<Along<'_>> =
        directions(mechanism, at)?.enumerate().map(|own| Along::new(mechanism, at, own)).collect();
    let mut most = 0.0_f64;
    let mut harmonics = Vec::new();
    for (vibration, first) in solved.vibrations.iter().zip(&slopes) {
        let shafts = ShaftsAlong::of(mechanism, at, vibration.harmonic.s())?;
        let shafts = shafts.as_ref();
        let moved = all.iter().zip(first.frequency.iter()).map(|(along, dw)| along.of((vibration, shafts), dw));
        let moved: Vec<Moved<'_>> = moved.collect();
        let (_, frequency) = frequency_rows(mechanism, at, &adjoint, vibration, &all);
        let adjoints = OutputAdjoint::each(&solved, vibration, 0..mechanism.sizes().outputs);
        let of_output = |(slopes, output_adjoint): (&Option<Slopes<Complex>>, Option<OutputAdjoint<'_>>)| {
            slopes.as_ref()?;
            let (curved, _) = Curved::new((output_adjoint?, shafts), &adjoint);
            let rows = moved.iter().map(|moved| curved.along(mechanism, moved));
            let rows: Option<Vec<Slopes<Complex>>> = rows.collect();
            let (second, asymmetry) = symmetric(&rows?, at.inputs.len(), Complex::norm);
            most = most.max(asymmetry);
            Some(second)
        };
        let harmonic_curvature = HarmonicCurvature {
            frequency: symmetric(&frequency, at.inputs.len(), f64::abs).0,
            outputs: first.outputs.iter().zip(adjoints).map(of_output).collect(),
        };
        if !harmonic_curvature.finite() {
            return Err(solved.not_finite());
        }
        harmonics.push(harmonic_curvature);
    }
    Ok(ForcedCurvature {
        first: ForcedSensitivities { response: solved.response(), harmonics: slopes },
        harmonics,
        asymmetry: most,
    })
}

/// A direction of one variable, and how everything that a vibration depends on changes along it.
pub(super) struct Along<'a> {
    at: &'a Equilibrium,
    /// Among inputs and then design variables.
    variable: usize,
    direction: Direction,
    linear: Linear,
    transposed: Linear,
    forces: Forces,
    seen: Seen,
}

impl<'a> Along<'a> {
    pub(super) fn new(
        mechanism: &dyn CurvatureKernels,
        at: &'a Equilibrium,
        (variable, direction): (usize, Direction),
    ) -> Self {
        let linear = direction.linear(mechanism, at);
        Self {
            at,
            variable,
            transposed: transposed(&linear),
            linear,
            forces: Forces::along(mechanism, at, &direction),
            seen: Seen::along(mechanism, at, &direction),
            direction,
        }
    }

    /// The change of a vibration, whose frequency changes by `dw`, with what shafts add.
    pub(super) fn of<'b>(
        &'b self,
        (vibration, shafts): (&'b Vibration, Option<&'b ShaftsAlong<'b>>),
        dw: f64,
    ) -> Moved<'b> {
        let harmonic = &vibration.harmonic;
        let (s, z) = (harmonic.s(), &harmonic.unknowns);
        let ds = Complex::new(0.0, dw);
        let slope = pencil_slope_times(&self.at.linear, s, z);
        let mut change = pencil_times(&self.linear, s, z);
        if let Some(own) = shafts {
            own.add_times(self.variable, z, false, &mut change);
            own.add_slope_times(ds, z, false, &mut change);
        }
        let mut right = Vector::from_fn(z.len(), |i| -change[i] - ds * slope[i]);
        for share in &harmonic.shares {
            let force = self.forces.force(share.excitation, share.turn());
            right.iter_mut().zip(&force).for_each(|(sum, x)| *sum += x);
        }
        let stiffness = &vibration.stiffness;
        let finite = !stiffness.driven_by(&right);
        Moved {
            along: self,
            vibration,
            shafts,
            ds,
            dz: finite.then(|| stiffness.solve(&Matrix::from_rows(1, right.into())).column(0)),
        }
    }
}

/// A vibration's change along a direction.
pub(super) struct Moved<'a> {
    along: &'a Along<'a>,
    vibration: &'a Vibration,
    shafts: Option<&'a ShaftsAlong<'a>>,
    ds: Complex,
    /// `None` if it is infinite.
    dz: Option<Vector<Complex>>,
}

impl Moved<'_> {
    /// The change of an output; `None` if it is infinite.
    pub(super) fn output(&self, solved: &Solved<'_>, output: usize) -> Option<Complex> {
        let harmonic = &self.vibration.harmonic;
        let (s, z, dz) = (harmonic.s(), &harmonic.unknowns, self.dz.as_ref()?);
        let of_frequency = self.ds * solved.seen.slope(output, s, z);
        let of_output = dot_complex(&self.along.seen.row(output, s), z);
        let of_motion = dot_complex(&solved.seen.row(output, s), dz);
        let forces = &self.along.forces;
        let direct = harmonic.shares.iter();
        let direct = direct.map(|share| forces.direct(share.excitation, share.turn())[output]);
        Some(of_frequency + of_output + of_motion + direct.sum::<Complex>())
    }
}

/// An output's adjoint gradient, prepared for differentiation.
pub(super) struct Curved<'a> {
    output_adjoint: OutputAdjoint<'a>,
    adjoint: &'a Adjoint<'a>,
    /// `Khat^T w = -dh/dq`, real and imaginary part.
    w: [Vector; 2],
    /// Second derivatives of `-h` by the numbers of shafts.
    of_shafts: Option<Matrix<Complex>>,
}

impl<'a> Curved<'a> {
    /// With the total gradient of `-h`.
    pub(super) fn new(
        (output_adjoint, shafts): (OutputAdjoint<'a>, Option<&ShaftsAlong<'_>>),
        adjoint: &'a Adjoint<'a>,
    ) -> (Self, ComplexGradient) {
        let mut room = Gradient::zeros(output_adjoint.solved.mechanism.sizes());
        let mut total = output_adjoint.gradient();
        let w = (total.each_mut()).map(|part| adjoint.total(part, &mut room));
        let unknowns = &output_adjoint.vibration.harmonic.unknowns;
        let of_shafts = shafts.map(|own| own.second(&output_adjoint.factors.left, unknowns));
        (Self { output_adjoint, adjoint, w, of_shafts }, total)
    }

    /// The derivatives of the total gradient along a direction; `None` if they are infinite.
    pub(super) fn along(&self, mechanism: &dyn CurvatureKernels, moved: &Moved<'_>) -> Option<Slopes<Complex>> {
        let (at, along) = (self.output_adjoint.solved.at, moved.along);
        let (vibration, fixed) = (self.output_adjoint.vibration, &self.output_adjoint.factors);
        let motion = &vibration.motion();
        let (change, motion_change) = &self.change(moved)?;
        let form = fixed.form(motion);
        let moved_form = [(&along.direction, change.form(motion_change))];
        let mut total = form_gradients_along(mechanism, at, &form, &moved_form).map(|mut own| own.swap_remove(0));
        let room = &mut Gradient::zeros(mechanism.sizes());
        let weights = |motion, factors, of| {
            let mut weights = Weights::of(mechanism.sizes(), vibration, motion, of);
            weights.set_output(&self.output_adjoint, factors, of);
            weights
        };
        for (total, part) in total.iter_mut().zip(PARTS) {
            for call in vibration.calls(part) {
                let base_weights = weights(motion, fixed, (call, 1.0));
                let changes = weights(motion_change, change, (call, 0.0));
                let weight_pair = (&base_weights, &changes);
                gradient_along(mechanism, at, weight_pair, &along.direction, room);
                subtract(total, room);
            }
        }
        for (part, w) in total.iter_mut().zip(&self.w) {
            (self.adjoint).total_along(part, w, &along.direction, room);
        }
        let mut total = joined(&total);
        if let (Some(second), Some(own), Some(dz)) = (&self.of_shafts, moved.shafts, &moved.dz) {
            let (z, p, dp) = (&vibration.harmonic.unknowns, &fixed.left, &change.left);
            for ((total, second), [by, mixed]) in total.iter_mut().zip(&second[along.variable]).zip(&own.by) {
                *total += second + own.form(by, dp, z) + own.form(by, p, dz) + moved.ds * own.form(mixed, p, z);
            }
        }
        Some(total.map(|value| -value))
    }

    /// How the factors of `h` change.
    fn change(&self, moved: &Moved<'_>) -> Option<(Factors, Motion)> {
        let Moved { along, ds, dz, shafts, .. } = moved;
        let (dz, ds) = (dz.as_ref()?, *ds);
        let (vibration, seen, o) =
            (self.output_adjoint.vibration, &self.output_adjoint.solved.seen, self.output_adjoint.output);
        let (s, z) = (vibration.harmonic.s(), &vibration.harmonic.unknowns);
        let (p, linear) = (&self.output_adjoint.factors.left, &self.output_adjoint.solved.at.linear);
        let n = z.len();
        let (dc, slope) = (along.seen.row(o, s), seen.row_slope(o, s));
        let mut of_matrices = pencil_times(&along.transposed, s, p);
        let mut of_frequency = pencil_slope_times(&transposed(linear), s, p);
        let mut at_rate = pencil_slope_times(linear, s, z);
        if let Some(own) = shafts {
            own.add_times(along.variable, p, true, &mut of_matrices);
            own.add_slope_times(Complex::ONE, p, true, &mut of_frequency);
            own.add_slope_times(Complex::ONE, z, false, &mut at_rate);
        }
        let right = Vector::from_fn(n, |i| dc[i] + ds * (slope[i] - of_frequency[i]) - of_matrices[i]);
        let stiffness = &vibration.stiffness;
        if stiffness.seen_by(&right) {
            return None;
        }
        let dp = stiffness.solve_transposed(&Matrix::from_rows(1, right.into()));
        let dp = dp.column(0);
        let (dslope, bend) = (along.seen.row_slope(o, s), seen.row_curvature(o));
        let dslope = Vector::from_fn(n, |i| dslope[i] + ds * bend[i]);
        let inertia = times_complex(&linear.mass, z);
        let moved = pencil_slope_times(&along.linear, s, z);
        let moved = Vector::from_fn(n, |i| moved[i] + 2.0 * ds * inertia[i]);
        let seen_change = dot_complex(&dslope, z) + dot_complex(&slope, dz);
        let of_shafts = shafts.map_or(Complex::ZERO, |own| {
            own.form(&own.by[along.variable][1], p, z) + ds * own.form(&own.curvature, p, z)
        });
        let form_change =
            dot_complex(&of_frequency, dz) + dot_complex(&dp, &at_rate) + dot_complex(p, &moved) + of_shafts;
        let motion = [
            Vector::from_fn(n, |i| s * (2.0 * ds * z[i] + s * dz[i])),
            Vector::from_fn(n, |i| ds * z[i] + s * dz[i]),
            dz.clone(),
        ];
        let slope = Complex::I * (seen_change - form_change);
        Some((Factors { left: dp, slope }, motion))
    }
}

/// Derivative of a gradient along a direction in which its weights change.
fn gradient_along(
    mechanism: &dyn CurvatureKernels,
    at: &Equilibrium,
    (weights, change): (&Weights, &Weights),
    direction: &Direction,
    gradient: &mut Gradient,
) {
    let state: [&[f64]; 3] = [&at.coordinates, &at.inputs, &at.design];
    mechanism.evaluate_curvature(
        Curvature::ForcedGradient,
        &weights.after(state),
        &change.after(direction.parts()),
        &mut gradient_results(gradient),
    );
}

/// The total derivative of a frequency along a direction.
pub(super) fn frequency_along(
    mechanism: &dyn CurvatureKernels,
    at: &Equilibrium,
    vibration: &Vibration,
    along: &Along<'_>,
) -> f64 {
    let mut gradient = Gradient::zeros(mechanism.sizes());
    Weights::of_frequency(mechanism.sizes(), vibration).gradient_into(mechanism, at, gradient_results(&mut gradient));
    let Direction { coordinates, inputs, design } = &along.direction;
    dot(&gradient.coordinates, coordinates) + dot(&gradient.inputs, inputs) + dot(&gradient.design, design)
}

/// The total gradient of a frequency, and its derivatives along each direction.
pub(super) fn frequency_rows(
    mechanism: &dyn CurvatureKernels,
    at: &Equilibrium,
    adjoint: &Adjoint<'_>,
    vibration: &Vibration,
    all: &[Along<'_>],
) -> (Slopes<f64>, Vec<Slopes<f64>>) {
    let sizes = mechanism.sizes();
    let (mut partial, mut room) = (Gradient::zeros(sizes), Gradient::zeros(sizes));
    let weights = Weights::of_frequency(sizes, vibration);
    weights.gradient_into(mechanism, at, gradient_results(&mut partial));
    let w = adjoint.total(&mut partial, &mut room);
    let slopes = |gradient: &Gradient| Slopes { by_input: gradient.inputs.clone(), by_design: gradient.design.clone() };
    let first = slopes(&partial);
    let still = Weights::zeros(sizes);
    let row = |along: &Along<'_>| {
        let weight_pair = (&weights, &still);
        gradient_along(mechanism, at, weight_pair, &along.direction, &mut partial);
        adjoint.total_along(&mut partial, &w, &along.direction, &mut room);
        slopes(&partial)
    };
    (first, all.iter().map(row).collect())
}
