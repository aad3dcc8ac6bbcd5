//! The excitations at one state: what they exert, at which frequencies, and how the outputs see a vibration.

use crate::algebra::{Matrix, Vector, all_finite};
use crate::kernels::{Curvature, CurvatureKernels, Kernel, Kernels, Sizes};
use crate::sensitivity::Direction;
use crate::{Complex, Equilibrium};
use eigentol_contract::Forcing;

/// Forces, frequencies and what both add to the outputs directly, or the derivatives of all these along a direction.
pub(super) struct Forces(Forcing<Matrix, Vector, Matrix>);

impl Forces {
    pub(super) fn of(mechanism: &dyn Kernels, at: &Equilibrium) -> Self {
        Self::at(mechanism, &at.coordinates, &at.inputs, &at.design)
    }

    pub(super) fn at(mechanism: &dyn Kernels, q: &[f64], u: &[f64], b: &[f64]) -> Self {
        Self::filled(mechanism.sizes(), |results| {
            mechanism.evaluate(Kernel::Forcing, &[q, u, b], results);
        })
    }

    pub(super) fn along(mechanism: &dyn CurvatureKernels, at: &Equilibrium, direction: &Direction) -> Self {
        let arguments: [&[f64]; 3] = [&at.coordinates, &at.inputs, &at.design];
        let (kernel, direction) = (Curvature::Forcing, direction.parts());
        Self::filled(mechanism.sizes(), |results| {
            mechanism.evaluate_curvature(kernel, &arguments, &direction, results);
        })
    }

    fn filled(sizes: Sizes, evaluate: impl FnOnce(&mut [&mut [f64]])) -> Self {
        let rows = |columns| Matrix::zeros(sizes.excitations, columns);
        let mut forcing = Forcing {
            cosine: rows(sizes.coordinates),
            frequency: Vector::zeros(sizes.excitations),
            direct_cosine: rows(sizes.outputs),
            sine: rows(sizes.coordinates),
            direct_sine: rows(sizes.outputs),
        };
        evaluate(&mut [
            forcing.cosine.as_flattened_mut(),
            &mut forcing.frequency,
            forcing.direct_cosine.as_flattened_mut(),
            forcing.sine.as_flattened_mut(),
            forcing.direct_sine.as_flattened_mut(),
        ]);
        Self(forcing)
    }

    /// The declared frequency of an excitation, rad/s; it may be negative.
    pub(super) fn frequency(&self, excitation: usize) -> f64 {
        self.0.frequency[excitation]
    }

    /// The amplitude of the force of an excitation; `turn` is the sign of its frequency.
    pub(super) fn force(&self, excitation: usize, turn: f64) -> Vector<Complex> {
        amplitude(&self.0.cosine[excitation], &self.0.sine[excitation], turn)
    }

    /// What an excitation adds to the outputs directly.
    pub(super) fn direct(&self, excitation: usize, turn: f64) -> Vector<Complex> {
        let (cosine, sine) = (&self.0.direct_cosine, &self.0.direct_sine);
        amplitude(&cosine[excitation], &sine[excitation], turn)
    }

    /// What of an excitation is not finite.
    pub(super) fn infinite(&self, excitation: usize) -> Option<f64> {
        let forces = [&self.0.cosine, &self.0.sine];
        let mut all =
            forces.into_iter().flat_map(|part| part[excitation].iter()).chain([&self.0.frequency[excitation]]).copied();
        all.find(|x| !x.is_finite())
    }

    /// Whether what all excitations add to an output directly is finite.
    fn finite_in(&self, output: usize) -> bool {
        let parts = [&self.0.direct_cosine, &self.0.direct_sine];
        parts.into_iter().all(|part: &Matrix| part.iter().all(|row| row[output].is_finite()))
    }
}

/// `cosine - i turn sine`.
fn amplitude(cosine: &[f64], sine: &[f64], turn: f64) -> Vector<Complex> {
    Vector::from_fn(cosine.len(), |i| Complex::new(cosine[i], -turn * sine[i]))
}

/// Derivatives of the outputs by acceleration, velocity and position, or the derivatives of these along a direction.
pub(super) struct Seen([Matrix; 3]);

impl Seen {
    pub(super) fn of(mechanism: &dyn Kernels, at: &Equilibrium) -> Self {
        let arguments: [&[f64]; 3] = [&at.coordinates, &at.inputs, &at.design];
        Self::filled(mechanism.sizes(), |results| {
            mechanism.evaluate(Kernel::OutputMotion, &arguments, results);
        })
    }

    pub(super) fn along(mechanism: &dyn CurvatureKernels, at: &Equilibrium, direction: &Direction) -> Self {
        let arguments: [&[f64]; 3] = [&at.coordinates, &at.inputs, &at.design];
        let (kernel, direction) = (Curvature::OutputMotion, direction.parts());
        Self::filled(mechanism.sizes(), |results| {
            mechanism.evaluate_curvature(kernel, &arguments, &direction, results);
        })
    }

    fn filled(sizes: Sizes, evaluate: impl FnOnce(&mut [&mut [f64]])) -> Self {
        let mut matrices = [(); 3].map(|()| Matrix::zeros(sizes.outputs, sizes.coordinates));
        evaluate(&mut matrices.each_mut().map(Matrix::as_flattened_mut));
        Self(matrices)
    }

    /// Whether each output has a derivative; rows that have none are zero from here on.
    pub(super) fn without_rough(&mut self, forces: &Forces) -> Vec<bool> {
        let of_motion = |o: usize| self.0.iter().all(|matrix| all_finite(&matrix[o]));
        let outputs = 0..self.0[0].row_count();
        let smooth: Vec<bool> = outputs.map(|o| of_motion(o) && forces.finite_in(o)).collect();
        for (o, _) in smooth.iter().enumerate().filter(|(_, smooth)| !**smooth) {
            self.0.iter_mut().for_each(|matrix| matrix[o].fill(0.0));
        }
        smooth
    }

    /// `c = s^2 o_qddot + s o_qdot + o_q`, with which an output sees the vibration `z e^{s t}`.
    pub(super) fn row(&self, output: usize, s: Complex) -> Vector<Complex> {
        self.combined(output, [s * s, s, Complex::ONE])
    }

    /// `c` of every output, one row each.
    pub(super) fn rows(&self, s: Complex) -> Matrix<Complex> {
        let [acceleration, velocity, position] = &self.0;
        let square = s * s;
        Matrix::from_fn(position.row_count(), position.column_count(), |o, i| {
            square * acceleration[o][i] + s * velocity[o][i] + position[o][i]
        })
    }

    /// `dc/ds`.
    pub(super) fn row_slope(&self, output: usize, s: Complex) -> Vector<Complex> {
        self.combined(output, [2.0 * s, Complex::ONE, Complex::ZERO])
    }

    /// `dc/ds . z`.
    pub(super) fn slope(&self, output: usize, s: Complex, z: &[Complex]) -> Complex {
        let [acceleration, velocity, _] = &self.0;
        acceleration[output].iter().zip(&velocity[output]).zip(z).map(|((a, v), z)| (2.0 * s * a + v) * z).sum()
    }

    /// `d2c/ds2`.
    pub(super) fn row_curvature(&self, output: usize) -> Vector<Complex> {
        self.combined(output, [2.0.into(), Complex::ZERO, Complex::ZERO])
    }

    fn combined(&self, output: usize, [a, v, x]: [Complex; 3]) -> Vector<Complex> {
        let [acceleration, velocity, position] = &self.0;
        let rows = [&acceleration[output], &velocity[output], &position[output]];
        Vector::from_fn(rows[0].len(), |i| a * rows[0][i] + v * rows[1][i] + x * rows[2][i])
    }
}
